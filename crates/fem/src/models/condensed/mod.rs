//! A case with linear finite elements that are condensed to their contact nodes: the meshes and the
//! materials of the explicit model, milliseconds instead of seconds.

mod cache;
mod collide;
mod effects;
mod outcome;

use std::sync::Arc;

use fem_condensed::{BodyInput, CondensedPair, ContactModel, PairSettings};
use fem_material::Material;
use fem_mesh::SphereMesh;

use crate::case::Case;
use crate::effects::Effect;
use crate::error::CaseError;
use crate::estimate::Estimate;
use crate::meshes::{MeshSource, mesh_error, mesh_sources};
use crate::model::{CondensedOptions as Options, Model};
use crate::model_tables::{CondensedTable, ModelTable};
use crate::plan::Plan;
use crate::quantity::Quantity;
use crate::schema::CaseFile;

use cache::PairKey;

pub use cache::PairCache;
pub use effects::QUASI_STATIC_LIMIT;

/// Growth of the condensed region when the contact leaves it.
const CANDIDATE_GROWTH: f64 = 2.0;
/// Half-width of the condensed region over that of the fine block.
const CANDIDATES_OVER_REFINED: f64 = 1.125;
/// And at least so much over the contact radius that Hertz expects, and so many elements.
const CANDIDATES_OVER_CONTACT: f64 = 1.3;
const CANDIDATE_ELEMENTS: f64 = 3.0;
/// Bytes an element takes: factor, assembly, a share of fields.
const BYTES_PER_ELEMENT: u64 = 8_000;

/// A case with condensed bodies, ready to run.
#[derive(Clone, Debug)]
pub struct Condensed {
    /// The case.
    pub case: Case,
    /// What was decided.
    pub plan: Plan,
    /// Which effects are on, and why.
    pub effects: Vec<Effect>,
    /// What the user should know before the run.
    pub warnings: Vec<String>,
    /// The bodies.
    pub pair: Arc<CondensedPair>,
    options: Options,
}

impl Condensed {
    /// Meshes and condenses, or takes the same pair from the cache without making a mesh.
    ///
    /// # Errors
    /// What the plan refuses; meshes that cannot be made or read; more elements or memory than the
    /// limits allow; a stiffness that cannot be factored.
    pub fn new(case: Case, cache: &PairCache) -> Result<Self, CaseError> {
        let options = options(&case);
        let plan = Plan::of(&case)?;
        let sources = mesh_sources(&case, &plan)?;
        check_memory(&case, &plan, &sources)?;
        let key = PairKey { bodies: bodies(&case, sources), settings: settings(&plan, options) };
        let pair = cache.pair(key, |key| {
            CondensedPair::new(inputs(&case, key)?, key.settings)
                .map_err(|error| case.error_at(&case.scene.model.path(), error.to_string()))
        })?;
        let (effects, warnings) = effects::decide(&case, &plan, &pair, options);
        Ok(Self { effects, warnings, pair, options, plan, case })
    }

    /// Whether the case could run, without making a mesh or a factor.
    ///
    /// # Errors
    /// As [`Condensed::new`], but for a stiffness that cannot be factored.
    pub fn check(case: &Case) -> Result<(), CaseError> {
        let plan = Plan::of(case)?;
        check_memory(case, &plan, &mesh_sources(case, &plan)?)
    }

    /// What closed forms say.
    pub fn estimate(&self) -> &Estimate {
        &self.plan.estimate
    }

    /// Those of the warnings that the speed causes.
    pub fn speed_warnings(&self) -> Vec<String> {
        effects::speed_warnings(&self.plan.estimate, self.options)
    }

    /// The keys of the model with their defaults.
    pub fn options(&self) -> Options {
        self.options
    }

    /// The case with the model's defaults filled in.
    pub fn resolve(&self) -> CaseFile {
        resolve(&self.case, &self.plan)
    }

    /// The case with the model's defaults filled in, without making a mesh.
    ///
    /// # Errors
    /// What the plan refuses.
    pub fn resolve_case(case: &Case) -> Result<CaseFile, CaseError> {
        Ok(resolve(case, &Plan::of(case)?))
    }

    /// Elements of both bodies.
    pub fn n_elements(&self) -> usize {
        self.meshes().iter().flatten().map(|mesh| mesh.quads().len()).sum()
    }

    /// The meshes; a wall has none.
    pub fn meshes(&self) -> [Option<&SphereMesh>; 2] {
        self.pair.inputs().each_ref().map(|input| match input {
            BodyInput::Sphere { mesh, .. } => Some(mesh),
            BodyInput::Wall => None,
        })
    }
}

fn options(case: &Case) -> Options {
    match case.scene.model {
        Model::Condensed(options) => options,
        _ => Options::default(),
    }
}

/// Bodies without their relaxations, which only the collision reads.
fn bodies(case: &Case, sources: [Option<MeshSource>; 2]) -> [Option<(MeshSource, Material)>; 2] {
    let mut sources = sources.into_iter();
    case.scene.bodies.each_ref().map(|body| {
        let source = sources.next().flatten()?;
        Some((source, body.material()?.without_relaxation()))
    })
}

fn inputs(case: &Case, key: &PairKey) -> Result<[BodyInput; 2], CaseError> {
    let input = |k: usize| match &key.bodies[k] {
        Some((source, material)) => {
            let mesh = source.build(k).map_err(|error| mesh_error(case, &error))?;
            Ok(BodyInput::Sphere { mesh, material: material.clone() })
        }
        None => Ok(BodyInput::Wall),
    };
    Ok([input(0)?, input(1)?])
}

/// The condensed region goes by the fine block, so that all speeds that share a mesh share a
/// factor; a contact that is expected further out doubles it.
fn settings(plan: &Plan, options: Options) -> PairSettings {
    let needed = (CANDIDATES_OVER_CONTACT * plan.estimate.hertz.max_contact_radius())
        .max(CANDIDATE_ELEMENTS * plan.contact_element_size);
    let mut candidate_radius = CANDIDATES_OVER_REFINED * plan.refined_radius;
    while candidate_radius < needed {
        candidate_radius *= CANDIDATE_GROWTH;
    }
    let contact = if options.penalty_springs {
        ContactModel::Springs(plan.contact_stiffness)
    } else {
        ContactModel::Exact
    };
    PairSettings {
        contact,
        vibration_modes: options.vibration_modes,
        ..PairSettings::new(candidate_radius)
    }
}

fn check_memory(
    case: &Case,
    plan: &Plan,
    sources: &[Option<MeshSource>; 2],
) -> Result<(), CaseError> {
    let mut elements = 0;
    for source in sources.iter().flatten() {
        elements += source.n_elements().map_err(|error| mesh_error(case, &error))?;
    }
    let bytes = BYTES_PER_ELEMENT.saturating_mul(elements as u64);
    if bytes <= plan.max_memory {
        return Ok(());
    }
    let message = format!("the factors would take about {:.1e} bytes", bytes as f64);
    Err(case.error_at("limits.memory", message).with_help(format!(
        "at most {:.1e} are allowed; use a larger mesh.contact_element_size, or raise \
         limits.memory",
        plan.max_memory as f64
    )))
}

/// Tables that the model does not read stay as they are.
fn resolve(case: &Case, plan: &Plan) -> CaseFile {
    let given = case.file.clone();
    let options = options(case);
    let mut file = plan.resolve(case);
    file.time = given.time;
    if !options.penalty_springs {
        file.contact = given.contact;
    }
    let table = CondensedTable {
        vibration_modes: Some(Quantity::from_si(options.vibration_modes as f64)),
        steps: Some(Quantity::from_si(options.steps as f64)),
        penalty_springs: Some(options.penalty_springs),
    };
    file.model = Some(ModelTable { condensed: Some(table), ..ModelTable::default() });
    file
}
