//! The instants at which fields are written.

use super::{Allowed, Check, NOT_NEGATIVE, allowed};
use crate::error::CaseError;
use crate::quantity::{Count, Quantity};
use crate::scene::Snapshots;
use crate::schema::{SnapshotLabel, SnapshotsValue};
use crate::source::explain::near;
use crate::source::key_path::join;

const SNAPSHOT_COUNT: Allowed =
    allowed("a whole number from 1 to 100000", |x| (1.0..=1e5).contains(&x) && x.fract() == 0.0);

impl Check<'_> {
    pub(super) fn snapshots(&self, value: &SnapshotsValue) -> Result<Snapshots, CaseError> {
        let path = "output.snapshots";
        let list = match value {
            SnapshotsValue::Count(count) => {
                let count =
                    self.number(path, &Quantity::<Count>::from_si(*count), SNAPSHOT_COUNT)?;
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
                        .error(&path, format!("\"{text}\" is no label of a snapshot"))
                        .with_help(format!("{}{}", near(text, words), help())));
                }
                _ => times.push(self.number(&path, item, NOT_NEGATIVE)?),
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
}
