//! Drake: point contact with Hunt & Crossley's dissipation d.
//!
//! ```math
//! F = k\,\xi\,(1 + d\,\dot\xi)_+
//! ```
//!
//! (*Drake documentation*, Compliant point contact). The restitution depends on a = d v alone, for any
//! spring: from v dv/(1 + d v) = −(k/m*) ξ dξ, the same ξ on the way in and out,
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

use super::snippet::{Export, HuntCrossley, Snippet, short, speed, time};
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
    // Of data that rise with speed the sum of squares may have more than one minimum.
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

/// A point contact with the d that fits e(v) best, and T of the linear law.
pub fn drake_snippets(export: &Export) -> Vec<Snippet> {
    // What cannot be entered is left out.
    let (Ok(law), Some(fitted)) = (export.linear_law(EndRule::ZeroForce), export.hunt_crossley)
    else {
        return Vec::new();
    };
    let HuntCrossley { dissipation, rms, validity } = fitted;
    let (slow, fast) = export.speeds;
    let made = |speed: f64| restitution_of(dissipation * speed);
    let heading = export.heading(
        "Drake, point contact, Hunt & Crossley",
        validity,
        &[
            format!(
                "Makes e = {:.4} at {}, {:.4} at {}: what it loses goes with speed.",
                made(slow),
                speed(slow),
                made(fast),
                speed(fast)
            ),
            format!("dissipation is fitted to e(v); rms error {rms:.4}."),
        ],
    );
    let text = format!(
        "{heading}from pydrake.geometry import AddContactMaterial, ProximityProperties\n\n\
         properties = ProximityProperties()   # of both bodies\n\
         AddContactMaterial(\n    dissipation={}, point_stiffness={}, properties=properties)\n\
         # The contact takes {}: a discrete plant needs a fiftieth of that, or less.\n",
        short(dissipation),
        short(2.0 * law.stiffness()),
        time(export.linear.contact_time)
    );
    vec![Snippet {
        name: "drake_point_contact.py",
        code: "Drake",
        model: "Hunt-Crossley",
        entries: vec![("dissipation", dissipation), ("point_stiffness", 2.0 * law.stiffness())],
        restitution: None,
        validity,
        text,
    }]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The equation of motion itself, stepped: half-implicit, to 1e-4 with 20,000 steps a contact.
    #[test]
    fn the_restitution_is_that_of_the_motion() {
        for a in [0.03, 0.3, 2.0] {
            let (mut x, mut v, dt) = (0.0_f64, 1.0_f64, std::f64::consts::PI / 20_000.0);
            while x >= 0.0 {
                v -= dt * x * (1.0 + a * v).max(0.0);
                x += dt * v;
            }
            assert!((restitution_of(a) + v).abs() < 2e-4, "{a}: {} {v}", restitution_of(a));
        }
    }

    /// e = 1 − 2a/3 + O(a²).
    #[test]
    fn a_weak_dashpot_is_that_of_hunt_and_crossley() {
        for a in [1e-2, 1e-3] {
            assert!((restitution_of(a) - (1.0 - 2.0 * a / 3.0)).abs() < a * a, "{a}");
        }
    }

    /// The dissipation that made the data is found; for data with another slope, no neighbour is better.
    #[test]
    fn the_dissipation_is_the_one_that_fits_best() {
        let of = |e: &dyn Fn(f64) -> f64| -> Vec<Point> {
            [0.05, 0.1, 0.3, 1.0, 4.0].iter().map(|v| Point::new(*v, e(*v))).collect()
        };
        let exact = fit_dissipation(&of(&|v| restitution_of(0.7 * v))).unwrap().unwrap();
        assert!((exact.dissipation / 0.7 - 1.0).abs() < 1e-6 && exact.rms < 1e-7, "{exact:?}");
        let points = of(&|v| 0.8 - 0.1 * v.ln());
        let best = fit_dissipation(&points).unwrap().unwrap();
        let sum = |d: f64| -> f64 {
            points.iter().map(|p| (restitution_of(d * p.speed) - p.restitution).powi(2)).sum()
        };
        for factor in [0.01, 0.1, 0.5, 0.99, 1.01, 2.0, 10.0] {
            assert!(sum(best.dissipation) < sum(factor * best.dissipation), "{factor}");
        }
        assert_eq!(fit_dissipation(&of(&|_| 1.0)), Ok(None));
    }

    #[test]
    fn one_is_the_others_inverse() {
        for e in [0.05, 0.5, 0.92, 0.999] {
            assert!((restitution_of(dissipation_of(e)) - e).abs() < 1e-6, "{e}");
        }
    }
}
