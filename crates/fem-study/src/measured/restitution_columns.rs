//! Which columns of a table hold speeds and restitutions, and what a row of them says.

use crate::fit::Point;
use fem_case::Scene;

use super::data_error::DataError;
use super::restitutions::LARGEST_UNCERTAINTY;
use super::table::Table;

pub(super) const SPEEDS: [&str; 10] = [
    "speed",
    "approach_speed",
    "impact_speed",
    "relative_speed",
    "incident_speed",
    "velocity",
    "impact_velocity",
    "relative_velocity",
    "incident_velocity",
    "v",
];
pub(super) const RESTITUTIONS: [&str; 5] =
    ["restitution", "coefficient_of_restitution", "restitution_coefficient", "cor", "e"];
pub(super) const UNCERTAINTIES: [&str; 5] =
    ["restitution_uncertainty", "e_uncertainty", "uncertainty", "sigma", "standard_error"];
pub(super) const CONTACT_TIMES: [&str; 2] = ["contact_time", "t_contact"];
const SPEED: [i32; 3] = [1, 0, -1];
const TIME: [i32; 3] = [0, 0, 1];
const NUMBER: [i32; 3] = [0; 3];
/// Restitutions above it are no scatter of a measurement.
const LARGEST: f64 = 1.2;

/// The columns that are read beside speeds and restitutions.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Wanted<'a> {
    /// Contact times, if there are any.
    pub contact_times: bool,
    /// Columns that are read by someone else, and may differ from row to row.
    pub others: &'a [usize],
    /// How those may be called.
    pub names: &'a [&'a str],
}

/// Columns of a table.
pub(super) struct Columns {
    /// Speeds that add up.
    speeds: Vec<usize>,
    /// Speeds of bodies that have no column, m/s.
    other_speed: f64,
    restitution: usize,
    uncertainty: Option<usize>,
    contact_time: Option<usize>,
    /// Whether a sweep's member came to its end.
    complete: Option<usize>,
}

impl Columns {
    pub fn of(table: &Table, scene: &Scene, wanted: Wanted<'_>) -> Result<Self, DataError> {
        let swept = [0, 1].map(|body| {
            let name = format!("body.{body}.approach_speed");
            table.header().iter().position(|header| *header == name)
        });
        let own = [scene.bodies()[0].velocity(), -scene.bodies()[1].velocity()];
        let (speeds, other_speed) = if swept == [None, None] {
            (vec![table.require(&SPEEDS, "speed_m_s, or speed_cm_s")?], 0.0)
        } else {
            let fixed = swept.iter().zip(own).filter(|(column, _)| column.is_none());
            (swept.into_iter().flatten().collect(), fixed.map(|(_, speed)| speed).sum())
        };
        check_same_bodies(table, &[&speeds[..], wanted.others].concat())?;
        Ok(Self {
            speeds,
            other_speed,
            restitution: table.require(&RESTITUTIONS, "restitution")?,
            uncertainty: table.find(&UNCERTAINTIES)?,
            contact_time: match wanted.contact_times {
                true => table.find(&CONTACT_TIMES)?,
                false => None,
            },
            complete: table.find(&["complete"])?,
        })
    }

    pub fn read(&self) -> Vec<usize> {
        let optional = [self.uncertainty, self.contact_time, self.complete];
        let required = self.speeds.iter().copied().chain([self.restitution]);
        required.chain(optional.into_iter().flatten()).collect()
    }

    /// A sweep has rows of members that failed, a measurement rows without a speed or a restitution.
    pub fn has_result(&self, table: &Table, row: usize) -> bool {
        // What stands first and is no number would be the unit of all that follows.
        if row == 0 && self.speeds.iter().any(|speed| is_text(table, *speed)) {
            return true;
        }
        let is_complete = |complete: usize| table.text(row, complete) != "false";
        self.complete.is_none_or(is_complete)
            && !table.is_missing(row, self.restitution)
            && !self.speeds.iter().any(|speed| table.is_missing(row, *speed))
    }

    pub fn point(&self, table: &Table, row: usize) -> Result<Point, DataError> {
        let mut speed = self.other_speed;
        for column in &self.speeds {
            speed += table.number(row, *column, SPEED)?;
        }
        if speed <= 0.0 {
            return Err(table
                .fault(row, format!("the approach speed is {speed:?} m/s"))
                .with_help("it must be greater than 0"));
        }
        let restitution = table.number(row, self.restitution, NUMBER)?;
        if !(0.0..=LARGEST).contains(&restitution) {
            return Err(table
                .fault(row, format!("the restitution is {restitution:?}"))
                .in_column(&table.header()[self.restitution])
                .with_help(
                    "it must be from 0 to 1, and scatter takes it to 1.2 at the most; name the \
                     column restitution_percent for per cents",
                ));
        }
        let restitution_uncertainty = match self.uncertainty {
            Some(column) => uncertainty(table, row, column)?,
            None => None,
        };
        let contact_time = match self.contact_time {
            Some(column) => positive(table, row, column, TIME)?,
            None => None,
        };
        Ok(Point { speed, restitution, restitution_uncertainty, contact_time })
    }
}

/// Whether the first cell of a column of speeds is neither a speed nor left out.
fn is_text(table: &Table, column: usize) -> bool {
    !table.is_missing(0, column) && table.number(0, column, SPEED).is_err()
}

/// Refuses a sweep that varies more than `may_vary`.
fn check_same_bodies(table: &Table, may_vary: &[usize]) -> Result<(), DataError> {
    for (column, header) in table.header().iter().enumerate() {
        let is_same = |row: usize| table.text(row, column) == table.text(0, column);
        // A sweep has its keys twice, as written and in SI.
        let is_twin = |other: &String| {
            let ending = header.strip_prefix(other.as_str());
            other.contains('.') && ending.is_some_and(|ending| ending.starts_with('_'))
        };
        if header.contains('.')
            && !may_vary.contains(&column)
            && !table.header().iter().any(is_twin)
            && let Some(row) = (1..table.n_rows()).find(|row| !is_same(*row))
        {
            let error = table.fault(row, format!("the sweep varies {header}, too"));
            return Err(error.in_column(header).with_help(
                "a law is fitted to one pair of bodies: keep the rows of one, with their values in \
                 the case or in an override of it",
            ));
        }
    }
    Ok(())
}

fn uncertainty(table: &Table, row: usize, column: usize) -> Result<Option<f64>, DataError> {
    let found = positive(table, row, column, NUMBER)?;
    if let Some(uncertainty) = found.filter(|found| *found > LARGEST_UNCERTAINTY) {
        let header = &table.header()[column];
        let error = table.fault(row, format!("{header} is {uncertainty:?}"));
        return Err(error.in_column(header).with_help(
            "the uncertainty of a restitution is at most 1; name the column \
             restitution_uncertainty_percent for per cents",
        ));
    }
    Ok(found)
}

/// A cell that may be empty.
fn positive(
    table: &Table,
    row: usize,
    column: usize,
    dimension: [i32; 3],
) -> Result<Option<f64>, DataError> {
    if table.is_missing(row, column) {
        return Ok(None);
    }
    let value = table.number(row, column, dimension)?;
    if value <= 0.0 {
        let header = &table.header()[column];
        return Err(table
            .fault(row, format!("{header} is {value:?}"))
            .in_column(header)
            .with_help("it must be greater than 0; leave the cell empty if there is none"));
    }
    Ok(Some(value))
}
