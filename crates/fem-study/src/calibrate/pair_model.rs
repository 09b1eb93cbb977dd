//! The model of one pair of bodies: the restitutions that a series of the calibrated material makes.

use std::fmt::Display;

use fem_case::Scene;
use fem_collision::Stop;
use fem_data::estimate::FitError;
use fem_laws::{FiniteSize, FreePlate, HertzImpact, LawError, Pair, PairRelaxation, Ting};
use fem_material::{Material, PronySeries, PronyTerm};
use rayon::prelude::*;

use super::target::Target;
use fem_simulation::Condensed;

/// Steps per elastic contact time: restitutions are within 2e-5 of those with 1000 steps.
pub(super) const STEPS_PER_CONTACT_TIME: usize = 300;
/// Accuracy of Ting's restitutions, far below that of measurements. Ranges are within 1 % of those at
/// 1e-7, in a third of the time; weights that the data do not determine change by about 3 % of their range.
const TOLERANCE: f64 = 1e-5;

/// Two bodies, one or both of which are made of the calibrated material.
#[derive(Debug)]
pub(super) struct PairModel {
    target: Target,
    materials: [Option<Material>; 2],
    /// Diameters, m; a wall has none.
    diameters: [Option<f64>; 2],
    evaluator: Evaluator,
}

/// The model that computes a collision.
#[derive(Debug)]
pub(super) enum Evaluator {
    /// Condensed bodies, factored once.
    Condensed(Box<Condensed>),
    /// Ting's model with the spheres' finite size, and a plate that bends under the contact.
    Ting(Pair, Option<FreePlate>),
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

    /// Returns the restitutions at these speeds, m/s.
    ///
    /// # Errors
    /// A collision cannot be computed.
    pub fn restitutions(&self, terms: &[PronyTerm], speeds: &[f64]) -> Result<Vec<f64>, FitError> {
        let at = |speed: &f64| self.restitution(terms, *speed);
        speeds.par_iter().map(at).collect()
    }

    /// Returns the restitution at a speed, m/s; 0 if the bodies do not separate.
    ///
    /// # Errors
    /// A collision cannot be computed.
    pub fn restitution(&self, terms: &[PronyTerm], speed: f64) -> Result<f64, FitError> {
        self.computed(terms, speed, FiniteSize::of_trial)
    }

    /// Checks that a collision is within the limits of the model.
    ///
    /// # Errors
    /// A contact too large for the first order of finite size; a collision cannot be computed.
    pub fn check(&self, terms: &[PronyTerm], speed: f64) -> Result<(), FitError> {
        self.computed(terms, speed, |size| size).map(|_| ())
    }

    fn computed(
        &self,
        terms: &[PronyTerm],
        speed: f64,
        limited: fn(FiniteSize) -> FiniteSize,
    ) -> Result<f64, FitError> {
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
                match condensed.restitution(speed, relaxations, STEPS_PER_CONTACT_TIME) {
                    Err(Stop::NoSeparation { .. }) => Ok(0.0),
                    result => result.map_err(failed),
                }
            }
            Evaluator::Ting(pair, plate) => {
                let material = |side: usize| {
                    let own = self.materials[side].as_ref()?;
                    let series = relaxations[side].cloned();
                    Some(Material::new(own.density(), *own.instantaneous(), series))
                };
                let materials = [
                    material(0).transpose().map_err(failed)?,
                    material(1).transpose().map_err(failed)?,
                ];
                let bodies = (materials.each_ref().map(Option::as_ref), self.diameters);
                match ting((pair, plate.as_ref()), bodies, speed, limited) {
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
    (pair, plate): (&Pair, Option<&FreePlate>),
    ([first, second], diameters): ([Option<&Material>; 2], [Option<f64>; 2]),
    speed: f64,
    limited: fn(FiniteSize) -> FiniteSize,
) -> Result<f64, LawError> {
    let relaxation = PairRelaxation::new(first, second)?;
    let sized = |side: usize, material| Some((0.5 * diameters[side]?, material?));
    let size = limited(FiniteSize::new(sized(0, first), sized(1, second))?);
    let mut ting = Ting::new(pair, relaxation).with_tolerance(TOLERANCE)?.with_finite_size(size);
    if let Some(plate) = plate
        && let Some(mobility) = plate.mobility_in(&HertzImpact::new(pair, speed)?)?
    {
        ting = ting.with_plate(mobility)?;
    }
    Ok(ting.impact(speed)?.restitution)
}
