//! `[output]`: the instants at which fields are written, and the positions of probes.

use super::Check;
use crate::engineering::show;
use crate::error::CaseError;
use crate::quantity::range::Range;
use crate::quantity::{Count, Quantity};
use crate::scene::body::{Body, Shape};
use crate::scene::{Probe, Snapshots};
use crate::schema::{ProbeTable, SnapshotLabel, SnapshotsValue};
use crate::source::explain::near;
use crate::source::toml_syntax::join;

/// The largest number of probes: each stores a few thousand instants.
const MAX_PROBES: usize = 100;
/// Relative tolerance of a radius, for the rounding of units.
const ROUNDING: f64 = 1e-9;

impl Check<'_> {
    /// Returns the instants of snapshots: a count, labels, or times.
    pub(super) fn snapshots(&self, value: &SnapshotsValue) -> Result<Snapshots, CaseError> {
        let path = "output.snapshots";
        let list = match value {
            SnapshotsValue::Count(count) => {
                let count =
                    self.number(path, &Quantity::<Count>::from_si(*count), Range::SNAPSHOTS)?;
                return Ok(Snapshots::Count(count as usize));
            }
            SnapshotsValue::List(list) => list,
        };
        let (mut labels, mut times) = (Vec::new(), Vec::new());
        for (index, item) in list.iter().enumerate() {
            let path = join(path, &index.to_string());
            let words = SnapshotLabel::WORDS;
            let help = || format!("the labels are {}; a time is \"10 us\"", words.join(", "));
            match item.text() {
                Some(text) if SnapshotLabel::from_word(text).is_some() => {
                    labels.extend(SnapshotLabel::from_word(text));
                }
                Some(text) if text.trim_start().starts_with(char::is_alphabetic) => {
                    return Err(self
                        .error(&path, format!("\"{text}\" is not the label of a snapshot"))
                        .with_help(format!("{}{}", near(text, words), help())));
                }
                _ => times.push(self.number(&path, item, Range::NOT_NEGATIVE)?),
            }
            let at = |index: usize| join("output.snapshots", &index.to_string());
            if !labels.is_empty() && !times.is_empty() {
                let others: Vec<String> = (0..index).map(at).collect();
                let others: Vec<&str> = others.iter().map(String::as_str).collect();
                let error = self.conflict(&path, &others, "snapshots mixes labels and times");
                return Err(error.with_help(help()));
            }
            let first = labels.iter().position(|label| labels.last() == Some(label));
            if let Some(first) = first.filter(|first| first + 1 < labels.len()) {
                let message = format!("snapshot {item} is listed twice");
                let error = self.conflict(&path, &[&at(first)], message);
                return Err(error.with_help("leave one out"));
            }
        }
        if times.is_empty() {
            return Ok(Snapshots::Labels(labels));
        }
        times.sort_by(f64::total_cmp);
        times.dedup();
        Ok(Snapshots::Times(times))
    }

    /// Returns the probes, each inside its body.
    pub(super) fn probes(
        &self,
        tables: &[ProbeTable],
        bodies: &[Body; 2],
    ) -> Result<Vec<Probe>, CaseError> {
        if tables.len() > MAX_PROBES {
            let message = format!("the case has {} probes", tables.len());
            return Err(self
                .error(&format!("output.probe.{MAX_PROBES}"), message)
                .with_help(format!("at most {MAX_PROBES} are allowed")));
        }
        tables.iter().enumerate().map(|(k, table)| self.probe(k, table, bodies)).collect()
    }

    fn probe(&self, k: usize, table: &ProbeTable, bodies: &[Body; 2]) -> Result<Probe, CaseError> {
        let path = format!("output.probe.{k}");
        let (of_r, of_y) = (join(&path, "r"), join(&path, "y"));
        let r = self.number(&of_r, &table.r, Range::NOT_NEGATIVE)?;
        let y = self.number(&of_y, &table.y, Range::ANY)?;
        let names = bodies.each_ref().map(Body::name);
        let Some(side) = names.iter().position(|name| *name == table.body) else {
            let message = format!("there is no body \"{}\"", table.body);
            let help =
                format!("{}the bodies are {}", near(&table.body, &names), names.join(" and "));
            return Err(self.error(&join(&path, "body"), message).with_help(help));
        };
        let depth = if side == 0 { -y } else { y };
        let name = names[side];
        let radius = match bodies[side].shape() {
            Shape::Wall | Shape::Rigid { .. } => {
                let message = format!("\"{name}\" is rigid and has no fields");
                let help = "put the probe in a body with a material";
                return Err(self.error(&join(&path, "body"), message).with_help(help));
            }
            Shape::HalfSpace { .. } | Shape::Plate { .. } => f64::INFINITY,
            Shape::Sphere { diameter, .. } => 0.5 * diameter,
        };
        if depth < 0.0 {
            let side = if side == 0 { "lower body, y <= 0" } else { "upper body, y >= 0" };
            let message = format!("y is {}, outside of \"{name}\"", table.y);
            return Err(self.error(&of_y, message).with_help(format!("\"{name}\" is the {side}")));
        }
        if radius.is_finite() && r.hypot(depth - radius) > radius * (1.0 + ROUNDING) {
            let message = format!("({}, {}) is outside of \"{name}\"", table.r, table.y);
            let help = format!(
                "\"{name}\" has a radius of {} and touches y = 0 at r = 0",
                show(radius, "m")
            );
            return Err(self.conflict(&of_r, &[&of_y], message).with_help(help));
        }
        Ok(Probe { body: side, r, y })
    }
}
