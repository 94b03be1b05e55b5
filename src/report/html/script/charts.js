// Channels: reference and engine over time or crank angle; below, the magnitude of their difference with its bound.

const PLOT = { width: 340, left: 56, right: 8, upper: 110, gap: 25, lower: 66, axis: 28, head: 18 };
/** Units of the page in place of SI units. */
const READ = { rad: ['deg', 180 / Math.PI], m: ['mm', 1e3] };
const readUnit = (unit) => READ[unit] || [nice(unit), 1];

let over = 'time';
const isOneWay = crank.every((value, k) => k === 0 || (value - crank[k - 1]) * (crank[last] - crank[0]) > 0);
const abscissa = () => (over === 'crank' ? crank.map((value) => value * input.factor) : time);
const abscissaUnit = () => (over === 'crank' ? `${input.word}, ${input.unit}` : 't, s');

/** Update functions of charts near the window, called at every instant shown. */
const near = new Map();
const nearWatcher = new IntersectionObserver((entries) => {
  for (const entry of entries) {
    const own = near.get(entry.target);
    if (own !== undefined) own.isNear = entry.isIntersecting;
    if (entry.isIntersecting && own !== undefined) own.move();
  }
});
function follow(element, move) {
  near.set(element, { move, isNear: true });
  nearWatcher.observe(element);
  move();
}
followers.push(() => { for (const own of near.values()) if (own.isNear) own.move(); });
// Before printing, all charts are updated to the instant shown.
window.addEventListener('beforeprint', () => near.forEach((own) => own.move()), { signal: life.signal });

/** A range with margins and a positive width. Variation far below `natural` is rounding error and is not magnified. */
function roomy([low, high], natural = 0) {
  const size = Math.max(Math.abs(low), Math.abs(high), natural) || 1;
  const room = Math.max(0.06 * (high - low), 1e-6 * size);
  return [low - room, high + room];
}

function axes(svg, box, xs, ys, labels) {
  const [x0, x1, y0, y1] = box;
  for (const own of ticks(ys.low, ys.high, 3)) {
    const y = ys.at(own);
    draw(svg, 'line', { class: 'tick', x1: x0, x2: x1, y1: y, y2: y });
    draw(svg, 'text', { x: x0 - 4, y: y + 3.5, 'text-anchor': 'end' }, (ys.name || digits)(own));
  }
  for (const own of ticks(xs.low, xs.high, 5)) {
    const x = xs.at(own);
    draw(svg, 'line', { class: 'tick', x1: x, x2: x, y1: y0, y2: y1 });
    if (labels) draw(svg, 'text', { x, y: y1 + 12, 'text-anchor': 'middle' }, digits(own));
  }
  draw(svg, 'rect', { class: 'frame', x: x0, y: y0, width: x1 - x0, height: y1 - y0 });
}

/** A linear scale from numbers to a part of a picture. */
function scale(low, high, from, to, name = null) {
  const share = (high - low) / (to - from);
  return { low, high, name, at: (value) => from + (value - low) / share, of: (place) => low + (place - from) * share };
}

/** The scale of an abscissa, from left to right in the direction of the motion. */
function scaleAlong(line, left, right) {
  const [low, high] = range([line]);
  return scale(low, high > low ? high : low + 1, ...(line[line.length - 1] < line[0] ? [right, left] : [left, right]));
}

/** Largest magnitude among an instant and two on either side, because magnitudes of rounding errors jump. */
function envelope(column, row) {
  let most = NaN;
  for (let k = Math.max(row - 2, 0); k <= Math.min(row + 2, last); k += 1) if (!(most >= Math.abs(column[k]))) most = Math.abs(column[k]);
  return most;
}

function bands(svg, own, xs, top, bottom, engine) {
  if (!(own.left_out > 0)) return;
  const rows = engine.unjudged;
  for (let k = 0; k < rows.length; k += 1) {
    const first = rows[k];
    while (rows[k + 1] === rows[k] + 1) k += 1;
    const ends = [xs.line[Math.max(first - 1, 0)], xs.line[Math.min(rows[k] + 1, last)]].map(xs.at).sort((a, b) => a - b);
    draw(svg, 'rect', { class: 'doubt', x: ends[0], y: top, width: Math.max(ends[1] - ends[0], 1), height: bottom - top });
  }
}

function chart(card, index) {
  const channel = page.channels[index];
  const engine = page.engines[shown.engine];
  const own = engine ? engine.channels[index] : {};
  const [unit, factor] = readUnit(channel.unit);
  const apart = 'engine minus reference';
  plot(card, { name: channel.name, unit, factor, own, engine, apart, reference: values(index), difference: errors(shown.engine, index) });
}

/** A reference and a second curve, which is the reference plus `difference`, and below the size of the difference with its bound. */
function plot(card, { name, unit, factor, own, engine, apart, reference, difference }) {
  const line = abscissa();
  const { width, left, right, upper, gap, lower, axis, head } = PLOT;
  const height = head + upper + axis + (difference ? gap + lower : 0);
  const told = own.bound === undefined ? '' : `; largest error ${digits(own.max * factor, 3)} of ${digits(own.bound * factor, 3)} ${unit} allowed: ${own.verdict}`;
  const svg = draw(card, 'svg', { class: 'chart', viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': `${name} over ${over === 'crank' ? input.noun : 'time'}${told}` });
  const [x0, x1] = [left, width - right];
  const xs = { ...scaleAlong(line, x0, x1), line };
  const [low, high] = roomy(range([reference]).map((value) => value * factor), (own.scale || 0) * factor);
  const [top, bottom] = [head, head + upper];
  const ys = scale(low, high, bottom, top);
  draw(svg, 'text', { x: 2, y: 10 }, unit);
  bands(svg, own, xs, top, bottom, engine);
  axes(svg, [x0, x1, top, bottom], xs, ys, !difference);
  const x = (k) => xs.at(line[k]);
  draw(svg, 'path', { class: 'first', d: way(line.length, x, (k) => ys.at(reference[k] * factor)) });
  let end = bottom;
  if (difference) {
    draw(svg, 'path', { class: 'second', d: way(line.length, x, (k) => Math.min(Math.max(ys.at((reference[k] + difference[k]) * factor), top), bottom)) });
    end = bottom + gap + lower;
    const most = Math.max(...range([difference]).map(Math.abs)) * factor;
    const bound = (own.bound || 0) * factor;
    const decade = (value, rounded) => rounded(Math.log10(value > 0 ? value : 1e-300));
    const highest = decade(Math.max(most, bound), Math.ceil);
    const below = bound > 0 ? decade(bound, Math.floor) : highest;
    const lowest = Math.max(Math.min(decade(most, Math.floor) - 2, highest - 3, below), highest - 12);
    const [from, to] = [bottom + gap, end];
    const log = scale(lowest, highest, to, from, (value) => `1e${Math.round(value)}`);
    draw(svg, 'text', { x: 2, y: from - 8 }, `error, ${unit}`);
    bands(svg, own, xs, from, to, engine);
    axes(svg, [x0, x1, from, to], xs, { ...log, ...{ low: lowest, high: highest } }, true);
    const y = (value) => Math.min(log.at(value > 0 ? Math.log10(value) : lowest), to);
    draw(svg, 'path', { class: 'error', d: way(line.length, x, (k) => y(envelope(difference, k) * factor)) });
    if (bound > 0) draw(svg, 'line', { class: 'bound', x1: x0, x2: x1, y1: y(bound), y2: y(bound) });
  }
  draw(svg, 'text', { x: x1, y: end + 25, 'text-anchor': 'end' }, abscissaUnit());
  const cursor = draw(svg, 'line', { class: 'cursor', y1: top, y2: end });
  const pointed = draw(svg, 'line', { class: 'pointed', y1: top, y2: end, x1: -9, x2: -9 });
  const now = put(card, 'p', 'numbers');
  /** The row whose instant is nearest to the pointer. */
  const rowUnder = (event) => {
    const box = svg.getBoundingClientRect();
    const at = xs.of((event.clientX - box.left) / box.width * width);
    let best = 0;
    for (let k = 1; k <= last; k += 1) if (Math.abs(line[k] - at) < Math.abs(line[best] - at)) best = k;
    return best;
  };
  const valuesAt = (row) => {
    const [ours, off] = [reference[row] * factor, difference ? difference[row] * factor : NaN];
    const engineTold = difference ? `, ${apart} ${off < 0 ? '−' : '+'}${digits(Math.abs(off), 3)} ${unit}` : '';
    return `${digits(ours, 6)} ${unit}${engineTold}`;
  };
  svg.addEventListener('click', (event) => { setPlaying(false); goTo(rowUnder(event)); });
  let under = null;
  const tellValues = () => {
    const place = under === null ? -9 : x(under);
    pointed.setAttribute('x1', place);
    pointed.setAttribute('x2', place);
    now.textContent = under === null ? valuesAt(shown.row) : `${digits(line[under])} ${abscissaUnit().split(', ')[1]}: ${valuesAt(under)}`;
  };
  svg.addEventListener('pointermove', (event) => { under = rowUnder(event); tellValues(); });
  svg.addEventListener('pointerleave', () => { under = null; tellValues(); });
  follow(svg, () => {
    const place = xs.at(linear(line));
    cursor.setAttribute('x1', place);
    cursor.setAttribute('x2', place);
    tellValues();
  });
}

const used = (own) => (own.bound > 0 ? own.max / own.bound : 0);
const ofBound = (share) => (share > 1.5 ? `${digits(share, 2)} times the bound` : `${digits(100 * share, 2)} % of the bound`);
const GRAVITY = ['disagree', 'inconclusive', 'expected', 'agree'];

function card(parent, index) {
  const channel = page.channels[index];
  const own = page.engines[shown.engine] ? page.engines[shown.engine].channels[index] : {};
  const element = put(parent, 'div', 'card');
  put(element, 'h3', '', channel.name);
  if (own.bound !== undefined) {
    const [unit, factor] = readUnit(channel.unit);
    const line = put(element, 'p', 'numbers', `error ${digits(own.max * factor, 3)} of ${digits(own.bound * factor, 3)} ${unit}, `);
    put(line, 'span', own.verdict, own.verdict);
    if (own.reason) put(element, 'p', '', own.reason);
  }
  later(element, () => chart(element, index));
}

/** All channels by quantity; groups with disagreeing channels, the first group and the worst channel are open. */
function setUpCharts() {
  const list = byId('charts');
  list.replaceChildren();
  near.forEach((own, element) => { if (!element.isConnected) near.delete(element); });
  const engine = page.engines[shown.engine];
  const quantities = new Map();
  page.channels.forEach((channel, index) => {
    if (!quantities.has(channel.quantity)) quantities.set(channel.quantity, []);
    quantities.get(channel.quantity).push(index);
  });
  const judged = (index) => (engine ? engine.channels[index] : {});
  const worst = page.channels.reduce((best, _, index) => (used(judged(index)) > used(judged(best)) ? index : best), 0);
  let isFirst = true;
  for (const [quantity, members] of quantities) {
    const verdicts = members.map((index) => judged(index).verdict).filter((own) => own !== undefined);
    const word = GRAVITY.find((own) => verdicts.includes(own));
    const details = put(list, 'details');
    const summary = put(details, 'summary', '', `${quantity} (${members.length})`);
    if (word !== undefined) {
      const share = Math.max(...members.map((index) => used(judged(index))));
      summary.append(': ');
      put(summary, 'span', word, word);
      summary.append(`, at most ${ofBound(share)}`);
    }
    details.open = isFirst || members.includes(worst) || word === 'disagree';
    isFirst = false;
    const grid = put(details, 'div', 'grid');
    members.forEach((index) => card(grid, index));
  }
  const told = byId('worst');
  told.replaceChildren();
  if (engine && judged(worst).bound !== undefined) {
    const share = used(judged(worst));
    put(told, 'p', '', share > 1 ? `Farthest beyond its bound (${ofBound(share)}):` : `Closest to its bound (${ofBound(share)}):`);
    card(told, worst);
  }
}
