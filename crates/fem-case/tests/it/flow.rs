//! `[material.NAME.flow]`: flow rules from tables, CSV files, overrides, and materials of the library.

use std::path::Path;

use fem_case::{Case, CaseError};
use fem_material::FlowRule;

use crate::{BALL_ON_WALL, parse_in};

const METAL: &str = r#"material.solid = { density = 8000, youngs_modulus = "200 GPa", poissons_ratio = 0.3,
    yield_strength = "235 MPa" }"#;

fn parse(folder: &Path, overrides: &[&str]) -> Result<Case, CaseError> {
    parse_in(folder, "ball.toml", &format!("{METAL}{BALL_ON_WALL}"), overrides)
}

fn rule(overrides: &[&str]) -> FlowRule {
    let case = parse(Path::new("."), overrides).unwrap();
    case.scene().bodies()[0].material().unwrap().flow().unwrap().clone()
}

fn stresses(rule: &FlowRule) -> [f64; 3] {
    [0.0, 0.1, 0.5].map(|strain| rule.flow_stress(strain, 0.0))
}

/// The values of each kind of hardening by hand.
#[test]
fn hardening_is_that_of_its_formula() {
    let perfect = rule(&["material.solid.flow.hardening='perfect'"]);
    // The name stands for its table inside of a larger value too.
    let whole = "material.solid.flow={ yield_strength='235 MPa', hardening='perfect' }";
    assert_eq!(rule(&[whole]), rule(&["material.solid.flow={ yield_strength='235 MPa' }"]));
    assert_eq!(stresses(&perfect), [235e6; 3], "the strength is that beside the density");
    let own = rule(&["material.solid.flow={ yield_strength='1 GPa' }"]);
    assert_eq!(stresses(&own), [1e9; 3]);
    let linear = rule(&["material.solid.flow.hardening.modulus='2 GPa'"]);
    assert_eq!(stresses(&linear), [235e6, 435e6, 1235e6]);
    let swift = rule(&["material.solid.flow.hardening.swift={ strain = 0.1, exponent = 0.5 }"]);
    let expected = [1.0, 2f64.sqrt(), 6f64.sqrt()].map(|factor| 235e6 * factor);
    for (found, expected) in stresses(&swift).into_iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < 1e-12);
    }
    let table = rule(&["material.solid.flow.hardening.table=[['20 %', '435 MPa']]"]);
    assert_eq!(stresses(&table), [235e6, 335e6, 435e6]);
    let rate = "material.solid.flow.rate.johnson_cook={ c = 0.01, reference_rate = '1 1/s' }";
    assert_eq!(rule(&[rate]).flow_stress(0.0, 1.0_f64.exp()), 235e6 * 1.01);
}

/// One kind of hardening replaces another, and a name stands for a table.
#[test]
fn an_override_replaces_the_hardening() {
    let swift = "material.solid.flow.hardening.swift={ strain = 0.1, exponent = 0.5 }";
    let linear = "material.solid.flow.hardening.modulus=0";
    assert_eq!(stresses(&rule(&[swift, linear])), [235e6; 3]);
    assert_eq!(stresses(&rule(&[linear, "material.solid.flow.hardening='perfect'"])), [235e6; 3]);
}

/// Tables as people write them give the same rule, which the case keeps without the file.
#[test]
fn flow_stress_is_read_from_csv() {
    let folder = tempfile::tempdir().unwrap();
    let of = |text: &str| {
        std::fs::write(folder.path().join("flow.csv"), text).unwrap();
        parse(folder.path(), &["material.solid.flow.hardening.table='flow.csv'"])
    };
    for text in [
        "plastic_strain,flow_stress_pa\n0,2e8\n0.2,4e8\n",
        "# tension\nplastic_strain;flow_stress_MPa\n0;200\n0.2;400\n",
        "plastic strain; flow stress [MPa]\n0; 200,0\n0,2; 400,0\n",
        "strain [%]\tstress [MPa]\n0\t200\n20\t400\n",
        "strain stress\n0 0.2e9\n0.2 0.4e9\n\n",
        "strain,stress\n0,0.2 GPa\n0.2,400 MPa\n",
        "eps,sigma (GPa)\r\n0, 0.2\r\n0.2, 0.4\r\n",
        "\"strain\",\"stress (GPa)\"\n\"0\",\"0.2\"\n\"0.2\",\"0.4\"\n",
    ] {
        let case = of(text).unwrap();
        let found = stresses(case.scene().bodies()[0].material().unwrap().flow().unwrap());
        for (found, expected) in found.into_iter().zip([2e8, 3e8, 4e8]) {
            assert!((found / expected - 1.0).abs() < 1e-12, "{text}: {found}");
        }
        let written = case.file().to_toml().unwrap();
        let again = Case::parse("ball.toml", &written, Path::new("/nowhere"), &[]).unwrap();
        assert_eq!(again.scene().bodies(), case.scene().bodies());
    }
    for (text, message) in [
        ("", "flow.csv is empty"),
        ("0,2e8\n0.2,4e8\n", "flow.csv:1 is of numbers: there is no header"),
        ("a,b,c\n1,2,3\n", "flow.csv:1 has 3 columns, not two"),
        ("strain,stress_mpa\n0,200\n1\n", "flow.csv:3 has 1 cells, not two"),
        ("strain,stress\n0,200\n", "flow.csv:2: the flow stress is 200.0 Pa"),
        ("strain,stress_mpa\n0,much\n", "flow.csv:2: \"much MPa\" is no flow stress"),
        ("strain,stress_mpa\n0 mm,200\n", "flow.csv:2: \"0 mm\" is no plastic strain"),
        ("strain [mm],stress_mpa\n0,200\n", "flow.csv:2: \"0\" is no plastic strain"),
        ("strain,stress [mm]\n0,200\n", "flow.csv:2: \"200 mm\" is no flow stress"),
    ] {
        let error = of(text).unwrap_err().to_string();
        assert!(error.contains(message), "{text}: {error}");
    }
}

/// A material of the library flows with its own yield strength.
#[test]
fn library_materials_take_a_flow_rule() {
    let steel = ["body.0.material='lib:steel'", "material.'lib:steel'.flow.hardening='perfect'"];
    assert_eq!(stresses(&rule(&steel)), [235e6; 3]);
}
