//! The overrides that change the scene, as they are appended to its title and to the name of its result folder.

use toml::Table;
use toml::de::DeValue;

use crate::schema::CaseFile;
use crate::source::overrides;

/// Tables of physical keys.
const PHYSICAL: [&str; 6] = ["material", "body", "start", "gravity", "stop", "scene"];
/// Physical keys in other tables.
const PHYSICAL_KEYS: [[&str; 2]; 2] = [["contact", "friction"], ["contact", "work_of_adhesion"]];
/// Longest value that is shown.
const MAX_VALUE_LENGTH: usize = 24;
/// Changes that a title names.
const MAX_IN_TITLE: usize = 5;
/// Longest name of a folder, without the digits that a taken one gets.
const MAX_NAME_LENGTH: usize = 100;

/// A key that an override gave another value, by a name that readers of the case understand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// The last part of the key, or that from `flow` on, after the name of the body or the material if several have it.
    pub key: String,
    /// The value with its unit: `1 m/s`.
    pub value: String,
}

/// Returns the changes of the scene by overrides, the last one of each key.
pub(crate) fn changes(file: &CaseFile, overrides: &[String]) -> Vec<Change> {
    let mut found: Vec<Change> = Vec::new();
    for text in overrides {
        // An override that has an error is not applied.
        let Ok(assignment) = overrides::parse(text, 0) else { continue };
        let path: Vec<&str> = assignment.path.iter().map(|part| part.get_ref().as_str()).collect();
        let is_physical =
            PHYSICAL.contains(&path[0]) || PHYSICAL_KEYS.iter().any(|key| path == key);
        // Another mesh file does not change the body.
        if !is_physical || path.last() == Some(&"mesh") {
            continue;
        }
        let raw = text.get(assignment.value.span()).unwrap_or_default();
        let value = match assignment.value.get_ref() {
            DeValue::String(words) => words.to_string(),
            DeValue::Float(_) | DeValue::Integer(_) => {
                let unit = file.number_at(path.iter().copied()).map_or("", |(_, unit)| unit);
                format!("{raw} {unit}").trim_end().to_string()
            }
            _ => raw.to_string(),
        };
        let is_short =
            value.chars().count() <= MAX_VALUE_LENGTH && !value.contains(char::is_control);
        let value = if is_short { value } else { "…".to_string() };
        let change = Change { key: key_of(file, &path), value };
        found.retain(|other| other.key != change.key);
        found.push(change);
    }
    found
}

/// Returns the last part of a key, with the name of its body or material if another one has the same key.
fn key_of(file: &CaseFile, path: &[&str]) -> String {
    // A material may have a yield strength beside its density, too.
    let last = match path {
        ["material", _, "flow", rest @ ..] if !rest.is_empty() => path[2..].join("."),
        ["body", _] => path.join("."),
        _ => path.last().copied().unwrap_or_default().to_string(),
    };
    let tree = Table::try_from(file).unwrap_or_default();
    let owner = match path {
        ["body", index, .., _] => {
            let other = if *index == "0" { "1" } else { "0" };
            let rest = [&["body", other][..], &path[2..]].concat();
            let body = index.parse().ok().and_then(|index: usize| file.body.get(index));
            body.filter(|_| has(&tree, &rest)).map(|body| body.name.as_str())
        }
        ["material", name, .., _] => Some(*name).filter(|_| file.material.len() > 1),
        _ => None,
    };
    owner.map_or(last.clone(), |owner| format!("{owner} {last}"))
}

/// Returns whether a tree has a value at a path.
fn has(tree: &Table, path: &[&str]) -> bool {
    let Some((first, rest)) = path.split_first() else { return true };
    let inside = |value: Option<&toml::Value>, part: &str| match value {
        Some(toml::Value::Table(table)) => table.get(part).cloned(),
        Some(toml::Value::Array(array)) => {
            part.parse().ok().and_then(|index: usize| array.get(index)).cloned()
        }
        _ => None,
    };
    rest.iter()
        .fold(tree.get(*first).cloned(), |value, part| inside(value.as_ref(), part))
        .is_some()
}

/// Returns a title with the changes appended, `…, but approach_speed = 1 m/s`, since the title may name the former value.
pub(crate) fn titled(title: &str, changes: &[Change]) -> String {
    let named = changes.iter().take(MAX_IN_TITLE);
    let named: Vec<String> =
        named.map(|Change { key, value }| format!("{key} = {value}")).collect();
    let title = match named.is_empty() {
        true => title.to_string(),
        false => format!("{title}, but {}", named.join(", ")),
    };
    match changes.len().saturating_sub(MAX_IN_TITLE) {
        0 => title,
        n => format!("{title} and {n} more"),
    }
}

/// Returns a name with the changes appended, fit for a folder on any system: `glass-approach_speed=1m_s`.
pub(crate) fn folder_name(stem: &str, changes: &[Change]) -> String {
    let mut name = stem.to_string();
    for Change { key, value } in changes {
        let key = readable_name(&key.replace(' ', "_"));
        let value = readable_name(&value.replace('…', ""));
        name += &if value.is_empty() { format!("-{key}") } else { format!("-{key}={value}") };
    }
    truncated(name, MAX_NAME_LENGTH.max(stem.len()))
}

/// Returns words as a part of a name of a file or folder that is valid on any system and of bounded length: `60 µm`
/// becomes `60um`.
pub fn readable_name(words: &str) -> String {
    let fit = |c: char| match c {
        ' ' | '"' | '\'' => None,
        'µ' => Some('u'),
        c if c.is_ascii_alphanumeric() || "-._+=".contains(c) => Some(c),
        _ => Some('_'),
    };
    truncated(words.chars().filter_map(fit).collect(), MAX_NAME_LENGTH)
}

fn truncated(mut name: String, length: usize) -> String {
    let ends = name.char_indices().map(|(at, c)| at + c.len_utf8());
    let end = ends.take_while(|end| *end <= length).last().unwrap_or(0);
    name.truncate(end);
    name
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schema::{BodyTable, MaterialTable};

    fn changed(overrides: &[&str]) -> Vec<Change> {
        let ice = MaterialTable::from_youngs_modulus_poissons_ratio(917.0, 9e9, 0.33);
        let ball = |name| BodyTable::sphere(name, "2 cm", "ice");
        let file = CaseFile::of_bodies(ball("lower").approaching("1 m/s"), ball("upper"))
            .with_material("ice", ice);
        changes(&file, &overrides.iter().map(ToString::to_string).collect::<Vec<_>>())
    }

    #[test]
    fn changes_of_the_scene_are_named_and_settings_are_not() {
        let of = |overrides: &[&str]| titled("Ice", &changed(overrides));
        assert_eq!(
            of(&["model=ting", "mesh.growth=1.2", "title='x'", "accuracy.tolerance=0.1"]),
            "Ice"
        );
        assert_eq!(of(&["body.0.approach_speed='2 m/s'"]), "Ice, but approach_speed = 2 m/s");
        assert_eq!(of(&["body.0.approach_speed=3"]), "Ice, but approach_speed = 3 m/s");
        let twice = ["body.0.approach_speed=3", "body.0.approach_speed=0.1 m/s"];
        assert_eq!(of(&twice), "Ice, but approach_speed = 0.1 m/s");
        assert_eq!(of(&["body.1.sphere.diameter=1e-3"]), "Ice, but upper diameter = 1e-3 m");
        assert_eq!(
            of(&["material.ice.density=1", "contact.friction=0.1"]),
            "Ice, but density = 1 kg/m^3, friction = 0.1"
        );
        let many =
            ["stop.bounces=2", "start.gap=1 mm", "stop.a=1", "stop.b=1", "stop.c=1", "stop.d=1"];
        assert_eq!(of(&many), "Ice, but bounces = 2, gap = 1 mm, a = 1, b = 1, c = 1 and 1 more");
        let flow = ["material.ice.flow.yield_strength='1 MPa'", "material.ice.yield_strength=1e6"];
        assert_eq!(of(&flow), "Ice, but flow.yield_strength = 1 MPa, yield_strength = 1e6");
    }

    #[test]
    fn folder_names_are_readable_and_of_bounded_length() {
        let of = |overrides: &[&str]| folder_name("glass", &changed(overrides));
        assert_eq!(of(&[]), "glass");
        assert_eq!(of(&["body.0.approach_speed=\"1 m/s\""]), "glass-approach_speed=1m_s");
        assert_eq!(of(&["body.0.approach_speed=1 m/s"]), "glass-approach_speed=1m_s");
        assert_eq!(of(&["body.0.sphere.diameter=14 µm"]), "glass-lower_diameter=14um");
        assert_eq!(of(&["material.ice={density=917, youngs_modulus=9e9}"]), "glass-ice");
        let many: Vec<String> = (0..20).map(|k| format!("stop.key_{k}={k}")).collect();
        assert_eq!(of(&many.iter().map(String::as_str).collect::<Vec<_>>()).len(), MAX_NAME_LENGTH);
        let stem = "é".repeat(60);
        assert_eq!(folder_name(&stem, &changed(&["stop.bounces=2"])), stem);
    }
}
