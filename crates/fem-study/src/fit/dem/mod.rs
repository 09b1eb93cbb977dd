//! The numbers that codes of the discrete element method ask for, and what they make of them.
//!
//! Three conventions hide behind a "restitution" that is entered:
//!
//! - a contact that ends at zero overlap, the dashpot pulling at the end: LAMMPS without
//!   `limit_damping`, LIGGGHTS without `limitForce on`, MercuryDPM, Lethe, MFIX-DEM;
//! - one that ends at zero force: YADE, MuJoCo, Drake, and the two above with those keywords;
//! - a formula that is an approximation: LAMMPS' `tsuji`, YADE's Hertz–Mindlin `en`, MFIX's `HERTZIAN`.
//!
//! Each code has a file with its formulas, their source, and the snippet that uses them.

mod drake;
mod grains;
mod lammps;
mod lethe;
mod liggghts;
mod mercury;
mod mfix;
mod mujoco;
mod snippet;
mod yade;

pub use drake::{dissipation_of, drake_snippets, fit_dissipation, restitution_of};
pub use grains::{Grain, PairOfGrains, grain_snippets};
pub use lammps::{TsujiVersion, lammps_snippets, tsuji_entry, tsuji_outcome, viscoelastic_damping};
pub use lethe::lethe_snippets;
pub use liggghts::{characteristic_velocity, hooke_stiffness, liggghts_snippets};
pub use mercury::mercury_snippets;
pub use mfix::{mfix_entry, mfix_outcome, mfix_snippets};
pub use mujoco::mujoco_snippets;
pub use snippet::{Dashpot, Elastic, Export, HuntCrossley, Snippet, Sphere};
pub use yade::{hertz_mindlin_entry, viscel_entry, yade_betan, yade_snippets};
