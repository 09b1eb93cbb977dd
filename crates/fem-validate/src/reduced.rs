//! The reduced models of a run's scene: what finite elements are held against.

use fem_case::Scene;
use fem_laws::{Impact, Pair, PairRelaxation, Ting};

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
        ting = ting.with_finite_size(scene.finite_size()?);
    }
    Ok(ting.impact(scene.approach_speed())?)
}
