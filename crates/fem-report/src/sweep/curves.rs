//! The curves of a panel of a sweep's figure, and their labels.

use std::collections::HashMap;

use fem_case::Sweep;

use super::choice::FigureChoice;
use super::labels::{plain, short_role};
use super::points::FigurePoint;

/// The members that differ only in the horizontal key.
#[derive(Clone, Debug)]
pub struct SweepCurve {
    /// Values of the other keys; empty if it is the only curve.
    pub label: String,
    /// Value of the other key, if there is one and it is a number.
    pub number: Option<f64>,
    /// (x, y, error of y) in SI, by increasing x.
    pub points: Vec<(f64, f64, f64)>,
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
        let place = *places.entry(own).or_insert_with(|| {
            let label = label(sweep, &elements, &choice.series);
            curves.push(SweepCurve { label, number, points: Vec::new(), reference: Vec::new() });
            curves.len() - 1
        });
        let x = choice.x.values[elements[choice.x.axis]];
        let values = point.values[panel];
        let error = values.error.unwrap_or(0.0);
        curves[place].points.extend(values.own.map(|y| (x, y, error)));
        curves[place].reference.extend(values.hertz.map(|y| (x, y)));
    }
    for curve in &mut curves {
        curve.points.sort_by(|a, b| a.0.total_cmp(&b.0));
        curve.reference.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    curves
}

/// Returns the label of a curve: the values of the axes that distinguish it.
fn label(sweep: &Sweep, elements: &[usize], axes: &[usize]) -> String {
    let part = |axis: &usize| {
        let of = &sweep.axes[*axis];
        let element = &of.values[elements[*axis]];
        let mut names: Vec<String> = Vec::new();
        let mut values: Vec<String> = Vec::new();
        for (k, key) in of.keys.iter().enumerate() {
            names.push(short_role(&key.key));
            values.push(plain(&element.displayed(k)));
        }
        names.dedup();
        values.dedup();
        let (names, values) = (names.join(", "), values.join(" and "));
        // The value of a model or a material needs no name.
        if names == "model" || names == "material" { values } else { format!("{names} = {values}") }
    };
    axes.iter().map(part).collect::<Vec<_>>().join(", ")
}
