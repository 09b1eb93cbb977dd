//! The sweep file as written: one field a key.

use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::quantity::{Count, Quantity};
use crate::schema::keyword::keywords;

/// A whole sweep file.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(extend("required" = ["case", "vary"])))]
#[serde(deny_unknown_fields)]
pub(crate) struct SweepFile {
    /// The base case; relative to the sweep file.
    pub(crate) case: String,
    /// How the lists make members.
    #[serde(default)]
    pub(crate) combine: Combine,
    /// What is kept of each member: the summary, packed in large sweeps, unless it says otherwise.
    pub(crate) keep: Option<Keep>,
    /// A sweep of more is refused.
    pub(crate) max_members: Option<Quantity<Count>>,
    /// Dotted keys and lists; [`crate::sweep_axes`] reads them, positions included.
    #[serde(default, rename = "vary")]
    #[cfg_attr(
        feature = "schema",
        schemars(
            description = "Dotted keys, and the values of each.",
            with = "std::collections::BTreeMap<String, serde_json::Value>"
        )
    )]
    pub(crate) _vary: Option<IgnoredAny>,
    /// What is drawn.
    #[serde(default)]
    pub(crate) plot: PlotTable,
}

keywords! {
    /// How the lists of a sweep make its members.
    #[derive(Default)]
    Combine {
        /// Every value of each list with every value of the others; the last list runs fastest.
        #[default]
        All = "all",
        /// The first values of all lists, the second values, …
        Paired = "paired",
    }
}

keywords! {
    /// What a sweep keeps of each member.
    Keep {
        /// `summary.json`, in a folder of the member's own.
        Summary = "summary",
        /// The summary, as a line of a file that a process writes.
        Packed = "packed",
        /// The whole result folder.
        All = "all",
    }
}

/// `[plot]` of a sweep.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table [plot]")]
pub struct PlotTable {
    /// The varied key along the horizontal axis; the first one with numbers if absent.
    pub x: Option<String>,
    /// Columns of the table, one panel each.
    pub y: Option<Vec<String>>,
    /// The varied key that tells curves apart; the other keys together if absent.
    pub series: Option<String>,
}
