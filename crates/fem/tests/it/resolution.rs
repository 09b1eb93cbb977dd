//! Meshes that cannot carry a contact say so, by how much, and what helps.

use std::path::Path;

use fem::{Case, Collision, Simulation};
use fem_mesh::HalfDisc;

const GLASS: &str = include_str!("../../../../cases/glass_0.5ms_elastic.toml");
/// Largest contact radius of the pair, m.
const CONTACT_RADIUS: f64 = 0.2231e-3;
/// Radii of the spheres, m.
const RADII: [f64; 2] = [11.1e-3, 7.95e-3];

fn run(overrides: &[String]) -> (Simulation, Collision) {
    let case = Case::parse("glass.toml", GLASS, Path::new("."), overrides).unwrap();
    let simulation = Simulation::new(case).unwrap();
    let collision = simulation.run(&mut ());
    (simulation, collision)
}

/// Overrides with `model`.
fn of(model: &str, more: &[&str]) -> Vec<String> {
    more.iter().map(ToString::to_string).chain([format!("model.{model}={{}}")]).collect()
}

/// The percentages of a warning: of the contact time, of the peak force.
fn foretold(warning: &str) -> [f64; 2] {
    let after = |words: &str| {
        let rest = warning.split(words).nth(1).unwrap_or_else(|| panic!("{warning}"));
        rest.trim_start().split(' ').next().unwrap().parse::<f64>().unwrap() / 100.0
    };
    [after("contact time off by about"), after("peak force by about")]
}

/// The limits are those of the module: 0.3 to 3 times what is foretold of the larger error, but for the
/// half per cent that the penalty and the place of the contact's edge add.
fn is_about(found: f64, foretold: f64) -> bool {
    found.abs() > 0.3 * foretold - 0.005 && found.abs() < 3.0 * foretold + 0.005
}

#[test]
fn a_mesh_that_grows_too_fast_foretells_its_error() {
    let (_, fine) = run(&of("condensed", &["mesh.contact_element_size='14 um'"]));
    let [time, force] = [fine.contact_time.unwrap(), fine.peak_force.unwrap()];
    for model in ["fem", "condensed"] {
        for growth in ["mesh.growth=1.6", "mesh.growth=2"] {
            let (simulation, collision) = run(&of(model, &[growth]));
            let before = simulation.mesh_warning().expect("a warning before the run");
            assert!(before.contains("around the contact"), "{before}");
            assert!(before.contains("leave mesh.growth out"), "{before}");
            let after = simulation.warnings(&collision);
            assert!(after.iter().any(|text| text.contains("around the contact")), "{after:?}");
            let [of_time, of_force] = foretold(&before);
            let found = collision.contact_time.unwrap() / time - 1.0;
            assert!(is_about(found, of_time), "{model} {growth}: T {found} {of_time}");
            let found = collision.peak_force.unwrap() / force - 1.0;
            assert!(is_about(found, of_force), "{model} {growth}: F {found} {of_force}");
        }
        // Followed, the advice is enough.
        let (simulation, collision) = run(&of(model, &[]));
        assert_eq!(simulation.mesh_warning(), None);
        assert_eq!(simulation.warnings(&collision), [""; 0]);
    }
}

#[test]
fn an_imported_mesh_that_is_fine_at_the_pole_only_is_told_what_helps() {
    let folder = tempfile::tempdir().unwrap();
    let files = |name: &str, size: f64, refined_radius: f64, growth: f64| {
        let file = |k: usize| {
            let disc = HalfDisc {
                radius: RADII[k],
                contact_element_size: size,
                refined_radius,
                growth: Some(growth),
            };
            let mesh = disc.build().unwrap();
            let points: Vec<_> = mesh.nodes().iter().map(|&[r, y]| [r, y, 0.0]).collect();
            let path = folder.path().join(format!("{name}{k}.vtu"));
            fem_vtk::VtuWriter::new(&points, mesh.quads()).write(&path).unwrap();
            format!("body.{k}.sphere.mesh='{}'", path.display())
        };
        [file(0), file(1)]
    };
    let bad = files("pole", CONTACT_RADIUS / 24.0, 0.15 * CONTACT_RADIUS, 2.0);
    let good = files("good", CONTACT_RADIUS / 10.0, 1.2 * CONTACT_RADIUS, 1.1);
    for model in ["fem", "condensed"] {
        let model = format!("model.{model}={{}}");
        let [bad, good] = [&bad, &good]
            .map(|files| run(&files.iter().chain([&model]).cloned().collect::<Vec<String>>()));
        let warning = bad.0.mesh_warning().expect("a warning before the run");
        for words in ["leave body.", "with edges of"] {
            assert!(warning.contains(words), "{warning}");
        }
        // Of an imported mesh no key of the table [mesh] says anything.
        let after = bad.0.warnings(&bad.1);
        assert!(!after.iter().any(|text| text.contains("contact_element_size")), "{after:?}");
        assert_eq!(good.0.mesh_warning(), None, "{model}");
        assert_eq!(bad.1.stop(), None, "{model}");
        let found = bad.1.contact_time.unwrap() / good.1.contact_time.unwrap() - 1.0;
        assert!(is_about(found, foretold(&warning)[0]), "{model}: {found} {warning}");
    }
}

/// Bodies that differ tell of the one that is too coarse.
#[test]
fn the_coarser_body_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let disc = HalfDisc {
        radius: RADII[1],
        contact_element_size: 0.1e-3,
        refined_radius: 0.2e-3,
        growth: None,
    };
    let mesh = disc.build().unwrap();
    let points: Vec<_> = mesh.nodes().iter().map(|&[r, y]| [r, y, 0.0]).collect();
    let path = folder.path().join("coarse.vtu");
    fem_vtk::VtuWriter::new(&points, mesh.quads()).write(&path).unwrap();
    let file = format!("body.1.sphere.mesh='{}'", path.display());
    let (simulation, _) = run(&[file, "model.condensed={}".to_string()]);
    let warning = simulation.mesh_warning().unwrap();
    assert!(
        warning.contains("most by target") && warning.contains("spans 2.2 elements"),
        "{warning}"
    );
    assert!(warning.contains("leave body.1.sphere.mesh out"), "{warning}");
}

/// A volume that hardly gives way makes explicit steps short; condensed bodies have none.
#[test]
fn a_long_run_names_the_model_that_is_not() {
    let hint = |overrides: &[&str]| {
        let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
        let case = Case::parse("glass.toml", GLASS, Path::new("."), &overrides).unwrap();
        Simulation::new(case).unwrap().cheaper()
    };
    let stiff = "material.glass.poissons_ratio=0.499999";
    let found = hint(&[stiff]).expect("a hint");
    assert!(found.contains("model.condensed = {}") && found.contains("hundredths"), "{found}");
    assert_eq!(hint(&[]), None);
    assert_eq!(hint(&[stiff, "model.condensed={}"]), None);
    // Where only explicit elements serve, there is none to name.
    assert_eq!(hint(&[stiff, "effects.hourglass_control='on'"]), None);
}

/// Elements wider than the contact foretell no error in numbers, which would be 4 % where 50 % is missing; one warning
/// says so, and its remedy is enough.
#[test]
fn a_mesh_that_resolves_nothing_is_told_so_once() {
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
                assert!(one.contains("does not resolve the contact"), "{one}");
                assert!(
                    one.contains("use a mesh.contact_element_size of 40.56 µm or less"),
                    "{one}"
                );
                assert!(!one.contains('%'), "{one}");
            }
        }
        let (simulation, collision) = run(&of(model, &["mesh.contact_element_size='40.56 um'"]));
        assert_eq!(simulation.warnings(&collision), [""; 0]);
        let hertz = simulation.setup().estimate.hertz.contact_time();
        assert!((collision.contact_time.unwrap() / hertz - 1.0).abs() < 0.015);
    }
}

/// Elements far beyond the contact carry nothing of its field, and rounding of the field there is no error of theirs.
#[test]
fn what_is_far_away_is_no_fault_of_the_mesh() {
    for (large, small) in [("1e6", "1e-6"), ("1e3", "1e-3"), ("10", "1e-5")] {
        let sizes =
            [format!("body.0.sphere.diameter={large}"), format!("body.1.sphere.diameter={small}")];
        let case = [&sizes[..], &of("fem", &[])].concat();
        let case = Case::parse("glass.toml", GLASS, Path::new("."), &case).unwrap();
        assert_eq!(Simulation::new(case).unwrap().mesh_warning(), None, "{large} {small}");
    }
}
