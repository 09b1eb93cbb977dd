//! A change of one setting of a case, as reference runs and the accuracy study make it.

use fem_case::CaseFile;
use fem_case::schema::{CondensedTable, ContactMethod, HertzTable, ModelTable, Switch, TingTable};

/// A change of one setting of a case, in SI units. Each variant sets the key of its name.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the variants and their fields have the names of the keys")]
pub enum Setting {
    Hertz {
        finite_size: bool,
    },
    Ting {
        finite_size: bool,
    },
    Condensed {
        vibration_modes: u8,
        penalty_springs: bool,
    },
    /// Sets `model.fem`, explicit elements.
    Explicit,
    /// Sets `mesh.contact_element_size`, in metres.
    ElementSize(f64),
    Staggered(bool),
    Growth(f64),
    ContactMethod(ContactMethod),
    PenaltyFactor(f64),
    MassScaling(f64),
    StepFactor(f64),
    /// Sets `effects.finite_strain = "on"`.
    FiniteStrain,
}

impl Setting {
    /// Makes the change in a case file.
    pub fn apply(self, file: &mut CaseFile) {
        match self {
            Self::Hertz { finite_size } => {
                file.model = Some(HertzTable { finite_size: Some(finite_size) }.into());
            }
            Self::Ting { finite_size } => {
                let table = TingTable { finite_size: Some(finite_size), ..TingTable::default() };
                file.model = Some(table.into());
            }
            Self::Condensed { vibration_modes, penalty_springs } => {
                let table = CondensedTable {
                    vibration_modes: Some(f64::from(vibration_modes).into()),
                    penalty_springs: Some(penalty_springs),
                    ..CondensedTable::default()
                };
                file.model = Some(table.into());
            }
            Self::Explicit => file.model = Some(ModelTable::fem()),
            Self::ElementSize(size) => {
                file.mesh.get_or_insert_default().contact_element_size = Some(size.into());
            }
            Self::Staggered(is) => {
                file.mesh.get_or_insert_default().staggered = Some(is);
            }
            Self::Growth(growth) => {
                file.mesh.get_or_insert_default().growth = Some(growth.into());
            }
            Self::ContactMethod(method) => {
                file.contact.get_or_insert_default().method = Some(method);
            }
            Self::PenaltyFactor(factor) => {
                file.contact.get_or_insert_default().penalty_factor = Some(factor.into());
            }
            Self::MassScaling(share) => {
                file.time.get_or_insert_default().mass_scaling = Some(share.into());
            }
            Self::StepFactor(factor) => {
                file.time.get_or_insert_default().step_factor = Some(factor.into());
            }
            Self::FiniteStrain => {
                file.effects.get_or_insert_default().finite_strain = Some(Switch::On);
            }
        }
    }

    /// Returns the override of the command line that makes the change: `mesh.contact_element_size=2.8e-5`.
    pub fn as_override(self) -> String {
        match self {
            Self::Hertz { finite_size: false } => "model.hertz={}".to_string(),
            Self::Hertz { finite_size: true } => "model.hertz={finite_size=true}".to_string(),
            Self::Ting { finite_size: false } => "model.ting={}".to_string(),
            Self::Ting { finite_size: true } => "model.ting={finite_size=true}".to_string(),
            Self::Condensed { vibration_modes, penalty_springs } => {
                let modes =
                    (vibration_modes > 0).then(|| format!("vibration_modes={vibration_modes}"));
                let springs = penalty_springs.then(|| "penalty_springs=true".to_string());
                let keys: Vec<String> = modes.into_iter().chain(springs).collect();
                format!("model.condensed={{{}}}", keys.join(","))
            }
            Self::Explicit => "model.fem={}".to_string(),
            Self::ElementSize(size) => format!("mesh.contact_element_size={size:e}"),
            Self::Staggered(is) => format!("mesh.staggered={is}"),
            Self::Growth(growth) => format!("mesh.growth={growth:?}"),
            Self::ContactMethod(method) => format!("contact.method=\"{}\"", method.word()),
            Self::PenaltyFactor(factor) => format!("contact.penalty_factor={factor:?}"),
            Self::MassScaling(share) => format!("time.mass_scaling={share:?}"),
            Self::StepFactor(factor) => format!("time.step_factor={factor:?}"),
            Self::FiniteStrain => "effects.finite_strain=\"on\"".to_string(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use fem_case::Case;

    use super::*;

    const BALL: &str =
        "material.ice = { density = 917, youngs_modulus = 9.3e9, poissons_ratio = 0.33 }
        body = [{ name = 'ball', sphere.diameter = 0.02, material = 'ice', approach_speed = 0.1 },
                { name = 'floor', wall = {} }]
        [model.law]
        hertz = {}";

    /// The change and its printed override give the same scene.
    #[test]
    fn case_variation_equals_its_printed_override() {
        let settings = [
            Setting::Hertz { finite_size: false },
            Setting::Hertz { finite_size: true },
            Setting::Ting { finite_size: false },
            Setting::Ting { finite_size: true },
            Setting::Condensed { vibration_modes: 0, penalty_springs: false },
            Setting::Condensed { vibration_modes: 12, penalty_springs: true },
            Setting::Explicit,
            Setting::ElementSize(2.8125e-5),
            Setting::Staggered(true),
            Setting::Growth(1.25),
            Setting::ContactMethod(ContactMethod::Massless),
            Setting::ContactMethod(ContactMethod::Penalty),
            Setting::ContactMethod(ContactMethod::NodeToSurface),
            Setting::PenaltyFactor(4.0),
            Setting::MassScaling(1e-3),
            Setting::MassScaling(0.0),
            Setting::StepFactor(0.45),
            Setting::FiniteStrain,
        ];
        let parse = |overrides: &[String]| Case::parse("ball", BALL, Path::new("."), overrides);
        for setting in settings {
            let case = parse(&[]).unwrap();
            let edited = case.edited(|file| setting.apply(file)).unwrap();
            let overridden = parse(&[setting.as_override()]).unwrap();
            assert_ne!(edited.scene(), case.scene(), "{setting:?}");
            assert_eq!(edited.scene(), overridden.scene(), "{setting:?}");
        }
    }
}
