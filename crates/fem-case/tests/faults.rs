//! Every fault of a case file: where it is found, what is said, what help is given.

use std::path::Path;

use fem_case::{Case, CaseError};

const VALID: &str = r#"title = "a pair"

[material.glass]
density = "2390 kg/m^3"
youngs_modulus = "63 GPa"
poissons_ratio = 0.244

[material.glass.relaxation]
acts_on = "all"
terms = [{ weight = 0.5, decay_rate = "2708 1/s" }, { weight = 0.25, relaxation_time = 1e-3 }]

[[body]]
name = "striker"
sphere = { diameter = "22.2 mm" }
material = "glass"
approach_speed = "0.5 m/s"

[[body]]
name = "target"
sphere = { diameter = "15.9 mm" }
material = "glass"

[start]
gap = "1 um"

[mesh]
contact_element_size = "14 um"
refined_radius = "0.3 mm"
growth = 1.1

[contact]
penalty_factor = 1.0

[time]
step_factor = 0.9
mass_scaling = 2e-4

[output]
snapshots = ["mid-compression", "maximum"]

[model]
fem = {}

[effects]
finite_strain = "auto"
bulk_viscosity = "off"

[limits]
elements = 200000
element_updates = 1e12
memory = "8 GB"
"#;

fn parse(text: &str) -> Result<Case, CaseError> {
    Case::parse("pair.toml", text, Path::new("."), &[])
}

/// The error of `marked`, in which «» enclose the text that must be underlined.
#[track_caller]
fn error_at_mark(marked: &str) -> CaseError {
    let (before, rest) = marked.split_once('«').expect("a mark");
    let (culprit, after) = rest.split_once('»').expect("the mark's end");
    let text = format!("{before}{culprit}{after}");
    let error = parse(&text).expect_err("a fault");
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap().chars().count() + 1;
    assert_eq!((error.line(), error.column()), (Some(line), Some(column)), "{error}");
    assert_eq!(&text[error.span().unwrap()], culprit, "{error}");
    assert_eq!(error.source_name(), "pair.toml");
    assert_eq!(error.source_text(), Some(text.as_str()));
    error
}

/// The valid case with one part replaced has this fault: `message` and `help` in its text.
#[track_caller]
fn fault(part: &str, replacement: &str, message: &str, help: &str) {
    assert!(VALID.contains(part), "{part}");
    let error = error_at_mark(&VALID.replacen(part, replacement, 1));
    assert!(error.message().contains(message), "{error}");
    assert!(error.help().unwrap_or("").contains(help), "{error}");
}

#[test]
fn the_valid_case_is_valid() {
    parse(VALID).unwrap();
}

#[test]
fn not_toml() {
    fault("\"22.2 mm\"", "«22.2 mm»", "must be quoted", "in quotes");
    fault("[start]", "[start«»", "", "TOML");
    fault("gap = ", "gap «»", "", "TOML");
    fault("\"a pair\"", "\"a pair«»", "", "TOML");
    fault("gap = \"1 um\"", "gap = «»", "", "TOML");
}

#[test]
fn duplicated_keys() {
    fault("growth = 1.1", "growth = 1.1\n«growth» = 1.1", "duplicate key", "");
    fault("[contact]", "[«mesh»]", "duplicate key", "");
}

#[test]
fn unknown_keys() {
    fault(
        "density",
        "«densty»",
        "unknown key `densty` in material.glass",
        "did you mean `density`?",
    );
    fault("density", "«densty»", "", "youngs_modulus, shear_modulus");
    fault("title", "«titel»", "unknown key `titel`", "did you mean `title`?");
    fault("diameter", "«radius»", "unknown key `radius` in body.0.sphere", "diameter, mesh");
    fault("[start]", "[«gravity»]", "unknown key `gravity`", "material, body");
    fault("fem = {}", "fem = { «fast» = 1 }", "unknown key `fast` in model.fem", "{}");
    fault(
        "fem = {}",
        "«\"fem`, expected `\"» = 1",
        "unknown key `fem`, expected `` in model",
        "fem",
    );
    fault("weight = 0.5", "«wait» = 0.5", "in material.glass.relaxation.terms.0", "weight");
    fault("finite_strain", "«friction»", "unknown key `friction` in effects", "mirror_symmetry");
}

#[test]
fn missing_keys() {
    fault(
        "[material.glass]\ndensity = \"2390 kg/m^3\"",
        "«[material.glass]»",
        "the key `density` is missing in material.glass",
        "density = \"2390 kg/m^3\"",
    );
    fault(
        "{ diameter = \"22.2 mm\" }",
        "«{ }»",
        "the key `diameter` is missing in body.0.sphere",
        "diameter = \"22.2 mm\"",
    );
    fault(
        "[[body]]\nname = \"target\"",
        "«[[body]]»",
        "the key `name` is missing in body.1",
        "name = \"striker\"",
    );
    fault(
        "[[body]]\nname = \"target\"\nsphere = { diameter = \"15.9 mm\" }\nmaterial = \"glass\"",
        "«[[body]]»\nname = \"target\"\nsphere = { diameter = \"15.9 mm\" }",
        "the key `material` is missing in body.1",
        "the case has glass",
    );
    fault(
        "{ weight = 0.5, decay_rate = \"2708 1/s\" }",
        "«{ decay_rate = 1 }»",
        "the key `weight` is missing in material.glass.relaxation.terms.0",
        "weight = 1.0",
    );
}

#[test]
fn wrong_types() {
    fault(
        "\"22.2 mm\" }\nm",
        "«true» }\nm",
        "body.0.sphere.diameter is a boolean `true`",
        "a length",
    );
    fault("0.244", "«[0.244]»", "material.glass.poissons_ratio is an array", "a plain number");
    fault("\"striker\"", "«3»", "body.0.name is an integer `3`", "a string");
    fault("\"all\"", "«{ all = {} }»", "acts_on is a table", "one of the words \"all\", \"shear\"");
    fault("{ diameter = \"22.2 mm\" }", "«\"22.2 mm\"»", "body.0.sphere is a string", "diameter =");
    fault("{ diameter = \"22.2 mm\" }", "«[\"22.2 mm\"]»", "body.0.sphere is an array", "a table");
    fault("fem = {}", "fem = «[]»", "model.fem is an array", "a table");
    fault("fem = {}", "fem = «true»", "model.fem is a boolean", "an empty table");
    fault("title = \"a pair\"", "title = «2024-01-01»", "title is a date or time", "a string");
    fault("[\"mid-compression\", \"maximum\"]", "«\"maximum\"»", "snapshots is a string", "a list");
}

#[test]
fn wrong_words() {
    fault("\"all\"", "«\"sheer\"»", "acts_on is \"sheer\"", "did you mean `shear`?");
    fault("\"off\"", "«\"no\"»", "bulk_viscosity is \"no\"", "\"auto\", \"on\", \"off\"");
}

#[test]
fn wrong_units() {
    fault(
        "\"22.2 mm\"",
        "«\"22.2 kg\"»",
        "\"22.2 kg\" is a mass; diameter wants a length, such as \"22.2 mm\"",
        "or a bare number in m",
    );
    fault("\"63 GPa\"", "«\"63 Gpa\"»", "unknown unit `Gpa`", "did you mean `GPa`?");
    fault("\"63 GPa\"", "«\"63 GN\"»", "is a force; youngs_modulus wants a pressure", "");
    fault("\"2708 1/s\"", "«\"2708 s\"»", "is a time; decay_rate wants a rate", "\"2708 1/s\"");
    fault("1e-3", "«\"1e3 1/s\"»", "is a rate; relaxation_time wants a time", "");
    fault(
        "\"0.5 m/s\"",
        "«\"0.5\"»",
        "has no unit; approach_speed wants a speed",
        "a bare number in m/s",
    );
    fault("\"0.5 m/s\"", "«\"0,5 m/s\"»", "decimal comma", "");
    fault("\"0.5 m/s\"", "«\"fast\"»", "does not begin with a number", "\"0.5 m/s\"");
    fault("0.244", "«\"0.244 m\"»", "is a length; poissons_ratio wants a plain number", "");
    fault("\"8 GB\"", "«\"8 kg\"»", "is a mass; memory wants an amount of memory", "\"8 GB\"");
}

#[test]
fn not_finite() {
    for (part, replacement) in [
        ("\"22.2 mm\"", "«nan»"),
        ("\"22.2 mm\"", "«inf»"),
        ("\"22.2 mm\"", "«-inf»"),
        ("0.244", "«nan»"),
        ("weight = 0.5", "weight = «nan»"),
        ("1e-3", "«inf»"),
        ("\"0.5 m/s\"", "«+nan»"),
        ("\"1 um\"", "«nan»"),
        ("1.1", "«inf»"),
        ("0.9", "«nan»"),
        ("2e-4", "«nan»"),
        ("200000", "«inf»"),
        ("[\"mid-compression\", \"maximum\"]", "«nan»"),
        ("[\"mid-compression\", \"maximum\"]", "[«nan»]"),
    ] {
        fault(part, replacement, "not finite", "");
    }
    fault("\"22.2 mm\"", "«\"nan mm\"»", "does not begin with a number", "");
    fault("\"22.2 mm\"", "«\"inf mm\"»", "does not begin with a number", "");
    fault("\"22.2 mm\"", "«\"1e400 mm\"»", "out of the range", "");
    fault("\"22.2 mm\"", "«1e400»", "overflow", "");
}

#[test]
fn out_of_range() {
    for (part, bad, message) in [
        ("\"22.2 mm\"", "«0»", "diameter is 0.0 m"),
        ("\"22.2 mm\"", "«\"-1 mm\"»", "diameter is \"-1 mm\""),
        ("\"2390 kg/m^3\"", "«0»", "density must be positive"),
        ("\"2390 kg/m^3\"", "«-2390»", "density must be positive"),
        ("\"63 GPa\"", "«0»", "youngs_modulus must be positive"),
        ("\"63 GPa\"", "«\"-63 GPa\"»", "youngs_modulus must be positive"),
        ("0.244", "«0.5»", "poissons_ratio must lie"),
        ("0.244", "«-1»", "poissons_ratio must lie"),
        ("0.244", "«24.4»", "poissons_ratio must lie"),
        ("\"2708 1/s\"", "«0»", "decay_rate is 0.0 1/s"),
        ("\"2708 1/s\"", "«\"-1 1/s\"»", "decay_rate is \"-1 1/s\""),
        ("1e-3", "«0»", "relaxation_time is 0.0 s"),
        ("1e-3", "«\"-1 ms\"»", "relaxation_time is \"-1 ms\""),
        ("weight = 0.5", "weight = «-0.5»", "relaxation term 0: weight"),
        ("\"1 um\"", "«-1e-6»", "gap is"),
        ("\"14 um\"", "«0»", "contact_element_size is 0.0 m"),
        ("\"0.3 mm\"", "«0»", "refined_radius is"),
        ("1.1", "«1»", "growth is 1.0"),
        ("penalty_factor = 1.0", "penalty_factor = «0»", "penalty_factor is 0.0"),
        ("0.9", "«0»", "step_factor is"),
        ("0.9", "«1.01»", "step_factor is"),
        ("2e-4", "«-1e-9»", "mass_scaling is"),
        ("2e-4", "«0.11»", "mass_scaling is"),
        ("200000", "«0»", "elements is"),
        ("200000", "«1.5»", "elements is"),
        ("1e12", "«1e30»", "element_updates is"),
        ("\"8 GB\"", "«0»", "memory is 0.0 bytes"),
    ] {
        fault(part, bad, message, "");
    }
    fault("\"22.2 mm\"", "«0»", "", "diameter must be greater than 0");
}

#[test]
fn moduli() {
    fault(
        "poissons_ratio = 0.244",
        "shear_modulus = 1e9\npoissons_ratio = «0.244»",
        "exactly two of youngs_modulus, shear_modulus, bulk_modulus, poissons_ratio",
        "",
    );
    fault(
        "[material.glass]\ndensity = \"2390 kg/m^3\"\nyoungs_modulus = \"63 GPa\"",
        "«[material.glass]»\ndensity = \"2390 kg/m^3\"",
        "exactly two",
        "",
    );
    fault("poissons_ratio = 0.244", "shear_modulus = «1e9»", "implies poissons_ratio", "");
    fault("poissons_ratio = 0.244", "bulk_modulus = «1e9»", "implies poissons_ratio", "");
}

#[test]
fn relaxation() {
    fault("decay_rate", "relaxation_time = «1», decay_rate", "both decay_rate and", "keep one");
    fault(
        "{ weight = 0.5, decay_rate = \"2708 1/s\" }",
        "«{ weight = 0.5 }»",
        "neither decay_rate nor",
        "decay_rate = \"2708 1/s\"",
    );
    fault(
        "[{ weight = 0.5, decay_rate = \"2708 1/s\" }, { weight = 0.25, relaxation_time = 1e-3 }]",
        "«[]»",
        "at least one term",
        "",
    );
    fault(
        "[{ weight = 0.5, decay_rate = \"2708 1/s\" }, { weight = 0.25, relaxation_time = 1e-3 }]",
        "«[{ weight = 0.8, decay_rate = 1 }, { weight = 0.3, decay_rate = 2 }]»",
        "at most 1",
        "",
    );
    fault("\"2708 1/s\"", "«1e-320»", "relaxation_time must be positive and finite", "");
}

#[test]
fn bodies() {
    let two = "[[body]]\nname = \"striker\"\nsphere = { diameter = 1 }\nmaterial = \"glass\"\n\
               approach_speed = 1\n[[body]]\nname = \"target\"\nwall = {}\n";
    let glass = "[material.glass]\ndensity = 1\nyoungs_modulus = 1\npoissons_ratio = 0\n";
    parse(&format!("{glass}{two}")).unwrap();
    let is = |text: String, message: &str| {
        let error = error_at_mark(&text);
        assert!(error.message().contains(message), "{error}");
    };
    is(format!("«»{glass}"), "no [[body]]");
    is("«»".to_string(), "no [[body]]");
    is(
        format!(
            "{glass}{}",
            two.replacen("[[body]]", "«[[body]]»", 1)
                .split("[[body]]\nname = \"target")
                .next()
                .unwrap()
        ),
        "only one [[body]]",
    );
    is(format!("{glass}{two}«[[body]]»\nname = \"c\"\nwall = {{}}\n"), "the case has 3 [[body]]");
    is(format!("{glass}{}", two.replace("speed = 1", "speed = «0»")), "receding or at rest");
    is(format!("{glass}{}", two.replace("speed = 1", "speed = «-1»")), "receding or at rest");
    is(
        format!(
            "{glass}{}",
            two.replace("[[body]]\nname = \"target", "«[[body]]»\nname = \"target")
                .replace("approach_speed = 1\n", "")
        ),
        "receding or at rest",
    );
    is(
        format!(
            "{glass}{}",
            two.replace(
                "wall = {}",
                "sphere.diameter = 1\nmaterial = 'glass'\napproach_speed = «-1.0»"
            )
        ),
        "add up to 0.0",
    );
    is(
        format!("{glass}{}", two.replace("wall = {}", "wall = {}\napproach_speed = «-0.5»")),
        "approach_speed is",
    );
    is(
        format!("{glass}{}", two.replace("wall = {}", "wall = {}\nmaterial = «'glass'»")),
        "no material",
    );
    is(
        "[[body]]\nname = 'a'\nwall = {}\n[[body]]\nname = 'b'\nwall = «{}»".to_string(),
        "both bodies are walls",
    );
    is(
        format!("{glass}{}", two.replace("wall = {}", "wall = «{}»\nsphere.diameter = 1")),
        "both sphere and wall",
    );
    is(
        format!(
            "{glass}{}",
            two.replace("[[body]]\nname = \"target\"\nwall = {}", "«[[body]]»\nname = \"target\"")
        ),
        "neither sphere nor wall",
    );
    is(
        format!("{glass}{}", two.replace("\"target\"", "«\"striker\"»")),
        "both bodies have the name",
    );
    is(format!("{glass}{}", two.replace("\"target\"", "«\"the target\"»")), "not a body's name");
    is(format!("{glass}{}", two.replace("\"target\"", "«\"\"»")), "not a body's name");
    is(format!("{glass}{}", two.replace("\"target\"", "«'Kügel'»")), "not a body's name");
    is(two.replace("\"glass\"", "«\"glass\"»"), "no material \"glass\"");
    is(
        format!("{glass}{}", two.replace("diameter = 1", "diameter = 1, mesh = «''»")),
        "mesh is an empty path",
    );
    // A moving wall, and a body that recedes more slowly than the other follows, are fine.
    parse(&format!(
        "{glass}{}",
        two.replace("wall = {}", "wall = {}\napproach_speed = 2")
            .replace("speed = 1", "speed = -1")
    ))
    .unwrap();
}

#[test]
fn materials() {
    fault(
        "material = \"glass\"",
        "material = «\"glas\"»",
        "no material \"glas\"",
        "did you mean `glass`? the case has glass",
    );
    let unused =
        "[material.\"ice (unused)\"]\ndensity = 1\nyoungs_modulus = 1\npoissons_ratio = 0\n";
    parse(&format!("{VALID}{unused}")).unwrap();
    let error = error_at_mark(&format!("{VALID}{}", unused.replace("= 0", "= «0.6»")));
    assert!(error.message().contains("poissons_ratio"), "{error}");
}

#[test]
fn snapshots() {
    let list = "[\"mid-compression\", \"maximum\"]";
    fault(list, "[\"maximum\", «\"maximun\"»]", "no label", "did you mean `maximum`?");
    fault(list, "[\"maximum\", «\"maximum\"»]", "twice", "");
    fault(list, "[\"maximum\", «1e-6»]", "mixes", "");
    fault(list, "[\"1 us\", «\"maximum\"»]", "mixes", "");
    fault(list, "[«\"1 um\"»]", "is a length; snapshots wants a time", "");
    fault(list, "[«-1e-6»]", "snapshots is -1e-6 s", "");
    fault(list, "[«[]»]", "snapshots.0 is an array", "");
    fault(list, "«0»", "snapshots is 0", "a whole number");
    fault(list, "«1.5»", "snapshots is 1.5", "a whole number");
}

#[test]
fn models() {
    fault(
        "fem = {}",
        "auto = «{}»",
        "model `auto` is not available in this version",
        "fem, condensed, ting, hertz and law",
    );
    fault("fem = {}", "fem = {}\nting = «{}»", "the keys fem and ting", "exactly one");
    fault("[model]\nfem = {}", "«[model]»", "names no model", "fem = {}");
}

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
