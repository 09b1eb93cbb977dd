//! Where contact was looked for.

use serde::{Deserialize, Serialize};

/// The part of the surfaces in which a model looks for contact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Searched {
    /// Distance from the axis out to which contact is looked for, m.
    pub radius: f64,
    /// Number of points that can touch.
    pub n_points: usize,
    /// Whether the points are nodes of one surface; else they are its integration points.
    pub at_nodes: bool,
}
