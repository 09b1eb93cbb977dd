//! Dashpots parallel to the springs, which damp the oscillation of nodes that enter the contact.
//!
//! Where a contact spreads, each node strikes the other body with its own small mass and bounces on the springs.
//! The effect grows with the speed over the wave speed: undamped, it was 5 % of the peak force of rubber at 1 m/s
//! and 19 % at 10 m/s. In a smooth contact the overlap changes slowly, and a dashpot has almost no effect,
//!
//! ```math
//! p = \langle k \langle -g \rangle - c\,\dot g \rangle \quad \text{where}\ g < 0, \qquad
//! \dot g = [\dot u_y - y' \dot u_r]^{upper}_{lower} .
//! ```
//!
//! The impedance c (Pa s/m) is independent of the element size: k grows with 1/h, and the mass of the surface
//! nodes per area, ½ρh, with h. The pressure never pulls. Dashpots damp the motion of that mass, which vanishes
//! with the element size.

use super::DeformedInterface;
use super::common_refinement::GAUSS;

impl DeformedInterface {
    /// Adds dashpots of an impedance c ≥ 0, Pa s/m. The stiffness bound relies on them to dissipate the energy that springs
    /// gain by opening and closing, which takes an impedance of a few tenths of the critical one, 2√(k ½ρh).
    #[must_use]
    pub fn with_damping(mut self, impedance: f64) -> Self {
        self.impedance = impedance;
        self
    }

    /// Adds the forces (N) of the dashpots alone to `f`, for displacements `u` (m) and velocities `v`
    /// (m/s); all are given for the lower and the upper body, one pair (r, y) per node.
    pub fn add_damping(
        &self,
        u: [&[[f64; 2]]; 2],
        v: [&[[f64; 2]]; 2],
        mut f: [&mut [[f64; 2]]; 2],
    ) {
        if self.impedance == 0.0 {
            return;
        }
        for interval in self.intervals(u.map(|u| move |node: u32| u[node as usize])) {
            for gauss in GAUSS {
                if let Some(point) = interval.closed_point(gauss) {
                    let [lower, upper] =
                        [0, 1].map(|side: usize| interval.rate_of_height(&point, side, v[side]));
                    let spring = -interval.stiffness * point.gap;
                    let pressure = (-self.impedance * (upper - lower)).max(-spring);
                    interval.add_pressure(&point, pressure, &mut f);
                }
            }
        }
    }
}
