//! Reference runs: cheaper collisions of the same bodies, whose Richardson limit estimates the discretisation error.

use fem_case::schema::{BodyTable, ContactMethod, StopTable};
use fem_case::{CaseFile, Quantity, defaults};
use fem_collision::{
    Approach, Collision, OutputRequest, QuantityOfInterest, SnapshotInstant, SnapshotRequest,
};

use super::calibration::ORDER;
use super::setting::Setting;
use super::stress_error::{ContactStress, StressError};
use crate::models::method::{Cost, SharedModels};
use crate::plan::Plan;
use crate::simulation::Simulation;

/// The quantities of interest, in the order of [`QuantityOfInterest::ALL`].
pub(super) type Values = [Option<f64>; 6];

/// Element sizes of the coarser run of the model itself over those of the collision. The second is tried if the collision
/// fails with the first, and is that of an elastic run.
pub(super) const COARSER_ELEMENT_RATIOS: [f64; 2] = [2.0, 1.5];
/// Time of the coarser run of condensed bodies over that of the collision with its factorisation.
pub const CONDENSED_REFERENCE_TIME: f64 = 0.25;
/// Time steps of condensed reference runs of explicit elements over the elastic contact time, which give the
/// restitution to 4e-5.
const STEPS_FOR_EXPLICIT: f64 = 120.0;
/// Time steps of reference runs of condensed bodies, which give the restitution to 2e-5.
const STEPS_FOR_CONDENSED: f64 = 160.0;
/// Elements across the contact of a mesh file below which its limit is taken from finer elements than its own.
const FEW_ACROSS: f64 = 9.0;
/// A reference run stops after this multiple of its expected element updates.
const MAX_UPDATES_OVER_EXPECTED: f64 = 4.0;

/// Returns the stop table that limits a bouncing ball to its first contact.
pub fn first_contact(file: &CaseFile) -> Option<StopTable> {
    let bounces = |_| StopTable { bounces: Some(Quantity::from_si(1.0)) };
    file.gravity.as_ref().map(bounces)
}

/// How the mesh continues away from the contact: as the case gives it, or by the mesh rule.
#[derive(Clone, Copy, Debug, PartialEq)]
enum FarMesh {
    AsGiven,
    ByRule,
}

/// A reference run and its result.
#[derive(Clone, Debug)]
struct ReferenceRun {
    approach: Approach,
    settings: Vec<Setting>,
    far_mesh: FarMesh,
    /// `None` if the model rejects the settings or the run does not end by itself.
    values: Option<Values>,
    /// Element updates over those that closed forms expect.
    updates_over_expected: f64,
    /// The stress at its largest approach, of runs of the model itself.
    stress: Option<ContactStress>,
}

/// The reference runs of a case so far, each computed once.
#[derive(Clone, Debug, Default)]
pub(super) struct ReferenceRuns {
    known: Vec<ReferenceRun>,
    element_updates: u64,
}

/// The collision that reference runs are compared with.
#[derive(Clone, Copy, Debug)]
pub(super) struct EstimatedCollision<'a> {
    pub simulation: &'a Simulation,
    pub approach: Approach,
    pub plan: &'a Plan,
    /// Element size at the contact, m.
    pub size: f64,
}

impl<'a> EstimatedCollision<'a> {
    /// Returns the planned collision; `None` for models without elements.
    pub fn planned(simulation: &'a Simulation) -> Option<Self> {
        let setup = simulation.setup();
        let plan = &setup.elements.as_ref()?.plan;
        Some(Self { simulation, approach: setup.approach, plan, size: plan.contact_element_size })
    }

    /// Returns the key by which the case replaces the chosen mesh away from the contact, if it does.
    pub fn far_mesh_key(&self) -> Option<&'static str> {
        let radius = self.simulation.estimate(&self.approach)?.contact_radius;
        self.plan.far_mesh_key(self.simulation.case().scene(), radius)
    }

    fn staggered(&self) -> Setting {
        Setting::Staggered(self.plan.finer_body.is_some())
    }
}

impl ReferenceRuns {
    /// Returns the element updates of all reference runs so far.
    pub fn element_updates(&self) -> u64 {
        self.element_updates
    }

    /// Counts a further run.
    pub fn count(&mut self, collision: &Collision) {
        self.element_updates += collision.element_updates.unwrap_or(0);
    }

    /// Returns the errors of condensed bodies on the mesh of explicit elements, and their values there.
    pub fn condensed(&mut self, subject: &EstimatedCollision<'_>) -> Option<(Values, Values)> {
        let settings = [condensed(true), Setting::ElementSize(subject.size), subject.staggered()];
        let values = self.values(subject, &settings, FarMesh::AsGiven)?;
        Some((self.error_of(subject, values, subject.size)?, values))
    }

    /// Returns the errors on a mesh file; `values` are those of condensed bodies on it, computed here for explicit
    /// elements.
    pub fn mesh_file(
        &mut self,
        subject: &EstimatedCollision<'_>,
        values: Option<Values>,
        across: f64,
    ) -> Option<Values> {
        let values = match values {
            Some(values) => values,
            None => self.values(subject, &[condensed(true)], FarMesh::AsGiven)?,
        };
        let size = if across < FEW_ACROSS { subject.size } else { 2.0 * subject.size };
        self.error_of(subject, values, size)
    }

    /// Returns the errors from a run of the model itself with longer elements, plus those of the mesh away from the
    /// contact if the case gives it.
    pub fn coarser(&mut self, subject: &EstimatedCollision<'_>, values: Values) -> Option<Values> {
        COARSER_ELEMENT_RATIOS.into_iter().find_map(|ratio| {
            let settings = [Setting::ElementSize(ratio * subject.size), subject.staggered()];
            let coarse = self.values(subject, &settings, FarMesh::AsGiven)?;
            let near = errors(values, extrapolated(coarse, values, ratio));
            let chosen = self.values(subject, &settings, FarMesh::ByRule)?;
            let (far, of_condensed) = (errors(coarse, chosen), self.far_mesh(subject));
            Some(std::array::from_fn(|k| {
                let of_condensed = of_condensed.and_then(|of| of[k]).unwrap_or(0.0);
                Some(near[k]? + far[k]?.max(of_condensed))
            }))
        })
    }

    /// Returns the change of each quantity by the mesh away from the contact, as the case gives it.
    pub fn far_mesh(&mut self, subject: &EstimatedCollision<'_>) -> Option<Values> {
        subject.far_mesh_key()?;
        let settings = [condensed(true), Setting::ElementSize(subject.size)];
        let given = self.values(subject, &settings, FarMesh::AsGiven)?;
        let chosen = self.values(subject, &settings, FarMesh::ByRule)?;
        Some(errors(given, chosen))
    }

    /// Returns the element updates of the collision over those that closed forms expect, from a coarser run of about
    /// `most` element updates.
    pub fn updates_over_expected(
        &mut self,
        subject: &EstimatedCollision<'_>,
        most: u64,
    ) -> Option<f64> {
        let Cost::Steps { element_updates, .. } = subject.simulation.setup().cost else {
            return None;
        };
        let ratio = (element_updates as f64 / most as f64).cbrt().max(COARSER_ELEMENT_RATIOS[0]);
        let settings = [Setting::ElementSize(ratio * subject.size), subject.staggered()];
        let most = (MAX_UPDATES_OVER_EXPECTED * most as f64) as u64;
        let run = self.run(subject, &settings, FarMesh::AsGiven, most)?;
        run.values.map(|_| run.updates_over_expected)
    }

    /// Returns the error of a stress from the coarser run of the model itself.
    pub fn stress_of_coarser(
        &mut self,
        subject: &EstimatedCollision<'_>,
        stress: &ContactStress,
    ) -> Option<StressError> {
        COARSER_ELEMENT_RATIOS.into_iter().find_map(|ratio| {
            let settings = [Setting::ElementSize(ratio * subject.size), subject.staggered()];
            let run = self.run(subject, &settings, FarMesh::AsGiven, u64::MAX)?;
            stress.error(run.stress.as_ref()?, ratio)
        })
    }

    /// Returns the error of a stress from condensed bodies with elements half as large, whose nodes touch exactly.
    pub fn stress_of_condensed(
        &mut self,
        subject: &EstimatedCollision<'_>,
        stress: &ContactStress,
    ) -> Option<StressError> {
        let size = Setting::ElementSize(0.5 * subject.size);
        let settings = [condensed(false), size, Setting::Staggered(false)];
        let snapshots = SnapshotRequest::Labels(vec![SnapshotInstant::Maximum]);
        let request = OutputRequest { snapshots, ..OutputRequest::quantities() };
        let (reference, collision) = collide(subject, &settings, FarMesh::ByRule, &request)?;
        self.count(&collision);
        stress.error(&ContactStress::of(&reference, &collision)?, 0.5)
    }

    /// Returns whether a condensed reference run of a collision has been computed.
    pub fn has_condensed(&self, approach: &Approach) -> bool {
        let is_condensed = |run: &ReferenceRun| {
            run.settings.contains(&condensed(false)) && run.approach == *approach
        };
        self.known.iter().any(is_condensed)
    }

    /// Returns the errors of values against the limit of condensed bodies whose nodes touch exactly, with elements of
    /// about this size (m) and half of it; the edge of the contact is at a node of both.
    fn error_of(
        &mut self,
        subject: &EstimatedCollision<'_>,
        values: Values,
        size: f64,
    ) -> Option<Values> {
        let size = match values[QuantityOfInterest::MaxContactRadius as usize] {
            Some(radius) if radius > size => radius / (radius / size).round(),
            _ => size,
        };
        let mut on = |size: f64| {
            let settings =
                [condensed(false), Setting::ElementSize(size), Setting::Staggered(false)];
            self.values(subject, &settings, FarMesh::ByRule)
        };
        let (coarse, fine) = (on(size)?, on(0.5 * size)?);
        Some(errors(values, extrapolated(coarse, fine, 2.0)))
    }

    fn values(
        &mut self,
        subject: &EstimatedCollision<'_>,
        settings: &[Setting],
        far_mesh: FarMesh,
    ) -> Option<Values> {
        self.run(subject, settings, far_mesh, u64::MAX)?.values
    }

    /// Returns a reference run, computed if it is not known; `None` if it takes more element updates than allowed.
    fn run(
        &mut self,
        subject: &EstimatedCollision<'_>,
        settings: &[Setting],
        far_mesh: FarMesh,
        most_element_updates: u64,
    ) -> Option<&ReferenceRun> {
        // Without a key of the case both meshes are the same.
        let far_mesh = if subject.far_mesh_key().is_some() { far_mesh } else { FarMesh::AsGiven };
        let is_it = |run: &ReferenceRun| {
            run.approach == subject.approach && run.settings == settings && run.far_mesh == far_mesh
        };
        if let Some(k) = self.known.iter().position(is_it) {
            return Some(&self.known[k]);
        }
        // The stress is free in a run of the model itself; condensed bodies compute their motion again for it.
        let is_own = !settings.iter().any(|it| matches!(it, Setting::Condensed { .. }));
        let snapshots = match is_own && !subject.simulation.request().snapshots.is_empty() {
            true => SnapshotRequest::Labels(vec![SnapshotInstant::Maximum]),
            false => SnapshotRequest::none(),
        };
        let request =
            OutputRequest { most_element_updates, snapshots, ..OutputRequest::quantities() };
        let collided = collide(subject, settings, far_mesh, &request);
        let (mut values, mut updates_over_expected, mut stress) = (None, 1.0, None);
        if let Some((reference, collision)) = collided {
            self.count(&collision);
            if collision.is_complete() {
                values = Some(QuantityOfInterest::ALL.map(|quantity| quantity.of(&collision)));
                updates_over_expected = updates_ratio(&reference, &collision).unwrap_or(1.0);
                stress = ContactStress::of(&reference, &collision);
            } else if most_element_updates < u64::MAX {
                return None;
            }
        }
        self.known.push(ReferenceRun {
            approach: subject.approach,
            settings: settings.to_vec(),
            far_mesh,
            values,
            updates_over_expected,
            stress,
        });
        self.known.last()
    }
}

fn condensed(penalty_springs: bool) -> Setting {
    Setting::Condensed { vibration_modes: 0, penalty_springs }
}

/// Computes the first contact of the bodies with these settings; `None` if the model rejects them.
fn collide(
    subject: &EstimatedCollision<'_>,
    settings: &[Setting],
    far_mesh: FarMesh,
    request: &OutputRequest,
) -> Option<(Simulation, Collision)> {
    let EstimatedCollision { simulation, approach, .. } = subject;
    let is_condensed = settings.iter().any(|it| matches!(it, Setting::Condensed { .. }));
    let case = simulation.case().edited(|file| {
        file.stop = first_contact(file);
        // If the case leaves the model open, the selected one is used.
        file.model = simulation.resolved().model.clone();
        if is_condensed {
            // Condensed bodies lack these effects and springs, and are half-spaces where the contact is on a plate.
            file.effects = None;
            file.body.iter_mut().for_each(BodyTable::make_plate_half_space);
            if let Some(mesh) = file.mesh.as_mut().filter(|_| subject.plan.estimate.bends) {
                mesh.far_radius = None;
            }
            let contact = file.contact.as_mut();
            if let Some(method) = contact.and_then(|contact| contact.method.as_mut())
                && *method == ContactMethod::NodeToSurface
            {
                *method = ContactMethod::Massless;
            }
        }
        for setting in settings {
            setting.apply(file);
        }
        if let (FarMesh::ByRule, Some(mesh)) = (far_mesh, file.mesh.as_mut()) {
            (mesh.growth, mesh.refined_radius) = (None, None);
            // The mesh rule depends on the speed.
            *file = simulation.with_approach(file.clone(), approach);
        }
        if settings.iter().any(|it| matches!(it, Setting::ElementSize(_))) {
            let spheres = file.body.iter_mut().filter_map(|body| body.sphere.as_mut());
            spheres.for_each(|sphere| sphere.mesh = None);
        }
        let table = file.model.as_mut().and_then(|model| model.condensed.as_mut());
        if let Some(table) = table {
            let own = table.steps.as_ref().and_then(|steps| steps.si().ok());
            let usual = defaults::CONDENSED.steps as f64;
            let steps = match own {
                _ if is_condensed => STEPS_FOR_EXPLICIT,
                Some(own) if own > usual => own,
                own => own.unwrap_or(STEPS_FOR_CONDENSED).min(STEPS_FOR_CONDENSED),
            };
            table.steps = Some(Quantity::from_si(steps));
        }
    });
    // A run with fields needs its factors twice.
    let is_of_reference_runs = request.snapshots.is_empty();
    let shared = SharedModels { is_of_reference_runs, ..simulation.shared().for_reference_runs() };
    let reference = Simulation::sharing(case.ok()?, &shared).ok()?;
    let collision = reference.model().collide(approach, request, &mut ());
    Some((reference, collision))
}

/// Returns the element updates of a collision over those that closed forms expect. Flattened elements have shorter steps,
/// and a body that stiffens separates sooner.
fn updates_ratio(simulation: &Simulation, collision: &Collision) -> Option<f64> {
    let Cost::Steps { element_updates, .. } = simulation.setup().cost else { return None };
    Some(collision.element_updates? as f64 / element_updates as f64)
}

/// Returns the Richardson limit of values whose elements differ by this ratio.
fn extrapolated(coarse: Values, fine: Values, ratio: f64) -> Values {
    let rest = 1.0 / (ratio.powf(ORDER) - 1.0);
    std::array::from_fn(|k| Some(fine[k]? + rest * (fine[k]? - coarse[k]?)))
}

/// Returns the distance of values from a limit: the restitution's absolute, others relative.
fn errors(values: Values, limit: Values) -> Values {
    QuantityOfInterest::ALL.map(|quantity| {
        let (value, limit) = (values[quantity as usize]?, limit[quantity as usize]?);
        Some((value - limit).abs() / quantity.scale(limit))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values that converge with the assumed order are exact after extrapolation, for any ratio.
    #[test]
    fn the_limit_of_a_power_law_is_exact() {
        for ratio in [1.5, 2.0] {
            let on =
                |size: f64| QuantityOfInterest::ALL.map(|_| Some(3.0 + 0.1 * size.powf(ORDER)));
            let limit = extrapolated(on(ratio), on(1.0), ratio);
            assert!(limit.iter().all(|limit| (limit.unwrap() - 3.0).abs() < 1e-12), "{limit:?}");
            let errors = errors(on(1.0), limit);
            assert!((errors[0].unwrap() - 0.1).abs() < 1e-12, "the restitution is absolute");
            assert!((errors[1].unwrap() - 0.1 / 3.0).abs() < 1e-12, "others are relative");
        }
        assert_eq!(extrapolated([None; 6], [Some(1.0); 6], 2.0), [None; 6]);
    }
}
