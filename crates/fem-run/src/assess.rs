//! How far a result can be trusted: what the run itself shows, in numbers.

use std::f64::consts::PI;

use fem_case::Problem;
use fem_explicit::{Collision, HistoryRow};

/// Fewer elements across the contact radius cost more than about 1 % of the force.
const FEWEST_ELEMENTS: f64 = 4.0;
/// Overlap of the surfaces over the approach.
const LARGEST_PENETRATION: f64 = 0.01;
/// Added mass over a body's mass.
const LARGEST_ADDED_MASS: f64 = 1e-3;
/// Energy that does not add up over the initial.
const LARGEST_RESIDUAL: f64 = 1e-3;
/// Vibration energy over the initial relative kinetic energy.
const LARGEST_VIBRATION: f64 = 0.01;
/// Scatter of the force over its peak.
const LARGEST_NOISE: f64 = 0.005;
/// Contact radius over effective radius.
const LARGEST_STRAIN: f64 = 0.1;
/// Restitution above 1 that is no rounding.
const LARGEST_EXCESS: f64 = 1e-5;

/// Warnings about a collision.
pub fn assess(problem: &Problem, collision: &Collision) -> Vec<String> {
    let warnings = [
        incomplete(collision),
        energy_residual(collision),
        restitution(collision),
        resolution(problem, collision),
        penetration(problem, collision),
        vibration(problem, collision),
        noise(collision),
        strain(problem, collision),
    ];
    warnings.into_iter().flatten().chain(added_mass(problem)).collect()
}

fn incomplete(collision: &Collision) -> Option<String> {
    let stop = collision.stopped.as_ref()?;
    Some(format!("the run is not complete: {stop}; maxima are those so far"))
}

fn energy_residual(collision: &Collision) -> Option<String> {
    let residual = collision.residual_relative;
    // A residual that is no number is above every limit.
    let is_sound = residual <= LARGEST_RESIDUAL;
    (!is_sound).then(|| {
        format!(
            "the energy does not add up by {residual:.1e} of the initial; above \
             {LARGEST_RESIDUAL:e}, lower time.step_factor"
        )
    })
}

fn restitution(collision: &Collision) -> Option<String> {
    let restitution = collision.restitution?;
    (restitution > 1.0 + LARGEST_EXCESS).then(|| {
        format!("the restitution {restitution:.6} is above 1: the numerical error is visible")
    })
}

/// Length of the element edge at the contact, the larger of the two bodies, m.
fn contact_edge(problem: &Problem) -> Option<f64> {
    let edges = problem.model.bodies().iter().filter_map(|body| {
        let mesh = body.mesh()?;
        let [pole, next] = mesh.surface().first_chunk::<2>()?;
        let [pole, next] = [pole, next].map(|node| mesh.nodes()[*node as usize]);
        Some((next[0] - pole[0]).hypot(next[1] - pole[1]))
    });
    edges.reduce(f64::max)
}

fn resolution(problem: &Problem, collision: &Collision) -> Option<String> {
    let n_elements = collision.max_contact_radius / contact_edge(problem)?;
    let is_enough = n_elements >= FEWEST_ELEMENTS || collision.stopped.is_some();
    (!is_enough).then(|| {
        format!(
            "the contact radius spans {n_elements:.1} elements; below {FEWEST_ELEMENTS}, use a \
             smaller mesh.contact_element_size"
        )
    })
}

/// The mean pressure F/πa² pushes the surfaces into each other by its ratio to the penalty
/// stiffness per area.
fn penetration(problem: &Problem, collision: &Collision) -> Option<String> {
    let radius = collision.max_contact_radius;
    let mean_pressure = collision.peak_force / (PI * radius * radius);
    let stiffness = problem.plan.contact_stiffness / contact_edge(problem)?;
    let share = mean_pressure / stiffness / collision.max_approach;
    (share > LARGEST_PENETRATION).then(|| {
        format!(
            "the surfaces overlap by about {:.1} % of the approach; above {} %, use a larger \
             contact.penalty_factor or a smaller mesh.contact_element_size",
            100.0 * share,
            100.0 * LARGEST_PENETRATION
        )
    })
}

fn vibration(problem: &Problem, collision: &Collision) -> Option<String> {
    let hertz = &problem.plan.estimate.hertz;
    let initial = 0.5 * hertz.pair().effective_mass() * hertz.approach_speed().powi(2);
    let share = collision.vibration_energy?.iter().sum::<f64>() / initial;
    (share > LARGEST_VIBRATION).then(|| {
        format!(
            "{:.1} % of the initial kinetic energy stays in vibrations of the bodies; closed \
             forms know nothing of them",
            100.0 * share
        )
    })
}

/// Scatter of the contact force from row to row, over its peak.
fn noise(collision: &Collision) -> Option<String> {
    let force = |row: &HistoryRow| row.contact_force;
    let rows: Vec<f64> = collision.history.iter().map(force).filter(|f| *f > 0.0).collect();
    // A smooth pulse bends by some 1e-5 over three of a thousand rows; the middle of three numbers
    // with independent scatter s is off the mean of the others by s √(3/2).
    let bends = rows.windows(3).map(|f| (f[1] - 0.5 * (f[0] + f[2])).powi(2));
    let mean = bends.sum::<f64>() / rows.len().max(1) as f64;
    let scatter = (mean / 1.5).sqrt() / collision.peak_force;
    (rows.len() > 100 && scatter > LARGEST_NOISE).then(|| {
        format!(
            "the contact force scatters by {:.1} % of its peak; above {} %, peaks are too high: \
             lower contact.penalty_factor or time.step_factor",
            100.0 * scatter,
            100.0 * LARGEST_NOISE
        )
    })
}

/// The plan warns of what it expects; this is what came.
fn strain(problem: &Problem, collision: &Collision) -> Option<String> {
    let radius = problem.plan.estimate.hertz.pair().effective_radius();
    let strain = collision.max_contact_radius / radius;
    let is_news = problem.plan.estimate.strain <= LARGEST_STRAIN;
    (is_news && strain > LARGEST_STRAIN).then(|| {
        format!(
            "the contact radius grew to {:.0} % of the effective radius; above {:.0} % the \
             small-strain model is in doubt",
            100.0 * strain,
            100.0 * LARGEST_STRAIN
        )
    })
}

fn added_mass(problem: &Problem) -> Vec<String> {
    let bodies = problem.model.bodies().iter().zip(&problem.case.scene.bodies);
    bodies
        .filter(|(body, _)| body.added_mass() > LARGEST_ADDED_MASS * body.mass())
        .map(|(body, named)| {
            format!(
                "mass scaling adds {:.2} % to the mass of {}; above {} %, use a smaller \
                 time.mass_scaling",
                100.0 * body.added_mass() / body.mass(),
                named.name,
                100.0 * LARGEST_ADDED_MASS
            )
        })
        .collect()
}
