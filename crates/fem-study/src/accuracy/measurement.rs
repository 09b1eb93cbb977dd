//! The results of a variant.

use fem_case::CaseError;
use fem_collision::{
    Monitor, OutputRequest, OutputRequestError, QuantityOfInterest, Snapshot, SnapshotInstant,
    SnapshotRequest,
};
use fem_mesh::SphereMesh;
use fem_simulation::{Cost, SharedModels, Simulation};

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

/// Distances from the axis over the contact radius. They avoid the edge of the contact, where the stress is
/// not smooth.
const RADII: [f64; 7] = [0.0, 0.2, 0.4, 0.6, 0.8, 1.3, 1.7];
/// Depths below the surface over the contact radius.
const DEPTHS: [f64; 7] = [0.2, 0.35, 0.5, 0.75, 1.0, 1.5, 2.0];
/// All places are nearer to the pole than this multiple of the contact radius.
const MAX_DISTANCE_OVER_RADIUS: f64 = 6.0;

/// Returns σ_yy (Pa, tension positive) at each place around a contact of this radius (m) in each body that has
/// elements, interpolated between nodal stresses. Returns `None` without elements, or if a place is not in its body.
pub(super) fn axial_stresses(
    simulation: &Simulation,
    snapshot: &Snapshot,
    contact_radius: f64,
) -> Option<Vec<f64>> {
    let mut all = Vec::new();
    for side in [0, 1] {
        let Some(stress) = simulation.stress(snapshot, side) else { continue };
        let near = stress.elements_near(MAX_DISTANCE_OVER_RADIUS * contact_radius);
        for depth in DEPTHS {
            for radius in RADII {
                let r = radius * contact_radius;
                let place = [r, surface_depth(stress.mesh, r)? + depth * contact_radius];
                all.push(stress.interpolated(&near, place)?[1]);
            }
        }
    }
    (!all.is_empty()).then_some(all)
}

/// Returns the depth of a body's surface below its pole at a distance from the axis, m; `None` beyond the
/// body.
fn surface_depth(mesh: &SphereMesh, r: f64) -> Option<f64> {
    if mesh.is_half_space() {
        return Some(0.0);
    }
    let radius = mesh.radius();
    let depth = radius - (radius * radius - r * r).sqrt();
    depth.is_finite().then_some(depth)
}

/// Returns the root mean square difference of two samples over that of the second.
pub(super) fn relative_difference(sample: &[f64], reference: &[f64]) -> Option<f64> {
    if sample.len() != reference.len() {
        return None;
    }
    let difference: f64 = sample.iter().zip(reference).map(|(a, b)| (a - b).powi(2)).sum();
    let whole: f64 = reference.iter().map(|b| b * b).sum();
    Some((difference / whole).sqrt()).filter(|error| error.is_finite())
}
