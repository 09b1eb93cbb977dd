//! Hertz' pressure and the stress on its axis.

use std::f64::consts::PI;

use fem_laws::HertzPressure;

const CONTACT: HertzPressure = HertzPressure { contact_radius: 2.0, peak_pressure: 3.0 };

/// ∫ f(r) p 2πr dr over the contact, by the midpoint rule in φ with r = a sin φ, which removes
/// the square root: p 2πr dr = p₀ 2πa² cos²φ sin φ dφ.
fn over_the_contact(f: impl Fn(f64) -> f64) -> f64 {
    let n = 2000;
    let width = 0.5 * PI / f64::from(n);
    (0..n)
        .map(|i| {
            let (sin, cos) = ((f64::from(i) + 0.5) * width).sin_cos();
            let r = CONTACT.contact_radius * sin;
            f(r) * CONTACT.pressure(r) * 2.0 * PI * r * CONTACT.contact_radius * cos * width
        })
        .sum()
}

#[test]
fn pressure_adds_up_to_the_force() {
    // The midpoint rule leaves width²/24 = 3e-8.
    assert!((over_the_contact(|_| 1.0) / CONTACT.force() - 1.0).abs() < 1e-6);
    assert_eq!(CONTACT.pressure(0.0), 3.0);
    assert!((CONTACT.pressure(1.2) - 3.0 * 0.8).abs() < 1e-15);
    for outside in [2.0, 2.5, f64::INFINITY] {
        assert_eq!(CONTACT.pressure(outside), 0.0);
    }
}

/// The pressure as a sum of point loads, with Boussinesq's stress (Johnson, eqs. 3.19): below a
/// ring of loads P at the radius r, ρ² = r² + z²,
/// σ_yy = −3Pz³/2πρ⁵ and σ_rr = P/4π [(1−2ν) z/ρ³ − 3zr²/ρ⁵].
#[test]
fn axis_stress_is_the_sum_of_boussinesqs_point_loads() {
    for depth in [0.2, 0.96, 2.0, 10.0] {
        for nu in [-0.5, 0.0, 0.244, 0.5] {
            let rho = |r: f64| r.hypot(depth);
            let axial = over_the_contact(|r| -1.5 / PI * depth.powi(3) / rho(r).powi(5));
            let radial = over_the_contact(|r| {
                let spread = (1.0 - 2.0 * nu) * depth / rho(r).powi(3);
                (spread - 3.0 * depth * r * r / rho(r).powi(5)) / (4.0 * PI)
            });
            let stress = CONTACT.axis_stress(depth, nu);
            // The midpoint rule over loads that vary on the scale 0.1 a.
            let tolerance = 1e-5 * CONTACT.peak_pressure;
            assert!((stress.axial - axial).abs() < tolerance, "{stress:?} {axial}");
            assert!((stress.radial - radial).abs() < tolerance, "{stress:?} {radial}");
        }
    }
}

#[test]
fn axis_stress_has_the_closed_form_at_the_surface_and_far_below() {
    let surface = CONTACT.axis_stress(0.0, 0.3);
    assert_eq!(surface.axial, -3.0);
    // −p₀(1 + 2ν)/2.
    assert!((surface.radial + 3.0 * 0.8).abs() < 1e-15);
    let far = CONTACT.axis_stress(2e4, 0.3);
    // The point load −3F/2πz², up to (a/z)² = 1e-8.
    assert!((far.axial / (-1.5 * CONTACT.force() / (PI * 4e8)) - 1.0).abs() < 2e-8);
    let open = HertzPressure { contact_radius: 0.0, peak_pressure: 0.0 };
    assert_eq!(open.axis_stress(0.0, 0.3).max_shear(), 0.0);
    assert_eq!(open.pressure(0.0), 0.0);
}

/// 0.31 p₀ at 0.48 a for ν = 0.3 (Johnson, eq. 3.46), to the printed digits.
#[test]
fn largest_shear_lies_below_the_surface() {
    let shear = |zeta: f64| {
        CONTACT.axis_stress(zeta * CONTACT.contact_radius, 0.3).max_shear() / CONTACT.peak_pressure
    };
    let deepest =
        (0..=1000).map(|i| f64::from(i) * 1e-3).max_by(|a, b| shear(*a).total_cmp(&shear(*b)));
    let zeta = deepest.unwrap();
    assert!((zeta - 0.48).abs() <= 0.005, "{zeta}");
    assert!((shear(zeta) - 0.31).abs() <= 0.005);
}
