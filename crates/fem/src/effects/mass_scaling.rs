//! Mass moved to the lightest nodes for a longer time step: a decision of the plan.

use fem_case::Scene;
use fem_case::engineering::number;
use fem_collision::Collision;

use super::answer::Answer;
use super::effect::Effect;
use crate::estimate::Estimate;

/// Moved mass over a body's mass: of 1 % the peak force is off by up to half of that.
const LARGEST_ADDED_MASS: f64 = 1e-2;
/// Moved mass over a body's mass up to which it is a rounding of the node that decides on the step.
const ROUNDING: f64 = 1e-12;

/// Mass moved for a longer time step.
#[derive(Clone, Copy, Debug)]
pub struct MassScaling;

impl MassScaling {
    /// Its name in results.
    pub const NAME: &'static str = "mass scaling";

    /// What a model has of it that moves these shares of the masses of bodies, by name, and whose time
    /// step is so many times longer for it. A wall's share is no number.
    pub(crate) fn of<'a>(shares: impl Iterator<Item = (&'a str, f64)>, longer: f64) -> Answer {
        let added = shares.filter(|(_, share)| *share > ROUNDING);
        let added: Vec<String> = added
            .map(|(name, share)| format!("{} of the mass of {name}", number(share, 2)))
            .collect();
        match added.is_empty() {
            true => Answer::is(false, "no mass is moved"),
            false => {
                let added = added.join(" and ");
                Answer::is(true, format!("moves {added} for a {longer:.1} times longer step"))
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
        let both = collision.bodies.iter().zip(scene.bodies());
        let shares =
            both.filter_map(|(body, named)| Some((named.name(), body.added_mass? / body.mass?)));
        Some(Self::of(shares, longer))
    }

    fn after(&self, scene: &Scene, _: &Estimate, collision: &Collision) -> Vec<String> {
        let bodies = collision.bodies.iter().zip(scene.bodies());
        let warnings = bodies.filter_map(|(body, named)| {
            let share = body.added_mass? / body.mass?;
            (share > LARGEST_ADDED_MASS).then(|| {
                format!(
                    "mass scaling moves {:.2} % of the mass of {} to its light nodes; above {} %, use a \
                     smaller time.mass_scaling",
                    100.0 * share,
                    named.name(),
                    100.0 * LARGEST_ADDED_MASS
                )
            })
        });
        warnings.collect()
    }
}
