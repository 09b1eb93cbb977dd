//! The course of a collision: what is observed of each step, and when it ends.

use crate::CondensedError;
use crate::collision::{Collision, Row};
use crate::motion::Motion;
use crate::pair::CondensedPair;

/// The run goes on for this share of the contact time after the last contact.
const FLIGHT_AFTER: f64 = 0.2;

/// A collision under way.
pub(crate) struct Run<'a> {
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
    pub fn new(
        pair: &'a CondensedPair,
        motion: Motion<'a>,
        speed: f64,
        keeps_history: bool,
    ) -> Self {
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

    /// Steps until the bodies have parted, or the time (s) is up.
    ///
    /// # Errors
    /// No contact state, a contact that reaches the last point, bodies that do not part.
    pub fn until_parted(mut self, give_up: f64) -> Result<Collision, CondensedError> {
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
