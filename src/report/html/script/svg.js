// Elements, axes and ticks.

const SVG = 'http://www.w3.org/2000/svg';

/** An element of SVG with attributes, in a parent. */
function draw(parent, name, attributes = {}, text = null) {
  const own = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) own.setAttribute(key, value);
  if (text !== null) own.textContent = text;
  if (parent) parent.append(own);
  return own;
}

/** An element of HTML with a class and a text, in a parent. */
function put(parent, name, className = '', text = null) {
  const own = document.createElement(name);
  if (className) own.className = className;
  if (text !== null) own.textContent = text;
  parent.append(own);
  return own;
}

/** Path through points, interrupted at points that are not numbers. */
function way(count, x, y) {
  let d = '';
  let pen = 'M';
  for (let k = 0; k < count; k += 1) {
    const [a, b] = [x(k), y(k)];
    if (Number.isFinite(a + b)) {
      d += `${pen}${a.toFixed(2)} ${b.toFixed(2)}`;
      pen = 'L';
    } else {
      pen = 'M';
    }
  }
  return d;
}

/** Least and greatest value of several columns. */
function range(columns) {
  let [low, high] = [Infinity, -Infinity];
  for (const column of columns) {
    for (const value of column) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return low <= high ? [low, high] : [0, 0];
}

/** Largest magnitude of a vector, given its columns. */
function largestOf(columns) {
  let most = 0;
  for (let row = 0; row <= last; row += 1) most = Math.max(most, Math.hypot(...columns.map((column) => column[row])) || 0);
  return most;
}

/** About `count` round numbers from low to high. */
function ticks(low, high, count) {
  const step = round((high - low) / count * 1.5);
  const out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1) out.push(k * step);
  return out;
}

/** Calls `fill` once, when the element comes near the window or is printed. */
const pending = new Map();
const watcher = new IntersectionObserver((entries) => {
  for (const entry of entries) if (entry.isIntersecting) reveal(entry.target);
}, { rootMargin: '400px' });
function later(element, fill) {
  pending.set(element, fill);
  watcher.observe(element);
}
function reveal(element) {
  const fill = pending.get(element);
  if (fill === undefined) return;
  pending.delete(element);
  watcher.unobserve(element);
  fill();
}
window.addEventListener('beforeprint', () => {
  for (const element of [...pending.keys()]) {
    if (element.closest('details:not([open])') === null) reveal(element);
  }
}, { signal: life.signal });

/** Functions that are called at every instant shown. */
const followers = [];
