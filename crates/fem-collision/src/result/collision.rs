//! The result of a collision, the same for every model.

use serde::{Deserialize, Serialize};

use crate::fields::{Snapshot, SnapshotInstant};
use crate::request::Approach;
use crate::result::{Ending, Stop};
use crate::run::{DeepestOverlap, EnergyLedger, HistoryRow, StepInstant};

/// Largest energy residual of a valid run, as a fraction of the initial energy.
pub const MAX_RESIDUAL: f64 = 1e-3;

/// The result of a collision, complete or up to the stop. `None` means that the model does not
/// compute the quantity or that it has no value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Collision {
    /// Initial velocities and gap.
    pub approach: Approach,
    /// How the collision ended.
    pub ending: Ending,
    /// Restitution of the collision ([`Ending::restitution`]).
    pub restitution: Option<f64>,
    /// Time from the first to the last contact force, including intervals in which the surfaces were open, s.
    pub contact_time: Option<f64>,
    /// First instant with a contact force since the start of the case, s.
    pub first_contact: Option<f64>,
    /// Last instant with a contact force so far, s.
    pub last_contact: Option<f64>,
    /// Number of separate contacts.
    pub contact_episodes: u64,
    /// Largest contact force, N. Models with time steps average it over [`PEAK_WINDOW`](crate::PEAK_WINDOW) of the pulse.
    pub peak_force: Option<f64>,
    /// Largest contact force of a single step, N.
    pub peak_force_raw: Option<f64>,
    /// Largest approach, m.
    pub max_approach: Option<f64>,
    /// Largest contact radius, averaged as the force is, m.
    pub max_contact_radius: Option<f64>,
    /// Largest contact pressure on the axis, averaged as the force is, Pa. The first touch does not count
    /// ([`ForcePulse`](crate::ForcePulse)).
    pub peak_pressure: Option<f64>,
    /// Contact radius at that pressure, m, for models with meshes.
    pub peak_pressure_radius: Option<f64>,
    /// Scatter of the contact force from sample to sample, N; close to 0 for a smooth pulse.
    pub force_scatter: Option<f64>,
    /// The instant at which the force scatters most.
    pub noisiest_instant: Option<StepInstant>,
    /// The deepest overlap of the surfaces; `None` for a contact without springs.
    pub deepest_overlap: Option<DeepestOverlap>,
    /// The final candidate region of the contact, for models that limit the search.
    pub candidate_region: Option<CandidateRegion>,
    /// Kinetic energy at the start without walls and half-spaces, J.
    pub initial_energy: Option<f64>,
    /// Energy in each account at the end, J.
    pub energies: EnergyLedger,
    /// Energy residual at the end, J.
    pub residual: Option<f64>,
    /// Largest energy residual, over the initial kinetic energy in the frame of the mass centre; with gravity over the
    /// sum of that and the work of the weight on the approach.
    pub residual_relative: Option<f64>,
    /// The instant at which that first exceeded [`MAX_RESIDUAL`], for models with time steps.
    pub residual_since: Option<StepInstant>,
    /// Largest spurious energy growth at any step, over the initial kinetic energy in the frame of
    /// the mass centre; for a bouncing ball that of its worst contact. `None` for models with one
    /// degree of freedom.
    pub energy_growth: Option<f64>,
    /// Largest momentum residual over Σ m|v| at the start: the drift of the total momentum, or the difference between the
    /// exchanged momentum and the impulse of the contact force. `None` for models with one degree of freedom, which
    /// conserve momentum by definition.
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
    /// All contacts of a ball that gravity brings back, the first one included; else empty. Every other result, except
    /// the ending, the history and the final energies, describes the first contact.
    pub bounces: Vec<Bounce>,
    /// The state of a ball that has come to rest.
    pub rest: Option<RestState>,
    /// The tangential half of an oblique impact; `None` of a head-on one, or of bodies that stay together.
    pub tangential: Option<TangentialResult>,
    /// Force and pressures at the steps of the contact, if they were asked for
    /// ([`OutputRequest::pressures`](crate::OutputRequest::pressures)).
    pub pressures: Option<PressureRecord>,
    /// Samples over contact and separation.
    pub history: Vec<HistoryRow>,
    /// Fields of finite elements, in the order of time.
    pub snapshots: Vec<Snapshot>,
    /// Bodies that flowed plastically, after the separation ([`SnapshotInstant::AfterSeparation`]).
    pub unloaded: Option<Snapshot>,
    /// Fields at the requested probes in the order of time, one entry per probe
    /// ([`Probes::reduce`](crate::Probes::reduce)).
    pub probes: Vec<Snapshot>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

/// One contact of a ball that bounces.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bounce {
    /// Time of first touch since the start of the case, s.
    pub time: f64,
    /// Relative speed at first touch, m/s.
    pub speed_before: f64,
    /// Relative velocity after the contact over that before; 0 if the ball stays.
    pub restitution: f64,
    /// Time from first to last contact force, s; `None` if the ball stays.
    pub contact_time: Option<f64>,
    /// Largest contact force, N.
    pub peak_force: Option<f64>,
}

impl Bounce {
    /// Returns the contact as a collision of its own, without history and fields; `None` for a speed that no approach has.
    pub fn collision(&self) -> Option<Collision> {
        let approach = Approach::new([0.0, -self.speed_before], 0.0).ok()?;
        Some(Collision {
            restitution: Some(self.restitution),
            contact_time: self.contact_time,
            peak_force: self.peak_force,
            ..Collision::empty(approach, Ending::Parted)
        })
    }
}

/// The tangential half of an oblique impact. Velocities are along x, angular ones right-handed about x × y.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TangentialResult {
    /// Velocity of the contact patch of the first body relative to that of the second, before and after, m/s.
    pub patch_velocity: [f64; 2],
    /// Tangential over normal impulse; positive against the velocity of the patch before.
    pub impulse_ratio: f64,
    /// Velocities of the mass centres after the impact, m/s.
    pub velocities: [f64; 2],
    /// Angular velocities after the impact, rad/s.
    pub spins: [f64; 2],
    /// Parts of the error of the velocity of the patch after the impact, m/s; `None` of one that is not known.
    pub errors: TangentialErrors,
}

/// Parts of the error of the velocity of a rebounding contact patch, m/s, at the restitution that the model computes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TangentialErrors {
    /// By the numbers of springs and steps, and by a mesh.
    pub discretisation: Option<f64>,
    /// By neglected effects.
    pub model: Option<f64>,
    /// Slopes of the velocity in that before, and in the relative change of the tangential stiffness over the normal one (m/s).
    pub slopes: [f64; 2],
}

/// Force and pressures of a contact at equal steps of time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PressureRecord {
    /// Time between two steps, s.
    pub time_step: f64,
    /// Contact forces, N.
    pub forces: Vec<f64>,
    /// Pairs of radius (m) and pressure (Pa) from the axis outward.
    pub profiles: Vec<Vec<(f64, f64)>>,
}

/// The static contact of a ball at rest, after all relaxation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RestState {
    /// Time since the start of the case from which the ball stays, s.
    pub time: f64,
    /// The static contact under its weight.
    pub contact: StaticContact,
}

/// A contact under a constant force, with equilibrium moduli.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StaticContact {
    /// Contact force, N.
    pub force: f64,
    /// Approach of the mass centres since first touch, m.
    pub approach: f64,
    /// Contact radius, where the pressure falls to zero, m; `None` if the model has none.
    pub contact_radius: Option<f64>,
    /// Contact pressure on the axis, Pa; `None` if the model has none.
    pub centre_pressure: Option<f64>,
}

/// The result of one body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyResult {
    /// Number of elements of the mesh.
    pub elements: Option<usize>,
    /// Number of nodes of the mesh.
    pub nodes: Option<usize>,
    /// Mass, kg; a wall or a half-space has none.
    pub mass: Option<f64>,
    /// Mass that mass scaling moved to light nodes of the body, kg.
    pub moved_mass: Option<f64>,
    /// Velocity of the mass centre along +y, m/s; for a half-space that of its far boundary.
    pub velocity_after: Option<f64>,
    /// Energy of the vibrations that are left, J; for a half-space that of the outgoing waves.
    pub vibration_energy: Option<f64>,
    /// Elastic energy of the residual stress that plastic flow leaves, J.
    pub locked_in: Option<f64>,
}

impl Collision {
    /// Returns the mass that mass scaling moves to light nodes of each body, over the mass of the
    /// lighter body.
    pub fn moved_shares(&self) -> [Option<f64>; 2] {
        let lightest = self.bodies.iter().filter_map(|body| body.mass).reduce(f64::min);
        self.bodies.each_ref().map(|body| Some(body.moved_mass? / lightest?))
    }

    /// Creates an empty result of a collision that was not computed, with the reason.
    pub fn stopped(approach: Approach, stop: Stop) -> Self {
        Self::empty(approach, Ending::Stopped(stop))
    }

    /// Creates a result without quantities.
    pub fn empty(approach: Approach, ending: Ending) -> Self {
        Self {
            approach,
            ending,
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
            tangential: None,
            pressures: None,
            history: Vec::new(),
            snapshots: Vec::new(),
            unloaded: None,
            probes: Vec::new(),
            warnings: Vec::new(),
        }
    }

    /// Returns the collision with all its instants shifted by `delay`, s.
    #[must_use]
    pub fn later_by(self, delay: f64) -> Self {
        let later = |time: Option<f64>| time.map(|time| delay + time);
        let step = |at: Option<StepInstant>| at.map(|at| at.later_by(delay));
        let shifted = Self {
            ending: match self.ending {
                Ending::Stopped(stop) => Ending::Stopped(stop.later_by(delay)),
                ending => ending,
            },
            first_contact: later(self.first_contact),
            last_contact: later(self.last_contact),
            noisiest_instant: step(self.noisiest_instant),
            deepest_overlap: self.deepest_overlap.map(|deepest| deepest.later_by(delay)),
            residual_since: step(self.residual_since),
            ..self
        };
        shifted.map_samples(
            |row| HistoryRow { time: delay + row.time, ..row },
            |fields| Snapshot { time: delay + fields.time, ..fields },
        )
    }

    /// Returns the collision with each row of the history changed by `row`, and each snapshot and probe sample by `fields`.
    #[must_use]
    pub fn map_samples(
        self,
        row: impl Fn(HistoryRow) -> HistoryRow,
        fields: impl Fn(Snapshot) -> Snapshot,
    ) -> Self {
        Self {
            history: self.history.into_iter().map(row).collect(),
            snapshots: self.snapshots.into_iter().map(&fields).collect(),
            probes: self.probes.into_iter().map(&fields).collect(),
            unloaded: self.unloaded.map(&fields),
            ..self
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

/// The candidate region: the part of the surfaces in which a model searches for contact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CandidateRegion {
    /// Largest distance from the axis, m.
    pub radius: f64,
    /// Number of points that may be in contact.
    pub n_points: usize,
    /// Whether the points are nodes of one surface; otherwise they are integration points.
    pub at_nodes: bool,
}
