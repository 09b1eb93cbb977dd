//! The flight of a ball between two bounces, in vacuum or in air.
//!
//! A ball that leaves the floor with the speed u rises against gravity and drag, falls from the height h, and lands with w:
//!
//! ```math
//! T = \int_0^u \frac{dv}{g + a(v)} + \int_0^w \frac{dv}{g - a(v)}, \qquad
//! h = \int_0^u \frac{v\,dv}{g + a(v)} = \int_0^w \frac{v\,dv}{g - a(v)}
//! ```
//!
//! In vacuum a = 0 and u = w = gT/2. In air, drag, buoyancy and added mass act on a sphere of diameter D and density ρ,
//! with β = ρ_air/ρ: g falls by the factor (1 − β)/(1 + β/2), and
//!
//! ```math
//! a(v) = \frac{3}{4} \frac{\beta}{1 + \beta/2} \frac{C_D v^2}{D}, \qquad
//! C_D = \frac{24}{Re} (1 + 0.15 Re^{0.687}) + \frac{0.42}{1 + 42500 Re^{-1.16}}
//! ```
//!
//! Drag coefficient of a smooth sphere: Clift & Gauvin, *Proc. Chemeca 70* (1970) 14–28, for Re < 3·10⁵. The wind, the spin
//! and the unsteadiness of the wake are neglected.

/// A gas through which a ball flies.
pub(super) struct Gas {
    /// Density of the air, kg/m³.
    pub density: f64,
    /// Viscosity of the air, Pa·s.
    pub viscosity: f64,
}

/// Dry air at 20 °C and 101 325 Pa.
pub(super) const AIR: Gas = Gas { density: 1.204, viscosity: 1.81e-5 };
/// Intervals of the integrals over the speed (Simpson's rule).
const INTERVALS: usize = 48;
/// Step of [`Departure`], s: the midpoint rule is accurate to 1e-7 of the height.
const STEP: f64 = 5e-4;
/// Largest landing speed over the terminal speed; beyond it the time of flight says little of the landing speed.
const NEAR_TERMINAL: f64 = 0.98;

/// The forces on a ball in flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeFlight {
    /// Acceleration of free fall, without drag, m/s².
    gravity: f64,
    air: Option<Air>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Air {
    /// Deceleration over C_D v², 1/m.
    drag: f64,
    /// Reynolds number over speed, s/m.
    reynolds: f64,
}

/// The departure of flights in air from parabolas with the same apex, over the time from the apex.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Departure {
    /// Height (m) and upward velocity (m/s) at multiples of [`STEP`] before and after the apex.
    sides: [Vec<[f64; 2]>; 2],
}

impl Departure {
    /// Returns height (m) and upward velocity (m/s) at a time from the apex, s, by linear interpolation.
    pub fn at(&self, time: f64) -> [f64; 2] {
        let side = &self.sides[usize::from(time > 0.0)];
        let place = (time.abs() / STEP).min((side.len() - 2) as f64);
        let k = place as usize;
        let share = time.abs() / STEP - k as f64;
        std::array::from_fn(|i| side[k][i] + share * (side[k + 1][i] - side[k][i]))
    }
}

/// One flight from the floor to the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight {
    /// Speed after the first bounce, m/s.
    pub launch: f64,
    /// Speed before the second bounce, m/s.
    pub landing: f64,
    /// Derivative of the launch speed by the time of flight, m/s².
    pub launch_slope: f64,
    /// Derivative of the landing speed by the time of flight, m/s².
    pub landing_slope: f64,
}

impl FreeFlight {
    /// Creates flights in vacuum; gravity in m/s².
    pub fn in_vacuum(gravity: f64) -> Self {
        Self { gravity, air: None }
    }

    /// Creates flights of a sphere in air by its diameter (m) and density (kg/m³). `drag_factor` multiplies the drag
    /// coefficient.
    pub fn in_air(gravity: f64, diameter: f64, density: f64, drag_factor: f64) -> Self {
        let ratio = AIR.density / density;
        let inertia = 1.0 + 0.5 * ratio;
        let drag = 0.75 * drag_factor * ratio / (inertia * diameter);
        let reynolds = AIR.density * diameter / AIR.viscosity;
        Self { gravity: gravity * (1.0 - ratio) / inertia, air: Some(Air { drag, reynolds }) }
    }

    /// Returns the acceleration of free fall with buoyancy and added mass, m/s².
    pub(super) fn gravity(&self) -> f64 {
        self.gravity
    }

    /// Returns the departure from parabolas up to a time from the apex, s; `None` in vacuum.
    pub(super) fn departure(&self, longest: f64) -> Option<Departure> {
        self.air?;
        let n = (longest / STEP).ceil() as usize + 2;
        // A rise is followed back from its apex, where drag adds to gravity.
        let side = |sign: f64| {
            let acceleration = |speed: f64| self.gravity - sign * self.deceleration(speed);
            let (mut speed, mut path) = (0.0, 0.0);
            let row = |k: usize| {
                let time = k as f64 * STEP;
                let vacuum = [0.5 * self.gravity * time * time, self.gravity * time];
                let own = [vacuum[0] - path, sign * (vacuum[1] - speed)];
                let middle = speed + 0.5 * STEP * acceleration(speed);
                path += STEP * middle;
                speed += STEP * acceleration(middle);
                own
            };
            (0..n).map(row).collect()
        };
        Some(Departure { sides: [side(-1.0), side(1.0)] })
    }

    /// Returns the deceleration by drag at a speed (m/s), m/s².
    fn deceleration(&self, speed: f64) -> f64 {
        let Some(Air { drag, reynolds }) = self.air else { return 0.0 };
        if speed <= 0.0 {
            return 0.0;
        }
        let re = reynolds * speed;
        let viscous = 24.0 / re * (1.0 + 0.15 * re.powf(0.687));
        drag * (viscous + 0.42 / (1.0 + 42_500.0 * re.powf(-1.16))) * speed * speed
    }

    /// Returns time and height of a rise that begins, or of a fall that ends, with `speed`.
    fn time_and_height(&self, speed: f64, sign: f64) -> [f64; 2] {
        let step = speed / INTERVALS as f64;
        let mut sums = [0.0; 2];
        for k in 0..=INTERVALS {
            let v = k as f64 * step;
            let weight = match k {
                0 | INTERVALS => 1.0,
                k if k % 2 == 1 => 4.0,
                _ => 2.0,
            };
            let share = weight * step / 3.0 / (self.gravity + sign * self.deceleration(v));
            sums = [sums[0] + share, sums[1] + share * v];
        }
        sums
    }

    /// Returns the speed after a fall from rest through a height (m); `None` if it is nearly the terminal speed.
    pub fn landing_after(&self, height: f64) -> Option<f64> {
        let ballistic = (2.0 * self.gravity * height).sqrt();
        if self.air.is_none() {
            return Some(ballistic);
        }
        let mut high = ballistic;
        if let Some(terminal) = self.terminal_speed_below(ballistic) {
            high = high.min(NEAR_TERMINAL * terminal);
            if self.time_and_height(high, -1.0)[1] < height {
                return None;
            }
        }
        let (mut low, mut speed) = (0.0, high);
        for _ in 0..60 {
            let excess = self.time_and_height(speed, -1.0)[1] - height;
            if excess > 0.0 {
                high = speed
            } else {
                low = speed
            }
            let slope = speed / (self.gravity - self.deceleration(speed));
            let newton = speed - excess / slope;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - speed).abs() <= 1e-13 * speed {
                return Some(next);
            }
            speed = next;
        }
        Some(speed)
    }

    /// Returns the speed at which drag balances gravity, if it is below `limit`.
    fn terminal_speed_below(&self, limit: f64) -> Option<f64> {
        let (mut low, mut high) = (0.0, limit);
        if self.deceleration(high) < self.gravity {
            return None;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.deceleration(middle) < self.gravity { low = middle } else { high = middle }
        }
        Some(low)
    }

    /// Returns the flight that lasts `time` (s); `None` if the ball lands at nearly its terminal speed.
    pub fn lasting(&self, time: f64) -> Option<Flight> {
        let ballistic = 0.5 * self.gravity * time;
        if self.air.is_none() {
            let slope = 0.5 * self.gravity;
            let (launch, landing) = (ballistic, ballistic);
            return Some(Flight { launch, landing, launch_slope: slope, landing_slope: slope });
        }
        let mut launch = ballistic;
        for _ in 0..50 {
            let [rise, height] = self.time_and_height(launch, 1.0);
            let landing = self.landing_after(height)?;
            let fall = self.time_and_height(landing, -1.0)[0];
            let up = self.gravity + self.deceleration(launch);
            let launch_slope = up / (1.0 + launch / landing);
            let change = (time - rise - fall) * launch_slope;
            if !change.is_finite() {
                return None;
            }
            if change.abs() <= 1e-12 * launch {
                let down = self.gravity - self.deceleration(landing);
                let landing_slope = launch_slope * launch * down / (landing * up);
                return Some(Flight { launch, landing, launch_slope, landing_slope });
            }
            launch = (launch + change).clamp(0.1 * launch, 10.0 * launch);
        }
        None
    }
}
