//! Against the explicit model on the same meshes with the same penalty springs.

use crate::common::{Scene, assert_close, assert_restitution, explicit, glass, unlike_scenes};
use fem_collision::{BodyInput, Collision, HistoryRow, OutputRequest};
use fem_condensed::{CondensedPair, ContactModel, PairSettings};
use fem_laws::HertzImpact;

/// Elements across the contact radius.
const ELEMENTS: f64 = 5.0;
/// Penalty over contact modulus, soft enough for a smooth force.
const PENALTY: f64 = 5.0;
const MODES: usize = 12;

/// Width of a pulse where the relative velocity passes half of its change on the way in and out:
/// the velocity is an integral, and the width free of the noise at first and last touch.
fn width(rows: impl Iterator<Item = (f64, f64)>, restitution: f64, speed: f64) -> f64 {
    let rows: Vec<_> = rows.collect();
    let passes = |level: f64| {
        let k = rows.iter().position(|&(_, v)| v <= level).unwrap();
        let ((t0, v0), (t1, v1)) = (rows[k - 1], rows[k]);
        t0 + (t1 - t0) * (level - v0) / (v1 - v0)
    };
    passes(-0.5 * restitution * speed) - passes(0.5 * speed)
}

/// Asserts that bodies that meet on springs of a stiffness (Pa) have the results of explicit elements, and returns both.
pub fn assert_agreement(
    name: &str,
    inputs: [BodyInput; 2],
    hertz: &HertzImpact,
    stiffness: f64,
) -> [Collision; 2] {
    let (request, speed) = (OutputRequest::history(), hertz.approach_speed());
    let reference = explicit(inputs.clone(), hertz, stiffness, &request);
    let contact = ContactModel::Springs(stiffness);
    let settings = PairSettings::new(1.5 * hertz.max_contact_radius());
    let settings = PairSettings { contact, vibration_modes: MODES, ..settings };
    let pair = CondensedPair::new(inputs, settings).unwrap();
    let (frame, relaxations) = (pair.frame(speed).unwrap(), pair.relaxations());
    let run = pair.collide(&frame, relaxations, 1000, &request, &mut ()).unwrap();
    let relative = |row: &HistoryRow| (row.time, row.velocity[0] - row.velocity[1]);
    let width_of =
        |run: &Collision| width(run.history.iter().map(relative), run.restitution.unwrap(), speed);
    // 6e-5 to 9e-5 measured; three times that at 5 m/s, from the modes beyond the twelfth.
    let tolerance = if name == "fast" { 5e-4 } else { 2e-4 };
    assert_close(name, width_of(&run), width_of(&reference), tolerance);
    // The explicit contact rattles a little: 1e-5.
    assert_restitution(name, &run, reference.restitution.unwrap(), 5e-5);
    type Quantity = fn(&Collision) -> Option<f64>;
    let quantities: [(Quantity, f64); 4] = [
        (|run| run.max_approach, 3e-5),
        (|run| run.max_contact_radius, 3e-4),
        // Its peaks are those of a noisy force.
        (|run| run.peak_force, 3e-3),
        (|run| run.peak_pressure, 5e-3),
    ];
    for (of, tolerance) in quantities {
        assert_close(name, of(&run).unwrap(), of(&reference).unwrap(), tolerance);
    }
    [run, reference]
}

/// Six scenes, of every kind of body.
#[test]
fn six_scenes_equal_the_explicit_results() {
    // The last is at 2 % of the shear wave's speed, where vibrations count.
    let like = [("glass", 0.5), ("fast", 5.0)]
        .map(|(name, speed)| (name, Scene { speed, ..Scene::paper(glass(), glass()) }));
    for (name, scene) in unlike_scenes().into_iter().chain(like) {
        let stiffness = PENALTY * scene.pair().contact_modulus();
        assert_agreement(name, scene.inputs(ELEMENTS), &scene.hertz(), stiffness);
    }
}
