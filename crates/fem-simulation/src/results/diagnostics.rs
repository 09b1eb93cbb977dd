//! All warnings about a run: before it, and the diagnostics of the finished run.

use std::f64::consts::PI;

use fem_case::ModelChoice;
use fem_case::engineering::show;
use fem_collision::{Collision, LARGEST_RESIDUAL, QuantityOfInterest, Stop};
use fem_mesh::SphereMesh;

use crate::effects::{EFFECTS, Effect, Vibration};
use crate::error::{
    ErrorEstimate, LARGEST_NOISE, early_pressure_warning, excess_of_restitution, is_unresolved,
    noise, tolerance_warning, unbalanced_energy, unresolved_warning, widest_contact,
};
use crate::estimate::mach;
use crate::models::method::{Cost, ElementSetup};
use crate::models::{ModelCandidate, SelectedModel};
use crate::plan::DEFAULT_PENALTY_FACTOR;
use crate::plan::Plan;
use crate::plan::contact_method::ContactNoiseAdvice;
use crate::plan::mesh_source::longest_contact_edge;
use crate::plan::penalty_compliance::softness;
use crate::simulation::Simulation;

/// Largest overlap of the surfaces over the approach without a warning.
const LARGEST_PENETRATION: f64 = 0.01;
/// Safety factor on the advised stiffness of springs.
const ROOM_OF_ADVICE: f64 = 1.2;
/// Power of the overlap with which elements are shortened: the overlap falls with the power 0.85 of the element size.
const SHORTER: f64 = 1.2;

/// Seconds of a run from which a cheaper model is suggested.
const LONG: f64 = 3.0;

impl Simulation {
    /// Returns the warnings before the run.
    pub fn warnings_before(&self) -> Vec<String> {
        let scene = self.case().scene();
        let of_scene = scene.implausible_numbers().into_iter().chain(scene.unpublished_loss());
        of_scene
            .chain(self.shear_waves_warning())
            .chain(self.choice_warning())
            .chain(self.setup().warnings())
            .chain(self.mesh_warning())
            .chain(self.springs_warning())
            .chain(self.cheaper())
            .collect()
    }

    /// Returns all warnings about a collision: those before it, those of its result, and those of its model.
    pub fn warnings_with(&self, collision: &Collision, errors: &ErrorEstimate) -> Vec<String> {
        let scene = self.case().scene();
        let mut warnings = scene.implausible_numbers();
        warnings.extend(scene.unpublished_loss());
        warnings.extend(self.choice_warning());
        warnings.extend(self.decisions(collision).warnings);
        warnings.extend(self.setup().unread.iter().cloned());
        warnings.extend(diagnose(self, collision, errors));
        warnings.extend(collision.warnings.iter().cloned());
        warnings
    }

    /// Estimates the errors of a collision by reference runs, and returns all warnings about it.
    pub fn warnings(&self, collision: &Collision) -> Vec<String> {
        self.warnings_with(collision, &self.estimate_errors(collision))
    }

    /// Returns a warning that the mesh resolves the expected contact by too few elements.
    pub fn mesh_warning(&self) -> Option<String> {
        unresolved_warning(self, self.setup().estimate.contact_radius)
    }

    /// Returns a warning that explicit elements fold if the bodies meet faster than shear waves leave the contact.
    fn shear_waves_warning(&self) -> Option<String> {
        let scene = self.scene_of_model();
        let mach = mach(&scene, scene.approach_speed());
        (mach > 1.0 && *scene.model() == ModelChoice::Fem).then(|| {
            format!(
                "the approach speed is {mach:.1} times that of the shear waves, √(G/ρ): above 1 the flank of a body \
                 may fold onto the other one, which stops the run; lower body.N.approach_speed, or check the moduli \
                 and their units"
            )
        })
    }

    /// Returns a warning that soft penalty springs lengthen the contact.
    fn springs_warning(&self) -> Option<String> {
        let elements = self.setup().elements.as_ref().filter(|elements| elements.has_springs)?;
        let longer = softness(&elements.plan)?;
        (longer > self.case().scene().accuracy().contact_time).then(|| {
            format!(
                "springs of contact.penalty_factor = {} are compliant: the contact lasts about {:.0} % longer; write \
                 contact.penalty_factor = 1",
                elements.plan.penalty_factor,
                100.0 * longer
            )
        })
    }

    /// Suggests the condensed model for a long run, if it is expected to meet the tolerance too.
    pub fn cheaper(&self) -> Option<String> {
        let Cost::Steps { seconds, .. } = self.setup().cost else { return None };
        let scene = self.case().scene();
        if seconds < LONG || *scene.model() != ModelChoice::Fem {
            return None;
        }
        let open = SelectedModel::of(&scene.clone().with_model(ModelChoice::Auto)).ok()?;
        // Condensed bodies have fields to draw, as explicit elements do.
        let serves = |it: &&ModelCandidate| {
            it.model.starts_with("condensed")
                && (it.chosen || it.reason.starts_with("within the tolerance"))
        };
        let other = open.considered.iter().find(serves).filter(|_| open.warning.is_none())?;
        Some(format!(
            "the run takes about {}; model.{} is also expected to be within the tolerance of the case and takes \
             hundredths of a second",
            show(seconds, "s"),
            other.model
        ))
    }
}

/// Returns warnings about a finished collision: impossible numbers, errors of the elements above the tolerance, and effects
/// that show in it.
pub fn diagnose(
    simulation: &Simulation,
    collision: &Collision,
    errors: &ErrorEstimate,
) -> Vec<String> {
    let mut warnings = of_numbers(simulation, collision);
    warnings.extend(of_elements(simulation, collision, errors));
    if let Some(estimate) = simulation.estimate(collision) {
        let scene = simulation.case().scene();
        let after = |effect: &&dyn Effect| effect.warnings_of_result(scene, &estimate, collision);
        warnings.extend(EFFECTS.iter().flat_map(after));
    }
    warnings
}

/// Returns the overlap of the surfaces over the approach, if it is too large.
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
    // On a coarse mesh the mesh is the cause of overlap, unless the springs are soft.
    let is_of_mesh =
        is_unresolved || (coarse.is_some() && run.plan.penalty_factor >= DEFAULT_PENALTY_FACTOR);
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

/// Returns a warning about the energy residual, unless it has stopped the run: the stop has its own remedy.
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

/// Rounds a positive number up to two digits.
fn two_digits(value: f64) -> f64 {
    let step = 10.0_f64.powf(value.log10().floor() - 1.0);
    // Printing and parsing gives the nearest decimal number.
    format!("{:.1e}", (value / step).ceil() * step).parse().unwrap_or(value)
}

/// Largest overlap of the surfaces.
struct Overlap {
    /// Overlap over the element length.
    of_element: f64,
    /// Overlap over the largest approach.
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

    /// Returns the overlap by the mean pressure F/πa² over the penalty stiffness per area.
    fn overlap(&self) -> Option<Overlap> {
        // An incomplete run has a warning of its own.
        let is_known = self.has_springs && self.collision.is_complete();
        let radius = self.collision.max_contact_radius.filter(|_| is_known)?;
        // A contact of the poles alone has no pressure, and a warning about the mesh.
        let radius = Some(radius).filter(|radius| *radius > 0.0)?;
        let mean_pressure = self.collision.peak_force? / (PI * radius * radius);
        let of_element = mean_pressure / self.plan.contact_stiffness;
        let longest = longest_contact_edge(self.meshes, radius)?;
        let of_approach = of_element * longest / self.collision.max_approach?;
        Some(Overlap { of_element, of_approach })
    }

    /// Returns a warning that the surfaces overlap too much.
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
                two_digits((ROOM_OF_ADVICE * excess.powf(1.5) * self.plan.penalty_factor).max(DEFAULT_PENALTY_FACTOR)),
                self.shorter_elements(excess)
            )
        })
    }

    /// Returns further advice against an overlap of this multiple of the limit. Springs softer than the default are the
    /// cause, and not the mesh.
    fn shorter_elements(&self, excess: f64) -> String {
        let size = self.plan.contact_element_size / (ROOM_OF_ADVICE * excess.powf(SHORTER));
        match self.plan.makes_meshes {
            _ if self.plan.penalty_factor < DEFAULT_PENALTY_FACTOR => String::new(),
            true => format!(", or use a mesh.contact_element_size of {} or less", show(size, "m")),
            false => ", or use meshes that are finer at the contact".to_string(),
        }
    }

    /// Returns a warning that the contact force scatters too much.
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
