//! Probes and stress fields: they agree with the run's own fields and with closed forms, and do not change the run.

use fem_case::schema::{
    BodyTable, MaterialTable, MeshTable, ModelTable, OutputTable, SnapshotsValue,
};
use fem_case::{Case, CaseFile};
use fem_collision::{Collision, Snapshot, SnapshotInstant};
use fem_simulation::Simulation;

use crate::scene::{GLASS, collision_of, refused_of, simulation_of};

const COARSE: &str = "mesh.contact_element_size='60 um'";
/// Probes at the contact pole of the target, below it off the axis, and at the centre of the striker.
const PROBES: &str = "output.probe=[{body='target', r=0, y=0}, \
    {body='target', r='0.1 mm', y='0.15 mm'}, {body='striker', r=0, y='-11.1 mm'}]";

fn simulation(overrides: &[&str]) -> Simulation {
    simulation_of(GLASS, overrides)
}

fn run(overrides: &[&str]) -> Collision {
    collision_of(GLASS, overrides)
}

/// Returns the sample with the largest approach.
fn deepest(samples: &[Snapshot]) -> &Snapshot {
    samples.iter().max_by(|one, other| one.approach.total_cmp(&other.approach)).unwrap()
}

/// A run with probes has the same steps, bits and warnings; a run without them has no samples.
#[test]
fn probes_do_not_change_the_run() {
    for model in ["model.fem={}", "model.condensed={}"] {
        let without = run(&[COARSE, model]);
        let mut with = run(&[COARSE, model, PROBES]);
        assert!(without.probes.is_empty() && with.probes.len() > 100, "{}", with.probes.len());
        with.probes.clear();
        assert_eq!(with, without);
    }
}

/// The displacement is the integral of the velocity, and the body's centre moves like its mass centre, within the strains
/// there, about 1e-4 of the approach.
#[test]
fn displacement_is_the_integral_of_velocity() {
    for model in ["model.fem={}", "model.condensed={}"] {
        let seen = run(&[COARSE, model, PROBES]).probes;
        for (side, k) in [(1, 0), (1, 1), (0, 2)] {
            let at =
                |one: &Snapshot| (one.displacement(side)[k][1], one.bodies[side].velocity[k][1]);
            let mut way = 0.0;
            for two in seen.windows(2) {
                let ((_, before), (_, after)) = (at(&two[0]), at(&two[1]));
                way += 0.5 * (two[1].time - two[0].time) * (before + after);
            }
            let moved = at(&seen[seen.len() - 1]).0 - at(&seen[0]).0;
            // The trapezoidal rule over some hundred instants; the striker goes 30 um.
            assert!((way - moved).abs() < 5e-8, "{model} {side} {k}: {way:e} {moved:e}");
        }
        let first = &seen[0];
        assert_eq!(first.displacement(0)[2], [0.0; 2]);
        // What the first difference of the springs adds in the condensed model.
        assert!((first.bodies[0].velocity[2][1] - 0.5).abs() < 1e-3);
    }
}

/// The stress at the pole is the contact pressure, and both models have the same stress.
#[test]
fn both_models_have_the_same_stress() {
    let [explicit, condensed] =
        ["model.fem={}", "model.condensed={}"].map(|model| run(&[model, PROBES]));
    let stress = |collision: &Collision, k: usize| deepest(&collision.probes).bodies[1].stress[k];
    let pressure = explicit.peak_pressure.unwrap();
    // The difference is due to the recovery at the surface and to the instant.
    assert!((stress(&explicit, 0)[1] / pressure + 1.0).abs() < 0.04, "{:?}", stress(&explicit, 0));
    for k in [0, 1] {
        let (a, b) = (stress(&explicit, k), stress(&condensed, k));
        for component in 0..4 {
            // Waves, the contact's last node and the nearest of 200 instants differ.
            let difference = (a[component] - b[component]).abs() / pressure;
            assert!(difference < 0.02, "{k} {component}: {a:?} {b:?}");
        }
    }
    // Below the edge of the contact there is shear, and more pressure than tension.
    let [rr, yy, tt, ry] = stress(&explicit, 1);
    assert!(yy < -0.5 * pressure && rr < 0.0 && tt < 0.0 && ry.abs() > 0.05 * pressure);
}

/// Identical bodies are computed as one, and a probe in the mirror image has the mirrored stress.
#[test]
fn probes_of_identical_bodies_are_mirrored() {
    let like = ["body.0.sphere.diameter='15.9 mm'", "mesh.contact_element_size='60 um'"];
    let places = "output.probe=[{body='striker', r='0.1 mm', y='-0.15 mm'}, \
        {body='target', r='0.1 mm', y='0.15 mm'}]";
    let [half, whole] = ["on", "off"].map(|switch| {
        let symmetry = format!("effects.mirror_symmetry='{switch}'");
        run(&[like[0], like[1], places, &symmetry])
    });
    let (half, whole) = (deepest(&half.probes), deepest(&whole.probes));
    let [rr, yy, tt, ry] = half.bodies[0].stress[0];
    assert_eq!(half.bodies[1].stress[1], [rr, yy, tt, -ry]);
    for (side, k) in [(0, 0), (1, 1)] {
        let ([a_r, a_y], [b_r, b_y]) = (half.displacement(side)[k], whole.displacement(side)[k]);
        // The instants differ by a step or two.
        assert!((a_r - b_r).abs() < 2e-8 && (a_y - b_y).abs() < 2e-8, "{a_r} {b_r} {a_y} {b_y}");
    }
}

/// A resumed run has the samples before its restart state, and a stopped run those until its stop.
#[test]
fn samples_are_part_of_the_restart_state() {
    let simulation = simulation(&[COARSE, PROBES]);
    let mut stepper = simulation.start();
    while stepper.progress().fraction < 0.4 && stepper.advance(&mut ()) {}
    let state = serde_json::to_string(&stepper.restart_state()).unwrap();
    let stopped = stepper.finish();
    let mut resumed = simulation.resume(serde_json::from_str(&state).unwrap()).unwrap();
    while resumed.advance(&mut ()) {}
    let whole = simulation.run(&mut ());
    assert_eq!(resumed.finish(), whole);
    assert!(stopped.probes.len() > 50 && whole.probes.starts_with(&stopped.probes[..50]));
}

#[test]
fn a_probe_outside_the_mesh_is_refused() {
    let refusal = |overrides: &[&str]| refused_of(GLASS, overrides);
    let block = "body.0={name='block', half_space={}, material='glass'}";
    let far = "output.probe=[{body='block', r='1 m', y='-1 m'}]";
    let error = refusal(&[block, "body.1.approach_speed=0.5", far, COARSE]);
    assert!(error.to_string().contains("does not reach"), "{error}");
    let stiff = [
        "material.stiff={density=2390, youngs_modulus=6.3e12, poissons_ratio=0.244}",
        "body.0.material='stiff'",
        "effects.rigid_partner='on'",
        PROBES,
    ];
    assert!(refusal(&stiff).to_string().contains("rigid body"));
}

#[test]
fn a_model_without_fields_warns_about_probes() {
    let simulation = simulation(&["model.ting={}", PROBES]);
    let warnings = simulation.warnings(&simulation.run(&mut ())).join("\n");
    assert!(warnings.contains("output.probe has no effect"), "{warnings}");
}

/// Returns the case of a steel ball that strikes a wall.
fn ball_on_wall(model: ModelTable) -> Case {
    let steel = MaterialTable::from_youngs_modulus_poissons_ratio(7850.0, 210e9, 0.3);
    let ball = BodyTable::sphere("ball", 20e-3, "steel").approaching(0.1);
    let mut file = CaseFile::of_bodies(ball, BodyTable::wall("wall"))
        .with_material("steel", steel)
        .with_model(model);
    file.mesh = Some(MeshTable { contact_element_size: Some(10e-6.into()), ..Default::default() });
    Case::of(file).unwrap()
}

/// Johnson, Contact Mechanics (1985), eqs 3.40 and 3.45: σ_yy is −p0 / (1 + z²/a²), and for ν = 0.3 the largest shear
/// stress is 0.310 p0 at the depth 0.48 a. With 14 elements across the contact radius the stress agrees within 1 % of
/// p0 below the first elements, where the recovery is one-sided.
#[test]
fn the_stress_on_the_axis_is_that_of_hertz() {
    let simulation = Simulation::new(ball_on_wall(ModelTable::condensed())).unwrap();
    let collision = simulation.run(&mut ());
    let hertz = &simulation.setup().estimate.hertz;
    let (radius, pressure) = (hertz.max_contact_radius(), hertz.peak_pressure());
    let snapshot = collision.snapshot(SnapshotInstant::Maximum).unwrap();
    let ball = simulation.stress(snapshot, 0).unwrap();
    let on_axis: Vec<_> = ball.on_axis().collect();
    assert_eq!(on_axis.len(), ball.mesh.axis().len());
    assert_eq!(on_axis[0].0, 0.0);
    assert!(on_axis.windows(2).all(|two| two[0].0 < two[1].0));
    for (depth, [_, yy, _, ry]) in on_axis.iter().skip(2).take_while(|(z, _)| *z < 2.0 * radius) {
        let expected = -pressure / (1.0 + (depth / radius).powi(2));
        assert!((yy - expected).abs() < 0.01 * pressure, "{depth:e} {yy:e} {expected:e}");
        assert_eq!(*ry, 0.0);
    }
    let shear = |stress: &[f64; 4]| 0.5 * (stress[0] - stress[1]);
    let by_shear = |a: &&(f64, _), b: &&(f64, _)| shear(&a.1).total_cmp(&shear(&b.1));
    let (depth, hardest) = on_axis.iter().max_by(by_shear).unwrap();
    assert!((shear(hardest) / pressure - 0.310).abs() < 0.005, "{}", shear(hardest) / pressure);
    assert!((depth / radius - 0.48).abs() < 0.05, "{}", depth / radius);
}

/// Johnson (1985), eqs 3.42 and 3.44: σ_rr and σ_θθ on the surface, with the tension (1 − 2ν) p0 a²/3r² outside of the contact.
/// With four elements across the contact, where a fit to the elements has σ_rr half as large at 1.5 a and no tension at the
/// edge, the stress agrees within 4 % of p0 at all nodes to 3 a, and the tension within 10 %.
#[test]
fn the_stress_on_the_surface_is_that_of_hertz() {
    for speed in ["1 mm/s", "3 mm/s"] {
        let mut file = ball_on_wall(ModelTable::condensed()).file().clone();
        file.mesh = None;
        file.body[0].approach_speed = Some(speed.into());
        let simulation = Simulation::new(Case::of(file).unwrap()).unwrap();
        let collision = simulation.run(&mut ());
        let hertz = &simulation.setup().estimate.hertz;
        let field = hertz.pressure(hertz.max_approach());
        let snapshot = collision.snapshot(SnapshotInstant::Maximum).unwrap();
        let ball = simulation.stress(snapshot, 0).unwrap();
        let radius = field.contact_radius;
        let size = ball.mesh.nodes()[ball.mesh.surface()[1] as usize][0];
        let mut largest = 0.0f64;
        let radius_of = |node: &&u32| ball.mesh.nodes()[**node as usize][0];
        for node in ball.mesh.surface().iter().take_while(|node| radius_of(node) < 3.0 * radius) {
            let (r, node) = (radius_of(&node), *node);
            if (r - radius).abs() < 0.5 * size {
                continue;
            }
            let ([rr, _, tt, _], [exact, _, hoop, _]) =
                (ball.field.points[node as usize], field.stress(r, 0.0, 0.3));
            let error = (rr - exact).abs().max((tt - hoop).abs());
            // The largest are at the axis, where the elements are stiff.
            assert!(error < 0.04 * field.peak_pressure, "{speed} {} {rr:e} {exact:e}", r / radius);
            if r > radius {
                assert!((rr / exact - 1.0).abs() < 0.1, "{speed} {} {rr:e} {exact:e}", r / radius);
            }
            largest = largest.max(rr);
        }
        assert!(
            largest > 0.6 * field.stress(field.contact_radius, 0.0, 0.3)[0],
            "{speed} {largest:e}"
        );
    }
}

/// A run states the error of its stress, which falls on a finer mesh.
#[test]
fn the_error_of_the_stress_is_stated() {
    let of = |size: Option<f64>| {
        let mut file = ball_on_wall(ModelTable::fem()).file().clone();
        file.mesh = size.map(|size| MeshTable {
            contact_element_size: Some(size.into()),
            ..Default::default()
        });
        let simulation = Simulation::new(Case::of(file).unwrap()).unwrap();
        simulation.run_within_tolerance(&mut ())
    };
    let coarse = of(None);
    let error = coarse.errors.stress_error.unwrap();
    assert!((0.005..0.1).contains(&error.l2) && (0.02..0.4).contains(&error.max), "{error:?}");
    let size = coarse.simulation.setup().elements.as_ref().unwrap().plan.contact_element_size;
    let fine = of(Some(size / 2.0)).errors.stress_error.unwrap();
    assert!(fine.l2 < 0.6 * error.l2, "{fine:?} {error:?}");
    // Without snapshots there is nothing to state.
    let mut file = ball_on_wall(ModelTable::fem()).file().clone();
    (file.mesh, file.output) = (
        None,
        Some(OutputTable { snapshots: Some(SnapshotsValue::labels([])), ..Default::default() }),
    );
    let without = Simulation::new(Case::of(file).unwrap()).unwrap().run_within_tolerance(&mut ());
    assert_eq!(without.errors.stress_error, None);
}

#[test]
fn walls_closed_forms_and_fields_of_other_meshes_have_no_stress() {
    let condensed = Simulation::new(ball_on_wall(ModelTable::condensed())).unwrap();
    for side in [0, 1, 2] {
        assert!(condensed.stress(&Snapshot::default(), side).is_none(), "{side}");
    }
    let ting = Simulation::new(ball_on_wall(ModelTable::ting())).unwrap();
    assert!(ting.stress(&Snapshot::default(), 0).is_none());
}
