//! The plan: every number that the case leaves open, and which effects are on.

use fem_explicit::{Label, SnapshotRequest};

use crate::case::Case;
use crate::effects::{Effect, scene_effects};
use crate::error::CaseError;
use crate::estimate::Estimate;
use crate::scene::{Body, Shape, Snapshots};
use crate::schema::{
    ContactTable, EffectsTable, EmptyTable, LimitsTable, MeshTable, ModelTable, OutputTable,
    SnapshotsValue, StartTable, Switch, TimeTable,
};
use crate::{CaseFile, Quantity};

/// Elements across the contact radius: within 0.1 % in contact time, 0.3 % in
/// force and 2 % in pressure of the limit.
const ELEMENTS_PER_CONTACT_RADIUS: f64 = 8.0;
/// Half-width of the fine block over the contact radius.
const REFINED_OVER_CONTACT: f64 = 1.2;
/// Half-width of the searched region over the contact radius.
const CANDIDATES_OVER_CONTACT: f64 = 1.5;
/// Default penalty stiffness per area times element size, over E*. Measured on
/// the glass pair with eight elements across the contact: 10 costs 0.14 % of the
/// contact time, 20 costs 0.02 %, 40 adds noise to the force.
const PENALTY_OVER_MODULUS: f64 = 20.0;
const STEP_FACTOR: f64 = 0.9;
const MASS_SCALING: f64 = 2e-4;
const HISTORY_ROWS: usize = 1000;
/// A run gives up after so many expected contact times.
const GIVE_UP_AFTER: f64 = 50.0;
/// Default limits of `[limits]`.
const MAX_ELEMENTS: u64 = 2_000_000;
const MAX_ELEMENT_UPDATES: u64 = 1_000_000_000_000;
const MAX_MEMORY: u64 = 8_000_000_000;

/// Everything that is decided before meshes are made. SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// What closed forms say.
    pub estimate: Estimate,
    /// Distance of the surfaces at time 0, m.
    pub gap: f64,
    /// Edge length of the elements at the contact, m.
    pub contact_element_size: f64,
    /// Half-width of the fine block, m.
    pub refined_radius: f64,
    /// Ratio of the radii of successive rings; `None` for square cells.
    pub growth: Option<f64>,
    /// Whether any mesh is made here, and not read from a file.
    pub makes_meshes: bool,
    /// Radius out to which contact is looked for, m.
    pub candidate_radius: f64,
    /// Times the default penalty stiffness.
    pub penalty_factor: f64,
    /// Penalty stiffness per area times element size, Pa.
    pub contact_stiffness: f64,
    /// Time step over critical time step.
    pub step_factor: f64,
    /// Largest added mass as a fraction of a body's mass.
    pub mass_scaling: f64,
    /// Snapshots to keep.
    pub snapshots: SnapshotRequest,
    /// Rows of the history over the expected contact.
    pub history_rows: usize,
    /// The run gives up this long after first touch, s.
    pub max_time: f64,
    /// Refusal limits.
    pub max_elements: u64,
    /// Elements times steps.
    pub max_element_updates: u64,
    /// Bytes.
    pub max_memory: u64,
    /// Which effects are on, and why.
    pub effects: Vec<Effect>,
    /// What the user should know before the run.
    pub warnings: Vec<String>,
}

impl Plan {
    /// Decides on a case.
    ///
    /// # Errors
    /// A scene whose closed-form estimates are not finite.
    pub fn of(case: &Case) -> Result<Self, CaseError> {
        let scene = &case.scene;
        let estimate = Estimate::checked(case)?;
        // Half of the radius is as far as the fine block of a half disc reaches.
        let half_radius = 0.5 * estimate.smallest_radius;
        let contact_radius = estimate.contact_radius.min(half_radius);
        let contact_element_size = scene.mesh.contact_element_size.unwrap_or(
            (contact_radius / ELEMENTS_PER_CONTACT_RADIUS).min(estimate.smallest_radius / 12.0),
        );
        let refined_radius = scene
            .mesh
            .refined_radius
            .unwrap_or((REFINED_OVER_CONTACT * contact_radius).min(half_radius));
        let candidate_radius =
            (CANDIDATES_OVER_CONTACT * contact_radius).max(3.0 * contact_element_size);
        let penalty_factor = scene.penalty_factor.unwrap_or(1.0);
        let (effects, mut warnings) = scene_effects(scene, &estimate);
        let made_here = |body: &Body| matches!(body.shape, Shape::Sphere { mesh: None, .. });
        let makes_meshes = scene.bodies.iter().any(made_here);
        let given = ["contact_element_size", "refined_radius", "growth"]
            .into_iter()
            .find(|key| !makes_meshes && case.gives(&format!("mesh.{key}")));
        if let Some(key) = given {
            warnings.push(format!("mesh.{key} has no effect: the meshes are read from files"));
        }
        let limits = scene.limits;
        Ok(Self {
            gap: scene.gap.unwrap_or(0.0),
            contact_element_size,
            refined_radius,
            growth: scene.mesh.growth,
            makes_meshes,
            candidate_radius,
            penalty_factor,
            contact_stiffness: penalty_factor
                * PENALTY_OVER_MODULUS
                * estimate.hertz.pair().contact_modulus(),
            step_factor: scene.step_factor.unwrap_or(STEP_FACTOR),
            mass_scaling: scene.mass_scaling.unwrap_or(MASS_SCALING),
            snapshots: request(scene.snapshots.as_ref()),
            history_rows: HISTORY_ROWS,
            max_time: GIVE_UP_AFTER * estimate.contact_time,
            max_elements: limits.elements.unwrap_or(MAX_ELEMENTS),
            max_element_updates: limits.element_updates.unwrap_or(MAX_ELEMENT_UPDATES),
            max_memory: limits.memory.unwrap_or(MAX_MEMORY),
            effects,
            warnings,
            estimate,
        })
    }

    /// The case with every default filled in; it runs again to the same bits.
    pub fn resolve(&self, case: &Case) -> CaseFile {
        let mut file = case.file.clone();
        file.start = Some(StartTable { gap: Some(Quantity::from_si(self.gap)) });
        file.mesh = self.makes_meshes.then(|| MeshTable {
            contact_element_size: Some(Quantity::from_si(self.contact_element_size)),
            refined_radius: Some(Quantity::from_si(self.refined_radius)),
            growth: self.growth.map(Quantity::from_si),
        });
        file.contact =
            Some(ContactTable { penalty_factor: Some(Quantity::from_si(self.penalty_factor)) });
        file.time = Some(TimeTable {
            step_factor: Some(Quantity::from_si(self.step_factor)),
            mass_scaling: Some(Quantity::from_si(self.mass_scaling)),
        });
        let given = file.output.take().and_then(|output| output.snapshots);
        let labels = || {
            let text = |label: Label| Quantity::from_text(label.name());
            SnapshotsValue::List(Label::ALL.into_iter().map(text).collect())
        };
        file.output = Some(OutputTable { snapshots: Some(given.unwrap_or_else(labels)) });
        let given = file.effects.unwrap_or_default();
        file.effects = Some(EffectsTable {
            finite_strain: Some(given.finite_strain.unwrap_or(Switch::Auto)),
            mirror_symmetry: Some(given.mirror_symmetry.unwrap_or(Switch::Auto)),
            bulk_viscosity: Some(given.bulk_viscosity.unwrap_or(Switch::Auto)),
        });
        file.model = Some(ModelTable { fem: Some(EmptyTable {}), ..ModelTable::default() });
        file.limits = Some(LimitsTable {
            elements: Some(Quantity::from_si(self.max_elements as f64)),
            element_updates: Some(Quantity::from_si(self.max_element_updates as f64)),
            memory: Some(Quantity::from_si(self.max_memory as f64)),
        });
        file
    }
}

fn request(snapshots: Option<&Snapshots>) -> SnapshotRequest {
    match snapshots {
        None => SnapshotRequest::Labels(Label::ALL.to_vec()),
        Some(Snapshots::Labels(labels)) => SnapshotRequest::Labels(
            labels
                .iter()
                .filter_map(|word| Label::ALL.into_iter().find(|label| label.name() == word.word()))
                .collect(),
        ),
        Some(Snapshots::Count(n)) => SnapshotRequest::Count(*n),
        Some(Snapshots::Times(times)) => SnapshotRequest::Times(times.clone()),
    }
}
