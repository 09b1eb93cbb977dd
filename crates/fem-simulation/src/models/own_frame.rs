//! Where explicit bodies are computed: in the frame of their mass centre, from first touch on.
//!
//! Nothing in the mechanics of a collision knows where the origin is or how fast it moves, and the
//! arithmetic should not either: strains are differences of displacements, and of 10⁶ m of free flight
//! or of a common speed of 10⁹ m/s rounding leaves none. With V the velocity of the mass centre and t₀ the
//! time of first touch,
//!
//! ```math
//! t = t_0 + t', \qquad v = v' + V, \qquad
//! E = E' + V \sum_i m_i v_i' + \tfrac12 V^2 \sum_i m_i .
//! ```
//!
//! A wall has an infinite mass and is at rest here; its work is V times the momentum that it gives.

use fem_collision::{
    Account, Approach, ApproachError, BodyResult, Collision, Ending, EnergyLedger, HistoryRow,
    OutputRequest, Progress, Snapshot, SnapshotRequest,
};

/// Two ways to look at the same bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OwnFrame {
    /// How the bodies meet in the case.
    met: Approach,
    /// The same in the frame of the mass centre, touching at time 0.
    own: Approach,
    /// Of the mass centre along +y, m/s.
    velocity: f64,
}

impl OwnFrame {
    /// Of bodies with these masses, kg; `None` of a wall, a half-space and what is held.
    ///
    /// # Errors
    /// Speeds that leave the range of f64.
    pub fn of(met: &Approach, masses: [Option<f64>; 2]) -> Result<Self, ApproachError> {
        let masses = masses.map(|mass| mass.unwrap_or(f64::INFINITY));
        let (own, velocity) = met.in_frame_of_centre(masses)?;
        Ok(Self { met: *met, own, velocity })
    }

    /// How the bodies meet in the frame of the mass centre.
    pub fn own(&self) -> &Approach {
        &self.own
    }

    /// How the bodies meet in the case.
    pub fn met(&self) -> &Approach {
        &self.met
    }

    /// What is asked for, at times since first touch.
    pub fn request(&self, request: &OutputRequest) -> OutputRequest {
        let mut request = request.clone();
        if let SnapshotRequest::Times(times) = &mut request.snapshots {
            times.iter_mut().for_each(|time| *time -= self.delay());
        }
        request
    }

    /// How far a run is, in the time of the case.
    pub fn progress(&self, own: Progress) -> Progress {
        Progress { time: self.delay() + own.time, ..own }
    }

    /// What came out, as the case sees it.
    pub fn collision(&self, own: Collision) -> Collision {
        if self.met == self.own {
            return own;
        }
        let masses = own.bodies.map(|body| body.mass);
        let later = |time: f64| self.delay() + time;
        let scale = |approach: &Approach| momentum_scale(approach, masses);
        let initial =
            own.initial_energy.map(|energy| energy + self.gained(masses, self.own.velocities()));
        // After the contact the bodies keep theirs; where a run knows none, the balance is the same with any.
        let after = own.bodies.map(|body| body.velocity_after);
        let [lower, upper] = self.own.velocities();
        let last = own.history.last().map(|row| row.velocity);
        let last = last.unwrap_or([after[0].unwrap_or(lower), after[1].unwrap_or(upper)]);
        Collision {
            approach: self.met,
            ending: match own.ending {
                Ending::Stopped(stop) => Ending::Stopped(stop.later_by(self.delay())),
                ending => ending,
            },
            first_contact: own.first_contact.map(later),
            last_contact: own.last_contact.map(later),
            noisiest_instant: own.noisiest_instant.map(|at| at.later_by(self.delay())),
            deepest_overlap: own
                .deepest_overlap
                .map(|deepest_overlap| deepest_overlap.later_by(self.delay())),
            residual_since: own.residual_since.map(|at| at.later_by(self.delay())),
            initial_energy: initial,
            energies: self.energies(own.energies, masses, last),
            momentum_residual_relative: own
                .momentum_residual_relative
                .map(|residual| residual * (scale(&self.own) / scale(&self.met))),
            bodies: own.bodies.map(|body| BodyResult {
                velocity_after: body.velocity_after.map(|v| v + self.velocity),
                ..body
            }),
            history: own.history.into_iter().map(|row| self.row(row, masses)).collect(),
            snapshots: own.snapshots.into_iter().map(|snapshot| self.snapshot(snapshot)).collect(),
            probes: own.probes.into_iter().map(|snapshot| self.snapshot(snapshot)).collect(),
            ..own
        }
    }

    /// Time of first touch, s.
    fn delay(&self) -> f64 {
        self.met.first_touch()
    }

    /// What the bodies' kinetic energy is more in the case's frame at velocities of this one, J.
    fn gained(&self, masses: [Option<f64>; 2], velocities: [f64; 2]) -> f64 {
        let bodies = masses.into_iter().zip(velocities);
        let moving = bodies.filter_map(|(mass, v)| Some(mass? * (v + 0.5 * self.velocity)));
        self.velocity * moving.sum::<f64>()
    }

    /// Work of a body that keeps its velocity on the other one, which has reached this velocity of this
    /// frame, J.
    fn wall_work(&self, masses: [Option<f64>; 2], velocities: [f64; 2]) -> f64 {
        let before = self.own.velocities();
        match masses {
            [None, Some(mass)] => self.velocity * mass * (velocities[1] - before[1]),
            [Some(mass), None] => self.velocity * mass * (velocities[0] - before[0]),
            _ => 0.0,
        }
    }

    fn energies(
        &self,
        own: EnergyLedger,
        masses: [Option<f64>; 2],
        velocities: [f64; 2],
    ) -> EnergyLedger {
        own.with(Account::Kinetic, self.gained(masses, velocities))
            .with(Account::WallWork, self.wall_work(masses, velocities))
    }

    fn row(&self, own: HistoryRow, masses: [Option<f64>; 2]) -> HistoryRow {
        HistoryRow {
            time: self.delay() + own.time,
            velocity: own.velocity.map(|v| v + self.velocity),
            energies: self.energies(own.energies, masses, own.velocity),
            ..own
        }
    }

    fn snapshot(&self, mut own: Snapshot) -> Snapshot {
        let flown = self.met.velocities().map(|v| v * self.delay());
        for side in 0..2 {
            own.carried[side] += flown[side] + self.velocity * own.time;
            own.bodies[side].velocity.iter_mut().for_each(|v| v[1] += self.velocity);
        }
        own.time += self.delay();
        own
    }
}

/// Σ m|v| at the start, N s; that of the relative motion if a wall strikes a body at rest.
fn momentum_scale(approach: &Approach, masses: [Option<f64>; 2]) -> f64 {
    let masses = masses.map(|mass| mass.unwrap_or(0.0));
    let scale: f64 = masses.iter().zip(approach.velocities()).map(|(m, v)| m * v.abs()).sum();
    if scale > 0.0 { scale } else { masses.iter().sum::<f64>() * approach.speed() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: 2 kg at 3 m/s onto 1 kg at rest; the mass centre moves at 2 m/s.
    #[test]
    fn energies_of_both_frames_differ_by_the_motion_of_the_centre() {
        let met = Approach::new([3.0, 0.0], 6.0).unwrap();
        let masses = [Some(2.0), Some(1.0)];
        let frame = OwnFrame::of(&met, masses).unwrap();
        assert_eq!((frame.own().velocities(), frame.velocity), ([1.0, -2.0], 2.0));
        // ½·2·1 + ½·1·4 = 3 J there, ½·2·9 = 9 J here.
        assert_eq!(3.0 + frame.gained(masses, frame.own().velocities()), 9.0);
        assert_eq!(frame.wall_work(masses, [0.0, 0.0]), 0.0);
        assert_eq!(frame.request(&OutputRequest::quantities()), OutputRequest::quantities());
        let snapshot = Snapshot { time: 0.5, ..Snapshot::default() };
        // 2 s of flight at 3 m/s and at rest, then half a second with the mass centre.
        let carried = frame.snapshot(snapshot);
        assert_eq!((carried.time, carried.carried), (2.5, [7.0, 1.0]));
    }

    /// A wall at 2 m/s throws a body of 1 kg at rest away at 4 m/s: 8 J.
    #[test]
    fn a_wall_that_moves_does_work() {
        let met = Approach::new([2.0, 0.0], 0.0).unwrap();
        let masses = [None, Some(1.0)];
        let frame = OwnFrame::of(&met, masses).unwrap();
        assert_eq!((frame.own().velocities(), frame.velocity), ([0.0, -2.0], 2.0));
        assert_eq!(frame.wall_work(masses, [0.0, 2.0]), 8.0);
        assert_eq!(2.0 + frame.gained(masses, [0.0, 2.0]), 8.0);
        assert_eq!(momentum_scale(&met, masses), 2.0);
    }
}
