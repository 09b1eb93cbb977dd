//! `[gravity]` and `[stop]` as written.

use serde::{Deserialize, Serialize};

use crate::quantity::{Acceleration, Count, Quantity};

/// `[gravity]`: the weight of the upper sphere, which the lower body bears.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table [gravity]")]
pub struct GravityTable {
    /// Along -y, > 0.
    pub acceleration: Quantity<Acceleration>,
}

impl GravityTable {
    /// Gravity of this acceleration.
    pub fn new(acceleration: impl Into<Quantity<Acceleration>>) -> Self {
        Self { acceleration: acceleration.into() }
    }
}

/// `[stop]`: when a run is over.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table [stop]")]
pub struct StopTable {
    /// After so many contacts, >= 1; rest ends the run before.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bounces: Option<Quantity<Count>>,
}
