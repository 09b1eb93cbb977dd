//! Newton's cradle compared with conservation laws, random inputs, and differences of an independent formula.

use fem_data::instruments::cradle::{Cradle, Measured, STANDARD_GRAVITY, Trial};

const DEGREE: f64 = std::f64::consts::PI / 180.0;

fn measured(value: f64, uncertainty: f64) -> Measured {
    Measured { value, uncertainty }
}

fn cradle() -> Cradle {
    Cradle {
        gravity: Measured::exact(STANDARD_GRAVITY),
        length: measured(0.2, 0.001),
        masses: [measured(13.69e-3, 0.01e-3), measured(5.03e-3, 0.01e-3)],
    }
}

fn trial() -> Trial {
    Trial {
        release: measured(20.0 * DEGREE, 0.2 * DEGREE),
        rise: measured(27.0 * DEGREE, 0.3 * DEGREE),
    }
}

/// Computes a trial from free fall, momentum and energy, without the formulas of the module.
#[test]
fn conservation_laws_hold() {
    let (cradle, trial) = (cradle(), trial());
    let swing = cradle.swing(&trial).unwrap();
    let (u, v1, v2) = (swing.before.value, swing.first_after.value, swing.second_after.value);
    let height = |angle: f64| 0.2 * (1.0 - angle.cos());
    let fall = |angle: f64| (2.0 * STANDARD_GRAVITY * height(angle)).sqrt();
    // Roundings of 1 − cos.
    assert!((u / fall(trial.release.value) - 1.0).abs() < 1e-12);
    assert!((v2 / fall(trial.rise.value) - 1.0).abs() < 1e-12);
    let [m1, m2] = cradle.masses.map(|mass| mass.value);
    assert!((m1 * u - m1 * v1 - m2 * v2).abs() < 1e-15);
    let e = swing.restitution.value;
    assert!((e - (v2 - v1) / u).abs() < 1e-14);
    // What is lost is (1 − e²) of the energy of the relative motion.
    let lost = 0.5 * (m1 * u * u - m1 * v1 * v1 - m2 * v2 * v2);
    let relative = 0.5 * m1 * m2 / (m1 + m2) * u * u;
    assert!((lost / relative - (1.0 - e * e)).abs() < 1e-12);
    assert!(0.0 < e && e < 1.0);
}

/// Equal balls without loss exchange their velocities; at the highest rise e = 1.
#[test]
fn elastic_cradle_exchanges_velocities() {
    let equal = Cradle { masses: [Measured::exact(1.0); 2], ..cradle() };
    let angle = Measured::exact(0.3);
    let swing = equal.swing(&Trial { release: angle, rise: angle }).unwrap();
    assert!((swing.restitution.value - 1.0).abs() < 1e-15);
    assert!(swing.first_after.value.abs() < 1e-15);
    assert!((equal.highest_rise(0.3).unwrap() - 0.3).abs() < 1e-15);
    let rise = Measured::exact(cradle().highest_rise(0.3).unwrap());
    let best = cradle().swing(&Trial { release: Measured::exact(0.3), rise }).unwrap();
    assert!((best.restitution.value - 1.0).abs() < 1e-14);
    let heavy = Cradle { masses: [Measured::exact(9.0), Measured::exact(1.0)], ..cradle() };
    assert_eq!(heavy.highest_rise(1.2), None);
}

/// Computes uncertainties by differences of free fall, momentum and the definition of e.
#[test]
fn uncertainties_are_those_of_differences() {
    let (cradle, trial) = (cradle(), trial());
    let swing = cradle.swing(&trial).unwrap();
    let inputs = [cradle.length, cradle.masses[0], cradle.masses[1], trial.release, trial.rise];
    let velocities = |x: [f64; 5]| {
        let fall = |angle: f64| (2.0 * STANDARD_GRAVITY * x[0] * (1.0 - angle.cos())).sqrt();
        let (u, v2) = (fall(x[3]), fall(x[4]));
        let v1 = u - x[2] * v2 / x[1];
        [u, v1, v2, (v2 - v1) / u]
    };
    let at = inputs.map(|input| input.value);
    let found = [swing.before, swing.first_after, swing.second_after, swing.restitution];
    for (k, found) in found.iter().enumerate() {
        let mut variance = 0.0;
        for i in 0..5 {
            let side = |sign: f64| {
                let mut x = at;
                x[i] *= 1.0 + sign * 1e-5;
                velocities(x)[k]
            };
            let slope = (side(1.0) - side(-1.0)) / (2e-5 * at[i]);
            variance += (slope * inputs[i].uncertainty).powi(2);
        }
        // Differences: 1e-10 of truncation, 1e-11 of rounding.
        assert!((found.uncertainty / variance.sqrt() - 1.0).abs() < 1e-7, "{k}");
        assert!((found.value / velocities(at)[k] - 1.0).abs() < 1e-12);
    }
    let shares: f64 = swing.shares.iter().sum();
    assert!((shares - 1.0).abs() < 1e-14);
}

/// The standard deviation of 200 000 trials with normal inputs equals the uncertainty.
#[test]
fn the_uncertainty_of_e_is_that_of_random_inputs() {
    let (cradle, trial) = (cradle(), trial());
    let swing = cradle.swing(&trial).unwrap();
    // A linear congruential generator and the sum of twelve draws, normal enough for a variance.
    let mut state = 1u64;
    let mut draw = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut normal = |input: Measured| {
        input.value + input.uncertainty * ((0..12).map(|_| draw()).sum::<f64>() - 6.0)
    };
    let n = 200_000;
    let (mut sum, mut squares) = (0.0, 0.0);
    for _ in 0..n {
        let lots =
            Cradle { masses: cradle.masses.map(|mass| Measured::exact(normal(mass))), ..cradle };
        let release = Measured::exact(normal(trial.release));
        let rise = Measured::exact(normal(trial.rise));
        let e = lots.swing(&Trial { release, rise }).unwrap().restitution.value;
        let deviation = e - swing.restitution.value;
        sum += deviation;
        squares += deviation * deviation;
    }
    let mean = sum / f64::from(n);
    let deviation = (squares / f64::from(n) - mean * mean).sqrt();
    // The scatter of the deviation is 1/√(2n) = 0.16 %, and the second order 0.1 %.
    assert!((deviation / swing.restitution.uncertainty - 1.0).abs() < 0.01, "{deviation}");
}

#[test]
fn cradle_rejects_meaningless_values() {
    let (good, trial) = (cradle(), trial());
    let angle = |value: f64| Measured::exact(value);
    for release in [0.0, -0.1, 1.6, 30.0, f64::NAN] {
        assert!(good.swing(&Trial { release: angle(release), ..trial }).is_err());
    }
    for rise in [-0.1, 1.6, f64::INFINITY] {
        assert!(good.swing(&Trial { rise: angle(rise), ..trial }).is_err());
    }
    assert!(good.swing(&Trial { rise: angle(0.0), ..trial }).is_ok());
    for bad in [
        Cradle { length: Measured::exact(0.0), ..good },
        Cradle { gravity: Measured::exact(-1.0), ..good },
        Cradle { masses: [Measured::exact(0.0), good.masses[1]], ..good },
        Cradle { length: measured(0.2, -0.1), ..good },
        Cradle { length: measured(0.2, f64::NAN), ..good },
    ] {
        assert!(bad.swing(&trial).is_err());
    }
}
