//! Rows of a history between the steps.

use crate::common::{GLASS, Scene, material};
use fem_collision::{Account, Collision, HistoryRow, OutputRequest};
use fem_material::ActsOn::All;

fn collide(n_steps: usize) -> Collision {
    let glass = material(GLASS, All, &[(1.0, 2708.0)]);
    let scene = Scene::paper(glass.clone(), glass);
    let pair = scene.condensed(6.0);
    let frame = pair.frame(scene.speed).unwrap();
    pair.collide(&frame, pair.relaxations(), n_steps, &OutputRequest::history(), &mut ()).unwrap()
}

/// About a thousand over the contact, however few steps there are, begin and end of the contact among them.
#[test]
fn history_has_about_1000_rows_for_any_number_of_steps() {
    for n_steps in [125, 250, 333, 1000, 3000] {
        let run = collide(n_steps);
        let last = run.last_contact.unwrap();
        let within = run.history.iter().filter(|row| row.time <= last).count();
        assert!((660..=1500).contains(&within), "{n_steps}: {within}");
        assert!(run.history.windows(2).all(|two| two[0].time < two[1].time));
        let is_end =
            |row: &HistoryRow| (row.time - last).abs() < 1e-12 * last && row.contact_force == 0.0;
        assert!(run.history.iter().any(is_end), "{n_steps}");
        assert_eq!(run.history[0].time, 0.0);
    }
}

/// Between steps rows are those of many steps, and their energies add up to what they say.
#[test]
fn rows_between_steps_are_those_of_more_steps() {
    let (few, many) = (collide(250), collide(4000));
    let end = many.last_contact.unwrap();
    let at = |time: f64| {
        let after = many.history.partition_point(|row| row.time < time);
        let [a, b] = [&many.history[after - 1], &many.history[after]];
        let part = (time - a.time) / (b.time - a.time);
        move |get: &dyn Fn(&HistoryRow) -> f64| (1.0 - part) * get(a) + part * get(b)
    };
    let peak = many.peak_force.unwrap();
    let [radius, pressure, approach] =
        [many.max_contact_radius, many.peak_pressure, many.max_approach].map(Option::unwrap);
    let initial = many.initial_energy.unwrap();
    type Column = (&'static str, f64, f64, fn(&HistoryRow) -> f64);
    let columns: [Column; 6] = [
        // It bends where a node joins, which a parabola rounds off: 4e-4.
        ("force", peak, 6e-4, |row| row.contact_force),
        // Both leap a little there.
        ("radius", radius, 1e-2, |row| row.contact_radius.unwrap()),
        ("pressure", pressure, 2e-2, |row| row.centre_pressure.unwrap()),
        ("approach", approach, 5e-6, |row| row.approach),
        ("velocity", 0.5, 2e-5, |row| row.velocity[0]),
        ("strain", initial, 2e-5, |row| row.energy(Account::Strain).unwrap()),
    ];
    // Without the first and last facet.
    for row in few.history.iter().filter(|row| row.time > 0.015 * end && row.time < 0.985 * end) {
        let expected = at(row.time);
        for (name, scale, allowed, get) in columns {
            let error = (get(row) - expected(&get)).abs() / scale;
            assert!(error < allowed, "{name} at {:e}: {error:e}", row.time / end);
        }
    }
    let of_motion = [Account::Kinetic, Account::Strain, Account::ViscousDissipation];
    for row in &few.history {
        let sum: f64 = of_motion.iter().map(|account| row.energy(*account).unwrap()).sum();
        assert!((sum - initial - row.residual.unwrap()).abs() < 1e-12 * initial);
        assert!(
            row.residual.unwrap().abs() <= 2e-5 * initial,
            "{:e}",
            row.residual.unwrap() / initial
        );
    }
}
