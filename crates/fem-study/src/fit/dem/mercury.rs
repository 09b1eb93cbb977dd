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

use super::snippet::{Export, Snippet, short, time};

/// Returns both species of the pair.
pub fn mercury_snippets(export: &Export) -> Vec<Snippet> {
    let (e, linear) = (export.hertz.restitution, &export.linear);
    let hertz_call = format!(
        "setEffectiveElasticModulusAndRestitutionCoefficient({}, {})",
        short(export.pair.contact_modulus()),
        short(e)
    );
    let hertz = heading(
        export,
        "MercuryDPM, HertzianViscoelastic",
        export.hertz.validity,
        "One restitution for all speeds; the contact ends at zero overlap.".to_string(),
    );
    let linear_call = format!(
        "setCollisionTimeAndRestitutionCoefficient({}, {}, {})",
        short(linear.contact_time),
        short(linear.restitution),
        short(2.0 * export.pair.effective_mass())
    );
    let hooke = heading(
        export,
        "MercuryDPM, LinearViscoelastic",
        linear.validity,
        format!(
            "Linear, {} at all speeds; the mass is twice that of the pair, m1 m2/(m1 + m2).",
            time(linear.contact_time)
        ),
    );
    let snippet = |name, model, entries, validity, text| Snippet {
        name,
        code: "MercuryDPM",
        model,
        entries,
        restitution: Some(e),
        validity,
        text,
    };
    let modulus = export.pair.contact_modulus();
    vec![
        snippet(
            "mercury_hertzian.cpp",
            "HertzianViscoelastic",
            vec![("effectiveElasticModulus", modulus), ("restitutionCoefficient", e)],
            export.hertz.validity,
            hertz + &body(export, "HertzianViscoelasticMindlinSpecies", &hertz_call),
        ),
        snippet(
            "mercury_linear.cpp",
            "LinearViscoelastic",
            vec![
                ("collisionTime", linear.contact_time),
                ("restitutionCoefficient", linear.restitution),
            ],
            linear.validity,
            hooke + &body(export, "LinearViscoelasticSpecies", &linear_call),
        ),
    ]
}

fn heading(export: &Export, model: &str, validity: [f64; 3], note: String) -> String {
    let place = "Goes into setupInitialConditions() of your Mercury3D.".to_string();
    comment(&export.heading(model, validity, &[note, place]))
}

/// A comment of C++.
fn comment(text: &str) -> String {
    let line = |line: &str| format!("//{}\n", line.trim_start_matches('#'));
    text.lines().map(line).collect()
}

/// Two species and what goes for one with the other; of equal spheres one, of a wall the second.
fn body(export: &Export, species: &str, call: &str) -> String {
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
        text += &comment(export.unlike_note());
    }
    text
}
