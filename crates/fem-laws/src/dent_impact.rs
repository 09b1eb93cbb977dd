//! A collision with a law that dents, by quadrature.
//!
//! The force depends on the approach alone, during the loading and during the rebound from the largest approach δ_m. So
//! the speed at each δ follows from the work between δ and δ_m,
//!
//! ```math
//! \tfrac12m^*\dot\delta^2 = \int_\delta^{\delta_m}(F-m^*g)\,\mathrm d\delta, \qquad
//! t = \int\frac{\mathrm d\delta}{|\dot\delta|},
//! ```
//!
//! and δ = δ_m − ℓ sin² θ over the length ℓ of a branch removes the roots at both of its ends. Both integrals are sums over
//! panels in θ, with five points each; first yield is the end of a panel. The error is about 1e-10, and 1e-8 where the slope of a law jumps elsewhere. With gravity g a ball whose rebound does
//! not lift it out of its dent stays there.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::error::{LawError, positive};
use crate::impact::{Impact, ImpactInstant, ImpactQuantities};
use crate::laws::{ContactLaw, ElasticPlastic, Rebound};
use crate::numerics::bisection::falling_zero;
use crate::numerics::gauss;
use crate::pair::Pair;

/// Panels of each smooth part of a branch, for a history and for the contact time alone.
const PANELS: usize = 60;
const FEW_PANELS: usize = 8;
/// Ratio of the ends of the panels in which the largest approach is sought.
const PANEL_RATIO: f64 = 2.0;

/// A place on a branch: the distance from the turn, m, the speed, m/s, and the time between both, s.
type Place = (f64, f64, f64);

/// Returns the collision at an approach speed, m/s, with gravity along the approach, m/s².
///
/// # Errors
/// A result that leaves the range of f64.
pub(crate) fn collide(
    pair: &Pair,
    (law, dent): (&ContactLaw, &ElasticPlastic),
    gravity: f64,
    speed: f64,
) -> Result<Impact, LawError> {
    let mass = pair.effective_mass();
    let energy = positive("contact law energy", 0.5 * mass * speed * speed)?;
    let (turn, work) = turn(law, dent, mass * gravity, energy)?;
    let rebound = law.rebound(dent, turn, work);
    let peak_force = positive("contact law peak_force", rebound.force)?;

    let yields = dent.yield_approach();
    let ends = [if yields < turn { turn - yields } else { 0.0 }, turn];
    let loading =
        branch(mass, gravity, (&ends, PANELS), |from_turn| law.loading_force(turn - from_turn));
    let height = |from_turn: f64| rebound.length - from_turn;
    let unloading = branch(mass, gravity, (&[rebound.length], PANELS), |from_turn| {
        rebound.force_at(height(from_turn))
    });
    let is_over = unloading.last().is_some_and(|(from_turn, ..)| *from_turn == rebound.length);
    let closing_time = loading.last().map_or(0.0, |(.., time)| *time);

    let radius = |approach: f64| dent.contact_radius(approach);
    let mut history: Vec<ImpactInstant> = Vec::with_capacity(loading.len() + unloading.len());
    let (mut approach, mut work) = (0.0, 0.0);
    for &(from_turn, rate, to_turn) in loading.iter().rev() {
        let from = std::mem::replace(&mut approach, turn - from_turn);
        work += law.loading_work(from, approach);
        let kept = match approach > 0.0 {
            true => recoverable(&law.rebound(dent, approach, work)),
            false => 0.0,
        };
        history.push(ImpactInstant {
            time: closing_time - to_turn,
            approach,
            approach_rate: rate,
            force: law.loading_force(approach),
            contact_radius: radius(approach),
            work,
            strain_energy: Some(kept),
            dissipated: Some(work - kept),
            ..ImpactInstant::first_touch(speed, false, true)
        });
    }
    let lost = work - recoverable(&rebound);
    for &(from_turn, rate, since_turn) in unloading.iter().skip(1) {
        let height = height(from_turn).max(0.0);
        let kept = rebound.energy_at(height);
        history.push(ImpactInstant {
            time: closing_time + since_turn,
            approach: turn - from_turn,
            approach_rate: -rate,
            force: rebound.force_at(height),
            contact_radius: radius(turn) * (height / rebound.length).sqrt(),
            work: kept + lost,
            strain_energy: Some(kept),
            dissipated: Some(lost),
            ..ImpactInstant::first_touch(speed, false, true)
        });
    }
    let end = history.last().filter(|_| is_over).copied();
    let (max_approach, max_contact_radius) = (turn, radius(turn));
    let impact =
        Impact { peak_force, max_approach, max_contact_radius, history, ..Impact::default() };
    Ok(match end {
        Some(end) => impact.parted(-end.approach_rate / speed, end.time),
        None => impact,
    })
}

/// Returns the quantities of the collision at an approach speed, m/s, without gravity; the contact time to about 1e-5. The
/// pressure is the mean one.
///
/// # Errors
/// A result that leaves the range of f64.
pub(crate) fn quantities(
    pair: &Pair,
    (law, dent): (&ContactLaw, &ElasticPlastic),
    speed: f64,
) -> Result<ImpactQuantities, LawError> {
    let mass = pair.effective_mass();
    let energy = positive("contact law energy", 0.5 * mass * speed * speed)?;
    let (turn, work) = turn(law, dent, 0.0, energy)?;
    let rebound = law.rebound(dent, turn, work);
    let yields = dent.yield_approach();
    let ends = [if yields < turn { turn - yields } else { 0.0 }, turn];
    let end = [rebound.length];
    let branches = [
        branch(mass, 0.0, (&ends, FEW_PANELS), |from_turn| law.loading_force(turn - from_turn)),
        branch(mass, 0.0, (&end, FEW_PANELS), |from_turn| rebound.force_at(end[0] - from_turn)),
    ];
    let radius = dent.contact_radius(turn);
    Ok(ImpactQuantities {
        restitution: (recoverable(&rebound) / energy).sqrt(),
        contact_time: branches.iter().filter_map(|places| Some(places.last()?.2)).sum(),
        peak_force: positive("contact law peak_force", rebound.force)?,
        max_approach: turn,
        max_contact_radius: radius,
        peak_pressure: rebound.force / (PI * radius * radius),
    })
}

/// Returns the largest approach, m, and the work of the loading up to it, J, of bodies with a weight (N) and an energy (J).
fn turn(
    law: &ContactLaw,
    dent: &ElasticPlastic,
    weight: f64,
    energy: f64,
) -> Result<(f64, f64), LawError> {
    let missing = |approach: f64, work: f64| energy + weight * approach - work;
    let exponent = law.elastic_exponent() + 1.0;
    // First yield or what the elastic spring would reach, and then farther by panels until the motion has stopped.
    let elastic = (exponent * energy / law.stiffness()).powf(exponent.recip());
    let (mut near, mut work, mut far) = (0.0, 0.0, dent.yield_approach().min(elastic));
    loop {
        let more = law.loading_work(near, far);
        if missing(far, work + more) <= 0.0 {
            break;
        }
        (near, work) = (far, work + more);
        far *= PANEL_RATIO;
    }
    let work_to = |approach: f64| work + law.loading_work(near, approach);
    let turn = falling_zero(near, far, |approach| missing(approach, work_to(approach)));
    Ok((positive("contact law approach", turn)?, work_to(turn)))
}

/// Returns the energy that a rebound returns, J.
fn recoverable(rebound: &Rebound) -> f64 {
    rebound.energy_at(rebound.length)
}

/// Returns places from the turn on, up to the last of some distances from it, m, at which the force may bend. The force, N, is
/// a function of the distance. A branch that gravity stops ends there.
fn branch(
    mass: f64,
    gravity: f64,
    (ends, panels): (&[f64], usize),
    force: impl Fn(f64) -> f64,
) -> Vec<Place> {
    let length = ends.last().copied().unwrap_or_default();
    let net = |distance: f64| force(distance) - mass * gravity;
    let mut places = vec![(0.0, 0.0, 0.0)];
    let (mut angle, mut energy, mut time) = (0.0, 0.0, 0.0);
    let distance_at = |angle: f64| length * angle.sin().powi(2);
    let slope = |angle: f64| length * (2.0 * angle).sin();
    for &end in ends.iter().filter(|end| **end > 0.0) {
        let last = if end == length { FRAC_PI_2 } else { (end / length).sqrt().asin() };
        let (begin, width) = (angle, (last - angle) / panels as f64);
        for panel in 1..=panels {
            let next = if panel == panels { last } else { begin + width * panel as f64 };
            // ½mv² at an angle, from that at the beginning of the panel.
            let at = |to: f64| energy + gauss(angle, to, |x| slope(x) * net(distance_at(x)));
            let speed = |x: f64| (2.0 * at(x).max(0.0) / mass).sqrt();
            let step = gauss(angle, next, |x| slope(x) / speed(x));
            let reached = at(next);
            if !(reached > 0.0 && step.is_finite()) {
                return places;
            }
            (angle, energy, time) = (next, reached, time + step);
            let distance = if panel == panels { end } else { distance_at(next) };
            places.push((distance, (2.0 * energy / mass).sqrt(), time));
        }
    }
    places
}
