//! The course of a collision: what is observed of each step, and when it ends.

use fem_collision::{
    Account, Book, Collision, Ending, Frame, History, Losses, Monitor, Progress, Row,
    STAY_TOGETHER, Stop, Want,
};

use crate::instants::Trace;
use crate::motion::{Energies, Motion};
use crate::pair::CondensedPair;
use crate::peak::Peak;

/// The run goes on for this share of the contact time after the last contact.
const FLIGHT_AFTER: f64 = 0.2;

/// Mechanical energy over the initial below which bodies in contact stay together: it could part
/// them with a restitution of 1e-4.
const NOTHING_LEFT: f64 = 1e-8;
/// Energy that does not add up over the initial: the run is no longer one.
const LARGEST_IMBALANCE: f64 = 0.1;
const STEPS_BETWEEN_REPORTS: u64 = 64;

/// A collision under way.
pub(crate) struct Run<'a> {
    pair: &'a CondensedPair,
    frame: &'a Frame,
    motion: Motion<'a>,
    initial_energy: f64,
    /// Since first touch, s.
    last_contact: f64,
    episodes: u64,
    was_closed: bool,
    losses: Losses,
    worst_residual: f64,
    worst_drift: f64,
    approach: Peak,
    force: Peak,
    max_radius: f64,
    max_pressure: f64,
    vibration_after: [f64; 2],
    n_after: usize,
    /// Since first touch, s.
    give_up: f64,
    expected_end: f64,
    history: Option<History>,
    /// The step before, and the end of contact after it with the steps around.
    last: Option<Sample>,
    opening: Option<[Sample; 3]>,
    trace: Vec<Trace>,
}

/// What came out of a run.
pub(crate) struct Finished {
    pub collision: Collision,
    /// Every step.
    pub trace: Vec<Trace>,
}

/// One instant of the relative motion.
#[derive(Debug, Clone, Copy)]
struct Sample {
    /// Since first touch, s.
    time: f64,
    contact_force: f64,
    contact_radius: f64,
    approach: f64,
    centre_pressure: f64,
    rate: f64,
    strain: f64,
    contact: f64,
    dissipated: f64,
    residual: f64,
    vibration: [f64; 2],
}

impl Sample {
    /// The end of the contact between two steps, where the force is zero; the rest linearly.
    fn between(before: &Self, after: &Self, time: f64) -> Self {
        let part = (time - before.time) / (after.time - before.time);
        let mean = |get: fn(&Self) -> f64| (1.0 - part) * get(before) + part * get(after);
        Self {
            time,
            contact_force: 0.0,
            contact_radius: 0.0,
            centre_pressure: 0.0,
            approach: mean(|sample| sample.approach),
            rate: mean(|sample| sample.rate),
            strain: mean(|sample| sample.strain),
            contact: mean(|sample| sample.contact),
            dissipated: mean(|sample| sample.dissipated),
            residual: mean(|sample| sample.residual),
            vibration: [0, 1]
                .map(|side| (1.0 - part) * before.vibration[side] + part * after.vibration[side]),
        }
    }

    /// The same of both bodies.
    fn row(&self, frame: &Frame) -> Row {
        let [lower, upper] = self.vibration;
        Row {
            time: frame.approach.first_touch() + self.time,
            contact_force: self.contact_force,
            contact_radius: Some(self.contact_radius),
            approach: self.approach,
            centre_pressure: Some(self.centre_pressure),
            velocity: frame.velocities(self.rate),
            energies: Book::EMPTY
                .with(Account::Kinetic, frame.kinetic(self.rate) + lower + upper)
                .with(Account::Strain, self.strain)
                .with(Account::Contact, self.contact)
                .with(Account::ViscousDissipation, self.dissipated)
                .with(Account::WallWork, frame.wall_work(self.rate)),
            residual: Some(self.residual),
            vibration: self.vibration,
        }
    }
}

impl<'a> Run<'a> {
    pub fn new(
        pair: &'a CondensedPair,
        motion: Motion<'a>,
        frame: &'a Frame,
        want: &Want,
        n_steps: usize,
        elastic_contact_time: f64,
    ) -> Self {
        let speed = frame.speed();
        Self {
            give_up: want.give_up_after * elastic_contact_time,
            expected_end: (1.0 + FLIGHT_AFTER) * elastic_contact_time,
            initial_energy: 0.5 * pair.reduced_mass * speed * speed,
            pair,
            frame,
            last_contact: 0.0,
            episodes: 0,
            was_closed: false,
            losses: Losses::default(),
            worst_residual: 0.0,
            worst_drift: 0.0,
            approach: Peak::default(),
            force: Peak::default(),
            max_radius: 0.0,
            max_pressure: 0.0,
            vibration_after: [0.0; 2],
            n_after: 0,
            history: (want.history_rows > 0)
                .then(|| History::new(want.history_rows, n_steps as f64)),
            last: None,
            opening: None,
            trace: Vec::with_capacity(2 * n_steps),
            motion,
        }
    }

    /// Steps until the bodies have parted, or something stops them.
    pub fn until_parted(mut self, monitor: &mut dyn Monitor) -> Finished {
        self.record();
        let ending = loop {
            match self.advance(monitor) {
                Ok(None) => {}
                Ok(Some(ending)) => break ending,
                Err(stop) => break Ending::Stopped(stop),
            }
        };
        self.finish(ending)
    }

    /// Time of the present step since the start of the case, s.
    fn time_of_case(&self) -> f64 {
        self.frame.approach.first_touch() + self.motion.time()
    }

    /// One step; how it ended, if it did.
    fn advance(&mut self, monitor: &mut dyn Monitor) -> Result<Option<Ending>, Stop> {
        let overlap_before = if self.motion.step == 0 { 0.0 } else { self.motion.axis_overlap() };
        let first_touch = self.frame.approach.first_touch();
        self.motion.advance().map_err(|stop| stop.later_by(first_touch))?;
        let (time, step) = (self.motion.time(), self.motion.step as u64);
        if !(self.motion.force.is_finite() && self.motion.rate.is_finite()) {
            return Err(Stop::NoContactState { time: self.time_of_case() });
        }
        let is_closed = self.motion.contact.n_closed > 0;
        let opens = self.was_closed && !is_closed;
        if opens {
            // The overlap on the axis passes through zero between the steps.
            let now = self.motion.axis_overlap();
            let part = (overlap_before / (overlap_before - now)).clamp(0.0, 1.0);
            self.last_contact = time - (1.0 - part) * self.motion.time_step;
        }
        self.episodes += u64::from(is_closed && !self.was_closed);
        self.was_closed = is_closed;
        let before = self.last;
        let mechanical = self.record();
        if let (true, Some(before), Some(after)) = (opens, before, self.last) {
            let end = Sample::between(&before, &after, self.last_contact);
            self.opening = Some([before, end, after]);
        }
        let flight = time - self.last_contact;
        if !is_closed && self.motion.rate < 0.0 && flight >= FLIGHT_AFTER * self.last_contact {
            return Ok(Some(Ending::Parted));
        }
        if is_closed && mechanical < NOTHING_LEFT * self.initial_energy {
            return Ok(Some(Ending::Together));
        }
        // An imbalance that is no number is above every limit.
        let is_sound = self.worst_residual <= LARGEST_IMBALANCE;
        let time_of_case = self.time_of_case();
        if !is_sound {
            let relative = self.worst_residual;
            return Err(Stop::EnergyImbalance { time: time_of_case, relative });
        }
        if time > self.give_up {
            return Err(Stop::NoSeparation { time: time_of_case, step });
        }
        if step.is_multiple_of(STEPS_BETWEEN_REPORTS) {
            let progress = Progress {
                time: time_of_case,
                step,
                fraction: (time / self.expected_end).min(1.0),
                contact_force: self.motion.force,
            };
            if !monitor.report(progress) {
                return Err(Stop::Interrupted { time: time_of_case, step });
            }
        }
        Ok(None)
    }

    /// Observes a step; its mechanical energy, J.
    fn record(&mut self) -> f64 {
        let motion = &self.motion;
        self.approach.observe(motion.approach);
        self.force.observe(motion.force);
        let Energies { stored, contact, power, vibration } = motion.energies();
        self.losses.advance(motion.time_step, Book::EMPTY.with(Account::ViscousDissipation, power));
        let dissipated =
            self.losses.energies().get(Account::ViscousDissipation).unwrap_or_default();
        let [lower, upper] = vibration;
        let kinetic = 0.5 * self.pair.reduced_mass * motion.rate * motion.rate + lower + upper;
        let mechanical = kinetic + stored + contact;
        let residual = mechanical + dissipated - self.initial_energy;
        let relative = residual.abs() / self.initial_energy;
        if relative > self.worst_residual || relative.is_nan() {
            self.worst_residual = relative;
        }
        let (contact_radius, centre_pressure) =
            self.pair.radius_and_pressure(&motion.contact, &motion.forces);
        self.max_radius = self.max_radius.max(contact_radius);
        self.max_pressure = self.max_pressure.max(centre_pressure);
        if self.episodes > 0 && !self.was_closed {
            self.n_after += 1;
            for (sum, energy) in self.vibration_after.iter_mut().zip(vibration) {
                *sum += energy;
            }
        }
        self.trace.push(Trace { approach: motion.approach, is_closed: self.was_closed });
        if let Some(history) = &mut self.history {
            let sample = Sample {
                time: motion.time(),
                contact_force: motion.force,
                contact_radius,
                approach: motion.approach,
                centre_pressure,
                rate: motion.rate,
                strain: stored,
                contact,
                dissipated,
                residual,
                vibration,
            };
            history.follow(motion.step as u64, self.was_closed, sample.row(self.frame));
            self.last = Some(sample);
        }
        self.worst_drift = self.worst_drift.max(self.frame.momentum_drift(motion.rate));
        mechanical
    }

    fn finish(self, ending: Ending) -> Finished {
        let (motion, frame) = (&self.motion, self.frame);
        let (is_parted, is_stopped) =
            (ending == Ending::Parted, matches!(ending, Ending::Stopped(_)));
        let restitution = match ending {
            Ending::Parted => Some(-motion.rate / frame.speed()),
            Ending::Together => Some(0.0),
            Ending::Stopped(_) => None,
        };
        let velocity_after = restitution.map(|e| frame.velocities(-e * frame.speed()));
        let mut bodies = self.pair.bodies_before(frame);
        for (side, body) in bodies.iter_mut().enumerate() {
            body.velocity_after = velocity_after.map(|both| both[side]);
            // Half of a vibration's energy is kinetic, on the mean.
            let mean = 2.0 * self.vibration_after[side] / self.n_after.max(1) as f64;
            let is_sphere = self.pair.inputs()[side].mesh().is_some();
            body.vibration_energy = (is_sphere && is_parted).then_some(mean);
        }
        let first_touch = frame.approach.first_touch();
        let has_touched = self.episodes > 0;
        let mut history = self.history.map(History::into_rows).unwrap_or_default();
        if let Some([before, end, after]) = self.opening.filter(|_| is_parted)
            && before.time < end.time
            && end.time < after.time
        {
            let place = history.partition_point(|row| row.time < first_touch + end.time);
            history.insert(place, end.row(frame));
        }
        let end = history.last();
        let collision = Collision {
            approach: frame.approach,
            restitution,
            contact_time: is_parted.then_some(self.last_contact),
            first_contact: has_touched.then_some(first_touch),
            last_contact: has_touched.then_some(first_touch + self.last_contact),
            contact_episodes: self.episodes,
            peak_force: Some(self.force.highest),
            max_approach: Some(self.approach.highest),
            max_contact_radius: Some(self.max_radius),
            peak_pressure: Some(self.max_pressure),
            force_scatter: None,
            searched: Some(self.pair.searched()),
            initial_energy: Some(frame.kinetic(frame.speed())),
            energies: end.map_or(Book::EMPTY, |row| row.energies),
            residual: end.and_then(|row| row.residual),
            residual_relative: Some(self.worst_residual),
            momentum_residual_relative: Some(self.worst_drift),
            bodies,
            time_step: Some(motion.time_step),
            steps: Some(motion.step as u64),
            element_updates: None,
            factor_bytes: Some(self.pair.factor_bytes() as u64),
            repeated_contact_solutions: Some(motion.n_fallbacks() as u64),
            history,
            snapshots: Vec::new(),
            warnings: if is_stopped || is_parted { Vec::new() } else { vec![STAY_TOGETHER.into()] },
            ending,
        };
        Finished { collision, trace: self.trace }
    }
}
