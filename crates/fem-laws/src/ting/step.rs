//! One step of a viscoelastic collision by collocation at Gauss points.
//!
//! The force at the points is iterated: it fixes the motion by two integrations, the motion fixes
//! what the Maxwell elements remember, exactly, and that the force. The iteration contracts while
//! the step is a fraction of the contact's period or of its viscous braking time, however fast
//! the relaxation.

use crate::finite_size::correction::Correction;
use crate::numerics::exp;
use crate::ting::collocation::{
    Interpolation, N, POINTS, Vector, dot, double_integral_moments, fading_moments, finest_detail,
    integral_moments,
};
use crate::ting::loading_record::{Contact, FORCE, Memory, PRESSURE, Record, SURFACE, Step};
use crate::ting::radiation_compliance::SlowForce;

/// Where the motion stands.
#[derive(Debug, Clone)]
pub(crate) struct State {
    pub time: f64,
    pub approach: f64,
    pub rate: f64,
    pub force: f64,
    /// 0 without radiation.
    pub slow_force: f64,
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
    force: Fading,
    /// Memories weighted by α_k and β_k of the finite size.
    creep: [Fading; 2],
    /// Memories weighted by α_k b_k and β_k b_k.
    creep_decay: [Fading; 2],
    radiation: Option<SlowForce>,
}

/// Memory of one combination of the elements.
#[derive(Clone, Copy)]
struct Fading {
    faded: [Vector; 3],
    weights: [Vector; N],
    /// Sum of the factors.
    instantaneous: f64,
}

impl Fading {
    const NONE: Self = Self { faded: [[0.0; N]; 3], weights: [[0.0; N]; N], instantaneous: 0.0 };

    /// Returns the internal variables of one drive at point `i`, with an elastic part.
    fn at(&self, kind: usize, drives: &[Vector; 3], i: usize, elastic: f64) -> f64 {
        elastic + self.faded[kind][i] + dot(&self.weights[i], &drives[kind])
    }
}

/// More than this says that the step is too long.
const MAX_ITERATIONS: usize = 20;

pub(crate) struct Stepper<'a> {
    pub contact: &'a Contact,
    pub interpolation: &'a Interpolation,
    /// `None` while the contact grows.
    pub record: Option<&'a Record>,
}

impl Contact {
    /// Returns Hertz' approach u of a state.
    pub fn hertz_approach_of(&self, state: &State) -> f64 {
        let approach = state.approach - self.deflection(state.rate, state.time);
        let own = match &self.radiation {
            None => approach,
            Some(radiation) => approach - radiation.approach(state.force, state.slow_force),
        };
        self.hertz_approach(own, &state.memory)
    }
}

impl Kernel {
    /// Returns the internal variables of the finite size at point `i` for a drive, and their rates.
    fn creep_at(&self, drives: &[Vector; 3], i: usize) -> (Correction, Correction) {
        let value = self.creep.map(|fading| fading.at(FORCE, drives, i, 0.0));
        let rate: [f64; 2] = std::array::from_fn(|part| {
            let decay = self.creep_decay[part].at(FORCE, drives, i, 0.0);
            self.creep[part].instantaneous * drives[FORCE][i] - decay
        });
        let correction = |[alpha, beta]: [f64; 2]| Correction { alpha, beta };
        (correction(value), correction(rate))
    }
}

impl Stepper<'_> {
    /// Solves a step; `None` if the iteration does not converge.
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
        let mut drives = [[0.0; N]; 3];
        let mut hertz = match self.contact.radiation {
            None => [0.0; N],
            Some(_) => [self.contact.hertz_approach_of(state); N],
        };
        for n_iterations in 1..=MAX_ITERATIONS {
            let coefficients = self.interpolation.coefficients(&force);
            let waves = kernel.radiation.as_ref().map(|slow| {
                slow.waves(self.interpolation, length, self.contact.correction, &force, &hertz)
            });
            let creep: [_; N] = std::array::from_fn(|i| kernel.creep_at(&drives, i));
            for i in 0..N {
                let theta = POINTS[i];
                let given = self.contact.gravity * theta;
                let rate = state.rate - length * (dot(&coefficients, &singles[i]) - given);
                let lost = length * (dot(&coefficients, &doubles[i]) - 0.5 * given * theta);
                let approach = state.approach + length * (state.rate * theta - lost)
                    - self.contact.deflection(rate, times[i]);
                let rate = rate - self.contact.deflection_rate(force[i]);
                let (remembered, creeping) = &creep[i];
                let (u, slope, rate) = match &waves {
                    None => {
                        let (u, slope) = self.contact.inverted(approach, remembered);
                        (u, slope, rate)
                    }
                    Some(waves) => waves.hertz_approach(i, approach, rate, remembered),
                };
                hertz[i] = u;
                let rate = rate - creeping.at(u);
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
            if length * change <= self.contact.accuracy.rate {
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
        let none = [Fading::NONE; 2];
        let radiation = self.contact.radiation.map(|radiation| {
            let elements = self.contact.elements.iter();
            let keeps =
                elements.map(|element| element.weight / (1.0 + 0.5 * element.rate * length));
            let response = self.contact.equilibrium + keeps.sum::<f64>();
            SlowForce::new(radiation, self.interpolation, length, state.slow_force, response)
        });
        let mut kernel = Kernel { force: Fading::NONE, creep: none, creep_decay: none, radiation };
        for (element, memory) in self.contact.elements.iter().zip(&state.memory) {
            let z = element.rate * length;
            let decay = POINTS.map(|theta| exp(-z * theta));
            let weights = POINTS.map(|theta| self.interpolation.weights(&fading_moments(theta, z)));
            let add = |fading: &mut Fading, factor: f64| {
                fading.instantaneous += factor;
                for i in 0..N {
                    for kind in [FORCE, SURFACE, PRESSURE] {
                        fading.faded[kind][i] += factor * decay[i] * memory[kind];
                    }
                    for j in 0..N {
                        fading.weights[i][j] += length * factor * weights[i][j];
                    }
                }
            };
            add(&mut kernel.force, element.weight);
            for (part, factor) in [element.correction.alpha, element.correction.beta]
                .into_iter()
                .enumerate()
                .filter(|(_, factor)| *factor != 0.0)
            {
                add(&mut kernel.creep[part], factor);
                add(&mut kernel.creep_decay[part], factor * element.rate);
            }
        }
        kernel
    }

    /// Returns the elastic part and the internal variables of one drive, at the points.
    fn remembered(
        &self,
        kernel: &Kernel,
        kind: usize,
        elastic: &Vector,
        drives: &[Vector; 3],
    ) -> Vector {
        std::array::from_fn(|i| {
            kernel.force.at(kind, drives, i, self.contact.equilibrium * elastic[i])
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
            gravity: self.contact.gravity,
            memory: state.memory.clone(),
            force: self.interpolation.coefficients(force),
            slow_force: state.slow_force,
            drives: drives.map(|drive| self.interpolation.coefficients(&drive)),
        };
        // d√u is singular at first touch; its integral over the step is known all the same.
        let end = step.memories(self.contact, 1.0);
        let hertz = self.contact.hertz_approach(step.contact_approach_at(self.contact, 1.0), &end);
        let gained = hertz.sqrt() - self.contact.hertz_approach_of(state).sqrt();
        let drive = &mut step.drives[PRESSURE];
        drive[0] += gained / length - dot(drive, &integral_moments(1.0));
        step
    }
}
