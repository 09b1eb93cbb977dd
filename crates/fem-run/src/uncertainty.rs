//! By how much a result may be off, on one line.

use fem::results::{Parts, UncertaintySummary};
use fem_case::engineering::Unit;

/// Shown for what nothing tells.
const UNTOLD: &str = "?";

/// "may be off by  restitution 1.9e-4, contact time 0.28 µs, …": of each quantity both parts together, more
/// than one where nothing tells the other.
pub fn may_be_off_by(uncertainty: &UncertaintySummary) -> String {
    let UncertaintySummary {
        restitution,
        contact_time_s,
        peak_force_n,
        max_approach_m,
        max_contact_radius_m,
        peak_pressure_pa,
    } = uncertainty;
    let quantities = [
        ("restitution", "", restitution),
        ("contact time", "s", contact_time_s),
        ("peak force", "N", peak_force_n),
        ("approach", "m", max_approach_m),
        ("contact radius", "m", max_contact_radius_m),
        ("peak pressure", "Pa", peak_pressure_pa),
    ];
    let size = |(name, unit, parts): &(&str, &str, &Parts)| {
        let size = match (parts.discretisation, parts.model) {
            (None, None) => UNTOLD.to_string(),
            (Some(discretisation), Some(model)) => sized(discretisation + model, unit),
            (Some(one), None) | (None, Some(one)) => format!("> {}", sized(one, unit)),
        };
        format!("{name} {size}")
    };
    let sizes: Vec<String> = quantities.iter().map(size).collect();
    format!("may be off by  {} (mesh and effects left out)", sizes.join(", "))
}

/// Two digits.
fn sized(size: f64, unit: &str) -> String {
    match (size, unit) {
        (0.0, _) => "0".to_string(),
        (_, "") => format!("{size:.1e}"),
        _ => Unit::fitting(size, unit).with_digits(2).show(size),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(discretisation: Option<f64>, model: Option<f64>) -> Parts {
        Parts { discretisation, model }
    }

    #[test]
    fn a_line_adds_what_is_told() {
        let both = parts(Some(2e-6), Some(2e-6));
        let uncertainty = UncertaintySummary {
            restitution: parts(Some(0.0), Some(1.9e-4)),
            contact_time_s: both,
            peak_force_n: parts(Some(0.0), Some(0.0)),
            max_approach_m: parts(None, None),
            max_contact_radius_m: parts(None, Some(2.5e-6)),
            peak_pressure_pa: parts(Some(2.5e-6), None),
        };
        assert_eq!(
            may_be_off_by(&uncertainty),
            "may be off by  restitution 1.9e-4, contact time 4.0 µs, peak force 0, approach ?, \
             contact radius > 2.5 µm, peak pressure > 2.5 µPa (mesh and effects left out)"
        );
    }
}
