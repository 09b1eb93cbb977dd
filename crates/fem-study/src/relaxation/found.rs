//! The relaxation of a material from a table of moduli, with the checks of the data.

use std::f64::consts::TAU;

use fem_case::engineering::show;
use fem_case::schema::ActsOn;

use crate::measured::{DataError, Modulus, ModulusPoint, ModulusTable, TestKind};

use super::series::{FittedSeries, fit_series};

/// The least ratio of the largest to the smallest frequency or time.
const MIN_SPAN: f64 = 3.0;
/// The share by which a storage modulus may fall below one at a lower frequency, by scatter.
const MAX_FALL: f64 = 0.1;
/// The share by which two values at one frequency may differ.
const MAX_CONTRADICTION: f64 = 0.2;
/// Frequencies closer than this ratio are the same.
const SAME: f64 = 1.0 + 1e-6;
/// Temperatures of one block, K.
const SAME_TEMPERATURE: f64 = 3.0;
/// Root mean square of relative residuals above which a warning is given.
const LARGE_RMS: f64 = 0.1;

/// Settings of [`FoundRelaxation::of`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RelaxationSettings {
    /// Terms per decade; by the data without it.
    pub terms_per_decade: Option<f64>,
    /// The bulk modulus, Pa, which then is elastic; without it Poisson's ratio is constant.
    pub bulk_modulus: Option<f64>,
}

/// The relaxation that a table of moduli shows.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundRelaxation {
    /// The table of measured moduli.
    pub table: ModulusTable,
    /// The series through them.
    pub series: FittedSeries,
    /// Mean temperature of the rows, K, if the table has temperatures.
    pub temperature: Option<f64>,
    /// The elastic bulk modulus, Pa; Poisson's ratio is constant without it.
    pub bulk_modulus: Option<f64>,
}

impl FoundRelaxation {
    /// Fits a series to a table.
    ///
    /// # Errors
    /// The table spans too few frequencies or times, has several temperatures, or contradicts itself.
    pub fn of(table: ModulusTable, settings: RelaxationSettings) -> Result<Self, DataError> {
        let temperature = one_temperature(&table)?;
        check_span(&table)?;
        check_block(&table, &table.points)?;
        let table = match settings.bulk_modulus {
            Some(bulk) => of_shear(table, bulk)?,
            None => table,
        };
        let series = fit_series(table.kind, &table.points, settings.terms_per_decade);
        if series.terms.is_empty() {
            let message = "no loss and no change of the modulus is found: the material is elastic";
            let error = DataError::new(&table.name, message);
            return Err(error.with_help("leave relaxation out of the material"));
        }
        Ok(Self { table, series, temperature, bulk_modulus: settings.bulk_modulus })
    }

    /// Returns the modulus that was measured.
    pub fn modulus(&self) -> Modulus {
        self.table.modulus
    }

    /// Returns the moduli that relax.
    pub fn acts_on(&self) -> ActsOn {
        if self.bulk_modulus.is_some() { ActsOn::Shear } else { ActsOn::All }
    }

    /// Returns the smallest and the largest measured frequency, Hz; of a relaxation test 1/(2πt).
    pub fn band(&self) -> [f64; 2] {
        band(self.table.kind, &self.table.points)
    }

    /// Returns the weights G_k/G_0 and the relaxation times (s).
    pub fn weights(&self) -> Vec<(f64, f64)> {
        let whole = self.series.instantaneous_modulus();
        let terms = self.series.terms.iter();
        terms.map(|term| (term.modulus / whole, term.relaxation_time)).collect()
    }

    /// Returns what may be wrong, and what was not read.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if !self.table.unread.is_empty() {
            warnings.push(format!("columns not read: {}", self.table.unread.join(", ")));
        }
        if !self.table.modulus_is_named {
            warnings.push(
                "the columns do not say which modulus they are: Young's is taken; --modulus shear for G"
                    .to_string(),
            );
        }
        if self.series.rms > LARGE_RMS {
            warnings.push(format!(
                "the series misses the moduli by {:.0} % (rms): check the columns, the units and the temperatures",
                100.0 * self.series.rms
            ));
        }
        warnings
    }
}

/// Returns the smallest and the largest frequency of points, Hz.
fn band(kind: TestKind, points: &[ModulusPoint]) -> [f64; 2] {
    let frequency = |point: &ModulusPoint| match kind {
        TestKind::Oscillation => point.at / TAU,
        TestKind::Relaxation => (TAU * point.at).recip(),
    };
    let all = points.iter().map(frequency);
    all.fold([f64::INFINITY, 0.0], |[from, to], it| [from.min(it), to.max(it)])
}

/// Returns the table with shear moduli, G* = 3 K E*/(9 K − E*) of Hooke's law with an elastic bulk modulus K (Pa) and a complex
/// Young's modulus, by the correspondence principle.
fn of_shear(mut table: ModulusTable, bulk: f64) -> Result<ModulusTable, DataError> {
    if table.modulus == Modulus::Shear {
        return Ok(table);
    }
    if table.kind == TestKind::Relaxation {
        let message = "E(t) becomes G(t) only over frequency if the bulk modulus is elastic";
        let help = "leave out --bulk-modulus: Poisson's ratio is constant then";
        return Err(DataError::new(&table.name, message).with_help(help));
    }
    for point in &mut table.points {
        // Poisson's ratio is 1/2 − E/(6 K).
        if point.magnitude() >= 3.0 * bulk {
            let message = format!(
                "E is {}, and the bulk modulus {} leaves Poisson's ratio below 0",
                show(point.magnitude(), "Pa"),
                show(bulk, "Pa")
            );
            let error = DataError::new(&table.name, message).in_line(point.line);
            return Err(error.with_help("the bulk modulus of a solid is above a third of E"));
        }
        // 3 K E (9 K − Ē)/|9 K − E|²
        let (real, norm) =
            (9.0 * bulk - point.storage, (9.0 * bulk - point.storage).hypot(point.loss));
        let storage = point.storage * real - point.loss * point.loss;
        let loss = point.loss * real + point.storage * point.loss;
        let factor = 3.0 * bulk / norm / norm;
        (point.storage, point.loss) = (factor * storage, factor * loss);
    }
    table.modulus = Modulus::Shear;
    Ok(table)
}

fn one_temperature(table: &ModulusTable) -> Result<Option<f64>, DataError> {
    let known: Vec<f64> = table.points.iter().filter_map(|point| point.temperature).collect();
    let (from, to) = known
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(from, to), t| (from.min(*t), to.max(*t)));
    if to - from > SAME_TEMPERATURE {
        let message = format!("the temperatures go from {from:.1} K to {to:.1} K");
        let error = DataError::new(&table.name, message);
        return Err(error.with_help("keep the rows of one temperature"));
    }
    let n = known.len() as f64;
    Ok((!known.is_empty()).then(|| known.iter().sum::<f64>() / n))
}

fn check_span(table: &ModulusTable) -> Result<(), DataError> {
    let [from, to] = band(table.kind, &table.points);
    if to < MIN_SPAN * from {
        let (what, unit) = match table.kind {
            TestKind::Oscillation => ("frequency", "Hz"),
            TestKind::Relaxation => ("time", "s"),
        };
        let at = table.points[0].at;
        let at = if table.kind == TestKind::Oscillation { at / TAU } else { at };
        let message = match to < SAME * from {
            true => format!("all rows are of one {what}, {}", show(at, unit)),
            false => format!("the rows span a factor of only {:.2} of {what}", to / from),
        };
        let help = format!(
            "a relaxation needs the moduli over a factor of 3 of {what} or more, better over several decades"
        );
        return Err(DataError::new(&table.name, message).with_help(help));
    }
    Ok(())
}

/// Checks the rows of one temperature: a storage modulus rises with frequency, a relaxation modulus falls with time.
fn check_block(table: &ModulusTable, points: &[ModulusPoint]) -> Result<(), DataError> {
    let mut sorted: Vec<&ModulusPoint> = points.iter().collect();
    sorted.sort_by(|a, b| a.at.total_cmp(&b.at));
    let name = format!(
        "{}{}",
        table.modulus.symbol(),
        match table.kind {
            TestKind::Oscillation => "'",
            TestKind::Relaxation => "(t)",
        }
    );
    let at = |point: &ModulusPoint| match table.kind {
        TestKind::Oscillation => show(point.at / TAU, "Hz"),
        TestKind::Relaxation => show(point.at, "s"),
    };
    for pair in sorted.windows(2) {
        let [first, second] = [pair[0], pair[1]];
        let ratio = first.storage / second.storage;
        if second.at < SAME * first.at && ratio.max(ratio.recip()) > 1.0 + MAX_CONTRADICTION {
            let message = format!(
                "{name} is {} and in line {} it is {}, both at {}",
                show(second.storage, "Pa"),
                first.line,
                show(first.storage, "Pa"),
                at(first)
            );
            let help = "rows of different temperatures need a column of temperatures; rows of different samples are different tables";
            return Err(DataError::new(&table.name, message).in_line(second.line).with_help(help));
        }
    }
    // Over frequency the modulus rises; over time it falls.
    if table.kind == TestKind::Relaxation {
        sorted.reverse();
    }
    let mut highest = sorted[0];
    for point in sorted {
        if point.storage > highest.storage {
            highest = point;
        } else if point.storage < (1.0 - MAX_FALL) * highest.storage {
            let message = format!(
                "{name} is {} at {} and only {} at {}",
                show(highest.storage, "Pa"),
                at(highest),
                show(point.storage, "Pa"),
                at(point)
            );
            let help = "at one temperature the modulus of every passive solid rises with frequency and falls with time: \
                        check columns, units and resonances of the instrument";
            return Err(DataError::new(&table.name, message).in_line(point.line).with_help(help));
        }
    }
    Ok(())
}
