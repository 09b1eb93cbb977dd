//! The viscoelastic modes of one body in a collision.
//!
//! Each mode is a scalar spring of which the share θ relaxes,
//!
//! ```math
//! (1-\theta)\,z + \theta\,w = f = \Phi^T\mathbf p, \qquad
//! w = g_\infty z + \sum_k g_k q_k, \qquad \dot q_k + q_k/\tau_k = \dot z .
//! ```
//!
//! Over a step with a constant rate, q_k ← a_k q_k + b_k Δz exactly ([`RelaxationStep`]). So w = γ z + m with
//! γ = g∞ + Σ g_k b_k and a known m, and the mode in a step obeys κ z = f − θ m with κ = 1 − θ + θ γ.
//!
//! A mode of vibration is the same spring with a mass: z̈/ω² = f − (1−θ) z − θ w. It is integrated with
//! Newmark's formulas, γ = 1/2 and β = [`BETA`], which add 1/(β Δt² ω²) to κ.

use faer::Mat;
use fem_material::{PronySeries, RelaxationStep};

use crate::contact::disc_contact::dot;

/// Newmark's β with γ = 1/2. With 1/12 the period of a linear oscillator is exact to fourth order (Fox & Goodwin
/// 1949; Numerov), and the method is stable for ω Δt < √6.
pub(crate) const BETA: f64 = 1.0 / 12.0;

/// One Prony term at the run's time step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PronyBranch {
    weight: f64,
    relaxation_time: f64,
    step: RelaxationStep,
}

/// A relaxation function at the run's time step.
#[derive(Debug, Clone)]
pub(crate) struct ViscoelasticState {
    equilibrium: f64,
    branches: Vec<PronyBranch>,
    /// Stiffness γ within a step over the instantaneous one.
    instantaneous: f64,
}

impl ViscoelasticState {
    /// Creates the function from a Prony series and a time step, s.
    pub fn new(series: &PronySeries, time_step: f64) -> Self {
        let branches: Vec<_> = series
            .terms()
            .iter()
            .filter(|term| term.weight > 0.0)
            .map(|term| PronyBranch {
                weight: term.weight,
                relaxation_time: term.relaxation_time,
                step: RelaxationStep::new(term.relaxation_time, time_step),
            })
            .collect();
        let equilibrium = series.equilibrium_weight();
        let gained: f64 = branches.iter().map(|branch| branch.weight * branch.step.gain).sum();
        Self { equilibrium, branches, instantaneous: equilibrium + gained }
    }

    /// Returns κ for a share θ.
    pub fn spring(&self, share: f64) -> f64 {
        1.0 - share + share * self.instantaneous
    }

    /// Creates the function of an elastic body.
    pub fn elastic() -> Self {
        Self { equilibrium: 1.0, branches: Vec::new(), instantaneous: 1.0 }
    }

    pub fn n_branches(&self) -> usize {
        self.branches.len()
    }
}

/// Masses and rates of modes of vibration.
#[derive(Debug, Clone)]
struct Inertia {
    time_step: f64,
    /// Squares ω² of the angular frequencies, 1/s².
    squared_frequency: Vec<f64>,
    /// Rates ż, √J/s.
    rate: Vec<f64>,
    /// Accelerations z̈, √J/s².
    acceleration: Vec<f64>,
}

/// Viscoelastic modes with their state.
#[derive(Debug, Clone)]
pub(crate) struct ViscoelasticModes {
    memory: ViscoelasticState,
    n_modes: usize,
    /// Displacement of each point in each mode, mode by mode within a point, m/√J.
    shapes: Vec<f64>,
    /// The same, point by point within a mode.
    modes: Vec<f64>,
    /// Number of modes moved by each point and those before it; for constant Poisson's ratio Φ is triangular.
    moved_by: Vec<usize>,
    /// Number of modes that have moved, the first ones.
    n_moved: usize,
    /// Share θ of each mode.
    share: Vec<f64>,
    /// Stiffness κ of each mode.
    spring: Vec<f64>,
    /// Displacement z of each mode, √J.
    pub displacement: Vec<f64>,
    /// Internal variables q of each branch, one branch after another.
    branch: Vec<f64>,
    /// Displacement −z without forces.
    past: Vec<f64>,
    /// Weight of the modes; −1 for modes that are subtracted from a body.
    weight: f64,
    inertia: Option<Inertia>,
}

impl ViscoelasticModes {
    /// Creates modes at rest. `shapes` has one row per point and one column per mode.
    pub fn new(memory: ViscoelasticState, shapes: Mat<f64>, share: &[f64]) -> Self {
        let (n_points, n_modes) = (shapes.nrows(), shapes.ncols());
        let flat = (0..n_points)
            .flat_map(|i| (0..n_modes).map(move |j| (i, j)))
            .map(|place| shapes[place])
            .collect();
        let modes = shapes.col_iter().flat_map(|mode| mode.iter().copied()).collect();
        let mut most = 0;
        let moved_by = (0..n_points)
            .map(|i| {
                let last = (0..n_modes).rposition(|j| shapes[(i, j)] != 0.0);
                most = last.map_or(most, |j| most.max(j + 1));
                most
            })
            .collect();
        Self {
            n_modes,
            shapes: flat,
            modes,
            moved_by,
            n_moved: 0,
            share: share[..n_modes].to_vec(),
            spring: share[..n_modes].iter().map(|&share| memory.spring(share)).collect(),
            displacement: vec![0.0; n_modes],
            branch: vec![0.0; n_modes * memory.n_branches()],
            past: vec![0.0; n_modes],
            memory,
            weight: 1.0,
            inertia: None,
        }
    }

    /// Returns these modes, subtracted from the body.
    pub fn removed(self) -> Self {
        self.weighted(-1.0)
    }

    /// Returns these modes with a factor.
    pub fn weighted(self, weight: f64) -> Self {
        Self { weight, ..self }
    }

    /// Adds masses, given by ω² (1/s²) of each mode and the time step, s.
    pub fn with_inertia(mut self, squared_frequency: &[f64], time_step: f64) -> Self {
        let scale = (BETA * time_step * time_step).recip();
        for (spring, squared) in self.spring.iter_mut().zip(squared_frequency) {
            *spring += scale / squared;
        }
        self.inertia = Some(Inertia {
            time_step,
            squared_frequency: squared_frequency.to_vec(),
            rate: vec![0.0; self.n_modes],
            acceleration: vec![0.0; self.n_modes],
        });
        self
    }

    /// Returns the displacement of a point, m, without the weight.
    pub fn displacement_at(&self, point: usize) -> f64 {
        dot(self.shape(point), &self.displacement)
    }

    fn shape(&self, point: usize) -> &[f64] {
        &self.shapes[point * self.n_modes..][..self.n_modes]
    }

    /// Adds the compliance Φ κ⁻¹ Φᵀ within a step, m/N.
    pub fn add_compliance(&self, compliance: &mut Mat<f64>) {
        let n = compliance.nrows();
        let mut scaled = vec![0.0; self.n_modes];
        for i in 0..n {
            for ((scaled, shape), spring) in scaled.iter_mut().zip(self.shape(i)).zip(&self.spring)
            {
                *scaled = shape / spring;
            }
            for j in 0..=i {
                let sum = self.weight * dot(&scaled, self.shape(j));
                compliance[(i, j)] += sum;
                if i != j {
                    compliance[(j, i)] += sum;
                }
            }
        }
    }

    /// Subtracts from the overlap (m) the displacement of the modes without new forces.
    pub fn subtract_past(&mut self, overlap: &mut [f64]) {
        let n = self.n_moved;
        let past = &mut self.past[..n];
        past.fill(0.0);
        for (k, branch) in self.memory.branches.iter().enumerate() {
            let q = &self.branch[k * self.n_modes..][..n];
            for ((past, q), z) in past.iter_mut().zip(q).zip(&self.displacement) {
                *past += branch.weight * (branch.step.decay * q - branch.step.gain * z);
            }
        }
        for (past, share) in past.iter_mut().zip(&self.share) {
            *past *= share;
        }
        if let Some(inertia) = &self.inertia {
            for (j, past) in past.iter_mut().enumerate() {
                *past -= inertia.load(j, self.displacement[j]);
            }
        }
        for (past, spring) in past.iter_mut().zip(&self.spring) {
            *past /= spring;
        }
        for (past, mode) in past.iter().zip(self.modes.chunks_exact(overlap.len())) {
            let moved = self.weight * past;
            overlap.iter_mut().zip(mode).for_each(|(overlap, shape)| *overlap += moved * shape);
        }
    }

    /// Advances to the end of the step under the forces (N) at the points, after
    /// [`ViscoelasticModes::subtract_past`].
    pub fn advance(&mut self, forces: &[f64]) {
        let reached = forces.len().checked_sub(1).map_or(0, |last| self.moved_by[last]);
        self.n_moved = self.n_moved.max(reached);
        let n = self.n_moved;
        let mut moved = std::mem::take(&mut self.past);
        let load = &mut moved[..n];
        for (load, spring) in load.iter_mut().zip(&self.spring) {
            *load *= -spring;
        }
        for (point, &force) in forces.iter().enumerate() {
            if force != 0.0 {
                let shape = &self.shapes[point * self.n_modes..][..self.moved_by[point]];
                load.iter_mut().zip(shape).for_each(|(load, shape)| *load += force * shape);
            }
        }
        for (moved, spring) in load.iter_mut().zip(&self.spring) {
            *moved /= spring;
        }
        for (k, branch) in self.memory.branches.iter().enumerate() {
            let q = &mut self.branch[k * self.n_modes..][..n];
            for ((q, new), old) in q.iter_mut().zip(&moved).zip(&self.displacement) {
                *q = branch.step.advance(*q, new - old);
            }
        }
        if let Some(inertia) = &mut self.inertia {
            for j in 0..n {
                inertia.advance(j, self.displacement[j], moved[j]);
            }
        }
        self.past = std::mem::replace(&mut self.displacement, moved);
    }

    /// Returns the kinetic energy of the modes, J.
    pub fn kinetic(&self) -> f64 {
        self.inertia.as_ref().map_or(0.0, |inertia| {
            let twice: f64 = inertia
                .rate
                .iter()
                .zip(&inertia.squared_frequency)
                .map(|(rate, squared)| rate * rate / squared)
                .sum();
            0.5 * twice
        })
    }

    /// Returns w of each mode, √J.
    pub fn effective(&self) -> Vec<f64> {
        let n = self.n_modes;
        let mut w: Vec<f64> =
            self.displacement.iter().map(|z| self.memory.equilibrium * z).collect();
        for (k, branch) in self.memory.branches.iter().enumerate() {
            for (w, q) in w.iter_mut().zip(&self.branch[k * n..][..n]) {
                *w += branch.weight * q;
            }
        }
        w
    }

    /// Returns stored energy (J) and dissipated power (W), negative for subtracted modes.
    pub fn stored_and_dissipated(&self) -> (f64, f64) {
        let n = self.n_moved;
        let (mut stored, mut power) = (0.0, 0.0);
        for (z, share) in self.displacement[..n].iter().zip(&self.share) {
            stored += 0.5 * (1.0 - share + share * self.memory.equilibrium) * z * z;
        }
        for (k, branch) in self.memory.branches.iter().enumerate() {
            let q = &self.branch[k * self.n_modes..][..n];
            let energy: f64 = q.iter().zip(&self.share).map(|(q, share)| 0.5 * share * q * q).sum();
            stored += branch.weight * energy;
            power += 2.0 * branch.weight * energy / branch.relaxation_time;
        }
        (self.weight * stored, self.weight * power)
    }
}

impl Inertia {
    /// Returns Newmark's prediction of z at the end of the step.
    fn predicted(&self, j: usize, displacement: f64) -> f64 {
        let dt = self.time_step;
        displacement + dt * self.rate[j] + (0.5 - BETA) * dt * dt * self.acceleration[j]
    }

    /// Returns the load of mode j by that prediction.
    fn load(&self, j: usize, displacement: f64) -> f64 {
        let dt = self.time_step;
        self.predicted(j, displacement) / (BETA * dt * dt * self.squared_frequency[j])
    }

    fn advance(&mut self, j: usize, old: f64, new: f64) {
        let dt = self.time_step;
        let acceleration = (new - self.predicted(j, old)) / (BETA * dt * dt);
        self.rate[j] += 0.5 * dt * (self.acceleration[j] + acceleration);
        self.acceleration[j] = acceleration;
    }
}
