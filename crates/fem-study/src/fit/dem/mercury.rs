//! MercuryDPM: `HertzianViscoelastic…Species` and `LinearViscoelastic…Species`.
//!
//! `setEffectiveElasticModulusAndRestitutionCoefficient` takes E* of the contact and
//!
//! ```math
//! F = k\,\xi - \gamma\sqrt{m^*k}\,\dot\xi, \qquad k = \tfrac43E^*\sqrt{R^*\xi}, \qquad
//! \gamma = \sqrt{\frac{5\ln^2e}{\pi^2+\ln^2e}}
//! ```
//!
//! (`HertzianViscoelasticNormalSpecies.cc`, `HertzianViscoelasticInteraction.cc`): Tsuji's dashpot with
//! Antypov & Elliott's exact coefficient. `setCollisionTimeAndRestitutionCoefficient` takes T, e and the
//! mass of two equal particles, 2m*, of the linear law. Both end at zero overlap: what is entered is made.
//! Mercury would take harmonic means of two species, so the pair's own values are set. Read, not run.

use super::snippet::{Export, MERCURY_HERTZIAN, MERCURY_LINEAR, Snippet, short, slashed, time};

/// Returns both species of the pair.
pub fn mercury_snippets(export: &Export) -> Vec<Snippet> {
    const PLACE: &str = "Goes into setupInitialConditions() of your Mercury3D.";
    let (e, linear) = (export.hertz.restitution, &export.linear);
    let modulus = export.pair.contact_modulus();
    let hertz = format!(
        "setEffectiveElasticModulusAndRestitutionCoefficient({}, {})",
        short(modulus),
        short(e)
    );
    let hooke = format!(
        "setCollisionTimeAndRestitutionCoefficient({}, {}, {})",
        short(linear.contact_time),
        short(linear.restitution),
        short(2.0 * export.pair.effective_mass())
    );
    vec![
        export.snippet(
            MERCURY_HERTZIAN,
            &[("effectiveElasticModulus", modulus), ("restitutionCoefficient", e)],
            &["One restitution for all speeds; the contact ends at zero overlap.", PLACE],
            &commands(export, "HertzianViscoelasticMindlinSpecies", &hertz),
        ),
        export.snippet(
            MERCURY_LINEAR,
            &[
                ("collisionTime", linear.contact_time),
                ("restitutionCoefficient", linear.restitution),
            ],
            &[
                &format!(
                    "Linear, {} at all speeds; the mass is twice that of the pair, m1 m2/(m1 + m2).",
                    time(linear.contact_time)
                ),
                PLACE,
            ],
            &commands(export, "LinearViscoelasticSpecies", &hooke),
        ),
    ]
}

/// Returns two species and their mixed species: one for equal spheres, and for a wall the second.
fn commands(export: &Export, species: &str, call: &str) -> String {
    let mut text = format!("// #include <Species/{species}.h>\n");
    let first = &export.spheres[0];
    let is_one = export.spheres.len() == 2 && Some(first) == export.spheres.last();
    let second = export.spheres.get(1).unwrap_or(first);
    let names = if is_one { &["sphere"][..] } else { &["first", "second"][..] };
    for (name, sphere) in names.iter().zip([first, second]) {
        text += &format!(
            "auto {name} = speciesHandler.copyAndAddObject({species}());\n\
             {name}->setDensity({});\n{name}->{call};\n",
            short(sphere.density)
        );
    }
    if !is_one {
        if export.spheres.len() < 2 {
            text += "// second: of the wall.\n";
        }
        text += &format!("speciesHandler.getMixedObject(first, second)->{call};\n");
        text += &slashed(export.unlike_note());
    }
    text
}
