//! The result of a collision: its quantities, and how it ended.

mod collision;
mod ending;
mod quantity_of_interest;

pub use collision::{
    BodyResult, Bounce, CandidateRegion, Collision, MAX_RESIDUAL, PressureRecord, RestState,
    StaticContact, TangentialErrors, TangentialResult,
};
pub use ending::{Ending, STAY_TOGETHER, Stop};
pub use quantity_of_interest::{QuantityOfInterest, Status};
