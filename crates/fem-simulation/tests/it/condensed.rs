//! `[model] condensed`: its keys, its results compared with the explicit model, and pairs that cases share.

use fem_case::Case;
use fem_collision::{Collision, QuantityOfInterest};
use fem_simulation::{Condensed, Model, SharedModels, Simulation};

use crate::scene::{GLASS, case_of, collision_of, refused_of, simulation_of};

fn case(overrides: &[&str]) -> Case {
    case_of(GLASS, overrides)
}

fn simulation(overrides: &[&str]) -> Simulation {
    simulation_of(GLASS, overrides)
}

fn run(overrides: &[&str]) -> Collision {
    collision_of(GLASS, overrides)
}

const CONDENSED: &str = "model.condensed={}";

/// Speeds and relaxations on one mesh share a factor and give the same bits as without sharing.
#[test]
fn cases_share_a_pair() {
    let mesh = ["mesh.contact_element_size='50 um'", "mesh.refined_radius='0.4 mm'", CONDENSED];
    let shared = SharedModels::default();
    let cache = &shared.pairs;
    let condensed_of = |extra: &str| {
        let overrides: Vec<&str> = mesh.iter().copied().chain([extra]).collect();
        let case = case(&overrides);
        let condensed = Condensed::new(case.scene(), &shared).unwrap();
        let (approach, request) = (condensed.setup().approach, condensed.setup().request.clone());
        let collision = condensed.collide(&approach, &request, &mut ());
        assert_eq!(collision.history, run(&overrides).history);
        condensed
    };
    let first = condensed_of("body.0.approach_speed=0.5");
    for extra in [
        "body.0.approach_speed=0.2",
        "material.glass.relaxation={acts_on='shear', terms=[{weight=0.5, decay_rate=1e4}]}",
    ] {
        assert!(std::ptr::eq(first.pair(), condensed_of(extra).pair()), "{extra}");
    }
    assert_eq!(cache.n_made(), 1);
    // Another density is another pair.
    assert!(!std::ptr::eq(first.pair(), condensed_of("material.glass.density=2000").pair()));
    assert_eq!(cache.n_made(), 2);
    // So are other elements, bodies, sides, and another way of condensing.
    let others = [
        "mesh.contact_element_size='60 um'",
        "mesh.growth=1.5",
        "body.1.sphere.diameter='16 mm'",
        "material.glass.poissons_ratio=0.25",
        "model.condensed.penalty_springs=true",
        "model.condensed.vibration_modes=1",
    ];
    for (k, extra) in others.into_iter().enumerate() {
        condensed_of(extra);
        assert_eq!(cache.n_made(), 3 + k, "{extra}");
    }
}

/// Bodies of a few hundred elements; the contact stays within them.
const COARSE: [&str; 3] =
    ["mesh.contact_element_size='0.2 mm'", "mesh.refined_radius='0.4 mm'", CONDENSED];

/// Returns nine pairings at two speeds; the speed is the outer loop or the inner one.
fn nine_pairings(speed_is_slow: bool) -> Vec<Case> {
    let member = |speed: usize, pairing: usize| {
        let [first, second] = [pairing / 3, pairing % 3];
        let speed = format!("body.0.approach_speed={}", [0.1, 0.3][speed]);
        let first = format!("body.0.sphere.diameter='{} mm'", 20 + first);
        let second = format!("body.1.sphere.diameter='{} mm'", 15 + second);
        case(&[&COARSE[..], &[&speed, &first, &second]].concat())
    };
    let index = |k: usize| if speed_is_slow { (k / 9, k % 9) } else { (k % 2, k / 2) };
    (0..18).map(index).map(|(speed, pairing)| member(speed, pairing)).collect()
}

fn restitution(case: Case, shared: &SharedModels) -> f64 {
    Simulation::sharing(case, shared).unwrap().run(&mut ()).restitution.unwrap()
}

/// Each pair of bodies is factored once in any order, and the order does not change the results.
#[test]
fn nine_pairings_need_nine_factors_in_any_order() {
    let run = |speed_is_slow: bool, shared: &SharedModels| -> Vec<f64> {
        nine_pairings(speed_is_slow).into_iter().map(|case| restitution(case, shared)).collect()
    };
    let [slow, fast] = [SharedModels::default(), SharedModels::default()];
    let tight = SharedModels::with_max_bytes(1);
    let (by_speed, by_pairing) = (run(true, &slow), run(false, &fast));
    assert_eq!((slow.pairs.n_made(), fast.pairs.n_made()), (9, 9));
    assert_eq!(slow.pairs.n_kept(), 9);
    let reordered: Vec<f64> = (0..18).map(|k| by_pairing[2 * (k % 9) + k / 9]).collect();
    assert_eq!(by_speed, reordered);
    // A cache with room for nothing keeps the last pair, and gives the same.
    assert_eq!(run(false, &tight), by_pairing);
    assert_eq!((tight.pairs.n_made(), tight.pairs.n_kept()), (9, 1));
    assert_eq!(run(true, &tight), by_speed);
    assert_eq!(tight.pairs.n_made(), 9 + 18);
}

/// Element sizes are rounded to lengths that scenes share. Thirty members over a third of a decade in speed and a decade in
/// relaxation need only a few factors, also of their reference runs, and give the same bits as without sharing.
#[test]
fn speeds_and_relaxations_share_meshes() {
    let members = || {
        (0..30).map(|k| {
            let speed = 0.25 * 2.0_f64.powf(f64::from(k % 6) / 5.0);
            let rate = 500.0 * 10.0_f64.powf(f64::from(k / 6) / 4.0);
            let speed = format!("body.0.approach_speed={speed:?}");
            let rate = format!("material.glass.relaxation.terms.0.decay_rate={rate:?}");
            case(&[CONDENSED, &speed, &rate])
        })
    };
    let shared = SharedModels::default();
    for (k, case) in members().enumerate() {
        let simulation = Simulation::sharing(case.clone(), &shared).unwrap();
        let collision = simulation.run(&mut ());
        let bar = |of: &Simulation| {
            let bars = of.summary(&collision).uncertainty;
            bars.of(QuantityOfInterest::PeakForce).discretisation.unwrap()
        };
        let shared = bar(&simulation);
        if k % 7 == 0 {
            let alone = Simulation::new(case).unwrap();
            assert_eq!((alone.run(&mut ()), bar(&alone)), (collision.clone(), shared));
        }
    }
    // a ∝ v^(2/5): 3.2 of eight lengths an octave.
    let (pairs, references) = (shared.pairs.n_made(), shared.reference_pairs.n_made());
    assert!((4..=8).contains(&pairs) && references <= 2 * pairs, "{pairs} {references}");
}

/// Threads that need the same pair wait for the one that makes it.
#[test]
fn threads_do_not_factor_a_pair_twice() {
    let shared = SharedModels::default();
    let barrier = std::sync::Barrier::new(4);
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                let case = case(&COARSE);
                barrier.wait();
                Simulation::sharing(case, &shared).unwrap();
            });
        }
    });
    assert_eq!(shared.pairs.n_made(), 1);
}

/// A contact beyond the condensed region enlarges the pair of that case alone.
#[test]
fn enlarged_pair_is_not_shared_with_other_cases() {
    let shared = SharedModels::default();
    let soft = |weight: f64| {
        let terms = format!(
            "material.glass.relaxation={{acts_on='all', terms=[{{weight={weight}, \
             decay_rate=1e6}}]}}"
        );
        let fine = ["mesh.contact_element_size='0.1 mm'", "body.0.approach_speed=1.2", &terms];
        case(&[&COARSE[1..], &fine].concat())
    };
    let condensed = |case: Case| {
        let condensed = Condensed::new(case.scene(), &shared).unwrap();
        let (approach, request) = (condensed.setup().approach, condensed.setup().request.clone());
        condensed.collide(&approach, &request, &mut ()).candidate_region.unwrap().radius
    };
    let small = condensed(soft(0.0));
    // The softer bodies need a larger region.
    let large = condensed(soft(0.95));
    assert!(large > small, "{large} {small}");
    assert_eq!(condensed(soft(0.0)), small);
    assert_eq!(shared.pairs.n_made(), 1);
}

/// Snapshots that are skipped do not change other results.
#[test]
fn snapshots_are_skipped_on_demand() {
    for model in [CONDENSED, "model.fem={}", "model.ting={}"] {
        let overrides = ["mesh.contact_element_size='90 um'", model];
        let skipping = simulation(&overrides).without_snapshots();
        let (skipped, whole) = (skipping.run(&mut ()), run(&overrides));
        assert!(skipped.snapshots.is_empty());
        assert_eq!(whole.snapshots.is_empty(), model.contains("ting"));
        assert_eq!(skipped.history, whole.history);
        assert_eq!(skipped.restitution, whole.restitution);
        assert_eq!(skipped.bodies, whole.bodies);
        assert_eq!(skipping.resolved(), simulation(&overrides).resolved());
    }
}

/// The model warns of keys that it does not read, and rejects scenes beyond its limits.
#[test]
fn unread_keys_and_limits_are_reported() {
    let warned = |overrides: &[&str], words: &str| {
        let warnings = simulation(overrides).setup().warnings().join("\n");
        assert!(warnings.contains(words), "{warnings}");
    };
    assert!(simulation(&[CONDENSED]).setup().warnings().is_empty());
    warned(&[CONDENSED, "time.step_factor=0.5"], "time.step_factor has no effect");
    warned(&[CONDENSED, "contact.method='massless'"], "contact.method has no effect");
    warned(&[CONDENSED, "contact.penalty_factor=2"], "contact.penalty_factor has no effect");
    warned(&[CONDENSED, "body.0.approach_speed=30"], "vibration_modes = 12");
    warned(&[CONDENSED, "body.0.approach_speed=30"], "small strain is off by");
    let refused = |overrides: &[&str]| refused_of(GLASS, overrides);
    // The limit applies to the memory of the factors.
    let error = refused(&[CONDENSED, "limits.memory=1000", "mesh.contact_element_size='60 um'"]);
    assert!(error.message().contains("factors"), "{error}");
    assert!(error.help().is_some_and(|help| help.contains("limits.memory")), "{error}");
    let error = refused(&[CONDENSED, "output.snapshots=100000"]);
    assert!(error.help().is_some_and(|help| help.contains("fewer output.snapshots")), "{error}");
}

/// Bodies that nearly flow stop slowly. Their steps are longer, so that they take as many as others, and the cost estimate
/// counts them.
#[test]
fn bodies_that_nearly_flow_take_longer_steps() {
    assert_longer_steps(&[("all", 0.9999)]);
}

#[test]
#[ignore = "takes many seconds"]
fn all_bodies_that_nearly_flow_take_longer_steps() {
    assert_longer_steps(&[("all", 1.0), ("shear", 0.999)]);
}

fn assert_longer_steps(relaxations: &[(&str, f64)]) {
    let flowing = |acts_on: &str, weight: f64, more: &str| {
        let relaxation = format!(
            "material.glass.relaxation={{acts_on='{acts_on}',terms=[{{weight={weight},decay_rate=4e6}}]}}"
        );
        let model = format!("model.condensed={{penalty_springs=true{more}}}");
        simulation(&["mesh.contact_element_size='60 um'", &relaxation, &model])
    };
    for &(acts_on, weight) in relaxations {
        let simulation = flowing(acts_on, weight, "");
        let fem_simulation::Cost::Factors { steps, .. } = simulation.setup().cost else {
            panic!("{acts_on}")
        };
        let found = simulation.run(&mut ());
        let share = found.steps.unwrap() as f64 / steps as f64;
        assert!(steps < 4000 && (1.0 / 1.5..1.5).contains(&share), "{share} of {steps}");
        // Ten times as many steps give the same; the default has about 500 until the bodies stop.
        let finer = flowing(acts_on, weight, ", steps=10000").run(&mut ());
        let numbers =
            |one: &Collision| [one.peak_force, one.max_approach, one.restitution.map(|e| 1.0 + e)];
        for (a, b) in numbers(&found).into_iter().zip(numbers(&finer)) {
            let error = a.unwrap() / b.unwrap() - 1.0;
            assert!(error.abs() < 1e-3, "{acts_on} {weight}: {error:e}");
        }
    }
}

/// By default a collision takes about three hundred steps and has a thousand history rows.
#[test]
fn default_condensed_run_takes_300_steps_and_1000_rows() {
    let run = run(&[CONDENSED]);
    let (steps, rows) = (run.steps.unwrap(), run.history.len());
    assert!(steps < 320 && (1000..1400).contains(&rows), "{steps} steps, {rows} rows");
    let e = self::run(&[CONDENSED, "material.glass.relaxation.terms.0.weight=0"]).restitution;
    assert!((e.unwrap() - 1.0).abs() < 1e-10, "{e:?}");
}

/// Factors are kept if the case requests fields, and made again if fields are requested later.
#[test]
fn factors_are_kept_for_fields_only() {
    let kept = |more: &str| {
        let simulation = simulation(&[CONDENSED, more]);
        let fem_simulation::Cost::Factors { factor_bytes, .. } = simulation.setup().cost else {
            panic!()
        };
        (factor_bytes, simulation)
    };
    let bytes = kept("output.report=false").0;
    assert!((500_000..2_000_000).contains(&bytes), "{bytes}");
    let probe = "output={snapshots=[], probe=[{body='target', r='0 m', y='1 mm'}]}";
    assert!(kept(probe).0 > 500_000);
    let (bytes, simulation) = kept("output.snapshots=[]");
    assert_eq!(bytes, 0);
    let (_, keeping) = kept("output.report=false");
    let snapshots = keeping.request().snapshots.clone();
    let asked =
        fem_collision::OutputRequest { snapshots, ..fem_collision::OutputRequest::quantities() };
    let approach = simulation.setup().approach;
    let [made, kept] = [&simulation, &keeping]
        .map(|simulation| simulation.model().collide(&approach, &asked, &mut ()).snapshots);
    assert_eq!((made.len(), made), (4, kept));
}
