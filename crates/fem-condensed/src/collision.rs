//! A collision from first touch until the bodies have parted.

use fem_material::PronySeries;

use crate::CondensedError;
use crate::motion::Motion;
use crate::pair::CondensedPair;

/// The run goes on for this share of the contact time after the last contact.
const FLIGHT_AFTER: f64 = 0.2;
/// Reach of the points that are followed over the elastic contact radius; a collision that needs
/// more is run again with all points.
const REACH: f64 = 1.3;
/// Largest ω Δt of a mode of vibration: its period is right to (ω Δt)⁴/480 = 1e-4.
const LARGEST_PHASE: f64 = 0.5;
/// Impact of an elastic pair: fewer steps than this do not follow it.
const FEWEST_STEPS: usize = 8;

/// How a collision is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CollideSettings {
    /// Steps over the elastic contact time.
    pub n_steps: usize,
    /// Whether the history is kept.
    pub history: bool,
    /// The run gives up after so many elastic contact times.
    pub give_up_after: f64,
}

impl Default for CollideSettings {
    fn default() -> Self {
        Self { n_steps: 200, history: false, give_up_after: 50.0 }
    }
}

/// One instant; all quantities belong to the same time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Time since first touch, s.
    pub time: f64,
    /// Contact force, ≥ 0, N.
    pub contact_force: f64,
    /// Radius where the contact pressure falls to zero, m.
    pub contact_radius: f64,
    /// Approach of the mass centres, m.
    pub approach: f64,
    /// Contact pressure on the axis, Pa.
    pub centre_pressure: f64,
    /// Rate of the approach, m/s.
    pub approach_rate: f64,
    /// Kinetic energy in the frame of the common mass centre, vibrations included, J.
    pub kinetic: f64,
    /// Strain energy, J.
    pub strain: f64,
    /// Energy in penalty springs, J.
    pub contact: f64,
    /// Energy dissipated by relaxation, J.
    pub viscous_dissipation: f64,
    /// What does not add up, J.
    pub residual: f64,
    /// Kinetic energy of each body's vibrations, J.
    pub vibration: [f64; 2],
}

/// What came out of a collision.
#[derive(Debug, Clone, PartialEq)]
pub struct Collision {
    /// Relative speed after over before.
    pub restitution: f64,
    /// First touch to the end of contact, openings in between included, s.
    pub contact_time: f64,
    /// Number of separate contacts.
    pub contact_episodes: usize,
    /// Largest contact force, N.
    pub peak_force: f64,
    /// Largest approach, m.
    pub max_approach: f64,
    /// Largest contact radius, m.
    pub max_contact_radius: f64,
    /// Largest contact pressure on the axis, Pa.
    pub peak_pressure: f64,
    /// Energy left in the vibrations of each body, J.
    pub vibration_energy: [f64; 2],
    /// Kinetic energy before in the frame of the common mass centre, J.
    pub initial_energy: f64,
    /// Worst imbalance of energy over the initial.
    pub residual_relative: f64,
    /// Every step, if asked for.
    pub history: Vec<Row>,
    /// s.
    pub time_step: f64,
    /// Steps until the run ended.
    pub steps: usize,
    /// Contact problems that were no discs.
    pub n_fallbacks: usize,
}

impl CondensedPair {
    /// The collision at a relative speed (m/s) with the given relaxations of the bodies, lower
    /// first; `None` is elastic.
    ///
    /// # Errors
    /// A speed that is not positive and finite, a contact beyond the condensed region, bodies that
    /// do not part.
    pub fn collide(
        &self,
        speed: f64,
        relaxations: [Option<&PronySeries>; 2],
        settings: &CollideSettings,
    ) -> Result<Collision, CondensedError> {
        if !(speed > 0.0 && speed.is_finite()) {
            return Err(CondensedError::NotApproaching(speed));
        }
        if settings.n_steps < FEWEST_STEPS {
            let (name, value) = ("number of steps", settings.n_steps as f64);
            return Err(CondensedError::Setting { name, value, allowed: "at least 8" });
        }
        let elastic = self.elastic_impact(speed)?;
        let reach = REACH * self.points[elastic.n_closed - 1].radius;
        let n_all = self.points.len();
        let n_near = (self.points.partition_point(|point| point.radius <= reach) + 2).min(n_all);
        let time_step = self.time_step(elastic.contact_time / settings.n_steps as f64);
        let give_up = settings.give_up_after * elastic.contact_time;
        let run = |n_points: usize| {
            let motion = Motion::new(self, speed, relaxations, time_step, n_points)?;
            Run::new(self, motion, speed, settings.history).until_parted(give_up)
        };
        match run(n_near) {
            Err(CondensedError::ContactBeyondCandidates { .. }) if n_near < n_all => run(n_all),
            result => result,
        }
    }

    /// Approach and forces at a time (s) after first touch, to the nearest of the default steps.
    ///
    /// # Errors
    /// As [`CondensedPair::collide`].
    pub fn collide_until(
        &self,
        speed: f64,
        relaxations: [Option<&PronySeries>; 2],
        time: f64,
    ) -> Result<ContactState, CondensedError> {
        let elastic = self.elastic_impact(speed)?;
        let n_steps = CollideSettings::default().n_steps as f64;
        let time_step = self.time_step(elastic.contact_time / n_steps);
        let mut motion = Motion::new(self, speed, relaxations, time_step, self.points.len())?;
        while motion.time() + 0.5 * time_step < time {
            motion.advance()?;
        }
        Ok(ContactState { time: motion.time(), approach: motion.approach, forces: motion.forces })
    }

    /// The step asked for, or what the modes of vibration allow.
    fn time_step(&self, asked: f64) -> f64 {
        let squared = self.sides.iter().flatten().filter_map(|side| {
            side.vibrations.as_ref()?.modes.squared_frequency.iter().copied().reduce(f64::max)
        });
        squared.map(|squared| LARGEST_PHASE / squared.sqrt()).fold(asked, f64::min)
    }
}

/// The contact at an instant.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactState {
    /// Since first touch, s.
    pub time: f64,
    /// m.
    pub approach: f64,
    /// Forces at the points, from the axis outward, N.
    pub forces: Vec<f64>,
}

/// A collision under way.
struct Run<'a> {
    pair: &'a CondensedPair,
    motion: Motion<'a>,
    speed: f64,
    initial_energy: f64,
    last_contact: f64,
    episodes: usize,
    was_closed: bool,
    dissipated: f64,
    last_power: f64,
    worst_residual: f64,
    approach: Peak,
    force: Peak,
    max_radius: f64,
    max_pressure: f64,
    vibration_after: [f64; 2],
    n_after: usize,
    keeps_history: bool,
    history: Vec<Row>,
}

/// Largest value of a smooth function given at even steps: the vertex of the parabola through the
/// highest three.
#[derive(Default)]
struct Peak {
    last: [f64; 2],
    highest: f64,
}

impl Peak {
    fn observe(&mut self, value: f64) {
        let [before, middle] = self.last;
        if middle >= before && middle > value {
            let (slope, bend) = (0.5 * (value - before), value - 2.0 * middle + before);
            self.highest = self.highest.max(middle - 0.5 * slope * slope / bend);
        }
        self.highest = self.highest.max(value);
        self.last = [middle, value];
    }
}

impl<'a> Run<'a> {
    fn new(pair: &'a CondensedPair, motion: Motion<'a>, speed: f64, keeps_history: bool) -> Self {
        Self {
            pair,
            speed,
            initial_energy: 0.5 * pair.reduced_mass * speed * speed,
            last_contact: 0.0,
            episodes: 0,
            was_closed: false,
            dissipated: 0.0,
            last_power: 0.0,
            worst_residual: 0.0,
            approach: Peak::default(),
            force: Peak::default(),
            max_radius: 0.0,
            max_pressure: 0.0,
            vibration_after: [0.0; 2],
            n_after: 0,
            keeps_history,
            history: Vec::new(),
            motion,
        }
    }

    fn until_parted(mut self, give_up: f64) -> Result<Collision, CondensedError> {
        self.record();
        loop {
            let overlap_before =
                if self.motion.step == 0 { 0.0 } else { self.motion.axis_overlap() };
            self.motion.advance()?;
            let time = self.motion.time();
            if !(self.motion.force.is_finite() && self.motion.rate.is_finite()) {
                return Err(CondensedError::NoContactState { time });
            }
            let is_closed = self.motion.contact.n_closed > 0;
            if self.was_closed && !is_closed {
                // The overlap on the axis passes through zero between the steps.
                let now = self.motion.axis_overlap();
                let part = (overlap_before / (overlap_before - now)).clamp(0.0, 1.0);
                self.last_contact = time - (1.0 - part) * self.motion.time_step;
            }
            self.episodes += usize::from(is_closed && !self.was_closed);
            self.was_closed = is_closed;
            self.record();
            let flight = time - self.last_contact;
            if !is_closed && self.motion.rate < 0.0 && flight >= FLIGHT_AFTER * self.last_contact {
                return Ok(self.finish());
            }
            if time > give_up {
                return Err(CondensedError::NoSeparation { time, steps: self.motion.step });
            }
        }
    }

    fn record(&mut self) {
        let motion = &self.motion;
        self.approach.observe(motion.approach);
        self.force.observe(motion.force);
        let energies = motion.energies();
        if motion.step > 0 {
            self.dissipated += 0.5 * motion.time_step * (self.last_power + energies.power);
        }
        self.last_power = energies.power;
        let [lower, upper] = energies.vibration;
        let kinetic = 0.5 * self.pair.reduced_mass * motion.rate * motion.rate + lower + upper;
        let total = kinetic + energies.stored + energies.contact + self.dissipated;
        let residual = total - self.initial_energy;
        let relative = residual.abs() / self.initial_energy;
        if relative > self.worst_residual || relative.is_nan() {
            self.worst_residual = relative;
        }
        let (contact_radius, pressure) =
            self.pair.radius_and_pressure(&motion.contact, &motion.forces);
        self.max_radius = self.max_radius.max(contact_radius);
        self.max_pressure = self.max_pressure.max(pressure);
        if self.episodes > 0 && !self.was_closed {
            self.n_after += 1;
            for (sum, energy) in self.vibration_after.iter_mut().zip(energies.vibration) {
                *sum += energy;
            }
        }
        if self.keeps_history {
            self.history.push(Row {
                time: motion.time(),
                contact_force: motion.force,
                contact_radius,
                approach: motion.approach,
                centre_pressure: pressure,
                approach_rate: motion.rate,
                kinetic,
                strain: energies.stored,
                contact: energies.contact,
                viscous_dissipation: self.dissipated,
                residual,
                vibration: energies.vibration,
            });
        }
    }

    fn finish(self) -> Collision {
        let motion = &self.motion;
        Collision {
            restitution: -motion.rate / self.speed,
            contact_time: self.last_contact,
            contact_episodes: self.episodes,
            peak_force: self.force.highest,
            max_approach: self.approach.highest,
            max_contact_radius: self.max_radius,
            peak_pressure: self.max_pressure,
            // Half of a vibration's energy is kinetic, on the mean.
            vibration_energy: self
                .vibration_after
                .map(|sum| 2.0 * sum / self.n_after.max(1) as f64),
            initial_energy: self.initial_energy,
            residual_relative: self.worst_residual,
            time_step: motion.time_step,
            steps: motion.step,
            n_fallbacks: motion.n_fallbacks(),
            history: self.history,
        }
    }
}
