//! The element loops of bulk viscosity: one adds up rates of dilatation at nodes, one makes forces of what is
//! left of them apart from their means.

use fem_element::QuadGeometry;

use crate::lanes::{LANES, LaneKernel, Lanes, run_lanes};
use crate::part::Field;

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
    /// √V, m^(3/2): from a dilatation rate to that rate.
    root_volume: Numbers,
}

/// The elements of a body. Every corner number is below `n_nodes`, which lets the loop index without a
/// check.
pub(super) struct ViscousElements {
    blocks: Vec<Block>,
    n_nodes: usize,
    /// For each node, a quarter of 1/Σ ρ l V (m²/kg) of its elements.
    shares: Vec<f64>,
    /// b₁ c_d, m/s.
    linear_speed: f64,
    /// Quadratic coefficient b₂².
    quadratic: f64,
    /// Cap j_max of the velocity drop, m/s.
    largest_drop: f64,
}

impl ViscousElements {
    /// Creates space for `n` elements, still without viscosity; `speeds` are b₁ c_d (m/s) and b₂².
    pub fn new(n_nodes: usize, n_elements: usize, speeds: [f64; 2], largest_drop: f64) -> Self {
        let empty = Block {
            corners: [[0; LANES]; 4],
            radial: [[0.0; LANES]; 4],
            axial: [[0.0; LANES]; 3],
            inertia: [0.0; LANES],
            length: [0.0; LANES],
            root_volume: [0.0; LANES],
        };
        let blocks = vec![empty; n_elements.div_ceil(LANES)];
        let [linear_speed, quadratic] = speeds;
        let shares = vec![0.0; n_nodes];
        Self { blocks, n_nodes, shares, linear_speed, quadratic, largest_drop }
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
        block.root_volume[lane] = scale;
        for &node in quad {
            let share = &mut self.shares[node as usize];
            let weight = if *share == 0.0 { 0.0 } else { 0.25 / *share };
            *share = 0.25 / (weight + inertia * geometry.volume);
        }
    }

    /// Subtracts the forces (N) of velocities (m/s) from `f`; `means` is room for a pair a node.
    pub fn subtract_forces(&self, velocity: &Field, means: &mut Field, f: &mut Field) {
        assert!(velocity.len() >= self.n_nodes && f.len() >= self.n_nodes);
        assert!(means.len() >= self.n_nodes);
        means.fill([0.0; 2]);
        run_lanes(Sums { elements: self, velocity }, means);
        for (mean, share) in means.iter_mut().zip(&self.shares) {
            mean[0] *= share;
        }
        run_lanes(Forces { elements: self, velocity, means }, f);
    }
}

/// Adds up at each node the dilatation rates of its elements times their ρ l V.
struct Sums<'a> {
    elements: &'a ViscousElements,
    velocity: &'a Field,
}

impl LaneKernel for Sums<'_> {
    type Output = Field;

    #[inline(always)]
    fn on<L: Lanes>(self, means: &mut Field) {
        add_rates::<L>(self.elements, self.velocity, means);
    }
}

#[inline(always)]
pub(super) fn add_rates<L: Lanes>(elements: &ViscousElements, velocity: &Field, means: &mut Field) {
    let zero = L::splat(0.0);
    for block in &elements.blocks {
        let weight = L::load(&block.inertia) * L::load(&block.root_volume);
        // SAFETY: fields are at least as long as the nodes that the corners were checked against.
        let sum = unsafe { block.rate::<L>(velocity) } * (zero - weight);
        for corners in &block.corners {
            // SAFETY: as above.
            unsafe { sum.scatter_subtract(zero, means, corners) };
        }
    }
}

struct Forces<'a> {
    elements: &'a ViscousElements,
    velocity: &'a Field,
    means: &'a Field,
}

impl LaneKernel for Forces<'_> {
    type Output = Field;

    #[inline(always)]
    fn on<L: Lanes>(self, f: &mut Field) {
        let Self { elements, velocity, means } = self;
        subtract_forces::<L>(elements, velocity, means, f);
    }
}

#[inline(always)]
pub(super) fn subtract_forces<L: Lanes>(
    elements: &ViscousElements,
    velocity: &Field,
    means: &Field,
    f: &mut Field,
) {
    let zero = L::splat(0.0);
    let linear_speed = L::splat(elements.linear_speed);
    let quadratic = L::splat(elements.quadratic);
    let largest_drop = L::splat(elements.largest_drop);
    for block in &elements.blocks {
        // SAFETY: fields are at least as long as the nodes that the corners were checked against.
        let (rate, around) = unsafe { (block.rate::<L>(velocity), block.around::<L>(means)) };
        let uneven = rate - L::load(&block.root_volume) * around;
        let drop = (zero - L::load(&block.length) * rate).max(zero).min(largest_drop);
        let viscous = linear_speed * uneven + quadratic * drop * rate;
        let tension = L::load(&block.inertia) * viscous;
        let [b0, b1] = [L::load(&block.radial[0]), L::load(&block.radial[1])];
        let [b2, b3] = [L::load(&block.radial[2]), L::load(&block.radial[3])];
        let [a0, a1, a2] =
            [L::load(&block.axial[0]), L::load(&block.axial[1]), L::load(&block.axial[2])];
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

impl Block {
    /// Returns the dilatation rates times √V.
    ///
    /// # Safety
    /// Every corner is an index of `velocity`.
    #[inline(always)]
    unsafe fn rate<L: Lanes>(&self, velocity: &Field) -> L {
        // SAFETY: the caller's promise.
        let [(r0, y0), (r1, y1), (r2, y2), (r3, y3)] = unsafe { self.gathered::<L>(velocity) };
        let [b0, b1] = [L::load(&self.radial[0]), L::load(&self.radial[1])];
        let [b2, b3] = [L::load(&self.radial[2]), L::load(&self.radial[3])];
        let [a0, a1, a2] =
            [L::load(&self.axial[0]), L::load(&self.axial[1]), L::load(&self.axial[2])];
        ((b0 * r0 + b1 * r1) + (b2 * r2 + b3 * r3))
            + (a0 * (y0 - y3) + a1 * (y1 - y3) + a2 * (y2 - y3))
    }

    /// Returns the mean of the values at four corners.
    ///
    /// # Safety
    /// Every corner is an index of `means`.
    #[inline(always)]
    unsafe fn around<L: Lanes>(&self, means: &Field) -> L {
        // SAFETY: the caller's promise.
        let [(m0, _), (m1, _), (m2, _), (m3, _)] = unsafe { self.gathered::<L>(means) };
        (m0 + m1) + (m2 + m3)
    }

    /// Returns the values of a field at the four corners. Not by a closure, which would be compiled without the
    /// instructions of the lanes.
    ///
    /// # Safety
    /// Every corner is an index of `field`.
    #[inline(always)]
    unsafe fn gathered<L: Lanes>(&self, field: &Field) -> [(L, L); 4] {
        let [a, b, c, d] = &self.corners;
        // SAFETY: the caller's promise.
        unsafe {
            [L::gather(field, a), L::gather(field, b), L::gather(field, c), L::gather(field, d)]
        }
    }
}
