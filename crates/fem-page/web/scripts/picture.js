// The picture of the bodies: instant, zoom and playback.
import { percent, show } from './units.js';
import { lastOnly } from './runner.js';
import { at, draw } from './results.js';

const LEAST_VIEW = 1.5;
const PLAY_MS = 120;

// Until the reader chooses an instant, that of the largest force is shown.
let isChosen = false;
let playing = null;
let drawnOutcome = null;
let askPicture = null;

// `request` requests a picture from the module.
export function buildPicture(request) {
  askPicture = request;
  at('instant').addEventListener('input', () => {
    isChosen = true;
    redraw();
  });
  at('zoom').addEventListener('input', () => redraw());
  at('play').addEventListener('click', play);
}

// The position in the contact, 0 to 1; null for the largest force.
export const share = () => (isChosen ? at('instant').value / 1000 : null);

// The half width of the window over the contact radius, from a close view to the whole of a small body.
export const halfWidth = () => LEAST_VIEW * 200 ** (at('zoom').value / 1000);

export function followForce() {
  isChosen = false;
}

// Shows the picture that came with a result.
export function showPicture(outcome, picture, index) {
  drawnOutcome = outcome;
  const has = Boolean(picture);
  document.querySelector('main').classList.toggle('no-picture', !has);
  at('picture').hidden = !has;
  at('no-picture').hidden = has;
  // Without a picture, the chart of the force takes its place.
  if (has) at('curves').prepend(at('figure-force'));
  else at('view').append(at('figure-force'));
  if (!has) {
    stopPlaying();
    at('no-picture').firstElementChild.textContent = 'This model has no elements, so there is no stress to draw.';
    return;
  }
  if (!isChosen && outcome.frames.length > 1) at('instant').value = (1000 * index) / (outcome.frames.length - 1);
  showInstant(picture, outcome.frames[index]);
}

function showInstant(picture, frame) {
  at('bands').textContent = `[data-theme="dark"] { ${picture.dark_rules} }`;
  const [low, high] = picture.range_pa;
  const isPart = drawnOutcome.summary.bodies.some((body) => !body.elements);
  const error = drawnOutcome.summary.stress_error;
  const known = error ? ` (± ${percent(error.l2)} rms, at most ± ${percent(error.max)} of the largest)` : '';
  const words = `${show(frame.time_s, 's', 3)} after first touch: force ${show(frame.contact_force_n, 'N', 3)}, approach ${show(frame.approach_m, 'm', 3)}; stress from ${show(low, 'Pa', 3)} to ${show(high, 'Pa', 3)}${known}, compression negative.${isPart ? ' The rigid partner is not drawn.' : ''}`;
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
  // There is no picture if another run has begun, which will draw its own.
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
