//! Drake: point contact with Hunt & Crossley's dissipation d.
//!
//! ```math
//! F = k\,\xi\,(1 + d\,\dot\xi)_+
//! ```
//!
//! (*Drake documentation*, Compliant point contact). The restitution depends on a = d v alone, for any
//! spring: from v dv/(1 + d v) = −(k/m*) ξ dξ, integrated over loading and unloading between the same overlaps,
//!
//! ```math
//! (1+e)\,a = \ln\frac{1+a}{1-e\,a} .
//! ```
//!
//! It falls with speed, as 1 − 2a/3 at first. Two bodies of stiffness k₁, k₂ make k₁k₂/(k₁ + k₂), and the
//! mean of d weighed by the other's stiffness: of equal ones k/2 and d.
//! Run in Drake by `.ci/check_robotics.py`.

use fem_laws::EndRule;
use fem_laws::bisection::last_where;

use super::snippet::{DRAKE_POINT_CONTACT, Export, HuntCrossley, Snippet, short, speed, time};
use crate::fit::error::FitError;
use crate::fit::least_squares::minimise;
use crate::fit::problem::Point;

/// Decades around the data's own values within which d is searched.
const REACH: f64 = 1e6;

/// Returns a = d v of a restitution between 0 and 1.
pub fn dissipation_of(restitution: f64) -> f64 {
    let e = restitution;
    // The root is above 3/2 (1 − e).
    last_where(0.5 * (1.0 - e), e.recip(), |a| surplus(e, a) >= 0.0)
}

/// Returns the restitution at a = d v > 0.
pub fn restitution_of(a: f64) -> f64 {
    last_where(0.0, a.recip().min(1.0), |e| surplus(e, a) >= 0.0)
}

/// (1 + e) a less the logarithm: positive below the root, a of an e or e of an a; far below it rounding.
fn surplus(e: f64, a: f64) -> f64 {
    (1.0 + e) * a - a.ln_1p() + (-e * a).ln_1p()
}

/// Returns d, s/m, by least squares of e(v), and its error; `None` for data without a loss or with nothing
/// but loss.
///
/// # Errors
/// A fit that does not converge.
pub fn fit_dissipation(points: &[Point]) -> Result<Option<HuntCrossley>, FitError> {
    let lossy = points.iter().filter(|point| (1e-6..1.0 - 1e-6).contains(&point.restitution));
    let mut own: Vec<f64> =
        lossy.map(|point| dissipation_of(point.restitution) / point.speed).collect();
    own.sort_by(f64::total_cmp);
    let [first, .., last] = own[..] else { return Ok(None) };
    let residuals = |theta: &[f64]| {
        let d = theta[0].exp();
        Some(
            points
                .iter()
                .map(|point| restitution_of(d * point.speed) - point.restitution)
                .collect(),
        )
    };
    let bounds = [((first / REACH).ln(), (last * REACH).ln())];
    // For data that rise with speed the sum of squares may have more than one minimum.
    let starts = [first, own[own.len() / 2], last];
    let mut best: Option<(f64, f64)> = None;
    for start in starts {
        let (theta, sum) = minimise(&residuals, &[start.ln()], &bounds)?;
        if best.is_none_or(|best| sum < best.1) {
            best = Some((theta[0].exp(), sum));
        }
    }
    Ok(best.map(|(dissipation, sum)| HuntCrossley {
        dissipation,
        rms: (sum / points.len() as f64).sqrt(),
        validity: [f64::INFINITY, 0.0, 0.0],
    }))
}

/// Returns a point contact with the d that fits e(v) best, and T of the linear law; none if they cannot be entered.
pub fn drake_snippets(export: &Export) -> Vec<Snippet> {
    let (Ok(law), Some(fitted)) = (export.linear_law(EndRule::ZeroForce), export.hunt_crossley)
    else {
        return Vec::new();
    };
    let HuntCrossley { dissipation, rms, .. } = fitted;
    let stiffness = 2.0 * law.stiffness();
    let (slow, fast) = export.speeds;
    let made = |speed: f64| restitution_of(dissipation * speed);
    let commands = format!(
        "from pydrake.geometry import AddContactMaterial, ProximityProperties\n\n\
         properties = ProximityProperties()   # of both bodies\n\
         AddContactMaterial(\n    dissipation={}, point_stiffness={}, properties=properties)\n\
         # The contact takes {}: a discrete plant needs a fiftieth of that, or less.\n",
        short(dissipation),
        short(stiffness),
        time(export.linear.contact_time)
    );
    vec![export.snippet(
        DRAKE_POINT_CONTACT,
        &[("dissipation", dissipation), ("point_stiffness", stiffness)],
        &[
            &format!(
                "Makes e = {:.4} at {}, {:.4} at {}: what it loses goes with speed.",
                made(slow),
                speed(slow),
                made(fast),
                speed(fast)
            ),
            &format!("dissipation is fitted to e(v); rms error {rms:.4}."),
        ],
        &commands,
    )]
}
