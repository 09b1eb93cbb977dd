//! The result of a collision, the same for every model.

use serde::{Deserialize, Serialize};

use crate::fields::{Snapshot, SnapshotInstant};
use crate::request::Approach;
use crate::result::{Bounce, Ending, RestState, Stop};
use crate::run::{DeepestOverlap, EnergyLedger, HistoryRow, StepInstant};

/// Warning for bodies with a restitution of 0.
pub const STAY_TOGETHER: &str = "the bodies stay together: what drives them apart is worth less than a thousandth of the speed of approach, and the \
     contact is not followed to an end";

/// Largest energy residual of a valid run, as a fraction of the initial energy.
pub const LARGEST_RESIDUAL: f64 = 1e-3;

/// The result of a collision, complete or up to the stop. `None` means that the model does not
/// compute the quantity or that it has no value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Collision {
    /// Initial velocities and gap.
    pub approach: Approach,
    /// How the collision ended.
    pub ending: Ending,
    /// Relative velocity after over before, 1 when elastic; 0 for bodies that stay together.
    pub restitution: Option<f64>,
    /// First to last instant with a contact force, openings in between included, s.
    pub contact_time: Option<f64>,
    /// First instant with a contact force since the start of the case, s.
    pub first_contact: Option<f64>,
    /// Last instant with a contact force so far, s.
    pub last_contact: Option<f64>,
    /// Number of separate contacts.
    pub contact_episodes: u64,
    /// Largest contact force, a mean over [`PEAK_WINDOW`](crate::PEAK_WINDOW) of the pulse in models that step, N.
    pub peak_force: Option<f64>,
    /// Largest contact force of a single step, N.
    pub peak_force_raw: Option<f64>,
    /// Largest approach, m.
    pub max_approach: Option<f64>,
    /// Largest contact radius, a mean as is the force, m.
    pub max_contact_radius: Option<f64>,
    /// Largest contact pressure on the axis, a mean as is the force, Pa: of first touch nothing counts
    /// ([`ForcePulse`](crate::ForcePulse)).
    pub peak_pressure: Option<f64>,
    /// Radius of the contact at that pressure, of a model with meshes, m.
    pub peak_pressure_radius: Option<f64>,
    /// Scatter of the contact force from sample to sample, N; close to 0 for a smooth pulse.
    pub force_scatter: Option<f64>,
    /// When the force scatters most.
    pub noisiest_instant: Option<StepInstant>,
    /// The deepest overlap of the surfaces; `None` for a contact without springs.
    pub deepest_overlap: Option<DeepestOverlap>,
    /// The final candidate region of the contact, for models that limit the search.
    pub candidate_region: Option<CandidateRegion>,
    /// Kinetic energy at the start, walls and half-spaces not counted, J.
    pub initial_energy: Option<f64>,
    /// Energy in each account at the end, J.
    pub energies: EnergyLedger,
    /// Energy residual at the end, J.
    pub residual: Option<f64>,
    /// Worst imbalance of energy over the initial kinetic energy in the frame of the mass centre, with gravity
    /// over that and what the weight has given while the bodies came closer.
    pub residual_relative: Option<f64>,
    /// When that was first above [`LARGEST_RESIDUAL`], for models that step in time.
    pub residual_since: Option<StepInstant>,
    /// Largest spurious energy growth at any step, over the initial kinetic energy in the frame of
    /// the mass centre; for a bouncing ball that of its worst contact. `None` for models with one
    /// degree of freedom.
    pub energy_growth: Option<f64>,
    /// Worst drift of momentum over Σ m|v| at the start, or of the momentum that the bodies have
    /// exchanged from the impulse of the contact force. `None` of one degree of freedom, from which
    /// both velocities follow because momentum is kept: that cannot fail.
    pub momentum_residual_relative: Option<f64>,
    /// Lower and upper body.
    pub bodies: [BodyResult; 2],
    /// Time step of models with a fixed step, s.
    pub time_step: Option<f64>,
    /// Time step without mass scaling, for models that have it, s.
    pub plain_time_step: Option<f64>,
    /// Number of time steps of such a model.
    pub steps: Option<u64>,
    /// Elements times steps, for models that compute each element at each step.
    pub element_updates: Option<u64>,
    /// Memory of the factors of condensed bodies, bytes.
    pub factor_bytes: Option<u64>,
    /// Steps whose contact problem took more than one solution, for models that solve one per step.
    pub repeated_contact_solutions: Option<u64>,
    /// All contacts of a ball that gravity brings back, the first one included; else empty. All
    /// other results but the ending, the history and the final energies belong to the first
    /// contact.
    pub bounces: Vec<Bounce>,
    /// The state of a ball that has come to rest.
    pub rest: Option<RestState>,
    /// Instants over contact and separation.
    pub history: Vec<HistoryRow>,
    /// Fields of finite elements, in the order of time.
    pub snapshots: Vec<Snapshot>,
    /// Fields at the requested probes in the order of time, one entry per probe
    /// ([`Probes::reduce`](crate::Probes::reduce)).
    pub probes: Vec<Snapshot>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

/// One body after a collision.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyResult {
    /// Elements of its mesh.
    pub elements: Option<usize>,
    /// Nodes of its mesh.
    pub nodes: Option<usize>,
    /// Mass, kg; a wall or a half-space has none.
    pub mass: Option<f64>,
    /// Mass that mass scaling moved to light nodes of the body, kg.
    pub added_mass: Option<f64>,
    /// Velocity of the mass centre along +y, m/s; of a half-space far away.
    pub velocity_after: Option<f64>,
    /// Energy left in its vibrations, J; for a half-space that of the outgoing waves.
    pub vibration_energy: Option<f64>,
}

impl Collision {
    /// Returns the mass that mass scaling moves to light nodes of each body, over the mass of the
    /// lighter body.
    pub fn added_shares(&self) -> [Option<f64>; 2] {
        let lightest = self.bodies.iter().filter_map(|body| body.mass).reduce(f64::min);
        self.bodies.each_ref().map(|body| Some(body.added_mass? / lightest?))
    }

    /// Creates an empty result of a collision that was not computed, with the reason.
    pub fn stopped(approach: Approach, stop: Stop) -> Self {
        Self {
            approach,
            ending: Ending::Stopped(stop),
            restitution: None,
            contact_time: None,
            first_contact: None,
            last_contact: None,
            contact_episodes: 0,
            peak_force: None,
            peak_force_raw: None,
            max_approach: None,
            max_contact_radius: None,
            peak_pressure: None,
            peak_pressure_radius: None,
            force_scatter: None,
            noisiest_instant: None,
            deepest_overlap: None,
            candidate_region: None,
            initial_energy: None,
            energies: EnergyLedger::EMPTY,
            residual: None,
            residual_relative: None,
            residual_since: None,
            energy_growth: None,
            momentum_residual_relative: None,
            bodies: [BodyResult::default(); 2],
            time_step: None,
            plain_time_step: None,
            steps: None,
            element_updates: None,
            factor_bytes: None,
            repeated_contact_solutions: None,
            bounces: Vec::new(),
            rest: None,
            history: Vec::new(),
            snapshots: Vec::new(),
            probes: Vec::new(),
            warnings: Vec::new(),
        }
    }

    /// Returns the reason if the run was stopped.
    pub fn stop(&self) -> Option<&Stop> {
        match &self.ending {
            Ending::Stopped(stop) => Some(stop),
            Ending::Parted | Ending::Together | Ending::AtRest => None,
        }
    }

    /// Returns whether the collision ended by itself.
    pub fn is_complete(&self) -> bool {
        self.stop().is_none()
    }

    /// Returns whether the caller interrupted the run.
    pub fn is_interrupted(&self) -> bool {
        matches!(self.stop(), Some(Stop::Interrupted { .. }))
    }

    /// Returns the snapshot at a named instant, if it was requested and occurred.
    pub fn snapshot(&self, label: SnapshotInstant) -> Option<&Snapshot> {
        self.snapshots.iter().find(|snapshot| snapshot.label == Some(label))
    }

    /// Returns the candidate radius (m) if the contact outgrew it.
    pub fn outgrown_radius(&self) -> Option<f64> {
        match self.stop() {
            Some(Stop::ContactBeyondCandidates { radius, .. }) => Some(*radius),
            _ => None,
        }
    }
}

/// The part of the surfaces in which a model looks for contact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CandidateRegion {
    /// Distance from the axis out to which contact is looked for, m.
    pub radius: f64,
    /// Number of points that can touch.
    pub n_points: usize,
    /// Whether the points are nodes of one surface; otherwise they are integration points.
    pub at_nodes: bool,
}
