//! How fast deformed elements are strained, and how soon one of them may ask for a shorter step.

use super::super::lanes::{LaneKernel, Lanes, WIDE, run_wide_lanes};
use super::block::{Block, Blocks, Numbers};
use super::kernel::Strain;
use crate::part::Field;

/// Largest component (1/s) of the rate Ḟ F⁻¹ of any element; no number where one is none.
pub(super) fn strain_rate(blocks: &Blocks, u: &Field, v: &Field) -> f64 {
    largest(blocks, [u, v], None)
}

/// The largest of these rates over the strain that an element may take, 1/s: what is left at each node
/// (`room`), at the corner with least.
pub(super) fn urgency(blocks: &Blocks, u: &Field, v: &Field, room: &[f64]) -> f64 {
    largest(blocks, [u, v], Some(room))
}

fn largest(blocks: &Blocks, [u, v]: [&Field; 2], room: Option<&[f64]>) -> f64 {
    let mut largest = 0.0;
    run_wide_lanes(Rates { blocks, u, v, room }, &mut largest);
    largest
}

struct Rates<'a> {
    blocks: &'a Blocks,
    u: &'a Field,
    v: &'a Field,
    room: Option<&'a [f64]>,
}

impl LaneKernel<WIDE> for Rates<'_> {
    type Output = f64;

    #[inline(always)]
    fn on<L: Lanes<WIDE>>(self, largest: &mut f64) {
        let Self { blocks, u, v, room } = self;
        let n_room = room.map_or(usize::MAX, <[f64]>::len);
        for block in blocks.checked(&[u.len(), v.len(), n_room]) {
            // SAFETY: the fields have been checked against the corner numbers.
            let (deformed, rate) =
                unsafe { (Strain::<L>::gather(block, u), Strain::<L>::gather(block, v)) };
            let mut own = components(&deformed, &rate);
            if let Some(room) = room {
                own = own / L::load(&least(block, room));
            }
            for rate in own.to_array() {
                // Empty lanes are still.
                if rate > *largest || rate.is_nan() {
                    *largest = rate;
                }
            }
        }
    }
}

/// The largest component of the rates of a block, 1/s.
#[inline(always)]
fn components<L: Lanes<WIDE>>(deformed: &Strain<L>, rate: &Strain<L>) -> L {
    let (one, h, d) = (L::splat(1.0), &deformed.h, &rate.h);
    let (rr, yy) = (one + h.rr, one + h.yy);
    let inverse = one / (rr * yy - h.ry * h.yr);
    // Row by row: of Ḟ with F⁻ᵀ.
    let [a, b] = [inverse * (yy * d.rr - h.yr * d.ry), inverse * (rr * d.ry - h.ry * d.rr)];
    let [e, f] = [inverse * (yy * d.yr - h.yr * d.yy), inverse * (rr * d.yy - h.ry * d.yr)];
    let hoop = d.tt / (one + h.tt);
    // A square root has no sign, and what is no number stays none: `max` would lose it.
    let sum = size(a) + size(b) + size(e) + size(f) + size(hoop);
    let largest = size(a).max(size(b)).max(size(e).max(size(f))).max(size(hoop));
    largest + L::splat(0.0) * sum
}

#[inline(always)]
fn size<L: Lanes<WIDE>>(x: L) -> L {
    x.max(L::splat(0.0) - x)
}

/// Of each element the least at its corners.
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
