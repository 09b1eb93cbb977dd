//! A collision from first touch until the bodies have parted.

use fem_collision::{
    Collision, Ending, Frame, Monitor, OutputRequest, Phase, SnapshotRequest, Stop,
};

use crate::error::CondensedError;
use crate::motion::ImpactMotion;
use crate::pair::CondensedPair;
use crate::run::ImpactRun;
use crate::settings::ContactModel;
use crate::settings::Damping;

/// Reach of the points that are followed over the elastic contact radius; a collision that needs
/// more is run again with all points.
const REACH: f64 = 1.3;
/// Largest ω Δt of a mode of vibration: its period is right to (ω Δt)⁴/480 = 1e-4.
const LARGEST_PHASE: f64 = 0.5;
/// Impact of an elastic pair: fewer steps than this do not follow it.
const FEWEST_STEPS: usize = 8;
/// Share of steps with a contact area that is not a disc above which a warning is given.
const MANY_REPEATED: f64 = 0.01;

impl CondensedPair {
    /// Steps over the elastic contact time that give a restitution to 2e-5.
    pub const N_STEPS: usize = 200;

    /// The quantities of the collision at a relative speed (m/s) with what takes energy from
    /// the bodies: relaxations, lower first, `None` is elastic; or more ([`Damping`]). `n_steps` steps
    /// over the elastic contact time.
    ///
    /// # Errors
    /// As [`CondensedPair::collide`]; a speed that is not positive and finite; whatever stops a
    /// collision before its end: a contact beyond the condensed region, bodies that neither part nor
    /// come to rest within the time.
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

    /// The collision of bodies that meet like this, as far as it gets.
    ///
    /// # Errors
    /// Too few steps, a radiation that is negative or not finite, a contact that is beyond the condensed
    /// region already without relaxation.
    pub fn collide<'a>(
        &self,
        frame: &Frame,
        damping: impl Into<Damping<'a>>,
        n_steps: usize,
        want: &OutputRequest,
        monitor: &mut dyn Monitor,
    ) -> Result<Collision, CondensedError> {
        let (speed, damping) = (frame.speed(), damping.into());
        damping.check()?;
        if n_steps < FEWEST_STEPS {
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
                ImpactRun::new(self, motion, frame, want, n_steps, elastic.contact_time)
                    .until_parted(monitor),
            )
        };
        let mut finished = run(n_near)?;
        if finished.collision.outgrown_radius().is_some() && n_near < n_all {
            finished = run(n_all)?;
        }
        let mut collision = finished.collision;
        if want.snapshots != SnapshotRequest::none() {
            monitor.enter(Phase::Fields);
            let (trace, ending) = (&finished.trace, &collision.ending);
            let request = &want.snapshots;
            match self.snapshots(frame, damping, time_step, trace, ending, request) {
                Ok((snapshots, missing)) => {
                    collision.snapshots = snapshots;
                    collision.warnings.splice(0..0, missing);
                }
                Err(error) => collision.ending = Ending::Stopped(error.into()),
            }
        }
        if !want.probes.is_empty() {
            monitor.enter(Phase::Fields);
            let last = finished.trace.len().saturating_sub(1);
            match self.probed(frame, damping, time_step, last, &want.probes) {
                Ok(probes) => collision.probes = probes,
                Err(error) => collision.ending = Ending::Stopped(error.into()),
            }
        }
        let share = collision
            .repeated_contact_solutions
            .zip(collision.steps)
            .map_or(0.0, |(repeated, steps)| repeated as f64 / steps as f64);
        if share > MANY_REPEATED && self.settings().contact == ContactModel::Exact {
            collision.warnings.push(format!(
                "in {:.0} % of the steps the contact was no disc; it was solved all the same",
                100.0 * share
            ));
        }
        Ok(collision)
    }

    /// Approach and forces at a time (s) after first touch, to the nearest of [`Self::N_STEPS`].
    ///
    /// # Errors
    /// The errors are those of [`CondensedPair::impact`].
    pub fn collide_until<'a>(
        &self,
        speed: f64,
        damping: impl Into<Damping<'a>>,
        time: f64,
    ) -> Result<ContactState, CondensedError> {
        let elastic = self.elastic_impact(speed)?;
        let time_step = self.time_step(elastic.contact_time / Self::N_STEPS as f64);
        let damping = damping.into();
        damping.check()?;
        let mut motion = ImpactMotion::new(self, speed, damping, time_step, self.points.len())?;
        while motion.time() + 0.5 * time_step < time {
            motion.advance()?;
        }
        Ok(ContactState { time: motion.time(), approach: motion.approach, forces: motion.forces })
    }

    /// How many points are followed at first by a collision that closes all up to this one without
    /// relaxation.
    fn n_near(&self, last_closed: usize) -> usize {
        let mut reach = REACH * self.points[last_closed].radius;
        if self.nodal_side.is_none() {
            // What has to stay open.
            reach += self.longest_element(last_closed);
        }
        let within = self.points.partition_point(|point| point.radius <= reach);
        (within + 2).min(self.points.len())
    }

    /// √(g δ) of the static approach δ without relaxation, m/s: of a ball that is let down more slowly
    /// the weight decides how long the contact is and how far it reaches. 0 without gravity.
    fn fall_speed(&self, frame: &Frame) -> f64 {
        if frame.gravity == 0.0 {
            return 0.0;
        }
        let at_rest = self.curve.approach(frame.weight()).unwrap_or_default();
        (frame.gravity * at_rest).sqrt()
    }

    /// The step asked for, or what the modes of vibration allow.
    fn time_step(&self, asked: f64) -> f64 {
        let squared = self.sides.iter().flatten().filter_map(|side| {
            side.vibrations.as_ref()?.modes.squared_frequency.iter().copied().reduce(f64::max)
        });
        squared.map(|squared| LARGEST_PHASE / squared.sqrt()).fold(asked, f64::min)
    }
}

/// The contact at an instant.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactState {
    /// Since first touch, s.
    pub time: f64,
    /// Approach of the mass centres, m.
    pub approach: f64,
    /// Forces at the points, from the axis outward, N.
    pub forces: Vec<f64>,
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
