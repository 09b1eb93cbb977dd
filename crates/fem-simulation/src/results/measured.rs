//! Measured restitutions of the library beside a result.

use fem_case::library::MeasuredRestitution;
use serde::Serialize;

/// A measured restitution of the material of both bodies.
#[derive(Clone, Debug, Serialize)]
pub struct MeasuredSummary {
    /// Name in the library: `bridges-1984`.
    pub name: &'static str,
    /// Source of the numbers.
    pub source: &'static str,
    /// The bodies and their surfaces.
    pub bodies: &'static str,
    /// Size of the bodies.
    pub size: Option<&'static str>,
    /// Temperature of the bodies.
    pub temperature: Option<&'static str>,
    /// Restitution at the approach speed of the case; `None` outside the measured speeds.
    pub restitution: Option<f64>,
    /// Standard deviation of the measured restitutions.
    pub scatter: Option<f64>,
    /// Approach speeds over the measured range, m/s, and their restitutions.
    pub points: Vec<(f64, f64)>,
}

impl MeasuredSummary {
    /// Returns a measurement with its restitution at an approach speed (m/s).
    pub fn at(speed: f64, measured: &'static MeasuredRestitution) -> Self {
        Self {
            name: &measured.name,
            source: &measured.source,
            bodies: &measured.bodies,
            size: measured.size.as_deref(),
            temperature: measured.temperature.as_deref(),
            restitution: measured.at(speed),
            scatter: measured.scatter(),
            points: measured.points(),
        }
    }
}
