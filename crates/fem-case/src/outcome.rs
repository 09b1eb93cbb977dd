//! What comes out of a collision, the same for every model. `None`: the model knows it not, or it
//! has no value.

use std::fmt;
use std::time::Duration;

use fem_condensed::CondensedError;
use fem_explicit::{Collision, Stop};
use fem_collision::Snapshot;
use fem_laws::LawError;

use crate::problem::Problem;
use crate::scene::Body;

/// What is said of a restitution of 0.
pub(crate) const STAY_TOGETHER: &str =
    "the bodies stay together: nothing drives them apart, and the contact has no end";

/// A collision as far as it got. SI.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Relative velocity after over before, 1 when elastic.
    pub restitution: Option<f64>,
    /// First to last instant with a contact force.
    pub contact_time: Option<f64>,
    /// Closed contacts, openings in between not counted.
    pub contact_episodes: u64,
    /// Largest contact force.
    pub peak_force: Option<f64>,
    /// Largest approach.
    pub max_approach: Option<f64>,
    /// Largest contact radius.
    pub max_contact_radius: Option<f64>,
    /// Largest pressure on the axis.
    pub peak_pressure: Option<f64>,
    /// Kinetic energy at the start.
    pub initial_energy: Option<f64>,
    /// Worst imbalance of energy over the initial kinetic energy in the frame of the mass centre.
    pub residual_relative: Option<f64>,
    /// Worst drift of momentum over Σ m|v| at the start.
    pub momentum_residual_relative: Option<f64>,
    /// Each body.
    pub bodies: [BodyOutcome; 2],
    /// Of a model that steps in time with a fixed step.
    pub time_step: Option<f64>,
    /// Likewise.
    pub steps: Option<u64>,
    /// Elements times steps.
    pub element_updates: Option<u64>,
    /// Instants over contact and separation.
    pub history: Vec<OutcomeRow>,
    /// Why it did not end by itself.
    pub halt: Option<Halt>,
    /// What the user should know.
    pub warnings: Vec<String>,
    /// Of the explicit model.
    pub collision: Option<Box<Collision>>,
    /// Fields of finite elements, in the order of time.
    pub snapshots: Vec<Snapshot>,
    /// Of a model whose run does more than to step.
    pub timing: Option<Timing>,
}

/// Where the time of a run went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// Until the collision could begin.
    pub setup: Duration,
    /// The collision alone.
    pub collision: Duration,
}

/// One body after a collision.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyOutcome {
    /// Of a mesh.
    pub elements: Option<usize>,
    /// Likewise.
    pub nodes: Option<usize>,
    /// kg; a wall has none.
    pub mass: Option<f64>,
    /// By mass scaling, kg.
    pub added_mass: Option<f64>,
    /// Along +y, m/s.
    pub velocity_after: Option<f64>,
    /// Left in the body, J.
    pub vibration_energy: Option<f64>,
}

/// One instant. SI; energies since the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutcomeRow {
    /// Since the start of the case.
    pub time: f64,
    /// Positive in compression.
    pub contact_force: f64,
    /// Where the pressure falls to zero.
    pub contact_radius: Option<f64>,
    /// Decrease of the distance of the mass centres since first touch.
    pub approach: f64,
    /// On the axis.
    pub centre_pressure: Option<f64>,
    /// Along +y.
    pub velocity: [f64; 2],
    /// Of the bodies but walls.
    pub kinetic: f64,
    /// Held by bodies or contact law.
    pub strain: Option<f64>,
    /// Held by the springs of a penalty contact.
    pub contact: Option<f64>,
    /// Lost in bodies or contact law.
    pub viscous_dissipation: Option<f64>,
    /// Done by a moving wall.
    pub wall_work: f64,
    /// What these do not account for.
    pub residual: Option<f64>,
}

/// Why a collision did not end by itself.
#[derive(Clone, Debug, PartialEq)]
pub enum Halt {
    /// Finite elements.
    Fem(Stop),
    /// A reduced model.
    Law(LawError),
    /// Condensed bodies.
    Condensed(CondensedError),
}

impl From<LawError> for Halt {
    fn from(error: LawError) -> Self {
        Self::Law(error)
    }
}

impl From<CondensedError> for Halt {
    fn from(error: CondensedError) -> Self {
        Self::Condensed(error)
    }
}

impl fmt::Display for Halt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Halt::Fem(stop) => stop.fmt(f),
            Halt::Law(error) => error.fmt(f),
            Halt::Condensed(error) => error.fmt(f),
        }
    }
}

impl Outcome {
    /// Whether the user ended it.
    pub fn is_interrupted(&self) -> bool {
        matches!(
            self.halt,
            Some(
                Halt::Fem(Stop::Interrupted { .. })
                    | Halt::Condensed(CondensedError::Interrupted { .. })
            )
        )
    }

    /// Nothing, and why.
    pub(crate) fn halted(halt: Halt) -> Self {
        Self {
            restitution: None,
            contact_time: None,
            contact_episodes: 0,
            peak_force: None,
            max_approach: None,
            max_contact_radius: None,
            peak_pressure: None,
            initial_energy: None,
            residual_relative: None,
            momentum_residual_relative: None,
            bodies: [BodyOutcome::default(); 2],
            time_step: None,
            steps: None,
            element_updates: None,
            history: Vec::new(),
            halt: Some(halt),
            warnings: Vec::new(),
            collision: None,
            snapshots: Vec::new(),
            timing: None,
        }
    }

    /// Of explicit finite elements.
    pub fn of_fem(problem: &Problem, mut collision: Collision) -> Self {
        let is_complete = collision.stopped.is_none();
        let ends = collision.first_contact.zip(collision.last_contact);
        Self {
            restitution: collision.restitution,
            // A contact that was left before its end has no duration.
            contact_time: ends.filter(|_| is_complete).map(|(first, last)| last - first),
            contact_episodes: collision.contact_episodes,
            peak_force: Some(collision.peak_force),
            max_approach: Some(collision.max_approach),
            max_contact_radius: Some(collision.max_contact_radius),
            peak_pressure: Some(collision.peak_pressure),
            initial_energy: Some(collision.initial_energy),
            residual_relative: Some(collision.residual_relative),
            momentum_residual_relative: Some(collision.momentum_residual_relative),
            bodies: [0, 1].map(|side| fem_body(problem, &collision, side)),
            time_step: Some(problem.model.time_step()),
            steps: Some(collision.steps),
            element_updates: Some(collision.element_updates),
            history: collision.history.iter().map(OutcomeRow::of_fem).collect(),
            halt: collision.stopped.clone().map(Halt::Fem),
            warnings: collision.warnings.clone(),
            snapshots: std::mem::take(&mut collision.snapshots),
            collision: Some(Box::new(collision)),
            timing: None,
        }
    }
}

fn fem_body(problem: &Problem, collision: &Collision, side: usize) -> BodyOutcome {
    let body = &problem.model.bodies()[side];
    let is_sphere = body.mesh().is_some();
    BodyOutcome {
        elements: Some(body.n_elements()),
        nodes: Some(body.n_nodes()),
        mass: is_sphere.then(|| body.mass()),
        added_mass: is_sphere.then(|| body.added_mass()),
        velocity_after: collision.stopped.is_none().then_some(collision.velocity_after[side]),
        vibration_energy: collision.vibration_energy.filter(|_| is_sphere).map(|both| both[side]),
    }
}

impl OutcomeRow {
    fn of_fem(row: &fem_explicit::HistoryRow) -> Self {
        Self {
            time: row.time,
            contact_force: row.contact_force,
            contact_radius: Some(row.contact_radius),
            approach: row.approach,
            centre_pressure: Some(row.centre_pressure),
            velocity: row.velocity,
            kinetic: row.kinetic,
            strain: Some(row.strain),
            contact: Some(row.contact),
            viscous_dissipation: Some(row.viscous_dissipation),
            wall_work: row.wall_work,
            residual: Some(row.residual),
        }
    }
}

/// The mass of a solid sphere, kg; a wall has none.
pub(crate) fn mass_of(body: &Body) -> Option<f64> {
    Some(fem_laws::sphere_mass(body.diameter()?, body.material()?.density()))
}
