//! The model of one pair of bodies: any series in the calibrated material to restitutions.

use std::fmt::Display;

use crate::fit::FitError;
use fem_case::Scene;
use fem_collision::Stop;
use fem_laws::{FiniteSize, LawError, Pair, PairRelaxation, Ting};
use fem_material::{Material, PronySeries, PronyTerm};
use rayon::prelude::*;

use super::target::Target;
use fem_simulation::Condensed;

/// Steps over the elastic contact time: restitutions within 2e-5 of 1000 steps'.
pub(super) const STEPS: usize = 300;
/// Accuracy of Ting's restitutions, far below what is measured. Ranges are within 1 % of those of
/// 1e-7, for a third of the time; weights that the data leave open move by some 3 % of their range.
const TOLERANCE: f64 = 1e-5;

/// Two bodies, one or both of the calibrated material.
#[derive(Debug)]
pub(super) struct PairModel {
    target: Target,
    materials: [Option<Material>; 2],
    /// m; a wall has none.
    diameters: [Option<f64>; 2],
    evaluator: Evaluator,
}

/// The model that computes a collision.
#[derive(Debug)]
pub(super) enum Evaluator {
    /// The bodies, factored once.
    Condensed(Box<Condensed>),
    /// With the spheres' finite size.
    Ting(Pair),
}

impl PairModel {
    /// Creates the model of the bodies of a scene.
    pub fn new(scene: &Scene, target: &Target, evaluator: Evaluator) -> Self {
        Self {
            target: target.clone(),
            materials: scene.bodies().each_ref().map(|body| body.material().cloned()),
            diameters: scene.bodies().each_ref().map(fem_case::Body::diameter),
            evaluator,
        }
    }

    /// The restitutions at these speeds, m/s.
    ///
    /// # Errors
    /// A collision that cannot be computed.
    pub fn restitutions(&self, terms: &[PronyTerm], speeds: &[f64]) -> Result<Vec<f64>, FitError> {
        let at = |speed: &f64| self.restitution(terms, *speed);
        speeds.par_iter().map(at).collect()
    }

    /// The restitution at a speed, m/s; 0 where the bodies do not part.
    ///
    /// # Errors
    /// A collision that cannot be computed.
    pub fn restitution(&self, terms: &[PronyTerm], speed: f64) -> Result<f64, FitError> {
        let acts_on = self.target.acts_on;
        let series = (!terms.is_empty()).then(|| PronySeries::new(terms.to_vec(), acts_on));
        let series = series.transpose().map_err(failed)?;
        let relaxation = |side: usize| match self.target.sides[side] {
            true => series.as_ref(),
            false => self.materials[side].as_ref().and_then(Material::relaxation),
        };
        let relaxations = [relaxation(0), relaxation(1)];
        match &self.evaluator {
            Evaluator::Condensed(condensed) => {
                match condensed.restitution(speed, relaxations, STEPS) {
                    Err(Stop::NoSeparation { .. }) => Ok(0.0),
                    result => result.map_err(failed),
                }
            }
            Evaluator::Ting(pair) => {
                let material = |side: usize| {
                    let own = self.materials[side].as_ref()?;
                    let series = relaxations[side].cloned();
                    Some(Material::new(own.density(), *own.instantaneous(), series))
                };
                let materials = [
                    material(0).transpose().map_err(failed)?,
                    material(1).transpose().map_err(failed)?,
                ];
                match ting(pair, materials.each_ref().map(Option::as_ref), self.diameters, speed) {
                    Err(LawError::NotFinished { .. }) => Ok(0.0),
                    result => result.map_err(failed),
                }
            }
        }
    }
}

fn failed(error: impl Display) -> FitError {
    FitError::Collision { reason: error.to_string() }
}

fn ting(
    pair: &Pair,
    [first, second]: [Option<&Material>; 2],
    diameters: [Option<f64>; 2],
    speed: f64,
) -> Result<f64, LawError> {
    let relaxation = PairRelaxation::new(first, second)?;
    let sized = |side: usize, material| Some((0.5 * diameters[side]?, material?));
    let size = FiniteSize::new(sized(0, first), sized(1, second))?;
    let ting = Ting::new(pair, relaxation).with_tolerance(TOLERANCE)?.with_finite_size(size);
    Ok(ting.impact(speed)?.restitution)
}
