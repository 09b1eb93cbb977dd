//! A collision from first touch until the bodies have separated.

use fem_collision::{
    Collision, Ending, Frame, Monitor, OutputRequest, Phase, SnapshotRequest, Stop,
};

use crate::error::CondensedError;
use crate::motion::ImpactMotion;
use crate::pair::CondensedPair;
use crate::run::ImpactRun;
use crate::run::instants::RunTrace;
use crate::settings::ContactModel;
use crate::settings::Damping;

/// Radius of the points that are included at first, over the elastic contact radius. A collision that needs
/// more points is run again with all of them.
const INCLUDED_OVER_CONTACT_RADIUS: f64 = 1.3;
/// Largest ω Δt of a mode of vibration; the error of its period is (ω Δt)⁴/480 = 1e-4.
const MAX_PHASE: f64 = 0.5;
/// Smallest number of steps per elastic contact time.
const MIN_STEPS: usize = 8;
/// Share of steps with a contact area that is not a disc above which a warning is given.
const MANY_REPEATED: f64 = 0.01;

impl CondensedPair {
    /// Default number of steps per elastic contact time; the restitution is exact to 2e-5.
    pub const N_STEPS: usize = 200;

    /// Computes the quantities of the collision at a relative speed (m/s), with `n_steps` steps per elastic
    /// contact time. Dissipation is a pair of relaxations, lower body first and `None` for an elastic one, or
    /// [`Damping`].
    ///
    /// # Errors
    /// Those of [`CondensedPair::collide`]; a speed that is not positive and finite; a collision that stops before
    /// its end, because the contact grows beyond the condensed region or because the bodies neither separate nor
    /// come to rest in time.
    pub fn impact<'a>(
        &self,
        speed: f64,
        damping: impl Into<Damping<'a>>,
        n_steps: usize,
    ) -> Result<Collision, CondensedError> {
        let frame = self.frame(speed)?;
        let collision =
            self.collide(&frame, damping, n_steps, &OutputRequest::quantities(), &mut ())?;
        match collision.ending {
            Ending::Stopped(stop) => Err(stop.into()),
            _ => Ok(collision),
        }
    }

    /// Computes a collision until its end or a stop.
    ///
    /// # Errors
    /// Too few steps, a radiation coefficient that is negative or not finite, a contact that is beyond the condensed
    /// region already without relaxation.
    pub fn collide<'a>(
        &self,
        frame: &Frame,
        damping: impl Into<Damping<'a>>,
        n_steps: usize,
        request: &OutputRequest,
        monitor: &mut dyn Monitor,
    ) -> Result<Collision, CondensedError> {
        let (speed, damping) = (frame.speed(), damping.into());
        damping.check()?;
        if n_steps < MIN_STEPS {
            let (name, value) = ("number of steps", n_steps as f64);
            return Err(CondensedError::Setting { name, value, allowed: "at least 8" });
        }
        self.prepare(speed, damping.relaxations)?;
        monitor.enter(Phase::Collision);
        let elastic = self.elastic_impact(speed.max(self.fall_speed(frame)))?;
        let n_all = self.points.len();
        let n_near = self.n_near(elastic.n_closed - 1);
        let time_step = self.time_step(elastic.contact_time / n_steps as f64);
        let mut run = |n_points: usize| {
            let motion = ImpactMotion::new(self, speed, damping, time_step, n_points)?
                .with_gravity(frame.gravity);
            Ok::<_, CondensedError>(
                ImpactRun::new(self, motion, frame, request, n_steps, elastic.contact_time)
                    .until_parted(monitor),
            )
        };
        let mut finished = run(n_near)?;
        if finished.collision.outgrown_radius().is_some() && n_near < n_all {
            finished = run(n_all)?;
        }
        let mut collision = finished.collision;
        if request.snapshots != SnapshotRequest::none() || !request.probes.is_empty() {
            monitor.enter(Phase::Fields);
            let trace = &finished.trace;
            let fields = self.add_fields(&mut collision, frame, damping, time_step, trace, request);
            if let Err(error) = fields {
                collision.ending = Ending::Stopped(error.into());
            }
        }
        let share = collision
            .repeated_contact_solutions
            .zip(collision.steps)
            .map_or(0.0, |(repeated, steps)| repeated as f64 / steps as f64);
        if share > MANY_REPEATED && self.settings().contact == ContactModel::Exact {
            collision.warnings.push(format!(
                "in {:.0} % of the steps the contact area was not a disc: the general solver was used",
                100.0 * share
            ));
        }
        Ok(collision)
    }

    /// Adds the requested snapshots and probes to a finished collision.
    fn add_fields(
        &self,
        collision: &mut Collision,
        frame: &Frame,
        damping: Damping<'_>,
        time_step: f64,
        trace: &[RunTrace],
        request: &OutputRequest,
    ) -> Result<(), CondensedError> {
        if request.snapshots != SnapshotRequest::none() {
            let (ending, asked) = (&collision.ending, &request.snapshots);
            let (snapshots, missing) =
                self.snapshots(frame, damping, time_step, trace, ending, asked)?;
            collision.snapshots = snapshots;
            collision.warnings.splice(0..0, missing);
        }
        if !request.probes.is_empty() {
            let last = trace.len().saturating_sub(1);
            collision.probes = self.probed(frame, damping, time_step, last, &request.probes)?;
        }
        Ok(())
    }

    /// Returns the number of points to include at first, for a collision that closes all up to this one without
    /// relaxation.
    fn n_near(&self, last_closed: usize) -> usize {
        let mut reach = INCLUDED_OVER_CONTACT_RADIUS * self.points[last_closed].radius;
        if self.nodal_side.is_none() {
            // The element that has to stay open.
            reach += self.longest_element(last_closed);
        }
        let within = self.points.partition_point(|point| point.radius <= reach);
        (within + 2).min(self.points.len())
    }

    /// Returns √(g δ) of the static approach δ without relaxation, m/s; 0 without gravity. At lower speeds the
    /// weight determines contact time and contact radius.
    fn fall_speed(&self, frame: &Frame) -> f64 {
        if frame.gravity == 0.0 {
            return 0.0;
        }
        let at_rest = self.curve.approach(frame.weight()).unwrap_or_default();
        (frame.gravity * at_rest).sqrt()
    }

    /// Returns the given step (s), limited by the modes of vibration.
    fn time_step(&self, asked: f64) -> f64 {
        let squared = self.sides.iter().flatten().filter_map(|side| {
            side.vibrations.as_ref()?.modes.squared_frequency.iter().copied().reduce(f64::max)
        });
        squared.map(|squared| MAX_PHASE / squared.sqrt()).fold(asked, f64::min)
    }
}

impl From<CondensedError> for Stop {
    fn from(error: CondensedError) -> Self {
        match error {
            CondensedError::Stopped(stop) => stop,
            error @ CondensedError::OutOfMemory => Self::OutOfMemory(error.to_string()),
            error => Self::NotMade(error.to_string()),
        }
    }
}
