//! The plan of a run with elements: every number that the case leaves open.

pub(crate) mod body_source;
pub(crate) mod contact_method;
pub(crate) mod element_size;
pub(crate) mod limits;
pub(crate) mod mesh_offset;
pub(crate) mod mesh_source;
pub(crate) mod pair_cache;
pub(crate) mod penalty_compliance;

use std::borrow::Cow;

use fem_case::engineering::number;
use fem_case::schema::{
    ContactTable, EmptyTable, LimitsTable, MeshTable, ModelTable, SnapshotsValue, StartTable,
    TimeTable,
};
use fem_case::{
    Body, Case, CaseError, CaseFile, ContactMethod, ModelChoice, Quantity, Scene, Shape, Snapshots,
    defaults,
};
use fem_collision::{
    OutputRequest, QuantityOfInterest, SnapshotInstant, SnapshotRequest, far_radius_at_rest,
    far_radius_of_waves,
};

use fem_laws::ImpactQuantities;

use crate::effects::{PlateBending, percent};
use crate::estimate::{Estimate, Regime, viscous_flow};
use crate::plan::body_source::meshed;
use crate::plan::contact_method::{contact_method, default_penalty_factor};
use crate::plan::element_size::{MeshRule, touches_at_nodes};
use crate::plan::mesh_offset::{finer_body, is_generated, staggered};
use crate::rejection::Rejection;

/// Half-width of the block of equal elements over the contact radius.
pub(crate) const REFINED_OVER_CONTACT: f64 = 1.2;
/// Half-width of the candidate region over the contact radius.
const CANDIDATES_OVER_CONTACT: f64 = 1.5;
/// Default penalty stiffness per area times element size, over E*. In the glass pair with eight elements across the
/// contact, 10 changes the contact time by 0.14 %, 20 by 0.02 %, and 40 adds noise to the force.
const PENALTY_OVER_MODULUS: f64 = 20.0;
/// Expected restitution above which the approach returns to half of its maximum.
const RESTITUTION_OF_SHALLOW_DENTS: f64 = 0.8;
/// Element sizes of condensed bodies per octave; sizes are rounded down by at most a ninth.
const SIZES_PER_OCTAVE: f64 = 8.0;
/// Return of shear waves from the rim of a plate's mesh over the expected contact time.
const RETURN_OVER_CONTACT: f64 = 1.1;
/// Least radius of a plate's mesh over its thickness.
const LEAST_RADIUS_OF_PLATE: f64 = 2.0;
/// Relative rounding of a length that was written and read.
const ROUNDING_OF_LENGTH: f64 = 1e-9;

/// The decisions before the meshes are generated, SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The closed-form estimate of the collision.
    pub estimate: Estimate,
    /// Share of the scene's approach speed with which the computed bodies meet: ½ if half of a mirrored scene is
    /// computed.
    pub speed_share: f64,
    /// Distance of the surfaces at time 0, m.
    pub gap: f64,
    /// Edge length of the elements at the contact, m.
    pub contact_element_size: f64,
    /// The body with the smaller elements, if the meshes are staggered.
    pub finer_body: Option<usize>,
    /// The quantity that needs the smallest elements and the least moved mass, and its tolerance.
    pub limiting_quantity: (QuantityOfInterest, f64),
    /// Half-width of the block of equal elements, m.
    pub refined_radius: f64,
    /// Ratio of the radii of successive rings; `None` for square cells.
    pub growth: Option<f64>,
    /// Distance of the far boundary of a half-space or of a wide plate, m.
    pub far_radius: Option<f64>,
    /// Whether any mesh is generated, and not read from a file.
    pub makes_meshes: bool,
    /// Whether no mesh meets the tolerance, which a warning reports.
    pub(crate) is_out_of_reach: bool,
    /// Radius of the candidate region of the contact, m.
    pub candidate_radius: f64,
    /// The contact method at small strain.
    pub contact_method: ContactMethod,
    /// Factor on the default penalty stiffness.
    pub penalty_factor: f64,
    /// Penalty stiffness per area times element size, Pa.
    pub contact_stiffness: f64,
    /// Time step over critical time step.
    pub step_factor: f64,
    /// Largest moved mass as a fraction of the lighter body's mass.
    pub mass_scaling: f64,
    /// The requested snapshots.
    pub snapshots: SnapshotRequest,
    /// Elements above which a run is rejected.
    pub max_elements: u64,
    /// Elements times steps above which a run is rejected.
    pub max_element_updates: u64,
    /// Longest run, in elastic contact times; a run that takes longer stops with
    /// [`NoSeparation`](fem_collision::Stop::NoSeparation).
    pub max_contact_times: f64,
    /// Memory above which a run is rejected, bytes.
    pub max_memory: u64,
    /// Warnings about unread keys and a tolerance that cannot be met.
    pub warnings: Vec<String>,
}

/// The first words of the warning about a tolerance that no mesh meets.
const UNREACHABLE: &str = "accuracy.tolerance cannot be met";

/// Rejects a sphere with a mass of its own, which elements would have to place somewhere in the body.
fn check_masses(scene: &Scene) -> Result<(), Rejection> {
    let has_own = |body: &&Body| body.own_mass().is_some();
    let Some(body) = scene.bodies().iter().find(has_own) else { return Ok(()) };
    let density = body.mean_density().map_or(String::new(), |it| number(it, 5));
    let key = format!("body.{}.sphere.mass", usize::from(body == &scene.bodies()[1]));
    let message = format!(
        "elements have the density of their material; {} has a mass of its own",
        body.name()
    );
    Err(Rejection::new(key, message).with_help(format!(
        "use [model] ting, hertz, law or auto; or remove the key and give the material density = \"{density} kg/m^3\""
    )))
}

impl Plan {
    /// Returns the plan of a scene.
    ///
    /// # Errors
    /// A scene whose closed-form estimates are not finite, or whose bodies flow into each other.
    pub fn of(scene: &Scene) -> Result<Self, Rejection> {
        Self::in_regime(&Regime::of(scene.clone())?)
    }

    /// Returns a plan if it is known, or else that of a scene in its regime.
    ///
    /// # Errors
    /// Those of [`Plan::in_regime`].
    pub(crate) fn known<'a>(
        known: Option<&'a Self>,
        regime: &Regime,
    ) -> Result<Cow<'a, Self>, Rejection> {
        known.map_or_else(|| Self::in_regime(regime).map(Cow::Owned), |it| Ok(Cow::Borrowed(it)))
    }

    /// Returns the plan of a scene in its regime.
    ///
    /// # Errors
    /// A scene whose bodies flow into each other.
    pub(crate) fn in_regime(regime: &Regime) -> Result<Self, Rejection> {
        let Regime { scene, estimate } = regime;
        viscous_flow::check(scene, estimate)?;
        PlateBending::check(scene)?;
        check_masses(scene)?;
        let finer_body = finer_body(scene);
        let rule = MeshRule::of(scene, estimate, finer_body.is_some());
        let is_shared = touches_at_nodes(scene.model());
        let contact_element_size = scene.mesh().contact_element_size.unwrap_or_else(|| {
            let length = (divided_radius(estimate) / rule.across)
                .min(estimate.smallest_radius / (12.0 * scene.refinement()));
            if is_shared { shared_length(length, estimate.smallest_radius) } else { length }
        });
        let refined_radius = scene.mesh().refined_radius.unwrap_or_else(|| {
            let radius = REFINED_OVER_CONTACT * estimate.contact_radius;
            let radius = match is_shared {
                true => (radius / contact_element_size).ceil() * contact_element_size,
                false => radius,
            };
            radius.min(estimate.smallest_radius)
        });
        let candidate_radius = candidate_radius(estimate, contact_element_size);
        let (penalty_factor, contact_stiffness) = springs(scene, estimate, contact_element_size)?;
        let makes_meshes = scene.bodies().iter().any(is_generated);
        let far_radius = far_radius(&meshed(scene), estimate, refined_radius, candidate_radius);
        let mut warnings = unread_keys(scene, makes_meshes, far_radius.is_some());
        let is_chosen = makes_meshes && scene.mesh().contact_element_size.is_none();
        let out_of_reach = rule.error_on_finest_mesh.filter(|_| is_chosen);
        warnings.extend(out_of_reach.map(|reached| finest_mesh_warning(&rule, reached)));
        let limits = scene.limits();
        Ok(Self {
            speed_share: 1.0,
            gap: scene.gap().unwrap_or(defaults::GAP),
            contact_element_size,
            finer_body,
            limiting_quantity: rule.limiting_quantity,
            refined_radius,
            growth: scene.mesh().growth,
            far_radius,
            makes_meshes,
            is_out_of_reach: out_of_reach.is_some(),
            candidate_radius,
            contact_method: contact_method(scene),
            penalty_factor,
            contact_stiffness,
            step_factor: scene.step_factor().unwrap_or(defaults::STEP_FACTOR),
            mass_scaling: scene.mass_scaling().unwrap_or(rule.mass_scaling),
            snapshots: request(scene.snapshots(), estimate.flow),
            max_elements: limits.elements.unwrap_or(defaults::MAX_ELEMENTS),
            max_element_updates: limits.element_updates.unwrap_or(defaults::MAX_ELEMENT_UPDATES),
            max_contact_times: viscous_flow::max_contact_times(scene, estimate),
            max_memory: limits.memory.unwrap_or(defaults::MAX_MEMORY),
            warnings,
            estimate: estimate.clone(),
        })
    }

    /// Returns the plan of a case.
    ///
    /// # Errors
    /// Those of [`Plan::of`], with their place in the case.
    pub fn of_case(case: &Case) -> Result<Self, CaseError> {
        Self::of(case.scene()).map_err(|rejection| rejection.in_case(case))
    }

    /// Returns why no mesh meets `accuracy.tolerance`, if the case asks for a smaller error than the finest mesh has.
    pub fn out_of_reach(&self) -> Option<&str> {
        let warning = self.warnings.iter().find(|warning| warning.starts_with(UNREACHABLE));
        warning.map(String::as_str)
    }

    /// Returns the element sizes of both bodies at the contact, m.
    pub fn element_sizes(&self) -> [f64; 2] {
        let length = self.contact_element_size;
        match self.finer_body {
            Some(finer) => staggered(length, divided_radius(&self.estimate), finer),
            None => [length; 2],
        }
    }

    /// Returns whether the penalty springs are softer than the default.
    pub(crate) fn has_soft_springs(&self) -> bool {
        self.penalty_factor < default_penalty_factor(&self.estimate)
    }

    /// Returns the expected radius (m) of a contact whose pressure is uniform up to its edge: of a body that flows.
    pub(crate) fn contact_edge(&self) -> Option<f64> {
        self.estimate.flow.map(|_| self.estimate.contact_radius)
    }

    /// Returns the key by which the case replaces the planned mesh away from a contact of this radius (m), if it does.
    pub(crate) fn far_mesh_key(&self, scene: &Scene, contact_radius: f64) -> Option<&'static str> {
        let chosen = REFINED_OVER_CONTACT * contact_radius;
        let chosen = (1.0 - ROUNDING_OF_LENGTH) * chosen.min(self.estimate.smallest_radius);
        let is_smaller = scene.mesh().refined_radius.is_some_and(|given| given < chosen);
        match (self.makes_meshes, self.growth.is_some(), is_smaller) {
            (false, ..) | (_, false, false) => None,
            (_, true, _) => Some("mesh.growth"),
            _ => Some("mesh.refined_radius"),
        }
    }

    /// Returns the output request of a run.
    pub fn request(&self) -> OutputRequest {
        OutputRequest {
            snapshots: self.snapshots.clone(),
            most_element_updates: self.max_element_updates,
            max_contact_times: self.max_contact_times,
            ..OutputRequest::history()
        }
    }

    /// Returns the case with every default filled in, which runs to the same bits.
    pub fn resolve(&self, mut file: CaseFile) -> CaseFile {
        file.start = Some(StartTable { gap: Some(self.gap.into()) });
        file.mesh = self.makes_meshes.then(|| MeshTable {
            contact_element_size: Some(self.contact_element_size.into()),
            refined_radius: Some(self.refined_radius.into()),
            growth: self.growth.map(Quantity::from_si),
            far_radius: self.far_radius.map(Quantity::from_si),
            staggered: Some(self.finer_body.is_some()),
        });
        file.contact = Some(ContactTable {
            method: Some(self.contact_method),
            penalty_factor: Some(self.penalty_factor.into()),
            ..file.contact.unwrap_or_default()
        });
        file.time = Some(TimeTable {
            step_factor: Some(self.step_factor.into()),
            mass_scaling: Some(self.mass_scaling.into()),
        });
        if let SnapshotRequest::Labels(labels) = &self.snapshots {
            file.output.get_or_insert_default().snapshots.get_or_insert_with(|| {
                let text = |label: &SnapshotInstant| Quantity::from_text(label.name());
                SnapshotsValue::List(labels.iter().map(text).collect())
            });
        }
        file.effects = Some(file.effects.unwrap_or_default().filled());
        file.model = Some(ModelTable { fem: Some(EmptyTable {}), ..ModelTable::default() });
        file.limits = Some(LimitsTable {
            elements: Some((self.max_elements as f64).into()),
            element_updates: Some((self.max_element_updates as f64).into()),
            memory: Some((self.max_memory as f64).into()),
        });
        file
    }
}

/// Returns the penalty factor, and the stiffness per area times element size (Pa) of springs on elements of this size, m.
fn springs(scene: &Scene, estimate: &Estimate, size: f64) -> Result<(f64, f64), Rejection> {
    let given = scene.penalty_factor();
    let factor = given.unwrap_or_else(|| default_penalty_factor(estimate));
    let stiffness = factor * PENALTY_OVER_MODULUS * estimate.hertz.pair().contact_modulus();
    let per_area = stiffness / size;
    if given.is_some() && !(per_area.is_finite() && per_area > 0.0) {
        let found =
            format!("springs of contact.penalty_factor = {factor:e} have {per_area:e} Pa/m");
        return Err(Rejection::new("contact.penalty_factor", found).with_help(
            "this stiffness must be positive and finite; leave it out for the default",
        ));
    }
    Ok((factor, stiffness))
}

/// Returns the warning that the finest mesh, whose force has this error, is too coarse.
fn finest_mesh_warning(rule: &MeshRule, reached: f64) -> String {
    let across = rule.across;
    match rule.is_for_tolerance {
        true => format!(
            "{UNREACHABLE}: even {across:.0} elements across the contact leave an error of about {} \
             of the peak force; raise accuracy.tolerance",
            percent(reached)
        ),
        false => format!(
            "accuracy.tolerance may not be met: the finest mesh has {across:.0} elements across the contact; the \
             estimated error or the steep fronts of a fast impact ask for more"
        ),
    }
}

/// Returns warnings about keys of `[mesh]` that have no effect.
fn unread_keys(scene: &Scene, makes_meshes: bool, has_half_space: bool) -> Vec<String> {
    let mesh = scene.mesh();
    let of_files = "the meshes are read from files";
    let keys = [
        ("contact_element_size", mesh.contact_element_size, makes_meshes, of_files),
        ("refined_radius", mesh.refined_radius, makes_meshes, of_files),
        ("growth", mesh.growth, makes_meshes, of_files),
        (
            "far_radius",
            mesh.far_radius,
            has_half_space,
            "no body is a half-space or a plate that is wider",
        ),
    ];
    let unread = keys.into_iter().filter(|(_, value, is_read, _)| value.is_some() && !is_read);
    unread.map(|(key, .., why)| format!("mesh.{key} has no effect: {why}")).collect()
}

/// Rounds a length (m) down to one of [`SIZES_PER_OCTAVE`] sizes per octave of the smallest radius. Scenes that differ
/// in speed, relaxation or modulus then share meshes, and condensed bodies are factored once.
fn shared_length(length: f64, smallest_radius: f64) -> f64 {
    let n = (SIZES_PER_OCTAVE * (smallest_radius / length).log2() * (1.0 - 1e-12)).ceil();
    smallest_radius * (-n / SIZES_PER_OCTAVE).exp2()
}

/// Returns the contact radius (m) that the elements divide: at most half of the smallest body radius.
pub fn divided_radius(estimate: &Estimate) -> f64 {
    radius_of_elements(estimate).min(0.5 * estimate.smallest_radius)
}

/// Returns the contact radius (m) that sizes the elements, without the limit by the body: that of flow in a body that flows
/// plastically. Otherwise it is the elastic radius if
/// relaxation widens the contact at most twofold, the radius with fully relaxed moduli (an upper bound) if it widens the
/// contact fourfold or more, and a quadratic blend in between.
fn radius_of_elements(estimate: &Estimate) -> f64 {
    if estimate.flow.is_some() {
        return estimate.contact_radius;
    }
    let elastic = estimate.hertz.max_contact_radius();
    if estimate.bends {
        return elastic.min(estimate.contact_radius);
    }
    let wider = 0.5 * estimate.contact_radius / elastic;
    if wider <= 1.0 { elastic } else { (elastic * wider * wider).min(estimate.contact_radius) }
}

/// Returns the initial radius (m) of the candidate region for explicit elements of this size (m).
pub(crate) fn candidate_radius(estimate: &Estimate, contact_element_size: f64) -> f64 {
    let contact_radius = estimate.contact_radius.min(0.5 * estimate.smallest_radius);
    (CANDIDATES_OVER_CONTACT * contact_radius).max(3.0 * contact_element_size)
}

/// Returns the far boundary of a half-space: no wave returns from it during the run, or, for condensed bodies, it does not
/// change the compliance. That of a plate is nearer, since shear waves are the fastest that matter in it; `None` for one that
/// ends before.
fn far_radius(
    scene: &Scene,
    estimate: &Estimate,
    refined_radius: f64,
    candidate_radius: f64,
) -> Option<f64> {
    if let Some((plate, material)) =
        scene.bodies().iter().find_map(|body| body.plate().zip(body.material()))
    {
        let radius = scene.mesh().far_radius.unwrap_or_else(|| {
            let way = material.shear_wave_speed() * RETURN_OVER_CONTACT * estimate.contact_time;
            (candidate_radius + 0.5 * way).max(LEAST_RADIUS_OF_PLATE * plate.thickness)
        });
        return plate.diameter.is_none_or(|diameter| 0.5 * diameter > radius).then_some(radius);
    }
    let half_space = |body: &Body| matches!(body.shape(), Shape::HalfSpace { .. });
    let material = scene.bodies().iter().find(|body| half_space(body))?.material()?;
    Some(scene.mesh().far_radius.unwrap_or_else(|| match scene.model() {
        ModelChoice::Condensed(_) => far_radius_at_rest(refined_radius),
        _ => far_radius_of_waves(material, estimate.contact_time, candidate_radius),
    }))
}

/// Returns the requested snapshots. By default they are those of the contact and, of bodies that flow, the unloaded bodies. A
/// dent that is deeper than half of the approach has no middle of the separation.
fn request(snapshots: Option<&Snapshots>, flow: Option<ImpactQuantities>) -> SnapshotRequest {
    match snapshots {
        None => {
            let is_default = |label: &SnapshotInstant| match label {
                SnapshotInstant::AfterSeparation => flow.is_some(),
                SnapshotInstant::MidSeparation => {
                    flow.is_none_or(|flow| flow.restitution > RESTITUTION_OF_SHALLOW_DENTS)
                }
                _ => true,
            };
            let labels = SnapshotInstant::ALL.into_iter().filter(is_default);
            SnapshotRequest::Labels(labels.collect())
        }
        Some(Snapshots::Labels(labels)) => SnapshotRequest::Labels(
            labels
                .iter()
                .filter_map(|word| {
                    SnapshotInstant::ALL.into_iter().find(|label| label.name() == word.word())
                })
                .collect(),
        ),
        Some(Snapshots::Count(n)) => SnapshotRequest::Count(*n),
        Some(Snapshots::Times(times)) => SnapshotRequest::Times(times.clone()),
    }
}
