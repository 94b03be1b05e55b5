// Hodographs, plans, curves over the crank angle and of the motor.

/** A square picture around a pole, for vectors up to `most`: its element, and places in it. */
function poled(parent, label, most, unit, size = 200) {
  const svg = draw(parent, 'svg', { class: 'curve', viewBox: `0 0 ${size} ${size}`, role: 'img', 'aria-label': label });
  const reach = 0.42 * size / (most > 0 ? most : 1);
  const at = (x, y) => [size / 2 + x * reach, size / 2 - y * reach];
  const bar = round(0.9 * most);
  const length = bar * reach;
  draw(svg, 'path', { class: 'frame', d: `M${size / 2 - 5} ${size / 2}h10M${size / 2} ${size / 2 - 5}v10` });
  if (most > 0) {
    draw(svg, 'path', { class: 'cursor', fill: 'none', d: `M6 ${size - 9}v6M6 ${size - 6}h${length}m0 -3v6` });
    draw(svg, 'text', { x: 6, y: size - 12 }, `${digits(bar)} ${nice(unit)}`);
  }
  return { svg, at };
}

function hodograph(parent, name, columns, unit) {
  const element = put(parent, 'div', 'card');
  put(element, 'h3', '', name);
  later(element, () => {
    const [x, y] = columns.map(values);
    let most = 0;
    for (let k = 0; k <= last; k += 1) most = Math.max(most, Math.hypot(x[k], y[k]));
    const { svg, at } = poled(element, `${name}: hodograph, at most ${digits(most)} ${nice(unit)}`, most, unit);
    const d = (a, b) => way(time.length, (k) => at(a(k), b(k))[0], (k) => at(a(k), b(k))[1]);
    draw(svg, 'path', { class: 'first', d: d((k) => x[k], (k) => y[k]) });
    const [dx, dy] = columns.map((index) => errors(shown.engine, index));
    if (dx && dy) draw(svg, 'path', { class: 'second', d: d((k) => x[k] + dx[k], (k) => y[k] + dy[k]) });
    const ray = draw(svg, 'line', { class: 'cursor', x1: at(0, 0)[0], y1: at(0, 0)[1] });
    const dot = draw(svg, 'circle', { class: 'dot', r: 3.5 });
    follow(svg, () => {
      const [a, b] = at(linear(x), linear(y));
      for (const [element, keys] of [[ray, ['x2', 'y2']], [dot, ['cx', 'cy']]]) {
        element.setAttribute(keys[0], a);
        element.setAttribute(keys[1], b);
      }
    });
  });
}

function setUpHodographs() {
  const list = byId('hodograph-list');
  // Taken away where there are none.
  if (list === null || motion === null) return false;
  list.replaceChildren();
  const sorts = [
    ['velocities of points', motion.points.filter((own) => own.velocity !== null).map((own) => [own.name, own.velocity]), 'm/s'],
    ['reactions', withForces.map((own) => [`${own.name}: ${own.links[0]} on ${own.links[1]}`, own.force]), 'N'],
  ];
  for (const [what, members, unit] of sorts) {
    if (members.length === 0) continue;
    const details = put(list, 'details');
    put(details, 'summary', '', `${what} (${members.length})`);
    details.open = members.length <= 6;
    const grid = put(details, 'div', 'grid small');
    for (const [name, columns] of members) hodograph(grid, name, columns, unit);
  }
  return list.children.length > 0;
}

/** Ends of the vectors of all points at the instant shown, by name; points of the ground are in the pole. */
function tipsNow(kind) {
  const tips = new Map();
  for (const point of motion.points) {
    if (point[kind] !== null) tips.set(point.name, point[kind].map((index) => linear(values(index))));
  }
  return tips;
}

/** Normal and tangential part of the relative acceleration of two places of a link (m). */
function partsOf(number, from, to) {
  const link = motion.links[number - 1];
  if (link.rates === null || link.alpha === null) return null;
  const at = pose(number, false);
  const [omega, alpha] = [link.rates[0], link.alpha[0]].map((index) => linear(values(index)));
  const [x, y] = [to[1] - from[1], to[2] - from[2]];
  const [u, v] = [at.cos * x - at.sin * y, at.sin * x + at.cos * y];
  return [[-omega * omega * u, -omega * omega * v], [-alpha * v, alpha * u]];
}

/** Half the width of a plan, and the room for its vectors. */
const MIDDLE = 170;
const REACH = 135;

/** The smallest of 1, 2, 5 times a power of ten that is not below a number. */
function roundUp(least) {
  if (!(least > 0) || !Number.isFinite(least)) return 1;
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((own) => own * power).find((own) => own >= least * (1 - 1e-9));
}

function plan(parent, kind, letter, unit) {
  const columns = motion.points.filter((own) => own[kind] !== null).map((own) => own[kind].map(values));
  if (!columns.flat().some((column) => column.some((value) => value !== 0))) return false;
  const element = put(parent, 'div', 'card');
  put(element, 'h3', '', `${kind} plan`);
  const svg = draw(element, 'svg', { class: 'curve', viewBox: `0 0 ${2 * MIDDLE} ${2 * MIDDLE}`, role: 'img', 'aria-label': `${kind} plan at the instant shown` });
  let reach = 1;
  const at = (x, y) => [MIDDLE + x * reach, MIDDLE - y * reach];
  const content = draw(svg, 'g');
  const line = (attributes, points, closed = false) => draw(content, 'path', {
    ...attributes, d: way(points.length, (k) => points[k][0], (k) => points[k][1]) + (closed ? 'Z' : ''),
  });
  follow(svg, () => {
    content.replaceChildren();
    const tips = tipsNow(kind);
    // The scale goes in steps, so that a plan is neither tiny nor too large, and lengths can be read.
    const whole = roundUp(Math.max(...[...tips.values()].map(([x, y]) => Math.hypot(x, y))));
    reach = REACH / whole;
    line({ class: 'cursor', fill: 'none' }, [[6, 2 * MIDDLE - 6], [6 + REACH / 2, 2 * MIDDLE - 6]]);
    draw(content, 'text', { x: 6, y: 2 * MIDDLE - 12 }, `${digits(whole / 2)} ${nice(unit)}`);
    const grounded = motion.labels.filter((own) => own.names === 'point' && own.on[0] === 0).map((own) => own.text);
    for (const name of grounded) if (!tips.has(name)) tips.set(name, [0, 0]);
    motion.links.forEach((link, k) => {
      const known = link.points.filter((own) => tips.has(own[0]));
      if (known.length < 2) return;
      const ends = known.map((own) => at(...tips.get(own[0])));
      line({ class: `image k${k + 1}` }, ends, ends.length > 2);
      if (kind !== 'acceleration') return;
      for (const other of known.slice(1)) {
        const parts = partsOf(k + 1, known[0], other);
        if (parts === null) continue;
        const start = tips.get(known[0][0]);
        const middle = [start[0] + parts[0][0], start[1] + parts[0][1]];
        line({ class: `vector normal k${k + 1}` }, [at(...start), at(...middle)]);
        line({ class: `vector tangential k${k + 1}` }, [at(...middle), at(middle[0] + parts[1][0], middle[1] + parts[1][1])]);
      }
    });
    const places = [[at(0, 0), [letter]]];
    for (const [name, tip] of tips) {
      const place = at(...tip);
      line({ class: 'vector' }, [at(0, 0), place]);
      const same = places.find(([own]) => Math.hypot(own[0] - place[0], own[1] - place[1]) < 4);
      if (same) same[1].push(name.toLowerCase()); else places.push([place, [name.toLowerCase()]]);
    }
    for (const [[x, y], names] of places) {
      draw(content, 'circle', { class: 'dot', cx: x, cy: y, r: 2.2 });
      draw(content, 'text', { x: x + (x < MIDDLE ? -6 : 6), y: y + (y < MIDDLE ? -4 : 11), 'text-anchor': x < MIDDLE ? 'end' : 'start' }, names.slice(0, 6).join(', '));
    }
  });
  return true;
}

function setUpPlans() {
  if (motion === null) return false;
  const list = byId('plan-list');
  const drawn = [plan(list, 'velocity', 'p', 'm/s'), plan(list, 'acceleration', 'π', 'm/s^2')];
  return drawn.includes(true);
}

/** A curve with its mean, and a dot that `now` places; x and y are told by name and unit. */
function curve(parent, title, [x, y], [across, along], mean, told, now) {
  const element = put(parent, 'div', 'card');
  put(element, 'h3', '', title);
  put(element, 'p', 'numbers', told);
  const { width, left, right, upper } = PLOT;
  const svg = draw(element, 'svg', { class: 'chart', viewBox: `0 0 ${width} ${upper + 54}`, role: 'img', 'aria-label': `${title}; ${told}` });
  const [x0, x1, top, bottom] = [left, width - right, 14, 14 + upper];
  const ends = range([x]);
  const xs = scale(ends[0], ends[1], x0, x1);
  const ys = scale(...roomy(range([y])), bottom, top);
  draw(svg, 'text', { x: 2, y: 9 }, along);
  axes(svg, [x0, x1, top, bottom], xs, ys, true);
  draw(svg, 'path', { class: 'first', d: way(x.length, (k) => xs.at(x[k]), (k) => ys.at(y[k])) });
  if (mean !== null) draw(svg, 'line', { class: 'mean', x1: x0, x2: x1, y1: ys.at(mean), y2: ys.at(mean) });
  draw(svg, 'text', { x: x1, y: bottom + 25, 'text-anchor': 'end' }, across);
  const dot = draw(svg, 'circle', { class: 'dot', r: 3.5 });
  follow(svg, () => {
    const at = now();
    let k = 0;
    while (k < x.length - 2 && (x[k + 1] - at) * (x[x.length - 1] - x[0]) < 0) k += 1;
    const share = x[k + 1] === x[k] ? 0 : (at - x[k]) / (x[k + 1] - x[k]);
    const isInside = share >= -1e-6 && share <= 1 + 1e-6;
    dot.setAttribute('visibility', isInside ? 'visible' : 'hidden');
    if (!isInside) return;
    dot.setAttribute('cx', xs.at(at));
    dot.setAttribute('cy', ys.at(y[k] + share * (y[k + 1] - y[k])));
  });
}

function setUpReduced() {
  const list = byId('reduced-list');
  const { reduced, motor } = page;
  const degrees = 180 / Math.PI;
  for (const graph of reduced ? reduced.graphs : []) {
    const [start, end] = reduced.period;
    const period = Math.abs(end - start);
    const low = Math.min(start, end);
    const now = () => (low + ((((linear(crank) - low) % period) + period) % period)) * degrees;
    const unit = nice(graph.unit);
    const marks = graph.marks.map((mark) => `${mark.word} ${digits(mark.at[1])} at ${digits((mark.at[0] * degrees) % 360, 4)} deg`);
    const told = graph.constant ? `constant: ${digits(graph.mean)} ${unit}` : `${graph.mean_word} ${digits(graph.mean)} ${unit} (dashed), ${marks.join(', ')}`;
    const symbol = graph.symbol.replace('_', '');
    curve(list, graph.name, [singles(graph.x).map((own) => own * degrees), singles(graph.y)], ['crank, deg', `${symbol}, ${unit}`], graph.mean, told, now);
  }
  if (reduced && reduced.note) put(list, 'p', 'note', reduced.note);
  if (motor) {
    const now = () => (motor.speed === null ? NaN : motor.sense * linear(values(motor.speed)));
    const told = `ratio ${digits(motor.ratio)}, efficiency ${digits(motor.efficiency)}; the dot is the instant shown`;
    curve(list, 'motor: moment on the crank over the crank\'s speed', [singles(motor.x), singles(motor.y)], ['crank, rad/s', 'M, N·m'], null, told, now);
  }
  return list.children.length > 0;
}
