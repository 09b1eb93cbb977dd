//! A collision with a contact law, integrated in time; [`crate::dent_impact`] does it for laws that dent.
//!
//! ```math
//! m^*\ddot\xi = -F(\xi,\dot\xi), \qquad \xi(0) = 0, \quad \dot\xi(0) = v
//! ```
//!
//! In units of the length ℓ = (m*v²/K)^(1/(γ+1)) and the time ℓ/v one number is left:
//!
//! ```math
//! \ddot x = -x^\gamma - c\,x^n\dot x, \qquad c = \frac{C\,\ell^{n+1}}{m^*v}.
//! ```
//!
//! The integrator is the Runge–Kutta method of order 8 of Dormand & Prince (crate
//! `differential-equations`); turn, largest force and end of contact are located with steps of their
//! own, since its dense output is good to 1e-8 only. Neither x^γ nor xⁿ ẋ need be smooth at x = 0, where a collision
//! begins and may end, so the clock s of the integration slows down there,
//!
//! ```math
//! \frac{\mathrm dt}{\mathrm ds} = b\,\frac{x+\varepsilon b}{x+\varepsilon b+b\dot x^2},
//! ```
//!
//! which makes x change by a constant factor a step while ẋ is large, and leaves a creep alone; b ≤ 1 is
//! the overlap at which the dashpot alone would stop the motion. Gravity adds g ℓ/v² to ẍ; a ball that
//! turns back while it touches, or whose energy does not lift it to x = 0 any more, stays. The dissipated
//! energy ∫c xⁿ ẋ² dt is integrated along.
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

use differential_equations::control::ControlFlag;
use differential_equations::interpolate::Interpolation;
use differential_equations::methods::{DormandPrince, ExplicitRungeKutta, Ordinary};
use differential_equations::ode::{ODE, solve_ode};
use differential_equations::solout::Solout;
use differential_equations::solution::Solution;

use crate::dent_impact;
use crate::dent_on_plate;
use crate::error::{LawError, not_negative, positive, tolerance as checked_tolerance};
use crate::impact::{Impact, ImpactInstant, restitution};
use crate::laws::{ContactLaw, EndRule};
use crate::numerics::bisection::falling_zero;
use crate::pair::Pair;
use crate::plate::SINKING_LAMBDA;

/// A pair with a contact law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawImpact {
    pair: Pair,
    law: ContactLaw,
    end_rule: EndRule,
    tolerance: f64,
    /// Gravity along the approach, m/s².
    gravity: f64,
    /// Mobility of a thin plate in series, m/(N s); 0 without a plate.
    plate_mobility: f64,
}

/// Relative energy below which nothing comes back: restitutions below 1e-8.
const STUCK: f64 = 1e-16;

const MAX_STEPS: usize = 100_000;

/// Steps of the clock stay short, so that neither turn nor largest force is stepped over twice.
const LONGEST_STEP: f64 = 0.5;

/// ε: what happens below this overlap, of 1, is not resolved; it is worth ε^(n+1) of the rate.
const UNRESOLVED: f64 = 1e-9;

impl LawImpact {
    /// Accuracy of restitution, time and force that [`LawImpact::new`] asks for.
    pub const DEFAULT_TOLERANCE: f64 = 1e-8;

    /// Creates a model that ends at zero force, with the default tolerance.
    pub fn new(pair: &Pair, law: ContactLaw) -> Self {
        let (end_rule, tolerance) = (EndRule::default(), Self::DEFAULT_TOLERANCE);
        Self { pair: *pair, law, end_rule, tolerance, gravity: 0.0, plate_mobility: 0.0 }
    }

    /// Sets the rule for the end of contact.
    pub fn with_end_rule(self, end_rule: EndRule) -> Self {
        Self { end_rule, ..self }
    }

    /// Sets the tolerance, 1e-10 to 1e-2.
    ///
    /// # Errors
    /// A tolerance outside.
    pub fn with_tolerance(self, tolerance: f64) -> Result<Self, LawError> {
        Ok(Self { tolerance: checked_tolerance(tolerance)?, ..self })
    }

    /// Adds gravity along the approach (m/s²), on a ball above a body that does not move.
    ///
    /// # Errors
    /// An acceleration that is negative or not finite.
    pub fn with_gravity(self, acceleration: f64) -> Result<Self, LawError> {
        Ok(Self { gravity: not_negative("gravity", acceleration)?, ..self })
    }

    /// Puts a thin plate in series with the contact, given by its mobility, m/(N s); see [`crate::plate_mobility`].
    ///
    /// # Errors
    /// A mobility that is not positive and finite.
    pub fn with_plate(self, mobility: f64) -> Result<Self, LawError> {
        Ok(Self { plate_mobility: positive("plate mobility", mobility)?, ..self })
    }

    /// Returns the collision at an approach speed, m/s.
    ///
    /// # Errors
    /// A speed that is not positive and finite; values so extreme that a result leaves the range
    /// of f64; a creep too long to follow.
    pub fn impact(&self, approach_speed: f64) -> Result<Impact, LawError> {
        let speed = positive("approach_speed", approach_speed)?;
        if let Some(dent) = self.law.elastic_plastic() {
            let law = (&self.law, dent);
            return match self.plate_mobility > 0.0 {
                true => dent_on_plate::collide(
                    &self.pair,
                    law,
                    (self.plate_mobility, self.gravity),
                    speed,
                ),
                false => dent_impact::collide(&self.pair, law, self.gravity, speed),
            };
        }
        let (mass, law) = (self.pair.effective_mass(), &self.law);
        let (gamma, n) = (law.elastic_exponent(), law.damping_exponent());
        // The powers are taken apart so that v² cannot leave the range of f64.
        let inverse = (gamma + 1.0).recip();
        let length = (mass / law.stiffness()).powf(inverse) * speed.powf(2.0 * inverse);
        let length = positive("contact law approach", length)?;
        let time = positive("contact law contact_time", length / speed)?;
        let force = positive("contact law peak_force", mass * speed / time)?;
        let damping = law.damping() * (length.powf(n) * time / mass);
        if !damping.is_finite() {
            return Err(LawError::NotPositive { quantity: "contact law damping", value: damping });
        }
        let has_plate = self.plate_mobility > 0.0;
        let lambda = self.plate_mobility * force / speed;
        let gravity = self.gravity * time / speed;
        let oscillator = Oscillator { gamma, n, damping, gravity, lambda };
        let outcome = oscillator.collide(self.end_rule, self.tolerance).map_err(|reached| {
            let (model, n_steps) = ("contact law", MAX_STEPS);
            LawError::NotFinished { model, n_steps, time: reached * time }
        })?;
        let radius = self.pair.effective_radius();
        let contact_radius = |overlap: f64| (radius * (overlap.max(0.0) * length)).sqrt();
        let energy = mass * speed * speed;
        let history = outcome.history.iter().map(|(state, f)| {
            let [x, v, t, lost, plate] = state;
            let strain_energy = energy * (x.max(0.0).powf(gamma + 1.0) / (gamma + 1.0));
            ImpactInstant {
                time: t * time,
                approach: oscillator.approach(*state) * length,
                approach_rate: v * speed,
                force: f * force,
                contact_radius: contact_radius(*x),
                centre_pressure: None,
                work: strain_energy + energy * lost + energy * plate,
                strain_energy: Some(strain_energy),
                dissipated: Some(energy * lost),
                radiated: None,
                plate: has_plate.then_some(energy * plate),
            }
        });
        Ok(Impact {
            restitution: restitution(outcome.end.map(|[_, v, ..]| v), 1.0),
            contact_time: outcome.end.map(|[_, _, t, ..]| t * time),
            peak_force: outcome.peak_force * force,
            max_approach: outcome.max_approach * length,
            max_contact_radius: contact_radius(outcome.max_overlap),
            peak_pressure: None,
            history: history.collect(),
        })
    }
}

/// V̇ = gravity − x^γ − c xⁿ ẋ, ẋ = V − λ F.
struct Oscillator {
    gamma: f64,
    n: f64,
    damping: f64,
    gravity: f64,
    /// λ of a plate; 0 without one.
    lambda: f64,
}

/// Overlap x, rate V of the approach, t, and what the dashpot and the plate have taken.
type State = [f64; 5];

impl Oscillator {
    /// Returns the force. The spring continues as an odd function, the dashpot as an even one, below x = 0, where only
    /// trial states of the integrator lie.
    fn force(&self, state: State) -> f64 {
        let [x, ..] = state;
        self.spring(x) + self.damping * x.abs().powf(self.n) * self.rate(state)
    }

    fn spring(&self, x: f64) -> f64 {
        x.abs().powf(self.gamma).copysign(x)
    }

    /// Returns 1 + λ c xⁿ.
    fn sharing(&self, x: f64) -> f64 {
        1.0 + self.lambda * self.damping * x.abs().powf(self.n)
    }

    /// Returns the rate ẋ of the overlap.
    fn rate(&self, [x, v, ..]: State) -> f64 {
        match self.lambda > 0.0 {
            true => (v - self.lambda * self.spring(x)) / self.sharing(x),
            false => v,
        }
    }

    /// Returns the approach: the overlap and the deflection of the plate, λ times the impulse.
    fn approach(&self, [x, v, t, ..]: State) -> f64 {
        x + self.lambda * (1.0 + self.gravity * t - v)
    }

    /// Returns dF/dt at x > 0.
    fn force_rate(&self, state: State) -> f64 {
        let (x, w) = (state[0], self.rate(state));
        let slowing = self.force(state) - self.gravity;
        let stretched = self.n * x.powf(self.n - 1.0) * w * w - x.powf(self.n) * slowing;
        (self.gamma * x.powf(self.gamma - 1.0) * w + self.damping * stretched) / self.sharing(x)
    }

    /// Returns a function that is not positive when the contact is over; the power of x common to both parts of F is
    /// left out.
    fn margin(&self, end_rule: EndRule, state: State) -> f64 {
        let (x, w) = (state[0], self.rate(state));
        let common = self.gamma.min(self.n);
        match end_rule {
            EndRule::ZeroOverlap => x,
            EndRule::ZeroForce if x <= 0.0 => x,
            EndRule::ZeroForce => {
                let dashpot = self.damping * x.powf(self.n - common) * w;
                x.min(x.powf(self.gamma - common) + dashpot)
            }
        }
    }

    /// Returns the energy of motion, spring and weight over the initial energy.
    fn energy(&self, [x, v, ..]: State) -> f64 {
        v * v + 2.0 / (self.gamma + 1.0) * x.abs().powf(self.gamma + 1.0) - 2.0 * self.gravity * x
    }

    /// Returns b: braking by the dashpot alone, dẋ = −c xⁿ dx, stops at c xⁿ⁺¹ = n + 1.
    fn braking_overlap(&self) -> f64 {
        if self.damping > 0.0 {
            ((self.n + 1.0) / self.damping).powf((self.n + 1.0).recip()).min(1.0)
        } else {
            1.0
        }
    }

    /// Computes the collision; `Err` has the time reached.
    fn collide(&self, end_rule: EndRule, tolerance: f64) -> Result<Outcome, f64> {
        let braking = self.braking_overlap();
        // Errors add up over some hundred steps.
        let local = 1e-2 * tolerance;
        let method = ExplicitRungeKutta::dop853()
            .rtol(local)
            .atol([local * braking, local, local * braking, local, local])
            .h_max(LONGEST_STEP)
            .max_steps(MAX_STEPS);
        let motion = Motion { oscillator: self, braking };
        let outcome = Outcome::default();
        let mut watch = Watch { motion: &motion, method: method.clone(), end_rule, outcome };
        // Beyond what MAX_STEPS of LONGEST_STEP reach.
        let horizon = MAX_STEPS as f64;
        let start = [0.0, 1.0, 0.0, 0.0, 0.0];
        match solve_ode(&mut method.h0(0.1), &motion, 0.0, horizon, &start, &mut watch) {
            Ok(_) => Ok(watch.outcome),
            Err(_) => Err(watch.outcome.history.last().map_or(0.0, |(state, _)| state[2])),
        }
    }
}

/// The motion by the clock s.
struct Motion<'a> {
    oscillator: &'a Oscillator,
    braking: f64,
}

impl ODE<f64, State> for Motion<'_> {
    fn diff(&self, _clock: f64, state: &State, rate: &mut State) {
        let overlap = state[0].max(0.0);
        let near = overlap + UNRESOLVED * self.braking;
        let Oscillator { n, damping, gravity, lambda, .. } = self.oscillator;
        let (force, w) = (self.oscillator.force(*state), self.oscillator.rate(*state));
        let pace = self.braking * near / (near + self.braking * w * w);
        let slowing = force - gravity;
        let taken = damping * state[0].abs().powf(*n) * w * w;
        let bending = lambda * force * force;
        *rate = [pace * w, -pace * slowing, pace, pace * taken, pace * bending];
    }
}

/// Result of a dimensionless collision.
#[derive(Debug, Default)]
struct Outcome {
    /// At the end of contact.
    end: Option<State>,
    peak_force: f64,
    max_approach: f64,
    max_overlap: f64,
    /// With the force.
    history: Vec<(State, f64)>,
}

type Method = ExplicitRungeKutta<Ordinary, DormandPrince, f64, State, 8, 12, 16>;

/// Looks at every step for the end of contact, the turn and the extremes.
struct Watch<'a> {
    motion: &'a Motion<'a>,
    method: Method,
    end_rule: EndRule,
    outcome: Outcome,
}

/// Keeps the last state of an integration.
struct Last(State);

impl Watch<'_> {
    /// Returns the state a part of a step after `from`, by a separate step.
    fn after(&self, from: &State, part: f64) -> State {
        let mut last = Last(*from);
        if part > 0.0 {
            let mut method = self.method.clone().h0(part);
            // A part of an accepted step; should it fail all the same, the last state stands.
            let _ = solve_ode(&mut method, self.motion, 0.0, part, from, &mut last);
        }
        last.0
    }

    /// Returns the largest part, up to `end`, of a step from `from` before `value` falls through 0, if it
    /// does.
    fn before_fall(&self, from: &State, end: f64, value: impl Fn(State) -> f64) -> Option<State> {
        let falls = value(*from) > 0.0 && value(self.after(from, end)) <= 0.0;
        falls
            .then(|| self.after(from, falling_zero(0.0, end, |part| value(self.after(from, part)))))
    }

    fn record(&mut self, state: State) {
        self.note(state);
        self.outcome.history.push((state, self.motion.oscillator.force(state)));
    }

    /// Updates the extremes only.
    fn note(&mut self, state: State) {
        let force = self.motion.oscillator.force(state);
        self.outcome.peak_force = self.outcome.peak_force.max(force);
        let approach = self.motion.oscillator.approach(state);
        self.outcome.max_approach = self.outcome.max_approach.max(approach);
        self.outcome.max_overlap = self.outcome.max_overlap.max(state[0]);
    }
}

impl Solout<f64, State> for Watch<'_> {
    fn solout<I>(
        &mut self,
        clock: f64,
        previous_clock: f64,
        state: &State,
        previous: &State,
        _interpolator: &mut I,
        _solution: &mut Solution<f64, State>,
    ) -> ControlFlag<f64, State>
    where
        I: Interpolation<f64, State> + ?Sized,
    {
        if clock == previous_clock {
            self.record(*state);
            return ControlFlag::Continue;
        }
        let (oscillator, end_rule) = (self.motion.oscillator, self.end_rule);
        let step = clock - previous_clock;
        let turns = previous[1] > 0.0 && state[1] <= 0.0;
        if turns && let Some(turn) = self.before_fall(previous, step, |state| state[1]) {
            self.note(turn);
        }
        // On a plate the overlap turns back before the approach does.
        let rates = [previous, state].map(|state| oscillator.rate(*state));
        let is_widest = oscillator.lambda > 0.0 && rates[0] > 0.0 && rates[1] <= 0.0;
        if is_widest && let Some(widest) = self.before_fall(previous, step, |s| oscillator.rate(s))
        {
            self.note(widest);
        }
        let passes = oscillator.force_rate(*previous) > 0.0 && oscillator.force_rate(*state) <= 0.0;
        if passes && let Some(top) = self.before_fall(previous, step, |s| oscillator.force_rate(s))
        {
            self.note(top);
        }
        if rates[1] < 0.0 && oscillator.margin(end_rule, *state) <= 0.0 {
            let end = self.before_fall(previous, step, |state| oscillator.margin(end_rule, state));
            let end = end.unwrap_or(*state);
            self.record(end);
            self.outcome.end = Some(end);
            return ControlFlag::Terminate;
        }
        self.record(*state);
        let turns_back = oscillator.gravity > 0.0 && rates[0] < 0.0 && rates[1] >= 0.0;
        let sinks = is_widest && oscillator.lambda >= SINKING_LAMBDA;
        if sinks {
            self.outcome.max_approach = oscillator.lambda;
        }
        if oscillator.energy(*state) < STUCK || turns_back || sinks {
            ControlFlag::Terminate
        } else {
            ControlFlag::Continue
        }
    }
}

impl Solout<f64, State> for Last {
    fn solout<I>(
        &mut self,
        _clock: f64,
        _previous_clock: f64,
        state: &State,
        _previous: &State,
        _interpolator: &mut I,
        _solution: &mut Solution<f64, State>,
    ) -> ControlFlag<f64, State>
    where
        I: Interpolation<f64, State> + ?Sized,
    {
        self.0 = *state;
        ControlFlag::Continue
    }
}
