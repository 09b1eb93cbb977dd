//! The case file as written: one struct per table and one field per key, before any decision.
//!
//! Every optional key is an `Option`. The plan fills in those that are `None`, and the same structs serialize to a case
//! file (TOML) or into a summary (JSON), with numbers in SI.

pub(crate) mod accuracy_table;
pub(crate) mod body_tables;
pub(crate) mod flow_table;
pub(crate) mod macros;
pub(crate) mod material_tables;
pub(crate) mod model_tables;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::quantity::{
    Acceleration, Bytes, Count, Length, Number, Quantity, QuantityKind, SurfaceEnergy, Temperature,
    Time,
};
use crate::schema::macros::{keywords, optional_keys};

pub use crate::schema::accuracy_table::*;
pub use crate::schema::body_tables::*;
pub use crate::schema::flow_table::*;
pub use crate::schema::material_tables::*;
pub use crate::schema::model_tables::*;

/// A whole case file.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema), schemars(extend("required" = ["body"])))]
#[serde(deny_unknown_fields)]
pub struct CaseFile {
    /// Title of the case; the file's stem if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// Conditions of both bodies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene: Option<SceneTable>,
    /// The tables `[material.NAME]`, by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    // A table `[material."lib:NAME"]` may have any keys, since the library gives the others.
    #[cfg_attr(all(test, feature = "schema"), schemars(extend("patternProperties" = serde_json::json!({ "^lib:": { "type": "object" } }))))]
    pub material: BTreeMap<String, MaterialTable>,
    /// `[[body]]`, exactly two; the first lies below the second on the axis y.
    #[serde(default)]
    #[cfg_attr(all(test, feature = "schema"), schemars(length(equal = 2)))]
    pub body: Vec<BodyTable>,
    /// Positions of the bodies at time 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start: Option<StartTable>,
    /// The weight of the upper sphere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gravity: Option<GravityTable>,
    /// End of the run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stop: Option<StopTable>,
    /// Element sizes of the mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<MeshTable>,
    /// Contact method, penalty stiffness, work of adhesion and friction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact: Option<ContactTable>,
    /// Length of the time step.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<TimeTable>,
    /// Instants and positions whose fields are written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub output: Option<OutputTable>,
    /// Model of the collision.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model: Option<ModelTable>,
    /// Tolerances of the results.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<AccuracyTable>,
    /// Numerical effects, forced or left to the plan.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub effects: Option<EffectsTable>,
    /// Limits of the cost of a run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limits: Option<LimitsTable>,
}

/// Constructors of a case in code. All other keys are fields: `file.title = Some("…".into())`.
///
/// ```
/// use fem_case::CaseFile;
/// use fem_case::schema::{ActsOn, BodyTable, MaterialTable, ModelTable, TermTable};
///
/// let glass = MaterialTable::from_youngs_modulus_poissons_ratio("2390 kg/m^3", "63 GPa", 0.244)
///     .relaxing(ActsOn::All, [TermTable::with_decay_rate(1.0, "2708 1/s")]);
/// let striker = BodyTable::sphere("striker", "22.2 mm", "glass").approaching("0.5 m/s");
/// let target = BodyTable::sphere("target", "15.9 mm", "glass");
/// let file = CaseFile::of_bodies(striker, target)
///     .with_material("glass", glass)
///     .with_model(ModelTable::ting());
/// # assert!(file.to_toml().unwrap().contains("decay_rate = 2708.0"));
/// ```
impl CaseFile {
    /// Creates a case of two bodies, the first below the second, without materials.
    pub fn of_bodies(first: BodyTable, second: BodyTable) -> Self {
        Self { body: vec![first, second], ..Self::default() }
    }

    /// Returns this case with `[material.NAME]`, which replaces one of that name.
    pub fn with_material(mut self, name: impl Into<String>, material: MaterialTable) -> Self {
        self.material.insert(name.into(), material);
        self
    }

    /// Returns this case, computed by this model.
    pub fn with_model(self, model: impl Into<ModelTable>) -> Self {
        Self { model: Some(model.into()), ..self }
    }
}

optional_keys! {
    /// `[scene]`: the conditions of both bodies.
    SceneTable, "a table [scene]" {
        /// Temperature of the bodies, > 0, which shifts the relaxation times of materials with a law `shift`; the
        /// reference temperature of each if absent.
        temperature: Quantity<Temperature>,
    }
}

optional_keys! {
    /// `[start]`: the positions of the bodies at time 0.
    StartTable, "a table [start]" {
        /// Distance of the surfaces on the axis at time 0, >= 0.
        gap: Quantity<Length>,
    }
}

/// `[gravity]`: the weight of the upper sphere, which the lower body supports.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table [gravity]")]
pub struct GravityTable {
    /// Acceleration along -y, > 0.
    pub acceleration: Quantity<Acceleration>,
    /// Where a ball that dents falls next; needed if a body flows plastically and bounces.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spot: Option<Spot>,
}

keywords! {
    /// The place of a bounce on bodies that are dented.
    Spot {
        /// Every contact is between undented surfaces.
        Fresh = "fresh",
        /// Every contact is at the dents of those before.
        Same = "same",
    }
}

impl GravityTable {
    /// Creates gravity with this acceleration.
    pub fn new(acceleration: impl Into<Quantity<Acceleration>>) -> Self {
        Self { acceleration: acceleration.into(), spot: None }
    }
}

optional_keys! {
    /// `[stop]`: the end of a run.
    StopTable, "a table [stop]" {
        /// Number of contacts after which the run ends, >= 1; rest ends it earlier.
        bounces: Quantity<Count>,
    }
}

optional_keys! {
    /// `[mesh]`: the element sizes.
    MeshTable, "a table [mesh]" {
        /// Edge length of the elements at the contact, > 0.
        contact_element_size: Quantity<Length>,
        /// Half-width of the uniformly fine block around the contact, > 0.
        refined_radius: Quantity<Length>,
        /// Ratio of the sizes of neighbouring elements outside of that block, > 1.
        growth: Quantity<Number>,
        /// Distance of the far boundary of a half-space, > 0.
        far_radius: Quantity<Length>,
        /// Whether the meshes are offset: elements of one body are slightly larger and those of the other slightly
        /// smaller, so that at the edge of the contact the nodes of one body lie between those of the other.
        staggered: bool,
    }
}

optional_keys! {
    /// `[contact]`: the contact method, the stiffness of its penalty springs, adhesion and friction of the pair.
    ContactTable, "a table [contact]" {
        /// Positions of the penalty springs and the nodes that they act on.
        method: ContactMethod,
        /// Factor on the default normal penalty stiffness per area, > 0.
        penalty_factor: Quantity<Number>,
        /// Work of adhesion of the pair, >= 0; by default it follows from the surface energies of the materials.
        work_of_adhesion: Quantity<SurfaceEnergy>,
        /// Coulomb's coefficient of friction, >= 0; 0 if absent.
        friction: Quantity<Number>,
    }
}

keywords! {
    /// The contact method: where penalty springs act.
    ContactMethod {
        /// Springs at the Gauss points of both surfaces, whose nodes have no mass and are in static equilibrium.
        Massless = "massless",
        /// The same springs between nodes that have mass.
        Penalty = "penalty",
        /// Springs at the nodes of each surface against the other one.
        NodeToSurface = "node_to_surface",
    }
}

optional_keys! {
    /// `[time]`: the length of the time step.
    TimeTable, "a table [time]" {
        /// Factor on the critical time step, > 0 and at most 1.
        step_factor: Quantity<Number>,
        /// Mass scaling: the largest mass that is moved to light nodes, as a fraction of the lighter body's mass, from 0
        /// (none) to 0.1. In a stiffer body the limit is several times as large, but at most that fraction of its own mass.
        mass_scaling: Quantity<Number>,
    }
}

/// `[output]`: the fields that are written.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table [output]")]
pub struct OutputTable {
    /// The instants at which fields are written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub snapshots: Option<SnapshotsValue>,
    /// The arrays in the files of snapshots, in addition to the body's number; all by default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fields: Option<Vec<Field>>,
    /// `[[output.probe]]`: points whose fields are recorded over time.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub probe: Vec<ProbeTable>,
    /// Whether a run writes its page, `report.html`; true by default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub report: Option<bool>,
}

/// `[[output.probe]]`: a point of a body whose fields are recorded over time.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table [[output.probe]]")]
pub struct ProbeTable {
    /// The name of a body.
    pub body: String,
    /// Distance from the axis in the undeformed body, >= 0.
    pub r: Quantity<Length>,
    /// Distance along the axis from the point of first contact; negative in the lower body.
    pub y: Quantity<Length>,
}

impl ProbeTable {
    /// Creates a probe at a point of a body.
    pub fn new(
        body: impl Into<String>,
        r: impl Into<Quantity<Length>>,
        y: impl Into<Quantity<Length>>,
    ) -> Self {
        Self { body: body.into(), r: r.into(), y: y.into() }
    }
}

/// `snapshots`: a count, or a list of labels or of times.
#[derive(Clone, Debug, PartialEq)]
pub enum SnapshotsValue {
    /// A number of snapshots, evenly over the contact.
    Count(f64),
    /// Labels (texts that are among [`SnapshotLabel::WORDS`]) or times.
    List(Vec<Quantity<Time>>),
}

keywords! {
    /// An array in the files of snapshots, by its name there.
    Field {
        /// Displacement of the points.
        Displacement = "displacement",
        /// Velocity of the points.
        Velocity = "velocity",
        /// Radial normal stress.
        SigmaRr = "sigma_rr",
        /// Axial normal stress.
        SigmaYy = "sigma_yy",
        /// Circumferential normal stress (hoop stress).
        SigmaTt = "sigma_tt",
        /// Shear stress in the radial-axial plane.
        SigmaRy = "sigma_ry",
        /// Minus the mean of the normal stresses.
        Pressure = "pressure",
        /// Von Mises equivalent stress.
        VonMises = "von_mises",
        /// Contact pressure on the surfaces.
        ContactPressure = "contact_pressure",
        /// Equivalent plastic strain of bodies that flow.
        PlasticStrain = "plastic_strain",
        /// Plastic work per undeformed volume of bodies that flow.
        PlasticWork = "plastic_work",
    }
}

keywords! {
    /// An instant of the collision that has a name.
    SnapshotLabel {
        /// The approach reaches half its maximum.
        MidCompression = "mid-compression",
        /// The approach is at its maximum.
        Maximum = "maximum",
        /// The approach is back at half its maximum.
        MidSeparation = "mid-separation",
        /// The last step with a contact force.
        LastContact = "last-contact",
        /// Bodies that flowed plastically, unloaded and without their vibration.
        AfterSeparation = "after-separation",
    }
}

impl SnapshotsValue {
    /// Requests no snapshot.
    pub fn none() -> Self {
        Self::List(Vec::new())
    }

    /// Requests the instants with these names.
    pub fn labels(labels: impl IntoIterator<Item = SnapshotLabel>) -> Self {
        Self::List(labels.into_iter().map(|label| label.word().into()).collect())
    }

    /// Requests the instants at these times since the start of the case.
    pub fn times<T: Into<Quantity<Time>>>(times: impl IntoIterator<Item = T>) -> Self {
        Self::List(times.into_iter().map(T::into).collect())
    }
}

impl Serialize for SnapshotsValue {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            SnapshotsValue::Count(count) if count.fract() == 0.0 && count.abs() < 2e9 => {
                serializer.serialize_i64(*count as i64)
            }
            SnapshotsValue::Count(count) => serializer.serialize_f64(*count),
            SnapshotsValue::List(list) => list.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for SnapshotsValue {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl<'de> serde::de::Visitor<'de> for Visitor {
            type Value = SnapshotsValue;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                let example = Time::INFO.example;
                write!(f, "a list of labels or of times, [\"maximum\"] or [{example}], or a count")
            }

            fn visit_i64<E>(self, count: i64) -> Result<SnapshotsValue, E> {
                Ok(SnapshotsValue::Count(count as f64))
            }

            fn visit_f64<E>(self, count: f64) -> Result<SnapshotsValue, E> {
                Ok(SnapshotsValue::Count(count))
            }

            fn visit_seq<A: serde::de::SeqAccess<'de>>(
                self,
                mut sequence: A,
            ) -> Result<SnapshotsValue, A::Error> {
                let mut list = Vec::new();
                while let Some(item) = sequence.next_element()? {
                    list.push(item);
                }
                Ok(SnapshotsValue::List(list))
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

optional_keys! {
    /// `[effects]`: numerical effects, forced or left to the plan.
    #[derive(Copy, Eq)]
    EffectsTable, "a table [effects]" {
        /// Relaxation of the materials, term by term.
        viscoelasticity: Switch,
        /// Large rotations and strains.
        finite_strain: Switch,
        /// Plastic flow of the materials that have the table `flow`.
        plastic_flow: Switch,
        /// Slip between surfaces of different materials.
        surface_slip: Switch,
        /// Bending of a plate; without it the plate is a half-space.
        plate_bending: Switch,
        /// Energy of waves that do not return within the contact.
        partner_waves: Switch,
        /// Two identical bodies computed as one against a rigid plane.
        mirror_symmetry: Switch,
        /// The stiffer body computed as rigid.
        rigid_partner: Switch,
        /// Hourglass control: stiffness of the modes that the mean stress does not resist.
        hourglass_control: Switch,
        /// Artificial bulk viscosity against shocks.
        bulk_viscosity: Switch,
    }
}

impl EffectsTable {
    /// Returns this table with `auto` for absent keys.
    pub fn filled(self) -> Self {
        let auto = |switch: Option<Switch>| switch.or(Some(Switch::Auto));
        Self {
            viscoelasticity: auto(self.viscoelasticity),
            finite_strain: auto(self.finite_strain),
            plastic_flow: auto(self.plastic_flow),
            surface_slip: auto(self.surface_slip),
            plate_bending: auto(self.plate_bending),
            partner_waves: auto(self.partner_waves),
            mirror_symmetry: auto(self.mirror_symmetry),
            rigid_partner: auto(self.rigid_partner),
            hourglass_control: auto(self.hourglass_control),
            bulk_viscosity: auto(self.bulk_viscosity),
        }
    }
}

keywords! {
    /// Setting of an effect.
    Switch {
        /// The plan decides whether the effect is on.
        Auto = "auto",
        /// The effect is on.
        On = "on",
        /// The effect is off.
        Off = "off",
    }
}

optional_keys! {
    /// `[limits]`: a run that needs more is rejected before it starts.
    LimitsTable, "a table [limits]" {
        /// Number of elements of both bodies.
        elements: Quantity<Count>,
        /// Number of elements times number of steps.
        element_updates: Quantity<Count>,
        /// Memory of the run.
        memory: Quantity<Bytes>,
    }
}

/// Returns whether the value at `path` may be an array. serde alone does not check this: a derived struct reads
/// `sphere = ["22.2 mm"]` as its fields in order.
pub(crate) fn is_list(path: &str) -> bool {
    let is_of_material = path.starts_with("material.")
        && (path.ends_with(".relaxation.terms")
            || path.contains(".relaxation.shift.table")
            || path.contains(".relaxation.band.loss_uncertainty")
            || path.contains(".flow.hardening.table"));
    is_of_material || matches!(path, "body" | "output.snapshots" | "output.fields" | "output.probe")
}
