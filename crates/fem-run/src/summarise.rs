//! From a collision to its summary.

use std::time::{Duration, Instant};

use fem_case::Problem;
use fem_explicit::Collision;
use fem_laws::HertzImpact;

use crate::peak_memory::peak_memory;
use crate::summary::{BodySummary, CostSummary, Energy, PROGRAM, Quantities, Summary};

/// A single run uses one thread; several serve several runs.
const THREADS: usize = 1;

/// When the process began, and how long the time steps took.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    /// Start of the process.
    pub started: Instant,
    /// The run alone.
    pub solve: Duration,
}

/// Sums up a collision. `warnings` and `files` are those so far; numbers that are not finite become
/// `None` and another warning.
pub fn summarise(
    problem: &Problem,
    collision: &Collision,
    clock: Clock,
    warnings: Vec<String>,
    files: Vec<String>,
) -> Summary {
    let mut numbers = Numbers { warnings };
    let solve_s = clock.solve.as_secs_f64();
    let updates = collision.element_updates;
    Summary {
        collision: quantities(collision, &mut numbers),
        contact_episodes: collision.contact_episodes,
        hertz: hertz(&problem.plan.estimate.hertz, &mut numbers),
        energy: energy(collision, &mut numbers),
        momentum_residual_relative: numbers
            .finite("momentum_residual_relative", collision.momentum_residual_relative),
        bodies: [0, 1].map(|side| body(problem, collision, side, &mut numbers)).to_vec(),
        time_step_s: numbers.finite("time_step_s", problem.model.time_step()),
        steps: collision.steps,
        element_updates: updates,
        cost: CostSummary {
            wall_s: clock.started.elapsed().as_secs_f64(),
            solve_s,
            ns_per_element_update: (updates > 0).then(|| 1e9 * solve_s / updates as f64),
            threads: THREADS,
            peak_memory_bytes: peak_memory(),
        },
        effects: problem.effects(),
        complete: collision.stopped.is_none(),
        stopped_because: collision.stopped.as_ref().map(ToString::to_string),
        program: PROGRAM,
        version: env!("CARGO_PKG_VERSION"),
        files,
        case: problem.plan.resolve(&problem.case),
        warnings: numbers.warnings,
    }
}

/// Keeps numbers that are not finite out of the summary.
struct Numbers {
    warnings: Vec<String>,
}

impl Numbers {
    fn finite(&mut self, key: &str, value: f64) -> Option<f64> {
        if !value.is_finite() {
            self.warnings.push(format!("{key} is {value}, no number; it is left out"));
        }
        value.is_finite().then_some(value)
    }

    fn finite_if_any(&mut self, key: &str, value: Option<f64>) -> Option<f64> {
        value.and_then(|value| self.finite(key, value))
    }
}

fn quantities(collision: &Collision, numbers: &mut Numbers) -> Quantities {
    // A contact that was left before its end has no duration.
    let contact_time = match (&collision.stopped, collision.first_contact, collision.last_contact) {
        (None, Some(first), Some(last)) => Some(last - first),
        _ => None,
    };
    Quantities {
        restitution: numbers.finite_if_any("restitution", collision.restitution),
        contact_time_s: numbers.finite_if_any("contact_time_s", contact_time),
        peak_force_n: numbers.finite("peak_force_n", collision.peak_force),
        max_approach_m: numbers.finite("max_approach_m", collision.max_approach),
        max_contact_radius_m: numbers.finite("max_contact_radius_m", collision.max_contact_radius),
        peak_pressure_pa: numbers.finite("peak_pressure_pa", collision.peak_pressure),
    }
}

fn hertz(impact: &HertzImpact, numbers: &mut Numbers) -> Quantities {
    Quantities {
        restitution: Some(impact.restitution()),
        contact_time_s: numbers.finite("hertz.contact_time_s", impact.contact_time()),
        peak_force_n: numbers.finite("hertz.peak_force_n", impact.peak_force()),
        max_approach_m: numbers.finite("hertz.max_approach_m", impact.max_approach()),
        max_contact_radius_m: numbers
            .finite("hertz.max_contact_radius_m", impact.max_contact_radius()),
        peak_pressure_pa: numbers.finite("hertz.peak_pressure_pa", impact.peak_pressure()),
    }
}

fn energy(collision: &Collision, numbers: &mut Numbers) -> Energy {
    let last = collision.history.last();
    let mut at_end = |key: &str, value: Option<f64>| numbers.finite_if_any(key, value);
    Energy {
        initial_j: at_end("energy.initial_j", Some(collision.initial_energy)),
        kinetic_j: at_end("energy.kinetic_j", last.map(|row| row.kinetic)),
        strain_j: at_end("energy.strain_j", last.map(|row| row.strain)),
        contact_j: at_end("energy.contact_j", last.map(|row| row.contact)),
        viscous_dissipation_j: at_end(
            "energy.viscous_dissipation_j",
            last.map(|row| row.viscous_dissipation),
        ),
        wall_work_j: at_end("energy.wall_work_j", last.map(|row| row.wall_work)),
        residual_j: at_end("energy.residual_j", last.map(|row| row.residual)),
        residual_relative: at_end("energy.residual_relative", Some(collision.residual_relative)),
    }
}

fn body(
    problem: &Problem,
    collision: &Collision,
    side: usize,
    numbers: &mut Numbers,
) -> BodySummary {
    let (named, body) = (&problem.case.scene.bodies[side], &problem.model.bodies()[side]);
    let is_sphere = body.mesh().is_some();
    let of_sphere = |value: f64| is_sphere.then_some(value);
    let after = collision.stopped.is_none().then_some(collision.velocity_after[side]);
    let vibration = collision.vibration_energy.filter(|_| is_sphere).map(|energy| energy[side]);
    let mut number = |key: &str, value: Option<f64>| {
        numbers.finite_if_any(&format!("{key} of {}", named.name), value)
    };
    BodySummary {
        name: named.name.clone(),
        elements: body.n_elements(),
        nodes: body.n_nodes(),
        mass_kg: number("mass_kg", of_sphere(body.mass())),
        added_mass_kg: number("added_mass_kg", of_sphere(body.added_mass())),
        velocity_before_m_s: number("velocity_before_m_s", Some(named.velocity)),
        velocity_after_m_s: number("velocity_after_m_s", after),
        vibration_energy_j: number("vibration_energy_j", vibration),
    }
}
