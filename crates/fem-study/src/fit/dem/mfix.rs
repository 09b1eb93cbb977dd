//! MFIX-DEM: `DES_COLL_MODEL = 'HERTZIAN'` and `'LSD'`.
//!
//! Both damp with
//!
//! ```math
//! \eta = \frac{2\sqrt{k\,m^*}\,|\ln e_n|}{\sqrt{\pi^2+\ln^2e_n}}
//! ```
//!
//! (`check_solids_dem.f`), the linear model with k = `KN`, for which it is exact; the Hertzian one with
//! k = K of F = K ξ^(3/2), times ξ^(1/4) (`calc_force_dem.f`). That is Tsuji's dashpot with α = 2 sin θ for
//! e_n = e^(−π tan θ), where √5 sin θ would make e_n: it damps too
//! little, 0.9 entered makes 0.910, so that what is entered is corrected. A contact ends at zero overlap.
//! Restitutions below 0.002 cannot be made. Read, not run.

use std::f64::consts::PI;

use fem_laws::{EndRule, LawError};

use super::snippet::{Export, MFIX_HERTZIAN, MFIX_LSD, Snippet, short, time};

/// Returns the restitution that `HERTZIAN` makes of an e_n in (0, 1].
pub fn mfix_outcome(entered: f64) -> f64 {
    of_sine(2.0 / 5f64.sqrt() * sine(entered))
}

/// Returns the e_n for which `HERTZIAN` makes this restitution; `None` if there is none.
pub fn mfix_entry(wanted: f64) -> Option<f64> {
    let sine = 5f64.sqrt() / 2.0 * sine(wanted);
    (sine < 1.0).then(|| of_sine(sine)).filter(|entry| *entry > 0.0)
}

/// |ln e|/√(π² + ln² e).
fn sine(e: f64) -> f64 {
    let loss = e.recip().ln();
    loss / PI.hypot(loss)
}

fn of_sine(sine: f64) -> f64 {
    (-PI * sine / ((1.0 - sine) * (1.0 + sine)).sqrt()).exp()
}

/// Returns the keywords of `mfix.dat`; those of the Hertzian model if the restitution can be entered.
///
/// # Errors
/// The linear law cannot be made.
pub fn mfix_snippets(export: &Export) -> Result<Vec<Snippet>, LawError> {
    let (e, linear) = (export.hertz.restitution, &export.linear);
    let stiffness = export.linear_law(EndRule::ZeroOverlap)?.stiffness();
    let hertz = mfix_entry(e).map(|entry| {
        let moduli = export.per_sphere(|phase, sphere| {
            let [_, _, young, poisson] = sphere.texts();
            format!("  e_young({phase}) = {young}\n  v_poisson({phase}) = {poisson}\n")
        });
        let wall = match &export.spheres[..] {
            [sphere] => format!(
                "  # A {}, of Poisson's ratio 0.\n  ew_young = {}\n  vw_poisson = 0.0\n",
                export.wall(),
                short(export.wall_modulus(sphere))
            ),
            _ => String::new(),
        };
        export.snippet(
            MFIX_HERTZIAN,
            &[("des_en_input", entry)],
            &[
                &format!(
                    "Entered {entry:.4}, made {e:.4}, wanted the latter: HERTZIAN damps too little."
                ),
                "One restitution for all speeds; the contact ends at zero overlap.",
            ],
            &format!(
                "  des_coll_model = 'HERTZIAN'\n{moduli}{wall}{}",
                restitutions(export, entry, true)
            ),
        )
    });
    let key = if export.spheres.len() < 2 { "kn_w" } else { "kn" };
    let hooke = export.snippet(
        MFIX_LSD,
        &[("kn", stiffness), ("des_en_input", linear.restitution)],
        &[
            &format!("Linear, contact time {} at all speeds.", time(linear.contact_time)),
            "One kn is for all pairs of a run: of other masses it makes another contact time.",
        ],
        &format!(
            "  des_coll_model = 'LSD'\n  {key} = {}\n{}",
            short(stiffness),
            restitutions(export, linear.restitution, false)
        ),
    );
    Ok(hertz.into_iter().chain([hooke]).collect())
}

/// Returns solids and their restitutions: of the pairs 11, 12, 22, or with the wall. Hertzian contacts also have a
/// tangential one.
fn restitutions(export: &Export, entry: f64, has_tangential: bool) -> String {
    let mut text = export.per_sphere(|phase, sphere| {
        let [diameter, density, ..] = sphere.texts();
        format!("  d_p0({phase}) = {diameter}\n  ro_s0({phase}) = {density}\n")
    });
    let pairs: &[(&str, usize)] = match export.spheres.len() {
        1 => &[("wall_input", 1)],
        _ => &[("input", 1), ("input", 2), ("input", 3)],
    };
    for (name, place) in pairs {
        text += &format!("  des_en_{name}({place}) = {}\n", short(entry));
        if has_tangential {
            text += &format!("  des_et_{name}({place}) = 1.0\n");
        }
    }
    if export.spheres.len() == 2 {
        text += "  # 1 is phase 1 with 1, 2 is 1 with 2, 3 is 2 with 2.\n";
        text += export.unlike_note();
    }
    text
}
