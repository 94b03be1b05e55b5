// Forces other than reactions: hollow arrows for loads, drives and weights, numbers at springs.

const loads = page.loads || null;
/** Half the width of an arrow's shaft, and half the width and the length of its head, in units. */
const SHAFT = 0.55;
const HEAD = [1.6, 3.2];
/** Radii of arrows of moments: for loads and for drives; the mark of the drive's sense lies between the two radii. */
const AROUND = { load: 5.6, drive: 10.4 };
/** Distance between the tip of an arrow and the edge of the picture, in units. */
const EDGE = 4;
/** Distance between the mechanism and the edge of the picture as it comes, in units. */
const MARGIN = 15;
/** Angle of the arrow of the largest moment (rad). */
const SWEEP = 1.5 * Math.PI;
/** Shorter arrows are not drawn (units). */
const SHORTEST = 0.8;
/** If there are more weights than this, their numbers are in the table only. */
const FEW = 4;
/** The number of a shorter arrow is in the table only (units). */
const READABLE = 3;
/** If the largest load is at least this fraction of the largest reaction, loads and reactions have one scale. */
const ALIKE = 0.25;

/** A column that may be one number for all rows. */
const columnOf = (own) => (typeof own === 'number' ? new Float64Array(time.length).fill(own) : singles(own));

/** Loads and weights: name, point of application and components by row; moments with their magnitude by row. */
const pushing = loads === null ? [] : [
  ...loads.arrows.filter((own) => own.force !== null).map((own) => ({ ...own, force: own.force.map(columnOf) })),
  ...loads.weights.map((own) => ({ ...own, force: own.force.map(columnOf), isQuiet: loads.weights.length > FEW })),
];
const turning = loads === null ? [] : [
  ...loads.arrows.filter((own) => own.moment !== null).map((own) => ({ ...own, radius: AROUND.load, size: columnOf(own.moment) })),
  ...loads.drives.map((own) => ({ ...own, radius: AROUND.drive, size: values(own.torque) })),
];
const between = loads === null ? [] : loads.between.map((own) => ({ ...own, size: columnOf(own.size) }));

/** A mark with a number in the picture, and a function that moves both. Numbers lie above all arrows. */
function sign(name, move) {
  const shown = [draw(byId('loads'), 'g', { 'data-name': name }), draw(byId('load-numbers'), 'g')];
  draw(shown[0], 'title', {}, name);
  const parts = { shape: draw(shown[0], 'path'), number: draw(shown[1], 'text') };
  following.push(() => {
    const isThere = move(parts);
    for (const own of shown) own.classList.toggle('hidden', !isThere);
  });
}

/** Boxes of the scales, and of the numbers in the picture at the instant shown. */
const scaleRooms = [];
let numberRooms = [];
following.push(() => { numberRooms = [...scaleRooms]; });

/** Writes a number beside a point of the picture, on the side of (u, v) if there is space. */
function tell(text, said, place, [u, v]) {
  text.textContent = said;
  const found = bestPlace(place, said, (box, k) => {
    const [a, b] = SIDES[k % SIDES.length];
    return COSTS.name * (numberRooms.filter((own) => overlap(own, box)).length + isOutside(box)) + 1.5 - a * u - b * v;
  });
  const { box } = found;
  const side = Math.round(SIDES[found.side % SIDES.length][0]);
  numberRooms.push(box);
  text.setAttribute('x', side > 0 ? box[0] : side < 0 ? box[2] : (box[0] + box[2]) / 2);
  text.setAttribute('text-anchor', side > 0 ? 'start' : side < 0 ? 'end' : 'middle');
  text.setAttribute('y', box[3] - 0.22 * LETTER);
}

/** Outline of a hollow arrow between two points of the picture. */
function hollow([x, y], [p, q]) {
  const length = Math.hypot(p - x, q - y);
  const [u, v] = [(p - x) / length, (q - y) / length];
  const head = Math.min(HEAD[1], 0.5 * length);
  const at = (along, aside) => `${x + u * along - v * aside} ${y + v * along + u * aside}`;
  const wide = HEAD[0] * head / HEAD[1];
  const shaft = SHAFT * head / HEAD[1];
  return `M${at(0, shaft)}L${at(length - head, shaft)}L${at(length - head, wide)}L${at(length, 0)}L${at(length - head, -wide)}`
    + `L${at(length - head, -shaft)}L${at(0, -shaft)}Z`;
}

/** Outline of a hollow arrow around a point, counter-clockwise for a positive sweep; y of the picture points down. */
function hollowTurn([x, y], radius, sweep) {
  const [start, sense] = [-0.25 * Math.PI, Math.sign(sweep)];
  const end = start + sweep;
  const at = (r, angle) => `${x + r * Math.cos(angle)} ${y - r * Math.sin(angle)}`;
  const long = Math.abs(sweep) > Math.PI ? 1 : 0;
  const [outer, inner] = [radius + SHAFT, radius - SHAFT];
  const tip = end + sense * HEAD[1] / radius;
  return `M${at(outer, start)}A${outer} ${outer} 0 ${long} ${sense > 0 ? 0 : 1} ${at(outer, end)}L${at(radius + HEAD[0], end)}L${at(radius, tip)}`
    + `L${at(radius - HEAD[0], end)}L${at(inner, end)}A${inner} ${inner} 0 ${long} ${sense > 0 ? 1 : 0} ${at(inner, start)}Z`;
}

let loadScale = 0;
let [largestLoad, largestMoment] = [0, 0];

/** Determines the scales of loads, and enlarges the picture for all arrows of the run. */
function scaleLoads() {
  largestLoad = pushing.reduce((found, own) => Math.max(found, largestOf(own.force)), 0);
  largestMoment = turning.reduce((found, own) => Math.max(found, largestOf([own.size])), 0);
  const own = largestLoad > 0 ? LONGEST / largestLoad : 0;
  loadScale = forceScale > 0 && own >= forceScale && own * ALIKE <= forceScale ? forceScale : own;
  const arrows = [...pushing.map((load) => [load.on, load.force, loadScale]), ...withForces.map((joint) => [joint.on, joint.force.map(values), forceScale])];
  let [left, top, right, bottom] = [motion.view[0], motion.view[1], motion.view[0] + motion.view[2], motion.view[1] + motion.view[3]];
  let lowest = -Infinity;
  const step = Math.ceil(time.length / 200);
  for (let row = 0; row <= last; row += step) {
    setRow(row, 0);
    for (const [on, force, size] of arrows) {
      const at = worldOf(on, false);
      if (at === null) continue;
      const [x, y] = toPicture(at);
      const [p, q] = [x + force[0][row] * size || x, y - force[1][row] * size || y];
      lowest = Math.max(lowest, q);
      [left, right] = [Math.min(left, p - EDGE), Math.max(right, p + EDGE)];
      [top, bottom] = [Math.min(top, q - EDGE), Math.max(bottom, q + EDGE)];
    }
  }
  setRow(0, 0);
  // The bars of the scales lie below the mechanism and all arrows.
  const pivots = motion.view[1] + motion.view[3] - MARGIN + PIVOT;
  bottom = Math.max(bottom, Math.max(lowest, pivots) + 18);
  motion.view = [left, top, right - left, bottom - top];
  picture.setAttribute('viewBox', motion.view.join(' '));
}

function setUpLoads() {
  for (const load of pushing) {
    sign(load.name, ({ shape, number }) => {
      const at = worldOf(load.on, false);
      const [fx, fy] = load.force.map(linear);
      const size = Math.hypot(fx, fy);
      if (at === null || !(size * loadScale > SHORTEST)) return false;
      const [x, y] = toPicture(at);
      const tip = [x + fx * loadScale, y - fy * loadScale];
      shape.setAttribute('d', hollow([x, y], tip));
      const isLong = size * loadScale > READABLE && !load.isQuiet;
      number.classList.toggle('hidden', !isLong);
      if (isLong) tell(number, `${digits(size, 3)} N`, tip, [fx / size, -fy / size]);
      return true;
    });
  }
  for (const load of turning) {
    sign(load.name, ({ shape, number }) => {
      const at = worldOf(load.on, false);
      const size = linear(load.size);
      if (at === null || !(Math.abs(size) > 1e-3 * largestMoment)) return false;
      const [x, y] = toPicture(at);
      shape.setAttribute('d', hollowTurn([x, y], load.radius, SWEEP * size / largestMoment));
      const aside = Math.SQRT1_2 * load.radius;
      tell(number, `${digits(Math.abs(size), 3)} N·m`, [x + aside, y + aside], [0.7, 0.7]);
      return true;
    });
  }
  for (const load of between.filter((one) => one.ends !== null)) {
    sign(load.name, ({ number }) => {
      const ends = load.ends.map((end) => worldOf(end, false));
      if (ends.includes(null)) return false;
      const [[a, b], [c, d]] = ends.map(toPicture);
      const length = Math.hypot(c - a, d - b) || 1;
      const side = Math.sign(d - b) || 1;
      tell(number, `${digits(Math.abs(linear(load.size)), 3)} N`, [(a + c) / 2 + 3 * side * (d - b) / length, (b + d) / 2 - 3 * side * (c - a) / length], [1, 0]);
      return true;
    });
  }
  const gravity = loads === null ? 0 : Math.hypot(...loads.gravity);
  if (gravity > 0) {
    sign('gravity', ({ shape, number }) => {
      const [left, top] = motion.view;
      const [u, v] = [loads.gravity[0] / gravity, -loads.gravity[1] / gravity];
      const foot = [left + 5 + Math.max(-8 * u, 0), top + 4 + Math.max(-8 * v, 0)];
      shape.setAttribute('d', hollow(foot, [foot[0] + 8 * u, foot[1] + 8 * v]));
      tell(number, `g = ${digits(gravity, 4)} m/s²`, [foot[0] + 4 * u + 1.5, foot[1] + 4 * v], [1, 0]);
      return true;
    });
  }
  tellLoads();
  return largestLoad > 0 || largestMoment > 0 || between.length > 0 || gravity > 0;
}

/** Writes the legend of the hollow arrows, with their scales. */
function tellLoads() {
  const said = [];
  if (largestLoad > 0) {
    const scale = loadScale === forceScale ? 'at the scale of the reactions' : `the hollow bar marked ${digits(round(largestLoad))} N shows their scale`;
    said.push(`the longest is ${digits(largestLoad, 3)} N, ${scale}`);
  }
  if (largestMoment > 0) said.push(`moments are arcs around a point, three quarters of a circle for ${digits(largestMoment, 3)} N·m`);
  byId('load-scale').textContent = `hollow arrows: what acts in addition to the reactions (loads, drives, weights, gravity)${said.map((own) => `; ${own}`).join('')}`;
}

/** Table of all forces at the instant shown: loads first, then reactions. */
function setUpForces() {
  const body = byId('force-rows');
  // Values below 1e-12 of the largest value of the run are only rounding.
  const naturalForce = 1e-12 * Math.max(largestForce(), largestLoad);
  const naturalMoment = Math.max(naturalForce * motion.size, 1e-12 * largestMoment);
  const seen = (size, natural) => (Math.abs(size) > natural ? size : 0);
  const angle = (x, y) => (x === 0 && y === 0 ? '' : `${(Math.atan2(y, x) * 180 / Math.PI).toFixed(1)}°`);
  const force = (columns) => () => {
    const [x, y] = columns.map((column) => seen(linear(column), naturalForce));
    return [`${digits(Math.hypot(x, y))} N`, angle(x, y)];
  };
  const moment = (column) => () => {
    const size = seen(linear(column), naturalMoment);
    return [`${digits(Math.abs(size))} N·m`, size > 0 ? 'counter-clockwise' : size < 0 ? 'clockwise' : ''];
  };
  const pull = (column) => () => {
    const size = linear(column);
    return [`${digits(Math.abs(size))} N`, size > 0 ? 'pulls together' : size < 0 ? 'pushes apart' : ''];
  };
  const channel = (name) => page.channels.findIndex((own) => own.name === name);
  const guides = motion.joints.map((own) => [own, channel(`joint.${own.name}.moment_N_m`)]).filter(([, index]) => index >= 0);
  const rows = [
    ...pushing.map((own) => [own.name, force(own.force)]),
    ...turning.map((own) => [own.name, moment(own.size)]),
    ...between.map((own) => [own.ends === null ? `${own.name}, on the first` : own.name, own.ends === null ? moment(own.size) : pull(own.size)]),
    ...withForces.map((own) => [`reaction at ${own.name}, of ${own.links[0]} on ${own.links[1]}`, force(own.force.map(values))]),
    ...guides.map(([own, index]) => [`reaction moment at ${own.name}, of ${own.links[0]} on ${own.links[1]}`, moment(values(index))]),
  ];
  const cells = rows.map(([name, read]) => {
    const row = put(body, 'tr');
    put(row, 'th', '', name).scope = 'row';
    return { read, own: [put(row, 'td'), put(row, 'td')] };
  });
  if (cells.length > 0) follow(body, () => cells.forEach(({ read, own }) => read().forEach((said, k) => { own[k].textContent = said; })));
  return cells.length > 0;
}
