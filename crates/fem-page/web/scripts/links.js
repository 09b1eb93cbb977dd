// The part of an address after #: the state of the sliders, or a case as text; and faults in it.
import { materialNames } from './materials.js';
import { CHOICES, FIRST, LABELS, SLIDERS } from './scene.js';

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
// Most characters of a word that are shown, and most words.
const MOST_LETTERS = 40;
const MOST_WORDS = 4;

function packed(text) {
  const bytes = Array.from(new TextEncoder().encode(text), (byte) => String.fromCharCode(byte));
  return btoa(bytes.join('')).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

function unpacked(text) {
  const bytes = Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (letter) => letter.charCodeAt(0));
  return new TextDecoder('utf-8', { fatal: true }).decode(bytes);
}

export function fragmentOf({ state, text }) {
  if (text !== null) return `#case=${packed(text)}`;
  const changed = Object.entries(state).filter(([key, value]) => value !== FIRST[key]);
  return changed.length === 0 ? '' : `#${new URLSearchParams(changed)}`;
}

const quoted = (word) => `“${word.length > MOST_LETTERS ? `${word.slice(0, MOST_LETTERS)}…` : word}”`;

function listed(words) {
  const more = words.length - MOST_WORDS;
  return `${words.slice(0, MOST_WORDS).map(quoted).join(', ')}${more > 0 ? ` and ${more} more` : ''}`;
}

// Returns the fault of a word for a setting, or null.
function faultOf(key, word) {
  const slider = SLIDERS[key];
  if (word.trim() === '') return 'nothing is given';
  if (slider) {
    const { from, to, unit } = slider;
    if (!NUMBER.test(word.trim())) return `${quoted(word)} is no number`;
    const value = Number(word);
    return value >= from && value <= to ? null : `${quoted(word)} is given; it goes from ${from} to ${to} ${unit}`.trim();
  }
  const allowed = CHOICES[key] ?? materialNames();
  return allowed.includes(word) ? null : `${quoted(word)} is given; there are ${allowed.join(', ')}`;
}

// Reads such a part: the state of the sliders, a text or null, and descriptions of what is not used.
export function read(fragment) {
  const rest = fragment.replace(/^#/, '');
  const given = { state: { ...FIRST }, text: null, faults: [] };
  if (rest === '') return given;
  const words = [...new URLSearchParams(rest)];
  const packedCase = words.find(([key]) => key === 'case');
  if (packedCase) {
    try {
      given.text = unpacked(packedCase[1]);
      if (given.text.trim() === '') throw new Error('empty');
      const others = words.filter((pair) => pair !== packedCase).map(([key]) => key);
      if (others.length > 0) given.faults.push(`Beside a whole case nothing else counts; left out: ${listed(others)}.`);
    } catch {
      given.text = null;
      given.faults.push('Its case cannot be read: the link is damaged or incomplete. The first case is shown.');
    }
    return given;
  }
  const seen = new Set();
  const unknown = words.map(([key]) => key).filter((key) => !Object.hasOwn(FIRST, key));
  if (unknown.length > 0) given.faults.push(`${listed(unknown)} ${unknown.length > 1 ? 'are no settings' : 'is no setting'} of this page. There are ${Object.keys(FIRST).join(', ')}.`);
  for (const [key, word] of words) {
    if (!Object.hasOwn(FIRST, key)) continue;
    const fault = seen.has(key) ? 'it is given twice; the first value is used' : faultOf(key, word);
    if (!seen.has(key) && !fault) given.state[key] = key in SLIDERS ? Number(word) : word.trim();
    seen.add(key);
    if (fault) given.faults.push(`${LABELS[key]} (${key}): ${fault}. Taken is ${shownValue(key, given.state[key])}.`);
  }
  return given;
}

function shownValue(key, value) {
  return `${value} ${SLIDERS[key]?.unit ?? ''}`.trim();
}
