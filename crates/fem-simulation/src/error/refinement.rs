//! Adaptive refinement: the mesh is refined until the estimated errors are within the tolerance of the case.
//!
//! The a-priori mesh rule chooses elements from closed forms ([`crate::Plan`]). If an estimated error exceeds the
//! tolerance and the case leaves the element size open, the elements are made smaller by
//!
//! ```math
//! \frac{h}{h'} = \Bigl(1.1\,\max_q \frac{|\Delta q|}{\tau_q}\Bigr)^{2/3}, \qquad 1.25 \le \frac h{h'} \le 2,
//! ```
//!
//! between the first order of bulk viscosity and the second order of elements, and the collision is computed again. The
//! ratio is 2 at once if condensed reference runs, which show the error before the collision, find a smaller one
//! insufficient. There are at most [`MAX_LEVELS`] finer meshes, each of at most [`MAX_UPDATES`] element updates or
//! `limits.element_updates`. No mesh is refined for errors of other settings of the case (moved mass, soft springs, a
//! coarse mesh away from the contact). A warning gives the reason why a mesh stays. Every decision follows from numbers
//! of the case and of its runs, so it is the same on all machines.

use std::convert::Infallible;

use fem_case::defaults::PENALTY_FACTOR;
use fem_case::{Body, Case, CaseError, Shape};
use fem_collision::{Collision, Monitor, QuantityOfInterest};
use fem_material::engineering::Unit;

use super::calibration::MOVED_MASS;
use super::elastic_null::elastic_null;
use super::estimate::{BarParts, ErrorEstimate, FaultySetting, NotRefined};
use super::estimator::ErrorEstimator;
use super::noise_floor::of_chatter;
use super::reference_runs::EstimatedCollision;
use super::tolerance_check::{ToleranceMiss, missed, misses};
use crate::models::method::Cost;
use crate::models::stepper::RefinementLevel;
use crate::simulation::Simulation;

/// Safety factor on the estimated error.
const SAFETY_FACTOR: f64 = 1.1;
/// Power of the element size with which errors are expected to fall.
const EXPECTED_ORDER: f64 = 1.5;
/// Least and largest ratio of element sizes of one refinement.
pub(super) const REFINEMENT_RATIOS: [f64; 2] = [1.25, 2.0];
/// Largest number of finer meshes.
pub(super) const MAX_LEVELS: usize = 4;
/// Most element updates of a finer mesh if the case gives no limit, which take some seconds.
pub(super) const MAX_UPDATES: u64 = 150_000_000;
/// Most elements of a finer mesh of condensed bodies, which take a second.
pub(super) const MAX_ELEMENTS: u64 = 60_000;

/// Computes the collision of a case with its model, within its tolerance.
///
/// # Errors
/// A case that the model rejects, with the place in the case.
///
/// ```
/// use fem_case::schema::{BodyTable, MaterialTable, ModelTable};
/// use fem_case::{Case, CaseFile};
///
/// let steel = MaterialTable::from_youngs_modulus_poissons_ratio("7850 kg/m^3", "210 GPa", 0.3);
/// let ball = BodyTable::sphere("ball", "1 cm", "steel").approaching("1 m/s");
/// let case = Case::of(
///     CaseFile::of_bodies(ball, BodyTable::wall("floor"))
///         .with_material("steel", steel)
///         .with_model(ModelTable::hertz()),
/// )?;
/// let collision = fem_simulation::collide(&case)?;
/// assert_eq!(collision.restitution, Some(1.0));
/// // T = 2.943 δ / v with the largest approach δ = (15 m v² / (16 E* √R))^(2/5), at 1 m/s.
/// let (mass, modulus, radius) = (4.110e-3, 230.8e9, 5e-3_f64);
/// let hertz = 2.943 * (15.0 * mass / (16.0 * modulus * radius.sqrt())).powf(0.4);
/// assert!((collision.contact_time.unwrap() / hertz - 1.0).abs() < 1e-3);
/// # Ok::<(), fem_case::CaseError>(())
/// ```
pub fn collide(case: &Case) -> Result<Collision, CaseError> {
    Ok(Simulation::new(case.clone())?.run_within_tolerance(&mut ()).collision)
}

/// A simulation on the mesh that its tolerance needs, as far as that is known before the run.
#[derive(Debug)]
pub struct RefinedBeforeRun {
    /// The case on that mesh.
    pub simulation: Simulation,
    /// Whether the run itself may still show that a finer mesh is needed.
    pub is_open: bool,
}

/// A collision within the tolerance of its case, as far as a mesh can meet it.
#[derive(Debug)]
pub struct ComputedCollision {
    /// The simulation with the last mesh.
    pub simulation: Simulation,
    /// Result of the simulation.
    pub collision: Collision,
    /// Estimated errors of the result.
    pub errors: ErrorEstimate,
}

impl Simulation {
    /// Computes the collision, on finer meshes until its tolerance is met, and estimates its errors.
    pub fn run_within_tolerance(self, monitor: &mut dyn Monitor) -> ComputedCollision {
        let mut estimator = ErrorEstimator::default();
        let simulation = estimator.refine_before_run(self, || true).simulation;
        let compute = |_: &mut ErrorEstimator, simulation: &Self| {
            Ok::<_, Infallible>(simulation.run(monitor))
        };
        match estimator.within_tolerance(simulation, compute) {
            Ok(computed) => computed,
            Err(never) => match never {},
        }
    }

    /// Estimates the errors of a collision by reference runs.
    pub fn estimate_errors(&self, collision: &Collision) -> ErrorEstimate {
        ErrorEstimator::default().estimate(self, collision)
    }

    /// Returns why the mesh was refined last, for the terminal.
    pub fn refined_because(&self) -> Option<String> {
        let level = self.levels().last()?;
        let quantity = QuantityOfInterest::ALL.into_iter().find(|it| it.key() == level.quantity)?;
        let (error, tolerance) = (level.error, level.tolerance);
        let miss = ToleranceMiss { quantity, error, tolerance, scatter: 0.0 };
        let size = self.setup().elements.as_ref()?.plan.contact_element_size;
        // The collision was not computed on the coarser mesh.
        let is_before_run =
            level.element_updates.is_none() && matches!(self.setup().cost, Cost::Steps { .. });
        Some(format!(
            "{}: {}elements of {} in place of {}",
            miss.described(),
            if is_before_run { "" } else { "again with " },
            length(size),
            length(level.contact_element_size_m)
        ))
    }
}

impl ErrorEstimator {
    /// Estimates the errors of a collision.
    pub fn estimate(&mut self, simulation: &Simulation, collision: &Collision) -> ErrorEstimate {
        let mut estimate = self.bars(simulation, collision);
        estimate.not_refined = self.refined(simulation, collision, &estimate).err();
        self.with_final_costs(simulation, collision, estimate)
    }

    /// Adds the elastic null, the decisions and the cost of all reference runs, which belong to the final mesh.
    fn with_final_costs(
        &mut self,
        simulation: &Simulation,
        collision: &Collision,
        estimate: ErrorEstimate,
    ) -> ErrorEstimate {
        let elastic_null = elastic_null(simulation, collision, &mut self.runs);
        let stress_error = self.stress_error(simulation, collision);
        ErrorEstimate {
            of_bounces: self.of_bounces(simulation, collision, &estimate),
            elastic_null,
            stress_error,
            decisions: simulation.decisions(collision),
            element_updates: self.runs.element_updates(),
            ..estimate
        }
    }

    /// Refines the mesh before the run as far as condensed reference runs show its error, while `goes_on` returns true.
    pub fn refine_before_run(
        &mut self,
        simulation: Simulation,
        mut goes_on: impl FnMut() -> bool,
    ) -> RefinedBeforeRun {
        let mut simulation = simulation;
        loop {
            if !may_be_refined(&simulation) {
                return RefinedBeforeRun { simulation, is_open: false };
            }
            let Some(miss) = goes_on().then(|| self.expected_miss(&simulation)).flatten() else {
                let is_open = simulation.setup().elements.is_some();
                return RefinedBeforeRun { simulation, is_open };
            };
            match miss.map(|miss| self.finer(&simulation, &miss, None)) {
                Some(Ok(finer)) => simulation = finer,
                _ => return RefinedBeforeRun { simulation, is_open: false },
            }
        }
    }

    /// Computes the collision on finer meshes until the tolerance is met, and estimates its errors. If the collision fails
    /// on a finer mesh, the result on the mesh before counts.
    ///
    /// # Errors
    /// Those of `compute`.
    pub fn within_tolerance<E>(
        &mut self,
        simulation: Simulation,
        mut compute: impl FnMut(&mut Self, &Simulation) -> Result<Collision, E>,
    ) -> Result<ComputedCollision, E> {
        let mut collision = compute(self, &simulation)?;
        let mut simulation = simulation;
        let errors = loop {
            let mut errors = self.bars(&simulation, &collision);
            match self.refined(&simulation, &collision, &errors) {
                Ok(Some(finer)) => {
                    let next = compute(self, &finer)?;
                    if let Some(stop) = next.stop().filter(|_| !next.is_interrupted()) {
                        errors.not_refined = Some(NotRefined::Stopped(stop.to_string()));
                        break errors;
                    }
                    (simulation, collision) = (finer, next);
                }
                Ok(None) => break errors,
                Err(reason) => {
                    errors.not_refined = Some(reason);
                    break errors;
                }
            }
        };
        let errors = self.with_final_costs(&simulation, &collision, errors);
        Ok(ComputedCollision { simulation, collision, errors })
    }

    /// Returns the case on a finer mesh if a tolerance is missed, or the reason why there is none.
    pub(super) fn refined(
        &mut self,
        simulation: &Simulation,
        collision: &Collision,
        errors: &ErrorEstimate,
    ) -> Result<Option<Simulation>, NotRefined> {
        let missed = missed(simulation, collision, errors);
        missed.first().map(|miss| self.finer(simulation, miss, Some(collision))).transpose()
    }

    /// Returns the largest miss that condensed reference runs expect: `None` if only the collision shows the error,
    /// `Some(None)` if the tolerance is met.
    fn expected_miss(&mut self, simulation: &Simulation) -> Option<Option<ToleranceMiss>> {
        let bars = self.before_run(simulation)?;
        let error = |quantity| {
            let parts: &BarParts = bars[quantity as usize].as_ref()?;
            Some((parts.sum(), parts.scatter))
        };
        Some(misses(simulation, error).into_iter().next())
    }

    /// Returns the case on a finer mesh, or the reason why there is none; `met` is the collision on the present mesh,
    /// `None` before the run.
    fn finer(
        &mut self,
        simulation: &Simulation,
        miss: &ToleranceMiss,
        met: Option<&Collision>,
    ) -> Result<Simulation, NotRefined> {
        let scene = simulation.case().scene();
        let elements = simulation.setup().elements.as_ref().ok_or(NotRefined::Given)?;
        let is_other = |collision: &Collision| collision.approach != simulation.setup().approach;
        match self.faulty_setting(simulation, miss, met) {
            Some(setting) => return Err(NotRefined::Setting(setting)),
            _ if !miss.is_of_mesh() => return Err(NotRefined::Scatter(miss.scatter)),
            _ if has_mesh_file(simulation) => return Err(NotRefined::FromFile),
            _ if scene.mesh().contact_element_size.is_some() => return Err(NotRefined::Given),
            _ if scene.gravity().is_some() || met.is_some_and(is_other) => {
                return Err(NotRefined::Gravity);
            }
            _ if simulation.levels().len() >= MAX_LEVELS => {
                return Err(NotRefined::TooExpensive { updates: None });
            }
            _ => {}
        }
        let by = refinement_ratio(miss.excess_of_mesh())
            .clamp(REFINEMENT_RATIOS[0], REFINEMENT_RATIOS[1]);
        let level = RefinementLevel {
            contact_element_size_m: elements.plan.contact_element_size,
            element_updates: met.and_then(|collision| collision.element_updates),
            quantity: miss.quantity.key().to_string(),
            error: miss.error,
            tolerance: miss.tolerance,
        };
        let levels: Vec<RefinementLevel> =
            simulation.levels().iter().cloned().chain([level]).collect();
        let on = |by: f64| {
            let refinement = by * simulation.refinement;
            simulation.refined(refinement, levels.clone()).map_err(NotRefined::Rejected)
        };
        let finer = match (on(by)?, by < REFINEMENT_RATIOS[1]) {
            (short, true) if self.expected_miss(&short).flatten().is_some() => {
                on(REFINEMENT_RATIOS[1])?
            }
            (enough, _) => enough,
        };
        let most = scene.limits().element_updates.unwrap_or(MAX_UPDATES);
        match finer.setup().cost {
            Cost::Steps { element_updates, .. } if element_updates > most => {
                Err(NotRefined::TooExpensive { updates: Some(element_updates) })
            }
            Cost::Factors { elements, .. } if elements > MAX_ELEMENTS => {
                Err(NotRefined::TooExpensive { updates: None })
            }
            _ => Ok(finer),
        }
    }

    /// Returns the setting of the case whose error exceeds the tolerance on any mesh; `met` is the collision on the present
    /// mesh, `None` before the run.
    fn faulty_setting(
        &mut self,
        simulation: &Simulation,
        miss: &ToleranceMiss,
        met: Option<&Collision>,
    ) -> Option<FaultySetting> {
        let scene = simulation.case().scene();
        let elements = simulation.setup().elements.as_ref()?;
        if miss.is_of_springs(elements) {
            return Some(FaultySetting::SoftSprings);
        }
        let of_mass = elements.moved_share * MOVED_MASS[miss.quantity as usize];
        if scene.mass_scaling().is_some() && of_mass > miss.tolerance {
            return Some(FaultySetting::MovedMass);
        }
        let subject = EstimatedCollision::planned(simulation)?;
        if let Some(key) = subject.far_mesh_key() {
            let error = self.runs.far_mesh(&subject).and_then(|of| of[miss.quantity as usize]);
            if error.is_some_and(|error| error > miss.tolerance) {
                return Some(FaultySetting::FarMesh(key));
            }
        }
        let collision = met?;
        if is_of_chatter(miss, collision) {
            return Some(FaultySetting::ChatteringSprings);
        }
        // Springs overlap by half of this on average, and the contact time grows like the approach.
        let overlap = collision.deepest_overlap.map_or(0.0, |deepest| deepest.overlap);
        let of_springs = 0.5 * overlap / collision.max_approach?;
        let is_soft = scene.penalty_factor().is_some_and(|factor| factor < PENALTY_FACTOR);
        (is_soft && of_springs > miss.tolerance).then_some(FaultySetting::SoftSprings)
    }
}

/// Returns the ratio of element sizes at which an error that exceeds the tolerance by this factor falls below it.
pub(super) fn refinement_ratio(excess: f64) -> f64 {
    (SAFETY_FACTOR * excess).powf(1.0 / EXPECTED_ORDER)
}

/// Returns whether contact chatter alone exceeds the tolerance.
pub(super) fn is_of_chatter(miss: &ToleranceMiss, collision: &Collision) -> bool {
    of_chatter(collision, miss.quantity) > miss.tolerance
}

/// Returns whether the meshes of the case may be refined for its tolerance.
pub(super) fn may_be_refined(simulation: &Simulation) -> bool {
    let scene = simulation.case().scene();
    let is_given = scene.mesh().contact_element_size.is_some();
    let has_elements = simulation.setup().elements.is_some();
    has_elements && !is_given && !has_mesh_file(simulation) && scene.gravity().is_none()
}

fn has_mesh_file(simulation: &Simulation) -> bool {
    let is_file = |body: &Body| matches!(body.shape(), Shape::Sphere { mesh: Some(_), .. });
    simulation.case().scene().bodies().iter().any(is_file)
}

/// Prints an element size with three digits, as a case takes it.
pub(super) fn length(size: f64) -> String {
    Unit::fitting(size, "m").with_digits(3).show(size)
}
