//! The element loops of finite strain.

use fem_material::finite::AxisymmetricTensor;

use super::block::{Block, Blocks, load_three};
use super::hourglass::{Amplitudes, Deformed};
use super::law::{ElasticLaw, Law};
use crate::lanes::{LaneKernel, Lanes, WIDE, run_wide_lanes};
use crate::part::{Field, NodalField};

/// The stress of the elements of a block.
pub(super) struct BlockStress<L> {
    /// First Piola–Kirchhoff stress, Pa. It has a meaning where J − 1 > −1.
    pub first_piola: AxisymmetricTensor<L>,
    /// J − 1.
    pub volume_change: L,
    /// Elastic hourglass amplitudes of all branches.
    pub amplitudes: Amplitudes<L>,
}

/// The response of elements, block by block: from the deformation to the stress, with an update of internal variables
/// if there are any.
pub(super) trait BlockResponse<L> {
    /// Returns the stress of the block at a place, from its deformation and its hourglass amplitude pulled back to the
    /// undeformed element, m.
    fn stress(
        &mut self,
        place: usize,
        deformation: &Deformation<L>,
        deformed: &Deformed<L>,
        pulled_back: (L, L),
    ) -> BlockStress<L>;
}

/// Subtracts the internal forces (N) of elements at a displacement (m) from `f`. This is the one loop from displacement
/// to forces of all responses: gather, deformation, pull-back, response, scatter.
///
/// Returns whether every element has a positive volume; if not, the forces have no meaning.
#[inline(always)]
pub(super) fn subtract_forces<L: Lanes<WIDE>, R: BlockResponse<L>>(
    blocks: &Blocks,
    shear: f64,
    u: &Field,
    f: &mut Field,
    response: &mut R,
) -> bool {
    let mut volumes = Volumes::<L>::new();
    for (place, block) in blocks.checked(&[u.len(), f.len()]).iter().enumerate() {
        // SAFETY: the fields have been checked against the corner numbers.
        let deformation = unsafe { Deformation::<L>::gather(block, u) };
        let deformed = deformation.deformed(block, shear);
        let stress =
            response.stress(place, &deformation, &deformed, deformed.pull_back(deformation.q));
        volumes.observe(stress.volume_change, deformation.h.tt);
        // SAFETY: as above.
        unsafe { forces_of(block, &deformed, &stress).scatter_subtract(block, f) };
    }
    volumes.are_valid()
}

/// The output of a loop that takes internal variables to the end of a step.
pub(super) struct Advanced<'a> {
    /// Internal variables of the elements.
    pub internal: &'a mut [NodalField],
    /// Internal forces are subtracted here, N.
    pub forces: &'a mut Field,
    /// Whether every element has a positive volume.
    pub is_valid: bool,
}

/// Returns the derivatives of the energy by the deformation of a block, from its stress.
#[inline(always)]
pub(super) fn forces_of<L: Lanes<WIDE>>(
    block: &Block,
    deformed: &Deformed<L>,
    BlockStress { first_piola: p, amplitudes, .. }: &BlockStress<L>,
) -> Conjugate<L> {
    let shape = deformed.force(amplitudes);
    let volume = L::load(&block.volume);
    let stress = AxisymmetricTensor {
        rr: shape.stress.rr.plus_product(volume, p.rr),
        ry: shape.stress.ry.plus_product(volume, p.ry),
        yr: shape.stress.yr.plus_product(volume, p.yr),
        yy: shape.stress.yy.plus_product(volume, p.yy),
        tt: shape.stress.tt.plus_product(volume, p.tt),
    };
    Conjugate { stress, q: shape.q }
}

/// Returns the stored energy (J) of elastic elements at a displacement, m.
pub(super) fn stored_energy<W: ElasticLaw>(blocks: &Blocks, law: &W, u: &Field) -> f64 {
    let mut energy = 0.0;
    run_wide_lanes(Energy { blocks, law, u }, &mut energy);
    energy
}

struct Energy<'a, W> {
    blocks: &'a Blocks,
    law: &'a W,
    u: &'a Field,
}

impl<W: ElasticLaw> LaneKernel<WIDE> for Energy<'_, W> {
    type Output = f64;

    #[inline(always)]
    fn on<L: Lanes<WIDE>>(self, energy: &mut f64) {
        *energy = sum_energy::<L, W>(self.blocks, self.law, self.u);
    }
}

/// Deformation of the elements of a block: mean displacement gradient, and amplitude of the hourglass shape, m.
#[derive(Clone, Copy)]
pub(super) struct Deformation<L> {
    pub h: AxisymmetricTensor<L>,
    pub q: (L, L),
}

/// Derivatives of the energy by the deformation, J and N.
pub(super) struct Conjugate<L> {
    pub stress: AxisymmetricTensor<L>,
    pub q: (L, L),
}

impl<L: Lanes<WIDE>> Deformation<L> {
    /// # Safety
    /// Every corner of the block is an index of `u`.
    #[inline(always)]
    pub unsafe fn gather(block: &Block, u: &Field) -> Self {
        // SAFETY: the caller's promise.
        let ((r0, y0), (r1, y1), (r2, y2), (r3, y3)) = unsafe {
            (
                L::gather(u, &block.corners[0]),
                L::gather(u, &block.corners[1]),
                L::gather(u, &block.corners[2]),
                L::gather(u, &block.corners[3]),
            )
        };
        let (dr0, dr1, dr2) = (r0 - r3, r1 - r3, r2 - r3);
        let (dy0, dy1, dy2) = (y0 - y3, y1 - y3, y2 - y3);
        let [a0, a1, a2] = load_three::<L>(&block.gradient_r);
        let [b0, b1, b2] = load_three::<L>(&block.gradient_y);
        let [g0, g1, g2] = load_three::<L>(&block.hourglass);
        let [t0, t1] = [L::load(&block.hoop[0]), L::load(&block.hoop[1])];
        let [t2, t3] = [L::load(&block.hoop[2]), L::load(&block.hoop[3])];
        Self {
            h: AxisymmetricTensor {
                rr: (a0 * dr0).plus_product(a1, dr1).plus_product(a2, dr2),
                ry: (b0 * dr0).plus_product(b1, dr1).plus_product(b2, dr2),
                yr: (a0 * dy0).plus_product(a1, dy1).plus_product(a2, dy2),
                yy: (b0 * dy0).plus_product(b1, dy1).plus_product(b2, dy2),
                tt: (t0 * r0).plus_product(t1, r1).plus_product(t2, r2).plus_product(t3, r3),
            },
            q: (
                (g0 * dr0).plus_product(g1, dr1).plus_product(g2, dr2),
                (g0 * dy0).plus_product(g1, dy1).plus_product(g2, dy2),
            ),
        }
    }

    /// Returns the derivatives of the energy at fixed internal variables.
    #[inline(always)]
    pub fn conjugate<W: Law>(
        &self,
        block: &Block,
        law: &W,
        internal: &W::Internal<L>,
    ) -> Conjugate<L> {
        let deformed = self.deformed(block, law.shear());
        let stress = law.stress(&self.h, deformed.pull_back(self.q), internal);
        forces_of(block, &deformed, &stress)
    }

    /// Returns the deformed elements, as their hourglass shape needs them, for an instantaneous shear modulus, Pa.
    #[inline(always)]
    pub fn deformed(&self, block: &Block, shear: f64) -> Deformed<L> {
        Deformed::of(&self.h, L::splat(shear), load_three(&block.measures))
    }
}

impl<L: Lanes<WIDE>> Conjugate<L> {
    /// Returns the force at a corner without that of the hoop stress.
    #[inline(always)]
    fn force(&self, block: &Block, a: usize) -> (L, L) {
        let (g_r, g_y) = (L::load(&block.gradient_r[a]), L::load(&block.gradient_y[a]));
        let gamma = L::load(&block.hourglass[a]);
        let Self { stress, q } = self;
        (
            (g_r * stress.rr).plus_product(g_y, stress.ry).plus_product(gamma, q.0),
            (g_r * stress.yr).plus_product(g_y, stress.yy).plus_product(gamma, q.1),
        )
    }

    /// # Safety
    /// Every corner of the block is an index of `f`.
    #[inline(always)]
    pub unsafe fn scatter_subtract(&self, block: &Block, f: &mut Field) {
        let (r0, y0) = self.force(block, 0);
        let (r1, y1) = self.force(block, 1);
        let (r2, y2) = self.force(block, 2);
        let zero = L::splat(0.0);
        let (r3, y3) = (zero - (r0 + r1 + r2), zero - (y0 + y1 + y2));
        let tt = self.stress.tt;
        // SAFETY: the caller's promise.
        unsafe {
            r0.plus_product(L::load(&block.hoop[0]), tt).scatter_subtract(y0, f, &block.corners[0]);
            r1.plus_product(L::load(&block.hoop[1]), tt).scatter_subtract(y1, f, &block.corners[1]);
            r2.plus_product(L::load(&block.hoop[2]), tt).scatter_subtract(y2, f, &block.corners[2]);
            r3.plus_product(L::load(&block.hoop[3]), tt).scatter_subtract(y3, f, &block.corners[3]);
        }
    }
}

/// The least volumes that a loop has seen.
pub(super) struct Volumes<L> {
    /// Least J − 1, and least hoop.
    least: L,
    /// 0, or not a number where a J is not.
    zero: L,
}

impl<L: Lanes<WIDE>> Volumes<L> {
    #[inline(always)]
    pub fn new() -> Self {
        Self { least: L::splat(0.0), zero: L::splat(0.0) }
    }

    #[inline(always)]
    pub fn observe(&mut self, volume_change: L, hoop: L) {
        self.least = volume_change.min(hoop.min(self.least));
        self.zero = self.zero + volume_change * L::splat(0.0);
    }

    /// Returns whether all volumes are positive.
    #[inline(always)]
    pub fn are_valid(&self) -> bool {
        let (least, zero): ([f64; WIDE], [f64; WIDE]) =
            (self.least.to_array(), self.zero.to_array());
        least.iter().all(|change| *change > -1.0) && zero.iter().all(|zero| *zero == 0.0)
    }

    /// Returns two sums over all lanes; not numbers where a volume is not positive.
    #[inline(always)]
    pub fn checked_sums(&self, first: L, second: L) -> (f64, f64) {
        let (first, second): ([f64; WIDE], [f64; WIDE]) = (first.to_array(), second.to_array());
        match self.are_valid() {
            true => (first.iter().sum(), second.iter().sum()),
            false => (f64::NAN, f64::NAN),
        }
    }
}

#[inline(always)]
pub(super) fn sum_energy<L: Lanes<WIDE>, W: ElasticLaw>(
    blocks: &Blocks,
    law: &W,
    u: &Field,
) -> f64 {
    let mut energy = L::splat(0.0);
    for block in blocks.checked(&[u.len()]) {
        // SAFETY: the field has been checked against the corner numbers.
        let strain = unsafe { Deformation::<L>::gather(block, u) };
        let deformed = strain.deformed(block, law.shear());
        let shape = deformed.energy_of(deformed.pull_back(strain.q));
        energy = energy + L::load(&block.volume) * law.energy(&strain.h) + shape;
    }
    let energy: [f64; WIDE] = energy.to_array();
    energy.iter().sum::<f64>()
}
