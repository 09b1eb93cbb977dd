//! YADE: Hertz–Mindlin with `en`, and the linear ViscEl with `tc` and `en`.
//!
//! Hertz–Mindlin turns en into β_n by the fit of Thornton, Cummins & Cleary (2013), eq. 20, for a
//! contact that ends at zero force, and damps with C = 2β_n √(m* S) ξ^(1/4), S = 2E*√R*: what comes
//! out misses what is entered by 8e-4 at 0.936, so the entry is corrected. ViscEl takes
//!
//! ```math
//! k_n = \frac{m^*(\pi^2+\ln^2e_n)}{t_c^2}, \qquad c_n = -\frac{2m^*\ln e_n}{t_c}
//! ```
//!
//! (Pournin et al. 2001), right for a contact that ends at zero overlap, but cuts the force off at
//! zero: 0.92 entered makes 0.9213, and is corrected too. Seen in YADE 2023.02a.

use std::f64::consts::PI;

use fem_laws::bisection::falling_zero;
use fem_laws::laws::power;
use fem_laws::{EndRule, LawError, LawImpact, Pair};

use super::snippet::{
    Dashpot, Export, Snippet, Sphere, YADE_HERTZ_MINDLIN, YADE_VISCEL, short, time,
};

/// Returns β_n of an en from 0 to 1 (not included).
pub fn yade_betan(en: f64) -> f64 {
    const H: [f64; 10] = [
        -6.918798, -16.41105, 146.8049, -796.4559, 2928.711, -7206.864, 11494.29, -11342.18,
        6276.757, -1489.915,
    ];
    let exponent = en * H.iter().rev().fold(0.0, |sum, h| sum * en + h);
    let share = 1.0 - (1.0 + en).powi(2) * exponent.exp();
    (share.recip() - 1.0).max(0.0).sqrt()
}

/// Returns the en for which Hertz–Mindlin makes this restitution.
///
/// # Errors
/// The pair has no collision.
pub fn hertz_mindlin_entry(pair: &Pair, restitution: f64) -> Result<f64, LawError> {
    let stiffness = 2.0 * pair.contact_modulus() * pair.effective_radius().sqrt();
    let unit = 2.0 * (pair.effective_mass() * stiffness).sqrt();
    // The restitution is the same at every speed.
    let made = |en: f64| {
        let law = power(2.0 / 3.0 * stiffness, 1.5, unit * yade_betan(en), 0.25)?;
        Ok::<f64, LawError>(LawImpact::new(pair, law).impact(1.0)?.restitution)
    };
    made(restitution)?;
    // The entry corrects the error of YADE's fit; beyond en = 0.999 the fit is not monotone.
    let (low, high) = ((restitution - 0.02).max(1e-3), (restitution + 0.02).min(0.999));
    if low >= high || made(low)? >= restitution || made(high)? <= restitution {
        return Ok(restitution);
    }
    Ok(falling_zero(low, high, |en| made(en).map_or(0.0, |made| restitution - made)))
}

/// Returns the tc, s, and en for which ViscEl's cut-off contact has the wanted e and T.
///
/// # Errors
/// The linear law cannot be made; the restitution is too small for tc and en to make it.
pub fn viscel_entry(export: &Export) -> Result<(f64, f64), LawError> {
    let law = export.linear_law(EndRule::ZeroForce)?;
    let mass = export.pair.effective_mass();
    let rate = 0.5 * law.damping() / mass;
    let frequency = law.stiffness() / mass - rate * rate;
    if frequency <= 0.0 {
        let (quantity, range) = ("restitution", "above 0.14 for YADE's ViscEl");
        return Err(LawError::OutOfRange { quantity, value: export.linear.restitution, range });
    }
    let time = PI / frequency.sqrt();
    Ok((time, (-rate * time).exp()))
}

/// Returns both laws for two spheres, and none for a wall, which YADE takes for a sphere of the same
/// radius. The linear law is left out if it cannot be entered.
///
/// # Errors
/// The pair has no collision.
pub fn yade_snippets(export: &Export) -> Result<Vec<Snippet>, LawError> {
    if export.spheres.len() != 2 {
        return Ok(Vec::new());
    }
    let materials = |kind: &str, more: &dyn Fn(&Sphere) -> String| {
        let material = |index: usize, sphere: &Sphere| {
            let (density, more) = (short(sphere.density), more(sphere));
            format!("material{index} = {kind}(density={density}, frictionAngle=0, {more})\n")
        };
        export.per_sphere(material) + export.unlike_note()
    };
    let e = export.hertz.restitution;
    let en = hertz_mindlin_entry(&export.pair, e)?;
    let elastic = |sphere: &Sphere| {
        let [_, _, young, poisson] = sphere.texts();
        format!("young={young}, poisson={poisson}")
    };
    let hertz = export.snippet(
        YADE_HERTZ_MINDLIN,
        &[("en", en)],
        &[&format!("Makes e = {e:.4} at all speeds; the contact ends at zero force.")],
        &format!(
            "{}ip2 = Ip2_FrictMat_FrictMat_MindlinPhys(en={1}, es={1})\n\
             law2 = Law2_ScGeom_MindlinPhys_Mindlin()\n",
            materials("FrictMat", &elastic),
            short(en)
        ),
    );
    let linear = viscel_entry(export).ok().map(|(tc, en)| {
        let Dashpot { restitution, contact_time, .. } = export.linear;
        let more = format!("tc={}, en={1}, et={1}", short(tc), short(en));
        export.snippet(
            YADE_VISCEL,
            &[("tc", tc), ("en", en)],
            &[
                &format!(
                    "Linear; makes e = {restitution:.4} in {}: YADE cuts the force at zero, so en and tc",
                    time(contact_time)
                ),
                "differ from both.",
            ],
            &format!(
                "{}ip2 = Ip2_ViscElMat_ViscElMat_ViscElPhys()\nlaw2 = Law2_ScGeom_ViscElPhys_Basic()\n",
                materials("ViscElMat", &|_| more.clone())
            ),
        )
    });
    Ok(std::iter::once(hertz).chain(linear).collect())
}
