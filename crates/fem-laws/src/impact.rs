//! The outcome of a collision, the same for every model.

/// Summary and history of one collision, from first touch to the end of contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Impact {
    /// Relative speed after over before; 0 if the bodies stay together.
    pub restitution: f64,
    /// s; `None` if the bodies stay together for ever.
    pub contact_time: Option<f64>,
    /// Largest force, N.
    pub peak_force: f64,
    /// Largest approach, m.
    pub max_approach: f64,
    /// Largest contact radius, m.
    pub max_contact_radius: f64,
    /// Largest pressure on the axis, Pa; `None` for a model without a pressure distribution.
    pub peak_pressure: Option<f64>,
    /// In the order of time, denser where the state changes faster; the first instant is first
    /// touch, the last the end of contact.
    pub history: Vec<ImpactInstant>,
}

/// State of a contact at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpactInstant {
    /// After first touch, s.
    pub time: f64,
    /// δ, m.
    pub approach: f64,
    /// δ̇, m/s.
    pub approach_rate: f64,
    /// Contact force, N; positive in compression.
    pub force: f64,
    /// a, m.
    pub contact_radius: f64,
}
