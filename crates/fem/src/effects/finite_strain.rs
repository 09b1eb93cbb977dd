//! Large strains and rotations: all models here are linear. What they change depends on the law of the
//! material beyond Hooke's, which is seldom known.
//!
//! Decided by the contact radius over the effective radius, the size of the strain.

use fem_case::{EffectsTable, Scene, Switch};
use fem_collision::Collision;

use super::effect::Effect;
use super::left_out::LeftOut;
use super::need::{Need, percent};
use crate::estimate::Estimate;

/// Above this a/R the small-strain model is in doubt: that of a glass impact at 3 m/s.
const SMALL_STRAIN_LIMIT: f64 = 0.1;
/// Share of the contact time that small strain leaves open, over a/R*: that of the law that departs
/// most, St Venant and Kirchhoff's, on glass; of neo-Hooke's it is a seventh, of Hencky's a fortieth.
const OPEN_SHARE: f64 = 0.09;
/// The same of the peak force.
const OPEN_FORCE_SHARE: f64 = 0.11;

/// Large strains and rotations.
#[derive(Clone, Copy, Debug)]
pub struct FiniteStrain;

impl FiniteStrain {
    /// Its name in results.
    pub const NAME: &'static str = "finite strain";
}

impl Effect for FiniteStrain {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn switch(&self, effects: &EffectsTable) -> Option<Switch> {
        effects.finite_strain
    }

    fn need(&self, _: &Scene, estimate: &Estimate) -> Option<Need> {
        let strain = estimate.strain;
        let open = percent(OPEN_SHARE * strain);
        let is_called_for = strain > SMALL_STRAIN_LIMIT;
        let warning = is_called_for.then(|| {
            format!(
                "the contact radius is {} of the effective radius; above {} the small-strain model \
                 is in doubt (up to {open} of the contact time), and finite strain is not available \
                 in this version",
                percent(strain),
                percent(SMALL_STRAIN_LIMIT),
            )
        });
        Some(Need {
            is_called_for,
            number: format!("contact radius / effective radius = {strain:.3}"),
            otherwise: format!("small strain leaves up to {open} of the contact time open"),
            left_open: format!("{open} of the contact time is open"),
            warning,
        })
    }

    fn left_out(&self, _: &Scene, estimate: &Estimate) -> Option<LeftOut> {
        let strain = estimate.strain;
        let open = LeftOut::shares(estimate, OPEN_SHARE * strain, OPEN_FORCE_SHARE * strain);
        Some(LeftOut { restitution: None, ..open })
    }

    /// The estimate warns of what it expects; this is what came.
    fn after(&self, _: &Scene, estimate: &Estimate, collision: &Collision) -> Vec<String> {
        let radius = estimate.hertz.pair().effective_radius();
        let strain = collision.max_contact_radius.unwrap_or_default() / radius;
        let is_news = estimate.strain <= SMALL_STRAIN_LIMIT && strain > SMALL_STRAIN_LIMIT;
        let warning = is_news.then(|| {
            format!(
                "the contact radius grew to {:.0} % of the effective radius; above {:.0} % the \
                 small-strain model is in doubt",
                100.0 * strain,
                100.0 * SMALL_STRAIN_LIMIT
            )
        });
        warning.into_iter().collect()
    }
}
