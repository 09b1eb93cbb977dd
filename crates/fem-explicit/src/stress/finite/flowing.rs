//! Elastic–plastic elements at finite strain: the return map of [`ElasticPlastic`] at the mean deformation, and a flow of
//! the hourglass shape.
//!
//! The elastic hourglass amplitude is scaled as the return map scales the deviator of the stress: an element that flows
//! cannot store more energy in its hourglass shape than in its mean shape. The energy that it loses is plastic work:
//! the force at the end of the step times the amplitude that flows.
//!
//! As with relaxation one loop takes the internal variables to the end of a step and computes the forces there. Fields of
//! history, one pair per element:
//!
//! ```text
//! 0    radial and axial component of C_p − 1
//! 1    shear component of C_p − 1, and equivalent plastic strain
//! 2    plastic amplitude of the hourglass shape, in the undeformed element, m
//! 3    plastic work per undeformed volume at the mean deformation, J/m³, and that of the hourglass shape, J
//! 4    nodal: internal forces at that deformation, N
//! ```

use fem_collision::Account;
use fem_material::finite::{
    AxisymmetricTensor, ElasticPlastic, HyperelasticLaw, Inverted, PlasticState, SymmetricTensor,
    ViscousStrain,
};
use fem_material::{ElasticModuli, FlowRule};

use super::ElementResponse;
use super::block::{Blocks, Slots};
use super::hourglass::{Amplitudes, Deformed};
use super::internal_variables;
use super::kernel::{self, Advanced, BlockResponse, BlockStress, Deformation, Volumes};
use super::law::Law;
use crate::lanes::{LaneKernel, Lanes, WIDE, run_wide_lanes};
use crate::part::{Accounts, Field, NodalField};

/// Number of fields of internal variables of the elements.
const N_FIELDS: usize = 4;

/// The response of elastic–plastic elements.
#[derive(Debug)]
pub(super) struct FlowingResponse {
    law: FlowingLaw,
}

/// An elastic–plastic law for the loops.
#[derive(Debug)]
pub(super) struct FlowingLaw {
    solid: ElasticPlastic,
}

/// Internal variables of the elements of a block.
pub(super) struct FlowingElements<L> {
    state: PlasticState<L>,
    /// Plastic amplitude of the hourglass shape, m.
    amplitude: (L, L),
    /// Plastic work of the hourglass shape, J.
    hourglass_work: L,
}

impl<L: Lanes<WIDE>> FlowingElements<L> {
    #[inline(always)]
    fn load(history: &[NodalField], slots: Slots) -> Self {
        let (rr, yy) = slots.load(&history[0]);
        let (ry, plastic_strain) = slots.load(&history[1]);
        let amplitude = slots.load(&history[2]);
        let (plastic_work, hourglass_work) = slots.load(&history[3]);
        let metric = ViscousStrain { rr, yy, ry, volume_change: L::splat(0.0) };
        let state = PlasticState { metric, plastic_strain, plastic_work };
        Self { state, amplitude, hourglass_work }
    }

    #[inline(always)]
    fn store(&self, history: &mut [NodalField], slots: Slots) {
        let PlasticState { metric, plastic_strain, plastic_work } = self.state;
        slots.store(&mut history[0], metric.rr, metric.yy);
        slots.store(&mut history[1], metric.ry, plastic_strain);
        slots.store(&mut history[2], self.amplitude.0, self.amplitude.1);
        slots.store(&mut history[3], plastic_work, self.hourglass_work);
    }

    /// Scales the elastic amplitude by the part of the deviator that a return map retains.
    #[inline(always)]
    fn advance_amplitude(&mut self, retained: L, pulled_back: (L, L), deformed: &Deformed<L>) {
        let one = L::splat(1.0);
        let lost = one - retained;
        let elastic = (pulled_back.0 - self.amplitude.0, pulled_back.1 - self.amplitude.1);
        // Lanes that do not flow keep their bits.
        let flown = (
            pulled_back.0.minus_product(retained, elastic.0),
            pulled_back.1.minus_product(retained, elastic.1),
        );
        self.amplitude = (
            lost.choose_within(0.0, self.amplitude.0, flown.0),
            lost.choose_within(0.0, self.amplitude.1, flown.1),
        );
        let work = L::splat(2.0) * retained * lost * deformed.energy_of(elastic);
        self.hourglass_work = self.hourglass_work + work;
    }

    /// Returns the amplitudes for force and energy: one branch, whose flow is plastic.
    #[inline(always)]
    fn amplitudes(&self, pulled_back: (L, L)) -> Amplitudes<L> {
        let mut amplitudes = Amplitudes::new(pulled_back, 0.0);
        amplitudes.add_term(1.0, self.amplitude);
        amplitudes
    }
}

impl Law for FlowingLaw {
    type Internal<L: Lanes<WIDE>> = FlowingElements<L>;

    fn shear(&self) -> f64 {
        self.solid.shear_modulus()
    }

    fn n_fields(&self) -> usize {
        N_FIELDS
    }

    #[inline(always)]
    fn undeformed<L: Lanes<WIDE>>(&self) -> FlowingElements<L> {
        let zero = L::splat(0.0);
        let metric = ViscousStrain { rr: zero, yy: zero, ry: zero, volume_change: zero };
        let state = PlasticState { metric, plastic_strain: zero, plastic_work: zero };
        FlowingElements { state, amplitude: (zero, zero), hourglass_work: zero }
    }

    #[inline(always)]
    fn load<L: Lanes<WIDE>>(
        &self,
        internal: &mut FlowingElements<L>,
        history: &[NodalField],
        slots: Slots,
    ) {
        *internal = FlowingElements::load(history, slots);
    }

    /// Returns the stress without further flow, whose stiffness bounds that with flow.
    #[inline(always)]
    fn stress<L: Lanes<WIDE>>(
        &self,
        h: &AxisymmetricTensor<L>,
        pulled_back: (L, L),
        internal: &FlowingElements<L>,
    ) -> BlockStress<L> {
        let stress = self.solid.stress_at(h, &internal.state);
        BlockStress {
            first_piola: stress.first_piola,
            volume_change: stress.volume_change,
            amplitudes: internal.amplitudes(pulled_back),
        }
    }
}

impl FlowingResponse {
    /// Takes the moduli and the flow rule of a material.
    pub fn new(moduli: &ElasticModuli, flow: FlowRule) -> Self {
        Self { law: FlowingLaw { solid: ElasticPlastic::new(moduli, flow) } }
    }
}

impl ElementResponse for FlowingResponse {
    type Law = FlowingLaw;

    fn law(&self) -> &FlowingLaw {
        &self.law
    }

    fn law_name(&self) -> HyperelasticLaw {
        HyperelasticLaw::Hencky
    }

    fn n_internal_fields(&self) -> usize {
        N_FIELDS
    }

    fn set_time_step(&mut self, _: f64) {}

    /// An instantaneous deformation is elastic; the next step flows.
    fn update_forces(
        &self,
        blocks: &Blocks,
        time_step: Option<f64>,
        u: &Field,
        internal: &mut [NodalField],
        forces: &mut Field,
    ) -> bool {
        let mut advanced = Advanced { internal, forces, is_valid: true };
        run_wide_lanes(Advance { blocks, law: &self.law, time_step, u }, &mut advanced);
        advanced.is_valid
    }

    fn cauchy(
        &self,
        h: &AxisymmetricTensor,
        (slots, lane): (Slots, usize),
        history: &[NodalField],
    ) -> Result<SymmetricTensor, Inverted> {
        let [rr, yy] = slots.pair(lane, &history[0]);
        let [ry, plastic_strain] = slots.pair(lane, &history[1]);
        let metric = ViscousStrain { rr, yy, ry, volume_change: 0.0 };
        let state = PlasticState { metric, plastic_strain, plastic_work: 0.0 };
        self.law.solid.cauchy(h, &state)
    }

    /// The work of the hourglass shape has no place in an element, and is left out.
    fn plastic(&self, (slots, lane): (Slots, usize), history: &[NodalField]) -> Option<[f64; 2]> {
        let [_, strain] = slots.pair(lane, &history[1]);
        let [work, _] = slots.pair(lane, &history[3]);
        Some([strain, work])
    }

    fn add_energies(
        &self,
        blocks: &Blocks,
        u: &Field,
        history: &[NodalField],
        accounts: &mut Accounts,
    ) {
        let mut sums = (0.0, 0.0);
        run_wide_lanes(Energies { blocks, law: &self.law, u, history }, &mut sums);
        accounts.energies.add(Account::Strain, sums.0);
        accounts.energies.add(Account::PlasticWork, sums.1);
    }

    fn can_lose_ellipticity(&self) -> bool {
        false
    }
}

/// The element loop over a step (s) with a displacement at its end; without a step the deformation is instantaneous.
struct Advance<'a> {
    blocks: &'a Blocks,
    law: &'a FlowingLaw,
    time_step: Option<f64>,
    u: &'a Field,
}

impl<'a> LaneKernel<WIDE> for Advance<'a> {
    type Output = Advanced<'a>;

    #[inline(always)]
    fn on<L: Lanes<WIDE>>(self, advanced: &mut Advanced<'a>) {
        let Self { blocks, law, time_step, u } = self;
        let Advanced { internal, forces, is_valid } = advanced;
        assert!(internal_variables::has_fields(internal, N_FIELDS, blocks.n_elements()));
        let mut response = Flowing { blocks, law, time_step, fields: internal };
        *is_valid = kernel::subtract_forces::<L, _>(blocks, law.shear(), u, forces, &mut response);
    }
}

/// The elastic–plastic response of blocks.
struct Flowing<'a> {
    blocks: &'a Blocks,
    law: &'a FlowingLaw,
    time_step: Option<f64>,
    fields: &'a mut [NodalField],
}

impl<L: Lanes<WIDE>> BlockResponse<L> for Flowing<'_> {
    #[inline(always)]
    fn stress(
        &mut self,
        place: usize,
        deformation: &Deformation<L>,
        deformed: &Deformed<L>,
        pulled_back: (L, L),
    ) -> BlockStress<L> {
        let slots = self.blocks.slots(place);
        let mut elements = FlowingElements::<L>::load(self.fields, slots);
        let Some(time_step) = self.time_step else {
            return self.law.stress(&deformation.h, pulled_back, &elements);
        };
        let stress = self.law.solid.advance(&deformation.h, time_step, &mut elements.state);
        let lost = L::splat(1.0) - stress.retained;
        if !lost.all_within(0.0) {
            elements.advance_amplitude(stress.retained, pulled_back, deformed);
            elements.store(self.fields, slots);
        }
        BlockStress {
            first_piola: stress.first_piola,
            volume_change: stress.volume_change,
            amplitudes: elements.amplitudes(pulled_back),
        }
    }
}

/// The element loop of stored energy and plastic work, J; not numbers where an element has collapsed.
struct Energies<'a> {
    blocks: &'a Blocks,
    law: &'a FlowingLaw,
    u: &'a Field,
    history: &'a [NodalField],
}

impl LaneKernel<WIDE> for Energies<'_> {
    type Output = (f64, f64);

    #[inline(always)]
    fn on<L: Lanes<WIDE>>(self, sums: &mut (f64, f64)) {
        let Self { blocks, law, u, history } = self;
        assert!(internal_variables::has_fields(history, N_FIELDS, blocks.n_elements()));
        let zero = L::splat(0.0);
        let (mut stored, mut work, mut volumes) = (zero, zero, Volumes::<L>::new());
        for (place, block) in blocks.checked(&[u.len()]).iter().enumerate() {
            // SAFETY: the field has been checked against the corner numbers.
            let strain = unsafe { Deformation::<L>::gather(block, u) };
            volumes.observe(strain.h.volume_change(), strain.h.tt);
            let deformed = strain.deformed(block, law.shear());
            let elements = FlowingElements::<L>::load(history, blocks.slots(place));
            let shape = deformed.energy(&elements.amplitudes(deformed.pull_back(strain.q)));
            let volume = L::load(&block.volume);
            // In the order of the elastic loop, so that both have the same bits without flow.
            stored = stored + volume * law.solid.energy(&strain.h, &elements.state) + shape;
            work =
                (work + elements.hourglass_work).plus_product(volume, elements.state.plastic_work);
        }
        *sums = volumes.checked_sums(stored, work);
    }
}
