//! The collision that a run returns.

use fem_collision::{
    BodyResult, Collision, Ending, EnergyLedger, History, MAX_RESIDUAL, Snapshot, SnapshotInstant,
    Stop, longest_at_pole,
};
use fem_material::Material;
use fem_material::engineering::show;

use super::restart_state::RunState;
use crate::body::Body;
use crate::model::ExplicitBodies;
use crate::state::State;

/// Returns the collision of a run with its ending.
pub(super) fn outcome(model: &ExplicitBodies, run: RunState, ending: Ending) -> Collision {
    let parted = velocities_after(model, &run).filter(|_| ending == Ending::Parted);
    let ending = match parted {
        Some([lower, upper]) => Ending::parted(upper - lower, model.approach().speed()),
        None => ending,
    };
    let velocity_after = match ending {
        Ending::Parted => parted,
        // The velocity of the common mass centre.
        Ending::Together | Ending::AtRest => Some(model.frame().velocities(0.0)),
        Ending::Stopped(_) => None,
    };
    let mut bodies = body_results(model, &run, &ending, velocity_after);
    let warnings_of_run = run_warnings(model, &run, &ending);
    let RunState { mut state, log, ledger, sampled, history, recorder, probes, .. } = run;
    let last_valid = run.last_valid;
    let unloaded = velocity_after
        .filter(|_| ending == Ending::Parted && model.bodies().iter().any(Body::flows))
        .map(|velocity| unloaded(model, &mut state, velocity, &mut bodies));
    let (mut snapshots, mut warnings) = recorder.finish();
    if matches!(&ending, Ending::Stopped(stop) if !matches!(stop, Stop::Interrupted { .. })) {
        last_valid.put_among(&mut snapshots);
    }
    warnings.extend(warnings_of_run);
    let mut peaks = sampled.pulse.peaks(log.peak_force, resolving_size(model));
    if model.bodies().iter().any(Body::flows)
        && let Some(pressure) = sampled.pulse.steady_pressure(log.peak_force)
    {
        (peaks.pressure, peaks.pressure_radius) = (pressure, peaks.radius);
    }
    let ends = log.first_contact.zip(log.last_contact);
    let frame = model.frame();
    let scale = frame.initial() / frame.energy_scale(log.max_approach);
    // A residual that is not a number is above every limit.
    let is_balanced = scale * ledger.worst_residual <= MAX_RESIDUAL;
    Collision {
        restitution: velocity_after
            .and_then(|[lower, upper]| ending.restitution(upper - lower, model.approach().speed())),
        // A contact has a duration only if it has ended.
        contact_time: ends.filter(|_| ending == Ending::Parted).map(|(first, last)| last - first),
        first_contact: log.first_contact,
        last_contact: log.last_contact,
        contact_episodes: log.episodes,
        peak_force: Some(peaks.force),
        peak_force_raw: Some(log.peak_force),
        max_approach: Some(log.max_approach),
        max_contact_radius: Some(peaks.radius),
        peak_pressure: Some(peaks.pressure),
        peak_pressure_radius: Some(peaks.pressure_radius),
        force_scatter: sampled.force_noise.force(),
        deepest_overlap: log.deepest_overlap,
        noisiest_instant: sampled.force_noise.noisiest_instant(),
        candidate_region: Some(model.candidate_region()),
        initial_energy: Some(ledger.initial),
        energies: sampled.last.map_or(EnergyLedger::EMPTY, |row| row.energies),
        residual: sampled.last.and_then(|row| row.residual),
        residual_relative: Some(scale * ledger.worst_residual),
        residual_since: ledger.beyond.filter(|_| !is_balanced),
        energy_growth: Some(scale * ledger.growth),
        momentum_residual_relative: Some(ledger.worst_momentum),
        bodies,
        time_step: Some(model.time_step()),
        plain_time_step: Some(model.plain_time_step()),
        steps: Some(state.step),
        element_updates: Some(state.step.saturating_mul(model.n_elements() as u64)),
        history: history.map_or_else(Vec::new, History::into_rows),
        snapshots,
        unloaded,
        probes,
        warnings,
        ..Collision::empty(*model.approach(), ending)
    }
}

/// Returns the velocities of both mass centres after the contact, m/s.
fn velocities_after(model: &ExplicitBodies, run: &RunState) -> Option<[f64; 2]> {
    run.sampled.last.map(|row| {
        // Without the acceleration during the flight since the end of the contact.
        let flight = run.log.last_contact.map_or(0.0, |last| row.time - last);
        [0, 1].map(|side: usize| row.velocity[side] - model.bodies()[side].acceleration * flight)
    })
}

/// Returns the results of both bodies.
fn body_results(
    model: &ExplicitBodies,
    run: &RunState,
    ending: &Ending,
    velocity_after: Option<[f64; 2]>,
) -> [BodyResult; 2] {
    let vibration = run.sampled.vibration_after.as_ref().filter(|_| *ending == Ending::Parted);
    let vibration_energy = vibration.and_then(|vibration| vibration.vibration_energy());
    [0, 1].map(|side: usize| {
        let body = &model.bodies()[side];
        let is_moved = !body.is_wall();
        BodyResult {
            elements: Some(body.n_elements()),
            nodes: Some(body.n_nodes()),
            mass: body.is_free().then(|| body.mass()),
            moved_mass: is_moved.then(|| body.moved_mass()),
            velocity_after: velocity_after.map(|both| both[side]),
            vibration_energy: vibration_energy.filter(|_| is_moved).map(|both| both[side]),
            locked_in: None,
        }
    })
}

/// Takes the bodies that flow to their equilibrium. Returns the snapshot of both bodies, whose mass centres move at these
/// velocities (m/s), and enters the elastic energies that they hold into their results.
fn unloaded(
    model: &ExplicitBodies,
    state: &mut State,
    velocity: [f64; 2],
    results: &mut [BodyResult; 2],
) -> Snapshot {
    let mut snapshot = Snapshot {
        label: Some(SnapshotInstant::AfterSeparation),
        time: state.time,
        ..Snapshot::default()
    };
    let clock = state.clock(model);
    for (side, body) in model.bodies().iter().enumerate().filter(|(_, body)| body.mesh().is_some())
    {
        let (own, fields) = (&mut state.bodies[side], &mut snapshot.bodies[side]);
        body.settle(own, clock);
        body.update_stress_fields(own, fields);
        fields.velocity = vec![[0.0, velocity[side]]; body.n_nodes()];
        if body.flows() {
            results[side].locked_in =
                Some(body.elastic_energy(&own.motion(body, clock), &own.history));
        }
    }
    snapshot
}

/// Returns the warnings of material instability, of bodies that stay together, and of waves that came back.
fn run_warnings(model: &ExplicitBodies, run: &RunState, ending: &Ending) -> Vec<String> {
    let is_of_stability = matches!(ending, Ending::Stopped(Stop::StabilityLost { .. }));
    let unstable = run.stability.warning().filter(|_| !is_of_stability);
    let is_together = matches!(ending, Ending::Together | Ending::AtRest);
    // Bodies that stay together may do so for as long as their own viscosity asks; a plate that moves on does not.
    let is_plate = |body: &Body| body.mesh().is_some_and(|mesh| mesh.thickness().is_some());
    let counts = !is_together || model.bodies().iter().any(is_plate);
    let ends = run.log.first_contact.zip(run.log.last_contact).filter(|_| counts);
    let returned =
        ends.zip(model.waves_return()).filter(|((first, last), time)| last - first > *time);
    let waves = returned.map(|((first, last), time)| {
        // The contact lasts a little longer or shorter on another mesh.
        let enough = model.far_radius_without_return(1.05 * (last - first));
        format!(
            "{} after first touch waves that were reflected at the end of the mesh of a half-space or plate were back at \
             the contact; an unbounded body reflects none: set mesh.far_radius = \"{}\" or more",
            show(time, "s"),
            show(enough, "m")
        )
    });
    unstable.into_iter().chain(ending.together_warning()).chain(waves).collect()
}

/// Ratio of approach speed to shear wave speed from which first touch makes a steep front, whose peak pressure depends
/// on the mesh.
const MACH_OF_STEEP_FRONTS: f64 = 0.02;

/// Returns the element size (m) from which the pressure counts as a peak, as soon as the contact spans two of them;
/// infinite where first touch makes a steep front. A body that flows carries its largest pressure throughout, and an early
/// peak of it is noise.
fn resolving_size(model: &ExplicitBodies) -> f64 {
    let mut materials = model.bodies().iter().filter_map(Body::material);
    let is_slow = |material: &Material| {
        let is_slow = model.approach().speed() < MACH_OF_STEEP_FRONTS * material.shear_wave_speed();
        is_slow && material.flow().is_none()
    };
    match materials.all(is_slow) {
        true => longest_at_pole(model.bodies().each_ref().map(Body::mesh)),
        false => f64::INFINITY,
    }
}
