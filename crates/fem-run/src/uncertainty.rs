//! By how much a result may be off, on one line.

use fem::results::UncertaintySummary;
use fem_case::engineering::{Unit, number};
use fem_collision::Headline;

/// Shown for what nothing tells.
const UNTOLD: &str = "?";

/// "may be off by  restitution 1.9e-4, contact time 0.28 µs, …": of each quantity both parts together, more
/// than one where nothing tells the other.
pub fn may_be_off_by(uncertainty: &UncertaintySummary) -> String {
    let size = |headline: Headline| {
        let unit = headline.unit();
        let parts = uncertainty.parts(headline);
        let size = match (parts.discretisation, parts.model) {
            (None, None) => UNTOLD.to_string(),
            (Some(discretisation), Some(model)) => sized(discretisation + model, unit),
            (Some(one), None) | (None, Some(one)) => format!("> {}", sized(one, unit)),
        };
        format!("{} {size}", headline.name().trim_start_matches("largest "))
    };
    let sizes = Headline::ALL.map(size);
    format!("may be off by  {} (mesh and effects left out)", sizes.join(", "))
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
        Parts { discretisation, model }
    }

    #[test]
    fn a_line_adds_what_is_told() {
        let uncertainty = UncertaintySummary::by(|headline| match headline {
            Headline::Restitution => parts(Some(0.0), Some(1.9e-4)),
            Headline::ContactTime => parts(Some(2e-6), Some(2e-6)),
            Headline::PeakForce => parts(Some(0.0), Some(0.0)),
            Headline::MaxApproach => parts(None, None),
            Headline::MaxContactRadius => parts(None, Some(2.5e-6)),
            Headline::PeakPressure => parts(Some(2.5e-6), None),
        });
        assert_eq!(
            may_be_off_by(&uncertainty),
            "may be off by  restitution 1.9e-4, contact time 4.0 µs, peak force 0, approach ?, \
             contact radius > 2.5 µm, peak pressure > 2.5 µPa (mesh and effects left out)"
        );
    }
}
