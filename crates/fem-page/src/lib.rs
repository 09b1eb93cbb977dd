//! The front door in a browser: text of a case in, numbers and pictures out.
//!
//! ```text
//! page (HTML, CSS, JavaScript in web/) ─ worker ─ module ─ Session ─ fem
//! sliders, pictures, stories             slices   JSON      one case   any model
//! ```
//!
//! A [`Session`] has the case that was read last, its collision, and the condensed bodies that cases
//! share; it knows neither a browser nor a clock. [`module`] is what WebAssembly exports of it: numbers
//! and bytes, no import. `build.sh` makes the page of both, one file.

mod charts;
mod contour;
mod fault;
mod library_entry;
pub mod module;
mod outcome;
mod session;
mod sharing;

pub use charts::{ChartSpec, Charts, CurveSpec, MarkSpec};
pub use contour::StressPicture;
pub use fault::Fault;
pub use library_entry::LibraryEntry;
pub use outcome::{Begun, Frame, Outcome, Price};
pub use session::{Ask, Session};
pub use sharing::Sharing;
