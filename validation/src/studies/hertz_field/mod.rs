//! The field of a Hertz contact at the largest approach, on meshes of several sizes.
//!
//! The case of the claim is run with several numbers of elements over Hertz' contact radius. For each
//! profile (`pressure`, `axial`, `radial`, `surface`,
//! `hoop`) and for σ_rz in the body, `inner_shear`, it measures `.error`, the relative L2 error on the finest mesh,
//! and `.order`; on the finest mesh also `max_shear` and `max_shear_depth` over their closed
//! forms, `rim_tension` over (1−2ν)p₀/3, and `size`, a/R.

mod closed_form;
mod fields;

use fem::Plan;
use fem_case::SnapshotLabel;
use fem_case::schema::SnapshotsValue;
use fem_figure::{Axis, Chart, Curve, GREY};
use serde::Deserialize;

use crate::{Findings, Laboratory, StudyError, studies::order::fitted_order};
use closed_form::{Profile, closed_form, shear};
use fields::{Fields, relative_error};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Elements over Hertz' contact radius, ascending.
    elements: Vec<f64>,
    /// Depth over the contact radius out to which the axis is compared.
    depth: f64,
    /// Distance from the axis over the contact radius out to which the surface is compared.
    distance: f64,
    /// Distance over the contact radius from which the tension outside of the contact is fitted.
    rim: f64,
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    if parameters.elements.len() < 2 {
        return Err(StudyError::parameters("an order needs at least two numbers of elements"));
    }
    let hertz = laboratory.case("contact")?;
    let radius = Plan::of_case(&hertz)?.estimate.hertz.max_contact_radius();
    let case = |n: &f64| {
        hertz.edited(|file| {
            file.mesh.get_or_insert_default().contact_element_size = Some((radius / n).into());
            file.output.get_or_insert_default().snapshots =
                Some(SnapshotsValue::labels([SnapshotLabel::Maximum]));
        })
    };
    let cases = parameters.elements.iter().map(case).collect::<Result<_, _>>()?;
    let runs = laboratory.run_all(cases)?;
    let fields = runs
        .iter()
        .map(|run| Fields::of(run, parameters.depth, parameters.distance))
        .collect::<Result<Vec<_>, _>>()?;
    let mut findings = Findings::new();
    let errors = Profile::ALL.map(|profile| {
        let errors: Vec<f64> = fields.iter().map(|f| relative_error(f.profile(profile))).collect();
        let sizes = parameters.elements.iter().map(|n| n.recip());
        let name = profile.name();
        findings.measure(format!("{name}.error"), errors[errors.len() - 1]);
        findings.measure(format!("{name}.order"), fitted_order(sizes.zip(errors.iter().copied())));
        errors
    });
    let inner: Vec<f64> = fields.iter().map(|f| relative_error(&f.inner_shear)).collect();
    let sizes = parameters.elements.iter().map(|n| n.recip());
    findings.measure("inner_shear.error", inner[inner.len() - 1]);
    findings.measure("inner_shear.order", fitted_order(sizes.zip(inner.iter().copied())));
    let marks: Vec<[f64; 3]> = fields.iter().map(|fields| marks(fields, parameters.rim)).collect();
    let names = ["max_shear", "max_shear_depth", "rim_tension"];
    for (name, value) in names.into_iter().zip(marks[marks.len() - 1]) {
        findings.measure(name, value);
    }
    findings.measure("size", fields[fields.len() - 1].size);
    draw(&mut findings, &parameters, &fields, &errors);
    let rows = parameters.elements.iter().zip(&marks).enumerate().map(|(k, (n, marks))| {
        let percent = |value: f64| format!("{:.2} %", 100.0 * value);
        let [pressure, axial, radial, surface, hoop] =
            errors.each_ref().map(|errors| percent(errors[k]));
        let [largest, depth, rim] = marks.map(|mark| format!("{mark:.4}"));
        let inner = percent(inner[k]);
        [n.to_string(), pressure, axial, radial, surface, hoop, inner, largest, depth, rim]
    });
    let header = [
        "elements over a",
        "p",
        "σ_yy axis",
        "σ_rr axis",
        "σ_rr surface",
        "σ_θθ surface",
        "σ_ry inside",
        "τ",
        "depth",
        "rim",
    ];
    findings.tabulate(
        "Relative L2 errors; largest shear, its depth and tension at the rim over Hertz'.",
        header,
        rows,
    );
    Ok(findings)
}

/// Measures the largest shear on the axis, its depth, and the tension at the rim, over Hertz' values.
fn marks(fields: &Fields, rim: f64) -> [f64; 3] {
    let (found, depth) = largest(&fields.shear());
    let exact: Vec<_> = places(2.0).map(|z| (z, shear(z, fields.poissons_ratio))).collect();
    let (exact, exact_depth) = largest(&exact);
    [found / exact, depth / exact_depth, rim_tension(fields, rim)]
}

/// Returns a fine grid from 0.
fn places(end: f64) -> impl Iterator<Item = f64> {
    let step = 2e-3;
    (0..=(end / step) as usize).map(move |k| k as f64 * step)
}

/// Returns the largest value and its place, from the parabola through the largest point and its two
/// neighbours.
fn largest(points: &[(f64, f64)]) -> (f64, f64) {
    let best = (1..points.len().saturating_sub(1))
        .max_by(|&a, &b| points[a].1.total_cmp(&points[b].1))
        .unwrap_or(usize::MAX);
    let Some([(x0, y0), (x1, y1), (x2, y2)]) =
        points.get(best.wrapping_sub(1)..best.saturating_add(2))
    else {
        return (f64::NAN, f64::NAN);
    };
    let (left, right) = ((y1 - y0) / (x1 - x0), (y2 - y1) / (x2 - x1));
    let curvature = (right - left) / (x2 - x0);
    let slope = left + curvature * (x1 - x0);
    let shift = -slope / (2.0 * curvature);
    (y1 + 0.5 * slope * shift, x1 + shift)
}

/// Returns the tension at the rim over (1−2ν)p₀/3, from the field outside: C of
/// σ_rr = C a²/r², by least squares beyond `rim` contact radii.
fn rim_tension(fields: &Fields, rim: f64) -> f64 {
    let outside = fields.profile(Profile::Surface).iter().filter(|sample| sample.place >= rim);
    let (product, square) = outside.fold((0.0, 0.0), |(product, square), s| {
        (product + s.weight * s.value * s.exact, square + s.weight * s.exact * s.exact)
    });
    product / square
}

fn draw(
    findings: &mut Findings,
    parameters: &Parameters,
    fields: &[Fields],
    errors: &[Vec<f64>; 5],
) {
    let finest = &fields[fields.len() - 1];
    let add = |chart: Chart, profile: Profile, colour: usize, end: f64| {
        let found = finest.profile(profile).iter().map(|s| (s.place, s.value)).collect();
        let exact = places(end)
            .map(|place| (place, closed_form(profile, place, finest.poissons_ratio)))
            .collect();
        chart
            .with(Curve::points(profile.label(), found).like_curve(colour))
            .with(Curve::dashed("closed form", exact).coloured(GREY))
    };
    let chart = |x: &str, y: &str| Chart::new(Axis::new(x), Axis::new(y));
    let pressure = add(chart("r/a", "p/p0"), Profile::Pressure, 0, 1.1);
    let axis = add(chart("depth/a", "stress/p0"), Profile::Axial, 1, parameters.depth);
    let exact = places(parameters.depth).map(|z| (z, shear(z, finest.poissons_ratio))).collect();
    let axis = add(axis, Profile::Radial, 2, parameters.depth)
        .with(Curve::points("τ, axis", finest.shear()).like_curve(5))
        .with(Curve::dashed("closed form", exact).coloured(GREY));
    let surface = add(chart("r/a", "stress/p0"), Profile::Surface, 3, parameters.distance);
    let surface = add(surface, Profile::Hoop, 4, parameters.distance);
    let mut convergence = Chart::new(
        Axis::new("elements over the contact radius").logarithmic(),
        Axis::new("relative L2 error").logarithmic(),
    );
    for (k, (profile, errors)) in Profile::ALL.into_iter().zip(errors).enumerate() {
        let points = parameters.elements.iter().copied().zip(errors.iter().copied()).collect();
        convergence =
            convergence.with(Curve::points_on_line(profile.label(), points).like_curve(k));
    }
    let first = parameters.elements.iter().map(|&n| (n, 0.5 / n)).collect();
    let convergence = convergence.with(Curve::dashed("first order", first).coloured("#000000"));
    let caption = format!(
        "Fields at the largest approach with {} elements over the contact radius (points) and \
         Hertz' closed forms at the same force (dashed); errors against the element size.",
        parameters.elements.last().copied().unwrap_or(f64::NAN)
    );
    findings.draw("profiles", caption, &[pressure, axis, surface, convergence]);
}
