//! The chart of contact pressure over the distance from the axis.

use std::f64::consts::FRAC_PI_2;

use fem_case::engineering::{Unit, show};
use fem_figure::{Chart, Curve};

use super::hertz_curves::HertzCurves;
use super::history_charts::drawn_contacts;
use super::stored_result::{ContactSnapshot, StoredResult};
use crate::quantity_axis::quantity_axis;

/// End of the pressure axis over the largest computed pressure; Hertz' curves may go beyond.
const MAX_OVER_DATA: f64 = 1.2;
/// Intervals of Hertz' profile from the axis to its edge.
const N_INTERVALS: u32 = 40;

/// Returns the pressure profiles, each next to Hertz' profile under the same force: those of some snapshots
/// of one result, or those of several results at their largest pressure. `None` without any pressure.
pub fn pressure_chart(results: &[StoredResult]) -> Option<Chart> {
    let contacts = || results.iter().flat_map(|result| &result.contacts);
    let points = || contacts().flat_map(|contact| &contact.pressure);
    let (reach, peak) = points().fold((0.0f64, 0.0f64), |(r, p), at| (r.max(at.0), p.max(at.1)));
    if !(reach > 0.0 && peak > 0.0) {
        return None;
    }
    let x = quantity_axis("distance from the axis r", "m", reach);
    let y = quantity_axis("Contact pressure p", "Pa", peak).from_to(0.0, MAX_OVER_DATA * peak);
    let mut chart = Chart::new(x, y);
    let mut curves = Vec::new();
    for (k, result) in results.iter().enumerate() {
        let time = Unit::fitting(result.last_touch() - result.first_touch(), "s").with_digits(3);
        if results.len() > 1 {
            let named = |contact| (k, result, contact, result.name.clone());
            curves.extend(highest(result).map(named));
            continue;
        }
        for contact in drawn_contacts(result) {
            let since = time.show(contact.time - result.first_touch());
            let label = format!("{}, {since}", instant_name(&contact.label));
            curves.push((curves.len(), result, contact, label));
        }
    }
    let mut hertz_profiles: Vec<(usize, Vec<(f64, f64)>)> = Vec::new();
    for (k, result, contact, label) in curves {
        chart = chart.with(Curve::line(label, contact.pressure.clone()).like_curve(k));
        if results.len() == 1 {
            chart = chart.with(Curve::points("", contact.at_nodes.clone()).like_curve(k));
        }
        let force = result.history.at("contact_force_n", contact.time);
        if let Some(hertz) = HertzCurves::of(result).filter(|_| force > 0.0) {
            let profile = hertz.pressure_under(force);
            let at = |k: u32| {
                // Points are denser toward the edge, where the profile is steep.
                let share = (FRAC_PI_2 * f64::from(k) / f64::from(N_INTERVALS)).sin();
                let r = share * profile.contact_radius;
                (r, profile.pressure(r))
            };
            hertz_profiles.push((k, (0..=N_INTERVALS).map(at).collect()));
        }
    }
    let largest = hertz_profiles.iter().flat_map(|(_, points)| points);
    let largest = largest.fold(0.0, |most: f64, point| most.max(point.1));
    let mut name = "dashed: Hertz under the same force".to_string();
    if largest > MAX_OVER_DATA * peak {
        name += &format!(", up to {}", show(largest, "Pa"));
    }
    // Each profile has the colour of the computed curve.
    for (k, points) in hertz_profiles {
        chart = chart.with(Curve::dashed(&name, points).like_curve(k));
    }
    Some(chart)
}

/// Returns the name of a snapshot by its label.
pub fn instant_name(label: &str) -> &str {
    match label {
        "last-contact" => "last contact",
        "after-separation" => "after separation",
        "last-sound" => "last valid state",
        "even" | "time" => "snapshot",
        other => other,
    }
}

/// Returns the contact with the largest pressure on the axis.
fn highest(result: &StoredResult) -> Option<&ContactSnapshot> {
    let on_axis = |contact: &ContactSnapshot| contact.pressure.first().map_or(0.0, |p| p.1);
    result.contacts.iter().max_by(|a, b| on_axis(a).total_cmp(&on_axis(b)))
}
