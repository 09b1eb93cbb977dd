//! What the plan foretells of leaving an effect out, held against collisions with it and without it.

use fem_simulation::effects::NeglectError;

use crate::scene::{
    GLASS, collision_of as run, decision_on, resolved, simulation_of as simulation,
};

fn foretold(text: &str, set: &[&str], effect: &str) -> NeglectError {
    let simulation = simulation(text, set);
    let decision = decision_on(&simulation, effect);
    assert!(decision.active, "{}", decision.reason);
    simulation.neglect_error(decision, &simulation.setup().estimate).unwrap()
}

/// Within a factor of three, where it is more than another error of the same number, and where closed
/// forms tell.
fn agree(foretold: Option<f64>, with: Option<f64>, without: Option<f64>, small: f64, what: &str) {
    let found = (with.unwrap() - without.unwrap()).abs();
    let Some(foretold) = foretold else { return };
    let near = |a: f64, b: f64| a <= 3.0 * b + small;
    assert!(
        near(foretold, found) && near(found, foretold),
        "{what}: {foretold:e}, found {found:e}"
    );
}

/// An effect switched off by force, the rest the same.
fn is_as_foretold(text: &str, set: &[&str], effect: &str) {
    // A tolerance decides whether large strains are computed, and they on the mesh.
    let size =
        simulation(text, set).setup().elements.as_ref().map(|e| 0.75 * e.plan.contact_element_size);
    let size = size.map(|size| format!("mesh.contact_element_size={size:e}")).unwrap_or_default();
    let fine = match effect {
        "finite strain" => vec![size.as_str(), "time.mass_scaling=2e-4"],
        _ => vec!["accuracy.tolerance='0.3 %'", "time.mass_scaling=2e-4"],
    };
    let set = &[set, &fine].concat()[..];
    let foretold = foretold(text, set, effect);
    let off = format!("effects.{}=\"off\"", effect.replace(' ', "_"));
    let without: Vec<&str> = set.iter().copied().chain([off.as_str()]).collect();
    let (with, without) = (run(text, set), run(text, &without));
    let told = [foretold.restitution, foretold.contact_time_s, foretold.peak_force_n];
    assert!(told.iter().flatten().all(|change| change.is_finite() && *change >= 0.0));
    assert!(foretold.restitution.is_some() && foretold.peak_force_n.is_some());
    let what = |number: &str| format!("{number} of {effect} of {set:?}");
    // What is left in vibrations depends on bodies that the foretold ones were not, and on how much of them
    // bulk viscosity takes, which falls with the elements: foretold from meshes twice as coarse.
    let vibration = if effect == "finite strain" { 2e-3 } else { 1e-4 };
    agree(foretold.restitution, with.restitution, without.restitution, vibration, &what("e"));
    // Steps of a history, and the instant at which a relaxed force ends.
    let time = 1e-3 * with.contact_time.unwrap();
    agree(foretold.contact_time_s, with.contact_time, without.contact_time, time, &what("T"));
    // Springs of soft bodies scatter, which small strain has as it is.
    let force = if effect == "finite strain" { 0.03 } else { 3e-3 } * with.peak_force.unwrap();
    agree(foretold.peak_force_n, with.peak_force, without.peak_force, force, &what("F"));
}

/// A ball of one material on a large sphere of another.
const BALL: &str = r#"
    material.hard = { density = "2500 kg/m^3", youngs_modulus = "2 GPa", poissons_ratio = 0.3 }
    material.soft = { density = "1200 kg/m^3", youngs_modulus = "1 GPa", poissons_ratio = 0.3,
        relaxation = { acts_on = "all", terms = [{ weight = 0.3, relaxation_time = "0.1 ms" }] } }
    body = [{ name = "block", sphere.diameter = "2 m", material = "hard" },
            { name = "ball", sphere.diameter = "10 mm", material = "soft", approach_speed = "0.5 m/s" }]
    output.snapshots = []"#;

const TING: &str = "model.ting={}";
const CONDENSED: &str = "model.condensed={}";
const FEM: &str = "model.fem={}";
const ELASTIC: &str = "material.soft.relaxation.terms.0.weight=0";
const STRONG: &str = "material.soft.relaxation.terms.0.weight=0.9";
const SHEAR: &str = "material.soft.relaxation.acts_on='shear'";
const FAST_TERM: &str = "material.soft.relaxation.terms.0.relaxation_time='0.1 us'";
const RUBBER: &str = "material.soft.youngs_modulus='1 MPa'";
const AUXETIC: &str = "material.soft.poissons_ratio=-0.4";
const BLOCK: &str = "body.0={ name = 'block', half_space = {}, material = 'hard' }";
const WALL: &str = "body.0={ name = 'block', wall = {} }";
const HARD_AS_SOFT: &str = "body.0.material='soft'";
const PEER: &str = "body.0.sphere.diameter='15 mm'";
const NEAR_LIMIT: &str = "body.0.sphere.diameter='0.25 m'";
const SLOW: &str = "body.1.approach_speed='1 mm/s'";
const FAST: &str = "body.1.approach_speed='20 m/s'";
const DUST: &str = "body.1.sphere.diameter='5 um'";
const RIGID: &str = "effects.rigid_partner='on'";
const INCOMPRESSIBLE: &str = "material.soft.poissons_ratio=0.45";
const FLAT: &str = "body.1.approach_speed='4.5 m/s'";
const HENCKY: &str = "material.soft.hyperelastic='hencky'";
const SVK: &str = "material.soft.hyperelastic='saint-venant-kirchhoff'";
const SMALL: &str = "effects.finite_strain='off'";
const VISCOUS: &str = "effects.bulk_viscosity='on'";
const PENALTY: &str = "contact.method='penalty'";

/// Every effect that a switch leaves out, in the models that obey it, alone and beside the others: waves of
/// what relaxes, relaxation of what radiates, a rigid partner that would do both.
#[test]
fn every_switch_changes_results_as_estimated() {
    switches_change_what_is_foretold(false);
}

/// The rest of the scenes, with explicit elements.
#[test]
#[ignore = "13 s; .ci/run runs it"]
fn every_switch_of_explicit_elements_changes_results_as_estimated() {
    switches_change_what_is_foretold(true);
}

/// Whether a scene has explicit elements that take seconds.
fn is_slow(set: &[&str]) -> bool {
    set[0] == FEM && !set.contains(&SMALL)
}

fn switches_change_what_is_foretold(slow: bool) {
    let rows: &[(&str, &[&str])] = &[
        ("viscoelasticity", &[TING]),
        ("viscoelasticity", &[TING, BLOCK, STRONG]),
        ("viscoelasticity", &[TING, BLOCK, FAST_TERM]),
        ("viscoelasticity", &[TING, WALL, SHEAR, STRONG, SLOW]),
        ("viscoelasticity", &[TING, PEER, RUBBER]),
        ("viscoelasticity", &[CONDENSED, HARD_AS_SOFT]),
        ("viscoelasticity", &[CONDENSED, PEER, AUXETIC]),
        ("viscoelasticity", &[FEM, PEER, SHEAR]),
        ("partner waves", &[TING]),
        ("partner waves", &[TING, ELASTIC]),
        ("partner waves", &[TING, BLOCK, STRONG]),
        ("partner waves", &[TING, NEAR_LIMIT, HARD_AS_SOFT]),
        ("partner waves", &[TING, BLOCK, ELASTIC, DUST]),
        ("partner waves", &[CONDENSED, ELASTIC]),
        ("partner waves", &[CONDENSED, BLOCK]),
        ("rigid partner", &[TING, RIGID]),
        ("rigid partner", &[TING, RIGID, BLOCK, ELASTIC]),
        ("rigid partner", &[TING, RIGID, PEER, RUBBER]),
        ("rigid partner", &[CONDENSED, RIGID, PEER]),
        ("rigid partner", &[CONDENSED, RIGID, BLOCK]),
        ("finite strain", &[FEM, RUBBER, ELASTIC, HENCKY, WALL, "body.1.approach_speed='2 m/s'"]),
        ("finite strain", &[FEM, RUBBER, FAST_TERM, SVK, PEER]),
        ("finite strain", &[FEM, RUBBER, ELASTIC, SVK, PEER, HARD_AS_SOFT]),
        ("finite strain", &[FEM, RUBBER, SHEAR, SVK, BLOCK]),
        ("finite strain", &[FEM, RUBBER, ELASTIC, BLOCK, HARD_AS_SOFT, INCOMPRESSIBLE, FLAT]),
        ("finite strain", &[FEM, RUBBER, ELASTIC, BLOCK, HARD_AS_SOFT, HENCKY, FLAT]),
        ("surface slip", &[TING, RIGID, PEER, ELASTIC, FAST]),
        ("surface slip", &[TING, PEER, AUXETIC, STRONG]),
        ("surface slip", &[TING, BLOCK, STRONG, FAST]),
        ("surface slip", &[TING, RIGID, PEER, RUBBER, SHEAR]),
        ("surface slip", &[CONDENSED, BLOCK, AUXETIC]),
        ("surface slip", &[CONDENSED, RIGID, PEER, FAST]),
        ("surface slip", &[CONDENSED, RIGID, PEER, SHEAR, STRONG, FAST]),
        ("surface slip", &[FEM, RIGID, PEER, ELASTIC, AUXETIC, SMALL]),
        ("surface slip", &[FEM, RIGID, PEER, SHEAR, FAST, SMALL]),
        ("bulk viscosity", &[FEM, VISCOUS, WALL, FAST, SMALL]),
        ("bulk viscosity", &[FEM, VISCOUS, PEER, FAST, AUXETIC, SMALL]),
        ("bulk viscosity", &[FEM, VISCOUS, PENALTY, WALL, FAST, SMALL]),
        ("bulk viscosity", &[FEM, VISCOUS, PENALTY, PEER, FAST, AUXETIC, SMALL]),
    ];
    for (effect, set) in rows.iter().filter(|(_, set)| is_slow(set) == slow) {
        is_as_foretold(BALL, set, effect);
    }
}

/// From relaxation that hardly begins within the contact to one that is over in a twentieth of it, of
/// glass and of rubber, of both moduli and of the shear modulus, in every model that has it.
#[test]
fn neglect_error_of_relaxation_equals_that_of_runs() {
    let rate = |rate: &str| format!("material.glass.relaxation.terms.0.decay_rate='{rate} 1/s'");
    let weight = |weight: f64| format!("material.glass.relaxation.terms.0.weight={weight}");
    for (rates, weights) in [("200", 1.0), ("2708", 1.0), ("3e4", 0.5), ("3e5", 0.3)] {
        for acts_on in ["all", "shear"] {
            let acts_on = format!("material.glass.relaxation.acts_on=\"{acts_on}\"");
            let (rate, weight) = (rate(rates), weight(weights));
            for model in ["model.ting={}", "model.condensed={}"] {
                let set = [model, &rate, &weight, &acts_on, "mesh.contact_element_size='40 um'"];
                is_as_foretold(GLASS, &set, "viscoelasticity");
            }
        }
    }
    is_as_foretold(GLASS, &["mesh.contact_element_size='56 um'"], "viscoelasticity");
}

/// What is switched off is not there: to the bits, the case without it, and the user is told.
#[test]
fn relaxation_switched_off_is_the_elastic_case() {
    let (table, _) = GLASS.split_once("[material.glass.relaxation]").unwrap();
    let bodies = GLASS.find("[[body]]").unwrap();
    let elastic = format!("{table}\n{}", &GLASS[bodies..]);
    for model in ["model.hertz={}", "model.ting={}", "model.condensed={}"] {
        let off = simulation(GLASS, &[model, "effects.viscoelasticity=\"off\""]);
        assert_eq!(off.run(&mut ()), run(&elastic, &[model]), "{model}");
        let warnings = off.setup().warnings().join("\n");
        assert!(warnings.contains("viscoelasticity is needed, but switched off"), "{warnings}");
        assert!(warnings.contains("neglects about 0.07"), "{warnings}");
        // It is what the resolved case says again.
        assert_eq!(resolved(&off).run(&mut ()), off.run(&mut ()), "{model}");
    }
}
