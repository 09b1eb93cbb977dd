//! Records of a bouncing ball, made by its equations of motion with noise, give back the restitution within their
//! uncertainty; records that say nothing are errors that say why.

use fem_laws::{EndRule, LawFamily, Pair, Partner};
use fem_material::{ElasticModuli, Material};
use fem_study::fit::cradle::Measured;
use fem_study::fit::{Model, Point, Problem};
use fem_study::measured::DataError;
use fem_study::records::{
    BounceTimes, ForceRecord, FreeFlight, Impact, Record, Rig, Signal, Sound,
    TimeUncertaintySource, Track,
};

/// Random numbers with a normal distribution.
struct Noise(fastrand::Rng);

impl Noise {
    fn seeded(seed: u64) -> Self {
        Self(fastrand::Rng::with_seed(seed))
    }

    /// Returns a number of variance 1: Irwin–Hall, the sum of twelve uniform numbers.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.0.f64()).sum::<f64>() - 6.0
    }

    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.0.f64()
    }
}

/// A ball that falls from a height at time 0 and bounces in vacuum with e = e₁ − slope·v.
#[derive(Clone, Copy, Debug)]
struct Ball {
    height: f64,
    restitution: f64,
    slope: f64,
}

impl Ball {
    const G: f64 = 9.80665;

    fn random(noise: &mut Noise) -> Self {
        Self {
            height: noise.between(0.2, 1.5),
            restitution: noise.between(0.7, 0.96),
            slope: noise.between(-0.02, 0.03),
        }
    }

    fn e(&self, speed: f64) -> f64 {
        (self.restitution - self.slope * speed).min(0.99)
    }

    /// Returns instant and approach speed of each bounce.
    fn bounces(&self, n: usize) -> Vec<(f64, f64)> {
        let mut speed = (2.0 * Self::G * self.height).sqrt();
        let mut time = speed / Self::G;
        let bounce = |_| {
            let now = (time, speed);
            speed *= self.e(speed);
            time += 2.0 * speed / Self::G;
            now
        };
        (0..n).map(bounce).collect()
    }
}

fn read(text: &str, rig: &Rig) -> Result<Record, DataError> {
    Record::read("record.csv", text.as_bytes(), None, &[], rig)
}

fn bounces(text: &str, rig: &Rig) -> BounceTimes {
    let Record::BounceTimes(bounces) = read(text, rig).unwrap() else { panic!("another kind") };
    bounces
}

fn list(times: impl IntoIterator<Item = f64>) -> String {
    let rows = times.into_iter().map(|time| format!("{time:.9}\n"));
    "time_s\n".to_string() + &rows.collect::<String>()
}

/// Counts the impacts whose restitution is within one and within two standard uncertainties.
#[derive(Debug, Default)]
struct Coverage {
    n: usize,
    within: [usize; 2],
}

impl Coverage {
    fn count(&mut self, impacts: &[Impact], e: impl Fn(&Impact) -> f64) {
        for impact in impacts {
            let Measured { value, uncertainty } = impact.restitution;
            let error = (value - e(impact)).abs();
            self.n += 1;
            self.within[0] += usize::from(error <= uncertainty);
            self.within[1] += usize::from(error <= 2.0 * uncertainty);
        }
    }

    /// Two standard uncertainties hold in 95 % of the cases, and one does not in more than nine of ten: a bar that always holds is
    /// too wide.
    #[track_caller]
    fn check(&self) {
        let share = |k: usize| self.within[k] as f64 / self.n as f64;
        assert!(share(1) >= 0.95, "{self:?}");
        assert!(share(0) <= 0.9, "{self:?}");
    }
}

#[test]
fn bounce_times_give_back_the_restitution_within_its_uncertainty() {
    let mut noise = Noise::seeded(1);
    let (mut coverage, mut n_draws) = (Coverage::default(), 0);
    for draw in 0..100 {
        let ball = Ball::random(&mut noise);
        let jitter = 10f64.powf(noise.between(-5.0, -3.0));
        let n = 5 + noise.0.usize(0..10);
        let true_bounces = ball.bounces(n);
        let missing = if draw % 3 == 0 { noise.0.usize(1..n) } else { n };
        let times = true_bounces.iter().enumerate().filter(|(k, _)| *k != missing);
        let times: Vec<f64> = times.map(|(_, (time, _))| time + jitter * noise.normal()).collect();
        let found = bounces(&list(times), &Rig::default());
        assert_eq!(found.source, TimeUncertaintySource::Scatter);
        coverage.count(&found.impacts, |impact| {
            let near = true_bounces
                .iter()
                .min_by(|a, b| (a.0 - impact.time).abs().total_cmp(&(b.0 - impact.time).abs()));
            ball.e(near.unwrap().1)
        });
        n_draws += usize::from(!found.impacts.is_empty());
    }
    assert_eq!(n_draws, 100);
    coverage.check();
}

/// Errors of neighbouring restitutions, which share a flight, have opposite signs and cancel in the mean. Over 600 draws the squares and
/// products of the errors agree with the stated covariances, and the mean with its uncertainty, which is less than half
/// of that of independent errors.
#[test]
fn covariances_of_neighbours_are_those_of_draws() {
    const DRAWS: f64 = 600.0;
    let e = 0.9;
    let mut noise = Noise::seeded(5);
    let (mut found, mut stated) = ([0.0; 3], [0.0; 3]);
    let (mut of_mean, mut if_independent) = (0.0, 0.0);
    for _ in 0..DRAWS as usize {
        let (mut time, mut flight) = (0.3, 0.4);
        let mut times = vec![time];
        for _ in 0..9 {
            time += flight;
            flight *= e;
            times.push(time);
        }
        let jitter = 1e-4;
        times.iter_mut().for_each(|time| *time += jitter * noise.normal());
        let rig = Rig { time_uncertainty: Some(jitter), ..Rig::default() };
        let bounces = bounces(&list(times), &rig);
        let errors: Vec<f64> =
            bounces.impacts.iter().map(|impact| impact.restitution.value - e).collect();
        // The bounce in the middle, and those after it.
        let covariances = bounces.covariances()[3];
        for k in 0..3 {
            found[k] += errors[3] * errors[3 + k] / DRAWS;
            stated[k] += covariances[k].unwrap() / DRAWS;
        }
        let mean = bounces.mean_restitution().unwrap();
        of_mean += ((mean.value - e) / mean.uncertainty).powi(2) / DRAWS;
        let n = bounces.impacts.len() as f64;
        let squares = bounces.impacts.iter().map(|impact| impact.restitution.uncertainty.powi(2));
        if_independent += squares.sum::<f64>().sqrt() / n / mean.uncertainty / DRAWS;
    }
    // A mean of 600 squares scatters by 6 %, one of products by up to 8 %.
    assert!((found[0] / stated[0] - 1.0).abs() < 0.2, "{found:?} {stated:?}");
    assert!(stated[1] < -0.5 * stated[0] && stated[2] > 0.0, "{stated:?}");
    for k in 1..3 {
        assert!((found[k] - stated[k]).abs() < 0.2 * stated[0], "{found:?} {stated:?}");
    }
    assert!((of_mean - 1.0).abs() < 0.2, "{of_mean}");
    assert!(if_independent > 2.0, "{if_independent}");
}

/// Density of a table-tennis ball of 40 mm and 2.7 g, kg/m³.
const TABLE_TENNIS: f64 = 80.573_4;

/// Returns instant and approach speed of the bounces of a table-tennis ball that falls from 50 cm in air, moved by steps of 10 µs, without the
/// integrals of the library; `watch` gets time and height after each step.
fn bounces_in_air(e: f64, n: usize, mut watch: impl FnMut(f64, f64)) -> Vec<(f64, f64)> {
    let ratio = 1.204 / TABLE_TENNIS;
    let gravity = 9.80665 * (1.0 - ratio) / (1.0 + 0.5 * ratio);
    let deceleration = |v: f64| {
        let re = 1.204 * v * 0.04 / 1.81e-5;
        let c_d =
            24.0 / re * (1.0 + 0.15 * re.powf(0.687)) + 0.42 / (1.0 + 42_500.0 * re.powf(-1.16));
        0.75 * ratio / (1.0 + 0.5 * ratio) * c_d * v * v / 0.04
    };
    let acceleration =
        |v: f64| if v == 0.0 { -gravity } else { -gravity - v.signum() * deceleration(v.abs()) };
    let step = 1e-5;
    let (mut y, mut v, mut time) = (0.5f64, 0.0f64, 0.0);
    let mut bounces = Vec::new();
    while bounces.len() < n {
        let middle = v + 0.5 * step * acceleration(v);
        y += step * middle;
        v += step * acceleration(middle);
        time += step;
        if y < 0.0 && v < 0.0 {
            let late = y / v;
            bounces.push((time - late, -v));
            (y, v) = (0.0, -e * v);
            time -= late;
        }
        watch(time, y);
    }
    bounces
}

#[test]
fn air_drag_is_taken_out() {
    let e = 0.9;
    let (times, speeds): (Vec<f64>, Vec<f64>) = bounces_in_air(e, 8, |_, _| ()).into_iter().unzip();
    let density = TABLE_TENNIS;
    let exact = Measured::exact;
    let vacuum = Rig { drop_height: Some(exact(0.5)), ..Rig::default() };
    let rig = Rig { diameter: Some(exact(0.04)), density: Some(exact(density)), ..vacuum };
    let found = bounces(&list(times.iter().copied()), &rig);
    assert_eq!(found.impacts.len(), 7);
    for (impact, speed) in found.impacts.iter().zip(&speeds) {
        // A step that begins before the bounce errs by up to its length times gravity, 1e-4 m/s.
        assert!((impact.restitution.value - e).abs() < 2e-4, "{impact:?}");
        assert!((impact.speed.value - speed).abs() < 3e-4, "{impact:?} {speed}");
        // A tenth of the drag is in the bar, and what a ball in vacuum would say is far off.
        assert!(impact.restitution.uncertainty > 1e-4, "{impact:?}");
    }
    let wrong = bounces(&list(times.iter().copied()), &vacuum);
    assert!((wrong.impacts[0].restitution.value - e).abs() > 0.01, "{:?}", wrong.impacts[0]);
}

#[test]
fn flight_in_thin_air_is_that_in_vacuum_and_foam_lands_at_its_terminal_speed() {
    let vacuum = FreeFlight::in_vacuum(9.81).lasting(0.5).unwrap();
    let heavy = FreeFlight::in_air(9.81, 0.1, 1e12, 1.0).lasting(0.5).unwrap();
    assert!((heavy.launch / vacuum.launch - 1.0).abs() < 1e-9, "{heavy:?}");
    assert!((heavy.landing_slope / vacuum.landing_slope - 1.0).abs() < 1e-9, "{heavy:?}");
    assert_eq!(FreeFlight::in_air(9.81, 5e-3, 10.0, 1.0).lasting(3.0), None);
    // The slopes are those of differences.
    let flight = FreeFlight::in_air(9.81, 0.04, 84.0, 1.0);
    let [slow, middle, fast] = [0.6, 0.6001, 0.6002].map(|time| flight.lasting(time).unwrap());
    let launch_slope = (fast.launch - slow.launch) / 2e-4;
    let landing_slope = (fast.landing - slow.landing) / 2e-4;
    assert!((middle.launch_slope / launch_slope - 1.0).abs() < 1e-6, "{middle:?}");
    assert!((middle.landing_slope / landing_slope - 1.0).abs() < 1e-6, "{middle:?}");
}

#[test]
fn missing_and_additional_instants_are_found() {
    for e in [0.5, 0.7, 0.9, 0.97] {
        let ball = Ball { height: 1.0, restitution: e, slope: 0.0 };
        let whole: Vec<f64> = ball.bounces(12).into_iter().map(|(time, _)| time).collect();
        assert!(bounces(&list(whole.clone()), &Rig::default()).warnings.len() <= 1);
        for at in 1..11 {
            let mut times = whole.clone();
            times.remove(at);
            let found = bounces(&list(times), &Rig::default());
            let doubled: Vec<usize> =
                found.spans.iter().filter(|span| span.n_flights == 2).map(|span| span.to).collect();
            assert_eq!(doubled, [at], "{e}: {:?}", found.spans);
            assert!(found.warnings[0].starts_with("an instant is missing"), "{:?}", found.warnings);
            let mut times = whole.clone();
            times.insert(at + 1, whole[at] + 0.1 * (whole[at + 1] - whole[at]));
            let found = bounces(&list(times), &Rig::default());
            let joined: Vec<usize> = found
                .spans
                .iter()
                .filter(|span| span.to == span.from + 2)
                .map(|span| span.from)
                .collect();
            assert_eq!(joined, [at], "{e}: {:?}", found.spans);
            for impact in &found.impacts {
                assert!((impact.restitution.value - e).abs() < 1e-4, "{e}: {impact:?}");
            }
        }
    }
}

/// The drop, the contact time and the time to rest of a ball with a constant restitution.
#[test]
fn height_contact_time_and_rest_of_the_rig_are_used() {
    let ball = Ball { height: 0.5, restitution: 0.8, slope: 0.0 };
    let (contact, true_bounces) = (2e-3, ball.bounces(6));
    let late = |k: usize| true_bounces[k].0 + k as f64 * contact;
    let times: Vec<f64> = (0..6).map(late).collect();
    let exact = |value: f64| Some(Measured::exact(value));
    let rig = Rig {
        drop_height: exact(0.5),
        contact_time: exact(contact),
        rest: Some(Measured { value: true_bounces[0].0 * 9.0, uncertainty: 1e-3 }),
        ..Rig::default()
    };
    let found = bounces(&list(times.clone()), &rig);
    assert_eq!(found.impacts.len(), 5);
    for impact in &found.impacts {
        assert!((impact.restitution.value - 0.8).abs() < 1e-6, "{impact:?}");
    }
    let (first, fall) = (found.impacts[0], (2.0 * Ball::G * 0.5).sqrt());
    // Instants are written with nine decimals.
    assert!((first.speed.value - fall).abs() < 1e-9 && (first.time - times[0]).abs() < 1e-9);
    // Without a contact time the first instant to rest is the sum of all flights, 2 t₁ e/(1 − e) with t₁ of the fall.
    let rig = Rig { contact_time: None, ..rig };
    let found = bounces(&list(true_bounces.iter().map(|(time, _)| *time)), &rig);
    let to_rest = found.restitution_to_rest.unwrap();
    assert!((to_rest.value - 0.8).abs() < 1e-6, "{to_rest:?}");
    assert!((found.predicted_rest.unwrap() - 9.0 * true_bounces[0].0).abs() < 1e-5);
    // The slope by the contact time is that of a difference.
    let change = 1e-5;
    let rig = Rig { contact_time: exact(change), ..Rig::default() };
    let [with, without] = [rig, Rig::default()].map(|rig| {
        let found = bounces(&list(true_bounces.iter().map(|(time, _)| *time)), &rig);
        (found.impacts.last().unwrap().restitution.value, found.contact_time_slope)
    });
    assert!(((with.0 - without.0) / change / without.1 - 1.0).abs() < 1e-3);
    // One flight suffices with the height or with the rest.
    for rig in [
        Rig { drop_height: exact(0.5), ..Rig::default() },
        Rig { rest: exact(9.0 * true_bounces[0].0), ..Rig::default() },
    ] {
        let found = bounces(&list(true_bounces[..2].iter().map(|(time, _)| *time)), &rig);
        assert_eq!(found.impacts.len(), 1);
        assert!((found.impacts[0].restitution.value - 0.8).abs() < 1e-6);
    }
}

#[test]
fn headers_units_and_dialects_of_instants_are_read() {
    let seconds = "time_s\n0.4\n1.0\n1.54\n2.026\n";
    let expected = bounces(seconds, &Rig::default()).impacts;
    for text in [
        "Time [ms]\n400\n1000\n1540\n2026\n",
        "n;t (s)\n1;0,4\n2;1,0\n3;1,54\n4;2,026\n",
        "# drop 7\nRecorder 3000\nGain,2\n\nnumber,impact time\n,ms\n1,400\n2,1000\n3,1540\n4,2026\n",
        "t\n400 ms\n1 s\n1.54 s\n2026 ms\n",
        "n t_s\n1 0.4\n2 1.0\n3 1.54\n4 2.026\n",
        "time_s\n0.4\n\n1.0\nnan\n1.54\n2.026\n",
    ] {
        let found = bounces(text, &Rig::default()).impacts;
        assert_eq!(found.len(), expected.len(), "{text}");
        for (a, b) in found.iter().zip(&expected) {
            assert!((a.restitution.value - b.restitution.value).abs() < 1e-12, "{text}");
            assert!((a.speed.value - b.speed.value).abs() < 1e-12, "{text}");
        }
    }
    let named = [("time", "when")];
    let text = "when_ms,e\n400,1\n1000,2\n1540,3\n2026,4\n";
    let found = Record::read("a.csv", text.as_bytes(), None, &named, &Rig::default()).unwrap();
    assert_eq!(found.impacts().len(), expected.len());
    let given =
        bounces("time_s,time_uncertainty_ms\n0.4,1\n1,1\n1.54,2\n2.026,1\n", &Rig::default());
    assert_eq!(given.source, TimeUncertaintySource::Given);
    assert_eq!(given.time_uncertainty, 2e-3);
}

/// Each record with parts of its error, separated by `|`.
#[test]
fn records_that_say_nothing_are_errors_that_say_why() {
    let geometric = |n: i32| list((0..n).map(|k| 1.0 - 0.9f64.powi(k)));
    for (text, expected) in [
        ("", "there is no row below the header"),
        ("time_s\n", "there is no row below the header"),
        ("0.4\n1.0\n1.54\n", "record.csv:1: the first row is of numbers"),
        ("time_s\n0.4\n", "one instant is no flight"),
        ("time_s\n0.4\n1.0\n", "two instants are one flight"),
        ("time_s\n0.4\n1.0\n0.9\n", "record.csv:4: the instant 0.9 s does not follow 1 s"),
        ("time_s\n0.4\n0.4\n0.9\n", "record.csv:3"),
        ("time_s\n0.4\nx\n0.9\n", "record.csv:3: time_s is \"x\", which is not a number"),
        ("time_s\n400\n1000\n1540\n", "record.csv:3: a flight of 600.000 s lands at 2942 m/s"),
        ("time_m\n0.4\n1.0\n1.54\n", "unit of another dimension"),
        ("t [frames]\n4\n10\n15\n", "the unit of t_[frames] is not known"),
        ("time_s\n0\n0.1\n0.3\n0.7\n1.5\n", "no two flights in a row"),
        ("speed,e\n1,0.9\n2,0.8\n", "the columns speed, e are those of no record"),
        ("time_s,time_uncertainty_s\n0.4,0\n1,0\n1.5,0\n", "record.csv:2: the uncertainty"),
        ("PK\u{3}\u{4}", "spreadsheet"),
    ] {
        let error = read(text, &Rig::default()).unwrap_err();
        assert!(error.to_string().contains(expected), "{text}: {error}");
    }
    let rig = |rig: Rig| read(&geometric(5), &rig).unwrap_err().to_string();
    let exact = |value: f64| Some(Measured::exact(value));
    assert!(rig(Rig { gravity: exact(0.0), ..Rig::default() }).contains("--gravity is 0.0"));
    assert!(rig(Rig { diameter: exact(0.01), ..Rig::default() }).contains("density"));
    assert!(rig(Rig { rest: exact(0.2), ..Rig::default() }).contains("at rest at 0.2 s"));
    // A long list, noise and a foam ball end in an answer or an error.
    let foam = Rig { diameter: exact(5e-3), density: exact(10.0), ..Rig::default() };
    let _ = read(&geometric(5), &foam);
    let _ = read(&list((0..2_000).map(|k| f64::from(k) * 1e-3)), &foam);
}

/// Returns the height of a ball at a time, m, by its bounces.
fn height(ball: &Ball, bounces: &[(f64, f64)], time: f64) -> f64 {
    match bounces.iter().rev().find(|(start, _)| *start <= time) {
        None => ball.height - 0.5 * Ball::G * time * time,
        Some((start, speed)) => {
            let (s, launch) = (time - start, speed * ball.e(*speed));
            (launch - 0.5 * Ball::G * s) * s
        }
    }
}

fn track(text: &str, rig: &Rig) -> Track {
    let Record::Track(track) = read(text, rig).unwrap() else { panic!("another kind") };
    track
}

/// Returns the true restitution of the bounce nearest to an impact.
fn true_restitution(ball: &Ball, bounces: &[(f64, f64)], impact: &Impact) -> f64 {
    let distance = |bounce: &&(f64, f64)| (bounce.0 - impact.time).abs();
    let near = bounces.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    ball.e(near.unwrap().1)
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
    // The second pulse is no bounce of the first one, which would follow after 2 · 0.8/g = 0.16 s: it is a drop of its own.
    let two = forces(&record(100.0, &pulses), &rig).unwrap();
    assert_eq!(two.impacts.len(), 1, "{:?}", two.warnings);
    // A sensor in the striking body measures less than the contact force, by the mass in front of it.
    let front = Rig { sensor_mass: exact(0.002), ..rig };
    let e = forces(&record(100.0, &pulses[..1]), &front);
    assert!(e.err().is_some_and(|error| error.to_string().contains("no restitution")));
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
        (format!("time_s,y [px]\n{}", whole(100.0)), "the unit of y_[px] is not known"),
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

/// Bursts of 1 to 5 kHz that decay in milliseconds, with noise, hum and a room's echo, at 11 to 44 kHz.
#[test]
fn sounds_give_back_the_restitution_within_its_uncertainty() {
    let mut noise = Noise::seeded(6);
    let mut coverages = [Coverage::default(), Coverage::default(), Coverage::default()];
    for draw in 0..300 {
        let ball = Ball { height: noise.between(0.1, 0.4), ..Ball::random(&mut noise) };
        let true_bounces = ball.bounces(4 + noise.0.usize(0..6));
        let rate = [11_025.0, 22_050.0, 44_100.0][draw % 3];
        let (tone, decay) = (noise.between(1e3, 5e3), noise.between(1e-3, 4e-3));
        let (jitter, echo) = (10f64.powf(noise.between(-4.0, -2.5)), noise.between(0.0, 0.3));
        let n = ((true_bounces[true_bounces.len() - 1].0 + 0.1) * rate) as usize;
        let mut values: Vec<f64> = (0..n)
            .map(|k| {
                jitter * noise.normal()
                    + 0.05 * (2.0 * std::f64::consts::PI * 50.0 * k as f64 / rate).sin()
            })
            .collect();
        for (time, speed) in &true_bounces {
            let phase = noise.between(0.0, 1.0);
            for (delay, size) in [(0.0, 1.0), (9e-3, echo)] {
                let from = ((time + delay) * rate).ceil() as usize;
                for k in from..n.min(from + 600) {
                    let s = k as f64 / rate - time - delay;
                    let wave = (2.0 * std::f64::consts::PI * tone * s + phase).sin();
                    values[k] += 0.2 * size * speed * (-s / decay).exp() * wave;
                }
            }
        }
        let signal = Signal { name: "drop.wav".to_string(), start: 0.0, rate, values };
        let sound = Sound::of(signal, &Rig::default()).unwrap();
        let found = sound.bounces;
        // Quieter bounces are in the noise.
        let n_loud = true_bounces.iter().filter(|bounce| 0.2 * bounce.1 > 20.0 * jitter).count();
        assert!(found.impacts.len() + 3 >= n_loud, "{draw}: {n_loud}, {:?}", found.warnings);
        let e = |impact: &Impact| true_restitution(&ball, &true_bounces, impact);
        coverages[draw % 3].count(&found.impacts, e);
    }
    for coverage in coverages {
        let share = |k: usize| coverage.within[k] as f64 / coverage.n as f64;
        assert!(coverage.n > 400, "{coverage:?}");
        // An onset errs by less than a sample and a quarter of the tone, and not as a normal number: more than two of three are within one
        // standard uncertainty.
        assert!(share(1) >= 0.98 && share(0) <= 0.97, "{coverage:?}");
    }
}

/// Standard errors of a fit to the bounces of one record, over the scatter of its parameter. A fit takes bounces as independent: errors of
/// instants cancel between neighbours, and the bar is twice too wide. Restitutions that scatter themselves do not cancel; `measure`
/// takes their scatter for that of the instants and trusts the first bounces too much, while a fit without
/// uncertainties has the right bar. 24 draws know the ratio to 15 %.
#[test]
fn bars_of_a_fit_to_bounces_of_one_record() {
    const DRAWS: usize = 24;
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(3e9, 0.35).unwrap();
    let ball = Partner::solid_sphere(0.02, &Material::new(1200.0, moduli, None).unwrap());
    let pair = Pair::new(Partner::HalfSpace { plane_strain_modulus: 2.3e11 }, ball).unwrap();
    let (law, end) = (LawFamily::KuwabaraKono, EndRule::ZeroForce);
    let model = Model::new(&pair, [None, None], law, end).unwrap();
    let a = 5e-6;
    let e = |speed: f64| model.outcome(&[a], speed).unwrap().restitution;
    let mut noise = Noise::seeded(11);
    // Errors of the instants, s; scatter of e; whether the fit has the uncertainties of the record.
    let kinds =
        [(1e-4, 0.0, true, 1.6..3.2), (0.0, 3e-3, true, 0.35..0.85), (0.0, 3e-3, false, 0.7..1.4)];
    for (jitter, scatter, is_weighted, expected) in kinds {
        let (mut squares, mut stated) = (0.0, 0.0);
        for _ in 0..DRAWS {
            let (mut time, mut speed) = (0.3, 3.0);
            let bounce = |_| {
                let instant = time + jitter * noise.normal();
                speed *= e(speed) + scatter * noise.normal();
                time += 2.0 * speed / Ball::G;
                instant
            };
            let times: Vec<f64> = (0..11).map(bounce).collect();
            let given = (jitter > 0.0).then_some(jitter);
            let rig = Rig { time_uncertainty: given, ..Rig::default() };
            let point = |impact: &Impact| {
                let Measured { value, uncertainty } = impact.restitution;
                let known = is_weighted.then_some(uncertainty);
                Point { restitution_uncertainty: known, ..Point::new(impact.speed.value, value) }
            };
            let points: Vec<Point> =
                bounces(&list(times), &rig).impacts.iter().map(point).collect();
            let fit = Problem::new(&model, &points, &["a"]).unwrap().fit(0.95).unwrap();
            squares += (fit.values[0] - a).powi(2);
            stated += fit.estimates[0].standard_error.unwrap().powi(2);
        }
        let ratio = (stated / squares).sqrt();
        assert!(expected.contains(&ratio), "{jitter} {scatter} {is_weighted}: {ratio}");
    }
}
