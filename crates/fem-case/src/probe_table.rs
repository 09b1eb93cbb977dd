//! `[[output.probe]]` as written.

use serde::{Deserialize, Serialize};

use crate::quantity::{Length, Quantity};

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
