//! Selection of the instants of snapshots.

use std::ops::Range;

use fem_collision::{
    Ending, SnapshotInstant, SnapshotRequest, did_not_occur, evenly, fewer_than_asked,
};
use fem_material::engineering::show;

/// Approach (m) and force (N) of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RunTrace {
    pub approach: f64,
    pub is_closed: bool,
}

/// An instant between two steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TraceInstant {
    /// Step at or before the instant.
    pub step: usize,
    /// Share of the interval to the next step, 0 to 1.
    pub part: f64,
}

impl TraceInstant {
    /// Creates the instant of a step.
    pub fn at(step: usize) -> Self {
        Self { step, part: 0.0 }
    }

    /// Returns the number of steps since first touch.
    pub fn position(self) -> f64 {
        self.step as f64 + self.part
    }
}

/// Returns the instants of the requested snapshots in the order of time, and messages about those that do not occur.
/// Times are those of the case, s. Bodies that stay together have no last contact.
pub(crate) fn choose(
    trace: &[RunTrace],
    time_step: f64,
    request: &SnapshotRequest,
    first_touch: f64,
    ending: &Ending,
) -> (Vec<(TraceInstant, Option<SnapshotInstant>)>, Vec<String>) {
    let mut missing = Vec::new();
    let last = trace.iter().rposition(|step| step.is_closed).unwrap_or(0);
    let end = trace.len().saturating_sub(1);
    let since_touch = |time: f64| {
        let position = (time / time_step).clamp(0.0, end as f64);
        let step = position.floor();
        // Positions within rounding of a step are that step.
        match position - step {
            part if part < 1e-6 => TraceInstant::at(step as usize),
            part if part > 1.0 - 1e-6 => TraceInstant::at(step as usize + 1),
            part => TraceInstant { step: step as usize, part },
        }
    };
    let chosen = match request {
        SnapshotRequest::Labels(labels) => {
            let wanted = SnapshotInstant::OF_CONTACT.iter().filter(|label| labels.contains(label));
            let mut chosen = Vec::new();
            for label in wanted {
                match labelled(trace, *label, last, ending) {
                    Some(instant) => chosen.push((instant, Some(*label))),
                    None => missing.push(did_not_occur(*label)),
                }
            }
            chosen
        }
        SnapshotRequest::Count(n) => {
            let end = last as f64 * time_step;
            if *n <= last + 1 {
                let times = evenly(*n, 0.0, end).into_iter();
                times.map(|time| (since_touch(time), None)).collect()
            } else {
                missing.push(fewer_than_asked(*n, last + 1, "steps"));
                (0..=last).map(|step| (TraceInstant::at(step), None)).collect()
            }
        }
        SnapshotRequest::Times(times) => {
            let mut times = times.clone();
            times.sort_by(f64::total_cmp);
            let end = first_touch + end as f64 * time_step;
            let (within, beyond): (Vec<f64>, Vec<f64>) =
                times.into_iter().partition(|&time| time >= first_touch && time <= end);
            for time in beyond {
                missing.push(format!(
                    "{} lies outside of the contact and the flight that is computed; \
                     its snapshot is left out",
                    show(time, "s")
                ));
            }
            within.into_iter().map(|time| (since_touch(time - first_touch), None)).collect()
        }
    };
    (chosen, missing)
}

/// Returns the instant of a label, if it occurs; `last` is the last step with contact.
fn labelled(
    trace: &[RunTrace],
    label: SnapshotInstant,
    last: usize,
    ending: &Ending,
) -> Option<TraceInstant> {
    let top = (0..trace.len())
        .max_by(|&a, &b| trace[a].approach.total_cmp(&trace[b].approach))
        .unwrap_or(0);
    let half = 0.5 * trace.get(top).map_or(0.0, |step| step.approach);
    match label {
        SnapshotInstant::MidCompression => passes(trace, 0..top, half),
        SnapshotInstant::Maximum => Some(TraceInstant::at(top)),
        SnapshotInstant::MidSeparation => passes(trace, top..trace.len().saturating_sub(1), half),
        SnapshotInstant::LastContact => {
            (*ending != Ending::Together).then_some(TraceInstant::at(last))
        }
        SnapshotInstant::AfterSeparation | SnapshotInstant::LastValid => None,
    }
}

/// Returns the instant at which the approach passes a level between two steps with contact.
fn passes(trace: &[RunTrace], steps: Range<usize>, level: f64) -> Option<TraceInstant> {
    steps.into_iter().find_map(|step| {
        let [before, after] = [trace[step], *trace.get(step + 1)?];
        let (low, high) =
            (before.approach.min(after.approach), before.approach.max(after.approach));
        let is_here = low < high && (low..=high).contains(&level);
        (is_here && after.is_closed).then(|| TraceInstant {
            step,
            part: (level - before.approach) / (after.approach - before.approach),
        })
    })
}
