//! What elements that relax remember: three fields a term, of one pair an element, three of their
//! deformation at the end of the last step, and a nodal one.
//!
//! ```text
//! 3 k        radial and axial component of C̄_v − 1
//! 3 k + 1    shear component of C̄_v − 1, and J_v − 1
//! 3 k + 2    amplitude of the hourglass shape that has flown, in the undeformed element, m
//! 3 n ..     of n terms, the same of the element: C̄ − 1, J − 1, and all of its amplitude
//! 3 n + 3    internal forces of that deformation and past, N; no numbers where an element collapsed
//! ```
//!
//! Elements stand in the order of their blocks ([`Slots`]), so that a loop reads and writes them in turn.

use fem_material::finite::{InverseMetric, ViscousStrain};

use super::super::lanes::{Lanes, WIDE};
use super::block::Slots;
use crate::part::{Field, NodalField};

/// Most terms that a material at finite strain may have: a longer series is a table, of which so many
/// terms a decade of time say as much. They lie on the stack in the element loops.
pub const MOST_FINITE_STRAIN_TERMS: usize = 32;
/// Fields of history of a term.
pub(super) const FIELDS_A_TERM: usize = 3;

/// Fields of history of elements with so many terms.
pub(super) fn n_element_fields(n_terms: usize) -> usize {
    FIELDS_A_TERM * (n_terms + 1)
}

/// The past of lanes of elements, term by term, of up to `MOST` terms.
pub(super) struct Past<L, const MOST: usize = MOST_FINITE_STRAIN_TERMS> {
    pub metrics: [InverseMetric<L>; MOST],
    pub amplitudes: [(L, L); MOST],
}

impl<L: Lanes<WIDE>, const MOST: usize> Past<L, MOST> {
    /// Of elements that nothing has ever strained.
    #[inline(always)]
    pub fn none() -> Self {
        let zero = L::splat(0.0);
        Self { metrics: [InverseMetric::none(); MOST], amplitudes: [(zero, zero); MOST] }
    }

    /// Reads the first terms of a block's elements.
    #[inline(always)]
    pub fn load(&mut self, n_terms: usize, history: &[NodalField], slots: Slots) {
        for term in 0..n_terms {
            let (strain, amplitude) = load_term(history, term, slots);
            (self.metrics[term], self.amplitudes[term]) = (strain.inverse_metric(), amplitude);
        }
    }
}

/// Reads what stands in the places of a term, of a block's elements.
#[inline(always)]
pub(super) fn load_term<L: Lanes<WIDE>>(
    history: &[NodalField],
    term: usize,
    slots: Slots,
) -> (ViscousStrain<L>, (L, L)) {
    let [plane, rest, amplitude] = of_term(history, term);
    let ((rr, yy), (ry, volume_change)) = (slots.load(plane), slots.load(rest));
    (ViscousStrain { rr, yy, ry, volume_change }, slots.load(amplitude))
}

/// Writes it.
#[inline(always)]
pub(super) fn store_term<L: Lanes<WIDE>>(
    history: &mut [NodalField],
    term: usize,
    slots: Slots,
    strain: &ViscousStrain<L>,
    (r, y): (L, L),
) {
    let first = FIELDS_A_TERM * term;
    let ViscousStrain { rr, yy, ry, volume_change } = *strain;
    slots.store(&mut history[first], rr, yy);
    slots.store(&mut history[first + 1], ry, volume_change);
    slots.store(&mut history[first + 2], r, y);
}

/// Whether a history has so many terms of so many elements.
pub(super) fn is_sound(history: &[NodalField], n_terms: usize, n_elements: usize) -> bool {
    n_terms <= MOST_FINITE_STRAIN_TERMS
        && history.len() >= FIELDS_A_TERM * n_terms
        && history[..FIELDS_A_TERM * n_terms].iter().all(|field| field.len() >= n_elements)
}

/// The past of one element: what the law remembers, and the amplitudes that have flown, m.
pub(super) fn of_element(
    history: &[NodalField],
    n_terms: usize,
    (slots, lane): (Slots, usize),
) -> ([ViscousStrain; MOST_FINITE_STRAIN_TERMS], [(f64, f64); MOST_FINITE_STRAIN_TERMS]) {
    let mut strains = [ViscousStrain::default(); MOST_FINITE_STRAIN_TERMS];
    let mut amplitudes = [(0.0, 0.0); MOST_FINITE_STRAIN_TERMS];
    for term in 0..n_terms {
        let [[rr, yy], [ry, volume_change], [r, y]] =
            of_term(history, term).map(|field| slots.pair(lane, field));
        strains[term] = ViscousStrain { rr, yy, ry, volume_change };
        amplitudes[term] = (r, y);
    }
    (strains, amplitudes)
}

#[inline(always)]
fn of_term(history: &[NodalField], term: usize) -> [&Field; 3] {
    let first = FIELDS_A_TERM * term;
    [&history[first], &history[first + 1], &history[first + 2]]
}
