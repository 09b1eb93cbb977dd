//! The reduced models of a run's scene: what finite elements are held against.

use fem_case::{Body, Scene};
use fem_laws::{FiniteSize, Impact, Pair, PairRelaxation, Ting};

use crate::error::StudyError;

/// Ting's impact of a scene, on half-spaces or with the compliance of finite spheres in series.
///
/// # Errors
/// Numbers that the law refuses.
pub(crate) fn ting(scene: &Scene, pair: &Pair, finite_size: bool) -> Result<Impact, StudyError> {
    let [lower, upper] = &scene.bodies;
    let relaxation = PairRelaxation::new(lower.material(), upper.material())?;
    let mut ting = Ting::new(pair, relaxation);
    if finite_size {
        let sphere = |body: &Body| body.diameter().map(|diameter| 0.5 * diameter);
        let [first, second] = [lower, upper].map(|body| sphere(body).zip(body.material()));
        ting = ting.with_finite_size(FiniteSize::new(first, second)?);
    }
    Ok(ting.impact(lower.velocity - upper.velocity)?)
}
