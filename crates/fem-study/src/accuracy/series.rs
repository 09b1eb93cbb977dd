//! The series of variants that the accuracy study computes, as a table.

use fem_case::schema::ContactMethod;
use fem_simulation::error::Setting;

use VariedSetting::{ElementSize, Factor, FiniteSize, Nothing};

/// Variants of a scene that differ in one setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Series {
    /// The case itself, on the mesh that is chosen for it.
    AsWritten,
    /// Hertz' closed form.
    Hertz,
    /// Ting's closed form for viscoelastic half-spaces.
    Ting,
    /// Condensed bodies without penalty springs.
    Condensed,
    /// Condensed bodies with the penalty springs of explicit elements between them.
    CondensedSprings,
    /// Condensed bodies that vibrate.
    CondensedVibrating,
    /// Explicit elements with the settings of the plan.
    Explicit,
    /// Explicit elements with much moved mass.
    ExplicitScaled,
    /// Explicit elements with fewer rings around the contact.
    ExplicitGrown,
    /// Explicit elements with springs between nodes that have mass.
    Penalty,
    /// Explicit elements with springs at nodes.
    NodeToSurface,
    /// Explicit elements at finite strain.
    FiniteStrain,
    /// Explicit elements with other stiffnesses of the penalty springs.
    PenaltyFactor,
    /// Explicit elements with other amounts of moved mass.
    MassScaling,
    /// Explicit elements with other time steps.
    StepFactor,
}

/// The setting in which the variants of a series differ.
pub(super) enum VariedSetting {
    /// None: the only variant is the case as it runs.
    Nothing,
    /// Without and with the spheres' finite size.
    FiniteSize(fn(bool) -> Setting),
    /// The element size: numbers of elements across the contact radius.
    ElementSize(&'static [f64]),
    /// A factor, with [`COMMON`] elements across the contact radius.
    Factor(fn(f64) -> Setting, &'static [f64]),
}

/// One row of the table of series.
pub(super) struct Preset {
    pub series: Series,
    name: &'static str,
    is_choice: bool,
    /// Settings of all its variants.
    pub settings: &'static [Setting],
    pub varied: VariedSetting,
}

/// Elements across the contact radius where one setting is varied by itself.
pub(super) const COMMON: f64 = 8.0;
/// Large mass scaling, as a multiple of the plan's: it halves the number of steps.
pub(super) const LARGE_MASS_SCALING: f64 = 4.0;
/// Elements across the contact radius of condensed, explicit and compared bodies.
const CONDENSED: [f64; 9] = [3.0, 4.0, 5.0, 6.0, 8.0, 11.0, 16.0, 23.0, 32.0];
const EXPLICIT: &[f64] = CONDENSED.split_at(8).0;
const COMPARED: [f64; 5] = [3.0, 4.0, 5.0, 8.0, 11.0];

const fn condensed(vibration_modes: u8, penalty_springs: bool) -> Setting {
    Setting::Condensed { vibration_modes, penalty_springs }
}

const fn row(
    series: Series,
    name: &'static str,
    is_choice: bool,
    settings: &'static [Setting],
    varied: VariedSetting,
) -> Preset {
    Preset { series, name, is_choice, settings, varied }
}

/// All series in the order of their results: name, whether a user would choose its variants, common
/// settings, and what differs. The series that no user would choose separate the sources of errors: they vary a
/// single setting, or make condensed bodies as coarse as explicit elements.
#[rustfmt::skip]
pub(super) const PRESETS: [Preset; 15] = {
    use Series::*;
    const FEM: Setting = Setting::Explicit;
    const PENALTY: Setting = Setting::ContactMethod(ContactMethod::Penalty);
    const NODAL: Setting = Setting::ContactMethod(ContactMethod::NodeToSurface);
    [
        row(AsWritten, "the case as written", true, &[], Nothing),
        row(Hertz, "Hertz", true, &[], FiniteSize(|finite_size| Setting::Hertz { finite_size })),
        row(Ting, "Ting", true, &[], FiniteSize(|finite_size| Setting::Ting { finite_size })),
        row(Condensed, "condensed", true, &[condensed(0, false)], ElementSize(&CONDENSED)),
        row(CondensedSprings, "condensed, springs", false, &[condensed(0, true)], ElementSize(EXPLICIT)),
        row(CondensedVibrating, "condensed, 12 modes", true, &[condensed(12, false)], ElementSize(&[4.0, 8.0, 16.0])),
        row(Explicit, "explicit", true, &[FEM], ElementSize(EXPLICIT)),
        row(ExplicitScaled, "explicit, four times the mass moved", true, &[FEM], ElementSize(&COMPARED)),
        row(ExplicitGrown, "explicit, growth 1.25", true, &[FEM, Setting::Growth(1.25)], ElementSize(&COMPARED)),
        row(Penalty, "explicit, penalty", true, &[FEM, PENALTY], ElementSize(&COMPARED)),
        row(NodeToSurface, "explicit, node to surface", true, &[FEM, NODAL], ElementSize(&COMPARED)),
        row(FiniteStrain, "finite strain", false, &[FEM, Setting::FiniteStrain], ElementSize(&[4.0, 8.0])),
        row(PenaltyFactor, "penalty factor", false, &[FEM], Factor(Setting::PenaltyFactor, &[0.25, 4.0])),
        row(MassScaling, "mass scaling", false, &[FEM], Factor(Setting::MassScaling, &[0.0, 1e-3, 2e-2])),
        row(StepFactor, "step factor", false, &[FEM], Factor(Setting::StepFactor, &[0.45])),
    ]
};

impl Series {
    fn preset(self) -> &'static Preset {
        &PRESETS[self as usize]
    }

    /// Returns the name of the series for readers.
    pub fn name(self) -> &'static str {
        self.preset().name
    }

    /// Whether its variants are choices for users; `false` if they only isolate a source of error.
    pub fn is_choice(self) -> bool {
        self.preset().is_choice
    }

    /// Returns the series whose errors converge with the element size, in order. The two
    /// meshes at finite strain are too few.
    pub(super) fn over_element_size() -> impl Iterator<Item = Self> {
        let is_over = |preset: &&Preset| {
            matches!(preset.varied, ElementSize(_)) && preset.series != Self::FiniteStrain
        };
        PRESETS.iter().filter(is_over).map(|preset| preset.series)
    }
}
