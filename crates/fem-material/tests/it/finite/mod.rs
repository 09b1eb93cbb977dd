//! Finite strain at a point.

mod closed_forms;
mod flow;
mod laws;
mod relaxation;
mod relaxation_limits;
mod stiffness;

use fem_material::ElasticModuli;
use fem_material::finite::{AxisymmetricTensor, Hyperelastic, HyperelasticLaw};

/// Numbers in −1 .. 1, the same on every machine (Knuth's linear congruence).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        const FACTOR: u64 = 6_364_136_223_846_793_005;
        self.0 = self.0.wrapping_mul(FACTOR).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// A displacement gradient with components up to `size`; below 0.5 its J is positive.
    fn gradient(&mut self, size: f64) -> AxisymmetricTensor {
        tensor(std::array::from_fn(|_| size * self.next()))
    }
}

fn tensor([rr, ry, yr, yy, tt]: [f64; 5]) -> AxisymmetricTensor {
    AxisymmetricTensor { rr, ry, yr, yy, tt }
}

fn components(t: &AxisymmetricTensor) -> [f64; 5] {
    [t.rr, t.ry, t.yr, t.yy, t.tt]
}

/// H of F, both by components.
fn gradient_of([rr, ry, yr, yy, tt]: [f64; 5]) -> AxisymmetricTensor {
    tensor([rr - 1.0, ry, yr, yy - 1.0, tt - 1.0])
}

/// F = 1 + H by components.
fn deformation(h: &AxisymmetricTensor) -> [f64; 5] {
    [1.0 + h.rr, h.ry, h.yr, 1.0 + h.yy, 1.0 + h.tt]
}

/// A B of two such tensors.
fn product([a, b, c, d, t]: [f64; 5], [e, f, g, h, u]: [f64; 5]) -> [f64; 5] {
    [a * e + b * g, a * f + b * h, c * e + d * g, c * f + d * h, t * u]
}

fn distance(a: [f64; 5], b: [f64; 5]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// Cauchy's stress of P by components: P Fᵀ/J.
fn cauchy_of(piola: [f64; 5], h: &AxisymmetricTensor) -> [f64; 5] {
    let [rr, ry, yr, yy, tt] = deformation(h);
    let jacobian = (rr * yy - ry * yr) * tt;
    product(piola, [rr, yr, ry, yy, tt]).map(|x| x / jacobian)
}

/// Slopes of a first Piola-Kirchhoff stress, by differences.
fn differences(
    h: &AxisymmetricTensor,
    stress: impl Fn(&AxisymmetricTensor) -> AxisymmetricTensor,
) -> [[f64; 5]; 5] {
    let delta = 1e-5;
    let mut slopes = [[0.0; 5]; 5];
    for l in 0..5 {
        let at = |shift: f64| {
            let mut moved = components(h);
            moved[l] += shift;
            components(&stress(&tensor(moved)))
        };
        let (after, before) = (at(delta), at(-delta));
        for k in 0..5 {
            slopes[k][l] = (after[k] - before[k]) / (2.0 * delta);
        }
    }
    slopes
}

/// Asserts that a tangent is the slope of a stress.
#[track_caller]
fn assert_slopes(
    tangent: [[f64; 5]; 5],
    h: &AxisymmetricTensor,
    tolerance: f64,
    stress: impl Fn(&AxisymmetricTensor) -> AxisymmetricTensor,
) {
    let expected = differences(h, stress);
    for (found, expected) in tangent.as_flattened().iter().zip(expected.as_flattened()) {
        assert!((found - expected).abs() < tolerance, "{found} {expected} at {h:?}");
    }
}

/// The rotation of the meridian plane by an angle.
fn rotation(angle: f64) -> [f64; 5] {
    let (s, c) = angle.sin_cos();
    [c, -s, s, c, 1.0]
}

/// Moduli with E = 2, so that G is about 2/3.
fn solid(law: HyperelasticLaw, nu: f64) -> Hyperelastic {
    Hyperelastic::new(law, &moduli(nu))
}

fn moduli(nu: f64) -> ElasticModuli {
    ElasticModuli::from_youngs_modulus_poissons_ratio(2.0, nu).unwrap()
}
