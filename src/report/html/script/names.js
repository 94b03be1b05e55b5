// Names in the picture: each name is placed where it hides the least of other names and of the mechanism.
// A name moves to another side of its point only if that is clearly better.

/** Height of letters, and width of one, in units of the picture. */
const LETTER = matchMedia('(max-width: 30rem)').matches ? 5 : 3.3;
const WIDE = 0.62 * LETTER;
/** Shorter links do not show their number (units). */
const ROOM = 24;
/** Distance of a name's edge from its point, in units. */
const AWAY = 2;
/** Height of a pivot's symbol below its point, in units. */
const PIVOT = 5;
/** Cost of covering another name, a point or a line, and cost of changing the side. */
const COSTS = { name: 6, place: 3, line: 1, change: 1.5 };
const SIDES = Array.from({ length: 8 }, (_, k) => [Math.cos(k * Math.PI / 4), Math.sin(k * Math.PI / 4)]);

/** Names by point; the names of one point are written side by side. */
function namesByPlace() {
  const extent = (number) => {
    const xs = motion.links[number - 1].points.map((point) => [point[1], point[2]]);
    return Math.max(0, ...xs.flatMap((a) => xs.map((b) => Math.hypot(a[0] - b[0], a[1] - b[1])))) / motion.unit;
  };
  // A link that is short in the picture has no number there; its colour identifies it in the table of links.
  const hasRoom = (own) => own.names !== 'centre' && (own.names !== 'link' || extent(own.on[0]) > ROOM);
  const found = [];
  for (const label of motion.labels.filter(hasRoom)) {
    const isLink = label.names === 'link';
    const at = worldOf(label.on, false);
    const near = (own) => at !== null && own.at !== null && Math.hypot(own.at[0] - at[0], own.at[1] - at[1]) < 1e-9 * motion.size;
    const same = isLink ? undefined : found.find((own) => !own.isLink && (own.on[0] === label.on[0] || label.names === 'motor') && near(own));
    if (same) same.text += `, ${label.text}`;
    else found.push({ text: label.text, on: label.on, at, isLink, kind: isLink ? `link k${label.text}` : label.names, side: null });
  }
  // Names of points are placed first, because numbers of links can be placed anywhere.
  return found.sort((a, b) => a.isLink - b.isLink);
}

/** Lines of links and of ground pivots in the picture, as pairs of points. */
function linesNow() {
  const lines = [];
  for (const { on } of motion.labels.filter((label) => label.on[0] === 0)) {
    const [x, y] = toPicture(worldOf(on, false));
    lines.push([[x, y], [x, y + PIVOT]], [[x - PIVOT / 2, y + PIVOT], [x + PIVOT / 2, y + PIVOT]]);
  }
  motion.links.forEach((link, index) => {
    const at = link.points.map(([, x, y]) => worldOf([index + 1, x, y], false));
    if (at.includes(null)) return;
    const places = at.map(toPicture);
    for (let k = 1; k < places.length; k += 1) lines.push([places[k - 1], places[k]]);
    if (places.length > 2) lines.push([places[places.length - 1], places[0]]);
  });
  return lines;
}

/** Whether a line meets a box, [left, top, right, bottom], by clipping the line. */
function meets([[x, y], [u, v]], [left, top, right, bottom]) {
  let [from, to] = [0, 1];
  for (const [start, way, low, high] of [[x, u - x, left, right], [y, v - y, top, bottom]]) {
    if (Math.abs(way) < 1e-12) {
      if (start < low || start > high) return false;
    } else {
      const [a, b] = [(low - start) / way, (high - start) / way];
      from = Math.max(from, Math.min(a, b));
      to = Math.min(to, Math.max(a, b));
    }
  }
  return from < to;
}

const overlap = (a, b) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];

/** Box of a text on one of the eight sides of its point, `away` from it. */
function boxOn([x, y], text, [u, v], away) {
  const [half, high] = [0.5 * WIDE * text.length, 0.5 * LETTER];
  const [a, b] = [x + u * (away + half), y + v * (away + high)];
  return [a - half, b - high, a + half, b + high];
}

/** Number of distances at which a text is tried: farther ones only if it covers another text at all nearer ones. */
const RINGS = 4;
/** The best place of a text beside a point: its box, and its side, which counts the distances too. */
function bestPlace(at, text, cost) {
  let best = { price: Infinity };
  for (let ring = 0; ring < RINGS && best.price >= COSTS.name; ring += 1) {
    SIDES.forEach((side, k) => {
      const box = boxOn(at, text, side, AWAY + 0.7 * LETTER * ring);
      const [price, number] = [cost(box, ring * SIDES.length + k) + ring, ring * SIDES.length + k];
      if (price < best.price) best = { box, side: number, price };
    });
  }
  return best;
}

/** Whether a box leaves the picture. */
function isOutside(box) {
  const [left, top, width, height] = motion.view;
  return box[0] < left || box[1] < top || box[2] > left + width || box[3] > top + height;
}

function setUpNames() {
  const names = namesByPlace();
  for (const own of names) {
    own.element = draw(byId('names'), 'text', { class: own.kind, 'text-anchor': 'middle' });
    own.element.textContent = own.text;
  }
  following.push(() => {
    const lines = linesNow();
    const places = names.map((own) => worldOf(own.on, false)).map((at) => (at === null ? null : toPicture(at)));
    const taken = picture.classList.contains('no-loads') ? [...scaleRooms] : [...numberRooms];
    names.forEach((own, index) => {
      own.element.classList.toggle('hidden', places[index] === null);
      if (places[index] === null) return;
      const cost = (box, side) => {
        const covers = (place) => place !== null && overlap([place[0] - 1, place[1] - 1, place[0] + 1, place[1] + 1], box);
        const count = (list, test) => list.reduce((sum, one) => sum + test(one), 0);
        return COSTS.name * (count(taken, (other) => overlap(other, box)) + isOutside(box)) + COSTS.place * count(places, covers)
          + COSTS.line * count(lines, (line) => meets(line, box)) + COSTS.change * (own.side !== null && own.side !== side);
      };
      const { box, side } = bestPlace(places[index], own.text, cost);
      own.side = side;
      taken.push(box);
      own.element.setAttribute('x', (box[0] + box[2]) / 2);
      own.element.setAttribute('y', box[3] - 0.22 * LETTER);
    });
  });
}
