//! A sphere pressed flat between two rigid plates, slowly, at finite strain.
//!
//! R = E = ρ = 1. One plate is the wall of the model, the other a force on the nodes of the far half
//! ([`plate`]); both come at the same speed, so that the sphere's centre stays in the middle. For each
//! Poisson's ratio and each depth d of a plate, over the radius, it measures
//!
//! * `nuNN.forceDD`, the mean force over the approaches within 2 % of d, over Hertz' force of d,
//!   4/3 d^(3/2)/(1 − ν²): NN and DD are hundredths;
//! * `energy_residual`, the worst of all runs over the work of the plates.

mod mesh;
mod plate;

use std::sync::Arc;

use fem_collision::{
    Account, Approach, BodyInput, Expectation, HistoryRow, OutputRequest, nan_aware_max_abs,
};
use fem_explicit::{
    DeformedContact, ExplicitBodies, ModelError, ModelParts, NodeForce, Run, Settings,
};
use fem_figure::{Axis, Chart, Curve};
use fem_material::finite::HyperelasticLaw;
use fem_material::{ElasticModuli, Material};
use serde::Deserialize;

use crate::{Findings, Laboratory, StudyError};
use plate::FarPlate;

/// Penalty factor of both plates: overlaps are h/60 times the pressure over E*.
const PENALTY_FACTOR: f64 = 60.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    poissons_ratios: Vec<f64>,
    /// Depths over the radius, ascending.
    depths: Vec<f64>,
    /// Cells along an eighth of the meridian.
    cells: usize,
    /// Speed of each plate toward the centre, over √(E/ρ).
    speed: f64,
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let mut findings = Findings::new();
    let mut curves = Vec::new();
    for &nu in &parameters.poissons_ratios {
        let rows = laboratory.work(|| press(&parameters, nu))?;
        let hertz = |depth: f64| 4.0 / 3.0 * depth.powf(1.5) / (1.0 - nu * nu);
        for &depth in &parameters.depths {
            let name = format!("nu{}.force{:02}", hundredths(nu), hundredths(depth));
            findings.measure(name, mean_force_ratio(&rows, depth, hertz));
        }
        findings.measure_worst("energy_residual", residual(&rows));
        let points = rows.iter().map(|row| (row.approach, row.contact_force));
        curves.push(Curve::line(format!("ν = {nu}"), points.collect()));
    }
    let axes = Chart::new(Axis::new("depth of a plate / R"), Axis::new("force / E R²"));
    let chart = curves.into_iter().fold(axes, Chart::with);
    findings.draw("force", "Force over the depth of each plate.", &[chart]);
    Ok(findings)
}

fn hundredths(x: f64) -> u32 {
    (100.0 * x).round() as u32
}

/// Returns the rows of a run until the plates are slightly beyond the largest depth.
fn press(parameters: &Parameters, nu: f64) -> Result<(Vec<HistoryRow>, u64), StudyError> {
    let Parameters { cells, speed, ref depths, .. } = *parameters;
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(1.0, nu)?;
    let material = Material::new(1.0, moduli, None)?;
    let mesh = mesh::sphere(cells)?;
    let element_size = mesh::contact_element_size(cells);
    let contact_stiffness = PENALTY_FACTOR * moduli.plane_strain_modulus();
    let far_plate = FarPlate::new(&mesh, contact_stiffness / element_size, speed);
    let bodies = [BodyInput::Wall, BodyInput::Sphere { mesh, material }];
    let settings = Settings {
        contact_stiffness,
        candidate_radius: 0.97,
        step_factor: 0.8,
        mass_scaling: 0.0,
        mass_times: [1.0; 2],
    };
    let approach = Approach::new([0.0, -speed], 0.0)?;
    let contact = DeformedContact::new(&bodies, 0.0, &settings).map_err(ModelError::from)?;
    let far: Box<dyn NodeForce> = Box::new(far_plate);
    let parts = ModelParts {
        node_forces: [Vec::new(), vec![far]],
        finite_strain: [None, Some(HyperelasticLaw::NeoHooke)],
        contact: Some(Box::new(contact)),
        ..ModelParts::default()
    };
    let model = Arc::new(ExplicitBodies::with_parts(bodies, approach, &settings, parts)?);
    let deepest = 1.03 * depths.iter().copied().fold(0.0, f64::max);
    let duration = deepest / speed;
    let expected = Expectation { contact_time: duration, approach: deepest };
    let n_elements = model.n_elements() as u64;
    let mut run = Run::new(model, expected, &OutputRequest::history());
    while run.progress().time < duration && run.advance(100).is_none() {}
    let (time, steps) = (run.progress().time, run.progress().step);
    let collision = run.finish();
    if time < duration {
        let message = format!("the sphere is pressed until {time}, and should be until {duration}");
        return Err(StudyError::parameters(message));
    }
    Ok((collision.history, steps * n_elements))
}

/// Returns the mean ratio of the force to Hertz' force at approaches near a depth.
fn mean_force_ratio(rows: &[HistoryRow], depth: f64, hertz: impl Fn(f64) -> f64) -> f64 {
    let near = rows.iter().filter(|row| (row.approach / depth - 1.0).abs() < 0.02);
    let ratios: Vec<f64> = near.map(|row| row.contact_force / hertz(row.approach)).collect();
    ratios.iter().sum::<f64>() / ratios.len() as f64
}

fn residual(rows: &[HistoryRow]) -> f64 {
    let work = rows.last().and_then(|row| row.energy(Account::WallWork)).unwrap_or(f64::NAN);
    rows.iter().map(|row| row.residual.unwrap_or(f64::NAN).abs()).fold(0.0, nan_aware_max_abs)
        / work
}
