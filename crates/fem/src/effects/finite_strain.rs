//! Large strains and rotations, and contact between moved surfaces: all models here are linear.
//!
//! Decided by the contact radius over the effective radius, the size of the strain.

use fem_case::{EffectsTable, Scene, Switch};

use super::effect::{Effect, Need, percent};
use crate::estimate::Estimate;

/// Above this a/R the small-strain model is in doubt: that of a glass impact at 3 m/s.
const SMALL_STRAIN_LIMIT: f64 = 0.1;
/// Share of the contact time that small strain leaves open, over a/R: what contact along each body's
/// own normal instead of the common one changes, 0.2 % at a/R = 0.048 and 1.4 % at 0.30 (glass).
const OPEN_SHARE: f64 = 0.045;

/// Large strains and rotations.
#[derive(Clone, Copy, Debug)]
pub struct FiniteStrain;

impl Effect for FiniteStrain {
    fn name(&self) -> &'static str {
        "finite strain"
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
                 is in doubt (about {open} of the contact time), and finite strain is not available \
                 in this version",
                percent(strain),
                percent(SMALL_STRAIN_LIMIT),
            )
        });
        Some(Need {
            is_called_for,
            number: format!("contact radius / effective radius = {strain:.3}"),
            otherwise: format!("small strain leaves about {open} of the contact time open"),
            left_open: format!("{open} of the contact time is open"),
            warning,
        })
    }
}
