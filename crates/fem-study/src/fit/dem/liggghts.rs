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

use super::snippet::{Export, Snippet, short, time};

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
    let [first, second] = &export.spheres[..] else { return Ok(Vec::new()) };
    let stiffness = export.linear_law(EndRule::ZeroOverlap)?.stiffness();
    let velocity = characteristic_velocity(&export.pair, stiffness);
    let code = "LIGGGHTS";
    let globals = |e: f64| {
        format!(
            "fix m1 all property/global youngsModulus peratomtype {1} {2}\n\
             fix m2 all property/global poissonsRatio peratomtype {3} {4}\n\
             fix m3 all property/global coefficientRestitution peratomtypepair 2 {0} {0} {0} {0}\n\
             fix m4 all property/global coefficientFriction peratomtypepair 2 0 0 0 0\n",
            short(e),
            short(first.youngs_modulus),
            short(second.youngs_modulus),
            short(first.poissons_ratio),
            short(second.poissons_ratio)
        ) + export.unlike_note()
    };
    let style =
        |model: &str| format!("pair_style gran model {model} tangential history\npair_coeff * *\n");
    let ends = "The contact ends at zero overlap; limitForce on would raise e.".to_string();
    let (e, hertz) = (export.hertz.restitution, &export.hertz);
    let hertz_text = export.heading(
        "LIGGGHTS, gran model hertz",
        hertz.validity,
        &["One restitution for all speeds.".to_string(), ends.clone()],
    );
    let linear = &export.linear;
    let hooke_text = export.heading(
        "LIGGGHTS, gran model hooke",
        linear.validity,
        &[
            format!(
                "Linear, contact time {} at all speeds: characteristicVelocity is chosen for it.",
                time(linear.contact_time)
            ),
            ends,
        ],
    );
    Ok(vec![
        Snippet {
            name: "liggghts_hertz.in",
            code,
            model: "hertz",
            entries: vec![("coefficientRestitution", e)],
            restitution: Some(e),
            validity: hertz.validity,
            text: hertz_text + &globals(e) + &style("hertz"),
        },
        Snippet {
            name: "liggghts_hooke.in",
            code,
            model: "hooke",
            entries: vec![
                ("coefficientRestitution", linear.restitution),
                ("characteristicVelocity", velocity),
            ],
            restitution: Some(linear.restitution),
            validity: linear.validity,
            text: hooke_text
                + &globals(linear.restitution)
                + &format!(
                    "fix m5 all property/global characteristicVelocity scalar {}\n",
                    short(velocity)
                )
                + &style("hooke"),
        },
    ])
}
