// The bodies at an instant: which, how near, and that it plays.
import { show } from './units.js';
import { lastOnly } from './runner.js';
import { at, draw } from './results.js';

const LEAST_VIEW = 1.5;
const PLAY_MS = 120;

// That of the largest force, until the reader has chosen one.
let isChosen = false;
let playing = null;
let drawnOutcome = null;
let askPicture = null;

// `request` asks the module for a picture.
export function buildPicture(request) {
  askPicture = request;
  at('instant').addEventListener('input', () => {
    isChosen = true;
    redraw();
  });
  at('zoom').addEventListener('input', () => redraw());
  at('play').addEventListener('click', play);
}

// Where in the contact, 0 to 1; null: where the force is largest.
export const share = () => (isChosen ? at('instant').value / 1000 : null);

// Half of the window over the contact radius, from the contact to the whole of a small body.
export const halfWidth = () => LEAST_VIEW * 200 ** (at('zoom').value / 1000);

export function followForce() {
  isChosen = false;
}

// The picture of an outcome that came with it.
export function showPicture(outcome, picture, index) {
  drawnOutcome = outcome;
  const has = Boolean(picture);
  document.querySelector('main').classList.toggle('no-picture', !has);
  at('picture').hidden = !has;
  at('no-picture').hidden = has;
  // Without it the force stands where the picture would.
  if (has) at('curves').prepend(at('figure-force'));
  else at('view').append(at('figure-force'));
  if (!has) {
    stopPlaying();
    at('no-picture').firstElementChild.textContent = 'This model knows the bodies as a whole: it has no elements, and so no stress to draw.';
    return;
  }
  if (!isChosen && outcome.frames.length > 1) at('instant').value = (1000 * index) / (outcome.frames.length - 1);
  showInstant(picture, outcome.frames[index]);
}

function showInstant(picture, frame) {
  at('bands').textContent = `[data-theme="dark"] { ${picture.dark_rules} }`;
  const [low, high] = picture.range_pa;
  const isPart = drawnOutcome.summary.bodies.some((body) => !body.elements);
  const words = `${show(frame.time_s, 's', 3)} after first touch: force ${show(frame.contact_force_n, 'N', 3)}, approach ${show(frame.approach_m, 'm', 3)}; stress from ${show(low, 'Pa', 3)} to ${show(high, 'Pa', 3)}, compression negative.${isPart ? ' The rigid partner is not drawn.' : ''}`;
  draw(at('picture-svg'), picture.svg, `Section through both bodies at the contact, ${words}`);
  draw(at('picture-bar'), picture.bar, 'Colours of the stress, from compression to tension.');
  at('picture-caption').textContent = words;
  at('instant').setAttribute('aria-valuetext', `${show(frame.time_s, 's', 3)} after first touch`);
  at('zoom').setAttribute('aria-valuetext', `${show(halfWidth(), '', 2)} contact radii to each side`);
}

export const redraw = lastOnly(async () => {
  const outcome = drawnOutcome;
  if (!outcome || outcome.frames.length === 0 || at('picture').hidden) return;
  const index = Math.round((at('instant').value / 1000) * (outcome.frames.length - 1));
  const answer = await askPicture({ index, halfWidth: halfWidth() });
  // None: another run has begun since, and will draw its own.
  if (answer.picture && outcome === drawnOutcome) showInstant(answer.picture, outcome.frames[index]);
});

function stopPlaying() {
  clearInterval(playing);
  playing = null;
  at('play').textContent = 'Play';
}

function play() {
  if (playing) return stopPlaying();
  isChosen = true;
  const step = 1000 / Math.max(1, drawnOutcome.frames.length - 1);
  if (Number(at('instant').value) >= 1000) at('instant').value = 0;
  at('play').textContent = 'Stop';
  playing = setInterval(() => {
    const next = Number(at('instant').value) + step;
    at('instant').value = next;
    redraw();
    if (next >= 1000) stopPlaying();
  }, PLAY_MS);
}
