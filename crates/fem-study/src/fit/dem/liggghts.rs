//! LIGGGHTS: `gran model hertz` and `gran model hooke`.
//!
//! `hertz` is Tsuji's dashpot with the exact coefficient of the entered restitution. `hooke` has
//!
//! ```math
//! k_n = \tfrac{16}{15}\sqrt{R^*}E^*\left(\frac{15m^*V^2}{16\sqrt{R^*}E^*}\right)^{1/5}, \qquad
//! \gamma_n = \sqrt{\frac{4m^*k_n}{1+(\pi/\ln e)^2}}
//! ```
//!
//! (`normal_model_hooke.h`): the spring that stores ½m*V² at Hertz' approach for the characteristic
//! velocity V, so that at V its contact is longer than Hertz' by π/2.943. Here V is chosen for the
//! contact time instead. Both end at zero overlap, unless `limitForce on`.

use fem_laws::{EndRule, LawError, Pair};

use super::snippet::{Export, LIGGGHTS_HERTZ, LIGGGHTS_HOOKE, Snippet, short, time};

/// Returns k_n, N/m, of `hooke` for a characteristic velocity, m/s.
pub fn hooke_stiffness(pair: &Pair, velocity: f64) -> f64 {
    let unit = 16.0 / 15.0 * pair.effective_radius().sqrt() * pair.contact_modulus();
    unit * (pair.effective_mass() * velocity * velocity / unit).powf(0.2)
}

/// Returns V, m/s, at which [`hooke_stiffness`] is this, N/m.
pub fn characteristic_velocity(pair: &Pair, stiffness: f64) -> f64 {
    let unit = 16.0 / 15.0 * pair.effective_radius().sqrt() * pair.contact_modulus();
    ((stiffness / unit).powi(5) * unit / pair.effective_mass()).sqrt()
}

/// Returns both models for two spheres, and none for a wall.
///
/// # Errors
/// The linear law cannot be made.
pub fn liggghts_snippets(export: &Export) -> Result<Vec<Snippet>, LawError> {
    const END: &str = "The contact ends at zero overlap; limitForce on would raise e.";
    let [first, second] = &export.spheres[..] else { return Ok(Vec::new()) };
    let stiffness = export.linear_law(EndRule::ZeroOverlap)?.stiffness();
    let velocity = characteristic_velocity(&export.pair, stiffness);
    let ([_, _, young1, poisson1], [_, _, young2, poisson2]) = (first.texts(), second.texts());
    let commands = |model: &str, e: f64, more: &str| {
        let (e, note) = (short(e), export.unlike_note());
        format!(
            "fix m1 all property/global youngsModulus peratomtype {young1} {young2}\n\
             fix m2 all property/global poissonsRatio peratomtype {poisson1} {poisson2}\n\
             fix m3 all property/global coefficientRestitution peratomtypepair 2 {e} {e} {e} {e}\n\
             fix m4 all property/global coefficientFriction peratomtypepair 2 0 0 0 0\n\
             {note}{more}pair_style gran model {model} tangential history\npair_coeff * *\n"
        )
    };
    let (e, linear) = (export.hertz.restitution, &export.linear);
    let more =
        format!("fix m5 all property/global characteristicVelocity scalar {}\n", short(velocity));
    Ok(vec![
        export.snippet(
            LIGGGHTS_HERTZ,
            &[("coefficientRestitution", e)],
            &["One restitution for all speeds.", END],
            &commands("hertz", e, ""),
        ),
        export.snippet(
            LIGGGHTS_HOOKE,
            &[
                ("coefficientRestitution", linear.restitution),
                ("characteristicVelocity", velocity),
            ],
            &[
                &format!(
                    "Linear, contact time {} at all speeds: characteristicVelocity is chosen for it.",
                    time(linear.contact_time)
                ),
                END,
            ],
            &commands("hooke", linear.restitution, &more),
        ),
    ])
}
