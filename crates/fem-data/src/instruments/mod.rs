//! Records of bouncing balls and of cradles as they are measured: restitutions over impact speed with their
//! uncertainties.
//!
//! ```text
//! roles ── number columns ─┬─ bounce_times ─┬─ impact: rows of the table
//! wav ─── sound: onsets ───┤                │
//!          of              ├─ track ────────┤
//!          crate::table   └─ force ────────┘
//! rig ──── free_flight, with drag ── flight_speeds, of bounce_times
//! series ─ drops, missing instants, scatter ── bad_instants, without which the others fit
//! cradle: angles of a Newton's cradle
//! ```
//!
//! A record that does not support a restitution is an error that says why. Nothing is opened here: callers pass texts and
//! their names.

mod bad_instants;
mod bounce_times;
pub mod cradle;
mod flight_speeds;
mod force;
mod free_flight;
mod impact;
mod record;
mod rig;
mod roles;
mod series;
mod sound;
mod track;
mod wav;

pub use bounce_times::{BounceTimes, Instants, TimeUncertaintySource};
pub use cradle::cradle_trials;
pub use force::{ForceRecord, Pulse, Samples};
pub use free_flight::{Flight, FreeFlight};
pub use impact::{IMPACT_COLUMNS, Impact};
pub use record::Record;
pub use rig::Rig;
pub use roles::RecordKind;
pub use series::{FlightSpan, Scatter};
pub use sound::{Signal, Sound};
pub use track::{Frames, Track, TrackFlight};
