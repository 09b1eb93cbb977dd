//! One variant of a scene: a model, a mesh and settings.

use fem_case::{Case, CaseError, ModelChoice};

use super::variants::{COMMON, Lengths};
use fem_simulation::Simulation;
use fem_simulation::chosen;
use fem_simulation::error::Setting;

/// Variants that differ in one setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Series {
    /// Hertz' closed form, without and with the spheres' finite size.
    Hertz,
    /// Ting's half-spaces, without and with the spheres' finite size.
    Ting,
    /// The case itself, on the mesh that is chosen for it.
    AsWritten,
    /// Condensed bodies over the size of the elements.
    Condensed,
    /// The same with the springs of explicit elements between them.
    CondensedSprings,
    /// Condensed bodies that vibrate.
    CondensedVibrating,
    /// Explicit elements over their size, all else as the plan has it.
    Explicit,
    /// Explicit elements over their size, with much added mass.
    ExplicitScaled,
    /// Explicit elements in fewer rings around the contact, over their size.
    ExplicitGrown,
    /// Explicit elements with springs between nodes that have mass, over the size of the elements.
    Penalty,
    /// Explicit elements with springs at nodes, over the size of the elements.
    NodeToSurface,
    /// Over the stiffness of the springs.
    PenaltyFactor,
    /// Over the added mass.
    MassScaling,
    /// Over the time step.
    StepFactor,
    /// At finite strain.
    FiniteStrain,
}

impl Series {
    /// All series, from the cheapest to the most expensive.
    pub const ALL: [Self; 15] = [
        Self::Hertz,
        Self::Ting,
        Self::AsWritten,
        Self::Condensed,
        Self::CondensedSprings,
        Self::CondensedVibrating,
        Self::Explicit,
        Self::ExplicitScaled,
        Self::ExplicitGrown,
        Self::Penalty,
        Self::NodeToSurface,
        Self::PenaltyFactor,
        Self::MassScaling,
        Self::StepFactor,
        Self::FiniteStrain,
    ];

    /// Returns its name for readers.
    pub fn name(self) -> &'static str {
        match self {
            Self::Hertz => "Hertz",
            Self::Ting => "Ting",
            Self::AsWritten => "the case as written",
            Self::Condensed => "condensed",
            Self::CondensedSprings => "condensed, springs",
            Self::CondensedVibrating => "condensed, 12 modes",
            Self::Explicit => "explicit",
            Self::ExplicitScaled => "explicit, four times the mass moved",
            Self::ExplicitGrown => "explicit, growth 1.25",
            Self::Penalty => "explicit, penalty",
            Self::NodeToSurface => "explicit, node to surface",
            Self::PenaltyFactor => "penalty factor",
            Self::MassScaling => "mass scaling",
            Self::StepFactor => "step factor",
            Self::FiniteStrain => "finite strain",
        }
    }

    /// Whether its variants differ in element size.
    pub fn is_over_element_size(self) -> bool {
        matches!(
            self,
            Self::Condensed
                | Self::CondensedSprings
                | Self::CondensedVibrating
                | Self::Explicit
                | Self::ExplicitScaled
                | Self::ExplicitGrown
                | Self::Penalty
                | Self::NodeToSurface
        )
    }

    /// Whether a user would choose it. The others vary a single setting, or make condensed bodies as coarse
    /// as explicit elements, to separate the sources of errors.
    pub fn is_choice(self) -> bool {
        !matches!(
            self,
            Self::CondensedSprings
                | Self::PenaltyFactor
                | Self::MassScaling
                | Self::StepFactor
                | Self::FiniteStrain
        )
    }
}

/// One variant of a scene.
#[derive(Clone, Debug)]
pub struct Variant {
    /// The series that it belongs to.
    pub series: Series,
    /// The value that varies in its series: an element size (m), a factor, a share; `None` if the series
    /// has one variant.
    pub value: Option<f64>,
    /// Elements across the contact radius, where the mesh is of this program.
    pub elements_across: Option<f64>,
    /// Whether its elements are as long as where one setting is varied by itself, of a mesh of this program.
    pub has_common_elements: bool,
    /// Settings that differ from the case.
    pub settings: Vec<Setting>,
    /// The case with these settings.
    pub case: Case,
    /// Estimated number of element updates; 0 without elements.
    pub price: u64,
}

impl Variant {
    /// Creates the variant of a scene with these settings.
    ///
    /// # Errors
    /// The method does not support the variant.
    pub(super) fn new(
        base: &Case,
        series: Series,
        settings: Vec<Setting>,
        value: Option<f64>,
        lengths: &Lengths,
    ) -> Result<Self, CaseError> {
        let case = base.edited(|file| {
            for setting in &settings {
                setting.apply(file);
            }
        })?;
        let price = Simulation::price(&case)?;
        let size = settings.iter().find_map(|setting| match setting {
            Setting::ElementSize(size) => Some(*size),
            _ => None,
        });
        let elements_across = size.map(|size| lengths.contact_radius / size);
        let has_common_elements = size.is_some_and(|size| size == lengths.element(COMMON));
        Ok(Self { series, value, elements_across, has_common_elements, settings, case, price })
    }

    /// Returns the model that computes it: the chosen one, if the case leaves the model open.
    fn model(&self) -> ModelChoice {
        let scene = self.case.scene();
        let chosen = chosen(scene).ok().flatten();
        chosen.map_or(scene.model().clone(), |chosen| chosen.scene.model().clone())
    }

    /// Whether explicit elements compute it.
    pub fn is_explicit(&self) -> bool {
        self.model() == ModelChoice::Fem
    }

    /// Whether it divides bodies into elements.
    pub(super) fn has_elements(&self) -> bool {
        matches!(self.model(), ModelChoice::Fem | ModelChoice::Condensed(_))
    }

    /// Describes the variant within its series.
    pub fn describe(&self) -> String {
        let finite_size = "with finite size".to_string();
        let own = self.settings.iter().rev().find_map(|setting| match *setting {
            Setting::Hertz { finite_size: true } | Setting::Ting { finite_size: true } => {
                Some(finite_size.clone())
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
