//! Checks the table of shipped cases in docs/cases.md: one line per case, with the effects and the model of its plan.
//! Times are not tested.

use std::fs;

use fem::{Case, Simulation};

use crate::pages::{Page, root};

/// Effects that explicit elements have in every scene.
const MESHED: [&str; 3] = ["hourglass control", "contact search", "mass scaling"];

/// Returns name, effects and model of a case as in the table.
fn cells(case: &Case, name: &str) -> [String; 3] {
    let simulation = Simulation::new(case.clone()).unwrap();
    let decisions = simulation.setup().decisions.all.iter();
    let active = decisions.filter(|decision| decision.active).map(|decision| decision.name);
    let active: Vec<&str> = active.filter(|effect| !MESHED.contains(effect)).collect();
    let effects = if active.is_empty() { "none".to_string() } else { active.join(", ") };
    let model = toml::Table::try_from(simulation.resolved().model.as_ref().unwrap()).unwrap();
    let by = if simulation.considered().is_empty() { "" } else { ", by `auto`" };
    let model = format!("{}{by}", model.keys().next().unwrap());
    [format!("`{name}`"), effects, model]
}

#[test]
fn cases_page_lists_every_shipped_case() {
    let mut expected = Vec::new();
    for entry in fs::read_dir(root().join("cases")).unwrap() {
        let path = entry.unwrap().path();
        // A sweep file has no bodies.
        if fs::read_to_string(&path).unwrap().contains("\n[[body]]") {
            let name = path.file_stem().unwrap().to_str().unwrap();
            expected.push(cells(&Case::load(&path, &[]).unwrap(), name));
        }
    }
    let page = Page::load("docs/cases.md");
    let lines = page.text.lines().skip_while(|line| !line.starts_with("| case |")).skip(2);
    let mut shown: Vec<[String; 3]> = lines
        .take_while(|line| line.starts_with('|'))
        .map(|line| line.trim_matches('|').split('|').map(|cell| cell.trim().to_string()))
        .map(|cells| cells.collect::<Vec<String>>())
        .map(|cells| [&cells[0], &cells[2], &cells[3]].map(String::clone))
        .collect();
    expected.sort();
    shown.sort();
    assert_eq!(shown, expected);
}
