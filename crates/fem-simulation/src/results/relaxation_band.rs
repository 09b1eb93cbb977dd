//! The frequencies of a contact beside those at which the moduli of its bodies are measured.
//!
//! A contact of duration T is like half a period of the frequency 1/(2T), and a term changes the loss up to about a decade on either
//! side of it. Where the measured band ends within that range, the series may go on: between not at all and by the mean weight per
//! decade of the last two measured decades. The restitution is computed for both ends. Values that are evenly spread between
//! them have the root mean square distance |Δ|/√3 from the first, which is the series of the case (JCGM 100:2008, 4.3.7); that is
//! its uncertainty by what is not measured.
//!
//! Within the band the scatter of the moduli makes the loss uncertain: the restitution is computed for a loss smaller by its standard
//! uncertainty at the frequency of the contact.
//!
//! Faster terms add to the instantaneous modulus; slower ones are part of the equilibrium modulus.

use std::f64::consts::TAU;

use fem_case::engineering::{Unit, number, range, show};
use fem_case::schema::TermTable;
use fem_case::{Body, Case, Scene};
use fem_material::{ActsOn, Material, ZERO_CELSIUS};

use crate::results::summary::RelaxationCoverage;

/// Decades on either side of the frequency of a contact within which a term matters.
const REACH: f64 = 10.0;
/// Most terms that are added.
const MAX_TERMS: usize = 16;
/// A frequency that instruments have, Hz.
const INSTRUMENT_FREQUENCY: f64 = 10.0;
/// Share by which the modulus of a material may differ from that of its data.
const MAX_DIFFERENCE: f64 = 0.05;
/// Measured decades that say how a series may go on.
const LAST_DECADES: i32 = 2;

/// Terms beyond the measured band: their largest weights over the instantaneous modulus, and their relaxation times, s.
#[derive(Clone, Debug)]
pub struct SeriesTail {
    /// Terms that are faster than the measured ones.
    pub faster: Vec<(f64, f64)>,
    /// Terms that are slower.
    pub slower: Vec<(f64, f64)>,
}

impl SeriesTail {
    /// Returns the lowest and the highest frequency (Hz) that matter to a contact (s).
    pub fn frequencies(contact_time: f64) -> [f64; 2] {
        let middle = 0.5 / contact_time;
        [middle / REACH, middle * REACH]
    }

    /// Returns the terms by which a series that is measured in a band (Hz) may go on within the frequencies that are needed; `None` if
    /// the material does not relax.
    pub fn of(
        material: &Material,
        [lowest, highest]: [f64; 2],
        [from, to]: [f64; 2],
    ) -> Option<Self> {
        let series = material.relaxation()?;
        let per_decade = |is_last: &dyn Fn(f64) -> bool| {
            let terms = series.terms().iter().filter(|term| is_last(term.relaxation_time));
            terms.map(|term| term.weight).sum::<f64>() / f64::from(LAST_DECADES)
        };
        let width = 10f64.powi(LAST_DECADES);
        let count = |ratio: f64| (ratio.log10().ceil().max(0.0) as usize).min(MAX_TERMS);
        let at = |k: usize| 10f64.powf(k as f64 + 0.5);
        let fast = per_decade(&|time| time < width / (TAU * to));
        let faster = (0..count(highest / to)).map(|k| (fast, 1.0 / (TAU * to * at(k)))).collect();
        let n_slow = count(from / lowest);
        let slow = per_decade(&|time| time > 1.0 / (TAU * from * width));
        let slow = slow.min(series.equilibrium_weight() / n_slow.max(1) as f64);
        let slower = (0..n_slow).map(|k| (slow, at(k) / (TAU * from))).collect();
        Some(Self { faster, slower })
    }

    fn is_empty(&self) -> bool {
        self.faster.iter().chain(&self.slower).all(|term| term.0 <= 0.0)
    }
}

/// Returns the cases by whose change the relaxation of a body is uncertain, with the standard uncertainty over that change.
pub(super) fn variants(case: &Case, side: usize, contact_time: f64) -> Vec<(Case, f64)> {
    let tail = with_tail(case, side, contact_time).map(|case| (case, 3f64.sqrt().recip()));
    tail.into_iter()
        .chain(with_less_loss(case, side, contact_time).map(|case| (case, 1.0)))
        .collect()
}

/// Returns the case with the weights, and so the loss, of a body's material smaller by their uncertainty; `None` if it is 0.
fn with_less_loss(case: &Case, side: usize, contact_time: f64) -> Option<Case> {
    let body = &case.scene().bodies()[side];
    let (series, measured) = (body.material()?.relaxation()?, body.measured()?);
    let uncertainty = uncertainty_at(&measured.loss_uncertainty, 0.5 / contact_time)?;
    let factor = 10f64.powf(measured.log10_shift());
    let share = 1.0 - uncertainty;
    let terms = series.terms().iter().map(|term| {
        TermTable::with_relaxation_time(share * term.weight, term.relaxation_time / factor)
    });
    let terms: Vec<TermTable> = terms.collect();
    let name = case.file().body.get(side)?.material.clone()?;
    let edited = case.edited(|file| {
        let table = file.material.get_mut(&name).and_then(|table| table.relaxation.as_mut());
        if let Some(relaxation) = table {
            relaxation.terms = terms;
        }
    });
    edited.ok()
}

/// Returns the value at a frequency of a table over frequencies: linear in the logarithm, constant beyond its ends; `None` without rows.
fn uncertainty_at(rows: &[(f64, f64)], frequency: f64) -> Option<f64> {
    let k = rows.partition_point(|row| row.0 < frequency);
    match (k.checked_sub(1).and_then(|k| rows.get(k)), rows.get(k)) {
        (Some(below), Some(above)) => {
            let share = (frequency / below.0).ln() / (above.0 / below.0).ln();
            Some(below.1 + share * (above.1 - below.1))
        }
        (below, above) => Some(below.or(above)?.1),
    }
}

/// Returns the case with the series of a body's material going on beyond the measured band; `None` if the band covers the
/// contact.
fn with_tail(case: &Case, side: usize, contact_time: f64) -> Option<Case> {
    let body = &case.scene().bodies()[side];
    let (material, measured) = (body.material()?, body.measured()?);
    let tail =
        SeriesTail::of(material, SeriesTail::frequencies(contact_time), measured.frequencies?)?;
    if tail.is_empty() {
        return None;
    }
    let series = material.relaxation()?;
    // The times of the case hold at its reference temperature.
    let factor = 10f64.powf(measured.log10_shift());
    let whole = 1.0 + tail.faster.iter().map(|term| term.0).sum::<f64>();
    let own = series.terms().iter().map(|term| (term.weight, term.relaxation_time));
    let terms = own
        .chain(tail.faster)
        .chain(tail.slower)
        .map(|(weight, time)| TermTable::with_relaxation_time(weight / whole, time / factor));
    let terms: Vec<TermTable> = terms.collect();
    let moduli = material.instantaneous();
    let shear = whole * moduli.shear_modulus();
    let bulk = match series.acts_on() {
        ActsOn::All => whole * moduli.bulk_modulus(),
        ActsOn::Shear => moduli.bulk_modulus(),
    };
    let name = case.file().body.get(side)?.material.clone()?;
    let edited = case.edited(|file| {
        let Some(table) = file.material.get_mut(&name) else { return };
        (table.youngs_modulus, table.poissons_ratio) = (None, None);
        (table.shear_modulus, table.bulk_modulus) = (Some(shear.into()), Some(bulk.into()));
        if let Some(relaxation) = &mut table.relaxation {
            relaxation.terms = terms;
        }
    });
    edited.ok()
}

/// Returns the warnings about materials whose moduli are not measured at all frequencies of the contact, or are not those of the data.
pub(super) fn band_warnings(scene: &Scene, contact_time: f64) -> Vec<String> {
    let mut warnings: Vec<String> = scene
        .bodies()
        .iter()
        .flat_map(|body| {
            let coverage = coverage_of(body, contact_time);
            [coverage.and_then(|coverage| coverage.warning), modulus_warning(body)]
        })
        .flatten()
        .collect();
    warnings.dedup();
    warnings
}

fn modulus_warning(body: &Body) -> Option<String> {
    let (measured, moduli) = (body.measured()?, body.material()?.instantaneous());
    let (key, of_data, own) = match (measured.youngs_modulus, measured.shear_modulus) {
        (Some(young), _) => ("youngs_modulus", young, moduli.youngs_modulus()),
        (None, shear) => ("shear_modulus", shear?, moduli.shear_modulus()),
    };
    ((own / of_data - 1.0).abs() > MAX_DIFFERENCE).then(|| {
        format!(
            "the {key} of {} is {}, but that of the data of its relaxation {}; set {key} of the material to that, unless the material is \
             another one",
            body.name(),
            show(own, "Pa"),
            show(of_data, "Pa")
        )
    })
}

/// Returns the coverage of the body whose data cover least of the frequencies of the contact; `None` without such data.
pub(super) fn least_coverage(scene: &Scene, contact_time: f64) -> Option<RelaxationCoverage> {
    let all = scene.bodies().iter().filter_map(|body| coverage_of(body, contact_time));
    all.min_by(|a, b| a.decades_inside.total_cmp(&b.decades_inside))
}

fn coverage_of(body: &Body, contact_time: f64) -> Option<RelaxationCoverage> {
    let [lowest, highest] = SeriesTail::frequencies(contact_time);
    let measured = body.measured()?;
    let [from, to] = measured.frequencies?;
    let decades = |from: f64, to: f64| (to / from).log10().max(0.0);
    let inside = decades(from.max(lowest), to.min(highest));
    let needed = decades(lowest, highest);
    let of =
        |warning| RelaxationCoverage { decades_inside: inside, decades_needed: needed, warning };
    if from <= lowest && to >= highest {
        return Some(of(None));
    }
    let celsius = |kelvin: f64| format!("{:.0} degC", kelvin - ZERO_CELSIUS);
    let kelvin = measured.temperature.or(measured.reference_temperature);
    let at = kelvin.map_or(String::new(), |kelvin| format!(" at {}", celsius(kelvin)));
    let is_fast = to < highest;
    let (side, wanted) = if is_fast { ("up to", highest) } else { ("from", lowest) };
    // An instrument's frequency at this temperature is the wanted one at that of the body.
    let temperature_for = |wanted: f64| {
        let log10 = measured.log10_shift() + (wanted / INSTRUMENT_FREQUENCY).log10();
        measured.shift.as_ref()?.temperature(log10, measured.reference_temperature?)
    };
    let or = match temperature_for(wanted) {
        Some(kelvin) => format!("{INSTRUMENT_FREQUENCY} Hz at {}", celsius(kelvin)),
        None => format!("at {} temperatures", if is_fast { "lower" } else { "higher" }),
    };
    let hertz = |value: f64| {
        let unit = Unit::fitting(value, "Hz");
        format!("{} {}", number(unit.scaled(value), 2), unit.symbol())
    };
    let end =
        if is_fast { format!("end at {}", hertz(to)) } else { format!("begin at {}", hertz(from)) };
    Some(of(Some(format!(
        "this contact needs moduli of {} at {}, and the data {end}{at} (± input has the extrapolation): measure {side} {}, or {or}",
        body.name(),
        range([lowest, highest], "Hz"),
        hertz(wanted)
    ))))
}
