//! Uncertain inputs, `"70 ± 2 GPa"`, and the uncertainty that follows from them.

use fem_collision::QuantityOfInterest;

use crate::scene::{GLASS, case_of, parse, summary_of};

const NYLON_ON_BLOCK: &str = "
    material.nylon = { density = 1150, youngs_modulus = '2.93 GPa', poissons_ratio = 0.4 }
    body = [{ name = 'ball', sphere.diameter = '10 mm', material = 'nylon', approach_speed = '1 m/s' },
            { name = 'block', half_space = {}, material = 'nylon' }]";

/// Elastic spheres of a material with Young's modulus E, each with its own material table.
fn pair(set: &[&str]) -> [Option<f64>; 6] {
    let text = "
        material.a = { density = 2500, youngs_modulus = '70 GPa', poissons_ratio = 0.2 }
        material.b = { density = 2500, youngs_modulus = '70 GPa', poissons_ratio = 0.2 }
        [[body]]
        name = 'lower'
        sphere.diameter = '20 mm'
        material = 'a'
        [[body]]
        name = 'upper'
        sphere.diameter = '20 mm'
        material = 'b'
        approach_speed = '0.5 m/s'";
    let summary = summary_of(text, &[&["model.hertz={}"], set].concat());
    QuantityOfInterest::ALL.map(|quantity| {
        let value = summary.collision.number(quantity).unwrap();
        Some(summary.uncertainty.of(quantity).input? / value)
    })
}

/// Hertz' powers of E*, m*, R* and v: T, F, δ, a, p₀ go with (−2/5, 2/5, −2/5, −1/5, 4/5) of E*, with (2/5, 3/5, 2/5, 1/5,
/// 1/5) of m*, with (−1/5, 1/5, −1/5, 2/5, −3/5) of R* and with (−1/5, 6/5, 4/5, 2/5, 2/5) of v.
#[test]
fn the_uncertainty_follows_hertz_powers() {
    assert_eq!(pair(&[]), [None; 6]);
    let modulus = [0.0, 0.4, 0.4, 0.4, 0.2, 0.8];
    let speed = [0.0, 0.2, 1.2, 0.8, 0.4, 0.4];
    let density = [0.0, 0.4, 0.6, 0.4, 0.2, 0.2];
    let of = |share: f64, powers: [f64; 6]| powers.map(|power| share * power);
    let squares = |one: [f64; 6], other: [f64; 6]| std::array::from_fn(|k| one[k].hypot(other[k]));
    let both = "body.1.material='a'";
    let stiff = "material.a.youngs_modulus='70 ± 2 GPa'";
    for (set, expected) in [
        // A material of both bodies is one input; that of one has half of the compliance.
        (&[both, stiff][..], of(2.0 / 70.0, modulus)),
        (&[stiff], of(1.0 / 70.0, modulus)),
        (
            &["material.a.youngs_modulus={ value = 70e9, uncertainty = '2 GPa' }"],
            of(1.0 / 70.0, modulus),
        ),
        (&["body.1.approach_speed='0.5 m/s ± 2 %'"], of(0.02, speed)),
        (&[both, "material.a.density='2500 +- 25 kg/m^3'"], of(0.01, density)),
        (
            &[both, stiff, "body.1.approach_speed='0.5 ± 0.01 m/s'"],
            squares(of(2.0 / 70.0, modulus), of(0.02, speed)),
        ),
    ] {
        for (found, expected) in pair(set).into_iter().zip(expected) {
            assert!(
                (found.unwrap() - expected).abs() <= 2e-3 * expected,
                "{set:?}: {found:?} {expected}"
            );
        }
    }
}

/// The loss of a relaxing pair is uncertain by its weight: about in proportion.
#[test]
fn relaxation_has_an_uncertainty() {
    let rate = "material.glass.relaxation.terms.0.decay_rate='2708 1/s ± 10 %'";
    let summary = summary_of(GLASS, &["model.ting={}", rate, "output.snapshots=[]"]);
    let input = summary.uncertainty.of(QuantityOfInterest::Restitution).input.unwrap();
    let loss = 1.0 - summary.collision.restitution.unwrap();
    assert!((0.09..0.105).contains(&(input / loss)), "{input} {loss}");
    let sum = summary.uncertainty.of(QuantityOfInterest::Restitution);
    assert!(sum.sum().unwrap() >= input);
}

/// Waves that do not return depend on the modulus too: the uncertainty of the restitution is half the difference between the
/// collisions at both ends, elastic and relaxing.
#[test]
fn waves_have_an_uncertainty() {
    let relaxing = "material.nylon.relaxation={ acts_on='shear', terms=[{ weight=0.2, relaxation_time='0.1 ms' }] }";
    for set in [&[][..], &[relaxing]] {
        let of = |modulus: &str| {
            let modulus = format!("material.nylon.youngs_modulus='{modulus}'");
            let set = [&["model.ting={}", modulus.as_str()], set].concat();
            summary_of(NYLON_ON_BLOCK, &set)
        };
        let restitution = |modulus: &str| of(modulus).collision.restitution.unwrap();
        let both = of("2.93 ± 0.29 GPa").uncertainty.of(QuantityOfInterest::Restitution);
        let expected = 0.5 * (restitution("3.22 GPa") - restitution("2.64 GPa")).abs();
        let found = both.input.unwrap();
        // The closed form of the waves is right to 15 %.
        assert!((found / expected - 1.0).abs() < 0.15, "{found:e} {expected:e}");
        assert!(expected > 1e-4, "{expected:e}");
    }
}

/// An uncertainty changes neither the scene's numbers nor the collision; the resolved case keeps it.
#[test]
fn an_uncertainty_leaves_the_collision_alone() {
    let set =
        ["material.glass.density='2390 ± 10 kg/m^3'", "body.0.sphere.diameter='22.2 ± 0.1 mm'"];
    let case = case_of(GLASS, &set);
    assert_eq!(case.scene().bodies(), case_of::<&str>(GLASS, &[]).scene().bodies());
    let text = case.file().to_toml().unwrap();
    let again = case_of::<&str>(&text, &[]);
    assert_eq!(again.scene().uncertain_inputs(), case.scene().uncertain_inputs());
    assert_eq!(again.scene().uncertain_inputs().len(), 2);
    let keys = ["body", "0", "sphere", "diameter"];
    assert_eq!(case.file().number_at(keys), Some((0.0222, "m")));
    assert_eq!(
        again.with_number("body.0.sphere.diameter", 0.02).unwrap().scene().uncertain_inputs().len(),
        1
    );
}

#[test]
fn a_setting_has_no_uncertainty() {
    for (set, expected) in [
        ("mesh.growth='1.1 ± 0.1'", "mesh.growth has no uncertainty"),
        ("accuracy.tolerance='1 % ± 0.1 %'", "has no uncertainty"),
        ("body.0.sphere.diameter='22.2 ± 1 kg'", "is a mass"),
        ("body.0.sphere.diameter='22.2 mm ± 1 kg'", "another unit"),
        ("body.0.sphere.diameter={ value = '22.2 mm' }", "uncertainty"),
    ] {
        let message = parse(GLASS, &[set]).unwrap_err().to_string();
        assert!(message.contains(expected), "{set}: {message}");
    }
}
