// Hodographs, curves over the crank angle, curves of the motor, and formulas.

/** A square picture around a pole, for vectors up to `most`: its element, and the map to positions in it. */
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
    const most = largestOf([x, y]);
    const { svg, at } = poled(element, `${name}: hodograph, at most ${digits(most)} ${nice(unit)}`, most, unit);
    const d = (a, b) => way(time.length, (k) => at(a(k), b(k))[0], (k) => at(a(k), b(k))[1]);
    draw(svg, 'path', { class: 'first', d: d((k) => x[k], (k) => y[k]) });
    const [dx, dy] = columns.map((index) => errors(shown.engine, index));
    if (dx && dy) draw(svg, 'path', { class: 'second', d: d((k) => x[k] + dx[k], (k) => y[k] + dy[k]) });
    const ray = draw(svg, 'line', { class: 'cursor', x1: at(0, 0)[0], y1: at(0, 0)[1] });
    const dot = draw(svg, 'circle', { class: 'dot', r: 3.5 });
    const now = put(element, 'p', 'numbers');
    follow(svg, () => {
      const [a, b] = at(linear(x), linear(y));
      now.textContent = `${digits(Math.hypot(linear(x), linear(y)))} ${nice(unit)} at ${atInstant()}`;
      for (const [element, keys] of [[ray, ['x2', 'y2']], [dot, ['cx', 'cy']]]) {
        element.setAttribute(keys[0], a);
        element.setAttribute(keys[1], b);
      }
    });
  });
}

function setUpHodographs() {
  const list = byId('hodograph-list');
  // The section is removed if there are no curves.
  if (list === null || motion === null) return false;
  list.replaceChildren();
  const ofPoints = (what) => motion.points.filter((own) => own[what] !== null).map((own) => [own.name, own[what]]);
  const sorts = [
    ['velocities of points', ofPoints('velocity'), 'm/s'],
    ['accelerations of points', ofPoints('acceleration'), 'm/s^2'],
    ['reactions', withForces.map((own) => [`${own.name}: ${own.links[0]} on ${own.links[1]}`, own.force]), 'N'],
  ];
  for (const [what, all, unit] of sorts) {
    const members = all.filter(([, columns]) => largestOf(columns.map(values)) > 0);
    if (members.length === 0) continue;
    const details = put(list, 'details');
    put(details, 'summary', '', `${what} (${members.length})`);
    details.open = members.length <= 6;
    const grid = put(details, 'div', 'grid small');
    for (const [name, columns] of members) hodograph(grid, name, columns, unit);
  }
  return list.children.length > 0;
}

/** A curve with its mean, and a dot at the position `now`; the axes have names and units. */
function curve(parent, title, [x, y], [across, along], mean, told, now) {
  const element = put(parent, 'div', 'card');
  put(element, 'h3', '', title);
  put(element, 'p', 'numbers', told);
  const { width, left, right, upper, head } = PLOT;
  const svg = draw(element, 'svg', { class: 'chart', viewBox: `0 0 ${width} ${upper + head + 40}`, role: 'img', 'aria-label': `${title}; ${told}` });
  const [x0, x1, top, bottom] = [left, width - right, head, head + upper];
  const xs = scaleAlong(x, x0, x1);
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
    const onAxis = (angle) => (low + ((((angle - low) % period) + period) % period)) * degrees;
    const now = () => onAxis(linear(crank));
    const unit = nice(graph.unit);
    const marks = graph.marks.map((mark) => `${mark.word} ${digits(mark.at[1])} at ${digits(onAxis(mark.at[0]), 4)} deg`);
    const [x, y] = [singles(graph.x).map((own) => own * degrees), singles(graph.y)];
    // A mean below 1e-12 of the largest value is only rounding.
    const mean = Math.abs(graph.mean) < 1e-12 * largestOf([y]) ? 0 : graph.mean;
    const told = graph.constant ? `constant: ${digits(mean)} ${unit}` : `${graph.mean_word} ${digits(mean)} ${unit} (dashed), ${marks.join(', ')}`;
    const symbol = graph.symbol.replace('_', '');
    curve(list, graph.name, [x, y], ['crank, deg', `${symbol}, ${unit}`], graph.mean, told, now);
  }
  if (reduced && reduced.note) put(list, 'p', 'note', reduced.note);
  if (motor) {
    const now = () => (motor.speed === null ? NaN : motor.sense * linear(values(motor.speed)));
    const told = `ratio ${digits(motor.ratio)}, efficiency ${digits(motor.efficiency)}; the dot is the instant shown`;
    curve(list, 'motor: moment on the crank over the crank\'s speed', [singles(motor.x), singles(motor.y)], ['crank, rad/s', 'M, N·m'], null, told, now);
  }
  return list.children.length > 0;
}

/** Every formula with the quantity that it claims; formulas that disagree are open. */
function setUpFormulas() {
  const list = byId('formula-list');
  // The section is removed if there are no formulas.
  if (list === null) return false;
  list.replaceChildren();
  for (const own of page.formulas) {
    const details = put(list, 'details');
    put(put(details, 'summary', '', `${own.name}, claimed to be ${own.claim}: `), 'span', own.verdict, own.verdict);
    details.open = own.verdict === 'disagree';
    const element = put(put(details, 'div', 'grid'), 'div', 'card');
    const [reference, difference] = [singles(own.mechanism), singles(own.difference)];
    const told = { name: own.name, unit: nice(own.unit), factor: 1, own, engine: null, apart: 'formula minus mechanism' };
    later(element, () => plot(element, { ...told, reference, difference }));
  }
  return list.children.length > 0;
}
