//! Drake: point contact with Hunt & Crossley's dissipation d.
//!
//! ```math
//! F = k\,\xi\,(1 + d\,\dot\xi)_+
//! ```
//!
//! (*Drake documentation*, Compliant point contact). The restitution depends on a = d v alone, whatever
//! the spring is: from v dv/(1 + d v) = −(k/m*) ξ dξ, the same ξ on the way in and out,
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

use super::snippet::{Export, Snippet, short};

/// a = d v of a restitution between 0 and 1.
pub fn dissipation_of(restitution: f64) -> f64 {
    let e = restitution;
    // The difference is positive up to the root, which is above 3/2 (1 − e), and negative beyond; far
    // below the root it is rounding.
    let is_below = |a: f64| (1.0 + e) * a >= a.ln_1p() - (-e * a).ln_1p();
    last_where(0.5 * (1.0 - e), e.recip(), is_below)
}

/// The restitution at a = d v > 0.
pub fn restitution_of(a: f64) -> f64 {
    last_where(0.0, 1.0, |e| dissipation_of(e) >= a)
}

/// A point contact that has e of the data at their middle speed, and T of the linear law.
pub fn drake_snippets(export: &Export) -> Vec<Snippet> {
    let e = export.hertz.restitution;
    // What cannot be entered is left out.
    let (Ok(law), true) = (export.linear_law(EndRule::ZeroForce), e > 0.0 && e < 1.0) else {
        return Vec::new();
    };
    let stiffness = law.stiffness();
    let (slow, fast) = export.speeds;
    let speed = (slow * fast).sqrt();
    let dissipation = dissipation_of(e) / speed;
    let at = |e: f64| dissipation_of(e.clamp(1e-6, 1.0 - 1e-9)) / dissipation;
    let off = |v: f64| (restitution_of(dissipation * v) - e).abs();
    // The data's own departure from one e adds to that of the law.
    let worst = off(slow).max(off(fast)) + export.hertz.validity[2];
    let (from, to) = (at(e + export.tolerance).max(slow), at(e - export.tolerance).min(fast));
    let validity = [from, to, worst];
    let heading = export.heading(
        "Drake, point contact, Hunt & Crossley",
        validity,
        &[
            format!("Makes e = {e:.4} at {speed:.4} m/s, and less above: 1 - e goes with speed."),
            "Of data with one e for all speeds; what theirs changes comes on top.".to_string(),
        ],
    );
    let text = format!(
        "{heading}from pydrake.geometry import AddContactMaterial, ProximityProperties\n\n\
         properties = ProximityProperties()   # of both bodies\n\
         AddContactMaterial(\n    dissipation={}, point_stiffness={}, properties=properties)\n\
         # The contact takes {:.2e} s: a discrete plant needs a fiftieth of that, or less.\n",
        short(dissipation),
        short(2.0 * stiffness),
        export.linear.contact_time
    );
    vec![Snippet {
        name: "drake_point_contact.py",
        code: "Drake",
        model: "Hunt-Crossley",
        entries: vec![("dissipation", dissipation), ("point_stiffness", 2.0 * stiffness)],
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

    #[test]
    fn one_is_the_others_inverse() {
        for e in [0.05, 0.5, 0.92, 0.999] {
            assert!((restitution_of(dissipation_of(e)) - e).abs() < 1e-6, "{e}");
        }
    }
}
