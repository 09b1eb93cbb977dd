//! The recorder: selects the states that are kept as snapshots.
//!
//! Half of the maximum approach is known only after the maximum. Therefore a state is kept as a candidate whenever the
//! approach has grown by 3 %, and candidates below half of the present approach are dropped. No state is taken where
//! the approach cannot be half of the maximum.
//!
//! Snapshots that are spread evenly over the contact need its duration. Therefore states are kept at an even spacing,
//! which doubles whenever there are too many of them.

use fem_collision::{
    Expectation, OutputRequest, Snapshot, SnapshotInstant, SnapshotRequest, did_not_occur, evenly,
    fewer_than_asked,
};
use fem_material::engineering::show;
use serde::{Deserialize, Serialize};

use super::{fits, in_free_flight, n_kept, take};
use crate::model::ExplicitBodies;
use crate::state::{Scratch, State};

/// Growth of the approach from one candidate for half of the maximum to the next: the nearest one is within 1.5 %.
const CANDIDATE_RATIO: f64 = 1.03;
/// Share of the expected approach at which candidates begin.
const FIRST_CANDIDATE: f64 = 0.02;
/// Below this share of the expected approach a candidate is taken only once the bodies have slowed down: at half of a
/// small maximum they would have.
const SURE_SHARE: f64 = 0.25;
/// Share of the speed at first touch above which bodies have not slowed down. A force that grows with the power p of
/// the approach has taken 2^-(p + 1) of the energy at half of the maximum: 0.18 for Hertz' force, while this share
/// takes 0.02.
const NOT_SLOWED: f64 = 0.99;

/// The contact at an instant, as the recorder needs it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Instant {
    pub approach: f64,
    /// Rate of the approach over the last half step, m/s.
    pub approach_rate: f64,
    pub is_closed: bool,
    /// The first closed step of the run.
    pub is_first_contact: bool,
    /// Closed now and open in the next step.
    pub is_last_contact: bool,
    /// The contact is over for good: the run ends here.
    pub has_separated: bool,
    /// The bodies are at rest and stay together: the run ends here.
    pub stays_together: bool,
}

/// The states that are kept for a request.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Recorder {
    request: SnapshotRequest,
    expected_approach: f64,
    /// Approach at which the next candidate for half of the maximum is due, m.
    next_candidate: f64,
    /// Candidates for half of the maximum, or evenly spaced states, or those at the requested times.
    kept: Vec<Snapshot>,
    /// Maximum approach, m; present once it is past.
    max_approach: Option<f64>,
    maximum: Option<Snapshot>,
    mid_separation: Option<Snapshot>,
    last_contact: Option<Snapshot>,
    spacing: f64,
    next_time: usize,
}

impl Recorder {
    /// Starts for a request, with estimates of contact time and approach.
    pub fn new(request: &SnapshotRequest, model: &ExplicitBodies, expected: Expectation) -> Self {
        let request = in_order(request);
        let mut kept = Vec::new();
        if let SnapshotRequest::Times(times) = &request {
            let in_flight = times.iter().take_while(|&&time| time < model.approach().first_touch());
            kept.extend(in_flight.map(|&time| in_free_flight(model, time)));
        }
        let spacing = match request {
            SnapshotRequest::Count(n) => 2.0 * expected.contact_time / n_kept(n) as f64,
            _ => 0.0,
        };
        Self {
            request,
            expected_approach: expected.approach,
            next_candidate: FIRST_CANDIDATE * expected.approach,
            next_time: kept.len(),
            kept,
            max_approach: None,
            maximum: None,
            mid_separation: None,
            last_contact: None,
            spacing,
        }
    }

    /// Keeps the state at t_n if it may become a snapshot.
    pub fn observe(
        &mut self,
        model: &ExplicitBodies,
        state: &State,
        scratch: &mut Scratch,
        now: Instant,
    ) {
        let Scratch { forces, pool, .. } = scratch;
        let copy = |recycled: Option<Snapshot>, label: Option<SnapshotInstant>| {
            let mut snapshot = recycled.unwrap_or_default();
            take(&mut snapshot, model, state, forces, now.approach, label);
            snapshot
        };
        if now.is_closed {
            // In contact again: the kept state was not the last contact.
            pool.extend(self.last_contact.take());
        }
        if now.is_last_contact && self.wants_last(now) {
            self.last_contact = Some(copy(pool.pop(), Some(SnapshotInstant::LastContact)));
        }
        match &self.request {
            SnapshotRequest::Labels(_) => {
                if let Some(label) = self.due_label(model, now, pool) {
                    let snapshot = copy(pool.pop(), Some(label));
                    match label {
                        SnapshotInstant::Maximum => self.maximum = Some(snapshot),
                        SnapshotInstant::MidSeparation => self.mid_separation = Some(snapshot),
                        _ => self.kept.push(snapshot),
                    }
                }
            }
            SnapshotRequest::Count(n) => {
                let due = self.kept.last().is_some_and(|last| {
                    now.is_closed && state.time >= last.time + self.spacing * (1.0 - 1e-9)
                });
                if now.is_first_contact || due {
                    let snapshot = copy(pool.pop(), None);
                    self.kept.push(snapshot);
                    if self.kept.len() > n_kept(*n) {
                        self.thin(pool);
                    }
                }
            }
            SnapshotRequest::Times(times) => {
                while let Some(&time) = times.get(self.next_time)
                    && state.time + 0.5 * state.time_step(model) >= time
                {
                    self.kept.push(copy(None, None));
                    self.next_time += 1;
                }
            }
        }
    }

    /// Returns whether the last contact is asked for. Bodies that stay together have none.
    fn wants_last(&self, now: Instant) -> bool {
        match &self.request {
            SnapshotRequest::Labels(labels) => {
                labels.contains(&SnapshotInstant::LastContact) && !now.stays_together
            }
            SnapshotRequest::Count(_) => true,
            SnapshotRequest::Times(_) => false,
        }
    }

    /// Returns the label for which the present state is a snapshot, or a candidate for the middle of the compression. Candidates that
    /// the approach has left behind are dropped.
    fn due_label(
        &mut self,
        model: &ExplicitBodies,
        now: Instant,
        pool: &mut Vec<Snapshot>,
    ) -> Option<SnapshotInstant> {
        let SnapshotRequest::Labels(labels) = &self.request else { return None };
        let wants = |label: SnapshotInstant| labels.contains(&label).then_some(label);
        match self.max_approach {
            None if now.is_closed && (now.approach_rate <= 0.0 || now.stays_together) => {
                self.max_approach = Some(now.approach);
                wants(SnapshotInstant::Maximum)
            }
            None if now.approach >= self.next_candidate => {
                let label = wants(SnapshotInstant::MidCompression)?;
                self.next_candidate = CANDIDATE_RATIO * now.approach;
                let half = 0.5 * now.approach / CANDIDATE_RATIO;
                let first = self.kept.iter().position(|candidate| candidate.approach >= half);
                pool.extend(self.kept.drain(..first.unwrap_or(self.kept.len())));
                let is_slowed = now.approach_rate <= NOT_SLOWED * model.approach().speed();
                (is_slowed || now.approach >= SURE_SHARE * self.expected_approach).then_some(label)
            }
            Some(max) if self.mid_separation.is_none() && now.approach <= 0.5 * max => {
                wants(SnapshotInstant::MidSeparation)
            }
            _ => None,
        }
    }

    /// Drops every second of the evenly spaced states.
    fn thin(&mut self, pool: &mut Vec<Snapshot>) {
        let mut k = 0;
        self.kept.retain_mut(|snapshot| {
            k += 1;
            let keep = k % 2 == 1;
            if !keep {
                pool.push(std::mem::take(snapshot));
            }
            keep
        });
        self.spacing *= 2.0;
    }

    /// Returns whether it can belong to a run of a model with a request.
    pub fn fits(&self, model: &ExplicitBodies, asked: &SnapshotRequest) -> bool {
        let request_fits = match (&self.request, &in_order(asked)) {
            (SnapshotRequest::Times(times), SnapshotRequest::Times(asked)) => {
                times.iter().map(|time| time.to_bits()).eq(asked.iter().map(|time| time.to_bits()))
                    && self.next_time == self.kept.len()
                    && self.next_time <= times.len()
            }
            (request, asked) => request == asked,
        };
        let singles = [&self.maximum, &self.mid_separation, &self.last_contact];
        request_fits
            && self.kept.is_sorted_by(|one, next| one.time <= next.time)
            && self.kept.iter().chain(singles.into_iter().flatten()).all(|kept| fits(kept, model))
    }

    /// Returns the snapshots in the order of time, and a message for each one that is missing.
    pub fn finish(self) -> (Vec<Snapshot>, Vec<String>) {
        let mut missing = Vec::new();
        let snapshots = match self.request {
            SnapshotRequest::Labels(labels) => {
                let mid_compression = self.max_approach.and_then(|max_approach| {
                    let half = 0.5 * max_approach;
                    let distance = |s: &Snapshot| (s.approach - half).abs();
                    self.kept
                        .into_iter()
                        .filter(|s| distance(s) <= 0.02 * half)
                        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
                });
                let mut found = Vec::new();
                let all = [mid_compression, self.maximum, self.mid_separation, self.last_contact];
                for (label, snapshot) in SnapshotInstant::OF_CONTACT.into_iter().zip(all) {
                    if !labels.contains(&label) {
                        continue;
                    }
                    match snapshot {
                        Some(snapshot) => found.push(snapshot),
                        None => missing.push(did_not_occur(label)),
                    }
                }
                found
            }
            SnapshotRequest::Count(n) => {
                let found = nearest_to_even(self.kept, self.last_contact, n);
                if found.len() < n {
                    missing.push(fewer_than_asked(n, found.len(), "states"));
                }
                found
            }
            SnapshotRequest::Times(times) => {
                for time in &times[self.next_time..] {
                    missing.push(format!(
                        "the run ended before {}; its snapshot is left out",
                        show(*time, "s")
                    ));
                }
                self.kept
            }
        };
        (snapshots, missing)
    }
}

/// Returns the request with its times in order; a time that is not a number comes last and is never due.
fn in_order(request: &SnapshotRequest) -> SnapshotRequest {
    let mut request = request.clone();
    if let SnapshotRequest::Times(times) = &mut request {
        let by_kind = |one: &f64, other: &f64| one.is_nan().cmp(&other.is_nan());
        times.sort_by(|one, other| by_kind(one, other).then(one.total_cmp(other)));
    }
    request
}

/// Returns the `n` states nearest to an even spacing between the first and the last one.
fn nearest_to_even(mut kept: Vec<Snapshot>, last: Option<Snapshot>, n: usize) -> Vec<Snapshot> {
    if let Some(last) = last {
        kept.retain(|snapshot| snapshot.time < last.time);
        kept.push(Snapshot { label: None, ..last });
    }
    let (Some(first), Some(end)) = (kept.first(), kept.last()) else {
        return kept;
    };
    let (start, length) = (first.time, end.time - first.time);
    let nearest = |time: f64| {
        let after = kept.partition_point(|snapshot| snapshot.time < time).min(kept.len() - 1);
        let before = after.saturating_sub(1);
        let is_before = time - kept[before].time <= kept[after].time - time;
        if is_before { before } else { after }
    };
    // More times than this select every state.
    let times = evenly(n.min(OutputRequest::MAX_SNAPSHOTS), start, length);
    let mut is_chosen = vec![false; kept.len()];
    times.into_iter().for_each(|time| is_chosen[nearest(time)] = true);
    let mut chosen = is_chosen.into_iter();
    kept.retain(|_| chosen.next().unwrap_or_default());
    kept
}

#[cfg(test)]
mod tests;
