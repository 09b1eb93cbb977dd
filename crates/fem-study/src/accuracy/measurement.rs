//! The results of a variant.

use fem_case::CaseError;
use fem_collision::{Monitor, OutputRequest, QuantityOfInterest, SnapshotInstant, SnapshotRequest};

use super::stress_places::StressPlaces;
use super::variant::Variant;
use fem_simulation::Simulation;
use fem_simulation::{Cost, SharedModels};

/// The results of a variant, SI.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measurement {
    /// The quantities of interest, in the order of [`QuantityOfInterest::ALL`]; `None` if the model does
    /// not compute one, or the run did not end by itself.
    pub values: [Option<f64>; 6],
    /// σ_yy at the largest approach, tension positive, Pa, at each of the study's places; `None` for a
    /// model without fields.
    pub stress: Option<Vec<f64>>,
    /// Elements of both bodies.
    pub elements: u64,
    /// Steps, of a model that has a fixed step.
    pub steps: Option<u64>,
    /// Elements times steps, of a model that computes each element at each step.
    pub element_updates: Option<u64>,
    /// Memory of the run or of the factors, bytes.
    pub memory: Option<u64>,
    /// Whether the collision ended by itself.
    pub is_complete: bool,
}

impl Measurement {
    /// Computes a variant, its fields at the largest approach too.
    ///
    /// # Errors
    /// The model does not support the variant.
    pub fn of(
        variant: &Variant,
        contact_radius: f64,
        shared: &SharedModels,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, CaseError> {
        let mut simulation = Simulation::sharing(variant.case.clone(), shared)?;
        let snapshots = SnapshotRequest::Labels(vec![SnapshotInstant::Maximum]);
        let request = OutputRequest { snapshots, ..simulation.request().clone() };
        // A label more or less is no fault.
        let _ = simulation.ask_for(request);
        let collision = simulation.run(monitor);
        let (elements, memory) = match simulation.setup().cost {
            Cost::Steps { elements, memory, .. } => (elements, Some(memory)),
            Cost::Factors { elements, memory, .. } => (elements, Some(memory)),
            Cost::Little { .. } => (0, None),
        };
        let is_complete = collision.is_complete();
        let finite = |value: f64| value.is_finite().then_some(value);
        let value = |quantity: QuantityOfInterest| match is_complete {
            true => quantity.of(&collision).and_then(finite),
            false => None,
        };
        let snapshot = collision.snapshot(SnapshotInstant::Maximum).filter(|_| is_complete);
        let stress = snapshot.and_then(|snapshot| {
            StressPlaces::around(contact_radius).sample(&simulation, snapshot)
        });
        Ok(Self {
            values: QuantityOfInterest::ALL.map(value),
            stress,
            elements,
            steps: collision.steps,
            element_updates: collision.element_updates,
            memory,
            is_complete,
        })
    }

    /// Returns the value of a quantity of interest.
    pub fn value(&self, quantity: QuantityOfInterest) -> Option<f64> {
        self.values[quantity as usize]
    }
}
