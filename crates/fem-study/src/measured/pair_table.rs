//! Restitutions of several pairs of bodies from a table that names their diameters.

use fem_case::Scene;

use super::column_roles::DIAMETERS;
use super::data_error::DataError;
use super::pairs::MeasuredPairs;
use super::restitution_table::{Wanted, read_rows};
use super::table::Table;

const SIDES: [&str; 2] = ["first", "second"];
const LENGTH: [i32; 3] = [1, 0, 0];

impl MeasuredPairs {
    /// Reads a table as [`Restitutions::read`](super::Restitutions::read) does; columns like `diameter_1_mm` and
    /// `diameter_2_mm` distinguish several pairs. The scene shows which body is a wall.
    ///
    /// # Errors
    /// The table has an error; the first one is returned.
    pub fn read(table: &Table, scene: &Scene) -> Result<Self, DataError> {
        let columns = diameter_columns(table, scene)?;
        let others: Vec<usize> = columns.iter().flatten().copied().collect();
        let names = DIAMETERS.map(|[name, _]| name);
        let wanted = Wanted { others: &others, names: &names, ..Wanted::default() };
        let (data, rows) = read_rows(table, scene, wanted)?;
        let diameters = rows.iter().map(|row| diameters(table, *row, columns));
        let diameters: Vec<[Option<f64>; 2]> = diameters.collect::<Result<_, _>>()?;
        Ok(Self::sorted(data, |point| diameters[point]))
    }
}

fn diameter_columns(table: &Table, scene: &Scene) -> Result<[Option<usize>; 2], DataError> {
    let [first, second] = DIAMETERS;
    let columns = [table.find(&first)?, table.find(&second)?];
    for ((column, body), side) in columns.iter().zip(scene.bodies()).zip(SIDES) {
        if let (Some(column), None) = (column, body.diameter()) {
            let (header, name) = (&table.header()[*column], &body.name());
            let message = format!("{header} belongs to the {side} body, and \"{name}\" is a wall");
            let error = table.header_fault(message).in_column(header);
            return Err(error.with_help("leave the column out, or take a case of two spheres"));
        }
    }
    Ok(columns)
}

fn diameters(
    table: &Table,
    row: usize,
    columns: [Option<usize>; 2],
) -> Result<[Option<f64>; 2], DataError> {
    let mut diameters = [None, None];
    for (diameter, column) in diameters.iter_mut().zip(columns) {
        let Some(column) = column else { continue };
        let value = table.number(row, column, LENGTH)?;
        if value <= 0.0 {
            return Err(table.cell_fault(row, column, value, "it must be greater than 0"));
        }
        *diameter = Some(value);
    }
    Ok(diameters)
}
