//! Quasi-static impact of viscoelastic bodies with Hertz' contact.
//!
//! While the contact grows (Lee & Radok 1960) and after it has begun to shrink (Ting 1966),
//!
//! ```math
//! F(t) = \tfrac43\sqrt{R^*}\int_0^{t_1}\!\!E^*(t-s)\,\mathrm d\bigl[\delta(s)^{3/2}\bigr], \qquad
//! p(0,t) = \frac{2}{\pi\sqrt{R^*}}\int_0^{t_1}\!\!E^*(t-s)\,\mathrm d\sqrt{\delta(s)}, \qquad
//! a = \sqrt{R^*\delta(t_1)},
//! ```
//!
//! with t₁ = t in loading; in unloading t₁ is the earlier time at which the contact was as large:
//!
//! ```math
//! \int_{t_1}^{t}E^*(t-s)\,\dot\delta(s)\,\mathrm ds = 0, \qquad m^*\ddot\delta = -F.
//! ```
//!
//! Contact ends when t₁ = 0, and so F = 0, while δ > 0: the surfaces recover later. With the
//! Prony series of [`PairRelaxation`] every integral is a sum of elements' fading memories. In
//! units of the length ℓ = (m*/K)^(2/5) v^(4/5) and the time ℓ/v nothing is left but g∞, g_k and
//! b_k = ℓ/(v τ_k).
//!
//! With a [`FiniteSize`], Hertz' approach u(t) takes the place of δ(t) in the integrals, and
//!
//! ```math
//! \delta = u + \sum_i\frac{c_i}{E_iR_i}(s)\,F(s)
//! = u + \Bigl[m_\infty + \sum_k\frac{m_k\,s}{s+p_k}\Bigr] K u^{3/2},
//! ```
//!
//! products in Carson's transform, with c(a), E, ν of the relaxed moduli. That is the correspondence
//! principle in loading, to first order in a/R. In unloading F lacks what E* makes of K u^(3/2)
//! since t₁. Keeping it makes the restitution of glass, from 0.1 to 2 m/s and of whatever loss, too
//! small by up to 4e-4, found by direct integration; finite elements agree.
//!
//! Limits: those of [`crate::HertzImpact`], but with loss; a restitution below 1e-8 is returned as
//! bodies that stay together.

use std::f64::consts::PI;

use crate::bisection::last_where;
use crate::collocation::{Interpolation, N, POINTS, evaluate};
use crate::error::{LawError, tolerance as checked_tolerance};
use crate::finite_correction::RelaxingCorrection;
use crate::finite_size::FiniteSize;
use crate::hertz::HertzImpact;
use crate::impact::{Impact, ImpactInstant};
use crate::pair::Pair;
use crate::pair_relaxation::PairRelaxation;
use crate::ting_record::{Contact, Element, Record, peak};
use crate::ting_step::{Solved, State, Stepper};

/// Local error of the rate over the tolerance. A collision takes some tens of steps.
const LOCAL_SHARE: f64 = 0.1;

/// Restitution that is none; also of the energy that could still come back, its root.
const STUCK: f64 = 1e-8;

/// Far above the some hundreds that the most viscous contacts take.
const MAX_STEPS: usize = 20_000;

/// Index of the Gauss point at θ = 1/2.
const MIDDLE: usize = N / 2;

/// Faster relaxation leaves a force of 1e-15.
const MAX_RATE: f64 = 1e15;

/// A viscoelastic pair.
#[derive(Debug, Clone, PartialEq)]
pub struct Ting {
    pair: Pair,
    relaxation: PairRelaxation,
    finite_size: Option<FiniteSize>,
    tolerance: f64,
}

impl Ting {
    /// Accuracy of restitution, time and force that [`Ting::new`] asks for.
    pub const DEFAULT_TOLERANCE: f64 = 1e-8;

    /// Of a pair, whose modulus is the instantaneous one, and its relaxation.
    pub fn new(pair: &Pair, relaxation: PairRelaxation) -> Self {
        Self { pair: *pair, relaxation, finite_size: None, tolerance: Self::DEFAULT_TOLERANCE }
    }

    /// With another tolerance, 1e-10 to 1e-2.
    ///
    /// # Errors
    /// A tolerance outside.
    pub fn with_tolerance(self, tolerance: f64) -> Result<Self, LawError> {
        Ok(Self { tolerance: checked_tolerance(tolerance)?, ..self })
    }

    /// With the finite size of the spheres in series; of the same materials as the relaxation.
    pub fn with_finite_size(self, finite_size: FiniteSize) -> Self {
        Self { finite_size: Some(finite_size), ..self }
    }

    /// The collision at an approach speed, m/s.
    ///
    /// # Errors
    /// Those of [`HertzImpact::new`]; a contact too large for the finite-size correction; a
    /// motion that does not end.
    pub fn impact(&self, approach_speed: f64) -> Result<Impact, LawError> {
        let hertz = HertzImpact::new(&self.pair, approach_speed)?;
        let units = Units::of(&hertz);
        let terms = self.relaxation.terms();
        let corrections = match &self.finite_size {
            Some(size) => {
                size.check(hertz.max_contact_radius())?;
                size.correction(units.length, units.force, units.radius, &self.relaxation)
            }
            None => RelaxingCorrection::none(terms.len()),
        };
        let elements = terms.iter().zip(corrections.fading).map(|(term, correction)| Element {
            weight: term.weight,
            rate: (units.time / term.relaxation_time).min(MAX_RATE),
            correction,
        });
        let contact = Contact {
            equilibrium: self.relaxation.equilibrium_weight(),
            elements: elements.collect(),
            correction: corrections.equilibrium,
        };
        Collision::new(&contact, self.finite_size.as_ref(), self.tolerance).run(&units)
    }
}

/// What a dimensionless 1 stands for.
struct Units {
    time: f64,
    length: f64,
    speed: f64,
    force: f64,
    radius: f64,
    pressure: f64,
    energy: f64,
}

impl Units {
    fn of(hertz: &HertzImpact) -> Self {
        let (pair, speed) = (hertz.pair(), hertz.approach_speed());
        // Hertz' energy balance is u^(5/2) = 5/4 at the largest approach.
        let length = hertz.max_approach() / 1.25f64.powf(0.4);
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
struct Collision<'a> {
    contact: &'a Contact,
    finite_size: Option<&'a FiniteSize>,
    interpolation: Interpolation,
    local_tolerance: f64,
    state: State,
    length: f64,
    work: f64,
    n_steps: usize,
    peak_force: f64,
    peak_pressure: f64,
    history: Vec<ImpactInstant>,
}

impl<'a> Collision<'a> {
    fn new(contact: &'a Contact, finite_size: Option<&'a FiniteSize>, tolerance: f64) -> Self {
        let fastest = contact.elements.iter().map(|element| element.rate).fold(1.0, f64::max);
        let memory = vec![[0.0; 3]; contact.elements.len()];
        Self {
            contact,
            finite_size,
            interpolation: Interpolation::new(),
            local_tolerance: LOCAL_SHARE * tolerance,
            state: State { time: 0.0, approach: 0.0, rate: 1.0, force: 0.0, memory },
            // δ^(3/2) is not smooth at first touch: begin far below all time scales.
            length: 1e-5 / fastest,
            work: 0.0,
            n_steps: 0,
            peak_force: 0.0,
            peak_pressure: 0.0,
            history: vec![ImpactInstant::first_touch(1.0, true, contact.elements.is_empty())],
        }
    }

    fn run(mut self, units: &Units) -> Result<Impact, LawError> {
        let record = self.load(units)?;
        let turned = self.state.clone();
        if let Some(record) = &record {
            self.unload(record, units)?;
        }
        let parted = -self.state.rate > STUCK;
        let hertz = self.contact.hertz_approach(turned.approach, &turned.memory);
        Ok(Impact {
            restitution: if parted { -self.state.rate } else { 0.0 },
            contact_time: parted.then_some(self.state.time * units.time),
            peak_force: self.peak_force * units.force,
            max_approach: turned.approach * units.length,
            max_contact_radius: hertz.sqrt() * units.radius,
            peak_pressure: Some(self.peak_pressure * units.pressure),
            history: self.history.iter().map(|instant| units.dimensional(instant)).collect(),
        })
    }

    /// Up to the largest approach; `None` if the bodies stay there.
    fn load(&mut self, units: &Units) -> Result<Option<Record>, LawError> {
        let mut steps = Vec::new();
        loop {
            let solved = self.step(None, units)?;
            let turn = if solved.step.rate_at(1.0) > 0.0 {
                1.0
            } else {
                last_where(0.0, 1.0, |theta| solved.step.rate_at(theta) > 0.0)
            };
            let pressure = self.interpolation.coefficients(&solved.pressure);
            self.peak_force = self.peak_force.max(peak(&solved.step.force, turn));
            self.peak_pressure = self.peak_pressure.max(peak(&pressure, turn));
            self.advance(&solved, turn);
            if let (Some(size), Some(last)) = (self.finite_size, self.history.last()) {
                size.check(last.contact_radius * units.radius)?;
            }
            steps.push(solved.step);
            if turn < 1.0 {
                return Ok(Some(Record { steps, end: self.state.time }));
            }
            if self.state.rate < STUCK && self.state.force * self.state.approach < STUCK * STUCK {
                return Ok(None);
            }
        }
    }

    /// Down to the end of contact.
    fn unload(&mut self, record: &Record, units: &Units) -> Result<(), LawError> {
        loop {
            let solved = self.step(Some(record), units)?;
            let touches = |theta: f64| solved.step.surface_at(self.contact, theta) > 0.0;
            let end = if touches(1.0) { 1.0 } else { last_where(0.0, 1.0, touches) };
            self.advance(&solved, end);
            if end < 1.0 {
                self.state.force = 0.0;
                if let Some(last) = self.history.last_mut() {
                    (last.force, last.contact_radius) = (0.0, 0.0);
                    last.centre_pressure = Some(0.0);
                    // A surface without load gives nothing back.
                    last.dissipated.get_or_insert(last.work);
                }
                return Ok(());
            }
        }
    }

    /// One step within the tolerance; the size of the next is chosen.
    fn step(&mut self, record: Option<&Record>, units: &Units) -> Result<Solved, LawError> {
        let (contact, interpolation) = (self.contact, &self.interpolation);
        let stepper = Stepper { contact, interpolation, record };
        while self.n_steps < MAX_STEPS {
            self.n_steps += 1;
            let Some(solved) = stepper.solve(&self.state, self.length) else {
                self.length *= 0.4;
                continue;
            };
            // The finest detail falls with the fifth power of the step.
            let factor = (0.9 * (self.local_tolerance / solved.error).powf(0.2)).clamp(0.2, 2.0);
            // Many iterations say that the step nears the limit of contraction.
            self.length *= if solved.n_iterations > 14 { factor.min(0.8) } else { factor };
            if solved.error <= self.local_tolerance {
                return Ok(solved);
            }
        }
        let time = self.state.time * units.time;
        Err(LawError::NotFinished { model: "ting", n_steps: self.n_steps, time })
    }

    /// The state at θ of a step becomes the present one.
    fn advance(&mut self, solved: &Solved, theta: f64) {
        let step = &solved.step;
        let radii = self.interpolation.coefficients(&solved.contact_approach);
        let pressures = self.interpolation.coefficients(&solved.pressure);
        let is_elastic = self.contact.elements.is_empty();
        let instant = |theta: f64| {
            let hertz = evaluate(&radii, theta).max(0.0);
            ImpactInstant {
                time: step.start + theta * step.length,
                approach: step.approach_at(theta),
                approach_rate: step.rate_at(theta),
                force: evaluate(&step.force, theta),
                contact_radius: hertz.sqrt(),
                centre_pressure: Some(evaluate(&pressures, theta).max(0.0)),
                work: self.work + step.work_until(&self.interpolation, theta),
                strain_energy: is_elastic.then(|| self.contact.correction.strain_energy(hertz)),
                dissipated: is_elastic.then_some(0.0),
            }
        };
        let middle = (POINTS[MIDDLE] < theta).then(|| instant(POINTS[MIDDLE]));
        let last = instant(theta);
        self.history.extend(middle);
        self.history.push(last);
        self.work = last.work;
        self.state = State {
            time: last.time,
            approach: last.approach,
            rate: last.approach_rate,
            force: last.force,
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
        }
    }
}
