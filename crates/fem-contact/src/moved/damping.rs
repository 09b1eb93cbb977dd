//! Dashpots beside the springs, so that nodes that strike the other surface do not ring on them.
//!
//! Where a contact spreads, each node meets the other body with its own small mass and bounces on the
//! springs, the more so the faster the bodies are to the waves in them: undamped, that was 5 % of
//! the largest force of rubber at 1 m/s and 19 % at 10 m/s. In a smooth contact what overlaps changes slowly,
//! and a dashpot between the surfaces does next to nothing,
//!
//! ```math
//! p = \langle k \langle -g \rangle - c\,\dot g \rangle \quad \text{where}\ g < 0, \qquad
//! \dot g = [\dot u_y - y' \dot u_r]^{upper}_{lower} .
//! ```
//!
//! c is an impedance, Pa s/m, the same for any size of elements: k goes with 1/h, and the mass of a
//! surface's own nodes, ½ρh of an area, with h. It never pulls. They damp the motion of that mass,
//! which vanishes with the element size.

use super::MovedInterface;
use super::common_refinement::GAUSS;

impl MovedInterface {
    /// With dashpots of an impedance c ≥ 0, Pa s/m; without, there are none. The bound of the stiffness
    /// counts on them to take what springs gain by opening and closing: some tenths of 2√(k ½ρh).
    #[must_use]
    pub fn with_damping(mut self, impedance: f64) -> Self {
        self.impedance = impedance;
        self
    }

    /// Adds the forces (N) of the dashpots alone to `f`, for displacements `u` (m) and velocities `v`
    /// (m/s); all are given for the lower and the upper body, one pair (r, y) a node.
    pub fn add_damping(
        &self,
        u: [&[[f64; 2]]; 2],
        v: [&[[f64; 2]]; 2],
        mut f: [&mut [[f64; 2]]; 2],
    ) {
        if self.impedance == 0.0 {
            return;
        }
        for piece in self.pieces(u.map(|u| move |node: u32| u[node as usize])) {
            for gauss in GAUSS {
                if let Some(point) = piece.closed_point(gauss) {
                    let [lower, upper] =
                        [0, 1].map(|side: usize| piece.rate_of_height(&point, side, v[side]));
                    let spring = -piece.stiffness * point.gap;
                    let pressure = (-self.impedance * (upper - lower)).max(-spring);
                    piece.add_pressure(&point, pressure, &mut f);
                }
            }
        }
    }
}
