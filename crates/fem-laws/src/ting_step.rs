//! One step of a viscoelastic collision by collocation at Gauss points.
//!
//! The force at the points is iterated: it fixes the motion by two integrations, the motion fixes
//! what the Maxwell elements remember, exactly, and that the force. The iteration contracts while
//! the step is a fraction of the contact's period or of its viscous braking time, however fast
//! the relaxation.

use crate::collocation::{
    Interpolation, N, POINTS, Vector, dot, double_integral_moments, fading_moments, finest_detail,
    integral_moments,
};
use crate::ting_record::{Contact, FORCE, Memory, PRESSURE, Record, SURFACE, Step};

/// Where the motion stands.
#[derive(Debug, Clone)]
pub(crate) struct State {
    pub time: f64,
    pub approach: f64,
    pub rate: f64,
    pub force: f64,
    pub memory: Vec<Memory>,
}

/// A step with what it did at the Gauss points.
#[derive(Debug, Clone)]
pub(crate) struct Solved {
    pub step: Step,
    /// Pressure on the axis.
    pub pressure: Vector,
    /// u at which the growing contact was as large as at each point.
    pub contact_approach: Vector,
    /// Error of the rate over the step, estimated.
    pub error: f64,
    pub n_iterations: usize,
}

/// The step sizes' share of the memory: what fades of the past, and weights of the present.
struct Kernel {
    faded: [Vector; 3],
    weights: [Vector; N],
}

/// More than this says that the step is too long.
const MAX_ITERATIONS: usize = 20;

/// Change of the rate, of 1, at which the iteration ends.
const SETTLED: f64 = 1e-14;

pub(crate) struct Stepper<'a> {
    pub contact: &'a Contact,
    pub interpolation: &'a Interpolation,
    /// `None` while the contact grows.
    pub record: Option<&'a Record>,
}

impl Stepper<'_> {
    /// `None` if the iteration does not settle.
    pub fn solve(&self, state: &State, length: f64) -> Option<Solved> {
        let kernel = self.kernel(state, length);
        let singles = POINTS.map(integral_moments);
        let doubles = POINTS.map(double_integral_moments);
        let times = POINTS.map(|theta| state.time + theta * length);
        let mut guesses = match self.record {
            Some(record) => times.map(|time| 2.0 * record.end - time),
            None => times,
        };
        let mut force = [state.force; N];
        for n_iterations in 1..=MAX_ITERATIONS {
            let coefficients = self.interpolation.coefficients(&force);
            let mut hertz = [0.0; N];
            let mut drives = [[0.0; N]; 3];
            for i in 0..N {
                let rate = state.rate - length * dot(&coefficients, &singles[i]);
                let lost = length * dot(&coefficients, &doubles[i]);
                let approach = state.approach + length * (state.rate * POINTS[i] - lost);
                let (u, slope) = self.contact.correction.hertz_approach(approach.max(0.0));
                hertz[i] = u;
                drives[SURFACE][i] = slope * rate;
                drives[FORCE][i] = 1.5 * u.sqrt() * slope * rate;
                drives[PRESSURE][i] = if u > 0.0 { 0.5 / u.sqrt() * slope * rate } else { 0.0 };
            }
            let mut contact_approach = hertz;
            let mut shrunk_pressure = [0.0; N];
            let new_force = match self.record {
                None => self.remembered(&kernel, FORCE, &hertz.map(|u| u * u.sqrt()), &drives),
                Some(record) => {
                    let surface = self.remembered(&kernel, SURFACE, &hertz, &drives);
                    std::array::from_fn(|i| {
                        let shrunk = record.shrunk(self.contact, times[i], surface[i], guesses[i]);
                        guesses[i] = shrunk.equivalent_time;
                        contact_approach[i] = shrunk.hertz_approach;
                        shrunk_pressure[i] = shrunk.pressure;
                        shrunk.force
                    })
                }
            };
            let change = (0..N).map(|i| (new_force[i] - force[i]).abs()).fold(0.0, f64::max);
            force = new_force;
            if length * change <= SETTLED {
                let pressure = match self.record {
                    None => self.remembered(&kernel, PRESSURE, &hertz.map(f64::sqrt), &drives),
                    Some(_) => shrunk_pressure,
                };
                let step = self.polynomials(state, length, &force, &drives);
                let error = length
                    * (finest_detail(&step.force) + length * finest_detail(&step.drives[FORCE]));
                return Some(Solved { step, pressure, contact_approach, error, n_iterations });
            }
        }
        None
    }

    fn kernel(&self, state: &State, length: f64) -> Kernel {
        let mut kernel = Kernel { faded: [[0.0; N]; 3], weights: [[0.0; N]; N] };
        for ((weight, rate), memory) in self.contact.elements.iter().zip(&state.memory) {
            let z = rate * length;
            for i in 0..N {
                let decay = weight * (-z * POINTS[i]).exp();
                for kind in [FORCE, SURFACE, PRESSURE] {
                    kernel.faded[kind][i] += decay * memory[kind];
                }
                let moments = fading_moments(POINTS[i], z);
                let weights = self.interpolation.weights(&moments);
                for j in 0..N {
                    kernel.weights[i][j] += length * weight * weights[j];
                }
            }
        }
        kernel
    }

    /// Elastic part and fading memory of one drive, at the points.
    fn remembered(
        &self,
        kernel: &Kernel,
        kind: usize,
        elastic: &Vector,
        drives: &[Vector; 3],
    ) -> Vector {
        std::array::from_fn(|i| {
            self.contact.equilibrium * elastic[i]
                + kernel.faded[kind][i]
                + dot(&kernel.weights[i], &drives[kind])
        })
    }

    fn polynomials(
        &self,
        state: &State,
        length: f64,
        force: &Vector,
        drives: &[Vector; 3],
    ) -> Step {
        let mut step = Step {
            start: state.time,
            length,
            approach: state.approach,
            rate: state.rate,
            memory: state.memory.clone(),
            force: self.interpolation.coefficients(force),
            drives: drives.map(|drive| self.interpolation.coefficients(&drive)),
        };
        // d√u is singular at first touch; its integral over the step is known all the same.
        let root =
            |approach: f64| self.contact.correction.hertz_approach(approach.max(0.0)).0.sqrt();
        let gained = root(step.approach_at(1.0)) - root(state.approach);
        let drive = &mut step.drives[PRESSURE];
        drive[0] += gained / length - dot(drive, &integral_moments(1.0));
        step
    }
}
