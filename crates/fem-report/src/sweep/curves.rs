//! The curves of a panel of a sweep's picture, and what they are called.

use std::collections::HashMap;

use fem_case::Sweep;

use super::picture_data::Choice;
use super::picture_points::PicturePoint;
use super::picture_words::{plain, short_role};

/// Points that belong together.
#[derive(Clone, Debug)]
pub struct Curve {
    /// What tells it apart; empty if it is the only one.
    pub label: String,
    /// Its number, if a number tells it apart.
    pub number: Option<f64>,
    /// SI, by increasing x: x, y and how far that may be off.
    pub points: Vec<(f64, f64, f64)>,
    /// What they are compared with; empty if there is nothing. Of the table: the same members by Hertz.
    pub reference: Vec<(f64, f64)>,
}

/// The curves of the panel that `panel` counts, in the order of the sweep.
pub fn curves(sweep: &Sweep, points: &[PicturePoint], choice: &Choice, panel: usize) -> Vec<Curve> {
    let mut places: HashMap<Vec<usize>, usize> = HashMap::new();
    let mut curves: Vec<Curve> = Vec::new();
    for point in points {
        let elements = sweep.choice(point.index);
        let own: Vec<usize> = choice.series.iter().map(|axis| elements[*axis]).collect();
        let number = choice.series_values.as_ref().map(|values| values[own[0]]);
        let place = *places.entry(own).or_insert_with(|| {
            let label = label(sweep, &elements, &choice.series);
            curves.push(Curve { label, number, points: Vec::new(), reference: Vec::new() });
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

/// What a curve is called: the values of the axes that tell it apart.
fn label(sweep: &Sweep, elements: &[usize], axes: &[usize]) -> String {
    let part = |axis: &usize| {
        let of = &sweep.axes[*axis];
        let element = &of.elements[elements[*axis]];
        let mut names: Vec<String> = Vec::new();
        let mut values: Vec<String> = Vec::new();
        for (k, key) in of.keys.iter().enumerate() {
            names.push(short_role(&key.key));
            values.push(plain(&element.said(k)));
        }
        names.dedup();
        values.dedup();
        let (names, values) = (names.join(", "), values.join(" and "));
        // A model or a material says what it is.
        if names == "model" || names == "material" { values } else { format!("{names} = {values}") }
    };
    axes.iter().map(part).collect::<Vec<_>>().join(", ")
}
