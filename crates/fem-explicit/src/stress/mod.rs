//! How a body's stress follows from its motion: the port, and one file a law.
//!
//! ```text
//! elastic             Hooke's law
//! constant_poisson    all moduli relax alike: Poisson's ratio stays
//! relaxing_shear      shear relaxes, bulk is elastic
//! prony               the history of both, one field a term
//! kernel              the element loops of all: forces and strain energy
//! lanes, block        four elements at once, and how they lie in memory
//! ```

mod block;
mod constant_poisson;
mod elastic;
mod kernel;
mod lanes;
mod prony;
mod relaxing_shear;

use fem_element::QuadGeometry;
use fem_material::{ActsOn, Material};
use fem_mesh::SphereMesh;

use crate::part::{Accounts, Field, Motion, NodalField, Part};
use block::Blocks;
use constant_poisson::ConstantPoisson;
use elastic::Elastic;
pub(crate) use kernel::Moduli;
use prony::Relaxing;
use relaxing_shear::RelaxingShear;

/// The stress of a body: internal forces, what it stores and dissipates, and how stiff it is.
///
/// The place of effects that depend on strain and its past: another material law, finite strain,
/// bulk viscosity.
pub trait Stress: Part {
    /// Largest eigenvalue (s⁻²) of an element's stiffness against its lumped masses (kg), its
    /// corners `on_axis` free along y alone; or a bound of it.
    fn largest_eigenvalue(
        &self,
        geometry: &QuadGeometry,
        masses: &[f64; 4],
        on_axis: [bool; 4],
    ) -> f64;

    /// History of a body that is displaced (m) as a whole.
    fn start_rigid(&self, _displacement: &Field, _history: &mut [NodalField]) {}

    /// History of a body that has been deformed in no time: nothing of it has relaxed.
    fn start_deformed(&self, _displacement: &Field, _history: &mut [NodalField]) {}

    /// Subtracts the internal forces (N) from `forces`.
    fn subtract_forces(&self, motion: &Motion<'_>, history: &[NodalField], forces: &mut Field);

    /// Takes the history to the end of a step, whose motion is given.
    fn advance(&self, _motion: &Motion<'_>, _history: &mut [NodalField]) {}

    /// Adds what the body stores and dissipates.
    fn add_energies(&self, motion: &Motion<'_>, history: &[NodalField], accounts: &mut Accounts);

    /// Which field of its history is the effective displacement, where relaxing stress is that of
    /// another displacement than the body's.
    fn effective(&self) -> Option<usize> {
        None
    }
}

/// The stress of a material at small strain, on the integrated elements of a mesh.
pub(crate) fn of_material(
    mesh: &SphereMesh,
    geometries: &[QuadGeometry],
    material: &Material,
) -> Box<dyn Stress> {
    let elastic = Elastic {
        blocks: Blocks::pack(mesh, geometries),
        moduli: Moduli::of(material.instantaneous()),
    };
    let relaxation = material.relaxation().filter(|series| series.relaxes());
    match relaxation.map(|series| (series, series.acts_on())) {
        None => Box::new(elastic),
        Some((series, ActsOn::All)) => Box::new(Relaxing::<ConstantPoisson>::new(elastic, series)),
        Some((series, ActsOn::Shear)) => Box::new(Relaxing::<RelaxingShear>::new(elastic, series)),
    }
}
