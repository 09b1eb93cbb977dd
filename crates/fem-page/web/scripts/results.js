// The results of a collision on the page.
import { NOTHING, percent, plain, show, showBeside } from './units.js';
import { ACCOUNT_WORDS } from './accounts.js';

const QUANTITIES = [
  ['restitution', 'Restitution', ''],
  ['contact_time_s', 'Contact time', 's'],
  ['peak_force_n', 'Peak force', 'N'],
  ['max_approach_m', 'Largest approach', 'm'],
  ['max_contact_radius_m', 'Largest contact radius', 'm'],
  ['peak_pressure_pa', 'Peak pressure', 'Pa'],
];

export const at = (id) => document.getElementById(id);

// Creates an element with text and attributes.
export function element(name, text = '', attributes = {}) {
  const made = document.createElement(name);
  made.textContent = text;
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

// Shows a picture of the module, in which text of the case is escaped. The label is for screen readers.
export function draw(place, svg, label) {
  place.innerHTML = svg ?? '';
  place.hidden = !svg;
  const picture = place.querySelector('svg');
  if (!picture) return;
  picture.setAttribute('role', 'img');
  picture.setAttribute('aria-label', label);
}

const sentence = (text) => text.charAt(0).toUpperCase() + text.slice(1);

// Shows a number; a bound with its sign, or with ± ? if its side is not known, behind the measured restitution.
function showOwn(summary, key, unit) {
  const { bound, model } = summary.uncertainty[key];
  const own = show(summary[key], unit);
  if (model !== null || summary[key] === null) return own;
  const sign = { 'at most': '≤ ', 'at least': '≥ ' }[bound];
  const marked = sign ? sign + own : own.replace(unit ? / (?=\S+$)/ : /$/, unit ? ' ± ? ' : ' ± ?');
  const measured = key === 'restitution' && (summary.measured_restitution ?? []).find((it) => it.restitution !== null);
  return measured ? `${show(measured.restitution, '', 2)} (${marked})` : marked;
}

export function headline(summary) {
  const force = `peak force ${showOwn(summary, 'peak_force_n', 'N')}`;
  if (!summary.complete) return `Not complete: ${force} so far.`;
  if (summary.contact_time_s === null && summary.restitution === 0) return `The bodies stay together: restitution 0, ${force}.`;
  return `Restitution ${showOwn(summary, 'restitution', '')}, contact time ${showOwn(summary, 'contact_time_s', 's')}, ${force}.`;
}

export function showNumbers(summary) {
  const rows = QUANTITIES.map(([key, name, unit]) => {
    const [own, hertz] = [summary[key], summary.hertz[key]];
    const { discretisation, model, input } = summary.uncertainty[key];
    const part = (size, none = '–') => element('td', size === null ? none : showBeside(size, own, unit));
    const row = element('tr');
    const ratio = own === null || hertz === null ? '–' : (own / hertz).toFixed(4);
    const number = element('td', showOwn(summary, key, unit), { 'data-key': key });
    if (own !== null) number.dataset.value = own;
    row.append(element('th', name, { scope: 'row' }), number, element('td', show(hertz, unit, 4, own ?? hertz)), element('td', ratio), part(discretisation), part(model, own === null ? '–' : '?'), part(input));
    return row;
  });
  at('numbers').tBodies[0].replaceChildren(...rows);
  const hasElements = summary.bodies.some((body) => body.elements > 0);
  const ownError = hasElements ? '± mesh' : '± numerics';
  const heads = ['this run', 'Hertz', 'ratio', ownError, '± neglected', '± inputs'];
  at('numbers').tHead.rows[0].replaceChildren(...['Quantity', ...heads].map((head) => element('th', head, { scope: 'col' })));
  const hasInputs = QUANTITIES.some(([key]) => summary.uncertainty[key].input);
  at('numbers').classList.toggle('without-inputs', !hasInputs);
  showAdhesion(summary.adhesion);
  const warnings = summary.stopped_because === null ? summary.warnings : [`Not complete: ${summary.stopped_because}`, ...summary.warnings];
  at('warnings').replaceChildren(...warnings.map((text) => element('li', sentence(plain(text)))));
}

// Shows below which speed the bodies stick, if the case gives their adhesion.
function showAdhesion(adhesion) {
  at('adhesion').hidden = !adhesion;
  if (!adhesion) return;
  const { sticking_speed_m_s: speed, work_of_adhesion_j_m2: work, sticks } = adhesion;
  const end = sticks ? 'These are slower: they stay together.' : 'These are faster.';
  at('adhesion').textContent = `Adhesion: with a work of adhesion of ${show(work, 'J/m²', 3)} bodies below ${show(speed, 'm/s', 2)} stick. ${end}`;
}

// Shows the model, and why it was chosen if the program chose it.
export function showMade(summary, begun, milliseconds) {
  const chosen = (summary.models_considered ?? []).find((model) => model.chosen);
  const choice = chosen ? ` Auto has chosen ${chosen.model.replace(' = {}', '')}: ${plain(chosen.reason)}.` : '';
  const elements = begun.price.elements ? `, ${begun.price.elements.toLocaleString('en')} elements` : '';
  at('made').textContent = `Computed with ${begun.model}${elements}, in ${Math.round(milliseconds)} ms.${choice}`;
}

export function showCharts(charts, summary) {
  const { hertz } = summary;
  draw(at('chart-force'), charts.force, `Contact force over time beside Hertz: at most ${show(summary.peak_force_n, 'N')}; Hertz ${show(hertz.peak_force_n, 'N')}.`);
  draw(at('chart-approach'), charts.approach, `Approach over time beside Hertz: at most ${show(summary.max_approach_m, 'm')}; Hertz ${show(hertz.max_approach_m, 'm')}.`);
  draw(at('chart-energy'), charts.energy, 'Energies over time.');
}

// Returns the shares of the energy at the end if the common motion is not known; external work counts with the
// initial energy.
function wholeSharing(energy) {
  const entries = Object.entries(energy)
    .filter(([key, value]) => key.endsWith('_j') && value !== null)
    .map(([key, value]) => [key.slice(0, -2), value]);
  const book = Object.fromEntries(entries);
  const whole = (book.initial ?? 0) + (book.wall_work ?? 0);
  return { common_j: 0, relative_j: whole, parts: entries.filter(([name]) => !['initial', 'residual', 'wall_work'].includes(name)) };
}

function energyText({ common_j, relative_j }, summary) {
  const whole = common_j + relative_j;
  if (!summary.complete) return `The run was ended early. So far, the ${show(relative_j, 'J', 3)} of the approach have become:`;
  if (common_j / whole < 1e-3) return `The bodies met with ${show(whole, 'J', 3)}, which became:`;
  return `The bodies met with ${show(whole, 'J', 3)}. ${percent(common_j / whole)} of it is their common motion, which no collision changes. The other ${show(relative_j, 'J', 3)}, the energy of the approach, became:`;
}

// Returns the description of a part of the energy; for the rebound, its relation to the restitution.
function partWords(name, { restitution, complete, case: { model } }) {
  if (name === 'viscous_dissipation' && model?.law) return 'heat in the dashpot of the law';
  const words = ACCOUNT_WORDS[name] ?? name.replaceAll('_', ' ');
  if (name !== 'rebound' || !complete || restitution === null) return words;
  return restitution > 0 ? `${words}, the square of the restitution, ${show(restitution, '')}²` : `${words}; the restitution is 0`;
}

export function showEnergy(summary, sharing) {
  const shared = sharing ?? wholeSharing(summary.energy);
  const whole = shared.relative_j;
  const shown = shared.parts.map(([name, energy]) => ({ name, share: energy / whole })).filter(({ name, share }) => name === 'rebound' || Math.abs(share) >= NOTHING);
  const known = whole > 0 && shown.length > 0;
  at('energy-text').textContent = known ? energyText(shared, summary) : 'This model does not compute energies here.';
  const bar = shown.map(({ name, share }) => element('span', '', { class: `energy-${name}`, style: `flex-grow:${Math.max(0, share)}` }));
  at('energy-bar').replaceChildren(...(known ? bar : []));
  const lines = shown.map(({ name, share }) => {
    const line = element('li');
    line.append(element('i', '', { class: `energy-${name}` }), ` ${percent(share)} ${partWords(name, summary)}`);
    return line;
  });
  at('energy-shares').replaceChildren(...(known ? lines : []));
}

// Relative changes below this are negligible.
const LEAST_CHANGE = 5e-4;

function worth(leftOut, summary) {
  if (!leftOut) return '';
  const known = [
    ['restitution', leftOut.restitution, '', 1],
    ['contact time', leftOut.contact_time_s, 's', summary.contact_time_s],
    ['peak force', leftOut.peak_force_n, 'N', summary.peak_force_n],
  ].filter(([, change]) => change !== null);
  const changes = known.filter(([, change, , whole]) => change > LEAST_CHANGE * (whole ?? 0));
  if (known.length === 0) return '';
  if (changes.length === 0) return ' Its influence is negligible.';
  return ` It changes ${changes.map(([name, change, unit]) => `${name} by about ${show(change, unit, 1)}`).join(', ')}.`;
}

// `explanations` has the words on each effect, and whether it is a part of the computation and not physics. Effects that matter
// and are not computed stand with those that are on.
export function showEffects(summary, explanations) {
  const known = (effect) => explanations.find(({ name }) => name === effect.name);
  const line = (effect) => {
    const made = element('li', '', { 'data-effect': effect.name });
    const lacking = effect.matters && !effect.active ? 'Not computed: ' : '';
    made.append(element('strong', effect.name), ` – ${lacking}${known(effect)?.words ?? ''}${worth(effect.error_if_left_out, summary)} `, element('span', plain(effect.reason), { class: 'reason' }));
    return made;
  };
  const isMeans = (effect) => known(effect)?.is_numerical ?? false;
  const physical = summary.effects.filter((effect) => !isMeans(effect));
  const isShown = (effect) => effect.active || effect.matters;
  const on = physical.filter(isShown);
  at('effects-on').replaceChildren(...on.map(line));
  at('effects-none').hidden = on.length > 0;
  at('effects-off').replaceChildren(...physical.filter((effect) => !isShown(effect)).map(line));
  const means = summary.effects.filter((effect) => isMeans(effect) && effect.active);
  at('effects-means').replaceChildren(...means.map(line));
  at('means-details').hidden = means.length === 0;
}

// Returns the lines of a text around a position, with a mark below the column.
function excerpt(text, line, column) {
  const lines = text.split('\n');
  const shown = lines.slice(Math.max(0, line - 2), line).map((words, k, all) => `${String(line - all.length + 1 + k).padStart(4)} | ${words}`);
  return [...shown, `     | ${' '.repeat(Math.max(0, column - 1))}^`].join('\n');
}

// `source` is the text that lines and columns refer to; if given, the lines are shown.
export function showFault(place, fault, source = null) {
  place.hidden = !fault;
  place.replaceChildren();
  if (!fault) return;
  for (const { line, column, message, help } of [fault, ...(fault.others ?? [])]) {
    const where = line ? `Line ${line}, column ${column}: ` : '';
    place.append(element('strong', `${where}${plain(message)}`));
    if (help) place.append(element('p', plain(help)));
    if (source !== null && line) place.append(element('pre', excerpt(source, line, column)));
  }
}
