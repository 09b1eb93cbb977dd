//! The element loops of small strain, in which a run spends most of its time.

use fem_material::ElasticModuli;

use super::elements::{Block, GatheredBlocks, PackedElements, Shape};
use super::rows::Rows;
use crate::lanes::{LANES, LaneKernel, Lanes, RowKernel, RowLanes, WIDE, run_lanes, run_row_lanes};
use crate::part::Field;

/// Bulk and shear modulus, Pa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Moduli {
    pub bulk: f64,
    pub shear: f64,
}

impl Moduli {
    /// Returns the moduli of an elastic material.
    pub fn of(moduli: &ElasticModuli) -> Self {
        Self { bulk: moduli.bulk_modulus(), shear: moduli.shear_modulus() }
    }
}

/// Subtracts the internal forces (N) of one field from `f`.
pub(crate) fn subtract_internal_forces(
    elements: &PackedElements,
    moduli: Moduli,
    w: &Field,
    f: &mut Field,
) {
    let PackedElements { rows, others } = elements;
    let of = Forces::<_, false> { elements: rows, moduli, bulk_field: w, shear_field: w };
    run_row_lanes(of, f);
    let of = Forces::<_, false> { elements: others, moduli, bulk_field: w, shear_field: w };
    run_lanes(of, f);
}

/// Subtracts the internal forces (N) from `f`: bulk stress of `u`, deviatoric
/// stress of `w`.
pub(crate) fn subtract_split_internal_forces(
    elements: &PackedElements,
    moduli: Moduli,
    u: &Field,
    w: &Field,
    f: &mut Field,
) {
    let PackedElements { rows, others } = elements;
    run_row_lanes(Forces::<_, true> { elements: rows, moduli, bulk_field: u, shear_field: w }, f);
    run_lanes(Forces::<_, true> { elements: others, moduli, bulk_field: u, shear_field: w }, f);
}

/// Returns the strain energy (J) of a field.
pub(crate) fn strain_energy(elements: &PackedElements, moduli: Moduli, field: &Field) -> f64 {
    let PackedElements { rows, others } = elements;
    let (mut in_rows, mut of_others) = (0.0, 0.0);
    run_row_lanes(Energy { elements: rows, moduli, field }, &mut in_rows);
    run_lanes(Energy { elements: others, moduli, field }, &mut of_others);
    in_rows + of_others
}

/// The loop of internal forces; bulk and shear read fields of their own if `SPLIT`.
struct Forces<'a, E, const SPLIT: bool> {
    elements: &'a E,
    moduli: Moduli,
    bulk_field: &'a Field,
    shear_field: &'a Field,
}

impl<const SPLIT: bool> LaneKernel for Forces<'_, GatheredBlocks, SPLIT> {
    type Output = Field;

    #[inline(always)]
    fn on<L: Lanes>(self, f: &mut Field) {
        self.subtract_of_blocks::<L>(f);
    }
}

impl<const SPLIT: bool> RowKernel for Forces<'_, Rows, SPLIT> {
    type Output = Field;

    #[inline(always)]
    fn on<L: RowLanes>(self, f: &mut Field) {
        self.subtract_of_rows::<L>(f);
    }
}

/// The loop of the strain energy.
struct Energy<'a, E> {
    elements: &'a E,
    moduli: Moduli,
    field: &'a Field,
}

impl LaneKernel for Energy<'_, GatheredBlocks> {
    type Output = f64;

    #[inline(always)]
    fn on<L: Lanes>(self, energy: &mut f64) {
        let constants = Constants::<L>::of(self.moduli);
        let mut twice = L::splat(0.0);
        for block in self.elements.checked(&[self.field.len()]) {
            // SAFETY: the field has been checked against the corner numbers.
            let corners = unsafe { Corners::<L>::gather(&block.corners, self.field) };
            twice = constants.plus_twice_energy::<LANES, false>(twice, &block.shape, &corners);
        }
        *energy = 0.5 * twice.to_array().iter().sum::<f64>();
    }
}

impl RowKernel for Energy<'_, Rows> {
    type Output = f64;

    #[inline(always)]
    fn on<L: RowLanes>(self, energy: &mut f64) {
        let constants = Constants::<L>::of(self.moduli);
        let mut twice = L::splat(0.0);
        for (stretch, shapes) in self.elements.checked(&[self.field.len()]) {
            for (k, shape) in shapes.iter().enumerate() {
                let first = stretch.first + k * WIDE;
                // SAFETY: the field has been checked against the nodes of all stretches.
                let corners = unsafe { Corners::<L>::of_row(self.field, first, stretch.stride) };
                twice = constants.plus_twice_energy::<WIDE, true>(twice, shape, &corners);
            }
        }
        *energy = 0.5 * twice.to_array().iter().sum::<f64>();
    }
}

impl<const SPLIT: bool> Forces<'_, GatheredBlocks, SPLIT> {
    #[inline(always)]
    fn subtract_of_blocks<L: Lanes>(self, f: &mut Field) {
        let Self { elements, moduli, bulk_field, shear_field: w } = self;
        let constants = Constants::<L>::of(moduli);
        for Block { corners, shape } in elements.checked(&[bulk_field.len(), w.len(), f.len()]) {
            // SAFETY: the fields have been checked against the corner numbers.
            let seen = unsafe { Corners::<L>::gather(corners, w) };
            let bulk = match SPLIT {
                // SAFETY: as above.
                true => Some(unsafe { Corners::<L>::gather(corners, bulk_field) }),
                false => None,
            };
            let [f0, f1, f2, f3] = constants.forces::<LANES, false>(shape, &seen, bulk.as_ref());
            // SAFETY: as above.
            unsafe {
                f0.0.scatter_subtract(f0.1, f, &corners[0]);
                f1.0.scatter_subtract(f1.1, f, &corners[1]);
                f2.0.scatter_subtract(f2.1, f, &corners[2]);
                f3.0.scatter_subtract(f3.1, f, &corners[3]);
            }
        }
    }
}

impl<const SPLIT: bool> Forces<'_, Rows, SPLIT> {
    #[inline(always)]
    fn subtract_of_rows<L: RowLanes>(self, f: &mut Field) {
        let Self { elements, moduli, bulk_field, shear_field: w } = self;
        let constants = Constants::<L>::of(moduli);
        for (stretch, shapes) in elements.checked(&[bulk_field.len(), w.len(), f.len()]) {
            let (mut first, stride) = (stretch.first, stretch.stride);
            let (mut carry, mut carry_beyond) = (L::no_carry(), L::no_carry());
            for shape in shapes {
                // SAFETY: the fields have been checked against the nodes of all stretches.
                let seen = unsafe { Corners::<L>::of_row(w, first, stride) };
                let bulk = match SPLIT {
                    // SAFETY: as above.
                    true => Some(unsafe { Corners::<L>::of_row(bulk_field, first, stride) }),
                    false => None,
                };
                let [f0, f1, f2, f3] = constants.forces::<WIDE, true>(shape, &seen, bulk.as_ref());
                // SAFETY: as above.
                unsafe {
                    carry = L::subtract_row(f, first, f0, f1, carry);
                    carry_beyond = L::subtract_row(f, first + stride, f3, f2, carry_beyond);
                }
                first += WIDE;
            }
            for (node, carry) in [(first, carry), (first + stride, carry_beyond)] {
                let [r, y] = L::carried(carry);
                f[node][0] -= r;
                f[node][1] -= y;
            }
        }
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
struct ElementStrain<L> {
    rr: L,
    yy: L,
    tt: L,
    ry: L,
    hourglass_r: L,
    hourglass_y: L,
}

/// Returns sum + x y, rounded once if `FUSED`, otherwise twice.
#[inline(always)]
fn plus<const N: usize, L: Lanes<N>, const FUSED: bool>(sum: L, x: L, y: L) -> L {
    if FUSED { sum.plus_product(x, y) } else { sum + x * y }
}

// Closures and `map` would be compiled without the instruction set of the kernel
// that they stand in, so numbers are loaded one by one.
#[inline(always)]
fn load_three<const N: usize, L: Lanes<N>>(values: &[[f64; N]; 3]) -> [L; 3] {
    [L::load(&values[0]), L::load(&values[1]), L::load(&values[2])]
}

/// Returns x₀ y₀ + x₁ y₁ + x₂ y₂.
#[inline(always)]
fn dot<const N: usize, L: Lanes<N>, const FUSED: bool>(x: &[L; 3], y: &[L; 3]) -> L {
    plus::<N, L, FUSED>(plus::<N, L, FUSED>(x[0] * y[0], x[1], y[1]), x[2], y[2])
}

impl<L> Corners<L> {
    #[inline(always)]
    fn of<const N: usize>([r0, r1, r2, r3]: [L; 4], [y0, y1, y2, y3]: [L; 4]) -> Self
    where
        L: Lanes<N>,
    {
        Self {
            r: [r0, r1, r2, r3],
            dr: [r0 - r3, r1 - r3, r2 - r3],
            dy: [y0 - y3, y1 - y3, y2 - y3],
        }
    }

    /// # Safety
    /// Every corner is an index of `field`.
    #[inline(always)]
    unsafe fn gather(corners: &[[u32; LANES]; 4], field: &Field) -> Self
    where
        L: Lanes,
    {
        // SAFETY: the caller's promise.
        let ((r0, y0), (r1, y1), (r2, y2), (r3, y3)) = unsafe {
            (
                L::gather(field, &corners[0]),
                L::gather(field, &corners[1]),
                L::gather(field, &corners[2]),
                L::gather(field, &corners[3]),
            )
        };
        Self::of([r0, r1, r2, r3], [y0, y1, y2, y3])
    }

    /// Loads the corners of eight elements in a row, given the first corner of the first one and their stride.
    ///
    /// # Safety
    /// The nine nodes from there and the nine a stride further are in the field.
    #[inline(always)]
    unsafe fn of_row(field: &Field, first: usize, stride: usize) -> Self
    where
        L: RowLanes,
    {
        // SAFETY: the caller's promise.
        let ((r0, y0), (r1, y1), (r2, y2), (r3, y3)) = unsafe {
            (
                L::load_row(field, first),
                L::load_row(field, first + 1),
                L::load_row(field, first + stride + 1),
                L::load_row(field, first + stride),
            )
        };
        Self::of([r0, r1, r2, r3], [y0, y1, y2, y3])
    }

    #[inline(always)]
    fn strain<const N: usize, const FUSED: bool>(&self, shape: &Shape<N>) -> ElementStrain<L>
    where
        L: Lanes<N>,
    {
        let [r, y] = [load_three(&shape.gradient_r), load_three(&shape.gradient_y)];
        let h = load_three(&shape.hourglass);
        ElementStrain {
            rr: dot::<N, L, FUSED>(&r, &self.dr),
            yy: dot::<N, L, FUSED>(&y, &self.dy),
            tt: self.hoop::<N, FUSED>(shape),
            ry: dot::<N, L, FUSED>(&y, &self.dr) + dot::<N, L, FUSED>(&r, &self.dy),
            hourglass_r: dot::<N, L, FUSED>(&h, &self.dr),
            hourglass_y: dot::<N, L, FUSED>(&h, &self.dy),
        }
    }

    #[inline(always)]
    fn dilatation<const N: usize, const FUSED: bool>(&self, shape: &Shape<N>) -> L
    where
        L: Lanes<N>,
    {
        let [r, y] = [load_three(&shape.gradient_r), load_three(&shape.gradient_y)];
        dot::<N, L, FUSED>(&r, &self.dr)
            + dot::<N, L, FUSED>(&y, &self.dy)
            + self.hoop::<N, FUSED>(shape)
    }

    #[inline(always)]
    fn hoop<const N: usize, const FUSED: bool>(&self, shape: &Shape<N>) -> L
    where
        L: Lanes<N>,
    {
        let [t0, t1] = [L::load(&shape.hoop[0]), L::load(&shape.hoop[1])];
        let [t2, t3] = [L::load(&shape.hoop[2]), L::load(&shape.hoop[3])];
        let [r0, r1, r2, r3] = self.r;
        plus::<N, L, FUSED>(t0 * r0, t1, r1) + plus::<N, L, FUSED>(t2 * r2, t3, r3)
    }
}

/// Moduli in all lanes.
struct Constants<L> {
    bulk: L,
    shear: L,
    twice_shear: L,
    /// The share 2/3 G of the trace.
    trace_shear: L,
    /// Lamé's constant K − 2/3 G.
    lame: L,
}

impl<L> Constants<L> {
    #[inline(always)]
    fn of<const N: usize>(Moduli { bulk, shear }: Moduli) -> Self
    where
        L: Lanes<N>,
    {
        Self {
            bulk: L::splat(bulk),
            shear: L::splat(shear),
            twice_shear: L::splat(2.0 * shear),
            trace_shear: L::splat(2.0 / 3.0 * shear),
            lame: L::splat(bulk - 2.0 / 3.0 * shear),
        }
    }

    /// Returns the forces (r, y) of the elements at their corners; the bulk stress is that of other displacements if given.
    #[inline(always)]
    fn forces<const N: usize, const FUSED: bool>(
        &self,
        shape: &Shape<N>,
        corners: &Corners<L>,
        bulk: Option<&Corners<L>>,
    ) -> [(L, L); 4]
    where
        L: Lanes<N>,
    {
        let e = corners.strain::<N, FUSED>(shape);
        let trace = e.rr + e.yy + e.tt;
        let dilatation = match bulk {
            Some(corners) => corners.dilatation::<N, FUSED>(shape),
            None => trace,
        };
        let mean = self.bulk * dilatation - self.trace_shear * trace;
        let s_tt = plus::<N, L, FUSED>(mean, self.twice_shear, e.tt);
        let [k_rr, k_yy, k_ry] = load_three::<N, L>(&shape.hourglass_stiffness);
        let (q_r, q_y) = (e.hourglass_r, e.hourglass_y);
        let stress = ElementStress {
            s_rr: plus::<N, L, FUSED>(mean, self.twice_shear, e.rr),
            s_yy: plus::<N, L, FUSED>(mean, self.twice_shear, e.yy),
            s_ry: self.shear * e.ry,
            h_r: self.shear * plus::<N, L, FUSED>(k_rr * q_r, k_ry, q_y),
            h_y: self.shear * plus::<N, L, FUSED>(k_ry * q_r, k_yy, q_y),
        };
        let (r0, y0) = stress.force::<N, FUSED>(shape, 0);
        let (r1, y1) = stress.force::<N, FUSED>(shape, 1);
        let (r2, y2) = stress.force::<N, FUSED>(shape, 2);
        let zero = L::splat(0.0);
        let (r3, y3) = (zero - (r0 + r1 + r2), zero - (y0 + y1 + y2));
        [
            (plus::<N, L, FUSED>(r0, L::load(&shape.hoop[0]), s_tt), y0),
            (plus::<N, L, FUSED>(r1, L::load(&shape.hoop[1]), s_tt), y1),
            (plus::<N, L, FUSED>(r2, L::load(&shape.hoop[2]), s_tt), y2),
            (plus::<N, L, FUSED>(r3, L::load(&shape.hoop[3]), s_tt), y3),
        ]
    }

    /// Returns a sum plus twice the strain energies of the elements.
    #[inline(always)]
    fn plus_twice_energy<const N: usize, const FUSED: bool>(
        &self,
        sum: L,
        shape: &Shape<N>,
        corners: &Corners<L>,
    ) -> L
    where
        L: Lanes<N>,
    {
        let e = corners.strain::<N, FUSED>(shape);
        let trace = e.rr + e.yy + e.tt;
        let [k_rr, k_yy, k_ry] = load_three::<N, L>(&shape.hourglass_stiffness);
        let (q_r, q_y) = (e.hourglass_r, e.hourglass_y);
        let cross = k_ry * q_r * q_y;
        let hourglass = k_rr * q_r * q_r + (cross + cross) + k_yy * q_y * q_y;
        sum + self.lame * trace * trace
            + self.twice_shear * (e.rr * e.rr + e.yy * e.yy + e.tt * e.tt)
            + self.shear * (e.ry * e.ry + hourglass)
    }
}

/// Stresses and hourglass forces, which the gradients turn into nodal forces.
#[derive(Clone, Copy)]
struct ElementStress<L> {
    s_rr: L,
    s_yy: L,
    s_ry: L,
    h_r: L,
    h_y: L,
}

impl<L> ElementStress<L> {
    /// Returns the force at a corner without that of the hoop stress.
    #[inline(always)]
    fn force<const N: usize, const FUSED: bool>(&self, shape: &Shape<N>, a: usize) -> (L, L)
    where
        L: Lanes<N>,
    {
        let [g_r, g_y] = [L::load(&shape.gradient_r[a]), L::load(&shape.gradient_y[a])];
        let gamma = L::load(&shape.hourglass[a]);
        let r = plus::<N, L, FUSED>(g_r * self.s_rr, g_y, self.s_ry);
        let y = plus::<N, L, FUSED>(g_y * self.s_yy, g_r, self.s_ry);
        (plus::<N, L, FUSED>(r, gamma, self.h_r), plus::<N, L, FUSED>(y, gamma, self.h_y))
    }
}

#[cfg(test)]
mod tests;
