//! The effects of a result, with an explanation of each and of the kink of the contact radius.

use fem::effects::{EFFECTS, Effect, EffectKind};
use fem_case::engineering::show;
use serde_json::Value;

use super::stored_result::StoredResult;
use crate::number_text::rounded;

/// An effect of a result.
pub struct EffectEntry {
    pub name: String,
    pub is_on: bool,
    /// Whether it changes the result by more than the tolerance.
    pub matters: bool,
    pub explanation: &'static str,
    pub reason: String,
    /// The change of the results without it.
    pub neglect_error: String,
    /// The same under [`CHANGE_HEADS`].
    pub changes: [String; 3],
}

/// Heads of the columns with the change of the results by an effect that is off.
pub const CHANGE_HEADS: [&str; 3] = ["It would change e by", "T by", "F by"];

/// Returns the effect of a name.
fn known(name: &str) -> Option<&'static dyn Effect> {
    EFFECTS.into_iter().find(|effect| effect.name() == name)
}

/// Returns whether an effect is one of the numerical method, which is not physics.
pub fn is_numerical(name: &str) -> bool {
    known(name).is_some_and(|effect| effect.kind() == EffectKind::Numerical)
}

/// Returns the physical effects that are on, the numerical ones that are on, those that are off and matter, and the
/// others.
pub fn effects(result: &StoredResult) -> [Vec<EffectEntry>; 4] {
    let effect = |value: &Value| {
        let text = |key: &str| value.get(key).and_then(Value::as_str).unwrap_or_default();
        let name = text("name").to_string();
        let explanation = known(&name).map_or("", |effect| effect.explanation());
        let holds = |key: &str| value.get(key).and_then(Value::as_bool).unwrap_or(false);
        let (is_on, matters) = (holds("active"), holds("matters"));
        let neglect_error = value.get("error_if_left_out").map(neglect_error).unwrap_or_default();
        let changes = changes(value.get("error_if_left_out").unwrap_or(&Value::Null));
        let reason = text("reason").to_string();
        EffectEntry { name, is_on, matters, explanation, reason, neglect_error, changes }
    };
    let (on, off): (Vec<EffectEntry>, Vec<EffectEntry>) =
        result.list("effects").iter().map(effect).partition(|effect| effect.is_on);
    let is_physical = |effect: &EffectEntry| !is_numerical(&effect.name);
    let (physical, numerical) = on.into_iter().partition(is_physical);
    let (lacking, off) = off.into_iter().partition(|effect| effect.matters);
    [physical, numerical, lacking, off]
}

/// Returns `e by 0.072, T by 0.39 µs, F by 3.5 N`, without what does not change.
fn neglect_error(neglect_error: &Value) -> String {
    let changes = changes(neglect_error);
    let parts = ["e", "T", "F"].iter().zip(&changes);
    let parts = parts.filter(|(_, change)| !["0", UNKNOWN].contains(&change.as_str()));
    parts.map(|(symbol, change)| format!("{symbol} by {change}")).collect::<Vec<_>>().join(", ")
}

/// What stands for a change that is not estimated.
const UNKNOWN: &str = "\u{2013}";

/// Returns the changes of restitution, contact time and peak force.
fn changes(neglect_error: &Value) -> [String; 3] {
    [("restitution", ""), ("contact_time_s", "s"), ("peak_force_n", "N")].map(|(key, unit)| {
        match neglect_error.get(key).and_then(Value::as_f64) {
            None => UNKNOWN.to_string(),
            Some(0.0) => "0".to_string(),
            Some(size) if unit.is_empty() => rounded(size),
            Some(size) => two_digits(size, unit),
        }
    })
}

fn two_digits(size: f64, unit: &str) -> String {
    let rounded: f64 = format!("{size:.1e}").parse().unwrap_or(size);
    let shown = show(rounded, unit);
    match shown.split_once(' ') {
        Some((number, unit)) if number.contains('.') => {
            format!("{} {unit}", number.trim_end_matches('0').trim_end_matches('.'))
        }
        _ => shown,
    }
}

/// Explanation of the kink of the contact radius at its maximum, which viscoelastic bodies show.
const KINK: &str = "The contact radius has a kink at its maximum. While it grows, the load presses ever \
                           wider rings of the surface; when the bodies part, the outer rings have relaxed under \
                           load and recover more slowly than the bodies separate, so the contact shrinks at once \
                           (Ting 1966).";
/// Interval before and after the maximum of the contact radius, over the contact time.
const KINK_INTERVAL: f64 = 1.0 / 16.0;
/// Least fall of the radius in that interval, over the maximum; that of an elastic contact is 0.01.
const MIN_FALL: f64 = 0.05;
/// Least ratio of the fall after the maximum to the rise before it.
const MIN_RATIO: f64 = 3.0;

/// Returns the explanation if the radius of this result has a kink, and else an empty text.
pub fn contact_radius_kink(result: &StoredResult) -> &'static str {
    let (start, end) = (result.first_touch(), result.last_touch());
    let times = result.history.get("time_s").iter().copied();
    let rows = times.zip(result.history.get("contact_radius_m").iter().copied());
    let largest = rows.filter(|(time, _)| *time <= end).max_by(|a, b| a.1.total_cmp(&b.1));
    let Some((top, radius)) = largest else { return "" };
    let interval = KINK_INTERVAL * (end - start);
    let below = |time: f64| radius - result.history.at("contact_radius_m", time);
    let (rise, fall) = (below(top - interval), below(top + interval));
    match fall > MIN_FALL * radius && fall > MIN_RATIO * rise && top + interval < end {
        true => KINK,
        false => "",
    }
}
