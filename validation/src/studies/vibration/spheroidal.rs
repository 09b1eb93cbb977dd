//! Spheroidal vibrations of a homogeneous elastic sphere (Lamb 1882; Eringen & Suhubi,
//! *Elastodynamics* II, § 8.14).
//!
//! Axisymmetric motion of degree l at the frequency ω is the sum of a dilatational and a shear
//! wave,
//!
//! ```math
//! \mathbf u = \nabla\!\left[A\, j_l(hr) P_l\right]
//!   + \nabla\times\nabla\times\left[B\, j_l(kr) P_l\, \mathbf r\right],
//! \qquad h = \omega/c_d, \quad k = \omega/c_s ,
//! ```
//!
//! and the surface of a unit sphere is free of normal and tangential traction if
//!
//! ```math
//! \begin{aligned}
//! A\left[(l^2-l-\tfrac12k^2)\,j_l(h) + 2h\,j_{l+1}(h)\right]
//!   &+ B\,l(l+1)\left[(l-1)\,j_l(k) - k\,j_{l+1}(k)\right] = 0, \\
//! A\left[(l-1)\,j_l(h) - h\,j_{l+1}(h)\right]
//!   &+ B\left[(l^2-1-\tfrac12k^2)\,j_l(k) + k\,j_{l+1}(k)\right] = 0 .
//! \end{aligned}
//! ```
//!
//! Degree 0 has no shear wave and the first bracket alone. Units: the radius and c_s.

use super::bessel::{legendre, spherical_bessel};

/// Step of the scan for sign changes of the frequency equation.
const SCAN_STEP: f64 = 0.005;
/// Start of the scan, below the lowest root of the degrees 0 to 2; the equation vanishes at 0 for rigid motion.
const SCAN_START: f64 = 1.0;
/// Start of the scan for a higher degree, over the degree, below the lowest root: surface waves are no slower than
/// 0.87 of shear waves. Far below, the equation is smaller than its rounding.
const SCAN_START_OVER_DEGREE: f64 = 0.8;

#[derive(Debug, Clone, Copy)]
pub struct ElasticSphere {
    /// Ratio of the wave speeds c_s/c_d.
    slowness: f64,
}

#[derive(Debug, Clone, Copy)]
pub struct Vibration {
    sphere: ElasticSphere,
    degree: usize,
    pub frequency: f64,
    /// Amplitudes A and B.
    amplitudes: [f64; 2],
}

impl ElasticSphere {
    /// Makes the sphere for a Poisson's ratio: (c_s/c_d)² = (1 − 2ν)/2(1 − ν).
    pub fn new(poissons_ratio: f64) -> Self {
        let slowness = ((1.0 - 2.0 * poissons_ratio) / (2.0 * (1.0 - poissons_ratio))).sqrt();
        Self { slowness }
    }

    /// Returns the vibrations of a degree up to a frequency ω R/c_s in ascending order.
    pub fn vibrations(&self, degree: usize, up_to: f64) -> Vec<Vibration> {
        let start = SCAN_START.max(SCAN_START_OVER_DEGREE * degree as f64);
        let n = ((up_to - start) / SCAN_STEP).ceil().max(0.0) as usize;
        let mut found = Vec::new();
        let mut left = (start, self.equation(degree, start));
        for step in 1..=n {
            let k = start + step as f64 * SCAN_STEP;
            let right = (k, self.equation(degree, k));
            if (left.1 < 0.0) != (right.1 < 0.0) {
                found.push(self.vibration(degree, self.root(degree, left, right)));
            }
            left = right;
        }
        found
    }

    /// Returns the root between two frequencies by bisection, to rounding.
    fn root(&self, degree: usize, left: (f64, f64), right: (f64, f64)) -> f64 {
        let (mut low, mut high) = (left.0, right.0);
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return middle;
            }
            let same = (self.equation(degree, middle) < 0.0) == (left.1 < 0.0);
            if same { low = middle } else { high = middle }
        }
    }

    /// Returns the value of the frequency equation, which is zero at a free vibration.
    fn equation(&self, degree: usize, k: f64) -> f64 {
        let [[rr_a, rr_b], [rt_a, rt_b]] = self.tractions(degree, k);
        if degree == 0 { rr_a } else { rr_a * rt_b - rr_b * rt_a }
    }

    /// Returns σ_rr and σ_rθ at the surface, over 2G, for A = 1 and for B = 1.
    fn tractions(&self, degree: usize, k: f64) -> [[f64; 2]; 2] {
        let (l, h) = (degree as f64, self.slowness * k);
        let [jh, jk] = [h, k].map(|x| spherical_bessel(degree + 1, x));
        let (ah, bh) = (jh[degree], h * jh[degree + 1]);
        let (ak, bk) = (jk[degree], k * jk[degree + 1]);
        let half = 0.5 * k * k;
        [
            [(l * l - l - half) * ah + 2.0 * bh, l * (l + 1.0) * ((l - 1.0) * ak - bk)],
            [(l - 1.0) * ah - bh, (l * l - 1.0 - half) * ak + bk],
        ]
    }

    fn vibration(&self, degree: usize, frequency: f64) -> Vibration {
        let [normal, tangential] = self.tractions(degree, frequency);
        // The row with the larger coefficients is better conditioned.
        let size = |row: [f64; 2]| row[0].hypot(row[1]);
        let [a, b] = match degree {
            0 => [0.0, 1.0],
            _ if size(normal) > size(tangential) => normal,
            _ => tangential,
        };
        let scale = a.hypot(b);
        Vibration { sphere: *self, degree, frequency, amplitudes: [b / scale, -a / scale] }
    }
}

impl Vibration {
    /// Returns the factors of P_l in u_r and of dP_l/dθ in u_θ at a radius r > 0.
    pub fn radial_parts(&self, r: f64) -> [f64; 2] {
        let (l, [a, b]) = (self.degree as f64, self.amplitudes);
        let [h, k] = [self.sphere.slowness * self.frequency, self.frequency];
        // j_l and x j_l′ = l j_l − x j_{l+1}.
        let [(jh, sh), (jk, sk)] = [h * r, k * r].map(|x| {
            let j = spherical_bessel(self.degree + 1, x);
            (j[self.degree], l * j[self.degree] - x * j[self.degree + 1])
        });
        [(a * sh + b * l * (l + 1.0) * jk) / r, (a * jh + b * (jk + sk)) / r]
    }

    /// Returns (u_r, u_y) at the place (r, y) of a sphere about the origin.
    pub fn displacement(&self, [r, y]: [f64; 2]) -> [f64; 2] {
        // The factors tend to constants at the centre.
        let distance = r.hypot(y).max(1e-6);
        let (cos, sin) = (y / distance, r / distance);
        let (value, slope) = legendre(self.degree, cos);
        let [radial, polar] = self.radial_parts(distance);
        // dP/dθ = −sin θ P′.
        let (u_radial, u_polar) = (radial * value, -polar * sin * slope);
        [u_radial * sin + u_polar * cos, u_radial * cos - u_polar * sin]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Roots that were computed elsewhere (ν = 0.244), and Lamb's for Poisson's solid: h R/π of
    /// breathing 0.8160, 1.9285, 2.9539, and k R/π = 0.840 of 0S2.
    #[test]
    fn roots_equal_published_ones() {
        let glass = ElasticSphere::new(0.244);
        for (degree, overtone, exact) in [
            (2, 0, 2.63906),
            (1, 0, 3.41139),
            (3, 0, 3.91364),
            (0, 0, 4.38361),
            (2, 1, 4.84778),
            (4, 0, 5.00467),
        ] {
            let found = glass.vibrations(degree, 6.0)[overtone].frequency;
            assert!((found - exact).abs() < 6e-6, "{overtone}S{degree}: {found}");
        }
        let solid = ElasticSphere::new(0.25);
        let breathing = solid.vibrations(0, 17.0);
        for (mode, exact) in breathing.iter().zip([0.8160, 1.9285, 2.9539]) {
            let found = mode.frequency / 3f64.sqrt() / std::f64::consts::PI;
            assert!((found - exact).abs() < 6e-5, "{found}");
        }
        let oblate = solid.vibrations(2, 3.0)[0].frequency / std::f64::consts::PI;
        assert!((oblate - 0.840).abs() < 6e-4, "{oblate}");
    }

    /// The shape solves G∇²u + (λ+G)∇∇·u = −ω²u: its part of the boundary's tractions is zero, by
    /// finite differences of the displacement.
    #[test]
    fn spheroidal_modes_have_no_surface_traction() {
        let nu = 0.244;
        let lambda = 2.0 * nu / (1.0 - 2.0 * nu);
        for degree in 0..5 {
            for mode in ElasticSphere::new(nu).vibrations(degree, 8.0) {
                for angle in [0.4f64, 1.3, 2.5] {
                    let (sin, cos) = angle.sin_cos();
                    let place = [sin, cos];
                    let d = 1e-4;
                    let at = |dr: f64, dy: f64| mode.displacement([place[0] + dr, place[1] + dy]);
                    let [right, left, up, down] =
                        [at(d, 0.0), at(-d, 0.0), at(0.0, d), at(0.0, -d)];
                    let slope = |a: [f64; 2], b: [f64; 2], i: usize| (a[i] - b[i]) / (2.0 * d);
                    let rr = slope(right, left, 0);
                    let yy = slope(up, down, 1);
                    let tt = at(0.0, 0.0)[0] / sin;
                    let ry = slope(up, down, 0) + slope(right, left, 1);
                    let pressure = lambda * (rr + yy + tt);
                    let traction = [
                        (pressure + 2.0 * rr) * sin + ry * cos,
                        ry * sin + (pressure + 2.0 * yy) * cos,
                    ];
                    // Second differences of 1e-8 of fields of size 1 to 10.
                    assert!(traction[0].hypot(traction[1]) < 1e-5, "{degree} {traction:?}");
                }
            }
        }
    }
}
