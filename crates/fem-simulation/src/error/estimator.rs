//! The estimator of the discretisation error: safety factor × distance from the Richardson limit + noise floor.

use fem_case::Spot;
use fem_collision::{Bounce, Collision, QuantityOfInterest};

use super::calibration::{CLOSED_FORM, Calibration, EXPLICIT, Reference, SAMPLED_PER_TOLERANCE};
use super::estimate::{BarParts, ErrorEstimate};
use super::noise_floor::{contact_element_size, floor_of_run, is_unresolved, moved_share};
use super::reference_runs::{EstimatedCollision, ReferenceRuns, Values};
use super::stress_error::{ContactStress, StressError};
use crate::effects::FiniteStrain;
use crate::models::bouncing::element_sizes;
use crate::models::explicit::cost::needs_own_reference;
use crate::models::method::Cost;
use crate::quantity_errors::QuantityErrors;
use crate::simulation::Simulation;

/// Number of contacts of a bouncing ball that have error bars.
const MAX_BARS_OF_BOUNCES: usize = 10;

/// Estimates the errors of the collisions of a case on the planned mesh and on refined ones, and keeps the reference runs
/// that it has computed.
///
/// ```
/// use fem_case::schema::{BodyTable, MaterialTable};
/// use fem_case::{Case, CaseFile};
/// use fem_collision::QuantityOfInterest;
/// use fem_simulation::Simulation;
/// use fem_simulation::error::ErrorEstimator;
///
/// let ice = MaterialTable::from_youngs_modulus_poissons_ratio("917 kg/m^3", "9.3 GPa", 0.33);
/// let ball = BodyTable::sphere("ball", "2 cm", "ice").approaching("0.2 m/s");
/// let file = CaseFile::of_bodies(ball, BodyTable::wall("floor")).with_material("ice", ice);
/// let simulation = Simulation::new(Case::of(file)?)?;
/// let collision = simulation.run(&mut ());
/// let errors = ErrorEstimator::default().estimate(&simulation, &collision);
/// let error = errors.discretisation(QuantityOfInterest::ContactTime).unwrap();
/// assert!(error < 0.01 * collision.contact_time.unwrap());
/// # Ok::<(), fem_case::CaseError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct ErrorEstimator {
    pub(super) runs: ReferenceRuns,
}

impl ErrorEstimator {
    /// Estimates the discretisation error.
    pub(super) fn bars(&mut self, simulation: &Simulation, collision: &Collision) -> ErrorEstimate {
        use fem_case::ModelChoice::{Auto, Condensed, Fem, Hertz, Law, Ting};
        let mut parts = [None; 6];
        let bars = match *simulation.scene_of_model().model() {
            Fem | Condensed(_) => {
                parts = self.of_elements(simulation, collision);
                summed(simulation, collision, &parts)
            }
            Hertz { .. } => of_tolerance(collision, CLOSED_FORM),
            Ting { tolerance, .. } | Law { tolerance, .. } => of_tolerance(collision, tolerance),
            // Its choice is one of the others.
            Auto => QuantityErrors::default(),
        };
        let element_updates = self.runs.element_updates();
        ErrorEstimate { bars, parts, element_updates, ..ErrorEstimate::default() }
    }

    /// Estimates the errors of a model with elements; all `None` if the collision did not end by itself.
    fn of_elements(
        &mut self,
        simulation: &Simulation,
        collision: &Collision,
    ) -> [Option<BarParts>; 6] {
        match contact_element_size(simulation, collision) {
            Some(size) => self.of_size(simulation, collision, size),
            None => [None; 6],
        }
    }

    /// Returns the discretisation errors of the restitutions of the contacts of a bouncing ball: each has reference runs at its own speed
    /// with its own elements, and the noise of the first contact.
    pub(super) fn of_bounces(
        &mut self,
        simulation: &Simulation,
        collision: &Collision,
        first: &ErrorEstimate,
    ) -> Vec<Option<f64>> {
        let restitution = QuantityOfInterest::Restitution;
        let scene = simulation.scene_of_model();
        let bounces = &collision.bounces[..collision.bounces.len().min(MAX_BARS_OF_BOUNCES)];
        let stays = scene.gravity().is_some_and(|gravity| gravity.spot == Some(Spot::Same));
        let is_dented = stays && simulation.setup().estimate.flow.is_some();
        // On its dent a contact is elastic and wider than the first, so its error is smaller: 1e-4 in place of 6e-3 of steel on aluminium.
        let needs_own = bounces.len() > 1 && !is_dented;
        let Some(elements) = simulation.setup().elements.as_ref().filter(|_| needs_own) else {
            return vec![first.discretisation(restitution); bounces.len()];
        };
        let Some(size) = contact_element_size(simulation, collision) else {
            return vec![None; bounces.len()];
        };
        let speeds = bounces.iter().map(|bounce| bounce.speed_before);
        let sizes = element_sizes(&scene, &elements.plan, size, speeds);
        let floor = floor_of_run(simulation, collision)(restitution);
        let later = |(bounce, size): (&Bounce, Option<f64>)| {
            let contact = bounce.collision()?;
            let radius = simulation.estimate(&contact.approach)?.contact_radius;
            let contact = Collision {
                max_contact_radius: Some(radius),
                element_updates: collision.element_updates,
                ..contact
            };
            let parts = self.of_size(simulation, &contact, size?)[restitution as usize]?;
            Some(parts.sum().max(floor))
        };
        let first = first.discretisation(restitution);
        let later = bounces.iter().zip(sizes).skip(1).map(later);
        [first].into_iter().chain(later).take(bounces.len()).collect()
    }

    /// Estimates the errors of a collision with elements of a size, m, at the contact.
    fn of_size(
        &mut self,
        simulation: &Simulation,
        collision: &Collision,
        size: f64,
    ) -> [Option<BarParts>; 6] {
        let values = QuantityOfInterest::ALL.map(|quantity| quantity.of(collision));
        let widest = collision.max_contact_radius.unwrap_or(0.0) / size;
        let at_pressure = collision.peak_pressure_radius.map_or(widest, |radius| radius / size);
        let estimated = self.reference_error(simulation, collision, size, values, widest);
        let Some((errors, calibration)) = estimated else { return [None; 6] };
        let shares = Shares {
            relaxed: simulation
                .estimate(&collision.approach)
                .map_or(0.0, |estimate| estimate.relaxed),
            moved: moved_share(simulation, collision),
        };
        bar_parts(errors, calibration, [widest, at_pressure], shares)
    }

    /// Returns the distances from the Richardson limits of the reference runs, the restitution's absolute, all others
    /// relative, and the constants for this kind of reference run.
    fn reference_error(
        &mut self,
        simulation: &Simulation,
        collision: &Collision,
        size: f64,
        values: Values,
        across: f64,
    ) -> Option<(Values, &'static Calibration)> {
        let plan = &simulation.setup().elements.as_ref()?.plan;
        let subject = &EstimatedCollision { simulation, approach: collision.approach, plan, size };
        let is_explicit = collision.element_updates.is_some();
        let needs_own = is_explicit && needs_own(simulation, collision);
        let calibration = Calibration::of(&plan.estimate, is_explicit, needs_own);
        if !plan.makes_meshes {
            let known = (!is_explicit).then_some(values);
            let errors = (!needs_own).then(|| self.runs.mesh_file(subject, known, across))??;
            return Some((errors, calibration));
        }
        let mut against = calibration.against.iter().map(|reference| match reference {
            Reference::Condensed => self.runs.condensed(subject).map(|(errors, _)| errors),
            Reference::Coarser => self.runs.coarser(subject, values),
        });
        let mut errors = against.next()??;
        for more in against.flatten() {
            errors = std::array::from_fn(|k| Some(errors[k]? + more[k].unwrap_or(0.0)));
        }
        Some((errors, calibration))
    }

    /// Returns the error of the recovered stress near the contact; `None` without a snapshot of the largest approach.
    pub(super) fn stress_error(
        &mut self,
        simulation: &Simulation,
        collision: &Collision,
    ) -> Option<StressError> {
        let size = contact_element_size(simulation, collision)?;
        let stress = ContactStress::of(simulation, collision)?;
        let plan = &simulation.setup().elements.as_ref()?.plan;
        let subject = &EstimatedCollision { simulation, approach: collision.approach, plan, size };
        let is_explicit = collision.element_updates.is_some();
        match plan.makes_meshes && (!is_explicit || needs_own(simulation, collision)) {
            true => self.runs.stress_of_coarser(subject, &stress),
            false => self.runs.stress_of_condensed(subject, &stress),
        }
    }

    /// Estimates the errors of explicit elements before the collision, the restitution's absolute, all others relative;
    /// `None` if only the collision itself shows them.
    pub(super) fn before_run(&mut self, simulation: &Simulation) -> Option<[Option<BarParts>; 6]> {
        let setup = simulation.setup();
        let Cost::Steps { .. } = setup.cost else { return None };
        let elements = setup.elements.as_ref()?;
        let is_finite = setup.decisions.is_active(FiniteStrain::NAME);
        if !elements.plan.makes_meshes || needs_own_reference(&setup.estimate, is_finite) {
            return None;
        }
        let subject = EstimatedCollision::planned(simulation)?;
        let (errors, values) = self.runs.condensed(&subject)?;
        let across = values[QuantityOfInterest::MaxContactRadius as usize]? / subject.size;
        let shares = Shares { relaxed: setup.estimate.relaxed, moved: elements.moved_share };
        Some(bar_parts(errors, &EXPLICIT, [across; 2], shares))
    }

    /// Returns the element updates of a collision over those that closed forms expect, from a coarser run; 1 if closed
    /// forms are sufficient.
    pub fn updates_over_expected(&mut self, simulation: &Simulation) -> f64 {
        /// Element updates of the coarser run, a tenth of a second.
        const ELEMENT_UPDATES_OF_COARSER_RUN: u64 = 4_000_000;
        let is_open = simulation.reference_updates().is_some()
            && simulation.case().scene().gravity().is_none();
        let subject = EstimatedCollision::planned(simulation).filter(|_| is_open);
        let ratio = subject.and_then(|subject| {
            self.runs.updates_over_expected(&subject, ELEMENT_UPDATES_OF_COARSER_RUN)
        });
        ratio.unwrap_or(1.0)
    }

    /// Returns the bytes that the collision takes, and those of condensed reference runs that are still to be computed;
    /// `None` for models without elements.
    pub fn memory_ahead(&self, simulation: &Simulation) -> Option<(u64, Option<u64>)> {
        let setup = simulation.setup();
        match setup.cost {
            Cost::Steps { memory, reference_memory, .. } => {
                let is_known = self.runs.has_condensed(&setup.approach);
                Some((memory, reference_memory.filter(|_| !is_known)))
            }
            Cost::Factors { memory, .. } => Some((memory, None)),
            Cost::ClosedForm { .. } => None,
        }
    }
}

/// Returns whether the error of explicit elements needs a reference run of explicit elements.
fn needs_own(simulation: &Simulation, collision: &Collision) -> bool {
    let is_finite = || simulation.decisions(collision).is_active(FiniteStrain::NAME);
    let estimate = simulation.estimate(&collision.approach);
    estimate.is_none_or(|estimate| needs_own_reference(&estimate, is_finite()))
}

/// The shares in proportion to which floors of the bars grow.
#[derive(Clone, Copy)]
struct Shares {
    /// Share of the modulus that is lost within one contact time.
    relaxed: f64,
    /// Share of the mass that is moved for a longer time step.
    moved: f64,
}

/// Returns the parts of all bars.
fn bar_parts(
    errors: Values,
    calibration: &Calibration,
    [widest, at_pressure]: [f64; 2],
    shares: Shares,
) -> [Option<BarParts>; 6] {
    QuantityOfInterest::ALL.map(|quantity| {
        let is_pressure = quantity == QuantityOfInterest::PeakPressure;
        let across = if is_pressure { at_pressure } else { widest };
        let k = quantity as usize;
        let edge = calibration.edge[k] + calibration.edge_of_relaxed[k] * shares.relaxed;
        Some(BarParts {
            constants: calibration.name,
            reference_error: errors[k]?,
            safety_factor: calibration.safety_factor[k],
            across,
            edge: edge / across.max(1.0).powi(calibration.edge_power),
            scatter: calibration.scatter[k],
            moved_mass: calibration.moved_mass[k] * shares.moved,
        })
    })
}

/// Returns error bars, SI: the sum of their parts, and no less than the floor that the run itself shows.
fn summed(
    simulation: &Simulation,
    collision: &Collision,
    parts: &[Option<BarParts>; 6],
) -> QuantityErrors {
    // Coarser runs of unresolved contacts may not come to an end.
    let is_unresolved = is_unresolved(simulation, collision);
    let floor = floor_of_run(simulation, collision);
    QuantityErrors::from_fn(|quantity| {
        let estimated = parts[quantity as usize].map(|parts| parts.sum());
        let bar = estimated.or(is_unresolved.then_some(0.0))?.max(floor(quantity));
        quantity.of(collision).map(|value| bar * quantity.scale(value))
    })
}

/// Returns the errors of a model without elements, from its tolerance.
fn of_tolerance(collision: &Collision, tolerance: f64) -> QuantityErrors {
    QuantityErrors::from_fn(|quantity| {
        let share = match quantity {
            QuantityOfInterest::Restitution
            | QuantityOfInterest::ContactTime
            | QuantityOfInterest::PeakForce => tolerance,
            _ => SAMPLED_PER_TOLERANCE * tolerance,
        };
        quantity.of(collision).map(|value| share * quantity.scale(value))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bar is F_s |Δ| + (c + c′ relaxed) (h/a)² + scatter + moved mass, and the pressure's floor depends on its own radius.
    #[test]
    fn error_bar_is_the_sum_of_its_documented_parts() {
        let calibration = Calibration {
            name: "",
            against: &[],
            safety_factor: [2.0; 6],
            edge: [0.16; 6],
            edge_of_relaxed: [0.32; 6],
            edge_power: 2,
            scatter: [5e-4; 6],
            moved_mass: [0.3; 6],
        };
        let shares = Shares { relaxed: 0.5, moved: 0.01 };
        let parts = bar_parts([Some(1e-3); 6], &calibration, [4.0, 2.0], shares);
        for (k, parts) in parts.into_iter().enumerate() {
            let edge = if k == QuantityOfInterest::PeakPressure as usize { 0.08 } else { 0.02 };
            let expected = 2e-3 + edge + 5e-4 + 0.01 * 0.3;
            assert!((parts.unwrap().sum() - expected).abs() < 1e-12, "{k}");
        }
        let mut errors = [Some(0.0); 6];
        errors[1] = None;
        assert_eq!(bar_parts(errors, &calibration, [4.0; 2], shares)[1], None);
    }
}
