//! A collision with a law that dents on a thin plate, integrated in time.
//!
//! With the mobility β of the plate ([`crate::plate_mobility`]) in series the contact's own approach x and the rate V of the
//! whole approach follow
//!
//! ```math
//! \dot x = V - \beta F(x), \qquad \dot V = g - F(x)/m^*,
//! ```
//!
//! where F is the loading up to the largest x and the rebound from there. Both are integrated by the classical Runge–Kutta
//! method with equal steps, short against the time of the elastic contact and that of the plate; a step that passes an end is
//! shortened. The kink of the force at first yield leaves an error of about 1e-7. Without a plate [`crate::dent_impact`] needs
//! no steps.

use std::f64::consts::PI;

use crate::error::{LawError, positive};
use crate::impact::{Impact, ImpactInstant, ImpactQuantities, restitution};
use crate::laws::{ContactLaw, ElasticPlastic};
use crate::numerics::bisection::falling_zero;
use crate::pair::Pair;

/// Steps per unit of time of the elastic contact, which lasts about three of them.
const STEPS_PER_UNIT: f64 = 400.0;
/// The same for quantities without a history.
const FEW_STEPS_PER_UNIT: f64 = 50.0;
/// Steps per instant of the history.
const STEPS_PER_INSTANT: usize = 8;
const MAX_STEPS: usize = 1_000_000;
/// λ from which a ball sinks in with the plate. Without a dent its restitution would be 7e-6 here, and the equal steps of a
/// whole motion would be too many.
const SINKING_LAMBDA_OF_DENTS: f64 = 10.0;
/// Energy over the initial one below which the bodies stay together.
const STUCK: f64 = 1e-16;

/// Own approach x, m, rate V of the approach, m/s, and the energy in the plate, J.
type State = [f64; 3];

/// The constants of the motion.
struct Motion {
    mass: f64,
    mobility: f64,
    gravity: f64,
}

impl Motion {
    fn rates(&self, [_, v, _]: State, force: f64) -> State {
        let bending = self.mobility * force;
        [v - bending, self.gravity - force / self.mass, bending * force]
    }

    /// Returns the state after a time step, s, under a force, N, as a function of x.
    fn step(&self, from: State, time: f64, force: impl Fn(f64) -> f64) -> State {
        let rates = |state: State| self.rates(state, force(state[0].max(0.0)));
        let at = |share: f64, rate: State| -> State {
            std::array::from_fn(|i| from[i] + share * time * rate[i])
        };
        let a = rates(from);
        let b = rates(at(0.5, a));
        let c = rates(at(0.5, b));
        let d = rates(at(1.0, c));
        std::array::from_fn(|i| from[i] + time / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]))
    }
}

/// Returns the collision at an approach speed, m/s, on a plate of a mobility, m/(N s), with gravity along the approach, m/s².
///
/// # Errors
/// A result that leaves the range of f64; a motion that does not end.
pub(crate) fn collide(
    pair: &Pair,
    law: (&ContactLaw, &ElasticPlastic),
    plate_and_gravity: (f64, f64),
    speed: f64,
) -> Result<Impact, LawError> {
    in_steps(STEPS_PER_UNIT, pair, law, plate_and_gravity, speed)
}

/// Returns the quantities of the collision without gravity, to about 1e-4. The pressure is the mean one.
///
/// # Errors
/// Those of [`collide`].
pub(crate) fn quantities(
    pair: &Pair,
    law: (&ContactLaw, &ElasticPlastic),
    mobility: f64,
    speed: f64,
) -> Result<ImpactQuantities, LawError> {
    let impact = in_steps(FEW_STEPS_PER_UNIT, pair, law, (mobility, 0.0), speed)?;
    Ok(impact.quantities(impact.peak_force / (PI * impact.max_contact_radius.powi(2))))
}

/// Returns the collision in these steps per unit of time of the elastic contact.
fn in_steps(
    steps_per_unit: f64,
    pair: &Pair,
    (law, dent): (&ContactLaw, &ElasticPlastic),
    (mobility, gravity): (f64, f64),
    speed: f64,
) -> Result<Impact, LawError> {
    let mass = pair.effective_mass();
    let inverse = (law.elastic_exponent() + 1.0).recip();
    let length = (mass / law.stiffness()).powf(inverse) * speed.powf(2.0 * inverse);
    let unit = positive("contact law contact_time", length / speed)?;
    let lambda = mobility * mass / unit;
    let time_step = unit / (steps_per_unit * (1.0 + lambda));
    let motion = Motion { mass, mobility, gravity };
    let not_finished =
        |time| LawError::NotFinished { model: "contact law", n_steps: MAX_STEPS, time };

    let (mut state, mut time, mut work): (State, f64, f64) = ([0.0, speed, 0.0], 0.0, 0.0);
    let first = ImpactInstant::first_touch(speed, false, true);
    let mut history = vec![ImpactInstant { plate: Some(0.0), ..first }];
    let deflection =
        |state: State, time: f64| mobility * mass * (speed + gravity * time - state[1]);
    let instant = |state: State, time: f64, force: f64, [kept, lost]: [f64; 2]| ImpactInstant {
        time,
        approach: state[0] + deflection(state, time),
        approach_rate: state[1],
        force,
        work: kept + lost + state[2],
        strain_energy: Some(kept),
        dissipated: Some(lost),
        plate: Some(state[2]),
        ..first
    };

    let loading = |x: f64| law.loading_force(x);
    let mut n_steps = 0;
    let rebound = loop {
        n_steps += 1;
        let growth = |state: State| motion.rates(state, loading(state[0]))[0];
        let mut part = time_step;
        let mut next = motion.step(state, part, loading);
        let turns = growth(next) <= 0.0;
        if turns {
            part = falling_zero(0.0, time_step, |part| growth(motion.step(state, part, loading)));
            next = motion.step(state, part, loading);
        }
        if n_steps > MAX_STEPS || !next[0].is_finite() {
            return Err(not_finished(time));
        }
        work += law.loading_work(state[0], next[0]);
        (state, time) = (next, time + part);
        if turns || n_steps % STEPS_PER_INSTANT == 0 {
            let rebound = law.rebound(dent, state[0], work);
            let kept = rebound.energy_at(rebound.length);
            let radius = dent.contact_radius(state[0]);
            let now = instant(state, time, loading(state[0]), [kept, work - kept]);
            history.push(ImpactInstant { contact_radius: radius, ..now });
            if turns {
                break rebound;
            }
        }
    };
    let (peak_force, deepest) = (positive("contact law peak_force", rebound.force)?, state[0]);
    let max_contact_radius = dent.contact_radius(deepest);
    let lost = work - rebound.energy_at(rebound.length);
    let height = |state: State| state[0] - (deepest - rebound.length);
    let unloading = |x: f64| rebound.force_at(x - (deepest - rebound.length));
    let energy =
        |state: State| 0.5 * mass * state[1] * state[1] + rebound.energy_at(height(state).max(0.0));
    let mut has_receded = false;
    let end = loop {
        n_steps += 1;
        let mut part = time_step;
        let mut next = motion.step(state, part, unloading);
        let is_over = height(next) <= 0.0;
        if is_over {
            part = falling_zero(0.0, time_step, |part| height(motion.step(state, part, unloading)));
            next = motion.step(state, part, unloading);
        }
        if n_steps > MAX_STEPS || !next[0].is_finite() {
            return Err(not_finished(time));
        }
        (state, time) = (next, time + part);
        let growth = motion.rates(state, unloading(state[0]))[0];
        let stays = has_receded && growth >= 0.0 && gravity > 0.0
            || lambda >= SINKING_LAMBDA_OF_DENTS
            || energy(state) < STUCK * 0.5 * mass * speed * speed;
        has_receded |= growth < 0.0;
        let ends = is_over || stays;
        if ends || n_steps % STEPS_PER_INSTANT == 0 {
            let left = if is_over { 0.0 } else { height(state).max(0.0) };
            let force = rebound.force_at(left);
            let now = instant(state, time, force, [rebound.energy_at(left), lost]);
            let radius = max_contact_radius * (left / rebound.length).sqrt();
            history.push(ImpactInstant { contact_radius: radius, ..now });
        }
        if ends {
            break is_over.then_some(state[1]);
        }
    };
    let sunk = if lambda >= SINKING_LAMBDA_OF_DENTS { mobility * mass * speed } else { 0.0 };
    Ok(Impact {
        restitution: restitution(end, speed),
        contact_time: end.map(|_| time),
        peak_force,
        max_approach: history.iter().map(|now| now.approach).fold(sunk, f64::max),
        max_contact_radius,
        peak_pressure: None,
        history,
    })
}
