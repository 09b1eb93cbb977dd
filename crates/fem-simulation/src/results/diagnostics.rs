//! Diagnostics of a finished run: warnings about what the run itself shows.

use std::f64::consts::PI;

use fem_case::engineering::show;
use fem_collision::{Collision, LARGEST_RESIDUAL, QuantityOfInterest, Stop};
use fem_mesh::SphereMesh;

use crate::effects::{EFFECTS, Effect, Vibration};
use crate::error::{
    ErrorEstimate, LARGEST_NOISE, early_pressure_warning, excess_of_restitution, is_unresolved,
    noise, tolerance_warning, unbalanced_energy, unresolved_warning, widest_contact,
};
use crate::models::method::ElementSetup;
use crate::plan::Plan;
use crate::plan::contact_method::ContactNoiseAdvice;
use crate::plan::mesh_source::longest_contact_edge;
use crate::simulation::Simulation;

/// Overlap of the surfaces over the approach.
const LARGEST_PENETRATION: f64 = 0.01;
/// Springs as stiff as usual overlap by less on the meshes that are chosen, and are advised wherever softer ones might do.
const USUAL: f64 = 1.0;
/// Safety factor on the advised stiffness of springs.
const ROOM_OF_ADVICE: f64 = 1.2;
/// Power by which elements become shorter for an overlap that is so many times smaller: it falls with their 0.85th.
const SHORTER: f64 = 1.2;

/// Returns warnings about a finished collision: numbers that no collision can have, errors of the elements that exceed
/// the tolerance, and effects that show in it.
pub fn diagnose(
    simulation: &Simulation,
    collision: &Collision,
    errors: &ErrorEstimate,
) -> Vec<String> {
    let mut warnings = of_numbers(simulation, collision);
    warnings.extend(of_elements(simulation, collision, errors));
    if let Some(estimate) = simulation.estimate(collision) {
        let scene = simulation.case().scene();
        let after = |effect: &&dyn Effect| effect.after(scene, &estimate, collision);
        warnings.extend(EFFECTS.iter().flat_map(after));
    }
    warnings
}

/// Overlap of the surfaces as a share of the approach, if it is too large.
pub(crate) fn overlap_of_approach(simulation: &Simulation, collision: &Collision) -> Option<f64> {
    let overlap = Run::of(simulation, collision)?.overlap()?;
    (overlap.of_approach > LARGEST_PENETRATION).then_some(overlap.of_approach)
}

/// Returns warnings about errors of the elements, one per cause.
fn of_elements(
    simulation: &Simulation,
    collision: &Collision,
    errors: &ErrorEstimate,
) -> Vec<String> {
    let Some(run) = Run::of(simulation, collision) else { return Vec::new() };
    let coarse = widest_contact(simulation, collision)
        .and_then(|radius| unresolved_warning(simulation, radius));
    let is_unresolved = is_unresolved(simulation, collision);
    // On a coarse mesh the surfaces overlap because of the mesh, unless the springs are soft.
    let is_of_mesh = is_unresolved || (coarse.is_some() && run.plan.penalty_factor >= USUAL);
    let penetration = run.penetration().filter(|_| !is_of_mesh);
    let is_estimated = errors.discretisation(QuantityOfInterest::PeakForce).is_some();
    let mesh = match (is_unresolved, penetration.is_some()) {
        (true, _) => coarse,
        (false, true) => None,
        (false, false) => {
            tolerance_warning(simulation, collision, errors).or(coarse.filter(|_| !is_estimated))
        }
    };
    let early = early_pressure_warning(simulation, collision).filter(|_| !is_unresolved);
    [mesh, penetration, run.noise(), early].into_iter().flatten().collect()
}

/// Returns the warnings that apply to every model.
fn of_numbers(simulation: &Simulation, collision: &Collision) -> Vec<String> {
    let remedy = match &simulation.setup().elements {
        Some(elements) => elements.noise_advice.advice_on_energy(),
        None => {
            format!("use model {}", Vibration::models_that_serve(&simulation.setup().estimate))
        }
    };
    [incomplete(collision), energy_residual(collision, &remedy), restitution(collision)]
        .into_iter()
        .flatten()
        .collect()
}

fn incomplete(collision: &Collision) -> Option<String> {
    let stop = collision.stop()?;
    Some(format!("the run is not complete: {stop}; maxima are those so far"))
}

/// Nothing of a run that ended for what its energy or its motion was: the stop has cause and remedy.
fn energy_residual(collision: &Collision, remedy: &str) -> Option<String> {
    use Stop::{EnergyGrowth, EnergyImbalance, NoNumber, StabilityLost};
    if let Some(
        EnergyGrowth { .. } | EnergyImbalance { .. } | NoNumber { .. } | StabilityLost { .. },
    ) = collision.stop()
    {
        return None;
    }
    let residual = unbalanced_energy(collision)?;
    Some(format!(
        "the energy does not add up by {residual:.1e} of the initial, above \
         {LARGEST_RESIDUAL:e}{}; {remedy}",
        collision.residual_since.map_or(String::new(), |since| format!(" since {since}"))
    ))
}

fn restitution(collision: &Collision) -> Option<String> {
    excess_of_restitution(collision)?;
    let restitution = collision.restitution?;
    Some(format!("the restitution {restitution:.6} is above 1: the numerical error is visible"))
}

/// A positive number as it is advised: rounded up to two digits.
fn two_digits(value: f64) -> f64 {
    let step = 10.0_f64.powf(value.log10().floor() - 1.0);
    // Printed and read, a decimal number is the nearest there is.
    format!("{:.1e}", (value / step).ceil() * step).parse().unwrap_or(value)
}

/// Overlap of the surfaces at most.
struct Overlap {
    /// Over an element's length.
    of_element: f64,
    /// Over the largest approach.
    of_approach: f64,
}

/// A run of finite elements.
struct Run<'a> {
    collision: &'a Collision,
    plan: &'a Plan,
    meshes: [Option<&'a SphereMesh>; 2],
    /// Whether springs keep the surfaces apart.
    has_springs: bool,
    noise_advice: ContactNoiseAdvice,
}

impl<'a> Run<'a> {
    fn of(simulation: &'a Simulation, collision: &'a Collision) -> Option<Self> {
        let ElementSetup { plan, has_springs, noise_advice, .. } =
            simulation.setup().elements.as_ref()?;
        let meshes = simulation.model().meshes();
        let (has_springs, noise_advice) = (*has_springs, *noise_advice);
        Some(Self { collision, plan, meshes, has_springs, noise_advice })
    }

    /// The mean pressure F/πa² pushes the surfaces into each other by its ratio to the penalty
    /// stiffness per area.
    fn overlap(&self) -> Option<Overlap> {
        // Why a run stopped early is said, and what it came to is no contact of usual springs.
        let is_sound = self.has_springs && self.collision.is_complete();
        let radius = self.collision.max_contact_radius.filter(|_| is_sound)?;
        // A contact of the poles alone has no pressure; that meshes cannot carry it is said.
        let radius = Some(radius).filter(|radius| *radius > 0.0)?;
        let mean_pressure = self.collision.peak_force? / (PI * radius * radius);
        let of_element = mean_pressure / self.plan.contact_stiffness;
        let longest = longest_contact_edge(self.meshes, radius)?;
        let of_approach = of_element * longest / self.collision.max_approach?;
        Some(Overlap { of_element, of_approach })
    }

    /// That the surfaces overlap by too much.
    fn penetration(&self) -> Option<String> {
        let Overlap { of_element, of_approach } = self.overlap()?;
        let excess = of_approach / LARGEST_PENETRATION;
        (excess > 1.0).then(|| {
            format!(
                "the surfaces overlap by about {:.1} % of the approach and {:.1} % of an element{}; above {} \
                 % of the approach, write contact.penalty_factor = {}{}",
                100.0 * of_approach,
                100.0 * of_element,
                self.collision.deepest_overlap.map_or(String::new(), |deepest_overlap| format!(", deepest {deepest_overlap}")),
                100.0 * LARGEST_PENETRATION,
                two_digits((ROOM_OF_ADVICE * excess.powf(1.5) * self.plan.penalty_factor).max(USUAL)),
                self.shorter_elements(excess)
            )
        })
    }

    /// Returns further advice against an overlap of this multiple of the limit. If springs are softer than
    /// the default, they are the cause and not the mesh.
    fn shorter_elements(&self, excess: f64) -> String {
        let size = self.plan.contact_element_size / (ROOM_OF_ADVICE * excess.powf(SHORTER));
        match self.plan.makes_meshes {
            _ if self.plan.penalty_factor < USUAL => String::new(),
            true => format!(", or use a mesh.contact_element_size of {} or less", show(size, "m")),
            false => ", or use meshes that are finer at the contact".to_string(),
        }
    }

    /// That the contact force scatters by too much.
    fn noise(&self) -> Option<String> {
        Some(format!(
            "the contact force scatters by {:.1} % of its peak{}; above {} %, peaks are too high: {}",
            100.0 * noise(self.collision)?,
            self.collision
                .noisiest_instant
                .map_or(String::new(), |at| format!(", most about {at}")),
            100.0 * LARGEST_NOISE,
            self.noise_advice.advice()
        ))
    }
}
