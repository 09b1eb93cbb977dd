//! By how much a result may be off, on one line.

use fem::results::{Parts, UncertaintySummary};
use fem_case::engineering::Unit;

/// Shown for what nothing tells.
const UNTOLD: &str = "?";

/// "may be off by  restitution 1.9e-4, contact time 0.28 µs, …": of each quantity what is told of both parts,
/// and what they are of.
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
    let is_known = |(_, _, parts): &(&str, &str, &Parts)| parts.discretisation.is_some();
    let by = match quantities.iter().any(is_known) {
        true => "mesh and effects left out",
        false => "effects left out",
    };
    let is_nothing = |(_, _, parts): &(&str, &str, &Parts)| {
        parts.discretisation.is_none() && parts.model == Some(0.0)
    };
    if quantities.iter().all(is_nothing) {
        return format!("may be off by  nothing that closed forms tell of ({by})");
    }
    let size = |(name, unit, parts): &(&str, &str, &Parts)| {
        let told = [parts.discretisation, parts.model];
        let size = match told {
            [None, None] => UNTOLD.to_string(),
            _ => sized(told.into_iter().flatten().sum(), unit),
        };
        format!("{name} {size}")
    };
    let sizes: Vec<String> = quantities.iter().map(size).collect();
    format!("may be off by  {} ({by})", sizes.join(", "))
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
        let model = parts(None, Some(2.5e-6));
        let mut uncertainty = UncertaintySummary {
            restitution: parts(None, Some(1.9e-4)),
            contact_time_s: model,
            peak_force_n: parts(None, Some(0.0)),
            max_approach_m: parts(None, None),
            max_contact_radius_m: model,
            peak_pressure_pa: model,
        };
        let line = may_be_off_by(&uncertainty);
        let expected = "may be off by  restitution 1.9e-4, contact time 2.5 µs, peak force 0, approach ?, \
                        contact radius 2.5 µm, peak pressure 2.5 µPa (effects left out)";
        assert_eq!(line, expected);
        let nothing = parts(None, Some(0.0));
        let none = UncertaintySummary {
            restitution: nothing,
            contact_time_s: nothing,
            peak_force_n: nothing,
            max_approach_m: nothing,
            max_contact_radius_m: nothing,
            peak_pressure_pa: nothing,
        };
        assert!(may_be_off_by(&none).contains("nothing that closed forms tell of"));
        uncertainty.contact_time_s = parts(Some(2e-6), Some(2e-6));
        let line = may_be_off_by(&uncertainty);
        assert!(
            line.contains("contact time 4.0 µs") && line.ends_with("(mesh and effects left out)")
        );
    }
}
