//! Measures the quantities of [`summary`](super::summary) and those of plastic flow.
//!
//! * `NAME.plastic_work_share`, the plastic work over the initial kinetic energy;
//! * `NAME.dent_depth` of the first body that flowed, m; NaN without a dent;
//! * `NAME.AT.force` (N), `NAME.AT.mean_pressure` (Pa) for each `approach.NAME.AT` of the parameters, m: means of F and
//!   F/πa² over the samples of the loading within 4 % of that approach.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use fem::results::dents;
use fem::{Account, HistoryRow, Simulation};
use serde::Deserialize;

use super::summary::quantities;
use crate::{Findings, Laboratory, StudyError};

/// Half of the width of a window of the loading, over its approach. Nodes that join the contact change the force of
/// single samples.
const WINDOW: f64 = 0.04;

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Approaches by the names of run and window, m.
    #[serde(default)]
    approach: BTreeMap<String, BTreeMap<String, f64>>,
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let Parameters { approach } = laboratory.parameters()?;
    let (names, cases) = laboratory.cases()?;
    let runs = laboratory.simulate_all(cases)?;
    let mut findings = Findings::new();
    for (name, run) in names.iter().zip(&runs) {
        let collision = &run.collision;
        let known = |value: Option<f64>| value.unwrap_or(f64::NAN);
        let work = known(collision.energies.get(Account::PlasticWork));
        let dents = dents(&Simulation::new(run.case.clone())?, collision);
        let depth = known(dents.first().and_then(|(_, dent, _)| dent.depth_m));
        let flow =
            [("plastic_work_share", work / known(collision.initial_energy)), ("dent_depth", depth)];
        for (quantity, value) in quantities(run).chain(flow) {
            findings.measure(format!("{name}.{quantity}"), value);
        }
        for (at, &approach) in approach.get(*name).into_iter().flatten() {
            let [force, pressure] = loading(&collision.history, approach);
            findings.measure(format!("{name}.{at}.force"), force);
            findings.measure(format!("{name}.{at}.mean_pressure"), pressure);
        }
    }
    Ok(findings)
}

/// Returns the means of force (N) and mean pressure (Pa) about an approach (m) before the largest one; NaN without samples.
fn loading(history: &[HistoryRow], approach: f64) -> [f64; 2] {
    let deepest = history.iter().map(|row| row.approach).fold(0.0, f64::max);
    let rows = history.iter().take_while(|row| row.approach < deepest);
    let within = rows.filter(|row| (row.approach / approach - 1.0).abs() < WINDOW);
    let (mut n, mut sums) = (0.0, [0.0; 2]);
    for row in within {
        let area = PI * row.contact_radius.unwrap_or(f64::NAN).powi(2);
        n += 1.0;
        sums[0] += row.contact_force;
        sums[1] += row.contact_force / area;
    }
    sums.map(|sum| sum / n)
}
