//! The collision that a run returns.

use fem_collision::{
    BodyResult, Collision, Ending, EnergyLedger, History, LARGEST_RESIDUAL, Stop, longest_at_pole,
};
use fem_material::Material;
use fem_material::engineering::show;

use super::restart_state::RunState;
use crate::body::Body;
use crate::model::ExplicitBodies;

/// Returns the collision of a run with its ending.
pub(super) fn outcome(model: &ExplicitBodies, run: RunState, ending: Ending) -> Collision {
    let RunState {
        state,
        log,
        ledger,
        sampled,
        history,
        recorder,
        probes,
        last_valid,
        stability,
        ..
    } = run;
    let is_parted = ending == Ending::Parted;
    let bodies = model.bodies();
    let velocity_after = match ending {
        Ending::Parted => sampled.last.map(|row| {
            // Without the acceleration during the flight since the end of the contact.
            let flight = log.last_contact.map_or(0.0, |last| row.time - last);
            [0, 1].map(|side: usize| row.velocity[side] - bodies[side].acceleration * flight)
        }),
        // The velocity of the common mass centre.
        Ending::Together | Ending::AtRest => Some(model.frame().velocities(0.0)),
        Ending::Stopped(_) => None,
    };
    let vibration_energy =
        sampled.aftermath.filter(|_| is_parted).and_then(|aftermath| aftermath.vibration_energy());
    let bodies = [0, 1].map(|side: usize| {
        let body = &bodies[side];
        let is_moved = !body.is_wall();
        BodyResult {
            elements: Some(body.n_elements()),
            nodes: Some(body.n_nodes()),
            mass: body.is_free().then(|| body.mass()),
            moved_mass: is_moved.then(|| body.moved_mass()),
            velocity_after: velocity_after.map(|both| both[side]),
            vibration_energy: vibration_energy.filter(|_| is_moved).map(|both| both[side]),
        }
    });
    let ends = log.first_contact.zip(log.last_contact);
    let peaks = sampled.pulse.peaks(log.peak_force, resolving_size(model));
    let (mut snapshots, mut warnings) = recorder.finish();
    let has_failed =
        matches!(&ending, Ending::Stopped(stop) if !matches!(stop, Stop::Interrupted { .. }));
    if has_failed {
        last_valid.put_among(&mut snapshots);
    }
    let is_of_stability = matches!(&ending, Ending::Stopped(Stop::StabilityLost { .. }));
    warnings.extend(stability.warning().filter(|_| !is_of_stability));
    warnings.extend(ending.together_warning());
    let is_together = matches!(ending, Ending::Together | Ending::AtRest);
    let lasted = ends.filter(|_| !is_together).map(|(first, last)| last - first);
    if let (Some(lasted), Some(time)) = (lasted, model.waves_return())
        && lasted > time
    {
        warnings.push(format!(
            "{} after first touch waves that were reflected at the end of the half-space's mesh were back at \
             the contact; a real half-space reflects none: set a larger far radius",
            show(time, "s")
        ));
    }
    let frame = model.frame();
    let of_stake = frame.initial() / frame.energy_scale(log.max_approach);
    // A residual that is not a number is above every limit.
    let is_sound = of_stake * ledger.worst_residual <= LARGEST_RESIDUAL;
    Collision {
        approach: *model.approach(),
        restitution: velocity_after
            .and_then(|[lower, upper]| ending.restitution(upper - lower, model.approach().speed())),
        // A contact has a duration only if it has ended.
        contact_time: ends.filter(|_| is_parted).map(|(first, last)| last - first),
        first_contact: log.first_contact,
        last_contact: log.last_contact,
        contact_episodes: log.episodes,
        peak_force: Some(peaks.force),
        peak_force_raw: Some(log.peak_force),
        max_approach: Some(log.max_approach),
        max_contact_radius: Some(peaks.radius),
        peak_pressure: Some(peaks.pressure),
        peak_pressure_radius: Some(peaks.pressure_radius),
        force_scatter: sampled.scatter.force(),
        deepest_overlap: log.deepest_overlap,
        noisiest_instant: sampled.scatter.noisiest_instant(),
        candidate_region: Some(model.candidate_region()),
        initial_energy: Some(ledger.initial),
        energies: sampled.last.map_or(EnergyLedger::EMPTY, |row| row.energies),
        residual: sampled.last.and_then(|row| row.residual),
        residual_relative: Some(of_stake * ledger.worst_residual),
        residual_since: ledger.beyond.filter(|_| !is_sound),
        energy_growth: Some(of_stake * ledger.growth),
        momentum_residual_relative: Some(ledger.worst_momentum),
        bodies,
        time_step: Some(model.time_step()),
        plain_time_step: Some(model.plain_time_step()),
        steps: Some(state.step),
        element_updates: Some(state.step.saturating_mul(model.n_elements() as u64)),
        factor_bytes: None,
        repeated_contact_solutions: None,
        bounces: Vec::new(),
        rest: None,
        history: history.map_or_else(Vec::new, History::into_rows),
        snapshots,
        probes,
        warnings,
        ending,
    }
}

/// Ratio of approach speed to shear wave speed from which first touch makes a steep front, whose peak pressure depends
/// on the mesh.
const MACH_OF_STEEP_FRONTS: f64 = 0.02;

/// Returns the element size (m) from which the pressure counts as a peak, as soon as the contact spans two of them; infinite
/// where first touch makes a steep front.
fn resolving_size(model: &ExplicitBodies) -> f64 {
    let mut materials = model.bodies().iter().filter_map(Body::material);
    let is_slow = |material: &Material| {
        model.approach().speed() < MACH_OF_STEEP_FRONTS * material.shear_wave_speed()
    };
    match materials.all(is_slow) {
        true => longest_at_pole(model.bodies().each_ref().map(Body::mesh)),
        false => f64::INFINITY,
    }
}
