//! Elastic null: the restitution that a relaxing run would lose by its mesh and settings without relaxation.
//!
//! It is estimated from the run's own energy balance: vibrations, radiated waves, numerical dissipation and the residual.
//! An elastic run keeps vibrations that have relaxed here since they were excited, mostly while nodes entered the contact.
//! The energy of oscillations much faster than relaxation falls as
//!
//! ```math
//! \exp\Bigl(-t \sum_k \frac{g_k}{\tau_k}\Bigr), \qquad t = 0.8\,T.
//! ```
//!
//! For the glass pair the estimate is right to a third: 8.3e-6, 6.7e-6 and 7.9e-6 with βT = 0.17, 0.5 and 1.9, against
//! 9.9e-6 from a run with relaxation off on the same mesh. If the vibrations have relaxed almost completely, a run with
//! relaxation off and elements 1.5 times as long is made instead, which gives 0.6 to 2.8 times the value of the same mesh.

use fem_case::Case;
use fem_case::schema::{OutputTable, Switch};
use fem_collision::{Account, Approach, Collision, OutputRequest};
use fem_material::PronySeries;
use serde::Serialize;

use super::reference_runs::{COARSER_ELEMENT_RATIOS, ReferenceRuns};
use super::setting::Setting;
use crate::simulation::Simulation;

/// Time for which vibrations relax, over the contact time.
const RELAXATION_TIME_OVER_CONTACT_TIME: f64 = 0.8;
/// Decay of the vibrations above which the run does not show them, ...
const MAX_DECAY: f64 = 8.0;
/// ... unless even the undecayed ones were at most this share of the energy.
const LITTLE_VIBRATION_ENERGY: f64 = 1e-5;

/// The loss of restitution of elastic bodies on the same mesh with the same settings.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ElasticNull {
    /// 1 − restitution.
    pub one_minus_restitution: f64,
    /// The part of it by vibrations and radiated waves, which are physics; the rest is numerical. `None` if an elastic run
    /// gives the sum alone.
    pub vibrations: Option<f64>,
    /// Whether the relaxing run itself gives the estimate; otherwise an elastic run on a coarser mesh does.
    pub estimated: bool,
}

/// Returns the elastic null of a finished run of relaxing bodies with elements; `None` under gravity, with its several
/// contacts.
pub(super) fn elastic_null(
    simulation: &Simulation,
    collision: &Collision,
    runs: &mut ReferenceRuns,
) -> Option<ElasticNull> {
    let scene = simulation.case().scene();
    let relaxed = collision.energies.get(Account::ViscousDissipation)? > 0.0;
    if !relaxed || scene.gravity().is_some() || !collision.is_complete() {
        return None;
    }
    let contact_time = collision.contact_time?;
    let inverse_mass: f64 =
        collision.bodies.iter().filter_map(|body| Some(body.mass?.recip())).sum();
    let initial = 0.5 * collision.approach.speed().powi(2) / inverse_mass;
    let (mut vibrating, numerical) = (0.0, collision.residual?.abs());
    let (mut has_elements, mut is_gone) = (false, false);
    for (named, body) in scene.bodies().iter().zip(&collision.bodies) {
        has_elements |= body.elements.is_some_and(|elements| elements > 0);
        let series = named.material().and_then(|material| material.relaxation());
        // −Ġ/G just after a sudden strain, 1/s.
        let terms = series.into_iter().flat_map(PronySeries::terms);
        let rate: f64 = terms.map(|term| term.weight / term.relaxation_time).sum();
        let relaxed = (RELAXATION_TIME_OVER_CONTACT_TIME * contact_time * rate).exp();
        let vibrations = body.vibration_energy.unwrap_or(0.0) * relaxed;
        is_gone |= relaxed > MAX_DECAY
            && vibrations.is_nan() | (vibrations > LITTLE_VIBRATION_ENERGY * initial);
        vibrating += vibrations;
    }
    if is_gone {
        let one_minus_restitution = elastic_run(simulation, &collision.approach, runs)?;
        return Some(ElasticNull { one_minus_restitution, vibrations: None, estimated: false });
    }
    let energy = |account| collision.energies.get(account).unwrap_or(0.0);
    vibrating += energy(Account::Radiated);
    let numerical = numerical + energy(Account::BulkViscosity) + energy(Account::ContactDamping);
    let share = (vibrating + numerical) / initial;
    (has_elements && share.is_finite()).then(|| {
        let one_minus_restitution = 1.0 - (1.0 - share).max(0.0).sqrt();
        let of_vibrations = if share > 0.0 { vibrating / initial / share } else { 0.0 };
        let vibrations = Some(of_vibrations * one_minus_restitution);
        ElasticNull { one_minus_restitution, vibrations, estimated: true }
    })
}

/// Computes 1 − restitution of the same bodies without relaxation on a coarser mesh; `None` for mesh files.
fn elastic_run(
    simulation: &Simulation,
    approach: &Approach,
    runs: &mut ReferenceRuns,
) -> Option<f64> {
    let plan = &simulation.setup().elements.as_ref()?.plan;
    let mut file = simulation.resolved_at(approach);
    file.effects.get_or_insert_default().viscoelasticity = Some(Switch::Off);
    file.output = Some(OutputTable { report: Some(false), ..OutputTable::default() });
    Setting::ElementSize(COARSER_ELEMENT_RATIOS[1] * plan.contact_element_size).apply(&mut file);
    let case = Case::of(file).ok().filter(|_| plan.makes_meshes)?;
    let shared = simulation.shared().for_reference_runs();
    let elastic = Simulation::sharing(case, &shared).ok()?;
    let elastic = elastic.model().collide(approach, &OutputRequest::quantities(), &mut ());
    runs.count(&elastic);
    let restitution = elastic.restitution.filter(|_| elastic.is_complete())?;
    Some((1.0 - restitution).max(0.0))
}
