//! The columns of `sweep.csv` that come from a member's summary, and their values.

use std::sync::LazyLock;

use fem_collision::{Account, QuantityOfInterest, ShownIn};
use serde_json::Value;

use fem_simulation::results::energy_key;

/// Columns before the accounts of energy.
const FIRST: [&str; 14] = [
    "restitution",
    "contact_time_s",
    "peak_force_n",
    "peak_force_raw_n",
    "max_approach_m",
    "max_contact_radius_m",
    "peak_pressure_pa",
    "contact_episodes",
    "hertz_restitution",
    "hertz_contact_time_s",
    "hertz_peak_force_n",
    "hertz_max_approach_m",
    "hertz_max_contact_radius_m",
    "hertz_peak_pressure_pa",
];
/// Columns after the accounts of energy.
const LAST: [&str; 17] = [
    "energy_residual_relative",
    "dent_depth_m",
    "dent_radius_m",
    "dent_max_plastic_strain",
    "adhesion_sticking_speed_m_s",
    "adhesion_sticks",
    "plate_lambda",
    "plate_regime",
    "momentum_residual_relative",
    "elements",
    "time_step_s",
    "steps",
    "element_updates",
    "radius_and_pressure",
    "complete",
    "stopped_because",
    "warnings",
];

/// Prefix of a column of the summary's `uncertainty`, and its part.
const UNCERTAINTIES: [(&str, &str); 3] = [
    ("uncertainty_discretisation_", "discretisation"),
    ("uncertainty_model_", "model"),
    ("uncertainty_input_", "input"),
];
/// Ending of a column of the summary's `status`, after the quantity.
const STATUS: &str = "_status";
/// Beginnings of columns that a table has only if a member has a value there.
const OPTIONAL: [&str; 5] =
    ["uncertainty_input_", "adhesion_", "plate_", "energy_locked_in_j", "dent_"];

/// Names and order of all columns that a table can have; `hertz_`, `energy_`, `adhesion_`, `plate_` and `uncertainty_` are the
/// summary's objects of that name, the last one with the part before the quantity, `_status` ends the columns of its status,
/// and `dent_` is the first of its dents. The cost of the run (`cost`) differs from run to run and stays in the member's
/// summary.
pub static COLUMNS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let own = |names: &'static [&str]| names.iter().map(ToString::to_string);
    let accounts = Account::all().map(|account| column_of(&energy_key(account)));
    let energies = [column_of("initial_j")].into_iter().chain(accounts);
    let energies = energies.chain(["locked_in_j", "residual_j"].map(column_of));
    let parts = |quantity: QuantityOfInterest| {
        UNCERTAINTIES.map(|(start, _)| format!("{start}{}", quantity.key()))
    };
    let status = QuantityOfInterest::ALL.into_iter().map(|it| format!("{}{STATUS}", it.key()));
    let uncertainties = QuantityOfInterest::ALL.into_iter().flat_map(parts);
    own(&FIRST).chain(status).chain(uncertainties).chain(energies).chain(own(&LAST)).collect()
});

/// The columns of a table of summaries: all except the optional ones that no summary has.
#[derive(Clone, Debug)]
pub struct Columns {
    /// Optional columns that no summary has had so far.
    absent: Vec<String>,
}

impl Default for Columns {
    fn default() -> Self {
        let energies = Account::all().filter(|account| account.shown() == ShownIn::WhereFilled);
        let energies = energies.map(|account| column_of(&energy_key(account)));
        let is_optional = |column: &&String| OPTIONAL.iter().any(|start| column.starts_with(start));
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

/// Returns the column of a key of the summary's energies.
fn column_of(energy_key: &str) -> String {
    format!("energy_{energy_key}")
}

/// Endings of column names and their units; if two end the same name, the longer one comes first.
const ENDINGS: [(&str, &str); 15] = [
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

/// Returns a column's name as text, without its unit.
pub fn column_words(column: &str) -> String {
    let bare = ending(column).map_or(column, |(ending, _)| &column[..column.len() - ending.len()]);
    bare.replace('_', " ")
}

fn ending(column: &str) -> Option<(&'static str, &'static str)> {
    ENDINGS.into_iter().find(|(ending, _)| column.ends_with(ending))
}
