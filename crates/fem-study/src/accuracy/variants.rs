//! The variants of a scene that the accuracy study computes.

use fem_case::schema::ContactMethod;
use fem_case::{Case, CaseError, Scene};

use super::variant::{Series, Variant};
use fem_simulation::Estimate;
use fem_simulation::MeshRule;
use fem_simulation::Simulation;
use fem_simulation::effects::FiniteStrain;
use fem_simulation::error::{Setting, first_contact};
use fem_simulation::{ErrorEstimator, RefinedBeforeRun};
use fem_simulation::{Plan, divided_radius};
use fem_simulation::{contact_method, unread};

/// Elements across the contact radius, of condensed bodies.
const CONDENSED: [f64; 9] = [3.0, 4.0, 5.0, 6.0, 8.0, 11.0, 16.0, 23.0, 32.0];
/// The same of condensed bodies that vibrate.
const VIBRATING: [f64; 3] = [4.0, 8.0, 16.0];
/// The same of explicit elements.
const EXPLICIT: [f64; 8] = [3.0, 4.0, 5.0, 6.0, 8.0, 11.0, 16.0, 23.0];
/// The same with much mass that is moved, and with other springs.
const COMPARED: [f64; 5] = [3.0, 4.0, 5.0, 8.0, 11.0];
/// The same at finite strain.
const STRAINED: [f64; 2] = [4.0, 8.0];
/// Where one setting is varied by itself.
pub(super) const COMMON: f64 = 8.0;
/// Modes of each body that vibrates.
const MODES: u8 = 12;
/// Large mass scaling, as a multiple of the mesh's own: it halves the length of the run.
const MUCH_MASS: f64 = 4.0;
const PENALTY_FACTORS: [f64; 2] = [0.25, 4.0];
const MASS_SCALINGS: [f64; 3] = [0.0, 1e-3, 2e-2];
const STEP_FACTORS: [f64; 1] = [0.45];
/// Growth of a mesh of half as many elements.
const GROWN: f64 = 1.25;

/// Lengths at the contact, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lengths {
    /// Contact radius by closed forms, m: elements are counted across it.
    pub contact_radius: f64,
    /// The length that elements divide, m.
    pub(super) divided: f64,
}

impl Lengths {
    /// Returns the length of elements for a number of elements across the contact.
    pub(super) fn element(&self, across: f64) -> f64 {
        short(self.divided / across)
    }
}

/// The variants of a scene.
#[derive(Clone, Debug)]
pub struct Variants {
    /// The variants, grouped by series, from coarse to fine.
    pub all: Vec<Variant>,
    /// Lengths at the contact that decide on element sizes.
    pub lengths: Lengths,
    /// Whether a run of the case refines its mesh if that of its variant does not meet the tolerance.
    pub is_open: bool,
    /// The first error among the variants that were left out.
    refused: Option<CaseError>,
}

impl Variants {
    /// Creates the variants of a case, for its first contact if gravity brings its body back.
    ///
    /// # Errors
    /// No model with elements supports any mesh: the first such error. Single variants that fail, for
    /// example by the limits of the case, are left out.
    pub fn of(case: &Case) -> Result<Self, CaseError> {
        let base = case.edited(|file| {
            (file.mesh, file.contact, file.time, file.output) = (None, None, None, None);
            file.stop = first_contact(file);
        })?;
        let plan = Plan::of_case(&base)?;
        let contact_radius = plan.estimate.contact_radius;
        // Of a contact as wide as its sphere the plan counts elements across less than all of it.
        let unit = contact_radius.min(divided_radius(&plan.estimate));
        let lengths = Lengths { contact_radius, divided: unit };
        let mut variants = Self { all: Vec::new(), lengths, is_open: false, refused: None };
        let own = case.edited(|file| (file.output, file.stop) = (None, first_contact(file)))?;
        match as_it_runs(own) {
            Ok((own, is_open)) => {
                variants.add(&own, Series::AsWritten, &[], None);
                variants.is_open = is_open;
            }
            Err(refused) => variants.refused = Some(refused),
        }
        let add = |series, settings: &[Setting], value| {
            variants.add(&base, series, settings, value);
        };
        let made = plan.makes_meshes.then_some(plan.finer_body.is_some());
        Self::fill(&base, made, &lengths, add);
        match variants.refused.take() {
            // What has only closed forms has no limit to tell.
            Some(refused) if !variants.all.iter().any(Variant::has_elements) => Err(refused),
            _ => Ok(variants),
        }
    }

    /// Adds the variants that the scene needs, series by series, on staggered meshes or not, unless meshes
    /// are read from files.
    fn fill(
        base: &Case,
        made: Option<bool>,
        lengths: &Lengths,
        mut add: impl FnMut(Series, &[Setting], Option<f64>),
    ) {
        for finite_size in [false, true] {
            add(Series::Hertz, &[Setting::Hertz { finite_size }], None);
        }
        let relaxes = base.scene().bodies().iter().filter_map(|body| body.material());
        if relaxes.into_iter().any(|material| material.relaxation().is_some()) {
            for finite_size in [false, true] {
                add(Series::Ting, &[Setting::Ting { finite_size }], None);
            }
        }
        let mut over_size = |series, across: &[f64], settings: &[Setting]| {
            let Some(is_staggered) = made else { return add(series, settings, None) };
            let mass = if series == Series::ExplicitScaled { MUCH_MASS } else { 1.0 };
            for across in across {
                let size = lengths.element(*across);
                let settings = [settings, &own(settings, *across, mass, is_staggered)].concat();
                add(series, &[&settings[..], &[Setting::ElementSize(size)]].concat(), Some(size));
            }
        };
        for (series, across, vibration_modes, penalty_springs) in [
            (Series::Condensed, &CONDENSED[..], 0, false),
            (Series::CondensedSprings, &EXPLICIT[..], 0, true),
            (Series::CondensedVibrating, &VIBRATING[..], MODES, false),
        ] {
            over_size(series, across, &[Setting::Condensed { vibration_modes, penalty_springs }]);
        }
        let explicit = Setting::Explicit;
        over_size(Series::Explicit, &EXPLICIT, &[explicit]);
        if made.is_some() {
            over_size(Series::ExplicitScaled, &COMPARED, &[explicit]);
            over_size(Series::ExplicitGrown, &COMPARED, &[explicit, Setting::Growth(GROWN)]);
        }
        for (series, method) in [
            (Series::Penalty, ContactMethod::Penalty),
            (Series::NodeToSurface, ContactMethod::NodeToSurface),
        ] {
            let setting = Setting::ContactMethod(method);
            if is_read(base, setting) {
                over_size(series, &COMPARED, &[explicit, setting]);
            }
        }
        if !explicit_has_finite_strain(base) {
            over_size(Series::FiniteStrain, &STRAINED, &[explicit, Setting::FiniteStrain]);
        }
        let mut varied = |series, values: &[f64], setting: fn(f64) -> Setting| {
            for value in values {
                let mut settings = vec![explicit];
                if let Some(is_staggered) = made {
                    settings.extend(own(&[explicit, setting(*value)], COMMON, 1.0, is_staggered));
                    settings.push(Setting::ElementSize(lengths.element(COMMON)));
                }
                settings.push(setting(*value));
                add(series, &settings, Some(*value));
            }
        };
        varied(Series::PenaltyFactor, &PENALTY_FACTORS, Setting::PenaltyFactor);
        varied(Series::MassScaling, &MASS_SCALINGS, Setting::MassScaling);
        varied(Series::StepFactor, &STEP_FACTORS, Setting::StepFactor);
    }

    /// Adds the variant if its model supports it.
    fn add(&mut self, base: &Case, series: Series, settings: &[Setting], value: Option<f64>) {
        match Variant::new(base, series, settings.to_vec(), value, &self.lengths) {
            Ok(variant) => self.all.push(variant),
            Err(refused) => {
                self.refused.get_or_insert(refused);
            }
        }
    }

    /// Returns the indices of the variants in the order in which they are computed, the cheapest first, so
    /// that a study that ends early has the most variants.
    pub fn cheapest_first(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.all.len()).collect();
        order.sort_by_key(|&k| self.all[k].price);
        order
    }
}

/// Returns a case with the model, mesh and settings with which it is run, as far as they are known before
/// the run, and whether refinement may follow.
fn as_it_runs(case: Case) -> Result<(Case, bool), CaseError> {
    let mut estimator = ErrorEstimator::default();
    let RefinedBeforeRun { simulation, is_open } =
        estimator.refine_before_run(Simulation::new(case)?, || true);
    Ok((Case::of(simulation.resolved().clone())?, is_open))
}

/// Whether explicit elements of a case take a contact method, and another one than they take without.
fn is_read(case: &Case, method: Setting) -> bool {
    let (Some(usual), Some(named)) = (explicit(case, &[]), explicit(case, &[method])) else {
        return false;
    };
    let (usual, named) = (usual.scene(), named.scene());
    unread(named, is_finite(named)).is_none() && contact_method(named) != contact_method(usual)
}

/// Whether explicit elements of a case are at finite strain if nothing else is said.
fn explicit_has_finite_strain(case: &Case) -> bool {
    explicit(case, &[]).is_some_and(|case| is_finite(case.scene()))
}

/// The case of explicit elements with settings.
fn explicit(case: &Case, settings: &[Setting]) -> Option<Case> {
    let all = [&[Setting::Explicit], settings].concat();
    case.edited(|file| all.iter().for_each(|setting| setting.apply(file))).ok()
}

fn is_finite(scene: &Scene) -> bool {
    Estimate::of(scene).is_ok_and(|estimate| FiniteStrain::laws(scene, &estimate) != [None; 2])
}

/// Returns the settings that go with a mesh of a number of elements across the contact: mass scaling as a
/// multiple of the plan's, and staggered meshes for penalty springs if those of the scene are.
fn own(settings: &[Setting], across: f64, mass: f64, is_staggered: bool) -> Vec<Setting> {
    let has = |wanted: fn(&Setting) -> bool| settings.iter().any(wanted);
    let is_explicit = has(|it| matches!(it, Setting::Explicit));
    let at_nodes = has(|it| matches!(it, Setting::Condensed { penalty_springs: false, .. }));
    let is_scaled = has(|it| matches!(it, Setting::MassScaling(_)));
    let mut own = Vec::new();
    if is_explicit && !is_scaled {
        let mass = mass * MeshRule::mass_scaling_beside(across);
        own.push(Setting::MassScaling(short(mass)));
    }
    if is_staggered && !at_nodes {
        own.push(Setting::Staggered(true));
    }
    own
}

/// Rounds a length to four digits, as a user would write it.
fn short(length: f64) -> f64 {
    format!("{length:.3e}").parse().unwrap_or(length)
}
