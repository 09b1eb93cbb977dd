//! The values of members that a sweep's figure draws, for a bounded number of members.

use fem::sweep::{COLUMNS, Row};

use super::choice::FigureChoice;

/// Most members that are drawn.
const MOST: usize = 4_000;

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
    /// Its error bar, if both parts are known.
    pub error: Option<f64>,
    /// The value of Hertz' closed form.
    pub hertz: Option<f64>,
}

/// Returns n if every n-th member is drawn.
fn stride(n_members: usize) -> usize {
    n_members.div_ceil(MOST).max(1)
}

impl FigurePoint {
    /// Reads a row of a sweep; `None` if it failed or is not drawn.
    pub fn of(row: &Row, choice: &FigureChoice, n_members: usize) -> Option<Self> {
        if !row.is_complete() || !row.index.is_multiple_of(stride(n_members)) {
            return None;
        }
        let number = |column: &str| row.value(column).as_f64();
        let there = |column: String| COLUMNS.contains(&column).then(|| number(&column)).flatten();
        let panel = |column: &&str| {
            let parts = ["discretisation", "model"]
                .map(|part| there(format!("uncertainty_{part}_{column}")));
            // A bar of one known part would be too short.
            let error =
                parts[0].zip(parts[1]).map(|(discretisation, model)| discretisation + model);
            // Hertz' restitution is 1.
            let hertz =
                (*column != "restitution").then(|| there(format!("hertz_{column}"))).flatten();
            PanelValues { own: number(column), error, hertz }
        };
        Some(Self { index: row.index, values: choice.y.iter().map(panel).collect() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_has_a_bounded_number_of_members() {
        assert_eq!([0, 1, MOST].map(stride), [1; 3]);
        for n in [MOST + 1, 10 * MOST + 3, 1_000_000] {
            let n_drawn = n.div_ceil(stride(n));
            assert!(n_drawn <= MOST && n_drawn > MOST / 2, "{n}: {n_drawn}");
        }
    }
}
