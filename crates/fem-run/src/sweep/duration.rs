//! Times of whole sweeps in words.

use std::time::Duration;

use fem_case::engineering::show;
use indicatif::HumanDuration;

/// `12 ms`, `40 s`, `3 minutes`, `2 days`.
pub fn duration(seconds: f64) -> String {
    if seconds < 60.0 {
        return show(seconds, "s");
    }
    HumanDuration(Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX)).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_times_are_in_minutes_and_days() {
        assert_eq!(duration(0.25), show(0.25, "s"));
        assert_eq!(duration(180.0), "3 minutes");
        assert_eq!(duration(2.0 * 86_400.0), "2 days");
        assert!(!duration(f64::INFINITY).is_empty());
    }
}
