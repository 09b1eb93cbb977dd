//! The estimator of a collision's error.

use fem_collision::{Collision, QuantityOfInterest, longest_at_pole};

use super::advice::is_unresolved;
use super::calibration::{
    ADDED_MASS, CLOSED_FORM, CLOSED_FORM_PRESSURE, CONDENSED, Calibration, EXPLICIT,
    SAMPLED_PER_TOLERANCE, SCATTER, STRAINED,
};
use super::elastic_null::{ElasticNull, elastic_null};
use super::noise_floor::{noise, noise_floor};
use super::reference_runs::{ReferenceRuns, Subject, Values};
use super::refinement::NotRefined;
use crate::effects::{EffectDecision, FiniteStrain, MassScaling, ModelFormError};
use crate::models::explicit::cost::needs_own_reference;
use crate::models::method::Cost;
use crate::results::overlap_of_approach;
use crate::simulation::Simulation;

/// Least relative error of a contact that is narrower than an element.
const UNRESOLVED_ERROR: f64 = 0.5;
/// Elements across the contact at the largest pressure, below which an early one is not resolved.
const FEW_AT_PRESSURE: f64 = 4.0;
/// Contact radius at the largest pressure over the largest one, below which the contact is still small. Bodies that keep
/// half of their moduli have the largest pressure at more than 0.8.
const EARLY: f64 = 0.5;

/// Estimates the errors of the collisions of a case, on the chosen mesh and on finer ones; keeps the reference runs that
/// it has computed.
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
    /// A refinement that was too expensive and its element updates.
    pub(super) too_expensive: Option<(f64, u64)>,
}

/// The estimated errors of a collision.
#[derive(Debug, Default)]
pub struct ErrorEstimate {
    pub(crate) bars: ModelFormError,
    parts: [Option<BarParts>; 6],
    /// The loss without relaxation, for relaxing bodies.
    pub elastic_null: Option<ElasticNull>,
    /// Element updates of all reference runs so far, those of coarser meshes included.
    pub element_updates: u64,
    /// Why the mesh stays, if the tolerance is missed.
    pub(super) not_refined: Option<NotRefined>,
}

/// The parts of an error bar: of the restitution absolute, of others relative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BarParts {
    /// Distance from the Richardson limit of the reference runs.
    pub reference_error: f64,
    /// Safety factor on it.
    pub safety_factor: f64,
    /// Elements across the contact.
    pub across: f64,
    /// Error by the place of the contact's edge.
    pub edge: f64,
    /// Scatter of any mesh, and the error by added mass.
    pub floor: f64,
}

impl BarParts {
    /// Returns safety factor × reference error + edge + floor.
    pub fn sum(&self) -> f64 {
        self.safety_factor * self.reference_error + self.edge + self.floor
    }
}

impl ErrorEstimate {
    /// Returns the discretisation error of a quantity, SI; `None` if it is not estimated.
    pub fn discretisation(&self, headline: QuantityOfInterest) -> Option<f64> {
        self.bars.size(headline)
    }

    /// Returns the parts of the error bar of a model with elements, but for noise that the run itself shows.
    pub fn parts(&self, headline: QuantityOfInterest) -> Option<BarParts> {
        self.parts[headline as usize]
    }
}

impl ErrorEstimator {
    /// Estimates the errors of a collision.
    pub fn estimate(&mut self, simulation: &Simulation, collision: &Collision) -> ErrorEstimate {
        let mut estimate = self.bars(simulation, collision);
        if let Err(reason) = self.refined(simulation, collision, &estimate) {
            estimate.not_refined = reason;
        }
        self.complete(simulation, collision, estimate)
    }

    /// Adds what only the last mesh needs.
    pub(super) fn complete(
        &mut self,
        simulation: &Simulation,
        collision: &Collision,
        estimate: ErrorEstimate,
    ) -> ErrorEstimate {
        let elastic_null = elastic_null(simulation, collision, &mut self.runs);
        ErrorEstimate { elastic_null, element_updates: self.runs.element_updates(), ..estimate }
    }

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
            Auto => ModelFormError::default(),
        };
        let element_updates = self.runs.element_updates();
        ErrorEstimate { bars, parts, element_updates, ..ErrorEstimate::default() }
    }

    /// Estimates the errors of a model with elements; none of a collision that did not end by itself.
    fn of_elements(
        &mut self,
        simulation: &Simulation,
        collision: &Collision,
    ) -> [Option<BarParts>; 6] {
        let Some(subject) = subject(simulation, collision) else { return [None; 6] };
        let values = QuantityOfInterest::ALL.map(|headline| headline.of(collision));
        let across = across(collision, subject.size);
        let estimated = self.estimated(&subject, collision, values, across[0]);
        let Some((errors, calibration)) = estimated else { return [None; 6] };
        bar_parts(errors, &calibration, across, added_share(simulation, collision))
    }

    /// Returns the distances from the Richardson limits of the reference runs, the restitution's absolute, all others
    /// relative, and the constants of this kind of reference run.
    fn estimated(
        &mut self,
        subject: &Subject<'_>,
        collision: &Collision,
        values: Values,
        across: f64,
    ) -> Option<(Values, Calibration)> {
        let Subject { simulation, plan, .. } = *subject;
        let is_explicit = collision.element_updates.is_some();
        let needs_own = is_explicit
            && simulation.estimate(collision).is_none_or(|estimate| {
                needs_own_reference(&estimate, is_at_finite_strain(simulation, collision))
            });
        match (is_explicit, plan.makes_meshes, needs_own) {
            (true, false, true) => None,
            (true, false, false) => Some((self.runs.mesh_file(subject, None, across)?, EXPLICIT)),
            (true, true, false) => Some((self.runs.condensed(subject)?.0, EXPLICIT)),
            (true, true, true) => {
                let own = self.runs.coarser(subject, values)?;
                let condensed = self.runs.condensed(subject).map(|(errors, _)| errors);
                let condensed = |k: usize| condensed.and_then(|condensed| condensed[k]);
                let both = |k: usize| Some(own[k]? + condensed(k).unwrap_or(0.0));
                Some((std::array::from_fn(both), STRAINED))
            }
            (false, false, _) => {
                Some((self.runs.mesh_file(subject, Some(values), across)?, CONDENSED))
            }
            (false, true, _) => Some((self.runs.coarser(subject, values)?, CONDENSED)),
        }
    }

    /// Estimates the errors of explicit elements before the collision, the restitution's absolute, all others relative;
    /// `None` where only the collision itself shows them.
    pub(super) fn before_run(&mut self, simulation: &Simulation) -> Option<Values> {
        let setup = simulation.setup();
        let Cost::Steps { .. } = setup.cost else { return None };
        let elements = setup.elements.as_ref()?;
        let is_finite = setup.decisions.is_active(FiniteStrain::NAME);
        if !elements.plan.makes_meshes || needs_own_reference(&setup.estimate, is_finite) {
            return None;
        }
        let subject = Subject::planned(simulation)?;
        let (errors, values) = self.runs.condensed(&subject)?;
        let across = values[QuantityOfInterest::MaxContactRadius as usize]? / subject.size;
        let parts = bar_parts(errors, &EXPLICIT, [across; 2], elements.added_share);
        Some(parts.map(|parts| Some(parts?.sum())))
    }

    /// Returns the element updates of a collision over those that closed forms announce, from a coarser run; 1 where
    /// closed forms serve.
    pub fn updates_over_announced(&mut self, simulation: &Simulation) -> f64 {
        /// Element updates of the coarser run, a tenth of a second.
        const MOST: u64 = 4_000_000;
        let is_open = simulation.reference_updates().is_some()
            && simulation.case().scene().gravity().is_none();
        let subject = Subject::planned(simulation).filter(|_| is_open);
        let ratio = subject.and_then(|subject| self.runs.updates_over_announced(&subject, MOST));
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
            Cost::Little { .. } => None,
        }
    }
}

/// Returns the collision as reference runs see it; `None` if it did not end by itself or has no elements.
fn subject<'a>(simulation: &'a Simulation, collision: &Collision) -> Option<Subject<'a>> {
    let elements = simulation.setup().elements.as_ref().filter(|_| collision.is_complete())?;
    let plan = &elements.plan;
    let size = match plan.makes_meshes {
        true => plan.contact_element_size,
        false => longest_at_pole(simulation.model().meshes()),
    };
    let approach = collision.approach;
    (size > 0.0).then_some(Subject { simulation, approach, plan, size })
}

/// Returns the elements across the contact at its widest and at the instant of the largest pressure.
fn across(collision: &Collision, size: f64) -> [f64; 2] {
    let widest = collision.max_contact_radius.unwrap_or(0.0) / size;
    let at_pressure = collision.peak_pressure_radius.map_or(widest, |radius| radius / size);
    [widest, at_pressure]
}

/// Returns the contact radius (m) at which closed forms expect the largest pressure, if that is while the contact is small
/// and spans few elements. Meshes of similar size then agree on a wrong pressure, and no finer one is tried for it.
pub(super) fn early_pressure_radius(simulation: &Simulation, collision: &Collision) -> Option<f64> {
    let size = subject(simulation, collision)?.size;
    let effective = simulation.estimate(collision)?.effective;
    let radius = effective.pressure_radius;
    let is_early = radius < EARLY * effective.sizes.max_contact_radius;
    (is_early && radius < FEW_AT_PRESSURE * size).then_some(radius)
}

/// Returns the relative distance of a peak pressure from that of closed forms, with their own error: the estimate for a
/// pressure that elements do not resolve.
fn beside_closed_form(simulation: &Simulation, collision: &Collision) -> f64 {
    let estimate = simulation.estimate(collision);
    let expected = estimate.map(|estimate| estimate.effective.sizes.peak_pressure);
    let both = collision.peak_pressure.zip(expected);
    both.map_or(0.0, |(value, expected)| CLOSED_FORM_PRESSURE * (1.0 - expected / value).abs())
}

/// Returns the parts of all bars.
fn bar_parts(
    errors: Values,
    calibration: &Calibration,
    [widest, at_pressure]: [f64; 2],
    added_share: f64,
) -> [Option<BarParts>; 6] {
    QuantityOfInterest::ALL.map(|headline| {
        let k = headline as usize;
        let across =
            if headline == QuantityOfInterest::PeakPressure { at_pressure } else { widest };
        Some(BarParts {
            reference_error: errors[k]?,
            safety_factor: calibration.safety_factor,
            across,
            edge: calibration.edge[k] / across.max(1.0).powi(2),
            floor: SCATTER[k] + ADDED_MASS[k] * added_share,
        })
    })
}

/// Returns error bars, SI: the sum of their parts, and no less than the noise that the run itself shows.
fn summed(
    simulation: &Simulation,
    collision: &Collision,
    parts: &[Option<BarParts>; 6],
) -> ModelFormError {
    let is_unresolved = is_unresolved(simulation, collision);
    let overlap = overlap_of_approach(simulation, collision).unwrap_or(0.0);
    let is_early = early_pressure_radius(simulation, collision).is_some();
    ModelFormError::by(|headline| {
        let mut floor = noise_floor(collision, headline);
        if headline == QuantityOfInterest::MaxApproach {
            floor = floor.max(overlap);
        }
        if headline != QuantityOfInterest::Restitution && is_unresolved {
            floor = floor.max(UNRESOLVED_ERROR);
        }
        let is_pressure = headline == QuantityOfInterest::PeakPressure;
        if is_pressure && (is_early || noise(collision).is_some()) {
            floor = floor.max(beside_closed_form(simulation, collision));
        }
        let estimated = parts[headline as usize].map(|parts| parts.sum());
        // Coarser runs of such meshes may not come to an end.
        let bar = estimated.or(is_unresolved.then_some(0.0))?.max(floor);
        headline.of(collision).map(|value| bar * headline.scale(value))
    })
}

/// Returns the errors of a model without elements, from its tolerance.
fn of_tolerance(collision: &Collision, tolerance: f64) -> ModelFormError {
    ModelFormError::by(|headline| {
        let share = match headline {
            QuantityOfInterest::Restitution
            | QuantityOfInterest::ContactTime
            | QuantityOfInterest::PeakForce => tolerance,
            _ => SAMPLED_PER_TOLERANCE * tolerance,
        };
        headline.of(collision).map(|value| share * headline.scale(value))
    })
}

fn is_at_finite_strain(simulation: &Simulation, collision: &Collision) -> bool {
    let verdicts = simulation.decisions(collision).verdicts;
    verdicts
        .iter()
        .any(|verdict: &EffectDecision| verdict.name == FiniteStrain::NAME && verdict.active)
}

/// Returns the most mass that is added to a body over that of the lighter one; for a stiffer body that share over its
/// larger allowance.
fn added_share(simulation: &Simulation, collision: &Collision) -> f64 {
    let allowed = MassScaling::times(simulation.case().scene());
    let shares = collision.added_shares().into_iter().zip(allowed);
    shares.filter_map(|(share, times)| Some(share? / times)).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: F_s |Δ| + c (h/a)² + scatter + added mass; the pressure's floor goes by its own radius.
    #[test]
    fn a_bar_is_the_formula() {
        let calibration = Calibration { safety_factor: 2.0, edge: [0.16; 6] };
        let parts = bar_parts([Some(1e-3); 6], &calibration, [4.0, 2.0], 0.01);
        for (k, parts) in parts.into_iter().enumerate() {
            let edge = if k == QuantityOfInterest::PeakPressure as usize { 0.04 } else { 0.01 };
            let expected = 2e-3 + edge + SCATTER[k] + 0.01 * ADDED_MASS[k];
            assert!((parts.unwrap().sum() - expected).abs() < 1e-12, "{k}");
        }
        let mut errors = [Some(0.0); 6];
        errors[1] = None;
        assert_eq!(bar_parts(errors, &calibration, [4.0; 2], 0.0)[1], None);
    }
}
