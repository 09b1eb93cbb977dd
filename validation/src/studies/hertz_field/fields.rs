//! The fields of a computed collision at its largest approach, in units of Hertz' contact radius a
//! and pressure p₀ at the same force.

use fem_case::Shape;
use fem_collision::{Snapshot, SnapshotInstant};
use fem_contact::ContactInterface;
use fem_laws::HertzPressure;
use fem_mesh::segment_measures;

use super::closed_form::{Profile, closed_form, shear_below};
use crate::{ExplicitRun, StudyError};

/// A value at a place with its weight in an integral.
#[derive(Clone, Copy)]
pub struct Sample {
    /// Distance from the axis or depth, over a.
    pub place: f64,
    /// The stress over p₀.
    pub value: f64,
    /// The closed form, over p₀.
    pub exact: f64,
    pub weight: f64,
}

/// Profiles of one run; stresses are those of the first sphere.
pub struct Fields {
    /// Largest a/R of the two bodies.
    pub size: f64,
    /// Poisson's ratio of the sphere.
    pub poissons_ratio: f64,
    profiles: [Vec<Sample>; 5],
    /// σ_rz at the nodes within the depth and the distance, in the order of the mesh.
    pub inner_shear: Vec<Sample>,
}

impl Fields {
    /// Samples the fields out to the given depth and distance over a.
    pub fn of(run: &ExplicitRun, depth: f64, distance: f64) -> Result<Self, StudyError> {
        let missing = || StudyError::parameters("the run has no snapshot of its largest approach");
        let is_maximum = |snapshot: &&Snapshot| snapshot.label == Some(SnapshotInstant::Maximum);
        let snapshot = run.collision.snapshots.iter().find(is_maximum).ok_or_else(missing)?;
        let bodies = run.model.bodies();
        let side = usize::from(bodies[0].mesh().is_none());
        let shape = run.case.scene().bodies()[side].shape();
        let (Some(mesh), Shape::Sphere { material, .. }) = (bodies[side].mesh(), shape) else {
            return Err(StudyError::parameters("the case has no sphere"));
        };
        let u = displacements(run, snapshot);
        let springs = run.springs()?;
        let hertz = hertz_at_force(run, &u)?;
        let stress = bodies[side].stress(&snapshot.bodies[side], Some(&snapshot.contact));
        let poissons_ratio = material.instantaneous().poissons_ratio();
        let boundary = |profile: Profile| {
            let (nodes, along, end, component) = match profile {
                Profile::Surface => (mesh.surface(), 0, distance, 0),
                Profile::Hoop => (mesh.surface(), 0, distance, 2),
                Profile::Axial => (mesh.axis(), 1, depth, 1),
                _ => (mesh.axis(), 1, depth, 0),
            };
            let places: Vec<f64> = (nodes.iter())
                .map(|&node| mesh.nodes()[node as usize][along].abs() / hertz.contact_radius)
                .take_while(|&place| place <= end)
                .collect();
            let value = |k: usize| stress.points[nodes[k] as usize][component];
            samples(&places, |k| value(k) / hertz.peak_pressure, profile, poissons_ratio)
        };
        // y points out of the lower body and into the upper one, z into either.
        let sign = if side == 0 { -1.0 } else { 1.0 };
        let inner_shear = (mesh.nodes().iter().zip(&stress.points))
            .map(|(node, stress)| (node.map(|x| x.abs() / hertz.contact_radius), stress))
            .filter(|([r, z], _)| *r <= depth && *z <= depth)
            .map(|([r, z], stress)| Sample {
                place: r,
                value: sign * stress[3] / hertz.peak_pressure,
                exact: shear_below(r, z),
                weight: 1.0,
            })
            .collect();
        Ok(Self {
            inner_shear,
            size: hertz.contact_radius / run.smallest_radius(),
            poissons_ratio,
            profiles: Profile::ALL.map(|profile| match profile {
                Profile::Pressure => pressure(springs, &u, hertz),
                _ => boundary(profile),
            }),
        })
    }

    /// Returns the samples of a profile along its curve, from the axis or the surface.
    pub fn profile(&self, profile: Profile) -> &[Sample] {
        &self.profiles[profile as usize]
    }

    /// Returns (depth, ½|σ_rr − σ_yy|) along the axis.
    pub fn shear(&self) -> Vec<(f64, f64)> {
        let both = self.profile(Profile::Axial).iter().zip(self.profile(Profile::Radial));
        both.map(|(axial, radial)| (axial.place, 0.5 * (radial.value - axial.value).abs()))
            .collect()
    }
}

/// Returns the displacements of both bodies, m; a wall has one node.
fn displacements(run: &ExplicitRun, snapshot: &Snapshot) -> [Vec<[f64; 2]>; 2] {
    std::array::from_fn(|side| match run.model.bodies()[side].mesh() {
        Some(_) => snapshot.bodies[side].displacement.clone(),
        None => vec![[0.0, run.case.scene().bodies()[side].velocity() * snapshot.time]],
    })
}

/// Returns a and p₀ of the contact force: a³ = 3FR*/4E*, p₀ = 3F/2πa².
fn hertz_at_force(run: &ExplicitRun, u: &[Vec<[f64; 2]>; 2]) -> Result<HertzPressure, StudyError> {
    let mut forces = u.each_ref().map(|u| vec![[0.0; 2]; u.len()]);
    let [lower, upper] = &mut forces;
    let force = run.springs()?.add_forces([&u[0], &u[1]], [lower, upper]).force;
    let hertz = run.hertz;
    let approach = (force / hertz.stiffness()).powf(2.0 / 3.0);
    Ok(hertz.pressure(approach))
}

/// Returns the contact pressure at the nodes of the first sphere, out to a tenth beyond the contact.
fn pressure(
    springs: &ContactInterface,
    u: &[Vec<[f64; 2]>; 2],
    hertz: HertzPressure,
) -> Vec<Sample> {
    let pressure = springs.nodal_pressure([&u[0], &u[1]]);
    let (places, values): (Vec<f64>, Vec<f64>) = pressure
        .map(|(r, p)| (r / hertz.contact_radius, p / hertz.peak_pressure))
        .take_while(|(place, _)| *place < 1.1)
        .unzip();
    let mut all = samples(&places, |k| values[k], Profile::Pressure, f64::NAN);
    // The weight is an area instead of a length.
    let n = places.len();
    for k in 0..n {
        let share = |inner: usize, which: usize| {
            segment_measures([places[inner], 0.0], [places[inner + 1], 0.0])[which]
        };
        let inside = if k > 0 { share(k - 1, 1) } else { 0.0 };
        all[k].weight = inside + if k + 1 < n { share(k, 0) } else { 0.0 };
    }
    all
}

/// Returns values at ascending places with those of the closed form, weighted by the length around each.
fn samples(
    places: &[f64],
    value: impl Fn(usize) -> f64,
    profile: Profile,
    poissons_ratio: f64,
) -> Vec<Sample> {
    let last = places.len().saturating_sub(1);
    (0..places.len())
        .map(|k| Sample {
            place: places[k],
            value: value(k),
            exact: closed_form(profile, places[k], poissons_ratio),
            weight: 0.5 * (places[(k + 1).min(last)] - places[k.saturating_sub(1)]),
        })
        .collect()
}

/// Returns √(Σ w (x − exact)² / Σ w exact²).
pub fn relative_error(samples: &[Sample]) -> f64 {
    let sum = |of: &dyn Fn(&Sample) -> f64| samples.iter().map(|s| s.weight * of(s)).sum::<f64>();
    (sum(&|s| (s.value - s.exact).powi(2)) / sum(&|s| s.exact * s.exact)).sqrt()
}
