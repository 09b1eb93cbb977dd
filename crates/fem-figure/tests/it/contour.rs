//! Contour bands of known fields cover the known areas for any choice of levels.

use fem_figure::contour::{Contour, Levels, Panel, Region, Section, Window};

/// The unit square in n × n skewed quads, with a field of (x, y).
fn square(n: usize, field: impl Fn([f64; 2]) -> f64) -> Section {
    let mut points = Vec::new();
    for j in 0..=n {
        for i in 0..=n {
            let [x, y] = [i, j].map(|k| k as f64 / n as f64);
            // Interior points are displaced; points of the outline stay on it.
            let shift = 0.1 * (3.1 * (i * 7 + j * 5) as f64).sin() / n as f64;
            let inside = |k: usize| if k.is_multiple_of(n) { 0.0 } else { shift };
            points.push([x + inside(i), y + inside(j)]);
        }
    }
    let at = |i: usize, j: usize| (j * (n + 1) + i) as u32;
    let quads = (0..n * n)
        .map(|k| (k % n, k / n))
        .map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
        .collect();
    let values = points.iter().map(|point| field(*point)).collect();
    let outline = (0..=n).map(|i| at(i, n)).collect();
    Section { points, values, quads, outline }
}

/// Rounding error of a few hundred sums of terms of order one.
const ROUNDING: f64 = 1e-13;

#[test]
fn bands_of_a_linear_field_have_exact_areas() {
    let section = square(7, |[x, _]| 2.0 * x - 1.0);
    for level in [-0.95, -0.5, -0.123, 0.0, 0.3, 0.9999] {
        let below = Region::at_most(&section, level).area();
        assert!((below - 0.5 * (level + 1.0)).abs() < ROUNDING, "{level} {below}");
        let above = Region::at_least(&section, level).area();
        assert!((above + below - 1.0).abs() < ROUNDING, "{level} {above}");
    }
    let section = square(5, |[x, y]| x + y);
    let area = Region::at_most(&section, 0.6).area() - Region::at_most(&section, 0.4).area();
    assert!((area - 0.5 * (0.36 - 0.16)).abs() < ROUNDING, "{area}");
    assert!((Region::at_least(&section, 1.7).area() - 0.045).abs() < ROUNDING);
}

#[test]
fn a_region_is_its_outline_without_inner_edges() {
    let section = square(6, |[x, _]| x);
    let whole = Region::at_most(&section, f64::INFINITY);
    assert_eq!((whole.loops.len(), whole.loops[0].len()), (1, 24));
    // A ring has a hole.
    let section = square(16, |[x, y]| (x - 0.5).hypot(y - 0.5));
    let ring = Region::at_least(&section, 0.3);
    assert_eq!(ring.loops.len(), 2);
    // Chords of a circle over sixteenths of the square.
    let hole = 1.0 - ring.area();
    assert!((hole / (std::f64::consts::PI * 0.09) - 1.0).abs() < 0.01, "{hole}");
}

#[test]
fn region_of_a_constant_field_is_whole_or_empty() {
    let section = square(4, |_| 0.7);
    for (level, inside) in [(0.69, 0.0), (0.7, 1.0), (0.71, 1.0)] {
        let area = Region::at_most(&section, level).area();
        assert!((area - inside).abs() < ROUNDING, "{level} {area}");
    }
    assert!((Region::at_least(&section, 0.7).area() - 1.0).abs() < ROUNDING);
    assert_eq!(Region::at_least(&section, 0.71).loops, Vec::<Vec<[f64; 2]>>::new());
}

#[test]
fn levels_on_nodes_leave_no_slivers() {
    // Values are multiples of 1/4, exact in binary, on a straight mesh.
    let mut section = square(4, |_| 0.0);
    for (k, point) in section.points.iter_mut().enumerate() {
        *point = [(k % 5) as f64 / 4.0, (k / 5) as f64 / 4.0];
        section.values[k] = point[0];
    }
    for k in 0..=4 {
        let level = k as f64 / 4.0;
        let below = Region::at_most(&section, level);
        assert_eq!(below.area(), level);
        assert_eq!(below.loops.len(), usize::from(k > 0));
    }
}

#[test]
fn points_without_a_value_are_left_out() {
    let mut section = square(4, |[x, _]| x);
    section.values[0] = f64::NAN;
    let corner = Region::at_most(&section, f64::INFINITY).area();
    assert!(corner < 0.95 && corner > 0.9, "{corner}");
    assert_eq!(section.range().map(|range| range.1), Some(1.0));
    section.values.fill(f64::INFINITY);
    assert_eq!(section.range(), None);
}

#[test]
fn a_mirror_image_doubles_the_area_without_a_seam() {
    let section = square(5, |[x, y]| x + y).mirrored();
    let whole = Region::at_most(&section, f64::INFINITY);
    assert!((whole.area() - 2.0).abs() < ROUNDING);
    assert_eq!(whole.loops.len(), 1);
    let ends = [section.outline[0], section.outline[section.outline.len() - 1]];
    assert_eq!(ends.map(|point| section.points[point as usize]), [[-1.0, 1.0], [1.0, 1.0]]);
    assert_eq!(section.outline.len(), 11);
}

#[test]
fn the_picture_has_bands_numbers_and_outlines() {
    let section = square(8, |[x, y]| -x * y).mirrored();
    let contour = Contour {
        quantity: "stress <GPa>".into(),
        x_label: "r [mm]".into(),
        y_label: "y [mm]".into(),
        window: Window { x: (-1.0, 1.0), y: (0.0, 1.0) },
        levels: Levels::about_zero(-1.0, 0.0, 5),
        panels: vec![Panel { title: "(a)".into(), sections: vec![section], ..Panel::default() }],
    };
    let svg = contour.svg();
    assert_eq!(svg, contour.svg());
    // Four bands below the neutral one, which is drawn as well, and one outline.
    assert_eq!(svg.matches("<path fill=\"#").count(), 5);
    assert_eq!(svg.matches("fill=\"none\" stroke=").count(), 2);
    for expected in ["stress &lt;GPa&gt;", "\u{2212}0.8", "r [mm]", "(a)"] {
        assert!(svg.contains(expected), "{expected}");
    }
    // A long heading widens the picture.
    let wide = Contour { quantity: "plastic strain [%]".into(), ..contour };
    assert!(svg.contains("width=\"598\"") && wide.svg().contains("width=\"643\""));
}

/// A region that touches the axis forms one polygon with its mirror image, a hole stays one, and a region
/// away from the axis forms two.
#[test]
fn a_half_region_and_its_image_have_no_seam() {
    let half = square(16, |[x, y]| x.hypot(y - 0.5));
    let disc = Region::at_most(&half, 0.3).mirrored();
    assert_eq!(disc.loops.len(), 1);
    assert!((disc.area() - 2.0 * Region::at_most(&half, 0.3).area()).abs() < ROUNDING);
    let around = Region::at_least(&half, 0.3);
    let ring = around.mirrored();
    assert_eq!((around.loops.len(), ring.loops.len()), (1, 2));
    assert!((ring.area() - 2.0 * around.area()).abs() < ROUNDING);
    let aside = Region::at_least(&half, 0.9);
    assert_eq!(aside.mirrored().loops.len(), 2 * aside.loops.len());
    // It equals the region of the section together with its image.
    let whole = Region::at_most(&half.mirrored(), 0.3);
    assert!((disc.area() - whole.area()).abs() < ROUNDING);
}

/// One frame drawn from the half section equals that frame of the picture with all panels.
#[test]
fn frames_have_classes_for_a_page_to_restyle() {
    let half = square(8, |[x, y]| 0.3 * y - x * y);
    let panel = |title: &str| Panel {
        title: title.into(),
        sections: vec![half.clone()],
        ..Panel::default()
    };
    let contour = Contour {
        quantity: "σ_yy [GPa]".into(),
        x_label: "r [mm]".into(),
        y_label: "y [mm]".into(),
        window: Window { x: (-1.0, 1.0), y: (0.0, 1.0) },
        levels: Levels::about_zero(-0.7, 0.3, 5),
        panels: vec![panel("one"), panel("two")],
    };
    let frames = contour.frames();
    assert_eq!(frames.len(), 2);
    assert!(frames[0].contains("<title>one</title>") && frames[1].contains("<title>two</title>"));
    for frame in &frames {
        for class in ["b0", "n1", "n3", "p1"] {
            assert!(frame.contains(&format!("class=\"{class}\" fill=\"#")), "{class}");
        }
        // The frame has no identifiers, which two pictures on one page could share.
        assert!(!frame.contains(" id=") && frame.matches("<svg").count() == 2);
    }
    let (bar, rules) = (contour.bar(), contour.dark_rules());
    let n_bands = contour.levels.edges().len() - 1;
    assert_eq!(
        (bar.matches("<rect").count(), rules.matches("{fill:#").count()),
        (n_bands, n_bands)
    );
}
