//! Slip between surfaces of unlike materials.
//!
//! Where the interface has the slope κr and the surfaces slip along r by Δu_r, the gap increases by κr Δu_r,
//! and the pressure normal to the interface has a radial part, which moves the surfaces. To first order both
//! together increase the gap everywhere by the same (derived in `fem-laws`, `surface_slip.rs`),
//!
//! ```math
//! \kappa\,(q_2 - q_1), \qquad q_i = \frac{t_i}{4\pi}\,F, \qquad t_i = \frac{1-2\nu_i}{\mu_i},
//! ```
//!
//! one scalar mode per body, of the weight ±κ, that relaxes with it: 1/t = K + μ/3, of which the share of
//! μ/3 relaxes with an elastic bulk modulus, and all of it with constant ν. κ and the shares s of
//! the compliance are those of the instantaneous moduli.
//!
//! Radii are then those of both bodies' points weighted with s. The results have radii halfway between both, as in
//! the explicit model, with Δu_r = (q₂ − q₁)/a at the edge and a pressure per area there:
//!
//! ```math
//! a = a_s - \tfrac12(s_2-s_1)\,\frac{q_2-q_1}{a_s}, \qquad
//! p_0 = p_s\Bigl(1 + \pi\,(s_2-s_1)\,\frac{q_2-q_1}{F}\,p_s\Bigr).
//! ```

use std::f64::consts::PI;

use faer::Mat;
use fem_material::{ActsOn, ElasticModuli, PronySeries};

use crate::operators::viscoelastic_modes::{ViscoelasticModes, ViscoelasticState};

/// Curvature of the interface of two bodies and the share of each body in the compliance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slip {
    /// Curvature κ of the interface, 1/m, positive if it rises from the axis outward.
    pub curvature: f64,
    /// Shares s of both bodies in the compliance of the contact, lower body first.
    pub shares: [f64; 2],
}

impl Slip {
    /// Returns the weight of the slip of a side in the gap, 1/m.
    fn weight(&self, side: usize) -> f64 {
        if side == 0 { -self.curvature } else { self.curvature }
    }

    /// Returns the compliance (m/N) that an elastic side adds between all points.
    pub(crate) fn compliance(&self, side: usize, moduli: &ElasticModuli) -> f64 {
        self.weight(side) * motion(moduli)
    }

    /// Returns the mode of a side, for a number of points.
    pub(crate) fn mode(
        &self,
        side: usize,
        moduli: &ElasticModuli,
        series: Option<&PronySeries>,
        time_step: f64,
        n_points: usize,
    ) -> ViscoelasticModes {
        let shape = motion(moduli).sqrt();
        let (memory, share) = match series {
            None => (ViscoelasticState::elastic(), 0.0),
            Some(series) => {
                let (bulk, shear) = (moduli.bulk_modulus(), moduli.shear_modulus());
                let share = match series.acts_on() {
                    ActsOn::All => 1.0,
                    ActsOn::Shear => shear / (3.0 * bulk + shear),
                };
                (ViscoelasticState::new(series, time_step), share)
            }
        };
        let shapes = Mat::from_fn(n_points, 1, |_, _| shape);
        ViscoelasticModes::new(memory, shapes, &[share]).weighted(self.weight(side))
    }

    /// Converts a contact radius (m) and a pressure on the axis (Pa) under a force (N) to values halfway between the
    /// bodies, for the slip q of both sides, m².
    pub(crate) fn halfway(
        &self,
        [radius, pressure]: [f64; 2],
        force: f64,
        moved: [f64; 2],
    ) -> (f64, f64) {
        if force <= 0.0 || radius <= 0.0 {
            return (radius, pressure);
        }
        let [unlike, slip] = [self.shares, moved].map(|[lower, upper]| upper - lower);
        let denser = PI * unlike * slip / force * pressure;
        (radius - 0.5 * unlike * slip / radius, pressure * (1.0 + denser))
    }
}

/// Returns q of an elastic body over the force, m²/N.
pub(crate) fn motion(moduli: &ElasticModuli) -> f64 {
    moduli.tangential_compliance() / (4.0 * PI)
}
