//! Waves that a contact sends into a body so large that they do not come back within the contact: they
//! take energy along. Elements have them; closed forms and quasi-static bodies do not.
//!
//! Decided by the contact time over the time that shear waves take through a body, T c_s/D. The loss is
//! that of a half-space ([`radiated_share`]).

use fem_case::{Body, Scene};
use fem_laws::radiated_share;

use super::effect::Effect;
use super::need::{Need, percent};
use crate::estimate::Estimate;

/// Below this T c_s/D nothing comes back in time.
const RETURN_LIMIT: f64 = 2.0;
/// Restitution that waves take and that is worth a warning.
const SMALL_LOSS: f64 = 1e-4;

/// Waves in a large partner.
#[derive(Clone, Copy, Debug)]
pub struct PartnerWaves;

impl PartnerWaves {
    /// Its name in results.
    pub const NAME: &'static str = "partner waves";
}

impl Effect for PartnerWaves {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn need(&self, scene: &Scene, estimate: &Estimate) -> Option<Need> {
        let passages =
            scene.bodies().iter().filter_map(|body| Some((body, passage(body, estimate)?)));
        let passages: Vec<(&Body, f64)> = passages.collect();
        let (largest, least) = passages.iter().copied().min_by(|(_, a), (_, b)| a.total_cmp(b))?;
        let large = passages.iter().filter(|(_, passage)| *passage < RETURN_LIMIT);
        let material = large.filter_map(|(body, _)| body.material());
        let loss: f64 = material.map(|m| radiated_share(&estimate.hertz, m)).sum();
        let lost = 1.0 - (1.0 - loss).max(0.0).sqrt();
        let name = largest.name();
        let warning = (lost > SMALL_LOSS).then(|| {
            format!(
                "{name} is so large that waves from the contact do not come back within it (contact \
                 time × shear wave speed / diameter = {least:.2}, below {RETURN_LIMIT}): they take \
                 {} of the energy, {lost:.1e} of the restitution, which this model leaves out; model \
                 fem has them",
                percent(loss)
            )
        });
        Some(Need {
            is_called_for: least < RETURN_LIMIT,
            number: format!("contact time × shear wave speed / diameter of {name} = {least:.2}"),
            otherwise: "waves come back within the contact".to_string(),
            left_open: format!("they take {lost:.1e} of the restitution"),
            warning,
        })
    }
}

/// T c_s/D; a wall has none.
fn passage(body: &Body, estimate: &Estimate) -> Option<f64> {
    Some(estimate.contact_time * body.material()?.shear_wave_speed() / body.diameter()?)
}
