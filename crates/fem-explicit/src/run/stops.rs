//! Reasons for which a run stops before its end, with their place.

use fem_collision::{StepInstant, Stop};
use fem_contact::SurfaceFold;

use crate::energy::EnergyGrowth;
use crate::model::ExplicitBodies;
use crate::state::State;
use crate::stress::Collapse;

/// A reason for which a step cannot be taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Fault {
    /// An element has collapsed.
    Collapsed(CollapsedElement),
    /// No step is short enough for the stiffness at a node: of the contact, or else of its elements.
    TooStiff {
        /// 0 lower, 1 upper.
        side: usize,
        node: usize,
        is_of_contact: bool,
    },
}

/// An element that its stress cannot follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CollapsedElement {
    /// 0 lower, 1 upper.
    pub side: usize,
    pub collapse: Collapse,
}

impl Fault {
    /// Returns the stop of a run in a state.
    pub fn stop(self, model: &ExplicitBodies, state: &State) -> Stop {
        let (time, step, bodies) = (state.time, state.step, model.bodies());
        match self {
            Self::Collapsed(CollapsedElement { side, collapse }) => {
                let Collapse { element, volume_ratio } = collapse;
                let place = bodies[side].element_centre(element);
                Stop::ElementCollapsed {
                    at: StepInstant { time, step },
                    body: side,
                    element,
                    place,
                    volume_ratio,
                }
            }
            Self::TooStiff { side, node, is_of_contact } => {
                let place = bodies[side].node_position(node);
                Stop::NoStepShortEnough {
                    at: StepInstant { time, step },
                    body: side,
                    place,
                    of_contact: is_of_contact,
                }
            }
        }
    }
}

/// Returns the stop of a run whose energy has grown: at the node that is fastest relative to its body, or at one whose
/// motion is not a number.
pub(super) fn stop_of_growth(model: &ExplicitBodies, growth: EnergyGrowth, state: &State) -> Stop {
    let EnergyGrowth { time, step, ratio } = growth;
    let mut fastest = (0, 0, -1.0);
    for (side, body) in model.bodies().iter().enumerate() {
        let (displacement, velocity) =
            (&state.bodies[side].displacement, &state.bodies[side].velocity);
        let centre = body.centre(velocity);
        for (node, (u, v)) in displacement.iter().zip(velocity).enumerate() {
            let square = v[0] * v[0] + (v[1] - centre) * (v[1] - centre);
            let is_lost = ![*u, *v].as_flattened().iter().all(|number| number.is_finite());
            if is_lost {
                let place = body.node_position(node);
                return Stop::NoNumber { at: StepInstant { time, step }, body: side, node, place };
            }
            if square > fastest.2 {
                fastest = (side, node, square);
            }
        }
    }
    let (body, node, _) = fastest;
    let place = model.bodies()[body].node_position(node);
    Stop::EnergyGrowth { at: StepInstant { time, step }, ratio, body, node, place }
}

/// Returns the stop of a run whose surface has turned over.
pub(super) fn stop_of_turn(model: &ExplicitBodies, turn: SurfaceFold, state: &State) -> Stop {
    let SurfaceFold { side, node, radius } = turn;
    let (time, step, node) = (state.time, state.step, node as usize);
    let place = model.bodies()[side].node_position(node);
    Stop::SurfaceTurnsOver { at: StepInstant { time, step }, radius, body: side, node, place }
}
