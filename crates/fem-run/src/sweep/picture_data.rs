//! What the picture of a sweep shows: which columns against which key, and the curves.

use fem::sweep::{COLUMNS, KeyNumbers};
use fem_case::{CaseError, Combine, Sweep};

use super::picture_points::PicturePoint;

/// Panels unless the sweep file names others.
const DEFAULT_COLUMNS: [&str; 4] =
    ["restitution", "contact_time_s", "peak_force_n", "max_contact_radius_m"];
/// Columns of text or of yes and no.
const NOT_NUMBERS: [&str; 2] = ["complete", "stopped_because"];
/// Which columns are drawn against which key.
#[derive(Clone, Debug)]
pub struct Choice {
    /// What is along the horizontal; none if no key has numbers.
    pub x: Option<Horizontal>,
    /// Columns of the table, one panel each.
    pub y: Vec<&'static str>,
    /// The key whose values tell curves apart; those of all other axes together if none.
    pub series: Option<usize>,
}

/// A varied key along the horizontal of the picture.
#[derive(Clone, Debug)]
pub struct Horizontal {
    /// Which.
    pub key: usize,
    /// The axis that it is on.
    pub axis: usize,
    /// Its values, SI.
    pub values: Vec<f64>,
    /// Their unit.
    pub unit: Option<&'static str>,
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
            Some(Horizontal { key, axis, values: numbers.of_key(key)?, unit })
        };
        let x = match &sweep.plot.x {
            Some(key) => {
                let key = find("plot.x", key)?;
                Some(horizontal(key).ok_or_else(|| {
                    let error = sweep.error_at("plot.x", format!("{} has no numbers", keys[key]));
                    error.with_help("name a varied key whose values are numbers")
                })?)
            }
            None => (0..keys.len()).find_map(horizontal),
        };
        let series = sweep.plot.series.as_ref().map(|key| find("plot.series", key)).transpose()?;
        if series.is_some() && series == x.as_ref().map(|x| x.key) {
            let error = sweep.error_at("plot.series", "x and series are the same key");
            return Err(error.with_help("series tells curves apart; leave it out"));
        }
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
        Ok(Self { x, y, series })
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

/// Points that belong together.
#[derive(Clone, Debug)]
pub struct Curve {
    /// What tells it apart; empty if it is the only one.
    pub label: String,
    /// SI, by increasing x.
    pub points: Vec<(f64, f64)>,
    /// The same members by Hertz; empty if Hertz has no such column.
    pub hertz: Vec<(f64, f64)>,
}

/// One curve a series of the panel that `panel` counts. Curves come in the order of the sweep.
pub fn curves(
    sweep: &Sweep,
    points: &[PicturePoint],
    choice: &Choice,
    x: &Horizontal,
    panel: usize,
) -> Vec<Curve> {
    let mut curves: Vec<Curve> = Vec::new();
    for point in points {
        let label = label(sweep, point.index, choice, x.axis);
        let known = curves.iter().position(|curve| curve.label == label);
        let place = known.unwrap_or_else(|| {
            curves.push(Curve { label, points: Vec::new(), hertz: Vec::new() });
            curves.len() - 1
        });
        let x = x.values[sweep.choice(point.index)[x.axis]];
        let [own, hertz] = point.values[panel];
        curves[place].points.extend(own.map(|y| (x, y)));
        curves[place].hertz.extend(hertz.map(|y| (x, y)));
    }
    for curve in &mut curves {
        curve.points.sort_by(|a, b| a.0.total_cmp(&b.0));
        curve.hertz.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    curves
}

fn label(sweep: &Sweep, member: usize, choice: &Choice, x: usize) -> String {
    let is_part = |key: usize, axis: usize| match (choice.series, sweep.combine) {
        (Some(series), _) => key == series,
        // Paired keys run along with x, as linked ones do.
        (None, Combine::Paired) => false,
        (None, Combine::All) => axis != x,
    };
    let values = sweep.values(member);
    let parts = sweep.keys().zip(sweep.places()).enumerate();
    let parts =
        parts.filter(|(key, (_, (axis, _)))| is_part(*key, *axis)).map(|(key, (swept, _))| {
            let name = swept.parts().last().unwrap_or_default();
            format!("{} {}", name.replace('_', " "), values[key])
        });
    parts.collect::<Vec<_>>().join(", ")
}
