//! `contact.method`: the choice of the case, and scenes that need another method.

use fem_case::ContactMethod;
use fem_collision::{Account, Collision};
use fem_simulation::Simulation;

use crate::scene::{coarse_glass as simulation, resolved};

const MASSLESS: &str = "contact.method='massless'";
const PENALTY: &str = "contact.method='penalty'";
const NODES: &str = "contact.method='node_to_surface'";
const VISCOUS: &str = "effects.bulk_viscosity='on'";
/// Small strain; contact between deformed surfaces at finite strain has its own springs.
const SMALL: &str = "effects.finite_strain='off'";
/// A speed beyond a fiftieth of the shear wave speed, with a mesh for it.
const FAST: [&str; 3] = [
    "body.0.approach_speed='80 m/s'",
    "mesh={contact_element_size='0.4 mm', refined_radius='1.6 mm'}",
    SMALL,
];
/// Identical bodies, of which one is computed.
const TWINS: &str = "body.1.sphere.diameter='22.2 mm'";

fn fem(overrides: &[&str]) -> Simulation {
    simulation("fem", overrides)
}

fn fast(overrides: &[&str]) -> Simulation {
    fem(&[&FAST, overrides].concat())
}

fn planned(simulation: &Simulation) -> ContactMethod {
    simulation.setup().elements.as_ref().unwrap().plan.contact_method
}

fn run(overrides: &[&str]) -> Collision {
    fem(overrides).run(&mut ())
}

/// Each method gives the same collision within its error.
#[test]
fn a_case_names_the_method() {
    let named = [MASSLESS, PENALTY, NODES].map(|method| fem(&[method]));
    let methods = named.each_ref().map(planned);
    let all = [ContactMethod::Massless, ContactMethod::Penalty, ContactMethod::NodeToSurface];
    assert_eq!(methods, all);
    let runs = named.each_ref().map(|simulation| simulation.run(&mut ()));
    for (k, run) in runs.iter().enumerate() {
        assert!(runs[..k].iter().all(|other| other.steps != run.steps));
        // The mesh is coarse, with two elements per contact radius.
        assert!((run.restitution.unwrap() / 0.9276 - 1.0).abs() < 0.01, "{:?}", run.restitution);
        assert!((run.contact_time.unwrap() / 62.445e-6 - 1.0).abs() < 0.03);
    }
    for simulation in &named {
        assert_eq!(planned(&resolved(simulation)), planned(simulation));
    }
}

/// A massless boundary cannot balance viscous forces, so forced bulk viscosity replaces it by penalty springs with a
/// warning.
#[test]
fn forced_viscosity_needs_penalty_springs() {
    for bodies in ["start={}", TWINS] {
        for (switch, named, expected) in [
            ("effects.bulk_viscosity='auto'", "start={}", ContactMethod::Massless),
            (VISCOUS, "start={}", ContactMethod::Penalty),
            (VISCOUS, MASSLESS, ContactMethod::Penalty),
            (VISCOUS, NODES, ContactMethod::NodeToSurface),
            ("effects.bulk_viscosity='off'", MASSLESS, ContactMethod::Massless),
        ] {
            let simulation = fast(&[bodies, switch, named]);
            assert_eq!(planned(&simulation), expected, "{bodies} {switch} {named}");
            let warnings = simulation.setup().warnings();
            let warned = warnings.iter().any(|warning| warning.contains("contact.method"));
            let is_other = named == MASSLESS && expected == ContactMethod::Penalty;
            assert_eq!(warned, is_other, "{warnings:?}");
            assert_eq!(planned(&resolved(&simulation)), expected);
        }
    }
}

/// Behind steep fronts a massless boundary has the force and pressure of penalty springs with viscosity, without
/// ringing and with a smaller loss.
#[test]
fn a_massless_boundary_does_not_ring_behind_fronts() {
    let run = |method: &str, switch: &str| {
        let fast = ["body.0.approach_speed='100 m/s'", "mesh.contact_element_size='0.3 mm'"];
        let more = ["mesh.refined_radius='2.4 mm'", method, switch, SMALL];
        fem(&[&fast[..], &more].concat()).run(&mut ())
    };
    let quiet = run(MASSLESS, "effects={}");
    let spread = run(PENALTY, VISCOUS);
    let ringing = run(PENALTY, "effects.bulk_viscosity='off'");
    let ratio = |a: Option<f64>, b: Option<f64>| a.unwrap() / b.unwrap() - 1.0;
    // 0.0 and 0.0 % measured; the largest force of a step is 6 % higher with springs that ring.
    let off = ratio(quiet.peak_force, spread.peak_force);
    assert!(off.abs() < 5e-3, "{off:e} {:?} {:?} {:?}", quiet.warnings, quiet.steps, spread.steps);
    assert!(ratio(quiet.peak_pressure, spread.peak_pressure).abs() < 1e-2);
    assert!(ratio(ringing.peak_force_raw, spread.peak_force_raw) > 0.03);
    assert!(!quiet.energies.has(Account::BulkViscosity));
    assert!(quiet.restitution > spread.restitution);
}

/// Bounces of a ball gain no energy.
#[test]
fn massless_bounces_gain_no_energy() {
    let floor = [
        "body.0={name='floor', wall={}}",
        "body.1.approach_speed=0.5",
        "gravity.acceleration=9.81",
        "stop.bounces=4",
        "effects.viscoelasticity='off'",
    ];
    let run = run(&[&floor[..], &[MASSLESS]].concat());
    assert_eq!(run.bounces.len(), 4);
    for bounce in &run.bounces {
        let e = bounce.restitution;
        // The loss is that by vibrations as nodes enter the contact on a coarse mesh.
        assert!(e < 1.0 && e > 0.999, "{e}");
    }
}

/// A ball on a half-space leaves as with penalty springs.
#[test]
fn massless_restitution_on_a_half_space_equals_penalty() {
    let block = [
        "body.0={name='block', half_space={}, material='glass'}",
        "body.1.approach_speed=0.5",
        "accuracy.tolerance='0.3 %'",
    ];
    let [massless, penalty] =
        [MASSLESS, PENALTY].map(|method| run(&[&block[..], &[method]].concat()));
    let off = massless.restitution.unwrap() - penalty.restitution.unwrap();
    assert!(off.abs() < 1e-3, "{off:e}");
    for run in [massless, penalty] {
        assert!(run.residual_relative.unwrap() < 1e-5, "{:?}", run.residual_relative);
        assert!(run.momentum_residual_relative.unwrap() < 1e-11);
    }
}

/// Slipping surfaces have a massless boundary, too. Node-to-surface contact is not possible there and is replaced with a
/// warning.
#[test]
fn slipping_surfaces_have_a_massless_boundary() {
    let steel = [
        "material.steel={density=7850, youngs_modulus=210e9, poissons_ratio=0.3}",
        "body.0.material='steel'",
    ];
    let with = |more: &[&str]| fem(&[&steel[..], more].concat());
    for (more, expected) in [
        (&[][..], ContactMethod::Massless),
        (&[PENALTY], ContactMethod::Penalty),
        (&[NODES], ContactMethod::Penalty),
        (&[NODES, "effects.surface_slip='off'"], ContactMethod::NodeToSurface),
        (&[VISCOUS], ContactMethod::Penalty),
    ] {
        let simulation = with(more);
        assert_eq!(planned(&simulation), expected, "{more:?}");
        let warnings = simulation.setup().warnings();
        let warned = warnings.iter().any(|warning| warning.contains("contact.method"));
        assert_eq!(warned, more == [NODES], "{warnings:?}");
        assert_eq!(planned(&resolved(&simulation)), expected);
    }
    let [bare, heavy] = [&[][..], &[PENALTY]].map(|more| with(more).run(&mut ()));
    assert_eq!(bare.contact_episodes, 1);
    for (bare, heavy) in
        [(bare.restitution, heavy.restitution), (bare.contact_time, heavy.contact_time)]
    {
        // Contact chatter at the end changes 3.3e-3 of the contact time on this mesh, and 7e-4 on that of the plan.
        assert!((bare.unwrap() / heavy.unwrap() - 1.0).abs() < 5e-3, "{bare:?} {heavy:?}");
    }
}

/// At finite strain a named method has no effect: there is a warning, and the resolved case has no method.
#[test]
fn finite_strain_warns_of_a_named_method() {
    let large = "effects.finite_strain='on'";
    for method in [MASSLESS, PENALTY, NODES] {
        let named = fem(&[large, method]);
        let said = named.setup().warnings().join("\n");
        let words = format!("{} has no effect at finite strain", method.replace('=', " = "));
        assert!(said.contains(&words.replace('\'', "\"")), "{said}");
        assert_eq!(named.resolved().contact.as_ref().unwrap().method, None);
        assert!(!resolved(&named).setup().warnings().join("\n").contains("has no effect"));
    }
    assert!(!fem(&[large]).setup().warnings().join("\n").contains("has no effect"));
    let small = fem(&[MASSLESS]);
    assert!(small.resolved().contact.as_ref().unwrap().method.is_some());
}
