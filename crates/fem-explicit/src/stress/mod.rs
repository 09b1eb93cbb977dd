//! How a body's stress follows from its motion: the port, and one file a law.
//!
//! ```text
//! port                what the step asks of a stress
//! elastic             Hooke's law
//! constant_poisson    all moduli relax alike: Poisson's ratio stays
//! relaxing_shear      shear relaxes, bulk is elastic
//! prony               the history of both, one field a term
//! finite              a law beyond Hooke at finite strain
//! partly_finite       that near the contact alone, and small strain beyond
//! kernel              the element loops of all: forces and strain energy
//! lanes               several elements at once
//! elements            how those of small strain lie in memory: rows of eight, and blocks of four
//! ```

mod block;
mod constant_poisson;
mod elastic;
mod elements;
mod finite;
mod kernel;
pub(crate) mod lanes;
mod partly_finite;
mod port;
mod prony;
mod relaxing_shear;
mod rows;
mod shape;

use fem_element::QuadGeometry;
use fem_material::{ActsOn, Material};
use fem_mesh::SphereMesh;

use constant_poisson::ConstantPoisson;
use elastic::Elastic;
use elements::Elements;
pub use finite::MOST_FINITE_STRAIN_TERMS;
pub(crate) use finite::finite_strain;
pub(crate) use kernel::Moduli;
pub(crate) use partly_finite::finite_strain_within;
pub use port::{Collapse, LumpedElement, Stress, Unstable};
use prony::Relaxing;
use relaxing_shear::RelaxingShear;

/// The stress of a material at small strain, on the integrated elements of a mesh.
pub(crate) fn of_material(
    mesh: &SphereMesh,
    geometries: &[QuadGeometry],
    material: &Material,
) -> Box<dyn Stress> {
    of_quads(mesh.nodes().len(), mesh.quads(), geometries, material)
}

/// The same on some elements, quads of so many nodes.
pub(crate) fn of_quads(
    n_nodes: usize,
    quads: &[[u32; 4]],
    geometries: &[QuadGeometry],
    material: &Material,
) -> Box<dyn Stress> {
    let elastic = Elastic {
        elements: Elements::pack(n_nodes, quads, geometries),
        moduli: Moduli::of(material.instantaneous()),
    };
    let relaxation = material.relaxation().filter(|series| series.relaxes());
    match relaxation.map(|series| (series, series.acts_on())) {
        None => Box::new(elastic),
        Some((series, ActsOn::All)) => Box::new(Relaxing::<ConstantPoisson>::new(elastic, series)),
        Some((series, ActsOn::Shear)) => Box::new(Relaxing::<RelaxingShear>::new(elastic, series)),
    }
}
