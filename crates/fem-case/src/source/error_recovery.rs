//! Error recovery: finds all faults of a text at once.
//!
//! serde and the validation stop at the first fault. Its key is then given a valid value, or is left out, and the
//! text is read again, until it is valid or nothing new is found. Faults that only follow from a repair are not
//! reported: those of a repaired key, and those of the table around it.

use crate::error::CaseError;
use crate::source::overrides::parse_path;
use crate::source::toml_syntax::join;

/// The largest number of faults that are reported after the first one.
pub(crate) const MAX_FAULTS: usize = 20;

/// Valid values of keys that a case needs, by their last part; other keys are left out.
const VALID_VALUES: [(&str, &str); 14] = [
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

/// A key of the tree and its new value.
#[derive(Clone, Debug)]
pub(crate) struct KeyRepair {
    /// The parts of the key.
    pub(crate) path: Vec<String>,
    /// The value as TOML; `None` removes the key.
    pub(crate) value: Option<String>,
}

/// Reads a text under repairs until it is valid. Returns what was read at last, if anything, and all faults.
pub(crate) fn read_repaired<T>(
    read: impl Fn(&[KeyRepair]) -> Result<T, CaseError>,
) -> (Option<T>, Vec<CaseError>) {
    let (mut faults, mut repairs) = (Vec::new(), Repairs::default());
    loop {
        let fault = match read(&repairs.list) {
            Ok(found) => return (Some(found), faults),
            Err(fault) => fault,
        };
        let wanted = fault.wanted();
        // A misspelled key that is left out is missing in its table.
        if faults.is_empty() || !repairs.explain(fault.key().unwrap_or_default()) {
            faults.push(fault);
        }
        let is_repaired = wanted.is_some_and(|key| repairs.add(&key));
        if !is_repaired || faults.len() > MAX_FAULTS {
            return (None, faults);
        }
    }
}

#[derive(Default)]
struct Repairs {
    list: Vec<KeyRepair>,
    /// The repaired keys as dotted paths.
    keys: Vec<String>,
}

impl Repairs {
    /// Returns whether a fault of this key may follow from a repair: of the same key, of the table around it, or of
    /// a key in it. The motion and the fall of a body depend on both bodies and their positions.
    fn explain(&self, key: &str) -> bool {
        let is_within = |inner: &str, outer: &str| {
            outer.is_empty() || inner == outer || inner.starts_with(&join(outer, ""))
        };
        let is_of = |key: &str, tables: &[&str]| tables.iter().any(|table| is_within(key, table));
        let is_motion = is_of(key, &["gravity", "stop"])
            || [".approach_speed", ".held"].iter().any(|end| key.ends_with(end));
        self.keys.iter().any(|repaired| {
            is_within(key, repaired)
                || is_within(repaired, key)
                || (is_motion && is_of(repaired, &["body", "start", "gravity"]))
        })
    }

    /// Adds a repair of a key, or of the table around it if that was repaired in vain; `false` if nothing is left
    /// to try.
    fn add(&mut self, key: &str) -> bool {
        let Ok((path, _)) = parse_path(&format!("{key}="), 0) else { return false };
        let path: Vec<String> = path.into_iter().map(|part| part.into_inner()).collect();
        let (path, value) = match self.explain(key) {
            false => (path.clone(), valid_value(&path)),
            true => table_around(&path),
        };
        if self.list.iter().any(|old| old.path == path && old.value == value) {
            return false;
        }
        self.keys.extend([key.to_string(), path.join(".")]);
        self.list.push(KeyRepair { path, value });
        true
    }
}

fn valid_value(path: &[String]) -> Option<String> {
    let parts: Vec<&str> = path.iter().map(String::as_str).collect();
    match parts.as_slice() {
        ["body", index, "name"] => Some(format!("'body{index}'")),
        ["body", _, "material"] => Some("'lib:steel'".to_string()),
        ["body", _] | ["material", _] => table_around(path).1,
        [.., last] => {
            let known = VALID_VALUES.iter().find(|(key, _)| key == last);
            known.map(|(_, value)| value.to_string())
        }
        [] => None,
    }
}

/// Returns the path of the table of the case that a key is in, and a valid table in its place.
fn table_around(path: &[String]) -> (Vec<String>, Option<String>) {
    let parts: Vec<&str> = path.iter().map(String::as_str).collect();
    let (depth, valid) = match parts.as_slice() {
        ["material", _, ..] => {
            let valid = "{ density = 1e3, youngs_modulus = 1e9, poissons_ratio = 0.3 }";
            (2, Some(valid.to_string()))
        }
        ["body", index, ..] => {
            let valid = format!(
                "{{ name = 'body{index}', sphere = {{ diameter = 0.01 }}, material = 'lib:steel', \
                 approach_speed = 1 }}"
            );
            (2, Some(valid))
        }
        _ => (path.len().min(1), None),
    };
    (path[..depth].to_vec(), valid)
}
