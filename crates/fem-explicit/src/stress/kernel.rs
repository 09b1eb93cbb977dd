//! The element loops, in which a run spends its time.

use fem_material::ElasticModuli;

use super::block::{Block, Blocks};
use super::lanes::{LANES, LaneKernel, Lanes, run_lanes};
use crate::part::Field;

/// Bulk and shear modulus, Pa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Moduli {
    pub bulk: f64,
    pub shear: f64,
}

impl Moduli {
    /// Of an elastic material.
    pub fn of(moduli: &ElasticModuli) -> Self {
        Self { bulk: moduli.bulk_modulus(), shear: moduli.shear_modulus() }
    }
}

/// Subtracts the internal forces (N) of one field from `f`.
pub(crate) fn subtract_internal_forces(blocks: &Blocks, moduli: Moduli, w: &Field, f: &mut Field) {
    run_lanes(Forces::<false> { blocks, moduli, bulk_field: w, shear_field: w }, f);
}

/// Subtracts the internal forces (N) from `f`: bulk stress of `u`, deviatoric
/// stress of `w`.
pub(crate) fn subtract_split_internal_forces(
    blocks: &Blocks,
    moduli: Moduli,
    u: &Field,
    w: &Field,
    f: &mut Field,
) {
    run_lanes(Forces::<true> { blocks, moduli, bulk_field: u, shear_field: w }, f);
}

/// Strain energy (J) of a field.
pub(crate) fn strain_energy(blocks: &Blocks, moduli: Moduli, field: &Field) -> f64 {
    let mut energy = 0.0;
    run_lanes(Energy { blocks, moduli, field }, &mut energy);
    energy
}

/// Internal forces; bulk and shear see fields of their own if `SPLIT`.
struct Forces<'a, const SPLIT: bool> {
    blocks: &'a Blocks,
    moduli: Moduli,
    bulk_field: &'a Field,
    shear_field: &'a Field,
}

impl<const SPLIT: bool> LaneKernel for Forces<'_, SPLIT> {
    type Output = Field;

    #[inline(always)]
    fn on<L: Lanes>(self, f: &mut Field) {
        let Self { blocks, moduli, bulk_field, shear_field } = self;
        subtract_forces::<L, SPLIT>(blocks, moduli, bulk_field, shear_field, f);
    }
}

/// Strain energy.
struct Energy<'a> {
    blocks: &'a Blocks,
    moduli: Moduli,
    field: &'a Field,
}

impl LaneKernel for Energy<'_> {
    type Output = f64;

    #[inline(always)]
    fn on<L: Lanes>(self, energy: &mut f64) {
        *energy = sum_energy::<L>(self.blocks, self.moduli, self.field);
    }
}

/// Displacements at the corners: radial at all four, and both relative to
/// corner 3.
struct Corners<L> {
    r: [L; 4],
    dr: [L; 3],
    dy: [L; 3],
}

/// Strains of the elements times the square root of their volume, and their
/// hourglass amplitudes.
struct Strain<L> {
    rr: L,
    yy: L,
    tt: L,
    ry: L,
    hourglass_r: L,
    hourglass_y: L,
}

// Closures and `map` would be compiled without the instruction set of the kernel
// that they stand in, so numbers are loaded one by one.
#[inline(always)]
fn load_three<L: Lanes>(values: &[[f64; LANES]; 3]) -> [L; 3] {
    [L::load(&values[0]), L::load(&values[1]), L::load(&values[2])]
}

impl<L: Lanes> Corners<L> {
    /// # Safety
    /// Every corner of the block is an index of `field`.
    #[inline(always)]
    unsafe fn gather(block: &Block, field: &Field) -> Self {
        // SAFETY: the caller's promise.
        let ((r0, y0), (r1, y1), (r2, y2), (r3, y3)) = unsafe {
            (
                L::gather(field, &block.corners[0]),
                L::gather(field, &block.corners[1]),
                L::gather(field, &block.corners[2]),
                L::gather(field, &block.corners[3]),
            )
        };
        Self {
            r: [r0, r1, r2, r3],
            dr: [r0 - r3, r1 - r3, r2 - r3],
            dy: [y0 - y3, y1 - y3, y2 - y3],
        }
    }

    #[inline(always)]
    fn strain(&self, block: &Block) -> Strain<L> {
        let [r0, r1, r2] = load_three::<L>(&block.gradient_r);
        let [y0, y1, y2] = load_three::<L>(&block.gradient_y);
        let [h0, h1, h2] = load_three::<L>(&block.hourglass);
        let ([dr0, dr1, dr2], [dy0, dy1, dy2]) = (self.dr, self.dy);
        Strain {
            rr: r0 * dr0 + r1 * dr1 + r2 * dr2,
            yy: y0 * dy0 + y1 * dy1 + y2 * dy2,
            tt: self.hoop(block),
            ry: (y0 * dr0 + y1 * dr1 + y2 * dr2) + (r0 * dy0 + r1 * dy1 + r2 * dy2),
            hourglass_r: h0 * dr0 + h1 * dr1 + h2 * dr2,
            hourglass_y: h0 * dy0 + h1 * dy1 + h2 * dy2,
        }
    }

    #[inline(always)]
    fn dilatation(&self, block: &Block) -> L {
        let [r0, r1, r2] = load_three::<L>(&block.gradient_r);
        let [y0, y1, y2] = load_three::<L>(&block.gradient_y);
        let ([dr0, dr1, dr2], [dy0, dy1, dy2]) = (self.dr, self.dy);
        (r0 * dr0 + r1 * dr1 + r2 * dr2) + (y0 * dy0 + y1 * dy1 + y2 * dy2) + self.hoop(block)
    }

    #[inline(always)]
    fn hoop(&self, block: &Block) -> L {
        let [t0, t1, t2] =
            [L::load(&block.hoop[0]), L::load(&block.hoop[1]), L::load(&block.hoop[2])];
        let t3 = L::load(&block.hoop[3]);
        (t0 * self.r[0] + t1 * self.r[1]) + (t2 * self.r[2] + t3 * self.r[3])
    }
}

/// Subtracts the internal forces of the shear field `w`, and of the bulk field
/// where it is another, from `f`.
#[inline(always)]
fn subtract_forces<L: Lanes, const SPLIT: bool>(
    blocks: &Blocks,
    moduli: Moduli,
    bulk_field: &Field,
    w: &Field,
    f: &mut Field,
) {
    let bulk = L::splat(moduli.bulk);
    let shear = L::splat(moduli.shear);
    let twice_shear = L::splat(2.0 * moduli.shear);
    let trace_shear = L::splat(2.0 / 3.0 * moduli.shear);
    for block in blocks.checked(&[bulk_field.len(), w.len(), f.len()]) {
        // SAFETY: the fields have been checked against the corner numbers.
        let e = unsafe { Corners::<L>::gather(block, w) }.strain(block);
        let trace = e.rr + e.yy + e.tt;
        let dilatation = if SPLIT {
            // SAFETY: as above.
            unsafe { Corners::<L>::gather(block, bulk_field) }.dilatation(block)
        } else {
            trace
        };
        let mean = bulk * dilatation - trace_shear * trace;
        let s_rr = mean + twice_shear * e.rr;
        let s_yy = mean + twice_shear * e.yy;
        let s_tt = mean + twice_shear * e.tt;
        let s_ry = shear * e.ry;
        let [k_rr, k_yy, k_ry] = load_three::<L>(&block.hourglass_stiffness);
        let h_r = shear * (k_rr * e.hourglass_r + k_ry * e.hourglass_y);
        let h_y = shear * (k_ry * e.hourglass_r + k_yy * e.hourglass_y);

        let stress = Stress { s_rr, s_yy, s_ry, h_r, h_y };
        let (r0, y0) = stress.force(block, 0);
        let (r1, y1) = stress.force(block, 1);
        let (r2, y2) = stress.force(block, 2);
        let zero = L::splat(0.0);
        let (r3, y3) = (zero - (r0 + r1 + r2), zero - (y0 + y1 + y2));
        // SAFETY: as above.
        unsafe {
            (r0 + L::load(&block.hoop[0]) * s_tt).scatter_subtract(y0, f, &block.corners[0]);
            (r1 + L::load(&block.hoop[1]) * s_tt).scatter_subtract(y1, f, &block.corners[1]);
            (r2 + L::load(&block.hoop[2]) * s_tt).scatter_subtract(y2, f, &block.corners[2]);
            (r3 + L::load(&block.hoop[3]) * s_tt).scatter_subtract(y3, f, &block.corners[3]);
        }
    }
}

/// What the gradients turn into forces.
#[derive(Clone, Copy)]
struct Stress<L> {
    s_rr: L,
    s_yy: L,
    s_ry: L,
    h_r: L,
    h_y: L,
}

impl<L: Lanes> Stress<L> {
    /// Force at a corner but for the hoop stress.
    #[inline(always)]
    fn force(&self, block: &Block, a: usize) -> (L, L) {
        let (g_r, g_y) = (L::load(&block.gradient_r[a]), L::load(&block.gradient_y[a]));
        let gamma = L::load(&block.hourglass[a]);
        (
            g_r * self.s_rr + g_y * self.s_ry + gamma * self.h_r,
            g_y * self.s_yy + g_r * self.s_ry + gamma * self.h_y,
        )
    }
}

#[inline(always)]
fn sum_energy<L: Lanes>(blocks: &Blocks, moduli: Moduli, field: &Field) -> f64 {
    let bulk = L::splat(moduli.bulk - 2.0 / 3.0 * moduli.shear);
    let shear = L::splat(moduli.shear);
    let twice_shear = L::splat(2.0 * moduli.shear);
    let mut twice = L::splat(0.0);
    for block in blocks.checked(&[field.len()]) {
        // SAFETY: the field has been checked against the corner numbers.
        let e = unsafe { Corners::<L>::gather(block, field) }.strain(block);
        let trace = e.rr + e.yy + e.tt;
        let [k_rr, k_yy, k_ry] = load_three::<L>(&block.hourglass_stiffness);
        let (q_r, q_y) = (e.hourglass_r, e.hourglass_y);
        let cross = k_ry * q_r * q_y;
        let hourglass = k_rr * q_r * q_r + (cross + cross) + k_yy * q_y * q_y;
        twice = twice
            + bulk * trace * trace
            + twice_shear * (e.rr * e.rr + e.yy * e.yy + e.tt * e.tt)
            + shear * (e.ry * e.ry + hourglass);
    }
    let twice: [f64; LANES] = twice.to_array();
    0.5 * twice.iter().sum::<f64>()
}

#[cfg(test)]
mod tests;
