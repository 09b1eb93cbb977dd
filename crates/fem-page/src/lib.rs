//! Collisions in the browser: the text of a case goes in, numbers and pictures come out.
//!
//! ```text
//! page (HTML, CSS, JavaScript in web/) ─ worker ─ module ─ Session ─ fem
//! sliders, pictures, stories             slices   JSON      one case   any model
//! ```
//!
//! A [`Session`] holds the last case, its collision, and the condensed bodies that cases share; it knows neither a
//! browser nor a clock. [`module`] is its WebAssembly interface, which exchanges numbers and bytes and imports
//! nothing. `build.sh` combines both into a page of one file.

mod charts;
mod contour;
pub mod module;
mod outcome;
mod session;
mod sharing;

pub use charts::{ChartSpec, Charts, CurveSpec, MarkSpec};
pub use contour::StressPicture;
pub use outcome::{
    CaseFault, CostEstimate, EffectExplanation, FrameInfo, LibraryEntry, RunOutcome, RunStart,
};
pub use session::{RecordedAmount, Session};
pub use sharing::EnergyShares;
