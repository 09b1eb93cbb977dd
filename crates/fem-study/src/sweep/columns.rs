//! The columns of `sweep.csv` that come from a member's summary, and their values.

use fem_collision::{Account, ShownIn, energy_key};
use fem_data::table::{COLUMNS, STATUS, TANGENTIAL, UNCERTAINTIES, energy_column};
use serde_json::Value;

/// Beginnings of columns that a table has only if a member has a value there.
const OPTIONAL: [&str; 7] = [
    "uncertainty_input_",
    "adhesion_",
    "plate_",
    "energy_locked_in_j",
    "energy_friction_j",
    "energy_tangential_relaxation_j",
    "dent_",
];

/// The columns of a table of summaries: all except the optional ones that no summary has.
#[derive(Clone, Debug)]
pub struct Columns {
    /// Optional columns that no summary has had so far.
    absent: Vec<String>,
}

impl Default for Columns {
    fn default() -> Self {
        let energies = Account::all().filter(|account| account.shown() == ShownIn::WhereFilled);
        let energies = energies.map(|account| energy_column(&energy_key(account)));
        let is_optional = |column: &&String| {
            OPTIONAL.iter().any(|start| column.starts_with(start))
                || TANGENTIAL.iter().any(|end| column.ends_with(end))
        };
        Self { absent: energies.chain(COLUMNS.iter().filter(is_optional).cloned()).collect() }
    }
}

impl Columns {
    /// Takes the next summary, given as JSON.
    pub fn see(&mut self, summary: &Value) {
        self.absent.retain(|column| value_of(summary, column).is_null());
    }

    /// Returns the columns of a table of the summaries so far.
    pub fn names(&self) -> Vec<&'static str> {
        COLUMNS.iter().filter(|column| !self.absent.contains(column)).map(String::as_str).collect()
    }
}

/// Endings of column names and their units; if two end the same name, the longer one comes first.
const ENDINGS: [(&str, &str); 16] = [
    ("_m_s2", "m/s^2"),
    ("_m_s", "m/s"),
    ("_kg_m3", "kg/m^3"),
    ("_n_s_m", "N s/m"),
    ("_pa_s", "Pa s"),
    ("_per_s", "1/s"),
    ("_j_m2", "J/m^2"),
    ("_n_m", "N/m"),
    ("_pa", "Pa"),
    ("_n", "N"),
    ("_s", "s"),
    ("_m", "m"),
    ("_j", "J"),
    ("_deg", "°"),
    ("_bytes", "bytes"),
    ("_number", ""),
];

/// Returns the column of a varied key in SI, such as `body.0.approach_speed_m_s`.
pub fn key_column(key: &str, unit: &str) -> String {
    let ending = ENDINGS.into_iter().find(|(_, known)| *known == unit);
    format!("{key}{}", ending.map_or("_si", |(ending, _)| ending))
}

/// Returns the value of a column in a summary; `null` if it has none.
pub(super) fn value_of(summary: &Value, column: &str) -> Value {
    let table =
        |name: &str| column.strip_prefix(name).map(|key| &summary[name.trim_end_matches('_')][key]);
    let uncertainty = UNCERTAINTIES.into_iter().find_map(|(start, part)| {
        column.strip_prefix(start).map(|quantity| &summary["uncertainty"][quantity][part])
    });
    let status = column.strip_suffix(STATUS).map(|quantity| &summary["status"][quantity]);
    match column {
        "elements" => {
            let bodies = summary["bodies"].as_array().into_iter().flatten();
            let counts: Vec<u64> = bodies.filter_map(|body| body["elements"].as_u64()).collect();
            if counts.is_empty() { Value::Null } else { counts.into_iter().sum::<u64>().into() }
        }
        "warnings" => summary["warnings"].as_array().map_or(0, Vec::len).into(),
        _ => {
            let tables = ["hertz_", "energy_", "adhesion_", "plate_"].into_iter().find_map(table);
            let dent = column.strip_prefix("dent_").map(|key| &summary["dent"][0][key]);
            let own = uncertainty.or(status).or(tables).or(dent);
            own.unwrap_or(&summary[column]).clone()
        }
    }
}

/// Returns the SI unit of a column; empty if it has none.
pub fn column_unit(column: &str) -> &'static str {
    ending(column).map_or("", |(_, unit)| unit)
}

/// Titles of columns whose names alone do not say what they are.
const TITLES: [(&str, &str); 5] = [
    ("tangential_restitution", "tangential restitution of the patch e_t"),
    ("contact_patch_rebound_deg", "rebound angle of the contact patch"),
    ("impulse_ratio", "tangential over normal impulse"),
    ("psi_before", "velocity of the patch before ψ₁"),
    ("psi_after", "velocity of the patch after ψ₂"),
];

/// Returns the column over which a column is drawn in place of the varied key: the rebound of the patch over its approach.
pub fn column_below(column: &str) -> Option<&'static str> {
    (column == "psi_after").then_some("psi_before")
}

/// Returns a column's name as text, without its unit.
pub fn column_words(column: &str) -> String {
    if let Some((_, title)) = TITLES.iter().find(|(known, _)| *known == column) {
        return (*title).to_string();
    }
    let bare = ending(column).map_or(column, |(ending, _)| &column[..column.len() - ending.len()]);
    bare.replace('_', " ")
}

fn ending(column: &str) -> Option<(&'static str, &'static str)> {
    ENDINGS.into_iter().find(|(ending, _)| column.ends_with(ending))
}
