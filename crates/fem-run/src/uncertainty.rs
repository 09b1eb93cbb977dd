//! By how much a result may be off, on one line.

use fem::results::UncertaintySummary;
use fem_case::engineering::{Unit, number};
use fem_collision::Headline;

/// Shown for what nothing tells.
const UNTOLD: &str = "?";

/// "may be off by  restitution 1.9e-4, contact time 0.28 µs, …": of each quantity both parts together, and more
/// than what is known where not all is.
pub fn may_be_off_by(uncertainty: &UncertaintySummary) -> String {
    let size = |headline: Headline| {
        let unit = headline.unit();
        let parts = uncertainty.parts(headline);
        let size = match (parts.sum(), parts.known().filter(|known| *known > 0.0)) {
            (Some(sum), _) => sized(sum, unit),
            (None, Some(known)) => format!("> {}", sized(known, unit)),
            (None, None) => UNTOLD.to_string(),
        };
        format!("{} {size}", headline.name().trim_start_matches("largest "))
    };
    let sizes = Headline::ALL.map(size);
    let is_partial = sizes.iter().any(|size| size.contains("> "));
    format!(
        "may be off by  {} (mesh and effects left out{})",
        sizes.join(", "),
        if is_partial { "; >: a part of it is not known" } else { "" }
    )
}

/// Two digits.
fn sized(size: f64, unit: &str) -> String {
    match (size, unit) {
        (0.0, _) => "0".to_string(),
        (_, "") => number(size, 2),
        _ => Unit::fitting(size, unit).with_digits(2).show(size),
    }
}

#[cfg(test)]
mod tests {
    use fem::results::Parts;

    use super::*;

    fn parts(discretisation: Option<f64>, model: Option<f64>) -> Parts {
        Parts { discretisation, model, model_at_least: None }
    }

    #[test]
    fn a_line_adds_what_is_told() {
        let uncertainty = UncertaintySummary::by(|headline| match headline {
            Headline::Restitution => parts(Some(0.0), Some(1.9e-4)),
            Headline::ContactTime => parts(Some(2e-6), Some(2e-6)),
            Headline::PeakForce => parts(Some(0.0), Some(0.0)),
            Headline::MaxApproach => parts(Some(0.0), None),
            Headline::MaxContactRadius => parts(None, Some(2.5e-6)),
            Headline::PeakPressure => {
                Parts { model_at_least: Some(1e-6), ..parts(Some(2.5e-6), None) }
            }
        });
        assert_eq!(
            may_be_off_by(&uncertainty),
            "may be off by  restitution 1.9e-4, contact time 4.0 µs, peak force 0, approach ?, \
             contact radius > 2.5 µm, peak pressure > 3.5 µPa (mesh and effects left out; >: a part of it is \
             not known)"
        );
    }
}
