//! Restitutions over speeds from a table, measured or that of a sweep.

use fem_case::Scene;

use crate::fit::Point;

use super::data_error::DataError;
use super::restitution_columns::{CONTACT_TIMES, Columns, Wanted};
use super::restitutions::{Restitutions, UnevenUncertainties};
use super::table::Table;
use crate::sweep::COLUMNS;

/// Names that need not be there, of which a near miss is no other name.
const OPTIONAL: [&str; 5] =
    ["restitution_uncertainty", "uncertainty", "standard_error", "sigma", "contact_time"];
/// Columns that tables of trials, fits and sweeps have beside them.
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
impl Restitutions {
    /// Reads a table with columns like `speed_m_s` and `restitution`, perhaps `restitution_uncertainty`, or
    /// of a sweep over speeds. The scene has the speed of a body that the sweep does not vary.
    ///
    /// # Errors
    /// The first thing that is wrong with the table.
    ///
    /// ```
    /// # use std::path::Path;
    /// # let text = "material.ice = { density = 917, youngs_modulus = 9.3e9, poissons_ratio = 0.33 }
    /// # [[body]]
    /// # name = 'floor'
    /// # wall = {}
    /// # [[body]]
    /// # name = 'ball'
    /// # sphere.diameter = 0.02
    /// # material = 'ice'
    /// # approach_speed = 0.1";
    /// # let case = fem_case::Case::parse("ball.toml", text, Path::new("."), &[])?;
    /// use fem_study::measured::{Restitutions, Table};
    ///
    /// let table = Table::parse("ice.csv", "speed_cm_s,e,sigma\n5,0.6,0.02\n20,0.4,0.02\n")?;
    /// let ice = Restitutions::read(&table, case.scene())?;
    /// assert_eq!(ice.points[1].speed, 0.2);
    /// assert_eq!(ice.points[1].restitution_uncertainty, Some(0.02));
    ///
    /// let table = Table::parse("ice.csv", "speed_cm_s,e\n5,60\n")?;
    /// let error = Restitutions::read(&table, case.scene()).unwrap_err();
    /// assert_eq!(error.to_string(), "ice.csv:2: the restitution is 60.0");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn read(table: &Table, scene: &Scene) -> Result<Self, DataError> {
        Ok(read_rows(table, scene, Wanted::default())?.0)
    }

    /// Restitutions, and contact times if the table has them.
    ///
    /// # Errors
    /// Those of [`Restitutions::read`].
    pub fn read_with_contact_times(table: &Table, scene: &Scene) -> Result<Self, DataError> {
        let wanted = Wanted { contact_times: true, ..Wanted::default() };
        Ok(read_rows(table, scene, wanted)?.0)
    }
}

/// The restitutions of a table, and the row that each is from.
///
/// # Errors
/// Those of [`Restitutions::read`].
pub(super) fn read_rows(
    table: &Table,
    scene: &Scene,
    wanted: Wanted<'_>,
) -> Result<(Restitutions, Vec<usize>), DataError> {
    let columns = Columns::of(table, scene, wanted)?;
    let unread = table.unread(
        &[&columns.read()[..], wanted.others].concat(),
        &[&OPTIONAL[..], wanted.names].concat(),
        |name| {
            // A sweep's keys have points in their names; they are the same in all rows here.
            name.contains('.')
                || COLUMNS.iter().any(|known| known == name)
                || [&WRITTEN[..], &CONTACT_TIMES].iter().any(|known| known.contains(&name))
        },
    )?;
    let (mut points, mut rows) = (Vec::new(), Vec::new());
    for row in 0..table.n_rows() {
        if columns.has_result(table, row) {
            points.push(columns.point(table, row)?);
            rows.push(row);
        }
    }
    if points.is_empty() {
        return Err(DataError::new(table.name(), "no row has a restitution"));
    }
    let n_left_out = table.n_rows() - points.len();
    let uneven = even_out(&mut points, &mut rows);
    let restitutions = Restitutions {
        name: table.name().to_string(),
        n_left_out,
        uneven,
        lines: rows.iter().map(|row| table.line(*row)).collect(),
        points,
        unread,
    };
    Ok((restitutions, rows))
}

/// Data are weighed all or none: of rows of which most have an uncertainty the others are left out, else
/// nobody's is looked at.
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
    Some(UnevenUncertainties::LeftOut { n_without })
}
