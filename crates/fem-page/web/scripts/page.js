// Sliders, runs, pictures.
import { allMaterials, setMaterials } from './materials.js';
import { FIRST, caseOf, commandOf, sound } from './scene.js';
import { fragmentOf, read } from './links.js';
import { Runner, lastOnly } from './runner.js';
import { at, element, headline, showCharts, showEffects, showEnergy, showFault, showMade, showNumbers } from './results.js';
import { buildPicture, followForce, halfWidth, redraw, share, showPicture } from './picture.js';
import { buildSlider, refreshControls } from './controls.js';
import { buildStories, storyText } from './telling.js';
import { buildTaking } from './taking.js';

// Fewer instants while a slider moves; at rest as many as the command writes.
const MOVING = { rows: 250, frames: 9 };
const AT_REST = { rows: 1000, frames: 25 };
// Delay after which progress is shown.
const LATE_MS = 700;
// The limit of a 32-bit module, independent of limits.memory.
const MEMORY_HELP = 'A browser gives a page 4 GB at most: choose a larger mesh.contact_element_size, or run the case with the command.';

const runner = new Runner();
const main = document.querySelector('main');
let state = { ...FIRST };
let ownText = null;
let shownSummary = null;

// ---- what the page asks for

const textNow = () => ownText ?? caseOf(state);
const isSlow = () => ownText === null && state.model === 'fem';

function refreshTexts() {
  const text = textNow();
  at('case').textContent = text;
  at('command').textContent = commandOf(text);
  at('pasted').hidden = ownText === null;
}

// Only when a slider has come to rest: browsers limit the number of changes of the address, and its length.
function refreshAddress() {
  try {
    history.replaceState(null, '', fragmentOf({ state, text: ownText }) || '#');
  } catch {
    // The case is shown below in any case.
  }
}

function sayOfOwn(words) {
  at('pasted-text').textContent = words;
}

const compute = lastOnly(async (text, ask) => {
  const began = performance.now();
  const request = { text, ...ask, share: share(), halfWidth: halfWidth() };
  let begun = null;
  const onway = (heard) => {
    if (heard.kind === 'begun') {
      begun = heard.begun;
      at('progress-text').textContent = progressText(begun);
    } else {
      at('status').textContent = '';
      at('progress').hidden = false;
      at('progress-bar').value = heard.done;
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
    standBack('Ended before there was a result');
    return;
  }
  tell(text, answer, { begun, milliseconds: performance.now() - began, isMoving: ask === MOVING });
  // The reader may have moved on while it was computed.
  if (request.share !== share() || request.halfWidth !== halfWidth()) redraw();
}, (isBusy) => at('results').setAttribute('aria-busy', String(isBusy)));

function progressText({ model, price }) {
  const steps = price.steps ? `, ${price.steps.toLocaleString('en')} steps of ${price.elements.toLocaleString('en')} elements` : '';
  return `Computing: ${model}${steps}`;
}

// Marks the displayed numbers, if any, as those of another case.
function standBack(words) {
  const of = shownSummary ? '; the numbers are those of the previous case.' : '; there are no numbers yet.';
  main.classList.add('stale');
  at('status').textContent = words + of;
  sayOfOwn(`Your own case could not be computed${of}`);
}

function clearFaults() {
  showFault(at('fault'), null);
  showFault(at('paste-fault'), null);
}

function tell(text, answer, { begun, milliseconds, isMoving }) {
  clearFaults();
  if (answer.kind !== 'done') {
    tellFault(text, withMemory(answer.fault ?? { message: 'The module failed and was restarted.', help: answer.message }));
    return;
  }
  main.classList.remove('stale', 'empty');
  const { outcome, picture, index } = answer;
  const { summary, sharing } = outcome;
  shownSummary = summary;
  showNumbers(summary);
  showMade(summary, begun, milliseconds);
  showCharts(outcome.charts, summary);
  showEnergy(summary, sharing);
  showEffects(summary, outcome.effects);
  showPicture(outcome, picture, index);
  at('version').textContent = `Version ${summary.version}.`;
  const words = headline(summary);
  at('status').textContent = words;
  sayOfOwn('Your own case is shown; the sliders are off.');
  // Announced by screen readers when a slider has come to rest.
  if (!isMoving) at('announced').textContent = words;
  // For the console and for tests.
  window.collision = { summary, sharing, text, frames: outcome.frames, milliseconds };
  document.documentElement.dataset.runs = Number(document.documentElement.dataset.runs ?? 0) + 1;
  storyText(text, summary, sharing);
}

// Replaces the message of a run or module that ran out of memory by one that says what to do.
function withMemory(fault) {
  if (!/not enough memory/.test(fault.message) && !/AllocError|no memory left/.test(fault.help ?? '')) return fault;
  const message = /not enough memory/.test(fault.message) ? fault.message : 'there is not enough memory for this case';
  return { ...fault, message, help: MEMORY_HELP };
}

// Shows the fault of the reader's own case beside it, and in a line above.
function tellFault(text, fault) {
  standBack('The case has an error');
  if (ownText === null) {
    showFault(at('fault'), fault);
    return;
  }
  showFault(at('paste-fault'), fault, text);
  const { line, column, message } = fault;
  showFault(at('fault'), { line, column, message, help: 'The case is below, under “Run a case of your own”.' });
}

function run(ask) {
  refreshTexts();
  if (ask === AT_REST) refreshAddress();
  runner.drop();
  compute(textNow(), ask);
}

// ---- controls

function change(changes, ask) {
  state = sound({ ...state, ...changes });
  ownText = null;
  showFault(at('link-fault'), null);
  refreshControls(state, false);
  if (isSlow() && ask === MOVING) {
    refreshTexts();
    main.classList.add('stale');
    at('status').textContent = 'Release the slider to compute: this model takes a while.';
    return;
  }
  run(ask);
}

function runOwn(text) {
  ownText = text;
  showFault(at('link-fault'), null);
  sayOfOwn('Your own case is being computed.');
  refreshControls(state, true);
  run(AT_REST);
}

function buildControls() {
  for (const select of document.querySelectorAll('select[data-key$="material"]')) {
    select.append(...allMaterials().map(({ name, title }) => element('option', title, { value: name })));
  }
  const hear = {
    moved: (changes) => change(changes, MOVING),
    set: (changes) => change(changes, AT_REST),
    refuse: (fault) => {
      showFault(at('fault'), fault);
      standBack('Not computed');
    },
  };
  document.querySelectorAll('.slider').forEach((box) => buildSlider(box, hear));
  for (const select of document.querySelectorAll('select[data-key]')) {
    select.addEventListener('change', () => change({ [select.dataset.key]: select.value }, AT_REST));
  }
  at('controls').addEventListener('submit', (event) => event.preventDefault());
  at('reset').addEventListener('click', () => {
    followForce();
    change({ ...FIRST }, AT_REST);
  });
  at('sliders-back').addEventListener('click', () => change({}, AT_REST));
  at('take-elements').addEventListener('click', () => change({ model: 'condensed' }, AT_REST));
  at('cancel').addEventListener('click', () => runner.cancel());
  const sources = allMaterials().flatMap(({ title, source, range }) => [element('dt', title), element('dd', `${source}. ${range}.`)]);
  at('materials').replaceChildren(...sources);
}

// ---- light and dark

function buildTheme() {
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const set = (isDark) => {
    document.documentElement.dataset.theme = isDark ? 'dark' : 'light';
    at('theme').textContent = isDark ? 'Light' : 'Dark';
    at('theme').setAttribute('aria-label', `Colours: change to ${isDark ? 'light' : 'dark'}`);
  };
  set(dark.matches);
  dark.addEventListener('change', () => set(dark.matches));
  at('theme').addEventListener('click', () => set(document.documentElement.dataset.theme !== 'dark'));
  document.head.append(element('style', '', { id: 'bands' }));
}

// ---- begin

function takeAddress() {
  const { state: given, text, faults } = read(location.hash);
  state = sound(given);
  ownText = text;
  const [first, ...others] = faults.map((message) => ({ message }));
  showFault(at('link-fault'), first ? { message: 'This link can only be used in part.', others: [first, ...others].map(({ message }) => ({ message: '', help: message })) } : null);
  if (ownText !== null) {
    at('paste').value = ownText;
    at('paste-details').open = true;
    sayOfOwn('The case of this link is being computed.');
  }
  refreshControls(state, ownText !== null);
  run(AT_REST);
}

async function begin() {
  buildTheme();
  if (document.documentElement.dataset.missing) return;
  at('status').textContent = 'Unpacking the solver…';
  const answer = await runner.ready;
  if (answer.kind !== 'done') {
    showFault(at('fault'), { message: 'The solver does not start in this browser.', help: `It needs WebAssembly, workers and DecompressionStream, which browsers support since 2023. ${answer.message}` });
    at('status').textContent = '';
    document.documentElement.dataset.missing = 'solver';
    return;
  }
  setMaterials(answer.materials);
  buildControls();
  buildPicture((request) => runner.ask('picture', request));
  buildTaking({ textNow, summaryNow: () => shownSummary, runOwn });
  buildStories((told) => change(told, AT_REST));
  addEventListener('hashchange', takeAddress);
  takeAddress();
}

begin();
