//! What elements that relax remember: three fields a term, of one pair an element.
//!
//! ```text
//! 3 k        radial and axial component of C̄_v − 1
//! 3 k + 1    shear component of C̄_v − 1, and J_v − 1
//! 3 k + 2    amplitude of the hourglass shape that has flown, in the undeformed element, m
//! ```

use fem_material::finite::ViscousStrain;

use super::super::lanes::{LANES, Lanes};
use crate::part::{Field, NodalField};

/// Most terms that a material at finite strain may have: a longer series is a table, of which so many
/// terms a decade of time say as much. They lie on the stack in the element loops.
pub const MOST_FINITE_STRAIN_TERMS: usize = 32;
/// Fields of history of a term.
pub(super) const FIELDS_A_TERM: usize = 3;

/// The past of lanes of elements, term by term.
pub(super) struct Past<L> {
    pub strains: [ViscousStrain<L>; MOST_FINITE_STRAIN_TERMS],
    pub amplitudes: [(L, L); MOST_FINITE_STRAIN_TERMS],
}

impl<L: Lanes> Past<L> {
    /// Of elements that nothing has ever strained.
    #[inline(always)]
    pub fn none() -> Self {
        let zero = L::splat(0.0);
        let strain = ViscousStrain { rr: zero, yy: zero, ry: zero, volume_change: zero };
        Self {
            strains: [strain; MOST_FINITE_STRAIN_TERMS],
            amplitudes: [(zero, zero); MOST_FINITE_STRAIN_TERMS],
        }
    }

    /// Reads the first terms of elements from a history, [`is_sound`].
    #[inline(always)]
    pub fn load(&mut self, n_terms: usize, history: &[NodalField], elements: &[u32; LANES]) {
        for term in 0..n_terms {
            let [plane, rest, amplitude] = of_term(history, term);
            // SAFETY: the history has been checked against the elements.
            unsafe {
                let strain = &mut self.strains[term];
                (strain.rr, strain.yy) = L::gather(plane, elements);
                (strain.ry, strain.volume_change) = L::gather(rest, elements);
                self.amplitudes[term] = L::gather(amplitude, elements);
            }
        }
    }

    /// Writes the first terms back, of as many lanes as hold an element.
    #[inline(always)]
    pub fn store(
        &self,
        n_terms: usize,
        history: &mut [NodalField],
        elements: &[u32; LANES],
        n_lanes: usize,
    ) {
        for term in 0..n_terms {
            let ViscousStrain { rr, yy, ry, volume_change } = self.strains[term];
            let (r, y) = self.amplitudes[term];
            let first = FIELDS_A_TERM * term;
            let elements = &elements[..n_lanes];
            put(&mut history[first], elements, rr.to_array(), yy.to_array());
            put(&mut history[first + 1], elements, ry.to_array(), volume_change.to_array());
            put(&mut history[first + 2], elements, r.to_array(), y.to_array());
        }
    }
}

#[inline(always)]
fn put(field: &mut Field, elements: &[u32], first: [f64; LANES], second: [f64; LANES]) {
    for (lane, &element) in elements.iter().enumerate() {
        field[element as usize] = [first[lane], second[lane]];
    }
}

/// Whether a history has so many terms of so many elements.
pub(super) fn is_sound(history: &[NodalField], n_terms: usize, n_elements: usize) -> bool {
    n_terms <= MOST_FINITE_STRAIN_TERMS
        && history.len() >= FIELDS_A_TERM * n_terms
        && history.iter().all(|field| field.len() >= n_elements)
}

/// The past of one element: what the law remembers, and the amplitudes that have flown, m.
pub(super) fn of_element(
    history: &[NodalField],
    n_terms: usize,
    element: usize,
) -> ([ViscousStrain; MOST_FINITE_STRAIN_TERMS], [(f64, f64); MOST_FINITE_STRAIN_TERMS]) {
    let mut strains = [ViscousStrain::default(); MOST_FINITE_STRAIN_TERMS];
    let mut amplitudes = [(0.0, 0.0); MOST_FINITE_STRAIN_TERMS];
    for term in 0..n_terms {
        let [[rr, yy], [ry, volume_change], [r, y]] =
            of_term(history, term).map(|field| field[element]);
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
