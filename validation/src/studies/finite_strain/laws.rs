//! Effect of finite strain: runs compared with the same collision at small strain, and with their finer meshes.
//!
//! Measures for each run all quantities of the study `summary`, and `NAME.pulse_time` and `NAME.pulse_force` of its
//! [`Pulse`]; `NAME.printed_force` is the excess of the printed peak force. For comparison with other codes it measures the
//! width at a tenth of the largest force, `NAME.width_at_tenth`, and the largest mean over a hundredth of that width,
//! `NAME.mean_force`.
//!
//! For each pair of `against` it measures the changes from the partner to the run: `NAME.time_change` (first to
//! last contact), `NAME.width_change` (of `pulse_time`), `NAME.force_change` and `NAME.printed_change` as shares,
//! `NAME.restitution_change`, and `NAME.width_slope` and `NAME.force_slope` over the partner's largest
//! contact radius over R\*.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::{
    Findings, Laboratory, Pulse, Run, StudyError, Table,
    pulse::{largest_mean, width_at_tenth},
    studies::summary,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Runs and the runs that they are compared with.
    against: BTreeMap<String, String>,
}

#[derive(Clone, Copy)]
struct Measured {
    contact_time: f64,
    pulse: Pulse,
    restitution: f64,
    printed: f64,
    /// Largest contact radius over R*.
    strain: f64,
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let Parameters { against } = laboratory.parameters()?;
    let (names, cases) = laboratory.cases()?;
    let runs = laboratory.simulate_all(cases)?;
    let mut findings = Findings::new();
    let mut pulses = BTreeMap::new();
    for (name, run) in names.into_iter().zip(&runs) {
        for (quantity, value) in summary::quantities(run) {
            findings.measure(format!("{name}.{quantity}"), value);
        }
        let measured = Measured::of(run);
        findings.measure(format!("{name}.pulse_time"), measured.pulse.time);
        findings.measure(format!("{name}.pulse_force"), measured.pulse.force);
        let printed = run.peak_force() / measured.pulse.force - 1.0;
        findings.measure(format!("{name}.printed_force"), printed);
        let (rows, width) = (&run.collision.history, width_at_tenth(&run.collision.history));
        findings.measure(format!("{name}.width_at_tenth"), width);
        findings.measure(format!("{name}.mean_force"), largest_mean(rows, 0.01 * width));
        pulses.insert(name.clone(), measured);
    }
    let pulse_of = |name: &String| {
        let known = pulses.get(name).copied();
        known.ok_or_else(|| StudyError::parameters(format!("against: there is no [run.{name}]")))
    };
    let mut rows = Vec::new();
    for (name, partner) in &against {
        let (own, base) = (pulse_of(name)?, pulse_of(partner)?);
        let change = |quantity: fn(&Measured) -> f64| quantity(&own) / quantity(&base) - 1.0;
        let [time, width] = [change(|it| it.contact_time), change(|it| it.pulse.time)];
        let force = change(|it| it.pulse.force);
        let restitution = own.restitution - base.restitution;
        let changes = [
            ("time_change", time),
            ("width_change", width),
            ("force_change", force),
            ("printed_change", change(|measured| measured.printed)),
            ("restitution_change", restitution),
            ("width_slope", width / base.strain),
            ("force_slope", force / base.strain),
        ];
        for (quantity, value) in changes {
            findings.measure(format!("{name}.{quantity}"), value);
        }
        let numbers =
            [format!("{:.3}", base.strain), percent(time), percent(width), percent(force)];
        let rest = [format!("{restitution:+.4}")];
        let slopes = [width, force].map(|change| format!("{:+.3}", change / base.strain));
        let cells = [name.clone(), partner.clone()].into_iter();
        rows.push(cells.chain(numbers).chain(rest).chain(slopes).collect());
    }
    let header =
        ["run", "against", "a/R*", "ΔT", "Δw", "ΔF", "Δe", "Δw/w over a/R*", "ΔF/F over a/R*"];
    let caption = "What changes from one run to another: contact time T, width of the pulse w, peak force F, \
                   restitution e."
        .into();
    findings.tables.push(Table { caption, header: header.map(String::from).to_vec(), rows });
    Ok(findings)
}

fn percent(share: f64) -> String {
    format!("{:+.3} %", 100.0 * share)
}

impl Measured {
    fn of(run: &Run) -> Self {
        Self {
            contact_time: run.contact_time(),
            pulse: Pulse::of(&run.collision.history, run.contact_time()),
            restitution: run.restitution,
            printed: run.peak_force(),
            strain: run.max_contact_radius() / run.hertz.pair().effective_radius(),
        }
    }
}
