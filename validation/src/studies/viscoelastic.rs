//! Restitution of relaxing spheres against Ting's quasi-static impact.
//!
//! The case `base` is run with its relaxation replaced by each series of the parameters and at each
//! speed. Compared with Ting on half-spaces, |Δe| is at most 5e-4 + 0.03 (1 − e), since a sphere is stiffer than
//! a half-space by first order in a/R. Compared with Ting with that compliance in series, the bound is
//! absolute.

use std::sync::Arc;

use fem::{Plan, ting_impact};
use fem_case::Case;
use fem_case::schema::{ActsOn, RelaxationTable, SnapshotsValue, TermTable};
use fem_figure::{Axis, Chart, Curve};
use rayon::prelude::*;
use serde::Deserialize;

use crate::{Findings, Laboratory, Run, StudyError, studies::relaxing::with_relaxation};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    rates: Vec<f64>,
    /// G∞/G0, at the base's decay rate.
    equilibrium: Vec<f64>,
    speeds: Vec<f64>,
    /// A series of several terms: (weight, decay rate times Hertz' contact time).
    series: Vec<(f64, f64)>,
    material: String,
    /// Decay rate times contact time of the single term if it is not varied.
    rate: f64,
    /// Default element size over element size.
    refinement: f64,
}

struct Member {
    group: &'static str,
    acts_on: ActsOn,
    x: f64,
    case: Case,
}

/// Restitutions of finite elements, of Ting on half-spaces, and of Ting with finite spheres.
struct Outcome {
    member: Member,
    run: Arc<Run>,
    half_space: f64,
    finite: f64,
}

const GROUPS: [(&str, &str); 4] = [
    ("rate", "decay rate × contact time"),
    ("equilibrium", "G∞/G0"),
    ("speed", "speed [m/s]"),
    ("series", ""),
];

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let base = laboratory.case("base")?;
    let time = Plan::of_case(&base)?.estimate.hertz.contact_time();
    let members = members(&parameters, &base, time)?;
    let outcomes: Vec<Outcome> = members
        .into_par_iter()
        .map(|member| measure(laboratory, member, parameters.refinement))
        .collect::<Result<_, _>>()?;
    let mut findings = Findings::new();
    for outcome in &outcomes {
        let e = outcome.run.restitution;
        let group = outcome.member.group;
        let allowed = 5e-4 + 0.03 * (1.0 - outcome.half_space);
        let half_space = (e - outcome.half_space).abs() / allowed;
        findings.measure_worst(&format!("{group}.half_space"), half_space);
        findings.measure_worst(&format!("{group}.finite"), (e - outcome.finite).abs());
    }
    draw(&mut findings, &outcomes);
    tabulate(&mut findings, &outcomes);
    Ok(findings)
}

fn members(parameters: &Parameters, base: &Case, time: f64) -> Result<Vec<Member>, StudyError> {
    let Parameters { rates, equilibrium, speeds, series, material, rate, .. } = parameters;
    let term = |(weight, rate): &(f64, f64)| TermTable::with_decay_rate(*weight, rate / time);
    let mut members = Vec::new();
    for acts_on in [ActsOn::All, ActsOn::Shear] {
        let mut add = |group, x, terms: &[(f64, f64)], speed: Option<f64>| {
            let case = with_relaxation(
                base,
                material,
                RelaxationTable::new(acts_on, terms.iter().map(term)),
            )?;
            let case = case.edited(|file| {
                file.output.get_or_insert_default().snapshots = Some(SnapshotsValue::none());
                if let Some(speed) = speed {
                    file.body[0].approach_speed = Some(speed.into());
                }
            })?;
            members.push(Member { group, acts_on, x, case });
            Ok::<_, StudyError>(())
        };
        for &x in rates {
            add("rate", x, &[(1.0, x)], None)?;
        }
        for &x in equilibrium {
            add("equilibrium", x, &[(1.0 - x, *rate)], None)?;
        }
        for &x in speeds {
            add("speed", x, &[(1.0, *rate)], Some(x))?;
        }
        add("series", 0.0, series, None)?;
    }
    Ok(members)
}

fn measure(
    laboratory: &Laboratory,
    member: Member,
    refinement: f64,
) -> Result<Outcome, StudyError> {
    let size = Plan::of_case(&member.case)?.contact_element_size / refinement;
    let fine = member.case.edited(|file| {
        file.mesh.get_or_insert_default().contact_element_size = Some(size.into());
    })?;
    let run = laboratory.simulate(fine)?;
    let (scene, pair) = (run.case.scene(), run.hertz.pair());
    let half_space = ting_impact(scene, pair, false)?.restitution;
    let finite = ting_impact(scene, pair, true)?.restitution;
    Ok(Outcome { member, half_space, finite, run })
}

fn words(acts_on: ActsOn) -> &'static str {
    match acts_on {
        ActsOn::All => "constant ν",
        ActsOn::Shear => "bulk elastic",
    }
}

fn draw(findings: &mut Findings, outcomes: &[Outcome]) {
    let charts: Vec<Chart> = GROUPS[..3]
        .iter()
        .flat_map(|(group, label)| {
            let axis = || {
                let axis = Axis::new(*label);
                if *group == "equilibrium" { axis } else { axis.logarithmic() }
            };
            let mut restitution = Chart::new(axis(), Axis::new("restitution e"));
            let mut difference = Chart::new(axis(), Axis::new("1000 (e − Ting's)"));
            for (k, acts_on) in [ActsOn::All, ActsOn::Shear].into_iter().enumerate() {
                let points = |value: fn(&Outcome) -> f64| -> Vec<(f64, f64)> {
                    let is_of =
                        |o: &&Outcome| o.member.group == *group && o.member.acts_on == acts_on;
                    outcomes.iter().filter(is_of).map(|o| (o.member.x, value(o))).collect()
                };
                let name = words(acts_on);
                restitution = restitution
                    .with(
                        Curve::points(
                            format!("finite elements, {name}"),
                            points(|o| o.run.restitution),
                        )
                        .like_curve(k),
                    )
                    .with(
                        Curve::line(format!("Ting, finite spheres, {name}"), points(|o| o.finite))
                            .like_curve(k),
                    )
                    .with(
                        Curve::dashed(
                            format!("Ting, half-spaces, {name}"),
                            points(|o| o.half_space),
                        )
                        .like_curve(k),
                    );
                let finite = points(|o| 1e3 * (o.run.restitution - o.finite));
                let half_space = points(|o| 1e3 * (o.run.restitution - o.half_space));
                difference = difference
                    .with(Curve::line("", finite).like_curve(k))
                    .with(Curve::dashed("", half_space).like_curve(k));
            }
            [restitution, difference]
        })
        .collect();
    findings.draw(
        "restitution",
        "Left: restitution of the finite-element model and of Ting's impact. Right: difference of finite elements from Ting with finite spheres (full lines) and on half- \
         spaces (dashed).",
        &charts,
    );
}

fn tabulate(findings: &mut Findings, outcomes: &[Outcome]) {
    let rows = outcomes.iter().map(|outcome| {
        let Outcome { member, run, half_space, finite } = outcome;
        let x = if member.group == "series" { String::new() } else { member.x.to_string() };
        [
            member.group.to_string(),
            x,
            words(member.acts_on).to_string(),
            format!("{:.5}", run.restitution),
            format!("{finite:.5}"),
            format!("{half_space:.5}"),
        ]
    });
    let header =
        ["varied", "value", "relaxing", "finite elements", "Ting, finite", "Ting, half-space"];
    findings.tabulate("All members.", header, rows);
}
