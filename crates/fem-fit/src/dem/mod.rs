//! The numbers that codes of the discrete element method ask for, and what they make of them.
//!
//! Three conventions hide behind a "restitution" that is entered:
//!
//! - a contact that ends at zero overlap, the dashpot pulling at the end: LAMMPS without
//!   `limit_damping`, LIGGGHTS without `limitForce on`;
//! - one that ends at zero force: YADE, MuJoCo, Drake, and the two above with those keywords;
//! - a formula that is an approximation: LAMMPS' `tsuji`, YADE's Hertz–Mindlin `en`.
//!
//! Each code has a file with its formulas, their source, and the snippet that uses them.

mod drake;
mod lammps;
mod liggghts;
mod mujoco;
mod snippet;
mod yade;

pub use drake::{dissipation_of, drake_snippets, restitution_of};
pub use lammps::{TsujiVersion, lammps_snippets, tsuji_entry, tsuji_outcome, viscoelastic_damping};
pub use liggghts::{characteristic_velocity, hooke_stiffness, liggghts_snippets};
pub use mujoco::mujoco_snippets;
pub use snippet::{Dashpot, Elastic, Export, Snippet, Sphere};
pub use yade::{hertz_mindlin_entry, viscel_entry, yade_betan, yade_snippets};
