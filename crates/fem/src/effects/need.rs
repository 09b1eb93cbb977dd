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

/// A share in per cent; of what would be 0.00 the power of ten.
pub(crate) fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    match percent != 0.0 && percent.abs() < 5e-3 {
        true => format!("{percent:.1e} %"),
        false => format!("{percent:.2} %"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_shares_keep_a_digit() {
        let shares = [0.0, 1e-11, 4.9e-5, 5.1e-5, 0.01, 1.5];
        let words = ["0.00 %", "1.0e-9 %", "4.9e-3 %", "0.01 %", "1.00 %", "150.00 %"];
        assert_eq!(shares.map(percent), words);
    }
}
