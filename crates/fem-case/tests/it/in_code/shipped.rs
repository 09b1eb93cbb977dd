//! The cases of the repository.

use std::fs;
use std::path::{Path, PathBuf};

use fem_case::{Case, CaseFile};

/// Numbers as text: `==` on doubles would pass 0 for −0, and their `Debug` is exact.
pub fn exactly(case: &Case) -> String {
    format!("{:?}", case.scene())
}

/// All cases of the repository, and as the claims run them.
pub fn shipped() -> Vec<Case> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let files = |folder: &Path| -> Vec<PathBuf> {
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
    };
    let mut cases = Vec::new();
    for path in files(&root.join("cases")) {
        let table = parsed(&path);
        if table.contains_key("body") {
            cases.push(Case::load(&path, &[]).unwrap());
        }
    }
    for folder in files(&root.join("validation")) {
        let path = folder.join("claim.toml");
        if !path.is_file() {
            continue;
        }
        let runs = parsed(&path).remove("run").and_then(|runs| runs.try_into::<toml::Table>().ok());
        for run in runs.unwrap_or_default().values() {
            let set = run.get("set").map_or(Vec::new(), |set| set.clone().try_into().unwrap());
            let case = folder.join(run["case"].as_str().unwrap());
            cases.push(Case::load(&case, &set).unwrap());
        }
    }
    assert!(cases.len() > 50, "{}", cases.len());
    cases
}

fn parsed(path: &Path) -> toml::Table {
    fs::read_to_string(path).unwrap().parse().unwrap()
}

/// The dotted paths of all keys of a case file, but for material names that need quotes.
pub fn paths(file: &CaseFile) -> Vec<String> {
    fn add(path: &str, value: &toml::Value, paths: &mut Vec<String>) {
        paths.push(path.to_string());
        match value {
            toml::Value::Table(table) => {
                table.iter().for_each(|(key, value)| add(&format!("{path}.{key}"), value, paths));
            }
            toml::Value::Array(array) => {
                let items = array.iter().enumerate();
                items.for_each(|(index, value)| add(&format!("{path}.{index}"), value, paths));
            }
            _ => {}
        }
    }
    let mut paths = Vec::new();
    for (key, value) in toml::Table::try_from(file).unwrap() {
        add(&key, &value, &mut paths);
    }
    paths
}
