//! The stress of a body, from its motion.
//!
//! ```text
//! traits         what a step asks of a stress
//! elastic        Hooke's law at small strain
//! prony          linear viscoelasticity at small strain, one nodal field per term
//! kernel         element loops of small strain: forces and strain energy
//! elements       elements that lie anywhere, in blocks of four
//! rows           elements that lie in rows, in eights
//! finite         hyperelastic laws at finite strain, elastic, relaxing or flowing
//! partly_finite  finite strain near the contact alone, small strain elsewhere
//! ```

mod elastic;
mod elements;
mod finite;
mod kernel;
mod partly_finite;
mod prony;
mod rows;
mod traits;

use fem_element::QuadGeometry;
use fem_material::finite::HyperelasticLaw;
use fem_material::{ActsOn, Material};
use fem_mesh::SphereMesh;

use crate::error::ModelError;
use elastic::Elastic;
use elements::PackedElements;
pub use finite::MAX_FINITE_STRAIN_TERMS;
pub(crate) use kernel::Moduli;
use partly_finite::finite_strain_within;
use prony::{AllModuliRelax, LinearViscoelastic, ShearRelaxes};
pub use traits::Collapse;
pub(crate) use traits::{
    FiniteStrainStress, LumpedElement, SmallStrainStress, StrainMeasure, Stress, UnstableElement,
};

/// The law of a body at finite strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FiniteStrainChoice {
    pub law: HyperelasticLaw,
    /// Distance from first touch (m) within which elements are at finite strain; `None` for all elements.
    pub within: Option<f64>,
}

/// Makes the stress of a material on the integrated elements of a mesh: at small strain, or at finite strain where that is
/// chosen.
pub(crate) fn stress_of_body(
    mesh: &SphereMesh,
    geometries: &[QuadGeometry],
    material: &Material,
    finite_strain: Option<FiniteStrainChoice>,
) -> Result<Box<dyn Stress>, ModelError> {
    let law = finite_strain.map(|choice| choice.law);
    if material.flow().is_some() && law != Some(HyperelasticLaw::Hencky) {
        return Err(ModelError::FlowWithoutHencky {
            law: law.map_or("none", HyperelasticLaw::name),
        });
    }
    let Some(FiniteStrainChoice { law, within }) = finite_strain else {
        return Ok(small_strain(mesh.nodes().len(), mesh.quads(), geometries, material));
    };
    let n_terms = material.relaxation().map_or(0, |series| series.terms().len());
    if n_terms > MAX_FINITE_STRAIN_TERMS {
        return Err(ModelError::TooManyTerms { n_terms, most: MAX_FINITE_STRAIN_TERMS });
    }
    let radius = within.unwrap_or(f64::INFINITY);
    Ok(finite_strain_within(radius, mesh, geometries, material, law))
}

/// Makes the stress of a material at small strain on integrated elements: quads on nodes with numbers below `n_nodes`.
pub(crate) fn small_strain(
    n_nodes: usize,
    quads: &[[u32; 4]],
    geometries: &[QuadGeometry],
    material: &Material,
) -> Box<dyn SmallStrainStress> {
    let elastic = Elastic {
        elements: PackedElements::pack(n_nodes, quads, geometries),
        moduli: Moduli::of(material.instantaneous()),
    };
    let relaxation = material.relaxation().filter(|series| series.relaxes());
    match relaxation.map(|series| (series, series.acts_on())) {
        None => Box::new(elastic),
        Some((series, ActsOn::All)) => {
            Box::new(LinearViscoelastic::<AllModuliRelax>::new(elastic, series))
        }
        Some((series, ActsOn::Shear)) => {
            Box::new(LinearViscoelastic::<ShearRelaxes>::new(elastic, series))
        }
    }
}
