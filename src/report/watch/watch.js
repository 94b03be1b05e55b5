'use strict';
// The page of `linkproof watch`: asks the program whether anything has changed, and shows the text, its mistakes, the
// sliders, and the page of the newest draft.

const byId = (id) => document.getElementById(id);
const [text, status, keep, reload] = ['text', 'status', 'keep', 'reload'].map(byId);
/** Times (ms) at which stages of drafts became visible; a test reads them. */
window.linkproofShown = [];
window.linkproofGround = [];

/** Delay (ms) of a text that was saved elsewhere. */
const LATER = 150;
let saved = null;
let version = 0;
let state = null;
/** The window of the mechanism, when its script is there. */
const frame = new Promise((done) => {
  const found = byId('frame').contentWindow;
  if (found.linkproofTake) done(found);
  else byId('frame').addEventListener('load', () => done(byId('frame').contentWindow));
});

const WORDS = {
  agree: 'AGREE: both methods give the same motion and forces', disagree: 'DISAGREE', inconclusive: 'INCONCLUSIVE', expected: 'AGREE',
};

async function post(what, body) {
  const answer = await fetch(what, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(body) });
  return answer.ok ? answer.json() : { error: `the program answers ${answer.status}` };
}

/** Takes the answer of the program to a change: a new text, or the reason why nothing was changed. */
function take(answer) {
  if (answer.text) setText(answer.text);
  if (answer.error) say(`${answer.error}${answer.help ? `; ${answer.help}` : ''}`, 'wrong');
  tellKept();
}

/** The text as the program has set it last. */
let base = '';

function setText(now) {
  base = now;
  if (text.value === now) return;
  const { selectionStart, selectionEnd, scrollTop } = text;
  text.value = now;
  text.setSelectionRange(Math.min(selectionStart, now.length), Math.min(selectionEnd, now.length));
  text.scrollTop = scrollTop;
  numberLines();
}

function say(words, kind) {
  status.textContent = words;
  status.className = kind;
}

function tellKept() {
  keep.disabled = text.value === saved && !(state && state.isMissing);
}

let numbered = '';
function numberLines() {
  const wrong = new Set(((state && state.errors) || []).filter((own) => own.place).map((own) => own.place.line));
  const count = text.value.split('\n').length;
  const now = [count, ...wrong].join();
  if (now === numbered) return;
  numbered = now;
  const lines = byId('lines');
  lines.replaceChildren();
  let run = '';
  for (let line = 1; line <= count; line += 1) {
    if (!wrong.has(line)) {
      run += `${line}\n`;
      continue;
    }
    const own = document.createElement('span');
    own.textContent = `${line}\n`;
    own.className = 'wrong';
    lines.append(run, own);
    run = '';
  }
  lines.append(run);
  lines.scrollTop = text.scrollTop;
}

function showErrors(errors) {
  const list = byId('errors');
  list.replaceChildren();
  for (const error of errors) {
    const item = document.createElement('li');
    const told = error.place ? document.createElement('button') : document.createElement('span');
    told.textContent = `${error.place ? `line ${error.place.line}: ` : ''}${error.key ? `${error.key}: ` : ''}${error.message}`;
    if (error.place) {
      told.type = 'button';
      told.addEventListener('click', () => {
        text.focus();
        text.setSelectionRange(error.place.at, error.place.at + error.place.length);
      });
    }
    item.append(told);
    if (error.help) {
      const help = document.createElement('div');
      help.className = 'help';
      help.textContent = error.help;
      item.append(help);
    }
    list.append(item);
  }
}

/** One request at a time; of several waiting ones, only the last is sent. */
let [isSending, waiting] = [false, null];
async function sendLatest(what, make) {
  waiting = [what, make];
  if (isSending) return;
  isSending = true;
  while (waiting !== null) {
    const [now, body] = waiting;
    waiting = null;
    take(await post(now, body()));
  }
  isSending = false;
}

function showParameters(parameters) {
  const box = byId('parameters');
  byId('sliders').hidden = parameters.length === 0;
  const names = parameters.map((own) => own.key).join();
  if (box.dataset.names !== names) {
    box.dataset.names = names;
    box.replaceChildren();
    for (const { key, value } of parameters) {
      const label = document.createElement('label');
      const [name, slider, now] = ['span', 'input', 'output'].map((own) => document.createElement(own));
      name.textContent = key;
      slider.type = 'range';
      slider.name = key;
      const reach = value === 0 ? 1 : Math.abs(value) / 2;
      [slider.min, slider.max, slider.step] = [value - reach, value + reach, Number((reach / 200).toPrecision(1))];
      slider.value = value;
      now.textContent = value;
      slider.addEventListener('input', () => {
        now.textContent = slider.value;
        sendLatest('parameter', () => ({ text: text.value, key, value: Number(slider.value) }));
      });
      label.append(name, slider, now);
      box.append(label);
    }
    return;
  }
  for (const { key, value } of parameters) {
    const slider = box.querySelector(`input[name="${CSS.escape(key)}"]`);
    if (slider === document.activeElement) continue;
    [slider.min, slider.max] = [Math.min(slider.min, value), Math.max(slider.max, value)];
    slider.value = value;
    slider.nextSibling.textContent = value;
  }
}

/** Longest time (ms) for which the next request waits until a page is painted; hidden tabs paint nothing. */
const PAINTING = 200;

/** Waits until the browser has painted what is known about a draft, and notes the time. */
async function painted(stage) {
  await new Promise((done) => {
    const painted = () => {
      window.linkproofShown.push({ stage, at: performance.timeOrigin + performance.now() });
      done();
    };
    requestAnimationFrame(() => setTimeout(painted, 0));
    setTimeout(done, PAINTING);
  });
}

/** Shows a state. Ends when its page is painted. */
async function show(now) {
  state = now;
  window.linkproofGround = now.ground;
  const isCurrent = now.shown === now.draft;
  if (isCurrent && now.page !== null) (await frame).linkproofTake(now.page, now.stage === 'moving');
  if (typeof now.text === 'string') {
    const delay = saved === null ? 0 : LATER;
    const isEdited = saved !== null && text.value !== base;
    saved = now.text;
    reload.hidden = !isEdited || text.value === saved;
    // The picture comes first.
    if (!isEdited) setTimeout(() => { if (text.value === base) setText(saved); tellKept(); }, delay);
  }
  if (now.isMissing) say('the file is missing: save it again, or keep the draft', 'wrong');
  else if (!isCurrent) say('solving', '');
  else if (now.stage === 'wrong') say(`${now.errors.length} ${now.errors.length === 1 ? 'mistake' : 'mistakes'}`, 'wrong');
  else if (now.stage === 'moving' || now.stage === 'solved') say('solved; the proof is running', '');
  else if (now.verdict) say(WORDS[now.verdict] || now.verdict, now.verdict);
  else if (now.stage === 'judged') say('the proof has failed', 'wrong');
  if (isCurrent) {
    showErrors(now.errors);
    showParameters(now.parameters);
    // If nothing of this draft can be drawn, the old picture stays, but pale.
    byId('right').classList.toggle('stale', !now.hasPage);
  }
  numberLines();
  tellKept();
  if (isCurrent) await painted(now.stage);
}

/** Shows every change. The next request tells the program that the last change is painted. */
async function follow() {
  for (;;) {
    try {
      const answer = await fetch(`state?after=${version}`);
      if (!answer.ok) throw new Error(String(answer.status));
      const now = await answer.json();
      if (now.version !== version) {
        version = now.version;
        await show(now).catch(console.error);
      }
    } catch {
      say('the program has ended: start it again, and open its new address', 'wrong');
      await new Promise((done) => { setTimeout(done, 1000); });
    }
  }
}

/** Called by the page of the mechanism: a point was dropped. */
window.linkproofDrop = (point, places) => sendLatest('point', () => ({ text: text.value, point, places }));

let pause = 0;
text.addEventListener('input', () => {
  numberLines();
  tellKept();
  clearTimeout(pause);
  pause = setTimeout(() => sendLatest('draft', () => ({ text: text.value })), 120);
});
text.addEventListener('scroll', () => { byId('lines').scrollTop = text.scrollTop; });
keep.addEventListener('click', async () => {
  const now = text.value;
  const answer = await post('keep', { text: now });
  if (!answer.error) [saved, reload.hidden] = [now, true];
  take(answer);
});
reload.addEventListener('click', () => {
  setText(saved);
  reload.hidden = true;
  sendLatest('draft', () => ({ text: text.value }));
});
follow();
