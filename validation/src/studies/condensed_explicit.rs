//! Condensed bodies against the explicit model with the same meshes, materials and springs.
//!
//! Each run of the claim is computed twice, and `NAME.QUANTITY` is the difference of the two over
//! the explicit value; `NAME.restitution` is |Δe|. `worst.QUANTITY` is the largest of all runs.
//!
//! The explicit force is noisy when nodes touch first and last, which changes the contact time. So
//! the duration is measured between the instants at which the approach rate has lost half of its value during
//! compression and gained half of its final value during restitution: a velocity is an integral of the force.

use std::sync::Arc;

use fem::Plan;
use fem_case::schema::{CondensedTable, ContactTable, SnapshotsValue, TimeTable};
use fem_collision::{Collision, HistoryRow};
use serde::Deserialize;

use crate::{Findings, Laboratory, Run, StudyError};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Elements across Hertz' contact radius.
    elements_per_contact_radius: f64,
    contact: ContactTable,
    time: TimeTable,
    /// Keys of the condensed model.
    condensed: CondensedTable,
}

type Quantity = (&'static str, fn(&Run) -> f64);

const RELATIVE: [Quantity; 5] = [
    ("pulse_width", pulse_width),
    ("max_approach", |run| run.max_approach()),
    ("max_contact_radius", |run| run.max_contact_radius()),
    ("peak_force", |run| run.peak_force()),
    ("peak_pressure", |run| run.peak_pressure()),
];

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let (names, own) = laboratory.cases()?;
    let mut cases = Vec::new();
    for case in own {
        let size =
            Plan::of_case(&case)?.estimate.contact_radius / parameters.elements_per_contact_radius;
        let explicit = case.edited(|file| {
            file.contact = Some(parameters.contact.clone());
            file.time = Some(parameters.time.clone());
            file.output.get_or_insert_default().snapshots = Some(SnapshotsValue::none());
            file.mesh.get_or_insert_default().contact_element_size = Some(size.into());
        })?;
        cases.push(explicit.clone());
        let condensed = parameters.condensed.clone().into();
        cases.push(explicit.edited(|file| file.model = Some(condensed))?);
    }
    let runs = laboratory.simulate_all(cases)?;
    let pairs: Vec<_> = runs.chunks_exact(2).map(|two| (&two[0], &two[1])).collect();
    let mut findings = Findings::new();
    for (name, (explicit, condensed)) in names.iter().zip(&pairs) {
        let mut measure = |quantity: &str, difference: f64| {
            findings.measure(format!("{name}.{quantity}"), difference);
            findings.measure_worst(&format!("worst.{quantity}"), difference);
        };
        measure("restitution", (condensed.restitution - explicit.restitution).abs());
        for (quantity, value) in RELATIVE {
            measure(quantity, (value(condensed) / value(explicit) - 1.0).abs());
        }
    }
    tabulate(&mut findings, &names, &pairs);
    Ok(findings)
}

/// Returns the width of the pulse, s; NaN if the approach rate does not pass both instants.
fn pulse_width(run: &Run) -> f64 {
    let speed = run.hertz.approach_speed();
    let passes = |rate: f64| passes(&run.collision, rate);
    passes(-0.5 * run.restitution * speed) - passes(0.5 * speed)
}

/// Returns the time at which the approach rate falls through a value (m/s), s.
fn passes(collision: &Collision, value: f64) -> f64 {
    let rate = |row: &HistoryRow| row.velocity[0] - row.velocity[1];
    let is_around = |two: &&[HistoryRow]| rate(&two[0]) > value && rate(&two[1]) <= value;
    collision.history.windows(2).find(is_around).map_or(f64::NAN, |two| {
        let part = (rate(&two[0]) - value) / (rate(&two[0]) - rate(&two[1]));
        two[0].time + part * (two[1].time - two[0].time)
    })
}

fn tabulate(findings: &mut Findings, names: &[&String], pairs: &[(&Arc<Run>, &Arc<Run>)]) {
    let rows = names.iter().zip(pairs).map(|(name, (explicit, condensed))| {
        let differences =
            RELATIVE.map(|(_, value)| format!("{:.1e}", value(condensed) / value(explicit) - 1.0));
        let [width, approach, radius, force, pressure] = differences;
        [
            name.to_string(),
            format!("{:.6}", explicit.restitution),
            format!("{:.1e}", condensed.restitution - explicit.restitution),
            width,
            approach,
            radius,
            force,
            pressure,
        ]
    });
    let header =
        ["run", "explicit e", "Δe", "pulse width", "approach", "contact radius", "force", "p0"];
    findings.tabulate(
        "Differences of condensed bodies from the explicit model; all except Δe are relative.",
        header,
        rows,
    );
}
