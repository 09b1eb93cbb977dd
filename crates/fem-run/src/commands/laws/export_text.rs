//! The texts of an export, for one pair and for all pairs of some grains.

use std::collections::BTreeSet;

use fem::fit::dem::{Friction, Snippet};
use fem::laws::{DemExport, LawExport, PairExport, PairNumbers};
use fem_case::engineering::{Unit, number, show};
use fem_laws::LawFamily;
use serde_json::{Value, json};

use crate::jobs::value_of;
use crate::text::run_report::Detail;
use crate::text::standard_output;
use crate::text::{Failure, hanging, headed};

/// Returns the files with their ranges and, if all is wanted, the numbers in them that decide on the loss.
pub fn export_text(fitted: &DemExport, snippets: &[Snippet], detail: Detail) -> String {
    let DemExport { export, curve, .. } = fitted;
    let row = |snippet: &Snippet| {
        let [from, to, worst] = snippet.validity;
        let entries =
            snippet.entries.iter().map(|(key, value)| format!("{key} {}", number(*value, 5)));
        let mut cells = vec![
            snippet.name.to_string(),
            valid_speeds(Some(from).filter(|from| *from <= to), Some(to)),
            format!("{worst:.3}"),
        ];
        let rubbing = export.friction.as_ref().map(|friction| friction.fitted.get(snippet.name));
        cells.extend(
            rubbing.map(|fit| fit.map_or("-".to_string(), |fit| format!("{:.3}", fit.rms))),
        );
        let stiffness = rubbing.flatten().filter(|fit| fit.factor > 0.0);
        let stiffness = stiffness.map(|fit| format!("k_t factor {}", number(fit.factor, 3)));
        let input = entries.chain(stiffness).collect::<Vec<_>>().join(", ");
        cells.extend(Some(input).filter(|_| detail == Detail::All));
        cells
    };
    let rubs = if export.friction.is_some() { "|>friction" } else { "" };
    let input = if detail == Detail::All { "|input" } else { "" };
    let header = format!("file|valid|>worst{rubs}{input}");
    let of_scatter = match curve.law {
        _ if export.tolerance != curve.scatter => String::new(),
        Some(law) => format!(", the error of the law {}", law.name()),
        None => ", three standard deviations of the data from a smooth curve".to_string(),
    };
    let heading = format!(
        "{}, {} to {}",
        standard_output::one_line(&export.title),
        show(export.speeds.0, "m/s"),
        show(export.speeds.1, "m/s"),
    );
    let judged = format!(
        "valid: speeds at which the error of e is at most {}{of_scatter}; worst: its largest error. \
         Models with one e for all speeds have {:.4}; where a code makes another e of its input, the input is corrected.",
        number(export.tolerance, 2),
        export.restitution
    );
    let judged = judged + &export.friction.as_ref().map_or_else(String::new, friction_text);
    format!("{heading}\n\n{}\n\n{}", hanging(&judged), headed(&header, snippets.iter().map(row)))
}

/// Returns what the column of friction means, and the spring for codes without a file.
fn friction_text(friction: &Friction) -> String {
    let linear = friction.fitted.get("mfix_lsd.dat").map_or_else(String::new, |fit| {
        let (ratio, rms) = (number(fit.factor, 2), number(fit.rms, 2));
        format!(" Other codes with a linear spring: k_t = {ratio} k_n makes {rms}.")
    });
    format!(
        " friction: rms error of the velocity with which the contact patch rebounds, over mu v, at {} angles.{linear}",
        friction.rebound.before.len()
    )
}

/// Returns the file of a contact law to compile with the speeds and errors that it was checked with, and the best law of each code's own.
pub fn law_text(export: &LawExport, best: &[Snippet]) -> String {
    let LawExport { law, model, errors: [e, time, force], contact_ratio, .. } = export;
    let [slow, fast] = export.speeds();
    let checked = format!(
        "checked from {} to {} at 100 steps per contact, with contacts up to {} of R*: e within {}, contact time within {} %, \
         largest force within {} % of {model}. Use it with 50 steps per contact or more.",
        show(slow, "m/s"),
        show(fast, "m/s"),
        number(*contact_ratio, 2),
        number(*e, 2),
        number(100.0 * time, 2),
        number(100.0 * force, 2)
    );
    let of_point =
        |[speed, e, time]: &[f64; 3]| [show(*speed, "m/s"), format!("{e:.4}"), show(*time, "s")];
    let own = best.iter().map(|own| format!("{} {:.3}", own.code, own.validity[2]));
    let own = match best {
        [] => String::new(),
        _ => format!(
            "\n{}\n",
            hanging(&format!(
                "Largest error of e of the codes' own laws, the best one of each: {}.",
                own.collect::<Vec<_>>().join(", ")
            ))
        ),
    };
    format!(
        "{}: a contact law in C99, {} bytes per contact\n\n{}\n\n{}{own}",
        law.file_name(),
        law.memory(),
        hanging(&checked),
        headed(">speed|>e|>contact time", law.curve.iter().step_by(4).map(of_point))
    )
}

/// Returns the same for the JSON file, SI.
pub fn law_json(export: &LawExport, best: &[Snippet], case: &str) -> Value {
    let LawExport { law, model, errors: [e, time, force], contact_ratio, .. } = export;
    let column = |k: usize| law.curve.iter().map(|point| point[k]).collect::<Vec<f64>>();
    let own = best.iter().map(
        |own| json!({ "code": own.code, "model": own.model, "restitution_error": own.validity[2] }),
    );
    json!({
        "case": case,
        "own_laws": own.collect::<Vec<_>>(),
        "law": {
            "file": law.file_name(),
            "model": model,
            "speed_m_s": column(0),
            "restitution": column(1),
            "contact_time_s": column(2),
            "restitution_error": e,
            "contact_time_error": time,
            "peak_force_error": force,
            "contact_ratio": contact_ratio,
            "bytes_per_contact": law.memory(),
        },
    })
}

/// Returns which laws the files have, and why not the one that fits best.
pub fn law_note(fitted: &DemExport, has_data: bool) -> String {
    let own = match fitted.curve.law {
        Some(LawFamily::KuwabaraKono) => Some("lammps_viscoelastic.in"),
        Some(LawFamily::HertzDashpot) => Some("lammps_velocity.in"),
        Some(LawFamily::Tsuji) => Some("lammps_tsuji.in"),
        Some(LawFamily::Linear) => Some("liggghts_hooke.in"),
        Some(LawFamily::Mdr) => Some("lammps_mdr.in"),
        Some(LawFamily::Luding) => Some("liggghts_hooke_hysteresis.in"),
        _ => None,
    };
    let note = match (fitted.curve.law.map(LawFamily::name), own) {
        (None, _) if !has_data => return String::new(),
        (None, _) => {
            "Each file has the law of its code that is nearest to the data. Whether another law explains them better: \
             fem-run fit, and then --fit FOLDER."
                .to_string()
        }
        (Some(law), Some(file)) => format!(
            "{file} has the law {law}. Each other file has the law of its code that is nearest to it."
        ),
        (Some(law), None) => {
            let dents = match fitted.export.of_speed("luding") {
                Some(_) => ", LAMMPS' mdr and Luding's springs",
                None => "",
            };
            format!(
                "None of these codes has the law {law}. Each file has the law of its code that is nearest to it: one \
                 e for all speeds, Kuwabara-Kono (lammps_viscoelastic.in), a constant dashpot (lammps_velocity.in), Hunt-Crossley \
                 (drake_point_contact.py)\
                 {dents}."
            )
        }
    };
    format!("\n{}\n", hanging(&note))
}

/// Returns the speeds for which a snippet is valid.
fn valid_speeds(from: Option<f64>, to: Option<f64>) -> String {
    match (from, to) {
        (Some(from), Some(to)) => {
            let unit = Unit::fitting(to, "m/s");
            let [low, high] = [from, to].map(|speed| number(unit.scaled(speed), 3));
            match from == to {
                true => format!("at {high} {}", unit.symbol()),
                false => format!("{low} to {high} {}", unit.symbol()),
            }
        }
        _ => "nowhere".to_string(),
    }
}

pub fn pairs_text(export: &PairExport, rows: &[PairNumbers]) -> String {
    let row = |row: &PairNumbers| {
        let grain = |material: &str, diameter| format!("{} {material}", show(diameter, "m"));
        [
            grain(&row.first_material, row.first_diameter_m),
            grain(&row.second_material, row.second_diameter_m),
            format!("{:.4}", row.restitution),
            match row.bounds.is_empty() {
                true => valid_speeds(row.good_from_m_s, row.good_to_m_s),
                false => "an upper bound".to_string(),
            },
            row.worst_error.map_or("not known".to_string(), |error| format!("{error:.4}")),
        ]
    };
    let n = export.grains.len();
    let heading = format!(
        "{n} {}, {} pairs; one e per pair for all speeds, valid where its error is at most {}",
        if n == 1 { "grain" } else { "grains" },
        rows.len(),
        export.tolerance
    );
    let table = headed("first|second|>e|valid from, to|>worst error", rows.iter().map(row));
    format!("{}\n\n{table}", hanging(&heading))
}

/// Returns `pairs.csv`, one row per pair with the input of each code.
pub fn pairs_csv(rows: &[PairNumbers]) -> Result<Vec<u8>, Failure> {
    let keys: BTreeSet<&String> = rows.iter().flat_map(|row| row.entries.keys()).collect();
    let failed =
        |error: csv::Error| Failure::failed(format!("pairs.csv cannot be written: {error}"));
    let mut writer = csv::Writer::from_writer(Vec::new());
    let fixed = [
        "first_material",
        "first_diameter_m",
        "second_material",
        "second_diameter_m",
        "slowest_m_s",
        "fastest_m_s",
        "restitution",
        "good_from_m_s",
        "good_to_m_s",
        "worst_error",
        "upper_bound_since",
        "comment",
    ];
    let header = fixed.into_iter().chain(keys.iter().map(|key| key.as_str()));
    writer.write_record(header).map_err(failed)?;
    for row in rows {
        let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:?}"));
        let mut cells = vec![
            row.first_material.clone(),
            number(Some(row.first_diameter_m)),
            row.second_material.clone(),
            number(Some(row.second_diameter_m)),
            number(Some(row.slowest_m_s)),
            number(Some(row.fastest_m_s)),
            number(Some(row.restitution)),
            number(row.good_from_m_s),
            number(row.good_to_m_s),
            number(row.worst_error),
            row.bounds.join("; "),
            row.notes.join("; "),
        ];
        cells.extend(keys.iter().map(|key| number(row.entries.get(*key).copied())));
        writer.write_record(cells).map_err(failed)?;
    }
    writer.into_inner().map_err(|error| Failure::failed(error.to_string()))
}

pub fn pairs_json(export: &PairExport, case: &str, rows: &[PairNumbers]) -> Result<Value, Failure> {
    Ok(json!({ "case": case, "tolerance": export.tolerance, "pairs": value_of(&rows)? }))
}
