// What a collision came to, on the page.
import { percent, show } from './units.js';
import { ACCOUNT_WORDS, EFFECT_WORDS } from './effects.js';

const QUANTITIES = [
  ['restitution', 'Restitution', ''],
  ['contact_time_s', 'Contact time', 's'],
  ['peak_force_n', 'Peak force', 'N'],
  ['max_approach_m', 'Largest approach', 'm'],
  ['max_contact_radius_m', 'Largest contact radius', 'm'],
  ['peak_pressure_pa', 'Peak pressure', 'Pa'],
];

export const at = (id) => document.getElementById(id);

// An element with text and children.
export function element(name, text = '', attributes = {}) {
  const made = document.createElement(name);
  made.textContent = text;
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

// Pictures are the module's own; what a case says is text in them. They are named for who cannot see them.
export function draw(place, svg, label) {
  place.innerHTML = svg ?? '';
  place.hidden = !svg;
  const picture = place.querySelector('svg');
  if (!picture) return;
  picture.setAttribute('role', 'img');
  picture.setAttribute('aria-label', label);
}

export function showNumbers(summary) {
  const rows = QUANTITIES.map(([key, name, unit]) => {
    const [own, hertz] = [summary[key], summary.hertz[key]];
    const { discretisation, model } = summary.uncertainty[key];
    const off = discretisation === null && model === null ? null : (discretisation ?? 0) + (model ?? 0);
    const row = element('tr');
    const ratio = own === null || hertz === null ? '–' : (own / hertz).toFixed(4);
    const number = element('td', show(own, unit, 4, hertz ?? own), { 'data-key': key });
    if (own !== null) number.dataset.value = own;
    row.append(element('th', name, { scope: 'row' }), number, element('td', show(hertz, unit)), element('td', ratio), element('td', off === null ? '–' : `± ${show(off, unit, 2)}`));
    return row;
  });
  at('numbers').tBodies[0].replaceChildren(...rows);
  const warnings = summary.stopped_because === null ? summary.warnings : [`Not complete: ${summary.stopped_because}`, ...summary.warnings];
  at('warnings').replaceChildren(...warnings.map((text) => element('li', text)));
}

export function showCharts(charts, summary) {
  const { hertz } = summary;
  draw(at('chart-force'), charts.force, `Contact force over time beside Hertz: at most ${show(summary.peak_force_n, 'N')}; Hertz ${show(hertz.peak_force_n, 'N')}.`);
  draw(at('chart-approach'), charts.approach, `Approach over time beside Hertz: at most ${show(summary.max_approach_m, 'm')}; Hertz ${show(hertz.max_approach_m, 'm')}.`);
  draw(at('chart-energy'), charts.energy, 'Where the energy is, over time.');
}

// Shares of the energy at the end; what is given to the bodies counts with what they had.
export function energyShares(energy) {
  const entries = Object.entries(energy)
    .filter(([key, value]) => key.endsWith('_j') && value !== null)
    .map(([key, value]) => [key.slice(0, -2), value]);
  const book = Object.fromEntries(entries);
  const whole = (book.initial ?? 0) + (book.wall_work ?? 0);
  const parts = entries.filter(([name]) => !['initial', 'residual', 'wall_work'].includes(name));
  return { whole, parts: parts.map(([name, value]) => ({ name, share: value / whole })) };
}

export function showEnergy(summary) {
  const { whole, parts } = energyShares(summary.energy);
  const shown = parts.filter(({ share }) => Math.abs(share) >= 5e-7);
  const known = whole > 0 && shown.length > 0;
  at('energy-text').textContent = known
    ? `Of the ${show(whole, 'J', 3)} that the bodies met with, there are in the end:`
    : 'This model keeps no account of energy here.';
  const bar = shown.map(({ name, share }) => element('span', '', { class: `energy-${name}`, style: `flex-grow:${Math.max(0, share)}` }));
  at('energy-bar').replaceChildren(...(known ? bar : []));
  const lines = shown.map(({ name, share }) => {
    const line = element('li');
    line.append(element('i', '', { class: `energy-${name}` }), ` ${percent(share)} ${ACCOUNT_WORDS[name] ?? name.replaceAll('_', ' ')}`);
    return line;
  });
  at('energy-shares').replaceChildren(...(known ? lines : []));
}

// Changes below this share of a number are nothing to speak of.
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
  if (changes.length === 0) return ' Worth next to nothing.';
  return ` Worth about ${changes.map(([name, change, unit]) => `${show(change, unit, 1)} of ${name}`).join(', ')}.`;
}

export function showEffects(summary) {
  const { effects } = summary;
  const line = (effect) => {
    const made = element('li', '', { 'data-effect': effect.name });
    made.append(element('strong', effect.name), ` – ${EFFECT_WORDS[effect.name] ?? ''}${worth(effect.error_if_left_out, summary)} `, element('span', effect.reason, { class: 'reason' }));
    return made;
  };
  at('effects-on').replaceChildren(...effects.filter((effect) => effect.active).map(line));
  at('effects-off').replaceChildren(...effects.filter((effect) => !effect.active).map(line));
}

export function showPicture(picture, frame, summary) {
  const has = Boolean(picture);
  at('picture-controls').hidden = !has;
  at('picture-bar').hidden = !has;
  if (!has) {
    draw(at('picture-svg'), null, '');
    at('picture-caption').textContent = 'This model has no elements, and so no stress to draw: take a finite-element model.';
    return;
  }
  at('bands').textContent = `[data-theme="dark"] { ${picture.dark_rules} }`;
  const [low, high] = picture.range_pa;
  const words = `${show(frame.time_s, 's', 3)} after first touch: force ${show(frame.contact_force_n, 'N', 3)}, approach ${show(frame.approach_m, 'm', 3)}; stress from ${show(low, 'Pa', 3)} to ${show(high, 'Pa', 3)}, compression negative.${summary.bodies.some((body) => !body.elements) ? ' The rigid partner is not drawn.' : ''}`;
  draw(at('picture-svg'), picture.svg, `Section through both bodies at the contact, ${words}`);
  draw(at('picture-bar'), picture.bar, 'Colours of the stress, from compression to tension.');
  at('picture-caption').textContent = words;
  at('instant').setAttribute('aria-valuetext', `${show(frame.time_s, 's', 3)} after first touch`);
}

export function showFault(place, fault) {
  place.hidden = !fault;
  place.replaceChildren();
  if (!fault) return;
  for (const { line, column, message, help, text } of [fault, ...(fault.others ?? [])]) {
    const where = line ? `Line ${line}, column ${column}: ` : '';
    place.append(element('strong', `${where}${message}`));
    if (help) place.append(element('p', help));
    if (text) place.append(element('pre', text));
  }
}
