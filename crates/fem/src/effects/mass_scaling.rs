//! Mass moved to the lightest nodes for a longer time step: a decision of the plan.

use fem_case::{Body, Scene};
use fem_collision::Collision;

use super::answer::Answer;
use super::effect::Effect;
use super::need::percent;
use crate::estimate::Estimate;

/// Moved mass over the lighter body's mass: of 1 % the peak force is off by up to half of that.
const LARGEST_ADDED_MASS: f64 = 1e-2;
/// Moved mass over that mass up to which it is a rounding of the node that decides on the step.
const ROUNDING: f64 = 1e-12;
const NOTHING: &str = "no mass is moved";

/// Mass moved for a longer time step.
#[derive(Clone, Copy, Debug)]
pub struct MassScaling;

impl MassScaling {
    /// Its name in results.
    pub const NAME: &'static str = "mass scaling";

    /// What a model has of it whose bodies have these masses (kg; a wall or a half-space none), in which so
    /// much is moved, kg, and whose time step is so many times longer for it.
    pub(crate) fn of(
        scene: &Scene,
        masses: [Option<f64>; 2],
        added: [Option<f64>; 2],
        longer: f64,
    ) -> Answer {
        let names = scene.bodies().each_ref().map(Body::name);
        let free = masses.into_iter().zip(names);
        let free = free.filter_map(|(mass, name)| Some((mass?, name)));
        let Some((lightest, its)) = free.min_by(|a, b| a.0.total_cmp(&b.0)) else {
            return Answer::is(false, NOTHING);
        };
        let moved = added.into_iter().zip(masses).zip(names).filter_map(|((added, mass), name)| {
            let share = added.map(|added| added / lightest).filter(|share| *share > ROUNDING)?;
            let of = percent(share);
            Some(match mass == Some(lightest) {
                true => format!("{of} of the mass of {name}"),
                false => format!("{of} of the mass of {its} in {name}"),
            })
        });
        let moved: Vec<String> = moved.collect();
        match moved.is_empty() {
            true => Answer::is(false, NOTHING),
            false => {
                let moved = moved.join(" and ");
                Answer::is(true, format!("moves {moved} for a {longer:.1} times longer step"))
            }
        }
    }
}

impl Effect for MassScaling {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn found(&self, scene: &Scene, collision: &Collision) -> Option<Answer> {
        let longer = collision.time_step? / collision.plain_time_step?;
        let masses = collision.bodies.each_ref().map(|body| body.mass);
        let added = collision.bodies.each_ref().map(|body| body.added_mass);
        Some(Self::of(scene, masses, added, longer))
    }

    fn after(&self, scene: &Scene, _: &Estimate, collision: &Collision) -> Vec<String> {
        let shares = collision.added_shares().into_iter().zip(scene.bodies());
        let warnings = shares.filter_map(|(share, named)| {
            let share = share.filter(|share| *share > LARGEST_ADDED_MASS)?;
            Some(format!(
                "mass scaling moves {:.2} % of the lighter body's mass to light nodes of {}; above {} %, use a \
                 smaller time.mass_scaling",
                100.0 * share,
                named.name(),
                100.0 * LARGEST_ADDED_MASS
            ))
        });
        warnings.collect()
    }
}
