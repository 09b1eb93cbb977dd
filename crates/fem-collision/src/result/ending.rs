//! Why a run ends before the bodies have parted.

use fem_material::engineering::{number, show};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::request::OutputRequestError;

/// Why a run ended early. Times are those of the case, s.
#[derive(Clone, Debug, PartialEq, Error, Serialize, Deserialize)]
pub enum Stop {
    /// The caller asked for it.
    #[error("interrupted at {at} (step {step})", at = show(*time, "s"))]
    Interrupted {
        /// Since the start of the case, s.
        time: f64,
        /// Number of the step.
        step: u64,
    },
    /// The contact grew out of the part of the boundary in which it is looked for.
    #[error(
        "at {at} (step {step}) the contact reached the radius {wide}, \
         the end of the region in which it is looked for", at = show(*time, "s"), wide = show(*radius, "m"))]
    ContactBeyondCandidates {
        /// Since the start of the case, s.
        time: f64,
        /// Number of the step.
        step: u64,
        /// Candidate radius, m.
        radius: f64,
    },
    /// A surface folds where the bodies touch: beyond, contact is not looked for.
    #[error(
        "at {at} (step {step}) the surface of the {} body turns over at the radius {wide}, where the other \
         body touches it: node {node} has come as near to the axis as the one inside of it; undeformed it \
         lies at r = {}, y = {}",
        side_of(*body),
        show(place[0], "m"),
        show(place[1], "m"), at = show(*time, "s"), wide = show(*radius, "m"))]
    SurfaceTurnsOver {
        /// Since the start of the case, s.
        time: f64,
        /// Number of the step.
        step: u64,
        /// Distance of the place from the axis, m.
        radius: f64,
        /// 0 of the lower body, 1 of the upper.
        body: usize,
        /// Number of the node.
        node: usize,
        /// Where it lies before the collision (r, y), m.
        place: [f64; 2],
    },
    /// Even the whole near hemisphere is too small for the contact.
    #[error(
        "the contact reached {ratio:.2} of the smaller radius: the bodies are not linear there; \
         lower the speed"
    )]
    ContactTooLarge {
        /// Contact radius over the smaller sphere's.
        ratio: f64,
    },
    /// The energy has grown.
    #[error(
        "at {at} (step {step}) the energy is {ratio:.4} times the initial: the time integration \
         is unstable; node {node} of the {} body is fastest, undeformed it lies at r = {}, \
         y = {}",
        side_of(*body),
        show(place[0], "m"),
        show(place[1], "m"), at = show(*time, "s"))]
    EnergyGrowth {
        /// Since the start of the case, s.
        time: f64,
        /// Number of the step.
        step: u64,
        /// Total energy over initial energy.
        ratio: f64,
        /// 0 of the lower body, 1 of the upper.
        body: usize,
        /// Number of its node that moves fastest against it.
        node: usize,
        /// Where that lies before the collision (r, y), m.
        place: [f64; 2],
    },
    /// The motion is no number any more.
    #[error(
        "at {at} (step {step}) the motion of node {node} of the {} body is no number; undeformed \
         it lies at r = {}, y = {}",
        side_of(*body),
        show(place[0], "m"),
        show(place[1], "m"), at = show(*time, "s"))]
    NoNumber {
        /// Since the start of the case, s.
        time: f64,
        /// Number of the step.
        step: u64,
        /// 0 of the lower body, 1 of the upper.
        body: usize,
        /// Number of the node.
        node: usize,
        /// Where it lies before the collision (r, y), m.
        place: [f64; 2],
    },
    /// Energy came from nowhere or went there.
    #[error("at {at} the energy does not add up by {relative:.1e} of the initial", at = show(*time, "s"))]
    EnergyImbalance {
        /// Since the start of the case, s.
        time: f64,
        /// Imbalance over the initial energy.
        relative: f64,
    },
    /// An element of a body at finite strain has lost its volume.
    #[error(
        "at {at} (step {step}) element {element} of the {} body is {}; undeformed it lies at \
         r = {}, y = {}",
        side_of(*body),
        fate(*volume_ratio),
        show(place[0], "m"),
        show(place[1], "m"), at = show(*time, "s"))]
    ElementCollapsed {
        /// Since the start of the case, s.
        time: f64,
        /// Number of the step.
        step: u64,
        /// 0 of the lower body, 1 of the upper.
        body: usize,
        /// Number of the element.
        element: usize,
        /// Its centre (r, y) before the collision, m.
        place: [f64; 2],
        /// Its volume over that of the undeformed element; not positive of one that is inside out.
        volume_ratio: f64,
    },
    /// The law of an element has lost its stability, and the energy stopped adding up.
    #[error(
        "at {at} (step {step}) element {element} of the {} body has lost its stability: {law}, its \
         law, gives way at stretches of {:.3} and {:.3} in the meridian plane and {:.3} around the axis; \
         undeformed it lies at r = {}, y = {}",
        side_of(*body),
        stretches[0],
        stretches[1],
        stretches[2],
        show(place[0], "m"),
        show(place[1], "m"), at = show(*time, "s"))]
    StabilityLost {
        /// When it was first seen, since the start of the case, s.
        time: f64,
        /// Number of the step.
        step: u64,
        /// 0 of the lower body, 1 of the upper.
        body: usize,
        /// Number of the element.
        element: usize,
        /// Its centre (r, y) before the collision, m.
        place: [f64; 2],
        /// Two of the meridian plane, the larger first, and that of the hoop.
        stretches: [f64; 3],
        /// Its name in cases.
        law: String,
    },
    /// Something has become so stiff that no time step is short enough for it.
    #[error(
        "at {at} (step {step}) {} is too stiff for any time step; undeformed it lies at \
         r = {}, y = {}",
        place_at_fault(*body, *of_contact),
        show(place[0], "m"),
        show(place[1], "m"), at = show(*time, "s"))]
    NoStepShortEnough {
        /// Since the start of the case, s.
        time: f64,
        /// Number of the step.
        step: u64,
        /// 0 of the lower body, 1 of the upper.
        body: usize,
        /// The node that asks for the shortest step (r, y) before the collision, m.
        place: [f64; 2],
        /// Whether more of its stiffness is the contact's than that of its elements.
        of_contact: bool,
    },
    /// The bodies stayed together too long.
    #[error("at {at} (step {step}) the bodies have not separated", at = show(*time, "s"))]
    NoSeparation {
        /// Since the start of the case, s.
        time: f64,
        /// Number of the step.
        step: u64,
    },
    /// The bodies have overlapped for too long, and none of their springs has closed.
    #[error(
        "at {at} (step {step}) the bodies have come {} closer than at first touch, and no spring between \
         their surfaces has closed", show(*approach, "m"), at = show(*time, "s"))]
    NoContact {
        /// Since the start of the case, s.
        time: f64,
        /// Number of the step.
        step: u64,
        /// m.
        approach: f64,
    },
    /// The run has taken as much as it was allowed.
    #[error(
        "at {at} (step {step}) the run had taken {updates:.1e} element updates, as many as it \
         may, and the bodies had not separated",
        updates = *element_updates as f64, at = show(*time, "s"))]
    TooManyUpdates {
        /// Since the start of the case, s.
        time: f64,
        /// Number of the step.
        step: u64,
        /// Elements times steps.
        element_updates: u64,
    },
    /// The contact problem of a step has no solution within reach.
    #[error("at {at} no contact state without tension and overlap was found", at = show(*time, "s"))]
    NoContactState {
        /// Since the start of the case, s.
        time: f64,
    },
    /// What the model is made of cannot be made for this collision.
    #[error("{0}")]
    NotMade(String),
    /// There is no memory for what the model is made of.
    #[error("{0}")]
    OutOfMemory(String),
    /// The motion of one degree of freedom creeps on and does not end.
    #[error("{0}")]
    NotFinished(String),
    /// The collision lies outside of what the model describes.
    #[error("{0}")]
    OutsideValidity(String),
    /// A result leaves the range of numbers.
    #[error("{0}")]
    OutOfRange(String),
}

/// Which body.
fn side_of(body: usize) -> &'static str {
    if body == 0 { "lower" } else { "upper" }
}

/// What no step is short enough for.
fn place_at_fault(body: usize, of_contact: bool) -> String {
    let what = if of_contact { "the contact, on steep flanks, at" } else { "the material around" };
    format!("{what} a node of the {} body", side_of(body))
}

/// What has become of an element with so much of its volume.
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
    /// This stop so much later, s: of a run that counts its time from another instant.
    #[must_use]
    pub fn later_by(mut self, delay: f64) -> Self {
        match &mut self {
            Self::Interrupted { time, .. }
            | Self::ContactBeyondCandidates { time, .. }
            | Self::SurfaceTurnsOver { time, .. }
            | Self::EnergyGrowth { time, .. }
            | Self::NoNumber { time, .. }
            | Self::ElementCollapsed { time, .. }
            | Self::StabilityLost { time, .. }
            | Self::NoStepShortEnough { time, .. }
            | Self::EnergyImbalance { time, .. }
            | Self::NoSeparation { time, .. }
            | Self::NoContact { time, .. }
            | Self::TooManyUpdates { time, .. }
            | Self::NoContactState { time } => *time += delay,
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

/// How a collision ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Ending {
    /// The bodies have parted.
    Parted,
    /// They stay together: nothing is left to drive them apart.
    Together,
    /// The upper one has come to rest on the lower one, after a bounce or more.
    AtRest,
    /// It did not; the results are those so far.
    Stopped(Stop),
}
