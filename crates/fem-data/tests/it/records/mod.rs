//! Records of a bouncing ball, made by its equations of motion with noise, give back the restitution within their
//! uncertainty; records that say nothing are errors that say why.

use fem_data::estimate::{Model, Point, Problem};
use fem_data::instruments::cradle::Measured;
use fem_data::instruments::{
    BounceTimes, ForceRecord, FreeFlight, Impact, Record, Rig, Signal, Sound,
    TimeUncertaintySource, Track,
};
use fem_data::table::{DataError, Table};
use fem_laws::{EndRule, LawFamily, Pair, Partner};
use fem_material::{ElasticModuli, Material};

mod bounces;
mod forces;
mod sounds;
mod tracks;

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

/// Returns the true restitution of the bounce nearest to an impact.
fn true_restitution(ball: &Ball, bounces: &[(f64, f64)], impact: &Impact) -> f64 {
    let distance = |bounce: &&(f64, f64)| (bounce.0 - impact.time).abs();
    let near = bounces.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    ball.e(near.unwrap().1)
}
