//! Slip between surfaces of unlike materials.
//!
//! Where the interface has the slope κr and the surfaces slip along r by Δu_r, the gap is wider by κr Δu_r,
//! and pressure normal to the interface has a part along r, which moves the surfaces. In first order both
//! together widen the gap everywhere by the same (derived in `fem-laws`, `surface_slip.rs`),
//!
//! ```math
//! \kappa\,(q_2 - q_1), \qquad q_i = \frac{t_i}{4\pi}\,F, \qquad t_i = \frac{1-2\nu_i}{\mu_i},
//! ```
//!
//! one scalar spring a body, of the weight ±κ, that relaxes with it: 1/t = K + μ/3, of which the share of
//! μ/3 relaxes beside an elastic bulk modulus, and all of it with constant ν. κ and the shares s of
//! the compliance stay those of the instantaneous moduli.
//!
//! Radii then are those of both bodies' points weighted with s. Read out are those halfway, as the explicit
//! model's are, with Δu_r = (q₂ − q₁)/a at the edge and a pressure per area there:
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
    /// κ, 1/m, upward from the axis.
    pub curvature: f64,
    /// Shares s of the contact's compliance, lower body first.
    pub shares: [f64; 2],
}

impl Slip {
    /// Weight of the slip of a side in the gap, 1/m.
    fn weight(&self, side: usize) -> f64 {
        if side == 0 { -self.curvature } else { self.curvature }
    }

    /// Compliance (m/N) that an elastic side adds between all points.
    pub(crate) fn compliance(&self, side: usize, moduli: &ElasticModuli) -> f64 {
        self.weight(side) * motion(moduli)
    }

    /// The spring of a side, for so many points.
    pub(crate) fn chain(
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

    /// A contact radius (m) and a pressure on its axis (Pa) under a force (N), halfway between the
    /// bodies, where the sides have moved by q, m².
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

/// q of an elastic body over the force, m²/N.
pub(crate) fn motion(moduli: &ElasticModuli) -> f64 {
    moduli.tangential_compliance() / (4.0 * PI)
}
