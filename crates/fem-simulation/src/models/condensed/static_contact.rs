//! The contact of relaxed finite elements under a constant force.
//!
//! Relaxation times may be far above the time step of explicit elements. The same bodies are condensed with equilibrium
//! moduli, on a mesh that the plan chooses for Hertz' contact radius under the force, and pressed together.

use fem_case::engineering::show;
use fem_case::{ModelChoice, Scene};
use fem_collision::StaticContact;
use fem_condensed::{CondensedError, CondensedPair};
use fem_laws::StaticHertz;

use super::{CANDIDATE_GROWTH, check_memory, inputs, settings};
use crate::plan::Plan;
use crate::plan::body_source::BodySource;
use crate::plan::pair_cache::PairKey;
use crate::rejection::Rejection;

/// Computes the static contact of a scene's bodies; `None` if they flow.
pub(in crate::models) fn of_elements(
    scene: &Scene,
    force: f64,
) -> Result<Option<StaticContact>, Rejection> {
    let reject = |message: String| Rejection::new("gravity", message);
    let Some(relaxed) = scene.at_equilibrium() else { return Ok(None) };
    let hertz = relaxed.pair().and_then(|pair| Ok((pair, StaticHertz::new(&pair, force)?)));
    let (pair, hertz) = hertz.map_err(|error| reject(error.to_string()))?;
    // At this speed Hertz' largest approach, (1.25 m v²/K)^(2/5), equals the static one.
    let stiffness = force / (hertz.approach * hertz.approach.sqrt());
    let speed =
        hertz.approach * (0.8 * stiffness * hertz.approach.sqrt() / pair.effective_mass()).sqrt();
    let Some(relaxed) = relaxed.touching_at(speed) else {
        return Err(reject(format!(
            "the static contact has no size: {}",
            show(hertz.contact_radius, "m")
        )));
    };
    // A static contact needs a larger mesh of a half-space than waves do.
    let relaxed = relaxed.with_model(ModelChoice::Condensed(fem_case::defaults::CONDENSED));
    let plan = Plan::of(&relaxed)?;
    let bodies = BodySource::of_scene(&relaxed, &plan)?;
    check_memory(&plan, &bodies)?;
    let settings = settings(&relaxed, &plan, fem_case::defaults::CONDENSED);
    let key = PairKey { bodies, settings };
    let of_error = |error: CondensedError| reject(error.to_string());
    let mut pair = CondensedPair::new(inputs(&key)?, key.settings).map_err(of_error)?;
    loop {
        match pair.pressed(force) {
            Err(CondensedError::ContactBeyondCandidates { radius }) => {
                pair = pair.enlarge(CANDIDATE_GROWTH * radius).map_err(of_error)?;
            }
            pressed => return pressed.map(Some).map_err(of_error),
        }
    }
}
