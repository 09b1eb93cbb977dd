//! The results of a variant.

use fem_case::CaseError;
use fem_collision::{
    Monitor, OutputRequest, OutputRequestError, QuantityOfInterest, SnapshotInstant,
    SnapshotRequest,
};
use fem_simulation::{Cost, SharedModels, Simulation};

use super::stress_samples::axial_stresses;
use super::variants::Variant;

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
    /// Computes a variant and its fields at the largest approach, for a contact of this radius, m. Nothing is
    /// shared with other variants, so that the run time includes meshes and factors.
    ///
    /// # Errors
    /// The model does not support the variant.
    pub fn of(
        variant: &Variant,
        contact_radius: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, CaseError> {
        let simulation = Simulation::sharing(variant.case.clone(), &SharedModels::default())?;
        let snapshots = SnapshotRequest::Labels(vec![SnapshotInstant::Maximum]);
        let request = OutputRequest { snapshots, ..simulation.request().clone() };
        let too_much =
            |error: OutputRequestError| variant.case.error_at("output", error.to_string());
        let simulation = simulation.with_output_request(request).map_err(too_much)?;
        let collision = simulation.run(monitor);
        let (elements, memory) = match simulation.setup().cost {
            Cost::Steps { elements, memory, .. } | Cost::Factors { elements, memory, .. } => {
                (elements, Some(memory))
            }
            Cost::ClosedForm { .. } => (0, None),
        };
        let complete = collision.is_complete().then_some(&collision);
        let value =
            |quantity: QuantityOfInterest| quantity.of(complete?).filter(|value| value.is_finite());
        let snapshot = complete.and_then(|it| it.snapshot(SnapshotInstant::Maximum));
        Ok(Self {
            values: QuantityOfInterest::ALL.map(value),
            stress: snapshot.and_then(|now| axial_stresses(&simulation, now, contact_radius)),
            elements,
            steps: collision.steps,
            element_updates: collision.element_updates,
            memory,
            is_complete: collision.is_complete(),
        })
    }

    /// Returns the value of a quantity of interest.
    pub fn value(&self, quantity: QuantityOfInterest) -> Option<f64> {
        self.values[quantity as usize]
    }
}
