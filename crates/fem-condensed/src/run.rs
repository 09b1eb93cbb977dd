//! The course of a collision: what is observed of each step, and when it ends.

use crate::CondensedError;
use crate::collision::{CollideSettings, Collision, Ending, Glance, Row};
use crate::history::History;
use crate::instants::Trace;
use crate::motion::Motion;
use crate::pair::CondensedPair;

/// The run goes on for this share of the contact time after the last contact.
const FLIGHT_AFTER: f64 = 0.2;

/// Mechanical energy over the initial below which bodies in contact stay together: it could part
/// them with a restitution of 1e-4.
const NOTHING_LEFT: f64 = 1e-8;
/// Energy that does not add up over the initial: the run is no longer one.
const LARGEST_IMBALANCE: f64 = 0.1;
const STEPS_BETWEEN_GLANCES: usize = 64;

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
    give_up: f64,
    expected_end: f64,
    history: Option<History>,
    trace: Vec<Trace>,
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
        settings: &CollideSettings,
        elastic_contact_time: f64,
    ) -> Self {
        Self {
            give_up: settings.give_up_after * elastic_contact_time,
            expected_end: (1.0 + FLIGHT_AFTER) * elastic_contact_time,
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
            history: settings.history.then(|| History::new(settings.n_steps)),
            trace: Vec::with_capacity(2 * settings.n_steps),
            motion,
        }
    }

    /// Steps until the bodies have parted, or something stops them.
    pub fn until_parted(mut self, watch: &mut dyn FnMut(Glance) -> bool) -> Collision {
        self.record();
        let ending = loop {
            match self.advance(watch) {
                Ok(None) => {}
                Ok(Some(ending)) => break ending,
                Err(error) => break Ending::Stopped(error),
            }
        };
        self.finish(ending)
    }

    /// One step; how it ended, if it did.
    fn advance(
        &mut self,
        watch: &mut dyn FnMut(Glance) -> bool,
    ) -> Result<Option<Ending>, CondensedError> {
        let overlap_before = if self.motion.step == 0 { 0.0 } else { self.motion.axis_overlap() };
        self.motion.advance()?;
        let (time, steps) = (self.motion.time(), self.motion.step);
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
        let mechanical = self.record();
        let flight = time - self.last_contact;
        if !is_closed && self.motion.rate < 0.0 && flight >= FLIGHT_AFTER * self.last_contact {
            return Ok(Some(Ending::Parted));
        }
        if is_closed && mechanical < NOTHING_LEFT * self.initial_energy {
            return Ok(Some(Ending::Together));
        }
        // An imbalance that is no number is above every limit.
        let is_sound = self.worst_residual <= LARGEST_IMBALANCE;
        if !is_sound {
            return Err(CondensedError::EnergyImbalance { time, relative: self.worst_residual });
        }
        if time > self.give_up {
            return Err(CondensedError::NoSeparation { time, steps });
        }
        if steps.is_multiple_of(STEPS_BETWEEN_GLANCES) {
            let fraction = (time / self.expected_end).min(1.0);
            let glance = Glance { time, step: steps, fraction, contact_force: self.motion.force };
            if !watch(glance) {
                return Err(CondensedError::Interrupted { time, steps });
            }
        }
        Ok(None)
    }

    /// Observes a step; its mechanical energy, J.
    fn record(&mut self) -> f64 {
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
        let mechanical = kinetic + energies.stored + energies.contact;
        let residual = mechanical + self.dissipated - self.initial_energy;
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
        self.trace.push(Trace { approach: motion.approach, is_closed: self.was_closed });
        if let Some(history) = &mut self.history {
            history.push(
                motion.step,
                self.was_closed,
                Row {
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
                },
            );
        }
        mechanical
    }

    fn finish(self, ending: Ending) -> Collision {
        let motion = &self.motion;
        let (restitution, contact_time) = match ending {
            Ending::Together => (0.0, motion.time()),
            _ => (-motion.rate / self.speed, self.last_contact),
        };
        Collision {
            ending,
            restitution,
            contact_time,
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
            history: self.history.map(History::finish).unwrap_or_default(),
            trace: self.trace,
        }
    }
}
