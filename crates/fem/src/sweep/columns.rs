//! The columns of `sweep.csv` that come from a member's summary, and what is in them.

use serde_json::Value;

/// Names and order of the columns; `hertz_` and `energy_` are the summary's objects of that name.
/// What the run took (`cost`) differs from run to run and stays in the member's summary.
pub const COLUMNS: &[&str] = &[
    "restitution",
    "contact_time_s",
    "peak_force_n",
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
    "energy_initial_j",
    "energy_kinetic_j",
    "energy_strain_j",
    "energy_contact_j",
    "energy_viscous_dissipation_j",
    "energy_wall_work_j",
    "energy_residual_j",
    "energy_residual_relative",
    "momentum_residual_relative",
    "elements",
    "time_step_s",
    "steps",
    "element_updates",
    "complete",
    "stopped_because",
    "warnings",
];
/// Endings of column names and their units.
const ENDINGS: [(&str, &str); 6] =
    [("_m_s", "m/s"), ("_pa", "Pa"), ("_n", "N"), ("_s", "s"), ("_m", "m"), ("_j", "J")];

/// The value of a column in a summary; `null` if it has none.
pub(super) fn value_of(summary: &Value, column: &str) -> Value {
    let table =
        |name: &str| column.strip_prefix(name).map(|key| &summary[name.trim_end_matches('_')][key]);
    match column {
        "elements" => {
            let bodies = summary["bodies"].as_array().into_iter().flatten();
            let counts: Vec<u64> = bodies.filter_map(|body| body["elements"].as_u64()).collect();
            if counts.is_empty() { Value::Null } else { counts.into_iter().sum::<u64>().into() }
        }
        "warnings" => summary["warnings"].as_array().map_or(0, Vec::len).into(),
        _ => table("hertz_").or(table("energy_")).unwrap_or(&summary[column]).clone(),
    }
}

/// The SI unit of a column; empty if it has none.
pub fn column_unit(column: &str) -> &'static str {
    ending(column).map_or("", |(_, unit)| unit)
}

/// A column's name in words, without its unit.
pub fn column_words(column: &str) -> String {
    let bare = ending(column).map_or(column, |(ending, _)| &column[..column.len() - ending.len()]);
    bare.replace('_', " ")
}

fn ending(column: &str) -> Option<(&'static str, &'static str)> {
    ENDINGS.into_iter().find(|(ending, _)| column.ends_with(ending))
}
