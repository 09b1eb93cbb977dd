//! `material = "lib:NAME"`.

use std::path::Path;

use fem_case::library::{LikeMaterial, materials, table_text};
use fem_case::schema::BodyTable;
use fem_case::{Case, CaseFile};
use fem_material::{ElasticModuli, Material};

use crate::parse_in;

const BALL: &str = "
    body = [{ name = 'floor', wall = {} },
            { name = 'ball', sphere.diameter = '10 mm', material = 'lib:pmma', approach_speed = '1 m/s' }]
";

fn parse(text: &str, overrides: &[&str]) -> Result<Case, fem_case::CaseError> {
    parse_in(Path::new("."), "ball.toml", text, overrides)
}

fn fault(overrides: &[&str]) -> String {
    parse(BALL, overrides).unwrap_err().to_string()
}

/// The numbers agree with moduli of other sources.
#[test]
fn materials_are_solids_with_a_source() {
    assert!(materials().len() > 15, "{:?}", materials().keys());
    let of = |name: &str| {
        let case = parse(BALL, &[&format!("body.1.material='lib:{name}'")]).unwrap();
        case.scene().bodies()[1].material().unwrap().clone()
    };
    for (name, entry) in materials() {
        for text in [&entry.title, &entry.source, &entry.range] {
            assert!(text.len() > 3, "{name}: {entry:?}");
        }
        let material = of(name);
        // From cork to tungsten carbide.
        assert!((100.0..20_000.0).contains(&material.density()), "{name}");
        assert!((1e6..6e11).contains(&material.instantaneous().youngs_modulus()), "{name}");
    }
    // Bulk and shear moduli that the sources print beside the two that stand in the library, GPa, and
    // how far their rounding lets them differ.
    for (name, bulk, shear, digit) in [
        ("alumina", 257.0, 169.0, 1.0),
        ("ice", 8.90, 3.52, 0.02),
        ("brass", 111.8, 37.3, 0.1),
        ("copper", 137.8, 48.3, 0.2),
        ("fused-silica", 36.9, 31.2, 0.1),
        ("tungsten-carbide", 319.0, 219.0, 1.0),
        ("steel", 175.0, 80.8, 0.1),
    ] {
        let found = *of(name).instantaneous();
        assert!((found.bulk_modulus() / 1e9 - bulk).abs() <= digit, "{name}: {found:?}");
        assert!((found.shear_modulus() / 1e9 - shear).abs() <= digit, "{name}: {found:?}");
    }
}

/// PVB relaxes to almost nothing, as the eleven terms of the paper add up to.
#[test]
fn pvb_equilibrium_shear_modulus_is_the_published_fraction() {
    let case = parse(BALL, &["body.1.material='lib:pvb'"]).unwrap();
    let material = case.scene().bodies()[1].material().unwrap();
    let lasting = material.equilibrium_shear_modulus() / material.instantaneous().shear_modulus();
    assert!((lasting - 1.35e-4).abs() < 1e-6, "{lasting}");
}

#[test]
fn library_material_is_copied_into_the_case() {
    let case = parse(BALL, &[]).unwrap();
    let pmma = &materials()["pmma"].material;
    assert_eq!(case.file().material.get("lib:pmma").unwrap().density.si(), pmma.density.si());
    // As text and in code, and from the resolved case, it is the same scene.
    let again = parse(&case.file().to_toml().unwrap(), &[]).unwrap();
    assert_eq!(again.scene().bodies(), case.scene().bodies());
    let ball = BodyTable::sphere("ball", "10 mm", "lib:pmma").approaching("1 m/s");
    let made = Case::of(CaseFile::of_bodies(BodyTable::wall("floor"), ball)).unwrap();
    assert_eq!(made.scene().bodies(), case.scene().bodies());
    let edited = case.edited(|file| file.body[1].material = Some("lib:steel".into())).unwrap();
    let steel = parse(BALL, &["body.1.material='lib:steel'"]).unwrap();
    assert_eq!(edited.scene().bodies(), steel.scene().bodies());
    // Other materials are not added.
    assert!(!case.file().material.contains_key("lib:steel"));
}

#[test]
fn printed_material_table_equals_the_library_material() {
    for name in materials().keys() {
        let text = BALL.replace("lib:pmma", name) + &table_text(name).unwrap();
        let own = parse(&text, &[]).unwrap();
        let set = format!("body.1.material='lib:{name}'");
        let library = parse(BALL, &[&set]).unwrap();
        // The names are those of the cases.
        let bodies = |case: &Case| format!("{:?}", case.scene().bodies()).replace("lib:", "");
        assert_eq!(bodies(&own), bodies(&library), "{name}");
    }
    assert_eq!(table_text("no such"), None);
}

/// A key that the case gives itself goes before that of the library.
#[test]
fn single_keys_can_be_overridden() {
    let case = parse(BALL, &["material.'lib:pmma'.youngs_modulus='5 GPa'"]).unwrap();
    let material = case.scene().bodies()[1].material().unwrap();
    assert!((material.instantaneous().youngs_modulus() / 5e9 - 1.0).abs() < 1e-14);
    assert_eq!(material.density(), 1190.0);
    let text = format!("{BALL}\n[material.'lib:pmma']\ndensity = 1200\n");
    let case = parse(&text, &[]).unwrap();
    assert_eq!(case.scene().bodies()[1].material().unwrap().density(), 1200.0);
    // The key that the user gave is blamed.
    let three = fault(&["material.'lib:pmma'.shear_modulus=1e9"]);
    assert!(three.starts_with("--set material.'lib:pmma'.shear_modulus=…:"), "{three}");
    assert!(three.contains("exactly two of"), "{three}");
}

#[test]
fn an_unknown_name_lists_the_library() {
    let error = parse(&BALL.replace("pmma", "pmna"), &[]).unwrap_err();
    assert_eq!((error.line(), error.column()), (Some(3), Some(68)), "{error}");
    let text = error.to_string();
    assert!(text.contains("did you mean `lib:pmma`?"), "{text}");
    assert!(text.contains("lib:alumina, lib:aluminium"), "{text}");
    for (name, expected) in [("acryl", "pmma"), ("plexi", "pmma"), ("rubbr", "natural-rubber")] {
        let message = fault(&[&format!("body.1.material='lib:{name}'")]);
        assert!(message.contains(&format!("did you mean `lib:{expected}`?")), "{message}");
    }
    assert!(fault(&["body.1.material='lib:'"]).contains("the library has"));
    assert!(fault(&["material=3"]).contains("material"));
    assert!(fault(&["material.'lib:pmma'=3"]).contains("lib:pmma"));
}

/// Names as people type them, for a body, for its table, and for both bodies in two spellings.
#[test]
fn other_names_of_materials_are_known() {
    let name_of = |overrides: &[&str]| {
        let case = parse(BALL, overrides).unwrap();
        let density = case.scene().bodies()[1].material().unwrap().density();
        (case.file().body[1].material.clone().unwrap(), density)
    };
    for (name, own, density) in [
        ("PMMA", "lib:pmma", 1190.0),
        ("Plexiglass", "lib:pmma", 1190.0),
        ("silica", "lib:fused-silica", 2200.0),
        ("Fused Silica", "lib:fused-silica", 2200.0),
        ("PDMS", "lib:silicone", 1030.0),
        ("100Cr6", "lib:bearing-steel", 7900.0),
        ("HDPE", "lib:polyethylene", 950.0),
        ("teflon", "lib:ptfe", 2170.0),
        ("Delrin", "lib:pom", 1420.0),
        ("zirconium dioxide", "lib:zirconia", 6050.0),
        ("quartz sand", "lib:quartz", 2650.0),
    ] {
        let body = format!("body.1.material='lib:{name}'");
        assert_eq!(name_of(&[&body]), (own.to_string(), density));
        let table = format!("material.'lib:{name}'.density=1000");
        assert_eq!(name_of(&[&body, &table]), (own.to_string(), 1000.0));
        let ball = BodyTable::sphere("ball", 0.01, format!("lib:{name}")).approaching(1.0);
        let made = Case::of(CaseFile::of_bodies(BodyTable::wall("floor"), ball)).unwrap();
        assert_eq!(made.scene().bodies()[1].material().unwrap().density(), density);
    }
    let both = ["body.0={name='a', sphere.diameter=0.01, material='lib:Perspex'}"];
    assert_eq!(name_of(&both).0, "lib:pmma");
    let names = materials().iter().flat_map(|(name, entry)| [name].into_iter().chain(&entry.names));
    let mut names: Vec<String> = names.map(|name| name.to_lowercase()).collect();
    names.sort();
    let n = names.len();
    names.dedup();
    assert_eq!(names.len(), n, "two materials have one name");
}

/// The loss of a material is unknown for each way to use one without a relaxation, unless it is meant to be elastic, a contact
/// law gives the loss, or a metal flows.
#[test]
fn an_unknown_loss_is_known() {
    let unknown = |text: &str, set: &[&str], flows: bool| {
        let case = parse(text, set).unwrap();
        let bodies = case.scene().bodies_of_unknown_loss(flows);
        bodies.map(|body| body.name().to_string()).collect::<Vec<_>>()
    };
    // Of the library, as `fem-run new` writes it, and as a resolved case has it.
    let copy = BALL.replace("lib:pmma", "pmma") + &table_text("pmma").unwrap();
    for (text, flows) in [(BALL, false), (BALL, true), (&copy, false)] {
        assert_eq!(unknown(text, &[], flows), ["ball"]);
    }
    let resolved = Case::of(parse(BALL, &[]).unwrap().file().clone()).unwrap();
    assert_eq!(resolved.scene().bodies_of_unknown_loss(false).count(), 1);
    let relaxing = "material.'lib:pmma'.relaxation={ acts_on = 'shear', terms = [{ weight = 0.1, \
                    relaxation_time = 1 }] }";
    let law = "model.law={ kuwabara_kono = { a = '1e-6 s' } }";
    for set in ["body.1.material='lib:pvb'", relaxing, law, "material.'lib:pmma'.elastic=true"] {
        assert!(unknown(BALL, &[set], false).is_empty(), "{set}");
    }
    let steel = ["body.1.material='lib:steel'"];
    assert_eq!(unknown(BALL, &steel, false), ["ball"]);
    assert!(unknown(BALL, &steel, true).is_empty());
}

/// What has the numbers of a material of the library is known as that, and of equally near ones the weakest. What is like no
/// material of the library is judged by one with a strength.
#[test]
fn the_nearest_material_is_found_by_its_numbers() {
    let like = |modulus: f64, density: f64, ratio: f64| {
        let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(modulus, ratio).unwrap();
        let material = Material::new(density, moduli, None);
        let found = LikeMaterial::of(&material.unwrap()).unwrap();
        (found.name, found.is_alike, found.yield_strength)
    };
    assert_eq!(like(210e9, 7850.0, 0.3), ("steel", true, Some(235e6)));
    assert_eq!(like(210e9, 7900.0, 0.29), ("steel", true, Some(235e6)));
    assert_eq!(like(70e9, 2700.0, 0.33), ("aluminium", true, Some(276e6)));
    // Glass, and sand of quartz.
    for density in [2500.0, 2650.0] {
        let (name, _, strength) = like(72e9, density, 0.2);
        assert!(name.contains("glass") && strength.is_none(), "{name}");
    }
    assert!(!like(150e9, 7000.0, 0.3).1);
    // Lead, tungsten, magnesium, polyethylene, wood: no stronger than the weakest metal or polymer near them.
    for (modulus, density, ratio, most) in [
        (16e9, 11340.0, 0.44, 100e6),
        (400e9, 19300.0, 0.28, 250e6),
        (45e9, 1740.0, 0.29, 300e6),
        (1e9, 950.0, 0.42, 100e6),
        (10e9, 600.0, 0.3, 110e6),
    ] {
        let (name, is_alike, strength) = like(modulus, density, ratio);
        assert!(!is_alike && strength.is_some_and(|it| it <= most), "{name} {strength:?}");
    }
}

/// Within the measured speeds of a material its restitution is known.
#[test]
fn measured_restitutions_are_found_at_their_speeds() {
    let measured = |speed: &str| {
        let set = ["body.1.material='lib:ice'", &format!("body.1.approach_speed='{speed}'")];
        let case = parse(BALL, &set).unwrap();
        let (all, speed) = (case.scene().measured_restitutions(), case.scene().approach_speed());
        all.iter().find_map(|it| Some((it.name.clone(), it.at(speed)?)))
    };
    assert_eq!(measured("1 cm/s"), Some(("bridges-1984".to_string(), 0.32)));
    assert_eq!(measured("10 cm/s").unwrap().0, "heisselmann-2010");
    assert_eq!(measured("1 m/s"), None);
    // Restitutions of ice on ice are not those of ice on steel.
    let two = BALL.replace("wall = {}", "half_space = {}, material = 'lib:steel'");
    let of = |text: &str| {
        parse(text, &["body.1.material='lib:ice'"]).unwrap().scene().measured_restitutions().len()
    };
    assert_eq!((of(BALL), of(&two)), (3, 0));
}

/// Every measured restitution is a number between 0 and 1 at speeds in order, with a name of its own.
#[test]
fn measured_restitutions_are_plausible() {
    for (name, entry) in materials() {
        for (k, measured) in entry.measured.iter().enumerate() {
            let of = format!("{name}, {}", measured.name);
            assert!(entry.measured[..k].iter().all(|other| other.name != measured.name), "{of}");
            assert!(measured.source.len() > 20 && !measured.bodies.is_empty(), "{of}");
            let (slowest, fastest) = measured.speeds();
            assert!(0.0 < slowest && slowest <= fastest && fastest < 100.0, "{of}");
            let points = measured.points();
            assert!(!points.is_empty(), "{of}");
            for (speed, restitution) in points {
                assert!((slowest..=1.0001 * fastest).contains(&speed), "{of}");
                assert!(restitution > 0.05 && restitution <= 1.0, "{of}: {restitution}");
                assert_eq!(measured.at(speed), Some(restitution), "{of}");
            }
            assert!(measured.scatter().is_none_or(|it| it > 0.0 && it < 0.3), "{of}");
            assert!(measured.law_text().starts_with("e = 0."), "{}", measured.law_text());
        }
    }
    let ice = &materials()["ice"].measured;
    assert_eq!(ice[0].law_text(), "e = 0.32 (v / 1 cm/s)^-0.234, 200.0 µm/s to 50.00 mm/s");
    assert_eq!(materials()["granite"].measured[0].scatter(), Some(0.06));
    // The law of Hatzes exceeds 1 below 0.26 mm/s.
    assert!(ice[1].points()[0].0 > 2.5e-4 && ice[1].at(1.6e-4) == Some(1.0));
}
