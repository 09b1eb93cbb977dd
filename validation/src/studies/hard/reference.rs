//! References of hard scenes.

use fem_case::{Case, CaseError};

use super::{
    axis::{Against, Scene},
    trial::{Numbers, Trial},
};
use crate::{Laboratory, StudyError};

/// Ting's model with finite spheres.
const TING: &str = "ting={finite_size=true}";

/// Reference values of the dimensionless numbers.
#[derive(Clone, Copy)]
pub(super) struct Reference(Numbers);

impl Reference {
    pub fn of<'a>(
        against: &Against,
        scene: &Scene,
        model: &str,
        laboratory: &Laboratory,
        case: impl Fn(&Scene, &str) -> Result<Case, CaseError>,
        other: impl Fn(&str) -> Result<&'a Scene, StudyError>,
    ) -> Result<Self, StudyError> {
        let run = |scene: &Scene, model: &str| {
            let trial = Trial::of(laboratory, case(scene, model))?;
            let none = || {
                format!(
                    "no reference for `{}`: {}",
                    scene.name,
                    trial.words(laboratory.claim().folder.as_path())
                )
            };
            trial.numbers().map(Self).ok_or_else(|| StudyError::parameters(none()))
        };
        match against {
            Against::Hertz => Ok(Self([Some(1.0); 4])),
            Against::Restitution(restitution) => Ok(Self([Some(*restitution), None, None, None])),
            Against::Ting => run(scene, TING),
            Against::Scene(name) => run(other(name)?, model),
        }
    }

    /// Returns the difference of one number: absolute for the restitution, relative for the others.
    pub fn difference(&self, ours: &Numbers, k: usize) -> Option<f64> {
        let (ours, reference) = (ours[k]?, self.0[k]?);
        Some(if k == 0 { ours - reference } else { ours / reference - 1.0 })
    }
}
