//! What a run says of itself that went wrong: when, where, by how much, and a remedy. Followed, it helps.

use std::path::Path;

use fem::{Case, Collision, Label, Simulation, Stop, assess, remedy_of};

const GLASS: &str = include_str!("../../../../cases/glass_0.5ms_elastic.toml");
const SOFT: &str = include_str!("../../../../cases/soft_sphere.toml");

/// A ball of steel on one of rubber: surfaces that slip, and a front of contact as fast as waves.
const SLIP: &str = "
    material.steel = { density = 7850, youngs_modulus = '210 GPa', poissons_ratio = 0.3 }
    [material.rubber]
    density = 1100
    youngs_modulus = '5 MPa'
    poissons_ratio = 0.45
    relaxation = { acts_on = 'shear', terms = [{ weight = 0.5, relaxation_time = '1 ms' }] }
    [[body]]
    name = 'ball'
    sphere.diameter = '20 mm'
    material = 'steel'
    approach_speed = '0.5 m/s'
    [[body]]
    name = 'target'
    sphere.diameter = '20 mm'
    material = 'rubber'
    [model]
    fem = {}
";

fn run(case: &str, overrides: &[&str]) -> (Simulation, Collision) {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    let case = Case::parse("case.toml", case, Path::new("."), &overrides).unwrap();
    let simulation = Simulation::new(case).unwrap();
    let collision = simulation.run(&mut ());
    (simulation, collision)
}

/// What a run says with some word in it.
fn said(case: &str, overrides: &[&str], word: &str) -> Option<String> {
    let (simulation, collision) = run(case, overrides);
    assess(&simulation, &collision).into_iter().find(|text| text.contains(word))
}

/// `KEY=VALUE` of `… write KEY = VALUE` in a message.
fn written(message: &str) -> String {
    let advice = message.split("write ").nth(1).unwrap_or_else(|| panic!("{message}"));
    let advice = advice.split([',', ';']).next().unwrap();
    advice.replacen(" = ", "=", 1)
}

/// A scene that says something with `word`, and nothing of it any more once the remedy is written.
#[track_caller]
fn assert_helped(case: &str, overrides: &[&str], word: &str) -> String {
    let message = said(case, overrides, word).unwrap_or_else(|| panic!("no word of {word}"));
    let remedy = written(&message);
    let with = [overrides, &[&remedy]].concat();
    for word in ["scatters", "add up", "overlap"] {
        assert_eq!(said(case, &with, word), None, "{message}");
    }
    message
}

const COARSE: &str = "mesh.contact_element_size='90 um'";
/// Elements that are small, and nodes that stay light: springs between them ring.
const SLIPPING_FINE: &str = "mesh.contact_element_size='0.163 mm'";
const SOFT_FINE: &str = "mesh.contact_element_size='0.55 mm'";
const LITTLE_MASS: &str = "time.mass_scaling=2e-4";

#[test]
fn springs_at_nodes_that_ring_are_told_of_a_boundary_without_mass() {
    for method in ["penalty", "node_to_surface"] {
        let method = format!("contact.method='{method}'");
        let overrides = [COARSE, &method, "contact.penalty_factor=30"];
        let message = assert_helped(GLASS, &overrides, "scatters");
        for words in ["% of its peak, most about", "s (step", "massless"] {
            assert!(message.contains(words), "{message}");
        }
    }
}

/// Surfaces that slip are quiet without mass, whatever their springs, and are told so with springs that ring.
#[test]
fn surfaces_that_slip_are_told_of_a_boundary_without_mass() {
    for factor in [1.0, 100.0] {
        let factor = format!("contact.penalty_factor={factor}");
        let fine = [factor.as_str(), SLIPPING_FINE, LITTLE_MASS];
        assert_eq!(said(SLIP, &fine, "scatters"), None);
        let springs = [&fine[..], &["contact.method='penalty'"]].concat();
        let message = assert_helped(SLIP, &springs, "scatters");
        assert_eq!(written(&message), "contact.method=\"massless\"");
    }
}

/// Where there is no boundary without mass it is not named: what is, helps.
#[test]
fn springs_that_cannot_be_without_mass_are_told_how_soft_to_be() {
    let viscous = "effects.bulk_viscosity='on'";
    let stiff = "contact.penalty_factor=300";
    let message = assert_helped(SLIP, &[viscous, stiff, SLIPPING_FINE, LITTLE_MASS], "scatters");
    assert_eq!(written(&message), "contact.penalty_factor=1");
    for factor in [10.0, 100.0] {
        let factor = format!("contact.penalty_factor={factor}");
        let message =
            assert_helped(SOFT, &[&factor, "model.fem={}", SOFT_FINE, LITTLE_MASS], "scatters");
        assert_eq!(written(&message), "contact.penalty_factor=1");
    }
}

#[test]
fn energy_that_does_not_add_up_is_told_with_its_time() {
    let overrides = [COARSE, "contact.method='penalty'", "contact.penalty_factor=1e4"];
    let (simulation, collision) = run(GLASS, &overrides);
    let since = collision.residual_since.expect("a moment");
    let rows = &collision.history;
    let worst_before = rows
        .iter()
        .filter(|row| row.time < since.time)
        .map(|row| row.residual.unwrap().abs() / collision.initial_energy.unwrap());
    // Energies of rows count in the frame of the case, and the imbalance in that of the mass centre.
    assert!(
        worst_before.fold(0.0, f64::max) < 1e-3 && since.time > collision.first_contact.unwrap()
    );
    let message = assess(&simulation, &collision);
    let message = message.iter().find(|text| text.contains("add up")).unwrap();
    assert!(message.contains(&format!("since {since}")), "{message}");
    assert_helped(GLASS, &overrides, "add up");
}

/// A run that blows up says where, leaves its last sound state, and ends well by its remedy.
#[test]
fn a_run_that_gains_energy_says_where_and_what_helps() {
    let overrides = [
        COARSE,
        "contact.method='node_to_surface'",
        "contact.penalty_factor=300",
        "time.mass_scaling=2e-4",
    ];
    let (_, collision) = run(GLASS, &overrides);
    let Some(stop @ Stop::EnergyGrowth { time, place, .. }) = collision.stop() else {
        panic!("{:?}", collision.ending)
    };
    // At the contact, which has a radius of 0.22 mm.
    assert!(place[0] < 0.4e-3 && place[1].abs() < 0.4e-3, "{place:?}");
    let sound = collision.snapshot(Label::LastSound).expect("a state").time;
    assert!(sound < *time && collision.residual_since.unwrap().time > sound);
    let remedy = remedy_of(stop).unwrap().remedy;
    assert!(remedy.starts_with("write contact.method = \"massless\""), "{remedy}");
    let with = [COARSE, "contact.method='massless'", "contact.penalty_factor=300"];
    assert_eq!(run(GLASS, &with).1.stop(), None);
}

#[test]
fn springs_that_are_too_soft_are_told_how_stiff_to_be() {
    for factor in [0.02, 0.1] {
        let factor = format!("contact.penalty_factor={factor}");
        let message = assert_helped(GLASS, &[COARSE, &factor], "overlap");
        assert!(message.contains("% of an element, deepest "), "{message}");
        // On the axis, at the largest force.
        let (_, collision) = run(GLASS, &[COARSE, &factor]);
        let deepest = collision.deepest.unwrap();
        assert!(message.contains(&deepest.to_string()), "{message}");
        let ends = [collision.first_contact, collision.last_contact].map(Option::unwrap);
        let middle = 0.5 * (ends[0] + ends[1]);
        assert!((deepest.at.time - middle).abs() < 0.1 * (ends[1] - ends[0]), "{deepest}");
        assert!(deepest.radius < 0.3 * collision.max_contact_radius.unwrap(), "{deepest}");
        // F = k ∫ overlap dA, of a paraboloid at most twice its mean.
        assert!(deepest.overlap < 0.5 * collision.max_approach.unwrap(), "{deepest}");
    }
}

/// Limits are for the user: raised, the run goes to its end.
#[test]
fn a_run_at_its_limit_goes_on_where_that_is_raised() {
    let fluid = "material.glass.relaxation={acts_on='all', terms=[{weight=0.995, relaxation_time='0.3 us'}]}";
    let mesh = ["mesh.contact_element_size='0.2 mm'", "mesh.refined_radius='0.6 mm'", fluid];
    let mut simulation = run(GLASS, &mesh).0;
    let want = simulation.want().clone();
    simulation.ask_for(fem::Want { most_element_updates: 100_000, ..want }).unwrap();
    let collision = simulation.run(&mut ());
    let stop = collision.stop().expect("a stop");
    assert!(matches!(stop, Stop::TooManyUpdates { .. }), "{stop}");
    assert!(remedy_of(stop).unwrap().remedy.starts_with("raise limits.element_updates"));
    assert_eq!(run(GLASS, &mesh).1.stop(), None);
}
