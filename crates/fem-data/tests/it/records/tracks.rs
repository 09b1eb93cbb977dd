use super::*;

fn track(text: &str, rig: &Rig) -> Track {
    let Record::Track(track) = read(text, rig).unwrap() else { panic!("another kind") };
    track
}

#[test]
fn tracks_give_back_the_restitution_within_its_uncertainty() {
    let mut noise = Noise::seeded(2);
    let mut coverage = Coverage::default();
    for draw in 0..100 {
        let ball = Ball::random(&mut noise);
        let n = 2 + noise.0.usize(0..5);
        let true_bounces = ball.bounces(n + 1);
        let rate = [60.0, 120.0, 240.0, 1000.0][draw % 4];
        let (jitter, phase) = (10f64.powf(noise.between(-4.0, -3.0)), noise.between(0.0, 1.0));
        let drift = if draw % 5 == 0 { noise.between(-0.01, 0.01) } else { 0.0 };
        let flips = draw % 7 == 0;
        let until = true_bounces[n].0 - 2.0 / rate;
        let mut text = "# a ball\nmass_A\nt\tx\ty\ns\tcm\tcm\n".to_string();
        for frame in 0..(until * rate) as usize {
            let time = (frame as f64 + phase) / rate;
            if noise.0.f64() < 0.05 {
                // The tracker has lost the ball.
                text += &format!("{time:.7}\t\t\n");
                continue;
            }
            let y =
                height(&ball, &true_bounces[..n], time) + drift * time + jitter * noise.normal();
            let y = 100.0 * if flips { -y } else { y };
            text += &format!("{time:.7}\t1.0\t{y:.6}\n");
        }
        let found = track(&text, &Rig::default());
        assert!(found.has_fitted_gravity, "{draw}: {:?}", found.gravity);
        // At 60 frames per second the last flights have too few frames.
        let n_short = if rate < 100.0 { 2 } else { 1 };
        assert!(
            found.impacts.len() + n_short >= n,
            "{draw}: {} of {n}: {:?}",
            found.impacts.len(),
            found.warnings
        );
        coverage.count(&found.impacts, |impact| true_restitution(&ball, &true_bounces, impact));
    }
    assert!(coverage.n > 300, "{coverage:?}");
    coverage.check();
}

/// A track in frames and pixels gives the restitutions and speeds of the track in metres, with the scale by gravity, or by `scale`.
#[test]
fn frames_and_pixels_are_read() {
    let ball = Ball { height: 0.5, restitution: 0.8, slope: 0.0 };
    let (true_bounces, mut noise) = (ball.bounces(4), Noise::seeded(12));
    let (rate, pixel) = (240.0, 8e-4);
    let frames: Vec<(usize, f64)> = (0..(true_bounces[3].0 * rate) as usize)
        .map(|k| (k, height(&ball, &true_bounces[..3], k as f64 / rate) + 2e-4 * noise.normal()))
        .collect();
    let rows = |time: &dyn Fn(usize) -> f64| -> String {
        let row = |(k, y): &(usize, f64)| format!("{:.6},{:.4}\n", time(*k), 700.0 - y / pixel);
        frames.iter().map(row).collect()
    };
    let exact = |value: f64| Some(Measured::exact(value));
    let numbered = Rig { frame_rate: exact(rate), ..Rig::default() };
    let of_frames = "frame,y_px\n".to_string() + &rows(&|k| k as f64);
    let of_seconds = "time [s],y [px]\n".to_string() + &rows(&|k| k as f64 / rate);
    for (text, rig) in [
        (&of_frames, numbered),
        (&of_frames, Rig { gravity: exact(9.80665), ..numbered }),
        (&of_frames, Rig { scale: exact(pixel), ..numbered }),
        (&of_seconds, Rig::default()),
    ] {
        let found = track(text, &rig);
        let scale = found.pixel.unwrap();
        assert!((scale.value - pixel).abs() <= 4.0 * scale.uncertainty, "{scale:?}");
        assert!(scale.uncertainty < 0.01 * pixel, "{scale:?}");
        assert_eq!(found.impacts.len(), 3, "{:?}", found.warnings);
        for (impact, (_, speed)) in found.impacts.iter().zip(&true_bounces) {
            let Measured { value, uncertainty } = impact.speed;
            assert!((value - speed).abs() < 4.0 * uncertainty, "{impact:?} {speed}");
            let Measured { value, uncertainty } = impact.restitution;
            assert!((value - 0.8).abs() < 4.0 * uncertainty, "{impact:?}");
        }
    }
    let error = read(&of_frames, &Rig::default()).unwrap_err();
    assert!(error.help.is_some_and(|help| help.contains("--frame-rate")));
}

/// Frames of a table-tennis ball in air with noise give back the restitution within its uncertainty, and g, with the size and the density of the
/// ball; in vacuum the restitution would be too small by more than four of its bars.
#[test]
fn air_drag_is_taken_out_of_tracks() {
    let e = 0.9;
    let mut exact_frames = Vec::new();
    let mut next = 0.0;
    let true_bounces = bounces_in_air(e, 6, |time, y| {
        if time >= next {
            exact_frames.push((time, y));
            next += 1.0 / 240.0;
        }
    });
    // The last frames are before the last bounce.
    exact_frames.pop();
    let mut noise = Noise::seeded(6);
    let known = |value: f64| Some(Measured::exact(value));
    let rig = Rig { diameter: known(0.04), density: known(TABLE_TENNIS), ..Rig::default() };
    let (mut coverage, mut n_wrong, mut n_all) = (Coverage::default(), 0, 0);
    for _ in 0..100 {
        let rows = exact_frames
            .iter()
            .map(|(time, y)| format!("{time:.6},{:.6}\n", y + 3e-4 * noise.normal()));
        let text = "time_s,y_m\n".to_string() + &rows.collect::<String>();
        let found = track(&text, &rig);
        assert_eq!(found.impacts.len(), 5, "{:?}", found.warnings);
        coverage.count(&found.impacts, |_| e);
        let ratio = 1.204 / TABLE_TENNIS;
        let gravity = 9.80665 * (1.0 - ratio) / (1.0 + 0.5 * ratio);
        let off = (found.gravity.value - gravity).abs() / found.gravity.uncertainty;
        assert!(off < 4.5, "{:?}", found.gravity);
        let first = found.impacts[0].speed;
        assert!((first.value - true_bounces[0].1).abs() < 4.0 * first.uncertainty, "{first:?}");
        let vacuum = track(&text, &Rig::default()).impacts;
        let is_off =
            |impact: &&Impact| impact.restitution.value < e - 4.0 * impact.restitution.uncertainty;
        n_wrong += vacuum.iter().filter(is_off).count();
        n_all += vacuum.len();
    }
    let share = |k: usize| coverage.within[k] as f64 / coverage.n as f64;
    assert!(share(1) >= 0.95, "{coverage:?}");
    assert!(n_wrong > n_all / 2, "{n_wrong} of {n_all}");
}

/// A hand that holds the ball before the drop leaves the restitution of the first bounce within its uncertainty.
#[test]
fn a_hand_before_the_drop_does_not_change_the_first_restitution() {
    let mut noise = Noise::seeded(7);
    let (mut first, mut n_within) = (0, 0);
    for draw in 0..120 {
        let ball = Ball::random(&mut noise);
        let true_bounces = ball.bounces(4);
        let rate = [30.0, 60.0, 120.0, 240.0][draw % 4];
        let (jitter, held) = (10f64.powf(noise.between(-4.0, -2.7)), noise.between(0.05, 0.5));
        let mut text = "t,y\n".to_string();
        for frame in 0..((true_bounces[3].0 + held - 2.0 / rate) * rate) as usize {
            let time = frame as f64 / rate;
            let y = if time < held {
                ball.height
            } else {
                height(&ball, &true_bounces[..3], time - held)
            };
            text += &format!("{time:.6},{:.7}\n", y + jitter * noise.normal());
        }
        let Ok(Record::Track(found)) = read(&text, &Rig::default()) else { continue };
        let Some(impact) =
            found.impacts.iter().find(|it| (it.time - held - true_bounces[0].0).abs() < 0.02)
        else {
            continue;
        };
        let off = impact.restitution.value - ball.e(true_bounces[0].1);
        first += 1;
        n_within += usize::from(off.abs() < 2.0 * impact.restitution.uncertainty);
    }
    assert!(first > 100, "{first}");
    // 95 % less two standard deviations of the count.
    assert!(n_within as f64 > 0.91 * first as f64, "{n_within} of {first}");
}

/// A hand holds the ball before the drop, a frame is wrong, the scale is 3 % off, and the ball rests at the end.
#[test]
fn hands_outliers_and_scales_of_tracks_are_found() {
    let ball = Ball { height: 0.6, restitution: 0.8, slope: 0.0 };
    let all = ball.bounces(40);
    let mut noise = Noise::seeded(3);
    let mut rows = String::new();
    for frame in 0..900 {
        let time = f64::from(frame) / 240.0;
        let y = if time < 0.5 { 0.6 } else { height(&ball, &all, time - 0.5) };
        let y = 1.03 * y + 2e-4 * noise.normal() + if frame == 300 { 0.2 } else { 0.0 };
        rows += &format!("{time:.6};{y:.6}\n").replace('.', ",");
    }
    let found = track(&format!("time [s];height [m]\n{rows}"), &Rig::default());
    assert!(found.impacts.len() >= 6, "{:?}", found.warnings);
    for impact in &found.impacts {
        let Measured { value, uncertainty } = impact.restitution;
        assert!((value - 0.8).abs() < 4.0 * uncertainty, "{impact:?}");
        // The scale is in the bar of the speed.
        assert!(impact.speed.uncertainty > 0.02 * impact.speed.value, "{impact:?}");
    }
    assert!((found.gravity.value / Ball::G - 1.03).abs() < 0.003, "{:?}", found.gravity);
    let warnings = found.warnings.join("; ");
    assert!(warnings.contains("the scale of the heights is off by 3."), "{warnings}");
    assert!(warnings.contains("far off"), "{warnings}");
    // With a given g the scale is not questioned.
    let rig = Rig { gravity: Some(Measured::exact(1.03 * Ball::G)), ..Rig::default() };
    let given = track(&format!("time [s];height [m]\n{rows}"), &rig);
    assert!(!given.has_fitted_gravity && given.impacts.len() == found.impacts.len());
    // A contact time of 4 ms has the ball fall and rise for 2 ms less.
    let rig = Rig { contact_time: Some(Measured::exact(4e-3)), ..Rig::default() };
    let late = track(&format!("time [s];height [m]\n{rows}"), &rig).impacts[0];
    let own = found.impacts[0];
    let change = 0.5 * 1.03 * Ball::G * 4e-3;
    let expected = (own.restitution.value * own.speed.value + change) / (own.speed.value - change);
    assert!((late.restitution.value - expected).abs() < 1e-3, "{late:?} {expected}");
}

#[test]
fn tracks_without_a_bounce_say_why() {
    let row = |k: i32, y: f64| format!("{:.4},{y:.6}\n", f64::from(k) / 100.0);
    let fall: String = (0..40).map(|k| row(k, 1.0 - 4.9 * f64::from(k * k) * 1e-4)).collect();
    let ball = Ball { height: 0.5, restitution: 0.8, slope: 0.0 };
    let all = ball.bounces(6);
    let whole = |scale: f64| -> String {
        (0..200).map(|k| row(k, scale * height(&ball, &all, f64::from(k) / 100.0))).collect()
    };
    for (text, expected) in [
        ("time_s,y_m\n0,1\n0.1,0.9\n".to_string(), "2 frames are too few for a bounce"),
        (format!("time_s,y_m\n{fall}"), "there is no bounce"),
        (format!("time_s,y_m\n{}", whole(100.0)), "the parabolas fall with 980.66"),
        (format!("time_s,y [ell]\n{}", whole(100.0)), "the unit of y_[ell] is not known"),
        (
            format!("time_s,y_m\n{}0.5,0.1\n", whole(1.0)),
            "record.csv:202: the time 0.5 s does not increase",
        ),
        ("time_s,y_m\n0,1\n0.1,x\n".to_string(), "record.csv:3: y_m is \"x\""),
    ] {
        let error = read(&text, &Rig::default()).expect_err(expected);
        assert!(error.to_string().contains(expected), "{expected}: {error}");
    }
    assert_eq!(track(&format!("time_s,y_m\n{}", whole(1.0)), &Rig::default()).drift, 0.0);
}

/// Distortions of a picture: its scale grows as the ball comes nearer, the camera looks at an angle, or it accelerates. None of them
/// cancels, and the bars have them; a constant scale and a plate that drifts leave the bars as they are.
#[test]
fn distorted_tracks_have_wider_bars() {
    let ball = Ball { height: 0.5, restitution: 0.85, slope: 0.0 };
    let all = ball.bounces(7);
    let worst_of = |distort: &dyn Fn(f64, f64) -> f64| {
        let (mut worst, mut largest): (f64, f64) = (0.0, 0.0);
        for seed in 0..4 {
            let mut noise = Noise::seeded(seed);
            let rows = (0..(240.0 * all[6].0) as usize - 3).map(|frame| {
                let time = frame as f64 / 240.0;
                let y = distort(time, height(&ball, &all[..6], time)) + 2e-4 * noise.normal();
                format!("{time:.7},{y:.7}\n")
            });
            let found =
                track(&("time_s,y_m\n".to_string() + &rows.collect::<String>()), &Rig::default());
            let says = found.warnings.join(" ").contains("the scale changes in the picture");
            assert!(!says || !found.warnings.join(" ").contains("cancels"), "{:?}", found.warnings);
            for Measured { value, uncertainty } in found.impacts.iter().map(|one| one.restitution) {
                worst = worst.max((value - 0.85).abs() / uncertainty);
                largest = largest.max(uncertainty);
            }
        }
        (worst, largest)
    };
    // 24 impacts: 3.5 standard uncertainties of a correct bar are exceeded in one of 90 tests.
    let (worst, usual) = worst_of(&|_, y| y);
    assert!(worst < 3.5, "{worst}");
    for (name, distort) in [
        ("a constant scale", &(|_, y| 1.03 * y) as &dyn Fn(f64, f64) -> f64),
        ("a drift", &|t, y| y + 0.01 * t),
    ] {
        let (worst, largest) = worst_of(distort);
        assert!(worst < 3.5 && largest < 1.5 * usual, "{name}: {worst} {largest}");
    }
    for (name, distort) in [
        ("a ball that comes nearer", &(|t, y| y * (1.0 + 0.01 * t)) as &dyn Fn(f64, f64) -> f64),
        ("a zoom about another height", &|t, y| (y - 0.2) * (1.0 + 0.02 * t)),
        ("perspective", &|_, y| y / (1.0 + 0.1 * y)),
        ("a lens", &|_, y| y + 0.05 * y * y),
        ("an accelerating camera", &|t, y| y - 0.025 * t * t),
        ("a camera in a hand", &|t: f64, y| y + 0.01 * (1.5 * t).sin()),
    ] {
        let (worst, _) = worst_of(distort);
        assert!(worst < 3.5, "{name}: {worst}");
    }
}
