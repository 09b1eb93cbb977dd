//! Ting's quasi-static impact of a scene.

use fem_case::{Body, Scene};
use fem_laws::{FiniteSize, Impact, LawError, Pair, PairRelaxation, Ting};
use fem_material::Material;

use crate::effects::SurfaceSlip;
use crate::estimate::Estimate;

/// Ting's impact of a scene, on half-spaces or with the compliance of finite spheres in series,
/// however large the contact.
///
/// # Errors
/// Numbers that the law refuses.
pub fn ting_impact(scene: &Scene, pair: &Pair, finite_size: bool) -> Result<Impact, LawError> {
    let size = finite_size.then(|| scene.finite_size()).transpose()?;
    ting_of(scene, pair, true, size)?.impact(scene.approach_speed())
}

/// Accuracy of an impact that only foretells.
const FORECAST: f64 = 1e-3;

/// Ting's impact of a scene on half-spaces at a speed (m/s), to foretell how far bodies come and how long they
/// take.
///
/// # Errors
/// Numbers that the law refuses.
pub(crate) fn foretold_impact(
    scene: &Scene,
    estimate: &Estimate,
    speed: f64,
) -> Result<Impact, LawError> {
    let ting = ting_of(scene, estimate.hertz.pair(), true, None)?;
    ting.with_tolerance(FORECAST)?.impact(speed)
}

/// Ting's model of a scene and its pair, of surfaces that slip on each other where the scene has that on;
/// of elastic materials with the same instantaneous moduli where nothing relaxes.
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
    let mut ting = Ting::new(pair, relaxation);
    if SurfaceSlip::is_on(scene) {
        ting = ting.with_surface_slip(scene.surface_slip());
    }
    Ok(match size {
        Some(size) => ting.with_finite_size(size),
        None => ting,
    })
}
