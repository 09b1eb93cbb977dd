//! The parabola of one flight by least squares, in moments of its frames.

use super::frames::Frames;

/// A flight in a track.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackFlight {
    /// Indices of its frames.
    pub frames: Vec<usize>,
    /// Weighted mean of the times, s.
    pub(super) centre: f64,
    /// Weighted means of y, τ², τ³ and of τ·y over that of τ², with τ = t − centre.
    pub(super) moments: Moments,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Moments {
    pub weight: f64,
    pub height: f64,
    pub slope: f64,
    pub square: f64,
    pub cube: f64,
}

/// A parabola: height and velocity at a time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parabola {
    pub height: f64,
    pub velocity: f64,
    pub centre: f64,
    pub gravity: f64,
}

impl Parabola {
    pub fn at(&self, time: f64) -> f64 {
        let tau = time - self.centre;
        self.height + (self.velocity - 0.5 * self.gravity * tau) * tau
    }

    /// Returns the time at which the velocity is 0, s.
    pub fn apex(&self) -> f64 {
        self.centre + self.velocity / self.gravity
    }

    pub fn velocity_at(&self, time: f64) -> f64 {
        self.velocity - self.gravity * (time - self.centre)
    }
}

impl TrackFlight {
    pub(super) fn of(all: &Frames, frames: Vec<usize>) -> Self {
        let weight: f64 = frames.iter().map(|k| all.weights[*k]).sum();
        let mean = |value: &dyn Fn(usize) -> f64| {
            frames.iter().map(|k| all.weights[*k] * value(*k)).sum::<f64>() / weight
        };
        let centre = mean(&|k| all.times[k]);
        let tau = |k: usize| all.times[k] - centre;
        let height = mean(&|k| all.heights[k]);
        let square = mean(&|k| tau(k).powi(2));
        let cube = mean(&|k| tau(k).powi(3));
        let slope = mean(&|k| tau(k) * (all.heights[k] - height)) / square;
        Self { frames, centre, moments: Moments { weight, height, slope, square, cube } }
    }

    /// Returns the parabola of least squares with this gravity.
    pub(super) fn parabola(&self, gravity: f64) -> Parabola {
        let Moments { height, slope, square, cube, .. } = self.moments;
        Parabola {
            height: height + 0.5 * gravity * square,
            velocity: slope + 0.5 * gravity * cube / square,
            centre: self.centre,
            gravity,
        }
    }

    /// Returns the mean deviation of other frames from the parabola of least squares, m, and its uncertainty over the noise of a frame.
    pub(super) fn misses(&self, all: &Frames, others: &[usize]) -> (f64, f64) {
        let Moments { weight, square, cube, .. } = self.moments;
        let (along, across) = self.curvature(all);
        let parabola = self.parabola(if across > 0.0 { along / across } else { 0.0 });
        let n = others.len() as f64;
        let mean = |value: &dyn Fn(usize) -> f64| others.iter().map(|k| value(*k)).sum::<f64>() / n;
        let tau = |k: usize| all.times[k] - self.centre;
        let bent = mean(&|k| -0.5 * (tau(k).powi(2) - square - cube / square * tau(k)));
        let variance =
            1.0 / n + (1.0 + mean(&tau).powi(2) / square) / weight + bent * bent / across;
        (mean(&|k| all.heights[k] - parabola.at(all.times[k])), variance.sqrt())
    }

    /// Returns the products of −τ²/2, less its regression on 1 and τ, with the heights and with itself.
    pub(super) fn curvature(&self, all: &Frames) -> (f64, f64) {
        let Moments { height, slope, square, cube, .. } = self.moments;
        let products = self.frames.iter().map(|k| {
            let tau = all.times[*k] - self.centre;
            let q = -0.5 * (tau * tau - square - cube / square * tau);
            let weight = all.weights[*k];
            (weight * q * (all.heights[*k] - height - slope * tau), weight * q * q)
        });
        products.fold((0.0, 0.0), |sum, one| (sum.0 + one.0, sum.1 + one.1))
    }
}

impl Frames {
    /// Returns the root of the mean squared deviation of frames from a parabola of their own, m.
    pub(super) fn own_misfit(&self, frames: &[usize]) -> f64 {
        let flight = TrackFlight::of(self, frames.to_vec());
        let (along, across) = flight.curvature(self);
        let gravity = if across > 0.0 { along / across } else { 0.0 };
        let parabola = flight.parabola(gravity);
        let squares = frames
            .iter()
            .map(|k| self.weights[*k] * (self.heights[*k] - parabola.at(self.times[*k])).powi(2));
        (squares.sum::<f64>() / (frames.len() - 3).max(1) as f64).sqrt()
    }
}
