//! What a result has over time, as charts: of one result beside Hertz, of several over each other.

use fem_case::engineering::Unit;
use fem_figure::{Axis, Chart, Curve, GREY};

use super::hertz::{Hertz, HertzInstant};
use super::record::Record;

/// Of one result no more profiles of the pressure than eyes tell apart.
const MOST_PROFILES: usize = 4;
/// What is less than this share of the largest energy is no curve.
const FAINT: f64 = 2e-3;
/// Where a profile's axis ends over the largest pressure, wherever Hertz is.
const MOST_OVER_DATA: f64 = 1.2;
/// How far beyond the contact time goes.
const BEYOND: f64 = 0.06;

/// One quantity over time.
#[derive(Clone, Copy)]
pub enum Quantity {
    Force,
    Approach,
    Radius,
    Pressure,
}

impl Quantity {
    pub const ALL: [Self; 4] = [Self::Force, Self::Approach, Self::Radius, Self::Pressure];

    fn column(self) -> &'static str {
        match self {
            Self::Force => "contact_force_n",
            Self::Approach => "approach_m",
            Self::Radius => "contact_radius_m",
            Self::Pressure => "centre_pressure_pa",
        }
    }

    fn label(self) -> (&'static str, &'static str) {
        match self {
            Self::Force => ("Contact force F", "N"),
            Self::Approach => ("Approach δ", "m"),
            Self::Radius => ("Contact radius a", "m"),
            Self::Pressure => ("Pressure on the axis p_0", "Pa"),
        }
    }

    fn of_hertz(self, hertz: &Hertz, instant: &HertzInstant) -> f64 {
        match self {
            Self::Force => instant.force,
            Self::Approach => instant.approach,
            Self::Radius => instant.contact_radius,
            Self::Pressure => hertz.pressure(instant.approach).peak_pressure,
        }
    }
}

/// Times of results as one axis has them: since first touch, up to a little after the last.
struct Clock {
    unit: Unit,
    end: f64,
}

impl Clock {
    fn of(records: &[Record], hertz: Option<&Hertz>) -> Self {
        let ends = records.iter().map(|record| record.last_touch() - record.first_touch());
        let hertz = hertz.and_then(|hertz| Some(hertz.history().last()?.time));
        let end = (1.0 + BEYOND) * ends.chain(hertz).fold(0.0, f64::max);
        Self { unit: Unit::fitting(end, "s"), end }
    }

    fn axis(&self) -> Axis {
        let end = self.unit.scaled(self.end);
        Axis::new(format!("time since first touch t [{}]", self.unit.symbol())).from_to(0.0, end)
    }

    /// A column over the time since first touch.
    fn points(&self, record: &Record, values: &[f64], unit: &Unit) -> Vec<(f64, f64)> {
        let start = record.first_touch();
        let times = record.history.get("time_s").iter();
        let points = times.zip(values).map(|(time, value)| (time - start, *value));
        let within =
            points.filter(|(time, value)| (0.0..=self.end).contains(time) && value.is_finite());
        within.map(|(time, value)| (self.unit.scaled(time), unit.scaled(value))).collect()
    }
}

/// Hertz of all of them, if it is the same.
fn common_hertz(records: &[Record]) -> Option<Hertz> {
    let of = |record: &Record| record.summary.get("hertz").cloned();
    let first = of(records.first()?)?;
    let is_common = records.iter().all(|record| of(record).as_ref() == Some(&first));
    Hertz::of(records.first()?).filter(|_| is_common)
}

/// A quantity over time; `None` if no result has it.
pub fn over_time(records: &[Record], quantity: Quantity) -> Option<Chart> {
    let hertz = common_hertz(records);
    let clock = Clock::of(records, hertz.as_ref());
    let (name, symbol) = quantity.label();
    let all = records.iter().flat_map(|record| record.history.get(quantity.column()));
    let largest = all.filter(|value| value.is_finite()).fold(0.0, |most: f64, v| most.max(v.abs()));
    if largest == 0.0 {
        return None;
    }
    let unit = Unit::fitting(largest, symbol);
    let mut chart = Chart::new(clock.axis(), Axis::new(format!("{name} [{}]", unit.symbol())));
    for (k, record) in records.iter().enumerate() {
        let label = if records.len() == 1 { "this run" } else { &record.name };
        let points = clock.points(record, record.history.get(quantity.column()), &unit);
        chart = chart.with(Curve::line(label, points).like_curve(k));
        if records.len() == 1 {
            let start = record.first_touch();
            let at = |time: f64| {
                let value = record.history.at(quantity.column(), time);
                (clock.unit.scaled(time - start), unit.scaled(value))
            };
            let times = some(&record.contacts, MOST_PROFILES).map(|contact| contact.time);
            let dots: Vec<_> = times.map(at).filter(|(_, value)| value.is_finite()).collect();
            chart = chart.with(Curve::points("", dots).like_curve(k));
        }
    }
    if let Some(hertz) = &hertz {
        let history = hertz.history();
        let point = |at: &HertzInstant| {
            (clock.unit.scaled(at.time), unit.scaled(quantity.of_hertz(hertz, at)))
        };
        let points = history.iter().map(point).collect();
        chart = chart.with(Curve::dashed("Hertz", points).coloured(GREY));
    }
    Some(chart)
}

/// Where the energy of a result is; `None` if its history does not tell.
pub fn energies(record: &Record) -> Option<Chart> {
    let hertz = Hertz::of(record);
    let clock = Clock::of(std::slice::from_ref(record), hertz.as_ref());
    let accounts: Vec<&String> = record
        .history
        .names()
        .iter()
        .filter(|name| name.ends_with("_j") && *name != "residual_j")
        .collect();
    let size = |name: &str| {
        let values = record.history.get(name).iter().filter(|value| value.is_finite());
        values.fold(0.0, |most: f64, value| most.max(value.abs()))
    };
    let largest = accounts.iter().map(|name| size(name)).fold(0.0, f64::max);
    if largest == 0.0 {
        return None;
    }
    let unit = Unit::fitting(largest, "J");
    let mut chart = Chart::new(clock.axis(), Axis::new(format!("Energy E [{}]", unit.symbol())));
    let shown = accounts.into_iter().filter(|name| size(name) > FAINT * largest);
    for (k, name) in shown.enumerate() {
        let label = match name.trim_end_matches("_j") {
            "viscous_dissipation" => "dissipated".to_string(),
            "contact" => "contact springs".to_string(),
            other => other.replace('_', " "),
        };
        let points = clock.points(record, record.history.get(name), &unit);
        chart = chart.with(Curve::line(label, points).like_curve(k));
    }
    if let Some(hertz) = &hertz {
        let point = |at: &HertzInstant| (clock.unit.scaled(at.time), unit.scaled(at.energy));
        let points = hertz.history().iter().map(point).collect();
        chart = chart.with(Curve::dashed("strain of Hertz", points).coloured(GREY));
    }
    Some(chart)
}

/// The contact pressure over the distance from the axis at some snapshots, each beside Hertz' under the same
/// force; of several results that at the largest approach.
pub fn pressures(records: &[Record]) -> Option<Chart> {
    let contacts = || records.iter().flat_map(|record| &record.contacts);
    let points = || contacts().flat_map(|contact| &contact.pressure);
    let (reach, peak) = points().fold((0.0f64, 0.0f64), |(r, p), at| (r.max(at.0), p.max(at.1)));
    if !(reach > 0.0 && peak > 0.0) {
        return None;
    }
    let (length, stress) = (Unit::fitting(reach, "m"), Unit::fitting(peak, "Pa"));
    let x = Axis::new(format!("distance from the axis r [{}]", length.symbol()));
    let y = Axis::new(format!("Contact pressure p [{}]", stress.symbol()));
    let mut chart = Chart::new(x, y.from_to(0.0, MOST_OVER_DATA * stress.scaled(peak)));
    let mut curves = Vec::new();
    for (k, record) in records.iter().enumerate() {
        let time = Unit::fitting(record.last_touch() - record.first_touch(), "s").with_digits(3);
        if records.len() > 1 {
            let of_record = |contact| (k, record, contact, record.name.clone());
            curves.extend(highest(record).map(of_record));
            continue;
        }
        for contact in some(&record.contacts, MOST_PROFILES) {
            let since = time.show(contact.time - record.first_touch());
            let label = format!("{}, {since}", instant(&contact.label));
            curves.push((curves.len(), record, contact, label));
        }
    }
    let mut of_hertz = Vec::new();
    for (k, record, contact, label) in curves {
        let scaled = |(r, p): &(f64, f64)| (length.scaled(*r), stress.scaled(*p));
        let own = contact.pressure.iter().map(scaled).collect();
        chart = chart.with(Curve::line(label, own).like_curve(k));
        if records.len() == 1 {
            let nodes = contact.at_nodes.iter().map(scaled).collect();
            chart = chart.with(Curve::points("", nodes).like_curve(k));
        }
        let force = record.history.at("contact_force_n", contact.time);
        if let Some(hertz) = Hertz::of(record).filter(|_| force > 0.0) {
            let profile = hertz.pressure_under(force);
            let at = |k: u32| {
                // Closer together toward the edge, where the profile is steep.
                let r = (std::f64::consts::FRAC_PI_2 * f64::from(k) / 40.0).sin()
                    * profile.contact_radius;
                scaled(&(r, profile.pressure(r)))
            };
            of_hertz.push((0..=40).map(at).collect());
        }
    }
    let curve = |points| Curve::dashed("Hertz under the same force", points).coloured(GREY);
    Some(of_hertz.into_iter().map(curve).fold(chart, Chart::with))
}

/// What a snapshot is called.
pub fn instant(label: &str) -> &str {
    match label {
        "last-contact" => "last contact",
        "last-sound" => "last sound state",
        "even" | "time" => "snapshot",
        other => other,
    }
}

/// Of several instants so many, the first and the last among them.
fn some<T>(all: &[T], most: usize) -> impl Iterator<Item = &T> {
    let n = all.len().min(most);
    (0..n).filter_map(move |k| all.get(k * (all.len() - 1) / (n - 1).max(1)))
}

/// The contact with the largest pressure on the axis.
fn highest(record: &Record) -> Option<&super::record::ContactAt> {
    let on_axis =
        |contact: &super::record::ContactAt| contact.pressure.first().map_or(0.0, |p| p.1);
    record.contacts.iter().max_by(|a, b| on_axis(a).total_cmp(&on_axis(b)))
}
