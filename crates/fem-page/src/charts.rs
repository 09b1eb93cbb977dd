//! Curves of a collision over its time, as pictures that a page restyles by their classes.

use fem::{Account, Row};
use fem_case::engineering::Unit;
use fem_figure::{Axis, Chart, Curve, Mark};
use serde::{Deserialize, Serialize};

/// What the reference is called in legends.
const HERTZ: &str = "Hertz";

/// Pictures over time, as SVG; none where there is nothing to draw.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Charts {
    /// Of the contact.
    pub force: Option<String>,
    /// Of the mass centres.
    pub approach: Option<String>,
    /// Where the energy is.
    pub energy: Option<String>,
}

impl Charts {
    /// A run beside Hertz' theory of the same bodies.
    pub(crate) fn of(run: &[Row], hertz: &[Row]) -> Self {
        Self {
            force: compared(run, hertz, ("contact force", "N"), |row| row.contact_force),
            approach: compared(run, hertz, ("approach", "m"), |row| row.approach),
            energy: energy(run),
        }
    }
}

/// A unit that fits the largest of some numbers.
fn unit(numbers: impl Iterator<Item = f64>, symbol: &str) -> Unit {
    Unit::fitting(numbers.fold(0.0, |largest: f64, number| largest.max(number.abs())), symbol)
}

fn time_unit(rows: &[Row]) -> Unit {
    unit(rows.iter().map(|row| row.time), "s")
}

fn axis(name: &str, unit: &Unit) -> Axis {
    Axis::new(format!("{name} [{}]", unit.symbol()))
}

fn compared(
    run: &[Row],
    hertz: &[Row],
    (name, symbol): (&str, &str),
    get: impl Fn(&Row) -> f64,
) -> Option<String> {
    let (time, own) = (time_unit(run), unit(run.iter().map(&get), symbol));
    let points = |rows: &[Row]| {
        rows.iter().map(|row| (time.scaled(row.time), own.scaled(get(row)))).collect()
    };
    let chart = Chart::new(axis("time", &time), axis(name, &own))
        .with(Curve::line("this run", points(run)))
        .with(Curve::dashed(HERTZ, points(hertz)));
    fem_figure::panel(&chart)
}

fn energy(run: &[Row]) -> Option<String> {
    let largest = run.iter().flat_map(|row| row.energies.entries().map(|(_, energy)| energy));
    let (time, own) = (time_unit(run), unit(largest, "J"));
    let mut chart = Chart::new(axis("time", &time), axis("energy", &own));
    for account in Account::all().filter(|account| has_something(run, *account)) {
        let point = |row: &Row| Some((time.scaled(row.time), own.scaled(row.energy(account)?)));
        let points = run.iter().filter_map(point).collect();
        let curve = Curve::line(account.name().replace('_', " "), points);
        chart = chart.with(curve.like_curve(colour(account)));
    }
    fem_figure::panel(&chart)
}

/// Which colour of charts an account has: the page's bar of energies has the same.
fn colour(account: Account) -> usize {
    match account {
        Account::Kinetic => 0,
        Account::Strain => 1,
        Account::Contact => 2,
        Account::ViscousDissipation => 3,
        Account::BulkViscosity | Account::Potential => 4,
        Account::ContactDamping | Account::LeftBefore => 5,
        Account::Radiated | Account::WallWork => 6,
    }
}

/// Whether a run puts more than a thousandth of its energy into an account.
fn has_something(run: &[Row], account: Account) -> bool {
    const LEAST: f64 = 1e-3;
    let all = || run.iter().flat_map(|row| row.energies.entries());
    let largest = all().fold(0.0, |largest: f64, (_, energy)| largest.max(energy.abs()));
    all().any(|(other, energy)| other == account && energy.abs() > LEAST * largest)
}

/// A chart that a page asks for: of many collisions, of measured points.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChartSpec {
    /// Horizontal axis: quantity and unit.
    pub x: String,
    /// Vertical axis: quantity and unit.
    pub y: String,
    /// Whether the axes are logarithmic.
    #[serde(default)]
    pub logarithmic: [bool; 2],
    /// From where to where the vertical axis goes, whatever the points.
    #[serde(default)]
    pub range: Option<(f64, f64)>,
    /// In the order of the legend.
    pub curves: Vec<CurveSpec>,
}

/// A curve of it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CurveSpec {
    /// In the legend.
    pub label: String,
    /// `line`, `dashed` or `points`.
    pub mark: MarkSpec,
    /// (x, y).
    pub points: Vec<(f64, f64)>,
}

/// How it is drawn.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MarkSpec {
    /// Points on a line: what was computed.
    Line,
    /// What it is compared with.
    Dashed,
    /// What was measured.
    Points,
}

impl ChartSpec {
    /// As SVG; `None` without a point.
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
