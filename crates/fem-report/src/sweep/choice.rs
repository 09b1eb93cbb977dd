//! The choice of what a sweep's figure shows: columns, the horizontal key, and the keys that distinguish curves.

use fem::ZERO_CELSIUS;
use fem::sweep::{COLUMNS, KeyNumbers};
use fem_case::{CaseError, Combine, Sweep};

/// Columns that are drawn by default.
const DEFAULT_COLUMNS: [&str; 4] =
    ["restitution", "contact_time_s", "peak_force_n", "max_contact_radius_m"];
/// Spellings of the degree Celsius.
const CELSIUS: [&str; 2] = ["degC", "°C"];
/// Columns of text or of true and false.
const NOT_NUMBERS: [&str; 3] = ["complete", "radius_and_pressure", "stopped_because"];

/// The columns that are drawn, and the key that they are drawn over.
#[derive(Clone, Debug)]
pub struct FigureChoice {
    /// The horizontal key.
    pub x: HorizontalKey,
    /// Columns of the table, one panel each.
    pub y: Vec<&'static str>,
    /// The axes whose values distinguish curves.
    pub series: Vec<usize>,
    /// Values of the only such axis, if they are numbers.
    pub series_values: Option<Vec<f64>>,
}

/// The varied key along the horizontal axis.
#[derive(Clone, Debug)]
pub struct HorizontalKey {
    /// Index of the key.
    pub key: usize,
    /// Axis of the sweep that the key belongs to.
    pub axis: usize,
    /// Values in SI, temperatures in °C if they are written so, or counted from 1 if they are not numbers.
    pub values: Vec<f64>,
    /// Unit of the values.
    pub unit: Option<&'static str>,
    /// Whether the values are counted.
    pub is_counted: bool,
}

impl FigureChoice {
    /// Returns the choice of a sweep file, or the default.
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
            let mut values = numbers.of_key(key)?;
            let first = sweep.axes[axis].values.first();
            let is_celsius = first.is_some_and(|it| {
                let text = it.displayed(places[key].1);
                CELSIUS.iter().any(|unit| text.ends_with(unit))
            });
            let unit = match unit {
                Some("rad") => {
                    values.iter_mut().for_each(|value| *value = value.to_degrees());
                    Some("°")
                }
                Some("K") if is_celsius => {
                    values.iter_mut().for_each(|value| *value -= ZERO_CELSIUS);
                    Some("°C")
                }
                unit => unit,
            };
            Some(HorizontalKey { key, axis, values, unit, is_counted: false })
        };
        let x = match &sweep.plot.x {
            Some(key) => {
                let key = find("plot.x", key)?;
                horizontal(key).ok_or_else(|| {
                    let error = sweep
                        .error_at("plot.x", format!("the values of {} are not numbers", keys[key]));
                    error.with_help("name a varied key whose values are numbers")
                })?
            }
            None => {
                let all = (0..keys.len()).filter_map(horizontal);
                // If counts are equal, `max_by_key` takes the last.
                let longest = all.rev().max_by_key(|x| {
                    (n_distinct(&x.values), keys[x.key].ends_with("approach_speed"))
                });
                longest.unwrap_or_else(|| counted(sweep))
            }
        };
        let named = sweep.plot.series.as_ref().map(|key| find("plot.series", key)).transpose()?;
        if named == Some(x.key) {
            let error = sweep.error_at("plot.series", "x and series name the same key");
            return Err(
                error.with_help("leave series out, or name a key that distinguishes curves")
            );
        }
        let series = match (named, sweep.combine) {
            (Some(key), _) => vec![places[key].0],
            // Paired keys vary together with x.
            (None, Combine::Paired) => Vec::new(),
            (None, Combine::All) => {
                let differs = |axis: &usize| *axis != x.axis && sweep.axes[*axis].values.len() > 1;
                (0..sweep.axes.len()).filter(differs).collect()
            }
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
            .error_at(&format!("plot.y.{k}"), format!("{name} is not a column of numbers"))
            .with_help(format!("the columns of numbers are {}", list.join(", ")))
    })
}

/// Returns the longest axis of a sweep without numbers, with its values counted.
fn counted(sweep: &Sweep) -> HorizontalKey {
    let lengths = sweep.axes.iter().map(|axis| axis.values.len()).enumerate();
    let (axis, n) = lengths.rev().max_by_key(|(_, n)| *n).unwrap_or((0, 0));
    let key = sweep.places().position(|(of_key, _)| of_key == axis).unwrap_or(0);
    let values = (1..=n).map(|k| k as f64).collect();
    HorizontalKey { key, axis, values, unit: None, is_counted: true }
}

fn n_distinct(values: &[f64]) -> usize {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    sorted.len()
}
