//! Limits and orders of convergence of a case over the size of its elements.
//!
//! For each quantity q of the collision it fits q(h) = q₀ + C hᵖ to the levels and measures
//! `NAME.limit`, `NAME.order`, and `NAME.uncertainty`, the largest relative change of the limit when a level
//! is left out.

use std::sync::Arc;

use fem::accuracy::PowerLaw;
use fem_case::engineering::show;
use fem_collision::SnapshotInstant;
use fem_figure::{Axis, Chart, Curve};
use serde::Deserialize;

use crate::{ExplicitRun, Findings, Laboratory, Run, StudyError};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Element sizes at the contact, m, in descending order.
    contact_element_sizes: Vec<f64>,
}

type Quantity = (&'static str, &'static str, &'static str, fn(&Run) -> f64);

const QUANTITIES: [Quantity; 5] = [
    ("restitution", "e", "", |run| run.restitution),
    ("contact_time", "T", "s", |run| run.contact_time()),
    ("peak_force", "F", "N", |run| run.peak_force()),
    ("contact_radius", "a", "m", equivalent_radius),
    ("peak_pressure", "p0", "Pa", |run| run.peak_pressure()),
];

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let Parameters { contact_element_sizes: sizes } = laboratory.parameters()?;
    let base = laboratory.case("base")?;
    let case = |size: &f64| {
        base.edited(|file| {
            file.mesh.get_or_insert_default().contact_element_size = Some((*size).into());
        })
    };
    let runs = laboratory.run_all(sizes.iter().map(case).collect::<Result<_, _>>()?)?;
    let mut findings = Findings::new();
    let mut chart = Chart::new(
        Axis::new("element size [µm]").logarithmic(),
        Axis::new("|q − limit| / limit").logarithmic(),
    );
    for (name, symbol, _, value) in QUANTITIES {
        let levels: Vec<_> =
            sizes.iter().zip(&runs).map(|(size, run)| (*size, value(run))).collect();
        let Some(fit) = PowerLaw::fit(&levels) else {
            return Err(StudyError::parameters("a fit needs four element sizes or more"));
        };
        findings.measure(format!("{name}.limit"), fit.limit);
        findings.measure(format!("{name}.order"), fit.order);
        findings.measure(format!("{name}.uncertainty"), fit.uncertainty / fit.limit.abs());
        // The restitution of elastic bodies has no error that converges.
        let points = levels.iter().map(|(h, q)| (1e6 * h, (q / fit.limit - 1.0).abs()));
        chart = chart.with(Curve::points_on_line(symbol, points.collect()));
    }
    let residuals = runs.iter().map(|run| run.energy_residual());
    findings.measure("energy_residual", residuals.fold(0.0, f64::max));
    if let Some(finest) = runs.last() {
        findings.measure("profile_radius", profile_radius(finest)?);
    }
    let slope = sizes.iter().map(|h| (1e6 * h, 1e-3 * h / sizes[0])).collect();
    chart = chart.with(Curve::dashed("first order", slope).coloured(fem_figure::GREY));
    findings.draw(
        "levels",
        "Distance of each quantity from its own extrapolated limit over the element size, and the \
         slope of first order.",
        &[chart],
    );
    tabulate(&mut findings, &sizes, &runs);
    Ok(findings)
}

fn tabulate(findings: &mut Findings, sizes: &[f64], runs: &[Arc<ExplicitRun>]) {
    let rows = sizes.iter().zip(runs).map(|(size, run)| {
        let [e, t, f, a, p] = QUANTITIES.map(|(.., unit, value)| {
            let value = value(run);
            if unit.is_empty() { format!("{value:.6}") } else { show(value, unit) }
        });
        [
            show(*size, "m"),
            e,
            t,
            f,
            a,
            p,
            format!("{:.1e}", run.collision.element_updates.unwrap_or(0) as f64),
        ]
    });
    let header = ["element size", "e", "T", "F", "a", "p0", "element updates"];
    findings.tabulate("The levels.", header, rows);
}

/// Returns the contact radius of Hertz' pressure with the run's peak force and pressure, p0 = 3F/(2πa²), m. It
/// does not depend on the position of nodes at the edge of the contact.
fn equivalent_radius(run: &Run) -> f64 {
    (1.5 * run.peak_force() / (std::f64::consts::PI * run.peak_pressure())).sqrt()
}

/// Returns the contact radius at maximum compression, m, as the root of p² = α − β r² fitted to the nodal
/// pressures, weighted by r. It does not depend on the position of nodes at the edge. NaN without
/// a snapshot of the maximum.
fn profile_radius(run: &ExplicitRun) -> Result<f64, StudyError> {
    let snapshots = &run.collision.snapshots;
    let Some(snapshot) = snapshots.iter().find(|s| s.label == Some(SnapshotInstant::Maximum))
    else {
        return Ok(f64::NAN);
    };
    let interface = run.springs()?;
    let u = snapshot.bodies.each_ref().map(|body| body.displacement.as_slice());
    let edge = interface.contact_radius(u);
    let mut sums = [0.0; 5];
    for (r, p) in interface.nodal_pressure(u).filter(|(r, _)| (0.1..0.8).contains(&(r / edge))) {
        let (x, y) = ((r / edge).powi(2), p * p);
        let terms = [1.0, x, x * x, y, x * y];
        for (sum, term) in sums.iter_mut().zip(terms) {
            *sum += r * term;
        }
    }
    let [s0, s1, s2, y0, y1] = sums;
    // These are α and −β up to the same factor.
    let (alpha, slope) = (y0 * s2 - y1 * s1, s0 * y1 - s1 * y0);
    Ok(edge * (-alpha / slope).sqrt())
}
