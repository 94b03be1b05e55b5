// Under `linkproof watch`: the view survives the next page, and points of links can be dragged.

/** What the next page of the same mechanism shows again. */
window.linkproofView = () => ({ share: duration > 0 ? (shown.time - time[0]) / duration : 0, isPlaying, top: window.scrollY });
window.linkproofShow = (view) => {
  setPlaying(false);
  goToTime(time[0] + view.share * duration);
  setPlaying(view.isPlaying);
  // After everything below the picture is set up.
  setTimeout(() => window.scrollTo(0, view.top), 0);
};

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
  const pixel = motion.unit / picture.getScreenCTM().a;
  const mark = draw(picture, 'circle', { class: 'dot hidden', r: 3 });
  let taken = null;
  picture.addEventListener('pointerdown', (event) => {
    const [x, y] = worldAt(event);
    let best = GRASP * pixel;
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
setUpDragging();
