//! Tests the charts for pages: their content, and what they leave to the style sheet of the page.

use fem_figure::{Axis, Chart, Curve, GREY, panel};

/// A half sine of a thousand points.
fn pulse(amplitude: f64) -> Vec<(f64, f64)> {
    let at = |k: u32| {
        (f64::from(k) / 16.0, amplitude * (std::f64::consts::PI * f64::from(k) / 1000.0).sin())
    };
    (0..=1000).map(at).collect()
}

fn force() -> Chart {
    Chart::new(Axis::new("time t [µs]"), Axis::new("force F [N]"))
        .with(Curve::line("this run", pulse(98.0)))
        .with(Curve::dashed("Hertz", pulse(102.0)).coloured(GREY))
        .with(Curve::points("", vec![(31.25, 98.0)]).like_curve(0))
}

#[test]
fn panel_svg_is_small_and_labels_its_curves() {
    let svg = panel(&force()).unwrap();
    assert_eq!(svg, panel(&force()).unwrap());
    // A picture keeps a few dozen of the thousand points of a smooth curve.
    assert!(svg.len() < 6000, "{}", svg.len());
    for expected in [">this run<", ">Hertz<", ">force F [N]<", ">time t [µs]<", ">100<"] {
        assert!(svg.contains(expected), "{expected}");
    }
    assert_eq!(svg.matches("<circle").count(), 1);
    for class in ["c0 stroke", "c0 fill", "grey stroke", "ink", "dim", "grid"] {
        assert!(svg.contains(&format!("class=\"{class}\"")), "{class}");
    }
}

/// The peak of 98 N is drawn at 98 on the axis, between the lines of 80 and 100.
#[test]
fn curve_peak_is_drawn_at_its_axis_value() {
    let svg = panel(&force()).unwrap();
    let line = |number: &str| {
        let end = svg.find(&format!(">{number}</text>")).unwrap();
        let from = svg[..end].rfind("<path class=\"grid\"").unwrap();
        let data = &svg[from..end];
        let data = &data[data.find("d=\"M").unwrap() + 4..];
        data.split([' ', 'H']).nth(1).unwrap().parse::<f64>().unwrap()
    };
    let dot = svg.split("cy=\"").nth(1).unwrap().split('"').next().unwrap().parse::<f64>().unwrap();
    let expected = line("80") + (line("100") - line("80")) * 0.9;
    // Coordinates are written to a tenth of a pixel.
    assert!((dot - expected).abs() < 0.2, "{dot} {expected}");
}

#[test]
fn panel_without_points_is_none() {
    let empty = Chart::new(Axis::new("t"), Axis::new("F"));
    assert_eq!(panel(&empty), None);
    let nan = empty.with(Curve::line("a", vec![(0.0, f64::NAN)]));
    assert_eq!(panel(&nan), None);
}

#[test]
fn curve_names_are_escaped() {
    let chart = Chart::new(Axis::new("t"), Axis::new("F"));
    let chart = chart.with(Curve::line("<script>&", vec![(0.0, 1.0), (1.0, 2.0)]));
    let svg = panel(&chart).unwrap();
    assert!(svg.contains("&lt;script&gt;&amp;") && !svg.contains("<script"));
}

/// A stand-alone picture is valid XML: no attribute is repeated, every element is closed.
#[test]
fn pictures_are_well_formed() {
    let band = force().with_band("range", vec![(0.0, 1.0, 2.0), (60.0, 3.0, 5.0)], GREY);
    let errors = Curve::points("measured", vec![(10.0, 50.0)]).with_errors(vec![5.0]);
    let svg = panel(&band.with(errors)).unwrap();
    let mut reader = quick_xml::Reader::from_str(&svg);
    loop {
        match reader.read_event().unwrap() {
            quick_xml::events::Event::Eof => break,
            quick_xml::events::Event::Start(tag) | quick_xml::events::Event::Empty(tag) => {
                tag.attributes().for_each(|attribute| assert!(attribute.is_ok(), "{tag:?}"));
            }
            _ => {}
        }
    }
}
