//! Elements at finite strain that relax: the law's Maxwell branches at their mean deformation
//! ([`Viscoelastic`]), and those of the hourglass shape ([`hourglass`](super::hourglass)).
//!
//! The past of an element moves with the deformation from the start of a step to its end; that at the
//! start is remembered. One loop over the elements takes their past to the end of a step and makes the
//! forces there, which the start of the next step asks for: what both need of a deformation is had once.

use std::borrow::Cow;
use std::fmt;

use fem_collision::Account;
use fem_element::QuadGeometry;

use fem_material::finite::{Hyperelastic, Shape, Viscoelastic, ViscousStep, ViscousStrain};
use fem_material::{PronySeries, RelaxationStep};

use super::super::lanes::{LaneKernel, Lanes, WIDE, run_wide_lanes};
use super::super::port::{Collapse, Stress};
use super::block::Blocks;
use super::bound::{self, Metrics};
use super::hourglass::{Amplitudes, Deformed};
use super::kernel::{Elements, Strain, Volumes};
use super::law::{Law, Relaxing};
use super::past::{self, Past};
use crate::pace;
use crate::part::{Accounts, Field, Motion, NodalField, Part};

/// The stress of a body at finite strain that relaxes.
struct RelaxingStrain<W> {
    blocks: Blocks,
    metrics: Metrics,
    law: Relaxing<W>,
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
    match solid.neo_hooke().cloned() {
        Some(law) => {
            let law = Relaxing::of(law, shear, series);
            Box::new(RelaxingStrain::new(blocks, metrics, law, solid, series))
        }
        None => {
            let law = Relaxing::of(solid.clone(), shear, series);
            Box::new(RelaxingStrain::new(blocks, metrics, law, solid, series))
        }
    }
}

impl<W> RelaxingStrain<W> {
    fn new(
        blocks: Blocks,
        metrics: Metrics,
        law: Relaxing<W>,
        solid: Viscoelastic,
        series: &PronySeries,
    ) -> Self {
        let relaxation_times = series.terms().iter().map(|term| term.relaxation_time).collect();
        Self { blocks, metrics, law, solid, relaxation_times, steps: Vec::new() }
    }

    fn step(&self, time_step: f64) -> Step {
        Step::of(&self.solid, &self.relaxation_times, time_step)
    }
}

impl<W> RelaxingStrain<W>
where
    Relaxing<W>: Law,
{
    fn elements<'a>(&'a self, history: &'a [NodalField]) -> Elements<'a, Relaxing<W>> {
        Elements { blocks: &self.blocks, law: &self.law, history }
    }
}

/// Its law, moduli and terms; the mesh is known by other means.
impl<W> fmt::Debug for RelaxingStrain<W> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "RelaxingStrain {{ {:?} }}", self.solid)
    }
}

impl<W: 'static> Part for RelaxingStrain<W>
where
    Relaxing<W>: Law,
{
    /// The internal forces.
    fn n_history(&self) -> usize {
        1
    }

    fn set_time_step(&mut self, time_step: f64) {
        self.steps = pace::time_steps(time_step).map(|time_step| self.step(time_step)).collect();
    }
}

impl<W: 'static> Stress for RelaxingStrain<W>
where
    Relaxing<W>: Law,
{
    fn n_element_history(&self) -> usize {
        past::n_element_fields(self.solid.n_terms())
    }

    fn largest_eigenvalue(
        &self,
        geometry: &QuadGeometry,
        masses: &[f64; 4],
        on_axis: [bool; 4],
    ) -> f64 {
        bound::at_rest(&self.law, geometry, masses, on_axis)
    }

    fn subtract_forces(
        &self,
        motion: &Motion<'_>,
        history: &[NodalField],
        forces: &mut Field,
    ) -> Result<(), Collapse> {
        // Made by the last step; no numbers where an element has collapsed in it.
        let own = &history[self.n_element_history()];
        if own.first().is_some_and(|force| force[0].is_nan()) {
            return Err(self.blocks.most_compressed(motion.displacement));
        }
        for (force, own) in forces.as_flattened_mut().iter_mut().zip(own.as_flattened()) {
            *force += own;
        }
        Ok(())
    }

    fn changes_stiffness(&self) -> bool {
        true
    }

    fn add_undeformed_stiffness_bound(&self, bound: &mut [f64]) {
        let still = vec![[0.0; 2]; bound.len()];
        bound::add_stiffness(&self.elements(&[]), &self.metrics, &still, bound);
    }

    fn add_stiffness_bound(&self, motion: &Motion<'_>, history: &[NodalField], bound: &mut [f64]) {
        let elements = self.elements(history);
        bound::add_stiffness(&elements, &self.metrics, motion.displacement, bound);
    }

    fn strain_rate(&self, motion: &Motion<'_>) -> f64 {
        self.blocks.strain_rate(motion.displacement, motion.velocity)
    }

    fn most_compressed(&self, displacement: &Field) -> Option<Collapse> {
        Some(self.blocks.most_compressed(displacement))
    }

    fn update_cauchy_stress(&self, u: &Field, history: &[NodalField], stress: &mut Vec<[f64; 4]>) {
        let n_terms = self.solid.n_terms();
        stress.clear();
        stress.extend((0..self.blocks.n_elements()).map(|element| {
            let h = self.blocks.gradient(element, u);
            let (strains, _) = past::of_element(history, n_terms, self.blocks.slot(element));
            // No run goes on behind a collapse.
            let stress = self.solid.cauchy(&h, &strains[..n_terms]).ok();
            stress.map_or([f64::NAN; 4], |stress| [stress.rr, stress.yy, stress.tt, stress.ry])
        }));
    }

    fn advance(&self, motion: &Motion<'_>, history: &mut [NodalField]) {
        let same = |step: &&Step| step.time_step == motion.time_step;
        let step = match self.steps.iter().find(same) {
            Some(step) => Cow::Borrowed(step),
            None => Cow::Owned(self.step(motion.time_step)),
        };
        self.update(Some(&step), motion.displacement, history);
    }

    fn start_deformed(&self, displacement: &Field, history: &mut [NodalField]) {
        self.update(None, displacement, history);
    }

    fn add_energies(&self, motion: &Motion<'_>, history: &[NodalField], accounts: &mut Accounts) {
        let u = motion.displacement;
        let (mut stored, mut power) = (0.0, 0.0);
        for element in 0..self.blocks.n_elements() {
            let (energy, dissipated) = self.energies(element, u, history);
            stored += energy;
            power += dissipated;
        }
        accounts.energies.add(Account::Strain, stored);
        accounts.powers.add(Account::ViscousDissipation, power);
    }
}

impl<W> RelaxingStrain<W>
where
    Relaxing<W>: Law,
{
    /// Takes the history to a displacement, by a step or in no time.
    fn update(&self, step: Option<&Step>, u: &Field, history: &mut [NodalField]) {
        let Self { blocks, law, .. } = self;
        let (of_elements, forces) =
            history.split_at_mut(past::n_element_fields(self.solid.n_terms()));
        let Some(forces) = forces.first_mut() else { return };
        run_wide_lanes(Advance { blocks, law, step, u }, &mut Advanced { of_elements, forces });
    }

    /// What an element stores (J) and dissipates, W; no numbers of one that has collapsed.
    fn energies(&self, element: usize, u: &Field, history: &[NodalField]) -> (f64, f64) {
        let Self { blocks, law, solid, relaxation_times, .. } = self;
        let n_terms = solid.n_terms();
        let (strains, amplitudes) = past::of_element(history, n_terms, self.blocks.slot(element));
        let (h, strains) = (blocks.gradient(element, u), &strains[..n_terms]);
        let (volume, measures, amplitude) = blocks.shape(element, u);
        let deformed = Deformed::of(&h, law.shear(), measures);
        let own = deformed.pull(amplitude);
        let mut all = Amplitudes::new(own, law.equilibrium_weight());
        let mut power = volume * solid.dissipation_rate(&h, strains).unwrap_or(f64::NAN);
        let weights = law.weights();
        for ((&weight, time), flown) in weights.iter().zip(relaxation_times).zip(amplitudes) {
            all.add_term(weight, flown);
            let elastic = deformed.energy_of((own.0 - flown.0, own.1 - flown.1));
            power += 2.0 * weight * elastic / time;
        }
        let stored = volume * solid.energy(&h, strains).unwrap_or(f64::NAN);
        (stored + deformed.energy(&all), power)
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
    fn on<L: Lanes<WIDE>>(self, Advanced { of_elements, forces }: &mut Advanced<'a>) {
        let Self { blocks, law, step, u } = self;
        let n_terms = law.weights().len();
        assert!(past::is_sound(of_elements, n_terms + 1, blocks.n_elements()));
        forces.fill([0.0; 2]);
        let mut past = Past::<L>::none();
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
                    let (strain, amplitude) =
                        step.advance_term(term, &before, &after, strain, amplitude);
                    past::store_term(of_elements, term, slots, &strain, amplitude);
                    (past.strains[term], past.amplitudes[term]) = (strain, amplitude);
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
            forces.fill([f64::NAN; 2]);
        }
    }
}

impl Step {
    /// What a term remembers after a step between two shapes and amplitudes in the undeformed element.
    #[inline(always)]
    fn advance_term<L: Lanes<WIDE>>(
        &self,
        term: usize,
        (before, first): &(Shape<L>, (L, L)),
        (after, last): &(Shape<L>, (L, L)),
        mut strain: ViscousStrain<L>,
        flown: (L, L),
    ) -> (ViscousStrain<L>, (L, L)) {
        self.law.advance_term(term, before, after, &mut strain);
        let RelaxationStep { decay, gain } = self.amplitudes[term];
        let (decay, gain) = (L::splat(decay), L::splat(gain));
        let amplitude = (
            last.0 - (decay * (first.0 - flown.0) + gain * (last.0 - first.0)),
            last.1 - (decay * (first.1 - flown.1) + gain * (last.1 - first.1)),
        );
        (strain, amplitude)
    }
}
