//! The text of a calibration.

use fem::calibrate::{Calibration, CalibrationModel};
use fem::fit::InputPart;
use fem::fit::spectrum::Range;
use fem_case::engineering::{number, show};
use fem_case::schema::ActsOn;

use super::fit_text::{relative, weighted_down};
use crate::text::run_report::Detail;
use crate::text::tables::{hanging, headed, show_value};

/// Smaller relative changes are rounding.
const ROUNDING: f64 = 1e-9;

/// Returns the whole text or, in short, one without settings and combinations of weights, and without weights if no series fits.
pub fn calibration_text(found: &Calibration, warnings: &[String], detail: Detail) -> String {
    let mut text = answer(found);
    if detail == Detail::All {
        text += &settings(found);
    }
    if detail == Detail::All || found.why_none_fits().is_none() {
        text += &weights(found);
        text += &prior(found);
        text += &inputs(found);
        text += "\n";
    }
    if detail == Detail::All {
        text += &combinations(found);
        text += "\n";
    }
    let fit = &found.fit;
    text += &hanging(&format!(
        "rms error: {}; with a single Maxwell term (weight 1, {}): {}\n",
        number(fit.rms, 3),
        match found.maxwell.beyond {
            None => format!("{} for the same mean restitution", show(found.maxwell.time, "s")),
            Some(beyond) => format!(
                "{} or {}, at the end of the search range",
                show(found.maxwell.time, "s"),
                beyond.word()
            ),
        },
        number(found.maxwell.rms, 3)
    ));
    if let Some(exponent) = found.loss_exponent().filter(|_| detail == Detail::All) {
        let error = exponent.standard_error.map_or(String::new(), |error| format!(" ± {error:.3}"));
        text += &hanging(&format!(
            "1 - e is proportional to speed^{:.3}{error} (Prony series give powers from -0.2 to 0.2)\n",
            exponent.value
        ));
    }
    if let Some(robustness) = &fit.robustness {
        text += &weighted_down(&found.measured.data, robustness, &robustness.weights);
    }
    for warning in warnings {
        text += &hanging(&format!("warning: {warning}\n"));
    }
    text
}

fn moduli(found: &Calibration) -> &'static str {
    match found.acts_on() {
        ActsOn::All => "all moduli",
        ActsOn::Shear => "the shear modulus",
    }
}

fn answer(found: &Calibration) -> String {
    let [total, ..] = found.moments();
    let none =
        found.why_none_fits().map(|why| format!("no Prony series fits these data: {why}\n\n"));
    let mut text = none.unwrap_or_default();
    text += &hanging(&format!(
        "{} (between {} and {}) of {} of {} relaxes; rms error of the restitution {}\n\n",
        number(total.value, 3),
        number(total.low, 3),
        number(total.high, 3),
        moduli(found),
        found.target.material,
        number(found.fit.rms, 2),
    ));
    text
}

fn settings(found: &Calibration) -> String {
    let counted = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    let span = |(low, high): (f64, f64), unit: &str| match low == high {
        true => show(low, unit),
        false => format!("{} to {}", show(low, unit), show(high, unit)),
    };
    let name = match found.model {
        CalibrationModel::Condensed => "condensed",
        CalibrationModel::Ting => "ting with finite size",
    };
    let mut text = hanging(&format!(
        "{name}; {} of {} of {}; regularisation {}\n{} of {}, {}: {}, contact times {}\n",
        counted(found.times.len(), "term"),
        moduli(found),
        found.target.material,
        number(found.regularisation, 3),
        counted(found.measured.data.points.len(), "point"),
        found.measured.data.name,
        counted(found.experiments.len(), "pair"),
        span(found.measured.data.speeds(), "m/s"),
        span(found.contact_times(), "s"),
    ));
    let across = found.experiments.iter().filter_map(|experiment| experiment.elements_across);
    let across = across.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
    if let Some((smallest, largest)) = across {
        text += &hanging(&format!(
            "one mesh per pair: {smallest:.1} elements across the smallest contact radius, \
             {largest:.1} across the largest\n"
        ));
    }
    text + "\n"
}

fn weights(found: &Calibration) -> String {
    let fit = &found.fit;
    let level = 100.0 * found.confidence;
    let parts = fit.parts.as_ref();
    let of_prior = if parts.is_some() { "|>measured" } else { "" };
    let header =
        format!("|>relaxation time{of_prior}|>best|{level} % range, others free|>from the data");
    let span = |range: &Range, shown: &dyn Fn(f64) -> String| {
        format!("{} to {}", shown(range.low), shown(range.high))
    };
    let plain = |value: f64| format!("{value:.4}");
    let terms = (0..found.times.len()).map(|k| {
        let weight = parts.map(|parts| parts.weights[k]);
        let weight = weight.map(|weight| format!("{:.4} ± {:.4}", weight.value, weight.error));
        let mut cells = vec![format!("g{}", k + 1), show(found.times[k], "s")];
        cells.extend(weight);
        cells.push(plain(fit.weights[k]));
        cells.push(span(&found.weight_range(k), &plain));
        cells.push(format!("{:.0} %", 100.0 * fit.resolution.shares[k]));
        cells
    });
    let [total, rate, time] = &found.moments();
    let rates = |value: f64| show_value(value, "1/s");
    let times = |value: f64| show(value, "s");
    let moment = |name: &str, range: &Range, shown: &dyn Fn(f64) -> String| {
        let mut cells = vec![name.to_string(), String::new()];
        cells.extend(parts.map(|_| String::new()));
        cells.extend([shown(range.value), span(range, shown), String::new()]);
        cells
    };
    let moments = [
        moment("Σ g", total, &plain),
        moment("Σ g/τ", rate, &rates),
        moment("Σ g τ", time, &times),
    ];
    headed(&header, terms.chain(moments))
}

/// Returns the mean restitution by the measured relaxation, by the data and by both; nothing without prior knowledge.
fn prior(found: &Calibration) -> String {
    let Some(parts) = &found.fit.parts else { return String::new() };
    let names = ["the measured relaxation", "the data", "both"];
    let rows = names.iter().zip(&parts.restitution).map(|(name, share)| {
        [format!("by {name}"), format!("{:.5} ± {:.5}", share.value, share.error)]
    });
    format!(
        "\n{}the data determine {:.1} of {} weights, the measured relaxation the others\n",
        headed("|mean restitution", rows),
        parts.n_of_data,
        found.times.len(),
    )
}

/// Returns the ranges of the moments by the data alone and the standard errors by uncertain inputs; nothing without these.
fn inputs(found: &Calibration) -> String {
    if found.inputs.is_empty() {
        return String::new();
    }
    let moments = &found.fit.moments;
    let shown: [&dyn Fn(f64) -> String; 3] =
        [&|value| format!("{value:.4}"), &|value| show_value(value, "1/s"), &|value| {
            show(value, "s")
        }];
    let row = |label: String, cell: &dyn Fn(usize) -> String| [label, cell(0), cell(1), cell(2)];
    let of_data =
        |i: usize| format!("{} to {}", shown[i](moments[i].low), shown[i](moments[i].high));
    let data = row("range by the data alone".to_string(), &of_data);
    let n = found.times.len();
    let of_input = |part: &InputPart| {
        let change = |i: usize| match part.changes[n + i].abs() {
            change if change <= ROUNDING * moments[i].value => "0".to_string(),
            change if change.is_finite() => format!("± {}", shown[i](change)),
            _ => "no fit".to_string(),
        };
        row(format!("by {}", relative(&part.input)), &change)
    };
    let rows = std::iter::once(data).chain(found.inputs.iter().map(of_input));
    format!("\n{}", headed("uncertain inputs|>Σ g|>Σ g/τ|>Σ g τ", rows))
}

fn combinations(found: &Calibration) -> String {
    let all = &found.fit.resolution.combinations;
    let seen = all.iter().filter(|combination| combination.singular_value > 0.0);
    let n_unseen = all.len() - seen.clone().count();
    let rows = seen.map(|combination| {
        let coefficients = combination.coefficients.iter().enumerate();
        let words = coefficients.filter(|(_, v)| v.abs() > 0.05).map(|(k, v)| {
            let sign = if *v < 0.0 { "- " } else { "+ " };
            format!("{sign}{:.2} g{}", v.abs(), k + 1)
        });
        let words = words.collect::<Vec<_>>().join(" ");
        // A standard error of 1 or more exceeds what weights can give, and is not printed.
        let is_told = combination.standard_error < 1.0;
        let error = match is_told {
            true => number(combination.standard_error, 2),
            false => "-".to_string(),
        };
        let verdict = match (combination.is_determined, is_told && combination.may_be_zero()) {
            (true, false) => "determined",
            (true, true) => "small: 0 within two standard errors",
            (false, true) => "not determined: 0 within two standard errors",
            (false, false) => "not determined",
        };
        [
            words.trim_start_matches("+ ").to_string(),
            number(combination.singular_value, 2),
            format!("{:.4}", combination.value),
            error,
            verdict.to_string(),
        ]
    });
    let text = headed("combination|>singular value|>value|>standard error|", rows);
    match n_unseen {
        0 => text,
        n => text + &format!("{n} more that do not affect the data\n"),
    }
}
