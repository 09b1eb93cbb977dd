//! Restitutions over speeds from a CSV file, measured or that of a sweep.

use std::path::Path;

use fem_case::Scene;
use fem_fit::Point;

use super::table::CsvTable;
use crate::failure::Failure;
use fem::sweep::COLUMNS;

/// The data of a file.
#[derive(Debug)]
pub struct Data {
    /// The file's name.
    pub name: String,
    /// In the order of the file.
    pub points: Vec<Point>,
    /// The row of the file that each point is from, counted from 0.
    pub rows: Vec<usize>,
    /// The line of the file that each point is from.
    pub lines: Vec<u64>,
    /// Rows of members that failed.
    pub n_left_out: usize,
    /// Columns that nobody reads.
    pub unread: Vec<String>,
}

impl Data {
    /// What was not looked at.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if self.n_left_out > 0 {
            warnings.push(format!("{} rows without a result were left out", self.n_left_out));
        }
        if !self.unread.is_empty() {
            warnings.push(format!("columns that are not read: {}", self.unread.join(", ")));
        }
        warnings
    }
}

/// Columns beyond the usual that a reader takes, and that may differ from row to row.
#[derive(Clone, Copy, Debug, Default)]
pub struct OtherColumns<'a> {
    /// Which they are.
    pub columns: &'a [usize],
    /// How they may be called.
    pub names: &'a [&'a str],
}

const SPEEDS: [&str; 6] =
    ["speed", "approach_speed", "impact_speed", "relative_speed", "velocity", "v"];
const RESTITUTIONS: [&str; 3] = ["restitution", "coefficient_of_restitution", "e"];
const UNCERTAINTIES: [&str; 5] =
    ["restitution_uncertainty", "e_uncertainty", "uncertainty", "sigma", "standard_error"];
const CONTACT_TIMES: [&str; 2] = ["contact_time", "t_contact"];
/// Names that need not be there, of which a near miss is no other name.
const OPTIONAL: [&str; 5] =
    ["restitution_uncertainty", "uncertainty", "standard_error", "sigma", "contact_time"];
/// What `cradle` and this reader's users write beside what is read.
const WRITTEN: [&str; 9] = [
    "speed_uncertainty",
    "first_after",
    "second_after",
    "alpha",
    "beta",
    "fitted_restitution",
    "residual",
    "fitted_contact_time",
    "member",
];
const SPEED: [i32; 3] = [1, 0, -1];
const TIME: [i32; 3] = [0, 0, 1];
/// Uncertainties above it tell nothing of a number between 0 and 1.
pub const LARGEST_UNCERTAINTY: f64 = 1.0;
/// Restitutions above it are no scatter of a measurement.
const LARGEST: f64 = 1.2;

/// Columns of a file.
struct Columns {
    /// Speeds that add up.
    speeds: Vec<usize>,
    /// Of bodies that have no column, m/s.
    other_speed: f64,
    restitution: usize,
    uncertainty: Option<usize>,
    contact_time: Option<usize>,
    complete: Option<usize>,
}

impl Columns {
    fn read(&self) -> Vec<usize> {
        let optional = [self.uncertainty, self.contact_time, self.complete];
        let required = self.speeds.iter().copied().chain([self.restitution]);
        required.chain(optional.into_iter().flatten()).collect()
    }
}

/// Reads a file; contact times only if they are wanted. The scene has the speed of a body that a
/// sweep does not vary.
///
/// # Errors
/// What is wrong, with file and line.
pub fn read_data(path: &Path, scene: &Scene, with_contact_time: bool) -> Result<Data, Failure> {
    points_of(&CsvTable::read(path)?, scene, with_contact_time, OtherColumns::default())
}

/// As [`read_data`], of a table with other columns.
///
/// # Errors
/// As [`read_data`].
pub fn points_of(
    table: &CsvTable,
    scene: &Scene,
    with_contact_time: bool,
    others: OtherColumns<'_>,
) -> Result<Data, Failure> {
    let columns = columns(table, scene, with_contact_time, others.columns)?;
    let unread = table.unread(
        &[&columns.read()[..], others.columns].concat(),
        &[&OPTIONAL[..], others.names].concat(),
        |name| {
            // A sweep's keys have points in their names; they are the same in all rows here.
            name.contains('.')
                || [COLUMNS, &WRITTEN, &CONTACT_TIMES].iter().any(|known| known.contains(&name))
        },
    )?;
    let (mut points, mut rows, mut lines) = (Vec::new(), Vec::new(), Vec::new());
    let mut n_left_out = 0;
    for row in 0..table.n_rows() {
        let is_failed = columns.complete.is_some_and(|column| table.text(row, column) == "false");
        if is_failed
            || (columns.complete.is_some() && table.text(row, columns.restitution).is_empty())
        {
            n_left_out += 1;
            continue;
        }
        points.push(point(table, &columns, row)?);
        rows.push(row);
        lines.push(table.line(row));
    }
    if points.is_empty() {
        return Err(Failure::bad_input(format!("{}: no row has a restitution", table.name())));
    }
    let with = points.iter().filter(|point| point.restitution_uncertainty.is_some()).count();
    if with != 0 && with != points.len() {
        let message =
            format!("{}: {with} of {} rows have an uncertainty", table.name(), points.len());
        return Err(Failure::bad_input(message).with_help("give one in every row, or in none"));
    }
    Ok(Data { name: table.name().to_string(), points, rows, lines, n_left_out, unread })
}

fn columns(
    table: &CsvTable,
    scene: &Scene,
    with_time: bool,
    may_vary: &[usize],
) -> Result<Columns, Failure> {
    let swept = |index: usize| {
        let name = format!("body.{index}.approach_speed");
        table.header().iter().position(|header| *header == name)
    };
    let swept = [swept(0), swept(1)];
    let own = [scene.bodies[0].velocity, -scene.bodies[1].velocity];
    let (speeds, other_speed) = if swept == [None, None] {
        (vec![table.require(&SPEEDS, "speed_m_s, or speed_cm_s")?], 0.0)
    } else {
        let fixed = swept.iter().zip(own).filter(|(column, _)| column.is_none());
        (swept.into_iter().flatten().collect(), fixed.map(|(_, speed)| speed).sum())
    };
    for (column, header) in table.header().iter().enumerate() {
        let varies =
            || (1..table.n_rows()).find(|row| table.text(*row, column) != table.text(0, column));
        if header.contains('.')
            && !speeds.contains(&column)
            && !may_vary.contains(&column)
            && let Some(row) = varies()
        {
            let line = table.line(row);
            return Err(table.fault(line, format!("the sweep varies {header}, too")).with_help(
                "a law is fitted to one pair of bodies: keep the rows of one, with their values in \
                 the case or in --set",
            ));
        }
    }
    Ok(Columns {
        speeds,
        other_speed,
        restitution: table.require(&RESTITUTIONS, "restitution")?,
        uncertainty: table.find(&UNCERTAINTIES)?,
        contact_time: if with_time { table.find(&CONTACT_TIMES)? } else { None },
        complete: table.find(&["complete"])?,
    })
}

fn point(table: &CsvTable, columns: &Columns, row: usize) -> Result<Point, Failure> {
    let line = table.line(row);
    let mut speed = columns.other_speed;
    for column in &columns.speeds {
        speed += table.number(row, *column, SPEED)?.value;
    }
    if speed <= 0.0 {
        return Err(table
            .fault(line, format!("the approach speed is {speed:?} m/s"))
            .with_help("it must be greater than 0"));
    }
    let restitution = table.number(row, columns.restitution, [0; 3])?.value;
    if !(0.0..=LARGEST).contains(&restitution) {
        return Err(table.fault(line, format!("the restitution is {restitution:?}")).with_help(
            "it must be from 0 to 1, and scatter takes it to 1.2 at the most; name the column \
             restitution_percent for per cents",
        ));
    }
    let optional = |column: Option<usize>, dimension| {
        let column = column.filter(|column| !table.text(row, *column).is_empty());
        let value = column.map(|column| table.number(row, column, dimension)).transpose()?;
        match value {
            Some(cell) if cell.value <= 0.0 => Err(table
                .fault(line, format!("{} is {:?}", table.header()[column.unwrap_or(0)], cell.value))
                .with_help("it must be greater than 0; leave the cell empty if there is none")),
            value => Ok(value.map(|cell| cell.value)),
        }
    };
    let restitution_uncertainty = optional(columns.uncertainty, [0; 3])?;
    if let Some(uncertainty) = restitution_uncertainty.filter(|u| *u > LARGEST_UNCERTAINTY) {
        let header = columns.uncertainty.map_or("", |column| &table.header()[column]);
        return Err(table.fault(line, format!("{header} is {uncertainty:?}")).with_help(
            "the uncertainty of a restitution is at most 1; name the column \
             restitution_uncertainty_percent for per cents",
        ));
    }
    Ok(Point {
        speed,
        restitution,
        restitution_uncertainty,
        contact_time: optional(columns.contact_time, TIME)?,
    })
}
