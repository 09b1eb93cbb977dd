//! Translates serde's errors into the terms of a case file.

use std::ops::Range;

use toml::de::Error;

use crate::error::CaseError;
use crate::schema::model_tables::choice_at;
use crate::schema::{CaseFile, HardeningTable};
use crate::source::document::Document;
use crate::source::nearest;
use crate::source::toml_syntax::{first_line, join, quote_key};
use crate::sweep::values::split_unit;

/// Examples of required keys.
const EXAMPLES: &[(&str, &str)] = &[
    ("name", "name = \"striker\""),
    ("diameter", "diameter = \"22.2 mm\""),
    ("density", "density = \"2390 kg/m^3\""),
    ("weight", "weight = 1.0"),
    ("acceleration", "acceleration = \"9.81 m/s^2\""),
    ("strain", "strain = 0.002"),
    ("exponent", "exponent = 0.2"),
    ("johnson_cook", "johnson_cook = { c = 0.014, reference_rate = \"1 1/s\" }"),
    ("c", "c = 0.014"),
    ("reference_rate", "reference_rate = \"1 1/s\""),
    ("terms", "terms = [{ weight = 1.0, decay_rate = \"2708 1/s\" }]"),
    (
        "acts_on",
        "acts_on = \"all\" (constant Poisson's ratio) or acts_on = \"shear\" (the bulk modulus \
         stays elastic)",
    ),
];

/// The tables and keys of a case outside of all tables.
const KEYS_OF_CASE: [&str; 15] = [
    "title", "scene", "material", "body", "start", "gravity", "stop", "mesh", "contact", "time",
    "output", "model", "accuracy", "effects", "limits",
];

/// Tables of bodies and materials: the path, and the TOML before one of their keys.
const INNER_TABLES: [(&str, &str); 6] = [
    ("body.0", "[[body]]\n"),
    ("body.0.sphere", "[[body]]\nsphere."),
    ("body.0.plate", "[[body]]\nplate."),
    ("material.NAME", "material.m."),
    ("material.NAME.flow", "material.m.flow."),
    ("material.NAME.relaxation", "material.m.relaxation."),
];

/// Returns the paths at which a case gives a key that it has at `path` by mistake, or else the table to which the key belongs.
fn elsewhere(document: &Document, path: &str, key: &str) -> Vec<String> {
    let ending = format!(".{}", quote_key(key));
    let given = |table: &str| -> Vec<String> {
        let below = join(path, "");
        let is_other = |it: &&str| it.starts_with(table) && *it != path && !it.starts_with(&below);
        let all = document.paths().filter(|it| it.ends_with(&ending)).filter(is_other);
        all.take(2).map(str::to_string).collect()
    };
    let own = path.rfind('.').map_or_else(Vec::new, |dot| given(&path[..=dot]));
    let given = if own.is_empty() { given("") } else { own };
    if !given.is_empty() || !document.has("body") {
        return given;
    }
    // The type of the value is wrong for any key that the table has.
    let has_key = |before: &str| {
        let read: Result<CaseFile, _> = toml::from_str(&format!("{before}{} = []", &ending[1..]));
        read.err().is_none_or(|error| {
            let message = error.message();
            !message.starts_with("unknown ") && !message.starts_with("invalid type: map")
        })
    };
    let outer = KEYS_OF_CASE.map(|table| (table, format!("{table}.")));
    let outer = outer.iter().filter(|(table, _)| !["material", "body"].contains(table));
    let outer = outer.map(|(table, before)| (*table, before.as_str()));
    let found = INNER_TABLES.into_iter().chain(outer).find(|(_, before)| has_key(before));
    let name = |table: &str| {
        let names = ["body.0.material", "body.1.material"].map(|key| document.value_text(key));
        let name = names.into_iter().find(|name| !name.is_empty()).unwrap_or("NAME");
        table.replace("NAME", &quote_key(name.trim_matches(['"', '\''])))
    };
    found.map(|(table, _)| join(&name(table), &ending[1..])).into_iter().collect()
}

/// Returns what a key means that this table does not have, but which many write: `table` is its path, `value` its text.
fn hint(table: &str, key: &str, value: &str) -> Option<String> {
    let (first, inner) = table.split_once('.').unwrap_or((table, ""));
    match key {
        "radius" if first == "body" && inner.ends_with(".sphere") => {
            let (number, unit) = split_unit(value.trim_matches(['"', '\'']));
            let twice = match (number.is_finite(), unit) {
                (false, _) => "\"20 mm\"".to_string(),
                (true, "") => format!("{:?}", 2.0 * number),
                (true, unit) => format!("\"{} {unit}\"", 2.0 * number),
            };
            Some(format!("a sphere has a diameter, which is twice the radius: diameter = {twice}"))
        }
        "velocity" | "speed" | "initial_velocity" | "impact_speed" | "v" if first == "body" => {
            let number = split_unit(value.trim_matches(['"', '\''])).0;
            let sign = match number < 0.0 {
                true => ", which is positive towards the other body",
                false => "",
            };
            let value = value.trim_start_matches(['-']).replacen("\"-", "\"", 1);
            Some(format!("a body has an approach speed{sign}: approach_speed = {value}"))
        }
        "damping" | "viscosity" | "loss_factor" if first != "model" => Some(
            "losses come from [material.NAME.relaxation], from [material.NAME] yield_strength or from a law in [model]"
                .into(),
        ),
        "E" | "e_modulus" | "elastic_modulus" | "modulus" | "stiffness" if first == "material" => {
            Some(format!("the key is youngs_modulus = {value}"))
        }
        "nu" | "ν" if first == "material" => Some(format!("the key is poissons_ratio = {value}")),
        "rho" | "ρ" if first == "material" => Some(format!("the key is density = {value}")),
        _ => not_computed(first, inner, key, value).map(str::to_string).or_else(|| {
            let is_of_case = KEYS_OF_CASE.contains(&first) && KEYS_OF_CASE.contains(&key);
            is_of_case.then(|| {
                format!(
                    "`{key}` belongs to the case, and this line is in the table {table}: write it above the first \
                     [table] of the file, or as a table [{key}] of its own"
                )
            })
        }),
    }
}

/// Returns why there is no such key, and what comes nearest to it. `first` and `inner` are the parts of the table's path.
fn not_computed(first: &str, inner: &str, key: &str, value: &str) -> Option<&'static str> {
    let value = value.trim_matches(['"', '\'']);
    Some(match key {
        "friction" | "friction_coefficient" | "coefficient_of_friction" | "mu" => {
            "the coefficient of friction is that of the pair: write [contact] friction = 0.1"
        }
        "rolling_friction" | "rolling_resistance" => {
            "rolling resistance is not computed, since a collision is over before a ball has rolled: remove the key"
        }
        "rotation" | "angular_velocity" | "omega" | "spin" => {
            "the key of a [[body]] is spin = \"10 rad/s\", right-handed about x × y"
        }
        "angle" | "incidence" | "angle_of_incidence" if first == "body" => {
            "the key is impact_angle = \"30 deg\", of the velocity against the axis"
        }
        "restitution" | "coefficient_of_restitution" | "cor" | "e"
            if ["", "body", "contact", "material", "model"].contains(&first) =>
        {
            "the restitution is a result, not an input: give the material a relaxation or a yield strength, or a law \
             in [model] whose damping fem-run invert finds for a restitution"
        }
        "mass" if ["body", "material"].contains(&first) => {
            "the mass follows from the diameter and the density of the material: remove the key; a striker that is \
             heavier than its tip: sphere = { diameter = \"10 mm\", mass = \"100 g\" }"
        }
        "thickness" | "wall_thickness" | "shell_thickness" | "inner_diameter" | "inner_radius"
        | "hollow"
            if first == "body" && !inner.ends_with(".plate") =>
        {
            "hollow balls are not computed; nearest: a solid one of the mean density, with measured numbers in the law \
             of [model], such as law = { linear = { k = \"20 kN/m\", e = 0.9 } }"
        }
        "support" if ["clamped", "fixed", "simply_supported", "hinged"].contains(&value) => {
            "the edge of a plate is free, no other one is computed; nearest: a plate without diameter and support, \
             which is right as long as no wave returns from the edge"
        }
        "gravity" if first == "effects" => "the table [gravity] switches gravity on",
        _ => return None,
    })
}

/// Translates an error of deserializing the tree of `document`.
pub(crate) fn explain(document: &Document, error: &Error) -> CaseError {
    let message = error.message();
    let span = error.span().unwrap_or(0..0);
    let path = document.path_of(&span).unwrap_or("");
    let fault = Fault { document, span, path };
    let expected = |start: &str| message.strip_prefix(start)?.rsplit_once(", expected ");
    if let Some(rest) = message.strip_prefix("unknown field ") {
        fault.unknown_key(rest)
    } else if let Some(rest) = message.strip_prefix("missing field ") {
        fault.missing_key(rest.trim_matches('`'))
    } else if let Some(rest) = message.strip_prefix("unknown variant ") {
        let (found, allowed) = split_backticked(rest);
        let quoted: Vec<_> = allowed.iter().map(|word| format!("\"{word}\"")).collect();
        let words = || format!("{}write one of {}", near(found, &allowed), quoted.join(", "));
        let (table, key) = path.rsplit_once('.').unwrap_or(("", path));
        let help = hint(table, key, document.text_on(&fault.span)).unwrap_or_else(words);
        fault.error(format!("{path} is \"{found}\", which is not allowed")).with_help(help)
    } else if let Some((found, wanted)) = expected("invalid type: ") {
        fault.wrong_type(found, wanted)
    } else if let Some((_, wanted)) = expected("invalid length ") {
        // serde reads an array as a struct's fields in order and reports their number.
        fault.error(format!("{} is an array", name(path))).with_help(format!("write {wanted}"))
    } else {
        fault.error(first_line(message))
    }
}

/// The place of one of serde's errors.
struct Fault<'d> {
    document: &'d Document,
    span: Range<usize>,
    /// The key, or that of the table; empty for the whole text.
    path: &'d str,
}

impl Fault<'_> {
    fn error(&self, message: String) -> CaseError {
        let error = self.document.error_on(self.span.clone(), message);
        if self.path.is_empty() { error } else { error.about(self.path) }
    }

    fn unknown_key(&self, rest: &str) -> CaseError {
        let (found, mut allowed) = split_backticked(rest);
        let table = self.path.rfind('.').map_or("", |dot| &self.path[..dot]);
        // A name of hardening stands for a table without keys, which nobody writes.
        if table.ends_with(".flow.hardening") {
            allowed.retain(|key| !HardeningTable::NAMES.contains(key));
        }
        let keys = || {
            let near = near(found, &allowed);
            let meant = match found {
                "velocity" | "speed" | "initial_velocity" | "impact_speed" => "approach_speed",
                _ => found,
            };
            let near = match elsewhere(self.document, self.path, meant).join("` or `") {
                other if near.is_empty() && !other.is_empty() => {
                    format!("did you mean `{other}`? ")
                }
                _ => near,
            };
            format!("{near}the keys here are {}", allowed.join(", "))
        };
        let help = match (table, found) {
            _ if allowed.is_empty() => "it has no keys: write {}".to_string(),
            ("", _) if allowed.contains(&"vary") && self.document.has("body") => {
                "a file with bodies is a case: fem-run FILE; a sweep names it, case = \"FILE\""
                    .to_string()
            }
            _ => hint(table, found, self.document.value_text(self.path)).unwrap_or_else(keys),
        };
        self.error(format!("unknown key `{found}`{}", in_table(table)))
            .labelled("unknown key")
            .with_help(help)
    }

    fn missing_key(&self, missing: &str) -> CaseError {
        let message = format!("the key `{missing}` is missing{}", in_table(self.path));
        let error = self.error(message).lacking(missing);
        let example = EXAMPLES.iter().find(|(key, _)| *key == missing);
        let material = self.path.strip_prefix("material.").filter(|_| missing == "density");
        let own = material.and_then(|name| unused_material(self.document, name));
        match (own, example) {
            (Some(help), _) => error.with_help(help),
            (None, Some((_, line))) => error.with_help(format!("write {line}")),
            (None, None) => error,
        }
    }

    fn wrong_type(&self, found: &str, wanted: &str) -> CaseError {
        let choice = choice_at(&self.path.split('.').collect::<Vec<_>>());
        let names = choice.map(|choice| choice.names);
        if let (Some(names), Some(word)) = (names, found.strip_prefix("string ")) {
            let word = word.trim_matches('"');
            let key = self.path.rsplit('.').next().unwrap_or(self.path);
            let near = near(word, names);
            let help = match wanted.starts_with('"') {
                true => format!("{near}write {wanted}"),
                false => format!("{near}write one of {}, or {wanted}", names.join(", ")),
            };
            return self.error(format!("unknown {key} \"{word}\"")).with_help(help);
        }
        // serde treats a date as a table.
        let text = self.document.text_on(&self.span);
        let found = match found == "map" && text.starts_with(|c: char| c.is_ascii_digit()) {
            true => "a date or time".to_string(),
            false => with_article(found),
        };
        let wanted = match self.path {
            "body" => "two [[body]] tables".to_string(),
            _ => with_article(wanted),
        };
        self.error(format!("{} is {found}", name(self.path))).with_help(format!("write {wanted}"))
    }
}

fn in_table(path: &str) -> String {
    if path.is_empty() { String::new() } else { format!(" in {path}") }
}

/// Returns that no body is of a material, and of which they are; `None` if one is.
fn unused_material(document: &Document, name: &str) -> Option<String> {
    let bodies = ["body.0.material", "body.1.material"].map(|key| document.value_text(key));
    let mut names: Vec<&str> = bodies.iter().map(|text| text.trim_matches(['"', '\''])).collect();
    names.retain(|text| !text.is_empty());
    names.dedup();
    let is_used = names.is_empty() || names.contains(&name.trim_matches(['"', '\'']));
    let tables = names.iter().map(|name| format!("[material.{}]", quote_key(name)));
    let tables = tables.collect::<Vec<_>>().join(" or ");
    (!is_used).then(|| {
        let names = names.join(" and ");
        format!("no body is of this material: they are of {names}, whose keys are in {tables}")
    })
}

/// Returns `did you mean …? ` if one of the allowed words is similar.
pub(crate) fn near<S: AsRef<str>>(found: &str, allowed: &[S]) -> String {
    // 0.8 accepts `densty`, `diametre` and `youngs_modul`, but not `radius` for `name`.
    nearest(found, allowed, 0.8).map_or(String::new(), |word| format!("did you mean `{word}`? "))
}

fn name(path: &str) -> &str {
    if path.is_empty() { "the case" } else { path }
}

/// Translates serde's name of a type into TOML's, with an article.
fn with_article(what: &str) -> String {
    match what {
        "map" | "a map" => return "a table".to_string(),
        "sequence" | "a sequence" => return "an array".to_string(),
        _ => {}
    }
    let has_article = ["a ", "an ", "one ", "\""].iter().any(|article| what.starts_with(article));
    if has_article {
        return what.to_string();
    }
    let article = if what.starts_with(['a', 'e', 'i', 'o']) { "an" } else { "a" };
    format!("{article} {what}")
}

/// Splits serde's "`found`, expected one of `a`, `b`" or "`found`, there are no fields" into the word and the allowed
/// words.
fn split_backticked(text: &str) -> (&str, Vec<&str>) {
    let (found, rest) = text
        .rsplit_once("`, expected ")
        .or_else(|| text.rsplit_once("`, there are no "))
        .unwrap_or((text, ""));
    (found.strip_prefix('`').unwrap_or(found), rest.split('`').skip(1).step_by(2).collect())
}

/// Joins words: "a", "a and b", "a, b and c".
pub(crate) fn listed(words: &[&str]) -> String {
    match words {
        [] => String::new(),
        [one] => one.to_string(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}
