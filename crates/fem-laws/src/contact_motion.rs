//! The motion of a contact with a law, which may dent, on a body or on a thin plate, integrated in time;
//! [`crate::dent_impact`] does it without time steps for a law that dents on a body.
//!
//! ```math
//! m^*\ddot\xi = -F(\xi,\dot\xi), \qquad \xi(0) = 0, \quad \dot\xi(0) = v
//! ```
//!
//! In units of the length ℓ = (m*v²/K)^(1/(γ+1)) and the time ℓ/v one number is left for a spring and a dashpot:
//!
//! ```math
//! \ddot x = -x^\gamma - c\,x^n\dot x, \qquad c = \frac{C\,\ell^{n+1}}{m^*v}.
//! ```
//!
//! A law that dents has no dashpot; its F is the loading up to the largest x and the rebound from there.
//!
//! The integrator is the Runge–Kutta method of order 8 of Dormand & Prince; turns, largest force and end of contact are located
//! with steps of their own. Neither x^γ nor xⁿ ẋ need be smooth at x = 0, where a collision
//! begins and may end, so the clock s of the integration slows down there,
//!
//! ```math
//! \frac{\mathrm dt}{\mathrm ds} = b\,\frac{x+\varepsilon b}{x+\varepsilon b+b\dot x^2},
//! ```
//!
//! which makes x change by a constant factor a step while ẋ is large, and leaves a creep alone; b ≤ 1 is
//! the overlap at which the dashpot alone would stop the motion. During the rebound of a dent x counts from the dent.
//! Gravity adds g ℓ/v² to ẍ; a ball that
//! turns back while it touches, or whose energy does not lift it out of the contact any more, stays. The dissipated
//! energy ∫c xⁿ ẋ² dt is integrated along; that of a dent is the work of the loading less what a rebound returns.
//!
//! A thin plate ([`crate::plate_mobility`]) is a dashpot in series: the overlap x is less than the approach by its
//! deflection, and with Zener's λ and the rate V of the approach
//!
//! ```math
//! \dot x = V - \lambda F = \frac{V-\lambda x^\gamma}{1+\lambda c\,x^n}, \qquad \dot V = -F.
//! ```
//!
//! Limits: a strongly damped creep back to zero overlap is rejected
//! when it needs more than 100 000 steps.

use crate::error::{LawError, positive};
use crate::impact::{AT_REST, Impact, ImpactInstant};
use crate::laws::{ContactLaw, EndRule, Rebound};
use crate::numerics::bisection::falling_zero;
use crate::numerics::runge_kutta::{Integrator, after_step};
use crate::pair::Pair;
use crate::plate::SINKING_LAMBDA;

const MAX_STEPS: usize = 100_000;

/// Steps of the clock stay short, so that neither turn nor largest force is stepped over twice.
const LONGEST_STEP: f64 = 0.5;

/// ε: what happens below this overlap, of 1, is not resolved; it is worth ε^(n+1) of the rate.
const UNRESOLVED: f64 = 1e-9;

/// Overlap x, rate V of the approach, t, and what the contact and the plate have taken, dimensionless.
type State = [f64; 5];

/// V̇ = gravity − x^γ − c xⁿ ẋ, ẋ = V − λ F, or the same with the force of a dent.
pub(crate) struct ContactMotion<'a> {
    pair: &'a Pair,
    law: &'a ContactLaw,
    /// Units of length, m, speed, m/s, and time, s.
    length: f64,
    speed: f64,
    time: f64,
    damping: f64,
    gravity: f64,
    /// λ of a plate; 0 without one.
    lambda: f64,
    /// b: braking by the dashpot alone, dẋ = −c xⁿ dx, stops at c xⁿ⁺¹ = n + 1.
    braking: f64,
    /// Rebound of a dent and the x at which it ends; `None` before, and for a law that does not dent.
    rebound: Option<(Rebound, f64)>,
}

impl<'a> ContactMotion<'a> {
    /// Returns the motion from first touch at a speed, m/s, with the mobility of a plate, m/(N s), 0 without one, and gravity
    /// along the approach, m/s².
    ///
    /// # Errors
    /// A unit of the motion that leaves the range of f64.
    pub fn new(
        pair: &'a Pair,
        law: &'a ContactLaw,
        (plate_mobility, gravity): (f64, f64),
        speed: f64,
    ) -> Result<Self, LawError> {
        let mass = pair.effective_mass();
        // The powers are taken apart so that v² cannot leave the range of f64.
        let inverse = (law.elastic_exponent() + 1.0).recip();
        let length = (mass / law.stiffness()).powf(inverse) * speed.powf(2.0 * inverse);
        let length = positive("contact law approach", length)?;
        let time = positive("contact law contact_time", length / speed)?;
        let force = positive("contact law peak_force", mass * speed / time)?;
        let n = law.damping_exponent();
        let damping = law.damping() * (length.powf(n) * time / mass);
        if !damping.is_finite() {
            return Err(LawError::NotPositive { quantity: "contact law damping", value: damping });
        }
        let (gravity, lambda) = (gravity * time / speed, plate_mobility * force / speed);
        let braking = match damping > 0.0 {
            true => ((n + 1.0) / damping).powf((n + 1.0).recip()).min(1.0),
            false => 1.0,
        };
        let rebound = None;
        Ok(Self { pair, law, length, speed, time, damping, gravity, lambda, braking, rebound })
    }

    /// Returns the units of force, N, and energy, J.
    fn force_and_energy(&self) -> (f64, f64) {
        let mass = self.pair.effective_mass();
        (mass * self.speed / self.time, mass * self.speed * self.speed)
    }

    /// Returns whether the contact dents further as it grows.
    fn is_denting(&self) -> bool {
        self.law.elastic_plastic().is_some() && self.rebound.is_none()
    }

    /// Returns x above the dent.
    fn height(&self, x: f64) -> f64 {
        self.rebound.map_or(x, |(_, dent)| x - dent)
    }

    /// Returns the force without the dashpot. The spring continues as an odd function, the dashpot as an even one, below x = 0,
    /// where only trial states of the integrator lie.
    fn spring(&self, x: f64) -> f64 {
        let force = match (self.rebound, self.law.elastic_plastic()) {
            (None, None) => return x.abs().powf(self.law.elastic_exponent()).copysign(x),
            (None, Some(_)) => self.law.loading_force(x.max(0.0) * self.length),
            (Some((rebound, dent)), _) => rebound.force_at((x - dent) * self.length),
        };
        force / self.force_and_energy().0
    }

    /// Returns c xⁿ.
    fn dashpot(&self, x: f64) -> f64 {
        match self.damping > 0.0 {
            true => self.damping * x.abs().powf(self.law.damping_exponent()),
            false => 0.0,
        }
    }

    /// Returns the energy that the contact returns from x on; of one that is denting, `None`.
    fn stored(&self, x: f64) -> Option<f64> {
        let exponent = self.law.elastic_exponent() + 1.0;
        match self.rebound {
            None => (!self.is_denting()).then(|| x.max(0.0).powf(exponent) / exponent),
            Some((rebound, dent)) => {
                let height = (x - dent).max(0.0) * self.length;
                Some(rebound.energy_at(height) / self.force_and_energy().1)
            }
        }
    }

    /// Returns the force, the rate ẋ of the overlap and the coefficient c xⁿ of the dashpot.
    fn force_and_rate(&self, [x, v, ..]: State) -> (f64, f64, f64) {
        let (spring, dashpot) = (self.spring(x), self.dashpot(x));
        let rate = (v - self.lambda * spring) / (1.0 + self.lambda * dashpot);
        (spring + dashpot * rate, rate, dashpot)
    }

    fn rate(&self, state: State) -> f64 {
        match self.lambda > 0.0 {
            true => self.force_and_rate(state).1,
            false => state[1],
        }
    }

    /// Returns the approach: the overlap and the deflection of the plate, λ times the impulse.
    fn approach(&self, [x, v, t, ..]: State) -> f64 {
        x + self.lambda * (1.0 + self.gravity * t - v)
    }

    /// Returns dF/dt at x > 0 of a law that does not dent.
    fn force_rate(&self, state: State) -> f64 {
        let (x, (force, w, dashpot)) = (state[0], self.force_and_rate(state));
        let (gamma, n) = (self.law.elastic_exponent(), self.law.damping_exponent());
        let stretched = n * x.powf(n - 1.0) * w * w - x.powf(n) * (force - self.gravity);
        let rate = gamma * x.powf(gamma - 1.0) * w + self.damping * stretched;
        rate / (1.0 + self.lambda * dashpot)
    }

    /// Returns a function that is not positive when the contact is over; the power of x common to both parts of F is
    /// left out.
    fn margin(&self, end_rule: EndRule, state: State) -> f64 {
        let x = self.height(state[0]);
        if x <= 0.0 || end_rule == EndRule::ZeroOverlap || self.rebound.is_some() {
            return x;
        }
        let (gamma, n) = (self.law.elastic_exponent(), self.law.damping_exponent());
        let common = gamma.min(n);
        let dashpot = self.damping * x.powf(n - common) * self.rate(state);
        x.min(x.powf(gamma - common) + dashpot)
    }

    /// Returns whether motion, contact and weight have not enough energy, of the initial one, to part.
    fn is_stuck(&self, [x, v, ..]: State) -> bool {
        let energy = |stored: f64| v * v + 2.0 * stored - 2.0 * self.gravity * self.height(x);
        self.stored(x).is_some_and(|stored| energy(stored) < AT_REST * AT_REST)
    }

    /// Returns the rates by the clock s.
    fn rates(&self, state: &State) -> State {
        let braking = self.braking;
        let near = self.height(state[0]).max(0.0) + UNRESOLVED * braking;
        let (force, w, dashpot) = self.force_and_rate(*state);
        let pace = braking * near / (near + braking * w * w);
        let slowing = force - self.gravity;
        let (taken, bending) = (dashpot * w * w, self.lambda * force * force);
        [pace * w, -pace * slowing, pace, pace * taken, pace * bending]
    }

    /// Returns the collision.
    ///
    /// # Errors
    /// A creep too long to follow.
    pub fn collide(mut self, end_rule: EndRule, tolerance: f64) -> Result<Impact, LawError> {
        // Errors add up over some hundred steps.
        let (local, braking) = (1e-2 * tolerance, self.braking);
        let mut integrator = Integrator {
            tolerance: local,
            absolute: [local * braking, local, local * braking, local, local],
            longest_step: LONGEST_STEP,
            step: 0.1,
            n_left: MAX_STEPS,
        };
        let (mut from, mut stored): (State, f64) = ([0.0, 1.0, 0.0, 0.0, 0.0], 0.0);
        let mut impact = Impact::default();
        self.record(&mut impact, from, stored);
        loop {
            let Some((mut to, step)) = integrator.advance(&from, |state| self.rates(state)) else {
                let (model, time) = ("contact law", from[2] * self.time);
                return Err(LawError::NotFinished { model, n_steps: MAX_STEPS, time });
            };
            let widest = self.note_extremes(&mut impact, (&from, &to, step));
            let rates = [self.rate(from), self.rate(to)];
            if rates[1] < 0.0 && !self.is_denting() && self.margin(end_rule, to) <= 0.0 {
                let margin = |state| self.margin(end_rule, state);
                let end = self.before_fall((&from, &to, step), margin).unwrap_or(to);
                self.record(&mut impact, end, self.stored(end[0]).unwrap_or_default());
                return Ok(impact.parted(-end[1], end[2] * self.time));
            }
            if self.is_denting() {
                to = widest.unwrap_or(to);
                stored = self.dent(from[0], &mut to, stored, widest.is_some());
            } else {
                stored = self.stored(to[0]).unwrap_or_default();
            }
            self.record(&mut impact, to, stored);
            let turns_back = self.gravity > 0.0 && rates[0] < 0.0 && rates[1] >= 0.0;
            let sinks = widest.is_some() && self.lambda >= SINKING_LAMBDA;
            if sinks {
                impact.max_approach = self.lambda * self.length;
            }
            if self.is_stuck(to) || turns_back || sinks {
                return Ok(impact);
            }
            from = to;
        }
    }

    /// Returns the state in a step of the clock at which a value falls through 0, if it does.
    fn before_fall(
        &self,
        (from, to, step): (&State, &State, f64),
        value: impl Fn(State) -> f64,
    ) -> Option<State> {
        let after = |part: f64| match part > 0.0 {
            true => after_step(from, part, |state| self.rates(state)),
            false => *from,
        };
        let falls = value(*from) > 0.0 && value(*to) <= 0.0;
        falls.then(|| after(falling_zero(0.0, step, |part| value(after(part)))))
    }

    /// Notes the turns of overlap, approach and force in a step of the clock, and returns that of the overlap.
    fn note_extremes(&self, impact: &mut Impact, step: (&State, &State, f64)) -> Option<State> {
        let widest = self.before_fall(step, |state| self.rate(state));
        // On a plate the overlap turns back before the approach does.
        let has_plate = self.lambda > 0.0;
        let turn = has_plate.then(|| self.before_fall(step, |state| state[1])).flatten();
        let is_law = self.law.elastic_plastic().is_none();
        let top = is_law.then(|| self.before_fall(step, |state| self.force_rate(state))).flatten();
        for state in [widest, turn, top].into_iter().flatten() {
            self.note(impact, state);
        }
        widest
    }

    /// Returns the energy that a rebound would return after the loading from an overlap at which this was `stored`, and puts what it
    /// would not into the state; the loading `ends` there or goes on.
    fn dent(&mut self, from: f64, state: &mut State, stored: f64, ends: bool) -> f64 {
        let (Some(dent), (_, unit)) = (self.law.elastic_plastic(), self.force_and_energy()) else {
            return stored;
        };
        let [from, to] = [from, state[0]].map(|x| x * self.length);
        let work = (stored + state[3]) * unit + self.law.loading_work(from, to);
        let rebound = self.law.rebound(dent, to, work);
        let returned = rebound.energy_at(rebound.length);
        state[3] = (work - returned) / unit;
        if ends {
            self.rebound = Some((rebound, state[0] - rebound.length / self.length));
        }
        returned / unit
    }

    /// Returns the contact radius, m.
    fn contact_radius(&self, x: f64) -> f64 {
        let (overlap, height) = (x.max(0.0) * self.length, self.height(x).max(0.0) * self.length);
        match (self.law.elastic_plastic(), self.rebound) {
            (None, _) => (self.pair.effective_radius() * overlap).sqrt(),
            (Some(dent), None) => dent.contact_radius(overlap),
            (Some(dent), Some((rebound, lowest))) => {
                let deepest = lowest * self.length + rebound.length;
                dent.contact_radius(deepest) * (height / rebound.length).sqrt()
            }
        }
    }

    /// Updates the extremes only.
    fn note(&self, impact: &mut Impact, state: State) {
        let force = self.force_and_rate(state).0 * self.force_and_energy().0;
        impact.peak_force = impact.peak_force.max(force);
        impact.max_approach = impact.max_approach.max(self.approach(state) * self.length);
        impact.max_contact_radius = impact.max_contact_radius.max(self.contact_radius(state[0]));
    }

    fn record(&self, impact: &mut Impact, state: State, stored: f64) {
        self.note(impact, state);
        let (force, energy) = self.force_and_energy();
        let [x, v, t, lost, plate] = state;
        impact.history.push(ImpactInstant {
            time: t * self.time,
            approach: self.approach(state) * self.length,
            approach_rate: v * self.speed,
            force: self.force_and_rate(state).0 * force,
            contact_radius: self.contact_radius(x),
            centre_pressure: None,
            work: energy * stored + energy * lost + energy * plate,
            strain_energy: Some(energy * stored),
            dissipated: Some(energy * lost),
            radiated: None,
            plate: (self.lambda > 0.0).then_some(energy * plate),
        });
    }
}
