//! Bound of the largest eigenvalue of deformed elements against their masses.
//!
//! With the strains e = B u of an element, those of its mean gradient and its hourglass amplitudes, the
//! stiffness is Bᵀ D B, D = ∂²E/∂e². Its eigenvalues against the masses are those of D Q, Q = B M⁻¹ Bᵀ,
//! which is constant, and
//!
//! ```math
//! \lambda_{max} \le \left( \mathrm{tr} (D Q)^{16} \right)^{1/16},
//! ```
//!
//! since all are real. The bound is at most 7^(1/16) = 1.13 times too large, usually some per cent. D is computed by
//! differences of the stress.

use fem_element::QuadGeometry;
use fem_mesh::SphereMesh;

use super::super::traits::LumpedElement;
use super::block::{Block, Blocks, Numbers, place};
use super::internal_variables;
use super::kernel::{Conjugate, Deformation};
use super::law::Law;
use crate::lanes::{LaneKernel, Lanes, WIDE, run_wide_lanes};
use crate::part::{Field, NodalField};

/// Number of strains of an element: rr, ry, θθ and the radial amplitude by radial displacements; yr, yy and the axial
/// amplitude by axial displacements.
const N_STRAINS: usize = 7;
/// Index of the first strain by axial displacements.
const FIRST_AXIAL: usize = 4;
/// Difference of a strain: the stress has a relative rounding error of 1e-16, and its slope changes over a strain of 1.
const STRAIN_STEP: f64 = 1e-6;

type Square<L> = [[L; N_STRAINS]; N_STRAINS];

/// Masses of the elements of a block, and their matrix Q.
#[derive(Debug, Clone)]
struct Metric {
    /// Masses of the corners, kg.
    masses: [Numbers; 4],
    /// Unit of the hourglass amplitudes, m.
    length: Numbers,
    /// Q for strains and for amplitudes over the length, 1/(m² kg).
    q: [[Numbers; N_STRAINS]; N_STRAINS],
}

impl Metric {
    /// Elements without mass, whose eigenvalue is 0.
    const EMPTY: Self = Self {
        masses: [[0.0; WIDE]; 4],
        length: [1.0; WIDE],
        q: [[[0.0; WIDE]; N_STRAINS]; N_STRAINS],
    };

    /// Puts an element into a lane; corners `on_axis` move along y alone.
    fn put(&mut self, lane: usize, geometry: &QuadGeometry, masses: &[f64; 4], on_axis: [bool; 4]) {
        let QuadGeometry { gradient_r, gradient_y, hoop, hourglass, .. } = geometry;
        let square: f64 = gradient_r.iter().chain(gradient_y).map(|g| g * g).sum();
        let length = square.sqrt().recip();
        self.length[lane] = length;
        for a in 0..4 {
            self.masses[a][lane] = masses[a];
            let amplitude = hourglass[a] / length;
            let radial = [gradient_r[a], gradient_y[a], hoop[a], amplitude];
            let axial = [gradient_r[a], gradient_y[a], amplitude];
            if masses[a] <= 0.0 {
                continue;
            }
            for (i, x) in radial.iter().enumerate().filter(|_| !on_axis[a]) {
                for (j, y) in radial.iter().enumerate() {
                    self.q[i][j][lane] += x * y / masses[a];
                }
            }
            for (i, x) in axial.iter().enumerate() {
                for (j, y) in axial.iter().enumerate() {
                    self.q[FIRST_AXIAL + i][FIRST_AXIAL + j][lane] += x * y / masses[a];
                }
            }
        }
    }
}

/// The metrics of all blocks.
#[derive(Debug, Clone)]
pub(super) struct Metrics(Vec<Metric>);

impl Metrics {
    /// Packs some integrated elements of a mesh with a density, kg/m³.
    pub fn pack(
        mesh: &SphereMesh,
        geometries: &[QuadGeometry],
        elements: &[usize],
        density: f64,
    ) -> Self {
        let mut metrics = vec![Metric::EMPTY; elements.len().div_ceil(WIDE)];
        let n_blocks = metrics.len();
        for (k, &element) in elements.iter().enumerate() {
            let geometry = &geometries[element];
            let masses = geometry.nodal_volumes.map(|volume| density * volume);
            let on_axis = mesh.corners(element).map(|corner| corner[0] == 0.0);
            let (place, lane) = place(k, n_blocks);
            metrics[place].put(lane, geometry, &masses, on_axis);
        }
        Self(metrics)
    }
}

/// Returns bounds of the largest eigenvalues (s⁻²) of undeformed elements.
pub(super) fn at_rest<W: Law>(law: &W, elements: &[LumpedElement]) -> Vec<f64> {
    let blocks = Blocks::pack_alone(elements.iter().map(|element| &element.geometry));
    let mut metrics = vec![Metric::EMPTY; elements.len().div_ceil(WIDE)];
    for (k, LumpedElement { geometry, masses, on_axis }) in elements.iter().enumerate() {
        metrics[k / WIDE].put(k % WIDE, geometry, masses, *on_axis);
    }
    let mut bounds = Vec::with_capacity(elements.len().next_multiple_of(WIDE));
    let undeformed = [[0.0; 2]; 4];
    let bound = Bound { blocks: &blocks, metrics: &metrics, law, u: &undeformed, history: &[] };
    run_wide_lanes(bound, &mut |_: &Block, _: &Metric, eigenvalues: &Numbers| {
        bounds.extend(eigenvalues);
    });
    bounds.truncate(elements.len());
    bounds
}

/// Adds the bounds λ_e m_e,i (N/m) of displaced elements at their nodes; without history nothing has relaxed.
pub(super) fn add_stiffness<W: Law>(
    (blocks, Metrics(metrics), law): (&Blocks, &Metrics, &W),
    u: &Field,
    history: &[NodalField],
    bound: &mut [f64],
) {
    let add = &mut |block: &Block, metric: &Metric, eigenvalues: &Numbers| {
        for lane in 0..WIDE {
            for a in 0..4 {
                let node = block.corners[a][lane] as usize;
                bound[node] += eigenvalues[lane] * metric.masses[a][lane];
            }
        }
    };
    run_wide_lanes(Bound { blocks, metrics, law, u, history }, add);
}

/// The loop over the eigenvalues of displaced elements. Its output is called for every block: the loop is long to compile,
/// and so exists once for all uses.
struct Bound<'a, W> {
    blocks: &'a Blocks,
    metrics: &'a [Metric],
    law: &'a W,
    u: &'a Field,
    history: &'a [NodalField],
}

impl<'a, W: Law> LaneKernel<WIDE> for Bound<'a, W> {
    type Output = dyn FnMut(&Block, &Metric, &Numbers) + 'a;

    #[inline(always)]
    fn on<L: Lanes<WIDE>>(self, output: &mut Self::Output) {
        let Self { blocks, metrics, law, u, history } = self;
        let mut internal = law.undeformed::<L>();
        let n_fields = if history.is_empty() { 0 } else { law.n_fields() };
        assert!(internal_variables::has_fields(history, n_fields, blocks.n_elements()));
        for (place, (block, metric)) in blocks.checked(&[u.len()]).iter().zip(metrics).enumerate() {
            if n_fields > 0 {
                law.load(&mut internal, history, blocks.slots(place));
            }
            // SAFETY: the field has been checked against the corner numbers.
            let strain = unsafe { Deformation::<L>::gather(block, u) };
            output(block, metric, &eigenvalues(&strain, block, metric, law, &internal));
        }
    }
}

/// Returns bounds of the largest eigenvalues, s⁻².
#[inline(always)]
fn eigenvalues<L: Lanes<WIDE>, W: Law>(
    strain: &Deformation<L>,
    block: &Block,
    metric: &Metric,
    law: &W,
    internal: &W::Internal<L>,
) -> [f64; WIDE] {
    let length = L::load(&metric.length);
    let step = L::splat(STRAIN_STEP);
    let per_step = L::splat(1.0 / STRAIN_STEP);
    let mut before = [L::splat(0.0); N_STRAINS];
    let mut product = [[L::splat(0.0); N_STRAINS]; N_STRAINS];
    // One call for the present strains and the moved ones, since it is inlined.
    for strain_number in 0..=N_STRAINS {
        let mut moved = *strain;
        match strain_number {
            0 => {}
            1 => moved.h.rr = moved.h.rr + step,
            2 => moved.h.ry = moved.h.ry + step,
            3 => moved.h.tt = moved.h.tt + step,
            4 => moved.q.0 = moved.q.0 + step * length,
            5 => moved.h.yr = moved.h.yr + step,
            6 => moved.h.yy = moved.h.yy + step,
            _ => moved.q.1 = moved.q.1 + step * length,
        }
        let after = in_order(&moved.conjugate(block, law, internal), length);
        let Some(k) = strain_number.checked_sub(1) else {
            before = after;
            continue;
        };
        // Row i of D Q takes column k of D with row k of Q, which has its own block alone.
        let own = if k < FIRST_AXIAL { 0..FIRST_AXIAL } else { FIRST_AXIAL..N_STRAINS };
        for i in 0..N_STRAINS {
            let slope = (after[i] - before[i]) * per_step;
            for j in own.clone() {
                product[i][j] = product[i][j].plus_product(slope, L::load(&metric.q[k][j]));
            }
        }
    }
    largest(product)
}

/// Returns the derivatives by the strains in their order, amplitudes over the length.
#[inline(always)]
fn in_order<L: Lanes<WIDE>>(conjugate: &Conjugate<L>, length: L) -> [L; N_STRAINS] {
    let Conjugate { stress, q } = conjugate;
    [stress.rr, stress.ry, stress.tt, q.0 * length, stress.yr, stress.yy, q.1 * length]
}

/// Returns (tr X¹⁶)^(1/16), lane by lane.
#[inline(always)]
fn largest<L: Lanes<WIDE>>(mut x: Square<L>) -> [f64; WIDE] {
    // Scaled so that the sixteenth power stays within the range of numbers.
    let size = trace_of_square(&x).to_array();
    let mut scale = [0.0; WIDE];
    for lane in 0..WIDE {
        scale[lane] = if size[lane] > 0.0 { size[lane].sqrt().recip() } else { 0.0 };
    }
    let factor = L::load(&scale);
    for row in &mut x {
        for entry in row {
            *entry = *entry * factor;
        }
    }
    for _ in 0..3 {
        x = square(&x);
    }
    let trace = trace_of_square(&x).to_array();
    let mut largest = [0.0; WIDE];
    for lane in 0..WIDE {
        let root = trace[lane].max(0.0).sqrt().sqrt().sqrt().sqrt();
        let own = root * size[lane].max(0.0).sqrt();
        // A value that is not a number has to stay so.
        largest[lane] = if size[lane].is_nan() { size[lane] } else { own };
    }
    largest
}

#[inline(always)]
fn square<L: Lanes<WIDE>>(x: &Square<L>) -> Square<L> {
    let mut squared = [[L::splat(0.0); N_STRAINS]; N_STRAINS];
    for i in 0..N_STRAINS {
        for k in 0..N_STRAINS {
            for j in 0..N_STRAINS {
                squared[i][j] = squared[i][j].plus_product(x[i][k], x[k][j]);
            }
        }
    }
    squared
}

#[inline(always)]
fn trace_of_square<L: Lanes<WIDE>>(x: &Square<L>) -> L {
    let mut sum = L::splat(0.0);
    for i in 0..N_STRAINS {
        for j in 0..N_STRAINS {
            sum = sum.plus_product(x[i][j], x[j][i]);
        }
    }
    sum
}
