//! The report of a run on stdout, for people. Programs read the numbers from the summary.

use std::fmt::Write;
use std::path::Path;

use comfy_table::CellAlignment::Left;
use fem::effects::{EffectDecision, NeglectError};
use fem::fit::cradle::Measured;
use fem::results::{BodySummary, BounceSummary, DentSummary, Parts, RestSummary, Summary};
use fem::{ExpectedError, ModelCandidate};
use fem_case::engineering::{Unit, number, show};
use fem_case::schema::{CaseFile, ToleranceValue};
use fem_case::{Spot, defaults};
use fem_collision::{Account, BalanceSide, QuantityOfInterest, ShownIn};
use fem_report::answer::{
    bounce_answer, has_known_loss, marked, measured_note, relative_motion_energy,
};
use fem_report::report::is_numerical;
use indicatif::{DecimalBytes, HumanCount};

use super::standard_output::{one_line, shown};
use super::tables::{hanging, headed, show_measured, table};

const NONE: &str = "-";
const UNKNOWN: &str = "?";
/// Within this distance from 1 a restitution is also printed as 1 − e.
const NEARLY_ELASTIC: f64 = 1e-3;
/// Smallest loss of restitution by mesh and settings that is printed.
const MIN_LOSS: f64 = 1e-6;
/// Relative errors below this are rounding.
const ROUNDING: f64 = 1e-9;
const MAX_BOUNCES: usize = 12;
/// Bounces whose restitution fits on one line of a short report.
const MAX_BOUNCES_IN_SHORT: usize = 4;
/// Reasons of the effects that are on are printed if they fit on two lines of 80 columns.
const MAX_REASONS: usize = 150;

/// How much of a result is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// What fits on a screen of 80 columns and 20 lines.
    Short,
    All,
}

/// Returns the report, with the warnings below the numbers, the most important one first.
pub fn report(summary: &Summary, place: Option<&Path>, detail: Detail) -> String {
    let mut text = String::new();
    let title = summary.case.title.as_deref().unwrap_or_default();
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{}\n", one_line(title));
    if let Some(reason) = &summary.stopped_because {
        let _ = writeln!(text, "INCOMPLETE: {reason}\n");
    }
    text += &quantities(summary, detail);
    text += &match detail {
        Detail::Short => short(summary),
        Detail::All => details(summary),
    };
    text += &warnings(&summary.warnings);
    let place = place.map_or("not written".into(), shown);
    let before = if detail == Detail::All { "\n" } else { "" };
    let _ = writeln!(text, "{before}Result: {place}");
    text
}

/// Returns what a short report says of contacts, model and effects.
fn short(summary: &Summary) -> String {
    let deficit = elastic_deficit(summary);
    let deficit = deficit.map_or(String::new(), |it| format!("1 - restitution: {it}\n"));
    let mut rows: Vec<[String; 2]> = Vec::new();
    let mut row = |name: &str, text: String| rows.push([format!("{name}:"), text]);
    if let Some(contacts) = &summary.bounces {
        let shown = contacts.iter().take(MAX_BOUNCES_IN_SHORT);
        let mut values: Vec<String> = shown.map(restitution_of_bounce).collect();
        if contacts.len() > MAX_BOUNCES_IN_SHORT {
            values.push("…".to_string());
        }
        let n = contacts.len();
        row("bounces", format!("{n}, with restitution {}; -v lists them", values.join(", ")));
    }
    if let Some(rest) = &summary.rest {
        row("at rest", format!("from {} on", rest.time_s.map_or(NONE.into(), |t| show(t, "s"))));
    }
    // Of two dents the deeper one; -v has both.
    let deepest = |a: &&DentSummary, b: &&DentSummary| {
        a.depth_m.unwrap_or(0.0).total_cmp(&b.depth_m.unwrap_or(0.0))
    };
    for (name, text) in flow(summary, summary.dent.iter().flatten().max_by(deepest).into_iter()) {
        row(name, text);
    }
    if let Some(text) = across(summary) {
        row("across", text);
    }
    let considered = summary.models_considered.as_deref().unwrap_or_default();
    let decisions = summary.effects.iter().map(|effect| &effect.decision);
    format!("\n{deficit}{}", effects_in_short(rows, decisions, &summary.case, considered))
}

/// Returns these rows, the chosen model, the effects that are on, and how many are off.
pub fn effects_in_short<'a>(
    mut rows: Vec<[String; 2]>,
    decisions: impl Iterator<Item = &'a EffectDecision> + Clone,
    case: &CaseFile,
    considered: &[ModelCandidate],
) -> String {
    let mut row = |name: &str, text: String| rows.push([format!("{name}:"), text]);
    let chosen = considered.iter().find(|candidate| candidate.chosen);
    if let Some(ModelCandidate { model, reason, .. }) = chosen {
        row("model", format!("{model}, {reason}"));
    }
    let on: Vec<&EffectDecision> =
        decisions.clone().filter(|it| it.active && !is_numerical(it.name)).collect();
    if !on.is_empty() {
        let reasons: Vec<String> =
            on.iter().map(|it| format!("{} ({})", it.name, it.reason)).collect();
        let names: Vec<&str> = on.iter().map(|it| it.name).collect();
        let reasons = reasons.join(", ");
        row("on", if reasons.len() > MAX_REASONS { names.join(", ") } else { reasons });
    }
    let off: Vec<&EffectDecision> = decisions.clone().filter(|it| !it.active).collect();
    let mattering: Vec<&str> = off.iter().filter(|it| it.matters).map(|it| it.name).collect();
    let above = match mattering.is_empty() {
        true => format!(", none above {}", tolerance_words(case)),
        false => format!("; above {}: {}", tolerance_words(case), mattering.join(", ")),
    };
    let plural = if off.len() == 1 { "" } else { "s" };
    let off = hanging(&format!("{} effect{plural} off{above}; -v lists them\n", off.len()));
    let rows = if rows.is_empty() { String::new() } else { table(&[Left, Left], rows) };
    rows + &off
}

/// Returns the tangential quantities of an oblique impact with their error bars.
pub fn across(summary: &Summary) -> Option<String> {
    let bars = summary.uncertainty.tangential?;
    let it = &summary.tangential;
    let quantities = [
        ("e_t", it.tangential_restitution, bars.tangential_restitution, ""),
        ("patch", it.contact_patch_rebound_deg, bars.contact_patch_rebound_deg, "°"),
        ("impulse ratio", it.impulse_ratio, bars.impulse_ratio, ""),
    ];
    let text = quantities.iter().filter_map(|(name, value, parts, unit)| {
        Some(format!("{name} {}", tangential_text((*value)?, parts, unit)))
    });
    Some(text.collect::<Vec<_>>().join(", "))
}

/// Returns a tangential quantity with its error bar.
pub fn tangential_text(value: f64, parts: &Parts, unit: &str) -> String {
    let text = match parts.sum() {
        Some(bar) => show_measured(Measured { value, uncertainty: bar }, unit),
        None => format!("{} ± ? {unit}", number(value, 4)),
    };
    text.trim_end().to_string()
}

/// Returns dents of bodies that flowed, and where the energy went.
fn flow<'a>(
    summary: &Summary,
    dents: impl Iterator<Item = &'a DentSummary>,
) -> Vec<(&'static str, String)> {
    let unknown = || UNKNOWN.to_string();
    let length = |value: Option<f64>| value.map_or_else(unknown, |value| show(value, "m"));
    let dent = |dent: &DentSummary| {
        let strain =
            dent.max_plastic_strain.map_or_else(unknown, |strain| number(100.0 * strain, 2));
        let text = format!(
            "{} is {} deep, {} in radius; plastic strain up to {strain} %",
            dent.body,
            length(dent.depth_m),
            length(dent.radius_m)
        );
        ("dent", text)
    };
    let mut rows: Vec<_> = dents.map(dent).collect();
    let energy = &summary.energy;
    let shares = [energy.get(Account::PlasticWork), energy.locked_in_j].map(|part| {
        share_of_energy(summary, part).map_or_else(unknown, |share| number(100.0 * share, 2))
    });
    // Dents beside each other hold more residual stress than that of the first one.
    let is_fresh = summary.bounces.as_ref().is_some_and(|bounces| bounces.len() > 1)
        && summary.case.gravity.as_ref().is_some_and(|gravity| gravity.spot == Some(Spot::Fresh));
    if let ([plastic, locked_in], false) = (&shares, rows.is_empty() || is_fresh) {
        let text = format!(
            "{plastic} % became plastic work, {locked_in} % is locked in by residual stress"
        );
        rows.push(("energy", text));
    }
    rows
}

/// Returns an energy as a share of the energy of relative motion.
fn share_of_energy(summary: &Summary, part: Option<f64>) -> Option<f64> {
    let [lower, upper] = &summary.bodies[..] else { return None };
    let all = [lower, upper].map(|it| (it.mass_kg, it.velocity_before_m_s.unwrap_or(0.0)));
    Some(part? / relative_motion_energy(all)?)
}

/// Returns the tolerance of the case as text: `the tolerance of 1 %`, or that it has several.
fn tolerance_words(case: &CaseFile) -> String {
    let given = case.accuracy.as_ref().and_then(|accuracy| accuracy.tolerance.as_ref());
    let share = match given {
        Some(ToleranceValue::Table(_)) => return "the tolerances of the case".to_string(),
        Some(ToleranceValue::Share(share)) => share.si().ok(),
        None => None,
    };
    let share = share.unwrap_or(defaults::accuracy().restitution);
    format!("the tolerance of {} %", number(100.0 * share, 3))
}

/// Returns everything between the table of quantities and the warnings.
fn details(summary: &Summary) -> String {
    let mut text = String::new();
    if let Some(deficit) = elastic_deficit(summary) {
        let _ = writeln!(text, "\n1 - restitution  {deficit}");
    }
    if summary.contact_episodes > 1 {
        let _ = writeln!(
            text,
            "\nseparate contacts  {} (the surfaces may separate for a few steps at first and last touch)",
            summary.contact_episodes
        );
    }
    if let Some(contacts) = &summary.bounces {
        let _ = writeln!(text, "\n{}", bounces(contacts, summary.rest.as_ref()));
    } else {
        text += "\n";
    }
    let _ = writeln!(text, "{}", bodies(&summary.bodies));
    if let Some(across) = across(summary) {
        let _ = writeln!(text, "across  {across}\n");
    }
    text += &balances(summary);
    if let Some(considered) = &summary.models_considered {
        let _ = write!(text, "\nModels and their expected errors\n{}", models(considered));
    }
    let _ = writeln!(
        text,
        "\nEffects\n{}",
        effects(summary.effects.iter().map(|effect| &effect.decision))
    );
    text
}

/// Returns each quantity with both parts of its error bar, next to Hertz' value.
fn quantities(summary: &Summary, detail: Detail) -> String {
    let (ours, hertz) = (&summary.collision, &summary.hertz);
    let own = own_error(summary);
    let is_uncertain =
        |it: QuantityOfInterest| summary.uncertainty.of(it).input.is_some_and(|input| input > 0.0);
    let measured = summary.measured_restitutions();
    // Seven columns are too wide for 80 characters.
    let has_input = QuantityOfInterest::ALL.into_iter().any(is_uncertain);
    let has_measured = !measured.is_empty()
        && summary.uncertainty.of(QuantityOfInterest::Restitution).model.is_none();
    let row = |quantity: QuantityOfInterest| {
        let (value, theirs) = (ours.number(quantity), hertz.number(quantity));
        let has_unit = quantity != QuantityOfInterest::Restitution;
        let unit =
            has_unit.then(|| Unit::fitting(theirs.or(value).unwrap_or_default(), quantity.unit()));
        let shown = |value: Option<f64>| match (value, &unit) {
            (None, _) => NONE.into(),
            (Some(value), Some(unit)) => unit.show(value),
            (Some(value), None) => format!("{value:.4}"),
        };
        let parts = summary.uncertainty.of(quantity);
        let errors = value.map(|value| error_columns(value, &parts, unit.as_ref()));
        let [mesh, neglected, input] = errors.unwrap_or([NONE; 3].map(String::from));
        let own = value.map_or(NONE.into(), |_| {
            let text = shown(value);
            let (number, symbol) = text.split_once(' ').unwrap_or((&text, ""));
            let own = marked(number, &parts, quantity, measured.first().map(|it| it.1));
            format!("{own} {symbol}").trim_end().to_string()
        });
        let ratio = value.zip(theirs).map_or(NONE.into(), |(a, b)| format!("{:.4}", a / b));
        let name = quantity.name().to_string();
        let mut cells = vec![name, own, mesh, neglected];
        match (has_input, has_measured) {
            (true, _) => cells.extend([input, shown(theirs)]),
            (false, true) => cells.push(shown(theirs)),
            (false, false) => cells.extend([shown(theirs), ratio]),
        }
        cells
    };
    let last = match (has_input, has_measured) {
        (true, _) => ">± input|>Hertz",
        (false, true) => ">Hertz",
        (false, false) => ">Hertz|>ratio",
    };
    let header = format!("|>this run|>{own}|>± neglected|{last}");
    let table = headed(&header, QuantityOfInterest::ALL.map(row));
    let mut legend = error_legend(own, &table);
    if let Some(note) = measured_note(&measured).filter(|_| has_measured) {
        legend += &format!("; restitution: {note}");
    }
    let between = if detail == Detail::All { "\n" } else { "" };
    format!("{table}{between}{}\n", hanging(&legend))
}

/// Returns the head of the column with the discretisation error.
fn own_error(summary: &Summary) -> &'static str {
    let has_elements = summary.bodies.iter().any(|body| body.elements.is_some());
    if has_elements { "± mesh" } else { "± numerics" }
}

fn own_error_words(head: &str) -> &'static str {
    if head == "± mesh" { "discretisation error" } else { "numerical error" }
}

/// Returns the line below the table that explains the error columns; `own` is the head of the first one.
fn error_legend(own: &str, cells: &str) -> String {
    let signs = [
        ("± input", "; ± input: by uncertain inputs"),
        (UNKNOWN, "; ?: not known"),
        ("≤", "; ≤: upper bound"),
        ("≥", "; ≥: lower bound"),
    ];
    let signs = signs.into_iter().filter(|(sign, _)| cells.contains(sign));
    let signs: String = signs.map(|(_, words)| words).collect();
    format!("{own}: {}; ± neglected: by neglected effects{signs}", own_error_words(own))
}

/// Returns the errors by discretisation, neglected effects and uncertain inputs with two digits, in `unit` if the
/// quantity has one.
fn error_columns(value: f64, parts: &Parts, unit: Option<&Unit>) -> [String; 3] {
    let sized = |size: f64| match unit {
        _ if size <= ROUNDING * value.abs() => "0".to_string(),
        Some(unit) => format!("{} {}", number(unit.scaled(size), 2), unit.symbol()),
        None => number(size, 2),
    };
    let known = |size: Option<f64>| size.map_or(UNKNOWN.to_string(), sized);
    [known(parts.discretisation), known(parts.model), parts.input.map_or("0".to_string(), sized)]
}

/// Returns 1 − e of a nearly elastic collision, with the digits that its discretisation error allows, and what it holds: the
/// loss by vibrations that the bodies keep, or numerical dissipation where it is below the error. There is none where
/// neglected effects may change it by more than this or by an unknown amount.
fn elastic_deficit(summary: &Summary) -> Option<String> {
    let restitution = summary.collision.restitution?;
    let deficit = 1.0 - restitution;
    let parts = summary.uncertainty.of(QuantityOfInterest::Restitution);
    let bar = parts.discretisation;
    if deficit.abs() >= NEARLY_ELASTIC || !has_known_loss(restitution, &parts) {
        return None;
    }
    let shown = with_known_digits(deficit, bar);
    let kept: Option<f64> = summary
        .bodies
        .iter()
        .filter(|body| body.elements.is_some())
        .map(|it| it.vibration_energy_j)
        .sum();
    // Bodies that lose the share s of the energy keep √(1 − s) of the speed.
    let by_vibrations = share_of_energy(summary, kept).map(|share| 0.5 * share);
    Some(match by_vibrations {
        Some(lost) if deficit > bar.unwrap_or(0.0) && lost > 0.0 => {
            format!("{shown}, of which {} in vibrations of the bodies", number(lost, 1))
        }
        _ => shown,
    })
}

/// Shows a number with the digits above its error, at most three; below its error, that it is less.
fn with_known_digits(value: f64, error: Option<f64>) -> String {
    let error = error.unwrap_or(0.0).max(ROUNDING);
    if value.abs() <= error {
        return format!("less than {}", number(error, 1));
    }
    let digits = value.abs().log10().floor() - error.log10().floor() + 1.0;
    number(value, digits.clamp(1.0, 3.0) as usize)
}

/// Returns the restitution of a contact of a bouncing ball with its error bar.
fn restitution_of_bounce(bounce: &BounceSummary) -> String {
    let BounceSummary { restitution, restitution_uncertainty: parts, .. } = bounce;
    bounce_answer(*restitution, parts, bounce.measured_restitution).unwrap_or(NONE.to_string())
}

/// Returns one line per contact of a bouncing ball, and the contact at rest.
fn bounces(bounces: &[BounceSummary], rest: Option<&RestSummary>) -> String {
    let quantity = |value: Option<f64>, unit: &str| value.map_or(NONE.into(), |v| show(v, unit));
    let row = |(k, bounce): (usize, &BounceSummary)| {
        [
            (k + 1).to_string(),
            quantity(bounce.time_s, "s"),
            quantity(bounce.speed_before_m_s, "m/s"),
            restitution_of_bounce(bounce),
            quantity(bounce.contact_time_s, "s"),
            quantity(bounce.peak_force_n, "N"),
        ]
    };
    let rows = bounces.iter().enumerate().take(MAX_BOUNCES).map(row);
    let mut text = headed("bounce|>at|>before|>restitution|>contact time|>peak force", rows);
    if bounces.len() > MAX_BOUNCES {
        text += &format!("and {} more\n", bounces.len() - MAX_BOUNCES);
    }
    if let Some(rest) = rest {
        text += &format!(
            "at rest from {} on: contact radius {}, approach {} under {}\n",
            quantity(rest.time_s, "s"),
            quantity(rest.contact_radius_m, "m"),
            quantity(rest.approach_m, "m"),
            quantity(rest.static_force_n, "N"),
        );
    }
    text
}

fn bodies(bodies: &[BodySummary]) -> String {
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
    headed("body|>elements|>mass|>before|>after|>vibration", bodies.iter().map(row))
}

/// Returns how peaks are defined, the restitution without relaxation, the residuals and the cost.
fn balances(summary: &Summary) -> String {
    let residual = |value: f64| number(value, 2);
    let book = summary.energy.accounts.0;
    let dissipated = book.total(BalanceSide::Lost);
    let of_effects = book.entries().filter(|(account, _)| account.shown() == ShownIn::WhereFilled);
    let of_effects = of_effects.map(|(account, energy)| {
        format!("; {} {}", account.name().replace('_', " "), show(energy, "J"))
    });
    let peaks = summary.peak_force_raw_n.map(|force| {
        let text = format!(
            "averaged over 1/64 of the contact time (unaveraged force: {}); radius and pressure are {}",
            show(force, "N"),
            match summary.radius_and_pressure {
                "true" => "true, on the deformed surface",
                _ => "nominal, on the undeformed surface",
            },
        );
        ["peaks".to_string(), text]
    });
    let null = summary.elastic_null.map(|null| {
        let lost = match null.one_minus_restitution {
            lost if lost.abs() < MIN_LOSS => format!("less than {}", number(MIN_LOSS, 1)),
            lost => number(lost, 1),
        };
        let how = match null.estimated {
            true => "estimated",
            false => "from a coarser run without relaxation",
        };
        let of_what = match null.vibrations {
            Some(vibrations) => format!(
                "{} by vibrations and waves, the rest by numerical dissipation",
                number(vibrations, 1)
            ),
            None => "by vibrations and numerical dissipation together".to_string(),
        };
        let text = format!("{lost} of the restitution on this mesh: {of_what} ({how})");
        ["loss without relaxation".to_string(), text]
    });
    let energy = format!(
        "residual {} of the initial energy; dissipated {}{}",
        summary.energy.residual_relative.map_or(NONE.into(), residual),
        dissipated.map_or(NONE.into(), |energy| show(energy, "J")),
        of_effects.collect::<String>(),
    );
    let energy = ["energy".to_string(), energy];
    let momentum = summary.momentum_residual_relative;
    let momentum =
        momentum.map(|drift| ["momentum".into(), format!("residual {}", residual(drift))]);
    // Closed forms take less than is worth printing.
    let cost = summary.steps.is_some().then(|| ["cost".into(), cost_text(summary)]);
    let of_flow = flow(summary, summary.dent.iter().flatten())
        .into_iter()
        .map(|(name, text)| [name.to_string(), text]);
    let rows =
        peaks.into_iter().chain(null).chain(of_flow).chain([energy]).chain(momentum).chain(cost);
    table(&[Left, Left], rows)
}

fn cost_text(summary: &Summary) -> String {
    let cost = &summary.cost;
    let memory = cost.peak_memory_bytes.map(|bytes| format!(", {}", DecimalBytes(bytes)));
    let memory = memory.unwrap_or_default();
    let Some(steps) = summary.steps else {
        return format!("{}{memory}", show(cost.solve_s, "s"));
    };
    let (solve, each) = match cost.ns_per_element_update {
        Some(ns) => (show(cost.solve_s, "s"), format!("{ns:.1} ns per element update, ")),
        None => (show(cost.solve_s, "s"), format!("after {} of setup, ", show(cost.setup_s, "s"))),
    };
    let trials = (cost.trials_s > 0.1 * cost.solve_s)
        .then(|| format!(", after {} of trial runs", show(cost.trials_s, "s")));
    let kept = cost.factor_bytes.filter(|bytes| *bytes > 0);
    let factors = kept.map(|bytes| format!(", {} of it for factors", DecimalBytes(bytes)));
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

pub fn models(considered: &[ModelCandidate]) -> String {
    let row = |considered: &ModelCandidate| {
        let ExpectedError { restitution, contact_time_s, peak_force_n, peak_pressure_pa } =
            considered.error;
        let [restitution, time, force] =
            changes(&NeglectError { restitution, contact_time_s, peak_force_n });
        let pressure = change(peak_pressure_pa, &|change| two_digits(change, "Pa"));
        let mark = if considered.chosen { "chosen: " } else { "" };
        let model = considered.model.replace(" = {}", "").replace(" = { ", ", ").replace(" }", "");
        [model, restitution, time, force, pressure, format!("{mark}{}", considered.reason)]
    };
    let header = "model|>restitution|>time|>force|>pressure|";
    headed(header, considered.iter().map(row))
}

pub fn changes(changes: &NeglectError) -> [String; 3] {
    let NeglectError { restitution, contact_time_s, peak_force_n } = *changes;
    [
        change(restitution, &|change| number(change, 2)),
        change(contact_time_s, &|change| two_digits(change, "s")),
        change(peak_force_n, &|change| two_digits(change, "N")),
    ]
}

/// Returns an estimate with two digits in a fitting unit.
fn two_digits(value: f64, unit: &str) -> String {
    Unit::fitting(value, unit).with_digits(2).show(value)
}

fn change(change: Option<f64>, show: &dyn Fn(f64) -> String) -> String {
    match change {
        None => UNKNOWN.to_string(),
        Some(0.0) => "0".to_string(),
        Some(change) => show(change),
    }
}

pub fn effects<'a>(effects: impl Iterator<Item = &'a EffectDecision>) -> String {
    let row = |effect: &EffectDecision| {
        [on_or_off(effect).to_string(), effect.name.to_string(), effect.reason.clone()]
    };
    table(&[Left, Left, Left], effects.map(row))
}

pub fn on_or_off(effect: &EffectDecision) -> &'static str {
    if effect.active { "on" } else { "off" }
}

pub fn warnings(warnings: &[String]) -> String {
    if warnings.is_empty() {
        return "No warnings.\n".to_string();
    }
    let rows = warnings.iter().map(|warning| ["warning:".to_string(), one_line(warning)]);
    table(&[Left, Left], rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fem::results::Side;

    /// A loss of 3.69e-5 is not known if the restitution is known to 4e-4.
    #[test]
    fn a_small_loss_has_the_digits_above_its_error() {
        for (value, error, expected) in [
            (3.69e-5, Some(3.9e-4), "less than 4e-4"),
            (3.694e-5, Some(2e-6), "3.7e-5"),
            (3.694e-5, Some(1e-5), "4e-5"),
            (3.694e-4, Some(0.0), "3.69e-4"),
            (1.5e-13, None, "less than 1e-9"),
            (-2.33e-11, Some(0.0), "less than 1e-9"),
        ] {
            assert_eq!(with_known_digits(value, error), expected);
        }
    }

    #[test]
    fn unknown_errors_are_marked() {
        let of = |discretisation, model, bound| {
            let parts = Parts { discretisation, model, input: None, bound };
            error_columns(62e-6, &parts, Some(&Unit::fitting(62e-6, "s")))
        };
        assert_eq!(of(Some(1.234e-7), Some(3e-6), None), ["0.12 µs", "3 µs", "0"]);
        assert_eq!(of(Some(1e-17), None, Some(Side::AtLeast)), ["0", "?", "0"]);
        assert_eq!(of(None, None, None), ["?", "?", "0"]);
        let plain = Parts {
            discretisation: Some(1.94e-4),
            model: Some(0.0),
            input: Some(3e-3),
            bound: None,
        };
        assert_eq!(error_columns(1.0, &plain, None), ["1.9e-4", "0", "0.003"]);
        assert!(error_legend("± mesh", "0.12 µs  ≤ 0.2 µs").ends_with("effects; ≤: upper bound"));
    }
}
