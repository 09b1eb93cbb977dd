//! Bodies that are far stiffer against shear than against pressure ring, at any speed.

use std::path::Path;

use fem::{Case, Collision, Simulation};
use fem_collision::QuantityOfInterest;

const GLASS: &str = include_str!("../../../../cases/glass_0.5ms_elastic.toml");

/// Both models with about seven elements across the contact.
fn run(poissons_ratio: f64, model: &str) -> (Simulation, Collision) {
    let tolerance = if model.starts_with("fem") { "0.5 %" } else { "0.15 %" };
    let overrides = [
        format!("material.glass.poissons_ratio={poissons_ratio}"),
        format!("model={{{model}}}"),
        format!("accuracy.tolerance='{tolerance}'"),
    ];
    let case = Case::parse("glass.toml", GLASS, Path::new("."), &overrides).unwrap();
    let simulation = Simulation::new(case).unwrap();
    let collision = simulation.run(&mut ());
    (simulation, collision)
}

/// What condensed bodies without modes lack of the restitution, they foretell within a factor of three; where that
/// counts they say so, and what they name helps.
#[test]
fn slow_bulk_waves_are_told() {
    for (poissons_ratio, is_said) in [(-0.99, true), (-0.5, false), (0.2, false)] {
        let (_, elements) = run(poissons_ratio, "fem={}");
        let (simulation, condensed) = run(poissons_ratio, "condensed={}");
        let says = simulation.warnings(&condensed).join("\n");
        assert_eq!(says.contains("it rings"), is_said, "{poissons_ratio}: {says}");
        let lost = condensed.restitution.unwrap() - elements.restitution.unwrap();
        if !is_said {
            assert!(lost < 1e-4, "{poissons_ratio}: {lost:e}");
            continue;
        }
        let bar = simulation
            .summary(&condensed)
            .uncertainty
            .parts(QuantityOfInterest::Restitution)
            .model
            .unwrap();
        assert!(lost > 5e-3 && (lost / 3.0..3.0 * lost).contains(&bar), "{lost:e} {bar:e}");
        // Few modes do not help, as the message says.
        assert!(says.contains("use model fem"), "{says}");
        let (simulation, with_modes) = run(poissons_ratio, "condensed={vibration_modes=12}");
        assert!(simulation.warnings(&with_modes).join("\n").contains("it rings"));
        let off = with_modes.restitution.unwrap() - elements.restitution.unwrap();
        assert!(off.abs() > 0.5 * lost, "{off:e} of {lost:e}");
    }
}
