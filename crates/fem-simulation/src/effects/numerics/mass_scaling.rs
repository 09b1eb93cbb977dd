//! Mass moved to the lightest nodes for a longer time step, a decision of the plan.
//!
//! Mass m that is moved to the contact of body i moves with it, by the share s_i of the approach that the body deforms. The
//! mass centre has an error of (m/m_i) s_i of the approach, and the energy one of m/m_light s_i². Equally compliant bodies
//! have s = ½. A body with s < ⅛ gets more mass in inverse proportion to s, up to a share of its own mass, at a quarter of
//! the error.

use fem_case::engineering::number;
use fem_case::{Body, Scene};
use fem_collision::Collision;
use fem_material::{Material, PronySeries};

use crate::effects::decision::relevance::percent;
use crate::effects::decision::support::Support;
use crate::effects::decision::{Effect, MassScaling};
use crate::estimate::Estimate;

/// Largest moved mass over the lighter body's mass, by default and without a warning: at 1 % the error of the peak force is up
/// to half of that, and bodies with relaxation times near the time step are more sensitive.
pub(crate) const MAX_MOVED_MASS: f64 = 1e-2;
/// Moved mass over that mass below which it is rounding of the node that determines the time step.
const ROUNDING_OF_MASS: f64 = 1e-12;
const NOTHING: &str = "no mass is moved";

/// Share of the approach below which more mass is moved in a body.
const LITTLE_SHARE: f64 = 0.125;

/// Returns the equilibrium modulus of a body over its instantaneous one.
fn equilibrium_share(body: &Body) -> f64 {
    let series = body.material().and_then(Material::relaxation);
    let terms = series.into_iter().flat_map(PronySeries::terms);
    1.0 - terms.map(|term| term.weight).sum::<f64>()
}

impl MassScaling {
    /// Returns the factor on the moved mass in each body relative to bodies of equal compliance.
    pub(crate) fn times(scene: &Scene) -> [f64; 2] {
        let moduli = scene.bodies().each_ref().map(|body| body.partner().plane_strain_modulus());
        std::array::from_fn(|side| {
            // The body is most compliant at equilibrium.
            let own = moduli[side] * equilibrium_share(&scene.bodies()[side]);
            let share = moduli[1 - side] / (own + moduli[1 - side]);
            let times = LITTLE_SHARE / share;
            if times.is_finite() && times > 1.0 { times } else { 1.0 }
        })
    }

    /// Returns the support of a model with these body masses (kg; none for a wall or half-space), moved
    /// masses (kg) and gain in time step.
    pub(crate) fn of(
        scene: &Scene,
        masses: [Option<f64>; 2],
        moved: [Option<f64>; 2],
        longer: f64,
    ) -> Support {
        let names = scene.bodies().each_ref().map(Body::name);
        let Some(lightest) = masses.into_iter().flatten().min_by(f64::total_cmp) else {
            return Support::decided(false, NOTHING);
        };
        let each = moved.into_iter().zip(names).zip(Self::times(scene));
        let moved = each.filter_map(|((moved, name), times)| {
            let share = moved? / lightest;
            let less = match times > 1.0 {
                true => {
                    format!(" (which deforms {} times less)", number(times / LITTLE_SHARE - 1.0, 2))
                }
                false => String::new(),
            };
            (share > ROUNDING_OF_MASS).then(|| format!("{} in {name}{less}", percent(share)))
        });
        let moved: Vec<String> = moved.collect();
        match moved.is_empty() {
            true => Support::decided(false, NOTHING),
            false => {
                let moved = moved.join(" and ");
                let reason = format!(
                    "mass moved to light nodes, as a share of the lighter body's mass: {moved}; the time step is \
                     {longer:.1} times longer"
                );
                Support::decided(true, reason)
            }
        }
    }
}

impl Effect for MassScaling {
    fn support_in_result(&self, scene: &Scene, collision: &Collision) -> Option<Support> {
        let longer = collision.time_step? / collision.plain_time_step?;
        let masses = collision.bodies.each_ref().map(|body| body.mass);
        let moved = collision.bodies.each_ref().map(|body| body.moved_mass);
        Some(Self::of(scene, masses, moved, longer))
    }

    fn warnings_of_result(
        &self,
        scene: &Scene,
        _: &Estimate,
        collision: &Collision,
    ) -> Vec<String> {
        let shares =
            collision.moved_shares().into_iter().zip(scene.bodies()).zip(Self::times(scene));
        let warnings = shares.filter_map(|((share, named), times)| {
            let share = share.filter(|share| *share > MAX_MOVED_MASS * times)?;
            Some(format!(
                "mass scaling moves {:.2} % of the lighter body's mass to light nodes of {}; above {} %, use a \
                 smaller time.mass_scaling",
                100.0 * share,
                named.name(),
                number(100.0 * MAX_MOVED_MASS * times, 3)
            ))
        });
        warnings.collect()
    }
}
