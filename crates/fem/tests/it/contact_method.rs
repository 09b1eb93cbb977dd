//! `contact.method` as a case names it, and where a scene decides.

use fem::{Case, Collision, Simulation};
use fem_case::ContactMethod;
use fem_collision::Account;

use crate::coarse::simulation;

const MASSLESS: &str = "contact.method='massless'";
const PENALTY: &str = "contact.method='penalty'";
const NODES: &str = "contact.method='node_to_surface'";
const VISCOUS: &str = "effects.bulk_viscosity='on'";
/// Surfaces that are where they have moved have springs of their own.
const SMALL: &str = "effects.finite_strain='off'";
/// Beyond a fiftieth of the shear wave speed, on a mesh for it.
const FAST: [&str; 3] = [
    "body.0.approach_speed='80 m/s'",
    "mesh={contact_element_size='0.4 mm', refined_radius='1.6 mm'}",
    SMALL,
];
/// Two bodies of which one is computed.
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

fn resolved(simulation: &Simulation) -> Simulation {
    let text = simulation.resolved().to_toml().unwrap();
    let case = Case::parse("resolved.toml", &text, std::path::Path::new("."), &[]).unwrap();
    Simulation::new(case).unwrap()
}

fn run(overrides: &[&str]) -> Collision {
    fem(overrides).run(&mut ())
}

/// Each is another contact, of the same collision.
#[test]
fn a_case_names_the_method() {
    let named = [MASSLESS, PENALTY, NODES].map(|method| fem(&[method]));
    let methods = named.each_ref().map(planned);
    let all = [ContactMethod::Massless, ContactMethod::Penalty, ContactMethod::NodeToSurface];
    assert_eq!(methods, all);
    let runs = named.each_ref().map(|simulation| simulation.run(&mut ()));
    for (k, run) in runs.iter().enumerate() {
        assert!(runs[..k].iter().all(|other| other.steps != run.steps));
        // A coarse mesh, of two elements a contact radius.
        assert!((run.restitution.unwrap() / 0.9276 - 1.0).abs() < 0.01, "{:?}", run.restitution);
        assert!((run.contact_time.unwrap() / 62.445e-6 - 1.0).abs() < 0.03);
    }
    for simulation in &named {
        assert_eq!(planned(&resolved(simulation)), planned(simulation));
    }
}

/// Viscous forces are of velocities, with which no boundary without mass is in balance; only where they are
/// forced on it gives way.
#[test]
fn viscosity_that_is_forced_on_takes_penalty_and_says_so() {
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

/// Behind steep fronts it is springs between masses that ring, and viscosity that quiets them: a boundary
/// without mass has the force and the pressure of both, and loses less.
#[test]
fn a_contact_without_mass_does_not_ring_behind_fronts() {
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

/// Stiff springs between masses ring and gain energy, and a warning names the way out, which helps.
#[test]
fn a_contact_that_rings_is_told_what_helps() {
    let warnings = |method: &str| {
        let simulation =
            fem(&["contact.penalty_factor=100", "effects.viscoelasticity='off'", method]);
        let collision = simulation.run(&mut ());
        let about = |text: &String| text.contains("scatters") || text.contains("add up");
        simulation.warnings(&collision).into_iter().filter(about).collect::<Vec<_>>()
    };
    let told = warnings(PENALTY);
    assert!(!told.is_empty());
    assert!(told.iter().all(|text| text.contains("contact.method = \"massless\"")), "{told:?}");
    assert_eq!(warnings(MASSLESS), [""; 0]);
}

/// One of two like bodies, against the plane between them.
#[test]
fn half_of_the_work_gives_the_whole() {
    let whole = run(&[TWINS, MASSLESS, "effects.mirror_symmetry='off'"]);
    let mirrored = run(&[TWINS, MASSLESS]);
    assert_eq!(mirrored.element_updates.map(|n| 2 * n), whole.element_updates);
    let numbers = |run: &Collision| [run.restitution, run.contact_time, run.peak_force];
    for (half, whole) in numbers(&mirrored).into_iter().zip(numbers(&whole)) {
        // Rounding, which does not grow.
        assert!((half.unwrap() / whole.unwrap() - 1.0).abs() < 1e-9, "{half:?} {whole:?}");
    }
}

/// A ball that gravity brings back keeps what each contact leaves it.
#[test]
fn bounces_gain_nothing() {
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
        // Elastic but for the vibrations of nodes that join one by one, on a coarse mesh.
        assert!(e < 1.0 && e > 0.999, "{e}");
    }
}

/// On a half-space, from the same limit as penalty.
#[test]
fn a_ball_leaves_a_half_space() {
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

/// Surfaces that slip are without mass, too; nodes against a surface have no springs that turn, and a case
/// that names them is told.
#[test]
fn surfaces_that_slip_have_no_mass_either() {
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
        // Chatter of the last touch, 3.3e-3 of the contact time on this mesh, 7e-4 on that of the plan.
        assert!((bare.unwrap() / heavy.unwrap() - 1.0).abs() < 5e-3, "{bare:?} {heavy:?}");
    }
}

/// Surfaces that are where they have moved have springs of their own: who names a method is told, and the resolved
/// case names none.
#[test]
fn finite_strain_says_that_it_has_springs_of_its_own() {
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
