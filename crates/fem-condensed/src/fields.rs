//! Displacement, velocity and effective displacement of whole bodies at chosen instants.
//!
//! The displacement of a body is linear in a few coordinates: the forces at its contact nodes if it is
//! elastic, the displacements of its modes if it relaxes, and those of its modes of vibration. A field costs one
//! solution per body; the fields of all snapshots are solved for together. Velocities are differences of the
//! coordinates between neighbouring steps. Radiated waves are not included.

use std::collections::{BTreeMap, BTreeSet};

use faer::linalg::triangular_solve::solve_upper_triangular_in_place;
use faer::{Mat, Par};
use fem_collision::{
    BodyFields, BodyInput, Ending, Frame, ProbeRequest, Probes, Snapshot, SnapshotRequest,
};
use fem_material::{ActsOn, Material, PronySeries};

use crate::error::CondensedError;
use crate::motion::{BodyState, ImpactMotion};
use crate::operators::body_operator::BodyOperator;
use crate::pair::CondensedPair;
use crate::run::instants::{RunTrace, TraceInstant, choose};
use crate::settings::Damping;

/// Number of instants at which probes are evaluated, if there are as many steps.
const PROBED_INSTANTS: usize = 200;
/// Number of snapshots that are stored at a time before they are reduced to the probes.
const SNAPSHOTS_AT_ONCE: usize = 64;
/// Number of fields that are solved for at a time, those of eight snapshots.
const FIELDS_AT_ONCE: usize = 24;

/// Coordinates of the deformation of a body.
#[derive(Debug, Clone, Default)]
pub(crate) struct FieldCoordinates {
    /// Forces at the contact nodes of an elastic body, displacements of the modes of a relaxing one.
    springs: Vec<f64>,
    /// Effective displacements, which the relaxing stress follows; empty for an elastic body.
    effective: Vec<f64>,
    /// Displacements of the modes of vibration, dynamic less static.
    vibration: Vec<f64>,
    vibration_effective: Vec<f64>,
}

/// Approach (m) and deformation of both bodies, or the rates of these.
#[derive(Debug, Clone)]
struct State {
    approach: f64,
    sides: [FieldCoordinates; 2],
    contact: Contact,
}

/// Contact forces between the bodies, or the rates of these.
#[derive(Debug, Clone)]
pub(crate) struct Contact {
    /// Forces at the contact points, N.
    pub forces: Vec<f64>,
    /// Slip q of each side, m².
    pub moved: [f64; 2],
}

/// The time step (s) and the last step of a run.
#[derive(Debug, Clone, Copy)]
struct Steps {
    time_step: f64,
    last: usize,
}

impl CondensedPair {
    /// Returns the snapshots of a collision in the order of time, and messages about those that are not available.
    /// `trace` has every step of a run with this time step (s), speed, damping and ending.
    pub(crate) fn snapshots(
        &self,
        frame: &Frame,
        damping: Damping<'_>,
        time_step: f64,
        trace: &[RunTrace],
        ending: &Ending,
        request: &SnapshotRequest,
    ) -> Result<(Vec<Snapshot>, Vec<String>), CondensedError> {
        let first_touch = frame.approach.first_touch();
        let (chosen, missing) = choose(trace, time_step, request, first_touch, ending);
        let instants: Vec<TraceInstant> = chosen.iter().map(|(instant, _)| *instant).collect();
        let steps = Steps { time_step, last: trace.len() - 1 };
        let states = self.states(frame, damping, steps, &instants)?;
        let mut snapshots = self.pictures(frame, damping, time_step, &instants, &states)?;
        let is_whole = damping.radiation == [None, None];
        let labels = chosen.iter().map(|(_, label)| *label);
        for ((snapshot, [now, _]), label) in snapshots.iter_mut().zip(&states).zip(labels) {
            let centres = frame.approach.centres(self.masses(), now.approach, 0.0);
            snapshot.label = label;
            snapshot.contact = self.profile(&now.contact, &snapshot.bodies, centres, is_whole)?;
        }
        Ok((snapshots, missing))
    }

    /// Returns snapshots of both bodies for given states and rates, without their contact profiles.
    fn pictures(
        &self,
        frame: &Frame,
        damping: Damping<'_>,
        time_step: f64,
        instants: &[TraceInstant],
        states: &[[State; 2]],
    ) -> Result<Vec<Snapshot>, CondensedError> {
        let (approach, relaxations) = (&frame.approach, damping.relaxations);
        let time = |instant: TraceInstant| approach.first_touch() + instant.position() * time_step;
        let mut snapshots: Vec<Snapshot> = instants
            .iter()
            .zip(states)
            .map(|(&instant, [now, _])| Snapshot {
                time: time(instant),
                approach: now.approach,
                carried: approach.centres(self.masses(), approach.gap(), time(instant)),
                ..Snapshot::default()
            })
            .collect();
        for (s, side) in self.sides.iter().enumerate() {
            let Some(side) = side else { continue };
            let wanted: Vec<_> = states
                .iter()
                .flat_map(|[now, rates]| {
                    let centre = frame.approach.centres(self.masses(), now.approach, 0.0)[s];
                    let velocity = frame.approach.centres(self.masses(), rates.approach, 1.0)[s];
                    let effective = now.sides[s].effective();
                    [
                        Some((now.sides[s].clone(), centre)),
                        Some((rates.sides[s].clone(), velocity)),
                        effective.map(|effective| (effective, centre)),
                    ]
                })
                .collect();
            let shear_blocks = self.shear_blocks(relaxations[s], frame.speed())?;
            let mut fields = Vec::with_capacity(wanted.len());
            for some in wanted.chunks(FIELDS_AT_ONCE) {
                fields.extend(self.fields(side, relaxations[s], shear_blocks, some)?);
            }
            let mut fields = fields.into_iter();
            let mut next = || fields.next().unwrap_or_default();
            for snapshot in &mut snapshots {
                snapshot.bodies[s] = BodyFields {
                    displacement: next(),
                    velocity: next(),
                    effective: next(),
                    ..BodyFields::default()
                };
            }
        }
        Ok(snapshots)
    }

    /// Returns the histories of probes at a few hundred instants from first touch to the `last` step. See
    /// [`CondensedPair::snapshots`].
    pub(crate) fn probed(
        &self,
        frame: &Frame,
        damping: Damping<'_>,
        time_step: f64,
        last: usize,
        requests: &[ProbeRequest],
    ) -> Result<Vec<Snapshot>, CondensedError> {
        let probes = Probes::new(self.inputs().each_ref().map(BodyInput::mesh), requests);
        // The pair's own materials may relax differently: stresses follow the relaxations of this collision.
        let materials = [0, 1].map(|s: usize| {
            let material = self.inputs()[s].material()?;
            let relaxation = damping.relaxations[s].cloned();
            Material::new(material.density(), *material.instantaneous(), relaxation).ok()
        });
        let materials = materials.each_ref().map(Option::as_ref);
        let stride = last.div_ceil(PROBED_INSTANTS).max(1);
        let instants: Vec<TraceInstant> =
            (0..last).step_by(stride).chain([last]).map(TraceInstant::at).collect();
        let states = self.states(frame, damping, Steps { time_step, last }, &instants)?;
        let is_whole = damping.radiation == [None, None];
        let mut seen = Vec::with_capacity(instants.len());
        for (instants, states) in
            instants.chunks(SNAPSHOTS_AT_ONCE).zip(states.chunks(SNAPSHOTS_AT_ONCE))
        {
            let mut all = self.pictures(frame, damping, time_step, instants, states)?;
            for (snapshot, [now, _]) in all.iter_mut().zip(states) {
                let centres = frame.approach.centres(self.masses(), now.approach, 0.0);
                snapshot.contact =
                    self.profile(&now.contact, &snapshot.bodies, centres, is_whole)?;
            }
            seen.extend(all.iter().map(|one| probes.reduce(materials, one)));
        }
        Ok(seen)
    }

    /// Returns state and rates at each instant. The motion is computed again, and the steps around each instant are
    /// kept.
    fn states(
        &self,
        frame: &Frame,
        damping: Damping<'_>,
        steps: Steps,
        instants: &[TraceInstant],
    ) -> Result<Vec<[State; 2]>, CondensedError> {
        let around = |instant: TraceInstant| match instant.part {
            0.0 => [instant.step.saturating_sub(1), (instant.step + 1).min(steps.last)],
            _ => [instant.step, instant.step + 1],
        };
        let needed: BTreeSet<usize> =
            instants.iter().flat_map(|&i| [around(i)[0], i.step, around(i)[1]]).collect();
        let (time_step, n_points) = (steps.time_step, self.points.len());
        let mut motion = ImpactMotion::new(self, frame.speed(), damping, time_step, n_points)?
            .with_gravity(frame.gravity);
        let mut kept: BTreeMap<usize, (State, f64)> = BTreeMap::new();
        for step in needed {
            while motion.step < step {
                motion.advance()?;
            }
            kept.insert(step, (self.state(&motion), motion.rate));
        }
        let states = instants.iter().map(|&instant| {
            let [before, after] = around(instant);
            let ((a, rate_a), (b, rate_b)) = (&kept[&before], &kept[&after]);
            let width = (after - before) as f64 * steps.time_step;
            let mut rates = a.combine(b, [-1.0 / width, 1.0 / width]);
            if instant.part == 0.0 {
                let (now, rate) = &kept[&instant.step];
                rates.approach = *rate;
                return [now.clone(), rates];
            }
            let shares = [1.0 - instant.part, instant.part];
            rates.approach = shares[0] * rate_a + shares[1] * rate_b;
            [a.combine(b, shares), rates]
        });
        Ok(states.collect())
    }

    fn state(&self, motion: &ImpactMotion<'_>) -> State {
        let sides = [0, 1].map(|s: usize| match &self.sides[s] {
            Some(side) => coordinates(side, &motion.sides[s], &motion.forces),
            None => FieldCoordinates::default(),
        });
        let contact = Contact { forces: motion.forces.clone(), moved: motion.slipped() };
        State { approach: motion.approach, sides, contact }
    }

    /// Returns nodal displacements (m) for coordinates, each with a mean motion along the axis; empty fields where
    /// none are requested.
    fn fields(
        &self,
        side: &BodyOperator,
        relaxation: Option<&PronySeries>,
        shear_blocks: usize,
        wanted: &[Option<(FieldCoordinates, f64)>],
    ) -> Result<Vec<Vec<[f64; 2]>>, CondensedError> {
        let body = &side.body;
        let all = || wanted.iter().flatten();
        let springs = columns(all().map(|(coordinates, _)| coordinates.springs.as_slice()));
        let relaxation = relaxation.filter(|series| series.relaxes());
        let mut fields = match relaxation.map(PronySeries::acts_on) {
            Some(ActsOn::Shear) => side.shear(shear_blocks)?.springs.fields(&springs),
            acts_on => {
                let forces = match acts_on {
                    Some(_) => transposed_solve(&body.compliance_factor, &springs),
                    None => springs,
                };
                // One solution for all columns, so that the factor is read once.
                let mut loads = body.balanced_load(&forces);
                body.solve_balanced(&mut loads)?;
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

impl State {
    /// Returns the weighted sum of two sets of coordinates.
    fn combine(&self, other: &Self, weights: [f64; 2]) -> Self {
        let [a, b] = weights;
        Self {
            approach: a * self.approach + b * other.approach,
            sides: [0, 1].map(|s: usize| self.sides[s].combine(&other.sides[s], weights)),
            contact: Contact {
                forces: combined(&self.contact.forces, &other.contact.forces, weights),
                moved: [0, 1]
                    .map(|s: usize| a * self.contact.moved[s] + b * other.contact.moved[s]),
            },
        }
    }
}

impl FieldCoordinates {
    fn combine(&self, other: &Self, weights: [f64; 2]) -> Self {
        let sum = |get: fn(&Self) -> &[f64]| combined(get(self), get(other), weights);
        Self {
            springs: sum(|c| &c.springs),
            effective: sum(|c| &c.effective),
            vibration: sum(|c| &c.vibration),
            vibration_effective: sum(|c| &c.vibration_effective),
        }
    }

    /// Returns the coordinates of the effective displacement; `None` for an elastic body.
    fn effective(&self) -> Option<Self> {
        (!self.effective.is_empty()).then(|| Self {
            springs: self.effective.clone(),
            vibration: self.vibration_effective.clone(),
            ..Self::default()
        })
    }
}

fn coordinates(side: &BodyOperator, state: &BodyState, forces: &[f64]) -> FieldCoordinates {
    let difference = |values: [Vec<f64>; 2]| {
        let [fixed, moving] = values;
        moving.into_iter().zip(fixed).map(|(m, f)| m - f).collect()
    };
    let vibration = state.vibration.as_ref();
    let (springs, effective) = match &state.springs {
        Some(springs) => (springs.displacement.clone(), springs.effective()),
        None => (side.nodal_forces(forces), Vec::new()),
    };
    FieldCoordinates {
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

fn combined(some: &[f64], others: &[f64], [a, b]: [f64; 2]) -> Vec<f64> {
    some.iter().zip(others).map(|(x, y)| a * x + b * y).collect()
}

/// Joins vectors of one length to the columns of a matrix.
fn columns<'a>(values: impl Iterator<Item = &'a [f64]>) -> Mat<f64> {
    let values: Vec<&[f64]> = values.collect();
    Mat::from_fn(values.first().map_or(0, |first| first.len()), values.len(), |i, j| values[j][i])
}

/// Solves Lᵀ x = z for each column, with z zero beyond its end.
fn transposed_solve(lower: &Mat<f64>, z: &Mat<f64>) -> Mat<f64> {
    let mut x = Mat::zeros(lower.nrows(), z.ncols());
    x.subrows_mut(0, z.nrows()).copy_from(z);
    solve_upper_triangular_in_place(lower.transpose(), x.as_mut(), Par::Seq);
    x
}
