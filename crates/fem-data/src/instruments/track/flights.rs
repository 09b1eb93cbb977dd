//! The flights of a track: the frames between its lowest ones that are those of a ball in free flight.

use fem_material::engineering::show;

use crate::estimate::{deviation_by_median, median};
use crate::instruments::rig::Rig;
use crate::table::DataError;

use super::FEWEST_FRAMES;
use super::frames::Frames;
use super::parabola::TrackFlight;

/// Rise beside a bounce over the noise of a frame.
const RISE_OVER_NOISE: f64 = 8.0;
/// Smallest rise beside a bounce over the range of all heights.
const RISE_OVER_RANGE: f64 = 4e-3;
/// A frame this many times the usual deviation off its parabola is left out.
const OUTLIER: f64 = 5.0;
/// Frames of a span over those at its end that are compared with the others.
const OUTER_PART: usize = 10;
/// Fewest frames that are compared.
const FEWEST_OUTER: usize = 3;
/// Deviation of a mean over its uncertainty from which a ball is held.
const HELD: f64 = 2.5;
/// A flight whose deviations are this many times the usual ones is no parabola.
const MISFIT: f64 = 3.0;
/// Relative difference of a flight's own g from the usual one that air drag and noise do not make.
const OTHER_GRAVITY: f64 = 0.1;

/// Returns the frames with upward heights, the lowest frame of each bounce, and the least rise beside it (m).
pub(super) fn oriented(frames: Frames) -> Result<(Frames, Vec<usize>, f64), DataError> {
    let n = frames.times.len();
    if n < 2 * FEWEST_FRAMES {
        let message = format!("{n} frames are too few for a bounce");
        let help = format!("a bounce needs at least {FEWEST_FRAMES} frames before and after it");
        return Err(DataError::new(&frames.name, message).with_help(help));
    }
    let (low, high) = frames
        .heights
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |range, y| (range.0.min(*y), range.1.max(*y)));
    let noise = frames.noise();
    let rise = (RISE_OVER_NOISE * noise).max(RISE_OVER_RANGE * (high - low));
    let scored = |frames: Frames| {
        let frames = frames.without_spikes(noise);
        let minima = frames.minima(rise);
        let n = frames.times.len();
        let ends = std::iter::once(0).chain(minima.iter().copied()).chain([n]);
        let ends: Vec<usize> = ends.collect();
        let spans: Vec<Vec<usize>> =
            ends.windows(2).map(|ends| (ends[0] + 1..ends[1]).collect()).collect();
        // The span before the first bounce may have a hand in it, the last one a ball at rest.
        let inner = if spans.len() > 2 { &spans[1..spans.len() - 1] } else { &spans[..] };
        let long = inner.iter().filter(|span| span.len() >= FEWEST_FRAMES);
        let misfits: Vec<f64> = long.map(|span| frames.own_misfit(span)).collect();
        let score = match minima.is_empty() || misfits.is_empty() {
            true => f64::INFINITY,
            false => median(&misfits),
        };
        (score, frames, minima)
    };
    let upright = scored(frames.clone());
    let upside_down = scored(frames.upside_down());
    let best = if upside_down.0 < upright.0 { upside_down } else { upright };
    if best.2.is_empty() || best.0 == f64::INFINITY {
        let message = format!(
            "there is no bounce: the heights, from {low:.4} to {high:.4} m with a noise of {}, have no minimum \
             between two rises of {}",
            show(noise, "m"),
            show(rise, "m")
        );
        let help =
            "a bounce needs frames before and after it; is the column the height of the ball?";
        return Err(DataError::new(&frames.name, message).with_help(help));
    }
    Ok((best.1, best.2, rise))
}

/// Returns the flight before, between and after the lowest frames; `None` for one that is no parabola or too short.
pub(super) fn flights(
    frames: &Frames,
    minima: &[usize],
    rise: f64,
    rig: &Rig,
    warnings: &mut Vec<String>,
) -> Vec<Option<TrackFlight>> {
    let spans = free_spans(frames, minima, rise, rig.contact_time().value);
    let is_long = |span: &Vec<usize>| span.len() >= FEWEST_FRAMES;
    let inner: Vec<f64> = match spans.len() {
        0..=2 => Vec::new(),
        n => spans[1..n - 1]
            .iter()
            .filter(|span| is_long(span))
            .map(|span| frames.own_misfit(span))
            .collect(),
    };
    let usual = if inner.is_empty() { frames.noise() } else { median(&inner) };
    let allowed = MISFIT * usual + 1e-9 * frames.heights.iter().fold(0.0f64, |m, y| m.max(y.abs()));
    let last = spans.len() - 1;
    let flight = |(k, mut span): (usize, Vec<usize>)| {
        // Before the first bounce a hand may hold the ball, and after the last one it may be at rest.
        while (k == 0 || k == last) && is_long(&span) && frames.own_misfit(&span) > allowed {
            let n_less = (span.len() / 20).max(1);
            if k == 0 {
                span.drain(..n_less)
            } else {
                span.drain(span.len() - n_less..)
            };
        }
        if k == 0 || k == last {
            leave_held_out(frames, &mut span, usual, k == 0);
        }
        // Frames in contact are off the parabola.
        for _ in 0..4 {
            if !is_long(&span) || frames.own_misfit(&span) <= allowed {
                break;
            }
            if k > 0 {
                span.remove(0);
            }
            if k < last {
                span.pop();
            }
        }
        let is_parabola = is_long(&span) && frames.own_misfit(&span) <= allowed;
        if !is_parabola && k > 0 && k < last {
            let [from, to] = [minima[k - 1], minima[k]].map(|k| frames.times[k]);
            let why = if is_long(&span) { "is no parabola" } else { "has too few frames" };
            warnings
                .push(format!("the flight from {from:.4} s to {to:.4} s {why} and is left out"));
        }
        is_parabola.then(|| TrackFlight::of(frames, span))
    };
    let mut flights: Vec<Option<TrackFlight>> = spans.into_iter().enumerate().map(flight).collect();
    warnings.extend(leave_other_gravity_out(frames, minima, &mut flights, usual));
    flights
}

/// Returns the frames before, between and after the lowest ones that are not in contact for this time, s.
fn free_spans(frames: &Frames, minima: &[usize], rise: f64, contact: f64) -> Vec<Vec<usize>> {
    let n = frames.times.len();
    let starts = std::iter::once(None).chain(minima.iter().copied().map(Some));
    let ends = minima.iter().copied().map(Some).chain([None]);
    let spans = starts.zip(ends).map(|(start, end)| {
        let is_free = |k: &usize| {
            let away = |bounce: Option<usize>| {
                bounce.is_none_or(|bounce| {
                    *k != bounce && (frames.times[*k] - frames.times[bounce]).abs() >= contact
                })
            };
            away(start) && away(end)
        };
        (start.unwrap_or(0)..end.map_or(n, |end| end + 1)).filter(is_free).collect()
    });
    let mut spans: Vec<Vec<usize>> = spans.collect();
    // After the last bounce that is clear, another one may follow near the plate.
    if let (Some(span), Some(bounce)) = (spans.last_mut(), minima.last()) {
        let is_near = |k: &usize| frames.heights[*k] < frames.heights[*bounce] + rise;
        while span.last().is_some_and(is_near) {
            span.pop();
        }
    }
    spans
}

/// Removes flights that fall with another g than the others, as a ball at rest or in a hand does, and returns warnings of those between
/// bounces; `usual` is the misfit of the others, m.
fn leave_other_gravity_out(
    frames: &Frames,
    minima: &[usize],
    flights: &mut [Option<TrackFlight>],
    usual: f64,
) -> Vec<String> {
    let (last, mut warnings) = (flights.len() - 1, Vec::new());
    let mut own: Vec<(f64, f64)> =
        flights.iter().flatten().map(|one| one.curvature(frames)).collect();
    own.sort_by(|a, b| (a.0 / a.1).total_cmp(&(b.0 / b.1)));
    let half = 0.5 * own.iter().map(|it| it.1).sum::<f64>();
    let mut sum = 0.0;
    let middle = own.iter().find(|it| {
        sum += it.1;
        sum >= half
    });
    let Some(gravity) = middle.map(|it| it.0 / it.1) else { return warnings };
    for (k, slot) in flights.iter_mut().enumerate() {
        let Some((along, across)) = slot.as_ref().map(|one| one.curvature(frames)) else {
            continue;
        };
        let off = (along / across - gravity).abs();
        if off > OUTLIER * usual / across.sqrt() + OTHER_GRAVITY * gravity.abs() {
            if k > 0 && k < last {
                let [from, to] = [minima[k - 1], minima[k]].map(|k| frames.times[k]);
                warnings.push(format!(
                    "the flight from {from:.4} s to {to:.4} s falls with another g and is left out"
                ));
            }
            *slot = None;
        }
    }
    warnings
}

/// Removes frames at the outer end of a span in which a hand holds the ball or it rests: while the mean of the outermost ones is off the
/// parabola of the others by more than the noise (m) explains.
fn leave_held_out(frames: &Frames, span: &mut Vec<usize>, noise: f64, at_start: bool) {
    let mut has_held = false;
    loop {
        let n_outer = (span.len() / OUTER_PART).max(FEWEST_OUTER);
        if span.len() < FEWEST_FRAMES + n_outer {
            return;
        }
        let is_off = |n: usize| {
            let split = if at_start { n } else { span.len() - n };
            let (first, second) = span.split_at(split);
            let (outer, inner) = if at_start { (first, second) } else { (second, first) };
            let (off, uncertainty) = TrackFlight::of(frames, inner.to_vec()).misses(frames, outer);
            off.abs() > HELD * noise * uncertainty
        };
        let is_held = [1, FEWEST_OUTER, n_outer].into_iter().any(is_off);
        if is_held || has_held {
            // Frames just before the release are nearly on the parabola.
            let n_less = n_outer / 2;
            match at_start {
                true => drop(span.drain(..n_less)),
                false => span.truncate(span.len() - n_less),
            }
        }
        if !is_held {
            return;
        }
        has_held = true;
    }
}

/// Removes frames that are far off their parabola, and returns their number.
pub(super) fn leave_outliers_out(frames: &Frames, flights: &mut [Option<TrackFlight>]) -> usize {
    let mut n_out = 0;
    let scatter = frames.noise();
    for flight in flights.iter_mut().flatten() {
        let (along, across) = flight.curvature(frames);
        let parabola = flight.parabola(if across > 0.0 { along / across } else { 0.0 });
        let off = |k: usize| {
            (frames.heights[k] - parabola.at(frames.times[k])).abs() * frames.weights[k].sqrt()
        };
        let all: Vec<f64> = flight.frames.iter().map(|k| off(*k)).collect();
        let limit = OUTLIER * deviation_by_median(&all).max(scatter);
        let kept: Vec<usize> = flight.frames.iter().copied().filter(|k| off(*k) <= limit).collect();
        if kept.len() >= FEWEST_FRAMES && kept.len() < flight.frames.len() {
            n_out += flight.frames.len() - kept.len();
            *flight = TrackFlight::of(frames, kept);
        }
    }
    n_out
}
