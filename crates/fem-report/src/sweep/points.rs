//! What the picture of a sweep needs of its members, of so many that it can be looked at.

use fem::sweep::{COLUMNS, Row};

use super::picture_data::Choice;

/// Members that are drawn, about.
const MOST: usize = 4_000;

/// Of a complete member.
#[derive(Clone, Debug, PartialEq)]
pub struct PicturePoint {
    /// Its place in the sweep.
    pub index: usize,
    /// Of each panel.
    pub values: Vec<PanelValues>,
}

/// What a panel shows of a member; `None` where there is none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PanelValues {
    /// The member's own.
    pub own: Option<f64>,
    /// How far that may be off, both parts of its error bar.
    pub error: Option<f64>,
    /// By Hertz.
    pub hertz: Option<f64>,
}

/// Every so manieth member is drawn.
fn stride(n_members: usize) -> usize {
    n_members.div_ceil(MOST).max(1)
}

impl PicturePoint {
    /// Of a row of a sweep of so many members, if it is drawn.
    pub fn of(row: &Row, choice: &Choice, n_members: usize) -> Option<Self> {
        if !row.is_complete() || !row.index.is_multiple_of(stride(n_members)) {
            return None;
        }
        let number = |column: &str| row.value(column).as_f64();
        let there = |column: String| COLUMNS.contains(&column).then(|| number(&column)).flatten();
        let panel = |column: &&str| {
            let parts = ["discretisation", "model"]
                .map(|part| there(format!("uncertainty_{part}_{column}")));
            // A bar that is not known whole would be too short.
            let error =
                parts[0].zip(parts[1]).map(|(discretisation, model)| discretisation + model);
            // Hertz gives all back.
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

    /// All members of a sweep that a picture can show, a share of a larger one.
    #[test]
    fn a_picture_has_a_bounded_number_of_members() {
        assert_eq!([0, 1, MOST].map(stride), [1; 3]);
        for n in [MOST + 1, 10 * MOST + 3, 1_000_000] {
            let n_drawn = n.div_ceil(stride(n));
            assert!(n_drawn <= MOST && n_drawn > MOST / 2, "{n}: {n_drawn}");
        }
    }
}
