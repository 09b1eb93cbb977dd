//! Tables of which exactly one key is given, such as `[model]`, and the names that stand for such a table.

use super::flow_table::HardeningTable;
use super::model_tables::{LawTable, ModelTable};

/// A table that chooses one of its keys.
pub(crate) struct Choice {
    /// The keys that exclude each other; any key if empty.
    exclusive: &'static [&'static str],
    /// Names that stand for the table of this name with its defaults: `"ting"` for `{ ting = {} }`.
    pub names: &'static [&'static str],
}

/// Returns the choice at a path of keys, if there is one.
pub(crate) fn choice_at(path: &[&str]) -> Option<Choice> {
    let choice = |exclusive, names| Some(Choice { exclusive, names });
    match path {
        ["model"] => choice(&[], ModelTable::NAMES),
        ["model", "law"] => choice(LawTable::NAMES, LawTable::NAMES),
        ["material", _, "flow", "hardening"] => choice(&[], HardeningTable::NAMES),
        _ => None,
    }
}

impl Choice {
    /// Returns whether the table may have only one of these two keys, so that an override with one replaces the other.
    pub fn is_between(&self, key: &str, other: &str) -> bool {
        let is_exclusive = |key| self.exclusive.is_empty() || self.exclusive.contains(&key);
        key != other && is_exclusive(key) && is_exclusive(other)
    }
}
