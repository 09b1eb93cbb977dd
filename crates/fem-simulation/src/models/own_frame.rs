//! Explicit bodies are computed in the frame of their mass centre, from first touch on.
//!
//! Strains are differences of displacements, which rounding would destroy after 10⁶ m of free flight or at a common
//! speed of 10⁹ m/s. With the velocity V of the mass centre and the time t₀ of first touch,
//!
//! ```math
//! t = t_0 + t', \qquad v = v' + V, \qquad
//! E = E' + V \sum_i m_i v_i' + \tfrac12 V^2 \sum_i m_i .
//! ```
//!
//! A wall has an infinite mass and is at rest in this frame. Its work is V times the momentum that it transfers.

use fem_collision::{
    Account, Approach, ApproachError, BodyResult, Collision, EnergyLedger, HistoryRow,
    OutputRequest, Progress, Snapshot, SnapshotRequest,
};

/// The transformation between the frame of the case and that of the mass centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OwnFrame {
    /// Approach in the case.
    approach: Approach,
    /// Approach in the frame of the mass centre, with first touch at time 0.
    own: Approach,
    /// Velocity of the mass centre along +y, m/s.
    velocity: f64,
}

impl OwnFrame {
    /// Returns the frame of bodies with these masses, kg; `None` for a wall, a half-space and a held body.
    ///
    /// # Errors
    /// Speeds that leave the range of f64.
    pub fn of(approach: &Approach, masses: [Option<f64>; 2]) -> Result<Self, ApproachError> {
        let masses = masses.map(|mass| mass.unwrap_or(f64::INFINITY));
        let (own, velocity) = approach.in_frame_of_centre(masses)?;
        Ok(Self { approach: *approach, own, velocity })
    }

    /// Returns the approach in the frame of the mass centre.
    pub fn own(&self) -> &Approach {
        &self.own
    }

    /// Returns the approach in the case.
    pub fn approach(&self) -> &Approach {
        &self.approach
    }

    /// Returns the output request with times since first touch.
    pub fn request(&self, request: &OutputRequest) -> OutputRequest {
        let mut request = request.clone();
        if let SnapshotRequest::Times(times) = &mut request.snapshots {
            times.iter_mut().for_each(|time| *time -= self.delay());
        }
        request
    }

    /// Returns the progress of a run in the time of the case.
    pub fn progress(&self, own: Progress) -> Progress {
        Progress { time: self.delay() + own.time, ..own }
    }

    /// Returns the collision in the frame of the case.
    pub fn collision(&self, own: Collision) -> Collision {
        if self.approach == self.own {
            return own;
        }
        let masses = own.bodies.map(|body| body.mass);
        let scale = |approach: &Approach| momentum_scale(approach, masses);
        let initial =
            own.initial_energy.map(|energy| energy + self.gained(masses, self.own.velocities()));
        // Bodies keep their velocities after the contact. Where they are unknown the balance is the same with any.
        let after = own.bodies.map(|body| body.velocity_after);
        let [lower, upper] = self.own.velocities();
        let last = own.history.last().map(|row| row.velocity);
        let last = last.unwrap_or([after[0].unwrap_or(lower), after[1].unwrap_or(upper)]);
        let moved = Collision {
            approach: self.approach,
            initial_energy: initial,
            energies: self.energies(own.energies, masses, last),
            momentum_residual_relative: own
                .momentum_residual_relative
                .map(|residual| residual * (scale(&self.own) / scale(&self.approach))),
            bodies: own.bodies.map(|body| BodyResult {
                velocity_after: body.velocity_after.map(|v| v + self.velocity),
                ..body
            }),
            ..own
        };
        let row = |row| self.row(row, masses);
        moved.map_samples(row, |snapshot| self.snapshot(snapshot)).later_by(self.delay())
    }

    /// Returns the time of first touch, s.
    fn delay(&self) -> f64 {
        self.approach.first_touch()
    }

    /// Returns the additional kinetic energy in the frame of the case at velocities in this frame, J.
    fn gained(&self, masses: [Option<f64>; 2], velocities: [f64; 2]) -> f64 {
        let bodies = masses.into_iter().zip(velocities);
        let moving = bodies.filter_map(|(mass, v)| Some(mass? * (v + 0.5 * self.velocity)));
        self.velocity * moving.sum::<f64>()
    }

    /// Returns the work of a wall on the other body, which has reached this velocity in this frame, J.
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
            velocity: own.velocity.map(|v| v + self.velocity),
            energies: self.energies(own.energies, masses, own.velocity),
            ..own
        }
    }

    fn snapshot(&self, mut own: Snapshot) -> Snapshot {
        let flown = self.approach.velocities().map(|v| v * self.delay());
        for side in 0..2 {
            own.carried[side] += flown[side] + self.velocity * own.time;
            own.bodies[side].velocity.iter_mut().for_each(|v| v[1] += self.velocity);
        }
        own
    }
}

/// Returns Σ m|v| at the start, N s, or that of the relative motion if a wall strikes a body at rest.
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
        let approach = Approach::new([3.0, 0.0], 6.0).unwrap();
        let masses = [Some(2.0), Some(1.0)];
        let frame = OwnFrame::of(&approach, masses).unwrap();
        assert_eq!((frame.own().velocities(), frame.velocity), ([1.0, -2.0], 2.0));
        // ½·2·1 + ½·1·4 = 3 J there, ½·2·9 = 9 J here.
        assert_eq!(3.0 + frame.gained(masses, frame.own().velocities()), 9.0);
        assert_eq!(frame.wall_work(masses, [0.0, 0.0]), 0.0);
        assert_eq!(frame.request(&OutputRequest::quantities()), OutputRequest::quantities());
        let snapshot = Snapshot { time: 0.5, ..Snapshot::default() };
        // 2 s of flight at 3 m/s and at rest, then half a second with the mass centre.
        assert_eq!(frame.snapshot(snapshot).carried, [7.0, 1.0]);
    }

    /// A wall at 2 m/s throws a body of 1 kg at rest away at 4 m/s: 8 J.
    #[test]
    fn a_wall_that_moves_does_work() {
        let approach = Approach::new([2.0, 0.0], 0.0).unwrap();
        let masses = [None, Some(1.0)];
        let frame = OwnFrame::of(&approach, masses).unwrap();
        assert_eq!((frame.own().velocities(), frame.velocity), ([0.0, -2.0], 2.0));
        assert_eq!(frame.wall_work(masses, [0.0, 2.0]), 8.0);
        assert_eq!(2.0 + frame.gained(masses, [0.0, 2.0]), 8.0);
        assert_eq!(momentum_scale(&approach, masses), 2.0);
    }
}
