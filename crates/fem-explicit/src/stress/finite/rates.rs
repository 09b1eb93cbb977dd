//! Strain rates of deformed elements, and how soon one of them may need a shorter step.

use super::block::{Block, Blocks, Numbers};
use super::kernel::Deformation;
use crate::lanes::{LaneKernel, Lanes, WIDE, run_wide_lanes};
use crate::part::Field;

/// Returns the largest component (1/s) of the rate Ḟ F⁻¹ of any element; not a number where one is not.
pub(super) fn strain_rate(blocks: &Blocks, u: &Field, v: &Field) -> f64 {
    largest(blocks, [u, v], None)
}

/// Returns the largest ratio of these rates to the strain allowance of an element, which is the least of those at its
/// corners, 1/s.
pub(super) fn allowance_rate(blocks: &Blocks, u: &Field, v: &Field, allowances: &[f64]) -> f64 {
    largest(blocks, [u, v], Some(allowances))
}

fn largest(blocks: &Blocks, [u, v]: [&Field; 2], allowances: Option<&[f64]>) -> f64 {
    let mut largest = 0.0;
    run_wide_lanes(Rates { blocks, u, v, allowances }, &mut largest);
    largest
}

struct Rates<'a> {
    blocks: &'a Blocks,
    u: &'a Field,
    v: &'a Field,
    allowances: Option<&'a [f64]>,
}

impl LaneKernel<WIDE> for Rates<'_> {
    type Output = f64;

    #[inline(always)]
    fn on<L: Lanes<WIDE>>(self, largest: &mut f64) {
        let Self { blocks, u, v, allowances } = self;
        let n_allowances = allowances.map_or(usize::MAX, <[f64]>::len);
        for block in blocks.checked(&[u.len(), v.len(), n_allowances]) {
            // SAFETY: the fields have been checked against the corner numbers.
            let (deformed, rate) =
                unsafe { (Deformation::<L>::gather(block, u), Deformation::<L>::gather(block, v)) };
            let mut own = components(&deformed, &rate);
            if let Some(allowances) = allowances {
                own = own / L::load(&least(block, allowances));
            }
            for rate in own.to_array() {
                // Empty lanes are at rest.
                if rate > *largest || rate.is_nan() {
                    *largest = rate;
                }
            }
        }
    }
}

/// Returns the largest component of the rates of a block, 1/s.
#[inline(always)]
fn components<L: Lanes<WIDE>>(deformed: &Deformation<L>, rate: &Deformation<L>) -> L {
    let (one, h, d) = (L::splat(1.0), &deformed.h, &rate.h);
    let (rr, yy) = (one + h.rr, one + h.yy);
    let inverse = one / (rr * yy - h.ry * h.yr);
    // Row by row: Ḟ with F⁻ᵀ.
    let [a, b] = [inverse * (yy * d.rr - h.yr * d.ry), inverse * (rr * d.ry - h.ry * d.rr)];
    let [e, f] = [inverse * (yy * d.yr - h.yr * d.yy), inverse * (rr * d.yy - h.ry * d.yr)];
    let hoop = d.tt / (one + h.tt);
    // A value that is not a number has to stay so; `max` would lose it.
    let sum = size(a) + size(b) + size(e) + size(f) + size(hoop);
    let largest = size(a).max(size(b)).max(size(e).max(size(f))).max(size(hoop));
    largest + L::splat(0.0) * sum
}

#[inline(always)]
fn size<L: Lanes<WIDE>>(x: L) -> L {
    x.max(L::splat(0.0) - x)
}

/// Returns the least value at the corners of each element.
#[inline(always)]
fn least(block: &Block, at_nodes: &[f64]) -> Numbers {
    let mut least = [f64::INFINITY; WIDE];
    for corners in &block.corners {
        for lane in 0..WIDE {
            least[lane] = least[lane].min(at_nodes[corners[lane] as usize]);
        }
    }
    least
}
