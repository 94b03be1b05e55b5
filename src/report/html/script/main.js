// Controls, keyboard, time.

const slider = byId('slider');
const play = byId('play');
const duration = time[last] - time[0];
let isPlaying = false;

function show() {
  for (const move of followers) move();
  slider.value = shown.row;
  const told = atInstant();
  slider.setAttribute('aria-valuetext', told);
  byId('readout').textContent = `${told} (instant ${shown.row + 1} of ${last + 1})`;
}

/** Shows a solved instant. */
function goTo(row) {
  setRow(Math.min(Math.max(row, 0), last), 0);
  show();
}

/** Shows a time, which may lie between two neighbouring instants. */
function goToTime(when) {
  const row = rowAt(when);
  const step = row < last ? time[row + 1] - time[row] : 1;
  setRow(row, isClose[row] && step > 0 ? (when - time[row]) / step : 0);
  shown.time = when;
  show();
}

const SPEEDS = [0.05, 0.1, 0.2, 0.5, 1, 2, 5];
const base = round(duration / 6);
const speedOf = () => SPEEDS[byId('speed').selectedIndex] * base;

function setUpSpeeds() {
  for (const own of SPEEDS) {
    const factor = own * base;
    const told = Math.abs(factor - 1) < 1e-9 ? 'real time' : factor < 1 ? `slow, 1 : ${digits(1 / factor)}` : `fast, ${digits(factor)} : 1`;
    put(byId('speed'), 'option', '', told);
  }
  byId('speed').selectedIndex = SPEEDS.indexOf(1);
}

let before = null;
function frame(now) {
  if (!isPlaying) return;
  const passed = before === null ? 0 : Math.min(now - before, 100);
  before = now;
  requestAnimationFrame(frame);
  // The first picture of a page is drawn already.
  if (passed === 0) return;
  let when = shown.time + passed / 1e3 * speedOf();
  if (when > time[last]) {
    if (!byId('loop').checked) {
      goTo(last);
      setPlaying(false);
      return;
    }
    when = time[0] + (when - time[0]) % duration;
  }
  goToTime(when);
}

function setPlaying(isOn) {
  isPlaying = isOn && duration > 0;
  play.textContent = isPlaying ? 'Pause' : 'Play';
  play.setAttribute('aria-pressed', String(isPlaying));
  if (!isPlaying) return;
  before = null;
  if (shown.row >= last) setRow(0, 0);
  requestAnimationFrame(frame);
}

/** Stops playing, and moves forwards or backwards by one or several instants. */
function step(by) {
  setPlaying(false);
  goTo(shown.row + by);
}

function faster(by) {
  const speeds = byId('speed');
  speeds.selectedIndex = Math.min(Math.max(speeds.selectedIndex + by, 0), SPEEDS.length - 1);
}

function toggle(id) {
  const own = byId(id);
  own.checked = !own.checked;
  own.dispatchEvent(new Event('change'));
}

const KEYS = {
  ' ': () => setPlaying(!isPlaying), ArrowLeft: (far) => step(far ? -10 : -1), ArrowRight: (far) => step(far ? 10 : 1),
  Home: () => step(-last), End: () => step(last), '+': () => faster(1), '-': () => faster(-1),
  l: () => toggle('loop'), r: () => toggle('show-arrows'), f: () => toggle('show-loads'), p: () => toggle('show-paths'), n: () => toggle('show-names'),
};

document.addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  const at = event.target;
  if (at.matches('select, summary, pre, .scroll') || (event.key === ' ' && at.matches('button, input'))) return;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const act = Object.hasOwn(KEYS, key) ? KEYS[key] : undefined;
  if (act === undefined) return;
  event.preventDefault();
  act(event.shiftKey);
}, { signal: life.signal });

/** Sets up the box that shows or hides a part of the picture. */
function setUpBox(part) {
  const box = byId(`show-${part}`);
  if (box && picture) box.addEventListener('change', () => picture.classList.toggle(`no-${part}`, !box.checked));
}

/** Width of a link (units of the picture). A smaller difference between engine and reference is not seen. */
const LINK = 1;

/** Shows the engine if it is seen beside the reference. On demand it is shown with the difference magnified. */
function setUpEngineBox() {
  const [box, factors] = ['show-engine', 'magnify'].map(byId);
  if (!hasEngine || motion === null) return;
  const isApart = () => farthest() / motion.unit > LINK;
  box.checked = isApart();
  box.dispatchEvent(new Event('change'));
  box.addEventListener('change', () => {
    if (!box.checked || isApart()) return;
    factors.selectedIndex = factors.options.length - 1;
    factors.dispatchEvent(new Event('change'));
  });
}

function setUpEngines() {
  const choice = byId('engine');
  page.engines.forEach((engine) => put(choice, 'option', '', engine.name));
  const factors = byId('magnify');
  const refill = () => {
    factors.replaceChildren();
    const all = motion === null ? [1] : magnifications();
    all.forEach((own) => { put(factors, 'option', '', own === 1 ? 'not magnified' : `${digits(own)} times`).value = own; });
    shown.magnify = 1;
    tellFactor();
  };
  const tellFactor = () => {
    byId('magnified').textContent = shown.magnify === 1 ? '' : `The difference between engine and reference is drawn ${digits(shown.magnify)} times as large as it is.`;
  };
  choice.addEventListener('change', () => {
    shown.engine = choice.selectedIndex;
    refill();
    redrawPaths();
    setUpCharts();
    setUpHodographs();
    show();
  });
  factors.addEventListener('change', () => {
    shown.magnify = Number(factors.value);
    tellFactor();
    redrawPaths();
    show();
  });
  refill();
}

/** Charts, curves and plans below the picture. */
function setUpBelow() {
  setUpCharts();
  if (!setUpFormulas()) byId('formulas').remove();
  if (!setUpHodographs()) byId('hodographs').remove();
  if (!setUpPlans()) byId('plans').remove();
  setUpReduced();
}

/** Sets up the page. A `view` of an earlier page is shown afterwards, by `resume`. */
function setUp(view) {
  const has = { script: true, engines: hasEngine, ...setUpPicture() };
  setUpSpeeds();
  setUpEngines();
  const choice = byId('over');
  over = isOneWay && last > 0 ? 'crank' : 'time';
  choice.value = over;
  if (!isOneWay) choice.closest('label').remove();
  choice.addEventListener('change', () => { over = choice.value; setUpCharts(); setUpFormulas(); });
  // Outdated sections below the picture, under `linkproof watch`, stay as they are.
  const isWhole = document.querySelector('main > .outdated') === null;
  if (isWhole) setUpBelow();
  const needs = [...document.querySelectorAll('[data-needs]')].filter((own) => own.closest('.outdated') === null);
  for (const own of needs) if (!has[own.dataset.needs]) own.remove();
  for (const [id, isOpen] of [['open-all', true], ['close-all', false]]) {
    byId(id).addEventListener('click', () => { for (const own of byId('charts').querySelectorAll('details')) own.open = isOpen; });
  }
  ['reference', 'engine', 'arrows', 'loads', 'paths', 'names'].forEach(setUpBox);
  setUpEngineBox();
  slider.max = last;
  slider.addEventListener('input', () => { setPlaying(false); goTo(Number(slider.value)); });
  play.addEventListener('click', () => setPlaying(!isPlaying));
  byId('back').addEventListener('click', () => step(-1));
  byId('on').addEventListener('click', () => step(1));
  byId('controls').hidden = motion === null && page.channels.length === 0;
  if (view !== null) return;
  goTo(0);
  if (!window.matchMedia('(prefers-reduced-motion: reduce)').matches) setPlaying(true);
}
