//! Measured restitutions, sorted by the pair of bodies they are of.

use std::path::Path;

use fem_case::{Case, CaseFile};

use crate::failure::Failure;
use crate::reduced::{CsvTable, Data, OtherColumns, points_of};

/// Columns that tell bodies apart, for the lower and the upper one; a sweep's own names last.
const DIAMETERS: [[&str; 2]; 2] =
    [["diameter_1", "body.0.sphere.diameter"], ["diameter_2", "body.1.sphere.diameter"]];
const SIDES: [&str; 2] = ["first", "second"];
const LENGTH: [i32; 3] = [1, 0, 0];

/// The data of a file by pairs of bodies.
#[derive(Debug)]
pub struct Measured {
    /// All points, in the order of the file.
    pub data: Data,
    /// In the order of their first points.
    pub bodies: Vec<Bodies>,
}

/// The points of one pair.
#[derive(Debug)]
pub struct Bodies {
    /// Diameters that the file gives in place of the case's, m.
    pub diameters: [Option<f64>; 2],
    /// Places in the data.
    pub points: Vec<usize>,
}

impl Bodies {
    /// Gives the spheres of a case the diameters of the file.
    pub fn resize(&self, file: &mut CaseFile) {
        for (body, diameter) in file.body.iter_mut().zip(self.diameters) {
            if let (Some(sphere), Some(diameter)) = (&mut body.sphere, diameter) {
                sphere.diameter = diameter.into();
            }
        }
    }
}

impl Measured {
    /// Restitutions of all points.
    pub fn restitutions(&self) -> Vec<f64> {
        self.data.points.iter().map(|point| point.restitution).collect()
    }

    /// For each point the first that is of the same collision: the same pair and speed.
    pub fn collisions(&self) -> Vec<usize> {
        let points = &self.data.points;
        let is_same = |a: usize, b: usize| {
            let (first, second) = (points[a].speed, points[b].speed);
            // Units round.
            (first - second).abs() <= 1e-12 * first && self.pair_of(a) == self.pair_of(b)
        };
        (0..points.len()).map(|k| (0..k).find(|j| is_same(*j, k)).unwrap_or(k)).collect()
    }

    /// A fault of a point.
    pub fn fault(&self, point: usize, message: impl std::fmt::Display) -> Failure {
        Failure::bad_input(format!("{}:{}: {message}", self.data.name, self.data.lines[point]))
    }

    /// The pair of each point.
    pub fn pair_of(&self, point: usize) -> usize {
        self.bodies.iter().position(|bodies| bodies.points.contains(&point)).unwrap_or(0)
    }
}

/// Reads a file.
///
/// # Errors
/// What is wrong, with file and line.
pub fn read_measured(path: &Path, case: &Case) -> Result<Measured, Failure> {
    let table = CsvTable::read(path)?;
    let [first, second] = DIAMETERS;
    let columns = [table.find(&first)?, table.find(&second)?];
    let may_vary: Vec<usize> = columns.iter().flatten().copied().collect();
    for ((column, body), side) in columns.iter().zip(&case.scene.bodies).zip(SIDES) {
        if let (Some(column), None) = (column, body.diameter()) {
            let (header, name) = (&table.header()[*column], &body.name);
            let message = format!("{header} is of the {side} body, and \"{name}\" is a wall");
            return Err(table
                .fault(table.header_line(), message)
                .with_help("leave the column out, or take a case of two spheres"));
        }
    }
    let others = OtherColumns { columns: &may_vary, names: &[first[0], second[0]] };
    let data = points_of(&table, &case.scene, false, others)?;
    let mut bodies: Vec<Bodies> = Vec::new();
    for (point, &row) in data.rows.iter().enumerate() {
        let mut diameters = [None, None];
        for (diameter, column) in diameters.iter_mut().zip(columns) {
            let Some(column) = column else { continue };
            let cell = table.number(row, column, LENGTH)?;
            if cell.value <= 0.0 {
                let message = format!("{} is {:?}", table.header()[column], cell.value);
                return Err(table.fault(cell.line, message).with_help("it must be greater than 0"));
            }
            *diameter = Some(cell.value);
        }
        match bodies.iter_mut().find(|known| known.diameters == diameters) {
            Some(known) => known.points.push(point),
            None => bodies.push(Bodies { diameters, points: vec![point] }),
        }
    }
    Ok(Measured { data, bodies })
}
