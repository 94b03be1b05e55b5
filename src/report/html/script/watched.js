// Under `linkproof watch`: the view survives the next page, and points of links can be dragged.

/** The parts of a page that a person sets: boxes by their identifiers, and open details by the first word of their summary. */
const boxes = () => [...document.querySelectorAll('#controls input[type=checkbox]')];
const details = () => [...document.querySelectorAll('details')];
const nameOf = (own) => own.querySelector('summary').textContent.split(/ \(|:/)[0];

/** Ends this page. Returns the view that the next page shows again. */
function end() {
  const view = {
    share: duration > 0 ? (shown.time - time[0]) / duration : 0,
    isPlaying,
    speed: byId('speed').selectedIndex,
    boxes: new Map(boxes().map((own) => [own.id, own.checked])),
    open: new Map(details().map((own) => [nameOf(own), own.open])),
  };
  setPlaying(false);
  life.abort();
  watcher.disconnect();
  nearWatcher.disconnect();
  return view;
}

function resume(view) {
  setPlaying(false);
  byId('speed').selectedIndex = view.speed;
  for (const own of boxes()) {
    // The new page itself decides whether the engine is shown.
    if (own.id === 'show-engine' || !view.boxes.has(own.id) || view.boxes.get(own.id) === own.checked) continue;
    own.checked = !own.checked;
    own.dispatchEvent(new Event('change'));
  }
  for (const own of details()) if (view.open.has(nameOf(own))) own.open = view.open.get(nameOf(own));
  goToTime(time[0] + view.share * duration);
  setPlaying(view.isPlaying);
}

/** All named points, each with the links on which it lies: number of the link, name, and place in its frame (m). */
function draggable() {
  const found = new Map();
  const links = [{ name: 'ground', points: window.parent.linkproofGround || [] }, ...motion.links];
  links.forEach((link, number) => {
    for (const [name, x, y] of link.points) {
      if (!found.has(name)) found.set(name, []);
      found.get(name).push({ number, link: link.name, from: [x, y], others: link.points.filter(([own]) => own !== name) });
    }
  });
  for (const holder of [...found.values()].flat()) holder.others = holder.others.filter(([name]) => found.get(name).length > 1);
  return found;
}

/** Where a dragged point lies in the frame of a link. If the link has one other joint, the direction from it stays. */
function droppedOn({ number, from, others }, [wx, wy]) {
  const at = pose(number, false);
  const [dx, dy] = [wx - at.x, wy - at.y];
  const place = [at.cos * dx + at.sin * dy, at.cos * dy - at.sin * dx];
  if (number === 0 || others.length !== 1) return place;
  const [, ox, oy] = others[0];
  const [ux, uy] = [from[0] - ox, from[1] - oy];
  const ratio = Math.hypot(place[0] - ox, place[1] - oy) / Math.hypot(ux, uy);
  return Number.isFinite(ratio) ? [ox + ux * ratio, oy + uy * ratio] : place;
}

/** Largest distance (pixels) between the pointer and the point that it takes. */
const GRASP = 14;

function setUpDragging() {
  if (motion === null || picture === null || window.parent === window) return;
  const worldAt = (event) => {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(picture.getScreenCTM().inverse());
    return [at.x * motion.unit, -at.y * motion.unit];
  };
  const mark = draw(picture, 'circle', { class: 'dot hidden', r: 3 });
  let taken = null;
  picture.addEventListener('pointerdown', (event) => {
    const [x, y] = worldAt(event);
    let best = GRASP * motion.unit / picture.getScreenCTM().a;
    for (const [name, holders] of draggable()) {
      const at = worldOf([holders[0].number, ...holders[0].from], false);
      const apart = at === null ? Infinity : Math.hypot(at[0] - x, at[1] - y);
      if (apart < best) [best, taken] = [apart, { name, holders }];
    }
    if (taken === null) return;
    setPlaying(false);
    picture.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  picture.addEventListener('pointermove', (event) => {
    if (taken === null) return;
    const [x, y] = toPicture(worldAt(event));
    mark.classList.remove('hidden');
    mark.setAttribute('cx', x);
    mark.setAttribute('cy', y);
  });
  picture.addEventListener('pointerup', (event) => {
    if (taken === null) return;
    const target = worldAt(event);
    const places = taken.holders.map((holder) => ({ link: holder.link, from: holder.from, to: droppedOn(holder, target) }));
    window.parent.linkproofDrop(taken.name, places);
    mark.classList.add('hidden');
    taken = null;
  });
}
setUp(view);
setUpDragging();
return { end, resume };
