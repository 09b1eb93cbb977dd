//! The ways in which a scene is computed.

use fem_case::schema::ContactMethod;
use fem_case::{Case, CaseError, Scene};

use super::rung::{Rung, Series};
use fem_simulation::Estimate;
use fem_simulation::Fineness;
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
/// Much mass that is moved, over what is beside a mesh: it shortens the run by half.
const MUCH_MASS: f64 = 4.0;
const PENALTY_FACTORS: [f64; 2] = [0.25, 4.0];
const MASS_SCALINGS: [f64; 3] = [0.0, 1e-3, 2e-2];
const STEP_FACTORS: [f64; 1] = [0.45];
/// Growth of a mesh of half as many elements.
const GROWN: f64 = 1.25;

/// Lengths at the contact, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lengths {
    /// Contact radius that closed forms foretell: what elements are counted across.
    pub contact_radius: f64,
    /// What elements divide.
    pub(super) divided: f64,
}

impl Lengths {
    /// The length of elements that divide it into so many.
    pub(super) fn element(&self, across: f64) -> f64 {
        short(self.divided / across)
    }
}

/// A scene, computed in many ways.
#[derive(Clone, Debug)]
pub struct Ladder {
    /// The ways, those of a series beside each other, from coarse to fine.
    pub rungs: Vec<Rung>,
    /// What elements are counted across and divide.
    pub lengths: Lengths,
    /// Whether a run of the case goes on with a finer mesh where that of its rung does not do.
    pub is_open: bool,
    /// The first of what was left out.
    refused: Option<CaseError>,
}

impl Ladder {
    /// The ladder of a case: of its first contact, where gravity brings its body back.
    ///
    /// # Errors
    /// A case of which all models with elements refuse all meshes: the first refusal. What else is refused,
    /// by the limits of the case for one, is left out.
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
        let mut ladder = Self { rungs: Vec::new(), lengths, is_open: false, refused: None };
        let own = case.edited(|file| (file.output, file.stop) = (None, first_contact(file)))?;
        match as_it_runs(own) {
            Ok((own, is_open)) => {
                ladder.add(&own, Series::AsWritten, &[], None);
                ladder.is_open = is_open;
            }
            Err(refused) => ladder.refused = Some(refused),
        }
        let add = |series, settings: &[Setting], value| {
            ladder.add(&base, series, settings, value);
        };
        let made = plan.makes_meshes.then_some(plan.finer_body.is_some());
        Self::fill(&base, made, &lengths, add);
        match ladder.refused.take() {
            // What has only closed forms has no limit to tell.
            Some(refused) if !ladder.rungs.iter().any(Rung::has_elements) => Err(refused),
            _ => Ok(ladder),
        }
    }

    /// The ways that the scene calls for, a series after the other, on meshes that are staggered or not,
    /// unless they are read from files.
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

    /// Adds what is not refused.
    fn add(&mut self, base: &Case, series: Series, settings: &[Setting], value: Option<f64>) {
        match Rung::new(base, series, settings.to_vec(), value, &self.lengths) {
            Ok(rung) => self.rungs.push(rung),
            Err(refused) => {
                self.refused.get_or_insert(refused);
            }
        }
    }

    /// Places of the rungs in the order in which they are computed: from cheap to dear, so that a run
    /// that ends early has told most.
    pub fn cheapest_first(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.rungs.len()).collect();
        order.sort_by_key(|&k| self.rungs[k].price);
        order
    }
}

/// A case with the model, the mesh and the settings with which it is run, as far as reference runs show them before the run; and whether
/// more may follow.
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

/// What goes with a mesh with so many elements across the contact, beside these settings: so many times the mass
/// is moved that the plan would move for it, and meshes with springs between them are staggered where those of the scene are.
fn own(settings: &[Setting], across: f64, mass: f64, is_staggered: bool) -> Vec<Setting> {
    let has = |wanted: fn(&Setting) -> bool| settings.iter().any(wanted);
    let is_explicit = has(|it| matches!(it, Setting::Explicit));
    let at_nodes = has(|it| matches!(it, Setting::Condensed { penalty_springs: false, .. }));
    let is_scaled = has(|it| matches!(it, Setting::MassScaling(_)));
    let mut own = Vec::new();
    if is_explicit && !is_scaled {
        let mass = mass * Fineness::mass_scaling_beside(across);
        own.push(Setting::MassScaling(short(mass)));
    }
    if is_staggered && !at_nodes {
        own.push(Setting::Staggered(true));
    }
    own
}

/// A length of four digits: as a user would write it.
fn short(length: f64) -> f64 {
    format!("{length:.3e}").parse().unwrap_or(length)
}
