//! Input for codes of the discrete element method, and the restitution that each code makes of it.
//!
//! Codes interpret an entered restitution in three ways:
//!
//! - The contact ends at zero overlap, and the dashpot pulls at the end: LAMMPS without `limit_damping`, LIGGGHTS
//!   without `limitForce on`, MercuryDPM, Lethe, MFIX-DEM.
//! - The contact ends at zero force: YADE, MuJoCo, Drake, and LAMMPS and LIGGGHTS with those keywords.
//! - An approximate formula: LAMMPS' `tsuji`, YADE's Hertz–Mindlin `en`, MFIX's `HERTZIAN`.
//!
//! Each code has a file with its formulas, their source, and the snippets that use them.

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

use fem_laws::LawError;

impl Export {
    /// Returns the input of all codes.
    ///
    /// # Errors
    /// Numbers that a code's formula does not take.
    pub fn snippets(&self) -> Result<Vec<Snippet>, LawError> {
        let all = [
            lammps_snippets(self)?,
            liggghts_snippets(self)?,
            yade_snippets(self)?,
            mercury_snippets(self),
            lethe_snippets(self),
            mfix_snippets(self)?,
            drake_snippets(self),
            mujoco_snippets(self),
        ];
        Ok(all.concat())
    }
}
