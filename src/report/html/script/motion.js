// The mechanism in motion: links, springs, reactions, paths.

const picture = byId('picture');
/** Length of the longest arrow, in units of the picture; shorter if the picture is low. */
const LONGEST = motion === null ? 26 : Math.min(26, Math.max(0.5 * (motion.view[3] - 30), 12));
const hasEngine = page.engines.some((engine) => engine.channels.some((own) => own.errors !== undefined));
const following = [];

/** World position (m) in units of the picture. */
const toPicture = ([x, y]) => [x / motion.unit, -y / motion.unit];

function matrix(at) {
  const [x, y] = toPicture([at.x, at.y]);
  return `matrix(${at.cos} ${-at.sin} ${-at.sin} ${-at.cos} ${x} ${y})`;
}

function setUpLinks() {
  for (const circle of picture.querySelectorAll('.engine circle')) circle.setAttribute('r', circle.dataset.ring);
  for (const [side, isEngine] of [['reference', false], ['engine', true]]) {
    const parts = [...picture.querySelectorAll(`.${side} [data-link]`)];
    if (isEngine && !hasEngine) {
      parts.forEach((part) => part.classList.add('hidden'));
      continue;
    }
    for (const part of parts) draw(part, 'title', {}, `${isEngine ? 'engine: ' : ''}link ${part.dataset.link}, ${part.dataset.name}`);
    following.push(() => {
      const poses = once((number) => pose(number, isEngine));
      for (const part of parts) {
        const at = poses(Number(part.dataset.link));
        part.classList.toggle('hidden', at === null);
        if (at !== null) part.setAttribute('transform', matrix(at));
      }
    });
  }
}

/** Shows the name of a joint under the pointer. */
function setUpJoints() {
  const parent = draw(null, 'g', { id: 'joints' });
  byId('arrows').before(parent);
  for (const joint of motion.joints) {
    const spot = draw(parent, 'circle', { r: 2.4 });
    draw(spot, 'title', {}, `joint ${joint.name}, ${joint.kind}: ${joint.links[0]} and ${joint.links[1]}`);
    following.push(() => {
      const at = worldOf(joint.on, false);
      spot.classList.toggle('hidden', at === null);
      if (at === null) return;
      const [x, y] = toPicture(at);
      spot.setAttribute('cx', x);
      spot.setAttribute('cy', y);
    });
  }
}

/** Elements of reference and engine that are redrawn at every instant: `make` creates an element, `move` draws it. */
function onBothSides(parent, make, move) {
  for (const isEngine of hasEngine ? [false, true] : [false]) {
    const own = draw(parent, 'g', { class: isEngine ? 'other' : 'own' });
    const element = make(own);
    following.push(() => own.classList.toggle('hidden', !move(element, isEngine)));
  }
}

/** World position (m) of a point of a link, [number, x, y]; null if the link has no pose. */
function worldOf([number, x, y], isEngine) {
  const at = pose(number, isEngine);
  return at === null ? null : placeOn(at, x, y);
}

function setUpStretched() {
  for (const own of motion.stretched) {
    onBothSides(byId('stretched'), (parent) => draw(parent, 'path'), (element, isEngine) => {
      const ends = own.ends.map((end) => worldOf(end, isEngine));
      if (ends.includes(null)) return false;
      const [[a, b], [c, d]] = ends.map(toPicture);
      const length = Math.hypot(c - a, d - b) || 1;
      const [u, v] = [-(d - b) / length * own.width, (c - a) / length * own.width];
      const line = (points) => way(points.length, (k) => a + (c - a) * points[k][0] - u * points[k][1],
        (k) => b + (d - b) * points[k][0] - v * points[k][1]);
      element.setAttribute('d', own.lines.map(line).join(''));
      return true;
    });
  }
}

/** Value of a channel at the instant shown. */
function channelNow(index, isEngine) {
  const value = linear(values(index));
  if (!isEngine) return value;
  const own = errors(shown.engine, index);
  return own === null ? NaN : value + linear(own);
}

let forceScale = 0;
const withForces = motion === null ? [] : motion.joints.filter((joint) => joint.force !== null);

function largestForce() {
  return Math.max(0, ...withForces.map((joint) => largestOf(joint.force.map(values))));
}

function setUpArrows() {
  const most = largestForce();
  if (!(most > 0)) return;
  forceScale = LONGEST / most;
  for (const joint of withForces) {
    const make = (parent) => {
      draw(parent, 'title', {}, `reaction at ${joint.name}: of ${joint.links[0]} on ${joint.links[1]}`);
      return [draw(parent, 'line'), draw(parent, 'path')];
    };
    onBothSides(byId('arrows'), make, ([line, head], isEngine) => {
      const at = worldOf(joint.on, isEngine);
      const [fx, fy] = joint.force.map((index) => channelNow(index, isEngine) * forceScale);
      const length = Math.hypot(fx, fy);
      if (at === null || !(length > 0.3)) return false;
      const [x, y] = toPicture(at);
      const [u, v] = [fx / length, -fy / length];
      const size = Math.min(3, 0.5 * length);
      const [ex, ey] = [x + u * length, y + v * length];
      const [bx, by] = [ex - u * size, ey - v * size];
      for (const [key, value] of Object.entries({ x1: x, y1: y, x2: bx, y2: by })) line.setAttribute(key, value);
      head.setAttribute('d', `M${ex} ${ey}L${bx - v * size * 0.35} ${by + u * size * 0.35}L${bx + v * size * 0.35} ${by - u * size * 0.35}Z`);
      return true;
    });
  }
  const bar = round(most);
  byId('arrow-scale').textContent = `reactions: force of a joint's first link on its second, at the joint; the bar marked ${digits(bar)} N is to scale, the longest arrow is ${digits(most, 3)} N`;
}

/** The scale bars of lengths and forces, in the lower left corner. */
function setUpScales() {
  const [left, top, width, height] = motion.view;
  const scales = byId('scales');
  const bar = (y, length, text) => {
    draw(scales, 'path', { d: `M${left + 3} ${y - 1}V${y + 1}M${left + 3} ${y}H${left + 3 + length}M${left + 3 + length} ${y - 1}V${y + 1}` });
    write(length, y, text);
  };
  const write = (length, y, text) => {
    draw(scales, 'text', { x: left + 4.5 + length, y: y + 1.1 }, text);
    scaleRooms.push([left, y - 0.5 * LETTER, left + 4.5 + length + WIDE * text.length, y + 0.5 * LETTER]);
  };
  const metres = round(motion.unit * width / 4);
  bar(top + height - 3.5, metres / motion.unit, `${digits(metres * 1e3)} mm`);
  if (forceScale > 0) {
    const force = round(LONGEST / forceScale);
    bar(top + height - 8.5, force * forceScale, `${digits(force)} N`);
  }
  if (loadScale > 0 && loadScale !== forceScale) {
    const load = round(LONGEST / loadScale);
    const y = top + height - 13.5;
    draw(scales, 'rect', { x: left + 3, y: y - SHAFT, width: load * loadScale, height: 2 * SHAFT });
    write(load * loadScale, y, `${digits(load)} N, loads`);
  }
}

let redrawPaths = () => {};
function setUpPaths() {
  const points = motion.points.filter((point) => point.at !== null);
  const drawn = points.map((point) => {
    const [x, y] = point.at.map(values);
    const [across, along] = [x, y].map((column) => range([column]));
    if (Math.hypot(across[1] - across[0], along[1] - along[0]) < 1e-6 * motion.size) return null;
    const own = draw(byId('paths'), 'path', { d: way(time.length, (k) => x[k] / motion.unit, (k) => -y[k] / motion.unit) });
    draw(own, 'title', {}, `path of ${point.name}`);
    return { x, y, point, other: hasEngine ? draw(byId('paths'), 'path', { class: 'other' }) : null };
  });
  redrawPaths = () => {
    for (const own of drawn) {
      if (own === null || own.other === null) continue;
      const [dx, dy] = own.point.at.map((index) => errors(shown.engine, index));
      const place = (column, differences, sign) => (k) => sign * (column[k] + shown.magnify * differences[k]) / motion.unit;
      const d = dx && dy ? way(time.length, place(own.x, dx, 1), place(own.y, dy, -1)) : '';
      own.other.setAttribute('d', d);
    }
  };
  redrawPaths();
  return drawn.some((own) => own !== null);
}

/** Largest distance (m) between engine and reference of a mass centre, or of a point at the mechanism's size from it. */
function farthest() {
  let most = 0;
  for (const link of motion.links) {
    link.at.forEach((index, k) => {
      const own = errors(shown.engine, index);
      const arm = k === 0 ? motion.size : 1;
      if (own !== null) for (const value of own) most = Math.max(most, Math.abs(value) * arm || 0);
    });
  }
  return most;
}

/** Factors by which differences between engine and reference can be magnified. */
function magnifications() {
  const most = farthest();
  const factor = most > 0 ? round(0.08 * motion.size / most) : 1;
  return [1, factor / 100, factor / 10, factor].filter((own, k) => k === 0 || (own > 1 && Number.isFinite(own)));
}

/** Sets up the picture. Returns whether there are reactions, loads, paths and forces to show. */
function setUpPicture() {
  if (motion === null) return { arrows: false, loads: false, paths: false, forces: false };
  setUpLinks();
  setUpJoints();
  setUpStretched();
  setUpArrows();
  scaleLoads();
  const hasLoads = setUpLoads();
  const paths = setUpPaths();
  setUpNames();
  setUpScales();
  followers.push(() => following.forEach((move) => move()));
  return { arrows: forceScale > 0, loads: hasLoads, paths, forces: setUpForces() };
}
