//! Reads restitutions over speeds from a table of a measurement or a sweep, of one pair of bodies or of several pairs
//! that the table distinguishes by their diameters.
//!
//! A body that falls from the height h₀ and rebounds to h₁ has v = √(2 g h₀) and e = √(h₁/h₀), without air drag.

use super::column_roles::{
    CONTACT_TIMES, DIAMETERS, DROP_HEIGHTS, REBOUND_HEIGHTS, REBOUND_SPEEDS, RESTITUTIONS, SPEEDS,
    is_key, is_numbered, is_one_of, uncertainties, uncertainty_of,
};
use super::csv_table::Table;
use super::data_error::DataError;
use super::pairs::MeasuredPairs;
use super::restitutions::Point;
use super::restitutions::{MAX_RESTITUTION, MAX_UNCERTAINTY, Restitutions, UnevenUncertainties};
use super::sweep_table::COLUMNS;
use fem_case::Scene;
use fem_collision::Status;

use crate::instruments::cradle::STANDARD_GRAVITY;
use fem_material::engineering::number;

/// Optional columns; a name that nearly equals one of them is an error.
const OPTIONAL: [&str; 5] =
    ["restitution_uncertainty", "uncertainty", "standard_error", "sigma", "contact_time"];
/// Other columns that tables of trials, fits and sweeps have.
const WRITTEN: &str = "speed_uncertainty time first_after second_after alpha beta fitted_restitution residual \
    fitted_contact_time member";

impl Restitutions {
    /// Reads a table with columns like `speed_m_s`, `restitution` and optionally `restitution_uncertainty`, or
    /// that of a sweep over speeds. The scene has the speed of a body that the sweep does not vary.
    ///
    /// # Errors
    /// The table has an error; the first one is returned.
    ///
    /// ```
    /// # use fem_case::schema::{BodyTable, MaterialTable};
    /// # use fem_case::{Case, CaseFile};
    /// # let ice = MaterialTable::from_youngs_modulus_poissons_ratio("917 kg/m^3", "9.3 GPa", 0.33);
    /// # let ball = BodyTable::sphere("ball", "2 cm", "ice").approaching("0.1 m/s");
    /// # let bodies = CaseFile::of_bodies(BodyTable::wall("floor"), ball);
    /// # let case = Case::of(bodies.with_material("ice", ice))?;
    /// use fem_data::table::{Restitutions, Table};
    ///
    /// let table = Table::parse("ice.csv", "speed_cm_s,e,sigma\n5,0.6,0.02\n20,0.4,0.02\n")?;
    /// let ice = Restitutions::read(&table, case.scene())?;
    /// assert_eq!(ice.points[1].speed, 0.2);
    /// assert_eq!(ice.points[1].restitution_uncertainty, Some(0.02));
    ///
    /// let table = Table::parse("ice.csv", "speed_cm_s,e\n5,60\n")?;
    /// let error = Restitutions::read(&table, case.scene()).unwrap_err();
    /// assert_eq!(error.to_string(), "ice.csv:2: the restitution is 60");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn read(table: &Table, scene: &Scene) -> Result<Self, DataError> {
        Ok(read_rows(table, scene, Wanted::default())?.0)
    }

    /// Returns the table with a mark that restitutions which are bounds are read as they are.
    pub fn as_elastic(table: Table) -> Table {
        table.with_name(STATUS, ACCEPTED_STATUS)
    }

    /// Reads restitutions, and contact times if the table has them.
    ///
    /// # Errors
    /// As [`Restitutions::read`].
    pub fn read_with_contact_times(table: &Table, scene: &Scene) -> Result<Self, DataError> {
        let wanted = Wanted { contact_times: true, ..Wanted::default() };
        Ok(read_rows(table, scene, wanted)?.0)
    }
}

/// Returns the restitutions of a table and the row of each.
///
/// # Errors
/// As [`Restitutions::read`].
fn read_rows(
    table: &Table,
    scene: &Scene,
    wanted: Wanted<'_>,
) -> Result<(Restitutions, Vec<usize>), DataError> {
    let columns = Columns::of(table, scene, wanted)?;
    let diameters = wanted.diameters.map_or(&[][..], |_| &["diameter_1", "diameter_2"]);
    let read = [&columns.read()[..], wanted.diameters.unwrap_or(&[])].concat();
    let unread = table.unread(&read, &[&OPTIONAL[..], diameters].concat(), |name| {
        // A sweep's keys have dots in their names; their values are the same in all rows here.
        is_key(name)
            || COLUMNS.iter().any(|known| known == name)
            || is_one_of(name, WRITTEN)
            || is_one_of(name, CONTACT_TIMES)
    })?;
    let (mut points, mut rows) = (Vec::new(), Vec::new());
    let mut n_left_out = 0;
    for row in 0..table.n_rows() {
        let n_before = points.len();
        for column in &columns.restitutions {
            if columns.has_result(row, *column) {
                points.push(columns.point(row, *column)?);
                rows.push(row);
            }
        }
        n_left_out += usize::from(points.len() == n_before);
    }
    if points.is_empty() {
        return Err(DataError::new(table.name(), "no row has a restitution"));
    }
    let uneven = even_out(&mut points, &mut rows);
    let accepted = columns.accepted;
    let bounds = points.iter().zip(&rows).filter(|(_, row)| columns.is_bound(**row, accepted));
    let restitutions = Restitutions {
        name: table.name().to_string(),
        n_left_out,
        bounds: bounds.map(|(point, _)| point.speed).collect(),
        uneven,
        lines: rows.iter().map(|row| table.line(*row)).collect(),
        points,
        unread,
        notes: [table.left_out(), &columns.notes()].concat(),
    };
    Ok((restitutions, rows))
}

/// Uncertainties weight all rows or none: if most rows have one, the others are left out; otherwise no uncertainty is
/// used.
fn even_out(points: &mut Vec<Point>, rows: &mut Vec<usize>) -> Option<UnevenUncertainties> {
    let has = |point: &Point| point.restitution_uncertainty.is_some();
    let n_with = points.iter().filter(|point| has(point)).count();
    let n_without = points.len() - n_with;
    if n_with == 0 || n_without == 0 {
        return None;
    }
    if n_with < n_without {
        points.iter_mut().for_each(|point| point.restitution_uncertainty = None);
        return Some(UnevenUncertainties::NotUsed { n_with });
    }
    let is_kept: Vec<bool> = points.iter().map(has).collect();
    let (mut of_points, mut of_rows) = (is_kept.iter(), is_kept.iter());
    points.retain(|_| of_points.next().is_some_and(|kept| *kept));
    rows.retain(|_| of_rows.next().is_some_and(|kept| *kept));
    Some(UnevenUncertainties::RowsLeftOut { n_without })
}

/// Column of a sweep that says what the restitution is.
const STATUS: &str = "restitution_status";
/// Its name where bounds are read as they are.
const ACCEPTED_STATUS: &str = "accepted_restitution_status";

/// The columns that are read in addition to speeds and restitutions.
#[derive(Clone, Copy, Debug, Default)]
struct Wanted<'a> {
    /// Whether contact times are read.
    pub contact_times: bool,
    /// Columns of diameters, which may differ from row to row, if these are read.
    pub diameters: Option<&'a [usize]>,
}

/// The quantity that a column gives for an impact or its rebound.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Said {
    Speed,
    Height,
    Restitution,
}

impl Said {
    /// Returns its dimension, and the power of the number to which the speed is proportional.
    fn row(self) -> ([i32; 3], f64) {
        match self {
            Self::Speed => ([1, 0, -1], 1.0),
            Self::Height => ([1, 0, 0], 0.5),
            Self::Restitution => ([0; 3], 1.0),
        }
    }

    /// Returns the speed at a height, m/s, or the number itself.
    fn speed(self, value: f64) -> f64 {
        match self {
            Self::Height => (2.0 * STANDARD_GRAVITY * value).sqrt(),
            Self::Speed | Self::Restitution => value,
        }
    }
}

/// The columns of a table that are read.
struct Columns<'a> {
    table: &'a Table,
    /// Speeds whose sum is the approach speed, or a height.
    speeds: Vec<usize>,
    /// The quantity that they are.
    approach: Said,
    /// Speeds of bodies that have no column, m/s.
    other_speed: f64,
    /// Restitutions of one row: several if an impact was repeated, `e1`, `e2`.
    restitutions: Vec<usize>,
    /// The quantity that they are.
    rebound: Said,
    uncertainty: Option<usize>,
    contact_time: Option<usize>,
    /// Whether the collision of a sweep's member is complete.
    complete: Option<usize>,
    /// Whether the restitution of a sweep's member is a bound.
    status: Option<usize>,
    /// The same where bounds are read as they are.
    accepted: Option<usize>,
}

impl<'a> Columns<'a> {
    fn of(table: &'a Table, scene: &Scene, wanted: Wanted<'_>) -> Result<Self, DataError> {
        let swept = [0, 1].map(|body| {
            let name = format!("body.{body}.approach_speed");
            table.header().iter().position(|header| *header == name)
        });
        let own = [scene.bodies()[0].velocity(), -scene.bodies()[1].velocity()];
        let height = |names: [&str; 2], other: Option<usize>| {
            let found = names.map(|names| table.find(names));
            let found = found.into_iter().find(|it| !matches!(it, Ok(None))).unwrap_or(Ok(None));
            found.map(|found| found.filter(|column| Some(*column) != other))
        };
        let (speeds, approach) = if swept == [None, None] {
            match (table.find(SPEEDS)?, height(DROP_HEIGHTS, None)?) {
                (None, Some(height)) => (vec![height], Said::Height),
                _ => (vec![table.require(SPEEDS, "speed_m_s, or speed_cm_s")?], Said::Speed),
            }
        } else {
            (swept.into_iter().flatten().collect(), Said::Speed)
        };
        let fixed = swept.iter().zip(own).filter(|(it, _)| swept != [None, None] && it.is_none());
        let other_speed = fixed.map(|(_, speed)| speed).sum();
        let repeats = |names: &str| -> Vec<usize> {
            let is_repeat = |column: &usize| is_numbered(&table.header()[*column], names);
            (0..table.header().len()).filter(is_repeat).collect()
        };
        let one = |column: Option<usize>| column.into_iter().collect::<Vec<_>>();
        let after = [
            (one(table.find(RESTITUTIONS)?), Said::Restitution),
            (one(table.find(REBOUND_SPEEDS)?), Said::Speed),
            (one(height(REBOUND_HEIGHTS, speeds.first().copied())?), Said::Height),
            (repeats(RESTITUTIONS), Said::Restitution),
            (repeats(REBOUND_HEIGHTS[0]), Said::Height),
        ];
        let (restitutions, rebound) = match after.into_iter().find(|it| !it.0.is_empty()) {
            Some(found) => found,
            None => (vec![table.require(RESTITUTIONS, "restitution")?], Said::Restitution),
        };
        check_same_bodies(table, &[&speeds[..], wanted.diameters.unwrap_or(&[])].concat())?;
        let contact_time = if wanted.contact_times { table.find(CONTACT_TIMES)? } else { None };
        Ok(Self {
            table,
            speeds,
            other_speed,
            approach,
            restitutions,
            rebound,
            uncertainty: table.find(uncertainties())?,
            contact_time,
            complete: table.find("complete")?,
            status: table.find(STATUS)?,
            accepted: table.find(ACCEPTED_STATUS)?,
        })
    }

    /// Returns what follows from the kinds of columns.
    fn notes(&self) -> Vec<String> {
        let has_height = [self.approach, self.rebound].contains(&Said::Height);
        let note =
            "speeds follow from heights, sqrt(2 g h) with 9.80665 m/s²: air drag is left out";
        has_height.then(|| note.to_string()).into_iter().collect()
    }

    fn read(&self) -> Vec<usize> {
        let Self { uncertainty, contact_time, complete, status, accepted, .. } = *self;
        let optional = [uncertainty, contact_time, complete, status, accepted];
        let required = self.speeds.iter().chain(&self.restitutions).copied();
        required.chain(optional.into_iter().flatten()).collect()
    }

    /// Whether a row has a result: a sweep has rows of failed members, a measurement rows without a speed or a restitution.
    fn has_result(&self, row: usize, restitution: usize) -> bool {
        let table = self.table;
        // A first cell that is no number may be the unit of the column: it is an error.
        let is_text = |column: &usize| {
            !table.is_missing(0, *column)
                && table.number(0, *column, self.approach.row().0).is_err()
        };
        if row == 0 && self.speeds.iter().any(is_text) {
            return true;
        }
        self.complete.is_none_or(|complete| table.text(row, complete) != "false")
            && !table.is_missing(row, restitution)
            && !self.speeds.iter().any(|speed| table.is_missing(row, *speed))
    }

    fn point(&self, row: usize, column: usize) -> Result<Point, DataError> {
        let table = self.table;
        let mut speed = self.other_speed;
        for speeds in &self.speeds {
            let value = table.number(row, *speeds, self.approach.row().0)?;
            if self.approach == Said::Height && value <= 0.0 {
                let help = "a height of a drop is greater than 0";
                return Err(table.cell_fault(row, *speeds, value, help));
            }
            speed += self.approach.speed(value);
        }
        if speed <= 0.0 {
            return Err(table
                .fault(row, format!("the approach speed is {} m/s", number(speed, 5)))
                .with_help("it must be greater than 0"));
        }
        let rebound = table.number(row, column, self.rebound.row().0)?;
        let restitution = match self.rebound {
            Said::Restitution => rebound,
            // A speed after the impact may have the opposite sign.
            Said::Speed => rebound.abs() / speed,
            Said::Height => self.rebound.speed(rebound) / speed,
        };
        if !(0.0..=MAX_RESTITUTION).contains(&restitution) {
            return Err(table
                .fault(row, format!("the restitution is {}", number(restitution, 5)))
                .in_column(&table.header()[column])
                .with_help(
                    "it must be from 0 to 1, or to 1.2 with scatter; name the column \
                     restitution_percent for per cents",
                ));
        }
        if self.is_bound(row, self.status) {
            let message = format!(
                "the restitution {} is an upper bound, and no number for a law",
                number(restitution, 5)
            );
            return Err(table.fault(row, message).in_column(STATUS).with_help(
                "give the materials a relaxation or a strength and run the sweep again, name a measured value, or write \
                 --as-elastic",
            ));
        }
        let restitution_uncertainty = match self.uncertainty {
            Some(own) => positive(table, row, own, [0; 3])?,
            None => self.derived_uncertainty(row, column, restitution)?,
        };
        if let Some((own, found)) = self.uncertainty.zip(restitution_uncertainty)
            && found > MAX_UNCERTAINTY
        {
            let help = "the uncertainty of a restitution is at most 1; name the column \
                        restitution_uncertainty_percent for per cents";
            return Err(table.cell_fault(row, own, found, help));
        }
        let contact_time = self.contact_time.map(|own| positive(table, row, own, [0, 0, 1]));
        let contact_time = contact_time.transpose()?.flatten();
        Ok(Point { speed, restitution, restitution_uncertainty, contact_time })
    }

    /// Returns the standard uncertainty of a restitution that follows from heights or speeds with uncertainties.
    fn derived_uncertainty(
        &self,
        row: usize,
        column: usize,
        restitution: f64,
    ) -> Result<Option<f64>, DataError> {
        if self.rebound == Said::Restitution {
            return Ok(None);
        }
        let table = self.table;
        let mut relative = None;
        let approach = self.speeds.iter().map(|column| (*column, self.approach));
        for (column, said) in approach.chain([(column, self.rebound)]) {
            let (dimension, power) = said.row();
            let Some(own) = table.position(&uncertainty_of(&table.header()[column])) else {
                continue;
            };
            if let Some(found) = positive(table, row, own, dimension)? {
                let share = power * found / table.number(row, column, dimension)?.abs();
                relative = Some(share.hypot(relative.unwrap_or(0.0)));
            }
        }
        Ok(relative.map(|relative: f64| relative * restitution))
    }

    /// Returns whether a column of statuses says that the restitution of a row is a bound.
    fn is_bound(&self, row: usize, status: Option<usize>) -> bool {
        status.is_some_and(|status| self.table.text(row, status) == Status::Bound.word())
    }
}

/// Rejects a sweep that varies columns other than `may_vary`.
fn check_same_bodies(table: &Table, may_vary: &[usize]) -> Result<(), DataError> {
    for (column, header) in table.header().iter().enumerate() {
        let is_same = |row: usize| table.text(row, column) == table.text(0, column);
        // A sweep has each key twice, as written and in SI.
        let is_twin = |other: &String| {
            let ending = header.strip_prefix(other.as_str());
            is_key(other) && ending.is_some_and(|ending| ending.starts_with('_'))
        };
        if is_key(header)
            && !may_vary.contains(&column)
            && !table.header().iter().any(is_twin)
            && let Some(row) = (1..table.n_rows()).find(|row| !is_same(*row))
        {
            let error = table.fault(row, format!("the sweep varies {header} as well"));
            return Err(error.in_column(header).with_help(
                "a law is fitted to one pair of bodies: keep the rows of one, with their values in \
                 the case or in an override of it",
            ));
        }
    }
    Ok(())
}

/// Returns the positive number of a cell; `None` for a cell without a value.
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
        let help = "it must be greater than 0; leave the cell empty if there is none";
        return Err(table.cell_fault(row, column, value, help));
    }
    Ok(Some(value))
}

impl MeasuredPairs {
    /// Reads a table as [`Restitutions::read`] does; columns like `diameter_1_mm` and
    /// `diameter_2_mm` distinguish several pairs. The scene shows which body is a wall.
    ///
    /// # Errors
    /// The table has an error; the first one is returned.
    pub fn read(table: &Table, scene: &Scene) -> Result<Self, DataError> {
        let columns = [table.find(DIAMETERS[0])?, table.find(DIAMETERS[1])?];
        for ((column, body), side) in columns.iter().zip(scene.bodies()).zip(["first", "second"]) {
            if let (Some(column), None) = (column, body.diameter()) {
                let (header, name) = (&table.header()[*column], &body.name());
                let message =
                    format!("{header} belongs to the {side} body, and \"{name}\" is a wall");
                let error = table.header_fault(message).in_column(header);
                return Err(error.with_help("leave the column out, or take a case of two spheres"));
            }
        }
        let others: Vec<usize> = columns.iter().flatten().copied().collect();
        let wanted = Wanted { diameters: Some(&others), contact_times: false };
        let (data, rows) = read_rows(table, scene, wanted)?;
        let diameter = |row: usize, column: usize| match table.number(row, column, [1, 0, 0])? {
            value if value > 0.0 => Ok(value),
            value => Err(table.cell_fault(row, column, value, "it must be greater than 0")),
        };
        let mut diameters = Vec::with_capacity(rows.len());
        for row in rows {
            let [first, second] = columns.map(|it| it.map(|column| diameter(row, column)));
            diameters.push([first.transpose()?, second.transpose()?]);
        }
        Ok(Self::sorted(data, |point| diameters[point]))
    }
}
