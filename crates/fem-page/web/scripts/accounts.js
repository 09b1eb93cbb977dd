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
  friction: 'work of friction',
  tangential_relaxation: 'relaxed under friction',
  plastic_work: 'heat from plastic flow',
  plate: 'bending waves of the plate',
};
