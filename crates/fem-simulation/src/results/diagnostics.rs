//! Collects the warnings before a run and those about its result, and phrases the ones about numbers, springs and the
//! contact force. Every other warning is phrased where its number is known:
//!
//! | warnings about | source |
//! |---|---|
//! | implausible numbers | `fem-case/src/scene/plausibility.rs` |
//! | the choice of the model | `models/auto.rs` |
//! | effects, before a run and in its result | `effects`, one file per effect |
//! | keys without effect, a tolerance out of reach | `plan/mod.rs`, `plan/contact_method.rs`, `models/condensed/effects.rs`, `models/reduced/effects.rs` |
//! | missed tolerances, too coarse meshes | `error/tolerance_warnings.rs` |
//! | a model's own run ([`Collision::warnings`]) | `fem-explicit/src/run/outcome.rs`, `fem-explicit/src/run/material_stability.rs`, `models/bouncing/report.rs` |
//! | frequencies at which moduli are not measured | `results/relaxation_band.rs` |
//! | snapshots that are left out | `results/snapshots.rs` |
//! | likely causes of an early stop | `results/stop_advice.rs` |

use fem_case::ModelChoice;
use fem_case::defaults::PENALTY_FACTOR;
use fem_case::engineering::show;
use fem_collision::{Collision, MAX_RESIDUAL, QuantityOfInterest, Stop};

use crate::effects::Vibration;
use crate::error::{
    ErrorEstimate, MAX_NOISE, MAX_PENETRATION, Overlap, early_pressure_warning,
    excess_of_restitution, is_unresolved, noise, overlap, tolerance_warning, unbalanced_energy,
    unresolved_warning, widest_contact,
};
use crate::estimate::{Regime, mach};
use crate::models::method::{Cost, ElementSetup};
use crate::models::{ModelCandidate, SelectedModel};
use crate::plan::Plan;
use crate::plan::contact_method::ContactNoiseAdvice;
use crate::plan::penalty_compliance::softness;
use crate::results::relaxation_band::band_warnings;
use crate::simulation::Simulation;

/// Safety factor on the advised stiffness of springs.
const ROOM_OF_ADVICE: f64 = 1.2;
/// Power of the overlap with which elements are shortened: the overlap falls with the power 0.85 of the element size.
const ELEMENT_SIZE_PER_OVERLAP: f64 = 1.2;
/// Distance of neighbouring atoms in solids (m), rounded down.
const SIZE_OF_ATOMS: f64 = 0.15e-9;
/// Seconds of a run from which a cheaper model is suggested.
const SECONDS_OF_LONG_RUN: f64 = 3.0;

impl Simulation {
    /// Returns the warnings before the run.
    pub fn warnings_before(&self) -> Vec<String> {
        let scene = self.case().scene();
        (scene.implausible_numbers().into_iter())
            .chain(self.shear_waves_warning())
            .chain(self.choice_warning())
            .chain(self.setup().warnings())
            .chain(band_warnings(scene, self.setup().estimate.contact_time))
            .chain(self.mesh_warning())
            .chain(self.springs_warning())
            .chain(self.cheaper_model_hint())
            .collect()
    }

    /// Returns all warnings about a collision: those before it, those of its result, and those of its model.
    pub fn warnings_with(&self, collision: &Collision, errors: &ErrorEstimate) -> Vec<String> {
        let scene = self.case().scene();
        let decisions = &errors.decisions;
        (scene.implausible_numbers().into_iter())
            .chain(self.choice_warning())
            .chain(decisions.warnings.iter().cloned())
            .chain(self.setup().unread_key_warnings.iter().cloned())
            .chain(diagnose(self, collision, errors))
            .chain(decisions.warnings_of_result.iter().cloned())
            .chain(band_warnings(scene, self.setup().estimate.contact_time))
            .chain(collision.warnings.iter().cloned())
            .collect()
    }

    /// Estimates the errors of a collision by reference runs, and returns all warnings about it.
    pub fn warnings(&self, collision: &Collision) -> Vec<String> {
        self.warnings_with(collision, &self.estimate_errors(collision))
    }

    /// Returns a warning that the mesh resolves the expected contact by too few elements.
    pub fn mesh_warning(&self) -> Option<String> {
        unresolved_warning(self, self.setup().estimate.contact_radius)
    }

    /// Returns a warning that explicit elements fold if the bodies meet faster than shear waves leave the contact.
    fn shear_waves_warning(&self) -> Option<String> {
        let scene = self.scene_of_model();
        let mach = mach(&scene, scene.approach_speed());
        (mach > 1.0 && *scene.model() == ModelChoice::Fem).then(|| {
            format!(
                "the approach speed is {mach:.1} times that of the shear waves, √(G/ρ): above 1 the flank of a body \
                 may fold onto the other one, which stops the run; lower body.N.approach_speed, or check the moduli \
                 and their units"
            )
        })
    }

    /// Returns a warning that soft penalty springs lengthen the contact.
    fn springs_warning(&self) -> Option<String> {
        let elements = self.setup().elements.as_ref().filter(|elements| elements.has_springs)?;
        let longer = softness(&elements.plan)?;
        (longer > self.case().scene().accuracy().contact_time).then(|| {
            format!(
                "contact.penalty_factor = {} makes the springs so soft that the contact lasts about {:.0} % longer; leave \
                 contact.penalty_factor out",
                elements.plan.penalty_factor,
                100.0 * longer
            )
        })
    }

    /// Suggests the condensed model for a long run, if it is expected to meet the tolerance too.
    pub fn cheaper_model_hint(&self) -> Option<String> {
        let Cost::Steps { seconds, .. } = self.setup().cost else { return None };
        let scene = self.case().scene();
        if seconds < SECONDS_OF_LONG_RUN || *scene.model() != ModelChoice::Fem {
            return None;
        }
        let scene = scene.clone().with_model(ModelChoice::Auto);
        let estimate = self.setup().estimate.clone();
        let open = SelectedModel::of(Regime { scene, estimate }).ok()?;
        // Condensed bodies have fields to draw, as explicit elements do.
        let serves = |it: &&ModelCandidate| {
            it.model.starts_with("condensed")
                && (it.chosen || it.reason.starts_with("within the tolerance"))
        };
        let other = open.considered.iter().find(serves).filter(|_| open.warning.is_none())?;
        Some(format!(
            "the run takes about {}; model.{} is also expected to be within the tolerance of the case and takes \
             hundredths of a second",
            show(seconds, "s"),
            other.model
        ))
    }
}

/// Returns warnings about a finished collision: impossible numbers, and errors of the elements above the tolerance.
pub fn diagnose(
    simulation: &Simulation,
    collision: &Collision,
    errors: &ErrorEstimate,
) -> Vec<String> {
    let mut warnings = of_numbers(simulation, collision);
    warnings.extend(of_elements(simulation, collision, errors));
    warnings
}

/// Returns warnings about errors of the elements, one per cause.
fn of_elements(
    simulation: &Simulation,
    collision: &Collision,
    errors: &ErrorEstimate,
) -> Vec<String> {
    let Some(elements) = &simulation.setup().elements else { return Vec::new() };
    let coarse = widest_contact(simulation, collision)
        .and_then(|radius| unresolved_warning(simulation, radius));
    let is_unresolved = is_unresolved(simulation, collision);
    let is_soft = elements.plan.has_soft_springs();
    // On a coarse mesh the mesh is the cause of overlap, unless the springs are soft.
    let is_of_mesh = is_unresolved || (coarse.is_some() && !is_soft);
    let overlap = overlap(simulation, collision).filter(|_| !is_of_mesh);
    let penetration = overlap.and_then(|overlap| penetration(collision, &elements.plan, &overlap));
    let is_estimated = errors.discretisation(QuantityOfInterest::PeakForce).is_some();
    let mesh = match (is_unresolved, penetration.is_some()) {
        (true, _) => coarse,
        (false, true) => None,
        (false, false) => {
            tolerance_warning(simulation, collision, errors).or(coarse.filter(|_| !is_estimated))
        }
    };
    let early = early_pressure_warning(simulation, collision).filter(|_| !is_unresolved);
    [mesh, penetration, scatter(collision, elements), early].into_iter().flatten().collect()
}

/// Returns the warnings that apply to every model.
fn of_numbers(simulation: &Simulation, collision: &Collision) -> Vec<String> {
    let remedy = match &simulation.setup().elements {
        Some(elements) => elements.noise_advice.advice_on_energy(),
        None => {
            format!("use model {}", Vibration::models_that_serve(&simulation.setup().estimate))
        }
    };
    let incomplete = collision
        .stop()
        .map(|stop| format!("the run stopped early: {stop}; peak values are those up to then"));
    let balance = energy_residual(collision, &remedy);
    [incomplete, balance, restitution(collision), atomic(collision)].into_iter().flatten().collect()
}

/// Returns a warning about the energy residual, unless it has stopped the run: the stop has its own remedy.
fn energy_residual(collision: &Collision, remedy: &str) -> Option<String> {
    use Stop::{EnergyGrowth, EnergyImbalance, NoNumber, StabilityLost};
    if let Some(
        EnergyGrowth { .. } | EnergyImbalance { .. } | NoNumber { .. } | StabilityLost { .. },
    ) = collision.stop()
    {
        return None;
    }
    let residual = unbalanced_energy(collision)?;
    Some(format!(
        "the energy balance has an error of {residual:.1e} of the initial energy{} (limit {MAX_RESIDUAL:e}); {remedy}",
        collision.residual_since.map_or(String::new(), |since| format!(" since {since}"))
    ))
}

fn restitution(collision: &Collision) -> Option<String> {
    excess_of_restitution(collision)?;
    let restitution = collision.restitution?;
    Some(format!("the restitution {restitution:.6} is above 1: the numerical error is visible"))
}

/// Returns a warning that bodies approach by less than an atom.
fn atomic(collision: &Collision) -> Option<String> {
    let approach = collision.max_approach.filter(|approach| *approach < SIZE_OF_ATOMS)?;
    Some(format!(
        "the largest approach is {}, less than the size of atoms: surfaces are no smooth continua at this scale",
        show(approach, "m")
    ))
}

/// Returns a warning that the surfaces overlap too much.
fn penetration(collision: &Collision, plan: &Plan, overlap: &Overlap) -> Option<String> {
    let excess = overlap.of_approach / MAX_PENETRATION;
    let factor = ROOM_OF_ADVICE * excess.powf(1.5) * plan.penalty_factor;
    let size = plan.contact_element_size / (ROOM_OF_ADVICE * excess.powf(ELEMENT_SIZE_PER_OVERLAP));
    let shorter = match plan.makes_meshes {
        // The springs are the cause, and not the mesh.
        _ if plan.has_soft_springs() => String::new(),
        true => format!(", or use a mesh.contact_element_size of {} or less", show(size, "m")),
        false => ", or use meshes that are finer at the contact".to_string(),
    };
    let deepest =
        collision.deepest_overlap.map_or(String::new(), |deepest| format!(", deepest {deepest}"));
    (excess > 1.0).then(|| {
        format!(
            "the surfaces overlap by about {:.1} % of the approach and {:.1} % of an element{deepest} (limit {} % of the \
             approach); write contact.penalty_factor = {}{shorter}",
            100.0 * overlap.of_approach,
            100.0 * overlap.of_element,
            100.0 * MAX_PENETRATION,
            two_digits(factor.max(PENALTY_FACTOR)),
        )
    })
}

/// Returns a warning that the contact force scatters too much.
fn scatter(collision: &Collision, elements: &ElementSetup) -> Option<String> {
    // The staircase of a contact that flows is part of a good run.
    let is_staircase = matches!(elements.noise_advice, ContactNoiseAdvice::FinerElements { .. });
    let limit = if is_staircase { 2.0 * MAX_NOISE } else { MAX_NOISE };
    Some(format!(
        "the contact force scatters by {:.1} % of its peak{} (limit {} %), so peaks are too high; {}",
        100.0 * noise(collision).filter(|noise| *noise > limit)?,
        collision.noisiest_instant.map_or(String::new(), |at| format!(", most about {at}")),
        100.0 * limit,
        elements.noise_advice.advice()
    ))
}

/// Rounds a positive number up to two digits.
fn two_digits(value: f64) -> f64 {
    let step = 10.0_f64.powf(value.log10().floor() - 1.0);
    // Printing and parsing gives the nearest decimal number.
    format!("{:.1e}", (value / step).ceil() * step).parse().unwrap_or(value)
}
