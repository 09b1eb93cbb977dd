//! By how much a number may be off, in two columns beside it.

use fem::results::Parts;
use fem_case::engineering::{Unit, number};

/// Shown for what nothing tells.
const UNTOLD: &str = "?";

/// Errors below this share of the number are what rounding does.
const ROUNDING: f64 = 1e-9;

/// What the columns are, for the line below the table; `own` names the first.
pub fn legend(own: &str, cells: &str) -> String {
    let untold = if cells.contains(UNTOLD) { "; ?: not known" } else { "" };
    let partly = if cells.contains("> ") { "; >: at least" } else { "" };
    format!(
        "{own}: from what its equations say; ± left out: by effects that it lacks{untold}{partly}"
    )
}

/// What `value` may be off by because of the discretisation, and of effects that the model lacks: in `unit`, or
/// plain for a number that has none. Two digits.
pub fn columns(value: f64, parts: &Parts, unit: Option<&Unit>) -> [String; 2] {
    let sized = |size: f64| match unit {
        _ if size <= ROUNDING * value.abs() => "0".to_string(),
        Some(unit) => format!("{} {}", number(unit.scaled(size), 2), unit.symbol()),
        None => number(size, 2),
    };
    let left_out = match (parts.model, parts.model_at_least) {
        (Some(size), _) => sized(size),
        (None, Some(known)) => format!("> {}", sized(known)),
        (None, None) => UNTOLD.to_string(),
    };
    [parts.discretisation.map_or(UNTOLD.into(), sized), left_out]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_known_is_said() {
        let of = |discretisation, model, model_at_least| {
            let parts = Parts { discretisation, model, model_at_least };
            columns(62e-6, &parts, Some(&Unit::fitting(62e-6, "s")))
        };
        assert_eq!(of(Some(1.234e-7), Some(3e-6), None), ["0.12 µs", "3 µs"]);
        assert_eq!(of(Some(1e-17), None, Some(2e-7)), ["0", "> 0.2 µs"]);
        assert_eq!(of(None, None, None), ["?", "?"]);
        let plain = Parts { discretisation: Some(1.94e-4), model: Some(0.0), model_at_least: None };
        assert_eq!(columns(1.0, &plain, None), ["1.9e-4", "0"]);
        assert!(legend("± mesh", "0.12 µs  > 0.2 µs").ends_with("lacks; >: at least"));
    }
}
