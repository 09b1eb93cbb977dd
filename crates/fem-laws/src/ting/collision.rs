//! The dimensionless motion of [`crate::Ting`], step by step: loading, unloading and the results gathered.

use std::f64::consts::PI;

use crate::error::LawError;
use crate::finite_size::FiniteSize;
use crate::hertz::HertzImpact;
use crate::impact::{AT_REST, Impact, ImpactInstant};
use crate::numerics::bisection::last_where;
use crate::numerics::power;
use crate::ting::Ting;
use crate::ting::collocation::{Interpolation, N, POINTS, evaluate};
use crate::ting::loading_record::{Contact, Record, peak};
use crate::ting::step::{Solved, State, Stepper};

/// Local error of the rate over the tolerance. A collision takes some tens of steps.
const LOCAL_SHARE: f64 = 0.1;

/// Rounding error of a force, relative to the force of the unrelaxed materials: the force is a difference
/// of terms of that size.
const OF_ROUNDING: f64 = 1e-13;

/// A ball creeps under its weight if the force is within this share of that, and the energy of its motion
/// below this share of what it has fallen since first touch.
const SETTLED: f64 = 1e-3;

/// Time after which a ball that sinks in with a plate is followed no longer: some two of Hertz' contact times.
const SUNK: f64 = 6.0;

/// Steps that a collision may take at [`Ting::DEFAULT_TOLERANCE`], the fifth root of which they follow as a step's
/// error does its fifth power. Tens are usual; the most viscous and the most radiating contacts of the tests take more
/// than 2000. Each step looks back on all before.
const MAX_STEPS: f64 = 5_000.0;
/// Steps that a collision may take at any tolerance: the span from the fastest relaxation to the slowest
/// contact. Estimates of contacts with ten decades between the two take up to 930.
const MIN_STEPS: f64 = 1_000.0;

/// Index of the Gauss point at θ = 1/2.
const MIDDLE: usize = N / 2;

/// Units of the dimensionless quantities.
pub(crate) struct Units {
    pub time: f64,
    pub length: f64,
    pub speed: f64,
    pub force: f64,
    pub radius: f64,
    pub pressure: f64,
    pub energy: f64,
}

impl Units {
    pub fn of(hertz: &HertzImpact) -> Self {
        let (pair, speed) = (hertz.pair(), hertz.approach_speed());
        let inertia = pair.effective_mass() / hertz.stiffness();
        let length = power(inertia, 0.4) * power(speed, 0.8);
        Self {
            time: length / speed,
            length,
            speed,
            force: hertz.force(length),
            radius: pair.effective_radius().sqrt() * length.sqrt(),
            pressure: 2.0 / PI * pair.contact_modulus() * (length / pair.effective_radius()).sqrt(),
            energy: pair.effective_mass() * speed * speed,
        }
    }
}

/// The dimensionless motion and what is gathered along it.
pub(crate) struct Collision<'a> {
    contact: &'a Contact,
    finite_size: Option<&'a FiniteSize>,
    interpolation: Interpolation,
    local_tolerance: f64,
    max_steps: usize,
    state: State,
    length: f64,
    work: f64,
    radiated: f64,
    plate_energy: f64,
    n_steps: usize,
    peak_force: f64,
    peak_pressure: f64,
    /// Largest approach in unloading, where the bodies radiate or a plate bends.
    max_approach: f64,
    history: Vec<ImpactInstant>,
}

impl<'a> Collision<'a> {
    /// Creates the collision of bodies that touch at a rate of the approach.
    pub fn new(
        contact: &'a Contact,
        finite_size: Option<&'a FiniteSize>,
        tolerance: f64,
        rate: f64,
    ) -> Self {
        let fastest = contact.elements.iter().map(|element| element.rate).fold(1.0, f64::max);
        let memory = vec![[0.0; 3]; contact.elements.len()];
        Self {
            contact,
            finite_size,
            interpolation: Interpolation::new(),
            local_tolerance: LOCAL_SHARE * tolerance,
            max_steps: (MAX_STEPS * power(Ting::DEFAULT_TOLERANCE / tolerance, 0.2)).max(MIN_STEPS)
                as usize,
            state: State { time: 0.0, approach: 0.0, rate, force: 0.0, slow_force: 0.0, memory },
            // δ^(3/2) is not smooth at first touch: begin far below all time scales.
            length: 1e-5 / fastest,
            work: 0.0,
            radiated: 0.0,
            plate_energy: 0.0,
            n_steps: 0,
            peak_force: 0.0,
            peak_pressure: 0.0,
            max_approach: 0.0,
            history: vec![ImpactInstant {
                radiated: contact.radiation.map(|_| 0.0),
                plate: contact.plate.map(|_| 0.0),
                ..ImpactInstant::first_touch(rate, true, contact.elements.is_empty())
            }],
        }
    }

    pub fn run(mut self, units: &Units) -> Result<Impact, LawError> {
        let first_rate = self.state.rate;
        let record = self.load(units)?;
        let turned = self.state.clone();
        if let Some(record) = &record {
            self.unload(record, units)?;
        }
        let hertz = self.contact.hertz_approach_of(&turned);
        let impact = Impact {
            peak_force: self.peak_force * units.force,
            max_approach: turned.approach.max(self.max_approach) * units.length,
            max_contact_radius: hertz.sqrt() * units.radius,
            peak_pressure: Some(self.peak_pressure * units.pressure),
            history: self.history.iter().map(|instant| units.dimensional(instant)).collect(),
            ..Impact::default()
        };
        Ok(match record {
            Some(_) => impact.parted(-self.state.rate / first_rate, self.state.time * units.time),
            None => impact,
        })
    }

    /// Computes the loading up to the largest contact; `None` if the bodies stay there.
    fn load(&mut self, units: &Units) -> Result<Option<Record>, LawError> {
        let mut steps = Vec::new();
        loop {
            let solved = self.step(None, units)?;
            let grows = |theta: f64| solved.step.grows_at(self.contact, theta);
            let turn = if grows(1.0) || self.rests() { 1.0 } else { last_where(0.0, 1.0, grows) };
            let pressure = self.interpolation.coefficients(&solved.pressure);
            self.peak_force = self.peak_force.max(peak(&solved.step.force, turn));
            self.peak_pressure = self.peak_pressure.max(peak(&pressure, turn));
            self.advance(&solved, turn);
            if let (Some(size), Some(last)) = (self.finite_size, self.history.last()) {
                size.check(last.contact_radius * units.radius)?;
            }
            steps.push(solved.step);
            // A contact that relaxes may grow as long as the ball sinks.
            let has_peaked = turn < 1.0 || self.state.time > SUNK;
            if let Some(plate) = self.contact.plate.filter(|plate| has_peaked && plate.takes_all())
            {
                self.max_approach = plate.deflection(0.0, 0.0, 0.0);
                return Ok(None);
            }
            if turn < 1.0 && !self.rests() {
                return Ok(Some(Record { steps, end: self.state.time }));
            }
            if self.rests() {
                return Ok(None);
            }
            let (gravity, State { rate, approach, force, .. }) =
                (self.contact.gravity, &self.state);
            let is_borne = (force - gravity).abs() < SETTLED * gravity;
            if is_borne && 0.5 * rate * rate < SETTLED * gravity * approach {
                return Ok(None);
            }
        }
    }

    /// Returns whether the bodies are at rest, so that this is no turning point: neither their motion nor the energy that could return
    /// moves them, or the force is of rounding.
    fn rests(&self) -> bool {
        let State { rate, approach, force, .. } = self.state;
        let is_small = force * approach < AT_REST * AT_REST
            || force < OF_ROUNDING * approach * approach.sqrt();
        rate < AT_REST && is_small
    }

    /// Computes the unloading to the end of contact, or until the weight turns the ball back.
    fn unload(&mut self, record: &Record, units: &Units) -> Result<(), LawError> {
        loop {
            let solved = self.step(Some(record), units)?;
            let touches = |theta: f64| solved.step.surface_at(self.contact, theta) > 0.0;
            let end = if touches(1.0) { 1.0 } else { last_where(0.0, 1.0, touches) };
            if self.contact.has_far_field() {
                let top = last_where(0.0, end, |theta| solved.step.rate_at(theta) > 0.0);
                self.max_approach = self.max_approach.max(solved.step.approach_at(top));
            }
            self.advance(&solved, end);
            if end < 1.0 {
                self.state.force = 0.0;
                if let Some(last) = self.history.last_mut() {
                    (last.force, last.contact_radius) = (0.0, 0.0);
                    last.centre_pressure = Some(0.0);
                    if let (Some(radiation), Some(radiated)) =
                        (&self.contact.radiation, &mut last.radiated)
                    {
                        // What is left of the slow force goes.
                        let held = radiation.held(0.0, self.state.slow_force);
                        *radiated += held;
                        last.strain_energy = last.strain_energy.map(|energy| energy - held);
                    }
                    // A surface without load gives nothing back.
                    let left = last.work - last.radiated.unwrap_or_default();
                    last.dissipated.get_or_insert(left - last.plate.unwrap_or_default());
                }
                return Ok(());
            }
            if self.contact.gravity > 0.0 && solved.step.turns_back_at(self.contact, end) {
                return Ok(());
            }
        }
    }

    /// Takes one step within the tolerance and chooses the size of the next.
    fn step(&mut self, record: Option<&Record>, units: &Units) -> Result<Solved, LawError> {
        let (contact, interpolation) = (self.contact, &self.interpolation);
        let stepper = Stepper { contact, interpolation, record };
        // A step that the clock does not feel, or that is none, gets nowhere.
        while self.n_steps < self.max_steps && self.state.time + self.length > self.state.time {
            self.n_steps += 1;
            let Some(solved) = stepper.solve(&self.state, self.length) else {
                self.length *= 0.4;
                continue;
            };
            // The finest detail falls with the fifth power of the step.
            let factor = (0.9 * power(self.local_tolerance / solved.error, 0.2)).clamp(0.2, 2.0);
            // Many iterations say that the step nears the limit of contraction.
            self.length *= if solved.n_iterations > 14 { factor.min(0.8) } else { factor };
            if solved.error <= self.local_tolerance {
                return Ok(solved);
            }
        }
        let time = self.state.time * units.time;
        Err(LawError::NotFinished { model: "ting", n_steps: self.n_steps, time })
    }

    /// Advances to the state at θ of a step.
    fn advance(&mut self, solved: &Solved, theta: f64) {
        let step = &solved.step;
        let radii = self.interpolation.coefficients(&solved.contact_approach);
        let pressures = self.interpolation.coefficients(&solved.pressure);
        let is_elastic = self.contact.elements.is_empty();
        let instant = |theta: f64| {
            let hertz = evaluate(&radii, theta).max(0.0);
            let force = evaluate(&step.force, theta);
            let mut strain_energy =
                is_elastic.then(|| self.contact.correction.strain_energy(hertz));
            let radiated = self.contact.radiation.map(|radiation| {
                let slow_force = step.slow_force_at(&radiation, theta);
                strain_energy =
                    strain_energy.map(|energy| energy + radiation.held(force, slow_force));
                self.radiated + step.radiated_until(&radiation, &self.interpolation, theta)
            });
            ImpactInstant {
                time: step.start + theta * step.length,
                approach: step.approach_at(theta),
                approach_rate: step.rate_at(theta),
                force,
                contact_radius: hertz.sqrt(),
                centre_pressure: Some(evaluate(&pressures, theta).max(0.0)),
                work: self.work + step.work_until(&self.interpolation, theta),
                strain_energy,
                dissipated: is_elastic.then_some(0.0),
                radiated,
                plate: self.contact.plate.map(|plate| {
                    let more = step.plate_energy_until(&plate, &self.interpolation, theta);
                    self.plate_energy + more
                }),
            }
        };
        let middle = (POINTS[MIDDLE] < theta).then(|| instant(POINTS[MIDDLE]));
        let last = instant(theta);
        self.history.extend(middle);
        self.history.push(last);
        self.work = last.work;
        self.radiated = last.radiated.unwrap_or_default();
        self.plate_energy = last.plate.unwrap_or_default();
        let slow_force = |radiation| step.slow_force_at(&radiation, theta);
        self.state = State {
            time: last.time,
            approach: last.approach,
            rate: last.approach_rate,
            force: last.force,
            slow_force: self.contact.radiation.map_or(0.0, slow_force),
            memory: step.memories(self.contact, theta),
        };
    }
}

impl Units {
    fn dimensional(&self, instant: &ImpactInstant) -> ImpactInstant {
        ImpactInstant {
            time: instant.time * self.time,
            approach: instant.approach * self.length,
            approach_rate: instant.approach_rate * self.speed,
            force: instant.force * self.force,
            contact_radius: instant.contact_radius * self.radius,
            centre_pressure: instant.centre_pressure.map(|pressure| pressure * self.pressure),
            work: instant.work * self.energy,
            strain_energy: instant.strain_energy.map(|energy| energy * self.energy),
            dissipated: instant.dissipated.map(|energy| energy * self.energy),
            radiated: instant.radiated.map(|energy| energy * self.energy),
            plate: instant.plate.map(|energy| energy * self.energy),
        }
    }
}
