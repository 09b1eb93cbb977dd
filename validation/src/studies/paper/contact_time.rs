//! Fig. 12: contact time against speed, next to Hertz and Hertz with finite spheres.

use fem::ting_impact;
use fem_figure::{Axis, Chart, Curve};
use serde::Deserialize;

use super::{Speeds, case_at, exponent};
use crate::{Findings, Laboratory, StudyError};

struct Point {
    speed: f64,
    ours: f64,
    hertz: f64,
    finite: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    speeds: Vec<f64>,
    elements_per_contact_radius: f64,
    condensed_speeds: Vec<f64>,
    condensed_elements_per_contact_radius: f64,
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let Parameters { speeds, elements_per_contact_radius, .. } = laboratory.parameters()?;
    let speeds = Speeds { speeds, elements_per_contact_radius };
    let mut points = Vec::new();
    for run in speeds.run_elastic(laboratory)? {
        let hertz = run.hertz;
        let finite = ting_impact(run.case.scene(), hertz.pair(), true)?;
        points.push(Point {
            speed: hertz.approach_speed(),
            ours: run.contact_time(),
            hertz: hertz.contact_time(),
            finite: finite.contact_time.unwrap_or(f64::NAN),
        });
    }
    let mut findings = Findings::new();
    measure_condensed(laboratory, &mut findings)?;
    for point in &points {
        let Point { speed, ours, hertz, finite } = point;
        findings.measure(format!("time.{speed}"), *ours);
        findings.measure(format!("over_hertz.{speed}"), ours / hertz - 1.0);
        findings.measure(format!("finite_over_hertz.{speed}"), finite / hertz - 1.0);
        findings.measure_worst("worst_over_finite", (ours / finite - 1.0).abs());
    }
    let times: Vec<_> = points.iter().map(|point| (point.speed, point.ours)).collect();
    findings.measure("exponent", exponent(&times));
    draw(&points, &mut findings);
    Ok(findings)
}

/// Returns the contact times of condensed bodies, which have no noise.
fn measure_condensed(laboratory: &Laboratory, findings: &mut Findings) -> Result<(), StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let elements = parameters.condensed_elements_per_contact_radius;
    let condensed = laboratory.case("condensed")?;
    let cases =
        parameters.condensed_speeds.iter().map(|speed| case_at(&condensed, *speed, elements));
    let runs = laboratory.simulate_all(cases.collect::<Result<_, _>>()?)?;
    for (speed, run) in parameters.condensed_speeds.iter().zip(&runs) {
        let time = run.collision.contact_time.unwrap_or(f64::NAN);
        findings.measure(
            format!("condensed_over_hertz.{speed}"),
            time / run.hertz.contact_time() - 1.0,
        );
    }
    Ok(())
}

fn draw(points: &[Point], findings: &mut Findings) {
    let curve = |of: &dyn Fn(&Point) -> f64| points.iter().map(|p| (p.speed, of(p))).collect();
    let per_cent = |ratio: f64| 100.0 * (ratio - 1.0);
    let speed = || Axis::new("approach speed [m/s]").logarithmic();
    let times = Chart::new(speed(), Axis::new("contact time [µs]"))
        .with(Curve::points("finite elements", curve(&|p| 1e6 * p.ours)))
        .with(Curve::dashed("Hertz", curve(&|p| 1e6 * p.hertz)))
        .with(Curve::line("Hertz, spheres of finite size", curve(&|p| 1e6 * p.finite)));
    let ratios = Chart::new(speed(), Axis::new("contact time over Hertz' − 1 [%]"))
        .with(Curve::points("finite elements", curve(&|p| per_cent(p.ours / p.hertz))))
        .with(Curve::dashed("Hertz", curve(&|_| 0.0)))
        .with(Curve::line(
            "Hertz, spheres of finite size",
            curve(&|p| per_cent(p.finite / p.hertz)),
        ));
    findings.draw(
        "contact_time",
        "Fig. 12 of the paper, computed here: contact time against speed. On the left the curves \
         cannot be distinguished; on the right they are divided by Hertz' contact time. The finite elements follow the finite spheres, whose contact is shorter the larger it is.",
        &[times, ratios],
    );
    let rows = points.iter().map(|p| {
        [
            format!("{}", p.speed),
            format!("{:.3}", 1e6 * p.ours),
            format!("{:.3}", 1e6 * p.hertz),
            format!("{:.3}", 1e6 * p.finite),
            format!("{:+.3} %", per_cent(p.ours / p.hertz)),
            format!("{:+.3} %", per_cent(p.finite / p.hertz)),
        ]
    });
    findings.tabulate(
        "Contact times, µs",
        ["speed [m/s]", "here", "Hertz", "finite spheres", "here − Hertz", "finite − Hertz"],
        rows.collect::<Vec<_>>(),
    );
}
