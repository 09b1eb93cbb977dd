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
    /// It did not; the results are those so far.
    Stopped(Stop),
}
