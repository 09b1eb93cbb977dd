//! Scenes beyond the range of a model are reported or rejected by every model.

use fem_collision::{Collision, QuantityOfInterest};
use fem_simulation::{Simulation, diagnose};

use crate::scene::{ELASTIC_GLASS, coarse_glass as simulation, refused, simulation_of};

fn warnings(simulation: &Simulation) -> Vec<String> {
    simulation.warnings(&simulation.run(&mut ()))
}

/// The error of half-spaces is 0.2 % at ν = −0.9, where the warning begins, 3 % at −0.99, and a factor of three at −0.9999.
#[test]
fn closed_forms_warn_about_the_spheres_own_compliance() {
    for (ratio, is_expected) in
        [("-0.9999", true), ("-0.99", true), ("-0.8", false), ("0.49", false)]
    {
        let set = format!("material.glass.poissons_ratio={ratio}");
        for finite_size in [true, false] {
            for model in ["hertz", "ting"] {
                let table = format!("model={{{model}={{finite_size={finite_size}}}}}");
                let found = warnings(&simulation("auto", &[&set, &table]));
                let is_named = found.iter().any(|one| one.contains("own compliance adds"));
                assert_eq!(is_named, is_expected, "{model} {finite_size} {ratio}: {found:?}");
            }
        }
    }
}

/// Energy residual and restitution are checked in every model.
#[test]
fn every_model_is_diagnosed() {
    for method in fem_simulation::METHODS {
        let simulation = simulation(method.name(), &[]);
        let mut collision = simulation.run(&mut ());
        let warns = |collision: &Collision, text: &str| {
            diagnose(&simulation, collision, &simulation.estimate_errors(collision))
                .iter()
                .any(|one| one.contains(text))
        };
        assert!(
            !warns(&collision, "energy balance has an error") && !warns(&collision, "above 1:")
        );
        for residual in [2e-3, f64::NAN] {
            collision.residual_relative = Some(residual);
            assert!(warns(&collision, "energy balance has an error"), "{}", method.name());
        }
        for restitution in [1.0 + 2e-5, f64::NAN] {
            collision.restitution = Some(restitution);
            assert!(warns(&collision, "above 1:"), "{}", method.name());
        }
    }
}

/// An infinite mass does not count as a wall.
#[test]
fn infinite_masses_are_refused() {
    for method in fem_simulation::METHODS {
        for size in ["1e150", "1e-110"] {
            let message = refused(method.name(), &[&format!("body.0.sphere.diameter={size}")]);
            assert!(message.contains("the mass of") && message.contains("kg"), "{message}");
        }
    }
}

/// A stiffness whose time step is zero, or whose number of steps is infinite, is refused with advice.
#[test]
fn a_time_step_out_of_range_is_refused() {
    let message =
        refused("fem", &["material.glass.youngs_modulus=1e300", "material.glass.density=1e-6"]);
    assert!(message.contains("explicit elements would need a time step of"), "{message}");
    let message = refused("fem", &["material.glass.youngs_modulus=1e200"]);
    assert!(message.contains("element updates") && !message.contains("18446744"), "{message}");
}

/// Runs the glass pair with about seven elements across the contact.
fn run(poissons_ratio: f64, model: &str) -> (Simulation, Collision) {
    let tolerance = if model.starts_with("fem") { "0.5 %" } else { "0.15 %" };
    let overrides = [
        format!("material.glass.poissons_ratio={poissons_ratio}"),
        format!("model={{{model}}}"),
        format!("accuracy.tolerance='{tolerance}'"),
    ];
    let simulation = simulation_of(ELASTIC_GLASS, &overrides);
    let collision = simulation.run(&mut ());
    (simulation, collision)
}

/// Bodies far stiffer in shear than in compression ring at any speed. Condensed bodies without modes estimate the missing
/// loss within a factor of three, warn where it matters, and name a model that has it.
#[test]
fn slow_bulk_waves_are_reported() {
    for (poissons_ratio, is_reported) in [(-0.99, true), (-0.5, false)] {
        let (_, elements) = run(poissons_ratio, "fem={}");
        let (simulation, condensed) = run(poissons_ratio, "condensed={}");
        let warnings = simulation.warnings(&condensed).join("\n");
        assert_eq!(
            warnings.contains("the body rings"),
            is_reported,
            "{poissons_ratio}: {warnings}"
        );
        let lost = condensed.restitution.unwrap() - elements.restitution.unwrap();
        if !is_reported {
            assert!(lost < 1e-4, "{poissons_ratio}: {lost:e}");
            continue;
        }
        let bar = simulation
            .summary(&condensed)
            .uncertainty
            .of(QuantityOfInterest::Restitution)
            .model
            .unwrap();
        assert!(lost > 5e-3 && (lost / 3.0..3.0 * lost).contains(&bar), "{lost:e} {bar:e}");
        // A few modes do not help.
        assert!(warnings.contains("use model fem"), "{warnings}");
        let (simulation, with_modes) = run(poissons_ratio, "condensed={vibration_modes=12}");
        assert!(simulation.warnings(&with_modes).join("\n").contains("the body rings"));
        let off = with_modes.restitution.unwrap() - elements.restitution.unwrap();
        assert!(off.abs() > 0.5 * lost, "{off:e} of {lost:e}");
    }
}
