//! What comes out of a collision, the same for every model.

use serde::{Deserialize, Serialize};

use crate::fields::{Snapshot, SnapshotInstant};
use crate::request::Approach;
use crate::result::{Bounce, Ending, RestState, Stop};
use crate::run::{DeepestOverlap, EnergyLedger, HistoryRow, StepInstant};

/// What is said of a restitution of 0.
pub const STAY_TOGETHER: &str = "the bodies stay together: what drives them apart is worth less than a thousandth of the speed of approach, and the \
     contact is not followed to an end";

/// Energy of a sound collision adds up to this share of the initial.
pub const LARGEST_RESIDUAL: f64 = 1e-3;

/// A collision as far as it got. `None`: the model knows it not, or it has no value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Collision {
    /// How the bodies met.
    pub approach: Approach,
    /// How it ended.
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
    /// How far the contact force scatters from instant to instant, N: none of a smooth pulse.
    pub force_scatter: Option<f64>,
    /// When it scatters most.
    pub noisiest: Option<StepInstant>,
    /// Where springs let the surfaces overlap most; none of a contact without.
    pub deepest: Option<DeepestOverlap>,
    /// Where contact was looked for in the end, of a model that does not look everywhere.
    pub searched: Option<CandidateRegion>,
    /// Kinetic energy at the start, walls and half-spaces not counted, J.
    pub initial_energy: Option<f64>,
    /// What is in each account of energy at the end, J.
    pub energies: EnergyLedger,
    /// What the energies do not account for at the end, J.
    pub residual: Option<f64>,
    /// Worst imbalance of energy over the initial kinetic energy in the frame of the mass centre, with gravity
    /// over that and what the weight has given while the bodies came closer.
    pub residual_relative: Option<f64>,
    /// When that was first above [`LARGEST_RESIDUAL`], of a model that steps in time.
    pub residual_since: Option<StepInstant>,
    /// Most energy that the bodies have held above what they had and were given, at any step, over the initial
    /// kinetic energy in the frame of the mass centre; of a ball that bounces that of its worst contact. `None`
    /// of one degree of freedom.
    pub energy_growth: Option<f64>,
    /// Worst drift of momentum over Σ m|v| at the start, or of the momentum that the bodies have
    /// exchanged from the impulse of the contact force. `None` of one degree of freedom, from which
    /// both velocities follow because momentum is kept: that cannot fail.
    pub momentum_residual_relative: Option<f64>,
    /// Lower and upper body.
    pub bodies: [BodyResult; 2],
    /// Of a model that steps in time with a fixed step, s.
    pub time_step: Option<f64>,
    /// What that step would be without mass scaling, of a model that has it, s.
    pub plain_time_step: Option<f64>,
    /// Steps done by such a model.
    pub steps: Option<u64>,
    /// Elements times steps, of a model that computes each element at each step.
    pub element_updates: Option<u64>,
    /// Memory of the factors of condensed bodies, bytes.
    pub factor_bytes: Option<u64>,
    /// Steps whose contact problem took more than one solution, of a model that solves one a step.
    pub repeated_contact_solutions: Option<u64>,
    /// Of a ball that gravity brings back: each contact, the first one among them; else none. All else
    /// here but the ending, the history and the energies at the end is of the first one.
    pub bounces: Vec<Bounce>,
    /// Of a ball that has come to rest.
    pub rest: Option<RestState>,
    /// Instants over contact and separation.
    pub history: Vec<HistoryRow>,
    /// Fields of finite elements, in the order of time.
    pub snapshots: Vec<Snapshot>,
    /// What the probes that were asked for saw, in the order of time: fields of one entry a probe
    /// ([`Probes::reduce`](crate::Probes::reduce)).
    pub probes: Vec<Snapshot>,
    /// What the user should know.
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
    /// Added to light nodes by mass scaling, from others of the body, kg.
    pub added_mass: Option<f64>,
    /// Velocity of the mass centre along +y, m/s; of a half-space far away.
    pub velocity_after: Option<f64>,
    /// Energy left in its vibrations, J; of a half-space that of the waves that go out.
    pub vibration_energy: Option<f64>,
}

impl Collision {
    /// What mass scaling adds to light nodes of each body, over the mass of the lighter one of both.
    pub fn added_shares(&self) -> [Option<f64>; 2] {
        let lightest = self.bodies.iter().filter_map(|body| body.mass).reduce(f64::min);
        self.bodies.each_ref().map(|body| Some(body.added_mass? / lightest?))
    }

    /// Nothing of bodies that were to meet like this, and why.
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
            noisiest: None,
            deepest: None,
            searched: None,
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

    /// Why it did not end by itself.
    pub fn stop(&self) -> Option<&Stop> {
        match &self.ending {
            Ending::Stopped(stop) => Some(stop),
            Ending::Parted | Ending::Together | Ending::AtRest => None,
        }
    }

    /// Whether it ended by itself.
    pub fn is_complete(&self) -> bool {
        self.stop().is_none()
    }

    /// Whether the caller ended it.
    pub fn is_interrupted(&self) -> bool {
        matches!(self.stop(), Some(Stop::Interrupted { .. }))
    }

    /// The fields at a named instant, if they were asked for and it came.
    pub fn snapshot(&self, label: SnapshotInstant) -> Option<&Snapshot> {
        self.snapshots.iter().find(|snapshot| snapshot.label == Some(label))
    }

    /// Whether the contact outgrew the region in which it is looked for, and how large that is, m.
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
    /// Whether the points are nodes of one surface; else they are its integration points.
    pub at_nodes: bool,
}
