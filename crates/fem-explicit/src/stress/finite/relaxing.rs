//! Elements at finite strain that relax: the law's Maxwell branches at their mean deformation
//! ([`Viscoelastic`]), and those of the hourglass shape ([`hourglass`](super::hourglass)).
//!
//! The past of an element moves with the deformation from the start of a step to its end; that at the
//! start is remembered. One loop over the elements takes their past to the end of a step and makes the
//! forces there, which the start of the next step asks for: what both need of a deformation is had once.

use std::borrow::Cow;
use std::fmt;

use fem_material::finite::{
    AxisymmetricTensor, Hyperelastic, HyperelasticLaw, InverseMetric, Inverted, Shape,
    SymmetricTensor, Viscoelastic, ViscousStep, ViscousStrain,
};
use fem_material::{PronySeries, RelaxationStep};

use super::super::lanes::{LaneKernel, Lanes, WIDE, run_wide_lanes};
use super::super::port::Stress;
use super::block::{Blocks, Slots};
use super::bound::Metrics;
use super::hourglass::Amplitudes;
use super::kernel::{Strain, Volumes};
use super::law::{Law, Relaxing};
use super::past::{self, MOST_FINITE_STRAIN_TERMS, Past};
use super::{FiniteStrain, Response};
use crate::pace;
use crate::part::{Field, NodalField};

/// A law that relaxes, and the same by its name.
struct RelaxingStrain {
    law: Relaxing,
    solid: Viscoelastic,
    relaxation_times: Vec<f64>,
    /// Of all steps that a run may take.
    steps: Vec<Step>,
}

/// A time step of all terms.
#[derive(Debug, Clone)]
pub(super) struct Step {
    /// s.
    time_step: f64,
    law: ViscousStep,
    amplitudes: Vec<RelaxationStep>,
}

impl Step {
    /// Of a solid with these relaxation times, s.
    pub fn of(solid: &Viscoelastic, relaxation_times: &[f64], time_step: f64) -> Self {
        let of = |&time: &f64| RelaxationStep::new(time, time_step);
        let amplitudes = relaxation_times.iter().map(of).collect();
        Self { time_step, law: solid.step(time_step), amplitudes }
    }
}

/// The stress of a solid that relaxes as a series says.
pub(super) fn relaxing_strain(
    blocks: Blocks,
    metrics: Metrics,
    instantaneous: &Hyperelastic,
    series: &PronySeries,
) -> Box<dyn Stress> {
    let solid = Viscoelastic::new(instantaneous, series);
    let shear = instantaneous.shear_modulus();
    let law = Relaxing::of(&solid, shear, series);
    Box::new(FiniteStrain { blocks, metrics, response: RelaxingStrain::new(law, solid, series) })
}

impl RelaxingStrain {
    fn new(law: Relaxing, solid: Viscoelastic, series: &PronySeries) -> Self {
        let relaxation_times = series.terms().iter().map(|term| term.relaxation_time).collect();
        Self { law, solid, relaxation_times, steps: Vec::new() }
    }

    fn step(&self, time_step: f64) -> Step {
        Step::of(&self.solid, &self.relaxation_times, time_step)
    }
}

impl fmt::Debug for RelaxingStrain {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "RelaxingStrain {{ {:?} }}", self.solid)
    }
}

impl Response for RelaxingStrain {
    type Law = Relaxing;

    fn law(&self) -> &Relaxing {
        &self.law
    }

    fn law_name(&self) -> HyperelasticLaw {
        self.solid.law()
    }

    /// Of the nodes the internal forces.
    fn n_history(&self) -> [usize; 2] {
        [past::n_element_fields(self.solid.n_terms()), 1]
    }

    fn set_time_step(&mut self, time_step: f64) {
        self.steps = pace::time_steps(time_step).map(|time_step| self.step(time_step)).collect();
    }

    fn subtract_forces(
        &self,
        blocks: &Blocks,
        _: &Field,
        history: &[NodalField],
        forces: &mut Field,
    ) -> bool {
        // Made by the last step; no numbers where an element has collapsed in it.
        let [n_element_fields, _] = self.n_history();
        let own = &history[n_element_fields][blocks.nodes()];
        if own.first().is_some_and(|force| force[0].is_nan()) {
            return false;
        }
        let forces = forces[blocks.nodes()].as_flattened_mut();
        for (force, own) in forces.iter_mut().zip(own.as_flattened()) {
            *force += own;
        }
        true
    }

    fn cauchy(
        &self,
        h: &AxisymmetricTensor,
        element: (Slots, usize),
        history: &[NodalField],
    ) -> Result<SymmetricTensor, Inverted> {
        let n_terms = self.solid.n_terms();
        let (strains, _) = past::of_element(history, n_terms, element);
        self.solid.cauchy(h, &strains[..n_terms])
    }

    fn advance(
        &self,
        blocks: &Blocks,
        time_step: Option<f64>,
        u: &Field,
        history: &mut [NodalField],
    ) {
        let of = |time_step: f64| {
            let same = |step: &&Step| step.time_step == time_step;
            match self.steps.iter().find(same) {
                Some(step) => Cow::Borrowed(step),
                None => Cow::Owned(self.step(time_step)),
            }
        };
        let step = time_step.map(of);
        let (law, step) = (&self.law, step.as_deref());
        let (of_elements, forces) = history.split_at_mut(self.n_history()[0]);
        let Some(forces) = forces.first_mut() else { return };
        run_wide_lanes(Advance { blocks, law, step, u }, &mut Advanced { of_elements, forces });
    }

    fn energies(&self, blocks: &Blocks, u: &Field, history: &[NodalField]) -> (f64, f64) {
        let mut sums = (0.0, 0.0);
        run_wide_lanes(Energies { blocks, strain: self, u, history }, &mut sums);
        sums
    }
}

/// What all elements store (J) and dissipate, W; no numbers where one has collapsed.
struct Energies<'a> {
    blocks: &'a Blocks,
    strain: &'a RelaxingStrain,
    u: &'a Field,
    history: &'a [NodalField],
}

impl LaneKernel<WIDE> for Energies<'_> {
    type Output = (f64, f64);

    #[inline(always)]
    fn on<L: Lanes<WIDE>>(self, sums: &mut (f64, f64)) {
        let Self { blocks, strain: RelaxingStrain { law, solid, relaxation_times, .. }, .. } = self;
        let (weights, n_terms) = (law.weights(), solid.n_terms());
        assert!(past::is_sound(self.history, n_terms, blocks.n_elements()));
        let zero = L::splat(0.0);
        let none = ViscousStrain { rr: zero, yy: zero, ry: zero, volume_change: zero };
        let mut strains = [none; MOST_FINITE_STRAIN_TERMS];
        let (mut stored, mut power, mut volumes) = (zero, zero, Volumes::<L>::new());
        for (place, block) in blocks.checked(&[self.u.len()]).iter().enumerate() {
            let slots = blocks.slots(place);
            // SAFETY: the field has been checked against the corner numbers.
            let strain = unsafe { Strain::<L>::gather(block, self.u) };
            volumes.observe(strain.h.volume_change(), strain.h.tt);
            let deformed = strain.deformed(block, law);
            let own = deformed.pull(strain.q);
            let mut all = Amplitudes::new(own, law.equilibrium_weight());
            for term in 0..n_terms {
                let (strain, flown) = past::load_term(self.history, term, slots);
                strains[term] = strain;
                all.add_term(weights[term], flown);
                let elastic = deformed.energy_of((own.0 - flown.0, own.1 - flown.1));
                let rate = 2.0 * weights[term] / relaxation_times[term];
                power = power.plus_product(L::splat(rate), elastic);
            }
            let (energy, rate) = solid.energy_and_dissipation_rate(&strain.h, &strains[..n_terms]);
            let volume = L::load(&block.volume);
            stored = (stored + deformed.energy(&all)).plus_product(volume, energy);
            power = power.plus_product(volume, rate);
        }
        let (stored, power): ([f64; WIDE], [f64; WIDE]) = (stored.to_array(), power.to_array());
        *sums = match volumes.are_sound() {
            true => (stored.iter().sum(), power.iter().sum()),
            false => (f64::NAN, f64::NAN),
        };
    }
}

/// The past of all elements over a step, or of none, whose displacement is given at its end.
pub(super) struct Advance<'a, W> {
    pub blocks: &'a Blocks,
    pub law: &'a W,
    pub step: Option<&'a Step>,
    pub u: &'a Field,
}

impl<W> Clone for Advance<'_, W> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<W> Copy for Advance<'_, W> {}

/// What that changes: the fields of the elements, and the forces on the nodes.
pub(super) struct Advanced<'a> {
    pub of_elements: &'a mut [NodalField],
    pub forces: &'a mut Field,
}

impl<'a, W: Law> LaneKernel<WIDE> for Advance<'a, W> {
    type Output = Advanced<'a>;

    #[inline(always)]
    fn on<L: Lanes<WIDE>>(self, advanced: &mut Advanced<'a>) {
        // What one term remembers stays in registers.
        match self.law.weights().len() {
            ..=1 => self.of_terms::<L, 1>(advanced),
            _ => self.of_terms::<L, MOST_FINITE_STRAIN_TERMS>(advanced),
        }
    }
}

impl<W: Law> Advance<'_, W> {
    /// The loop for up to `MOST` terms; the same bits whatever that is.
    #[inline(always)]
    pub fn of_terms<L: Lanes<WIDE>, const MOST: usize>(
        self,
        Advanced { of_elements, forces }: &mut Advanced<'_>,
    ) {
        let Self { blocks, law, step, u } = self;
        let n_terms = law.weights().len();
        assert!(n_terms <= MOST && past::is_sound(of_elements, n_terms + 1, blocks.n_elements()));
        // Elsewhere they are always zero.
        forces[blocks.nodes()].fill([0.0; 2]);
        let mut past = Past::<L, MOST>::none();
        let mut volumes = Volumes::<L>::new();
        for (place, block) in blocks.checked(&[u.len(), forces.len()]).iter().enumerate() {
            let slots = blocks.slots(place);
            // SAFETY: the fields have been checked against the corner numbers.
            let strain = unsafe { Strain::<L>::gather(block, u) };
            let deformed = strain.deformed(block, law);
            let after = (Shape::of(&strain.h), deformed.pull(strain.q));
            if let Some(step) = step {
                let (whole, amplitude) = past::load_term(of_elements, n_terms, slots);
                let before = (Shape::of_remembered(&whole), amplitude);
                for term in 0..n_terms {
                    let (strain, amplitude) = past::load_term(of_elements, term, slots);
                    let (strain, metric, amplitude) =
                        step.advance_term(term, &before, &after, strain, amplitude);
                    past::store_term(of_elements, term, slots, &strain, amplitude);
                    (past.metrics[term], past.amplitudes[term]) = (metric, amplitude);
                }
            } else {
                past.load(n_terms, of_elements, slots);
            }
            past::store_term(of_elements, n_terms, slots, &after.0.remembered(), after.1);
            let (conjugate, volume_change) =
                strain.conjugate_of(&deformed, after.1, block, law, &past);
            volumes.observe(volume_change, strain.h.tt);
            // SAFETY: as above.
            unsafe { conjugate.scatter_subtract(block, forces) };
        }
        if !volumes.are_sound() {
            forces[blocks.nodes()].fill([f64::NAN; 2]);
        }
    }
}

impl Step {
    /// What a term remembers after a step between two shapes and amplitudes in the undeformed element, and
    /// what stress asks of it.
    #[inline(always)]
    fn advance_term<L: Lanes<WIDE>>(
        &self,
        term: usize,
        (before, first): &(Shape<L>, (L, L)),
        (after, last): &(Shape<L>, (L, L)),
        mut strain: ViscousStrain<L>,
        flown: (L, L),
    ) -> (ViscousStrain<L>, InverseMetric<L>, (L, L)) {
        let metric = self.law.advance_term(term, before, after, &mut strain);
        let RelaxationStep { decay, gain } = self.amplitudes[term];
        let (decay, gain) = (L::splat(decay), L::splat(gain));
        let amplitude = (
            last.0.minus_product(decay, first.0 - flown.0).minus_product(gain, last.0 - first.0),
            last.1.minus_product(decay, first.1 - flown.1).minus_product(gain, last.1 - first.1),
        );
        (strain, metric, amplitude)
    }
}
