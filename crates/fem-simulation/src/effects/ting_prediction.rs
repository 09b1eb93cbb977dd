//! Ting's prediction of restitution, contact time and peak force, with and without effects.

use fem_case::{Body, ModelChoice, Scene, Switch};
use fem_laws::{HertzImpact, Impact, LawError, Ting};

use crate::effects::decision::neglect_error::NeglectError;
use crate::effects::decision::simplified_scene::SimplifiedScene;
use crate::effects::decision::{NamedEffect, PartnerWaves};
use crate::estimate::plate_impact::{plate_mobility_of, thin_plate_mobility};
use crate::estimate::quasi_static::{surfaces_slip, ting_of};
use crate::estimate::semi_infinite_partner::radiating_impact;
use crate::estimate::{Estimate, Regime};

/// Relative accuracy of the predictions.
const PREDICTION_TOLERANCE: f64 = 1e-4;

/// The results that effects change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TingPrediction {
    pub restitution: f64,
    /// Contact time, in seconds; `None` for bodies that stay together.
    pub contact_time: Option<f64>,
    /// Peak force, in newtons.
    pub peak_force: f64,
}

impl TingPrediction {
    /// Predicts the collision of a scene, with its relaxation and radiated waves; between half-spaces, or with the spheres'
    /// finite size.
    ///
    /// # Errors
    /// Numbers that the law rejects.
    pub fn of(regime: &Regime, finite_size: bool) -> Result<Self, LawError> {
        let Regime { scene, estimate } = regime;
        let is_condensed = matches!(scene.model(), ModelChoice::Condensed(_));
        let radiating = match is_condensed {
            true => PartnerWaves::radiating_at_rest(scene, estimate),
            false => PartnerWaves::radiating(scene, estimate),
        };
        let radiates = radiating != [None, None];
        let is_hertz = !radiates && !relaxes(scene) && !finite_size && !surfaces_slip(scene);
        if is_hertz && thin_plate_mobility(scene).is_none() {
            return Ok(Self::from(&estimate.hertz));
        }
        let finish = |ting: Ting| ting.with_coarse_waves().with_tolerance(PREDICTION_TOLERANCE);
        if radiates && !is_condensed {
            let impact = radiating_impact(scene, &radiating, estimate, finite_size, finish)?;
            return Ok(Self::from(&impact));
        }
        let size = finite_size.then(|| scene.finite_size()).transpose()?;
        let ting = finish(ting_of(scene, estimate.hertz.pair(), true, size)?)?;
        let ting = ting.with_radiation(radiating.iter().flatten())?;
        Ok(Self::from(&*estimate.impacts.impact(ting, estimate.hertz.approach_speed())?))
    }

    /// Predicts the collision between half-spaces of elastic or relaxing bodies, of which a plate has its finite thickness,
    /// without waves.
    ///
    /// # Errors
    /// Numbers that the law rejects.
    pub fn on_thick_plate(regime: &Regime) -> Result<Self, LawError> {
        let Regime { scene, estimate } = regime;
        let pair = estimate.hertz.pair();
        let ting = ting_of(scene, pair, true, None)?.with_tolerance(PREDICTION_TOLERANCE)?;
        let ting = match plate_mobility_of(scene, pair)? {
            Some(mobility) => ting.with_plate(mobility)?,
            None => ting,
        };
        Ok(Self::from(&*estimate.impacts.impact(ting, estimate.hertz.approach_speed())?))
    }

    /// Returns the difference from another impact. Bodies that stay together have no contact time. A loss of more
    /// than the whole energy counts as unknown.
    pub fn change_from(&self, without: &Self) -> NeglectError {
        let restitution = self.restitution - without.restitution;
        if restitution.abs() > 1.0 {
            return NeglectError::default();
        }
        let times = self.contact_time.zip(without.contact_time);
        NeglectError::of([
            Some(restitution),
            times.map(|(with, without)| with - without),
            Some(self.peak_force - without.peak_force),
        ])
    }
}

/// Returns the difference between two variants of an estimated scene, after all transformations. Waves are
/// left out where they are more than a correction; all is `None` where Ting's model has no solution.
pub(super) fn change_between(with: Scene, without: Scene, estimate: &Estimate) -> NeglectError {
    let [with, without] = [with, without].map(|scene| SimplifiedScene::quiet(scene, estimate));
    let Some((with, without)) = with.zip(without) else { return NeglectError::default() };
    let change = |[with, without]: [&Regime; 2], size: bool| {
        let [with, without] = [with, without].map(|regime| TingPrediction::of(regime, size));
        Some(with.ok()?.change_from(&without.ok()?))
    };
    let both = [&with, &without];
    let size = has_finite_size(&with.scene);
    change(both, size)
        .or_else(|| change(both, false).filter(|_| size))
        .or_else(|| {
            let without_waves = |regime: &Regime| {
                estimate.regime_of(PartnerWaves.switched(&regime.scene, Some(Switch::Off))).ok()
            };
            let [with, without] = both.map(without_waves);
            change([&with?, &without?], false)
        })
        .unwrap_or_default()
}

/// Returns the loss of restitution by relaxation at small strain.
pub(super) fn relaxed_loss(scene: &Scene, estimate: &Estimate) -> f64 {
    let Some(regime) = relaxes(scene).then(|| estimate.regime_of(scene.clone()).ok()).flatten()
    else {
        return 0.0;
    };
    // Compliance of finite spheres changes the relaxation, too.
    let sized = has_finite_size(scene).then(|| TingPrediction::of(&regime, true).ok()).flatten();
    let impact = sized.or_else(|| TingPrediction::of(&regime, false).ok());
    let loss = impact.map_or(0.0, |impact| 1.0 - impact.restitution);
    (loss - PartnerWaves::loss(scene, estimate)).max(0.0)
}

/// Returns whether the scene's model includes the spheres' finite size.
fn has_finite_size(scene: &Scene) -> bool {
    match scene.model() {
        ModelChoice::Fem | ModelChoice::Condensed(_) => true,
        ModelChoice::Ting { finite_size, .. } => *finite_size,
        _ => false,
    }
}

/// Returns whether a material of the scene relaxes.
pub(super) fn relaxes(scene: &Scene) -> bool {
    let mut materials = scene.bodies().iter().filter_map(Body::material);
    materials.any(|material| material.relaxation().is_some())
}

impl From<&Impact> for TingPrediction {
    fn from(impact: &Impact) -> Self {
        let Impact { restitution, contact_time, peak_force, .. } = *impact;
        Self { restitution, contact_time, peak_force }
    }
}

impl From<&HertzImpact> for TingPrediction {
    fn from(hertz: &HertzImpact) -> Self {
        Self {
            restitution: hertz.restitution(),
            contact_time: Some(hertz.contact_time()),
            peak_force: hertz.peak_force(),
        }
    }
}
