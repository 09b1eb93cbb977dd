//! One pair of bodies and its speeds: any series to restitutions.
//!
//! The condensed model factors the pair once, on a mesh for all of its speeds: fine block and
//! condensed region are those of the largest contact (instantaneous moduli), elements are small
//! enough for the smallest, unless the case gives their size.

use std::sync::Mutex;

use fem::effects::QUASI_STATIC_LIMIT;
use fem::measured::{MeasuredPair, MeasuredPairs};
use fem::{Condensed, Model, Shared};
use fem_case::Case;
use fem_collision::Stop;
use fem_fit::FitError;
use fem_laws::{FiniteSize, HertzImpact, LawError, Pair, PairRelaxation, Ting};
use fem_material::{ActsOn, Material, PronySeries, PronyTerm};
use rayon::prelude::*;

use super::ends;
use super::faults::{blame, no_mesh};
use crate::engineering::show;
use crate::failure::Failure;

/// Elements across the largest and the smallest contact radius, at least.
const ELEMENTS_ACROSS: (f64, f64) = (8.0, 4.0);
/// Elements across the radius of the smaller sphere, at least.
const ACROSS_SPHERE: f64 = 12.0;
/// Steps over the elastic contact time: restitutions within 2e-5 of 1000 steps'.
pub(super) const STEPS: usize = 300;
/// Accuracy of Ting's restitutions, far below what is measured. Ranges are within 1 % of those of
/// 1e-7, for a third of the time; weights that the data leave open move by some 3 % of their range.
const TOLERANCE: f64 = 1e-5;

/// Which model computes the restitutions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum ModelName {
    /// Finite elements condensed to their contact
    Condensed,
    /// Ting's half-spaces with the spheres' finite size
    Ting,
}

impl ModelName {
    /// As an option has it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Condensed => "condensed",
            Self::Ting => "ting",
        }
    }
}

/// The material that is calibrated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Target {
    /// Its name in the case.
    pub material: String,
    /// Which of its moduli relax.
    pub acts_on: ActsOn,
    /// The bodies that are made of it.
    pub sides: [bool; 2],
}

impl Target {
    /// The material that the user names, or the only one.
    ///
    /// # Errors
    /// None, or more than one without a name.
    pub fn of(case: &Case, name: Option<&str>, acts_on: Option<ActsOn>) -> Result<Self, Failure> {
        let own = |side: usize| case.file.body.get(side).and_then(|body| body.material.as_deref());
        let own = [own(0), own(1)];
        let mut names: Vec<&str> = own.into_iter().flatten().collect();
        names.dedup();
        let material = match (name, &names[..]) {
            (Some(name), _) if names.contains(&name) => name,
            (None, [only]) => only,
            (Some(name), _) => {
                let message = format!("--material {name}: no body is made of it");
                return Err(Failure::bad_input(message)
                    .with_help(format!("the bodies are made of {}", names.join(" and "))));
            }
            (None, _) => {
                let message = format!("the bodies are made of {}", names.join(" and "));
                return Err(Failure::bad_input(message)
                    .with_help(format!("say which to calibrate: --material {}", names[0])));
            }
        };
        let sides = own.map(|own| own == Some(material));
        let bodies = case.scene.bodies.iter().zip(sides).filter(|(_, is_it)| *is_it);
        let series = bodies.filter_map(|(body, _)| body.material()?.relaxation()).next();
        let acts_on = acts_on.or(series.map(PronySeries::acts_on)).unwrap_or(ActsOn::All);
        Ok(Self { material: material.to_string(), acts_on, sides })
    }
}

/// A pair, its data and its model.
#[derive(Debug)]
pub struct Experiment {
    /// Places of its points in the data.
    pub points: Vec<usize>,
    /// m/s.
    pub speeds: Vec<f64>,
    /// Hertz' with instantaneous moduli, s.
    pub contact_times: Vec<f64>,
    /// Diameters of the bodies, m; a wall has none.
    pub diameters: [Option<f64>; 2],
    /// Elements across the smallest and the largest contact radius; none without a mesh.
    pub elements_across: Option<(f64, f64)>,
    /// Why its fastest point is perhaps a slip.
    pub doubt: Option<String>,
    /// What the user should know of the model's limits.
    pub warnings: Vec<String>,
    target: Target,
    materials: [Option<Material>; 2],
    model: Evaluator,
}

#[derive(Debug)]
enum Evaluator {
    Condensed(Box<Mutex<Condensed>>),
    Ting(Pair),
}

impl Experiment {
    /// Gives the case the bodies of the data and its speeds, and makes its model.
    ///
    /// # Errors
    /// A case that cannot be, a mesh or a factor that cannot be made.
    pub fn new(
        case: &Case,
        measured: &MeasuredPairs,
        bodies: &MeasuredPair,
        target: &Target,
        model: ModelName,
    ) -> Result<Self, Failure> {
        let speeds: Vec<f64> =
            bodies.points.iter().map(|point| measured.data.points[*point].speed).collect();
        let first = bodies.points[0];
        let base = case
            .edited(|file| bodies.resize(file))
            .map_err(|error| blame(error, measured, first))?;
        let moving = usize::from(base.scene.bodies[0].diameter().is_none());
        let place = |speed: f64| {
            let is_it = |k: &usize| measured.data.points[*k].speed == speed;
            bodies.points.iter().copied().find(is_it).unwrap_or(first)
        };
        let at = |speed: f64, element_size: Option<f64>| {
            let case = base.edited(|file| {
                file.body[moving].approach_speed = Some(speed.into());
                file.body[1 - moving].approach_speed = Some(0.0.into());
                if let Some(size) = element_size {
                    file.mesh.get_or_insert_default().contact_element_size = Some(size.into());
                }
            });
            case.map_err(|error| blame(error, measured, place(speed)))
        };
        let bad = |error: LawError| Failure::bad_input(error.to_string());
        let pair = base.scene.pair().map_err(bad)?;
        let hertz = |speed: f64| HertzImpact::new(&pair, speed).map_err(bad);
        let (slowest, fastest) = ends(&speeds);
        let (small, large) = (hertz(slowest)?, hertz(fastest)?);
        let radii = base.scene.bodies.iter().filter_map(|body| Some(0.5 * body.diameter()?));
        let smallest_radius = radii.fold(f64::INFINITY, f64::min);
        let time = |speed: &f64| large.contact_time() * (speed / fastest).powf(-0.2);
        let contact_times = speeds.iter().map(time).collect();
        let mut experiment = Self {
            points: bodies.points.clone(),
            speeds,
            contact_times,
            diameters: base.scene.bodies.each_ref().map(fem_case::Body::diameter),
            elements_across: None,
            doubt: None,
            warnings: Vec::new(),
            target: target.clone(),
            materials: base.scene.bodies.each_ref().map(|body| body.material().cloned()),
            model: match model {
                ModelName::Condensed => {
                    let size = (large.max_contact_radius() / ELEMENTS_ACROSS.0)
                        .min(small.max_contact_radius() / ELEMENTS_ACROSS.1)
                        .min(smallest_radius / ACROSS_SPHERE);
                    let is_given = base.gives("mesh.contact_element_size");
                    let case = at(fastest, (!is_given).then_some(size))?;
                    let condensed = Condensed::new(&case.scene, &Shared::default())
                        .map_err(|refusal| refusal.in_case(&case));
                    let condensed = condensed.map_err(|error| match is_given {
                        true => error.into(),
                        false => no_mesh(error, size, (slowest, fastest)),
                    })?;
                    Evaluator::Condensed(Box::new(Mutex::new(condensed)))
                }
                ModelName::Ting => {
                    let size = base.scene.finite_size().map_err(bad)?;
                    size.check(large.max_contact_radius()).map_err(|error| {
                        Failure::from(measured.data.fault(place(fastest), error)).with_help(format!(
                            "{} is too fast for the sizes and the moduli: is the unit of the speeds \
                             right?",
                            show(fastest, "m/s")
                        ))
                    })?;
                    Evaluator::Ting(pair)
                }
            },
        };
        let mut is_too_fast = true;
        if let Evaluator::Condensed(condensed) = &experiment.model {
            let condensed = lock(condensed);
            let plan = condensed.setup().elements.as_ref().map(|elements| &elements.plan);
            let size = plan.map_or(f64::NAN, |plan| plan.contact_element_size);
            let across = (small.max_contact_radius() / size, large.max_contact_radius() / size);
            experiment.elements_across = Some(across);
            // Their remedy is a model that calibrates nothing: the doubt below takes their place.
            let told = condensed.speed_warnings();
            is_too_fast = !told.is_empty();
            let warnings = condensed.setup().warnings.iter();
            let others = warnings.filter(|warning| !told.contains(warning));
            experiment.warnings = others.cloned().collect();
        }
        let materials = experiment.materials.iter().flatten();
        let slow = materials.map(Material::shear_wave_speed).fold(f64::INFINITY, f64::min);
        let share = fastest / slow;
        if share > QUASI_STATIC_LIMIT && is_too_fast {
            experiment.doubt = Some(format!(
                "{} is {:.2} % of the shear wave speed; above {:.1} % the inertia of the bodies \
                 counts, which --model {} leaves out: is the unit of the speeds right?",
                show(fastest, "m/s"),
                100.0 * share,
                100.0 * QUASI_STATIC_LIMIT,
                model.word(),
            ));
        }
        Ok(experiment)
    }

    /// The restitutions at its speeds with these terms in the calibrated material.
    ///
    /// # Errors
    /// A collision that cannot be computed.
    pub fn restitutions(&self, terms: &[PronyTerm]) -> Result<Vec<f64>, FitError> {
        let at = |speed: &f64| self.restitution(terms, *speed);
        match &self.model {
            // One pair of bodies in one state.
            Evaluator::Condensed(_) => self.speeds.iter().map(at).collect(),
            Evaluator::Ting(_) => self.speeds.par_iter().map(at).collect(),
        }
    }

    /// The restitution at a speed with these terms in the calibrated material; 0 where the bodies
    /// do not part.
    ///
    /// # Errors
    /// A collision that cannot be computed.
    pub fn restitution(&self, terms: &[PronyTerm], speed: f64) -> Result<f64, FitError> {
        let failed =
            |error: &dyn std::fmt::Display| FitError::Collision { reason: error.to_string() };
        let series = match terms {
            [] => None,
            terms => Some(
                PronySeries::new(terms.to_vec(), self.target.acts_on).map_err(|e| failed(&e))?,
            ),
        };
        let relaxation = |side: usize| match self.target.sides[side] {
            true => series.as_ref(),
            false => self.materials[side].as_ref().and_then(Material::relaxation),
        };
        match &self.model {
            Evaluator::Condensed(condensed) => {
                let relaxations = [relaxation(0), relaxation(1)];
                match lock(condensed).restitution(speed, relaxations, STEPS) {
                    Err(Stop::NoSeparation { .. }) => Ok(0.0),
                    result => result.map_err(|stop| failed(&stop)),
                }
            }
            Evaluator::Ting(pair) => {
                let material = |side: usize| {
                    let own = self.materials[side].as_ref();
                    let with = |own: &Material| {
                        let series = relaxation(side).cloned();
                        Material::new(own.density(), *own.instantaneous(), series)
                    };
                    own.map(with).transpose().map_err(|error| failed(&error))
                };
                match ting(pair, [material(0)?, material(1)?], &self.diameters, speed) {
                    Ok(restitution) => Ok(restitution),
                    Err(LawError::NotFinished { .. }) => Ok(0.0),
                    Err(error) => Err(failed(&error)),
                }
            }
        }
    }
}

/// A thread that panicked left the pair whole.
fn lock(condensed: &Mutex<Condensed>) -> std::sync::MutexGuard<'_, Condensed> {
    condensed.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

fn ting(
    pair: &Pair,
    materials: [Option<Material>; 2],
    diameters: &[Option<f64>; 2],
    speed: f64,
) -> Result<f64, LawError> {
    let [first, second] = materials.each_ref().map(Option::as_ref);
    let relaxation = PairRelaxation::new(first, second)?;
    let sized = |side: usize, material| Some((0.5 * diameters[side]?, material?));
    let size = FiniteSize::new(sized(0, first), sized(1, second))?;
    let ting = Ting::new(pair, relaxation).with_tolerance(TOLERANCE)?.with_finite_size(size);
    Ok(ting.impact(speed)?.restitution)
}
