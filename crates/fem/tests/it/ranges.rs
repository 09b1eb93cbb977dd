//! What lies beyond the range of a model is said, whichever the model.

use fem::{Simulation, diagnose};

use crate::coarse::{refused, simulation};

fn warnings(simulation: &Simulation) -> Vec<String> {
    simulation.warnings(&simulation.run(&mut ()))
}

/// Off by 0.2 % at −0.9, where the warning begins, by 3 % at −0.99 and by a factor of three at −0.9999.
#[test]
fn half_spaces_are_doubted_where_the_spheres_own_compliance_counts() {
    for (ratio, is_doubtful) in
        [("-0.9999", true), ("-0.99", true), ("-0.8", false), ("0.49", false)]
    {
        let set = format!("material.glass.poissons_ratio={ratio}");
        for finite_size in [true, false] {
            for model in ["hertz", "ting"] {
                let table = format!("model={{{model}={{finite_size={finite_size}}}}}");
                let found = warnings(&simulation("auto", &[&set, &table]));
                let doubts = found.iter().any(|one| one.contains("own compliance adds"));
                assert_eq!(doubts, is_doubtful, "{model} {finite_size} {ratio}: {found:?}");
            }
        }
    }
}

/// A residual, a restitution and a stop are judged whatever computed them.
#[test]
fn numbers_of_every_model_are_judged() {
    for method in fem::METHODS {
        let simulation = simulation(method.name(), &[]);
        let mut collision = simulation.run(&mut ());
        let said = |collision: &fem::Collision, text: &str| {
            diagnose(&simulation, collision, &simulation.estimate_errors(collision))
                .iter()
                .any(|one| one.contains(text))
        };
        assert!(!said(&collision, "does not add up") && !said(&collision, "above 1:"));
        for residual in [2e-3, f64::NAN] {
            collision.residual_relative = Some(residual);
            assert!(said(&collision, "does not add up"), "{}", method.name());
        }
        for restitution in [1.0 + 2e-5, f64::NAN] {
            collision.restitution = Some(restitution);
            assert!(said(&collision, "above 1:"), "{}", method.name());
        }
    }
}

/// An infinite mass is no wall.
#[test]
fn masses_that_are_no_numbers_are_refused() {
    for method in fem::METHODS {
        for size in ["1e150", "1e-110"] {
            let message = refused(method.name(), &[&format!("body.0.sphere.diameter={size}")]);
            assert!(message.contains("the mass of") && message.contains("kg"), "{message}");
        }
    }
}

/// So does a stiffness whose waves pass an element in no time, and one whose run has more steps than any
/// number of them.
#[test]
fn a_time_step_that_is_no_number_is_refused_with_what_to_check() {
    let message =
        refused("fem", &["material.glass.youngs_modulus=1e300", "material.glass.density=1e-6"]);
    assert!(message.contains("explicit elements would need a time step of"), "{message}");
    let message = refused("fem", &["material.glass.youngs_modulus=1e200"]);
    assert!(message.contains("element updates") && !message.contains("18446744"), "{message}");
}
