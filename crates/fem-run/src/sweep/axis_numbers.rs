//! What the values of varied keys are as numbers, found as the members are looked at.

use fem_case::{CaseFile, Sweep};
use serde_json::Value;

/// Of each element of each axis, its number in SI.
#[derive(Clone, Debug)]
pub struct AxisNumbers(Vec<Vec<Found>>);

#[derive(Clone, Copy, Debug)]
enum Found {
    /// No member with this element has been seen.
    NotYet,
    Number(f64),
    Other,
}

impl AxisNumbers {
    /// Of a sweep of which no member has been seen.
    pub fn new(sweep: &Sweep) -> Self {
        Self(sweep.axes.iter().map(|axis| vec![Found::NotYet; axis.elements.len()]).collect())
    }

    /// Takes the resolved case of a member.
    pub fn see(&mut self, sweep: &Sweep, member: usize, case: &CaseFile) {
        let choice = sweep.choice(member);
        let is_new =
            |(axis, element): (usize, &usize)| matches!(self.0[axis][*element], Found::NotYet);
        if !choice.iter().enumerate().any(is_new) {
            return;
        }
        let Ok(tree) = serde_json::to_value(case) else { return };
        for (axis, element) in choice.into_iter().enumerate() {
            let place = &mut self.0[axis][element];
            if let Found::NotYet = place {
                *place = number(sweep, axis, &tree).map_or(Found::Other, Found::Number);
            }
        }
    }

    /// The values of an axis, if all of them are numbers.
    pub fn of_axis(&self, axis: usize) -> Option<Vec<f64>> {
        let number = |found: &Found| match found {
            Found::Number(number) => Some(*number),
            Found::NotYet | Found::Other => None,
        };
        self.0[axis].iter().map(number).collect()
    }
}

/// The value of a varied key in a resolved case.
fn number(sweep: &Sweep, axis: usize, case: &Value) -> Option<f64> {
    let mut value = case;
    for part in sweep.axes[axis].parts() {
        value = match value {
            Value::Array(array) => array.get(part.parse::<usize>().ok()?)?,
            table => table.get(part)?,
        };
    }
    value.as_f64()
}
