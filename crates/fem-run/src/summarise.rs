//! From a collision to its summary.

use std::time::{Duration, Instant};

use fem_case::{Outcome, Simulation};
use fem_explicit::Monitor;
use fem_laws::HertzImpact;

use crate::peak_memory::peak_memory;
use crate::summary::{BodySummary, CostSummary, Energy, PROGRAM, Quantities, Summary};

/// A single run uses one thread; several serve several runs.
const THREADS: usize = 1;

/// What a run took, by the clock.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    /// Start of the process, or of this run in it.
    started: Instant,
    /// Until the model was built.
    setup: Duration,
    /// The run of the model.
    run: Duration,
}

impl Clock {
    /// Runs a model that has just been built.
    pub fn run(
        started: Instant,
        simulation: &mut Simulation,
        monitor: &mut dyn Monitor,
    ) -> (Outcome, Self) {
        let setup = started.elapsed();
        let outcome = simulation.run(monitor);
        (outcome, Self { started, setup, run: started.elapsed() - setup })
    }
}

/// Sums up a collision. `warnings` and `files` are those so far; numbers that are not finite become
/// `None` and another warning.
pub fn summarise(
    simulation: &Simulation,
    outcome: &Outcome,
    clock: Clock,
    warnings: Vec<String>,
    files: Vec<String>,
) -> Summary {
    let mut numbers = Numbers { warnings };
    let (setup, solve) = match outcome.timing {
        Some(timing) => (clock.setup + timing.setup, timing.collision),
        None => (clock.setup, clock.run),
    };
    let solve_s = solve.as_secs_f64();
    let updates = outcome.element_updates.filter(|updates| *updates > 0);
    Summary {
        collision: quantities(outcome, &mut numbers),
        contact_episodes: outcome.contact_episodes,
        hertz: hertz(simulation.hertz(), &mut numbers),
        energy: energy(outcome, &mut numbers),
        momentum_residual_relative: numbers
            .finite_if_any("momentum_residual_relative", outcome.momentum_residual_relative),
        bodies: [0, 1].map(|side| body(simulation, outcome, side, &mut numbers)).to_vec(),
        time_step_s: numbers.finite_if_any("time_step_s", outcome.time_step),
        steps: outcome.steps,
        element_updates: outcome.element_updates,
        cost: CostSummary {
            wall_s: clock.started.elapsed().as_secs_f64(),
            setup_s: setup.as_secs_f64(),
            solve_s,
            ns_per_element_update: updates.map(|updates| 1e9 * solve_s / updates as f64),
            threads: THREADS,
            peak_memory_bytes: peak_memory(),
            factor_bytes: match simulation {
                Simulation::Condensed(condensed) => Some(condensed.pair.factor_bytes() as u64),
                _ => None,
            },
        },
        effects: simulation.effects(),
        complete: outcome.halt.is_none(),
        stopped_because: outcome.halt.as_ref().map(ToString::to_string),
        program: PROGRAM,
        version: env!("CARGO_PKG_VERSION"),
        files,
        case: simulation.resolved(),
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

fn quantities(outcome: &Outcome, numbers: &mut Numbers) -> Quantities {
    let mut number = |key: &str, value: Option<f64>| numbers.finite_if_any(key, value);
    Quantities {
        restitution: number("restitution", outcome.restitution),
        contact_time_s: number("contact_time_s", outcome.contact_time),
        peak_force_n: number("peak_force_n", outcome.peak_force),
        max_approach_m: number("max_approach_m", outcome.max_approach),
        max_contact_radius_m: number("max_contact_radius_m", outcome.max_contact_radius),
        peak_pressure_pa: number("peak_pressure_pa", outcome.peak_pressure),
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

fn energy(outcome: &Outcome, numbers: &mut Numbers) -> Energy {
    let last = outcome.history.last();
    let mut at_end = |key: &str, value: Option<f64>| numbers.finite_if_any(key, value);
    Energy {
        initial_j: at_end("energy.initial_j", outcome.initial_energy),
        kinetic_j: at_end("energy.kinetic_j", last.map(|row| row.kinetic)),
        strain_j: at_end("energy.strain_j", last.and_then(|row| row.strain)),
        contact_j: at_end("energy.contact_j", last.and_then(|row| row.contact)),
        viscous_dissipation_j: at_end(
            "energy.viscous_dissipation_j",
            last.and_then(|row| row.viscous_dissipation),
        ),
        wall_work_j: at_end("energy.wall_work_j", last.map(|row| row.wall_work)),
        residual_j: at_end("energy.residual_j", last.and_then(|row| row.residual)),
        residual_relative: at_end("energy.residual_relative", outcome.residual_relative),
    }
}

fn body(
    simulation: &Simulation,
    outcome: &Outcome,
    side: usize,
    numbers: &mut Numbers,
) -> BodySummary {
    let (named, body) = (&simulation.case().scene.bodies[side], &outcome.bodies[side]);
    let mut number = |key: &str, value: Option<f64>| {
        numbers.finite_if_any(&format!("{key} of {}", named.name), value)
    };
    BodySummary {
        name: named.name.clone(),
        elements: body.elements,
        nodes: body.nodes,
        mass_kg: number("mass_kg", body.mass),
        added_mass_kg: number("added_mass_kg", body.added_mass),
        velocity_before_m_s: number("velocity_before_m_s", Some(named.velocity)),
        velocity_after_m_s: number("velocity_after_m_s", body.velocity_after),
        vibration_energy_j: number("vibration_energy_j", body.vibration_energy),
    }
}
