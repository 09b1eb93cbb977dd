//! The sweep file as written: one field per key.

use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::quantity::{Count, Quantity};
use crate::schema::macros::{keywords, optional_keys};

/// A whole sweep file.
#[derive(Debug, Deserialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema), schemars(extend("required" = ["case", "vary"])))]
#[serde(deny_unknown_fields)]
pub(crate) struct SweepFile {
    /// Path of the base case, relative to the sweep file.
    pub(crate) case: String,
    /// How the values of the lists are combined.
    #[serde(default)]
    pub(crate) combine: Combine,
    /// Results that are kept of each member; by default the summary, packed in large sweeps.
    pub(crate) keep: Option<Keep>,
    /// The largest number of members.
    pub(crate) max_members: Option<Quantity<Count>>,
    /// Dotted keys and lists; `sweep::axes` reads them with their positions.
    #[serde(default, rename = "vary")]
    #[cfg_attr(
        all(test, feature = "schema"),
        schemars(
            description = "Dotted keys, and the values of each.",
            with = "std::collections::BTreeMap<String, serde_json::Value>"
        )
    )]
    pub(crate) _vary: Option<IgnoredAny>,
    /// The figure of the sweep.
    #[serde(default)]
    pub(crate) plot: PlotTable,
}

keywords! {
    /// How the lists of a sweep are combined into members.
    #[derive(Default)]
    Combine {
        /// Every value of each list with every value of the others; the last list varies fastest.
        #[default]
        All = "all",
        /// The first values of all lists, then the second values, and so on.
        Paired = "paired",
    }
}

keywords! {
    /// The results that a sweep keeps of each member.
    Keep {
        /// `summary.json` in a folder per member.
        Summary = "summary",
        /// The summaries as lines of one file per process.
        Packed = "packed",
        /// The whole result folder.
        All = "all",
    }
}

optional_keys! {
    /// `[plot]` of a sweep.
    #[derive(Eq)]
    PlotTable, "a table [plot]" {
        /// The varied key on the horizontal axis; by default the first one with numbers.
        x: String,
        /// Columns of the table, one per panel.
        y: Vec<String>,
        /// The varied key that distinguishes the curves; by default all other keys.
        series: String,
    }
}
