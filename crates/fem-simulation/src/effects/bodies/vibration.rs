//! Inertia of the bodies' own deformation: elements have it, a quasi-static model has it as modes of
//! free vibration, or lacks it.
//!
//! Decided by the approach speed over the shear wave speed.

use fem_case::{Body, Scene};
use fem_collision::Collision;

use crate::effects::effect::neglect_error::NeglectError;
use crate::effects::effect::relevance::{MACH_LIMIT, QUASI_STATIC_LIMIT, above, number};
use crate::effects::effect::relevance::{Relevance, percent};
use crate::effects::effect::support::Support;
use crate::effects::effect::{Effect, PartnerWaves, Vibration};
use crate::effects::ting_prediction::relaxed_loss;
use crate::estimate::Estimate;
use crate::estimate::effective_modulus::left_at;

/// Number of modes per body that carry the inertia of its deformation.
pub(super) const ENOUGH_MODES: usize = 12;
/// Vibration energy over the initial relative kinetic energy that closed forms may leave out.
const LARGEST_VIBRATION: f64 = 0.01;

/// What it takes of the restitution at least, over the bodies' own speeds in shear wave speeds ([`own_mach`]): explicit
/// elements against quasi-static bodies lose 0.06 to 0.1 of it on a wall at 0.3 to 20 %, twice that at 40 %. A small ball
/// leaves more in a large one, which hardly moves ([`PartnerWaves::left_ringing`]).
const LOSS: f64 = 0.1;
/// By how much it lengthens the contact and lowers the peak force, over what a body deforms less than at rest
/// ([`slowness`]): elastic balls on a wall at 0.3 to 40 % of the shear wave speed and pairs at 1.5 to 18 %, explicit
/// elements or twelve modes against none, within a factor of 2.5.
const LENGTHENING: f64 = 2.2;
const WEAKENING: f64 = 5.0;
/// What relaxation takes of the restitution makes inertia take more of it, by so many times that: spheres that relax to
/// 0.1 to 3 % lose 0.0048, 0.0021, 0.0019 and 0.0023 of it between elements and none, where this has 0.0051, 0.0029, 0.0011
/// and 0.0022.
const OF_RELAXED: f64 = 2.0;
/// The same of bodies that ring because their bulk waves are slow, over [`Estimate::effective_ringing`]: of the glass pair with
/// ν = −0.99, elements against none.
const RINGING_LOSS: f64 = 0.05;
const RINGING_LENGTHENING: f64 = 0.035;
const RINGING_WEAKENING: f64 = 0.25;

impl Effect for Vibration {
    fn relevance(&self, _: &Scene, estimate: &Estimate) -> Option<Relevance> {
        Some(Relevance {
            is_called_for: estimate.effective_mach.max(estimate.effective_ringing)
                > QUASI_STATIC_LIMIT,
            number: match estimate.effective_ringing > estimate.effective_mach {
                true => "bulk waves are slow, Poisson's ratio is negative".to_string(),
                false => number(estimate),
            },
            ..Relevance::default()
        })
    }

    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        let mach = own_mach(scene, estimate);
        let slowness = slowness(scene, estimate);
        let ringing = estimate.effective_ringing;
        let lengths = NeglectError::shares(
            estimate,
            LENGTHENING * slowness + RINGING_LENGTHENING * ringing,
            WEAKENING * slowness + RINGING_WEAKENING * ringing,
        );
        let relaxed = 1.0 + OF_RELAXED * relaxed_loss(scene, estimate);
        // Fronts take more of it, the faster the more.
        let own = (LOSS * mach * (1.0 + mach)).max(PartnerWaves::left_ringing(scene, estimate));
        let loss = own + RINGING_LOSS * ringing;
        Some(NeglectError { restitution: Some(loss * relaxed), ..lengths })
    }

    fn warnings_of_result(
        &self,
        _: &Scene,
        estimate: &Estimate,
        collision: &Collision,
    ) -> Vec<String> {
        let hertz = &estimate.hertz;
        let initial = 0.5 * hertz.pair().effective_mass() * hertz.approach_speed().powi(2);
        // What is without a mass is without an end: its waves are gone.
        let left = collision.bodies.iter().filter(|body| body.mass.is_some());
        let left = left.filter_map(|body| body.vibration_energy);
        let share = left.sum::<f64>() / initial;
        let warning = (share > LARGEST_VIBRATION).then(|| {
            format!(
                "{:.1} % of the initial kinetic energy stays in vibrations of the bodies; closed \
                 forms know nothing of them",
                100.0 * share
            )
        });
        warning.into_iter().collect()
    }
}

impl Vibration {
    /// Returns the answer of a model with these numbers of modes, asked for and per sphere by name. With
    /// few modes it lacks inertia; shocks it always lacks.
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
        let mut warnings = Self::doubts_of_speed(estimate, n_asked);
        let unresolved = spheres.iter().filter(|(_, n_modes)| *n_modes < n_asked);
        warnings.extend(unresolved.map(|(name, n_modes)| {
            format!(
                "the mesh of {name} resolves {n_modes} of the {n_asked} modes of vibration asked \
                 for, the others are left out: use a smaller mesh.contact_element_size for more"
            )
        }));
        Support::is(n_asked > 0, reason).warning(warnings)
    }

    /// Returns what such a model leaves open because of the speed.
    pub(crate) fn doubts_of_speed(estimate: &Estimate, n_asked: usize) -> Vec<String> {
        let mut warnings = Vec::new();
        // Modes help only where nothing forms that they do not carry.
        if Self::needs_modes(estimate, n_asked) && Self::beyond_modes(estimate).is_none() {
            warnings.push(format!(
                "{} the inertia of the bodies counts: set model.condensed.vibration_modes = \
                 {ENOUGH_MODES}, or use model fem",
                above(estimate, QUASI_STATIC_LIMIT)
            ));
        }
        if estimate.effective_ringing > QUASI_STATIC_LIMIT {
            warnings.push(format!(
                "bulk waves are so slow in a body of negative Poisson's ratio that it rings, and the contact so \
                 short that few modes do not follow: about {} of the restitution, {} of the contact time and {} of the \
                 peak force; use model fem",
                percent(RINGING_LOSS * estimate.effective_ringing),
                percent(RINGING_LENGTHENING * estimate.effective_ringing),
                percent(RINGING_WEAKENING * estimate.effective_ringing)
            ));
        }
        if estimate.effective_mach > MACH_LIMIT {
            warnings.push(format!(
                "{} steep fronts form that no mode of vibration carries: use model fem",
                above(estimate, MACH_LIMIT)
            ));
        }
        warnings
    }

    fn needs_modes(estimate: &Estimate, n_asked: usize) -> bool {
        estimate.effective_mach > QUASI_STATIC_LIMIT && n_asked < ENOUGH_MODES
    }

    /// Why a result with so many modes would advise more of them, or explicit elements
    /// ([`Vibration::doubts_of_speed`]).
    pub(crate) fn advises_another(estimate: &Estimate, n_asked: usize) -> Option<&'static str> {
        let few = Self::needs_modes(estimate, n_asked).then_some("lacks vibration, which counts");
        Self::beyond_modes(estimate).or(few)
    }

    /// The models with elements that serve a scene: condensed bodies where modes carry what inertia does.
    pub(crate) fn models_that_serve(estimate: &Estimate) -> &'static str {
        match Self::beyond_modes(estimate) {
            Some(_) => "fem",
            None => "condensed or fem",
        }
    }

    /// Why no number of modes carries what inertia does in a scene, if none does.
    fn beyond_modes(estimate: &Estimate) -> Option<&'static str> {
        if estimate.effective_mach > MACH_LIMIT {
            return Some("steep fronts form that no mode carries");
        }
        (estimate.effective_ringing > QUASI_STATIC_LIMIT)
            .then_some("bulk waves are too slow for few modes")
    }

    /// Returns the answer of a model of rigid bodies with one degree of freedom.
    pub(crate) fn of_rigid_bodies(estimate: &Estimate) -> Support {
        let warning = (estimate.effective_mach > MACH_LIMIT).then(|| {
            format!(
                "{} the bodies vibrate, which this model leaves out",
                above(estimate, MACH_LIMIT)
            )
        });
        Support::is(false, "the bodies move as a whole: quasi-static contact").warning(warning)
    }
}

/// m*/m of each body that moves, m* the reduced mass: its part in the approach.
fn parts<'a>(scene: &'a Scene, estimate: &'a Estimate) -> impl Iterator<Item = (&'a Body, f64)> {
    let reduced = estimate.hertz.pair().effective_mass();
    let part = move |body: &'a Body| Some((body, (reduced / body.mass()?).min(1.0)));
    scene.bodies().iter().filter_map(part)
}

/// The speeds of the bodies in the frame of the mass centre over those of their shear waves, weighed by their kinetic
/// energies; a body is no faster than its waves. Like bodies meet as each would a wall at half the speed.
fn own_mach(scene: &Scene, estimate: &Estimate) -> f64 {
    let own = |(body, part): (&Body, f64)| {
        let waves = left_at(body.material()?, estimate.effective.after).shear_wave_speed();
        Some(part * (part * estimate.hertz.approach_speed() / waves).min(1.0))
    };
    parts(scene, estimate).filter_map(own).sum()
}

/// How much later than its contact force a body deforms: modes of free vibration of frequencies ω and masses m follow a
/// force F that lasts for T with
///
/// ```math
/// q = \frac{F}{m\omega^2} - \frac{\ddot F}{m\omega^4} + \dots, \qquad
/// \frac{\Delta\delta}\delta \sim \sum_b \frac{m^*}{m_b}\Bigl(\frac{D_b}{c_{s,b}T}\Bigr)^4,
/// ```
///
/// since δ ~ F T²/m*, ω ~ c_s/D and F̈ ~ F/T², the first term being that of bodies at rest. With Hertz' contact time it grows
/// as (v/c_s)^(4/5). Waves that do not come back within the contact do nothing to it.
fn slowness(scene: &Scene, estimate: &Estimate) -> f64 {
    let effective = &estimate.effective;
    let of_body = |(body, part): (&Body, f64)| {
        let waves = left_at(body.material()?, effective.after).shear_wave_speed();
        let passage = body.diameter()? / (waves * effective.hertz.contact_time());
        Some(part * passage.min(1.0).powi(4))
    };
    parts(scene, estimate).filter_map(of_body).sum()
}
