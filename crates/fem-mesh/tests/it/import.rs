//! Imported meshes that are not spheres are rejected; the message names the node or element.

use fem_mesh::{HalfDisc, SphereMesh};

const RADIUS: f64 = 0.01;

type Mesh = (Vec<[f64; 2]>, Vec<[u32; 4]>);

fn sphere() -> Mesh {
    let (contact_element_size, refined_radius) = (2e-3, 4e-3);
    let (growth, edge) = (None, None);
    let disc = HalfDisc { radius: RADIUS, contact_element_size, refined_radius, growth, edge };
    let mesh = disc.build().unwrap();
    (mesh.nodes().to_vec(), mesh.quads().to_vec())
}

#[track_caller]
fn refusal(change: impl FnOnce(&mut Mesh)) -> String {
    let mut mesh = sphere();
    assert!(SphereMesh::import(RADIUS, mesh.0.clone(), mesh.1.clone()).is_ok());
    change(&mut mesh);
    SphereMesh::import(RADIUS, mesh.0, mesh.1).unwrap_err().to_string()
}

/// A node off the boundary, and an element that has it.
fn inner((nodes, quads): &Mesh) -> (u32, usize) {
    let is_inner = |k: u32| {
        let [r, y] = nodes[k as usize];
        r > 1e-4 && r.hypot(y - RADIUS) < 0.9 * RADIUS
    };
    let node = (0..nodes.len() as u32).find(|k| is_inner(*k)).unwrap();
    (node, quads.iter().position(|quad| quad.contains(&node)).unwrap())
}

#[test]
fn coincident_nodes_are_rejected_by_number() {
    let (node, _) = inner(&sphere());
    let n = sphere().0.len();
    let said = refusal(|mesh| {
        let (node, element) = inner(mesh);
        mesh.0.push(mesh.0[node as usize]);
        mesh.1[element].iter_mut().filter(|k| **k == node).for_each(|k| *k = n as u32);
    });
    assert!(said.contains(&format!("nodes {node} and {n} are at one place")), "{said}");
}

#[test]
fn second_body_is_rejected_with_a_node_number() {
    let n = sphere().0.len() as u32;
    let said = refusal(|(nodes, quads)| {
        nodes.extend(nodes.clone().iter().map(|[r, y]| [r + 0.05, *y]));
        quads.extend(quads.clone().iter().map(|quad| quad.map(|k| k + n)));
    });
    let named = said.rsplit_once("node ").unwrap().0;
    assert!(said.contains("is on another than node 0"), "{said}");
    let other: u32 =
        named.split("node ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!(other >= n, "{said}");
}

/// A corner beyond the diagonal: the winding is that of most of the element, its Jacobian at the corner is
/// not.
#[test]
fn inverted_element_is_rejected_by_number() {
    let (node, element) = inner(&sphere());
    let said = refusal(|(nodes, quads)| {
        let quad = quads[element];
        let k = quad.iter().position(|k| *k == node).unwrap();
        let [before, after] = [quad[(k + 3) % 4], quad[(k + 1) % 4]].map(|k| nodes[k as usize]);
        let at = &mut nodes[node as usize];
        *at = [0, 1].map(|x| at[x] + 1.3 * (0.5 * (before[x] + after[x]) - at[x]));
    });
    assert!(said.contains(&format!("element {element} is degenerate or inverted")), "{said}");
}

/// The first in the order of numbers, not of a map.
#[test]
fn import_error_of_a_mesh_is_reproducible() {
    let said = || refusal(|(_, quads)| quads.extend(quads.clone()));
    let first = said();
    assert!(first.contains("has two elements on the same side"), "{first}");
    assert!((0..20).all(|_| said() == first));
}
