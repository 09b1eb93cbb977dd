//! Relaxing elements at finite strain: Maxwell branches of the law at the mean deformation ([`Viscoelastic`]), and of the
//! hourglass shape ([`hourglass`](super::hourglass)).
//!
//! Internal variables follow the deformation from the start of a step to its end. One loop over the elements takes them to
//! the end of the step and computes the forces there, since both need the same deformation. The forces are kept until the
//! next step asks for them ([`FiniteStrain`](super::FiniteStrain)).

use std::borrow::Cow;
use std::fmt;

use fem_collision::Account;
use fem_material::finite::{
    AxisymmetricTensor, Hyperelastic, HyperelasticLaw, InverseMetric, Inverted, Shape,
    SymmetricTensor, Viscoelastic, ViscousStep, ViscousStrain,
};
use fem_material::{PronySeries, RelaxationStep};

use super::ElementResponse;
use super::block::{Blocks, Slots};
use super::hourglass::{Amplitudes, Deformed};
use super::internal_variables::{self, InternalVariables, MAX_FINITE_STRAIN_TERMS};
use super::kernel::{self, Advanced, BlockResponse, BlockStress, Deformation, Volumes};
use super::law::{Law, RelaxingLaw};
use crate::lanes::{LaneKernel, Lanes, WIDE, run_wide_lanes};
use crate::part::{Accounts, Field, NodalField};
use crate::time::step_levels;

/// A relaxing law for the loops, and the same law by its name.
pub(super) struct RelaxingResponse {
    law: RelaxingLaw,
    solid: Viscoelastic,
    relaxation_times: Vec<f64>,
    /// Coefficients of all time steps that a run may take.
    steps: Vec<Step>,
}

/// Coefficients of a time step, for all terms.
#[derive(Debug, Clone)]
pub(super) struct Step {
    /// The step, s.
    time_step: f64,
    law: ViscousStep,
    amplitudes: Vec<RelaxationStep>,
}

impl Step {
    /// Takes a solid, its relaxation times (s) and a time step, s.
    pub fn of(solid: &Viscoelastic, relaxation_times: &[f64], time_step: f64) -> Self {
        let of = |&time: &f64| RelaxationStep::new(time, time_step);
        let amplitudes = relaxation_times.iter().map(of).collect();
        Self { time_step, law: solid.step(time_step), amplitudes }
    }
}

impl RelaxingResponse {
    /// Takes the instantaneous solid and its series.
    pub fn new(instantaneous: &Hyperelastic, series: &PronySeries) -> Self {
        let solid = Viscoelastic::new(instantaneous, series);
        let law = RelaxingLaw::of(&solid, instantaneous.shear_modulus(), series);
        let relaxation_times = series.terms().iter().map(|term| term.relaxation_time).collect();
        Self { law, solid, relaxation_times, steps: Vec::new() }
    }

    fn step(&self, time_step: f64) -> Step {
        Step::of(&self.solid, &self.relaxation_times, time_step)
    }
}

impl fmt::Debug for RelaxingResponse {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "RelaxingResponse {{ {:?} }}", self.solid)
    }
}

impl ElementResponse for RelaxingResponse {
    type Law = RelaxingLaw;

    fn law(&self) -> &RelaxingLaw {
        &self.law
    }

    fn law_name(&self) -> HyperelasticLaw {
        self.solid.law()
    }

    fn n_internal_fields(&self) -> usize {
        internal_variables::n_element_fields(self.solid.n_terms())
    }

    fn set_time_step(&mut self, time_step: f64) {
        self.steps = step_levels(time_step).map(|time_step| self.step(time_step)).collect();
    }

    fn cauchy(
        &self,
        h: &AxisymmetricTensor,
        element: (Slots, usize),
        history: &[NodalField],
    ) -> Result<SymmetricTensor, Inverted> {
        let n_terms = self.solid.n_terms();
        let (strains, _) = internal_variables::of_element(history, n_terms, element);
        self.solid.cauchy(h, &strains[..n_terms])
    }

    fn update_forces(
        &self,
        blocks: &Blocks,
        time_step: Option<f64>,
        u: &Field,
        internal: &mut [NodalField],
        forces: &mut Field,
    ) -> bool {
        let of = |time_step: f64| {
            let same = |step: &&Step| step.time_step == time_step;
            match self.steps.iter().find(same) {
                Some(step) => Cow::Borrowed(step),
                None => Cow::Owned(self.step(time_step)),
            }
        };
        let step = time_step.map(of);
        let (law, step) = (&self.law, step.as_deref());
        let mut advanced = Advanced { internal, forces, is_valid: true };
        run_wide_lanes(Advance { blocks, law, step, u }, &mut advanced);
        advanced.is_valid
    }

    fn add_energies(
        &self,
        blocks: &Blocks,
        u: &Field,
        history: &[NodalField],
        accounts: &mut Accounts,
    ) {
        let mut sums = (0.0, 0.0);
        run_wide_lanes(Energies { blocks, strain: self, u, history }, &mut sums);
        accounts.energies.add(Account::Strain, sums.0);
        accounts.powers.add(Account::ViscousDissipation, sums.1);
    }
}

/// The element loop of stored energy (J) and dissipated power, W; not numbers where an element has collapsed.
struct Energies<'a> {
    blocks: &'a Blocks,
    strain: &'a RelaxingResponse,
    u: &'a Field,
    history: &'a [NodalField],
}

impl LaneKernel<WIDE> for Energies<'_> {
    type Output = (f64, f64);

    #[inline(always)]
    fn on<L: Lanes<WIDE>>(self, sums: &mut (f64, f64)) {
        let Self { blocks, strain: RelaxingResponse { law, solid, relaxation_times, .. }, .. } =
            self;
        let (weights, n_terms) = (law.weights(), solid.n_terms());
        assert!(internal_variables::has_fields(self.history, law.n_fields(), blocks.n_elements()));
        let zero = L::splat(0.0);
        let none = ViscousStrain { rr: zero, yy: zero, ry: zero, volume_change: zero };
        let mut strains = [none; MAX_FINITE_STRAIN_TERMS];
        let (mut stored, mut power, mut volumes) = (zero, zero, Volumes::<L>::new());
        for (place, block) in blocks.checked(&[self.u.len()]).iter().enumerate() {
            let slots = blocks.slots(place);
            // SAFETY: the field has been checked against the corner numbers.
            let strain = unsafe { Deformation::<L>::gather(block, self.u) };
            volumes.observe(strain.h.volume_change(), strain.h.tt);
            let deformed = strain.deformed(block, law.shear());
            let own = deformed.pull_back(strain.q);
            let mut all = Amplitudes::new(own, law.equilibrium_weight());
            for term in 0..n_terms {
                let (strain, flown) = internal_variables::load_term(self.history, term, slots);
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
        *sums = volumes.checked_sums(stored, power);
    }
}

/// The element loop over a step with a displacement at its end; without a step the deformation is instantaneous.
#[derive(Clone, Copy)]
pub(super) struct Advance<'a> {
    pub blocks: &'a Blocks,
    pub law: &'a RelaxingLaw,
    pub step: Option<&'a Step>,
    pub u: &'a Field,
}

impl<'a> LaneKernel<WIDE> for Advance<'a> {
    type Output = Advanced<'a>;

    #[inline(always)]
    fn on<L: Lanes<WIDE>>(self, advanced: &mut Advanced<'a>) {
        // The internal variables of one term stay in registers.
        match self.law.weights().len() {
            ..=1 => self.of_terms::<L, 1>(advanced),
            _ => self.of_terms::<L, MAX_FINITE_STRAIN_TERMS>(advanced),
        }
    }
}

impl Advance<'_> {
    /// The loop for up to `MOST` terms; its result does not depend on `MOST`.
    #[inline(always)]
    pub fn of_terms<L: Lanes<WIDE>, const MOST: usize>(self, advanced: &mut Advanced<'_>) {
        let Self { blocks, law, step, u } = self;
        let Advanced { internal: fields, forces, is_valid } = advanced;
        let n_terms = law.weights().len();
        let n_fields = internal_variables::n_element_fields(n_terms);
        assert!(
            n_terms <= MOST
                && internal_variables::has_fields(fields, n_fields, blocks.n_elements())
        );
        let internal = InternalVariables::<L, MOST>::none();
        let mut response = Relaxing { blocks, law, step, fields, internal };
        *is_valid = kernel::subtract_forces::<L, _>(blocks, law.shear(), u, forces, &mut response);
    }
}

/// The relaxing response of blocks: internal variables advance to the deformation, and the stress follows from both.
struct Relaxing<'a, L, const MOST: usize> {
    blocks: &'a Blocks,
    law: &'a RelaxingLaw,
    step: Option<&'a Step>,
    fields: &'a mut [NodalField],
    internal: InternalVariables<L, MOST>,
}

impl<L: Lanes<WIDE>, const MOST: usize> BlockResponse<L> for Relaxing<'_, L, MOST> {
    #[inline(always)]
    fn stress(
        &mut self,
        place: usize,
        deformation: &Deformation<L>,
        _: &Deformed<L>,
        pulled_back: (L, L),
    ) -> BlockStress<L> {
        let Self { blocks, law, step, fields, internal } = self;
        let (slots, n_terms) = (blocks.slots(place), law.weights().len());
        let after = (Shape::of(&deformation.h), pulled_back);
        if let Some(step) = step {
            let (whole, amplitude) = internal_variables::load_term(fields, n_terms, slots);
            let before = (Shape::of_remembered(&whole), amplitude);
            for term in 0..n_terms {
                let (strain, amplitude) = internal_variables::load_term(fields, term, slots);
                let (strain, metric, amplitude) =
                    step.advance_term(term, &before, &after, strain, amplitude);
                internal_variables::store_term(fields, term, slots, &strain, amplitude);
                (internal.metrics[term], internal.amplitudes[term]) = (metric, amplitude);
            }
        } else {
            internal.load(n_terms, fields, slots);
        }
        let (whole, amplitude) = (after.0.remembered(), after.1);
        internal_variables::store_term(fields, n_terms, slots, &whole, amplitude);
        law.stress_of(&deformation.h, pulled_back, internal)
    }
}

impl Step {
    /// Returns the internal variables of a term after a step between two shapes and pulled-back amplitudes, and its metric,
    /// from which the stress follows.
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
