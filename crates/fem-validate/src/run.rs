//! Cases that were run.

use fem_case::{Case, Outcome, Problem};
use fem_explicit::Collision;
use fem_laws::HertzImpact;

/// An explicit case and what came out of it; the run ended by itself.
#[derive(Debug)]
pub struct Run {
    /// Case, plan, meshes and model.
    pub problem: Problem,
    /// The result.
    pub collision: Collision,
    /// The restitution.
    pub restitution: f64,
    /// First to last contact, s.
    pub contact_time: f64,
    /// What the run took, s.
    pub seconds: f64,
}

impl Run {
    /// Centre pressure over Hertz' at this run's own peak force: free of the error in force.
    pub fn pressure_over_hertz_at_force(&self) -> f64 {
        let hertz = self.problem.plan.estimate.hertz;
        over_hertz_at_force(&hertz, self.collision.peak_force, self.collision.peak_pressure)
    }
}

/// A case of any model and what came out of it; the run ended by itself.
#[derive(Debug)]
pub struct Simulated {
    /// The case.
    pub case: Case,
    /// Hertz with instantaneous moduli.
    pub hertz: HertzImpact,
    /// What every model gives.
    pub outcome: Outcome,
    /// The restitution.
    pub restitution: f64,
    /// What the run took, s.
    pub seconds: f64,
}

impl Simulated {
    /// Centre pressure over Hertz' at this run's own peak force; NaN of a model without pressures.
    pub fn pressure_over_hertz_at_force(&self) -> f64 {
        let Outcome { peak_force, peak_pressure, .. } = self.outcome;
        peak_force
            .zip(peak_pressure)
            .map_or(f64::NAN, |(force, pressure)| over_hertz_at_force(&self.hertz, force, pressure))
    }
}

impl From<&Run> for Simulated {
    fn from(run: &Run) -> Self {
        Self {
            case: run.problem.case.clone(),
            hertz: run.problem.plan.estimate.hertz,
            outcome: Outcome::of_fem(&run.problem, run.collision.clone()),
            restitution: run.restitution,
            seconds: run.seconds,
        }
    }
}

/// A centre pressure (Pa) over that of Hertz at a peak force (N), p0 ∝ F^(1/3).
fn over_hertz_at_force(hertz: &HertzImpact, peak_force: f64, peak_pressure: f64) -> f64 {
    let at_force = hertz.peak_pressure() * (peak_force / hertz.peak_force()).cbrt();
    peak_pressure / at_force
}
