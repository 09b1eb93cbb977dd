//! The transformation of a case into the variants of an accuracy study.

use fem_case::{Case, CaseError, ModelChoice, Scene};
use fem_simulation::effects::FiniteStrain;
use fem_simulation::error::{Setting, first_contact};
use fem_simulation::{
    ErrorEstimator, Estimate, MeshRule, Plan, RefinedBeforeRun, Simulation, contact_method,
    divided_radius, ignored_method_warning, selected_model,
};

use super::series::{COMMON, LARGE_MASS_SCALING, PRESETS, Preset, Series, VariedSetting};

/// One variant of a scene: a model, a mesh and settings.
#[derive(Clone, Debug)]
pub struct Variant {
    /// The series that it belongs to.
    pub series: Series,
    /// The value that varies in its series: an element size (m), a factor, a share; `None` if the series
    /// has one variant.
    pub value: Option<f64>,
    /// Elements across the contact radius; `None` without a mesh or with a mesh from a file.
    pub elements_across: Option<f64>,
    /// Whether its element size is that of the variants that vary another setting.
    pub has_common_elements: bool,
    /// Settings that differ from the case.
    settings: Vec<Setting>,
    /// The case with these settings.
    pub case: Case,
    /// Estimated number of element updates; 0 without elements.
    pub element_updates: u64,
}

impl Variant {
    /// Returns the model that computes it: the chosen one, if the case leaves the model open.
    fn model(&self) -> ModelChoice {
        let scene = self.case.scene();
        selected_model(scene).unwrap_or_else(|_| scene.model().clone())
    }

    /// Whether explicit elements compute it.
    pub fn is_explicit(&self) -> bool {
        self.model() == ModelChoice::Fem
    }

    /// Describes the variant within its series.
    pub fn describe(&self) -> String {
        let own = self.settings.iter().rev().find_map(|setting| match *setting {
            Setting::Hertz { finite_size: true } | Setting::Ting { finite_size: true } => {
                Some("with finite size".to_string())
            }
            Setting::PenaltyFactor(value) => Some(format!("penalty factor {value}")),
            Setting::MassScaling(share) if self.series == Series::MassScaling => {
                Some(format!("{} % of mass added", 100.0 * share))
            }
            Setting::StepFactor(value) => Some(format!("step factor {value}")),
            _ => None,
        });
        let across = self.elements_across.map(|across| format!("a/h = {across:.1}"));
        let model = (self.series == Series::AsWritten).then(|| self.model().name().to_string());
        [model, across, own].into_iter().flatten().collect::<Vec<_>>().join(", ")
    }

    /// Returns the overrides that make it of the case: `--set KEY=VALUE`, in order.
    pub fn overrides(&self) -> Vec<String> {
        self.settings.iter().map(|setting| setting.as_override()).collect()
    }
}

/// The variants of a scene.
#[derive(Clone, Debug)]
pub struct Variants {
    /// The variants, grouped by series, from coarse to fine.
    pub all: Vec<Variant>,
    /// Contact radius by closed forms, m: elements are counted across it.
    pub contact_radius: f64,
    /// Whether a run of the case refines its mesh if that of its variant does not meet the tolerance.
    pub is_open: bool,
}

/// The scene that is varied.
struct Base {
    /// The case without its own mesh, contact method, time step and output.
    case: Case,
    contact_radius: f64,
    /// The length that elements divide, m.
    divided: f64,
    /// Whether meshes are staggered; `None` if they are read from files.
    is_staggered: Option<bool>,
}

impl Variants {
    /// Creates the variants of a case, for its first contact if gravity brings its body back.
    ///
    /// # Errors
    /// No model with elements supports any mesh: the first such error. Single variants that fail, for
    /// example by the limits of the case, are left out.
    pub fn of(case: &Case) -> Result<Self, CaseError> {
        let base = Base::of(case)?;
        let own = case.edited(|file| (file.output, file.stop) = (None, first_contact(file)))?;
        let own = as_it_runs(own);
        let is_open = own.as_ref().is_ok_and(|(_, is_open)| *is_open);
        let variant = |(case, _)| base.variant(Series::AsWritten, Vec::new(), None, case);
        let mut made = vec![own.and_then(variant)];
        for preset in PRESETS.iter().filter(|preset| base.has(preset)) {
            for (settings, value) in base.settings(preset) {
                let case = edited(&base.case, &settings);
                made.push(case.and_then(|case| base.variant(preset.series, settings, value, case)));
            }
        }
        let (all, failed): (Vec<_>, Vec<_>) = made.into_iter().partition(Result::is_ok);
        let all: Vec<Variant> = all.into_iter().flatten().collect();
        let has_elements =
            |one: &Variant| matches!(one.model(), ModelChoice::Fem | ModelChoice::Condensed(_));
        match failed.into_iter().find_map(Result::err) {
            // Closed forms alone do not determine a limit.
            Some(first) if !all.iter().any(has_elements) => Err(first),
            _ => Ok(Self { all, contact_radius: base.contact_radius, is_open }),
        }
    }

    /// Returns the indices of the variants in the order in which they are computed, the cheapest first, so
    /// that a study that ends early has the most variants.
    pub fn cheapest_first(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.all.len()).collect();
        order.sort_by_key(|&k| self.all[k].element_updates);
        order
    }
}

impl Base {
    fn of(case: &Case) -> Result<Self, CaseError> {
        let case = case.edited(|file| {
            (file.mesh, file.time, file.output) = (None, None, None);
            // Adhesion and friction belong to the scene.
            if let Some(contact) = &mut file.contact {
                (contact.method, contact.penalty_factor) = (None, None);
            }
            file.stop = first_contact(file);
        })?;
        let plan = Plan::of_case(&case)?;
        let contact_radius = plan.estimate.contact_radius;
        // If the contact is as wide as its sphere, the plan's elements divide a shorter length.
        let divided = contact_radius.min(divided_radius(&plan.estimate));
        let is_staggered = plan.makes_meshes.then_some(plan.finer_body.is_some());
        Ok(Self { case, contact_radius, divided, is_staggered })
    }

    /// Whether the scene has the effect that a series varies, and reads its settings.
    fn has(&self, preset: &Preset) -> bool {
        match preset.series {
            Series::Ting => {
                let mut materials =
                    self.case.scene().bodies().iter().filter_map(|body| body.material());
                materials.any(|material| material.relaxation().is_some())
            }
            Series::ExplicitScaled | Series::ExplicitGrown => self.is_staggered.is_some(),
            Series::Penalty | Series::NodeToSurface => {
                let scenes = [&[Setting::Explicit][..], preset.settings];
                let [Ok(usual), Ok(named)] = scenes.map(|all| edited(&self.case, all)) else {
                    return false;
                };
                let (usual, named) = (usual.scene(), named.scene());
                ignored_method_warning(named, is_finite(named)).is_none()
                    && contact_method(named) != contact_method(usual)
            }
            Series::FiniteStrain => {
                let usual = edited(&self.case, &[Setting::Explicit]);
                !usual.is_ok_and(|case| is_finite(case.scene()))
            }
            _ => true,
        }
    }

    /// Returns the settings and the varied value of each variant of a series.
    fn settings(&self, preset: &Preset) -> Vec<(Vec<Setting>, Option<f64>)> {
        let is_made = self.is_staggered.is_some();
        match preset.varied {
            VariedSetting::Nothing => Vec::new(),
            VariedSetting::FiniteSize(setting) => {
                [false, true].map(|is_on| (vec![setting(is_on)], None)).into()
            }
            VariedSetting::ElementSize(_) if !is_made => vec![(preset.settings.to_vec(), None)],
            VariedSetting::ElementSize(all) => {
                let of = |&across| (self.meshed(preset, None, across), Some(self.element(across)));
                all.iter().map(of).collect()
            }
            VariedSetting::Factor(setting, values) => {
                let of = |&value| (self.meshed(preset, Some(setting(value)), COMMON), Some(value));
                values.iter().map(of).collect()
            }
        }
    }

    /// Returns the settings of a series and those that go with a mesh of a number of elements across the
    /// contact: mass scaling as a multiple of the plan's, and staggered meshes for penalty springs if those of
    /// the scene are.
    fn meshed(&self, preset: &Preset, varied: Option<Setting>, across: f64) -> Vec<Setting> {
        let mut settings = preset.settings.to_vec();
        if let Some(is_staggered) = self.is_staggered {
            let has = |wanted: fn(&Setting) -> bool| preset.settings.iter().any(wanted);
            let is_scaled = matches!(varied, Some(Setting::MassScaling(_)));
            if has(|one| matches!(one, Setting::Explicit)) && !is_scaled {
                let is_large = preset.series == Series::ExplicitScaled;
                let multiple = if is_large { LARGE_MASS_SCALING } else { 1.0 };
                let share = multiple * MeshRule::mass_scaling_beside(across);
                settings.push(Setting::MassScaling(rounded(share)));
            }
            let is_nodal =
                |one: &_| matches!(one, Setting::Condensed { penalty_springs: false, .. });
            if is_staggered && !has(is_nodal) {
                settings.push(Setting::Staggered(true));
            }
            settings.push(Setting::ElementSize(self.element(across)));
        }
        settings.extend(varied);
        settings
    }

    /// Returns the element size for a number of elements across the contact, m.
    fn element(&self, across: f64) -> f64 {
        rounded(self.divided / across)
    }

    fn variant(
        &self,
        series: Series,
        settings: Vec<Setting>,
        value: Option<f64>,
        case: Case,
    ) -> Result<Variant, CaseError> {
        let element_updates = Simulation::expected_of(&case)?.element_updates;
        let size = settings.iter().find_map(|setting| match setting {
            Setting::ElementSize(size) => Some(*size),
            _ => None,
        });
        let elements_across = size.map(|size| self.contact_radius / size);
        let has_common_elements = size == Some(self.element(COMMON));
        Ok(Variant {
            series,
            value,
            elements_across,
            has_common_elements,
            settings,
            case,
            element_updates,
        })
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

fn edited(case: &Case, settings: &[Setting]) -> Result<Case, CaseError> {
    case.edited(|file| settings.iter().for_each(|setting| setting.apply(file)))
}

fn is_finite(scene: &Scene) -> bool {
    Estimate::of(scene).is_ok_and(|estimate| FiniteStrain::laws(scene, &estimate) != [None; 2])
}

/// Rounds a length to four digits, as a user would write it.
fn rounded(length: f64) -> f64 {
    format!("{length:.3e}").parse().unwrap_or(length)
}
