//! Effect of slip between the surfaces of unlike bodies: each run of the claim is computed with it, which is the
//! default, and without.
//!
//! `NAME.QUANTITY` is the relative change by the slip; `NAME.restitution` is |Δe|, and
//! `NAME.energy_residual` the largest energy residual with slip.

use std::sync::Arc;

use fem_case::Switch;
use fem_case::schema::EffectsTable;

use crate::{Findings, Laboratory, Run, StudyError};

/// Name and value of a quantity.
type Quantity = (&'static str, fn(&Run) -> f64);

const RELATIVE: [Quantity; 4] = [
    ("contact_time", |run| run.contact_time()),
    ("peak_force", |run| run.peak_force()),
    ("max_approach", |run| run.max_approach()),
    ("peak_pressure", |run| run.peak_pressure()),
];

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let (names, own) = laboratory.cases()?;
    let mut cases = Vec::new();
    for case in own {
        let without = case.edited(|file| {
            let effects = file.effects.get_or_insert_default();
            *effects = EffectsTable { surface_slip: Some(Switch::Off), ..*effects };
        })?;
        cases.extend([case, without]);
    }
    let runs = laboratory.simulate_all(cases)?;
    let pairs: Vec<_> = runs.chunks_exact(2).map(|two| (&two[0], &two[1])).collect();
    let mut findings = Findings::new();
    for (name, (with, without)) in names.iter().zip(&pairs) {
        for (quantity, value) in RELATIVE {
            findings.measure(format!("{name}.{quantity}"), value(with) / value(without) - 1.0);
        }
        let restitution = (with.restitution - without.restitution).abs();
        findings.measure(format!("{name}.restitution"), restitution);
        findings.measure(format!("{name}.energy_residual"), with.energy_residual());
    }
    tabulate(&mut findings, &names, &pairs);
    Ok(findings)
}

fn tabulate(findings: &mut Findings, names: &[&String], pairs: &[(&Arc<Run>, &Arc<Run>)]) {
    let rows = names.iter().zip(pairs).map(|(name, (with, without))| {
        let [time, force, approach, pressure] = RELATIVE
            .map(|(_, value)| format!("{:+.3} %", 100.0 * (value(with) / value(without) - 1.0)));
        let restitution = format!("{:.1e}", with.restitution - without.restitution);
        [name.to_string(), restitution, time, force, approach, pressure]
    });
    let header = ["run", "Δe", "contact time", "force", "approach", "p0"];
    findings.tabulate("Changes by the slip; all except Δe are relative.", header, rows);
}
