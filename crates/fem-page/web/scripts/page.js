// Sliders, runs, pictures.
import { show } from './units.js';
import { allMaterials, setMaterials } from './materials.js';
import { FIRST, caseOf, commandOf, fragmentOf, read, sound } from './scene.js';
import { Runner, lastOnly } from './runner.js';
import { at, element, showCharts, showEffects, showEnergy, showFault, showNumbers, showPicture } from './results.js';
import { buildSlider, refreshControls } from './controls.js';
import { buildStories, storyText } from './telling.js';

// While a slider moves: fewer instants. At rest: as the command has it.
const MOVING = { rows: 250, frames: 9 };
const AT_REST = { rows: 1000, frames: 25 };
const LEAST_VIEW = 1.5;
const PLAY_MS = 120;
// After which a reader is told that something is under way.
const LATE_MS = 700;

const runner = new Runner();
let state = { ...FIRST };
let ownText = null;
let shown = { outcome: null, index: 0, text: '' };
let playing = null;

// ---- what the page asks for

const textNow = () => ownText ?? caseOf(state);
const share = () => at('instant').value / 1000;
const isSlow = () => ownText === null && state.model === 'fem';

// Half of the window over the contact radius, from the contact to the whole of a small body.
const halfWidth = () => LEAST_VIEW * 200 ** (at('zoom').value / 1000);

function refreshTexts() {
  const text = textNow();
  at('case').textContent = text;
  at('command').textContent = commandOf(text);
  at('pasted').hidden = ownText === null;
  history.replaceState(null, '', fragmentOf({ state, text: ownText }) || '#');
}

const compute = lastOnly(async (text, ask) => {
  const began = performance.now();
  const request = { text, ...ask, share: share(), halfWidth: halfWidth() };
  const onway = ({ kind, begun, done }) => {
    if (kind === 'begun') at('progress-text').textContent = progressText(begun);
    else {
      at('status').textContent = '';
      at('progress').hidden = false;
      at('progress-bar').value = done;
    }
  };
  at('progress-text').textContent = 'Computing';
  const late = setTimeout(() => { at('progress').hidden = false; }, LATE_MS);
  const answer = await runner.ask('begin', request, onway);
  clearTimeout(late);
  at('progress').hidden = true;
  at('progress-bar').value = 0;
  if (answer.kind === 'dropped') return;
  if (answer.kind === 'ended') {
    at('status').textContent = 'Ended before there was anything to show; the numbers are those of the case before.';
    at('results').classList.add('stale');
    return;
  }
  tell(text, answer, performance.now() - began, ask === MOVING);
  // The reader may have moved on while it was computed.
  if (request.share !== share() || request.halfWidth !== halfWidth()) drawPicture();
}, (isBusy) => at('results').setAttribute('aria-busy', String(isBusy)));

function progressText({ model, price }) {
  const steps = price.steps ? `, ${price.steps.toLocaleString('en')} steps of ${price.elements.toLocaleString('en')} elements` : '';
  return `Computing: ${model}${steps}`;
}

function tell(text, answer, milliseconds, isMoving) {
  const place = ownText === null ? at('fault') : at('paste-fault');
  showFault(at('fault'), null);
  showFault(at('paste-fault'), null);
  if (answer.kind !== 'done') {
    const fault = answer.fault ?? { message: 'The module failed; another one has taken its place.', help: answer.message };
    showFault(place, fault);
    at('results').classList.add('stale');
    at('status').textContent = 'Something is wrong with the case; the numbers are those of the case before.';
    return;
  }
  at('results').classList.remove('stale');
  const { outcome, picture, index } = answer;
  const { summary } = outcome;
  shown = { outcome, index, text };
  showNumbers(summary);
  showCharts(outcome.charts, summary);
  showEnergy(summary);
  showEffects(summary);
  showPicture(picture, outcome.frames[index], summary);
  at('version').textContent = `Version ${summary.version}.`;
  const headline = `Restitution ${show(summary.restitution, '')}, contact time ${show(summary.contact_time_s, 's')}, peak force ${show(summary.peak_force_n, 'N')}.`;
  at('status').textContent = `${headline} Computed in ${Math.round(milliseconds)} ms.`;
  // Read out where a slider has come to rest, not on its way.
  if (!isMoving) at('announced').textContent = headline;
  // For whoever opens the console, and for tests.
  window.collision = { summary, text, frames: outcome.frames, milliseconds };
  document.documentElement.dataset.runs = Number(document.documentElement.dataset.runs ?? 0) + 1;
  storyText(text, summary);
}

function run(ask) {
  refreshTexts();
  runner.drop();
  compute(textNow(), ask);
}

// ---- the picture

const drawPicture = lastOnly(async () => {
  const { outcome } = shown;
  if (!outcome || outcome.frames.length === 0 || at('picture-controls').hidden) return;
  const index = Math.round(share() * (outcome.frames.length - 1));
  const answer = await runner.ask('picture', { index, halfWidth: halfWidth() });
  // None: another run has begun since, and will draw its own.
  if (answer.picture && outcome === shown.outcome) showPicture(answer.picture, outcome.frames[index], outcome.summary);
});

function stopPlaying() {
  clearInterval(playing);
  playing = null;
  at('play').textContent = 'Play';
}

function play() {
  if (playing) return stopPlaying();
  const step = 1000 / Math.max(1, shown.outcome.frames.length - 1);
  if (Number(at('instant').value) >= 1000) at('instant').value = 0;
  at('play').textContent = 'Stop';
  playing = setInterval(() => {
    const next = Number(at('instant').value) + step;
    at('instant').value = next;
    drawPicture();
    if (next >= 1000) stopPlaying();
  }, PLAY_MS);
}

// ---- controls

function change(changes, ask) {
  state = sound({ ...state, ...changes });
  ownText = null;
  refreshControls(state);
  if (isSlow() && ask === MOVING) {
    refreshTexts();
    at('status').textContent = 'Let go to compute: this model takes its time.';
    return;
  }
  run(ask);
}

function buildControls() {
  for (const select of document.querySelectorAll('select[data-key$="material"]')) {
    select.append(...allMaterials().map(({ name, title }) => element('option', title, { value: name })));
  }
  const hear = {
    moved: (changes) => change(changes, MOVING),
    set: (changes) => change(changes, AT_REST),
    refuse: (fault) => showFault(at('fault'), fault),
  };
  document.querySelectorAll('.slider').forEach((box) => buildSlider(box, hear));
  for (const select of document.querySelectorAll('select[data-key]')) {
    select.addEventListener('change', () => change({ [select.dataset.key]: select.value }, AT_REST));
  }
  at('controls').addEventListener('submit', (event) => event.preventDefault());
  at('reset').addEventListener('click', () => change({ ...FIRST }, AT_REST));
  at('sliders-back').addEventListener('click', () => change({}, AT_REST));
  at('cancel').addEventListener('click', () => runner.cancel());
  at('instant').addEventListener('input', drawPicture);
  at('zoom').addEventListener('input', drawPicture);
  at('play').addEventListener('click', play);
  const sources = allMaterials().flatMap(({ title, source, range }) => [element('dt', title), element('dd', `${source}. ${range}.`)]);
  at('materials').replaceChildren(...sources);
}

// ---- to take along

async function copy(text, what) {
  try {
    await navigator.clipboard.writeText(text);
    at('copied').textContent = `${what} copied.`;
  } catch {
    at('copied').textContent = `The browser does not let this page copy; the ${what.toLowerCase()} stands below or in the address.`;
  }
}

function buildSharing() {
  at('copy-link').addEventListener('click', () => copy(location.href, 'Link'));
  at('copy-case').addEventListener('click', () => copy(textNow(), 'Case'));
  at('copy-command').addEventListener('click', () => copy(commandOf(textNow()), 'Command'));
  at('save-summary').addEventListener('click', () => {
    const text = JSON.stringify(shown.outcome?.summary ?? null, null, 2);
    const address = URL.createObjectURL(new Blob([text], { type: 'application/json' }));
    element('a', '', { href: address, download: 'summary.json' }).click();
  });
  at('paste-fill').addEventListener('click', () => {
    at('paste').value = textNow();
  });
  at('paste-run').addEventListener('click', () => {
    ownText = at('paste').value;
    run(AT_REST);
  });
}

// ---- light and dark

function buildTheme() {
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const set = (isDark) => {
    document.documentElement.dataset.theme = isDark ? 'dark' : 'light';
    at('theme').textContent = isDark ? 'Light' : 'Dark';
  };
  set(dark.matches);
  dark.addEventListener('change', () => set(dark.matches));
  at('theme').addEventListener('click', () => set(document.documentElement.dataset.theme !== 'dark'));
  document.head.append(element('style', '', { id: 'bands' }));
}

// ---- begin

function takeAddress() {
  const given = read(location.hash);
  state = sound(given?.state ?? FIRST);
  ownText = given?.text ?? null;
  if (ownText !== null) {
    at('paste').value = ownText;
    at('paste-details').open = true;
  }
  refreshControls(state);
  run(AT_REST);
}

async function begin() {
  buildTheme();
  at('status').textContent = 'Unpacking the solver…';
  const answer = await runner.ready;
  if (answer.kind !== 'done') {
    showFault(at('fault'), { message: 'The solver does not start in this browser.', help: `It needs WebAssembly, module workers and DecompressionStream, which browsers have since 2023. ${answer.message}` });
    at('status').textContent = '';
    return;
  }
  setMaterials(answer.materials);
  buildControls();
  buildSharing();
  buildStories((told) => change(told, AT_REST));
  addEventListener('hashchange', takeAddress);
  takeAddress();
}

begin();
