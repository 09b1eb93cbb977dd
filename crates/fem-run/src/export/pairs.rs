//! All pairs of some grains as text and as a table.

use std::collections::BTreeSet;

use comfy_table::CellAlignment::{Left, Right};
use fem::laws::{PairExport, PairNumbers};
use fem_case::engineering::show;
use serde_json::{Value, json};

use super::curves::good;
use crate::failure::Failure;
use crate::jobs::value_of;
use crate::tables::table;

/// What is printed: a line a pair.
pub fn pairs_text(export: &PairExport, rows: &[PairNumbers]) -> String {
    let header = ["first", "second", "e", "good to tolerance", "worst error"].map(String::from);
    let row = |row: &PairNumbers| {
        let grain = |material: &str, diameter| format!("{} {material}", show(diameter, "m"));
        [
            grain(&row.first_material, row.first_diameter_m),
            grain(&row.second_material, row.second_diameter_m),
            format!("{:.4}", row.restitution),
            match row.unpublished_loss.as_slice() {
                [] => good(row.good_from_m_s, row.good_to_m_s),
                materials => format!("no loss known of {}", materials.join(", ")),
            },
            row.worst_error.map_or("not known".to_string(), |error| format!("{error:.4}")),
        ]
    };
    let n = export.grains.len();
    let cells = std::iter::once(header).chain(rows.iter().map(row));
    format!(
        "{n} {}, {} pairs; one e for all speeds of each, good where it is right to {}\n\n{}",
        if n == 1 { "grain" } else { "grains" },
        rows.len(),
        export.tolerance,
        table(&[Left, Left, Right, Left, Right], cells)
    )
}

/// `pairs.csv`: a row a pair, with what each code is told.
///
/// # Errors
/// A table that cannot be written.
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
        "no_loss_known_of",
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
            number(row.slowest_m_s),
            number(row.fastest_m_s),
            number(Some(row.restitution)),
            number(row.good_from_m_s),
            number(row.good_to_m_s),
            number(row.worst_error),
            row.unpublished_loss.join(" "),
        ];
        cells.extend(keys.iter().map(|key| number(row.entries.get(*key).copied())));
        writer.write_record(cells).map_err(failed)?;
    }
    writer.into_inner().map_err(|error| Failure::failed(error.to_string()))
}

/// `export.json`.
///
/// # Errors
/// Numbers that are no JSON.
pub fn pairs_json(export: &PairExport, case: &str, rows: &[PairNumbers]) -> Result<Value, Failure> {
    Ok(json!({ "case": case, "tolerance": export.tolerance, "pairs": value_of(&rows)? }))
}
