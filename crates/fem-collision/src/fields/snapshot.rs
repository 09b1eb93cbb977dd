//! Fields of both bodies at an instant.

use serde::{Deserialize, Serialize};

/// The named instants of a collision.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum SnapshotInstant {
    /// The approach reaches half its maximum in compression.
    MidCompression,
    /// The approach is at its maximum.
    Maximum,
    /// The approach is back at half its maximum in separation.
    MidSeparation,
    /// The last step with a contact force.
    LastContact,
    /// Bodies that flowed plastically, unloaded: in equilibrium with their residual stress, without vibration and bending.
    AfterSeparation,
    /// The last valid state of a run that failed, with a small energy residual.
    #[serde(rename = "LastSound")]
    LastValid,
}

impl SnapshotInstant {
    /// The instants that can be requested, in the order of time.
    pub const ALL: [Self; 5] = [
        Self::MidCompression,
        Self::Maximum,
        Self::MidSeparation,
        Self::LastContact,
        Self::AfterSeparation,
    ];

    /// The instants of every contact, in the order of time.
    pub const OF_CONTACT: [Self; 4] =
        [Self::MidCompression, Self::Maximum, Self::MidSeparation, Self::LastContact];

    /// Returns the name in cases and file names.
    pub fn name(self) -> &'static str {
        match self {
            Self::MidCompression => "mid-compression",
            Self::Maximum => "maximum",
            Self::MidSeparation => "mid-separation",
            Self::LastContact => "last-contact",
            Self::AfterSeparation => "after-separation",
            Self::LastValid => "last-sound",
        }
    }
}

/// The snapshots that a run keeps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum SnapshotRequest {
    /// Snapshots at named instants.
    Labels(Vec<SnapshotInstant>),
    /// A number of snapshots, evenly over the contact.
    Count(usize),
    /// Snapshots at these times since the start of the case, s.
    Times(Vec<f64>),
}

impl SnapshotRequest {
    /// Requests no snapshot.
    pub fn none() -> Self {
        Self::Labels(Vec::new())
    }

    /// Returns the number of requested snapshots.
    pub fn len(&self) -> usize {
        match self {
            Self::Labels(labels) => labels.len(),
            Self::Count(count) => *count,
            Self::Times(times) => times.len(),
        }
    }

    /// Returns whether no snapshot is requested.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Nodal fields of one body; empty for a rigid body.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct BodyFields {
    /// Total displacement (r, y), m.
    pub displacement: Vec<[f64; 2]>,
    /// Velocity (r, y), m/s.
    pub velocity: Vec<[f64; 2]>,
    /// Effective displacement of the relaxing stress, m; empty for an elastic body.
    pub effective: Vec<[f64; 2]>,
    /// Cauchy stress (σ_rr, σ_yy, σ_θθ, σ_ry) of each element of a body at finite strain, tension
    /// positive, Pa; empty if it follows from the fields above.
    pub stress: Vec<[f64; 4]>,
    /// Equivalent plastic strain and plastic work per undeformed volume (J/m³) of each element of a body that flows; empty
    /// for other bodies.
    pub plastic: Vec<[f64; 2]>,
}

/// The contact at one distance from the axis.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct ContactProfilePoint {
    /// Whether the point is a node of the surface whose values these are.
    pub is_node: bool,
    /// Distance from the axis, m, in the deformed state if the contact follows the moving surfaces.
    pub radius: f64,
    /// Contact pressure, Pa; 0 from the contact radius on.
    pub pressure: f64,
    /// Gap: y of the upper surface minus that of the lower one, m; negative if penalty springs overlap.
    pub gap: f64,
    /// Radial displacement of the lower and the upper surface, m.
    pub radial: [f64; 2],
}

/// The contact at an instant.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ContactProfile {
    /// Contact radius, where the pressure falls to zero, m; 0 without contact.
    pub radius: f64,
    /// Points from the axis to the edge of the candidate region: the nodes, the edge of the contact, and points between, so
    /// that linear interpolation gives the contact force. Empty in flight.
    pub places: Vec<ContactProfilePoint>,
}

impl ContactProfile {
    /// Returns the contact pressure at a distance from the axis (m), linear between the points, Pa.
    pub fn pressure_at(&self, radius: f64) -> f64 {
        let outer = self.places.partition_point(|place| place.radius < radius);
        let Some(end) = self.places.get(outer) else { return 0.0 };
        match outer.checked_sub(1).map(|inner| &self.places[inner]) {
            Some(start) => {
                let share = (radius - start.radius) / (end.radius - start.radius);
                start.pressure + share * (end.pressure - start.pressure)
            }
            None => end.pressure,
        }
    }
}

/// Both bodies at an instant.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Snapshot {
    /// The named instant, if it is one.
    pub label: Option<SnapshotInstant>,
    /// Time since the start of the case, s.
    pub time: f64,
    /// Approach of the mass centres, m.
    pub approach: f64,
    /// Rigid displacement of each body along +y, m, in addition to the displacements of its fields. It is kept apart since
    /// its rounding errors would exceed the strains.
    pub carried: [f64; 2],
    /// Fields of the lower and the upper body.
    pub bodies: [BodyFields; 2],
    /// The contact between them.
    pub contact: ContactProfile,
}

impl Snapshot {
    /// Returns the displacements (r, y) of a body's nodes since the start of the case, m.
    pub fn displacement(&self, side: usize) -> Vec<[f64; 2]> {
        let carried = self.carried[side];
        self.bodies[side].displacement.iter().map(|[r, y]| [*r, y + carried]).collect()
    }
}

/// Returns `n` times, evenly spaced over an interval (s) with its ends; a single time is in the middle.
pub fn evenly(n: usize, start: f64, length: f64) -> Vec<f64> {
    match n {
        1 => vec![start + 0.5 * length],
        _ => (0..n).map(|k| start + length * k as f64 / (n - 1) as f64).collect(),
    }
}

/// Returns the warning for a named instant that did not occur.
pub fn did_not_occur(label: SnapshotInstant) -> String {
    format!("the instant \"{}\" did not occur; its snapshot is left out", label.name())
}

/// Returns the warning for a contact with fewer instants than requested snapshots.
pub fn fewer_than_asked(n_asked: usize, n_there: usize, instants: &str) -> String {
    format!("{n_asked} snapshots were requested; the contact has {instants} for {n_there}")
}
