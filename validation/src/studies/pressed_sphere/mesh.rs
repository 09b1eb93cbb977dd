//! A sphere's mesh that is symmetric about the equator and equally fine at both poles.

use fem_mesh::{MeshError, SphereMesh};

/// Corners of the inner block, in ζ: on the axis and on the diagonal.
const CORNERS: [f64; 2] = [0.5, 0.4];

/// Returns a unit sphere above its contact pole, with 6 m² elements.
///
/// The near half is the image of the quarter disc |ζ| ≤ 1 under z = 2ζ/(1 + ζ): a block of m × m cells
/// at the pole and m rings of 2m cells around it, out to the equator.
pub fn sphere(m: usize) -> Result<SphereMesh, MeshError> {
    let mut nodes = Vec::new();
    let mut number = |zeta: [f64; 2]| {
        nodes.push(image(zeta));
        (nodes.len() - 1) as u32
    };
    let at = |k: usize| k as f64 / m as f64;
    let block: Vec<Vec<u32>> =
        (0..=m).map(|i| (0..=m).map(|j| number(inner(at(i), at(j)))).collect()).collect();
    // Rows run from the axis to the surface, around the free sides of the block and each ring.
    let outline: Vec<u32> =
        (0..=m).map(|j| block[m][j]).chain((0..m).rev().map(|i| block[i][m])).collect();
    let station = |k: usize| if k <= m { inner(1.0, at(k)) } else { inner(at(2 * m - k), 1.0) };
    let mut rings = vec![outline];
    for ring in 1..=m {
        let stations = (0..=2 * m).map(|k| {
            let angle = std::f64::consts::FRAC_PI_4 * at(k);
            let (from, to) = (station(k), [angle.cos(), angle.sin()]);
            let share = at(ring);
            number(std::array::from_fn(|axis| (1.0 - share) * from[axis] + share * to[axis]))
        });
        rings.push(stations.collect());
    }
    let mut quads = Vec::new();
    for grid in [&block, &rings] {
        for pair in grid.windows(2) {
            for k in 0..pair[0].len() - 1 {
                quads.push([pair[0][k], pair[0][k + 1], pair[1][k + 1], pair[1][k]]);
            }
        }
    }
    mirror(&mut nodes, &mut quads, &rings[m]);
    SphereMesh::import(1.0, nodes, quads)
}

/// Returns the size of the elements at the poles.
pub fn contact_element_size(m: usize) -> f64 {
    2.0 * CORNERS[0] / m as f64
}

/// Returns ζ in the inner block, bilinear between its corners.
fn inner(s: f64, t: f64) -> [f64; 2] {
    let [side, diagonal] = CORNERS;
    let reach = |s: f64, t: f64| s * (side + (diagonal - side) * t);
    [reach(s, t), reach(t, s)]
}

/// Returns (r, y) of 2ζ/(1 + ζ).
fn image([x, y]: [f64; 2]) -> [f64; 2] {
    let square = (1.0 + x) * (1.0 + x) + y * y;
    [2.0 * y / square, 2.0 * (x * (1.0 + x) + y * y) / square]
}

/// Adds the far half, which has the nodes of the equator in common.
fn mirror(nodes: &mut Vec<[f64; 2]>, quads: &mut Vec<[u32; 4]>, equator: &[u32]) {
    let mut twin: Vec<u32> = (0..nodes.len() as u32).collect();
    for (node, twin) in twin.iter_mut().enumerate() {
        if !equator.contains(&(node as u32)) {
            let [r, y] = nodes[node];
            *twin = nodes.len() as u32;
            nodes.push([r, 2.0 - y]);
        }
    }
    let far: Vec<_> = quads.iter().map(|quad| quad.map(|node| twin[node as usize])).collect();
    quads.extend(far);
}
