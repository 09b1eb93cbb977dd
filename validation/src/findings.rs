//! Findings of a study: measurements, tables and figures.

use std::collections::BTreeMap;

use fem_figure::Chart;

/// A figure as SVG with its caption.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// A name for a file, unique in a claim: letters, digits, `_`.
    pub name: String,
    /// One or two sentences on what the figure shows.
    pub caption: String,
    /// A self-contained SVG document.
    pub svg: String,
}

/// A table of the findings.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Caption of the table.
    pub caption: String,
    /// Names of the columns.
    pub header: Vec<String>,
    /// The rows, each as long as the header.
    pub rows: Vec<Vec<String>>,
}

/// Measurements, tables and figures of a study.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Findings {
    /// Measured quantities by name, SI.
    pub quantities: BTreeMap<String, f64>,
    /// The figures, in order.
    pub figures: Vec<Figure>,
    /// The tables, in order.
    pub tables: Vec<Table>,
}

impl Findings {
    /// Returns empty findings.
    pub fn new() -> Self {
        Self::default()
    }

    /// Records a measured quantity, SI.
    pub fn measure(&mut self, quantity: impl Into<String>, value: f64) {
        self.quantities.insert(quantity.into(), value);
    }

    /// Records the larger of a quantity so far and a signed value; a NaN stays.
    pub fn measure_worst(&mut self, quantity: &str, value: f64) {
        let largest = self.quantities.entry(quantity.to_string()).or_insert(value);
        if value > *largest || value.is_nan() {
            *largest = value;
        }
    }

    /// Adds a figure of charts side by side; none if they have no points.
    pub fn draw(&mut self, name: &str, caption: impl Into<String>, charts: &[Chart]) {
        if let Some(svg) = fem_figure::svg(charts) {
            self.figures.push(Figure { name: name.into(), caption: caption.into(), svg });
        }
    }

    /// Adds a table.
    pub fn tabulate<const N: usize>(
        &mut self,
        caption: impl Into<String>,
        header: [&str; N],
        rows: impl IntoIterator<Item = [String; N]>,
    ) {
        self.tables.push(Table {
            caption: caption.into(),
            header: header.map(String::from).to_vec(),
            rows: rows.into_iter().map(|row| row.to_vec()).collect(),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measure_worst_keeps_the_largest_value_or_nan() {
        let worst = |values: &[f64]| {
            let mut findings = Findings::new();
            values.iter().for_each(|&value| findings.measure_worst("q", value));
            findings.quantities["q"]
        };
        assert_eq!(worst(&[1.0, 3.0, 2.0]), 3.0);
        assert_eq!(worst(&[-2.0, -3.0]), -2.0);
        assert!(worst(&[1.0, f64::NAN, 2.0]).is_nan());
        assert!(worst(&[f64::NAN, 2.0]).is_nan());
    }
}
