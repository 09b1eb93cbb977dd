//! A plate under the contact, whose bending waves carry energy away.
//!
//! The centre of a thin plate without an edge moves at a rate in proportion to the force, which adds to the approach
//!
//! ```math
//! \dot w = \beta F
//! ```
//!
//! equally at all points, and takes the power β F² (Zener 1941, *Phys. Rev.* 59, 669). The mobility β is that of
//! `fem_laws::plate_mobility`; the local deformation of the plate is that of a half-space, which is meshed. Over a step
//! the force is integrated by the trapezoidal rule, as Newmark's formulas do for the rate of the approach, so that
//! w = β m* (v + g t − δ̇).

/// Deflection of a plate as a dashpot.
#[derive(Debug, Clone)]
pub(crate) struct PlateDashpot {
    /// Mobility β, m/(N s).
    mobility: f64,
    time_step: f64,
    /// Contact force, N.
    force: f64,
    deflection: f64,
}

impl PlateDashpot {
    /// Creates a plate at rest from its mobility, m/(N s), and a time step, s.
    pub fn new(mobility: f64, time_step: f64) -> Self {
        Self { mobility, time_step, force: 0.0, deflection: 0.0 }
    }

    /// Returns the mobility, m/(N s).
    pub fn mobility(&self) -> f64 {
        self.mobility
    }

    /// Returns the change of the gap at all points within a step per force, m/N.
    pub fn compliance(&self) -> f64 {
        0.5 * self.mobility * self.time_step
    }

    /// Returns the deflection at the end of a step with zero force there, m.
    pub fn past_displacement(&self) -> f64 {
        self.deflection + self.compliance() * self.force
    }

    /// Returns the current deflection, m.
    pub fn displacement(&self) -> f64 {
        self.deflection
    }

    /// Advances to the end of a step with this force, N.
    pub fn advance(&mut self, force: f64) {
        self.deflection = self.past_displacement() + self.compliance() * force;
        self.force = force;
    }

    /// Returns the power that goes into the plate, W.
    pub fn power(&self) -> f64 {
        self.mobility * self.force * self.force
    }
}
