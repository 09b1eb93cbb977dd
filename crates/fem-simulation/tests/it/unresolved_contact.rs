//! Warnings about meshes that are too coarse at the contact or away from it, with advice.

use std::path::Path;

use fem_collision::{Collision, QuantityOfInterest};
use fem_mesh::HalfDisc;
use fem_simulation::Simulation;

use crate::scene::{ELASTIC_GLASS as GLASS, simulation_of};

/// Largest contact radius of the pair, m.
const CONTACT_RADIUS: f64 = 0.2231e-3;
/// Radii of the spheres, m.
const RADII: [f64; 2] = [11.1e-3, 7.95e-3];

fn run(overrides: &[String]) -> (Simulation, Collision) {
    let simulation = simulation_of(GLASS, overrides);
    let collision = simulation.run(&mut ());
    (simulation, collision)
}

/// Returns overrides with this model.
fn of(model: &str, more: &[&str]) -> Vec<String> {
    more.iter().map(ToString::to_string).chain([format!("model.{model}={{}}")]).collect()
}

/// A mesh that grows too fast away from the contact is named as the cause by both models; without the key there is no
/// warning.
#[test]
fn a_mesh_that_grows_too_fast_is_named() {
    for model in ["fem", "condensed"] {
        let (simulation, collision) = run(&of(model, &["mesh.growth=2"]));
        let after = simulation.warnings(&collision);
        let [warning] = &after[..] else { panic!("{model}: {after:?}") };
        assert!(warning.contains("because of the mesh away from the contact"), "{warning}");
        assert!(warning.contains("leave mesh.growth out"), "{warning}");
        let (simulation, collision) = run(&of(model, &[]));
        assert_eq!(simulation.mesh_warning(), None);
        assert_eq!(simulation.warnings(&collision), [""; 0]);
    }
}

/// Returns the override of a body's mesh by a file of this half disc.
fn mesh_file(folder: &Path, name: &str, body: usize, disc: HalfDisc) -> String {
    let mesh = disc.build().unwrap();
    let points: Vec<_> = mesh.nodes().iter().map(|&[r, y]| [r, y, 0.0]).collect();
    let path = folder.join(format!("{name}{body}.vtu"));
    fem_vtk::VtuWriter::new(&points, mesh.quads()).write(&path).unwrap();
    format!("body.{body}.sphere.mesh='{}'", path.display())
}

/// Imported meshes that are fine only at the pole miss the tolerance; no key of the table [mesh] is advised.
#[test]
fn coarse_imported_meshes_get_advice() {
    let folder = tempfile::tempdir().unwrap();
    let files = |name: &str, size: f64, refined_radius: f64, growth: f64| {
        [0, 1].map(|k| {
            let (radius, growth) = (RADII[k], Some(growth));
            let disc =
                HalfDisc { radius, contact_element_size: size, refined_radius, growth, edge: None };
            mesh_file(folder.path(), name, k, disc)
        })
    };
    let bad = files("pole", CONTACT_RADIUS / 24.0, 0.15 * CONTACT_RADIUS, 2.0);
    let good = files("good", CONTACT_RADIUS / 10.0, 1.2 * CONTACT_RADIUS, 1.1);
    for model in ["fem", "condensed"] {
        let model = format!("model.{model}={{}}");
        let [bad, good] = [&bad, &good]
            .map(|files| run(&files.iter().chain([&model]).cloned().collect::<Vec<String>>()));
        assert_eq!(bad.1.stop(), None, "{model}");
        let after = bad.0.warnings(&bad.1).join("\n");
        assert!(after.contains(" because of the mesh"), "{model}: {after}");
        assert!(!after.contains("contact_element_size"), "{model}: {after}");
        assert_eq!(good.0.mesh_warning(), None, "{model}");
        assert!(!good.0.warnings(&good.1).join("\n").contains("because of the mesh"), "{model}");
    }
}

/// The coarser body counts, also with an imported mesh.
#[test]
fn resolution_warning_counts_the_coarser_body() {
    let folder = tempfile::tempdir().unwrap();
    let disc = HalfDisc {
        radius: RADII[1],
        contact_element_size: 0.1e-3,
        refined_radius: 0.2e-3,
        growth: None,
        edge: None,
    };
    let file = mesh_file(folder.path(), "coarse", 1, disc);
    let (simulation, _) = run(&[file, "model.condensed={}".to_string()]);
    let warning = simulation.mesh_warning().unwrap();
    assert!(warning.contains("only 2.2 elements"), "{warning}");
}

/// A nearly incompressible material makes explicit steps short, and the condensed model is suggested.
#[test]
fn a_cheaper_model_is_suggested_for_a_long_run() {
    let hint = |overrides: &[&str]| simulation_of(GLASS, overrides).cheaper_model_hint();
    let stiff = "material.glass.poissons_ratio=0.499999";
    let found = hint(&[stiff]).expect("a hint");
    assert!(found.contains("model.condensed = {}") && found.contains("hundredths"), "{found}");
    assert_eq!(hint(&[]), None);
    assert_eq!(hint(&[stiff, "model.condensed={}"]), None);
    // No model is suggested if only explicit elements are sufficient.
    assert_eq!(hint(&[stiff, "effects.hourglass_control='on'"]), None);
}

/// One warning reports elements wider than the contact, without a number for the error, and the advised size is sufficient.
#[test]
fn an_unresolved_contact_has_one_warning() {
    for model in ["fem", "condensed"] {
        for size in ["0.3 mm", "1 mm", "1.8 mm"] {
            let size = format!("mesh.contact_element_size='{size}'");
            let (simulation, collision) = run(&of(model, &[&size]));
            let before = simulation.mesh_warning().unwrap();
            let after = simulation.warnings(&collision);
            for (when, warnings) in [("before", vec![before]), ("after", after)] {
                let of_mesh: Vec<&String> = warnings
                    .iter()
                    .filter(|text| {
                        text.contains("the mesh") || text.contains("contact_element_size")
                    })
                    .collect();
                let [one] = of_mesh[..] else { panic!("{model} {size} {when}: {warnings:#?}") };
                assert!(one.contains("spans only 0."), "{one}");
                assert!(one.contains("set mesh.contact_element_size = \"40 µm\" or less"), "{one}");
                assert!(!one.contains('%'), "{one}");
            }
            let errors = simulation.estimate_errors(&collision);
            let time = errors.discretisation(QuantityOfInterest::ContactTime).unwrap();
            assert!(time >= 0.5 * collision.contact_time.unwrap(), "{model} {size}");
        }
        let (simulation, collision) = run(&of(model, &["mesh.contact_element_size='40 um'"]));
        assert_eq!(simulation.warnings(&collision), [""; 0]);
        let hertz = simulation.setup().estimate.hertz.contact_time();
        assert!((collision.contact_time.unwrap() / hertz - 1.0).abs() < 0.015);
    }
}
