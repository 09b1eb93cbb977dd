//! The graded half disc: geometry, grading, volume, extremes of size.

use fem_mesh::{HalfDisc, Quality, Side, SphereMesh, cap_volume, segment_measures, sphere_volume};

use crate::meshed_volume;

fn glass(size: f64) -> HalfDisc {
    HalfDisc {
        radius: 11.1e-3,
        contact_element_size: size,
        refined_radius: 0.3e-3,
        growth: None,
        edge: None,
    }
}

/// Volume of the quads and of the caps over their chords, over that of the sphere.
fn volume_with_caps(mesh: &SphereMesh) -> f64 {
    let cap = |pair: &[u32]| {
        let [p, q] = [pair[0], pair[1]].map(|node| mesh.nodes()[node as usize]);
        cap_volume(p, q, mesh.radius())
    };
    let caps: f64 = mesh.surface().windows(2).map(cap).sum();
    (meshed_volume(mesh) + caps) / sphere_volume(mesh.radius())
}

fn assert_on_arc(mesh: &SphereMesh) {
    for &node in mesh.surface() {
        let [r, y] = mesh.nodes()[node as usize];
        // Rounding of a few operations on numbers of the radius' size.
        assert!((r.hypot(y - mesh.radius()) / mesh.radius() - 1.0).abs() < 1e-14);
    }
}

#[test]
fn boundary_nodes_lie_on_the_true_arc_and_the_axis() {
    let mesh = glass(30e-6).build().unwrap();
    let radius = mesh.radius();
    assert_on_arc(&mesh);
    assert!(mesh.axis().iter().all(|&node| mesh.nodes()[node as usize][0] == 0.0));
    let n_axis = mesh.nodes().iter().filter(|p| p[0] == 0.0).count();
    assert_eq!(n_axis, mesh.axis().len());
    assert_eq!(mesh.nodes()[mesh.surface()[0] as usize], [0.0, 0.0]);
    let far_pole = mesh.nodes()[*mesh.surface().last().unwrap() as usize];
    assert!((far_pole[1] / (2.0 * radius) - 1.0).abs() < 1e-14);
}

#[test]
fn elements_at_the_contact_have_the_size_asked_for() {
    let mesh = glass(30e-6).build().unwrap();
    let r = |k: usize| mesh.nodes()[mesh.surface()[k] as usize][0];
    // The map stretches by 1/(1 + η²): 2e-4 over the block of ten cells.
    for k in 0..10 {
        assert!(((r(k + 1) - r(k)) / 30e-6 - 1.0).abs() < 1e-3);
    }
    assert_eq!(mesh.quads().len(), glass(30e-6).n_elements().unwrap());
}

#[test]
fn cells_keep_their_shape_and_grow_slowly() {
    for size in [60e-6, 30e-6, 15e-6] {
        let quality = Quality::of(&glass(size).build().unwrap());
        // sin 60° = 0.87 at best: the three cells that meet at a block's free corner share 360°.
        assert!(quality.min_scaled_jacobian > 0.82, "{quality:?}");
        assert!(quality.max_aspect_ratio < 1.6, "{quality:?}");
    }
}

#[test]
fn quads_and_caps_make_the_exact_sphere() {
    for side in [Side::Above, Side::Below] {
        let mesh = glass(60e-6).build().unwrap().on_side(side);
        assert_eq!(mesh.side(), side);
        let exact = sphere_volume(mesh.radius());
        assert!(meshed_volume(&mesh) < exact * 0.9999, "the chords cut nothing off");
        // Rounding of a sum over the elements.
        assert!((volume_with_caps(&mesh) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn surface_measures_sum_to_the_lateral_area() {
    // Cone from r = 1 to r = 3 with slant √(4 + 9): area π (1 + 3) √13.
    let [inner, outer] = segment_measures([1.0, 0.0], [3.0, 3.0]);
    let area = std::f64::consts::PI * 4.0 * 13f64.sqrt();
    assert!(((inner + outer) / area - 1.0).abs() < 1e-15);
    // A disc's centre node takes π h²/3, not the quarter share π h²/4.
    let [centre, rim] = segment_measures([0.0, 0.0], [1.0, 0.0]);
    assert!((centre * 3.0 / std::f64::consts::PI - 1.0).abs() < 1e-15);
    assert!((rim / centre - 2.0).abs() < 1e-15);
}

#[test]
fn sphere_meshes_of_all_sizes_have_good_quality() {
    for radius in [0.5e-6_f64, 1e-3, 5.0, 1e6] {
        for fraction in [0.25, 0.05, 1e-3, 1e-7] {
            let size = radius * fraction;
            let refined_radius = (12.0 * size).min(radius / 2.0);
            // The map shrinks cells away from the pole by up to (1 + 1/4)².
            assert_quality(radius, size, refined_radius, [3.0, 0.35]);
        }
    }
    // A block for a contact as wide as the sphere.
    for share in [0.5, 0.7, 0.9, 1.0_f64] {
        for n in [2.0, 8.0, 25.0] {
            let size = (share * 1e-2 / n).min(1e-2 / 4.0);
            // The map shrinks cells away from the pole by up to (1 + 1/2)², those of the far block more.
            assert_quality(1e-2, size, share * 1e-2, [4.0, 0.1]);
        }
    }
}

/// Asserts that a mesh has no larger aspect ratio and, over the element size, no shorter edge than these.
#[track_caller]
fn assert_quality(radius: f64, size: f64, refined_radius: f64, [aspect, edge]: [f64; 2]) {
    let disc = HalfDisc { radius, refined_radius, ..glass(size) };
    let quality = Quality::of(&disc.build().unwrap());
    assert!(quality.min_scaled_jacobian > 0.5, "{disc:?} {quality:?}");
    assert!(quality.max_aspect_ratio < aspect, "{disc:?} {quality:?}");
    assert!(quality.min_edge / size > edge, "{disc:?} {quality:?}");
}

/// Twice as many columns, of which those at the edge are the narrowest, and the same exact sphere.
#[test]
fn columns_are_narrow_at_the_edge_of_a_contact() {
    // Elements are sheared where the shift fades, the more the nearer the edge is to the end of the columns; the plan has
    // 0.83. The smallest Jacobian is 0.36.
    for (share, least) in [(0.5, 0.5), (0.83, 0.45), (0.99, 0.35)] {
        let disc = HalfDisc { edge: Some(share * 0.3e-3), ..glass(30e-6) };
        let mesh = disc.build().unwrap();
        assert_eq!(mesh.quads().len(), disc.n_elements().unwrap());
        let place = |k: usize| mesh.nodes()[mesh.surface()[k] as usize];
        let widths: Vec<f64> = (0..20).map(|k| place(k + 1)[0] - place(k)[0]).collect();
        // 1 + A and 1 columns per length.
        let [narrowest, widest] =
            [f64::min, f64::max].map(|of| widths.iter().copied().reduce(of).unwrap());
        assert!((2.7..3.1).contains(&(widest / narrowest)), "{share}: {widths:?}");
        let at = widths.iter().position(|width| *width == narrowest).unwrap();
        assert!((place(at)[0] / (share * 0.3e-3) - 1.0).abs() < 0.1, "{share}: {widths:?}");
        assert_on_arc(&mesh);
        assert!((volume_with_caps(&mesh) - 1.0).abs() < 1e-12);
        let quality = Quality::of(&mesh);
        assert!(quality.min_scaled_jacobian > least, "{share}: {quality:?}");
        // Rows 3.3 times as high as columns are wide on average, times 2.7 at the edge.
        assert!(quality.max_aspect_ratio < 10.0, "{share}: {quality:?}");
    }
    // A contact as wide as half of the sphere keeps even columns.
    let wide =
        HalfDisc { refined_radius: 6e-3, edge: Some(5e-3), ..glass(0.6e-3) }.build().unwrap();
    assert!(Quality::of(&wide).min_scaled_jacobian > 0.5);
}

#[test]
fn faster_growth_takes_fewer_elements() {
    let growth = |growth| HalfDisc { growth, ..glass(30e-6) }.n_elements().unwrap();
    assert!(growth(Some(1.2)) < growth(None));
    assert!(growth(Some(1.05)) > growth(None));
}

#[test]
fn impossible_parameters_are_refused() {
    let sphere = glass(30e-6);
    for (disc, expected) in [
        (HalfDisc { radius: -1.0, ..sphere }, "Length"),
        (HalfDisc { radius: f64::NAN, ..sphere }, "Length"),
        (glass(0.0), "Length"),
        (glass(3e-3), "ElementSize"),
        (HalfDisc { refined_radius: 11.2e-3, ..sphere }, "RefinedRadius"),
        (HalfDisc { growth: Some(1.0), ..sphere }, "Growth"),
        (glass(1e-12), "TooLarge"),
    ] {
        let error = format!("{:?}", disc.build().unwrap_err());
        assert!(error.starts_with(expected), "{disc:?}: {error} is no {expected}");
    }
}

#[test]
fn an_exported_mesh_comes_back_the_same() {
    for side in [Side::Above, Side::Below] {
        let mesh = glass(60e-6).build().unwrap().on_side(side);
        let imported =
            SphereMesh::import(mesh.radius(), mesh.nodes().to_vec(), mesh.quads().to_vec())
                .unwrap();
        assert_eq!(imported, mesh);
    }
}

#[test]
fn imported_meshes_are_repaired_or_rejected() {
    let mesh = glass(60e-6).build().unwrap();
    let (nodes, quads) = (mesh.nodes().to_vec(), mesh.quads().to_vec());
    let import = |nodes: &[[f64; 2]], quads: &[[u32; 4]]| {
        SphereMesh::import(mesh.radius(), nodes.to_vec(), quads.to_vec())
    };

    let rounded: Vec<_> = nodes.iter().map(|p| p.map(|x| f64::from(x as f32))).collect();
    let clockwise: Vec<_> = quads.iter().map(|&[a, b, c, d]| [d, c, b, a]).collect();
    let repaired = import(&rounded, &clockwise).unwrap();
    assert_eq!(repaired.surface(), mesh.surface());
    assert_on_arc(&repaired);

    // Nodes of no element: the centre of an arc before all others, and one at the place of another.
    let centre = [[0.0, mesh.radius()]];
    let loose = [&centre[..], &nodes, &nodes[..1]].concat();
    let renumbered: Vec<_> = quads.iter().map(|quad| quad.map(|k| k + 1)).collect();
    assert_eq!(import(&loose, &renumbered).unwrap(), mesh);

    let check = |nodes: &[[f64; 2]], quads: &[[u32; 4]], words: &str| {
        let message = import(nodes, quads).unwrap_err().to_string();
        assert!(message.contains(words), "{message} lacks {words}");
    };
    check(&nodes, &[], "no quadrilaterals");
    check(&nodes, &quads[..10], "long along the axis");
    check(&nodes[..10], &quads, "the mesh has 10 nodes");
    let shifted: Vec<_> = nodes.iter().map(|p| [p[0], p[1] + 1e-3]).collect();
    check(&shifted, &quads, "contact pole must be at y = 0");
    let scaled: Vec<_> = nodes.iter().map(|p| p.map(|x| 1.01 * x)).collect();
    check(&scaled, &quads, "the sphere's diameter");
    let mut dented = nodes.clone();
    dented[mesh.surface()[20] as usize][0] *= 0.99;
    check(&dented, &quads, "from the sphere's centre");
    let mut inverted = nodes.clone();
    inverted[(quads[0][2]) as usize] = [25e-6, 25e-6];
    check(&inverted, &quads, "degenerate or inverted");
    let mut not_finite = nodes.clone();
    not_finite[7][1] = f64::NAN;
    check(&not_finite, &quads, "node 7");
    let mut doubled = quads.clone();
    doubled.push(quads[3]);
    check(&nodes, &doubled, "two elements on the same side");
}
