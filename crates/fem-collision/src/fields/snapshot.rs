//! Fields of both bodies at an instant.

use serde::{Deserialize, Serialize};

/// The named instants of a collision.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum SnapshotInstant {
    /// Approach at half its maximum, going in.
    MidCompression,
    /// Approach at its maximum.
    Maximum,
    /// Approach at half its maximum, coming out.
    MidSeparation,
    /// The last step with a contact force.
    LastContact,
    /// Of a run that failed: the last state that is kept whose energy added up.
    LastSound,
}

impl SnapshotInstant {
    /// All that can be asked for, in the order of time.
    pub const ALL: [Self; 4] =
        [Self::MidCompression, Self::Maximum, Self::MidSeparation, Self::LastContact];

    /// The name in case and file names.
    pub fn name(self) -> &'static str {
        match self {
            Self::MidCompression => "mid-compression",
            Self::Maximum => "maximum",
            Self::MidSeparation => "mid-separation",
            Self::LastContact => "last-contact",
            Self::LastSound => "last-sound",
        }
    }
}

/// Which snapshots a run keeps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum SnapshotRequest {
    /// At named instants.
    Labels(Vec<SnapshotInstant>),
    /// So many, evenly over the contact.
    Count(usize),
    /// At these times since the start of the case, s.
    Times(Vec<f64>),
}

impl SnapshotRequest {
    /// No snapshot at all.
    pub fn none() -> Self {
        Self::Labels(Vec::new())
    }

    /// How many are asked for.
    pub fn len(&self) -> usize {
        match self {
            Self::Labels(labels) => labels.len(),
            Self::Count(count) => *count,
            Self::Times(times) => times.len(),
        }
    }

    /// Whether none is.
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
    /// Effective displacement that the relaxing stress sees, m; empty for an
    /// elastic body.
    pub effective: Vec<[f64; 2]>,
    /// Cauchy stress (σ_rr, σ_yy, σ_θθ, σ_ry) of each element of a body at finite strain, tension
    /// positive, Pa; empty where it follows from the fields above.
    pub stress: Vec<[f64; 4]>,
}

/// The contact at one distance from the axis.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct ContactProfilePoint {
    /// Whether a node of the surface that is read is there.
    pub is_node: bool,
    /// Distance from the axis, m; where surfaces are followed as they move, the present one.
    pub radius: f64,
    /// Contact pressure, Pa; 0 from the contact radius on.
    pub pressure: f64,
    /// y of the upper less that of the lower surface, m; negative by what springs overlap.
    pub gap: f64,
    /// Displacement along r of the lower and the upper surface, m.
    pub radial: [f64; 2],
}

/// The contact at an instant.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ContactProfile {
    /// Where the pressure falls to zero, m; 0 without contact.
    pub radius: f64,
    /// From the axis outward, as far as contact is looked for: nodes, where the contact ends, and places
    /// between, along which straight lines carry the contact force; none in flight.
    pub places: Vec<ContactProfilePoint>,
}

/// Both bodies at an instant.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Snapshot {
    /// Which instant, for named ones.
    pub label: Option<SnapshotInstant>,
    /// Time since the start of the case, s.
    pub time: f64,
    /// Approach of the mass centres, m.
    pub approach: f64,
    /// How far each body has moved along +y beyond the displacements of its fields, m: its flight before
    /// first touch and the way of the mass centre, of which strains would keep nothing but rounding.
    pub carried: [f64; 2],
    /// Lower and upper body.
    pub bodies: [BodyFields; 2],
    /// What they do to each other.
    pub contact: ContactProfile,
}

impl Snapshot {
    /// Displacements (r, y) of a body's nodes since the start of the case, m.
    pub fn displacement(&self, side: usize) -> Vec<[f64; 2]> {
        let carried = self.carried[side];
        self.bodies[side].displacement.iter().map(|[r, y]| [*r, y + carried]).collect()
    }
}

/// `n` times evenly over a stretch (s), its ends among them; one alone lies in the middle.
pub fn evenly(n: usize, start: f64, length: f64) -> Vec<f64> {
    match n {
        1 => vec![start + 0.5 * length],
        _ => (0..n).map(|k| start + length * k as f64 / (n - 1) as f64).collect(),
    }
}

/// What is said of a named instant that a run has not had.
pub fn did_not_occur(label: SnapshotInstant) -> String {
    format!("the instant \"{}\" did not occur; its snapshot is left out", label.name())
}

/// What is said of a contact with fewer instants than snapshots.
pub fn fewer_than_asked(n_asked: usize, n_there: usize, instants: &str) -> String {
    format!("{n_asked} snapshots were asked for; the contact has {instants} for {n_there}")
}
