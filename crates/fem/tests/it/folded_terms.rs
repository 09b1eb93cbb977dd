//! Folded relaxation terms: terms much faster or slower than the contact are not integrated.

use fem::{Collision, Simulation};

use crate::scene::{decision_on, simulation_of as simulation};

/// Ten terms over as many decades, like the fit of a polymer's master curve.
const POLYMER: &str = r#"
[material.polymer]
density = "1200 kg/m^3"
youngs_modulus = "3 GPa"
poissons_ratio = 0.35

[material.polymer.relaxation]
acts_on = "shear"
terms = [
    { weight = 0.05, relaxation_time = "1e-11 s" },
    { weight = 0.05, relaxation_time = "1e-10 s" },
    { weight = 0.05, relaxation_time = "1e-9 s" },
    { weight = 0.1, relaxation_time = "1e-7 s" },
    { weight = 0.1, relaxation_time = "1e-5 s" },
    { weight = 0.1, relaxation_time = "1e-3 s" },
    { weight = 0.1, relaxation_time = "1e-1 s" },
    { weight = 0.1, relaxation_time = "10 s" },
    { weight = 0.05, relaxation_time = "1e3 s" },
    { weight = 0.05, relaxation_time = "1e5 s" },
]

[[body]]
name = "floor"
wall = {}

[[body]]
name = "ball"
sphere = { diameter = "10 mm" }
material = "polymer"
approach_speed = "0.5 m/s"

[output]
snapshots = []
"#;

fn changes(a: &Collision, b: &Collision) -> [f64; 3] {
    let relative = |a: Option<f64>, b: Option<f64>| a.unwrap() / b.unwrap() - 1.0;
    [
        a.restitution.unwrap() - b.restitution.unwrap(),
        relative(a.contact_time, b.contact_time),
        relative(a.peak_force, b.peak_force),
    ]
}

#[test]
fn folded_terms_change_less_than_their_stated_error() {
    // The mesh is the same, since other moduli would move the contact's edge between nodes.
    let mesh = "mesh.contact_element_size='10 um'";
    for model in ["model.ting={}", "model.condensed={}"] {
        let folded = simulation(POLYMER, &[model, mesh]);
        let decision = decision_on(&folded, "viscoelasticity");
        assert!(decision.active && decision.reason.contains("of 10 terms are integrated"));
        let all = simulation(POLYMER, &[model, mesh, "effects.viscoelasticity='on'"]);
        assert!(!decision_on(&all, "viscoelasticity").reason.contains("integrated"));
        for change in changes(&folded.run(&mut ()), &all.run(&mut ())) {
            assert!(change.abs() < 1.5e-4, "{model}: {change:e}");
        }
    }
}

/// Explicit elements store one field per integrated term and none for folded ones.
#[test]
fn folded_terms_are_not_stored() {
    let set = ["mesh.contact_element_size='0.1 mm'"];
    let folded = simulation(POLYMER, &set);
    let all = simulation(POLYMER, &[set[0], "effects.viscoelasticity='on'"]);
    let bytes = |simulation: &Simulation| match simulation.setup().cost {
        fem::Cost::Steps { memory, .. } => memory,
        _ => panic!("explicit elements"),
    };
    assert!(bytes(&folded) < bytes(&all), "{} {}", bytes(&folded), bytes(&all));
    for change in changes(&folded.run(&mut ()), &all.run(&mut ())) {
        // Contact springs follow the stiffness of the bodies, which lack the fast terms.
        assert!(change.abs() < 5e-3, "{change:e}");
    }
}

/// Small losses are accurate to two per cent.
#[test]
fn small_losses_are_accurate() {
    for (time, weight) in [("1 s", 0.5), ("30 ms", 0.2), ("1 ns", 0.2)] {
        let terms = format!(
            "material.polymer.relaxation.terms=[{{weight={weight},relaxation_time='{time}'}}]"
        );
        let set = ["model.ting={}", terms.as_str()];
        let found = 1.0 - simulation(POLYMER, &set).run(&mut ()).restitution.unwrap();
        let on = [set[0], set[1], "effects.viscoelasticity='on'"];
        let exact = 1.0 - simulation(POLYMER, &on).run(&mut ()).restitution.unwrap();
        assert!((found - exact).abs() < (0.02 * exact).max(2e-7), "{time}: {found:e} {exact:e}");
    }
}
