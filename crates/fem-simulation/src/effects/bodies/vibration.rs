//! Inertia of the bodies' own deformation. Elements include it; a quasi-static model has modes of free vibration or
//! lacks it.
//!
//! Decided by the approach speed over the shear wave speed.

use fem_case::{Body, ModelChoice, Scene};
use fem_laws::RelativeError;

use crate::effects::decision::neglect_error::{EffectStatus, NeglectError};
use crate::effects::decision::relevance::{MACH_LIMIT, QUASI_STATIC_LIMIT, above, number};
use crate::effects::decision::relevance::{Relevance, percent};
use crate::effects::decision::support::{Adequacy, ConsideredModel, Support};
use crate::effects::decision::{Effect, PartnerWaves, Vibration};
use crate::effects::ting_prediction::relaxed_loss;
use crate::estimate::Estimate;
use crate::estimate::effective_modulus::left_at;
use crate::quantity_errors::QuantityErrors;

/// Number of modes per body that carry the inertia of its deformation.
pub(super) const ENOUGH_MODES: usize = 12;

/// Least loss of restitution over the bodies' own speeds in shear wave speeds ([`own_mach`]). Explicit elements lost
/// 0.06 to 0.1 of it more than quasi-static bodies on a wall at 0.3 to 20 %, and twice that at 40 %. A small ball
/// leaves more in a large one, which hardly moves ([`PartnerWaves::left_ringing`]).
const LOSS_PER_MACH: f64 = 0.1;
/// Factor on the loss by inertia in error bars, since [`LOSS_PER_MACH`] is the least loss: explicit elements of elastic pairs with
/// restitutions of 0.979 to 0.996 lost up to a third more.
const MARGIN_OF_LOSS: f64 = 1.5;
/// Increase of the contact time and decrease of the peak force over the delay of the deformation ([`slowness`]), from explicit
/// elements or twelve modes against none, within a factor of 2.5: elastic balls on a wall at 0.3 to 40 % of the shear wave
/// speed, and pairs at 1.5 to 18 %.
const PER_DELAY: RelativeError =
    RelativeError { restitution: 0.0, contact_time: 2.2, peak_force: 5.0 };
/// Relative increase of the loss over the loss by relaxation. Spheres that relax to 0.1 to 3 % lost 0.0048, 0.0021, 0.0019
/// and 0.0023 of the restitution by inertia, where this gives 0.0051, 0.0029, 0.0011 and 0.0022.
const OF_RELAXED: f64 = 2.0;
/// The same changes over [`Estimate::effective_ringing`], for bodies that ring because their bulk waves are slow: from
/// explicit elements of the glass pair with ν = −0.99.
const PER_RINGING: RelativeError =
    RelativeError { restitution: 0.05, contact_time: 0.035, peak_force: 0.25 };

impl Effect for Vibration {
    fn relevance(&self, _: &Scene, estimate: &Estimate) -> Option<Relevance> {
        Some(Relevance {
            is_needed: estimate.effective_mach.max(estimate.effective_ringing) > QUASI_STATIC_LIMIT,
            number: match estimate.effective_ringing > estimate.effective_mach {
                true => "bulk waves are slow, Poisson's ratio is negative".to_string(),
                false => number(estimate),
            },
            ..Relevance::default()
        })
    }

    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        let slowness = slowness(scene, estimate);
        let ringing = estimate.effective_ringing;
        let lengths = NeglectError::shares(
            estimate,
            PER_DELAY.contact_time * slowness + PER_RINGING.contact_time * ringing,
            PER_DELAY.peak_force * slowness + PER_RINGING.peak_force * ringing,
        );
        let relaxed = 1.0 + OF_RELAXED * relaxed_loss(scene, estimate);
        let loss = loss_by_inertia(scene, estimate) + PER_RINGING.restitution * ringing;
        Some(NeglectError { restitution: Some((loss * relaxed).min(1.0)), ..lengths })
    }

    /// A result with too few modes advises more modes or explicit elements (`Vibration::warnings_of_speed`).
    fn adequacy(&self, model: &ConsideredModel) -> Adequacy {
        let advice = match model.own.model() {
            ModelChoice::Condensed(options) => {
                let is_few = Self::needs_modes(model.estimate, options.vibration_modes);
                let few = is_few.then_some("lacks vibration, which matters");
                Self::beyond_modes(model.estimate).or(few).map(str::to_string)
            }
            _ => None,
        };
        Adequacy { advice, ..model.with_or_without(self) }
    }

    /// The neglect error, with a margin on the loss.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> QuantityErrors {
        let Some(change) = status.neglect_error.filter(|_| status.is_lacking) else {
            return QuantityErrors::ZERO;
        };
        let margin = (MARGIN_OF_LOSS - 1.0) * loss_by_inertia(scene, estimate);
        let restitution = change.restitution.map(|loss| loss + margin);
        NeglectError { restitution, ..change }.of_all_quantities(estimate)
    }
}

impl Vibration {
    /// Returns the support of a model with a requested number of modes, and the numbers of modes that the mesh of each
    /// sphere resolves. Few modes do not resolve the inertia, and no modes resolve shocks.
    pub(crate) fn of_modes(
        estimate: &Estimate,
        n_asked: usize,
        spheres: &[(&str, usize)],
    ) -> Support {
        let reason = match n_asked {
            0 => format!("quasi-static: {}", number(estimate)),
            _ => {
                let count = |(name, n_modes): &(&str, usize)| format!("{n_modes} modes of {name}");
                spheres.iter().map(count).collect::<Vec<_>>().join(", ")
            }
        };
        let mut warnings = Self::warnings_of_speed(estimate, n_asked);
        let unresolved = spheres.iter().filter(|(_, n_modes)| *n_modes < n_asked);
        warnings.extend(unresolved.map(|(name, n_modes)| {
            format!(
                "the mesh of {name} resolves {n_modes} of the {n_asked} modes of vibration asked \
                 for, the others are left out: use a smaller mesh.contact_element_size for more"
            )
        }));
        Support::decided(n_asked > 0, reason).warning(warnings)
    }

    /// Returns the warnings of such a model about the speed.
    pub(crate) fn warnings_of_speed(estimate: &Estimate, n_asked: usize) -> Vec<String> {
        let mut warnings = Vec::new();
        // Modes help unless there are waves that they do not resolve.
        if Self::needs_modes(estimate, n_asked) && Self::beyond_modes(estimate).is_none() {
            warnings.push(format!(
                "{}, where the inertia of the bodies matters: set model.condensed.vibration_modes = \
                 {ENOUGH_MODES}, or use model fem",
                above(estimate, QUASI_STATIC_LIMIT)
            ));
        }
        if estimate.effective_ringing > QUASI_STATIC_LIMIT {
            warnings.push(format!(
                "Poisson's ratio is negative: bulk waves are slow and the body rings, which this model neglects: about {} of \
                 the restitution, {} of the contact time and {} of the peak force; use model fem",
                percent(PER_RINGING.restitution * estimate.effective_ringing),
                percent(PER_RINGING.contact_time * estimate.effective_ringing),
                percent(PER_RINGING.peak_force * estimate.effective_ringing)
            ));
        }
        if estimate.effective_mach > MACH_LIMIT {
            warnings.push(format!(
                "{}, where steep fronts form that no mode of vibration resolves: use model fem",
                above(estimate, MACH_LIMIT)
            ));
        }
        warnings
    }

    fn needs_modes(estimate: &Estimate, n_asked: usize) -> bool {
        estimate.effective_mach > QUASI_STATIC_LIMIT && n_asked < ENOUGH_MODES
    }

    /// Returns the models with elements that are suitable: condensed bodies only if modes resolve the inertia.
    pub(crate) fn models_that_serve(estimate: &Estimate) -> &'static str {
        match Self::beyond_modes(estimate) {
            Some(_) => "fem",
            None => "condensed or fem",
        }
    }

    /// Returns why no number of modes resolves the inertia, if none does.
    fn beyond_modes(estimate: &Estimate) -> Option<&'static str> {
        if estimate.effective_mach > MACH_LIMIT {
            return Some("steep fronts form that no mode resolves");
        }
        (estimate.effective_ringing > QUASI_STATIC_LIMIT)
            .then_some("bulk waves are too slow for few modes")
    }

    /// Returns the support of a model of rigid bodies with one degree of freedom.
    pub(crate) fn of_rigid_bodies(estimate: &Estimate) -> Support {
        let warning = (estimate.effective_mach > MACH_LIMIT).then(|| {
            format!(
                "{}, where the bodies vibrate, which this model neglects",
                above(estimate, MACH_LIMIT)
            )
        });
        Support::decided(false, "the bodies move as a whole: quasi-static contact").warning(warning)
    }
}

/// Returns the loss of restitution by inertia of bodies that do not relax.
fn loss_by_inertia(scene: &Scene, estimate: &Estimate) -> f64 {
    let mach = own_mach(scene, estimate);
    // Steep fronts increase the loss with the speed.
    (LOSS_PER_MACH * mach * (1.0 + mach)).max(PartnerWaves::left_ringing(scene, estimate))
}

/// Returns each moving body with its share of the approach speed, m*/m with the reduced mass m*.
fn parts<'a>(scene: &'a Scene, estimate: &'a Estimate) -> impl Iterator<Item = (&'a Body, f64)> {
    let reduced = estimate.hertz.pair().effective_mass();
    let part = move |body: &'a Body| Some((body, (reduced / body.mass()?).min(1.0)));
    scene.bodies().iter().filter_map(part)
}

/// Returns the mean speed of the bodies over their shear wave speeds, at most one each, in the frame of the mass centre and
/// weighted by their kinetic energies. Each of two like bodies has that of a wall impact at half the speed.
fn own_mach(scene: &Scene, estimate: &Estimate) -> f64 {
    let own = |(body, part): (&Body, f64)| {
        let waves = left_at(body.material()?, estimate.effective.after).shear_wave_speed();
        Some(part * (part * estimate.hertz.approach_speed() / waves).min(1.0))
    };
    parts(scene, estimate).filter_map(own).sum()
}

/// Returns the relative delay of the deformation behind the contact force. Modes of free vibration with frequencies ω and
/// masses m follow a force F of duration T with
///
/// ```math
/// q = \frac{F}{m\omega^2} - \frac{\ddot F}{m\omega^4} + \dots, \qquad
/// \frac{\Delta\delta}\delta \sim \sum_b \frac{m^*}{m_b}\Bigl(\frac{D_b}{c_{s,b}T}\Bigr)^4,
/// ```
///
/// since δ ~ F T²/m*, ω ~ c_s/D and F̈ ~ F/T². The first term is quasi-static. With Hertz' contact time the delay grows as
/// (v/c_s)^(4/5). Waves that do not return within the contact do not change it.
fn slowness(scene: &Scene, estimate: &Estimate) -> f64 {
    let effective = &estimate.effective;
    let of_body = |(body, part): (&Body, f64)| {
        let waves = left_at(body.material()?, effective.after).shear_wave_speed();
        let passage = body.diameter()? / (waves * effective.hertz.contact_time());
        Some(part * passage.min(1.0).powi(4))
    };
    parts(scene, estimate).filter_map(of_body).sum()
}
