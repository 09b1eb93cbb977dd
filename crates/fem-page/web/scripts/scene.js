// The state of the sliders as a case and as a command.
import { materialNames, materialTable } from './materials.js';

// The sliders: range, displayed unit, whether it is logarithmic.
export const SLIDERS = {
  'striker.diameter': { from: 0.01, to: 200, unit: 'mm', isLogarithmic: true },
  'partner.diameter': { from: 0.01, to: 200, unit: 'mm', isLogarithmic: true },
  'plate.thickness': { from: 0.1, to: 200, unit: 'mm', isLogarithmic: true },
  'plate.diameter': { from: 1, to: 2000, unit: 'mm', isLogarithmic: true },
  'speed': { from: 0.001, to: 10, unit: 'm/s', isLogarithmic: true },
  'relaxation.time': { from: 1, to: 100000, unit: 'µs', isLogarithmic: true },
  'relaxation.weight': { from: 0, to: 1, unit: '', isLogarithmic: false },
  'adhesion.work': { from: 1, to: 1000, unit: 'mJ/m²', isLogarithmic: true },
  'law.a': { from: 0.01, to: 100, unit: 'µs', isLogarithmic: true },
  'law.e': { from: 0.05, to: 1, unit: '', isLogarithmic: false },
};

export const CHOICES = {
  'partner.shape': ['sphere', 'wall', 'half_space', 'plate'],
  'plate.edge': ['none', 'diameter'],
  'plate.support': ['free', 'bonded'],
  'relaxation.kind': ['library', 'none', 'term'],
  'relaxation.acts_on': ['all', 'shear'],
  'adhesion.kind': ['none', 'work'],
  'model': ['condensed', 'fem', 'ting', 'hertz', 'law', 'auto'],
  'law.kind': ['kuwabara_kono', 'tsuji'],
};

// The names of the settings.
export const LABELS = {
  'striker.diameter': 'Diameter of the striker',
  'striker.material': 'Material of the striker',
  'partner.shape': 'Shape of the partner',
  'partner.diameter': 'Diameter of the partner',
  'partner.material': 'Material of the partner',
  'plate.thickness': 'Thickness of the plate',
  'plate.edge': 'Edge of the plate',
  'plate.diameter': 'Diameter of the plate',
  'plate.support': 'Support of the plate',
  'speed': 'Approach speed',
  'relaxation.kind': 'Relaxation',
  'relaxation.time': 'Relaxation time',
  'relaxation.weight': 'Relaxing share',
  'relaxation.acts_on': 'What relaxes',
  'adhesion.kind': 'Adhesion',
  'adhesion.work': 'Work of adhesion',
  'model': 'Model',
  'law.kind': 'Contact law',
  'law.a': 'Dissipation time',
  'law.e': 'Desired restitution',
};

// The pair of the paper, the initial state.
export const FIRST = {
  'striker.diameter': 22.2,
  'striker.material': 'glass',
  'partner.shape': 'sphere',
  'partner.diameter': 15.9,
  'partner.material': 'glass',
  'plate.thickness': 5,
  'plate.edge': 'none',
  'plate.diameter': 200,
  'plate.support': 'free',
  'speed': 0.5,
  'relaxation.kind': 'library',
  'relaxation.time': 369,
  'relaxation.weight': 1,
  'relaxation.acts_on': 'all',
  'adhesion.kind': 'none',
  'adhesion.work': 100,
  'model': 'condensed',
  'law.kind': 'kuwabara_kono',
  'law.a': 1,
  'law.e': 0.9,
};

// Returns a valid state: given values within their limits, and initial values for the rest.
export function sound(given) {
  const state = { ...FIRST };
  for (const key of Object.keys(FIRST)) {
    const value = given[key];
    const slider = SLIDERS[key];
    if (slider && Number.isFinite(value)) state[key] = Math.min(slider.to, Math.max(slider.from, value));
    else if (CHOICES[key]?.includes(value)) state[key] = value;
    else if (key.endsWith('.material') && materialNames().includes(value)) state[key] = value;
  }
  return state;
}

// Returns whether a control applies to the state.
export function isMeant(key, state) {
  if (key === 'partner.diameter') return state['partner.shape'] === 'sphere';
  if (key === 'partner.material') return state['partner.shape'] !== 'wall';
  if (key === 'plate.diameter') return state['partner.shape'] === 'plate' && state['plate.edge'] === 'diameter';
  if (key.startsWith('plate.')) return state['partner.shape'] === 'plate';
  if (['relaxation.time', 'relaxation.weight', 'relaxation.acts_on'].includes(key)) return state['relaxation.kind'] === 'term';
  if (key === 'adhesion.work') return state['adhesion.kind'] === 'work';
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

// Returns the case as TOML. The first body lies below: the striker of two spheres, otherwise the partner.
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
  const edge = isMeant('plate.diameter', state) ? `, diameter = "${state['plate.diameter']} mm"` : '';
  const support = state['plate.support'] === 'free' ? '' : `, support = "${state['plate.support']}"`;
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
    plate: `[[body]]
name = "plate"
plate = { thickness = "${state['plate.thickness']} mm"${edge}${support} }
material = "${state['partner.material']}"`,
  };
  const bodies = shape === 'sphere' ? [striker, partners.sphere] : [partners[shape], striker];
  const contact = isMeant('adhesion.work', state) ? `[contact]\nwork_of_adhesion = "${state['adhesion.work']} mJ/m^2"\n\n` : '';
  const tables = [...names].map((name) => materialTable(name, relaxation));
  return `title = "${titleOf(state)}"

${[...tables, ...bodies].join('\n\n')}

${contact}[model]
${modelTable(state)}
`;
}

function titleOf(state) {
  const other = {
    sphere: `${state['partner.diameter']} mm of ${state['partner.material']}`,
    wall: 'a rigid wall',
    half_space: `a block of ${state['partner.material']}`,
    plate: `${state['plate.thickness']} mm of ${state['partner.material']}`,
  };
  return `${state['striker.diameter']} mm of ${state['striker.material']} on ${other[state['partner.shape']]} at ${state.speed} m/s`;
}

// Returns the shell command for a case.
export function commandOf(text) {
  const end = text.split('\n').includes('CASE') ? 'END_OF_THE_CASE' : 'CASE';
  return `cat > case.toml <<'${end}'
${text.trimEnd()}
${end}
fem-run case.toml
`;
}
