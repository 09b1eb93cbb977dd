//! The steps that snapshots show.

use fem_field::{Label, SnapshotRequest};

use crate::fields::Coordinates;

/// A step with the deformation of both bodies.
#[derive(Debug, Clone)]
pub(crate) struct Kept {
    pub time: f64,
    pub approach: f64,
    pub rate: f64,
    pub is_closed: bool,
    pub sides: [Coordinates; 2],
}

/// Steps of the snapshots that are asked for, and what cannot be had.
pub(crate) fn choose(
    kept: &[Kept],
    request: &SnapshotRequest,
    first_touch: f64,
) -> (Vec<(usize, Option<Label>)>, Vec<String>) {
    let nearest = |time: f64| {
        (0..kept.len())
            .min_by(|&a, &b| (kept[a].time - time).abs().total_cmp(&(kept[b].time - time).abs()))
            .unwrap_or(0)
    };
    let mut missing = Vec::new();
    let last = kept.iter().rposition(|step| step.is_closed).unwrap_or(0);
    let top =
        (0..kept.len()).max_by(|&a, &b| kept[a].approach.total_cmp(&kept[b].approach)).unwrap_or(0);
    let chosen = match request {
        SnapshotRequest::Labels(labels) => {
            let half = 0.5 * kept[top].approach;
            let nearest_half = |steps: std::ops::Range<usize>| {
                let distance = |k: usize| (kept[k].approach - half).abs();
                steps
                    .filter(|&k| kept[k].is_closed && distance(k) <= 0.02 * half)
                    .min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
            };
            let found = |label: &Label| match label {
                Label::MidCompression => nearest_half(0..top),
                Label::Maximum => Some(top),
                Label::MidSeparation => nearest_half(top..kept.len()),
                Label::LastContact => Some(last),
            };
            let wanted = Label::ALL.iter().filter(|label| labels.contains(label));
            let mut chosen = Vec::new();
            for label in wanted {
                match found(label) {
                    Some(step) => chosen.push((step, Some(*label))),
                    None => missing.push(format!(
                        "the instant \"{}\" did not occur; its snapshot is left out",
                        label.name()
                    )),
                }
            }
            chosen
        }
        SnapshotRequest::Count(n) => {
            let end = kept[last].time;
            let time = |k: usize| match n {
                1 => 0.5 * end,
                _ => end * k as f64 / (*n - 1) as f64,
            };
            let mut chosen: Vec<_> = (0..*n).map(|k| (nearest(time(k)), None)).collect();
            chosen.dedup();
            if chosen.len() < *n {
                missing.push(format!(
                    "{n} snapshots were asked for; the contact has steps for {}",
                    chosen.len()
                ));
            }
            chosen
        }
        SnapshotRequest::Times(times) => {
            let mut times = times.clone();
            times.sort_by(f64::total_cmp);
            let end = first_touch + kept[kept.len() - 1].time;
            let (within, beyond): (Vec<f64>, Vec<f64>) =
                times.into_iter().partition(|&time| time >= first_touch && time <= end);
            for time in beyond {
                missing.push(format!(
                    "{time:.4e} s lies outside of the contact and the flight that is computed; \
                     its snapshot is left out"
                ));
            }
            within.into_iter().map(|time| (nearest(time - first_touch), None)).collect()
        }
    };
    (chosen, missing)
}
