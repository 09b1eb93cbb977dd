//! Geometry of an axisymmetric quadrilateral from its corners.

use std::f64::consts::PI;

/// The hourglass pattern of the corners.
const HOURGLASS: [f64; 4] = [1.0, -1.0, 1.0, -1.0];

/// Geometry of an axisymmetric four-node quad, integrated exactly.
///
/// Mean gradients (Flanagan & Belytschko 1981, here with the weight 2π r) are
/// B̄_r = ∫ ∂N/∂r 2πr dA / V and so on. They differentiate linear fields
/// exactly, and their forces V B̄ᵀσ are work-conjugate to the mean strain, so
/// axial momentum is kept to rounding.
///
/// The hourglass shape γ = h − B̄_r (h·r) − B̄_y (h·y) is orthogonal to linear
/// fields; γ·u / 4 is the amplitude of the field ξη that the mean strain does
/// not see.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuadGeometry {
    /// ∫ 2πr dA, m³.
    pub volume: f64,
    /// ∫ N_a 2πr dA, m³: the lumped shares of the volume.
    pub nodal_volumes: [f64; 4],
    /// Mean ∂N_a/∂r, 1/m.
    pub gradient_r: [f64; 4],
    /// Mean ∂N_a/∂y, 1/m.
    pub gradient_y: [f64; 4],
    /// Mean N_a/r, 1/m.
    pub hoop: [f64; 4],
    /// Hourglass vector γ_a, dimensionless.
    pub hourglass: [f64; 4],
    /// ∫ (∂φ/∂r)² 2πr dA, ∫ (∂φ/∂y)² 2πr dA and ∫ ∂φ/∂r ∂φ/∂y 2πr dA of the
    /// field φ = ξη less its mean gradient, m.
    pub hourglass_measures: [f64; 3],
}

/// Shape functions at one integration point.
pub(crate) struct QuadraturePoint {
    /// 2πr dA, m³.
    pub weight: f64,
    pub radius: f64,
    pub shape: [f64; 4],
    pub gradient_r: [f64; 4],
    pub gradient_y: [f64; 4],
}

/// Returns the 2 × 2 Gauss points, exact for every integral of a straight-sided quad's
/// volume, mean gradients and lumped volumes.
#[inline]
pub(crate) fn quadrature(corners: &[[f64; 2]; 4]) -> [QuadraturePoint; 4] {
    const CORNER: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let point = 1.0 / 3f64.sqrt();
    CORNER.map(|[px, pe]| {
        let (xi, eta) = (px * point, pe * point);
        let shape = CORNER.map(|[x, e]| 0.25 * (1.0 + x * xi) * (1.0 + e * eta));
        let d_xi = CORNER.map(|[x, e]| 0.25 * x * (1.0 + e * eta));
        let d_eta = CORNER.map(|[x, e]| 0.25 * e * (1.0 + x * xi));
        let sum = |d: &[f64; 4], axis: usize| {
            d.iter().zip(corners).map(|(d, corner)| d * corner[axis]).sum::<f64>()
        };
        let (r_xi, y_xi) = (sum(&d_xi, 0), sum(&d_xi, 1));
        let (r_eta, y_eta) = (sum(&d_eta, 0), sum(&d_eta, 1));
        let jacobian = r_xi * y_eta - r_eta * y_xi;
        let radius = sum(&shape, 0);
        let (mut gradient_r, mut gradient_y) = ([0.0; 4], [0.0; 4]);
        for a in 0..4 {
            gradient_r[a] = (d_xi[a] * y_eta - d_eta[a] * y_xi) / jacobian;
            gradient_y[a] = (d_eta[a] * r_xi - d_xi[a] * r_eta) / jacobian;
        }
        let weight = 2.0 * PI * radius * jacobian;
        QuadraturePoint { weight, radius, shape, gradient_r, gradient_y }
    })
}

/// Returns the weighted sum over the points of a quantity of each corner.
#[inline]
fn weighted(
    points: &[QuadraturePoint; 4],
    value: impl Fn(&QuadraturePoint, usize) -> f64,
) -> [f64; 4] {
    let mut sums = [0.0; 4];
    for p in points {
        for (a, sum) in sums.iter_mut().enumerate() {
            *sum += p.weight * value(p, a);
        }
    }
    sums
}

/// Returns [`QuadGeometry::nodal_volumes`] of the quad with the given corners (r, y) in m.
pub fn nodal_volumes(corners: &[[f64; 2]; 4]) -> [f64; 4] {
    weighted(&quadrature(corners), |p, a| p.shape[a])
}

impl QuadGeometry {
    /// Integrates over the quad with the given corners (r, y) in m,
    /// counter-clockwise, r ≥ 0.
    pub fn new(corners: &[[f64; 2]; 4]) -> Self {
        let points = quadrature(corners);
        let volume: f64 = points.iter().map(|p| p.weight).sum();
        let mean = |sums: [f64; 4]| sums.map(|sum| sum / volume);
        let gradient_r = mean(weighted(&points, |p, a| p.gradient_r[a]));
        let gradient_y = mean(weighted(&points, |p, a| p.gradient_y[a]));
        let hoop = mean(weighted(&points, |p, a| p.shape[a] / p.radius));
        let nodal_volumes = mean(weighted(&points, |p, a| p.shape[a])).map(|share| share * volume);

        let dot = |values: &[f64; 4]| (0..4).map(|a| HOURGLASS[a] * values[a]).sum::<f64>();
        let h_r = dot(&corners.map(|[r, _]| r));
        let h_y = dot(&corners.map(|[_, y]| y));
        let mut hourglass = HOURGLASS;
        for (a, shape) in hourglass.iter_mut().enumerate() {
            *shape = *shape - gradient_r[a] * h_r - gradient_y[a] * h_y;
        }
        let (mean_r, mean_y) = (dot(&gradient_r), dot(&gradient_y));
        let mut hourglass_measures = [0.0; 3];
        for p in &points {
            let (g_r, g_y) = (dot(&p.gradient_r) - mean_r, dot(&p.gradient_y) - mean_y);
            for (sum, product) in
                hourglass_measures.iter_mut().zip([g_r * g_r, g_y * g_y, g_r * g_y])
            {
                *sum += p.weight * product;
            }
        }
        Self { volume, nodal_volumes, gradient_r, gradient_y, hoop, hourglass, hourglass_measures }
    }

    /// Returns the mean strain (ε_rr, ε_yy, ε_θθ, γ_ry) of corner displacements (u_r, u_y).
    pub fn mean_strain(&self, u: &[[f64; 2]; 4]) -> [f64; 4] {
        let mut strain = [0.0; 4];
        for a in 0..4 {
            strain[0] += self.gradient_r[a] * u[a][0];
            strain[1] += self.gradient_y[a] * u[a][1];
            strain[2] += self.hoop[a] * u[a][0];
            strain[3] += self.gradient_y[a] * u[a][0] + self.gradient_r[a] * u[a][1];
        }
        strain
    }
}
