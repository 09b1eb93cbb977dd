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

/// Two digits of a number that is compared with one, without an exponent where it needs none.
pub(crate) fn short(number: f64) -> String {
    let text = format!("{number:.1e}");
    let is_plain = number == 0.0 || (1e-3..1e3).contains(&number.abs());
    text.parse::<f64>().ok().filter(|_| is_plain).map_or(text, |rounded| rounded.to_string())
}

/// A share in per cent.
pub(crate) fn percent(share: f64) -> String {
    format!("{:.2} %", 100.0 * share)
}
