//! The result of a collision: its quantities, and how it ended.

mod bounce;
mod collision;
mod ending;
mod quantity_of_interest;

pub use bounce::{Bounce, RestState, StaticContact};
pub use collision::{BodyResult, CandidateRegion, Collision, LARGEST_RESIDUAL, STAY_TOGETHER};
pub use ending::{Ending, Stop};
pub use quantity_of_interest::QuantityOfInterest;
