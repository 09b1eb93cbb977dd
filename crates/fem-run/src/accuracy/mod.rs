//! The study of accuracy: runs, text and files.

mod climb;
mod findings;
mod page;
mod picture;

pub use climb::{Climb, climb};
pub use findings::{Findings, json, write_csv};
pub use page::{markdown, report};
pub use picture::picture;
