//! Surfaces of unlike materials move by different amounts along their common tangent, and the interface
//! is curved: contact between the points that faced each other at first is off by the slope of the
//! interface times the difference.
//!
//! ```math
//! \frac{\Delta T}{T} = 0.24\, a\,|\kappa\,\beta|, \qquad
//! \kappa = \frac{s_1}{R_2}-\frac{s_2}{R_1}, \qquad
//! \beta = \frac{(1-2\nu_1)/\mu_1-(1-2\nu_2)/\mu_2}{2(1-\nu_1)/\mu_1+2(1-\nu_2)/\mu_2}
//! ```
//!
//! with the shares s of the contact's compliance, so that κ is the curvature of the interface, and
//! Dundurs' second parameter β. It is first order in a/R, and nothing between like bodies or against
//! a plane that does not give way.

use fem_case::{Body, EffectsTable, Scene, Switch};

use super::effect::Effect;
use super::left_out::LeftOut;
use super::need::{Need, percent};
use crate::estimate::Estimate;

/// Change of the contact time over a κβ: explicit elements with and without the slip gave 0.22 for
/// steel on a soft polymer and 0.27 for steel on glass.
const TIME_SHARE: f64 = 0.24;
/// The same of the peak force: 0.30 and 0.31.
const FORCE_SHARE: f64 = 0.3;
/// Change of the contact time that is worth a warning.
const SMALL_SHARE: f64 = 1e-3;

/// Surfaces that slip on each other.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceSlip;

impl SurfaceSlip {
    /// Its name in results.
    pub const NAME: &'static str = "surface slip";
}

impl Effect for SurfaceSlip {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn switch(&self, effects: &EffectsTable) -> Option<Switch> {
        effects.surface_slip
    }

    fn need(&self, scene: &Scene, estimate: &Estimate) -> Option<Need> {
        let slope = slope(scene, estimate);
        let share = TIME_SHARE * slope;
        let is_called_for = share > SMALL_SHARE;
        let warning = is_called_for.then(|| {
            format!(
                "the surfaces of unlike materials slip on each other, which changes the contact time \
                 by about {} and the peak force by {}; no model here has it",
                percent(share),
                percent(FORCE_SHARE * slope)
            )
        });
        Some(Need {
            is_called_for,
            number: format!("slope of the interface × mismatch of the materials = {slope:.1e}"),
            otherwise: "facing points move alike".to_string(),
            left_open: format!("{} of the contact time is open", percent(share)),
            warning,
        })
    }

    fn left_out(&self, scene: &Scene, estimate: &Estimate) -> Option<LeftOut> {
        let slope = slope(scene, estimate);
        Some(LeftOut::shares(estimate, TIME_SHARE * slope, FORCE_SHARE * slope))
    }
}

/// a |κ β|.
fn slope(scene: &Scene, estimate: &Estimate) -> f64 {
    let [lower, upper] = scene.bodies().each_ref().map(Face::of);
    let compliance = lower.normal + upper.normal;
    let shares = [lower.normal / compliance, upper.normal / compliance];
    let curvature = shares[0] * upper.curvature - shares[1] * lower.curvature;
    let mismatch = (lower.tangential - upper.tangential) / (2.0 * compliance);
    let slope = estimate.contact_radius * (curvature * mismatch).abs();
    if slope.is_finite() { slope } else { 0.0 }
}

/// What a body's surface gives way by.
struct Face {
    /// 1/m.
    curvature: f64,
    /// (1 − ν)/μ, 1/Pa.
    normal: f64,
    /// (1 − 2ν)/μ, 1/Pa.
    tangential: f64,
}

impl Face {
    /// Of a body; a wall neither bends nor gives way.
    fn of(body: &Body) -> Self {
        let curvature = body.diameter().map_or(0.0, |diameter| 2.0 / diameter);
        let Some(material) = body.material() else {
            return Self { curvature, normal: 0.0, tangential: 0.0 };
        };
        let now = material.instantaneous();
        let (nu, shear) = (now.poissons_ratio(), now.shear_modulus());
        Self { curvature, normal: (1.0 - nu) / shear, tangential: (1.0 - 2.0 * nu) / shear }
    }
}
