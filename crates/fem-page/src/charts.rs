//! Charts of a collision over time, as pictures that a page restyles by their classes.

use fem::{Account, HistoryRow};
use fem_figure::{Axis, Chart, Curve, Mark};
use fem_report::quantity_axis::quantity_axis;
use serde::{Deserialize, Serialize};

/// The legend entry of the reference.
const HERTZ: &str = "Hertz";
/// Least share of the largest energy from which an account gets a curve.
const MIN_ENERGY_SHARE: f64 = 1e-3;

/// Charts over time as SVG; `None` if there is nothing to draw.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Charts {
    /// The contact force.
    pub force: Option<String>,
    /// The approach of the mass centres.
    pub approach: Option<String>,
    /// The energies, by account.
    pub energy: Option<String>,
}

impl Charts {
    /// Draws a run next to Hertz' theory of the same bodies; `common` is the energy (J) of their common
    /// motion, if it is known, which is not drawn.
    pub(crate) fn of(run: &[HistoryRow], hertz: &[HistoryRow], common: Option<f64>) -> Self {
        Self {
            force: compared(run, hertz, ("contact force", "N"), |row| row.contact_force),
            approach: compared(run, hertz, ("approach", "m"), |row| row.approach),
            energy: energy(run, common),
        }
    }
}

/// Returns an axis in a unit that fits the largest of some numbers.
fn axis(name: &str, symbol: &str, numbers: impl Iterator<Item = f64>) -> Axis {
    let largest = numbers.fold(0.0, |largest: f64, number| largest.max(number.abs()));
    quantity_axis(name, symbol, largest)
}

fn time_axis(rows: &[HistoryRow]) -> Axis {
    axis("time", "s", rows.iter().map(|row| row.time))
}

fn compared(
    run: &[HistoryRow],
    hertz: &[HistoryRow],
    (name, symbol): (&str, &str),
    get: impl Fn(&HistoryRow) -> f64,
) -> Option<String> {
    let points = |rows: &[HistoryRow]| rows.iter().map(|row| (row.time, get(row))).collect();
    let chart = Chart::new(time_axis(run), axis(name, symbol, run.iter().map(&get)))
        .with(Curve::line("this run", points(run)))
        .with(Curve::dashed(HERTZ, points(hertz)));
    fem_figure::panel(&chart)
}

/// An account of energy over the rows, J.
struct EnergyCurve {
    name: String,
    colour: usize,
    energies: Vec<Option<f64>>,
}

fn energy(run: &[HistoryRow], common: Option<f64>) -> Option<String> {
    let curves = energy_curves(run, common);
    let all = || curves.iter().flat_map(|curve| curve.energies.iter().flatten().copied());
    let largest = all().fold(0.0, |largest: f64, energy| largest.max(energy.abs()));
    let mut chart = Chart::new(time_axis(run), axis("energy", "J", all()));
    let is_seen = |curve: &&EnergyCurve| {
        curve.energies.iter().flatten().any(|energy| energy.abs() > MIN_ENERGY_SHARE * largest)
    };
    for curve in curves.iter().filter(is_seen) {
        let point = |(row, energy): (&HistoryRow, &Option<f64>)| Some((row.time, (*energy)?));
        let points = run.iter().zip(&curve.energies).filter_map(point).collect();
        chart = chart.with(Curve::line(curve.name.clone(), points).like_curve(curve.colour));
    }
    fem_figure::panel(&chart)
}

/// Returns the relative motion and the other accounts; deformation and heat are one curve if the model does
/// not distinguish them during the contact.
fn energy_curves(run: &[HistoryRow], common: Option<f64>) -> Vec<EnergyCurve> {
    let motion =
        |row: &HistoryRow| Some(row.energy(Account::Kinetic)? - common.unwrap_or_default());
    let named = |name: &str, colour: usize, get: &dyn Fn(&HistoryRow) -> Option<f64>| EnergyCurve {
        name: name.to_string(),
        colour,
        energies: run.iter().map(get).collect(),
    };
    let name = if common.is_some() { "relative motion" } else { "motion" };
    let mut curves = vec![named(name, colour(Account::Kinetic), &motion)];
    let is_split = run.iter().all(|row| row.energy(Account::Strain).is_some());
    let is_apart = |account: Account| {
        !is_split && matches!(account, Account::Strain | Account::ViscousDissipation)
    };
    for account in Account::all().filter(|account| *account != Account::Kinetic) {
        if !is_apart(account) {
            let name = account.name().replace('_', " ");
            curves.push(named(&name, colour(account), &|row| row.energy(account)));
        }
    }
    if let (false, Some(whole)) = (is_split, run.first().and_then(motion)) {
        let rest = |row: &HistoryRow| {
            let known = row.energies.entries().filter(|(account, _)| !is_apart(*account));
            let known = known.filter(|(account, _)| *account != Account::Kinetic);
            Some(whole - motion(row)? - known.map(|(_, energy)| energy).sum::<f64>())
        };
        curves.push(named("deformation and heat", colour(Account::Strain), &rest));
    }
    curves
}

/// Returns the index of an account's colour; the page's bar of energies uses the same indices.
fn colour(account: Account) -> usize {
    match account {
        Account::Kinetic => 0,
        Account::Strain => 1,
        Account::Contact => 2,
        Account::ViscousDissipation => 3,
        Account::BulkViscosity | Account::Potential => 4,
        Account::ContactDamping | Account::LeftBefore | Account::Adhesion => 5,
        Account::Radiated
        | Account::WallWork
        | Account::PlasticWork
        | Account::Plate
        | Account::Friction
        | Account::TangentialRelaxation => 6,
    }
}

/// A chart requested by the page, of many collisions or of measured points.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChartSpec {
    /// Label of the horizontal axis: quantity and unit.
    pub x: String,
    /// Label of the vertical axis: quantity and unit.
    pub y: String,
    /// Whether the axes are logarithmic.
    #[serde(default)]
    pub logarithmic: [bool; 2],
    /// Range of the vertical axis, independent of the points.
    #[serde(default)]
    pub range: Option<(f64, f64)>,
    /// The curves in the order of the legend.
    pub curves: Vec<CurveSpec>,
}

/// A curve of such a chart.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CurveSpec {
    /// Label in the legend.
    pub label: String,
    /// One of `line`, `dashed` and `points`.
    pub mark: MarkSpec,
    /// Points (x, y).
    pub points: Vec<(f64, f64)>,
}

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MarkSpec {
    /// Points on a line, for computed values.
    Line,
    /// A dashed line, for references.
    Dashed,
    /// Points, for measured values.
    Points,
}

impl ChartSpec {
    /// Draws the chart as SVG; `None` without a point.
    pub fn svg(&self) -> Option<String> {
        let axis = |label: &str, is_logarithmic: bool| match is_logarithmic {
            true => Axis::new(label).logarithmic(),
            false => Axis::new(label),
        };
        let [x, y] = self.logarithmic;
        let vertical = match self.range {
            Some((from, to)) => axis(&self.y, y).from_to(from, to),
            None => axis(&self.y, y),
        };
        let empty = Chart::new(axis(&self.x, x), vertical);
        let chart = self.curves.iter().fold(empty, |chart, curve| {
            let mark = match curve.mark {
                MarkSpec::Line => Mark::PointsOnLine,
                MarkSpec::Dashed => Mark::Dashed,
                MarkSpec::Points => Mark::Points,
            };
            chart.with(Curve::new(&curve.label, mark, curve.points.clone()))
        });
        fem_figure::panel(&chart)
    }
}
