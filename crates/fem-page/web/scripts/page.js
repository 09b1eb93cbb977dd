// Sliders, runs, stories.
import { rounded, show } from './units.js';
import { allMaterials, setMaterials } from './materials.js';
import { FIRST, SLIDERS, caseOf, commandOf, fragmentOf, isMeant, read, sound } from './scene.js';
import { Runner, lastOnly } from './runner.js';
import { at, draw, element, showCharts, showEffects, showEnergy, showFault, showNumbers, showPicture } from './results.js';
import { STORIES, chartOf, stateOf } from './stories.js';

// While a slider moves: fewer instants. At rest: as the command has it.
const MOVING = { rows: 250, frames: 9 };
const AT_REST = { rows: 1000, frames: 25 };
const LEAST_VIEW = 1.5;
const PLAY_MS = 120;

const runner = new Runner();
let sweeps = null;
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
  const answer = await runner.ask('begin', request, onway);
  at('progress').hidden = true;
  at('progress-bar').value = 0;
  if (answer.kind === 'dropped') return;
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
    const fault = answer.fault ?? { message: 'The module failed; it has been started anew.', help: answer.message };
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
  showEffects(summary.effects);
  showPicture(picture, outcome.frames[index]);
  at('version').textContent = `Version ${summary.version}.`;
  const headline = `Restitution ${show(summary.restitution, '')}, contact time ${show(summary.contact_time_s, 's')}, peak force ${show(summary.peak_force_n, 'N')}.`;
  at('status').textContent = `${headline} Computed in ${Math.round(milliseconds)} ms.`;
  // Read out where a slider has come to rest, not on its way.
  if (!isMoving) at('announced').textContent = headline;
  // For whoever opens the console, and for tests.
  window.collision = { summary, text, frames: outcome.frames, milliseconds };
  document.documentElement.dataset.runs = Number(document.documentElement.dataset.runs ?? 0) + 1;
  storyText();
}

function run(ask) {
  refreshTexts();
  runner.tell('drop');
  compute(textNow(), ask);
}

// ---- the picture

const drawPicture = lastOnly(async () => {
  const { outcome } = shown;
  if (!outcome || outcome.frames.length === 0 || at('picture-controls').hidden) return;
  const index = Math.round(share() * (outcome.frames.length - 1));
  const answer = await runner.ask('picture', { index, halfWidth: halfWidth() });
  // None: another run has begun since, and will draw its own.
  if (answer.picture && outcome === shown.outcome) showPicture(answer.picture, outcome.frames[index]);
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

function placeOf(key) {
  const { from, to, isLogarithmic } = SLIDERS[key];
  const value = state[key];
  return Math.round(1000 * (isLogarithmic ? Math.log(value / from) / Math.log(to / from) : (value - from) / (to - from)));
}

function valueAt(key, place) {
  const { from, to, isLogarithmic } = SLIDERS[key];
  const part = place / 1000;
  return rounded(isLogarithmic ? from * (to / from) ** part : from + (to - from) * part);
}

function buildSlider(box) {
  const { key, label } = box.dataset;
  const { from, to, unit } = SLIDERS[key];
  const id = `slider-${key.replace('.', '-')}`;
  const slider = element('input', '', { type: 'range', id, min: 0, max: 1000, step: 1 });
  const number = element('input', '', { type: 'number', min: from, max: to, step: 'any', 'aria-label': unit ? `${label} in ${unit}` : label });
  box.append(element('label', label, { for: id }), slider, number, element('span', unit, { class: 'unit' }));
  slider.addEventListener('input', () => change({ [key]: valueAt(key, slider.value) }, MOVING));
  slider.addEventListener('change', () => change({ [key]: valueAt(key, slider.value) }, AT_REST));
  number.addEventListener('change', () => {
    const value = Number(number.value);
    const isWithin = number.value !== '' && value >= from && value <= to;
    number.setAttribute('aria-invalid', String(!isWithin));
    if (isWithin) change({ [key]: value }, AT_REST);
    else showFault(at('fault'), { message: `${label}: ${number.value || 'nothing'} is given`, help: `Between ${from} and ${to} ${unit}. A case of your own may go further: see below.` });
  });
}

// Puts the state into the controls.
function refreshControls() {
  for (const box of document.querySelectorAll('.slider')) {
    const { key } = box.dataset;
    const [slider, number] = box.querySelectorAll('input');
    slider.value = placeOf(key);
    slider.setAttribute('aria-valuetext', `${state[key]} ${SLIDERS[key].unit}`.trim());
    if (document.activeElement !== number || number.getAttribute('aria-invalid') !== 'true') number.value = state[key];
    number.setAttribute('aria-invalid', 'false');
    box.hidden = !isMeant(key, state);
  }
  for (const select of document.querySelectorAll('select[data-key]')) {
    select.value = state[select.dataset.key];
    select.parentElement.hidden = !isMeant(select.dataset.key, state);
  }
}

function change(changes, ask) {
  state = sound({ ...state, ...changes });
  ownText = null;
  refreshControls();
  if (isSlow() && ask === MOVING) {
    refreshTexts();
    at('status').textContent = 'Let go to compute: this model takes seconds.';
    return;
  }
  run(ask);
}

function buildControls() {
  for (const select of document.querySelectorAll('select[data-key$="material"]')) {
    select.append(...allMaterials().map(({ name, title }) => element('option', title, { value: name })));
  }
  document.querySelectorAll('.slider').forEach(buildSlider);
  for (const select of document.querySelectorAll('select[data-key]')) {
    select.addEventListener('change', () => change({ [select.dataset.key]: select.value }, AT_REST));
  }
  at('controls').addEventListener('submit', (event) => event.preventDefault());
  at('reset').addEventListener('click', () => change({ ...FIRST }, AT_REST));
  at('sliders-back').addEventListener('click', () => change({}, AT_REST));
  at('cancel').addEventListener('click', () => runner.tell('cancel'));
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

// ---- stories

let told = null;

function buildStories() {
  STORIES.forEach((story, k) => {
    const button = element('button', story.title, { type: 'button', 'aria-expanded': 'false', 'aria-controls': 'story' });
    button.addEventListener('click', () => goTo(k, 0));
    at('stories').append(button);
  });
  at('story-next').addEventListener('click', () => goTo(told.story, told.step + 1));
  at('story-back').addEventListener('click', () => goTo(told.story, told.step - 1));
  at('story-close').addEventListener('click', closeStory);
}

function closeStory() {
  const button = at('stories').children[told.story];
  told = null;
  at('story').hidden = true;
  markStory();
  button.focus();
}

function markStory() {
  [...at('stories').children].forEach((button, k) => button.setAttribute('aria-expanded', String(told?.story === k)));
}

function goTo(story, step) {
  const { title, steps } = STORIES[story];
  const isNew = told?.story !== story;
  told = { story, step, text: caseOf(stateOf(steps[step])) };
  markStory();
  at('story').hidden = false;
  at('story-title').textContent = title;
  at('story-text').textContent = '';
  at('story-place').textContent = `${step + 1} of ${steps.length}`;
  at('story-back').disabled = step === 0;
  at('story-next').disabled = step === steps.length - 1;
  draw(at('story-chart'), null, '');
  if (isNew) at('story-title').focus();
  change(stateOf(steps[step]), AT_REST);
  if (steps[step].chart) tellChart(told, steps[step]);
}

// A step's text, once its own case has been computed; it stays while the reader plays on.
function storyText() {
  if (!told || shown.text !== told.text) return;
  const { summary } = shown.outcome;
  const heat = (summary.energy.viscous_dissipation_j ?? 0) / summary.energy.initial_j;
  const numbers = { restitution: summary.restitution, time: summary.contact_time_s, heat };
  at('story-text').textContent = STORIES[told.story].steps[told.step].text(numbers);
}

async function tellChart(own, step) {
  sweeps ??= new Runner();
  await sweeps.ready;
  const summaryOf = async (text) => {
    if (own !== told) return null;
    const answer = await sweeps.ask('begin', { text, rows: 0, frames: 0, share: 0, halfWidth: 1 });
    return answer.outcome?.summary ?? null;
  };
  const spec = await chartOf(step, summaryOf);
  if (!spec || own !== told) return;
  const { svg } = await sweeps.ask('chart', { spec });
  if (own === told) draw(at('story-chart'), svg, `${spec.y} over ${spec.x}: from ${spec.curves[0].points.map(([x, y]) => `${show(y, '', 3)} at ${show(x, '', 2)}`).join(', ')}.`);
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
  refreshControls();
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
  buildStories();
  addEventListener('hashchange', takeAddress);
  takeAddress();
}

begin();
