//! The contacts of a ball that bounces, for people.

use comfy_table::CellAlignment::{Left, Right};
use fem::results::{BounceSummary, RestSummary};
use fem_case::engineering::show;

use crate::tables::table;

/// Contacts that are shown; the summary has all.
const SHOWN: usize = 12;

/// A line a contact, and what bears the ball at rest.
pub fn bounces(bounces: &[BounceSummary], rest: Option<&RestSummary>) -> String {
    let quantity = |value: Option<f64>, unit: &str| value.map_or("-".into(), |v| show(v, unit));
    let header = ["bounce", "at", "before", "restitution", "contact time", "peak force"];
    let row = |(k, bounce): (usize, &BounceSummary)| {
        [
            (k + 1).to_string(),
            quantity(bounce.time_s, "s"),
            quantity(bounce.speed_before_m_s, "m/s"),
            bounce.restitution.map_or("-".into(), |restitution| format!("{restitution:.4}")),
            quantity(bounce.contact_time_s, "s"),
            quantity(bounce.peak_force_n, "N"),
        ]
    };
    let rows = bounces.iter().enumerate().take(SHOWN).map(row);
    let rows = std::iter::once(header.map(String::from)).chain(rows);
    let mut text = table(&[Left, Right, Right, Right, Right, Right], rows);
    if bounces.len() > SHOWN {
        text += &format!("and {} more\n", bounces.len() - SHOWN);
    }
    if let Some(rest) = rest {
        text += &format!(
            "at rest from {} on: contact radius {}, approach {} under {}\n",
            quantity(rest.time_s, "s"),
            quantity(rest.contact_radius_m, "m"),
            quantity(rest.approach_m, "m"),
            quantity(rest.static_force_n, "N"),
        );
    }
    text
}
