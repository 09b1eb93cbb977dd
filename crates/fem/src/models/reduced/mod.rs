//! A case with a model of one degree of freedom, the approach of the mass centres: Hertz, Ting, or a
//! contact law. What is asked of all models comes from the relative motion and the conservation of
//! momentum.

mod contact_law;
mod effects;
mod outcome;
pub(crate) mod relative;

use fem_laws::laws::ContactLaw;
use fem_laws::{
    EndRule, FiniteSize, HertzImpact, Impact, LawError, LawImpact, Pair, PairRelaxation, Ting,
};
use fem_material::Material;

use crate::case::Case;
use crate::effects::Effect;
use crate::error::CaseError;
use crate::estimate::Estimate;
use crate::model::{Law, Model};
use crate::outcome::Outcome;
use crate::quantity::Quantity;
use crate::scene::{Body, Scene};
use crate::schema::{CaseFile, End, HertzTable, LawTable, ModelTable, StartTable, TingTable};
use contact_law::{Refusal, Setting};

/// A case with a reduced model, ready to run.
#[derive(Clone, Debug)]
pub struct Reduced {
    /// The case.
    pub case: Case,
    /// What closed forms say.
    pub estimate: Estimate,
    /// Which effects are on, and why.
    pub effects: Vec<Effect>,
    /// What the user should know before the run.
    pub warnings: Vec<String>,
    motion: Motion,
    /// Of the motion: with relaxed moduli if the law is a slow limit.
    pair: Pair,
}

/// What computes the relative motion.
#[derive(Clone, Debug)]
enum Motion {
    Hertz(HertzImpact),
    Ting(Ting),
    Law(LawMotion),
}

/// A law, its numbers, and its integration.
#[derive(Clone, Debug)]
struct LawMotion {
    impact: LawImpact,
    law: ContactLaw,
    numbers: Vec<f64>,
}

impl Reduced {
    /// Builds the model.
    ///
    /// # Errors
    /// A scene whose closed-form estimates are not finite; a contact too large for the finite-size
    /// correction; a law that cannot be made of this pair.
    pub fn new(case: Case) -> Result<Self, CaseError> {
        let estimate = Estimate::checked(&case)?;
        let refuse = |error: LawError| case.error_at(&case.scene.model.path(), error.to_string());
        let (motion, pair) = match &case.scene.model {
            Model::Fem | Model::Condensed(_) => {
                return Err(case.error_at("model", "finite elements are no reduced model"));
            }
            Model::Hertz { finite_size: false } => {
                (Motion::Hertz(estimate.hertz), *estimate.hertz.pair())
            }
            // Elastic bodies under Ting are Hertz', and Ting knows their size.
            Model::Hertz { finite_size: true } => {
                ting(&case, &estimate, false, true, Ting::DEFAULT_TOLERANCE)?
            }
            Model::Ting { finite_size, tolerance } => {
                ting(&case, &estimate, true, *finite_size, *tolerance)?
            }
            Model::Law { law, end_rule, tolerance } => {
                let (numbers, pair) = law_numbers(&case, &estimate, law, *end_rule)?;
                let Some(made) = law.family().law(&pair, &numbers) else {
                    let message = format!("{} is no law of the overlap", law.name());
                    return Err(case.error_at(&case.scene.model.path(), message));
                };
                let law = made.map_err(refuse)?;
                let impact = LawImpact::new(&pair, law).with_end_rule(*end_rule);
                let impact = impact.with_tolerance(*tolerance).map_err(refuse)?;
                (Motion::Law(LawMotion { impact, law, numbers }), pair)
            }
        };
        let law = match &motion {
            Motion::Law(motion) => Some(&motion.law),
            _ => None,
        };
        let (effects, warnings) = effects::decide(&case, &estimate, law);
        Ok(Self { effects, warnings, estimate, motion, pair, case })
    }

    /// In a few words: what is integrated.
    pub fn describe(&self) -> String {
        let name = self.case.scene.model.name();
        match (&self.motion, &self.case.scene.model) {
            (Motion::Hertz(_), _) => "model hertz, a closed form".to_string(),
            (Motion::Law(_), Model::Law { law, .. }) => {
                format!("model law {}, one degree of freedom", law.name())
            }
            _ => format!("model {name}, one degree of freedom"),
        }
    }

    /// Stiffness and dashpot of a law.
    pub fn law(&self) -> Option<&ContactLaw> {
        match &self.motion {
            Motion::Law(motion) => Some(&motion.law),
            _ => None,
        }
    }

    /// The law's numbers, SI, in the order of its family's parameters.
    pub fn law_numbers(&self) -> Option<&[f64]> {
        match &self.motion {
            Motion::Law(motion) => Some(&motion.numbers),
            _ => None,
        }
    }

    /// Computes the collision; `halt` says why if it cannot.
    pub fn run(&self) -> Outcome {
        match self.impact(self.estimate.hertz.approach_speed()) {
            Ok(impact) => self.outcome(&impact),
            Err(error) => Outcome::halted(error.into()),
        }
    }

    /// The relative motion at an approach speed, m/s, the law's numbers those of the case.
    ///
    /// # Errors
    /// Those of the model.
    pub fn impact(&self, speed: f64) -> Result<Impact, LawError> {
        match &self.motion {
            Motion::Hertz(hertz) => Ok(HertzImpact::new(hertz.pair(), speed)?.impact()),
            Motion::Ting(ting) => ting.impact(speed),
            Motion::Law(motion) => motion.impact.impact(speed),
        }
    }

    /// The case with the model's defaults filled in; what the model does not read stays as it is.
    pub fn resolve(&self) -> CaseFile {
        let mut file = self.case.file.clone();
        let gap = self.case.scene.gap.unwrap_or_default();
        file.start = Some(StartTable { gap: Some(Quantity::from_si(gap)) });
        let given = file.model.take().unwrap_or_default();
        file.model = Some(match &self.case.scene.model {
            Model::Fem | Model::Condensed(_) => given,
            Model::Hertz { finite_size } => ModelTable {
                hertz: Some(HertzTable { finite_size: Some(*finite_size) }),
                ..ModelTable::default()
            },
            Model::Ting { finite_size, tolerance } => ModelTable {
                ting: Some(TingTable {
                    finite_size: Some(*finite_size),
                    tolerance: Some(Quantity::from_si(*tolerance)),
                }),
                ..ModelTable::default()
            },
            Model::Law { end_rule, tolerance, .. } => {
                let end = match end_rule {
                    EndRule::ZeroForce => End::ZeroForce,
                    EndRule::ZeroOverlap => End::ZeroOverlap,
                };
                let law = given.law.unwrap_or_default().filled(end, *tolerance);
                ModelTable { law: Some(self.with_speed(law)), ..ModelTable::default() }
            }
        });
        file
    }

    /// The speed at which Hunt and Crossley's restitution is wanted, if left to the case.
    fn with_speed(&self, mut law: LawTable) -> LawTable {
        if let Some(keys) = &mut law.hunt_crossley {
            let speed = self.estimate.hertz.approach_speed();
            keys.v.get_or_insert(Quantity::from_si(speed));
        }
        law
    }
}

fn materials(case: &Case) -> [Option<&Material>; 2] {
    case.scene.bodies.each_ref().map(|body| body.material())
}

/// Ting's model of a case, of the materials or of elastic ones with the same instantaneous moduli.
fn ting(
    case: &Case,
    estimate: &Estimate,
    relaxes: bool,
    finite_size: bool,
    tolerance: f64,
) -> Result<(Motion, Pair), CaseError> {
    let path = case.scene.model.path();
    let refuse = |error: LawError| case.error_at(&path, error.to_string());
    let pair = *estimate.hertz.pair();
    let size = finite_size.then(|| case.scene.finite_size()).transpose().map_err(refuse)?;
    if let Some(size) = &size {
        size.check(estimate.hertz.max_contact_radius()).map_err(|error| {
            case.error_at(&format!("{path}.finite_size"), error.to_string())
                .with_help("write finite_size = false, or use model fem")
        })?;
    }
    let ting = ting_of(&case.scene, &pair, relaxes, size).map_err(refuse)?;
    Ok((Motion::Ting(ting.with_tolerance(tolerance).map_err(refuse)?), pair))
}

/// Ting's impact of a scene, on half-spaces or with the compliance of finite spheres in series,
/// however large the contact.
///
/// # Errors
/// Numbers that the law refuses.
pub fn ting_impact(scene: &Scene, pair: &Pair, finite_size: bool) -> Result<Impact, LawError> {
    let size = finite_size.then(|| scene.finite_size()).transpose()?;
    ting_of(scene, pair, true, size)?.impact(scene.approach_speed())
}

fn ting_of(
    scene: &Scene,
    pair: &Pair,
    relaxes: bool,
    size: Option<FiniteSize>,
) -> Result<Ting, LawError> {
    let [first, second] = scene.bodies.each_ref().map(Body::material);
    let elastic = |material: Option<&Material>| material.map(Material::without_relaxation);
    let relaxation = if relaxes {
        PairRelaxation::new(first, second)?
    } else {
        PairRelaxation::new(elastic(first).as_ref(), elastic(second).as_ref())?
    };
    let ting = Ting::new(pair, relaxation);
    Ok(match size {
        Some(size) => ting.with_finite_size(size),
        None => ting,
    })
}

fn law_numbers(
    case: &Case,
    estimate: &Estimate,
    law: &Law,
    end_rule: EndRule,
) -> Result<(Vec<f64>, Pair), CaseError> {
    let path = case.scene.model.path();
    let materials = materials(case);
    let relaxation = PairRelaxation::new(materials[0], materials[1])
        .map_err(|error| case.error_at(&path, error.to_string()))?;
    let setting = Setting {
        pair: *estimate.hertz.pair(),
        speed: estimate.hertz.approach_speed(),
        materials,
        relaxation: &relaxation,
        end_rule,
    };
    setting.numbers(law).map_err(|refusal| match refusal {
        Refusal::Law(error) => case.error_at(&path, error.to_string()),
        Refusal::Source(message, help) => case.error_at(&path, message).with_help(help),
    })
}
