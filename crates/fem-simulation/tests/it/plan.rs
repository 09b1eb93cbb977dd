//! The plan and the model that follows from it: defaults, limits, effects, imported meshes, rejections.

use std::path::Path;

use fem_case::schema::{LawTable, MeshTable, ModelTable};
use fem_case::{Case, CaseError, CaseFile};
use fem_simulation::{
    Explicit, METHODS, Model, ModelSetup, Plan, Regime, SharedModels, Simulation,
};

use crate::scene::{
    ELASTIC_GLASS as GLASS, GLASS as RELAXING, case_of, decision_on, refused_of, simulation_of,
};

/// A tolerance with eight elements across the contact.
const FINE: &str = "accuracy.tolerance='0.1 %'";

fn case(overrides: &[&str]) -> Case {
    case_of(GLASS, overrides)
}

fn refusal(overrides: &[&str]) -> CaseError {
    refused_of(GLASS, overrides)
}

#[test]
fn defaults_follow_from_hertz() {
    let plan = Plan::of_case(&case(&[])).unwrap();
    // The closed form gives 63.235 µs for this pair at 0.5 m/s.
    assert!((plan.estimate.hertz.contact_time() * 1e6 - 63.235).abs() < 5e-4);
    // A tolerance of 1 % needs four elements across the contact: 3.75 in the larger sphere, 4.25 in the smaller one.
    assert!((plan.contact_element_size * 4.0 * 1e3 - 0.22307).abs() < 5e-6);
    let [larger, smaller] = plan.element_sizes().map(|size| 0.22307e-3 / size);
    assert!((larger - 3.75).abs() < 1e-3 && (smaller - 4.25).abs() < 1e-3, "{larger} {smaller}");
    assert_eq!(plan.mass_scaling, 5e-3);
    assert_eq!(plan.step_factor, 0.9);
    assert!((plan.contact_stiffness / 33.494e9 - 20.0).abs() < 1e-3);
}

/// The block of equal elements is as wide as the contact, up to the whole sphere.
#[test]
fn the_block_of_equal_elements_follows_the_contact() {
    let smallest = 7.95e-3;
    for (speed, least) in [("0.5", 0.02), ("500", 0.3), ("3000", 1.0)] {
        let plan = Plan::of_case(&case(&[&format!("body.0.approach_speed={speed}")])).unwrap();
        let wide = (1.2 * plan.estimate.contact_radius).min(smallest);
        assert!((plan.refined_radius / wide - 1.0).abs() < 1e-12, "{speed}");
        assert!(plan.refined_radius >= least * smallest, "{speed}: {}", plan.refined_radius);
    }
}

#[test]
fn relaxation_widens_the_expected_contact() {
    let [relaxing, elastic] = [RELAXING, GLASS].map(|text| simulation_of::<&str>(text, &[]));
    for (simulation, is_active) in [(&relaxing, true), (&elastic, false)] {
        assert_eq!(decision_on(simulation, "viscoelasticity").active, is_active);
    }
    let [relaxing, elastic] = [relaxing, elastic].map(|one| one.setup().clone());
    assert!(relaxing.estimate.contact_radius > elastic.estimate.contact_radius);
    // 1 − exp(−2708/s · 64 µs) = 16 %.
    assert!((relaxing.estimate.relaxed - 0.16).abs() < 0.005);
}

#[test]
fn resolved_case_has_the_same_plan_and_time_step() {
    let first = case(&["mesh.contact_element_size='60 um'"]);
    let text = Simulation::resolve(&first).unwrap().to_toml().unwrap();
    let again = Case::parse("resolved.toml", &text, Path::new("."), &[]).unwrap();
    assert_eq!(Simulation::resolve(&again).unwrap().to_toml().unwrap(), text);
    let [first, again] = [first, again].map(|case| Explicit::new(case.scene()).unwrap());
    let plan = |explicit: &Explicit| explicit.setup().elements.as_ref().unwrap().plan.clone();
    assert_eq!(plan(&again), plan(&first));
    assert_eq!(again.bodies().time_step(), first.bodies().time_step());
}

#[test]
fn a_run_above_a_limit_is_refused_with_its_cost() {
    // The meshes have two million elements, and more than indices can number.
    for size in ["0.2 um", "5 nm"] {
        let error = refusal(&[&format!("mesh.contact_element_size='{size}'")]);
        assert_eq!(error.source_name(), "--set mesh.contact_element_size=…");
        assert!(error.message().contains("elements"), "{error}");
        assert!(error.help().unwrap().contains("contact_element_size"), "{error}");
    }
    let error = refusal(&["limits.elements=1000", FINE]);
    assert_eq!(error.source_name(), "--set limits.elements=…");
    assert!(error.message().contains("2878 elements"), "{error}");
    assert!(error.help().unwrap().contains("limits.elements"), "{error}");
    let error = refusal(&["limits.memory='1 MB'", FINE]);
    assert_eq!(error.source_name(), "--set limits.memory=…");
    assert!(error.message().contains("5.0 MB of memory"), "{error}");
    let error = refusal(&["output.snapshots=100000"]);
    assert_eq!(error.source_name(), "--set output.snapshots=…");
    assert!(error.help().unwrap().contains("fewer output.snapshots"), "{error}");
    let error = refusal(&["limits.element_updates=1e6", FINE]);
    assert!(error.message().contains("steps"), "{error}");
    assert!(error.help().unwrap().contains("mass_scaling"), "{error}");
}

#[test]
fn elements_and_blocks_larger_than_the_body_are_refused() {
    assert!(refusal(&["mesh.contact_element_size='50 mm'"]).message().contains("too large"));
    let error = refusal(&["mesh.refined_radius='8 mm'"]);
    assert_eq!(error.source_name(), "--set mesh.refined_radius=…");
    assert!(refusal(&["mesh.growth=3"]).message().contains("growth"));
}

#[test]
fn scenes_beyond_the_model_are_warned_about() {
    let warnings =
        |overrides: &[&str]| simulation_of(GLASS, overrides).setup().warnings().join("\n");
    let small = "effects.finite_strain='off'";
    let set = ["body.0.approach_speed=100", "effects.bulk_viscosity='off'", small];
    let faster = warnings(&[&set[..], &["contact.method='penalty'"]].concat());
    assert!(faster.contains("shear wave speed"), "{faster}");
    // A massless boundary does not ring with steep fronts.
    assert!(!warnings(&set).contains("shear wave speed"));
    assert_eq!(warnings(&[]), "");
}

#[test]
fn a_missing_mesh_file_points_at_its_key() {
    let error = refusal(&["body.1.sphere.mesh='nowhere.vtu'"]);
    assert_eq!(error.source_name(), "--set body.1.sphere.mesh=…");
    assert!(error.message().contains("nowhere.vtu"), "{error}");
    assert!(error.help().unwrap().contains("fem-run mesh"), "{error}");
}

#[test]
fn a_contact_wider_than_the_candidate_region_is_computed_again() {
    let case = case(&["mesh.contact_element_size='60 um'"]);
    let mut plan = Plan::of_case(&case).unwrap();
    // Half of the largest contact radius, 0.223 mm.
    plan.candidate_radius = 0.11e-3;
    let explicit = Explicit::with_plan(case.scene(), plan).unwrap();
    let ModelSetup { approach, request, .. } = explicit.setup().clone();
    let collision = explicit.collide(&approach, &request, &mut ());
    assert!(collision.is_complete());
    assert!(collision.candidate_region.unwrap().radius > 0.223e-3);
    // The model itself does not change.
    assert!(explicit.bodies().candidate_radius() < 0.12e-3);
    assert!((collision.restitution.unwrap() - 1.0).abs() < 1e-3);
}

/// Every TOML example of the case reference is a valid case.
#[test]
fn the_examples_of_the_case_reference_are_valid() {
    let reference = include_str!("../../../../docs/cases.md");
    let examples: Vec<&str> =
        reference.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    assert_eq!(examples.len(), 8);
    for example in examples {
        let case = Case::parse("cases.md", example, Path::new("."), &[]);
        let case = case.unwrap_or_else(|error| panic!("{error}"));
        Simulation::resolve(&case).unwrap_or_else(|error| panic!("{error}"));
    }
    for law in LawTable::NAMES {
        assert!(reference.contains(&format!("| `{law}` |")), "{law}");
    }
}

fn refused(case: Case) -> CaseError {
    Simulation::new(case).map(|_| ()).unwrap_err()
}

fn mesh(file: &mut CaseFile) -> &mut MeshTable {
    file.mesh.get_or_insert_default()
}

#[test]
fn a_fault_in_the_text_keeps_its_line() {
    let text = format!("{RELAXING}\n[mesh]\nrefined_radius = \"20 mm\"\n");
    let case = Case::parse("pair.toml", &text, Path::new("."), &[]).unwrap();
    let faster = case.edited(|file| file.body[0].approach_speed = Some(0.6.into())).unwrap();
    let error = refused(faster);
    assert_eq!(error.key(), Some("mesh.refined_radius"));
    assert_eq!(error.line(), Some(text.lines().count()), "{error}");
    let wider = case.edited(|file| mesh(file).refined_radius = Some("30 mm".into())).unwrap();
    let error = refused(wider);
    assert_eq!((error.source_name(), error.line()), ("mesh.refined_radius", None), "{error}");
}

#[test]
fn a_fault_of_a_default_names_its_key() {
    let file = Case::parse("pair.toml", RELAXING, Path::new("."), &[]).unwrap().file().clone();
    let case = Case::of(file).unwrap();
    let fine = case.edited(|file| mesh(file).contact_element_size = Some("20 nm".into())).unwrap();
    assert_eq!(refused(fine).source_name(), "mesh.contact_element_size");
    let many = case.edited(|file| {
        mesh(file).contact_element_size = Some("1 um".into());
        file.model = Some(ModelTable::condensed());
        file.limits.get_or_insert_default().elements = Some(1e9.into());
    });
    assert_eq!(refused(many.unwrap()).source_name(), "limits.memory");
}

#[test]
fn a_method_refuses_a_scene_of_another_model() {
    for model in ["fem={}", "condensed={}", "hertz={}", "ting={}", "law.falcon.c=300"] {
        let set = [format!("model.{model}")];
        let case = case_of(RELAXING, &set);
        let scene = case.scene();
        for method in METHODS {
            let regime = Regime::of(scene.clone()).unwrap();
            let made = method.build(&regime, &SharedModels::default());
            if method.name() == scene.model().name() {
                made.unwrap();
            } else {
                assert_eq!(made.unwrap_err().key, scene.model().path(), "{}", method.name());
            }
        }
    }
}
