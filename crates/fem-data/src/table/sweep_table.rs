//! Tables of sweeps: the columns of their results, and the values of a sweep from a table, which is read like measured data.

use std::sync::LazyLock;

use fem_case::RowsFault;
use fem_collision::{Account, QuantityOfInterest, energy_key};

use super::column_roles::ending_of;
use super::csv_dialect::{column_name, decode, with_point};
use super::csv_table::Table;
use super::data_error::DataError;

/// Columns before the accounts of energy.
const FIRST: &str = "restitution contact_time_s peak_force_n peak_force_raw_n max_approach_m max_contact_radius_m \
    peak_pressure_pa contact_episodes hertz_restitution hertz_contact_time_s hertz_peak_force_n hertz_max_approach_m \
    hertz_max_contact_radius_m hertz_peak_pressure_pa";
/// Quantities of oblique impacts.
pub const TANGENTIAL: [&str; 5] = [
    "tangential_restitution",
    "contact_patch_rebound_deg",
    "impulse_ratio",
    "psi_before",
    "psi_after",
];
/// Columns after the accounts of energy.
const LAST: &str = "energy_residual_relative dent_depth_m dent_radius_m dent_max_plastic_strain adhesion_sticking_speed_m_s \
    adhesion_sticks plate_lambda plate_regime momentum_residual_relative elements time_step_s steps element_updates \
    radius_and_pressure complete stopped_because warnings";

/// Prefix of a column of the summary's `uncertainty`, and its part.
pub const UNCERTAINTIES: [(&str, &str); 3] = [
    ("uncertainty_discretisation_", "discretisation"),
    ("uncertainty_model_", "model"),
    ("uncertainty_input_", "input"),
];
/// Ending of a column of the summary's `status`, after the quantity.
pub const STATUS: &str = "_status";
/// Names and order of all columns that a table can have; `hertz_`, `energy_`, `adhesion_`, `plate_` and `uncertainty_` are the
/// summary's objects of that name, the last one with the part before the quantity, `_status` ends the columns of its status,
/// and `dent_` is the first of its dents. The cost of the run (`cost`) differs from run to run and stays in the member's
/// summary.
pub static COLUMNS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let own = |names: &'static str| names.split(' ').map(ToString::to_string);
    let accounts = Account::all().map(|account| energy_column(&energy_key(account)));
    let energies = [energy_column("initial_j")].into_iter().chain(accounts);
    let energies = energies.chain(["locked_in_j", "residual_j"].map(energy_column));
    let keys = || QuantityOfInterest::ALL.into_iter().map(QuantityOfInterest::key);
    let status = keys().map(|key| format!("{key}{STATUS}"));
    let parts = |key: &'static str| UNCERTAINTIES.map(|(start, _)| format!("{start}{key}"));
    let across = TANGENTIAL.iter().map(ToString::to_string);
    let across = across.chain(TANGENTIAL.into_iter().take(3).flat_map(parts));
    let all = own(FIRST).chain(status).chain(keys().flat_map(parts)).chain(energies);
    all.chain(own(LAST)).chain(across).collect()
});

/// Returns the column of a key of the summary's energies.
pub fn energy_column(energy_key: &str) -> String {
    format!("energy_{energy_key}")
}

/// Returns, for each row of a table, the cells below these names, as a case accepts them: a cell whose unit
/// stands in the name of its column has the unit in SI, so that the case rejects one of another dimension.
///
/// # Errors
/// The text is no table, lacks a column, or has a cell without a value.
pub fn rows_below(
    source: &str,
    bytes: &[u8],
    names: &[String],
) -> Result<Vec<Vec<String>>, RowsFault> {
    read(source, bytes, names).map_err(|error| RowsFault {
        message: error.to_string(),
        help: error.help.unwrap_or_else(|| {
            "the table has a header that names its columns; every row has as many cells".to_string()
        }),
    })
}

fn read(source: &str, bytes: &[u8], names: &[String]) -> Result<Vec<Vec<String>>, DataError> {
    let table = Table::parse(source, &decode(bytes))?;
    let columns = names.iter().map(|name| {
        let wanted = column_name(name);
        table.position(&wanted).map(|column| (column, wanted)).ok_or_else(|| {
            let found = table.header().join(", ");
            let message = format!("there is no column {name}; found are {found}");
            let help =
                "name columns like the keys, or name their columns: columns = [\"d1\", \"d2\"]";
            table.header_fault(message).with_help(help)
        })
    });
    let columns = columns.collect::<Result<Vec<_>, _>>()?;
    let cell = |row: usize, (column, name): &(usize, String)| {
        if table.is_missing(row, *column) {
            let help = "every row is a value of each key; leave the row out";
            return Err(table.fault(row, "a cell has no value").in_column(name).with_help(help));
        }
        let header = &table.header()[*column];
        match ending_of(header).filter(|_| header != name) {
            Some(ending) => {
                let number = table.number(row, *column, ending.dimension)?;
                let unit = match ending.dimension {
                    [1, 0, -1] => " m/s",
                    [1, 0, 0] => " m",
                    [0, 0, 1] => " s",
                    _ => "",
                };
                Ok(format!("{number:?}{unit}"))
            }
            None if table.has_decimal_commas() => {
                Ok(with_point(table.text(row, *column)).to_string())
            }
            None => Ok(table.text(row, *column).to_string()),
        }
    };
    let row = |row: usize| columns.iter().map(|column| cell(row, column)).collect();
    (0..table.n_rows()).map(row).collect()
}
