//! The run of a collision: samples of each step, and the criteria that end it.

pub(crate) mod between_steps;
pub(crate) mod instants;
pub(crate) mod sample;

use fem_collision::{
    BodyResult, Collision, DeepestOverlap, Ending, EnergyLedger, ForceNoise, ForcePulse, Frame,
    History, HistoryRow, MAX_RESIDUAL, Monitor, OutputRequest, POST_CONTACT_FRACTION,
    PostContactVibration, PressureRecord, Progress, RelativeMotion, RestCriterion,
    STEPS_BETWEEN_REPORTS, StepInstant, Stop, longest_at_pole, nan_aware_max, nan_aware_max_abs,
};
use fem_laws::SINKING_LAMBDA;

use crate::contact::pressure::Pressures;
use crate::motion::{ImpactMotion, MotionEnergies};
use crate::pair::CondensedPair;
use crate::run::between_steps::InterpolatedPeak;
use crate::run::instants::RunTrace;
use crate::run::sample::MotionSample;

/// Relative energy residual above which a run is stopped.
const MAX_IMBALANCE: f64 = 0.1;
/// Rate of approach over the initial one below which bodies creep. Creeping bodies get more time to separate.
const CREEPING_RATE: f64 = 0.1;
/// Largest time that creeping bodies may take to separate, over the time of compression.
const SLOWEST_PARTING: f64 = 2.0;

/// Smallest number of samples of force, radius and pressure in a contact; the window of their peaks
/// is a 64th of it.
const MIN_SAMPLES: usize = 1000;
/// Largest number of samples per step.
const MAX_WITHIN_STEP: f64 = 8.0;

/// Largest number of steps for which memory is reserved at the beginning.
const MAX_RESERVED: usize = 1 << 16;
/// If a plate takes this many elastic contact times to stop a ball, β m*, the ball does not leave it: Hertz' contact lasts 3.218 of its
/// units of time.
const SINKING_TIME: f64 = SINKING_LAMBDA / 3.218;

/// A collision that is being computed.
pub(crate) struct ImpactRun<'a> {
    pair: &'a CondensedPair,
    frame: &'a Frame,
    motion: ImpactMotion<'a>,
    initial_energy: f64,
    /// Time of the last contact since first touch, s.
    last_contact: f64,
    episodes: u64,
    was_closed: bool,
    /// Whether the bodies have moved apart since first touch.
    has_receded: bool,
    /// Energy dissipated by relaxation, J.
    dissipated: f64,
    /// Energy radiated from each body, J, if included.
    radiated: Option<[f64; 2]>,
    /// Energy that has gone into a plate, J, if included.
    plate: Option<f64>,
    impulse: f64,
    /// Impulse of the force without its oscillation ([`crate::motion::ImpactMotion::force_oscillation`]), N s.
    even_impulse: f64,
    /// [`ImpactMotion::missed_slope`] of the previous step.
    missed_slope: f64,
    /// Number of samples per step, its end included.
    per_step: u64,
    worst_residual: f64,
    residual_since: Option<StepInstant>,
    growth: f64,
    /// Largest difference of the exchanged momentum and the impulse, N s.
    worst_momentum: f64,
    approach: InterpolatedPeak,
    force: InterpolatedPeak,
    force_noise: ForceNoise,
    deepest_overlap: Option<DeepestOverlap>,
    pulse: ForcePulse,
    vibration_after: PostContactVibration,
    rest_criterion: RestCriterion,
    /// End of the compression, since first touch, s.
    turned: f64,
    /// Time limit since first touch, s.
    give_up: f64,
    expected_end: f64,
    /// Distance that a ball still sinks in with its plate per speed, s, if it does not leave it.
    sinking: Option<f64>,
    history: Option<History>,
    /// Samples of the last two steps.
    last: Option<MotionSample>,
    before_last: Option<MotionSample>,
    opening: Option<[MotionSample; 3]>,
    trace: Vec<RunTrace>,
    pressures: Pressures,
    /// Force and pressures of all steps so far, if they are asked for.
    record: Option<PressureRecord>,
}

/// Result of a run.
pub(crate) struct FinishedRun {
    pub collision: Collision,
    /// Approach and force of every step.
    pub trace: Vec<RunTrace>,
}

impl<'a> ImpactRun<'a> {
    pub fn new(
        pair: &'a CondensedPair,
        motion: ImpactMotion<'a>,
        frame: &'a Frame,
        request: &OutputRequest,
        n_steps: usize,
        elastic_contact_time: f64,
    ) -> Self {
        let steps = elastic_contact_time / motion.time_step;
        let instants = request.history_rows.max(MIN_SAMPLES) as f64;
        let per_step = (instants / steps).round().clamp(1.0, MAX_WITHIN_STEP) as u64;
        Self {
            give_up: request.max_contact_times * elastic_contact_time,
            expected_end: (1.0 + POST_CONTACT_FRACTION) * elastic_contact_time,
            sinking: motion
                .plate_mobility()
                .map(|mobility| mobility * frame.reduced_mass)
                .filter(|time| *time >= SINKING_TIME * elastic_contact_time),
            initial_energy: frame.initial(),
            pair,
            frame,
            last_contact: 0.0,
            episodes: 0,
            was_closed: false,
            has_receded: false,
            dissipated: 0.0,
            radiated: None,
            plate: None,
            impulse: 0.0,
            even_impulse: 0.0,
            missed_slope: 0.0,
            per_step,
            worst_residual: 0.0,
            residual_since: None,
            growth: 0.0,
            worst_momentum: 0.0,
            approach: InterpolatedPeak::default(),
            force: InterpolatedPeak::default(),
            force_noise: ForceNoise::default(),
            deepest_overlap: None,
            pulse: ForcePulse::default(),
            vibration_after: PostContactVibration::default(),
            rest_criterion: RestCriterion::new(frame),
            turned: 0.0,
            history: (request.history_rows > 0)
                .then(|| History::new(request.history_rows, per_step as f64 * steps)),
            last: None,
            before_last: None,
            opening: None,
            trace: Vec::with_capacity(n_steps.saturating_mul(2).min(MAX_RESERVED)),
            pressures: Pressures::default(),
            record: request.pressures.then(PressureRecord::default),
            motion,
        }
    }

    /// Advances until the bodies have separated or the run stops.
    pub fn until_parted(mut self, monitor: &mut dyn Monitor) -> FinishedRun {
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

    /// Returns the time of the current step since the start of the case, s.
    fn time_of_case(&self) -> f64 {
        self.frame.approach.first_touch() + self.motion.time()
    }

    /// Advances by one step and returns the ending, if the run has ended.
    fn advance(&mut self, monitor: &mut dyn Monitor) -> Result<Option<Ending>, Stop> {
        let opens = self.advance_motion()?;
        let stays = self.record();
        if opens {
            self.sample_opening();
        }
        if let Some(ending) = self.ending(stays) {
            return Ok(Some(ending));
        }
        self.check_energy()?;
        self.check_duration()?;
        self.report(monitor)?;
        Ok(None)
    }

    /// Returns the instant of the current step since the start of the case.
    fn now(&self) -> StepInstant {
        StepInstant { time: self.time_of_case(), step: self.motion.step as u64 }
    }

    /// Advances the motion by one step, counts the contacts, and returns whether the contact opens in this step.
    fn advance_motion(&mut self) -> Result<bool, Stop> {
        let overlap_before = if self.motion.step == 0 { 0.0 } else { self.motion.axis_overlap() };
        let first_touch = self.frame.approach.first_touch();
        self.motion.advance().map_err(|stop| stop.later_by(first_touch))?;
        if !(self.motion.force.is_finite() && self.motion.rate.is_finite()) {
            return Err(Stop::NoContactState { time: self.time_of_case() });
        }
        let is_closed = self.motion.contact.n_closed > 0;
        let opens = self.was_closed && !is_closed;
        if opens {
            // The overlap on the axis passes through zero between the steps.
            let now = self.motion.axis_overlap();
            let part = (overlap_before / (overlap_before - now)).clamp(0.0, 1.0);
            self.last_contact = self.motion.time() - (1.0 - part) * self.motion.time_step;
        }
        self.episodes += u64::from(is_closed && !self.was_closed);
        self.was_closed = is_closed;
        Ok(opens)
    }

    /// Keeps the samples around the end of the contact, which lies within this step.
    fn sample_opening(&mut self) {
        let (Some(before), Some(after)) = (self.before_last, self.last) else { return };
        let share = (self.last_contact - before.time) / self.motion.time_step;
        let end = MotionSample::within(None, &before, &after, Some(share), share);
        self.opening = Some([before, self.with_residual(end), after]);
    }

    /// Returns the ending, if the bodies have separated or stay together.
    fn ending(&mut self, stays: bool) -> Option<Ending> {
        let is_receding = self.motion.rate < 0.0;
        let flight = self.motion.time() - self.last_contact;
        let has_flown = is_receding && flight >= POST_CONTACT_FRACTION * self.last_contact;
        self.has_receded |= is_receding;
        // Under gravity bodies do not necessarily separate that far.
        let is_at_top = self.frame.gravity > 0.0 && self.has_receded && self.motion.rate >= 0.0;
        let sinks = self.sinking.filter(|_| self.motion.time() > self.expected_end);
        match stays || sinks.is_some() {
            _ if !self.was_closed && (has_flown || is_at_top) => Some(Ending::Parted),
            true => {
                let sunk = sinks.map_or(0.0, |time| time * self.motion.rate);
                self.approach.highest = self.approach.highest.max(self.motion.approach + sunk);
                Some(Ending::Together)
            }
            false => None,
        }
    }

    fn check_energy(&self) -> Result<(), Stop> {
        let relative = self.worst_residual;
        // NaN is above every limit.
        match relative <= MAX_IMBALANCE {
            true => Ok(()),
            false => Err(Stop::EnergyImbalance { time: self.time_of_case(), relative }),
        }
    }

    /// Checks that the run is within its time limit, or that its bodies still creep apart.
    fn check_duration(&self) -> Result<(), Stop> {
        let time = self.motion.time();
        let creeps = self.motion.rate.abs() < CREEPING_RATE * self.frame.speed()
            && time <= (1.0 + SLOWEST_PARTING) * self.turned;
        let (at, approach) = (self.now(), self.motion.approach);
        match self.episodes {
            _ if time <= self.give_up || creeps => Ok(()),
            0 => Err(Stop::NoContact { at, approach }),
            _ => Err(Stop::NoSeparation { at }),
        }
    }

    /// Reports the progress every few steps.
    fn report(&self, monitor: &mut dyn Monitor) -> Result<(), Stop> {
        let at = self.now();
        if !at.step.is_multiple_of(STEPS_BETWEEN_REPORTS) {
            return Ok(());
        }
        let progress = Progress {
            time: at.time,
            step: at.step,
            fraction: Progress::share(self.motion.time(), self.expected_end),
            contact_force: self.motion.force,
        };
        if monitor.report(progress) { Ok(()) } else { Err(Stop::Interrupted { at }) }
    }

    /// Records a step and returns whether the bodies stay together.
    fn record(&mut self) -> bool {
        self.observe_extremes();
        let touches = self.was_closed || self.motion.step == 0;
        let begin = self.last;
        // Parabolas do not extend across a first touch or the end of a contact.
        let is_same = |other: &MotionSample| other.touches == touches;
        let before =
            self.before_last.filter(|before| is_same(before) && begin.is_some_and(|b| is_same(&b)));
        let sample = self.sample(touches);
        let sample = self.integrated(before.as_ref(), begin.as_ref(), sample);
        self.observe_balance(&sample);
        if self.episodes > 0 {
            self.vibration_after.observe(self.was_closed, sample.vibration);
        }
        let approach = self.motion.approach;
        self.trace.push(RunTrace { approach, is_closed: self.was_closed });
        self.observe_within(before, begin, sample);
        (self.before_last, self.last) = (begin, Some(sample));
        let potential = self.frame.potential(approach).unwrap_or(0.0);
        let [lower, upper] = sample.vibration;
        self.rest_criterion.observe(&RelativeMotion {
            time: sample.time,
            is_closed: self.was_closed,
            force: sample.contact_force,
            rate: self.motion.rate,
            inner_energy: lower + upper + sample.strain + sample.contact + potential,
        })
    }

    /// Observes the largest approach, force and overlap, the noise of the force, and the end of the compression.
    fn observe_extremes(&mut self) {
        let at = self.now();
        let motion = &self.motion;
        self.approach.observe(motion.approach);
        self.force.observe(motion.force);
        self.force_noise.observe(motion.force, at);
        if let Some((overlap, radius)) = motion.largest_overlap() {
            let deepest = DeepestOverlap { overlap, radius, at };
            self.deepest_overlap = DeepestOverlap::of(self.deepest_overlap, deepest);
        }
        if motion.rate > 0.0 {
            self.turned = motion.time();
        }
    }

    /// Returns the sample of a step, with the losses of the previous one.
    fn sample(&mut self, touches: bool) -> MotionSample {
        let motion = &self.motion;
        let MotionEnergies { stored, contact, power, vibration, radiated_power, plate_power } =
            motion.energies();
        let (contact_radius, centre_pressure) = self.pair.radius_and_pressure(
            &motion.contact,
            &motion.forces,
            motion.slipped(),
            &mut self.pressures,
        );
        if let Some(record) = &mut self.record {
            let within = self.pair.nodal_pressure(&motion.forces);
            let within = within.take_while(|(radius, _)| *radius < contact_radius);
            record.time_step = motion.time_step;
            record.forces.push(motion.force);
            record.profiles.push(within.chain([(contact_radius, 0.0)]).collect());
        }
        MotionSample {
            time: motion.time(),
            touches,
            contact_force: motion.force,
            even_force: motion.force - motion.force_oscillation(),
            contact_radius,
            approach: motion.approach,
            centre_pressure,
            rate: motion.rate,
            strain: stored,
            contact,
            power,
            dissipated: self.dissipated,
            radiated_power,
            radiated: None,
            plate_power,
            plate: None,
            residual: 0.0,
            vibration,
        }
    }

    /// Observes the residuals of energy and momentum, and the spurious energy growth.
    fn observe_balance(&mut self, sample: &MotionSample) {
        let lost = sample.lost();
        let energy_scale = self.frame.energy_scale(self.approach.highest);
        let residual = sample.residual;
        self.worst_residual = nan_aware_max_abs(self.worst_residual, residual / energy_scale);
        self.growth = nan_aware_max(self.growth, (residual - lost) / energy_scale);
        if self.residual_since.is_none() && self.worst_residual > MAX_RESIDUAL {
            self.residual_since = Some(self.now());
        }
        let given = self.frame.weight() * sample.time;
        let drift = self.frame.impulse(self.motion.rate) + given - self.impulse;
        self.worst_momentum = nan_aware_max_abs(self.worst_momentum, drift);
    }

    /// Returns the collision of the run with its ending.
    fn finish(mut self, ending: Ending) -> FinishedRun {
        let ending = match ending {
            Ending::Parted => Ending::parted(self.rate_of_separation(), self.frame.speed()),
            other => other,
        };
        let bodies = self.body_results(&ending);
        let history = self.history_rows(&ending);
        let (motion, frame) = (&self.motion, self.frame);
        let meshes = self.pair.inputs().each_ref().map(|input| input.mesh());
        let peaks = self.pulse.peaks(self.force.highest, longest_at_pole(meshes));
        let first_touch = frame.approach.first_touch();
        let has_touched = self.episodes > 0;
        let collision = Collision {
            restitution: self.restitution(&ending),
            contact_time: (ending == Ending::Parted).then_some(self.last_contact),
            first_contact: has_touched.then_some(first_touch),
            last_contact: has_touched.then_some(first_touch + self.last_contact),
            contact_episodes: self.episodes,
            peak_force: Some(peaks.force),
            peak_force_raw: Some(self.force.highest),
            max_approach: Some(self.approach.highest),
            max_contact_radius: Some(peaks.radius),
            peak_pressure: Some(peaks.pressure),
            peak_pressure_radius: Some(peaks.pressure_radius),
            force_scatter: self.force_noise.force(),
            deepest_overlap: self.deepest_overlap,
            noisiest_instant: self.force_noise.noisiest_instant(),
            candidate_region: Some(self.pair.candidate_region()),
            initial_energy: Some(frame.kinetic(frame.speed())),
            energies: self.last.map_or(EnergyLedger::EMPTY, |end| end.energies(frame)),
            residual: self.last.map(|end| end.residual),
            residual_relative: Some(self.worst_residual),
            residual_since: self.residual_since,
            energy_growth: Some(self.growth),
            momentum_residual_relative: Some(self.worst_momentum / frame.momentum_scale()),
            bodies,
            pressures: self.record,
            time_step: Some(motion.time_step),
            steps: Some(motion.step as u64),
            factor_bytes: Some(self.pair.factor_bytes() as u64),
            repeated_contact_solutions: Some(motion.n_fallbacks() as u64),
            history,
            warnings: ending.together_warning().into_iter().collect(),
            ..Collision::empty(frame.approach, ending)
        };
        FinishedRun { collision, trace: self.trace }
    }

    /// Returns the rate of separation at the end of the contact, m/s.
    fn rate_of_separation(&self) -> f64 {
        self.frame.gravity * (self.motion.time() - self.last_contact) - self.motion.rate
    }

    fn restitution(&self, ending: &Ending) -> Option<f64> {
        ending.restitution(self.rate_of_separation(), self.frame.speed())
    }

    /// Returns the results of both bodies.
    fn body_results(&self, ending: &Ending) -> [BodyResult; 2] {
        let frame = self.frame;
        let velocity_after = self.restitution(ending).map(|e| frame.velocities(-e * frame.speed()));
        let is_parted = *ending == Ending::Parted;
        let vibration_energy = self.vibration_after.vibration_energy().filter(|_| is_parted);
        let mut bodies = self.pair.bodies_before(frame);
        for (side, body) in bodies.iter_mut().enumerate() {
            body.velocity_after = velocity_after.map(|both| both[side]);
            // The vibration energy of a half-space is the energy of its waves; a wall has neither this nor a mass.
            let input = &self.pair.inputs()[side];
            let is_wall = frame.masses[side].is_none() && input.mesh().is_none();
            let in_waves = match input.is_half_space() {
                true => self.radiated.map_or(0.0, |both| both[side]) + self.plate.unwrap_or(0.0),
                false => 0.0,
            };
            body.vibration_energy =
                vibration_energy.filter(|_| !is_wall).map(|both| both[side] + in_waves);
        }
        bodies
    }

    /// Returns the rows of the history, with one at the end of the contact.
    fn history_rows(&mut self, ending: &Ending) -> Vec<HistoryRow> {
        let mut history = self.history.take().map(History::into_rows).unwrap_or_default();
        if !history.is_empty()
            && *ending == Ending::Parted
            && let Some([before, end, after]) = self.opening
            && before.time < end.time
            && end.time < after.time
        {
            let time = self.frame.approach.first_touch() + end.time;
            let place = history.partition_point(|row| row.time < time);
            history.insert(place, end.row(self.frame));
        }
        history
    }
}

mod step_integrals;
