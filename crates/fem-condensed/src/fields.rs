//! Displacement, velocity and effective displacement of whole bodies at chosen instants.
//!
//! A body's displacement is linear in a few coordinates: the forces at its contact nodes if it is
//! elastic, the displacements of its springs if it relaxes, and those of its modes of vibration.
//! They are kept for every step, so that a field costs one solution a body and its velocity is the
//! central difference of the coordinates.

use faer::Mat;
use fem_field::{BodyFields, Snapshot, SnapshotRequest};
use fem_material::{ActsOn, PronySeries};

use crate::CondensedError;
use crate::collision::Collision;
use crate::frame::Frame;
use crate::instants::{Kept, choose};
use crate::motion::{Motion, SideState};
use crate::pair::CondensedPair;
use crate::side::PairSide;

/// A body's deformation in coordinates.
#[derive(Debug, Clone, Default)]
pub(crate) struct Coordinates {
    /// Forces at the contact nodes of an elastic body, displacements of a relaxing one's springs.
    springs: Vec<f64>,
    /// What the relaxing stress sees; empty for an elastic body.
    effective: Vec<f64>,
    /// Modes of vibration, dynamic less static.
    vibration: Vec<f64>,
    vibration_effective: Vec<f64>,
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
        let mut snapshots: Vec<Snapshot> = chosen
            .iter()
            .map(|&(index, label)| Snapshot {
                label,
                time: frame.first_touch() + kept[index].time,
                approach: kept[index].approach,
                bodies: [BodyFields::default(), BodyFields::default()],
            })
            .collect();
        for (s, side) in self.sides.iter().enumerate() {
            let Some(side) = side else { continue };
            let wanted: Vec<_> = chosen
                .iter()
                .flat_map(|&(index, _)| {
                    let (now, rates) =
                        (&kept[index], rate_of(&kept, index, s, collision.time_step));
                    let time = frame.first_touch() + now.time;
                    let centre = frame.centres(self.masses(), now.approach + frame.gap, time)[s];
                    let velocity = frame.centres(self.masses(), now.rate, 1.0)[s];
                    let effective = now.sides[s].effective();
                    let displacement = (now.sides[s].clone(), centre);
                    [Some(displacement), Some((rates, velocity)), effective.map(|e| (e, centre))]
                })
                .collect();
            let mut fields = self.fields(side, relaxations[s], &wanted)?.into_iter();
            let mut next = || fields.next().unwrap_or_default();
            for snapshot in &mut snapshots {
                snapshot.bodies[s] =
                    BodyFields { displacement: next(), velocity: next(), effective: next() };
            }
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

    /// Nodal displacements (m) of coordinates, each on top of a mean motion along the axis; none
    /// where none are wanted.
    fn fields(
        &self,
        side: &PairSide,
        relaxation: Option<&PronySeries>,
        wanted: &[Option<(Coordinates, f64)>],
    ) -> Result<Vec<Vec<[f64; 2]>>, CondensedError> {
        let body = &side.body;
        let all = || wanted.iter().flatten();
        let springs = columns(all().map(|(coordinates, _)| coordinates.springs.as_slice()));
        let relaxation = active(relaxation);
        let mut fields = match relaxation.map(PronySeries::acts_on) {
            Some(ActsOn::Shear) => {
                side.shear(self.settings().shear_blocks)?.springs.fields(&springs)
            }
            acts_on => {
                let forces = match acts_on {
                    Some(_) => transposed_solve(&body.compliance_factor, &springs),
                    None => springs,
                };
                // One solution for all, so that the factor is read once.
                let mut loads = body.balanced_load(&forces);
                body.solve_balanced(&mut loads);
                loads
            }
        };
        if let Some(vibrations) = &side.vibrations {
            let modes = columns(all().map(|(coordinates, _)| coordinates.vibration.as_slice()));
            fields += &vibrations.modes.fields * modes;
        }
        body.remove_mean_motion(&mut fields);
        let mut column = 0;
        let nodal = wanted.iter().map(|wanted| {
            let Some((_, mean)) = wanted else { return Vec::new() };
            let mut nodal = body.nodal_field(fields.as_ref().col(column));
            nodal.iter_mut().for_each(|u| u[1] += mean);
            column += 1;
            nodal
        });
        Ok(nodal.collect())
    }
}

impl Coordinates {
    /// Those of the field that the relaxing stress sees; `None` for an elastic body.
    fn effective(&self) -> Option<Self> {
        (!self.effective.is_empty()).then(|| Self {
            springs: self.effective.clone(),
            vibration: self.vibration_effective.clone(),
            ..Self::default()
        })
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

/// Side by side; all of one length.
fn columns<'a>(values: impl Iterator<Item = &'a [f64]>) -> Mat<f64> {
    let values: Vec<&[f64]> = values.collect();
    Mat::from_fn(values.first().map_or(0, |first| first.len()), values.len(), |i, j| values[j][i])
}

/// Lᵀ x = z for each column, z zero beyond its end.
fn transposed_solve(lower: &Mat<f64>, z: &Mat<f64>) -> Mat<f64> {
    let n = lower.nrows();
    let mut x = Mat::zeros(n, z.ncols());
    for j in 0..z.ncols() {
        for i in (0..z.nrows()).rev() {
            let sum: f64 = (i + 1..n).map(|k| lower[(k, i)] * x[(k, j)]).sum();
            x[(i, j)] = (z[(i, j)] - sum) / lower[(i, i)];
        }
    }
    x
}
