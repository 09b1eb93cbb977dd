// The stories on the page: which one is open, and at which step.
import { show } from './units.js';
import { caseOf } from './scene.js';
import { Runner } from './runner.js';
import { at, draw, element } from './results.js';
import { STORIES, chartOf, stateOf } from './stories.js';

let sweeps = null;
let told = null;
let take = null;

// `setState` receives the state of a step.
export function buildStories(setState) {
  take = setState;
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
  take(stateOf(steps[step]));
  if (steps[step].chart) tellChart(told, steps[step]);
}

// Shows the text of a step once its case has been computed; it stays while the reader moves sliders.
export function storyText(text, summary, sharing) {
  if (!told || text !== told.text) return;
  const heat = sharing?.parts.find(([name]) => name === 'viscous_dissipation')?.[1] ?? 0;
  const numbers = {
    restitution: summary.restitution,
    time: summary.contact_time_s,
    heat: sharing ? heat / sharing.relative_j : 0,
    relaxationTime: relaxationTime(summary),
    crossings: crossings(summary),
    hertz: summary.hertz,
  };
  at('story-text').textContent = STORIES[told.story].steps[told.step].text(numbers);
}

// Returns the relaxation time of the striker's material, s; null without relaxation.
function relaxationTime(summary) {
  const [term] = materialOf(summary).relaxation?.terms ?? [];
  return term?.relaxation_time ?? (term?.decay_rate ? 1 / term.decay_rate : null);
}

// Returns how often a sound wave crosses the striker during the contact.
function crossings(summary) {
  const { youngs_modulus, density } = materialOf(summary);
  return (summary.contact_time_s * Math.sqrt(youngs_modulus / density)) / striker(summary).sphere.diameter;
}

const striker = (summary) => summary.case.body.find((body) => body.approach_speed > 0);
const materialOf = (summary) => summary.case.material[striker(summary).material];

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
