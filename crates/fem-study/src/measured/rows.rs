//! The values of a sweep in a table, which is read like measured data.

use fem_case::RowsFault;

use super::column_roles::ending_of;
use super::csv_dialect::{column_name, decode, with_point};
use super::data_error::DataError;
use super::table::Table;

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
