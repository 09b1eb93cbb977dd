//! Invariance of results under exchange of the bodies, a common velocity and the choice of units.
//!
//! Each run of the claim is compared with the run `plain` in dimensionless numbers: the restitution, and
//! all other quantities over Hertz' values of the run itself. `NAME.difference` is the largest relative
//! difference of results, and of the contact force in any row of the history over the peak;
//! `NAME.pressure` that of the largest pressure, which is read at the nodes of one body.

use fem_collision::nan_aware_max_abs;

use crate::{Findings, Laboratory, Run, StudyError};

const REFERENCE: &str = "plain";

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let (names, cases) = laboratory.cases()?;
    let runs = laboratory.run_all(cases)?;
    let Some(plain) = names.iter().position(|name| *name == REFERENCE) else {
        return Err(StudyError::parameters(format!("the claim has no [run.{REFERENCE}]")));
    };
    let mut findings = Findings::new();
    for (name, run) in names.iter().zip(&runs).filter(|(name, _)| **name != REFERENCE) {
        findings.measure(format!("{name}.difference"), difference(run, &runs[plain]));
        let [ours, theirs] = [run, &runs[plain]].map(|run| run.pressure_over_hertz_at_force());
        findings.measure(format!("{name}.pressure"), (ours / theirs - 1.0).abs());
    }
    Ok(findings)
}

/// Results without unit.
fn results(run: &Run) -> [f64; 6] {
    let hertz = &run.hertz;
    let [lower, upper] = run.velocity_after();
    [
        run.restitution,
        run.contact_time() / hertz.contact_time(),
        run.peak_force() / hertz.peak_force(),
        run.max_approach() / hertz.max_approach(),
        run.max_contact_radius() / hertz.max_contact_radius(),
        (upper - lower) / hertz.approach_speed(),
    ]
}

/// Returns the contact forces over the peak, from the first to the last contact. After it, rounding
/// may decide whether the run continues for another step.
fn forces(run: &Run) -> Vec<f64> {
    let last = run.collision.last_contact.unwrap_or(f64::NAN);
    let rows = run.collision.history.iter().take_while(|row| row.time <= last);
    rows.map(|row| row.contact_force / run.peak_force()).collect()
}

/// Returns the largest difference of the histories; NaN if their numbers of rows differ.
fn difference(run: &Run, plain: &Run) -> f64 {
    let (ours, theirs) = (forces(run), forces(plain));
    if ours.len() != theirs.len() || ours.is_empty() {
        return f64::NAN;
    }
    let forces = ours.iter().zip(&theirs).map(|(ours, theirs)| (ours - theirs).abs());
    let results = results(run).into_iter().zip(results(plain));
    let all = forces.chain(results.map(|(ours, theirs)| (ours / theirs - 1.0).abs()));
    all.fold(0.0, nan_aware_max_abs)
}
