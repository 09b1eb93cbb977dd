//! Internal variables of relaxing elements: three fields per term with one pair per element, three fields of their
//! deformation at the end of the last step, and one nodal field.
//!
//! ```text
//! 3 k        radial and axial component of C̄_v − 1
//! 3 k + 1    shear component of C̄_v − 1, and J_v − 1
//! 3 k + 2    viscous amplitude of the hourglass shape, in the undeformed element, m
//! 3 n ..     for n terms, the same of the element: C̄ − 1, J − 1, and its whole amplitude
//! 3 n + 3    nodal: internal forces at that deformation, N; not numbers where an element has collapsed
//! ```
//!
//! Elements are in the order of their blocks ([`Slots`]), so that a loop reads and writes them one after the other.

use fem_material::finite::{InverseMetric, ViscousStrain};

use super::block::Slots;
use crate::lanes::{Lanes, WIDE};
use crate::part::{Field, NodalField};

/// Largest number of Prony terms of a material at finite strain. They lie on the stack in the element loops. A longer
/// series is tabulated data, which this many terms represent as well.
pub const MAX_FINITE_STRAIN_TERMS: usize = 32;
/// Fields of history per term.
pub(super) const FIELDS_PER_TERM: usize = 3;

/// Returns the number of fields of history of elements with a number of terms.
pub(super) fn n_element_fields(n_terms: usize) -> usize {
    FIELDS_PER_TERM * (n_terms + 1)
}

/// Internal variables of the elements of a block, for up to `MOST` terms.
pub(super) struct InternalVariables<L, const MOST: usize = MAX_FINITE_STRAIN_TERMS> {
    pub metrics: [InverseMetric<L>; MOST],
    pub amplitudes: [(L, L); MOST],
}

impl<L: Lanes<WIDE>, const MOST: usize> InternalVariables<L, MOST> {
    /// Returns those of elements that have never been strained.
    #[inline(always)]
    pub fn none() -> Self {
        let zero = L::splat(0.0);
        Self { metrics: [InverseMetric::none(); MOST], amplitudes: [(zero, zero); MOST] }
    }

    /// Reads the first terms of the elements of a block.
    #[inline(always)]
    pub fn load(&mut self, n_terms: usize, history: &[NodalField], slots: Slots) {
        for term in 0..n_terms {
            let (strain, amplitude) = load_term(history, term, slots);
            (self.metrics[term], self.amplitudes[term]) = (strain.inverse_metric(), amplitude);
        }
    }
}

/// Reads the fields of a term for the elements of a block.
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

/// Writes the fields of a term.
#[inline(always)]
pub(super) fn store_term<L: Lanes<WIDE>>(
    history: &mut [NodalField],
    term: usize,
    slots: Slots,
    strain: &ViscousStrain<L>,
    (r, y): (L, L),
) {
    let first = FIELDS_PER_TERM * term;
    let ViscousStrain { rr, yy, ry, volume_change } = *strain;
    slots.store(&mut history[first], rr, yy);
    slots.store(&mut history[first + 1], ry, volume_change);
    slots.store(&mut history[first + 2], r, y);
}

/// Returns whether a history has a number of fields that are long enough for a number of elements.
pub(super) fn has_fields(history: &[NodalField], n_fields: usize, n_elements: usize) -> bool {
    history.len() >= n_fields && history[..n_fields].iter().all(|field| field.len() >= n_elements)
}

/// Returns the internal variables of one element: those of the law, and its viscous amplitudes, m.
pub(super) fn of_element(
    history: &[NodalField],
    n_terms: usize,
    (slots, lane): (Slots, usize),
) -> ([ViscousStrain; MAX_FINITE_STRAIN_TERMS], [(f64, f64); MAX_FINITE_STRAIN_TERMS]) {
    let mut strains = [ViscousStrain::default(); MAX_FINITE_STRAIN_TERMS];
    let mut amplitudes = [(0.0, 0.0); MAX_FINITE_STRAIN_TERMS];
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
    let first = FIELDS_PER_TERM * term;
    [&history[first], &history[first + 1], &history[first + 2]]
}
