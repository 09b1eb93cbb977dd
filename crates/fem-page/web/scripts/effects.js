// What each effect is, in plain words; its name as results have it.

export const EFFECT_WORDS = {
  'viscoelasticity': 'The material gives way while it is squeezed: it pushes back less on the way out than on the way in, and the difference becomes heat.',
  'dashpot': 'The contact law has a dashpot, which stands for every loss at once.',
  'finite size': 'A sphere is no half-space: its far side is free, which makes it a little stiffer than Hertz says.',
  'finite strain': 'Where the bodies are squeezed by many per cent, strains have to be measured from the deformed shape.',
  'surface slip': 'Surfaces of unlike stiffness slide on each other as they are pressed together.',
  'plastic yield': 'Above its yield strength a material flows and does not come back. No model here flows; this says where it would.',
  'partner waves': 'A large partner carries waves away that do not come back within the contact: their energy is lost to the collision.',
  'mirror symmetry': 'Two equal bodies are each other’s mirror image: one is computed, and the other follows.',
  'rigid partner': 'A partner that is far stiffer hardly gives way: it is taken as rigid.',
  'vibration': 'The bodies ring after the contact. A sphere that is small for the length of its contact hardly rings.',
  'hourglass control': 'Simple elements have shapes that they do not feel; a weak stiffness keeps these away.',
  'bulk viscosity': 'An artificial viscosity that smooths shocks, where there are some.',
  'penalty springs': 'Springs keep the surfaces apart and overlap a little.',
  'gravity': 'Weight, which brings the ball back to the floor.',
  'contact search': 'Where the surfaces may touch is looked for around the axis alone.',
  'mass scaling': 'The smallest elements are made a little heavier, so that steps may be longer.',
};

// Those that are means of the computation, not of the bodies.
export const OF_COMPUTATION = ['mirror symmetry', 'hourglass control', 'bulk viscosity', 'penalty springs', 'contact search', 'mass scaling'];

// What each account of energy is.
export const ACCOUNT_WORDS = {
  rebound: 'motion away from each other: the rebound',
  ringing: 'motion within the bodies: they ring',
  kinetic: 'motion',
  strain: 'deformation that is still there',
  contact: 'springs of the contact',
  viscous_dissipation: 'heat, by relaxation',
  bulk_viscosity: 'smoothed shocks',
  contact_damping: 'dashpots of the contact',
  radiated: 'waves that went away for good',
  potential: 'height',
  left_before: 'left in the bodies by earlier contacts',
};
