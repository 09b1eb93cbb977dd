//! Meshes offset by half an element: at the edge of the contact the nodes of one body lie between those of the other.
//!
//! The contact force of linear elements oscillates with the place of the contact's edge between two nodes, with the period
//! of one element and an amplitude of about (3/8)(h/a)²: a body is too stiff with the edge at a node, and too compliant
//! with the edge between nodes. Two meshes that are half an element apart at the edge,
//!
//! ```math
//! h_\pm = \frac{a}{a/h \pm \tfrac14},
//! ```
//!
//! oscillate against each other: over all phases at a/h = 4 to 5, the amplitude falls from 1.0 to 0.14 % of the force
//! (docs/contact.md). This needs springs at points of both surfaces. Bodies whose nodes touch exactly follow one of the
//! meshes, and identical bodies are computed as one: their meshes are not staggered.

use fem_case::{Body, CondensedOptions, ModelChoice, Scene, Shape};

/// Elements across the contact by which each mesh differs from the mean.
const OFFSET_OF_EACH_MESH: f64 = 0.25;

/// Returns the body with the smaller elements if the meshes of the scene are staggered.
pub(crate) fn finer_body(scene: &Scene) -> Option<usize> {
    // An element size of the case is kept.
    let is_open = scene.mesh().contact_element_size.is_none();
    if scene.mesh().staggered.unwrap_or(is_open) { smaller(scene) } else { None }
}

/// Returns the smaller body, whose mesh has fewer rings, or the softer one of two of equal size; `None` if the meshes
/// cannot be staggered.
fn smaller(scene: &Scene) -> Option<usize> {
    let between_points = match scene.model() {
        ModelChoice::Fem => true,
        ModelChoice::Condensed(CondensedOptions { penalty_springs, .. }) => *penalty_springs,
        _ => false,
    };
    if !between_points || !scene.bodies().iter().all(is_generated) {
        return None;
    }
    let radii = scene.bodies().each_ref().map(|body| body.diameter().unwrap_or(f64::INFINITY));
    let shares = scene.compliance_shares();
    let order = radii[0].total_cmp(&radii[1]).then(shares[1].total_cmp(&shares[0]));
    match order {
        std::cmp::Ordering::Less => Some(0),
        std::cmp::Ordering::Equal => None,
        std::cmp::Ordering::Greater => Some(1),
    }
}

/// Returns whether the mesh of a body is generated, and not read from a file.
pub(super) fn is_generated(body: &Body) -> bool {
    matches!(
        body.shape(),
        Shape::Sphere { mesh: None, .. } | Shape::HalfSpace { .. } | Shape::Plate { .. }
    )
}

/// Returns the element sizes of both bodies (m) for a mean size in a contact of this radius (m); the body `finer` has the
/// smaller ones.
pub(crate) fn staggered(length: f64, contact_radius: f64, finer: usize) -> [f64; 2] {
    let across = contact_radius / length;
    [0, 1].map(|side| {
        let more = if side == finer { OFFSET_OF_EACH_MESH } else { -OFFSET_OF_EACH_MESH };
        contact_radius / (across + more)
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use fem_case::Case;

    use super::*;

    const GLASS: &str = include_str!("../../../../cases/glass_0.5ms_elastic.toml");

    fn finer(set: &[&str]) -> Option<usize> {
        let set: Vec<String> = set.iter().map(ToString::to_string).collect();
        let case = Case::parse("glass.toml", GLASS, Path::new("."), &set).unwrap();
        finer_body(case.scene())
    }

    /// At the edge of the contact the nodes of one mesh lie midway between those of the other.
    #[test]
    fn nodes_are_half_an_element_apart_at_the_edge() {
        for across in [3.5, 4.0, 8.3] {
            for finer in [0, 1] {
                let lengths = staggered(1.0 / across, 1.0, finer);
                let counts = lengths.map(|length| 1.0 / length);
                assert!((counts[finer] - counts[1 - finer] - 0.5).abs() < 1e-12);
                assert!((0.5 * (counts[0] + counts[1]) - across).abs() < 1e-12);
            }
        }
    }

    /// The smaller body has the smaller elements, or the softer one of two of equal size, in any order. Meshes are not
    /// staggered with one mesh, with nodes that touch exactly, or with a given element size.
    #[test]
    fn the_smaller_body_has_the_smaller_elements() {
        let swapped = ["body.0.sphere.diameter='1 cm'", "body.1.sphere.diameter='2 cm'"];
        let like = ["body.0.sphere.diameter='1 cm'", "body.1.sphere.diameter='1 cm'"];
        let soft = "material.soft={ density=2390, youngs_modulus='6 GPa', poissons_ratio=0.3 }";
        let block = "body.0={ name = 'striker', half_space = {}, material = 'glass' }";
        let size = "mesh.contact_element_size='50 um'";
        for (set, expected) in [
            (&[][..], Some(1)),
            (&swapped, Some(0)),
            (&like, None),
            (&[like[0], like[1], soft, "body.0.material='soft'"], Some(0)),
            (&[block, "body.1.approach_speed=1"], Some(1)),
            (&["body.0={ name = 'striker', wall = {} }", "body.1.approach_speed=1"], None),
            (&["model.condensed={}"], None),
            (&["model.condensed.penalty_springs=true"], Some(1)),
            (&[size], None),
            (&[size, "mesh.staggered=true"], Some(1)),
            (&["mesh.staggered=false"], None),
        ] {
            assert_eq!(finer(set), expected, "{set:?}");
        }
    }
}
