//! Dotted paths of keys: `body.0.sphere.diameter`, `material."my glass".density`.

/// `path.key`; just the key at the root.
pub(crate) fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_string() } else { format!("{path}.{key}") }
}

/// A key as one part of a dotted path: bare if TOML allows that, quoted if not.
pub(crate) fn quote_key(key: &str) -> String {
    if !key.is_empty() && key.chars().all(is_bare) { key.to_string() } else { format!("{key:?}") }
}

/// Whether a key made of such characters needs no quotes.
pub(crate) fn is_bare(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_' || c == '-'
}
