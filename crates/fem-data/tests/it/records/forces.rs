use super::*;

/// Returns the force of pulses at these times with these impulses and durations, N.
fn force(time: f64, pulses: &[(f64, f64, f64)]) -> f64 {
    let one = |(start, impulse, lasts): &(f64, f64, f64)| {
        let s = (time - start) / lasts;
        // The integral of sin^1.5 from 0 to π is 1.748 038 369 528 08.
        let peak = impulse / lasts * std::f64::consts::PI / 1.748_038_369_528_08;
        if (0.0..=1.0).contains(&s) {
            peak * (std::f64::consts::PI * s).sin().powf(1.5)
        } else {
            0.0
        }
    };
    pulses.iter().map(one).sum()
}

fn forces(text: &str, rig: &Rig) -> Result<ForceRecord, DataError> {
    read(text, rig).map(|record| match record {
        Record::Force(force) => force,
        other => panic!("{other:?}"),
    })
}

#[test]
fn forces_give_back_the_restitution_within_its_uncertainty() {
    let mut noise = Noise::seeded(4);
    let mut coverage = Coverage::default();
    for draw in 0..100 {
        let mass = noise.between(2e-3, 0.2);
        let ball = Ball { height: noise.between(0.01, 0.04), ..Ball::random(&mut noise) };
        let (lasts, n) = (noise.between(5e-4, 2e-3), 1 + draw % 3);
        let true_bounces = ball.bounces(n);
        let pulses: Vec<(f64, f64, f64)> = true_bounces
            .iter()
            .enumerate()
            .map(|(k, (time, speed))| {
                let impulse = mass * (speed * (1.0 + ball.e(*speed)) + Ball::G * lasts);
                (time + k as f64 * lasts, impulse, lasts)
            })
            .collect();
        let peak = pulses[0].1 / lasts;
        let (jitter, rate) = (peak * 10f64.powf(noise.between(-3.5, -2.0)), 40e3);
        let (offset, slope) = (noise.between(-1.0, 1.0) * peak, noise.between(-0.3, 0.3) * peak);
        let sign = if draw % 4 == 0 { -1.0 } else { 1.0 };
        let until = pulses[n - 1].0 + 0.02;
        let mut text = "TIME,FORCE\nms,N\n".to_string();
        for sample in 0..(until * rate) as usize {
            let time = sample as f64 / rate;
            let value =
                sign * force(time, &pulses) + offset + slope * time + jitter * noise.normal();
            text += &format!("{:.5},{value:.9}\n", 1e3 * time);
        }
        let off = |value: f64, share: f64, noise: &mut Noise| {
            Some(Measured {
                value: value * (1.0 + share * noise.normal()),
                uncertainty: share * value,
            })
        };
        let rig = Rig {
            mass: off(mass, 2e-3, &mut noise),
            speed: off(true_bounces[0].1, 3e-3, &mut noise),
            ..Rig::default()
        };
        let found = forces(&text, &rig).unwrap();
        assert_eq!(found.impacts.len(), n, "{draw}: {:?}", found.warnings);
        for pulse in &found.pulses {
            // sin^1.5 is above a tenth of its peak for 0.862 of its length, and above a hundredth for 0.9703.
            let short = pulse.contact_time_10_percent_s.unwrap() / lasts;
            assert!((short - 0.862).abs() < 0.03, "{draw}: {short}");
            if let Some(long) = pulse.contact_time_1_percent_s {
                assert!((long / lasts - 0.9703).abs() < 0.05, "{draw}: {}", long / lasts);
            }
        }
        coverage.count(&found.impacts, |impact| true_restitution(&ball, &true_bounces, impact));
    }
    coverage.check();
}

/// Few samples of a pulse miss its impulse by more than the noise, and the bars know that.
#[test]
fn few_samples_of_a_pulse_are_in_the_uncertainty() {
    let mut noise = Noise::seeded(10);
    let mut coverage = Coverage::default();
    let exact = |value: f64| Some(Measured::exact(value));
    for _ in 0..200 {
        let (e, speed, mass, lasts) = (noise.between(0.6, 0.95), 1.0, 0.01, 1e-3);
        let n_samples = noise.between(6.0, 25.0);
        let start = lasts * noise.between(20.0, 21.0);
        let pulses = [(start, mass * (speed * (1.0 + e) + Ball::G * lasts), lasts)];
        let row = |k: u32| {
            let time = f64::from(k) * lasts / n_samples;
            format!("{time:.9},{:.5}\n", force(time, &pulses) + 1e-3 * noise.normal())
        };
        let text = "time_s,force_n\n".to_string() + &(0..1200).map(row).collect::<String>();
        let rig = Rig { mass: exact(mass), speed: exact(speed), ..Rig::default() };
        coverage.count(&forces(&text, &rig).unwrap().impacts, |_| e);
    }
    let share = |k: usize| coverage.within[k] as f64 / coverage.n as f64;
    // The error of a sum is bounded, by two of its standard deviations.
    assert!(share(1) >= 0.95 && share(0) <= 0.9, "{coverage:?}");
}

#[test]
fn clipped_and_other_pulses_without_a_restitution_say_why() {
    let record = |top: f64, pulses: &[(f64, f64, f64)]| {
        let mut noise = Noise::seeded(5);
        let row = |k: u32| {
            let time = f64::from(k) / 50e3;
            let value = (force(time, pulses) + 0.02 * noise.normal()).min(top);
            format!("{time:.6},{value:.4}\n")
        };
        "time_s,force_n\n".to_string() + &(0..5000).map(row).collect::<String>()
    };
    let exact = |value: f64| Some(Measured::exact(value));
    // 10 g with 1 m/s and e = 0.8.
    let pulses = [(0.02, 0.01 * (1.8 + Ball::G * 1e-3), 1e-3), (0.07, 0.01 * 0.9, 1e-3)];
    let rig = Rig { mass: exact(0.01), speed: exact(1.0), ..Rig::default() };
    let whole = forces(&record(100.0, &pulses[..1]), &rig).unwrap();
    assert!((whole.impacts[0].restitution.value - 0.8).abs() < 5e-3, "{:?}", whole.impacts);
    assert!(whole.impacts[0].contact_time.is_some() && !whole.pulses[0].is_clipped);
    for (text, rig, expected) in [
        (record(20.0, &pulses[..1]), rig, "the pulse gives no restitution|clipped at "),
        (record(100.0, &pulses[..1]), Rig { mass: None, ..rig }, "no restitution|--mass"),
        (
            record(100.0, &pulses[..1]),
            Rig { speed: None, ..rig },
            "no restitution|--speed or --height",
        ),
        (
            record(100.0, &pulses[..1]),
            Rig { mass: exact(10.0), ..rig },
            "below 0|units of the force",
        ),
        (record(100.0, &[]), rig, "there is no pulse above the noise"),
        ("time_s,force_n\n0,1\n1,2\n".to_string(), rig, "2 samples are too few"),
        ("time_s,force [V]\n0,1\n1,2\n".to_string(), rig, "the unit of force_[v] is not known"),
    ] {
        let error = forces(&text, &rig).expect_err(expected);
        let whole = format!("{error}; {}", error.help.clone().unwrap_or_default());
        assert!(expected.split('|').all(|part| whole.contains(part)), "{expected}: {whole}");
    }
    // An amplifier that saturates before its noise has no equal samples.
    let mut noise = Noise::seeded(12);
    let row = |k: u32| {
        let time = f64::from(k) / 50e3;
        format!("{time:.6},{:.5}\n", force(time, &pulses[..1]).min(16.0) + 0.02 * noise.normal())
    };
    let saturated = "time_s,force_n\n".to_string() + &(0..5000).map(row).collect::<String>();
    let error = forces(&saturated, &rig).unwrap_err();
    assert!(error.help.is_some_and(|help| help.contains("clipped")), "{}", error.message);
    // The second pulse is no bounce of the first one, which would follow after 2 · 0.8/g = 0.16 s: it is a drop of its own.
    let two = forces(&record(100.0, &pulses), &rig).unwrap();
    assert_eq!(two.impacts.len(), 1, "{:?}", two.warnings);
    // A sensor in the striking body measures less than the contact force, by the mass in front of it.
    let front = Rig { sensor_mass: exact(0.002), ..rig };
    let e = forces(&record(100.0, &pulses[..1]), &front);
    assert!(e.err().is_some_and(|error| error.to_string().contains("no restitution")));
}
