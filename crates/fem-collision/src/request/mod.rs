//! The input of a model: the bodies, their approach, and the requested output.

mod approach;
mod body_input;
mod frame;
mod output_request;

pub use approach::{Approach, ApproachError};
pub use body_input::{BodyInput, far_radius_at_rest, far_radius_of_waves};
pub use frame::Frame;
pub use output_request::{Expectation, OutputRequest, OutputRequestError, POST_CONTACT_FRACTION};
