//! Effects: what a scene calls for, what a model has of it, and what follows.
//!
//! ```text
//! Effect  a file each: name, key in [effects], the number that decides   ─┐
//! Answer  what a model has of it                                          ├─ decide ─ Verdict, warnings,
//! Switch  what the case says: auto, on, off                              ─┘           or a refusal
//! ```
//!
//! An effect acts at one of three levels, never at several: it transforms the scene (mirror
//! symmetry), it is a decision of the plan (mass scaling), or it is a part of a step (relaxation).
//! [`EFFECTS`] lists them all. A model names those that it has an answer to, in the order in which its
//! results show them.

mod bulk_viscosity;
mod contact_search;
mod dashpot;
mod effect;
mod finite_size;
mod finite_strain;
mod gravity;
mod hourglass_control;
mod mass_scaling;
mod mirror_symmetry;
mod penalty_springs;
mod vibration;
mod viscoelasticity;

use fem_case::{Scene, Switch};
use serde::Serialize;

use crate::estimate::Estimate;
use crate::refusal::Refusal;

pub use bulk_viscosity::{BulkViscosity, MACH_LIMIT};
pub use contact_search::ContactSearch;
pub use dashpot::DashpotEffect;
pub use effect::{Effect, Need};
pub use finite_size::FiniteSizeEffect;
pub use finite_strain::FiniteStrain;
pub use gravity::Gravity;
pub use hourglass_control::HourglassControl;
pub use mass_scaling::MassScaling;
pub use mirror_symmetry::MirrorSymmetry;
pub use penalty_springs::PenaltySprings;
pub use vibration::{QUASI_STATIC_LIMIT, Vibration};
pub use viscoelasticity::Viscoelasticity;

/// All effects, in the order of the level at which they act.
pub const EFFECTS: [&dyn Effect; 12] = [
    &MirrorSymmetry,
    &FiniteStrain,
    &Viscoelasticity,
    &Vibration,
    &BulkViscosity,
    &Gravity,
    &FiniteSizeEffect,
    &DashpotEffect,
    &ContactSearch,
    &PenaltySprings,
    &HourglassControl,
    &MassScaling,
];

/// What a model has of an effect.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// It computes the effect where it is called for; what follows where it is not.
    Computes {
        /// Said after the number of a scene that does not call for it; may be empty.
        idle: &'static str,
    },
    /// It lacks the effect; a scene that calls for it is warned about.
    Lacks,
    /// It decides by itself: whether the effect is on, and why.
    Is(bool, String),
}

/// Whether an effect is on, and why.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Verdict {
    /// What the effect is called.
    pub name: &'static str,
    /// Whether the run computes it.
    pub active: bool,
    /// The number that decided.
    pub reason: String,
}

/// What was decided on all effects of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Decisions {
    /// In the order of the answers.
    pub verdicts: Vec<Verdict>,
    /// Those of effects that are called for and lacking, in the same order.
    pub warnings: Vec<String>,
}

/// Decides on the effects that a model has an answer to.
///
/// # Errors
/// An effect that the case forces on and the model lacks.
pub fn decide(
    scene: &Scene,
    estimate: &Estimate,
    answers: Vec<(&'static dyn Effect, Answer)>,
) -> Result<Decisions, Refusal> {
    refuse_forced(scene, &answers)?;
    let mut decisions = Decisions::default();
    for (effect, answer) in answers {
        let (active, reason) = match answer {
            Answer::Is(active, reason) => (active, reason),
            answer => {
                let need = effect.need(scene, estimate).unwrap_or_default();
                if answer == Answer::Lacks {
                    decisions.warnings.extend(need.warning.clone());
                }
                follows(&need, &answer)
            }
        };
        decisions.verdicts.push(Verdict { name: effect.name(), active, reason });
    }
    Ok(decisions)
}

/// Whether an effect is on, and why, of a need and a model that has an answer to it.
fn follows(need: &Need, answer: &Answer) -> (bool, String) {
    let joined = |parts: &[&str]| {
        let parts: Vec<&str> = parts.iter().filter(|part| !part.is_empty()).copied().collect();
        parts.join("; ")
    };
    match (answer, need.is_called_for) {
        (Answer::Computes { .. }, true) => (true, need.number.clone()),
        (Answer::Computes { idle }, false) => {
            (false, joined(&[&need.number, &need.otherwise, idle]))
        }
        (_, true) => {
            let lacking = "called for, but not available in this version";
            (false, joined(&[&need.number, lacking, &need.left_open]))
        }
        (_, false) => (false, joined(&[&need.number, &need.otherwise])),
    }
}

/// An effect that is forced on must be one that the model computes.
fn refuse_forced(scene: &Scene, answers: &[(&'static dyn Effect, Answer)]) -> Result<(), Refusal> {
    for effect in EFFECTS {
        let computes = answers
            .iter()
            .any(|(other, answer)| other.name() == effect.name() && *answer != Answer::Lacks);
        if effect.switch(scene.effects()) == Some(Switch::On) && !computes {
            let key = effect.name().replace(' ', "_");
            let message = format!("effect `{key}` is not available in this version");
            return Err(Refusal::new(format!("effects.{key}"), message)
                .with_help("write \"auto\" or \"off\", or leave it out"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn need(is_called_for: bool) -> Need {
        Need {
            is_called_for,
            number: "x = 1".into(),
            otherwise: "small".into(),
            left_open: "all of it is open".into(),
            warning: None,
        }
    }

    #[test]
    fn reasons_say_the_number_and_what_follows() {
        let computes = Answer::Computes { idle: "nothing is kept" };
        assert_eq!(follows(&need(true), &computes), (true, "x = 1".into()));
        assert_eq!(
            follows(&need(false), &computes),
            (false, "x = 1; small; nothing is kept".into())
        );
        assert_eq!(follows(&need(false), &Answer::Lacks), (false, "x = 1; small".into()));
        let (active, reason) = follows(&need(true), &Answer::Lacks);
        assert!(!active && reason.contains("not available") && reason.contains("all of it"));
    }

    #[test]
    fn effects_have_names_of_their_own() {
        for (k, effect) in EFFECTS.iter().enumerate() {
            assert!(EFFECTS[..k].iter().all(|other| other.name() != effect.name()));
        }
    }
}
