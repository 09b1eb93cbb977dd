//! The text of a case: one tree of keys with their positions, overrides, and the explanation of faults.

pub(crate) mod changes;
pub(crate) mod document;
pub(crate) mod error_recovery;
pub(crate) mod explain;
pub(crate) mod key_origins;
pub(crate) mod number_at;
pub(crate) mod overrides;
pub(crate) mod similar_words;
pub(crate) mod toml_syntax;
