//! Fields at an instant.

use crate::common::{GLASS, Scene, explicit, glass, material};
use fem_collision::{
    Approach, BodyInput, Collision, Frame, OutputRequest, SnapshotInstant, SnapshotRequest,
    StressField,
};
use fem_condensed::CondensedPair;
use fem_material::ActsOn::{self, All, Shear};
use fem_material::Material;

fn relaxing(acts_on: ActsOn) -> Material {
    material(GLASS, acts_on, &[(1.0, 2708.0)])
}

/// A collision with the relaxations of the bodies' own materials and these snapshots.
pub(crate) fn drawn(
    pair: &CondensedPair,
    frame: Frame,
    snapshots: SnapshotRequest,
    n_steps: usize,
) -> Collision {
    let request = OutputRequest { snapshots, ..OutputRequest::quantities() };
    pair.collide(&frame, pair.relaxations(), n_steps, &request, &mut ()).unwrap()
}

/// Σ m u_y of a field.
fn moment(masses: &[f64], field: &[[f64; 2]]) -> f64 {
    masses.iter().zip(field).map(|(m, u)| m * u[1]).sum()
}

/// The mean of a field along y, by mass.
fn centre(masses: &[f64], field: &[[f64; 2]]) -> f64 {
    moment(masses, field) / masses.iter().sum::<f64>()
}

/// Everything that the snapshots say about the bodies as a whole, for every kind of body.
#[test]
fn snapshots_agree_with_the_rigid_body_motion() {
    let cases = [
        (glass(), glass(), 0),
        (relaxing(All), glass(), 0),
        (relaxing(Shear), relaxing(All), 0),
        (glass(), relaxing(Shear), 6),
    ];
    for (lower, upper, vibration_modes) in cases {
        let scene = Scene::paper(lower, upper);
        let pair = scene.vibrating(8.0, vibration_modes);
        let approach = Approach::new([0.7, 0.2], 1e-6).unwrap();
        let frame = Frame { approach, ..pair.frame(0.5).unwrap() };
        let run =
            drawn(&pair, frame, SnapshotRequest::Labels(SnapshotInstant::OF_CONTACT.to_vec()), 200);
        let (snapshots, missing) = (&run.snapshots, &run.warnings);
        assert!(missing.is_empty() && snapshots.len() == 4, "{missing:?}");
        assert!(snapshots.windows(2).all(|two| two[0].time < two[1].time));
        let [lower, upper] = pair.masses();
        let momentum = lower * 0.7 + upper * 0.2;
        for snapshot in snapshots {
            let mut total = 0.0;
            let mut centres = [0.0; 2];
            for (side, fields) in snapshot.bodies.iter().enumerate() {
                let masses = pair.nodal_masses(side);
                total += moment(masses, &fields.velocity);
                centres[side] = moment(masses, &snapshot.displacement(side)) / pair.masses()[side];
            }
            // Rounding of fields of 1e-5 m.
            assert!((total / momentum - 1.0).abs() < 1e-9);
            assert!((centres[0] - centres[1] - 1e-6 - snapshot.approach).abs() < 1e-15);
        }
        let half = 0.5 * run.max_approach.unwrap();
        assert!((snapshots[0].approach / half - 1.0).abs() < 0.02);
        assert!((snapshots[1].approach / run.max_approach.unwrap() - 1.0).abs() < 1e-3);
        assert!((snapshots[2].approach / half - 1.0).abs() < 0.02);
        assert!(
            (snapshots[3].time - approach.first_touch() - run.contact_time.unwrap()).abs()
                <= run.time_step.unwrap()
        );

        // Under the contact the stress is Hertz'.
        let maximum = &snapshots[1];
        for (side, input) in pair.inputs().iter().enumerate() {
            let BodyInput::Sphere { mesh, material } = input else { continue };
            let stress =
                StressField::of(mesh, material, &maximum.bodies[side], Some(&maximum.contact));
            let contact_radius = run.max_contact_radius.unwrap();
            let peak_pressure = run.peak_pressure.unwrap();
            let hertz = fem_laws::HertzPressure { contact_radius, peak_pressure };
            let depth = |node: u32| mesh.nodes()[node as usize][1].abs();
            for &node in mesh.axis().iter().filter(|&&node| depth(node) < 3.0 * contact_radius) {
                let expected = hertz.axis_stress(depth(node), 0.244).axial;
                let found = stress.points[node as usize][1];
                // Recovered from elements of an eighth of the radius; 4 % at the surface.
                assert!((found - expected).abs() < 0.05 * peak_pressure, "{found} {expected}");
            }
        }
    }
}

/// Velocities of a snapshot are those by which displacements change from step to step, in contact, with
/// modes of vibration, and of a shear modulus that relaxes, with them.
#[test]
fn velocities_are_the_change_of_displacements() {
    for (glass, vibration_modes) in [(glass(), 0), (relaxing(Shear), 6)] {
        let scene = Scene { speed: 3.0, ..Scene::paper(glass.clone(), glass) };
        let pair = scene.vibrating(6.0, vibration_modes);
        let frame = pair.frame(scene.speed).unwrap();
        let step = drawn(&pair, frame, SnapshotRequest::none(), 400).time_step.unwrap();
        for k in [60.0, 240.0] {
            let times = [-1.0, 0.0, 1.0].map(|j| (k + j) * step).to_vec();
            let run = drawn(&pair, frame, SnapshotRequest::Times(times), 400);
            let [before, now, after] = &run.snapshots[..] else { panic!("{:?}", run.warnings) };
            for side in 0..2 {
                let ends = [before, after].map(|snapshot| snapshot.displacement(side));
                let (mut off, mut largest) = (0.0_f64, 0.0_f64);
                let velocity = &now.bodies[side].velocity;
                let mean = velocity.iter().map(|v| v[1]).sum::<f64>() / velocity.len() as f64;
                for (v, (from, to)) in velocity.iter().zip(ends[0].iter().zip(&ends[1])) {
                    for axis in 0..2 {
                        let change = (to[axis] - from[axis]) / (2.0 * step);
                        off = off.max((v[axis] - change).abs());
                        // Relative to the body as a whole.
                        largest = largest.max((v[axis] - [0.0, mean][axis]).abs());
                    }
                }
                // Nodes that join the contact move by jumps, 3 % of the largest velocity; half of it is 50 %.
                assert!(off < 0.1 * largest, "{vibration_modes} {k} {side}: {off} {largest}");
            }
        }
    }
}

/// The reported energy of vibrations is twice the mean kinetic energy, about the mass centre, of the
/// fields after the contact.
#[test]
fn vibration_energy_is_that_of_the_fields() {
    let scene = Scene { speed: 5.0, ..Scene::paper(glass(), glass()) };
    let pair = scene.vibrating(5.0, 8);
    let frame = pair.frame(scene.speed).unwrap();
    let run = drawn(&pair, frame, SnapshotRequest::none(), 200);
    let (step, last) = (run.time_step.unwrap(), run.last_contact.unwrap());
    let first = (last / step).ceil() as u64;
    let times = (first..run.steps.unwrap()).map(|k| k as f64 * step).collect::<Vec<_>>();
    let run = drawn(&pair, frame, SnapshotRequest::Times(times), 200);
    assert!(run.snapshots.len() > 20, "{:?}", run.warnings);
    for side in 0..2 {
        let masses = pair.nodal_masses(side);
        let kinetic = run.snapshots.iter().map(|snapshot| {
            let velocity = &snapshot.bodies[side].velocity;
            let (nodes, mean) = (masses.iter().zip(velocity), centre(masses, velocity));
            0.5 * nodes.map(|(m, v)| m * (v[0] * v[0] + (v[1] - mean).powi(2))).sum::<f64>()
        });
        let of_fields = 2.0 * kinetic.sum::<f64>() / run.snapshots.len() as f64;
        let reported = run.bodies[side].vibration_energy.unwrap();
        assert!((of_fields / reported - 1.0).abs() < 0.05, "{side}: {of_fields:e} {reported:e}");
    }
}

/// The effective displacement of a body whose moduli all relax is the convolution of its displacements with the
/// modulus, node by node, in contact and while it vibrates after it:
///
/// w = u − g ∫ (1 − e^(−β(t−s))) u'(s) ds,
///
/// of displacements that are linear in between.
#[test]
fn effective_displacement_is_the_convolution_with_the_modulus() {
    let (weight, rate) = (0.6, 3e4);
    let relaxing = material(GLASS, All, &[(weight, rate)]);
    let scene = Scene { speed: 8.0, ..Scene::paper(relaxing.clone(), relaxing) };
    let pair = scene.vibrating(4.0, 8);
    let frame = pair.frame(scene.speed).unwrap();
    let run = drawn(&pair, frame, SnapshotRequest::none(), 300);
    let (step, last) = (run.time_step.unwrap(), run.last_contact.unwrap());
    let times = (0..run.steps.unwrap()).map(|k| k as f64 * step).collect::<Vec<_>>();
    let run = drawn(&pair, frame, SnapshotRequest::Times(times), 300);
    let decay = (-rate * step).exp();
    let gain = (1.0 - decay) / (rate * step);
    for side in 0..2 {
        let masses = pair.nodal_masses(side);
        // About the mass centre.
        let deformed = |field: &[[f64; 2]]| -> Vec<[f64; 2]> {
            let mean = centre(masses, field);
            field.iter().map(|u| [u[0], u[1] - mean]).collect()
        };
        let n = run.snapshots[0].bodies[side].displacement.len();
        let (mut before, mut kept) = (vec![[0.0; 2]; n], vec![[0.0; 2]; n]);
        // In contact, and after it.
        let (mut off, mut largest) = ([0.0_f64; 2], [0.0_f64; 2]);
        for snapshot in &run.snapshots {
            let fields = &snapshot.bodies[side];
            let (now, effective) = (deformed(&fields.displacement), deformed(&fields.effective));
            let phase = usize::from(snapshot.time > last);
            for node in 0..n {
                for axis in 0..2 {
                    let change = now[node][axis] - before[node][axis];
                    kept[node][axis] = decay * kept[node][axis] + gain * change;
                    let expected = (1.0 - weight) * now[node][axis] + weight * kept[node][axis];
                    off[phase] = off[phase].max((effective[node][axis] - expected).abs());
                    largest[phase] = largest[phase].max(expected.abs());
                }
            }
            before = now;
        }
        for (off, largest) in off.into_iter().zip(largest) {
            // Rounding. Modes that are faster than the relaxation see 2 % of it.
            assert!(off < 1e-10 * largest, "{side}: {off:e} {largest:e}");
        }
    }
}

/// Counts and times.
#[test]
fn snapshots_by_count_and_time_are_at_the_requested_instants() {
    let scene = Scene::paper(glass(), glass());
    let pair = scene.condensed(6.0);
    let run = scene.collide(&pair);
    let with = |request| {
        let run = drawn(&pair, pair.frame(0.5).unwrap(), request, 200);
        (run.snapshots, run.warnings)
    };
    let (five, missing) = with(SnapshotRequest::Count(5));
    assert!(five.len() == 5 && missing.is_empty());
    for (k, snapshot) in five.iter().enumerate() {
        let time = run.contact_time.unwrap() * k as f64 / 4.0;
        // The contact ends within a step of its last.
        assert!((snapshot.time - time).abs() <= 1.01 * run.time_step.unwrap());
    }
    let (many, missing) = with(SnapshotRequest::Count(10_000));
    assert!(many.len() < 300 && missing.len() == 1);
    let (two, missing) = with(SnapshotRequest::Times(vec![30e-6, 10e-6, 1.0]));
    assert!(two.len() == 2 && missing.len() == 1);
    assert!((two[0].time - 10e-6).abs() <= 1e-12 && (two[1].time - 30e-6).abs() <= 1e-12);
}

/// The explicit model's fields at the largest approach, node by node.
#[test]
fn fields_are_the_explicit_ones() {
    let scene = Scene::paper(relaxing(Shear), relaxing(All));
    let stiffness = 5.0 * scene.pair().contact_modulus();
    let hertz = scene.hertz();
    let snapshots = SnapshotRequest::Labels(vec![SnapshotInstant::Maximum]);
    let request = OutputRequest { snapshots: snapshots.clone(), ..OutputRequest::history() };
    let reference = explicit(scene.inputs(5.0), &hertz, stiffness, &request);
    let pair = scene.on_springs(5.0, stiffness, 12);
    let run = drawn(&pair, pair.frame(0.5).unwrap(), snapshots, 1000);
    for side in 0..2 {
        let (found, expected) =
            (&run.snapshots[0].bodies[side], &reference.snapshots[0].bodies[side]);
        let distance = |a: &[[f64; 2]], b: &[[f64; 2]]| {
            let pairs = a.as_flattened().iter().zip(b.as_flattened());
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let [one, other] = [&run, &reference].map(|run| run.snapshots[0].displacement(side));
        // Against the approach. The instants differ by up to a step of either model, 4e-8 s, in
        // which the bodies move by 1e-8 m: 1e-3 of the approach.
        assert!(distance(&one, &other) < 3e-3 * run.max_approach.unwrap());
        // The effective displacements differ by a rigid motion that no stress sees.
        let stress = |fields| {
            let input = &pair.inputs()[side];
            let BodyInput::Sphere { mesh, material } = input else { panic!() };
            StressField::of(mesh, material, fields, None).cells
        };
        let (found, expected) = (stress(found), stress(expected));
        let pairs = found.as_flattened().iter().zip(expected.as_flattened());
        let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // The explicit contact force is noisy by some parts in a thousand.
        assert!(worst < 1e-2 * run.peak_pressure.unwrap(), "{worst:e}");
    }
}
