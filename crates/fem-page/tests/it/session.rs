//! A session gives the same results as `fem::Simulation`, whatever it computed before, and its messages say
//! what is wrong.

use std::path::Path;

use fem::{Case, Simulation};
use fem_page::{CaseFault, RecordedAmount, RunOutcome, Session};

pub const GLASS: &str = include_str!("../../../../cases/glass_0.5ms.toml");
const WALL: &str = include_str!("../../../../cases/glass_on_wall.toml");
pub const CONDENSED: &str = "\n[model]\ncondensed = {}\n";
const ASK: RecordedAmount = RecordedAmount { rows: 300, frames: 5 };

/// Runs a case to its end.
pub fn run(session: &mut Session, text: &str, ask: RecordedAmount) -> RunOutcome {
    session.begin(text, ask).expect("a case that runs");
    while session.advance(1) < 1.0 {}
    session.finish(0.5).expect("a run")
}

fn fault(text: &str) -> CaseFault {
    Session::default().begin(text, ASK).expect_err("a fault").into()
}

/// The results have the same bits as the command's, also after other cases and after unfinished ones.
#[test]
fn session_results_equal_the_simulation_after_any_earlier_runs() {
    let mut session = Session::default();
    let text = GLASS.to_string() + CONDENSED;
    for other in [&text.replace("22.2 mm", "10 mm"), &text.replace("0.5 m/s\"", "3 m/s\""), &text] {
        run(&mut session, other, ASK);
    }
    for text in [&text, &(WALL.to_string() + CONDENSED)] {
        let outcome = run(&mut session, text, ASK);
        let case = Case::parse("x", text, Path::new("."), &[]).unwrap();
        let simulation = Simulation::new(case).unwrap();
        let direct = simulation.summary(&simulation.run(&mut ()));
        let of = |summary: &fem::Summary| {
            let value = serde_json::to_value(summary).unwrap();
            ["restitution", "contact_time_s", "peak_force_n", "max_approach_m", "energy", "effects"]
                .map(|key| value[key].clone())
        };
        assert_eq!(of(&outcome.summary), of(&direct));
        assert_eq!(outcome.summary.cost.solve_s, 0.5);
    }
}

/// By König's theorem the rebound keeps e² of the energy of the relative motion, and the energy of the
/// common motion is that of the mass centre: checked by hand for unequal spheres and for a wall. The shares
/// sum to the initial energy.
#[test]
fn the_rebound_is_the_square_of_the_restitution() {
    for (text, common) in [(GLASS, 13.691_639 / 18.721_870), (WALL, 0.0)] {
        for model in ["condensed", "fem", "ting"] {
            let text = format!("{text}\n[model]\n{model} = {{}}\n");
            let RunOutcome { summary, sharing, .. } = run(&mut Session::default(), &text, ASK);
            let sharing = sharing.expect("two bodies and nothing else");
            let (name, rebound) = sharing.parts[0];
            assert_eq!(name, "rebound");
            let restitution = summary.collision.restitution.unwrap();
            let whole = sharing.common_j + sharing.relative_j;
            assert!((rebound / sharing.relative_j / restitution.powi(2) - 1.0).abs() < 1e-9);
            // The masses are written with seven digits.
            assert!((sharing.common_j / whole - common).abs() < 1e-7, "{sharing:?}");
            let parts: f64 = sharing.parts.iter().map(|(_, energy)| energy).sum();
            // Explicit runs with penalty contacts leave 1e-4 of the energy unaccounted for.
            assert!((parts / sharing.relative_j - 1.0).abs() < 1e-3, "{model}: {sharing:?}");
        }
    }
}

/// Glass that relaxes within a microsecond does not rebound. All energy that could be lost is heat, and no
/// contact time is reported.
#[test]
fn bodies_that_stay_together_have_no_contact_time() {
    let text = GLASS.replace("2708 1/s", "1e6 1/s") + CONDENSED;
    let RunOutcome { summary, sharing, .. } = run(&mut Session::default(), &text, ASK);
    assert_eq!(
        (summary.collision.restitution, summary.collision.contact_time_s),
        (Some(0.0), None)
    );
    assert!(summary.warnings.iter().any(|warning| warning.contains("stay together")));
    let of_time = summary.warnings.iter().find(|warning| warning.contains("contact time"));
    assert_eq!(of_time, None);
    let sharing = sharing.unwrap();
    assert!(sharing.parts[0].1 < 1e-6 * sharing.relative_j, "{sharing:?}");
}

#[test]
fn session_errors_have_key_line_and_help() {
    let negative = fault(&GLASS.replace("22.2 mm\" }", "-1 mm\" }"));
    assert_eq!(negative.key.as_deref(), Some("body.0.sphere.diameter"));
    assert_eq!((negative.line, negative.column), (Some(20), Some(23)));
    assert!(negative.help.unwrap().contains("greater than 0"));

    let third =
        "\n[[body]]\nname = \"third\"\nsphere = { diameter = 1e-2 }\nmaterial = \"glass\"\n";
    let three = fault(&(GLASS.to_string() + third));
    assert!(three.text.contains("body") && three.message.contains('3'), "{}", three.text);

    let both = GLASS.replace("22.2 mm\" }", "-1 mm\" }").replace("0.244", "0.9");
    let both = fault(&both);
    assert_eq!(both.others.len(), 1, "{both:?}");
    assert!(!both.text.contains(&both.others[0].message));

    let mesh = fault(include_str!("../../../../cases/glass_0.5ms_14um.toml"));
    assert_eq!(mesh.key.as_deref(), Some("body.0.sphere.mesh"));
    assert!(!fault("title = [").text.is_empty());
}

/// A browser has less memory than the plan allows; the case can set a higher limit.
#[test]
fn case_beyond_the_browser_memory_limit_is_rejected() {
    let fine = GLASS.to_string() + "[mesh]\ncontact_element_size = \"2 um\"\n" + CONDENSED;
    let fault = fault(&fine);
    assert!(fault.text.contains("limits.memory"), "{}", fault.text);
    let own = GLASS.to_string() + "[limits]\nmemory = \"10 kB\"\n" + CONDENSED;
    assert!(Session::default().begin(&own, ASK).is_err());
}

/// A run that the reader ends is reported as far as it got; nothing is computed afterwards.
#[test]
fn run_finished_early_is_reported_as_incomplete() {
    let mut session = Session::default();
    let begun = session.begin(GLASS, ASK).unwrap();
    assert!(begun.price.element_updates.is_some_and(|updates| updates > 1_000_000));
    while session.advance(1) < 0.3 {}
    let outcome = session.finish(1.0).unwrap();
    assert!(!outcome.summary.complete && outcome.summary.collision.restitution.is_none());
    assert!(outcome.charts.force.is_some_and(|svg| svg.contains("this run")));
    assert!(session.finish(1.0).is_none() && session.advance(1) == 1.0);
}

/// An invalid case discards the case before it.
#[test]
fn invalid_case_discards_the_case_before_it() {
    let mut session = Session::default();
    session.begin(GLASS, ASK).unwrap();
    assert!(session.begin("title = 1", ASK).is_err());
    assert!(session.finish(0.0).is_none() && session.picture(0, 2.0).is_none());
}

/// A request for more frames than a run keeps is rejected with a message.
#[test]
fn more_frames_than_a_run_keeps_are_refused() {
    let ask = RecordedAmount { frames: 100_000_000, ..ASK };
    let error = Session::default().begin(GLASS, ask).unwrap_err();
    assert!(error.message().contains("snapshots"), "{error}");
}
