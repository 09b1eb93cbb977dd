//! A table of the program's own, by columns.

use std::collections::HashMap;
use std::path::Path;

/// Columns by name; what is blank or no number is NaN.
#[derive(Default)]
pub struct Columns {
    names: Vec<String>,
    numbers: HashMap<String, Vec<f64>>,
    texts: HashMap<String, Vec<String>>,
}

impl Columns {
    /// Reads a file; `None` if there is none or it is no table.
    pub fn read(path: &Path) -> Option<Self> {
        let mut file = csv::Reader::from_path(path).ok()?;
        let names: Vec<String> = file.headers().ok()?.iter().map(String::from).collect();
        let mut numbers = vec![Vec::new(); names.len()];
        let mut texts = vec![Vec::new(); names.len()];
        let mut row = csv::StringRecord::new();
        while file.read_record(&mut row).ok()? {
            for (k, field) in row.iter().enumerate() {
                numbers[k].push(field.parse().unwrap_or(f64::NAN));
                if names[k] == "label" {
                    texts[k].push(field.to_string());
                }
            }
        }
        Some(Self {
            numbers: names.iter().cloned().zip(numbers).collect(),
            texts: names.iter().cloned().zip(texts).collect(),
            names,
        })
    }

    /// The names, in the order of the file.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The numbers of a column; none where there is no such column.
    pub fn get(&self, name: &str) -> &[f64] {
        self.numbers.get(name).map_or(&[], Vec::as_slice)
    }

    /// The texts of a column of texts.
    pub fn texts(&self, name: &str) -> &[String] {
        self.texts.get(name).map_or(&[], Vec::as_slice)
    }

    /// A column at a time, s, by the line between the rows around; NaN beyond the table.
    pub fn at(&self, name: &str, time: f64) -> f64 {
        let (times, values) = (self.get("time_s"), self.get(name));
        let after = times.partition_point(|row| *row < time);
        match (after.checked_sub(1), values.get(after)) {
            (None, Some(value)) if times[after] == time => *value,
            (Some(before), Some(value)) => {
                let share = (time - times[before]) / (times[after] - times[before]);
                values[before] + share * (value - values[before])
            }
            _ => f64::NAN,
        }
    }
}
