//! A law in principal axes, and the stiffness that follows from it.
//!
//! With principal stretches λ_i, Kirchhoff stresses τ_i and F = Σ λ_i n_i ⊗ N_i
//!
//! ```math
//! W_i = \frac{\tau_i}{\lambda_i}, \qquad
//! W_{ij} = \frac{\partial\tau_i/\partial\ln\lambda_j - \delta_{ij}\tau_i}{\lambda_i\lambda_j}
//! ```
//!
//! are the slopes of the energy. The stiffness A = ∂P/∂F couples the three stretches by W_ij; in a
//! plane it answers a change of shape n_1 ⊗ N_2 + n_2 ⊗ N_1 with (W_1 − W_2)/(λ_1 − λ_2) and a
//! change n_1 ⊗ N_2 − n_2 ⊗ N_1 with (W_1 + W_2)/(λ_1 + λ_2) (Ogden 1984, section 6.1.4). These
//! and the eigenvalues of W_ij are all eigenvalues of A.

use super::tensor::AxisymmetricTensor;

/// τ_i and ∂τ_i/∂ln λ_j.
#[derive(Debug, Clone, Copy)]
pub(super) struct Response {
    stress: [f64; 3],
    slope: [[f64; 3]; 3],
}

impl Response {
    pub fn new(stress: impl Fn(usize) -> f64, slope: impl Fn(usize, usize) -> f64) -> Self {
        Self {
            stress: std::array::from_fn(&stress),
            slope: std::array::from_fn(|i| std::array::from_fn(|j| slope(i, j))),
        }
    }
}

/// F = Σ λ_i n_i ⊗ N_i: the two in the meridian plane, the larger first, then the hoop.
#[derive(Debug, Clone, Copy)]
pub(super) struct PrincipalAxes {
    pub stretches: [f64; 3],
    /// Cosine and sine of the angle of n_1 to the radius.
    deformed: [f64; 2],
    /// Cosine and sine of the angle of N_1 to the radius.
    undeformed: [f64; 2],
}

impl PrincipalAxes {
    /// Computes the principal axes of a displacement gradient with a positive J.
    ///
    /// The in-plane F is the sum of a scaled rotation `turn` and a symmetric deviator `shear`, both complex
    /// numbers; λ = |turn| ± |shear|, and n_1 bisects them.
    pub fn of(h: &AxisymmetricTensor) -> Self {
        let turn = [1.0 + 0.5 * (h.rr + h.yy), 0.5 * (h.yr - h.ry)];
        let shear = [0.5 * (h.rr - h.yy), 0.5 * (h.yr + h.ry)];
        let length = |[x, y]: [f64; 2]| (x * x + y * y).sqrt();
        let (q, s) = (length(turn), length(shear));
        let rotation = [turn[0] / q, turn[1] / q];
        let reflection = if s > 0.0 { [shear[0] / s, shear[1] / s] } else { rotation };
        let deformed = half_angle(product(rotation, reflection));
        let undeformed = product(deformed, [rotation[0], -rotation[1]]);
        Self { stretches: [q + s, q - s, 1.0 + h.tt], deformed, undeformed }
    }
}

impl AxisymmetricTensor {
    /// Returns the principal stretches of a displacement gradient with a positive J: the two of the meridian plane, the
    /// larger first, then that of the hoop.
    pub fn principal_stretches(&self) -> [f64; 3] {
        PrincipalAxes::of(self).stretches
    }
}

fn product([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [a * c - b * d, a * d + b * c]
}

/// Returns the cosine and sine of half of an angle, up to a common sign.
fn half_angle([cosine, sine]: [f64; 2]) -> [f64; 2] {
    if cosine > 0.0 {
        let half = (0.5 * (1.0 + cosine)).sqrt();
        [half, 0.5 * sine / half]
    } else {
        let half = (0.5 * (1.0 - cosine)).sqrt();
        [0.5 * sine / half, half]
    }
}

/// Stiffness in principal axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct PrincipalStiffness {
    /// Second derivatives W_ij.
    normal: [[f64; 3]; 3],
    /// Stiffness for n_1 ⊗ N_2 + n_2 ⊗ N_1.
    shape: f64,
    /// Stiffness for n_1 ⊗ N_2 − n_2 ⊗ N_1.
    turn: f64,
}

/// Relative difference of stretches below which its quotient is replaced by the derivative: the
/// one rounds to 1e-16 over it, the other errs by its square.
const EQUAL_STRETCHES: f64 = 1e-5;

impl PrincipalStiffness {
    pub fn new(stretches: [f64; 3], response: &Response) -> Self {
        let [first, second, _] = stretches;
        let slope = |i: usize| response.stress[i] / stretches[i];
        let normal: [[f64; 3]; 3] = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let own = if i == j { response.stress[i] } else { 0.0 };
                (response.slope[i][j] - own) / (stretches[i] * stretches[j])
            })
        });
        let shape = if first - second > EQUAL_STRETCHES * first {
            (slope(0) - slope(1)) / (first - second)
        } else {
            0.5 * (normal[0][0] + normal[1][1]) - normal[0][1]
        };
        Self { normal, shape, turn: (slope(0) + slope(1)) / (first + second) }
    }

    /// Returns an upper bound of the largest eigenvalue, exact to 1e-6.
    pub fn largest_eigenvalue(&self) -> f64 {
        largest_eigenvalue(&self.normal).max(self.shape).max(self.turn)
    }

    /// Returns A for the components rr, ry, yr, yy, tt.
    pub fn tangent(&self, axes: &PrincipalAxes) -> [[f64; 5]; 5] {
        let ([c, s], [big_c, big_s]) = (axes.deformed, axes.undeformed);
        // Rows: what n_1 ⊗ N_1, n_2 ⊗ N_2, hoop, n_1 ⊗ N_2, n_2 ⊗ N_1 take of the components.
        let take = [
            [c * big_c, c * big_s, s * big_c, s * big_s, 0.0],
            [s * big_s, -s * big_c, -c * big_s, c * big_c, 0.0],
            [0.0, 0.0, 0.0, 0.0, 1.0],
            [-c * big_s, c * big_c, -s * big_s, s * big_c, 0.0],
            [-s * big_c, -s * big_s, c * big_c, c * big_s, 0.0],
        ];
        let (same, other) = (0.5 * (self.shape + self.turn), 0.5 * (self.shape - self.turn));
        let entry = |a: usize, b: usize| match (a, b) {
            (0..=2, 0..=2) => self.normal[a][b],
            (3, 3) | (4, 4) => same,
            (3, 4) | (4, 3) => other,
            _ => 0.0,
        };
        std::array::from_fn(|k| {
            std::array::from_fn(|l| {
                let pairs = (0..5).flat_map(|a| (0..5).map(move |b| (a, b)));
                pairs.map(|(a, b)| take[a][k] * entry(a, b) * take[b][l]).sum()
            })
        })
    }
}

/// Returns an upper bound of the largest eigenvalue of a symmetric matrix, exact to 1e-6.
///
/// It is the largest root of the characteristic polynomial, all of whose roots are real. Newton's
/// method comes down from the end of Gershgorin's circles and never passes it; what is left is at
/// most three steps. The mean of the roots is taken out, so that three equal ones stay exact.
fn largest_eigenvalue(a: &[[f64; 3]; 3]) -> f64 {
    let mean = (a[0][0] + a[1][1] + a[2][2]) / 3.0;
    let [x, y, z] = [a[0][0] - mean, a[1][1] - mean, a[2][2] - mean];
    let [xy, yz, zx] = [a[0][1], a[1][2], a[2][0]];
    let minors = x * y + y * z + z * x - (xy * xy + yz * yz + zx * zx);
    let determinant = x * (y * z - yz * yz) - xy * (xy * z - yz * zx) + zx * (xy * yz - y * zx);
    let circle = |own: f64, side: f64, other: f64| own + side.abs() + other.abs();
    let mut root = circle(x, xy, zx).max(circle(y, xy, yz)).max(circle(z, yz, zx));
    let scale = mean.abs() + root.abs();
    for _ in 0..60 {
        let value = (root * root + minors) * root - determinant;
        let slope = 3.0 * root * root + minors;
        let step = value / slope;
        if !(slope > 0.0 && step > 1e-7 * scale) {
            break;
        }
        root -= step;
    }
    mean + root
}
