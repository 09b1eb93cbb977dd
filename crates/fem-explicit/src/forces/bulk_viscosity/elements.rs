//! The element loop of bulk viscosity.

use fem_element::QuadGeometry;

use crate::part::Field;
use crate::stress::lanes::{LANES, LaneKernel, Lanes, run_lanes};

/// One number of each element of a block.
type Numbers = [f64; LANES];

/// Four elements. The dilatation of unit displacements, 1/m, is scaled by the root of the volume, so
/// that it makes a rate of ε̇_V √V and forces of a pressure of that scale; along y it sums to zero over
/// the corners, and velocities are taken relative to corner 3.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
struct Block {
    corners: [[u32; LANES]; 4],
    radial: [Numbers; 4],
    axial: [Numbers; 3],
    /// ρ l, kg/m².
    inertia: Numbers,
    /// l/√V, m^(−1/2): from that rate to a drop of velocity.
    length: Numbers,
}

/// The elements of a body. Every corner number is below `n_nodes`, which lets the loop index without a
/// check.
pub(super) struct Elements {
    blocks: Vec<Block>,
    n_nodes: usize,
    /// b₁ c_d, m/s.
    linear_speed: f64,
    /// b₂².
    quadratic: f64,
    /// j_max, m/s.
    largest_drop: f64,
}

impl Elements {
    /// Room for so many, still without viscosity; `speeds` are b₁ c_d (m/s) and b₂².
    pub fn new(n_nodes: usize, n_elements: usize, speeds: [f64; 2], largest_drop: f64) -> Self {
        let empty = Block {
            corners: [[0; LANES]; 4],
            radial: [[0.0; LANES]; 4],
            axial: [[0.0; LANES]; 3],
            inertia: [0.0; LANES],
            length: [0.0; LANES],
        };
        let blocks = vec![empty; n_elements.div_ceil(LANES)];
        let [linear_speed, quadratic] = speeds;
        Self { blocks, n_nodes, linear_speed, quadratic, largest_drop }
    }

    /// Puts one of those in, of ρ l (kg/m²) and l (m). Lane k takes the k-th stretch of the elements,
    /// as those of the stress do.
    pub fn put(
        &mut self,
        element: usize,
        quad: &[u32; 4],
        geometry: &QuadGeometry,
        [inertia, length]: [f64; 2],
    ) {
        assert!(
            quad.iter().all(|&node| (node as usize) < self.n_nodes),
            "an element names a node that the mesh does not have"
        );
        let (place, lane) = (element % self.blocks.len(), element / self.blocks.len());
        let (block, scale) = (&mut self.blocks[place], geometry.volume.sqrt());
        for a in 0..4 {
            block.corners[a][lane] = quad[a];
            block.radial[a][lane] = scale * (geometry.gradient_r[a] + geometry.hoop[a]);
        }
        for a in 0..3 {
            block.axial[a][lane] = scale * geometry.gradient_y[a];
        }
        block.inertia[lane] = inertia;
        block.length[lane] = length / scale;
    }

    /// Subtracts the forces (N) of velocities (m/s) from `f`.
    pub fn subtract_forces(&self, velocity: &Field, f: &mut Field) {
        assert!(velocity.len() >= self.n_nodes && f.len() >= self.n_nodes);
        run_lanes(Forces { elements: self, velocity }, f);
    }
}

struct Forces<'a> {
    elements: &'a Elements,
    velocity: &'a Field,
}

impl LaneKernel for Forces<'_> {
    type Output = Field;

    #[inline(always)]
    fn on<L: Lanes>(self, f: &mut Field) {
        let Self { elements, velocity } = self;
        subtract_forces::<L>(elements, velocity, f);
    }
}

#[inline(always)]
pub(super) fn subtract_forces<L: Lanes>(elements: &Elements, velocity: &Field, f: &mut Field) {
    let zero = L::splat(0.0);
    let linear_speed = L::splat(elements.linear_speed);
    let quadratic = L::splat(elements.quadratic);
    let largest_drop = L::splat(elements.largest_drop);
    for block in &elements.blocks {
        // SAFETY: fields are at least as long as the nodes that the corners were checked against.
        let ((r0, y0), (r1, y1), (r2, y2), (r3, y3)) = unsafe {
            (
                L::gather(velocity, &block.corners[0]),
                L::gather(velocity, &block.corners[1]),
                L::gather(velocity, &block.corners[2]),
                L::gather(velocity, &block.corners[3]),
            )
        };
        let [b0, b1] = [L::load(&block.radial[0]), L::load(&block.radial[1])];
        let [b2, b3] = [L::load(&block.radial[2]), L::load(&block.radial[3])];
        let [a0, a1, a2] =
            [L::load(&block.axial[0]), L::load(&block.axial[1]), L::load(&block.axial[2])];
        let rate = ((b0 * r0 + b1 * r1) + (b2 * r2 + b3 * r3))
            + (a0 * (y0 - y3) + a1 * (y1 - y3) + a2 * (y2 - y3));
        let drop = (zero - L::load(&block.length) * rate).max(zero).min(largest_drop);
        let tension = L::load(&block.inertia) * (linear_speed + quadratic * drop) * rate;
        let (f0, f1, f2) = (a0 * tension, a1 * tension, a2 * tension);
        // SAFETY: as above.
        unsafe {
            (b0 * tension).scatter_subtract(f0, f, &block.corners[0]);
            (b1 * tension).scatter_subtract(f1, f, &block.corners[1]);
            (b2 * tension).scatter_subtract(f2, f, &block.corners[2]);
            (b3 * tension).scatter_subtract(zero - (f0 + f1 + f2), f, &block.corners[3]);
        }
    }
}
