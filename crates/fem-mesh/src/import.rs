//! A sphere's mesh from foreign nodes and quads.

use std::collections::{HashMap, HashSet};

use fem_material::engineering::show;

use crate::error::MeshError;
use crate::quality::Quality;
use crate::sphere_mesh::SphereMesh;

/// Tolerance of the distance of a boundary node from the true circle or the axis, as a fraction of
/// the radius: files often store single precision.
const POSITION_TOLERANCE: f64 = 2e-6;

impl SphereMesh {
    /// Takes nodes (r, y) in m and quads as the meridian of a sphere of the
    /// given radius: contact pole at the origin, body above or below.
    ///
    /// Quads may wind either way. Nodes within single precision of the axis or
    /// the surface are moved onto them. Nodes that no element uses, such as the
    /// centres of arcs, are left out.
    ///
    /// # Errors
    /// Node numbers out of range, inverted or degenerate elements, a boundary
    /// that is not one closed curve made of the axis and the circle of the given
    /// radius through the origin.
    pub fn import(
        radius: f64,
        mut nodes: Vec<[f64; 2]>,
        mut quads: Vec<[u32; 4]>,
    ) -> Result<Self, MeshError> {
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(MeshError::Length { name: "radius", value: radius });
        }
        leave_out_unused(&mut nodes, &mut quads)?;
        orient(&nodes, &mut quads);
        if let Some([first, second]) = at_one_place(&nodes) {
            return Err(MeshError::Import(format!(
                "nodes {first} and {second} are at one place; elements that touch have their nodes in common"
            )));
        }
        let boundary = boundary_loop(nodes.len(), &quads)?;
        let tolerance = POSITION_TOLERANCE * radius;
        let centre = centre_of(&nodes, &boundary, radius, tolerance)?;
        let (axis, surface) = split_boundary(&mut nodes, boundary, radius, centre, tolerance)?;
        let quality = Quality::of_quads(&nodes, &quads);
        if quality.min_scaled_jacobian <= 1e-3 {
            return Err(MeshError::Import(format!(
                "element {} is degenerate or inverted (scaled Jacobian {:.3e}); at least 0.001 is needed",
                quality.worst_element, quality.min_scaled_jacobian
            )));
        }
        Ok(Self::from_parts(radius, nodes, quads, axis, surface, Vec::new()))
    }
}

/// Leaves out the nodes that no quad uses, and renumbers the others in their order.
fn leave_out_unused(nodes: &mut Vec<[f64; 2]>, quads: &mut [[u32; 4]]) -> Result<(), MeshError> {
    if quads.is_empty() {
        return Err(MeshError::Import("the mesh has no quadrilaterals".into()));
    }
    if let Some(node) = nodes.iter().position(|p| !(p[0].is_finite() && p[1].is_finite())) {
        return Err(MeshError::Import(format!("node {node} is not at a finite position")));
    }
    let mut numbers = vec![u32::MAX; nodes.len()];
    for (element, quad) in quads.iter().enumerate() {
        for &node in quad {
            *numbers.get_mut(node as usize).ok_or_else(|| {
                let n_nodes = nodes.len();
                MeshError::Import(format!(
                    "element {element} names node {node}; the mesh has {n_nodes} nodes"
                ))
            })? = 0;
        }
    }
    let used = numbers.iter_mut().filter(|number| **number == 0);
    used.zip(0..).for_each(|(number, k)| *number = k);
    let mut number = numbers.iter();
    nodes.retain(|_| number.next().is_some_and(|number| *number != u32::MAX));
    quads.iter_mut().flatten().for_each(|node| *node = numbers[*node as usize]);
    Ok(())
}

/// Turns every quad counter-clockwise.
fn orient(nodes: &[[f64; 2]], quads: &mut [[u32; 4]]) {
    for quad in quads {
        let [a, b, c, d] = quad.map(|node| nodes[node as usize]);
        let twice_area = (c[0] - a[0]) * (d[1] - b[1]) - (d[0] - b[0]) * (c[1] - a[1]);
        if twice_area < 0.0 {
            quad.reverse();
        }
    }
}

/// Returns the nodes of the one closed boundary curve, in order, counter-clockwise.
fn boundary_loop(n_nodes: usize, quads: &[[u32; 4]]) -> Result<Vec<u32>, MeshError> {
    let mut edges: HashMap<(u32, u32), usize> = HashMap::new();
    for quad in quads {
        for a in 0..4 {
            *edges.entry((quad[a], quad[(a + 1) % 4])).or_default() += 1;
        }
    }
    // The first edge, for any order of the map.
    let twice = edges.iter().filter(|(_, count)| **count > 1).map(|(edge, _)| edge).min();
    if let Some((a, b)) = twice {
        return Err(MeshError::Import(format!(
            "the edge between nodes {a} and {b} has two elements on the same side"
        )));
    }
    let mut next = vec![u32::MAX; n_nodes];
    let mut n_edges = 0;
    let mut start = u32::MAX;
    for &(a, b) in edges.keys() {
        if !edges.contains_key(&(b, a)) {
            if next[a as usize] != u32::MAX {
                return Err(MeshError::Import(format!("the boundary passes node {a} twice")));
            }
            next[a as usize] = b;
            n_edges += 1;
            start = start.min(a);
        }
    }
    let mut nodes = Vec::with_capacity(n_edges);
    let mut node = start;
    while nodes.len() < n_edges && node != u32::MAX {
        nodes.push(node);
        node = next[node as usize];
        if node == start {
            break;
        }
    }
    if nodes.len() == n_edges && node == start && n_edges > 0 {
        return Ok(nodes);
    }
    let on_it: HashSet<u32> = nodes.into_iter().collect();
    let other = (0..n_nodes as u32).find(|k| next[*k as usize] != u32::MAX && !on_it.contains(k));
    Err(MeshError::Import(match other {
        Some(other) => format!(
            "the boundary is not one closed curve: node {other} is on another than node {start}"
        ),
        None => "the boundary is not one closed curve".into(),
    }))
}

/// Returns two nodes at the same place, to the bit.
fn at_one_place(nodes: &[[f64; 2]]) -> Option<[usize; 2]> {
    let mut known = HashMap::new();
    nodes.iter().enumerate().find_map(|(k, &[r, y])| {
        // −0 is 0.
        let place = [r + 0.0, y + 0.0].map(f64::to_bits);
        known.insert(place, k).map(|first| [first, k])
    })
}

/// Returns the centre's y, found from the extent of the boundary.
fn centre_of(
    nodes: &[[f64; 2]],
    boundary: &[u32],
    radius: f64,
    tolerance: f64,
) -> Result<f64, MeshError> {
    let y = boundary.iter().map(|&node| nodes[node as usize][1]);
    let (low, high) = y.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), y| (l.min(y), h.max(y)));
    if (high - low - 2.0 * radius).abs() > 2.0 * tolerance {
        return Err(MeshError::Import(format!(
            "the mesh is {} long along the axis; the sphere's diameter is {}",
            show(high - low, "m"),
            show(2.0 * radius, "m")
        )));
    }
    if low.abs() <= tolerance {
        Ok(radius)
    } else if high.abs() <= tolerance {
        Ok(-radius)
    } else {
        Err(MeshError::Import(format!(
            "the mesh lies between y = {} and y = {}; its contact pole must be at y = 0",
            show(low, "m"),
            show(high, "m")
        )))
    }
}

/// Returns axis and surface, each from the contact pole to the far pole.
fn split_boundary(
    nodes: &mut [[f64; 2]],
    mut boundary: Vec<u32>,
    radius: f64,
    centre: f64,
    tolerance: f64,
) -> Result<(Vec<u32>, Vec<u32>), MeshError> {
    let pole = |boundary: &[u32], y: f64, name: &str| {
        let is_pole = |&node: &u32| {
            let [r, at] = nodes[node as usize];
            r.abs() <= tolerance && (at - y).abs() <= tolerance
        };
        let message =
            || MeshError::Import(format!("no boundary node lies at the {name} pole (0, {y})"));
        boundary.iter().position(is_pole).ok_or_else(message)
    };
    let contact_pole = pole(&boundary, 0.0, "contact")?;
    boundary.rotate_left(contact_pole);
    // Counter-clockwise from the contact pole: a body above runs along the
    // surface first, one below along the axis first.
    if centre < 0.0 {
        boundary[1..].reverse();
    }
    let far_pole = pole(&boundary, 2.0 * centre, "far")?;
    let surface = boundary[..=far_pole].to_vec();
    let mut axis = vec![boundary[0]];
    axis.extend(boundary[far_pole..].iter().rev());
    for &node in &surface {
        let p = &mut nodes[node as usize];
        let distance = p[0].hypot(p[1] - centre);
        if (distance - radius).abs() > tolerance || p[0] < -tolerance {
            return Err(MeshError::Import(format!(
                "surface node {node} lies {} from the sphere's centre (0, {centre}); its radius is {}",
                show(distance, "m"),
                show(radius, "m")
            )));
        }
        let scale = radius / distance;
        if (scale - 1.0).abs() > 4.0 * f64::EPSILON {
            *p = [p[0] * scale, centre + (p[1] - centre) * scale];
        }
    }
    for &node in &axis {
        let p = &mut nodes[node as usize];
        if p[0].abs() > tolerance {
            return Err(MeshError::Import(format!(
                "boundary node {node} at ({}, {}) lies neither on the axis nor on the surface",
                p[0], p[1]
            )));
        }
        p[0] = 0.0;
    }
    if let Some(node) = nodes.iter().position(|p| p[0] < 0.0) {
        return Err(MeshError::Import(format!(
            "node {node} has a negative r, {}",
            show(nodes[node][0], "m")
        )));
    }
    let n_axis = nodes.iter().filter(|p| p[0] == 0.0).count();
    if n_axis != axis.len() {
        return Err(MeshError::Import("a node inside of the mesh lies on the axis".into()));
    }
    Ok((axis, surface))
}
