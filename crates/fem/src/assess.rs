//! How far a result can be trusted: what the run itself shows, in numbers.

use std::f64::consts::PI;

use fem_collision::Collision;
use fem_mesh::SphereMesh;

use crate::method::ElementSetup;
use crate::plan::Plan;
use crate::simulation::Simulation;

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
/// Contact radius over the half-width of the fine block.
const LARGEST_OUTGROWTH: f64 = 1.05;
/// Restitution above 1 that is no rounding.
const LARGEST_EXCESS: f64 = 1e-5;

impl Simulation {
    /// All that the user should know of a collision: what was known before it, what it shows itself
    /// ([`assess`]), and what its model says.
    pub fn warnings(&self, collision: &Collision) -> Vec<String> {
        let mut warnings = self.setup().warnings.clone();
        warnings.extend(assess(self, collision));
        warnings.extend(collision.warnings.iter().cloned());
        warnings
    }
}

/// Warnings about a collision of finite elements; a reduced model has no such errors.
pub fn assess(simulation: &Simulation, collision: &Collision) -> Vec<String> {
    let Some(run) = Run::of(simulation, collision) else { return Vec::new() };
    let warnings = [
        run.incomplete(),
        run.energy_residual(),
        run.restitution(),
        run.resolution(),
        run.refinement(),
        run.penetration(),
        run.vibration(),
        run.noise(),
        run.strain(),
    ];
    warnings.into_iter().flatten().chain(run.added_mass()).collect()
}

/// A run of finite elements.
struct Run<'a> {
    simulation: &'a Simulation,
    collision: &'a Collision,
    plan: &'a Plan,
    meshes: [Option<&'a SphereMesh>; 2],
    /// Whether springs keep the surfaces apart.
    has_springs: bool,
    /// What makes the time step smaller.
    finer_steps: &'static str,
}

impl<'a> Run<'a> {
    fn of(simulation: &'a Simulation, collision: &'a Collision) -> Option<Self> {
        let ElementSetup { plan, has_springs, finer_steps } =
            simulation.setup().elements.as_ref()?;
        let meshes = simulation.model.meshes();
        let (has_springs, finer_steps) = (*has_springs, *finer_steps);
        Some(Self { simulation, collision, plan, meshes, has_springs, finer_steps })
    }

    fn incomplete(&self) -> Option<String> {
        let stop = self.collision.stop()?;
        Some(format!("the run is not complete: {stop}; maxima are those so far"))
    }

    fn energy_residual(&self) -> Option<String> {
        let residual = self.collision.residual_relative?;
        // A residual that is no number is above every limit.
        let is_sound = residual <= LARGEST_RESIDUAL;
        (!is_sound).then(|| {
            format!(
                "the energy does not add up by {residual:.1e} of the initial; above \
                 {LARGEST_RESIDUAL:e}, {}",
                self.finer_steps
            )
        })
    }

    fn restitution(&self) -> Option<String> {
        let restitution = self.collision.restitution?;
        (restitution > 1.0 + LARGEST_EXCESS).then(|| {
            format!("the restitution {restitution:.6} is above 1: the numerical error is visible")
        })
    }

    /// Length of the element edge at the contact, the larger of the two bodies, m.
    fn contact_edge(&self) -> Option<f64> {
        let edges = self.meshes.iter().flatten().filter_map(|mesh| {
            let [pole, next] = mesh.surface().first_chunk::<2>()?;
            let [pole, next] = [pole, next].map(|node| mesh.nodes()[*node as usize]);
            Some((next[0] - pole[0]).hypot(next[1] - pole[1]))
        });
        edges.reduce(f64::max)
    }

    fn resolution(&self) -> Option<String> {
        let n_elements = self.collision.max_contact_radius? / self.contact_edge()?;
        let is_enough = n_elements >= FEWEST_ELEMENTS || !self.collision.is_complete();
        (!is_enough).then(|| {
            format!(
                "the contact radius spans {n_elements:.1} elements; below {FEWEST_ELEMENTS}, use \
                 a smaller mesh.contact_element_size"
            )
        })
    }

    /// Whether the contact stayed in the block of fine elements.
    fn refinement(&self) -> Option<String> {
        let (radius, fine) = (self.collision.max_contact_radius?, self.plan.refined_radius);
        (self.plan.makes_meshes && radius > LARGEST_OUTGROWTH * fine).then(|| {
            format!(
                "the contact grew to {radius:.2e} m, beyond the block of fine elements \
                 (mesh.refined_radius, {fine:.2e} m): its edge is in coarser ones; use a larger \
                 mesh.refined_radius"
            )
        })
    }

    /// The mean pressure F/πa² pushes the surfaces into each other by its ratio to the penalty
    /// stiffness per area.
    fn penetration(&self) -> Option<String> {
        let radius = self.collision.max_contact_radius.filter(|_| self.has_springs)?;
        let mean_pressure = self.collision.peak_force? / (PI * radius * radius);
        let stiffness = self.plan.contact_stiffness / self.contact_edge()?;
        let share = mean_pressure / stiffness / self.collision.max_approach?;
        (share > LARGEST_PENETRATION).then(|| {
            format!(
                "the surfaces overlap by about {:.1} % of the approach; above {} %, use a larger \
                 contact.penalty_factor or a smaller mesh.contact_element_size",
                100.0 * share,
                100.0 * LARGEST_PENETRATION
            )
        })
    }

    fn vibration(&self) -> Option<String> {
        let hertz = &self.plan.estimate.hertz;
        let initial = 0.5 * hertz.pair().effective_mass() * hertz.approach_speed().powi(2);
        let left = self.collision.bodies.iter().filter_map(|body| body.vibration_energy);
        let share = left.sum::<f64>() / initial;
        (share > LARGEST_VIBRATION).then(|| {
            format!(
                "{:.1} % of the initial kinetic energy stays in vibrations of the bodies; closed \
                 forms know nothing of them",
                100.0 * share
            )
        })
    }

    /// Scatter of the contact force from row to row, over its peak.
    fn noise(&self) -> Option<String> {
        let forces = self.collision.history.iter().map(|row| row.contact_force);
        let rows: Vec<f64> = forces.filter(|force| *force > 0.0).collect();
        // A smooth pulse bends by some 1e-5 over three of a thousand rows; the middle of three
        // numbers with independent scatter s is off the mean of the others by s √(3/2).
        let bends = rows.windows(3).map(|f| (f[1] - 0.5 * (f[0] + f[2])).powi(2));
        let mean = bends.sum::<f64>() / rows.len().max(1) as f64;
        let scatter = (mean / 1.5).sqrt() / self.collision.peak_force?;
        (rows.len() > 100 && scatter > LARGEST_NOISE).then(|| {
            format!(
                "the contact force scatters by {:.1} % of its peak; above {} %, peaks are too \
                 high: lower contact.penalty_factor or {}",
                100.0 * scatter,
                100.0 * LARGEST_NOISE,
                self.finer_steps
            )
        })
    }

    /// The plan warns of what it expects; this is what came.
    fn strain(&self) -> Option<String> {
        let radius = self.plan.estimate.hertz.pair().effective_radius();
        let strain = self.collision.max_contact_radius? / radius;
        let is_news = self.plan.estimate.strain <= LARGEST_STRAIN;
        (is_news && strain > LARGEST_STRAIN).then(|| {
            format!(
                "the contact radius grew to {:.0} % of the effective radius; above {:.0} % the \
                 small-strain model is in doubt",
                100.0 * strain,
                100.0 * LARGEST_STRAIN
            )
        })
    }

    fn added_mass(&self) -> impl Iterator<Item = String> {
        let bodies = self.collision.bodies.iter().zip(self.simulation.case.scene().bodies());
        bodies.filter_map(|(body, named)| {
            let share = body.added_mass? / body.mass?;
            (share > LARGEST_ADDED_MASS).then(|| {
                format!(
                    "mass scaling adds {:.2} % to the mass of {}; above {} %, use a smaller \
                     time.mass_scaling",
                    100.0 * share,
                    named.name(),
                    100.0 * LARGEST_ADDED_MASS
                )
            })
        })
    }
}
