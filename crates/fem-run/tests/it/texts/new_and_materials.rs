//! The first steps of a new user: choosing a material and starting a case.

use crate::common::Place;

#[test]
fn materials_are_listed_and_one_is_printed_as_a_table_of_a_case() {
    let place = Place::new();
    let list = place.succeed("materials").stdout;
    let whole = place.succeed("materials -v").stdout;
    for name in ["alumina", "glass", "pmma", "soda-lime-glass"] {
        assert!(list.split_whitespace().any(|word| word == name), "{name}: {list}");
        let row = whole.lines().find(|line| line.starts_with(&format!("{name} ")));
        assert!(row.is_some(), "{name}: {whole}");
    }
    assert!(list.lines().count() <= 24 && list.lines().all(|line| line.len() <= 80), "{list}");
    assert!(list.contains("With measured restitutions: glass, granite, ice\n"), "{list}");
    let one = place.succeed("materials lib:pmma").stdout;
    assert!(one.contains("# Source: ") && one.contains("# Range: "), "{one}");
    assert!(one.lines().all(|line| line.len() <= 80), "{one}");
    // The text is a table of a case.
    let bodies = "[[body]]\nname = 'floor'\nwall = {}\n\n[[body]]\nname = 'ball'\nmaterial = 'pmma'\n\
                  sphere = { diameter = '1 cm' }\napproach_speed = 1\n\n[model]\nhertz = {}\n";
    place.write("ball.toml", &format!("{bodies}\n{one}"));
    place.write("short.toml", &bodies.replace("'pmma'", "'lib:pmma'"));
    let own = place.succeed("ball.toml --json").stdout;
    let short = place.succeed("short.toml --json").stdout;
    let read = |text: &str| -> serde_json::Value { serde_json::from_str(text).unwrap() };
    let (own, short) = (read(&own), read(&short));
    assert_eq!(own["peak_force_n"], short["peak_force_n"]);
    assert_eq!(own["case"]["material"]["pmma"], short["case"]["material"]["lib:pmma"]);
    assert_eq!(short["case"]["material"]["lib:pmma"]["density"], 1190.0);
    let unknown = place.fails(2, "materials rubber");
    unknown.tells("did you mean natural-rubber?");
    assert!(unknown.stdout.is_empty());
}

/// A new case runs, also with each of its commented keys enabled.
#[test]
fn new_case_is_valid_with_all_commented_keys_enabled() {
    let place = Place::new();
    for (partner, material) in [
        ("sphere", "soda-lime-glass"),
        ("wall", "pmma"),
        ("half-space", "lib:pvb"),
        ("plate", "lib:pvb"),
    ] {
        let name = format!("{partner}_0.5ms");
        let ran = place.succeed(["new", &name, "--partner", partner, "--material", material]);
        let file = format!("{name}.toml");
        ran.prints(&file);
        let text = place.text(&file);
        assert!(text.starts_with("#:schema ./fem-run.schema.json\n"), "{text}");
        for place in
            ["{below}", "{table}", "{flow}", "{relaxation}", "{gravity}", "{material}", "{file}"]
        {
            assert!(!text.contains(place), "{text}");
        }
        place.succeed([&file, "--set", "model.hertz={}"]);
        place.succeed(["check", &file]);
        // A bare # precedes a key, `# ` precedes text.
        let is_offer =
            |line: &str| line.starts_with('#') && !line.starts_with("# ") && line.len() > 1;
        let offers: Vec<&str> = text
            .split("\n\n")
            .filter(|block| {
                block.lines().next().is_some_and(is_offer) && !block.contains(":schema")
            })
            .collect();
        let expected = match material {
            "soda-lime-glass" => 4,
            // Gravity on a wall, and a flow rule beside its yield strength.
            "pmma" => 6,
            // Gravity; it has a relaxation.
            _ => 4,
        };
        assert_eq!(offers.len(), expected, "{offers:?}");
        for offer in offers {
            assert!(offer.lines().all(is_offer), "{offer}");
            let in_force: Vec<&str> = offer.lines().map(|line| &line[1..]).collect();
            place.write("offered.toml", &text.replace(offer, &in_force.join("\n")));
            place.fails(0, "check offered.toml");
        }
    }
    let schema = place.json("fem-run.schema.json");
    assert_eq!(schema["properties"]["body"]["minItems"], 2);
    let printed = place.succeed("schema").stdout;
    assert_eq!(printed.as_bytes(), place.read("fem-run.schema.json"));
}

/// The options of `new` are in the file, which is checked as a case.
#[test]
fn new_case_has_what_the_options_say() {
    let place = Place::new();
    place.succeed(
        "new drop --material Plexiglas --diameter '9.5 ± 0.1 mm' --drop-height '50 cm' --partner plate \
         --partner-material lib:Delrin",
    );
    let text = place.text("drop.toml");
    for line in [
        "sphere = { diameter = \"9.5 ± 0.1 mm\" }\nmaterial = \"pmma\"\n\n[start]\ngap = \"50 cm\"",
        "\n[gravity]",
        "\nacceleration = \"9.81 m/s^2\"\n#[stop]",
        "material = \"pom\"\n",
        "\n[material.pom]\n",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
    assert!(!text.contains("approach_speed"), "{text}");
    place.succeed("check drop.toml");
    place.succeed("new fast --speed 3 --partner-material glass");
    let text = place.text("fast.toml");
    assert!(text.contains("\napproach_speed = 3 ") && text.contains("[material.glass]"), "{text}");
    for (options, expected) in [
        ("--drop-height '1 m'", "needs a support|--partner wall"),
        ("--partner wall --partner-material pom", "a wall is rigid"),
        ("--partner wall --drop-height '1 m' --speed '1 m/s'", "cannot be used with"),
        ("--diameter '0 mm'", "diameter must be greater than 0"),
        ("--diameter '1 kg'", "1 kg"),
        ("--diameter 9.5", "9.5 mm"),
        ("--partner-material unobtainium", "the library has no material"),
    ] {
        place.fails(2, &format!("new none {options}")).tells(expected);
    }
    assert!(!place.list(".").contains(&"none.toml".to_string()));
}

#[test]
fn new_case_overwrites_no_file() {
    let place = Place::new();
    place.fails(2, "new case").tells("case.toml exists");
    assert_eq!(place.list("."), ["case.toml"]);
    place.write("fem-run.schema.json", "{}");
    place.succeed("new other --quiet");
    assert_eq!(place.read("fem-run.schema.json"), b"{}");
    assert_eq!(place.run("new none/ball").code, Some(2));
    assert_eq!(place.run("new ball --material stee").code, Some(2));
    assert_eq!(place.list("."), ["case.toml", "fem-run.schema.json", "other.toml"]);
}

/// The schema has the keys that the reader lists for an unknown key.
#[test]
fn schema_has_the_keys_of_the_reader() {
    let place = Place::new();
    let read = |of: &str| -> serde_json::Value {
        serde_json::from_str(&place.succeed(["schema", of]).stdout).unwrap()
    };
    let keys = |schema: &serde_json::Value| -> Vec<String> {
        schema["properties"].as_object().unwrap().keys().cloned().collect()
    };
    let told = |stderr: &str| -> Vec<String> {
        let (_, list) = stderr.split_once("the keys here are ").unwrap();
        list.split(", ").map(|key| key.split_whitespace().collect()).collect()
    };
    let schema = read("case");
    for (at, keys) in [
        ("nothing=1", keys(&schema)),
        ("body.0.nothing=1", keys(&schema["definitions"]["BodyTable"])),
        ("material.glass.nothing=1", keys(&schema["definitions"]["MaterialTable"])),
        ("model.law.tsuji.nothing=1", keys(&schema["definitions"]["TsujiTable"])),
    ] {
        assert_eq!(told(&place.run(["check", "case.toml", "--set", at]).stderr), keys, "{at}");
    }
    place.write("sweep.toml", "nothing = 1\ncase = 'case.toml'\nvary = { title = ['a'] }\n");
    assert_eq!(told(&place.run("sweep sweep.toml").stderr), keys(&read("sweep")));
}

#[test]
fn manual_pages_are_of_the_command_and_its_commands() {
    let place = Place::new();
    let whole = place.succeed("man").stdout;
    assert!(whole.contains(".TH fem-run 1") && whole.contains("fem\\-run\\-check"), "{whole}");
    let one = place.succeed("man check").stdout;
    assert!(one.contains("Check a case and print it"), "{one}");
    assert_eq!(place.run("man chek").code, Some(2));
}
