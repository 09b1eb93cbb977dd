//! The values of members that a sweep's figure draws, for a bounded number of members, and the curves of a panel.

use std::collections::HashMap;

use fem::sweep::Row;
use fem_case::Sweep;
use fem_collision::QuantityOfInterest;
use serde_json::Value;

use super::choice::FigureChoice;
use super::labels::{key_symbol, plain};
use crate::answer::{error_parts, estimate_of};

/// Most members that are drawn.
const MAX_MEMBERS: usize = 4_000;

/// A complete member.
#[derive(Clone, Debug, PartialEq)]
pub struct FigurePoint {
    /// Its index in the sweep.
    pub index: usize,
    /// Values for each panel.
    pub values: Vec<PanelValues>,
}

/// The values of a member in one panel; `None` if it has none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PanelValues {
    /// The computed value.
    pub own: Option<f64>,
    /// Its error bar, with the parts that are known.
    pub error: Option<f64>,
    /// Whether a part of the error is unknown.
    pub is_open: bool,
    /// The middle and half the range of the estimate that leads; not finite if it has no such value.
    pub estimate: Option<[f64; 2]>,
    /// The value of Hertz' closed form.
    pub hertz: Option<f64>,
}

/// Why a point of a curve is marked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointMark {
    /// A part of the error of the computed value is unknown.
    Open,
    /// The point is the middle of an estimate by closed forms, with its range as error bar.
    Estimated,
}

impl PanelValues {
    /// Returns the values of a quantity of interest.
    fn of_quantity(summary: &Value, quantity: QuantityOfInterest) -> Self {
        let parts = error_parts(summary, quantity);
        let leads = summary.get("estimate").is_some_and(|estimate| !estimate.is_null());
        let estimate = leads.then(|| {
            let [low, high] = estimate_of(summary, quantity).unwrap_or([f64::NAN; 2]);
            [0.5 * (low + high), 0.5 * (high - low)]
        });
        Self {
            own: summary[quantity.key()].as_f64(),
            error: parts.known(),
            is_open: parts.sum().is_none(),
            estimate,
            hertz: None,
        }
    }

    /// Returns value, error and mark of the point to draw. The estimate that leads takes the place of the computed value
    /// unless the curve is one over a resolution.
    fn drawn(&self, is_resolution: bool) -> Option<(f64, f64, Option<PointMark>)> {
        match self.estimate.filter(|_| !is_resolution) {
            Some([middle, half]) => {
                middle.is_finite().then_some((middle, half, Some(PointMark::Estimated)))
            }
            None => {
                let mark = self.is_open.then_some(PointMark::Open);
                Some((self.own?, self.error.unwrap_or(0.0), mark))
            }
        }
    }
}

/// Returns n if every n-th member is drawn.
fn stride(n_members: usize) -> usize {
    n_members.div_ceil(MAX_MEMBERS).max(1)
}

impl FigurePoint {
    /// Reads a row of a sweep; `None` if it failed or is not drawn.
    pub fn of(row: &Row, choice: &FigureChoice, n_members: usize) -> Option<Self> {
        if !row.is_complete() || !row.index.is_multiple_of(stride(n_members)) {
            return None;
        }
        let number = |column: &str| row.value(column).as_f64();
        let panel = |column: &&str| {
            let quantity = QuantityOfInterest::ALL.into_iter().find(|it| it.key() == *column);
            let Some(quantity) = quantity else {
                return PanelValues { own: number(column), ..PanelValues::default() };
            };
            // Hertz' restitution is 1.
            let has_hertz = quantity != QuantityOfInterest::Restitution;
            let hertz = has_hertz.then(|| number(&format!("hertz_{column}"))).flatten();
            PanelValues { hertz, ..PanelValues::of_quantity(&row.summary, quantity) }
        };
        Some(Self { index: row.index, values: choice.y.iter().map(panel).collect() })
    }
}

/// The members that differ only in the horizontal key.
#[derive(Clone, Debug)]
pub struct SweepCurve {
    /// Values of the other keys; empty if it is the only curve.
    pub label: String,
    /// Index of the value of each axis that distinguishes curves.
    pub place: Vec<usize>,
    /// Value of the other key, if there is one and it is a number.
    pub number: Option<f64>,
    /// (x, y, error of y) in SI, by increasing x.
    pub points: Vec<(f64, f64, f64)>,
    /// The points among them whose error is not known, or that are estimates.
    pub marked: Vec<(PointMark, (f64, f64))>,
    /// Reference points: Hertz' results of the same members, or the limit; may be empty.
    pub reference: Vec<(f64, f64)>,
}

/// Returns the curves of the k-th panel, in the order of the sweep; `is_resolution` says that they are over a key of the
/// resolution.
pub fn curves(
    sweep: &Sweep,
    points: &[FigurePoint],
    choice: &FigureChoice,
    panel: usize,
    is_resolution: bool,
) -> Vec<SweepCurve> {
    let mut places: HashMap<Vec<usize>, usize> = HashMap::new();
    let mut curves: Vec<SweepCurve> = Vec::new();
    for point in points {
        let elements = sweep.choice(point.index);
        let own: Vec<usize> = choice.series.iter().map(|axis| elements[*axis]).collect();
        let number = choice.series_values.as_ref().map(|values| values[own[0]]);
        let place = *places.entry(own.clone()).or_insert_with(|| {
            let label = label(sweep, &elements, &choice.series);
            let (points, reference, marked) = (Vec::new(), Vec::new(), Vec::new());
            curves.push(SweepCurve { label, place: own, number, points, marked, reference });
            curves.len() - 1
        });
        let x = choice.x.values[elements[choice.x.axis]];
        let values = point.values[panel];
        if let Some((y, error, mark)) = values.drawn(is_resolution) {
            curves[place].points.push((x, y, error));
            curves[place].marked.extend(mark.map(|mark| (mark, (x, y))));
        }
        curves[place].reference.extend(values.hertz.map(|y| (x, y)));
    }
    for curve in &mut curves {
        curve.points.sort_by(|a, b| a.0.total_cmp(&b.0));
        curve.reference.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    curves
}

/// Returns the label of a curve: the values of the axes that distinguish it.
pub fn label(sweep: &Sweep, elements: &[usize], axes: &[usize]) -> String {
    let part = |axis: &usize| {
        let of = &sweep.axes[*axis];
        let element = &of.values[elements[*axis]];
        let mut names: Vec<String> = Vec::new();
        let mut values: Vec<String> = Vec::new();
        for (k, key) in of.keys.iter().enumerate() {
            names.push(key_symbol(&key.key));
            values.push(plain(&element.displayed(k)));
        }
        names.dedup();
        values.dedup();
        let (names, values) = (names.join(", "), values.join(" and "));
        // The value of a model or a material needs no key.
        if names == "model" || names == "material" { values } else { format!("{names} = {values}") }
    };
    axes.iter().map(part).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_has_a_bounded_number_of_members() {
        assert_eq!([0, 1, MAX_MEMBERS].map(stride), [1; 3]);
        for n in [MAX_MEMBERS + 1, 10 * MAX_MEMBERS + 3, 1_000_000] {
            let n_drawn = n.div_ceil(stride(n));
            assert!(n_drawn <= MAX_MEMBERS && n_drawn > MAX_MEMBERS / 2, "{n}: {n_drawn}");
        }
    }
}
