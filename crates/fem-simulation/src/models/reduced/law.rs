//! Contact laws: a spring and a dashpot of the overlap, or a contact that dents, integrated.

use fem_case::schema::LawTable;
use fem_case::{Quantity, Scene};
use fem_laws::laws::ContactLaw;
use fem_laws::{
    EndRule, FirstYield, Impact, LawContext, LawError, LawImpact, LawInput, LawInputError, Pair,
    PairRelaxation,
};

use super::{Motion, MotionOfScene, rejected};
use crate::estimate::plate_impact::thin_plate_mobility;
use crate::estimate::{Estimate, Regime};
use crate::rejection::Rejection;

/// Returns the law with Hunt and Crossley's speed (m/s) filled in, at which their restitution holds.
pub(super) fn with_speed(mut law: LawTable, speed: f64) -> LawTable {
    if let Some(keys) = &mut law.hunt_crossley {
        keys.v.get_or_insert(Quantity::from_si(speed));
    }
    law
}

/// A law, its parameters, and its integration.
#[derive(Debug)]
struct LawMotion {
    impact: LawImpact,
    law: ContactLaw,
    numbers: Vec<f64>,
}

impl Motion for LawMotion {
    fn impact(&self, speed: f64) -> Result<Impact, LawError> {
        self.impact.impact(speed)
    }

    fn law(&self) -> Option<&ContactLaw> {
        Some(&self.law)
    }

    fn law_numbers(&self) -> Option<&[f64]> {
        Some(&self.numbers)
    }
}

/// Returns the motion of a scene.
pub(super) fn motion(
    regime: &Regime,
    law: &LawInput,
    end_rule: EndRule,
    tolerance: f64,
) -> Result<MotionOfScene, Rejection> {
    let Regime { scene, estimate } = regime;
    let reject = |error: LawError| rejected(scene, &error);
    let (numbers, pair) = law_numbers(scene, estimate, law, end_rule)?;
    let name = law.family.name();
    let Some(made) = law.family.law(&pair, &numbers) else {
        let message = format!("{name} is no law of the overlap");
        return Err(Rejection::new(scene.model().path(), message));
    };
    let description = format!("model law {name}, one degree of freedom");
    let law = made.map_err(reject)?;
    let impact = LawImpact::new(&pair, law).with_end_rule(end_rule);
    let gravity = scene.gravity().map_or(0.0, |gravity| gravity.acceleration);
    let impact = impact.with_tolerance(tolerance).and_then(|impact| impact.with_gravity(gravity));
    let mut impact = impact.map_err(reject)?;
    if let Some(mobility) = thin_plate_mobility(scene) {
        impact = impact.with_plate(mobility).map_err(reject)?;
    }
    Ok((Box::new(LawMotion { impact, law, numbers }), pair, description))
}

/// Returns the parameters of a law and the pair that they belong to.
pub(super) fn law_numbers(
    scene: &Scene,
    estimate: &Estimate,
    law: &LawInput,
    end_rule: EndRule,
) -> Result<(Vec<f64>, Pair), Rejection> {
    let relaxation = relaxation_of(scene).map_err(|error| rejected(scene, &error))?;
    let context = context(scene, estimate, &relaxation, end_rule);
    law.parameters(&context).map_err(|error| match error {
        LawInputError::Law(error) => rejected(scene, &error),
        LawInputError::Materials { message, help } => {
            Rejection::new(scene.model().path(), message).with_help(help)
        }
    })
}

/// Returns the first yield of the body that flows under a law that dents; `None` if the law cannot be made of the scene.
pub(super) fn flow_of(scene: &Scene, estimate: &Estimate, law: &LawInput) -> Option<FirstYield> {
    let relaxation = relaxation_of(scene).ok()?;
    let context = context(scene, estimate, &relaxation, EndRule::ZeroForce);
    fem_laws::laws::flow_of(law, &context).ok()
}

fn relaxation_of(scene: &Scene) -> Result<PairRelaxation, LawError> {
    let [first, second] = scene.bodies().each_ref().map(|body| body.material());
    PairRelaxation::new(first, second)
}

/// Returns the pair and the collision that a law is made for.
fn context<'a>(
    scene: &'a Scene,
    estimate: &Estimate,
    relaxation: &'a PairRelaxation,
    end_rule: EndRule,
) -> LawContext<'a> {
    LawContext {
        pair: *estimate.hertz.pair(),
        approach_speed: estimate.hertz.approach_speed(),
        materials: scene.bodies().each_ref().map(|body| body.material()),
        yield_strengths: scene.bodies().each_ref().map(|body| body.yield_strength()),
        radii: scene.bodies().each_ref().map(|body| body.radius()),
        relaxation,
        end_rule,
    }
}
