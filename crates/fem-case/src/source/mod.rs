//! The text of a case: one tree of keys with their positions, overrides, the explanation of faults, and words that were
//! probably meant.

pub(crate) mod changes;
pub(crate) mod document;
pub(crate) mod error_recovery;
pub(crate) mod explain;
pub(crate) mod key_origins;
pub(crate) mod number_at;
pub(crate) mod overrides;
pub(crate) mod toml_syntax;

/// Returns the allowed word that is most similar to `found`, if its Jaro-Winkler similarity (0 to 1) is above `least`. Two
/// swapped neighbours count as 0.95 at least, also in short words: `nwe`.
pub fn nearest<'w, S: AsRef<str>>(found: &str, allowed: &'w [S], least: f64) -> Option<&'w str> {
    let found = found.to_lowercase();
    let similarity = |word: &S| {
        let jaro_winkler = strsim::jaro_winkler(&found, word.as_ref());
        if is_swapped(&found, word.as_ref()) { jaro_winkler.max(0.95) } else { jaro_winkler }
    };
    let nearest = allowed.iter().max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
    nearest.filter(|word| similarity(word) > least).map(AsRef::as_ref)
}

/// Returns whether the words differ only by two swapped neighbours.
fn is_swapped(found: &str, word: &str) -> bool {
    strsim::osa_distance(found, word) == 1 && strsim::levenshtein(found, word) == 2
}
