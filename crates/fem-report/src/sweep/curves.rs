//! The values of members that a sweep's figure draws, for a bounded number of members, and the curves of a panel.

use std::collections::HashMap;

use fem::results::Status;
use fem::sweep::{Row, column_below};
use fem_case::Sweep;
use fem_collision::QuantityOfInterest;
use serde_json::Value;

use super::choice::FigureChoice;
use super::labels::{key_symbol, plain};
use crate::answer::{error_parts, status};

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
    /// Its error bar; `None` if a part of it is unknown.
    pub error: Option<f64>,
    /// Whether a known effect is missing that moves it by an unknown amount.
    pub is_bound: bool,
    /// The value of Hertz' closed form.
    pub hertz: Option<f64>,
    /// The value that takes the place of the varied key.
    pub below: Option<f64>,
}

impl PanelValues {
    /// Returns the values of a quantity of interest.
    fn of_quantity(summary: &Value, quantity: QuantityOfInterest) -> Self {
        let own = summary[quantity.key()].as_f64();
        let error = error_parts(summary, quantity).sum();
        let is_bound = status(summary, quantity) == Status::Bound;
        Self { own, error, is_bound, ..Self::default() }
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
                let below = column_below(column).and_then(number);
                return PanelValues { own: number(column), below, ..PanelValues::default() };
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
    /// The points among them that are bounds.
    pub bounds: Vec<(f64, f64)>,
    /// Reference points: Hertz' results of the same members, or the limit; may be empty.
    pub reference: Vec<(f64, f64)>,
}

/// Returns the curves of the k-th panel, in the order of the sweep.
pub fn curves(
    sweep: &Sweep,
    points: &[FigurePoint],
    choice: &FigureChoice,
    panel: usize,
) -> Vec<SweepCurve> {
    let mut places: HashMap<Vec<usize>, usize> = HashMap::new();
    let mut curves: Vec<SweepCurve> = Vec::new();
    for point in points {
        let elements = sweep.choice(point.index);
        let own: Vec<usize> = choice.series.iter().map(|axis| elements[*axis]).collect();
        let number = choice.series_values.as_ref().map(|values| values[own[0]]);
        let place = *places.entry(own.clone()).or_insert_with(|| {
            let label = label(sweep, &elements, &choice.series);
            let (points, reference, bounds) = (Vec::new(), Vec::new(), Vec::new());
            curves.push(SweepCurve { label, place: own, number, points, bounds, reference });
            curves.len() - 1
        });
        let values = point.values[panel];
        let x = values.below.unwrap_or(choice.x.values[elements[choice.x.axis]]);
        if let Some(y) = values.own {
            curves[place].points.push((x, y, values.error.unwrap_or(0.0)));
            curves[place].bounds.extend(values.is_bound.then_some((x, y)));
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
