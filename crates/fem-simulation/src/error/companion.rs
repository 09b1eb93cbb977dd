//! Cheaper collisions of the same bodies, by which it is told what a mesh is off by: condensed bodies in place of
//! explicit elements, and meshes that are coarser or finer.

use std::sync::PoisonError;

use fem_case::schema::{ContactMethod, StopTable};
use fem_case::{CaseFile, CondensedOptions, Quantity};
use fem_collision::{Approach, OutputRequest, QuantityOfInterest};

use super::foretold::lengthening;
use super::setting::Setting;
use crate::estimate::Estimate;
use crate::plan::Plan;
use crate::simulation::Simulation;

/// Errors of a sequence of meshes fall with this power of the length of their elements.
pub(crate) const ORDER: f64 = 1.9;
/// Elements of coarser companions over those of the collision.
pub(super) const COARSER: [f64; 2] = [1.5, 2.0];
/// Over the shear wave speed the speed of an impact of which condensed bodies tell what meshes do: rubber on a
/// wall at twice that is off by 1.4 % of the contact time where they find 0.3 %.
pub(super) const SLOW: f64 = 0.02;
/// Steps of condensed companions of explicit elements over the elastic contact time: a restitution to 4e-5,
/// and the same of all three, of which differences are taken.
const STEPS: f64 = 120.0;
/// The same of condensed companions of condensed bodies, which may have more: a restitution to 2e-5.
const OWN_STEPS: f64 = 160.0;
/// Errors that are told over what the mesh away from the contact changes.
const MARGIN_OF_FAR_MESH: f64 = 1.3;
/// Contact radius over effective radius up to which meshes do at finite strain what they do at small strain:
/// there the two differ by the same on all meshes with eight elements or more across, to 0.02 % of time and force.
pub(super) const FLAT: f64 = 0.1;

/// The numbers of condensed bodies with springs, and what they are off by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Beside {
    pub(super) values: [Option<f64>; 6],
    pub(super) errors: [Option<f64>; 6],
}

/// Element updates of the companions of explicit elements over those of the collision, Σ r⁻³, whose impact has this
/// speed over that of shear waves and this strain; none where condensed bodies are its companions. These know no
/// large strains, nor what keeps such surfaces apart, and no waves.
pub(crate) fn companion_updates(
    [mach, strain]: [f64; 2],
    is_at_finite_strain: bool,
) -> Option<f64> {
    // A strain that is no number is not small.
    let is_large = is_at_finite_strain && (strain.is_nan() || strain >= FLAT);
    (is_large || mach >= SLOW).then(|| COARSER.into_iter().map(|ratio: f64| ratio.powi(-3)).sum())
}

/// A companion of a model itself with longer elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Coarser {
    /// How the bodies met.
    pub(super) approach: Approach,
    /// Length of the elements at the contact, m.
    pub(super) size: f64,
    /// In the order of [`QuantityOfInterest::ALL`].
    pub(super) values: [Option<f64>; 6],
    /// See [`lengthening`].
    pub(super) lengthening: f64,
}

/// How meshes go on away from the contact.
#[derive(Clone, Copy, Debug, PartialEq)]
enum FarMesh {
    AsGiven,
    Chosen,
}

/// Cheaper collisions of the same bodies.
pub(super) struct Companions<'a> {
    pub(super) simulation: &'a Simulation,
    /// How the bodies meet.
    pub(super) approach: Approach,
    pub(super) plan: &'a Plan,
    /// Length of the elements at the contact, m.
    pub(super) size: f64,
}

impl<'a> Companions<'a> {
    /// Of a collision that is planned; none of models without elements.
    pub(super) fn of_what_is_planned(simulation: &'a Simulation) -> Option<Self> {
        let setup = simulation.setup();
        let plan = &setup.elements.as_ref()?.plan;
        Some(Self { simulation, approach: setup.approach, plan, size: plan.contact_element_size })
    }

    /// Errors of explicit elements, the restitution's absolute, all others relative; none where condensed
    /// bodies cannot be had. What they were is kept: they are asked for before a collision and after it.
    pub(super) fn of_condensed(&self) -> Option<Beside> {
        // Who panicked has left nothing half written.
        let mut known = self.simulation.condensed.lock().unwrap_or_else(PoisonError::into_inner);
        match *known {
            Some((approach, beside)) if approach == self.approach => beside,
            _ => {
                let beside = self.condensed_anew();
                *known = Some((self.approach, beside));
                beside
            }
        }
    }

    fn condensed_anew(&self) -> Option<Beside> {
        let values = self.collide(&[
            Setting::Condensed { vibration_modes: 0, penalty_springs: true },
            Setting::ElementSize(self.size),
            Setting::Staggered(self.plan.finer_body.is_some()),
        ])?;
        Some(Beside { values, errors: self.beside_touching(values, self.size)? })
    }

    /// The numbers of condensed bodies with springs on the mesh of a file.
    pub(super) fn of_same_mesh(&self) -> Option<[Option<f64>; 6]> {
        self.collide(&[Setting::Condensed { vibration_modes: 0, penalty_springs: true }])
    }

    /// Errors of numbers from the mesh of a file beside the limit of meshes that are made here.
    pub(super) fn beside_made(
        &self,
        same: [Option<f64>; 6],
        is_few: bool,
    ) -> Option<[Option<f64>; 6]> {
        self.beside_touching(same, if is_few { self.size } else { 2.0 * self.size })
    }

    fn far_mesh_key(&self) -> Option<&'static str> {
        let scene = self.simulation.case().scene();
        let estimate = Estimate::at(scene, self.approach.speed()).ok()?;
        self.plan.far_mesh_key(scene, estimate.contact_radius)
    }

    /// Errors by the mesh away from the contact, where the case gives it; the restitution's absolute, all others relative.
    pub(super) fn of_far_mesh(&self) -> Option<[Option<f64>; 6]> {
        self.far_mesh_key()?;
        let [given, chosen] = [FarMesh::AsGiven, FarMesh::Chosen].map(|far_mesh| {
            let settings = [
                Setting::Condensed { vibration_modes: 0, penalty_springs: true },
                Setting::ElementSize(self.size),
            ];
            self.collide_within(&settings, far_mesh, u64::MAX)
        });
        Some(beside_chosen(given?, chosen?))
    }

    /// The same as the model itself tells it with longer elements: at large strains it is more.
    pub(super) fn of_strained_far_mesh(&self) -> Option<[Option<f64>; 6]> {
        self.far_mesh_key()?;
        let ratio = COARSER[0];
        let size = Setting::ElementSize(ratio * self.size);
        let staggered = Setting::Staggered(self.plan.finer_body.is_some());
        let given = self.with_elements(ratio, u64::MAX)?.values;
        let chosen = self.collide_within(&[size, staggered], FarMesh::Chosen, u64::MAX)?;
        Some(beside_chosen(given, chosen))
    }

    /// Errors of numbers beside the limit of nodes that touch exactly, which have no meshes that are staggered, with
    /// elements about as long (m) and half as long.
    fn beside_touching(&self, values: [Option<f64>; 6], size: f64) -> Option<[Option<f64>; 6]> {
        let size = match values[QuantityOfInterest::MaxContactRadius as usize] {
            Some(radius) if radius > size => radius / (radius / size).round(),
            _ => size,
        };
        let far_mesh = match self.far_mesh_key() {
            Some(_) => FarMesh::Chosen,
            None => FarMesh::AsGiven,
        };
        let [coarse, fine] = [size, 0.5 * size].map(|size| {
            let settings = [
                Setting::Condensed { vibration_modes: 0, penalty_springs: false },
                Setting::ElementSize(size),
                Setting::Staggered(false),
            ];
            self.collide_within(&settings, far_mesh, u64::MAX)
        });
        Some(beside_limit(values, coarse?, fine?))
    }

    /// The same from the model itself with elements that are so many times shorter.
    pub(super) fn of_finer(&self, values: [Option<f64>; 6], ratio: f64) -> [Option<f64>; 6] {
        let size = Setting::ElementSize(self.size / ratio);
        let staggered = Setting::Staggered(self.plan.finer_body.is_some());
        let fine = self.collide(&[size, staggered]).unwrap_or_default();
        QuantityOfInterest::ALL.map(|headline| {
            let k = headline as usize;
            let (fine, value) = (fine[k]?, values[k]?);
            Some((1.0 + remaining(ratio)) * (fine - value) / headline.scale(value))
        })
    }

    /// The numbers of the model itself with elements that are so many times longer; none of a run that takes more. They
    /// are kept: they are asked for before a collision and after it.
    pub(super) fn with_elements(&self, ratio: f64, most_element_updates: u64) -> Option<Coarser> {
        let size = ratio * self.size;
        // Who panicked has left nothing half written.
        let mut known = self.simulation.coarser.lock().unwrap_or_else(PoisonError::into_inner);
        let is_it = |one: &&Coarser| one.approach == self.approach && one.size == size;
        if let Some(coarser) = known.iter().find(is_it) {
            return Some(*coarser);
        }
        let staggered = Setting::Staggered(self.plan.finer_body.is_some());
        let settings = [Setting::ElementSize(size), staggered];
        let (values, lengthening) =
            self.computed(&settings, FarMesh::AsGiven, most_element_updates)?;
        let coarser = Coarser { approach: self.approach, size, values, lengthening };
        known.push(coarser);
        Some(coarser)
    }

    /// The same from the model itself with elements that are so many times longer.
    pub(super) fn of_coarser(&self, ratios: &[f64], values: [Option<f64>; 6]) -> [Option<f64>; 6] {
        let mut errors = [None; 6];
        for &ratio in ratios {
            let Some(Coarser { values: coarse, .. }) = self.with_elements(ratio, u64::MAX) else {
                continue;
            };
            for (k, headline) in QuantityOfInterest::ALL.into_iter().enumerate() {
                let both = coarse[k].zip(values[k]);
                let error = both.map(|(coarse, value)| {
                    remaining(ratio) * (coarse - value).abs() / headline.scale(value)
                });
                errors[k] =
                    error.map(|error| errors[k].map_or(error, |other: f64| error.max(other)));
            }
        }
        errors
    }

    /// The numbers of the bodies' first contact with these settings; none where the model refuses them.
    fn collide(&self, settings: &[Setting]) -> Option<[Option<f64>; 6]> {
        self.collide_within(settings, FarMesh::AsGiven, u64::MAX)
    }

    /// The same; none of a run that takes more element updates.
    fn collide_within(
        &self,
        settings: &[Setting],
        far_mesh: FarMesh,
        most_element_updates: u64,
    ) -> Option<[Option<f64>; 6]> {
        self.computed(settings, far_mesh, most_element_updates).map(|(values, _)| values)
    }

    /// The same, and by how many times it took more than closed forms announce.
    fn computed(
        &self,
        settings: &[Setting],
        far_mesh: FarMesh,
        most_element_updates: u64,
    ) -> Option<([Option<f64>; 6], f64)> {
        let case = self.simulation.case().edited(|file| {
            file.stop = first_contact(file);
            // Where the case leaves the model open, the one that was chosen.
            file.model = self.simulation.resolved().model.clone();
            let is_condensed = settings.iter().any(|it| matches!(it, Setting::Condensed { .. }));
            if is_condensed {
                // Switches of what condensed bodies lack, and springs that they have not.
                file.effects = None;
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
            if let (FarMesh::Chosen, Some(mesh)) = (far_mesh, file.mesh.as_mut()) {
                (mesh.growth, mesh.refined_radius) = (None, None);
                // What is chosen goes by the speed.
                *file = self.simulation.meeting(file.clone(), &self.approach);
            }
            if settings.iter().any(|it| matches!(it, Setting::ElementSize(_))) {
                let spheres = file.body.iter_mut().filter_map(|body| body.sphere.as_mut());
                spheres.for_each(|sphere| sphere.mesh = None);
            }
            let condensed = file.model.as_mut().and_then(|model| model.condensed.as_mut());
            if let Some(table) = condensed {
                let own = table.steps.as_ref().and_then(|steps| steps.si().ok());
                // Who asks for more than the usual ones has an instant to see that fewer do not show.
                let usual = CondensedOptions::default().steps as f64;
                let steps = match own {
                    _ if is_condensed => STEPS,
                    Some(own) if own > usual => own,
                    own => own.unwrap_or(OWN_STEPS).min(OWN_STEPS),
                };
                table.steps = Some(Quantity::from_si(steps));
            }
        });
        let shared = self.simulation.shared().of_companions();
        let companion = Simulation::sharing(case.ok()?, &shared).ok()?;
        let want = OutputRequest { most_element_updates, ..OutputRequest::quantities() };
        let collision = companion.model().collide(&self.approach, &want, &mut ());
        self.simulation.count_companion(&collision);
        let values = QuantityOfInterest::ALL.map(|headline| headline.of(&collision));
        let longer = lengthening(&companion, &collision).unwrap_or(1.0);
        collision.is_complete().then_some((values, longer))
    }
}

/// What the mesh away from the contact changes, with its margin, of numbers with the given and with the chosen one.
fn beside_chosen(given: [Option<f64>; 6], chosen: [Option<f64>; 6]) -> [Option<f64>; 6] {
    QuantityOfInterest::ALL.map(|headline| {
        let k = headline as usize;
        let (given, chosen) = (given[k]?, chosen[k]?);
        Some(MARGIN_OF_FAR_MESH * (given - chosen).abs() / headline.scale(chosen))
    })
}

/// Errors beside the limit of numbers with elements of some length and of half of it.
fn beside_limit(
    values: [Option<f64>; 6],
    coarse: [Option<f64>; 6],
    fine: [Option<f64>; 6],
) -> [Option<f64>; 6] {
    QuantityOfInterest::ALL.map(|headline| {
        let k = headline as usize;
        let limit = fine[k]? + remaining(2.0) * (fine[k]? - coarse[k]?);
        Some((values[k]? - limit) / headline.scale(limit))
    })
}

/// What is left of the way to the limit, over the last step of a length that is this many times smaller.
fn remaining(ratio: f64) -> f64 {
    1.0 / (ratio.powf(ORDER) - 1.0)
}

/// `[stop]` after the first contact, where there are more.
pub fn first_contact(file: &CaseFile) -> Option<StopTable> {
    file.gravity.as_ref()?;
    Some(StopTable { bounces: Some(Quantity::from_si(1.0)) })
}
