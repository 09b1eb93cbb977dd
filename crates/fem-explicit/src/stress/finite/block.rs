//! Undeformed elements in blocks of lanes, as the loops of finite strain read them.

use std::ops::Range;

use fem_element::QuadGeometry;
use fem_material::finite::AxisymmetricTensor;
use fem_mesh::SphereMesh;

use super::super::traits::Collapse;
use crate::lanes::{Lanes, WIDE};
use crate::part::Field;

/// One number for each element of a block.
pub(super) type Numbers = [f64; WIDE];

/// Geometry of the elements of a block.
///
/// Gradients and hourglass shapes sum to zero over the corners, so those of corner 3 are left out and
/// displacements are taken relative to it: a rigid translation gives exactly no force.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub(super) struct Block {
    pub corners: [[u32; WIDE]; 4],
    /// Derivatives of the shape functions by r, 1/m.
    pub gradient_r: [Numbers; 3],
    /// Derivatives of the shape functions by y, 1/m.
    pub gradient_y: [Numbers; 3],
    /// Hoop strain per radial displacement, 1/m.
    pub hoop: [Numbers; 4],
    pub hourglass: [Numbers; 3],
    /// Measures of the hourglass shape at unit amplitude: rr, yy, ry, m.
    pub measures: [Numbers; 3],
    /// Volume of each element, m³.
    pub volume: Numbers,
}

impl Block {
    /// Elements without volume, deformation and force.
    pub const EMPTY: Self = Self {
        corners: [[0; WIDE]; 4],
        gradient_r: [[0.0; WIDE]; 3],
        gradient_y: [[0.0; WIDE]; 3],
        hoop: [[0.0; WIDE]; 4],
        hourglass: [[0.0; WIDE]; 3],
        measures: [[0.0; WIDE]; 3],
        volume: [0.0; WIDE],
    };

    /// Puts an element of these corners into a lane.
    pub fn put(&mut self, lane: usize, corners: &[u32; 4], geometry: &QuadGeometry) {
        for a in 0..4 {
            self.corners[a][lane] = corners[a];
            self.hoop[a][lane] = geometry.hoop[a];
        }
        for a in 0..3 {
            self.gradient_r[a][lane] = geometry.gradient_r[a];
            self.gradient_y[a][lane] = geometry.gradient_y[a];
            self.hourglass[a][lane] = geometry.hourglass[a];
            // The amplitude γ·u is four times that of the field ξη.
            self.measures[a][lane] = geometry.hourglass_measures[a] / 16.0;
        }
        self.volume[lane] = geometry.volume;
    }
}

/// Places of a block in the fields of elements, which have one pair per element: the first place, and the number of
/// places. For a block without empty lanes a field holds the first numbers of all lanes, then the second ones; for
/// other blocks it holds one pair after the other.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slots {
    pub first: usize,
    pub n_lanes: usize,
}

impl Slots {
    /// Loads the pairs of the lanes; zero in empty lanes.
    #[inline(always)]
    pub fn load<L: Lanes<WIDE>>(self, field: &Field) -> (L, L) {
        let own = &field[self.first..self.first + self.n_lanes];
        if let ([first, second], _) = own.as_flattened().as_chunks() {
            return (L::load(first), L::load(second));
        }
        let mut both = [[0.0; WIDE]; 2];
        for (lane, pair) in own.iter().enumerate() {
            (both[0][lane], both[1][lane]) = (pair[0], pair[1]);
        }
        (L::load(&both[0]), L::load(&both[1]))
    }

    /// Stores the pairs of the lanes.
    #[inline(always)]
    pub fn store<L: Lanes<WIDE>>(self, field: &mut Field, first: L, second: L) {
        let own = &mut field[self.first..self.first + self.n_lanes];
        let both = [first.to_array(), second.to_array()];
        if let (chunks @ [_, _], _) = own.as_flattened_mut().as_chunks_mut() {
            chunks.copy_from_slice(&both);
            return;
        }
        for (lane, pair) in own.iter_mut().enumerate() {
            *pair = [both[0][lane], both[1][lane]];
        }
    }

    /// Returns the pair of a lane.
    pub fn pair(self, lane: usize, field: &Field) -> [f64; 2] {
        let own = &field[self.first..self.first + self.n_lanes];
        match own.as_flattened().as_chunks::<WIDE>() {
            ([first, second], _) => [first[lane], second[lane]],
            _ => own[lane],
        }
    }
}

/// The elements of a body at finite strain. Every corner number is below `n_nodes`, so that loops index without a
/// check.
#[derive(Debug, Clone)]
pub(super) struct Blocks {
    blocks: Vec<Block>,
    n_nodes: usize,
    n_elements: usize,
    /// Range from the lowest to the highest corner number.
    nodes: Range<usize>,
}

impl Blocks {
    /// Packs some integrated elements of a mesh; lane l takes the l-th part of them.
    pub fn pack(mesh: &SphereMesh, geometries: &[QuadGeometry], elements: &[usize]) -> Self {
        let n_nodes = mesh.nodes().len();
        assert!(
            mesh.quads().iter().flatten().all(|&node| (node as usize) < n_nodes),
            "an element names a node that the mesh does not have"
        );
        let n_elements = elements.len();
        let mut blocks = vec![Block::EMPTY; n_elements.div_ceil(WIDE)];
        for (k, &element) in elements.iter().enumerate() {
            let (place, lane) = place(k, blocks.len());
            blocks[place].put(lane, &mesh.quads()[element], &geometries[element]);
        }
        let corners = || elements.iter().flat_map(|&element| mesh.quads()[element]);
        let [first, last] = [corners().min(), corners().max()];
        let nodes = first.map_or(0, |k| k as usize)..last.map_or(0, |k| k as usize + 1);
        Self { blocks, n_nodes, n_elements, nodes }
    }

    /// Packs elements that share no nodes: each has the corners 0 to 3, and eight that follow each other are a block.
    pub fn pack_alone<'a>(geometries: impl ExactSizeIterator<Item = &'a QuadGeometry>) -> Self {
        let n_elements = geometries.len();
        let mut blocks = vec![Block::EMPTY; n_elements.div_ceil(WIDE)];
        for (k, geometry) in geometries.enumerate() {
            blocks[k / WIDE].put(k % WIDE, &[0, 1, 2, 3], geometry);
        }
        Self { blocks, n_nodes: 4, n_elements, nodes: 0..4 }
    }

    /// Returns the number of elements.
    pub fn n_elements(&self) -> usize {
        self.n_elements
    }

    /// Returns the range of nodes in which all corners lie: a small part of all nodes if the elements are near first
    /// touch and nodes are numbered from there.
    pub fn nodes(&self) -> Range<usize> {
        self.nodes.clone()
    }

    /// Returns the blocks, after a check that nodal fields are long enough for them.
    #[inline(always)]
    pub fn checked(&self, field_lengths: &[usize]) -> &[Block] {
        assert!(field_lengths.iter().all(|&length| length >= self.n_nodes));
        &self.blocks
    }

    /// Returns the places of a block in the fields of elements.
    #[inline(always)]
    pub fn slots(&self, place: usize) -> Slots {
        let n_blocks = self.blocks.len();
        // The first blocks have an element in the last lane.
        let n_full = (self.n_elements + n_blocks).saturating_sub(WIDE * n_blocks);
        if place < n_full {
            return Slots { first: WIDE * place, n_lanes: WIDE };
        }
        let n_lanes = |place: usize| (self.n_elements - place).div_ceil(n_blocks);
        let first = WIDE * n_full + (n_full..place).map(n_lanes).sum::<usize>();
        Slots { first, n_lanes: n_lanes(place) }
    }

    /// Returns slots and lane of an element.
    pub fn slot(&self, element: usize) -> (Slots, usize) {
        let (place, lane) = place(element, self.blocks.len());
        (self.slots(place), lane)
    }

    /// Returns the mean displacement gradient of an element.
    pub fn gradient(&self, element: usize, u: &Field) -> AxisymmetricTensor {
        let (place, lane) = place(element, self.blocks.len());
        let block = &self.blocks[place];
        let at = |a: usize| u[block.corners[a][lane] as usize];
        let mut h = AxisymmetricTensor { tt: block.hoop[3][lane] * at(3)[0], ..Default::default() };
        for a in 0..3 {
            let (r, y) = (block.gradient_r[a][lane], block.gradient_y[a][lane]);
            let (du_r, du_y) = (at(a)[0] - at(3)[0], at(a)[1] - at(3)[1]);
            h.rr += r * du_r;
            h.ry += y * du_r;
            h.yr += r * du_y;
            h.yy += y * du_y;
            h.tt += block.hoop[a][lane] * at(a)[0];
        }
        h
    }

    /// Returns the most compressed element, or one whose displacement is not a number.
    pub fn most_compressed(&self, u: &Field) -> Collapse {
        let mut most = Collapse { element: 0, volume_ratio: f64::INFINITY };
        for element in 0..self.n_elements {
            let h = self.gradient(element, u);
            let jacobian = 1.0 + h.volume_change();
            // Beyond the axis, hoop and meridian are both inverted.
            let volume_ratio = if h.tt <= -1.0 { -jacobian.abs() } else { jacobian };
            if volume_ratio < most.volume_ratio || volume_ratio.is_nan() {
                most = Collapse { element, volume_ratio };
            }
        }
        most
    }
}

/// Returns block and lane of an element: lane l takes the l-th part of the elements.
pub(super) fn place(element: usize, n_blocks: usize) -> (usize, usize) {
    (element % n_blocks, element / n_blocks)
}

// Closures and `map` would be compiled without the instruction set of the kernel that they stand in, so
// numbers are loaded one by one.
#[inline(always)]
pub(super) fn load_three<L: Lanes<WIDE>>(values: &[Numbers; 3]) -> [L; 3] {
    [L::load(&values[0]), L::load(&values[1]), L::load(&values[2])]
}
