//! What the picture of a sweep shows: which columns against which key, and what tells curves apart.

use fem::sweep::{COLUMNS, KeyNumbers};
use fem_case::{CaseError, Combine, Sweep};

/// Panels unless the sweep file names others.
const DEFAULT_COLUMNS: [&str; 4] =
    ["restitution", "contact_time_s", "peak_force_n", "max_contact_radius_m"];
/// Columns of text or of yes and no.
const NOT_NUMBERS: [&str; 3] = ["complete", "radius_and_pressure", "stopped_because"];

/// Which columns are drawn against which key.
#[derive(Clone, Debug)]
pub struct Choice {
    /// What is along the horizontal.
    pub x: Horizontal,
    /// Columns of the table, one panel each.
    pub y: Vec<&'static str>,
    /// The axes whose values tell curves apart.
    pub series: Vec<usize>,
    /// The values of the only one of those, if they are numbers.
    pub series_values: Option<Vec<f64>>,
}

/// A varied key along the horizontal of the picture.
#[derive(Clone, Debug)]
pub struct Horizontal {
    /// Which.
    pub key: usize,
    /// The axis that it is on.
    pub axis: usize,
    /// Its values, SI; counted from 1 if they are no numbers.
    pub values: Vec<f64>,
    /// Their unit.
    pub unit: Option<&'static str>,
    /// Whether they are counted.
    pub is_counted: bool,
}

impl Choice {
    /// The choice of a sweep file, or its default.
    ///
    /// # Errors
    /// Keys that are not varied, a horizontal key whose values are not numbers, unknown columns.
    pub fn of(sweep: &Sweep, numbers: &KeyNumbers) -> Result<Self, CaseError> {
        let keys: Vec<&str> = sweep.keys().map(|swept| swept.key.as_str()).collect();
        let places: Vec<(usize, usize)> = sweep.places().collect();
        let find = |place: &str, key: &str| {
            keys.iter().position(|known| *known == key).ok_or_else(|| {
                let error = sweep.error_at(place, format!("{key} is not varied"));
                error.with_help(format!("the varied keys are {}", keys.join(", ")))
            })
        };
        let horizontal = |key: usize| {
            let (axis, unit) = (places[key].0, numbers.unit(key).filter(|unit| !unit.is_empty()));
            let values = numbers.of_key(key)?;
            Some(Horizontal { key, axis, values, unit, is_counted: false })
        };
        let x = match &sweep.plot.x {
            Some(key) => {
                let key = find("plot.x", key)?;
                horizontal(key).ok_or_else(|| {
                    let error = sweep.error_at("plot.x", format!("{} has no numbers", keys[key]));
                    error.with_help("name a varied key whose values are numbers")
                })?
            }
            None => {
                let all = (0..keys.len()).filter_map(horizontal);
                // Of equal ones `max_by_key` takes the last.
                let longest = all.rev().max_by_key(|x| {
                    (n_distinct(&x.values), keys[x.key].ends_with("approach_speed"))
                });
                longest.unwrap_or_else(|| counted(sweep))
            }
        };
        let named = sweep.plot.series.as_ref().map(|key| find("plot.series", key)).transpose()?;
        if named == Some(x.key) {
            let error = sweep.error_at("plot.series", "x and series are the same key");
            return Err(error.with_help("series tells curves apart; leave it out"));
        }
        let series = match (named, sweep.combine) {
            (Some(key), _) => vec![places[key].0],
            // Paired keys run along with x, as linked ones do.
            (None, Combine::Paired) => Vec::new(),
            (None, Combine::All) => (0..sweep.axes.len()).filter(|axis| *axis != x.axis).collect(),
        };
        let series_values = match series.as_slice() {
            [axis] => (0..keys.len())
                .filter(|key| places[*key].0 == *axis)
                .find_map(|key| numbers.of_key(key)),
            _ => None,
        };
        let y = match &sweep.plot.y {
            None => DEFAULT_COLUMNS.to_vec(),
            Some(names) if names.is_empty() => {
                let error = sweep.error_at("plot.y", "y names no column");
                return Err(error.with_help("name columns of sweep.csv, such as [\"restitution\"]"));
            }
            Some(names) => {
                let column = |(k, name): (usize, &String)| column(sweep, k, name);
                names.iter().enumerate().map(column).collect::<Result<_, _>>()?
            }
        };
        Ok(Self { x, y, series, series_values })
    }
}

fn column(sweep: &Sweep, k: usize, name: &str) -> Result<&'static str, CaseError> {
    let columns = || COLUMNS.iter().map(String::as_str);
    let numbers = || columns().filter(|column| !NOT_NUMBERS.contains(column));
    numbers().find(|column| *column == name).ok_or_else(|| {
        let list: Vec<_> = numbers().collect();
        sweep
            .error_at(&format!("plot.y.{k}"), format!("{name} is no column with numbers"))
            .with_help(format!("the columns with numbers are {}", list.join(", ")))
    })
}

/// The longest axis of a sweep that has no numbers, its values counted.
fn counted(sweep: &Sweep) -> Horizontal {
    let lengths = sweep.axes.iter().map(|axis| axis.elements.len()).enumerate();
    let (axis, n) = lengths.rev().max_by_key(|(_, n)| *n).unwrap_or((0, 0));
    let key = sweep.places().position(|(of_key, _)| of_key == axis).unwrap_or(0);
    let values = (1..=n).map(|k| k as f64).collect();
    Horizontal { key, axis, values, unit: None, is_counted: true }
}

fn n_distinct(values: &[f64]) -> usize {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    sorted.len()
}
