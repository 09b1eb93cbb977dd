//! Results do not depend on the frame of reference or on the gap.

use fem_collision::{Approach, Collision, OutputRequest, QuantityOfInterest};
use fem_simulation::METHODS;

use crate::scene::coarse_glass as simulation;

fn quantities(collision: &Collision) -> [Option<f64>; 6] {
    QuantityOfInterest::ALL.map(|quantity| quantity.of(collision))
}

/// Every approach has the relative speed 0.5 m/s to the last bit.
#[test]
fn results_are_independent_of_gap_and_common_speed() {
    let twins = &["body.1.sphere.diameter='22.2 mm'"][..];
    let wall = &["body.1={name='wall', wall={}}", "body.0.approach_speed=0.5"][..];
    let ways = [
        Approach::new([0.5, 0.0], 1e6),
        Approach::new([0.5, 0.0], 1e-12),
        Approach::new([1e9 + 0.5, 1e9], 0.0),
        Approach::new([-1e9, -1e9 - 0.5], 1e6),
        Approach::new([0.25, -0.25], 1e3),
    ];
    for (method, more) in
        METHODS.iter().flat_map(|method| [(method, &[][..]), (method, twins), (method, wall)])
    {
        let simulation = simulation(method.name(), more);
        let at = |approach: &Approach| {
            simulation.model().collide(approach, &OutputRequest::history(), &mut ())
        };
        let reference = at(&Approach::at(0.5).unwrap());
        assert!(reference.is_complete());
        for way in &ways {
            let way = way.as_ref().unwrap();
            let name = format!("{} {more:?} {way:?}", method.name());
            let found = at(way);
            assert!(found.is_complete(), "{name}");
            assert_eq!(quantities(&found), quantities(&reference), "{name}");
            let first = found.first_contact.unwrap() - way.first_touch();
            // The time of the case is rounded.
            let ulp = f64::EPSILON * way.first_touch();
            assert!((first - reference.first_contact.unwrap()).abs() <= 2.0 * ulp, "{name}");
            let moved = found.bodies.map(|body| body.velocity_after);
            if let [Some(lower), Some(upper)] = moved {
                let relative = reference.restitution.unwrap() * 0.5;
                let ulp = f64::EPSILON * way.velocities()[0].abs();
                assert!((upper - lower - relative).abs() < 1e-12 + 2.0 * ulp, "{name}: {moved:?}");
            }
            if let Some(residual) = found.momentum_residual_relative {
                assert!(residual < 1e-9, "{name}: {residual:e}");
            }
            // The energy balance holds in any frame; reduced models have that of the relative motion.
            if found.time_step.is_none() {
                continue;
            }
            let initial = found.initial_energy.unwrap();
            for row in &found.history {
                let Some(residual) = row.residual else { continue };
                let off = row.energies.residual(initial) - residual;
                assert!(off.abs() <= 1e-13 * initial, "{name} at {}: {off:e}", row.time);
            }
        }
    }
}
