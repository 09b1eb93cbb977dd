//! Duration and height of the force pulse of a collision, from its history.
//!
//! The duration is that of the Hertz pulse with the same second moment, √(∫F (t − t̄)² dt/∫F dt). The
//! height is the maximum of the parabola that fits the force best within a tenth of the contact time around its
//! largest value; the pressure is treated in the same way. Single points that close last or oscillate hardly change
//! either.

use fem_collision::HistoryRow;

/// Duration of Hertz' elastic pulse over the root of its second moment, by quadrature.
const TIME_OVER_WIDTH: f64 = 5.152_65;

/// Half-width of the parabola's fit, over the contact time.
const HALF_WIDTH: f64 = 0.05;

/// Duration and height of a force pulse, free of the noise of single rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse {
    /// Duration from the second moment, s.
    pub time: f64,
    /// Height of the force pulse, N.
    pub force: f64,
    /// Pressure on the axis around the instant of the largest force, Pa.
    pub pressure: f64,
}

impl Pulse {
    /// Computes the pulse of a history, given its contact time in seconds.
    pub fn of(rows: &[HistoryRow], contact_time: f64) -> Self {
        let axis = |row: &HistoryRow| row.centre_pressure.unwrap_or_default();
        Self {
            time: TIME_OVER_WIDTH * width(rows),
            force: top(rows, contact_time, |row| row.contact_force),
            pressure: top(rows, contact_time, axis),
        }
    }
}

/// Returns the time during which the force is above a tenth of its largest value, s, with its ends interpolated
/// between rows; pulses of other codes are compared by it.
pub fn width_at_tenth(rows: &[HistoryRow]) -> f64 {
    let tenth = 0.1 * rows.iter().map(|row| row.contact_force).fold(0.0, f64::max);
    let is_above = |row: &HistoryRow| row.contact_force > tenth;
    let crossing = |below: &HistoryRow, above: &HistoryRow| {
        let share = (tenth - below.contact_force) / (above.contact_force - below.contact_force);
        below.time + share * (above.time - below.time)
    };
    let first = rows.windows(2).find(|pair| is_above(&pair[1]));
    let last = rows.windows(2).rfind(|pair| is_above(&pair[0]));
    match (first, last) {
        (Some(first), Some(last)) => crossing(&last[1], &last[0]) - crossing(&first[0], &first[1]),
        _ => f64::NAN,
    }
}

/// Returns the largest mean of the force over a window (s), N; the force is linear between rows.
pub fn largest_mean(rows: &[HistoryRow], window: f64) -> f64 {
    let mut impulses = vec![0.0];
    for pair in rows.windows(2) {
        let mean = 0.5 * (pair[0].contact_force + pair[1].contact_force);
        impulses.push(impulses[impulses.len() - 1] + mean * (pair[1].time - pair[0].time));
    }
    let impulse_until = |time: f64| {
        let after = rows.partition_point(|row| row.time < time).clamp(1, rows.len() - 1);
        let share = (time - rows[after - 1].time) / (rows[after].time - rows[after - 1].time);
        impulses[after - 1] + share * (impulses[after] - impulses[after - 1])
    };
    let Some(last) = rows.last().filter(|_| rows.len() > 1) else { return f64::NAN };
    let whole = rows.iter().zip(&impulses).filter(|(row, _)| row.time + window <= last.time);
    let means = whole.map(|(row, before)| (impulse_until(row.time + window) - before) / window);
    means.fold(0.0, f64::max)
}

/// Returns the root of the second moment of the force over time by the trapezoidal rule.
fn width(rows: &[HistoryRow]) -> f64 {
    let moment = |of: &dyn Fn(f64) -> f64| -> f64 {
        let value = |row: &HistoryRow| row.contact_force * of(row.time);
        let piece = |pair: &[HistoryRow]| {
            0.5 * (value(&pair[0]) + value(&pair[1])) * (pair[1].time - pair[0].time)
        };
        rows.windows(2).map(piece).sum()
    };
    let impulse = moment(&|_| 1.0);
    let mean = moment(&|time| time) / impulse;
    (moment(&|time| (time - mean) * (time - mean)) / impulse).sqrt()
}

/// Returns the maximum, within a tenth of the contact time, of the least-squares parabola through the rows around the
/// largest force.
fn top(rows: &[HistoryRow], contact_time: f64, value: fn(&HistoryRow) -> f64) -> f64 {
    let Some(peak) = rows.iter().max_by(|a, b| a.contact_force.total_cmp(&b.contact_force)) else {
        return f64::NAN;
    };
    let half = HALF_WIDTH * contact_time;
    let near = rows.iter().filter(|row| (row.time - peak.time).abs() <= half);
    // Σ x^(i+j) c_j = Σ x^i F in x = (t − t_peak)/half.
    let (mut moments, mut sums) = ([0.0; 5], [0.0; 3]);
    for row in near {
        let x = (row.time - peak.time) / half;
        let mut power = 1.0;
        for k in 0..5 {
            moments[k] += power;
            if k < 3 {
                sums[k] += power * value(row);
            }
            power *= x;
        }
    }
    let matrix = |i: usize, j: usize| moments[i + j];
    let minor = |column: Option<usize>| {
        let entry = |i: usize, j: usize| if column == Some(j) { sums[i] } else { matrix(i, j) };
        entry(0, 0) * (entry(1, 1) * entry(2, 2) - entry(1, 2) * entry(2, 1))
            - entry(0, 1) * (entry(1, 0) * entry(2, 2) - entry(1, 2) * entry(2, 0))
            + entry(0, 2) * (entry(1, 0) * entry(2, 1) - entry(1, 1) * entry(2, 0))
    };
    let [c_0, c_1, c_2] = [0, 1, 2].map(|j| minor(Some(j)) / minor(None));
    // A value that grows or falls at the largest force, as the pressure of flattened balls does, is largest at an end.
    let x = if c_2 < 0.0 { (-0.5 * c_1 / c_2).clamp(-1.0, 1.0) } else { c_1.signum() };
    c_0 + x * (c_1 + x * c_2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fem_collision::EnergyLedger;

    fn force(rows: &[HistoryRow]) -> f64 {
        top(rows, 1.0, |row| row.contact_force)
    }

    fn pulse(force: impl Fn(f64) -> f64) -> Vec<HistoryRow> {
        let row = |k: usize| {
            let time = 1e-3 * k as f64;
            HistoryRow {
                time,
                contact_force: force(time),
                contact_radius: None,
                approach: 0.0,
                centre_pressure: None,
                velocity: [0.0; 2],
                energies: EnergyLedger::EMPTY,
                residual: None,
                vibration: [0.0; 2],
                tangential: None,
            }
        };
        (0..=1000).map(row).collect()
    }

    /// In s² = 1 − δ/δ_max, time is ∫ 2s ds/√(1 − (1 − s²)^(5/2)) and force (1 − s²)^(3/2).
    #[test]
    fn the_width_of_hertz_pulse_is_known() {
        let n = 100_000;
        let (mut time, mut impulse, mut moment) = (0.0, 0.0, 0.0);
        for k in 0..n {
            let s = (f64::from(k) + 0.5) / f64::from(n);
            let depth = 1.0 - s * s;
            let dt = 2.0 * s / (1.0 - depth.powf(2.5)).sqrt() / f64::from(n);
            let (force, middle) = (depth.powf(1.5), time + 0.5 * dt);
            impulse += force * dt;
            moment += force * middle * middle * dt;
            time += dt;
        }
        let ratio = 2.0 * time / (moment / impulse).sqrt();
        assert!((ratio - TIME_OVER_WIDTH).abs() < 1e-4, "{ratio}");
    }

    /// For t (1 − t), a tenth of the height lies √0.9/2 away from the middle, and the mean over w of the middle is
    /// (1 − w²/3)/4 of 4: a parabola less its curvature. Rows are 1e-3 apart.
    #[test]
    fn a_parabola_has_its_width_at_a_tenth_and_its_mean() {
        let rows = pulse(|t| 4.0 * t * (1.0 - t));
        assert!((width_at_tenth(&rows) - 0.9f64.sqrt()).abs() < 1e-6);
        for w in [0.01, 0.3] {
            assert!((largest_mean(&rows, w) - (1.0 - w * w / 3.0)).abs() < 2e-6, "{w}");
        }
        assert!(width_at_tenth(&[]).is_nan() && largest_mean(&[], 0.1).is_nan());
    }

    /// The second moment of t (1 − t) is a twentieth; the top lies between two rows.
    #[test]
    fn a_parabola_has_its_top_and_its_width() {
        let rows = pulse(|t| 4.0 * t * (1.0 - t));
        assert!((width(&rows) - 0.05f64.sqrt()).abs() < 1e-5);
        let rows = pulse(|t| 4.0 * t * (0.9993 - t));
        assert!((force(&rows) / 0.9993f64.powi(2) - 1.0).abs() < 1e-9);
    }

    /// A pressure that falls all the time, faster at first, has no maximum inside.
    #[test]
    fn a_falling_pressure_is_largest_at_the_beginning() {
        let mut rows = pulse(|t| 4.0 * t * (1.0 - t));
        for row in &mut rows {
            row.centre_pressure = Some(1.0 + (row.time - 1.0).powi(2));
        }
        let top = top(&rows, 1.0, |row| row.centre_pressure.unwrap_or_default());
        assert!((top - (1.0 + 0.55f64.powi(2))).abs() < 1e-3, "{top}");
    }

    /// An oscillation by a per cent with a period of a hundredth hardly changes the height.
    #[test]
    fn pulse_height_and_width_are_insensitive_to_oscillations() {
        let quiet = pulse(|t| (std::f64::consts::PI * t).sin());
        let ringing = pulse(|t| (std::f64::consts::PI * t).sin() + 0.01 * (628.3 * t).sin());
        let change = force(&ringing) / force(&quiet) - 1.0;
        assert!(change.abs() < 5e-4, "{change}");
        let change = width(&ringing) / width(&quiet) - 1.0;
        assert!(change.abs() < 5e-4, "{change}");
    }
}
