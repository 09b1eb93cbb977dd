// What the sliders say, as a case, as a command and as a link.
import { rounded } from './units.js';
import { materialNames, materialTable } from './materials.js';

// Each slider: range, unit as people write it, whether it is logarithmic.
export const SLIDERS = {
  'striker.diameter': { from: 0.1, to: 200, unit: 'mm', isLogarithmic: true },
  'partner.diameter': { from: 0.1, to: 200, unit: 'mm', isLogarithmic: true },
  'speed': { from: 0.01, to: 10, unit: 'm/s', isLogarithmic: true },
  'relaxation.time': { from: 1, to: 100000, unit: 'µs', isLogarithmic: true },
  'relaxation.weight': { from: 0, to: 1, unit: '', isLogarithmic: false },
  'law.a': { from: 0.01, to: 100, unit: 'µs', isLogarithmic: true },
  'law.e': { from: 0.05, to: 1, unit: '', isLogarithmic: false },
};

const CHOICES = {
  'partner.shape': ['sphere', 'wall', 'half_space'],
  'relaxation.kind': ['library', 'none', 'term'],
  'relaxation.acts_on': ['all', 'shear'],
  'model': ['condensed', 'fem', 'ting', 'hertz', 'law', 'auto'],
  'law.kind': ['kuwabara_kono', 'tsuji'],
};

// The pair of the paper.
export const FIRST = {
  'striker.diameter': 22.2,
  'striker.material': 'glass',
  'partner.shape': 'sphere',
  'partner.diameter': 15.9,
  'partner.material': 'glass',
  'speed': 0.5,
  'relaxation.kind': 'library',
  'relaxation.time': 369,
  'relaxation.weight': 1,
  'relaxation.acts_on': 'all',
  'model': 'condensed',
  'law.kind': 'kuwabara_kono',
  'law.a': 1,
  'law.e': 0.9,
};

// What there is of a state, within its limits; the rest is as at first.
export function sound(given) {
  const state = { ...FIRST };
  for (const key of Object.keys(FIRST)) {
    const value = given[key];
    const slider = SLIDERS[key];
    if (slider && Number.isFinite(value)) state[key] = rounded(Math.min(slider.to, Math.max(slider.from, value)), 4);
    else if (CHOICES[key]?.includes(value)) state[key] = value;
    else if (key.endsWith('.material') && materialNames().includes(value)) state[key] = value;
  }
  return state;
}

// Which controls have a meaning.
export function isMeant(key, state) {
  if (key === 'partner.diameter') return state['partner.shape'] === 'sphere';
  if (key === 'partner.material') return state['partner.shape'] !== 'wall';
  if (['relaxation.time', 'relaxation.weight', 'relaxation.acts_on'].includes(key)) return state['relaxation.kind'] === 'term';
  if (key === 'law.kind') return state.model === 'law';
  if (key === 'law.a') return state.model === 'law' && state['law.kind'] === 'kuwabara_kono';
  if (key === 'law.e') return state.model === 'law' && state['law.kind'] === 'tsuji';
  return true;
}

function modelTable(state) {
  if (state.model !== 'law') return `${state.model} = {}`;
  if (state['law.kind'] === 'tsuji') return `law = { tsuji = { e = ${state['law.e']} } }`;
  return `law = { kuwabara_kono = { a = "${state['law.a']} us" } }`;
}

// The case as TOML. The first body lies below: the striker of two spheres, else the partner.
export function caseOf(state) {
  const relaxation = {
    kind: state['relaxation.kind'],
    time: state['relaxation.time'],
    weight: state['relaxation.weight'],
    acts_on: state['relaxation.acts_on'],
  };
  const shape = state['partner.shape'];
  const names = new Set([state['striker.material']]);
  if (shape !== 'wall') names.add(state['partner.material']);
  const striker = `[[body]]
name = "striker"
sphere = { diameter = "${state['striker.diameter']} mm" }
material = "${state['striker.material']}"
approach_speed = "${state.speed} m/s"`;
  const partners = {
    sphere: `[[body]]
name = "target"
sphere = { diameter = "${state['partner.diameter']} mm" }
material = "${state['partner.material']}"`,
    wall: `[[body]]
name = "wall"
wall = {}`,
    half_space: `[[body]]
name = "block"
half_space = {}
material = "${state['partner.material']}"`,
  };
  const bodies = shape === 'sphere' ? [striker, partners.sphere] : [partners[shape], striker];
  const tables = [...names].map((name) => materialTable(name, relaxation));
  return `title = "${titleOf(state)}"

${[...tables, ...bodies].join('\n\n')}

[model]
${modelTable(state)}
`;
}

function titleOf(state) {
  const other = {
    sphere: `${state['partner.diameter']} mm of ${state['partner.material']}`,
    wall: 'a rigid wall',
    half_space: `a block of ${state['partner.material']}`,
  };
  return `${state['striker.diameter']} mm of ${state['striker.material']} on ${other[state['partner.shape']]} at ${state.speed} m/s`;
}

// What a shell does with the same case.
export function commandOf(text) {
  const end = text.split('\n').includes('CASE') ? 'END_OF_THE_CASE' : 'CASE';
  return `cat > case.toml <<'${end}'
${text.trimEnd()}
${end}
fem-run case.toml
`;
}

function packed(text) {
  const bytes = Array.from(new TextEncoder().encode(text), (byte) => String.fromCharCode(byte));
  return btoa(bytes.join('')).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

function unpacked(text) {
  const bytes = Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (letter) => letter.charCodeAt(0));
  return new TextDecoder('utf-8', { fatal: true }).decode(bytes);
}

// The part of an address behind #: what the sliders say, or a text.
export function fragmentOf({ state, text }) {
  if (text !== null) return `#case=${packed(text)}`;
  const changed = Object.entries(state).filter(([key, value]) => value !== FIRST[key]);
  return changed.length === 0 ? '' : `#${new URLSearchParams(changed)}`;
}

// What such a part says; null if it is none.
export function read(fragment) {
  const rest = fragment.replace(/^#/, '');
  if (rest === '') return null;
  const words = new URLSearchParams(rest);
  if (words.has('case')) {
    try {
      return { state: { ...FIRST }, text: unpacked(words.get('case')) };
    } catch {
      return null;
    }
  }
  const given = Object.fromEntries([...words].map(([key, value]) => [key, key in SLIDERS ? Number(value) : value]));
  return { state: sound(given), text: null };
}
