//! The case file as written: one struct a table, one field a key, nothing decided yet.
//!
//! Everything optional is an `Option`. The plan fills in what is `None`, and the same structs
//! serialize back to a case file (TOML) or into a summary (JSON), numbers in SI.

pub(crate) mod accuracy_table;
pub(crate) mod body_tables;
pub(crate) mod gravity_tables;
pub(crate) mod keyword;
pub(crate) mod material_tables;
pub(crate) mod model_tables;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::quantity::{Bytes, Count, Length, Number, Quantity, QuantityKind, Time};
use crate::schema::keyword::keywords;

pub use crate::schema::accuracy_table::*;
pub use crate::schema::body_tables::*;
pub use crate::schema::gravity_tables::*;
pub use crate::schema::material_tables::*;
pub use crate::schema::model_tables::*;

/// A whole case file.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(extend("required" = ["body"])))]
#[serde(deny_unknown_fields)]
pub struct CaseFile {
    /// What the case is about; the file's stem if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// The tables `[material.NAME]`, by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    #[cfg_attr(feature = "schema", schemars(extend("patternProperties" = crate::json_schema::library_tables())))]
    pub material: BTreeMap<String, MaterialTable>,
    /// `[[body]]`, exactly two; the first lies below the second on the axis y.
    #[serde(default)]
    #[cfg_attr(feature = "schema", schemars(length(equal = 2)))]
    pub body: Vec<BodyTable>,
    /// Where the bodies start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start: Option<StartTable>,
    /// The weight of the upper sphere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gravity: Option<GravityTable>,
    /// When the run is over.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stop: Option<StopTable>,
    /// How finely the bodies are divided.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<MeshTable>,
    /// How stiff the contact is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact: Option<ContactTable>,
    /// How long a time step is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<TimeTable>,
    /// Which instants are drawn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub output: Option<OutputTable>,
    /// Which model computes the collision.
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

/// A case made in code. Everything else is a field: `file.title = Some("…".into())`.
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
    /// Two bodies, the first below the second; materials are still to come.
    pub fn of_bodies(first: BodyTable, second: BodyTable) -> Self {
        Self { body: vec![first, second], ..Self::default() }
    }

    /// This case with `[material.NAME]`, in place of one of that name.
    pub fn with_material(mut self, name: impl Into<String>, material: MaterialTable) -> Self {
        self.material.insert(name.into(), material);
        self
    }

    /// This case, computed by this model.
    pub fn with_model(self, model: impl Into<ModelTable>) -> Self {
        Self { model: Some(model.into()), ..self }
    }
}

/// `[start]`: where the bodies are at time 0.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table [start]")]
pub struct StartTable {
    /// Distance of the surfaces on the axis at time 0, >= 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gap: Option<Quantity<Length>>,
}

/// `[mesh]`: how finely the bodies are divided.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table [mesh]")]
pub struct MeshTable {
    /// Edge length of the elements at the contact, > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_element_size: Option<Quantity<Length>>,
    /// Half-width of the uniformly fine block around the contact, > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refined_radius: Option<Quantity<Length>>,
    /// Ratio of the sizes of neighbouring elements outside of that block, > 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub growth: Option<Quantity<Number>>,
    /// Distance of the far boundary of a half-space, > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub far_radius: Option<Quantity<Length>>,
    /// Whether elements of one body are a little larger and those of the other a little smaller, so that at
    /// the edge of the contact their nodes lie between each other.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub staggered: Option<bool>,
}

/// `[contact]`: how springs keep the surfaces apart, and how stiff they are.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table [contact]")]
pub struct ContactTable {
    /// Where the springs are, and what they pull at.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub method: Option<ContactMethod>,
    /// Times the default normal stiffness per area, > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub penalty_factor: Option<Quantity<Number>>,
}

keywords! {
    /// How springs keep the surfaces apart.
    ContactMethod {
        /// Springs at the Gauss points of both surfaces, whose nodes have no mass and are always in
        /// balance.
        Massless = "massless",
        /// The same springs between nodes that have mass.
        Penalty = "penalty",
        /// Springs at the nodes of each surface against the other one.
        NodeToSurface = "node_to_surface",
    }
}

/// `[time]`: how long a time step is.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table [time]")]
pub struct TimeTable {
    /// Times the critical time step, > 0 and at most 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step_factor: Option<Quantity<Number>>,
    /// Largest mass that is moved to light nodes, as a fraction of the lighter body's mass, and of several times that in a
    /// body that gives way less, but no more than of its own; 0 to 0.1; 0 forbids it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_scaling: Option<Quantity<Number>>,
}

/// `[output]`: what is drawn of the collision.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table [output]")]
pub struct OutputTable {
    /// The instants at which fields are written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub snapshots: Option<SnapshotsValue>,
    /// The arrays that the files of snapshots have beside the body's number; all unless told otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fields: Option<Vec<Field>>,
    /// `[[output.probe]]`: places of which is told what happens there over time.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub probe: Vec<ProbeTable>,
    /// Whether a run writes its page, `report.html`; it does unless told otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub report: Option<bool>,
}

/// `snapshots`: a count, or a list of labels or of times.
#[derive(Clone, Debug, PartialEq)]
pub enum SnapshotsValue {
    /// So many, evenly over the contact.
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
        /// Radial stress.
        SigmaRr = "sigma_rr",
        /// Stress along the axis.
        SigmaYy = "sigma_yy",
        /// Hoop stress.
        SigmaTt = "sigma_tt",
        /// Shear stress.
        SigmaRy = "sigma_ry",
        /// Minus the mean of the normal stresses.
        Pressure = "pressure",
        /// Equivalent stress of von Mises.
        VonMises = "von_mises",
        /// Contact pressure on the surfaces.
        ContactPressure = "contact_pressure",
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
    }
}

impl SnapshotsValue {
    /// No instant: nothing is drawn.
    pub fn none() -> Self {
        Self::List(Vec::new())
    }

    /// The instants with these names.
    pub fn labels(labels: impl IntoIterator<Item = SnapshotLabel>) -> Self {
        Self::List(labels.into_iter().map(|label| label.word().into()).collect())
    }

    /// The instants at these times since the start of the case.
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
                let example = Time::KIND.example;
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

/// `[effects]`: numerical effects, forced or left to the plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table [effects]")]
pub struct EffectsTable {
    /// Relaxation of the materials, a term at a time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub viscoelasticity: Option<Switch>,
    /// Large rotations and strains.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub finite_strain: Option<Switch>,
    /// Surfaces of unlike materials that slip on each other.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface_slip: Option<Switch>,
    /// What waves take along that do not come back within the contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub partner_waves: Option<Switch>,
    /// Two identical bodies as one against a rigid plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mirror_symmetry: Option<Switch>,
    /// The stiffer body as a rigid one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rigid_partner: Option<Switch>,
    /// Stiffness of the modes that a mean stress does not see.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hourglass_control: Option<Switch>,
    /// Artificial viscosity against shocks.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bulk_viscosity: Option<Switch>,
}

impl EffectsTable {
    /// This table with what it leaves open left to the plan in words.
    pub fn filled(self) -> Self {
        let auto = |switch: Option<Switch>| switch.or(Some(Switch::Auto));
        Self {
            viscoelasticity: auto(self.viscoelasticity),
            finite_strain: auto(self.finite_strain),
            surface_slip: auto(self.surface_slip),
            partner_waves: auto(self.partner_waves),
            mirror_symmetry: auto(self.mirror_symmetry),
            rigid_partner: auto(self.rigid_partner),
            hourglass_control: auto(self.hourglass_control),
            bulk_viscosity: auto(self.bulk_viscosity),
        }
    }
}

keywords! {
    /// Who decides on an effect.
    Switch {
        /// The plan decides.
        Auto = "auto",
        /// The case decides: the effect is on.
        On = "on",
        /// The case decides: the effect is off.
        Off = "off",
    }
}

/// `[limits]`: a run that needs more is refused before it starts.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table [limits]")]
pub struct LimitsTable {
    /// Elements of both bodies together.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elements: Option<Quantity<Count>>,
    /// Elements times steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub element_updates: Option<Quantity<Count>>,
    /// Memory of the run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub memory: Option<Quantity<Bytes>>,
}

/// Whether the value at `path` may be an array. serde alone does not tell: a derived struct
/// reads `sphere = ["22.2 mm"]` as its fields in order.
pub(crate) fn is_list(path: &str) -> bool {
    let is_terms = path.starts_with("material.") && path.ends_with(".relaxation.terms");
    is_terms || matches!(path, "body" | "output.snapshots" | "output.fields" | "output.probe")
}
