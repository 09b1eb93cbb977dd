//! The displacement of the bodies around the springs: their finite size.

use fem_material::RelaxationStep;

use crate::finite_size::FiniteSize;
use crate::pair_relaxation::PairRelaxation;

/// m∞ w + Σ m_k M_k of the pseudo-force w ([`FiniteSize`]), with the coefficient at the largest contact radius.
pub(super) struct FarField {
    /// m∞ + Σ m_k, m/N.
    compliance: f64,
    terms: Vec<Term>,
    /// Force of the springs, N.
    force: f64,
}

struct Term {
    /// Compliance m_k, m/N.
    compliance: f64,
    step: RelaxationStep,
    /// Fading memory M_k, N.
    memory: f64,
}

impl FarField {
    /// Creates the far field of half-spaces, which is none, or of bodies of a finite size.
    pub fn new(
        size: Option<&FiniteSize>,
        relaxation: &PairRelaxation,
        widest: f64,
        time_step: f64,
    ) -> Self {
        let Some(size) = size else {
            return Self { compliance: 0.0, terms: Vec::new(), force: 0.0 };
        };
        let correction = size.correction(1.0, 1.0, widest, relaxation);
        let terms = relaxation.terms().iter().zip(&correction.fading);
        let terms: Vec<_> = terms
            .map(|(term, correction)| {
                let compliance = correction.alpha;
                let step = RelaxationStep::new(term.relaxation_time, time_step);
                Term { compliance, step, memory: 0.0 }
            })
            .collect();
        let compliance = correction.equilibrium.alpha;
        Self { compliance, terms, force: 0.0 }
    }

    /// Returns the displacement in a step per change of the pseudo-force, m/N.
    pub fn slope(&self) -> f64 {
        self.compliance
            + self.terms.iter().map(|term| term.compliance * term.step.gain).sum::<f64>()
    }

    /// Returns the displacement in a step in which the pseudo-force changes, m.
    pub fn change(&self, pseudo_force: f64) -> f64 {
        let creep = |term: &Term| term.compliance * (term.step.decay - 1.0) * term.memory;
        self.slope() * pseudo_force + self.terms.iter().map(creep).sum::<f64>()
    }

    /// Advances by a step in which the pseudo-force changes, to a force (N). Returns the energy held at its end and that lost in it, J:
    /// the work that is not held.
    pub fn advance(&mut self, pseudo_force: f64, force: f64) -> [f64; 2] {
        let whole = self.compliance + self.terms.iter().map(|term| term.compliance).sum::<f64>();
        let [before, after] = [self.force, force].map(|force| 0.5 * whole * force * force);
        let work = 0.5 * (self.force + force) * self.change(pseudo_force);
        for term in &mut self.terms {
            term.memory = term.step.advance(term.memory, pseudo_force);
        }
        self.force = force;
        [after, work - (after - before)]
    }
}
