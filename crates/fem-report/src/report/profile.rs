//! The contact pressure over the distance from the axis, as a chart.

use fem_case::engineering::{Unit, show};
use fem_figure::{Axis, Chart, Curve};

use super::curves::telling;
use super::hertz::Hertz;
use super::record::{ContactAt, Record};

/// Where the axis ends over the largest pressure, wherever Hertz is.
const MOST_OVER_DATA: f64 = 1.2;

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
        for contact in telling(record) {
            let since = time.show(contact.time - record.first_touch());
            let label = format!("{}, {since}", instant(&contact.label));
            curves.push((curves.len(), record, contact, label));
        }
    }
    let mut of_hertz: Vec<(usize, Vec<(f64, f64)>)> = Vec::new();
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
                (r, profile.pressure(r))
            };
            of_hertz.push((k, (0..=40).map(at).collect()));
        }
    }
    let largest =
        of_hertz.iter().flat_map(|(_, points)| points).fold(0.0, |most: f64, p| most.max(p.1));
    let mut name = "dashed: Hertz under the same force".to_string();
    if largest > MOST_OVER_DATA * peak {
        name += &format!(", up to {}", show(largest, "Pa"));
    }
    // Each in the colour of what it stands beside.
    for (k, points) in of_hertz {
        let points = points.iter().map(|(r, p)| (length.scaled(*r), stress.scaled(*p))).collect();
        chart = chart.with(Curve::dashed(&name, points).like_curve(k));
    }
    Some(chart)
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

/// The contact with the largest pressure on the axis.
fn highest(record: &Record) -> Option<&ContactAt> {
    let on_axis = |contact: &ContactAt| contact.pressure.first().map_or(0.0, |p| p.1);
    record.contacts.iter().max_by(|a, b| on_axis(a).total_cmp(&on_axis(b)))
}
