//! The kink of the contact radius at its largest, of bodies that relax while they touch (Ting 1966).

use super::record::Record;

/// What a reader is told of it.
const WORDS: &str = "The contact radius has a kink at its largest. Until then the surface is pressed ever further out; \
                     as the bodies part, its outermost rings, which have relaxed while they were pressed, come back \
                     more slowly than the bodies go, and the contact shrinks at once (Ting 1966).";
/// Before and after the largest radius, over the contact time.
const STRETCH: f64 = 1.0 / 16.0;
/// What the radius falls by in that at least, over the largest: an elastic contact's falls by 0.01.
const LEAST_FALL: f64 = 0.05;
/// That over what it rose by in as long before, at least.
const LEAST_RATIO: f64 = 3.0;

/// The words where the picture of the radius shows a kink.
pub fn words(record: &Record) -> &'static str {
    let (start, end) = (record.first_touch(), record.last_touch());
    let times = record.history.get("time_s").iter().copied();
    let rows = times.zip(record.history.get("contact_radius_m").iter().copied());
    let largest = rows.filter(|(time, _)| *time <= end).max_by(|a, b| a.1.total_cmp(&b.1));
    let Some((top, radius)) = largest else { return "" };
    let stretch = STRETCH * (end - start);
    let less = |time: f64| radius - record.history.at("contact_radius_m", time);
    let (rise, fall) = (less(top - stretch), less(top + stretch));
    match fall > LEAST_FALL * radius && fall > LEAST_RATIO * rise && top + stretch < end {
        true => WORDS,
        false => "",
    }
}
