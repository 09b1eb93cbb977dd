//! The element with one mean stress and hourglass stiffness.
//!
//! ```math
//! \mathbf f = V \bar B^T \boldsymbol\sigma(\bar{\boldsymbol\varepsilon})
//!   + \boldsymbol\gamma \, G \, k \, (\boldsymbol\gamma \cdot \mathbf u)
//! ```
//!
//! The hourglass stiffness k is that of the deviatoric part of the field ξη
//! (see [`QuadGeometry::hourglass_stiffness`]).

use nalgebra::SVector;

use crate::geometry::QuadGeometry;
use crate::stiffness::{ElementMatrix, ElementStiffness};

impl QuadGeometry {
    /// Returns the mean dilatation of unit displacements, 1/m.
    pub(crate) fn dilatation(&self) -> SVector<f64, 8> {
        SVector::from_fn(|i, _| {
            let a = i / 2;
            if i % 2 == 0 { self.gradient_r[a] + self.hoop[a] } else { self.gradient_y[a] }
        })
    }

    /// Hourglass stiffness k_rr, k_yy, k_ry for unit shear modulus, m.
    ///
    /// The deviatoric energy of φ = ξη in u_r and u_y, whose strains are
    /// ε_rr = φ_r q_r, ε_yy = φ_y q_y, γ_ry = φ_y q_r + φ_r q_y, at the amplitude
    /// q = γ·u / 4. It makes the element as stiff in bending as the B-bar
    /// element, needs no coefficient, and leaves the volume free, so nearly
    /// incompressible bodies do not lock.
    pub fn hourglass_stiffness(&self) -> [f64; 3] {
        let [rr, yy, ry] = self.hourglass_measures;
        [4.0 / 3.0 * rr + yy, 4.0 / 3.0 * yy + rr, ry / 3.0].map(|k| k / 16.0)
    }
}

/// Returns the lower triangle, row by row, of the stiffness matrix of the mean-gradient element, N/m; degrees of
/// freedom u_r, u_y corner by corner. It is that of [`mean_gradient`] for given moduli (Pa), in a quarter of the time.
pub fn mean_gradient_stiffness(
    geometry: &QuadGeometry,
    bulk_modulus: f64,
    shear_modulus: f64,
) -> [f64; 36] {
    let QuadGeometry { volume, gradient_r, gradient_y, hoop, hourglass, .. } = geometry;
    let [k_rr, k_yy, k_ry] = geometry.hourglass_stiffness().map(|k| k * shear_modulus);
    // κ tr ε² + 2 G (ε:ε − tr ε²/3), shear as γ²/2.
    let of_trace = volume * (bulk_modulus - 2.0 / 3.0 * shear_modulus);
    let (twice, once) = (2.0 * volume * shear_modulus, volume * shear_modulus);
    let (mut lower, mut next) = ([0.0; 36], 0);
    let mut put = |value: f64| {
        lower[next] = value;
        next += 1;
    };
    for a in 0..4 {
        let (r, y, h) = (gradient_r[a], gradient_y[a], hoop[a]);
        let trace = r + h;
        let to_rr = |b: usize| {
            of_trace * trace * (gradient_r[b] + hoop[b])
                + twice * (r * gradient_r[b] + h * hoop[b])
                + once * y * gradient_y[b]
                + k_rr * hourglass[a] * hourglass[b]
        };
        // u_r of corner a with u_y of corner b.
        let to_ry = |b: usize| {
            of_trace * trace * gradient_y[b]
                + once * y * gradient_r[b]
                + k_ry * hourglass[a] * hourglass[b]
        };
        for b in 0..a {
            put(to_rr(b));
            put(to_ry(b));
        }
        put(to_rr(a));
        for b in 0..=a {
            // u_y of corner a with u_r of corner b.
            put(of_trace * y * (gradient_r[b] + hoop[b])
                + once * r * gradient_y[b]
                + k_ry * hourglass[a] * hourglass[b]);
            put(of_trace * y * gradient_y[b]
                + twice * y * gradient_y[b]
                + once * r * gradient_r[b]
                + k_yy * hourglass[a] * hourglass[b]);
        }
    }
    lower
}

/// Returns the element matrices of the mean-gradient element.
pub fn mean_gradient(geometry: &QuadGeometry) -> ElementStiffness {
    let dilatation = geometry.dilatation();
    let bulk = dilatation * dilatation.transpose() * geometry.volume;
    let strains: [[f64; 4]; 8] = std::array::from_fn(|i| {
        let a = i / 2;
        if i % 2 == 0 {
            [geometry.gradient_r[a], 0.0, geometry.hoop[a], geometry.gradient_y[a]]
        } else {
            [0.0, geometry.gradient_y[a], 0.0, geometry.gradient_r[a]]
        }
    });
    let [k_rr, k_yy, k_ry] = geometry.hourglass_stiffness();
    let mut deviatoric = ElementMatrix::zeros();
    for (i, e) in strains.iter().enumerate() {
        for (j, f) in strains[..=i].iter().enumerate() {
            let trace = (e[0] + e[1] + e[2]) * (f[0] + f[1] + f[2]);
            let product = e[0] * f[0] + e[1] * f[1] + e[2] * f[2];
            let k = match (i % 2, j % 2) {
                (0, 0) => k_rr,
                (1, 1) => k_yy,
                _ => k_ry,
            };
            let value = geometry.volume * (2.0 * (product - trace / 3.0) + e[3] * f[3])
                + k * geometry.hourglass[i / 2] * geometry.hourglass[j / 2];
            deviatoric[(i, j)] = value;
            deviatoric[(j, i)] = value;
        }
    }
    ElementStiffness { bulk, deviatoric }
}
