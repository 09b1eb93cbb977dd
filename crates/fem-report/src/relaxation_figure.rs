//! The figure of a relaxation that was found: moduli with the series, residuals, and the weights.

use std::f64::consts::TAU;

use fem::ZERO_CELSIUS;
use fem::measured::{ModulusPoint, TestKind};
use fem::relaxation::{FoundRelaxation, Superposition};
use fem_figure::{Axis, COLOURS, Chart, Curve, GREY};

use crate::quantity_axis::{DECADE, fitting_axis, quantity_axis};

/// Points of a drawn curve per decade.
const POINTS_PER_DECADE: f64 = 12.0;

/// Returns `relaxation.svg`: measured moduli with the series, relative residuals, and the weights of the terms.
pub fn relaxation_figure(found: &FoundRelaxation) -> String {
    let charts = [moduli(found), residuals(found), weights(found)].into_iter();
    let charts = charts.chain(found.superposition.as_ref().map(shifts));
    fem_figure::svg(&charts.collect::<Vec<_>>()).unwrap_or_default()
}

/// Returns the position of a point along the axis: frequency, Hz, or time, s.
fn position(found: &FoundRelaxation, at: f64) -> f64 {
    if found.table.kind == TestKind::Oscillation { at / TAU } else { at }
}

fn abscissa(found: &FoundRelaxation) -> Axis {
    let points = found.points.iter().map(|point| position(found, point.at));
    let (name, symbol) = match found.table.kind {
        TestKind::Oscillation => ("frequency", "Hz"),
        TestKind::Relaxation => ("time", "s"),
    };
    quantity_axis(name, symbol, points.fold(0.0, f64::max)).logarithmic()
}

/// The storage or the loss modulus of a point, Pa.
type Part = fn(&ModulusPoint) -> f64;

/// Returns the parts of a measured modulus with their names.
fn parts(found: &FoundRelaxation) -> Vec<(String, Part)> {
    let symbol = found.modulus().symbol();
    match found.table.kind {
        TestKind::Oscillation => vec![
            (format!("storage modulus {symbol}′"), |point| point.storage),
            (format!("loss modulus {symbol}″"), |point| point.loss),
        ],
        TestKind::Relaxation => vec![(format!("modulus {symbol}(t)"), |point| point.storage)],
    }
}

fn moduli(found: &FoundRelaxation) -> Chart {
    let points = &found.points;
    let (from, to) = points
        .iter()
        .fold((f64::INFINITY, 0.0f64), |(from, to), point| (from.min(point.at), to.max(point.at)));
    let largest = points.iter().map(|point| point.storage).fold(0.0, f64::max);
    let y = quantity_axis("modulus", "Pa", largest).logarithmic();
    let mut chart = Chart::new(abscissa(found), y);
    let n = ((to / from).log10() * POINTS_PER_DECADE).ceil().max(1.0) as usize;
    for (k, (name, part)) in parts(found).into_iter().enumerate() {
        let measured = points.iter().map(|point| (position(found, point.at), part(point)));
        let measured = measured.filter(|it| it.1 > 0.0).collect();
        let fitted = (0..=n).map(|i| {
            let at = from * (to / from).powf(i as f64 / n as f64);
            (position(found, at), found.series.moduli(found.table.kind, at)[k])
        });
        let fitted = fitted.filter(|it| it.1 > 0.0).collect();
        chart = chart
            .with(Curve::points(name, measured).coloured(COLOURS[k]))
            .with(Curve::line("series", fitted).coloured(COLOURS[k]));
    }
    chart
}

fn residuals(found: &FoundRelaxation) -> Chart {
    let mut chart = Chart::new(abscissa(found), Axis::new("residual [%]"));
    for (k, (name, part)) in parts(found).into_iter().enumerate() {
        let off = found.points.iter().filter(|point| part(point) > 0.0).map(|point| {
            let fitted = found.series.moduli(found.table.kind, point.at)[k];
            let share = (part(point) - fitted) / part(point);
            (position(found, point.at), 100.0 * share)
        });
        chart = chart.with(Curve::points(name, off.collect()).coloured(COLOURS[k]));
    }
    let zero = found.points.iter().map(|point| (position(found, point.at), 0.0)).collect();
    chart.with(Curve::dashed("", zero).coloured(GREY))
}

fn weights(found: &FoundRelaxation) -> Chart {
    let whole = found.series.instantaneous_modulus();
    let terms = &found.series.terms;
    let times = terms.iter().map(|term| term.relaxation_time);
    let x = fitting_axis("relaxation time", "s", times, DECADE).logarithmic();
    let points = terms.iter().map(|term| (term.relaxation_time, term.modulus / whole));
    let bars = terms.iter().map(|term| 2.0 * term.uncertainty / whole).collect();
    let points = Curve::points("weight ± 2 u", points.collect()).with_errors(bars);
    Chart::new(x, Axis::new("weight")).with(points.like_curve(2))
}

/// Shift factors over temperature with the laws that were fitted to them.
fn shifts(found: &Superposition) -> Chart {
    let log10 = |ln: f64| ln / std::f64::consts::LN_10;
    let celsius = |kelvin: f64| kelvin - ZERO_CELSIUS;
    let points = found.blocks.iter().map(|it| (celsius(it.temperature), log10(it.ln_shift)));
    let bars = found.blocks.iter().map(|it| 2.0 * log10(it.shift_uncertainty)).collect();
    let measured = Curve::points("shift ± 2 u", points.collect()).with_errors(bars);
    let mut chart = Chart::new(Axis::new("temperature [°C]"), Axis::new("log₁₀ a_T"));
    let ends = [found.blocks.first(), found.blocks.last()];
    let [from, to] = ends.map(|block| block.map_or(0.0, |block| block.temperature));
    for (k, (name, law)) in
        [("WLF", &found.wlf), ("Arrhenius", &found.arrhenius)].iter().enumerate()
    {
        let Some(fitted) = law else { continue };
        let curve = (0..=60).filter_map(|i| {
            let temperature = from + (to - from) * f64::from(i) / 60.0;
            let reference = found.reference_temperature();
            Some((celsius(temperature), fitted.law.log10_shift(temperature, reference)?))
        });
        chart = chart.with(Curve::line(*name, curve.collect()).coloured(COLOURS[k + 1]));
    }
    chart.with(measured.like_curve(0))
}
