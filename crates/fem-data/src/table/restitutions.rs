//! Restitutions over approach speeds, from a measurement or a sweep.

use fem_material::engineering::number;

use super::data_error::DataError;
use super::quantity::{Measured, impossible_restitution};
use fem_case::engineering::show;

/// A measured or computed collision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Approach speed, m/s.
    pub speed: f64,
    /// The restitution e.
    pub restitution: f64,
    /// Its standard uncertainty.
    pub restitution_uncertainty: Option<f64>,
    /// Contact time T, s, if it is fitted too.
    pub contact_time: Option<f64>,
}

impl Point {
    /// Creates a point of a restitution at a speed, m/s.
    pub fn new(speed: f64, restitution: f64) -> Self {
        Self { speed, restitution, restitution_uncertainty: None, contact_time: None }
    }
}

/// Larger restitutions are not the scatter of a measurement.
pub const MAX_RESTITUTION: f64 = 1.2;
/// Larger uncertainties carry no information about a number between 0 and 1.
pub const MAX_UNCERTAINTY: f64 = 1.0;

/// The words of a warning about restitutions that are bounds.
pub const ACCEPTED_BOUNDS: &str = "restitutions are upper bounds, taken as they are";

/// Restitutions over speeds, each with its place in the data.
///
/// ```
/// use fem_data::table::Restitutions;
///
/// let measured = Restitutions::of("glass", &[(0.2, 0.93), (0.5, 0.925)]);
/// assert_eq!(measured.points[1].restitution, 0.925);
/// assert_eq!(measured.fault(1, "too fast").to_string(), "glass: point 1: too fast");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Restitutions {
    /// The name of the data, such as their file's name.
    pub name: String,
    /// The points, in the order of the data.
    pub points: Vec<Point>,
    /// The line of each point in the text; empty for points from code.
    pub lines: Vec<u64>,
    /// Number of rows of failed members, or without a speed or a restitution.
    pub n_left_out: usize,
    /// Speeds (m/s) of restitutions that are upper bounds and are taken as they are.
    pub bounds: Vec<f64>,
    /// The treatment of an uncertainty that only some rows have.
    pub uneven: Option<UnevenUncertainties>,
    /// Columns that are not read.
    pub unread: Vec<String>,
    /// Sentences about rows that are left out and about derived speeds.
    pub notes: Vec<String>,
}

/// The treatment of an uncertainty that some rows have and others lack.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnevenUncertainties {
    /// So few rows lacked it that they were left out.
    RowsLeftOut {
        /// Number of rows without an uncertainty.
        n_without: usize,
    },
    /// So few rows had it that no row is weighed by it.
    NotUsed {
        /// Number of rows with an uncertainty.
        n_with: usize,
    },
}

/// The reason why an uncertainty cannot be set.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum UncertaintyError {
    /// The uncertainty is not greater than 0, or above [`MAX_UNCERTAINTY`].
    #[error("the uncertainty of a restitution is {}", number(*.0, 5))]
    OutOfRange(f64),
    /// The data have their own uncertainties.
    #[error("{0} has uncertainties of its own")]
    Known(String),
}

impl Restitutions {
    /// Creates restitutions from speeds (m/s) and their restitutions.
    pub fn of(name: &str, points: &[(f64, f64)]) -> Self {
        let points = points.iter().map(|(speed, e)| Point::new(*speed, *e)).collect();
        let name = name.to_string();
        let (lines, bounds) = (Vec::new(), Vec::new());
        let (unread, notes) = (Vec::new(), Vec::new());
        Self { name, points, lines, n_left_out: 0, bounds, uneven: None, unread, notes }
    }

    /// Gives all points the same standard uncertainty.
    ///
    /// # Errors
    /// The uncertainty is out of range, or the data have their own.
    pub fn set_uncertainty(&mut self, uncertainty: f64) -> Result<(), UncertaintyError> {
        if !(uncertainty > 0.0 && uncertainty <= MAX_UNCERTAINTY) {
            return Err(UncertaintyError::OutOfRange(uncertainty));
        }
        if self.points.iter().any(|point| point.restitution_uncertainty.is_some()) {
            return Err(UncertaintyError::Known(self.name.clone()));
        }
        for point in &mut self.points {
            point.restitution_uncertainty = Some(uncertainty);
        }
        Ok(())
    }

    /// Whether each restitution has an uncertainty.
    pub fn has_uncertainties(&self) -> bool {
        self.points.iter().all(|point| point.restitution_uncertainty.is_some())
    }

    /// Returns the slowest and the fastest speed, m/s.
    pub fn speeds(&self) -> (f64, f64) {
        let speeds = || self.points.iter().map(|point| point.speed);
        (speeds().fold(f64::INFINITY, f64::min), speeds().fold(0.0, f64::max))
    }

    /// Returns warnings about rows and columns that are not used.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = self.notes.clone();
        let rows = |n: usize| if n == 1 { "1 row".to_string() } else { format!("{n} rows") };
        if self.n_left_out > 0 {
            let rows = rows(self.n_left_out);
            warnings.push(format!("{rows} without a speed or a restitution left out"));
        }
        match self.uneven {
            Some(UnevenUncertainties::RowsLeftOut { n_without }) => {
                warnings.push(format!("{} without an uncertainty left out", rows(n_without)));
            }
            Some(UnevenUncertainties::NotUsed { n_with }) => warnings.push(format!(
                "only {} with an uncertainty, of {}: none is used; give one in most rows",
                rows(n_with),
                self.points.len()
            )),
            None => {}
        }
        warnings.extend(self.accepted_bounds());
        warnings.extend(self.impossible());
        if !self.unread.is_empty() {
            warnings.push(format!("columns that are not read: {}", self.unread.join(", ")));
        }
        warnings
    }

    /// Returns a warning of restitutions that are upper bounds and are taken as they are.
    pub fn accepted_bounds(&self) -> Option<String> {
        let n = self.bounds.len();
        let [slow, fast] = [(f64::INFINITY, f64::min as fn(f64, f64) -> f64), (0.0, f64::max)]
            .map(|(start, pick)| show(self.bounds.iter().copied().fold(start, pick), "m/s"));
        (n > 0).then(|| {
            format!("{n} of {} {ACCEPTED_BOUNDS}, from {slow} to {fast}", self.points.len())
        })
    }

    /// Returns a warning of the largest restitution above 1, which no collision has.
    fn impossible(&self) -> Option<String> {
        let above = |point: &&Point| point.restitution > 1.0;
        let n = self.points.iter().filter(above).count();
        let is_larger = |a: &&Point, b: &&Point| a.restitution.total_cmp(&b.restitution);
        let worst = self.points.iter().filter(above).max_by(is_larger)?;
        let place = self.points.iter().position(|point| point == worst).unwrap_or(0);
        let uncertainty = worst.restitution_uncertainty.unwrap_or(0.0);
        let reason = impossible_restitution(Measured { value: worst.restitution, uncertainty })?;
        let rows = if n == 1 { "1 row".to_string() } else { format!("{n} rows") };
        let what = format!(
            "{reason} in {rows}, at most {}: scatter, or a wrong column",
            worst.restitution
        );
        Some(self.fault(place, what).to_string())
    }

    /// Returns an error about a point with its line, or its index for a point from code.
    pub fn fault(&self, point: usize, message: impl std::fmt::Display) -> DataError {
        match self.lines.get(point) {
            Some(line) => DataError::new(&self.name, message).in_line(*line),
            None => DataError::new(&self.name, format!("point {point}: {message}")),
        }
    }
}
