//! `{}` as a choice: `wall = {}`, `fem = {}`.

use serde::{Deserialize, Serialize};

/// A table without keys: its presence is the choice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "an empty table, {}")]
pub struct EmptyTable {}
