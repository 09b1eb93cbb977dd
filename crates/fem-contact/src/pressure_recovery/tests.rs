use super::edge::contact_radius;
use super::*;

const SIZE: f64 = 0.1;

/// Means over the hats of nodes at multiples of SIZE of a profile p(x), x = r², by a fine sum.
fn hat_means(profile: impl Fn(f64) -> f64, n: usize) -> Vec<(f64, f64)> {
    let mean = |k: usize| {
        let at = k as f64 * SIZE;
        let (mut force, mut area) = (0.0, 0.0);
        for i in 0..4000 {
            let r = at + SIZE * ((i as f64 + 0.5) / 2000.0 - 1.0);
            let weight = (1.0 - (r - at).abs() / SIZE) * r;
            if r > 0.0 {
                force += weight * profile(r * r);
                area += weight;
            }
        }
        (at, force / area)
    };
    (0..n).map(mean).collect()
}

/// The area, mean and variance of x of the hat function on the axis, 2π∫(1 − r)r: π/3, 3/10 and 1/5 − 9/100 h⁴; a hat
/// between two lengths has the areas that its force is divided by.
#[test]
fn hats_have_their_moments() {
    let axis =
        NodalMean { radius: 0.0, neighbours: [None, Some(1.0)], pressure: 1.0 }.hat_moments();
    let close = |a: f64, b: f64| (a - b).abs() < 1e-14;
    assert!(close(axis.area, PI / 3.0) && close(axis.square, 0.3));
    assert!(close(axis.variance, 1.0 / 7.0 - 0.09), "{}", axis.variance);
    let between = NodalMean { radius: 1.0, neighbours: [Some(0.5), Some(1.75)], pressure: 1.0 };
    let area = [0.5, 1.75].map(|from| fem_mesh::segment_measures([from, 0.0], [1.0, 0.0])[1]);
    assert!(close(between.hat_moments().area, area[0] + area[1]));
    assert_eq!(
        NodalMean { radius: 1.0, neighbours: [None; 2], pressure: 1.0 }.hat_moments().area,
        0.0
    );
}

/// Hertz' profile and one that relaxation has flattened, p = (1 − x)^½ (1 + x/2), without what elements do to
/// them: the pressure comes back but for the constants, whose part is taken off here.
#[test]
fn centre_pressure_is_recovered_from_exact_means() {
    for (flat, tolerance) in [(0.0, 2e-4), (0.5, 3e-3)] {
        let radius = 10.3 * SIZE;
        let profile = |x: f64| {
            let x = x / (radius * radius);
            if x < 1.0 { (1.0 - x).sqrt() * (1.0 + flat * x) } else { 0.0 }
        };
        let nodes = hat_means(profile, 13);
        let coarseness = SIZE / radius;
        // Pressures that elements have lowered near the axis as the reading assumes.
        let lowered = nodes.iter().zip([0.27, 0.085, 0.030, 0.012, 0.005]);
        let lowered: Vec<_> =
            lowered.map(|((r, p), layer)| (*r, p * (1.0 - layer * coarseness))).collect();
        let nodes = lowered.into_iter().chain(nodes.into_iter().skip(5));
        let rigid = centre_pressure(nodes.clone(), radius, ContactEnforcement::Rigid);
        let expected = 1.0 - 0.15 * coarseness * coarseness;
        assert!((rigid / expected - 1.0).abs() < tolerance, "{flat}: {rigid} {expected}");
        let soft = centre_pressure(nodes, radius, ContactEnforcement::Springs);
        assert!((soft - rigid - 0.022 * coarseness * rigid).abs() < 1e-3 * coarseness);
    }
}

/// With one or two nodes no profile is fitted: the pressure is that of the axis node, corrected.
#[test]
fn centre_pressure_of_few_nodes_is_that_of_the_axis_node() {
    let nodes = [(0.0, 2.0), (SIZE, 0.0), (2.0 * SIZE, 0.0)].into_iter();
    let radius = contact_radius(nodes.clone(), ContactEnforcement::Rigid);
    assert_eq!(radius, 0.5 * SIZE);
    let own = centre_pressure(nodes.clone(), radius, ContactEnforcement::Rigid);
    assert!((own - 2.0 / (1.0 - 0.5 * 0.27) * (1.0 - 0.15 * 0.25)).abs() < 1e-12, "{own}");
    let open = nodes.map(|(r, _)| (r, 0.0));
    assert_eq!(contact_radius(open.clone(), ContactEnforcement::Springs), 0.0);
    assert_eq!(centre_pressure(open, 0.0, ContactEnforcement::Springs), 0.0);
    assert_eq!(contact_radius(std::iter::empty(), ContactEnforcement::Springs), 0.0);
}

/// Nodes of an ellipse that ends at a radius, the outermost with a ratio to the one before; `steeper` times as
/// large a fall inside of it.
fn ending(ratio: f64, radius: f64, steeper: f64) -> Vec<(f64, f64)> {
    let place = |k: usize| k as f64 * SIZE;
    let square = |k: usize| {
        let neighbours = [k.checked_sub(1).map(place), Some(place(k + 1))];
        NodalMean { radius: place(k), neighbours, pressure: 0.0 }.hat_moments().square
    };
    let mut nodes: Vec<_> =
        (0..8).map(|k| (place(k), (radius * radius - square(k)).max(0.0).sqrt())).collect();
    nodes[6].1 *= steeper;
    nodes[7].1 = ratio * nodes[6].1;
    nodes.extend([(place(8), 0.0), (place(9), 0.0)]);
    nodes
}

/// At the ratios of the table, with a fall inside as the table has it, the edge is where it says.
#[test]
fn contact_radius_equals_the_tabulated_edge_offset() {
    for (ratio, springs, rigid, fall) in [
        (0.08, -0.274, -0.230, -0.018),
        (0.25, -0.053, -0.024, -0.0225),
        (0.6, 0.608, 0.573, 0.0075),
    ] {
        for (enforcement, offset) in
            [(ContactEnforcement::Springs, springs), (ContactEnforcement::Rigid, rigid)]
        {
            let radius = (7.0 + offset) * SIZE;
            let nodes = ending(ratio, radius, 1.0 + fall);
            let found = contact_radius(nodes.into_iter(), enforcement);
            assert!((found - radius).abs() < 1e-12, "{ratio} {enforcement:?}: {found} {radius}");
        }
    }
    // A node that has just entered the contact is ignored.
    let mut nodes = ending(0.5, 7.382 * SIZE, 1.0 - 0.0025);
    nodes[8].1 = 0.07 * nodes[7].1;
    let found = contact_radius(nodes.into_iter(), ContactEnforcement::Springs);
    assert!((found - 7.382 * SIZE).abs() < 1e-12, "{found}");
}

/// Pressure that falls less steeply inside than an ellipse's ends nearer, as that of bodies that relax does;
/// by no more than half an element.
#[test]
fn contact_radius_shrinks_for_a_flatter_profile() {
    let at = |steeper: f64| {
        let nodes = ending(0.5, 7.382 * SIZE, (1.0 - 0.0025) * steeper);
        contact_radius(nodes.into_iter(), ContactEnforcement::Springs) / SIZE
    };
    assert!((at(1.0) - 7.382).abs() < 1e-12);
    // 2.3 · 0.5 elements a unit.
    assert!((at(1.05) - (7.382 - 1.15 * 0.9975 * 0.05)).abs() < 1e-12, "{}", at(1.05));
    assert!(at(0.95) > 7.43 && (at(3.0) - 6.882).abs() < 1e-12);
}
