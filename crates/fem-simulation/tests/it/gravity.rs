//! A ball that gravity brings back, by every model.

use fem_collision::{Account, BalanceSide, Collision, Ending, HistoryRow, Monitor, Progress};
use fem_simulation::Simulation;

use crate::scene::{
    RUBBER_BALL as BALL, THREE_BOUNCES, collision_of, decision_on, resolved, simulation_of,
};

/// The error bar of each contact holds beside elements a quarter as large at its own speed. The bars grow while the elements stay and
/// the contact shrinks, and are other ones on the mesh that follows.
#[test]
fn each_contact_has_an_error_bar_of_its_own() {
    for model in ["model.condensed={}", "model.fem={}"] {
        let simulation = simulation_of(THREE_BOUNCES, &[model, "stop.bounces=6"]);
        let found = simulation.run_within_tolerance(&mut ());
        let summary = found.summary();
        let bounces = summary.bounces.unwrap();
        let bars: Vec<f64> =
            bounces.iter().filter_map(|it| it.restitution_uncertainty.discretisation).collect();
        assert!(bars.len() == bounces.len() && bars.windows(2).all(|two| two[0] != two[1]));
        for (bounce, bar) in bounces.iter().zip(bars).skip(1) {
            let (speed, e) = (bounce.speed_before_m_s.unwrap(), bounce.restitution.unwrap());
            let at = format!("body.1.approach_speed={speed}");
            let fine = ["model.condensed={}", "start.gap=0", "stop.bounces=1", &at, FINE];
            let fine = simulation_of(THREE_BOUNCES, &fine).run(&mut ());
            let error = (e - fine.restitution.unwrap()).abs();
            // The smaller elements err by 2e-5 themselves.
            assert!(error < bar + 2e-5 && bar < 0.01, "{model} at {speed}: {error} ± {bar}");
        }
    }
}

/// Elements that are as coarse as a test may have them: four across the first contact.
const COARSE: &str = "mesh={contact_element_size='0.45 mm', refined_radius='1.8 mm'}";
/// Elements a quarter as large as those of the shipped case.
const FINE: &str = "mesh.contact_element_size='28 um'";
const ELASTIC: &str = "material.rubber={density=1100, youngs_modulus=20e6, poissons_ratio=0.4}";
const G: f64 = 9.81;

fn simulation(set: &[&str]) -> Simulation {
    simulation_of(BALL, set)
}

fn run(overrides: &[&str]) -> Collision {
    simulation(overrides).run(&mut ())
}

fn relaxing(weight: f64, time: &str, acts_on: &str) -> String {
    format!(
        "material.rubber.relaxation={{acts_on='{acts_on}', \
         terms=[{{weight={weight}, relaxation_time='{time}'}}]}}"
    )
}

/// Returns the energy that all accounts hold and have lost, J.
fn total(row: &HistoryRow) -> f64 {
    [BalanceSide::Held, BalanceSide::Lost]
        .into_iter()
        .filter_map(|side| row.energies.total(side))
        .sum()
}

/// Returns the greatest heights of rows between bounces, m.
fn heights(collision: &Collision) -> Vec<f64> {
    let tops = collision.bounces.windows(2).map(|two| {
        let rows = collision.history.iter();
        let flight = rows.filter(|row| row.time > two[0].time && row.time < two[1].time);
        flight.map(|row| -row.approach).fold(0.0, f64::max)
    });
    tops.collect()
}

/// The change of the first contact by the weight agrees with its estimate, for a ball that is let down at 3 cm/s.
#[test]
fn the_neglect_error_of_gravity_is_that_of_runs() {
    let let_down = ["model.ting={}", ELASTIC, "start.gap=0", "body.1.approach_speed='3 cm/s'"];
    let with = simulation(&let_down);
    let estimate = &with.setup().estimate;
    let estimated = with.neglect_error(decision_on(&with, "gravity"), estimate).unwrap();
    let none = "gravity.acceleration=1e-9";
    let (with, without) = (with.run(&mut ()), run(&[&let_down[..], &[none]].concat()));
    let change = |with: Option<f64>, without: Option<f64>| with.unwrap() - without.unwrap();
    let time = change(with.contact_time, without.contact_time);
    let force = change(with.peak_force, without.peak_force);
    // √(g δ)/v is 0.46, so the first order is accurate within a factor of two.
    let ratio = time / estimated.contact_time_s.unwrap();
    assert!((0.5..2.0).contains(&ratio), "T {ratio}");
    let ratio = force / estimated.peak_force_n.unwrap();
    assert!((0.5..2.0).contains(&ratio), "F {ratio}");
}

/// A ball that leaves with e v rises to (e v)²/2g, and comes down 2 e v/g after it has left.
#[test]
fn heights_follow_from_the_restitution() {
    for model in ["model.ting={}", "model.condensed={}", "model.law.kuwabara_kono.a='40 us'"] {
        let ball = run(&[model, "stop.bounces=8"]);
        assert_eq!((ball.ending.clone(), ball.bounces.len()), (Ending::Parted, 8), "{model}");
        let first = &ball.bounces[0];
        // Torricelli.
        assert!((first.speed_before / (2.0 * G * 0.05_f64).sqrt() - 1.0).abs() < 1e-12);
        assert!((first.time - (2.0 * 0.05 / G).sqrt()).abs() < 1e-12);
        assert_eq!(ball.restitution, Some(first.restitution), "{model}");
        for (two, height) in ball.bounces.windows(2).zip(heights(&ball)) {
            let left = two[0].restitution * two[0].speed_before;
            // A row near the top is within a ninth of the flight: 1 − (1/9)² of its height.
            let top = left * left / (2.0 * G);
            assert!(height < 1.001 * top && height > 0.98 * top, "{model}: {height} {top}");
            // The ball leaves from below the height of first touch, which changes some thousandths.
            assert!((two[1].speed_before / left - 1.0).abs() < 5e-3, "{model}");
            let flight = two[1].time - two[0].time - two[0].contact_time.unwrap();
            assert!((flight / (2.0 * left / G) - 1.0).abs() < 5e-3, "{model}: {flight}");
        }
    }
}

/// Every contact is the collision of the same bodies alone at its speed.
#[test]
fn a_bounce_is_a_collision_at_its_speed() {
    for model in ["model.ting={}", "model.condensed={}"] {
        let ball = run(&[model, COARSE, "stop.bounces=4"]);
        for bounce in &ball.bounces {
            let speed = format!("body.1.approach_speed={:?}", bounce.speed_before);
            let alone = run(&[model, COARSE, &speed, "start.gap=0", "stop={}"]);
            assert_eq!(alone.restitution, Some(bounce.restitution), "{model}");
            assert_eq!(alone.contact_time, bounce.contact_time, "{model}");
            assert_eq!(alone.peak_force, bounce.peak_force, "{model}");
        }
    }
}

/// A ball comes to rest with Hertz' contact radius a³ = 3 F R/4 E* of the relaxed E*, by hand: half of it, or that of K
/// and G∞ if only the shear modulus relaxes.
#[test]
fn a_relaxing_ball_rests_on_its_equilibrium_modulus() {
    let weight = 1100.0 * std::f64::consts::PI * 0.02_f64.powi(3) / 6.0 * G;
    let (bulk, shear) = (20e6 / (3.0 * 0.2), 0.3 * 20e6 / 2.8);
    let of_shear = 4.0 * shear * (3.0 * bulk + shear) / (3.0 * bulk + 4.0 * shear);
    for (relaxation, modulus, tolerance, allowed) in [
        // The mesh's weight and its edge of contact: 0.1 %.
        (relaxing(0.5, "2 ms", "all"), 0.5 * 20e6 / (1.0 - 0.4 * 0.4), "0.3 %", 5e-3),
        // At 1 % the edge may fall anywhere between nodes: 0.7 % of the radius. With ν = 0.47 of what is left the edge
        // is read 0.4 % too wide.
        (relaxing(0.7, "1 ms", "shear"), of_shear, "0.1 %", 8e-3),
    ] {
        let tolerance = format!("accuracy.tolerance='{tolerance}'");
        let radius = (0.75 * weight * 0.01 / modulus).cbrt();
        for model in ["model.ting={}", "model.condensed={}"] {
            let own = simulation(&[model, &relaxation, "stop.bounces=100", &tolerance]);
            let ball = own.run(&mut ());
            assert_eq!(ball.ending, Ending::AtRest, "{model}");
            assert!(ball.is_complete() && ball.bounces.len() > 10, "{model}: {:?}", ball.bounces);
            let rest = ball.rest.unwrap();
            assert!((rest.contact.force / weight - 1.0).abs() < 1e-9, "{model}");
            let found = rest.contact.contact_radius.unwrap();
            assert!((found / radius - 1.0).abs() < allowed, "{model}: {found} {radius}");
            let approach = radius * radius / 0.01;
            // A finite sphere is stiffer than a half-space by the order of a/R, 3 %.
            assert!((rest.contact.approach / approach - 1.0).abs() < 0.03, "{model}");
            assert!(rest.time > ball.bounces.last().unwrap().time, "{model}");
            assert!(ball.warnings.iter().any(|text| text.contains("comes to rest")), "{model}");
            let summary = own.summary(&ball);
            assert_eq!(summary.bounces.unwrap().len(), ball.bounces.len());
            assert_eq!(summary.rest.unwrap().contact_radius_m, Some(found));
        }
    }
}

/// In a hundred bounces the energy stays that of first touch within the error of the steps, 2e-6 per contact.
#[test]
fn energy_is_conserved_over_many_bounces() {
    for model in ["model.condensed.vibration_modes=6", "model.hertz={}"] {
        let ball = run(&[model, ELASTIC, COARSE, "stop.bounces=100"]);
        assert_eq!((ball.ending.clone(), ball.bounces.len()), (Ending::Parted, 100), "{model}");
        let initial = ball.initial_energy.unwrap();
        for row in &ball.history {
            let total = total(row);
            assert!((total / initial - 1.0).abs() < 1e-3, "{model}: {} {total}", row.time);
            let residual = row.residual.unwrap();
            assert!(residual.abs() < 1e-3 * initial, "{model}: {residual}");
        }
        assert!(ball.residual_relative.unwrap() < 1e-3, "{model}");
        let left = ball.energies.get(Account::LeftBefore).unwrap();
        let has_modes = model.contains("modes");
        assert_eq!(left > 1e-6 * initial, has_modes, "{model}: what vibrates is {left}");
        assert!(ball.history.is_sorted_by(|one, next| one.time < next.time), "{model}");
    }
}

/// A ball that is laid down has almost no energy at first touch, so its energy residual is relative to the work of its
/// weight.
#[test]
fn the_energy_of_a_ball_that_is_laid_down_balances() {
    for model in ["model.fem={}", "model.condensed={}", "model.ting={}"] {
        for gap in ["start.gap='1 pm'", "start.gap='1 nm'"] {
            let laid = simulation(&[model, ELASTIC, COARSE, gap, "stop.bounces=1"]);
            let ball = laid.run(&mut ());
            assert_eq!(ball.stop(), None, "{model} {gap}");
            assert!(ball.residual_relative.unwrap() < 1e-3, "{model} {gap}");
            let warnings = laid.warnings(&ball);
            assert!(!warnings.iter().any(|text| text.contains("add up")), "{warnings:?}");
        }
    }
}

/// A ball that loses nothing never rests. Models of one degree of freedom gain nothing by rounding, and a real gain is not hidden.
#[test]
fn a_ball_that_loses_nothing_never_rests_and_says_so() {
    for model in ["model.hertz={}", "model.ting={}", "model.condensed={}", "model.law.hertz={}"] {
        let ball = run(&[model, ELASTIC, "stop.bounces=6"]);
        assert_eq!((ball.ending.clone(), ball.bounces.len()), (Ending::Parted, 6), "{model}");
        assert!(ball.is_complete() && ball.rest.is_none(), "{model}");
        // Condensed elements step in time: 1e-5.
        let most = if model == "model.condensed={}" { 1.0 + 1e-5 } else { 1.0 };
        let is_all = |e: f64| (1.0 - 1e-5..=most).contains(&e);
        assert!(
            ball.bounces.iter().all(|it| is_all(it.restitution)),
            "{model}: {:?}",
            ball.bounces
        );
        assert!(ball.warnings.iter().any(|text| text.contains("never rests")), "{model}");
    }
    assert_eq!(Ending::Parted.restitution(1.0 + 1e-12, 1.0), Some(1.0));
    assert_eq!(Ending::Parted.restitution(1.01, 1.0), Some(1.01));
}

/// So does one that falls so slowly that its flight is shorter than what is looked at of a fast one:
/// at √(g δ)/20 it is at the top after a fiftieth of the contact.
#[test]
fn a_slow_elastic_ball_leaves_as_fast_as_it_came() {
    let slow = ["body.1.approach_speed='0.4 mm/s'", "start.gap=0", "stop.bounces=3"];
    let coarse = "mesh={contact_element_size='60 um', refined_radius='300 um'}";
    for model in ["model.hertz={}", "model.condensed={}", "model.fem={}"] {
        let ball = run(&[model, ELASTIC, coarse, slow[0], slow[1], slow[2]]);
        assert_eq!((ball.ending.clone(), ball.bounces.len()), (Ending::Parted, 3), "{model}");
        for bounce in &ball.bounces {
            let flight = bounce.speed_before / G;
            assert!(flight < 0.02 * bounce.contact_time.unwrap(), "{model}: {bounce:?}");
            // The weight has done hundreds of times the energy of the fall: errors of steps show.
            assert!((bounce.restitution - 1.0).abs() < 0.1, "{model}: {bounce:?}");
        }
    }
}

/// A ball without equilibrium modulus flows into the floor without limit.
#[test]
fn a_ball_that_flows_sinks_with_a_warning() {
    for model in ["model.ting={}", "model.condensed={}", "model.fem={}"] {
        for time in ["50 us", "2 ms"] {
            let flowing = relaxing(1.0, time, "all");
            let ball = run(&[model, &flowing, COARSE, "stop.bounces=200", "start.gap='5 mm'"]);
            assert_eq!(ball.ending, Ending::AtRest, "{model} {time}");
            assert!(ball.is_complete() && ball.rest.is_none(), "{model} {time}");
            assert!(ball.warnings.iter().any(|text| text.contains("sinks")), "{model} {time}");
        }
    }
}

/// The contact tends to that without gravity, and the difference is proportional to gravity.
#[test]
fn contact_with_small_gravity_tends_to_that_without() {
    for model in ["model.ting={}", "model.condensed={}", "model.law.falcon.c=10", "model.fem={}"] {
        let at = |gravity: &str| {
            let touching = ["body.1.approach_speed=0.5", "start.gap=0"];
            run(&[model, COARSE, touching[0], touching[1], gravity, "stop={}"])
        };
        let none = {
            let text = BALL.split("\n[start]\n").next().unwrap();
            collision_of(text, &[model, COARSE, "body.1.approach_speed=0.5"])
        };
        let differences: Vec<[f64; 3]> = ["9.81", "0.0981", "1e-9"]
            .iter()
            .map(|gravity| {
                let some = at(&format!("gravity.acceleration={gravity}"));
                let share = |get: fn(&Collision) -> Option<f64>| {
                    get(&some).unwrap() / get(&none).unwrap() - 1.0
                };
                [share(|c| c.peak_force), share(|c| c.max_approach), share(|c| c.restitution)]
            })
            .collect();
        for (k, difference) in differences[0].iter().enumerate() {
            // A hundredth of the gravity has a hundredth of the influence within a tenth, beside 1e-6 by the steps.
            let hundredth = differences[1][k];
            // The peak force of explicit elements scatters by more than the weight.
            if (k, model) == (0, "model.fem={}") {
                continue;
            }
            assert!(
                (hundredth - 0.01 * difference).abs() < 1e-3 * difference.abs() + 5e-6,
                "{model} {k}: {differences:?}"
            );
            assert!(differences[2][k].abs() < 1e-6, "{model} {k}: {differences:?}");
        }
        // m g over a peak force of some newtons.
        assert!(differences[0][1] > 1e-4, "{model}: {differences:?}");
    }
}

/// Explicit and condensed elements give the same bounces.
#[test]
fn explicit_elements_bounce_as_condensed_ones() {
    let [fem, condensed] = ["model.fem={}", "model.condensed.vibration_modes=12"]
        .map(|model| run(&[model, COARSE, "start.gap='5 mm'"]));
    for (a, b) in fem.bounces.iter().zip(&condensed.bounces) {
        // Springs of explicit elements of this size: 1 % of the contact time.
        for (a, b) in [
            (a.speed_before, b.speed_before),
            (a.restitution, b.restitution),
            (a.contact_time.unwrap(), b.contact_time.unwrap()),
        ] {
            assert!((a / b - 1.0).abs() < 0.015, "{a} {b}");
        }
    }
    assert!(fem.residual_relative.unwrap() < 1e-3, "{:?}", fem.residual_relative);
    assert!(fem.momentum_residual_relative.unwrap() < 1e-9);
    // The ball fell before it touched: its highest point has, too.
    let snapshot = &fem.snapshots[0];
    assert!(snapshot.time > fem.bounces[0].time);
    let lowered = snapshot.displacement(1).iter().all(|u| u[1] < -4e-3);
    assert!(lowered, "the height of the fall is in the displacements");
}

/// A held sphere bears the ball like a wall with a curvature and a modulus, which halves E*.
#[test]
fn a_held_sphere_bears_a_ball() {
    let held = "body.0={name='post', sphere={diameter=0.03}, material='rubber', held=true}";
    let law = "model.law.kuwabara_kono.a='40 us'";
    for model in ["model.ting={}", "model.condensed={}", law, "model.fem={}"] {
        let ball = run(&[model, held, "stop.bounces=3"]);
        assert_eq!(ball.bounces.len(), 3, "{model}");
        // Explicit elements hold it to rounding.
        assert!(ball.bodies[0].velocity_after.unwrap().abs() < 1e-12, "{model}");
        assert!(ball.momentum_residual_relative.unwrap_or(0.0) < 1e-9, "{model}");
        assert!(ball.residual_relative.unwrap() < 1e-4, "{model}");
        let wall = run(&[model, "stop.bounces=3"]);
        // Hertz: T ∝ (m²/R*E*²v)^(1/5); R* = 3/5 R and half of E*.
        let expected = (4.0_f64 / 0.6).powf(0.2);
        let found = ball.contact_time.unwrap() / wall.contact_time.unwrap();
        // What relaxes in the longer contact, and the size of both spheres.
        assert!((found / expected - 1.0).abs() < 0.06, "{model}: {found} {expected}");
    }
}

/// The decision on gravity gives its numbers, and says if it acts in flight alone.
#[test]
fn the_decision_on_gravity_has_its_numbers() {
    let decision = |overrides: &[&str]| {
        let simulation = simulation(overrides);
        let collision = simulation.run(&mut ());
        let decisions = simulation.decisions(&collision);
        let found = decisions.all.into_iter().find(|decision| decision.name == "gravity");
        found.map(|decision| (decision.active, decision.reason)).unwrap()
    };
    for model in ["model.ting={}", "model.condensed={}", "model.fem={}", "model.hertz={}"] {
        let (active, reason) = decision(&[model, COARSE, "stop.bounces=1"]);
        assert!(active && reason.contains("weight / peak force = 0.0025"), "{model}: {reason}");
        assert!(!reason.contains("does not change"), "{reason}");
    }
    let hard = "material.rubber={density=1100, youngs_modulus=20e12, poissons_ratio=0.4}";
    let (active, reason) = decision(&["model.hertz={}", hard, "start.gap='10 m'"]);
    assert!(active && reason.contains("does not change the contact"), "{reason}");
}

/// A resolved case bounces to the same bits, from where the ball was dropped.
#[test]
fn a_resolved_case_falls_from_the_same_height() {
    for model in ["model.ting={}", "model.condensed={}", "model.law.falcon.c=10"] {
        let first = simulation(&[model, COARSE]);
        let again = resolved(&first);
        assert_eq!(again.run(&mut ()), first.run(&mut ()), "{model}");
        let [one, other] = [&again, &first].map(|it| it.resolved().to_toml().unwrap());
        assert_eq!(one, other, "{model}");
    }
}

/// One monitor receives the progress of all contacts in the time of the case, and can stop them.
#[test]
fn an_interrupted_ball_keeps_its_bounces() {
    struct Until(f64);
    impl Monitor for Until {
        fn report(&mut self, progress: Progress) -> bool {
            assert!((0.0..=1.0).contains(&progress.fraction));
            progress.time < self.0
        }
    }
    for model in ["model.condensed={}", "model.fem={}"] {
        let simulation = simulation(&[model, COARSE]);
        let whole = simulation.run(&mut ());
        let part = simulation.run(&mut Until(whole.bounces[1].time + 1e-4));
        assert!(part.is_interrupted(), "{model}: {:?}", part.ending);
        assert_eq!(part.bounces, whole.bounces[..1], "{model}");
        assert_eq!(part.restitution, whole.restitution, "{model}");
        let last = part.history.last().unwrap();
        assert!(last.time > whole.bounces[1].time, "{model}: {}", last.time);
    }
}

/// Meshes are refined when contacts become small, so that there are at least three quarters of the elements that the
/// tolerance needs.
#[test]
fn late_contacts_have_refined_meshes() {
    let fine = "accuracy.tolerance='0.3 %'";
    let ball = run(&["model.condensed={}", "stop.bounces=100", fine]);
    let plan = |speed: f64| {
        let speed = format!("body.1.approach_speed={speed:?}");
        let own = simulation(&["model.condensed={}", &speed, "start.gap=0", fine]);
        own.setup().elements.as_ref().unwrap().plan.contact_element_size
    };
    let (first, last) = (plan(0.99), plan(ball.bounces.last().unwrap().speed_before));
    assert!(last < 0.3 * first, "{last} {first}");
    // On the first mesh alone the last contacts have two elements across.
    let alone = |size: &str| run(&["model.condensed={}", size, "stop.bounces=25"]);
    let coarse = alone(&format!("mesh.contact_element_size={first:?}"));
    let fine = alone("mesh={contact_element_size='20 um', refined_radius='0.8 mm'}");
    // The largest of several errors, since the error vanishes for some places of the edge between two nodes.
    let time = |of: &Collision, k: usize| of.bounces[k].contact_time.unwrap();
    let of_one = |of: &Collision, k| (time(of, k) / time(&fine, k) - 1.0).abs();
    let error = |of: &Collision| (15..25).map(|k| of_one(of, k)).fold(0.0, f64::max);
    let errors = [error(&ball), error(&coarse)];
    assert!(errors[0] < 3e-3 && errors[1] > 2.0 * errors[0], "{errors:?}");
}

/// A ball that is let down softly and never leaves has a peak force above its weight, the same in every model.
#[test]
fn a_ball_that_never_leaves_sinks_in_dynamically() {
    let soft = "material.rubber={density=1000, youngs_modulus=1e6, poissons_ratio=0.45, relaxation=\
                {acts_on='all', terms=[{weight=0.5, relaxation_time='5 ms'}]}}";
    let set =
        [soft, "start.gap=0", "body.1.approach_speed='1 cm/s'", "body.1.sphere.diameter='10 cm'"];
    let run = |model: &str| run(&[&set[..], &[model]].concat());
    let reference = run("model.ting={}");
    let weight = 1000.0 * std::f64::consts::PI / 6.0 * 1e-3 * G;
    for model in ["model.condensed={}", "model.fem={}"] {
        let ball = run(model);
        let force = ball.peak_force.unwrap();
        assert!(force > weight, "{model}: {force} {weight}");
        // A contact as wide as a twelfth of the ball, whose own compliance Ting's model lacks.
        for (found, expected, what) in [
            (force, reference.peak_force.unwrap(), "F"),
            (ball.max_approach.unwrap(), reference.max_approach.unwrap(), "approach"),
        ] {
            assert!((found / expected - 1.0).abs() < 0.1, "{model}: {what} {found} {expected}");
        }
    }
}
