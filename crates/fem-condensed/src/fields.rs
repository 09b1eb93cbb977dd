//! Displacement, velocity and effective displacement of whole bodies at chosen instants.
//!
//! A body's displacement is linear in a few coordinates: the forces at its contact nodes if it is
//! elastic, the displacements of its springs if it relaxes, and those of its modes of vibration.
//! They are kept for every step, so that a field costs one solution a body and its velocity is the
//! central difference of the coordinates.

use faer::Mat;
use fem_field::{BodyFields, Label, Snapshot, SnapshotRequest};
use fem_material::{ActsOn, PronySeries};

use crate::CondensedError;
use crate::collision::Collision;
use crate::motion::{Motion, SideState};
use crate::pair::{CondensedPair, PairSide};

/// Motion of the bodies as a whole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Velocities along +y at the start, lower body first, m/s.
    pub velocities: [f64; 2],
    /// Distance of the surfaces at time 0, m.
    pub gap: f64,
}

impl Frame {
    /// Relative speed of approach, m/s.
    pub fn approach_speed(&self) -> f64 {
        self.velocities[0] - self.velocities[1]
    }

    /// Time of first touch, s.
    pub fn first_touch(&self) -> f64 {
        self.gap / self.approach_speed()
    }

    /// What the two mass centres do along +y (m, or m/s) at an approach since time 0 (m, or its
    /// rate in m/s), the time since then (s, or 1 for the rates), and the masses, kg.
    pub fn centres(&self, masses: [f64; 2], approach: f64, time: f64) -> [f64; 2] {
        let share = |own: f64, other: f64| {
            if own.is_infinite() { 0.0 } else { (1.0 + own / other).recip() }
        };
        let shares = [share(masses[0], masses[1]), share(masses[1], masses[0])];
        // The lighter body does more of the approach; the common mass centre moves on.
        let common = shares[1] * self.velocities[0] + shares[0] * self.velocities[1];
        [common * time + shares[0] * approach, common * time - shares[1] * approach]
    }
}

/// A body's deformation in coordinates.
#[derive(Debug, Clone, Default)]
struct Coordinates {
    /// Forces at the contact nodes of an elastic body, displacements of a relaxing one's springs.
    springs: Vec<f64>,
    /// What the relaxing stress sees; empty for an elastic body.
    effective: Vec<f64>,
    /// Modes of vibration, dynamic less static.
    vibration: Vec<f64>,
    vibration_effective: Vec<f64>,
}

/// One step.
#[derive(Debug, Clone)]
struct Kept {
    time: f64,
    approach: f64,
    rate: f64,
    is_closed: bool,
    sides: [Coordinates; 2],
}

impl CondensedPair {
    /// The snapshots of a collision in the order of time, and what could not be had. `collision`
    /// is what [`CondensedPair::collide`] gave for the same speed, relaxations and settings.
    ///
    /// # Errors
    /// As [`CondensedPair::collide`].
    pub fn snapshots(
        &self,
        frame: &Frame,
        relaxations: [Option<&PronySeries>; 2],
        collision: &Collision,
        request: &SnapshotRequest,
    ) -> Result<(Vec<Snapshot>, Vec<String>), CondensedError> {
        if *request == SnapshotRequest::Labels(Vec::new()) {
            return Ok((Vec::new(), Vec::new()));
        }
        let kept = self.keep_steps(frame.approach_speed(), relaxations, collision)?;
        let (chosen, missing) = choose(&kept, request, frame.first_touch());
        let mut snapshots = Vec::with_capacity(chosen.len());
        for (index, label) in chosen {
            let now = &kept[index];
            let time = frame.first_touch() + now.time;
            let centre = frame.centres(self.masses(), now.approach + frame.gap, time);
            let velocity = frame.centres(self.masses(), now.rate, 1.0);
            let mut bodies = [BodyFields::default(), BodyFields::default()];
            for (s, side) in self.sides.iter().enumerate() {
                let Some(side) = side else { continue };
                let rates = rate_of(&kept, index, s, collision.time_step);
                let now = &now.sides[s];
                let field = |springs: &[f64], vibration: &[f64], mean: f64| {
                    self.field(side, relaxations[s], springs, vibration, mean)
                };
                bodies[s] = BodyFields {
                    displacement: field(&now.springs, &now.vibration, centre[s])?,
                    velocity: field(&rates.springs, &rates.vibration, velocity[s])?,
                    effective: if now.effective.is_empty() {
                        Vec::new()
                    } else {
                        field(&now.effective, &now.vibration_effective, centre[s])?
                    },
                };
            }
            snapshots.push(Snapshot { label, time, approach: now.approach, bodies });
        }
        Ok((snapshots, missing))
    }

    fn keep_steps(
        &self,
        speed: f64,
        relaxations: [Option<&PronySeries>; 2],
        collision: &Collision,
    ) -> Result<Vec<Kept>, CondensedError> {
        let n = self.points.len();
        let mut motion = Motion::new(self, speed, relaxations, collision.time_step, n)?;
        let mut kept = Vec::with_capacity(collision.steps + 1);
        loop {
            let sides = [0, 1].map(|s: usize| match &self.sides[s] {
                Some(side) => coordinates(side, &motion.sides[s], &motion.forces),
                None => Coordinates::default(),
            });
            kept.push(Kept {
                time: motion.time(),
                approach: motion.approach,
                rate: motion.rate,
                is_closed: motion.contact.n_closed > 0,
                sides,
            });
            if motion.step == collision.steps {
                return Ok(kept);
            }
            motion.advance()?;
        }
    }

    /// Nodal displacements (m) of coordinates, on top of a mean motion along the axis.
    fn field(
        &self,
        side: &PairSide,
        relaxation: Option<&PronySeries>,
        springs: &[f64],
        vibration: &[f64],
        mean: f64,
    ) -> Result<Vec<[f64; 2]>, CondensedError> {
        let body = &side.body;
        let shear = match active(relaxation) {
            Some(series) if series.acts_on() == ActsOn::Shear => {
                Some(side.shear(self.settings().shear_blocks)?)
            }
            _ => None,
        };
        let mut field = match shear {
            Some(shear) => &shear.springs.fields * column(springs),
            None => {
                let forces = match active(relaxation) {
                    Some(_) => transposed_solve(&body.compliance_factor, springs),
                    None => springs.to_vec(),
                };
                let mut loads = body.balanced_load(&forces);
                body.solve_balanced(&mut loads)?;
                loads
            }
        };
        if let Some(vibrations) = &side.vibrations {
            field += &vibrations.modes.fields * column(vibration);
        }
        body.remove_mean_motion(&mut field);
        let values: Vec<f64> = (0..field.nrows()).map(|i| field[(i, 0)]).collect();
        let mut nodal = body.nodal_field(&values);
        nodal.iter_mut().for_each(|u| u[1] += mean);
        Ok(nodal)
    }
}

/// A relaxation that does something.
pub(crate) fn active(series: Option<&PronySeries>) -> Option<&PronySeries> {
    series.filter(|series| series.terms().iter().any(|term| term.weight > 0.0))
}

fn coordinates(side: &PairSide, state: &SideState, forces: &[f64]) -> Coordinates {
    let difference = |values: [Vec<f64>; 2]| {
        let [fixed, moving] = values;
        moving.into_iter().zip(fixed).map(|(m, f)| m - f).collect()
    };
    let vibration = state.vibration.as_ref();
    let (springs, effective) = match &state.springs {
        Some(springs) => (springs.displacement.clone(), springs.effective()),
        None => (side.nodal_forces(forces), Vec::new()),
    };
    Coordinates {
        springs,
        effective,
        vibration: vibration
            .map(|both| difference(both.each_ref().map(|chain| chain.displacement.clone())))
            .unwrap_or_default(),
        vibration_effective: vibration
            .map(|both| difference(both.each_ref().map(|chain| chain.effective())))
            .unwrap_or_default(),
    }
}

/// Central difference of the coordinates, one-sided at the ends.
fn rate_of(kept: &[Kept], index: usize, side: usize, time_step: f64) -> Coordinates {
    let (before, after) = (index.saturating_sub(1), (index + 1).min(kept.len() - 1));
    let width = (after - before) as f64 * time_step;
    let rate = |get: fn(&Coordinates) -> &[f64]| {
        let [a, b] = [before, after].map(|k| get(&kept[k].sides[side]));
        a.iter().zip(b).map(|(a, b)| (b - a) / width).collect()
    };
    Coordinates {
        springs: rate(|c| &c.springs),
        vibration: rate(|c| &c.vibration),
        ..Coordinates::default()
    }
}

fn column(values: &[f64]) -> Mat<f64> {
    Mat::from_fn(values.len(), 1, |i, _| values[i])
}

/// Lᵀ x = z with z zero beyond its end.
fn transposed_solve(lower: &Mat<f64>, z: &[f64]) -> Vec<f64> {
    let n = lower.nrows();
    let mut x = vec![0.0; n];
    for i in (0..z.len()).rev() {
        let sum: f64 = (i + 1..n).map(|k| lower[(k, i)] * x[k]).sum();
        x[i] = (z[i] - sum) / lower[(i, i)];
    }
    x
}

/// Steps of the snapshots that are asked for, and what cannot be had.
fn choose(
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
