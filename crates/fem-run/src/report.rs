//! The result on stdout: for people. Numbers for programs are in the summary.

use std::fmt::Write;
use std::path::Path;

use comfy_table::CellAlignment::{Left, Right};
use fem::effects::{LeftOut, Verdict};
use fem::results::{BodySummary, Summary};
use fem::{Considered, ExpectedError};
use fem_case::engineering::{Unit, number, show};
use fem_collision::{Headline, Shown, Side};
use indicatif::{DecimalBytes, HumanCount};

use crate::bounces::bounces;
use crate::standard_output::one_line;
use crate::tables::table;
use crate::uncertainty::{columns, legend};

/// Shown for a number that there is not.
const NONE: &str = "-";
/// A restitution this near to 1 is told by what is missing.
const NEARLY_ELASTIC: f64 = 1e-3;

/// The report of a run whose files are in `place`, if there are any.
pub fn report(summary: &Summary, place: Option<&Path>) -> String {
    let mut text = String::new();
    let title = summary.case.title.as_deref().unwrap_or_default();
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{}\n", one_line(title));
    if let Some(reason) = &summary.stopped_because {
        let _ = writeln!(text, "INCOMPLETE: {reason}\n");
    }
    text += &quantities(summary);
    if let Some(deficit) = elastic_deficit(summary.collision.restitution) {
        let _ = writeln!(text, "\n1 - restitution  {deficit}");
    }
    if summary.contact_episodes > 1 {
        let _ = writeln!(
            text,
            "\ncontact episodes  {} (the surfaces may part for a few steps at first and last touch)",
            summary.contact_episodes
        );
    }
    if let Some(contacts) = &summary.bounces {
        let _ = writeln!(text, "\n{}", bounces(contacts, summary.rest.as_ref()));
    } else {
        text += "\n";
    }
    let _ = writeln!(text, "{}", bodies(&summary.bodies));
    text += &balances(summary);
    if let Some(considered) = &summary.models_considered {
        let _ = write!(text, "\nModels, and what they are off by\n{}", models(considered));
    }
    let _ = writeln!(
        text,
        "\nEffects\n{}",
        effects(summary.effects.iter().map(|effect| &effect.verdict))
    );
    text += &warnings(&summary.warnings);
    let place = place.map_or("not written".into(), |place| one_line(&place.display().to_string()));
    let _ = writeln!(text, "\nResult: {place}");
    text
}

/// Each quantity with what it may be off by, beside Hertz.
fn quantities(summary: &Summary) -> String {
    let (ours, hertz) = (&summary.collision, &summary.hertz);
    let has_elements = summary.bodies.iter().any(|body| body.elements.is_some());
    let own = if has_elements { "± mesh" } else { "± numerics" };
    let header = ["", "this run", own, "± left out", "Hertz", "ratio"].map(String::from);
    let row = |headline: Headline| {
        let (value, theirs) = (ours.number(headline), hertz.number(headline));
        let has_unit = headline != Headline::Restitution;
        let unit =
            has_unit.then(|| Unit::fitting(theirs.or(value).unwrap_or_default(), headline.unit()));
        let shown = |value: Option<f64>| match (value, &unit) {
            (None, _) => NONE.into(),
            (Some(value), Some(unit)) => unit.show(value),
            (Some(value), None) => format!("{value:.4}"),
        };
        let parts = summary.uncertainty.parts(headline);
        let errors = value.map(|value| columns(value, &parts, unit.as_ref()));
        let [mesh, left_out] = errors.unwrap_or([NONE, NONE].map(String::from));
        let ratio = value.zip(theirs).map_or(NONE.into(), |(a, b)| format!("{:.4}", a / b));
        [headline.name().into(), shown(value), mesh, left_out, shown(theirs), ratio]
    };
    let rows = std::iter::once(header).chain(Headline::ALL.map(row));
    let table = table(&[Left, Right, Right, Right, Right, Right], rows);
    let legend = legend(own, &table);
    format!("{table}\n{legend}\n")
}

fn elastic_deficit(restitution: Option<f64>) -> Option<String> {
    let deficit = 1.0 - restitution?;
    (deficit.abs() < NEARLY_ELASTIC).then(|| number(deficit, 3))
}

fn bodies(bodies: &[BodySummary]) -> String {
    let header = ["body", "elements", "mass", "before", "after", "vibration"].map(String::from);
    let quantity = |value: Option<f64>, unit: &str| value.map_or(NONE.into(), |v| show(v, unit));
    let speeds = bodies.iter().flat_map(|body| [body.velocity_before_m_s, body.velocity_after_m_s]);
    let fastest = speeds.flatten().fold(0.0, |fastest: f64, speed| fastest.max(speed.abs()));
    let speed_unit = Unit::fitting(fastest, "m/s");
    let speed = |value: Option<f64>| value.map_or(NONE.into(), |speed| speed_unit.show(speed));
    let row = |body: &BodySummary| {
        [
            body.name.clone(),
            body.elements.map_or(NONE.into(), |n| HumanCount(n as u64).to_string()),
            quantity(body.mass_kg.map(|mass| 1e3 * mass), "g"),
            speed(body.velocity_before_m_s),
            speed(body.velocity_after_m_s),
            quantity(body.vibration_energy_j, "J"),
        ]
    };
    let rows = std::iter::once(header).chain(bodies.iter().map(row));
    table(&[Left, Right, Right, Right, Right, Right], rows)
}

fn balances(summary: &Summary) -> String {
    let residual = |value: Option<f64>| value.map_or(NONE.into(), |value| number(value, 2));
    let book = summary.energy.accounts.0;
    let dissipated = book.total(Side::Lost);
    let of_effects = book.entries().filter(|(account, _)| account.shown() == Shown::WhereFilled);
    let of_effects = of_effects.map(|(account, energy)| {
        format!("; {} {}", account.name().replace('_', " "), show(energy, "J"))
    });
    let raw = summary.peak_force_raw_n.map(|force| {
        let text = format!(
            "means over 1/64 of the pulse, radius and pressure {}; force of a single step {}",
            summary.radius_and_pressure,
            show(force, "N")
        );
        ["peaks".to_string(), text]
    });
    let null = summary.elastic_null.map(|null| {
        let lost = null.one_minus_restitution;
        let how = match null.estimated {
            true => "estimated",
            false => "by a coarser run without it",
        };
        let text = format!(
            "with relaxation off these settings lose {} of the restitution ({how})",
            number(lost, 1)
        );
        ["elastic null".to_string(), text]
    });
    let rows = [
        [
            "energy".to_string(),
            format!(
                "residual {} of the initial; dissipated {}{}",
                residual(summary.energy.residual_relative),
                dissipated.map_or(NONE.into(), |energy| show(energy, "J")),
                of_effects.collect::<String>(),
            ),
        ],
        ["momentum".into(), format!("residual {}", residual(summary.momentum_residual_relative))],
        ["cost".into(), price(summary)],
    ];
    table(&[Left, Left], raw.into_iter().chain(null).chain(rows))
}

fn price(summary: &Summary) -> String {
    let cost = &summary.cost;
    let memory = cost.peak_memory_bytes.map(|bytes| format!(", {}", DecimalBytes(bytes)));
    let memory = memory.unwrap_or_default();
    let Some(steps) = summary.steps else {
        return format!("{}{memory}", show(cost.solve_s, "s"));
    };
    let (solve, each) = match cost.ns_per_element_update {
        Some(ns) => (show(cost.solve_s, "s"), format!("{ns:.1} ns an element update, ")),
        None => (show(cost.solve_s, "s"), format!("after {} of setup, ", show(cost.setup_s, "s"))),
    };
    let trials = (cost.trials_s > 0.1 * cost.solve_s)
        .then(|| format!(", after {} of trials", show(cost.trials_s, "s")));
    let kept = cost.factor_bytes.filter(|bytes| *bytes > 0);
    let factors = kept.map(|bytes| format!(", {} of it factors", DecimalBytes(bytes)));
    format!(
        "{solve} for {} steps of {} ({each}{} thread{}{memory}{}){}",
        HumanCount(steps),
        summary.time_step_s.map_or(NONE.into(), |step| show(step, "s")),
        cost.threads,
        if cost.threads == 1 { "" } else { "s" },
        factors.unwrap_or_default(),
        trials.unwrap_or_default(),
    )
}

/// Which models were considered, what they are expected to be off by, and why one was chosen.
pub fn models(considered: &[Considered]) -> String {
    let header = ["", "model", "restitution", "contact time", "peak force", "peak pressure", ""]
        .map(String::from);
    let row = |considered: &Considered| {
        let ExpectedError { restitution, contact_time_s, peak_force_n, peak_pressure_pa } =
            considered.error;
        let [restitution, time, force] =
            changes(&LeftOut { restitution, contact_time_s, peak_force_n });
        let pressure = change(peak_pressure_pa, &|change| show(change, "Pa"));
        let mark = if considered.chosen { "takes" } else { "" };
        let model = considered.model.to_string();
        [mark.to_string(), model, restitution, time, force, pressure, considered.reason.clone()]
    };
    let rows = std::iter::once(header).chain(considered.iter().map(row));
    table(&[Left, Left, Right, Right, Right, Right, Left], rows)
}

/// Changes of restitution, contact time and peak force.
pub fn changes(changes: &LeftOut) -> [String; 3] {
    let LeftOut { restitution, contact_time_s, peak_force_n } = *changes;
    [
        change(restitution, &|change| number(change, 2)),
        change(contact_time_s, &|change| show(change, "s")),
        change(peak_force_n, &|change| show(change, "N")),
    ]
}

/// What a quantity changes by, "?" where nothing tells.
fn change(change: Option<f64>, show: &dyn Fn(f64) -> String) -> String {
    match change {
        None => "?".to_string(),
        Some(0.0) => "0".to_string(),
        Some(change) => show(change),
    }
}

/// On or off, and why.
pub fn effects<'a>(effects: impl Iterator<Item = &'a Verdict>) -> String {
    let row = |effect: &Verdict| {
        [on_or_off(effect).to_string(), effect.name.to_string(), effect.reason.clone()]
    };
    table(&[Left, Left, Left], effects.map(row))
}

/// Whether an effect is there, in a word.
pub fn on_or_off(effect: &Verdict) -> &'static str {
    if effect.active { "on" } else { "off" }
}

/// A line a warning.
pub fn warnings(warnings: &[String]) -> String {
    if warnings.is_empty() {
        return "No warnings.\n".to_string();
    }
    let rows = warnings.iter().map(|warning| ["warning:".to_string(), one_line(warning)]);
    table(&[Left, Left], rows)
}
