//! How a collision ended.

use serde::{Deserialize, Serialize};

use crate::stop::Stop;

/// How a collision ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Ending {
    /// The bodies have parted.
    Parted,
    /// They stay together: nothing is left to drive them apart.
    Together,
    /// The upper one has come to rest on the lower one, after a bounce or more.
    AtRest,
    /// It did not; the results are those so far.
    Stopped(Stop),
}
