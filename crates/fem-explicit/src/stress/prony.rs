//! Linear viscoelasticity at small strain by a Prony series, one nodal field per term.
//!
//! ```math
//! \dot q_k + q_k/\tau_k = \dot u, \qquad w = g_\infty u + \sum_k g_k q_k
//! ```
//!
//! A branch is advanced exactly for a constant rate ([`RelaxationStep`]). The relaxing part of the stress is that of
//! the effective displacement w. [`RelaxingModuli`] defines which part relaxes:
//!
//! ```math
//! f = -(K_{bulk} + K_{shear})\, w \quad\text{(all moduli)}, \qquad
//! f = -K_{bulk}\, u - K_{shear}\, w \quad\text{(shear alone)} .
//! ```
//!
//! A branch stores ½ q·g K q and dissipates q·g K q / τ; the rest of the stiffness stores ½ u·K u.

use std::fmt::Debug;
use std::marker::PhantomData;

use fem_collision::Account;
use fem_element::{ElementMatrix, QuadGeometry, mean_gradient};
use fem_material::{PronySeries, RelaxationStep};
use multiversion::multiversion;

use super::elastic::Elastic;
use super::kernel::{
    Moduli, strain_energy, subtract_internal_forces, subtract_split_internal_forces,
};
use super::traits::{Collapse, LumpedElement, SmallStrainStress, StrainMeasure, Stress};
use crate::part::{Accounts, Field, Motion, NodalField, Part};

/// The part of the stress that relaxes.
pub(super) trait RelaxingModuli: Debug + Send + Sync + 'static {
    /// Returns the moduli that relax, from the instantaneous ones.
    fn relaxing(instantaneous: Moduli) -> Moduli;

    /// Returns the equilibrium moduli, with g∞ of those that relax.
    fn lasting(instantaneous: Moduli, equilibrium_weight: f64) -> Moduli;

    /// Subtracts the forces of a displacement u and an effective displacement w from f.
    fn subtract_forces(elastic: &Elastic, u: &Field, w: &Field, f: &mut Field);
}

/// All moduli relax alike, so that Poisson's ratio stays constant.
#[derive(Debug)]
pub(super) struct AllModuliRelax;

impl RelaxingModuli for AllModuliRelax {
    fn relaxing(instantaneous: Moduli) -> Moduli {
        instantaneous
    }

    fn lasting(Moduli { bulk, shear }: Moduli, equilibrium_weight: f64) -> Moduli {
        Moduli { bulk: equilibrium_weight * bulk, shear: equilibrium_weight * shear }
    }

    fn subtract_forces(elastic: &Elastic, _: &Field, w: &Field, f: &mut Field) {
        subtract_internal_forces(&elastic.elements, elastic.moduli, w, f);
    }
}

/// Shear relaxes; bulk is elastic.
#[derive(Debug)]
pub(super) struct ShearRelaxes;

impl RelaxingModuli for ShearRelaxes {
    fn relaxing(Moduli { shear, .. }: Moduli) -> Moduli {
        Moduli { bulk: 0.0, shear }
    }

    fn lasting(Moduli { bulk, shear }: Moduli, equilibrium_weight: f64) -> Moduli {
        Moduli { bulk, shear: equilibrium_weight * shear }
    }

    fn subtract_forces(elastic: &Elastic, u: &Field, w: &Field, f: &mut Field) {
        subtract_split_internal_forces(&elastic.elements, elastic.moduli, u, w, f);
    }
}

/// One Prony term at the model's time step.
#[derive(Debug, Clone, Copy)]
struct Branch {
    weight: f64,
    relaxation_time: f64,
    /// Factor of the branch over a step.
    decay: f64,
    /// Gain per velocity in a step, s.
    gain: f64,
    /// Gain per displacement in a step.
    share: f64,
}

impl Branch {
    /// Sets the time step, s.
    fn set_time_step(&mut self, time_step: f64) {
        let step = RelaxationStep::new(self.relaxation_time, time_step);
        self.decay = step.decay;
        self.gain = step.gain * time_step;
        self.share = step.gain;
    }

    /// Returns this branch at a step (s) that may be shorter than that of the model.
    fn at(mut self, time_step: f64, of_model: f64) -> Self {
        if time_step != of_model {
            self.set_time_step(time_step);
        }
        self
    }
}

/// The stress of a linear viscoelastic body. Its history is w, then q of each term.
#[derive(Debug)]
pub(super) struct LinearViscoelastic<R> {
    elastic: Elastic,
    equilibrium_weight: f64,
    branches: Vec<Branch>,
    /// Time step of the model, s; 0 until it is known.
    time_step: f64,
    relaxes: PhantomData<R>,
}

impl<R: RelaxingModuli> LinearViscoelastic<R> {
    /// Adds a series to an elastic body; terms without weight keep no history.
    pub fn new(elastic: Elastic, series: &PronySeries) -> Self {
        let terms = series.terms().iter().filter(|term| term.weight > 0.0);
        // Nothing relaxes until the time step is known.
        let branches = terms.map(|term| Branch {
            weight: term.weight,
            relaxation_time: term.relaxation_time,
            decay: 1.0,
            gain: 0.0,
            share: 0.0,
        });
        Self {
            elastic,
            equilibrium_weight: series.equilibrium_weight(),
            branches: branches.collect(),
            time_step: 0.0,
            relaxes: PhantomData,
        }
    }

    /// Returns the gain of the effective displacement per displacement in a step, g∞ + Σ g_k ∂q_k/∂u.
    fn weight_of_step(&self) -> f64 {
        let branches = self.branches.iter().map(|branch| branch.weight * branch.share);
        self.equilibrium_weight + branches.sum::<f64>()
    }

    /// Computes w = g∞ u + Σ g_k q_k.
    fn update_effective(&self, u: &Field, history: &mut [NodalField]) {
        let [w, branches @ ..] = history else { return };
        start_effective(self.equilibrium_weight, u, w);
        for (branch, q) in self.branches.iter().zip(branches) {
            advance_branch(1.0, 0.0, branch.weight, u, q, w);
        }
    }
}

impl<R: RelaxingModuli> Part for LinearViscoelastic<R> {
    fn n_history(&self) -> usize {
        1 + self.branches.len()
    }

    fn set_time_step(&mut self, time_step: f64) {
        self.time_step = time_step;
        self.branches.iter_mut().for_each(|branch| branch.set_time_step(time_step));
    }
}

impl<R: RelaxingModuli> Stress for LinearViscoelastic<R> {
    fn strain_measure(&self) -> StrainMeasure<'_> {
        StrainMeasure::Small(self)
    }

    fn n_element_history(&self) -> usize {
        0
    }

    fn largest_eigenvalues(&self, elements: &[LumpedElement]) -> Vec<f64> {
        self.elastic.largest_eigenvalues(elements)
    }

    /// Rigid motion strains nothing: the branches stay at zero.
    fn start_rigid(&self, displacement: &Field, history: &mut [NodalField]) {
        self.update_effective(displacement, history);
    }

    fn start_deformed(&self, displacement: &Field, history: &mut [NodalField]) {
        for q in &mut history[1..] {
            q.copy_from_slice(displacement);
        }
        self.update_effective(displacement, history);
    }

    fn subtract_forces(
        &self,
        motion: &Motion<'_>,
        history: &[NodalField],
        forces: &mut Field,
    ) -> Result<(), Collapse> {
        R::subtract_forces(&self.elastic, motion.displacement, &history[0], forces);
        Ok(())
    }

    fn advance(&self, motion: &Motion<'_>, history: &mut [NodalField]) {
        let [w, branches @ ..] = history else { return };
        start_effective(self.equilibrium_weight, motion.displacement, w);
        for (branch, q) in self.branches.iter().zip(branches) {
            let branch = branch.at(motion.time_step, self.time_step);
            advance_branch(branch.decay, branch.gain, branch.weight, motion.velocity, q, w);
        }
    }

    fn add_energies(&self, motion: &Motion<'_>, history: &[NodalField], accounts: &mut Accounts) {
        let Elastic { elements, moduli } = &self.elastic;
        let lasting = R::lasting(*moduli, self.equilibrium_weight);
        let relaxing = R::relaxing(*moduli);
        let (mut stored, mut power) = (0.0, 0.0);
        if lasting.bulk != 0.0 || lasting.shear != 0.0 {
            stored += strain_energy(elements, lasting, motion.displacement);
        }
        for (branch, q) in self.branches.iter().zip(&history[1..]) {
            let weight = branch.weight;
            let moduli = Moduli { bulk: weight * relaxing.bulk, shear: weight * relaxing.shear };
            let energy = strain_energy(elements, moduli, q);
            stored += energy;
            power += 2.0 * energy / branch.relaxation_time;
        }
        accounts.energies.add(Account::Strain, stored);
        accounts.powers.add(Account::ViscousDissipation, power);
    }
}

impl<R: RelaxingModuli> SmallStrainStress for LinearViscoelastic<R> {
    /// The moduli are those for a displacement that is added at the end of a step.
    fn stiffness_of_step(&self, geometry: &QuadGeometry) -> ElementMatrix {
        let weight = self.weight_of_step();
        let Moduli { bulk, shear } = R::lasting(self.elastic.moduli, weight);
        mean_gradient(geometry).combine(bulk, shear)
    }

    fn shift(&self, node: usize, change: [f64; 2], history: &mut [NodalField]) {
        let [w, branches @ ..] = history else { return };
        let weight = self.weight_of_step();
        for axis in 0..2 {
            w[node][axis] += weight * change[axis];
        }
        for (branch, q) in self.branches.iter().zip(branches) {
            for axis in 0..2 {
                q[node][axis] += branch.share * change[axis];
            }
        }
    }

    fn effective(&self) -> Option<usize> {
        Some(0)
    }
}

/// Starts the effective displacement: w ← g∞ u.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"))]
fn start_effective(equilibrium_weight: f64, u: &Field, w: &mut Field) {
    for (w, u) in w.as_flattened_mut().iter_mut().zip(u.as_flattened()) {
        *w = equilibrium_weight * u;
    }
}

/// Advances one branch by a step of constant rate and adds its share: q ← decay q + gain v,
/// w ← w + weight q.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"))]
fn advance_branch(decay: f64, gain: f64, weight: f64, v: &Field, q: &mut Field, w: &mut Field) {
    let (q, w) = (q.as_flattened_mut(), w.as_flattened_mut());
    for ((q, w), v) in q.iter_mut().zip(w).zip(v.as_flattened()) {
        *q = decay * *q + gain * v;
        *w += weight * *q;
    }
}
