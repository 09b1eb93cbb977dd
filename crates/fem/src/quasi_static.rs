//! Ting's quasi-static impact of a scene: a model, and what effects estimate by.

use fem_case::{Body, Scene};
use fem_laws::{FiniteSize, Impact, LawError, Pair, PairRelaxation, Ting};
use fem_material::Material;

use crate::estimate::Estimate;

/// Accuracy of the impacts that foretell what effects change.
const ESTIMATE_TOLERANCE: f64 = 1e-5;

/// Ting's impact of a scene, on half-spaces or with the compliance of finite spheres in series,
/// however large the contact.
///
/// # Errors
/// Numbers that the law refuses.
pub fn ting_impact(scene: &Scene, pair: &Pair, finite_size: bool) -> Result<Impact, LawError> {
    let size = finite_size.then(|| scene.finite_size()).transpose()?;
    ting_of(scene, pair, true, size)?.impact(scene.approach_speed())
}

/// Ting's model of a scene and its pair; of elastic materials with the same instantaneous moduli where
/// nothing relaxes.
///
/// # Errors
/// Numbers that the law refuses.
pub(crate) fn ting_of(
    scene: &Scene,
    pair: &Pair,
    relaxes: bool,
    size: Option<FiniteSize>,
) -> Result<Ting, LawError> {
    let [first, second] = scene.bodies().each_ref().map(Body::material);
    let elastic = |material: Option<&Material>| material.map(Material::without_relaxation);
    let relaxation = if relaxes {
        PairRelaxation::new(first, second)?
    } else {
        PairRelaxation::new(elastic(first).as_ref(), elastic(second).as_ref())?
    };
    let ting = Ting::new(pair, relaxation);
    Ok(match size {
        Some(size) => ting.with_finite_size(size),
        None => ting,
    })
}

/// What an impact that foretells has beside elastic half-spaces.
#[derive(Clone, Debug, Default)]
pub(crate) struct Terms<'a> {
    /// Whether the materials relax.
    pub relaxes: bool,
    /// The spheres' own compliance.
    pub size: Option<FiniteSize>,
    /// Materials of bodies that radiate.
    pub radiating: [Option<&'a Material>; 2],
}

/// Ting's impact at the speed of an estimate, as accurate as a forecast needs; nothing where it has none.
pub(crate) fn estimated(scene: &Scene, estimate: &Estimate, terms: Terms<'_>) -> Option<Impact> {
    let hertz = &estimate.hertz;
    let ting = ting_of(scene, hertz.pair(), terms.relaxes, terms.size).ok()?;
    let ting = ting.with_radiation(terms.radiating.into_iter().flatten()).ok()?;
    ting.with_tolerance(ESTIMATE_TOLERANCE).ok()?.impact(hertz.approach_speed()).ok()
}
