//! Error recovery: all faults of a case at once. After the first one the case is repaired on trial
//! and read again.
//!
//! The reader stops at a fault. Here its culprit is replaced by something sound of its kind, or left
//! out, and the case is read again, until it is sound or nothing new is found. What only follows from
//! a repair is no fault: an error about a key that was mended, or about the table around it.

use crate::error::CaseError;
use crate::source::key_path::join;
use crate::source::overrides::parse_path;

/// As many faults are told.
const MOST_FAULTS: usize = 20;

/// Sound values of keys that a case needs, by their last part; other keys are left out.
const SOUND: [(&str, &str); 14] = [
    ("density", "1e3"),
    ("youngs_modulus", "1e9"),
    ("shear_modulus", "4e8"),
    ("bulk_modulus", "1e9"),
    ("poissons_ratio", "0.3"),
    ("acts_on", "'all'"),
    ("terms", "[{ weight = 0.1, relaxation_time = 1 }]"),
    ("weight", "0.01"),
    ("relaxation_time", "1"),
    ("decay_rate", "1"),
    ("sphere", "{ diameter = 0.01 }"),
    ("diameter", "0.01"),
    ("approach_speed", "1"),
    ("acceleration", "9.81"),
];

/// A key of the tree, and its new value as TOML; left out without one.
#[derive(Clone, Debug)]
pub(crate) struct Repair {
    /// Its parts.
    pub(crate) path: Vec<String>,
    /// `None` removes the key.
    pub(crate) value: Option<String>,
}

/// The first fault with all others, which `read` finds under repairs.
pub(crate) fn all(first: CaseError, read: impl Fn(&[Repair]) -> Option<CaseError>) -> CaseError {
    let mut others = Vec::new();
    let mut repairs = Repairs::default();
    let mut next = Some(first.clone());
    while let Some(fault) = next.filter(|_| others.len() < MOST_FAULTS) {
        let Some(wanted) = fault.wanted() else { break };
        // A misspelled key that is left out is missing in its table.
        let is_first = repairs.list.is_empty();
        if !is_first && !repairs.explain(fault.key().unwrap_or_default()) {
            others.push(fault);
        }
        if !repairs.mend(&wanted) {
            break;
        }
        next = read(&repairs.list);
    }
    first.with_others(others)
}

#[derive(Default)]
struct Repairs {
    list: Vec<Repair>,
    /// The keys that were mended, as written.
    keys: Vec<String>,
}

impl Repairs {
    /// Whether a fault of this key may follow from a repair: of the same key, of what it is in, of what
    /// is in it; and how a body moves and falls is of all bodies and their places.
    fn explain(&self, key: &str) -> bool {
        let is_within = |inner: &str, outer: &str| {
            outer.is_empty() || inner == outer || inner.starts_with(&join(outer, ""))
        };
        let is_of = |key: &str, tables: &[&str]| tables.iter().any(|table| is_within(key, table));
        let of_fall = is_of(key, &["gravity", "stop"])
            || [".approach_speed", ".held"].iter().any(|end| key.ends_with(end));
        let falls = |mended: &str| is_of(mended, &["body", "start", "gravity"]);
        self.keys.iter().any(|mended| {
            is_within(key, mended) || is_within(mended, key) || (of_fall && falls(mended))
        })
    }

    /// Mends a key, or what it is in where that was in vain; `false` if nothing is left to try.
    fn mend(&mut self, key: &str) -> bool {
        let Some(path) = parts(key) else { return false };
        let (path, value) = match self.explain(key) {
            false => (path.clone(), sound(&path)),
            true => table_around(&path),
        };
        let written: Vec<&str> = path.iter().map(String::as_str).collect();
        let name = written.join(".");
        if self.list.iter().any(|old| old.path == path && old.value == value) {
            return false;
        }
        self.keys.extend([key.to_string(), name]);
        self.list.push(Repair { path, value });
        true
    }
}

fn parts(key: &str) -> Option<Vec<String>> {
    let (path, _) = parse_path(&format!("{key}="), 0).ok()?;
    Some(path.into_iter().map(|part| part.into_inner()).collect())
}

fn sound(path: &[String]) -> Option<String> {
    let [.., last] = path else { return None };
    let parts: Vec<&str> = path.iter().map(String::as_str).collect();
    match parts.as_slice() {
        ["body", index, "name"] => Some(format!("'body{index}'")),
        ["body", _, "material"] => Some("'lib:steel'".to_string()),
        ["body", _] | ["material", _] => table_around(path).1,
        _ => SOUND.iter().find(|(key, _)| key == last).map(|(_, value)| value.to_string()),
    }
}

/// The table of the case that a key is in, and a sound one in its place.
fn table_around(path: &[String]) -> (Vec<String>, Option<String>) {
    let parts: Vec<&str> = path.iter().map(String::as_str).collect();
    let head = |n: usize| path[..n].to_vec();
    match parts.as_slice() {
        ["material", _, ..] => {
            let sound = "{ density = 1e3, youngs_modulus = 1e9, poissons_ratio = 0.3 }";
            (head(2), Some(sound.to_string()))
        }
        ["body", index, ..] => {
            let sound = format!(
                "{{ name = 'body{index}', sphere = {{ diameter = 0.01 }}, material = 'lib:steel', \
                 approach_speed = 1 }}"
            );
            (head(2), Some(sound))
        }
        _ => (head(path.len().min(1)), None),
    }
}
