//! Hertz' collision: reference table, scaling, energy, history.

use fem_laws::{HertzImpact, LawError, Pair, Partner, contact_time_coefficient};

use crate::common::{assert_close, glass_pair};

/// Reference numbers for glass, 22.2 mm on 15.9 mm, to one unit of the last digit printed: the
/// table cuts 72.6378 µs to 72.637 and has 1.3550 GPa for 1.35491.
#[test]
fn hertz_equals_the_reference_table() {
    let pair = glass_pair();
    // m/s; then T in µs, δ_max in µm, F in N, a in mm, p₀ in GPa.
    let table = [
        (0.1, "87.247 2.9643 15.513 0.11718 0.5394"),
        (0.25, "72.637 6.1698 46.581 0.16906 0.7782"),
        (0.5, "63.235 10.742 107.02 0.22307 1.0268"),
        (1.0, "55.049 18.703 245.86 0.29435 1.3550"),
    ];
    for (speed, row) in table {
        let impact = HertzImpact::new(&pair, speed).unwrap();
        let found = [
            impact.contact_time() * 1e6,
            impact.max_approach() * 1e6,
            impact.peak_force(),
            impact.max_contact_radius() * 1e3,
            impact.peak_pressure() * 1e-9,
        ];
        assert_eq!(row.split(' ').count(), found.len());
        for (found, printed) in found.into_iter().zip(row.split(' ')) {
            let n_decimals = printed.len() - printed.find('.').unwrap() - 1;
            let unit = 10f64.powi(-(n_decimals as i32));
            let expected: f64 = printed.parse().unwrap();
            assert!((found - expected).abs() <= unit, "{speed} m/s: {found}, not {printed}");
        }
        assert_eq!(impact.restitution(), 1.0);
    }
    let stiffness = HertzImpact::new(&pair, 0.5).unwrap().stiffness();
    assert!((stiffness - 3.0395e9).abs() < 0.5e5);
}

/// T v/δ_max = 2 ∫ dx/√(1−x^(5/2)) by quadrature, with x = sin ψ to remove the singularity.
#[test]
fn contact_time_coefficient_is_the_energy_integral() {
    let n = 100_000;
    let width = std::f64::consts::FRAC_PI_2 / f64::from(n);
    let integral: f64 = (0..n)
        .map(|i| (f64::from(i) + 0.5) * width)
        .map(|phase| phase.cos() / (1.0 - phase.sin().powf(2.5)).sqrt() * width)
        .sum();
    // The midpoint rule leaves width²/24 = 1e-11; the cancellation near the end adds 1e-10.
    assert!((contact_time_coefficient() - 2.0 * integral).abs() < 1e-9);
    assert!((contact_time_coefficient() - 2.94328).abs() < 5e-6);
}

/// ½ m* v² = 2/5 K δ^(5/2), T v ∝ δ, p₀ = 3F/2πa² and a² = R*δ for any size, stiffness and speed.
#[test]
fn identities_hold_over_all_sizes() {
    for mass in [1e-12, 1e-6, 1.0, 1e6] {
        for radius in [1e-6, 1e-2, 10.0] {
            for plane_strain_modulus in [1e3, 7e10, 1e12] {
                for speed in [1e-9, 1e-3, 1e3] {
                    let sphere = Partner::Sphere { radius, mass, plane_strain_modulus };
                    let pair = Pair::new(sphere, Partner::Wall).unwrap();
                    let impact = HertzImpact::new(&pair, speed).unwrap();
                    let (approach, force) = (impact.max_approach(), impact.peak_force());
                    // powf and about ten products.
                    assert_close(0.4 * force * approach, 0.5 * mass * speed * speed, 1e-13);
                    let path = contact_time_coefficient() * approach;
                    assert_close(impact.contact_time() * speed, path, 1e-14);
                    assert_close(impact.max_contact_radius().powi(2), radius * approach, 1e-14);
                    assert_close(impact.pressure(approach).force(), force, 1e-14);
                    let middle = impact.at(0.5 * impact.contact_time());
                    assert_close(middle.force, force, 1e-13);
                }
            }
        }
    }
}

/// The equation of motion integrated by velocity Verlet shares nothing with the beta function.
#[test]
fn history_obeys_the_equation_of_motion() {
    let impact = HertzImpact::new(&glass_pair(), 0.5).unwrap();
    let mass = impact.pair().effective_mass();
    let deviation = |n_steps: usize| {
        let dt = impact.contact_time() / n_steps as f64;
        let (mut approach, mut rate, mut worst) = (0.0f64, 0.5f64, 0.0f64);
        for i in 1..n_steps {
            rate -= 0.5 * dt * impact.force(approach) / mass;
            approach += dt * rate;
            rate -= 0.5 * dt * impact.force(approach) / mass;
            let instant = impact.at(dt * i as f64);
            worst = worst.max((instant.approach - approach).abs() / impact.max_approach());
            worst = worst.max((instant.approach_rate - rate).abs() / 0.5);
        }
        worst
    };
    let order = (deviation(1000) / deviation(2000)).log2();
    assert!((order - 2.0).abs() < 0.05, "order {order}");
    // Verlet leaves (ωΔt)²/24 with ωT near π.
    assert!(deviation(2000) < 1e-6);
}

#[test]
fn history_keeps_the_energy_and_mirrors_itself() {
    let impact = HertzImpact::new(&glass_pair(), 0.5).unwrap();
    let (end, mass) = (impact.contact_time(), impact.pair().effective_mass());
    for i in 0..=200 {
        let time = end * f64::from(i) / 200.0;
        let instant = impact.at(time);
        let energy = 0.5 * mass * instant.approach_rate.powi(2)
            + 0.4 * impact.force(instant.approach) * instant.approach;
        assert_close(energy, 0.5 * mass * 0.25, 1e-14);
        let mirror = impact.at(end - time);
        // The phase is resolved to 1e-15.
        assert!((instant.approach - mirror.approach).abs() < 1e-14 * impact.max_approach());
        // At 0, T/2 and T a rounding of the time decides between two branches.
        if i % 100 != 0 {
            assert!((instant.approach_rate + mirror.approach_rate).abs() < 1e-14);
        }
        assert_eq!(instant.force, impact.force(instant.approach));
    }
    let middle = impact.at(0.5 * end);
    assert_close(middle.approach, impact.max_approach(), 1e-15);
    assert!(middle.approach_rate.abs() < 1e-14);
}

/// The first terms in x = δ/δ_max of the motion: x = τ − τ^(7/2)/7 + O(τ⁶), τ = vt/δ_max.
#[test]
fn history_starts_as_its_series() {
    let impact = HertzImpact::new(&glass_pair(), 0.5).unwrap();
    for tau in [1e-9, 1e-6, 1e-3] {
        let x = tau - f64::powf(tau, 3.5) / 7.0;
        let instant = impact.at(tau * impact.max_approach() / 0.5);
        // The neglected term is 1e-15 of x at most; the beta function adds a few roundings.
        assert_close(instant.approach, x * impact.max_approach(), 1e-14);
    }
}

/// An open contact has no force and no pressure.
#[test]
fn bodies_fly_freely_before_and_after() {
    let impact = HertzImpact::new(&glass_pair(), 0.5).unwrap();
    for open in [-1e-3, -1e-12, 0.0] {
        let pressure = impact.pressure(open);
        assert_eq!(impact.force(open), 0.0);
        assert_eq!([pressure.peak_pressure, pressure.contact_radius], [0.0; 2]);
    }
    let end = impact.contact_time();
    for (time, approach, rate) in
        [(-2.0, -1.0, 0.5), (0.0, 0.0, 0.5), (end, 0.0, -0.5), (end + 2.0, -1.0, -0.5)]
    {
        let found = impact.at(time);
        // Rounding of the time after the contact.
        assert!((found.approach - approach).abs() < if time > end { 1e-15 } else { 1e-300 });
        assert_eq!((found.approach_rate, found.force), (rate, 0.0), "{time}");
    }
}

#[test]
fn impossible_speeds_are_refused() {
    let pair = glass_pair();
    for value in [0.0, -0.5, f64::INFINITY] {
        let refused = LawError::NotPositive { quantity: "approach_speed", value };
        assert_eq!(HertzImpact::new(&pair, value), Err(refused));
    }
    assert!(HertzImpact::new(&pair, f64::NAN).is_err());
    // Results beyond the range of f64.
    assert!(HertzImpact::new(&pair, 1e300).is_err());
    assert!(HertzImpact::new(&pair, 1e-300).is_err());
    let needle = Partner::Sphere { radius: 1e-300, mass: 1.0, plane_strain_modulus: 1e200 };
    let value = f64::INFINITY;
    let refused = LawError::NotPositive { quantity: "hertz peak_pressure", value };
    let needle = Pair::new(needle, Partner::Wall).unwrap();
    assert_eq!(HertzImpact::new(&needle, 1.0), Err(refused));
}
