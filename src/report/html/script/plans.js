// Plans of velocities and accelerations: the vectors of `linkproof plan` at the instant shown.

/** Half the width of a plan, and the space for its vectors. */
const MIDDLE = 190;
const REACH = 160;
/** Height of a plan's letters, and width of one. */
const SIGN = [12, 6.8];

/** The smallest round number that is at least `least`. */
function roundUp(least) {
  if (!(least > 0) || !Number.isFinite(least)) return 1;
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 1.5, 2, 3, 4, 5, 6, 8, 10].map((own) => own * power).find((own) => own >= least * (1 - 1e-9));
}

const tipColumns = once((number, tip) => page.plans.plans[number].tips[tip].map(columnOf));
const letterOf = new Map(page.plans ? page.plans.letters : []);

/** The layout of a plan at the instant shown, and the ends of its vectors. Layouts are not interpolated. */
function planNow(number) {
  const own = page.plans.plans[number];
  const which = (row) => (own.which === null ? 0 : own.which[row]);
  const layout = own.layouts[which(shown.row)];
  const isOne = shown.row === last || which(shown.row) === which(shown.row + 1);
  const read = (column) => (isOne ? linear(column) : column[shown.row]);
  return { ...layout, at: layout.tips.map((_, tip) => tipColumns(number, tip).map(read)) };
}

/** The vectors of a link with the absolute vectors to their ends; for 0, all vectors. */
function chosen(vectors, link) {
  const own = vectors.filter((vector) => link === 0 || vector[4] === link);
  const ends = new Set(own.flatMap((vector) => [vector[2], vector[3]]));
  return vectors.filter((vector) => own.includes(vector) || ((vector[1] === 'absolute' || vector[1] === 'centre') && ends.has(vector[3])));
}

/** Writes the name of a vector, such as a_BA^n, with subscript and superscript. */
function named(parent, name) {
  const [, letter, of, part] = /^([^_]+)_([^^]+)\^?(.*)$/.exec(name) || [null, name, '', ''];
  parent.append(letter);
  if (of) put(parent, 'sub', '', of);
  if (part) put(parent, 'sup', '', part);
}

const GRADES = { absolute: 0, centre: 0, relative: 1, normal: 2, tangential: 2, coriolis: 2, sliding: 2 };

/** Draws the plan of the instant into `content`. Returns the ends of all vectors as [point, letters]. */
function drawPlan(content, own, now, link) {
  const vectors = chosen(now.vectors, link);
  const used = new Set(vectors.flatMap((vector) => [vector[2], vector[3]]));
  const [x, y] = [0, 1].map((axis) => range([[0, ...[...used].map((tip) => now.at[tip][axis])]]));
  // The scale fits the plan, and changes only in round steps, so that lengths can be read off with the scale bar.
  const whole = roundUp(Math.max(x[1] - x[0], y[1] - y[0]));
  const reach = 2 * REACH / whole;
  const place = ([a, b]) => [MIDDLE + (a - (x[0] + x[1]) / 2) * reach, MIDDLE - (b - (y[0] + y[1]) / 2) * reach];
  const line = (attributes, points, close = '') => draw(content, 'path', {
    ...attributes, d: way(points.length, (k) => points[k][0], (k) => points[k][1]) + close,
  });
  const bar = 0.2 * whole * reach;
  line({ class: 'cursor', fill: 'none' }, [[6, 2 * MIDDLE - 10], [6, 2 * MIDDLE - 6], [6 + bar, 2 * MIDDLE - 6], [6 + bar, 2 * MIDDLE - 10]]);
  draw(content, 'text', { x: 6, y: 2 * MIDDLE - 14 }, `${digits(0.2 * whole)} ${nice(own.unit)}`);
  motion.links.forEach((body, k) => {
    const tips = body.points.map(([name]) => now.tips.findIndex(([letter]) => letter === letterOf.get(name))).filter((tip) => used.has(tip));
    if (tips.length > 2) line({ class: `image k${k + 1}` }, tips.map((tip) => place(now.at[tip])), 'Z');
  });
  for (const [name, part, from, to, of, meaning] of [...vectors].sort((a, b) => GRADES[a[1]] - GRADES[b[1]])) {
    const [start, end] = [place(now.at[from]), place(now.at[to])];
    const length = Math.hypot(end[0] - start[0], end[1] - start[1]);
    if (!(length > 0.5)) continue;
    const vector = draw(content, 'g', { class: `vector ${part} k${GRADES[part] > 0 ? of : 0}` });
    draw(vector, 'title', {}, `${name}: ${meaning}`);
    draw(vector, 'path', { d: way(2, (k) => [start, end][k][0], (k) => [start, end][k][1]) });
    const size = Math.min(7, 0.5 * length);
    const [u, v] = [(end[0] - start[0]) / length * size, (end[1] - start[1]) / length * size];
    draw(vector, 'path', { class: 'tip', d: `M${end[0]} ${end[1]}l${-u - 0.3 * v} ${-v + 0.3 * u}l${0.6 * v} ${-0.6 * u}Z` });
  }
  const places = [];
  now.tips.forEach(([letter], tip) => {
    if (tip > 0 && !used.has(tip)) return;
    const at = place(now.at[tip]);
    const same = places.find(([one]) => Math.hypot(one[0] - at[0], one[1] - at[1]) < 4);
    if (same) same[1].push(letter); else places.push([at, [letter]]);
  });
  letter(content, places);
}

/** Writes letters beside their points, on the side where they cover least. */
function letter(content, places) {
  const taken = places.map(([[x, y]]) => [x - 3, y - 3, x + 3, y + 3]);
  places.forEach(([[x, y], letters]) => {
    const text = letters.length > 6 ? `${letters.slice(0, 6).join(', ')}, …` : letters.join(', ');
    const [half, high] = [0.5 * SIGN[1] * text.length, 0.5 * SIGN[0]];
    const boxes = SIDES.map(([u, v]) => [x + u * (4 + half), y + v * (4 + high)]).map(([a, b]) => [a - half, b - high, a + half, b + high]);
    const costs = boxes.map((box) => taken.filter((own) => overlap(own, box)).length + 3 * (box[0] < 0 || box[2] > 2 * MIDDLE || box[1] < 0 || box[3] > 2 * MIDDLE - 24));
    const box = boxes[costs.indexOf(Math.min(...costs))];
    taken.push(box);
    draw(content, 'circle', { class: 'dot', cx: x, cy: y, r: 2.2 });
    draw(content, 'text', { x: (box[0] + box[2]) / 2, y: box[3] - 2, 'text-anchor': 'middle' }, text);
  });
}

function plan(parent, number) {
  const own = page.plans.plans[number];
  const isSome = (column) => typeof column !== 'number' || column !== 0;
  if (!own.tips.some((tip) => tip.some(isSome))) return false;
  const element = put(parent, 'div', 'card');
  put(element, 'h3', '', `${own.word} plan, in ${nice(own.unit)}`);
  const when = put(element, 'p', 'numbers');
  const svg = draw(element, 'svg', { class: 'curve', viewBox: `0 0 ${2 * MIDDLE} ${2 * MIDDLE}`, role: 'img', 'aria-label': `${own.word} plan at the instant shown; its vectors are in the table below` });
  const content = draw(svg, 'g');
  const details = put(element, 'details');
  const summary = put(details, 'summary');
  const box = put(details, 'div', 'scroll');
  box.tabIndex = 0;
  box.setAttribute('role', 'region');
  box.setAttribute('aria-label', `vectors of the ${own.word} plan`);
  const table = put(box, 'table', 'numbers');
  const heads = put(put(table, 'thead'), 'tr');
  for (const head of ['vector', 'from, to', `size, ${nice(own.unit)}`, 'direction', 'meaning']) put(heads, 'th', '', head).scope = 'col';
  const body = put(table, 'tbody');
  const move = () => {
    const now = planNow(number);
    const link = byId('plan-of').selectedIndex;
    when.textContent = atInstant();
    content.replaceChildren();
    drawPlan(content, own, now, link);
    const vectors = chosen(now.vectors, link);
    summary.textContent = `${vectors.length} vectors in numbers`;
    body.replaceChildren();
    if (!details.open) return;
    for (const [name, , from, to, , meaning] of vectors) {
      const [x, y] = [0, 1].map((axis) => now.at[to][axis] - now.at[from][axis]);
      const row = put(body, 'tr');
      row.dataset.vector = name;
      named(put(row, 'th'), name);
      const said = [`${now.tips[from][0]}, ${now.tips[to][0]}`, digits(Math.hypot(x, y)), x === 0 && y === 0 ? '' : `${(Math.atan2(y, x) * 180 / Math.PI).toFixed(1)}°`, meaning];
      for (const own of said) put(row, 'td', '', own);
    }
  };
  follow(svg, move);
  details.addEventListener('toggle', move);
  byId('plan-of').addEventListener('change', move);
  return true;
}

function setUpPlans() {
  if (!page.plans) return false;
  const choice = byId('plan-of');
  for (const name of ['all links', ...motion.links.map((own) => own.name)]) put(choice, 'option', '', name);
  const list = byId('plan-list');
  return page.plans.plans.map((_, number) => plan(list, number)).includes(true);
}
