//! The instants that snapshots show: what all models share in choosing them.

use crate::snapshot::Label;

/// `n` times evenly over a stretch (s), its ends among them; one alone lies in the middle.
pub fn evenly(n: usize, start: f64, length: f64) -> Vec<f64> {
    match n {
        1 => vec![start + 0.5 * length],
        _ => (0..n).map(|k| start + length * k as f64 / (n - 1) as f64).collect(),
    }
}

/// What is said of a named instant that a run has not had.
pub fn did_not_occur(label: Label) -> String {
    format!("the instant \"{}\" did not occur; its snapshot is left out", label.name())
}

/// What is said of a contact with fewer instants than snapshots.
pub fn fewer_than_asked(n_asked: usize, n_there: usize, instants: &str) -> String {
    format!("{n_asked} snapshots were asked for; the contact has {instants} for {n_there}")
}
