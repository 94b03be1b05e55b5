'use strict';
// Data of the page: columns, and the poses of all links at any instant.

const page = JSON.parse(document.getElementById('data').textContent);
const byId = (id) => document.getElementById(id);
/** Ends listeners of the window when another page takes the place of this one. */
const life = new AbortController();

function bytes(text) {
  const raw = atob(text);
  const out = new Uint8Array(raw.length);
  for (let k = 0; k < raw.length; k += 1) out[k] = raw.charCodeAt(k);
  return out.buffer;
}
const doubles = (text) => new Float64Array(bytes(text));
const singles = (text) => new Float32Array(bytes(text));

const time = doubles(page.time);
const crank = doubles(page.crank);
/** Names of the input, and its unit on the page. */
const input = page.input || { noun: 'crank angle', word: 'crank', unit: 'deg', factor: 180 / Math.PI };
const last = time.length - 1;

/** A function that stores its result for each argument. */
function once(make) {
  const known = new Map();
  return (...key) => {
    const name = key.join();
    if (!known.has(name)) known.set(name, make(...key));
    return known.get(name);
  };
}

/** Values of the reference in a channel. */
const values = once((index) => {
  const own = page.channels[index];
  return own.wide ? doubles(own.values) : singles(own.values);
});
/** Engine minus reference; null if the engine lacks the channel. */
const errors = once((engine, index) => {
  const own = engine < page.engines.length ? page.engines[engine].channels[index].errors : undefined;
  return own === undefined ? null : singles(own);
});

/** The instant shown, between two rows, and the engine shown. */
const shown = { row: 0, share: 0, time: time[0], engine: 0, magnify: 1 };

/** Shows a row, or an instant `share` of the way to the next one. */
function setRow(row, share) {
  shown.row = row;
  shown.share = row < last ? share : 0;
  shown.time = row < last ? time[row] + shown.share * (time[row + 1] - time[row]) : time[row];
}

/** The last row at or before a time. */
function rowAt(when) {
  let low = 0;
  let high = last;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (time[middle] <= when) low = middle; else high = middle - 1;
  }
  return low;
}

/** Value of a channel at the instant shown, linear between rows. */
function linear(column) {
  const { row, share } = shown;
  return share > 0 ? column[row] + share * (column[row + 1] - column[row]) : column[row];
}

/** The instant shown in words. */
function atInstant() {
  return `t = ${shown.time.toPrecision(6)} s, ${input.noun} ${(linear(crank) * input.factor).toFixed(2)} ${input.unit}`;
}

/** A coordinate at the instant shown: between rows, a cubic with the rates of both rows. */
function smooth(column, rates) {
  const { row, share } = shown;
  if (share === 0) return column[row];
  const step = time[row + 1] - time[row];
  const rest = 1 - share;
  return rest * rest * (1 + 2 * share) * column[row] + share * share * (3 - 2 * share) * column[row + 1]
    + step * share * rest * (rest * rates[row] - share * rates[row + 1]);
}

// If a link turns by this angle (rad) or more between two rows, the page does not interpolate between these rows, and
// shows the earlier row.
const FARTHEST = 0.2;
const motion = page.motion || null;
const isClose = new Uint8Array(time.length);
if (motion !== null && motion.links.every((link) => link.rates !== null)) {
  const turns = motion.links.map((link) => values(link.at[0]));
  for (let row = 0; row < last; row += 1) {
    isClose[row] = turns.every((angle) => Math.abs(angle[row + 1] - angle[row]) < FARTHEST) ? 1 : 0;
  }
}

const GROUND = { x: 0, y: 0, cos: 1, sin: 0 };

/** Pose of a link (number as in the mechanism) of the reference or of the engine shown; null if it has no pose. */
function pose(number, isEngine) {
  if (number === 0) return GROUND;
  const link = motion.links[number - 1];
  const [angle, x, y] = link.at.map((index, k) => {
    const column = values(index);
    let value = shown.share > 0 ? smooth(column, values(link.rates[k])) : column[shown.row];
    if (isEngine) {
      const own = errors(shown.engine, index);
      value += own === null ? NaN : shown.magnify * linear(own);
    }
    return value;
  });
  if (!Number.isFinite(angle + x + y)) return null;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const [a, b] = link.centre;
  return { x: x - (cos * a - sin * b), y: y - (sin * a + cos * b), cos, sin };
}

/** World position (m) of a point of a link. */
const placeOn = (at, x, y) => [at.x + at.cos * x - at.sin * y, at.y + at.sin * x + at.cos * y];

/** A number with `count` significant digits. */
function digits(value, count = 4) {
  if (!Number.isFinite(value)) return '-';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size < 1e-3 || size >= 1e6) return value.toExponential(Math.min(count - 1, 2)).replace('e+', 'e');
  return String(Number(value.toPrecision(count)));
}
/** The largest number of the form 1, 2 or 5 times a power of ten that is at most `most`. */
function round(most) {
  if (!(most > 0) || !Number.isFinite(most)) return 1;
  const power = 10 ** Math.floor(Math.log10(most));
  return [5, 2, 1].map((own) => own * power).find((own) => own <= most * (1 + 1e-9)) || power;
}
const nice = (unit) => unit.replace('^2', '²').replace('^3', '³').replace(/ (?=[a-z])/gi, '·');
