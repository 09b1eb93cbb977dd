//! The program `fem-validate`: verdicts, exit statuses, the page, and the committed table.

use std::path::Path;

use crate::common::{FAILS, Place};

const CHECK: &str = r#"
[[check]]
quantity = "pair.restitution"
label = "restitution"
kind = "published"
source = "nobody"
reference = 0.93
absolute = 0.01
reason = "a coarse mesh"
"#;

/// Returns a claim about [`crate::common::CASE`] with these checks.
fn claim(checks: &str) -> String {
    format!(
        "title = 'A claim'\nsection = 'paper'\nclaim = 'It is so.'\nstudy = 'summary'\n\
         [run.pair]\ncase = '../../case.toml'\n{checks}"
    )
}

fn place(checks: &str) -> Place {
    let place = Place::new();
    std::fs::create_dir_all(place.path("validation/mine")).unwrap();
    place.write("validation/mine/claim.toml", &claim(checks));
    place
}

#[test]
fn a_claim_that_holds_is_shown_with_its_reference() {
    let place = place(CHECK);
    let ran = place.succeed("");
    ran.prints("Against Bordbar & Hyppänen (2007)|mine|restitution|0.93|0.01|pass");
    ran.tells("[1/1] pass  mine");
    assert_eq!(place.list("runs/validation"), ["checks.csv", "index.html", "summary.json"]);
    assert_eq!(place.json("runs/validation/summary.json")["passed"], true);
    let page = place.text("runs/validation/index.html");
    for outside in ["<script", "<link", "@import", "src=\"http", "url("] {
        assert!(!page.contains(outside), "{outside}");
    }
    for source in page.split("src=\"").skip(1) {
        assert!(source.starts_with("data:image/svg+xml;base64,"));
    }
    // A second time, over the old page.
    place.succeed("mine --quiet");
}

#[test]
fn a_claim_that_fails_ends_with_status_1_and_keeps_the_page() {
    let place = place(&CHECK.replace("0.93", "0.99"));
    let ran = place.fails(1, "");
    ran.prints("FAIL");
    ran.tells("1 of 1 claims fail: mine");
    let page = place.text("runs/validation/index.html");
    assert!(page.contains("FAIL") && page.contains("It is so."));
    assert_eq!(place.json("runs/validation/summary.json")["passed"], false);
    // A quantity that the study does not measure, and a run that fails.
    let other = CHECK.replace("pair.restitution", "pair.colour");
    place.write("validation/mine/claim.toml", &claim(&other));
    place.fails(1, "").prints("not measured");
    let text = claim(CHECK).replace("case.toml'\n", &format!("case.toml'\nset = {FAILS:?}\n"));
    place.write("validation/mine/claim.toml", &text);
    place.fails(1, "").prints("mine|FAIL");
}

#[test]
fn claims_are_evaluated_for_any_model() {
    for model in ["model.condensed={}", "model.ting={}"] {
        let place = place(CHECK);
        let text =
            claim(CHECK).replace("case.toml'\n", &format!("case.toml'\nset = ['{model}']\n"));
        assert!(text.contains(model));
        place.write("validation/mine/claim.toml", &text);
        place.succeed("--quiet");
    }
}

#[test]
fn bad_claims_are_refused_before_anything_runs() {
    let no_tolerance = CHECK.replace("absolute = 0.01\n", "");
    let no_reference = CHECK.replace("reference = 0.93\n", "");
    let line = |text: &str, word: &str| {
        let before = text.find(word).unwrap();
        format!("claim.toml:{}:", text[..before].matches('\n').count() + 1)
    };
    for (checks, place_of, message) in [
        (no_tolerance.as_str(), "[[check]]", "exactly one of relative"),
        (no_reference.as_str(), "[[check]]", "need a reference"),
        (&CHECK.replace("label", "labl"), "labl", "unknown field `labl`"),
        (&CHECK.replace("published", "hearsay"), "\"hearsay", "unknown variant"),
    ] {
        let place = place(checks);
        let ran = place.fails(2, "");
        ran.tells(line(&claim(checks), place_of));
        ran.tells(message);
        assert!(!place.path("runs").exists());
    }
    let place = place(CHECK);
    place.write("taken.md", "mine");
    for (arguments, message) in [
        (&["--table", "taken.md"][..], "taken.md: this file is not a table of fem-run"),
        (&["--table", "t.csv"], "t.csv: a table of fem-run is a .md file"),
        (&["yours"], "there is no claim `yours`; the claims are mine"),
        (&["--claims", "nowhere"], "nowhere"),
        (&["mine", "--table", "t.md"], "--table"),
        (&["mine", "--scenes", "t.md"], "none of the named claims has hard scenes"),
    ] {
        place.fails(2, arguments).tells(message);
    }
    let sumary = claim(CHECK).replace("'summary'", "'sumary'");
    place.write("validation/mine/claim.toml", &sumary);
    let message = "claim.toml:1:1: there is no study `sumary`; the studies are balances, ";
    place.fails(2, "").tells(message);
    place.write("validation/mine/claim.toml", &claim(CHECK));
    place.write("case.toml", &crate::common::CASE.replace("density", "densty"));
    place.fails(2, "").tells("case.toml:4:1: ");
}

/// validation/claims.md agrees with the claims: same claims, checks, references and tolerances, and all of
/// them held.
#[test]
fn the_committed_table_is_that_of_the_claims() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let claims = fem_validate::load_claims(&root.join("validation"), &[]).unwrap();
    let table = std::fs::read_to_string(root.join("validation/claims.md")).unwrap();
    let mut rows = table.lines().filter(|line| line.ends_with("| pass |"));
    for claim in &claims {
        for check in &claim.checks {
            let row = rows.next().unwrap_or_default();
            let cells: Vec<&str> = row.split(" | ").collect();
            // A bar would end the cell.
            let label = check.label.replace('|', "\\|");
            assert_eq!(cells.get(1), Some(&label.as_str()), "{}", claim.name);
            assert_eq!(cells.get(3), Some(&check.reference_text().as_str()), "{}", claim.name);
            assert_eq!(cells.get(6), Some(&check.tolerance_text().as_str()), "{}", claim.name);
        }
    }
    assert_eq!(rows.next(), None);
    assert!(!table.contains("FAIL"));
}
