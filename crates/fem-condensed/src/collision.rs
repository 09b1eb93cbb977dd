//! A collision from first touch until the bodies have parted.

use fem_material::PronySeries;

use crate::CondensedError;
use crate::instants::Trace;
use crate::motion::Motion;
use crate::pair::CondensedPair;
use crate::run::Run;

/// Reach of the points that are followed over the elastic contact radius; a collision that needs
/// more is run again with all points.
const REACH: f64 = 1.3;
/// Largest ω Δt of a mode of vibration: its period is right to (ω Δt)⁴/480 = 1e-4.
const LARGEST_PHASE: f64 = 0.5;
/// Impact of an elastic pair: fewer steps than this do not follow it.
const FEWEST_STEPS: usize = 8;

/// How a collision is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CollideSettings {
    /// Steps over the elastic contact time.
    pub n_steps: usize,
    /// Whether the history is kept.
    pub history: bool,
    /// The run gives up after so many elastic contact times.
    pub give_up_after: f64,
}

impl Default for CollideSettings {
    fn default() -> Self {
        Self { n_steps: 200, history: false, give_up_after: 50.0 }
    }
}

/// One instant; all quantities belong to the same time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Time since first touch, s.
    pub time: f64,
    /// Contact force, ≥ 0, N.
    pub contact_force: f64,
    /// Radius where the contact pressure falls to zero, m.
    pub contact_radius: f64,
    /// Approach of the mass centres, m.
    pub approach: f64,
    /// Contact pressure on the axis, Pa.
    pub centre_pressure: f64,
    /// Rate of the approach, m/s.
    pub approach_rate: f64,
    /// Kinetic energy in the frame of the common mass centre, vibrations included, J.
    pub kinetic: f64,
    /// Strain energy, J.
    pub strain: f64,
    /// Energy in penalty springs, J.
    pub contact: f64,
    /// Energy dissipated by relaxation, J.
    pub viscous_dissipation: f64,
    /// What does not add up, J.
    pub residual: f64,
    /// Kinetic energy of each body's vibrations, J.
    pub vibration: [f64; 2],
}

/// How a collision ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Ending {
    /// The bodies have parted.
    Parted,
    /// They stay together: what energy is left could not part them at a restitution of 1e-4.
    Together,
    /// It did not; the results are those so far.
    Stopped(CondensedError),
}

/// A glance at a collision under way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Glance {
    /// Time since first touch, s.
    pub time: f64,
    /// Steps done.
    pub step: usize,
    /// Estimated share of the run that is done, 0 to 1.
    pub fraction: f64,
    /// N.
    pub contact_force: f64,
}

/// What came out of a collision.
#[derive(Debug, Clone, PartialEq)]
pub struct Collision {
    /// How it ended.
    pub ending: Ending,
    /// Relative speed after over before; 0 for bodies that stay together.
    pub restitution: f64,
    /// First touch to the end of contact, openings in between included, s; for bodies that stay
    /// together, until that was clear.
    pub contact_time: f64,
    /// Number of separate contacts.
    pub contact_episodes: usize,
    /// Largest contact force, N.
    pub peak_force: f64,
    /// Largest approach, m.
    pub max_approach: f64,
    /// Largest contact radius, m.
    pub max_contact_radius: f64,
    /// Largest contact pressure on the axis, Pa.
    pub peak_pressure: f64,
    /// Energy left in the vibrations of each body, J.
    pub vibration_energy: [f64; 2],
    /// Kinetic energy before in the frame of the common mass centre, J.
    pub initial_energy: f64,
    /// Worst imbalance of energy over the initial.
    pub residual_relative: f64,
    /// About a thousand steps over the contact, its first and last among them, if asked for.
    pub history: Vec<Row>,
    /// Every step.
    pub(crate) trace: Vec<Trace>,
    /// s.
    pub time_step: f64,
    /// Steps until the run ended.
    pub steps: usize,
    /// Contact problems that were no discs.
    pub n_fallbacks: usize,
}

impl CondensedPair {
    /// The collision at a relative speed (m/s) with the given relaxations of the bodies, lower
    /// first; `None` is elastic.
    ///
    /// # Errors
    /// A speed that is not positive and finite; whatever stops a collision before its end: a contact
    /// beyond the condensed region, bodies that do not part within the time.
    pub fn collide(
        &self,
        speed: f64,
        relaxations: [Option<&PronySeries>; 2],
        settings: &CollideSettings,
    ) -> Result<Collision, CondensedError> {
        let collision = self.follow(speed, relaxations, settings, &mut |_| true)?;
        match collision.ending {
            Ending::Stopped(error) => Err(error),
            _ => Ok(collision),
        }
    }

    /// The same, as far as it gets; `watch` looks on every few steps and stops it with `false`.
    ///
    /// # Errors
    /// A speed that is not positive and finite, settings out of range, a contact that is beyond the
    /// condensed region already without relaxation.
    pub fn follow(
        &self,
        speed: f64,
        relaxations: [Option<&PronySeries>; 2],
        settings: &CollideSettings,
        watch: &mut dyn FnMut(Glance) -> bool,
    ) -> Result<Collision, CondensedError> {
        if !(speed > 0.0 && speed.is_finite()) {
            return Err(CondensedError::NotApproaching(speed));
        }
        if settings.n_steps < FEWEST_STEPS {
            let (name, value) = ("number of steps", settings.n_steps as f64);
            return Err(CondensedError::Setting { name, value, allowed: "at least 8" });
        }
        let elastic = self.elastic_impact(speed)?;
        let reach = REACH * self.points[elastic.n_closed - 1].radius;
        let n_all = self.points.len();
        let n_near = (self.points.partition_point(|point| point.radius <= reach) + 2).min(n_all);
        let time_step = self.time_step(elastic.contact_time / settings.n_steps as f64);
        let mut run = |n_points: usize| {
            let motion = Motion::new(self, speed, relaxations, time_step, n_points)?;
            let run = Run::new(self, motion, speed, settings, elastic.contact_time);
            Ok(run.until_parted(watch))
        };
        let collision = run(n_near)?;
        match collision.ending {
            Ending::Stopped(CondensedError::ContactBeyondCandidates { .. }) if n_near < n_all => {
                run(n_all)
            }
            _ => Ok(collision),
        }
    }

    /// Approach and forces at a time (s) after first touch, to the nearest of the default steps.
    ///
    /// # Errors
    /// As [`CondensedPair::collide`].
    pub fn collide_until(
        &self,
        speed: f64,
        relaxations: [Option<&PronySeries>; 2],
        time: f64,
    ) -> Result<ContactState, CondensedError> {
        let elastic = self.elastic_impact(speed)?;
        let n_steps = CollideSettings::default().n_steps as f64;
        let time_step = self.time_step(elastic.contact_time / n_steps);
        let mut motion = Motion::new(self, speed, relaxations, time_step, self.points.len())?;
        while motion.time() + 0.5 * time_step < time {
            motion.advance()?;
        }
        Ok(ContactState { time: motion.time(), approach: motion.approach, forces: motion.forces })
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
    /// m.
    pub approach: f64,
    /// Forces at the points, from the axis outward, N.
    pub forces: Vec<f64>,
}
