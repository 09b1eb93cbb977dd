//! Figs. 2 and 3: the pairings of three spheres over speed, by finite elements with one Maxwell
//! branch and by the paper's reduced law.

use std::sync::Arc;

use fem::Plan;
use fem_case::Case;
use fem_case::schema::SphereTable;
use fem_figure::{Axis, Chart, Curve, GREY, tick};
use fem_laws::{LawImpact, Pair, laws};
use serde::Deserialize;

use super::{case_at, exponent, falls_through};
use crate::{ExplicitRun, Findings, Laboratory, StudyError};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Diameters, m, ascending.
    diameters: Vec<f64>,
    speeds: Vec<f64>,
    elements_per_contact_radius: f64,
    /// n of the reduced law.
    damping_exponent: f64,
    fit: Fit,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Fit {
    diameters: [f64; 2],
    speed: f64,
    restitution: f64,
}

struct Pairing {
    diameters: [f64; 2],
    /// Speed, restitution of the finite elements, and that of the reduced law.
    points: Vec<(f64, f64, f64)>,
}

impl Pairing {
    fn label(&self) -> String {
        let [first, second] = self.diameters.map(|diameter| tick(1e3 * diameter));
        format!("{first} on {second} mm")
    }

    fn is_of_equals(&self) -> bool {
        self.diameters[0] == self.diameters[1]
    }

    /// Returns the exponents of the losses 1 − e in the speed, of finite elements and of the reduced law.
    fn exponents(&self) -> [f64; 2] {
        let of = |loss: &dyn Fn(&(f64, f64, f64)) -> f64| {
            exponent(&self.points.iter().map(|point| (point.0, loss(point))).collect::<Vec<_>>())
        };
        [of(&|point| 1.0 - point.1), of(&|point| 1.0 - point.2)]
    }

    fn at(&self, speed: f64) -> (f64, f64) {
        let found = self.points.iter().find(|point| (point.0 / speed - 1.0).abs() < 1e-9);
        found.map_or((f64::NAN, f64::NAN), |point| (point.1, point.2))
    }
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let glass = laboratory.case("glass")?;
    let case = |diameters: [f64; 2], speed: f64| {
        let sized = glass.edited(|file| {
            for (body, diameter) in file.body.iter_mut().zip(diameters) {
                body.sphere = Some(SphereTable::new(diameter));
            }
        })?;
        case_at(&sized, speed, parameters.elements_per_contact_radius)
    };
    let fitted = pair_of(&case(parameters.fit.diameters, parameters.fit.speed)?)?;
    let n = parameters.damping_exponent;
    let by_law = |pair: &Pair, time: f64, speed: f64| -> Result<f64, StudyError> {
        let law = laws::bordbar_hyppanen(pair, time, n)?;
        Ok(LawImpact::new(pair, law).impact(speed)?.restitution)
    };
    let dissipation_time = falls_through(parameters.fit.restitution, (1e-9, 1e-3), |time| {
        by_law(&fitted, time, parameters.fit.speed)
    })?;
    let mut kinds = Vec::new();
    for (k, first) in parameters.diameters.iter().enumerate() {
        kinds.extend(parameters.diameters[..=k].iter().map(|second| [*first, *second]));
    }
    let mut wanted = Vec::new();
    for diameters in &kinds {
        wanted.extend(parameters.speeds.iter().map(|speed| (*diameters, *speed)));
    }
    let [large, small] = parameters.fit.diameters;
    wanted.push(([small, large], parameters.fit.speed));
    let cases = wanted.iter().map(|(diameters, speed)| case(*diameters, *speed));
    let mut runs = laboratory.run_all(cases.collect::<Result<_, _>>()?)?;
    let swapped = runs.pop().map_or(f64::NAN, |run| run.restitution);
    let mut pairings = Vec::new();
    for (diameters, runs) in kinds.iter().zip(runs.chunks(parameters.speeds.len())) {
        let point = |run: &Arc<ExplicitRun>| {
            let hertz = run.hertz;
            let speed = hertz.approach_speed();
            Ok((speed, run.restitution, by_law(hertz.pair(), dissipation_time, speed)?))
        };
        let points = runs.iter().map(point).collect::<Result<_, StudyError>>()?;
        pairings.push(Pairing { diameters: *diameters, points });
    }
    let mut findings = Findings::new();
    findings.measure("dissipation_time", dissipation_time);
    measure(&parameters, &pairings, swapped, &mut findings);
    draw(&pairings, &mut findings);
    Ok(findings)
}

fn pair_of(case: &Case) -> Result<Pair, StudyError> {
    Ok(*Plan::of_case(case)?.estimate.hertz.pair())
}

fn measure(parameters: &Parameters, pairings: &[Pairing], swapped: f64, findings: &mut Findings) {
    let Fit { diameters, speed, .. } = parameters.fit;
    let fitted = pairings.iter().find(|pairing| pairing.diameters == diameters);
    let (ours, law) = fitted.map_or((f64::NAN, f64::NAN), |pairing| pairing.at(speed));
    findings.measure("agreement", (ours - law).abs());
    findings.measure("swap", (ours - swapped).abs());
    for pairing in pairings {
        let [ours, law] = pairing.exponents();
        findings.measure_worst("largest_exponent", ours);
        findings.measure_worst("minus_smallest_exponent", -ours);
        findings.measure_worst("minus_smallest_law_exponent", -law);
        findings.measure_worst("largest_law_exponent", law);
        for pair in pairing.points.windows(2) {
            findings.measure_worst("largest_fall", pair[0].1 - pair[1].1);
            findings.measure_worst("largest_law_rise", pair[1].2 - pair[0].2);
        }
    }
    let equals = pairings.iter().filter(|pairing| pairing.is_of_equals());
    let losses = equals.map(|pairing| (pairing.diameters[0], pairing.at(speed)));
    let (mut ours, mut law) = (Vec::new(), Vec::new());
    for (diameter, (e, e_law)) in losses {
        ours.push((diameter, 1.0 - e));
        law.push((diameter, 1.0 - e_law));
    }
    findings.measure("size_exponent", exponent(&ours));
    findings.measure("law_size_exponent", exponent(&law));
}

fn draw(pairings: &[Pairing], findings: &mut Findings) {
    let chart = |title: &str, of_equals: bool, from: usize| {
        let axes = (Axis::new("approach speed [m/s]").logarithmic(), Axis::new("restitution"));
        let chart = Chart::new(axes.0, axes.1.from_to(0.7, 1.0)).titled(title);
        let chosen = pairings.iter().filter(|pairing| pairing.is_of_equals() == of_equals);
        chosen.enumerate().fold(chart, |chart, (k, pairing)| {
            let ours = pairing.points.iter().map(|point| (point.0, point.1)).collect();
            let law = pairing.points.iter().map(|point| (point.0, point.2)).collect();
            chart
                .with(Curve::points_on_line(pairing.label(), ours).like_curve(from + k))
                .with(Curve::dashed("", law).like_curve(from + k))
        })
    };
    let key = Curve::dashed("the paper's reduced law", Vec::new()).coloured(GREY);
    findings.draw(
        "pairings",
        "The pairings of the paper's figs. 2 and 3, computed here with one Maxwell branch (points) \
         and with the paper's reduced law (dashed, n = 1, A from its measured 0.925 at 0.5 m/s for \
         22.2 on 15.9 mm). The branch loses less in a shorter contact: its restitution rises with speed and falls with \
         size. That of the law falls with speed and rises with size.",
        &[chart("equal spheres", true, 0), chart("unequal spheres", false, 3).with(key)],
    );
    let mut rows = Vec::new();
    for pairing in pairings {
        let [ours, law] = pairing.exponents().map(|exponent| format!("{exponent:+.3}"));
        for (k, (speed, e, e_law)) in pairing.points.iter().enumerate() {
            let first = |text: &str| if k == 0 { text.to_string() } else { String::new() };
            rows.push([
                first(&pairing.label()),
                format!("{speed}"),
                format!("{e:.4}"),
                format!("{e_law:.4}"),
                first(&ours),
                first(&law),
            ]);
        }
    }
    let header =
        ["pairing", "speed [m/s]", "here", "reduced law", "1 − e ∝ v^…, here", "reduced law"];
    findings.tabulate("Restitution of the six distinct pairings", header, rows);
}
