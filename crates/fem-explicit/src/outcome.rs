//! What a run leaves, as a collision.

use fem_collision::{
    BodyResult, Collision, Ending, EnergyLedger, History, LARGEST_RESIDUAL, STAY_TOGETHER, Stop,
    longest_at_pole,
};
use fem_material::Material;
use fem_material::engineering::show;

use crate::body::Body;
use crate::memory::Memory;
use crate::model::Model;

/// The collision of a run that ended like this.
pub(crate) fn outcome(model: &Model, memory: Memory, ending: Ending) -> Collision {
    let Memory {
        state, log, ledger, observed, history, recorder, probes, sound, stability, ..
    } = memory;
    let (is_complete, is_parted) =
        (!matches!(ending, Ending::Stopped(_)), ending == Ending::Parted);
    let bodies = model.bodies();
    let velocity_after = match ending {
        Ending::Parted => observed.last.map(|row| {
            // As they were when the contact ended.
            let flight = log.last_contact.map_or(0.0, |last| row.time - last);
            [0, 1].map(|side: usize| row.velocity[side] - bodies[side].acceleration * flight)
        }),
        // With the common mass centre.
        Ending::Together | Ending::AtRest => Some(model.frame().velocities(0.0)),
        Ending::Stopped(_) => None,
    };
    let vibration_energy =
        observed.aftermath.filter(|_| is_parted).and_then(|aftermath| aftermath.vibration_energy());
    let speed = model.approach().speed();
    let bodies = [0, 1].map(|side: usize| {
        let body = &bodies[side];
        let is_moved = !body.is_wall();
        BodyResult {
            elements: Some(body.n_elements()),
            nodes: Some(body.n_nodes()),
            mass: body.is_free().then(|| body.mass()),
            added_mass: is_moved.then(|| body.added_mass()),
            velocity_after: velocity_after.map(|both| both[side]),
            vibration_energy: vibration_energy.filter(|_| is_moved).map(|both| both[side]),
        }
    });
    let ends = log.first_contact.zip(log.last_contact);
    let peaks = observed.pulse.peaks(log.peak_force, resolving(model));
    let (mut snapshots, mut warnings) = recorder.finish();
    let has_failed =
        matches!(&ending, Ending::Stopped(stop) if !matches!(stop, Stop::Interrupted { .. }));
    if has_failed {
        sound.put_among(&mut snapshots);
    }
    let is_of_stability = matches!(&ending, Ending::Stopped(Stop::StabilityLost { .. }));
    warnings.extend(stability.warning().filter(|_| !is_of_stability));
    if is_complete && !is_parted {
        warnings.push(STAY_TOGETHER.to_string());
    }
    let is_together = is_complete && !is_parted;
    let lasted = ends.filter(|_| !is_together).map(|(first, last)| last - first);
    if let (Some(lasted), Some(time)) = (lasted, model.waves_return())
        && lasted > time
    {
        warnings.push(format!(
            "{} after first touch waves were back at the contact from the end of the \
             half-space's mesh, as they never are from a half-space; a larger far radius keeps them away",
            show(time, "s")
        ));
    }
    let frame = model.frame();
    let of_stake = frame.initial() / frame.energy_at_stake(log.max_approach);
    // What is no number is above every limit.
    let is_sound = of_stake * ledger.worst_residual <= LARGEST_RESIDUAL;
    Collision {
        approach: *model.approach(),
        ending,
        restitution: velocity_after
            .map(|[lower, upper]| if is_parted { (upper - lower) / speed } else { 0.0 }),
        // A contact that was left before its end has no duration, nor has one without an end.
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
        force_scatter: observed.scatter.force(),
        deepest: log.deepest,
        noisiest: observed.scatter.noisiest(),
        searched: Some(model.searched()),
        initial_energy: Some(ledger.initial),
        energies: observed.last.map_or(EnergyLedger::EMPTY, |row| row.energies),
        residual: observed.last.and_then(|row| row.residual),
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
    }
}

/// Approach speed over that of shear waves from which first touch is a front, whose pressure is the mesh's: a ball of
/// rubber at 10 m/s has one, and no more of it on a finer mesh.
const FRONTS: f64 = 0.02;

/// Elements (m) of which two resolve a pressure of early contact; without limit where it is that of first touch.
fn resolving(model: &Model) -> f64 {
    let mut materials = model.bodies().iter().filter_map(Body::material);
    let is_slow =
        |material: &Material| model.approach().speed() < FRONTS * material.shear_wave_speed();
    match materials.all(is_slow) {
        true => longest_at_pole(model.bodies().each_ref().map(Body::mesh)),
        false => f64::INFINITY,
    }
}
