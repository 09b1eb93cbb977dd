//! Every fault of a case file: where it is found, what is said, what help is given.

mod gravity;
pub mod marked;
mod numbers;
mod places;
mod scene;
mod text;
