//! Volumes, mean gradients and the hourglass shape of a quad.

use std::f64::consts::PI;

use crate::common::DISTORTED;
use fem_element::QuadGeometry;

/// ∫ 2πr dA by Green's theorem, exact for straight sides.
fn volume(corners: &[[f64; 2]; 4]) -> f64 {
    (0..4)
        .map(|a| {
            let ([r0, y0], [r1, y1]) = (corners[a], corners[(a + 1) % 4]);
            PI / 3.0 * (r0 * r0 + r0 * r1 + r1 * r1) * (y1 - y0)
        })
        .sum()
}

#[test]
fn volumes_of_a_tube_and_a_cone() {
    // Tube 1 < r < 3 of height 2: V = 16π, a corner's share 2π·½·2·l(2r_i + r_j)/6.
    let tube = QuadGeometry::new(&[[1.0, 0.0], [3.0, 0.0], [3.0, 2.0], [1.0, 2.0]]);
    // A dozen roundings.
    assert!((tube.volume / (16.0 * PI) - 1.0).abs() < 4e-15);
    let (inner, outer) = (10.0 / 3.0 * PI, 14.0 / 3.0 * PI);
    for (volume, exact) in tube.nodal_volumes.into_iter().zip([inner, outer, outer, inner]) {
        assert!((volume / exact - 1.0).abs() < 4e-15, "{volume} {exact}");
    }
    // Frustum of radii 2 and 1, height 3: π·3/3·(4 + 2 + 1), one side on the axis.
    let cone = QuadGeometry::new(&[[0.0, 0.0], [2.0, 0.0], [1.0, 3.0], [0.0, 3.0]]);
    assert!((cone.volume / (7.0 * PI) - 1.0).abs() < 4e-15);
    let skew = QuadGeometry::new(&DISTORTED);
    assert!((skew.volume / volume(&DISTORTED) - 1.0).abs() < 4e-15);
    for geometry in [tube, cone, skew] {
        let sum: f64 = geometry.nodal_volumes.iter().sum();
        assert!((sum / geometry.volume - 1.0).abs() < 4e-15);
        assert!(geometry.nodal_volumes.iter().all(|&v| v > 0.0));
    }
}

#[test]
fn mean_strain_is_exact_for_linear_fields() {
    let geometry = QuadGeometry::new(&DISTORTED);
    let strain = geometry.mean_strain(&DISTORTED.map(|[r, y]| [0.3 * r, 7.0 + 0.2 * r - 0.5 * y]));
    for (value, exact) in strain.into_iter().zip([0.3, -0.5, 0.3, 0.2]) {
        // Roundings of terms up to 7/h.
        assert!((value - exact).abs() < 1e-14, "{strain:?}");
    }
    let shear = geometry.mean_strain(&DISTORTED.map(|[_, y]| [0.4 * y, 0.0]));
    assert!((shear[3] - 0.4).abs() < 1e-15 && shear[0].abs() < 1e-15, "{shear:?}");
}

/// Moving a corner changes the volume by ∫ div u dV = V tr ε̄: V B̄_y = ∂V/∂y_a and
/// V (B̄_r + hoop) = ∂V/∂r_a.
#[test]
fn mean_dilatation_is_the_derivative_of_the_volume() {
    let geometry = QuadGeometry::new(&DISTORTED);
    for a in 0..4 {
        let dilatation = [geometry.gradient_r[a] + geometry.hoop[a], geometry.gradient_y[a]];
        for axis in 0..2 {
            let moved = |step: f64| {
                let mut corners = DISTORTED;
                corners[a][axis] += step;
                volume(&corners)
            };
            // The volume is quadratic in r_a, so the difference is exact but for rounding / step.
            let exact = (moved(0.125) - moved(-0.125)) / 0.25;
            assert!((geometry.volume * dilatation[axis] - exact).abs() < 1e-13);
        }
    }
}

#[test]
fn hourglass_shape_is_orthogonal_to_linear_fields() {
    let geometry = QuadGeometry::new(&DISTORTED);
    let amplitude = |field: &dyn Fn([f64; 2]) -> f64| -> f64 {
        (0..4).map(|a| geometry.hourglass[a] * field(DISTORTED[a])).sum()
    };
    // Roundings of numbers up to 2.
    assert!(amplitude(&|_| 1.0).abs() < 1e-14);
    assert!(amplitude(&|[r, _]| r).abs() < 1e-14);
    assert!(amplitude(&|[_, y]| y).abs() < 1e-14);
    assert!(amplitude(&|[r, y]| r * y).abs() > 1.0);
}

/// On a rectangle of half sides a, b about the radius c: φ_r = η/a, φ_y = ξ/b, so
/// ∫φ_r² = 8π c b/3a, ∫φ_y² = 8π c a/3b, and the mean of φ_y is a/3bc.
#[test]
fn hourglass_measures_of_a_rectangle() {
    let (a, b, c) = (0.7, 0.4, 2.0);
    let corners = [[c - a, -b], [c + a, -b], [c + a, b], [c - a, b]];
    let [rr, yy, ry] = QuadGeometry::new(&corners).hourglass_measures;
    let volume = 8.0 * PI * a * b * c;
    let exact_yy = 8.0 / 3.0 * PI * c * a / b - volume * (a / (3.0 * b * c)).powi(2);
    // A few roundings.
    assert!((rr / (8.0 / 3.0 * PI * c * b / a) - 1.0).abs() < 1e-14);
    assert!((yy / exact_yy - 1.0).abs() < 1e-14);
    // The mean of ξη over the revolved rectangle: odd in η.
    assert!(ry.abs() < 1e-14);
}
