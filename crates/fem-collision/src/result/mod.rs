//! The result of a collision: its quantities, and how it ended.

mod collision;
mod ending;
mod quantity_of_interest;

pub use collision::{
    BodyResult, Bounce, CandidateRegion, Collision, LARGEST_RESIDUAL, RestState, STAY_TOGETHER,
    StaticContact,
};
pub use ending::{Ending, Stop};
pub use quantity_of_interest::QuantityOfInterest;
