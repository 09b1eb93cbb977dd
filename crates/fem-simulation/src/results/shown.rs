//! Which snapshots results show, and what they are called.

use fem_collision::{Collision, Snapshot, SnapshotInstant, SnapshotRequest};

use crate::simulation::Simulation;

/// Snapshots in the order of time, each with the label of its files.
pub(super) struct Shown<'a> {
    pub snapshots: Vec<(&'a Snapshot, &'static str)>,
    /// What is left out, and why.
    pub warnings: Vec<String>,
}

/// All but a last contact that was not the last, and a second one of the same instant: viewers draw two
/// files of one time on top of each other.
pub(super) fn shown<'a>(simulation: &Simulation, collision: &'a Collision) -> Shown<'a> {
    let request = &simulation.want().snapshots;
    let mut shown = Shown { snapshots: Vec::new(), warnings: Vec::new() };
    for snapshot in &collision.snapshots {
        let label = label(snapshot, request);
        if snapshot.label == Some(SnapshotInstant::LastContact) && !collision.is_complete() {
            let warning = format!("the run ended before the instant \"{label}\"; it is left out");
            shown.warnings.push(warning);
            continue;
        }
        if let Some((before, earlier)) = shown.snapshots.last()
            && snapshot.time <= before.time
        {
            shown.warnings.push(format!(
                "the snapshot \"{label}\" is of the same instant as \"{earlier}\"; it is left out"
            ));
            continue;
        }
        shown.snapshots.push((snapshot, label));
    }
    shown
}

fn label(snapshot: &Snapshot, request: &SnapshotRequest) -> &'static str {
    match (snapshot.label, request) {
        (Some(label), _) => label.name(),
        (None, SnapshotRequest::Times(_)) => "time",
        (None, _) => "even",
    }
}
