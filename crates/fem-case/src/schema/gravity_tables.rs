//! `[gravity]` and `[stop]` as written.

use crate::quantity::{Acceleration, Count, Length, Quantity};
use serde::{Deserialize, Serialize};

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

/// `[[output.probe]]`: a place of a body of which is told what happens there over time.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table [[output.probe]]")]
pub struct ProbeTable {
    /// The name of a body.
    pub body: String,
    /// Distance from the axis in the undeformed body, >= 0.
    pub r: Quantity<Length>,
    /// Along the axis from where the bodies touch first: negative in the lower body.
    pub y: Quantity<Length>,
}

impl ProbeTable {
    /// A place of a body.
    pub fn new(
        body: impl Into<String>,
        r: impl Into<Quantity<Length>>,
        y: impl Into<Quantity<Length>>,
    ) -> Self {
        Self { body: body.into(), r: r.into(), y: y.into() }
    }
}
