//! Positions of faults: files that cannot be read, and keys that a later check blames.

use fem_case::Case;

use super::marked::{VALID, parse};

#[test]
fn files() {
    let folder = tempfile::tempdir().unwrap();
    let load = |name: &str| Case::load(&folder.path().join(name), &[]).unwrap_err();
    let error = load("none.toml");
    assert!(error.source_name().ends_with("none.toml"), "{error}");
    assert!(error.message().contains("no such file"), "{error}");
    assert_eq!((error.line(), error.span()), (None, None));
    let error = load("");
    assert!(error.message().contains("folder"), "{error}");
    std::fs::write(folder.path().join("latin.toml"), b"# caf\xc3\xa9\n# caf\xe9\n").unwrap();
    let error = load("latin.toml");
    assert!(error.message().contains("UTF-8"), "{error}");
    assert_eq!((error.line(), error.column()), (Some(2), Some(6)));
    std::fs::write(folder.path().join("bom.toml"), format!("\u{feff}{VALID}")).unwrap();
    let case = Case::load(&folder.path().join("bom.toml"), &[]).unwrap();
    assert_eq!(case.error_at("start.gap", "").line(), Some(24));
}

#[test]
fn later_faults_point_at_their_key() {
    let case = parse(VALID).unwrap();
    let error = case.error_at("mesh.contact_element_size", "too coarse").with_help("14 um");
    assert_eq!((error.line(), error.column()), (Some(27), Some(24)));
    assert!(case.gives("mesh.contact_element_size"));
    let without = VALID.replace("contact_element_size = \"14 um\"\n", "");
    let case = parse(&without).unwrap();
    let error = case.error_at("mesh.contact_element_size", "too coarse");
    assert!(!case.gives("mesh.contact_element_size"));
    assert_eq!((error.line(), error.column()), (Some(26), Some(1)));
    let error = case.error_at("nothing.at.all", "nowhere");
    assert_eq!((error.line(), error.column()), (Some(1), Some(1)));
}
