//! Elements at finite strain that relax: the law's Maxwell branches at their mean deformation
//! ([`Viscoelastic`]), and those of the hourglass shape ([`hourglass`](super::hourglass)).
//!
//! The past of an element moves with the deformation from the start of a step to its end; that at the
//! start is the one at the end less what the velocity did.

use std::borrow::Cow;
use std::fmt;

use fem_collision::Account;
use fem_element::QuadGeometry;

use fem_material::finite::{AxisymmetricTensor, Hyperelastic, Viscoelastic, ViscousStep};
use fem_material::{PronySeries, RelaxationStep};

use super::super::lanes::{LaneKernel, Lanes, run_lanes};
use super::super::port::{Collapse, Stress};
use super::block::Blocks;
use super::bound::{self, Metrics};
use super::hourglass::{Amplitudes, Deformed, pulled_back};
use super::kernel::{Elements, Strain};
use super::law::{Law, Relaxing};
use super::past::{self, FIELDS_A_TERM, Past};
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
    fn set_time_step(&mut self, time_step: f64) {
        self.steps = pace::time_steps(time_step).map(|time_step| self.step(time_step)).collect();
    }
}

impl<W: 'static> Stress for RelaxingStrain<W>
where
    Relaxing<W>: Law,
{
    fn n_element_history(&self) -> usize {
        FIELDS_A_TERM * self.solid.n_terms()
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
        let is_sound = self.elements(history).subtract_forces(motion.displacement, forces);
        if is_sound { Ok(()) } else { Err(self.blocks.most_compressed(motion.displacement)) }
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
            let (strains, _) = past::of_element(history, n_terms, element);
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
        run_lanes(Advance { blocks: &self.blocks, step: &step, motion }, history);
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
    /// What an element stores (J) and dissipates, W; no numbers of one that has collapsed.
    fn energies(&self, element: usize, u: &Field, history: &[NodalField]) -> (f64, f64) {
        let Self { blocks, law, solid, relaxation_times, .. } = self;
        let n_terms = solid.n_terms();
        let (strains, amplitudes) = past::of_element(history, n_terms, element);
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

/// The past of all elements over a step, whose motion is given at its end.
pub(super) struct Advance<'a> {
    pub blocks: &'a Blocks,
    pub step: &'a Step,
    pub motion: &'a Motion<'a>,
}

impl LaneKernel for Advance<'_> {
    type Output = [NodalField];

    #[inline(always)]
    fn on<L: Lanes>(self, history: &mut [NodalField]) {
        let Self { blocks, step, motion: Motion { displacement: u, velocity: v, .. } } = self;
        let n_terms = step.amplitudes.len();
        assert!(past::is_sound(history, n_terms, blocks.n_elements()));
        let mut past = Past::<L>::none();
        for (place, block) in blocks.checked(&[u.len(), v.len()]).iter().enumerate() {
            let (elements, n_lanes) = blocks.elements(place);
            past.load(n_terms, history, &elements);
            // SAFETY: the fields have been checked against the corner numbers.
            let (after, rate) =
                unsafe { (Strain::<L>::gather(block, u), Strain::<L>::gather(block, v)) };
            past.advance(step, &before(&after, &rate, L::splat(step.time_step)), &after);
            past.store(n_terms, history, &elements, n_lanes);
        }
    }
}

impl<L: Lanes> Past<L> {
    #[inline(always)]
    fn advance(&mut self, step: &Step, before: &Strain<L>, after: &Strain<L>) {
        let n_terms = step.amplitudes.len();
        step.law.advance(&before.h, &after.h, &mut self.strains[..n_terms]);
        let (first, last) = (pulled_back(&before.h, before.q), pulled_back(&after.h, after.q));
        for (term, factors) in step.amplitudes.iter().enumerate() {
            let (decay, gain) = (L::splat(factors.decay), L::splat(factors.gain));
            let flown = &mut self.amplitudes[term];
            flown.0 = last.0 - (decay * (first.0 - flown.0) + gain * (last.0 - first.0));
            flown.1 = last.1 - (decay * (first.1 - flown.1) + gain * (last.1 - first.1));
        }
    }
}

/// A strain a time step (s) ago.
#[inline(always)]
fn before<L: Lanes>(after: &Strain<L>, rate: &Strain<L>, time_step: L) -> Strain<L> {
    let (h, r) = (&after.h, &rate.h);
    Strain {
        h: AxisymmetricTensor {
            rr: h.rr - time_step * r.rr,
            ry: h.ry - time_step * r.ry,
            yr: h.yr - time_step * r.yr,
            yy: h.yy - time_step * r.yy,
            tt: h.tt - time_step * r.tt,
        },
        q: (after.q.0 - time_step * rate.q.0, after.q.1 - time_step * rate.q.1),
    }
}
