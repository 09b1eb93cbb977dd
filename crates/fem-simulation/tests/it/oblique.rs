//! Oblique impacts of whole cases: momenta, energies, what is refused, and the run along the axis, which friction leaves alone.

use fem_collision::Account;
use fem_simulation::results::Summary;

use crate::scene::{refused_of, summary_of};

/// Relaxing spheres of two sizes that both move across the axis and spin.
const SPHERES: &str = r#"
body = [
    { name = "a", material = "m", sphere = { diameter = "8 mm" }, approach_speed = "0.4 m/s", tangential_speed = "-0.3 m/s", spin = "40 rad/s" },
    { name = "b", material = "m", sphere = { diameter = "5 mm" }, approach_speed = "0.6 m/s", impact_angle = "25 deg", spin = "-900 rpm" },
]
output = { snapshots = [] }
contact = { friction = "0.2 ± 0.05" }

[material.m]
density = 2500
youngs_modulus = "60 GPa"
poissons_ratio = 0.25
relaxation = { acts_on = "shear", terms = [{ weight = 0.3, relaxation_time = "20 us" }] }
"#;

const TING: &str = "model.ting={}";
const WALL: &str = "body.1={ name = 'w', wall = {} }";

/// Angular momentum of each body about the contact: I ω ± m R v, on the side of the contact.
fn about_the_contact(summary: &Summary) -> [f64; 2] {
    let [a, b] = &summary.bodies[..] else { unreachable!() };
    let of = |body: &fem_simulation::results::BodySummary, radius: f64, side: f64| {
        let mass = body.mass_kg.unwrap();
        let [velocity, spin] = [body.velocity_tangential_after_m_s, body.spin_after_rad_s];
        mass * radius * (0.4 * radius * spin.unwrap() + side * velocity.unwrap())
    };
    [of(a, 4e-3, 1.0), of(b, 2.5e-3, -1.0)]
}

/// By hand before the impact, from the case; the impulse acts at the contact and has no moment about it. Each model, with the energies
/// closed.
#[test]
fn momenta_are_kept_and_energies_close() {
    let sets: [&[&str]; 4] = [
        &[TING],
        &["model.ting={ finite_size = true }"],
        &["model.hertz={}"],
        &["model.law={ tsuji = { e = 0.8 } }"],
    ];
    let tangential = 0.6 * 25f64.to_radians().tan();
    let spin = -900.0 * std::f64::consts::PI / 30.0;
    for set in sets {
        let summary = summary_of(SPHERES, set);
        let mass = |k: usize| summary.bodies[k].mass_kg.unwrap();
        let expected = [
            mass(0) * 4e-3 * (0.4 * 4e-3 * 40.0 - 0.3),
            mass(1) * 2.5e-3 * (0.4 * 2.5e-3 * spin - tangential),
        ];
        for (found, expected) in about_the_contact(&summary).into_iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-12, "{set:?} {found} {expected}");
        }
        let linear = |v: [f64; 2]| mass(0) * v[0] + mass(1) * v[1];
        let after = [0, 1].map(|k| summary.bodies[k].velocity_tangential_after_m_s.unwrap());
        let before = linear([-0.3, tangential]);
        assert!((linear(after) / before - 1.0).abs() < 1e-12, "{set:?} {after:?}");
        assert!(summary.energy.residual_relative.unwrap() < 1e-6, "{set:?}");
        assert!(summary.energy.get(Account::Friction).unwrap() > 0.0, "{set:?}");
        let bars = summary.uncertainty.tangential.unwrap();
        assert!(bars.tangential_restitution.input.unwrap() > 0.0, "{set:?}");
    }
}

/// The impulse of friction is its coefficient times the normal one where the patch slides throughout, and the patch loses
/// 7/2 μ (1 + e) v_n of its velocity (Walton 1993).
#[test]
fn sliding_patches_lose_what_rigid_spheres_do() {
    let summary = summary_of(
        SPHERES,
        &[TING, WALL, "body.0.tangential_speed='3 m/s'", "body.0.spin=0", "contact.friction=0.1"],
    );
    let restitution = summary.collision.restitution.unwrap();
    let expected = 1.0 - 3.5 * 0.1 * (1.0 + restitution) * 0.4 / 3.0;
    assert!((summary.tangential.tangential_restitution.unwrap() - expected).abs() < 1e-9);
    assert!((summary.tangential.impulse_ratio.unwrap() - 0.1).abs() < 1e-9);
    let rebound = (3.0 * expected).atan2(0.4 * restitution).to_degrees();
    assert!((summary.tangential.contact_patch_rebound_deg.unwrap() - rebound).abs() < 1e-6);
    // Seen from the other side everything is the same: signs are along the patch.
    let mirrored = summary_of(
        SPHERES,
        &[TING, WALL, "body.0.tangential_speed='-3 m/s'", "body.0.spin=0", "contact.friction=0.1"],
    );
    assert_eq!(mirrored.tangential, summary.tangential);
}

/// Condensed bodies have pressures of their own instead of Hertz'; the difference is within their bars on any mesh.
#[test]
fn condensed_bodies_agree_with_ting() {
    let ting = summary_of(SPHERES, &["model.ting={ finite_size = true }"]);
    for tolerance in ["1 %", "0.2 %"] {
        let tolerance = format!("accuracy.tolerance='{tolerance}'");
        let condensed = summary_of(SPHERES, &["model.condensed={}", &tolerance]);
        let bars = condensed.uncertainty.tangential.unwrap().tangential_restitution;
        let bar = bars.discretisation.unwrap() + bars.model.unwrap();
        let found = [&ting, &condensed].map(|it| it.tangential.tangential_restitution.unwrap());
        assert!((found[0] - found[1]).abs() < bar && bar < 0.04, "{tolerance} {found:?} {bar}");
    }
}

/// ψ₂ of elastic like spheres at ν = 0.3 just below ψ₁ = 4χ − 1, where they slide until the last steps: by independent springs in equal
/// distances with explicit steps, 80,000 a contact. The bars hold, though the errors of two discretisations may be alike there; so do
/// those of condensed bodies, whose mesh is coarse beside the last contact.
#[test]
fn bars_hold_where_sliding_begins() {
    const LIKE: &str = r#"
        contact.friction = 0.1
        body = [{ name = "a", material = "m", sphere = { diameter = "5 mm" }, approach_speed = 0.05 },
                { name = "b", material = "m", sphere = { diameter = "5 mm" } }]
        material.m = { density = 2500, youngs_modulus = "60 GPa", poissons_ratio = 0.3, elastic = true }
        effects.partner_waves = "off""#;
    for (before, expected) in [
        (4.288235, -1.3362490),
        (4.526471, -1.1996478),
        (4.621765, -1.1284219),
        (4.669412, -1.0886867),
        (4.693235, -1.0677081),
        (4.717059, -1.0459537),
        (4.740882, -1.0233947),
    ] {
        let speed = format!("body.0.tangential_speed={}", before * 0.1 * 0.05 * 1.7 / 1.4);
        let at = |model: &str| {
            let summary = summary_of(LIKE, &[model, &speed]);
            let bar = summary.uncertainty.tangential.unwrap().tangential_restitution;
            let error = (summary.tangential.psi_after.unwrap() - expected).abs();
            let [discretisation, model] = [bar.discretisation, bar.model].map(Option::unwrap);
            (error, before * discretisation, before * model)
        };
        let (error, bar, size) = at("model.ting={}");
        assert!(error < bar && bar < 2e-3, "{before} {error} {bar}");
        let (error, bar, _) = at("model.condensed={}");
        assert!(error < bar + size && bar < 0.06, "{before} {error} {bar} {size}");
    }
}

/// Each uncertain input changes the rebound by half of the difference at its ends, as whole runs find it.
#[test]
fn bars_have_each_uncertain_input() {
    let sets = [TING, "contact.friction=0.2", "body.0.tangential_speed='1.5 m/s'"];
    for (key, value, change, unit) in [
        ("contact.friction", 0.2, 0.002, ""),
        ("body.0.tangential_speed", 1.5, 0.02, "m/s"),
        ("body.1.impact_angle", 0.5, 0.01, "rad"),
        ("body.0.spin", 40.0, 5.0, "rad/s"),
        ("body.0.approach_speed", 0.4, 0.004, "m/s"),
        ("body.0.sphere.diameter", 8.0, 0.1, "mm"),
        ("material.m.poissons_ratio", 0.25, 0.01, ""),
    ] {
        let at = |value: String| {
            summary_of(SPHERES, &[&sets[..], &[&format!("{key}='{value} {unit}'")]].concat())
        };
        let numbers = |summary: Summary| {
            let it = summary.tangential;
            [it.tangential_restitution, it.contact_patch_rebound_deg, it.impulse_ratio]
                .map(Option::unwrap)
        };
        let [below, above] = [value - change, value + change].map(|it| numbers(at(it.to_string())));
        let bars = at(format!("{value} ± {change}")).uncertainty.tangential.unwrap();
        let bars =
            [bars.tangential_restitution, bars.contact_patch_rebound_deg, bars.impulse_ratio];
        for k in 0..3 {
            let (found, expected) = (bars[k].input.unwrap(), 0.5 * (above[k] - below[k]).abs());
            // Impacts of relaxing bodies are similar but for their loss, whose change is added by its size.
            let rounding = 2e-4 * above[k].abs();
            let range = 0.92 * expected - rounding..1.25 * expected + rounding;
            assert!(range.contains(&found), "{key} {k}: {found} {expected}");
        }
    }
}

/// To the bit, whatever the friction; without it the patch goes on as it came.
#[test]
fn the_run_along_the_axis_is_that_of_a_head_on_impact() {
    let head_on =
        ["body.0.tangential_speed=0", "body.1.impact_angle=0", "body.0.spin=0", "body.1.spin=0"];
    let numbers = |changes: &[&str]| {
        let summary = summary_of(SPHERES, changes);
        (format!("{:?}", summary.collision), summary.tangential)
    };
    let (plain, none) = numbers(&[&[TING, "contact.friction=0"], &head_on[..]].concat());
    assert_eq!(none, Default::default());
    let (with_friction, _) = numbers(&[TING]);
    let (without, free) = numbers(&[TING, "contact.friction=0"]);
    assert_eq!(plain, with_friction);
    assert_eq!(plain, without);
    assert_eq!((free.tangential_restitution, free.impulse_ratio), (Some(1.0), Some(0.0)));
}

/// Unlike bodies that stick have a rebound of unknown error; those that slide do not.
#[test]
fn the_error_beside_coupling_is_unknown_where_the_patch_sticks() {
    let at = |speed: &str| {
        let speed = format!("body.0.tangential_speed={speed}");
        let summary = summary_of(SPHERES, &[TING, WALL, "body.0.spin=0", &speed]);
        summary.uncertainty.tangential.unwrap().tangential_restitution.model
    };
    assert_eq!(at("0.02"), None);
    assert!(at("3.0").is_some());
    // A patch that stands has no restitution.
    let standing = summary_of(SPHERES, &[TING, WALL, "body.0.tangential_speed=0.16"]);
    assert_eq!(standing.tangential.tangential_restitution, None);
    assert_eq!(standing.tangential.impulse_ratio, Some(0.0));
}

#[test]
fn what_has_no_friction_says_which_model_has() {
    let plate = "body.1={ name = 'p', plate = { thickness = '5 mm' }, material = 'm' }";
    for (set, key, help) in [
        (vec!["model.fem={}"], "model", "condensed or ting"),
        (vec![TING, plate], "plate", "half_space"),
        (vec!["model.law={ mean_pressure = { yield_strength = '300 MPa' } }"], "law", "ting"),
        (vec![TING, "body.0.sphere.mass='9 g'"], "mass", "remove"),
    ] {
        let fault = format!("{:?}", refused_of(SPHERES, &set));
        assert!(fault.contains(key) && fault.contains(help), "{set:?}: {fault}");
    }
}
