//! What is no TOML, or no key or type of a case.

use super::marked::fault;

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
    fault("[start]", "[«weather»]", "unknown key `weather`", "material, body");
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
