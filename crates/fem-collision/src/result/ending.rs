//! The end of a run: separation, rest, or the reason why it stopped earlier.

use fem_laws::MIN_RESTITUTION;
use fem_material::engineering::{number, show};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::request::OutputRequestError;
use crate::run::StepInstant;

/// The reason why a run stopped early.
#[derive(Clone, Debug, PartialEq, Error, Serialize, Deserialize)]
pub enum Stop {
    /// The caller interrupted the run.
    #[error("interrupted at {at}")]
    Interrupted {
        /// Instant of the stop.
        at: StepInstant,
    },
    /// The contact reached the edge of the candidate region.
    #[error(
        "at {at} the contact reached the radius {wide}, \
         the edge of the region in which contact is searched for", wide = show(*radius, "m"))]
    ContactBeyondCandidates {
        /// Instant of the stop.
        at: StepInstant,
        /// Candidate radius, m.
        radius: f64,
    },
    /// A surface folds in the contact, where contact is not searched for.
    #[error(
        "at {at} the surface of the {} body folds at the radius {wide} in the contact: \
         node {node} is no farther from the axis than the next node inward; its undeformed position is \
         r = {}, y = {}",
        side_of(*body),
        show(place[0], "m"),
        show(place[1], "m"), wide = show(*radius, "m"))]
    SurfaceTurnsOver {
        /// Instant of the stop.
        at: StepInstant,
        /// Distance of the fold from the axis, m.
        radius: f64,
        /// The body: 0 is the lower one, 1 the upper one.
        body: usize,
        /// Number of the node.
        node: usize,
        /// Position of the node before the collision (r, y), m.
        place: [f64; 2],
    },
    /// The contact is larger than the hemisphere around it.
    #[error(
        "the contact radius reached {ratio:.2} of the smaller sphere's radius, outside of the \
         linear range; lower the speed"
    )]
    ContactTooLarge {
        /// Contact radius over the radius of the smaller sphere.
        ratio: f64,
    },
    /// The total energy has grown.
    #[error(
        "at {at} the energy is {ratio:.4} times the initial energy: the time integration \
         is unstable; the fastest node is node {node} of the {} body; its undeformed position is \
         r = {}, y = {}",
        side_of(*body),
        show(place[0], "m"),
        show(place[1], "m"))]
    EnergyGrowth {
        /// Instant of the stop.
        at: StepInstant,
        /// Total energy over initial energy.
        ratio: f64,
        /// The body: 0 is the lower one, 1 the upper one.
        body: usize,
        /// Number of the node that moves fastest relative to the body.
        node: usize,
        /// Position of the node before the collision (r, y), m.
        place: [f64; 2],
    },
    /// The motion is NaN.
    #[error(
        "at {at} the motion of node {node} of the {} body is not a number; its undeformed \
         position is r = {}, y = {}",
        side_of(*body),
        show(place[0], "m"),
        show(place[1], "m"))]
    NoNumber {
        /// Instant of the stop.
        at: StepInstant,
        /// The body: 0 is the lower one, 1 the upper one.
        body: usize,
        /// Number of the node.
        node: usize,
        /// Position of the node before the collision (r, y), m.
        place: [f64; 2],
    },
    /// The energy residual is too large.
    #[error("at {at} the energy residual is {relative:.1e} of the initial energy", at = show(*time, "s"))]
    EnergyImbalance {
        /// Time since the start of the case, s.
        time: f64,
        /// Energy residual over the initial energy.
        relative: f64,
    },
    /// An element at finite strain has lost its volume.
    #[error(
        "at {at} element {element} of the {} body is {}; its undeformed position is \
         r = {}, y = {}",
        side_of(*body),
        fate(*volume_ratio),
        show(place[0], "m"),
        show(place[1], "m"))]
    ElementCollapsed {
        /// Instant of the stop.
        at: StepInstant,
        /// The body: 0 is the lower one, 1 the upper one.
        body: usize,
        /// Number of the element.
        element: usize,
        /// Centre of the element before the collision (r, y), m.
        place: [f64; 2],
        /// Volume over that of the undeformed element; not positive if the element is inverted.
        volume_ratio: f64,
    },
    /// The law of an element has lost ellipticity, and the energy residual is too large.
    #[error(
        "at {at} element {element} of the {} body became unstable: the law {law} loses \
         ellipticity at stretches of {:.3} and {:.3} in the meridian plane and {:.3} around the axis; its \
         undeformed position is r = {}, y = {}",
        side_of(*body),
        stretches[0],
        stretches[1],
        stretches[2],
        show(place[0], "m"),
        show(place[1], "m"))]
    StabilityLost {
        /// Instant of the first instability.
        at: StepInstant,
        /// The body: 0 is the lower one, 1 the upper one.
        body: usize,
        /// Number of the element.
        element: usize,
        /// Centre of the element before the collision (r, y), m.
        place: [f64; 2],
        /// Principal stretches: two in the meridian plane, the larger first, and the circumferential one.
        stretches: [f64; 3],
        /// Name of the law in cases.
        law: String,
    },
    /// The stiffness has become too large for any time step.
    #[error(
        "at {at} {} is too stiff for any time step; its undeformed position is \
         r = {}, y = {}",
        place_at_fault(*body, *of_contact),
        show(place[0], "m"),
        show(place[1], "m"))]
    NoStepShortEnough {
        /// Instant of the stop.
        at: StepInstant,
        /// The body: 0 is the lower one, 1 the upper one.
        body: usize,
        /// Position (r, y) before the collision of the node with the shortest critical step, m.
        place: [f64; 2],
        /// Whether the contact contributes more stiffness than the elements.
        of_contact: bool,
    },
    /// The bodies stayed together too long.
    #[error("at {at} the bodies have not separated")]
    NoSeparation {
        /// Instant of the stop.
        at: StepInstant,
    },
    /// The bodies have overlapped for too long without any closed spring.
    #[error(
        "at {at} the approach since first touch is {}, but no spring between the \
         surfaces has closed", show(*approach, "m"))]
    NoContact {
        /// Instant of the stop.
        at: StepInstant,
        /// Approach since first touch, m.
        approach: f64,
    },
    /// The run reached its limit of element updates.
    #[error(
        "at {at} the run reached its limit of {updates:.1e} element updates before the \
         bodies separated",
        updates = *element_updates as f64)]
    TooManyUpdates {
        /// Instant of the stop.
        at: StepInstant,
        /// Number of elements times number of steps.
        element_updates: u64,
    },
    /// The contact problem of a step was not solved.
    #[error("at {at} no contact state without tension and overlap was found", at = show(*time, "s"))]
    NoContactState {
        /// Time since the start of the case, s.
        time: f64,
    },
    /// The model cannot be built for this collision.
    #[error("{0}")]
    NotMade(String),
    /// The model needs more memory than there is.
    #[error("{0}")]
    OutOfMemory(String),
    /// The motion of a model with one degree of freedom does not end.
    #[error("{0}")]
    NotFinished(String),
    /// The collision is outside of the model's range of validity.
    #[error("{0}")]
    OutsideValidity(String),
    /// A result is outside of the range of numbers.
    #[error("{0}")]
    OutOfRange(String),
}

fn side_of(body: usize) -> &'static str {
    if body == 0 { "lower" } else { "upper" }
}

fn place_at_fault(body: usize, of_contact: bool) -> String {
    let what = if of_contact { "the contact, on steep flanks, at" } else { "the material around" };
    format!("{what} a node of the {} body", side_of(body))
}

/// Describes an element by the ratio of its volume to the undeformed one.
fn fate(volume_ratio: f64) -> String {
    if volume_ratio > 0.0 {
        format!("compressed to {} of its volume", number(volume_ratio, 3))
    } else {
        "turned inside out".to_string()
    }
}

impl From<OutputRequestError> for Stop {
    fn from(error: OutputRequestError) -> Self {
        Self::NotMade(error.to_string())
    }
}

impl Stop {
    /// Returns this reason with its time shifted by `delay`, s, for a run whose time starts at another instant.
    #[must_use]
    pub fn later_by(mut self, delay: f64) -> Self {
        match &mut self {
            Self::Interrupted { at }
            | Self::ContactBeyondCandidates { at, .. }
            | Self::SurfaceTurnsOver { at, .. }
            | Self::EnergyGrowth { at, .. }
            | Self::NoNumber { at, .. }
            | Self::ElementCollapsed { at, .. }
            | Self::StabilityLost { at, .. }
            | Self::NoStepShortEnough { at, .. }
            | Self::NoSeparation { at }
            | Self::NoContact { at, .. }
            | Self::TooManyUpdates { at, .. } => *at = at.later_by(delay),
            Self::EnergyImbalance { time, .. } | Self::NoContactState { time } => *time += delay,
            Self::ContactTooLarge { .. }
            | Self::NotMade(_)
            | Self::OutOfMemory(_)
            | Self::NotFinished(_)
            | Self::OutsideValidity(_)
            | Self::OutOfRange(_) => {}
        }
        self
    }
}

/// Warning for bodies with a restitution of 0.
pub const STAY_TOGETHER: &str = "the bodies stay together: next to nothing of the speed of approach would come back, so the \
     run ends before the contact does";

/// The end of a collision.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Ending {
    /// The bodies have separated.
    Parted,
    /// The bodies stay together: too little energy is left to separate them.
    Together,
    /// The upper body has come to rest on the lower one after at least one bounce.
    AtRest,
    /// The run stopped early; the results are those until then.
    Stopped(Stop),
}

/// Excess of a restitution over 1 that integrators leave to a contact that loses nothing. A larger one is an error and stays.
const ROUNDING: f64 = 1e-9;

impl Ending {
    /// Returns the ending of bodies that have separated at a rate, m/s: they count as together below [`MIN_RESTITUTION`].
    pub fn parted(rate_of_separation: f64, approach_speed: f64) -> Self {
        match rate_of_separation < MIN_RESTITUTION * approach_speed {
            true => Self::Together,
            false => Self::Parted,
        }
    }

    /// Returns the restitution: rate of separation over approach speed for bodies that have separated, 0 for bodies that
    /// stay together, and `None` for a run that was stopped.
    pub fn restitution(&self, rate_of_separation: f64, approach_speed: f64) -> Option<f64> {
        match self {
            Self::Parted => {
                let restitution = rate_of_separation / approach_speed;
                Some(if restitution < 1.0 + ROUNDING { restitution.min(1.0) } else { restitution })
            }
            Self::Together | Self::AtRest => Some(0.0),
            Self::Stopped(_) => None,
        }
    }

    /// Returns the warning about bodies that stay together.
    pub fn together_warning(&self) -> Option<String> {
        matches!(self, Self::Together | Self::AtRest).then(|| STAY_TOGETHER.to_string())
    }
}
