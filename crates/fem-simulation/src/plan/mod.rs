//! The plan of finite elements: every number that the case leaves open.

pub(crate) mod body_source;
pub(crate) mod contact_method;
pub(crate) mod contact_noise_advice;
pub(crate) mod element_size;
pub(crate) mod limits;
pub(crate) mod mesh_offset;
pub(crate) mod mesh_source;
pub(crate) mod meshes;
pub(crate) mod pair_cache;
pub(crate) mod penalty_compliance;
pub(crate) mod probes;

use fem_case::schema::{
    ContactTable, EmptyTable, LimitsTable, MeshTable, ModelTable, OutputTable, SnapshotsValue,
    StartTable, TimeTable,
};
use fem_case::{
    Body, Case, CaseError, CaseFile, ContactMethod, ModelChoice, Quantity, Scene, Shape, Snapshots,
};
use fem_collision::{
    OutputRequest, QuantityOfInterest, SnapshotInstant, SnapshotRequest, far_radius_at_rest,
    far_radius_of_waves,
};

use crate::effects::percent;
use crate::estimate::Estimate;
use crate::estimate::viscous_flow;
use crate::plan::contact_method::contact_method;
use crate::plan::element_size::{MeshRule, touches_at_nodes};
use crate::plan::mesh_offset::{finer_body, staggered};
use crate::rejection::Rejection;

/// Half-width of the fine block over the contact radius.
const REFINED_OVER_CONTACT: f64 = 1.2;
/// Half-width of the searched region over the contact radius.
const CANDIDATES_OVER_CONTACT: f64 = 1.5;
/// Default penalty stiffness per area times element size, over E*. Measured on
/// the glass pair with eight elements across the contact: 10 costs 0.14 % of the
/// contact time, 20 costs 0.02 %, 40 adds noise to the force.
const PENALTY_OVER_MODULUS: f64 = 20.0;
const STEP_FACTOR: f64 = 0.9;
/// Lengths of elements of condensed bodies in an octave: a ninth more elements across the contact at most.
const LENGTHS: f64 = 8.0;
/// Of a length that was written and read.
const ROUNDING: f64 = 1e-9;
/// Default limits of `[limits]`.
const MAX_ELEMENTS: u64 = 2_000_000;
const MAX_ELEMENT_UPDATES: u64 = 1_000_000_000_000;
const MAX_MEMORY: u64 = 8_000_000_000;

/// Everything that is decided before meshes are made. SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Closed-form estimate.
    pub estimate: Estimate,
    /// Share of the scene's approach speed with which the computed bodies meet: ½ where half of a scene
    /// is computed.
    pub speed_share: f64,
    /// Distance of the surfaces at time 0, m.
    pub gap: f64,
    /// Edge length of the elements at the contact, m.
    pub contact_element_size: f64,
    /// The body with the smaller elements, where the meshes are staggered about that length.
    pub finer_body: Option<usize>,
    /// The quantity whose tolerance asks for most of the mesh and the mass that is moved, and that tolerance.
    pub asked_by: (QuantityOfInterest, f64),
    /// Half-width of the fine block, m.
    pub refined_radius: f64,
    /// Ratio of the radii of successive rings; `None` for square cells.
    pub growth: Option<f64>,
    /// Distance of the far boundary of a half-space, m; none without one.
    pub far_radius: Option<f64>,
    /// Whether any mesh is made here, and not read from a file.
    pub makes_meshes: bool,
    /// Whether no mesh that is chosen serves the tolerance, which a warning says.
    pub(crate) is_out_of_reach: bool,
    /// Radius out to which contact is looked for, m.
    pub candidate_radius: f64,
    /// How springs keep the surfaces apart.
    pub contact_method: ContactMethod,
    /// Times the default penalty stiffness.
    pub penalty_factor: f64,
    /// Penalty stiffness per area times element size, Pa.
    pub contact_stiffness: f64,
    /// Time step over critical time step.
    pub step_factor: f64,
    /// Largest added mass as a fraction of the lighter body's mass.
    pub mass_scaling: f64,
    /// Snapshots to keep.
    pub snapshots: SnapshotRequest,
    /// Elements above which a run is refused.
    pub max_elements: u64,
    /// Elements times steps above which a run is refused.
    pub max_element_updates: u64,
    /// Elastic contact times after which a run gives up.
    pub give_up_after: f64,
    /// Memory above which a run is refused, bytes.
    pub max_memory: u64,
    /// Keys of the case that the plan does not read.
    pub warnings: Vec<String>,
}

impl Plan {
    /// Decides on a scene.
    ///
    /// # Errors
    /// A scene whose closed-form estimates are not finite, or whose bodies flow into each other.
    pub fn of(scene: &Scene) -> Result<Self, Rejection> {
        let estimate = Estimate::checked(scene)?;
        viscous_flow::check(scene, &estimate)?;
        let finer_body = finer_body(scene);
        let rule = MeshRule::of(scene, &estimate, finer_body.is_some());
        let is_shared = touches_at_nodes(scene.model());
        let contact_element_size = scene.mesh().contact_element_size.unwrap_or_else(|| {
            let length = (divided_radius(&estimate) / rule.across)
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
        let candidate_radius = candidate_radius(&estimate, contact_element_size);
        let penalty_factor = scene.penalty_factor().unwrap_or(1.0);
        let contact_stiffness =
            penalty_factor * PENALTY_OVER_MODULUS * estimate.hertz.pair().contact_modulus();
        let per_area = contact_stiffness / contact_element_size;
        if scene.penalty_factor().is_some() && !(per_area.is_finite() && per_area > 0.0) {
            let found = format!(
                "springs of contact.penalty_factor = {penalty_factor:e} have {per_area:e} Pa/m"
            );
            return Err(Rejection::new("contact.penalty_factor", found)
                .with_help("it must be positive and finite; 1 is the default, leave it out"));
        }
        let made_here = |body: &Body| {
            matches!(body.shape(), Shape::Sphere { mesh: None, .. } | Shape::HalfSpace { .. })
        };
        let makes_meshes = scene.bodies().iter().any(made_here);
        let given = [
            ("contact_element_size", scene.mesh().contact_element_size),
            ("refined_radius", scene.mesh().refined_radius),
            ("growth", scene.mesh().growth),
        ];
        let unread = given.into_iter().find(|(_, value)| !makes_meshes && value.is_some());
        let far_radius = far_radius(scene, &estimate, refined_radius, candidate_radius);
        let warning =
            |key: &str| format!("mesh.{key} has no effect: the meshes are read from files");
        let mut warnings: Vec<String> = unread.map(|(key, _)| warning(key)).into_iter().collect();
        if far_radius.is_none() && scene.mesh().far_radius.is_some() {
            warnings.push("mesh.far_radius has no effect: no body is a half-space".to_string());
        }
        let is_chosen = makes_meshes && scene.mesh().contact_element_size.is_none();
        let out_of_reach = rule.reached.filter(|_| is_chosen);
        if let Some(reached) = out_of_reach {
            warnings.push(format!(
                "accuracy.tolerance is out of reach: {:.0} elements across the contact are taken, for about \
                 {} of the peak force: allow more of it",
                rule.across,
                percent(reached)
            ));
        }
        let limits = scene.limits();
        Ok(Self {
            speed_share: 1.0,
            gap: scene.gap().unwrap_or(0.0),
            contact_element_size,
            finer_body,
            asked_by: rule.asked_by,
            refined_radius,
            growth: scene.mesh().growth,
            far_radius,
            makes_meshes,
            is_out_of_reach: out_of_reach.is_some(),
            candidate_radius,
            contact_method: contact_method(scene),
            penalty_factor,
            contact_stiffness,
            step_factor: scene.step_factor().unwrap_or(STEP_FACTOR),
            mass_scaling: scene.mass_scaling().unwrap_or(rule.mass_scaling),
            snapshots: request(scene.snapshots()),
            max_elements: limits.elements.unwrap_or(MAX_ELEMENTS),
            max_element_updates: limits.element_updates.unwrap_or(MAX_ELEMENT_UPDATES),
            give_up_after: viscous_flow::give_up_after(scene, &estimate),
            max_memory: limits.memory.unwrap_or(MAX_MEMORY),
            warnings,
            estimate,
        })
    }

    /// Decides on the scene of a case, faults with their place.
    ///
    /// # Errors
    /// As [`Plan::of`].
    pub fn of_case(case: &Case) -> Result<Self, CaseError> {
        Self::of(case.scene()).map_err(|refusal| refusal.in_case(case))
    }

    /// Edge lengths of the elements of both bodies at the contact, m.
    pub fn element_sizes(&self) -> [f64; 2] {
        let length = self.contact_element_size;
        match self.finer_body {
            Some(finer) => staggered(length, divided_radius(&self.estimate), finer),
            None => [length; 2],
        }
    }

    /// The key by which a case makes the mesh away from a contact of this radius, m, another one than is chosen, if it
    /// does.
    pub(crate) fn far_mesh_key(&self, scene: &Scene, contact_radius: f64) -> Option<&'static str> {
        let chosen = REFINED_OVER_CONTACT * contact_radius;
        let chosen = (1.0 - ROUNDING) * chosen.min(self.estimate.smallest_radius);
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
            give_up_after: self.give_up_after,
            ..OutputRequest::history()
        }
    }

    /// The case as written with every default filled in; it runs again to the same bits.
    pub fn resolve(&self, mut file: CaseFile) -> CaseFile {
        file.start = Some(StartTable { gap: Some(Quantity::from_si(self.gap)) });
        file.mesh = self.makes_meshes.then(|| MeshTable {
            contact_element_size: Some(Quantity::from_si(self.contact_element_size)),
            refined_radius: Some(Quantity::from_si(self.refined_radius)),
            growth: self.growth.map(Quantity::from_si),
            far_radius: self.far_radius.map(Quantity::from_si),
            staggered: Some(self.finer_body.is_some()),
        });
        file.contact = Some(ContactTable {
            method: Some(self.contact_method),
            penalty_factor: Some(Quantity::from_si(self.penalty_factor)),
        });
        file.time = Some(TimeTable {
            step_factor: Some(Quantity::from_si(self.step_factor)),
            mass_scaling: Some(Quantity::from_si(self.mass_scaling)),
        });
        let OutputTable { snapshots: given, fields, probe, report } =
            file.output.take().unwrap_or_default();
        let labels = || {
            let text = |label: SnapshotInstant| Quantity::from_text(label.name());
            SnapshotsValue::List(SnapshotInstant::ALL.into_iter().map(text).collect())
        };
        let snapshots = Some(given.unwrap_or_else(labels));
        file.output = Some(OutputTable { snapshots, fields, probe, report });
        file.effects = Some(file.effects.unwrap_or_default().filled());
        file.model = Some(ModelTable { fem: Some(EmptyTable {}), ..ModelTable::default() });
        file.limits = Some(LimitsTable {
            elements: Some(Quantity::from_si(self.max_elements as f64)),
            element_updates: Some(Quantity::from_si(self.max_element_updates as f64)),
            memory: Some(Quantity::from_si(self.max_memory as f64)),
        });
        file
    }
}

/// The largest length (m) that is none larger than this and a whole power of [`LENGTHS`] of the smallest radius: scenes
/// that differ in speed, relaxation or modulus have the same meshes, and condensed bodies are eliminated once.
fn shared_length(length: f64, smallest_radius: f64) -> f64 {
    let n = (LENGTHS * (smallest_radius / length).log2() * (1.0 - 1e-12)).ceil();
    smallest_radius * (-n / LENGTHS).exp2()
}

/// The contact radius (m) that elements divide: they are made no larger for a contact that is wider than half
/// of a body.
pub fn divided_radius(estimate: &Estimate) -> f64 {
    radius_of_elements(estimate).min(0.5 * estimate.smallest_radius)
}

/// The same of any contact. Bodies that relax have the mesh of elastic ones up to
/// twice the radius with fully relaxed moduli, an upper limit that the contact does not reach; from four times
/// on, where it goes on growing, that radius counts.
fn radius_of_elements(estimate: &Estimate) -> f64 {
    let elastic = estimate.hertz.max_contact_radius();
    let wider = 0.5 * estimate.contact_radius / elastic;
    if wider <= 1.0 { elastic } else { (elastic * wider * wider).min(estimate.contact_radius) }
}

/// Radius out to which explicit elements of this size (m) look for the contact of an estimate at
/// first, m.
pub(crate) fn candidate_radius(estimate: &Estimate, contact_element_size: f64) -> f64 {
    let contact_radius = estimate.contact_radius.min(0.5 * estimate.smallest_radius);
    (CANDIDATES_OVER_CONTACT * contact_radius).max(3.0 * contact_element_size)
}

/// Where the mesh of a half-space ends: where no wave comes back from within the run, or, of bodies that
/// are always in balance, where it takes nothing away from the compliance.
fn far_radius(
    scene: &Scene,
    estimate: &Estimate,
    refined_radius: f64,
    candidate_radius: f64,
) -> Option<f64> {
    let half_space = |body: &Body| matches!(body.shape(), Shape::HalfSpace { .. });
    let material = scene.bodies().iter().find(|body| half_space(body))?.material()?;
    Some(scene.mesh().far_radius.unwrap_or_else(|| match scene.model() {
        ModelChoice::Condensed(_) => far_radius_at_rest(refined_radius),
        _ => far_radius_of_waves(material, estimate.contact_time, candidate_radius),
    }))
}

fn request(snapshots: Option<&Snapshots>) -> SnapshotRequest {
    match snapshots {
        None => SnapshotRequest::Labels(SnapshotInstant::ALL.to_vec()),
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
