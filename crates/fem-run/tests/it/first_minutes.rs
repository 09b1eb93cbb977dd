//! What a new user does first: pick a material, start a case.

use crate::common::Place;

#[test]
fn materials_are_listed_and_one_is_printed_as_a_table_of_a_case() {
    let place = Place::new();
    let list = place.succeed(&["materials"]).stdout;
    for name in ["alumina", "glass", "pmma", "soda-lime-glass"] {
        let row = list.lines().find(|line| line.starts_with(&format!("{name} ")));
        assert!(row.is_some(), "{name}: {list}");
    }
    let one = place.succeed(&["materials", "lib:pmma"]).stdout;
    assert!(one.contains("# Source: ") && one.contains("# Range: "), "{one}");
    assert!(one.lines().all(|line| line.len() <= 100), "{one}");
    // The text is a table of a case.
    let bodies = "[[body]]\nname = 'floor'\nwall = {}\n\n[[body]]\nname = 'ball'\nmaterial = 'pmma'\n\
                  sphere = { diameter = '1 cm' }\napproach_speed = 1\n\n[model]\nhertz = {}\n";
    place.write("ball.toml", &format!("{bodies}\n{one}"));
    place.write("short.toml", &bodies.replace("'pmma'", "'lib:pmma'"));
    let own = place.succeed(&["ball.toml", "--json"]).stdout;
    let short = place.succeed(&["short.toml", "--json"]).stdout;
    let read = |text: &str| -> serde_json::Value { serde_json::from_str(text).unwrap() };
    let (own, short) = (read(&own), read(&short));
    assert_eq!(own["peak_force_n"], short["peak_force_n"]);
    assert_eq!(own["case"]["material"]["pmma"], short["case"]["material"]["lib:pmma"]);
    assert_eq!(short["case"]["material"]["lib:pmma"]["density"], 1190.0);
}

#[test]
fn a_material_that_is_not_there_is_bad_input() {
    let ran = Place::new().run(&["materials", "rubber"]);
    assert_eq!(ran.code, Some(2));
    assert!(ran.stderr.contains("did you mean natural-rubber?"), "{}", ran.stderr);
    assert!(ran.stdout.is_empty());
}
