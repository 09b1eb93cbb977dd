//! What a scene needs of an effect.

/// What a scene needs of an effect.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Need {
    /// Whether the scene calls for it.
    pub is_called_for: bool,
    /// The number that decides, in words.
    pub number: String,
    /// What follows where it is not called for.
    pub otherwise: String,
    /// What stays open in a model that lacks it.
    pub left_open: String,
    /// What a user should know of a model that lacks it.
    pub warning: Option<String>,
}

/// A share in per cent.
pub(crate) fn percent(share: f64) -> String {
    format!("{:.2} %", 100.0 * share)
}
