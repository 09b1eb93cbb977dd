//! Elements in rows, as in the meshes of `fem-mesh` and in any mesh whose nodes are numbered row by row.
//!
//! If an element has the corners k, k + 1, k + s + 1 and k + s, the next one in its row has the corners from k + 1 on:
//! the corners of eight elements are four times eight neighbours in memory. The slot between the last element of a row
//! and the first one of the next row is an element without stiffness. So all rows of one length s form one stretch, and
//! only these slots are idle.

use std::collections::HashMap;
use std::ops::Range;

use fem_element::QuadGeometry;

use super::elements::Shape;
use crate::lanes::{ROW_PLACES, WIDE};

/// Largest number of slots without an element within a stretch.
const LONGEST_GAP: usize = 4;

/// Elements of consecutive first corners.
#[derive(Debug, Clone)]
pub(crate) struct Stretch {
    /// First corner of the first element.
    pub first: usize,
    /// Distance in node numbers to the neighbour in the next row.
    pub stride: usize,
    /// Shapes of its eights.
    shapes: Range<usize>,
}

/// Elements of a body that lie in rows. All node numbers of a stretch are below `n_nodes`, so that kernels index
/// without a check.
#[derive(Debug, Clone)]
pub(crate) struct Rows {
    stretches: Vec<Stretch>,
    shapes: Vec<Shape<WIDE>>,
    n_nodes: usize,
}

/// An element in a row: its number, and the corners that are k, k + 1, k + s + 1 and k + s.
struct Placed {
    element: usize,
    corners: [usize; 4],
}

impl Rows {
    /// Packs the integrated elements that lie in stretches of eight or more; quads are on nodes with numbers below
    /// `n_nodes`. Returns also the numbers of the other elements.
    pub fn pack(
        n_nodes: usize,
        quads: &[[u32; 4]],
        geometries: &[QuadGeometry],
    ) -> (Self, Vec<usize>) {
        let mut of_stride: HashMap<usize, Vec<(usize, Placed)>> = HashMap::new();
        let mut others = Vec::new();
        for (element, quad) in quads.iter().enumerate() {
            match in_row(quad) {
                Some((first, stride, corners)) => {
                    let placed = (first, Placed { element, corners });
                    of_stride.entry(stride).or_default().push(placed);
                }
                None => others.push(element),
            }
        }
        let mut of_stride: Vec<_> = of_stride.into_iter().collect();
        of_stride.sort_by_key(|(stride, _)| *stride);
        let mut rows = Self { stretches: Vec::new(), shapes: Vec::new(), n_nodes };
        for (stride, mut elements) in of_stride {
            elements.sort_by_key(|(first, _)| *first);
            let is_near = |one: &(usize, Placed), next: &(usize, Placed)| {
                (1..=LONGEST_GAP).contains(&(next.0 - one.0))
            };
            for stretch in elements.chunk_by(is_near) {
                let (Some((first, _)), Some((last, _))) = (stretch.first(), stretch.last()) else {
                    continue;
                };
                if last - first + 1 < WIDE || last + stride + 1 >= n_nodes {
                    others.extend(stretch.iter().map(|(_, placed)| placed.element));
                    continue;
                }
                // Whole eights from the first element on, and one eight that ends with the last element.
                let end = last + 1;
                let whole = first + (end - first) / WIDE * WIDE;
                let part = |range: Range<usize>| move |(k, _): &&(usize, Placed)| range.contains(k);
                rows.push(
                    *first..whole,
                    stride,
                    stretch.iter().filter(part(*first..whole)),
                    geometries,
                );
                if whole < end {
                    let rest = stretch.iter().filter(part(whole..end));
                    rows.push(end - WIDE..end, stride, rest, geometries);
                }
            }
        }
        others.sort_unstable();
        (rows, others)
    }

    /// Adds a stretch of whole eights.
    fn push<'a>(
        &mut self,
        slots: Range<usize>,
        stride: usize,
        elements: impl Iterator<Item = &'a (usize, Placed)>,
        geometries: &[QuadGeometry],
    ) {
        let before = self.shapes.len();
        let n_shapes = slots.len() / WIDE;
        self.shapes.resize(before + n_shapes, Shape::EMPTY);
        for (first, Placed { element, corners }) in elements {
            let (shape, place) = ((first - slots.start) / WIDE, (first - slots.start) % WIDE);
            let lane = ROW_PLACES.into_iter().position(|at| at == place).unwrap_or_default();
            self.shapes[before + shape].put(lane, &geometries[*element], *corners);
        }
        let shapes = before..before + n_shapes;
        self.stretches.push(Stretch { first: slots.start, stride, shapes });
    }

    /// Returns the number of slots in the loop, idle lanes included.
    #[cfg(test)]
    pub fn n_slots(&self) -> usize {
        WIDE * self.shapes.len()
    }

    /// Returns the stretches with the shapes of their eights, after a check that nodal fields are long enough.
    #[inline(always)]
    pub fn checked(
        &self,
        field_lengths: &[usize],
    ) -> impl Iterator<Item = (&Stretch, &[Shape<WIDE>])> {
        assert!(field_lengths.iter().all(|&length| length >= self.n_nodes));
        self.stretches.iter().map(|stretch| (stretch, &self.shapes[stretch.shapes.clone()]))
    }
}

/// Returns first corner k, stride s and the corners that are k, k + 1, k + s + 1 and k + s, if a quad has such corners.
fn in_row(quad: &[u32; 4]) -> Option<(usize, usize, [usize; 4])> {
    let mut order = [0, 1, 2, 3];
    order.sort_by_key(|&corner| quad[corner]);
    let [a, b, c, d] = order.map(|corner| quad[corner] as usize);
    let stride = c - a;
    (b == a + 1 && d == c + 1 && stride > 1)
        .then(|| (a, stride, [order[0], order[1], order[3], order[2]]))
}

#[cfg(test)]
mod tests {
    use fem_mesh::{Side, SphereMesh};

    use super::*;
    use crate::test_support::{geometries, sphere};

    fn packed(mesh: &SphereMesh) -> (Rows, Vec<usize>) {
        Rows::pack(mesh.nodes().len(), mesh.quads(), &geometries(mesh))
    }

    /// The cost of a step: blocks and rings lie in rows, except the halves of the first and of the last ring along the
    /// nodes of a block that are not neighbours.
    #[test]
    fn built_in_meshes_are_packed_into_element_rows() {
        for m in [3, 5, 10, 20] {
            let mesh = sphere(0.1 / m as f64, 0.1, Side::Above);
            let (rows, others) = packed(&mesh);
            let n = mesh.quads().len();
            // Fewer than eight elements are no stretch.
            let too_short = if m < WIDE { m } else { 0 };
            assert_eq!(others.len(), 2 * m + too_short, "{m}");
            // A slot without an element behind each row, and an eight of each stretch that is not full.
            let most = (n as f64 * (1.0 + 1.2 / m as f64)) as usize + 4 * WIDE;
            assert!((n - others.len()..most).contains(&rows.n_slots()), "{m}: {}", rows.n_slots());
        }
    }

    /// Corners may be listed from any corner on, in both directions.
    #[test]
    fn the_corners_of_an_element_in_a_row_are_found() {
        for turn in 0..4 {
            let mut quad = [5, 6, 17, 16];
            quad.rotate_left(turn);
            for quad in [quad, {
                quad.reverse();
                quad
            }] {
                let (first, stride, corners) = in_row(&quad).unwrap();
                assert_eq!((first, stride), (5, 11));
                assert_eq!(corners.map(|corner| quad[corner]), [5, 6, 17, 16]);
            }
        }
        assert_eq!(in_row(&[5, 7, 17, 16]), None);
        assert_eq!(in_row(&[5, 6, 8, 7]).map(|(first, stride, _)| (first, stride)), Some((5, 2)));
    }

    /// The last nodes are not the first of an eight that would read beyond them.
    #[test]
    fn element_rows_read_no_nodes_beyond_the_mesh() {
        let mesh = sphere(0.02, 0.1, Side::Below);
        let (rows, _) = packed(&mesh);
        let n = mesh.nodes().len();
        for (stretch, shapes) in rows.checked(&[n]) {
            assert!(stretch.first + WIDE * shapes.len() + stretch.stride < n);
        }
    }
}
