//! The values of a sweep in a table, which is read like measured data.

use fem_case::RowsFault;

use super::column_roles::ending_of;
use super::csv_dialect::{column_name, decode, with_point};
use super::data_error::DataError;
use super::table::Table;

/// Returns, for each row of a table, the cells below these names, as a case accepts them: a cell whose unit
/// stands in the name of its column is a number in SI.
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
            Some(ending) => Ok(format!("{:?}", table.number(row, *column, ending.dimension)?)),
            None if table.has_decimal_commas() => {
                Ok(with_point(table.text(row, *column)).to_string())
            }
            None => Ok(table.text(row, *column).to_string()),
        }
    };
    let row = |row: usize| columns.iter().map(|column| cell(row, column)).collect();
    (0..table.n_rows()).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &[u8], names: [&str; 2]) -> Result<Vec<Vec<String>>, RowsFault> {
        rows_below("pairs.csv", text, &names.map(String::from))
    }

    /// The values do not depend on the separator and the place of the units.
    #[test]
    fn tables_are_read_in_all_dialects() {
        let names = ["d1", "body.0.approach_speed"];
        for (text, expected) in [
            (&b"body.0.approach_speed,d1\n0.5 m/s,10 mm\n"[..], ["10 mm", "0.5 m/s"]),
            (b"# pairs\nD1;body.0.approach_speed\n10 mm;0,5 m/s\n", ["10 mm", "0.5 m/s"]),
            (b"d1\tbody.0.approach_speed\n0,01\t0,5\n", ["0.01", "0.5"]),
            (b"sep=;\nd1 [mm];body.0.approach_speed\n10;0,5\n", ["0.01", "0.5"]),
            (b"d1_mm,body.0.approach_speed_cm_s,\xb5\n10,50,1\n", ["0.01", "0.5"]),
        ] {
            assert_eq!(rows(text, names).unwrap(), [expected], "{}", String::from_utf8_lossy(text));
        }
    }

    #[test]
    fn row_errors_name_file_line_and_column() {
        let names = ["d1", "d2"];
        for (text, expected) in [
            ("d1;d2\n1;2\n1\n", "pairs.csv:3"),
            ("d1;d2\n1;\n", "pairs.csv:2: a cell has no value"),
            ("d1;d3\n1;2\n", "there is no column d2; found are d1, d3"),
            ("d1;d2\n", "no row"),
            ("d1_mm;d2\n1 kg;2\n", "pairs.csv:2"),
        ] {
            let fault = rows(text.as_bytes(), names).unwrap_err();
            assert!(fault.message.contains(expected), "{text}: {}", fault.message);
        }
    }
}
