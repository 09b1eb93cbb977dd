//! The kink of the contact radius at its maximum, which viscoelastic bodies show (Ting 1966).

use super::stored_result::StoredResult;

/// The explanation on the report page.
const EXPLANATION: &str = "The contact radius has a kink at its maximum. While it grows, the load presses ever \
                           wider rings of the surface; when the bodies part, the outer rings have relaxed under \
                           load and recover more slowly than the bodies separate, so the contact shrinks at once \
                           (Ting 1966).";
/// Interval before and after the maximum, over the contact time.
const INTERVAL: f64 = 1.0 / 16.0;
/// Least fall of the radius in that interval, over the maximum; that of an elastic contact is 0.01.
const LEAST_FALL: f64 = 0.05;
/// Least ratio of the fall after the maximum to the rise before it.
const LEAST_RATIO: f64 = 3.0;

/// Returns the explanation if the radius of this result has a kink, and else an empty text.
pub fn explanation(result: &StoredResult) -> &'static str {
    let (start, end) = (result.first_touch(), result.last_touch());
    let times = result.history.get("time_s").iter().copied();
    let rows = times.zip(result.history.get("contact_radius_m").iter().copied());
    let largest = rows.filter(|(time, _)| *time <= end).max_by(|a, b| a.1.total_cmp(&b.1));
    let Some((top, radius)) = largest else { return "" };
    let interval = INTERVAL * (end - start);
    let below = |time: f64| radius - result.history.at("contact_radius_m", time);
    let (rise, fall) = (below(top - interval), below(top + interval));
    match fall > LEAST_FALL * radius && fall > LEAST_RATIO * rise && top + interval < end {
        true => EXPLANATION,
        false => "",
    }
}
