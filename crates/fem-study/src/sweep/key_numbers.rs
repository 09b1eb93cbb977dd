//! The values of varied keys as numbers in SI, collected while the members are checked.

use fem_case::{CaseFile, Sweep};

use super::columns::key_column;

/// The number in SI of each value of each varied key.
#[derive(Clone, Debug)]
pub struct KeyNumbers(Vec<OfKey>);

#[derive(Clone, Debug)]
struct OfKey {
    axis: usize,
    unit: Option<&'static str>,
    /// The number of each element of the axis.
    numbers: Vec<Found>,
    /// Whether each value is written as its number in SI.
    is_written: bool,
}

#[derive(Clone, Copy, Debug)]
enum Found {
    /// No member with this element has been checked.
    NotYet,
    Number(f64),
    Other,
}

/// A column with the values of a varied key in SI.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NumberColumn {
    /// The name of the column.
    pub name: String,
    /// Index of the key.
    key: usize,
}

impl KeyNumbers {
    /// Creates the numbers of a sweep of which no member has been checked.
    pub fn new(sweep: &Sweep) -> Self {
        let of_key = |(axis, _): (usize, usize)| OfKey {
            axis,
            unit: None,
            numbers: vec![Found::NotYet; sweep.axes[axis].values.len()],
            is_written: true,
        };
        Self(sweep.places().map(of_key).collect())
    }

    /// Takes the resolved case of a member.
    pub fn see(&mut self, sweep: &Sweep, member: usize, case: &CaseFile) {
        let choice = sweep.choice(member);
        for ((of_key, swept), (axis, key)) in
            self.0.iter_mut().zip(sweep.keys()).zip(sweep.places())
        {
            let place = &mut of_key.numbers[choice[axis]];
            if !matches!(place, Found::NotYet) {
                continue;
            }
            let found = case.number_at(swept.parts());
            *place = found.map_or(Found::Other, |(number, _)| Found::Number(number));
            of_key.unit = of_key.unit.or(found.map(|(_, unit)| unit));
            let text = sweep.axes[axis].values[choice[axis]].text(key);
            of_key.is_written &= found.is_none_or(|(number, _)| text.parse() == Ok(number));
        }
    }

    /// Returns the values of a key by the elements of its axis, if all of them are numbers.
    pub fn of_key(&self, key: usize) -> Option<Vec<f64>> {
        let number = |found: &Found| match found {
            Found::Number(number) => Some(*number),
            Found::NotYet | Found::Other => None,
        };
        self.0[key].numbers.iter().map(number).collect()
    }

    /// Returns the SI unit of a key, empty for a plain number; `None` if no value is a number.
    pub fn unit(&self, key: usize) -> Option<&'static str> {
        self.0[key].unit
    }

    /// Returns the columns of keys that are quantities. A plain number that is written as such needs none.
    pub fn columns(&self, sweep: &Sweep) -> Vec<NumberColumn> {
        let column = |((key, of_key), swept): ((usize, &OfKey), &fem_case::SweptKey)| {
            let unit = of_key.unit.filter(|unit| !unit.is_empty() || !of_key.is_written)?;
            Some(NumberColumn { name: key_column(&swept.key, unit), key })
        };
        self.0.iter().enumerate().zip(sweep.keys()).filter_map(column).collect()
    }

    /// Returns the numbers of a member in these columns.
    pub fn row(&self, sweep: &Sweep, columns: &[NumberColumn], member: usize) -> Vec<Option<f64>> {
        let choice = sweep.choice(member);
        let number = |column: &NumberColumn| {
            let of_key = &self.0[column.key];
            match of_key.numbers[choice[of_key.axis]] {
                Found::Number(number) => Some(number),
                Found::NotYet | Found::Other => None,
            }
        };
        columns.iter().map(number).collect()
    }
}
