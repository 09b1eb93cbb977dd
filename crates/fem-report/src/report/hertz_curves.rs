//! Hertz' elastic collision over time, scaled to the closed-form numbers of a summary.

use fem_laws::{HertzImpact, HertzPressure, ImpactInstant, Pair, Partner};

use super::stored_result::StoredResult;

/// Hertz' collision of a result's bodies.
///
/// All pairs share one curve if time is divided by the contact time and approach by its maximum, so the
/// collision of bodies of unit size is computed and scaled.
pub struct HertzCurves {
    shape: HertzImpact,
    contact_time: f64,
    peak_force: f64,
    max_approach: f64,
    peak: HertzPressure,
}

/// An instant of Hertz' collision, SI.
pub struct HertzInstant {
    /// Time since first touch.
    pub time: f64,
    pub approach: f64,
    pub force: f64,
    pub contact_radius: f64,
    /// Stored elastic energy, J.
    pub energy: f64,
}

impl HertzCurves {
    /// Reads the closed-form numbers of a result; `None` if one is missing.
    pub fn of(result: &StoredResult) -> Option<Self> {
        let number = |key: &str| result.number(&["hertz", key]).filter(|number| *number > 0.0);
        let ball = Partner::Sphere { radius: 1.0, mass: 1.0, plane_strain_modulus: 1.0 };
        let shape = HertzImpact::new(&Pair::new(ball, Partner::Wall).ok()?, 1.0).ok()?;
        Some(Self {
            shape,
            contact_time: number("contact_time_s")?,
            peak_force: number("peak_force_n")?,
            max_approach: number("max_approach_m")?,
            peak: HertzPressure {
                contact_radius: number("max_contact_radius_m")?,
                peak_pressure: number("peak_pressure_pa")?,
            },
        })
    }

    /// Returns the instants from first touch to separation.
    pub fn history(&self) -> Vec<HertzInstant> {
        let shape = &self.shape;
        let initial = 0.5 * shape.pair().effective_mass() * shape.approach_speed().powi(2);
        // At the largest approach all energy is elastic: ∫F dδ with F ∝ δ^(3/2).
        let whole = 0.4 * self.peak_force * self.max_approach;
        let at = |instant: &ImpactInstant| HertzInstant {
            time: instant.time / shape.contact_time() * self.contact_time,
            approach: instant.approach / shape.max_approach() * self.max_approach,
            force: shape.force(instant.approach) / shape.peak_force() * self.peak_force,
            contact_radius: self.scaled(instant.approach).contact_radius,
            energy: instant.work / initial * whole,
        };
        shape.impact().history.iter().map(at).collect()
    }

    /// Returns the pressure distribution at an approach, m.
    pub fn pressure(&self, approach: f64) -> HertzPressure {
        self.scaled(approach / self.max_approach * self.shape.max_approach())
    }

    /// Returns the pressure distribution under a force, N; the approach grows with F^(2/3).
    pub fn pressure_under(&self, force: f64) -> HertzPressure {
        self.pressure((force / self.peak_force).max(0.0).cbrt().powi(2) * self.max_approach)
    }

    /// Scales the pressure at an approach of the unit bodies.
    fn scaled(&self, approach: f64) -> HertzPressure {
        let (own, most) =
            (self.shape.pressure(approach), self.shape.pressure(self.shape.max_approach()));
        HertzPressure {
            contact_radius: own.contact_radius / most.contact_radius * self.peak.contact_radius,
            peak_pressure: own.peak_pressure / most.peak_pressure * self.peak.peak_pressure,
        }
    }
}
