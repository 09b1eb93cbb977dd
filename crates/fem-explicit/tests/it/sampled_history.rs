//! Sampled quantities of a run do not depend on whether its rows are kept.

use crate::common::{HERTZ_TIME, Pair};
use fem_collision::{Collision, Expectation, OutputRequest, Stop};
use fem_explicit::{ExplicitBodies, collide};
use fem_material::ActsOn;

/// Elastic, and relaxing in shear.
fn pairs() -> [Pair; 2] {
    let relaxation = Some(ActsOn::Shear);
    [Pair::small(), Pair { relaxation, terms: &[(0.3, 2e-5), (0.5, 1e-3)], ..Pair::small() }]
}

/// All but the rows; numbers are printed so that they read back to the same bits.
fn but_rows(run: &Collision) -> String {
    format!("{:?}", Collision { history: Vec::new(), ..run.clone() })
}

/// Runs a model for so many rows.
fn run_for(
    model: &ExplicitBodies,
    expected: Expectation,
    request: OutputRequest,
    history_rows: usize,
) -> Collision {
    collide(model, expected, &OutputRequest { history_rows, ..request }, &mut ())
}

#[test]
fn quantities_are_those_of_a_run_with_history() {
    for pair in pairs() {
        let model = pair.model();
        let whole = collide(&model, pair.expected(), &OutputRequest::history(), &mut ());
        let bare = collide(&model, pair.expected(), &OutputRequest::quantities(), &mut ());
        assert!(whole.history.len() > 1000 && bare.history.is_empty());
        assert_eq!(but_rows(&bare), but_rows(&whole));
        for history_rows in [1, 100, 100_000] {
            let other = run_for(&model, pair.expected(), OutputRequest::history(), history_rows);
            assert!(!other.history.is_empty());
            assert_eq!(but_rows(&other), but_rows(&whole), "{history_rows} rows");
        }
    }
}

/// Runs that stop, and one that takes so much longer than expected that instants are given up.
#[test]
fn quantities_of_stopped_and_overlong_runs_need_no_history() {
    let (outgrown, endless) = (Pair::outgrown(), Pair::endless());
    for (pair, contact_time) in
        [(&outgrown, HERTZ_TIME), (&endless, HERTZ_TIME), (&Pair::small(), HERTZ_TIME / 1e3)]
    {
        let model = pair.model();
        let expected = Expectation { contact_time, ..pair.expected() };
        let request = OutputRequest {
            max_contact_times: pair.max_time / contact_time,
            ..OutputRequest::history()
        };
        let whole = run_for(&model, expected, request.clone(), 1000);
        assert_eq!(whole.is_complete(), contact_time < HERTZ_TIME);
        for history_rows in [0, 30, 3000] {
            let other = run_for(&model, expected, request.clone(), history_rows);
            assert_eq!(but_rows(&other), but_rows(&whole), "{history_rows} rows");
            // The state where it stopped is the last row, whenever one was due.
            if let Some(row) = other.history.last() {
                assert_eq!(Some(row.time), whole.history.last().map(|row| row.time));
                assert_eq!(Some(row.residual), Some(other.residual));
                assert_eq!(row.energies, other.energies);
            }
        }
        assert!(!matches!(whole.stop(), Some(Stop::EnergyGrowth { .. })));
    }
}

/// Rows between the instants that are observed lie on the same curves.
#[test]
fn more_rows_show_the_same_run() {
    let pair = Pair { relaxation: Some(ActsOn::All), step_factor: 0.3, ..Pair::small() };
    let model = pair.model();
    let few = run_for(&model, pair.expected(), pair.request(), 1000).history;
    let many = run_for(&model, pair.expected(), pair.request(), 5000).history;
    assert!(many.len() > 3 * few.len(), "{} {}", many.len(), few.len());
    assert!(many.windows(2).all(|two| two[0].time < two[1].time));
    let common = few.iter().filter(|row| many.contains(row)).count();
    // At strides of 5 and 1 steps.
    assert_eq!(common, few.len());
    let dissipated = |k: usize| many[k].energy(fem_collision::Account::ViscousDissipation).unwrap();
    assert!((1..many.len()).all(|k| dissipated(k) >= dissipated(k - 1)));
}
