// An explanation of each effect, by its name in results.

export const EFFECT_WORDS = {
  'viscoelasticity': 'The material relaxes while it is compressed: it pushes back less during separation than during approach, and the difference becomes heat.',
  'material loss': 'A material without a relaxation is computed as elastic: its own loss is missing.',
  'dashpot': 'The contact law has a dashpot, which represents all losses together.',
  'finite size': 'A sphere is not a half-space: its far side is free, which makes it slightly stiffer than Hertz assumes.',
  'finite strain': 'At strains of several per cent, the deformed shape matters for strains and contact.',
  'surface slip': 'Surfaces of different stiffness slide on each other as they are pressed together.',
  'plastic yield': 'Above its yield strength a material deforms permanently. No model here computes that; this says when it would happen.',
  'adhesion': 'Surfaces attract each other. No model here computes that; this says below which speed the bodies would stick.',
  'partner waves': 'Waves in a large partner do not return within the contact: their energy is lost to the collision.',
  'mirror symmetry': 'Two equal bodies are mirror images of each other, so only one is computed.',
  'rigid partner': 'A much stiffer partner hardly deforms and is treated as rigid.',
  'vibration': 'The bodies vibrate after the contact. A sphere that waves cross many times during the contact hardly vibrates.',
  'hourglass control': 'Simple elements have deformation modes without stiffness (hourglass modes); a small stiffness suppresses them.',
  'bulk viscosity': 'An artificial viscosity smooths shock waves.',
  'penalty springs': 'Springs keep the surfaces apart; they allow a small overlap.',
  'gravity': 'Weight brings the ball back to the floor.',
  'contact search': 'Contact is searched for only in the region around the axis where it can occur.',
  'mass scaling': 'The smallest elements are made slightly heavier, which allows longer time steps.',
};

// Effects of the numerical method, which are not physics.
export const OF_COMPUTATION = ['mirror symmetry', 'hourglass control', 'bulk viscosity', 'penalty springs', 'contact search', 'mass scaling'];

// A description of each account of energy.
export const ACCOUNT_WORDS = {
  rebound: 'motion away from each other: the rebound',
  ringing: 'vibration of the bodies',
  kinetic: 'motion',
  strain: 'remaining deformation',
  contact: 'penalty springs of the contact',
  viscous_dissipation: 'heat from relaxation',
  bulk_viscosity: 'smoothed shocks',
  contact_damping: 'dashpots of the contact',
  radiated: 'waves that do not return',
  potential: 'height',
  left_before: 'energy left in the bodies by earlier contacts',
  adhesion: 'held back by adhesion',
};
