//! The roles and the units of columns by their names: `speed_cm_s`, `alpha_deg`. Lists of names are texts with a blank between
//! two names, the preferred one first.

use std::f64::consts::PI;
use std::sync::LazyLock;

use fem_case::parse_quantity;

use super::rebounds::REBOUNDS;

/// The end of a column's name that is a unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct UnitSuffix {
    /// The ending with its underscore.
    pub text: &'static str,
    /// Factor from this unit to SI.
    pub scale: f64,
    /// Exponents of metre, kilogram, second.
    pub dimension: [i32; 3],
}

/// Endings with the units that they stand for. If two fit the same name, the longer one comes first. A name that ends in `_min` may
/// be a least value. Scales of temperature have an offset, which their reader adds.
const ENDINGS: &str = "_cm_s=cm/s _mm_s=mm/s _um_s=um/s _km_h=km/h _ft_s=ft/s _in_s=in/s _mph=mph _m_s=m/s \
    _hz=Hz _rad_s=rad/s _per_s=1/s _rpm=rpm _us=us _ms=ms _ns=ns _s=s _deg=deg _mrad=1e-3 _khz=kHz _rad=rad \
    _percent=% _mm=mm _cm=cm _um=um _m=m _kn=kN _mn=mN _n=N _newton=N _pa=Pa _kpa=kPa _mpa=MPa _gpa=GPa \
    _psi=psi _ksi=ksi _dyn_cm2=dyn/cm^2 _minutes=min _hours=h _px=px _pixel=px _pixels=px _degc= _degf= _kelvin=";

static SUFFIXES: LazyLock<Vec<UnitSuffix>> = LazyLock::new(|| {
    let suffix = |entry: &'static str| {
        let (text, unit) = entry.split_once('=').unwrap_or((entry, ""));
        let (scale, dimension) = match unit {
            // A rate of phase counts in cycles per second, like a frequency.
            "rad/s" => (0.5 / PI, [0, 0, -1]),
            "rpm" => (1.0 / 60.0, [0, 0, -1]),
            // The scale of a picture is not in its names.
            "px" => (1.0, PIXELS),
            "1e-3" => (1e-3, [0; 3]),
            _ => {
                let found = parse_quantity(&format!("1 {unit}"));
                found.map_or((1.0, [0; 3]), |(scale, it)| (scale, [it.0[0], it.0[1], it.0[2]]))
            }
        };
        UnitSuffix { text, scale, dimension }
    };
    ENDINGS.split(' ').map(suffix).collect()
});

/// Exponents of a length in pixels, which is of no dimension of a table.
const PIXELS: [i32; 3] = [1, 0, 1];
/// The ending of newton, which is a part of the name where no force can stand: `e_n`.
const NEWTON: &str = "_n";
/// Names of forces, and how others begin.
const FORCES: &str = "f fn fmax fz fy f_max f_peak n";
const FORCE_WORDS: [&str; 3] = ["force", "load", "kraft"];
/// Exponents of a pressure.
pub(super) const PRESSURE: [i32; 3] = [-1, 1, -2];

/// Endings of names with units, separated by bars, that the units of a case do not have or that mean another there.
const OTHER_UNITS: [(&str, &str); 10] = [
    ("_rad_s", "rad/s|rad s^-1|rad·s⁻¹"),
    ("_per_s", "1/s|s^-1|s⁻¹"),
    ("_rpm", "rpm"),
    ("_degc", "C|°C|º C|ºC|degC"),
    ("_kelvin", "K"),
    ("_degf", "°F|degF|F"),
    ("_dyn_cm2", "dyne/cm^2|dyne/cm²|dyne/cm2"),
    ("_hours", "hr"),
    ("_px", "px|pixel|pixels"),
    ("_s", "second|seconds|sec"),
];

/// Whether a name is one of a list.
pub(crate) fn is_one_of(name: &str, names: &str) -> bool {
    names.split(' ').any(|known| known == name)
}

/// Returns the ending of a unit that cases do not have.
pub(super) fn other_ending(unit: &str) -> Option<&'static str> {
    let is_it = |(_, units): &&(_, &str)| units.split('|').any(|known| known == unit);
    OTHER_UNITS.iter().find(is_it).map(|(ending, _)| *ending)
}

/// Returns the unit in which a column's name ends.
pub(super) fn ending_of(header: &str) -> Option<UnitSuffix> {
    SUFFIXES.iter().copied().find(|ending| ending.before(header).is_some())
}

impl UnitSuffix {
    /// Whether the unit is a pixel.
    pub fn is_pixel(self) -> bool {
        self.dimension == PIXELS
    }

    /// Returns what is before this ending of a name.
    fn before(self, header: &str) -> Option<&str> {
        let name = header.strip_suffix(self.text)?;
        (self.text != NEWTON || is_force(name)).then_some(name)
    }
}

fn is_force(name: &str) -> bool {
    is_one_of(name, FORCES) || FORCE_WORDS.iter().any(|word| name.contains(word))
}

/// Returns a name with the ending of a unit.
pub(super) fn with_ending(name: &str, ending: &str) -> String {
    let is_unclear = ending == NEWTON && !is_force(name);
    format!("{name}{}", if is_unclear { "_newton" } else { ending })
}

/// Returns the ending of a name that stands for a unit.
pub(super) fn ending_of_unit(unit: &str) -> Option<&'static str> {
    if let Some(ending) = other_ending(unit) {
        return Some(ending);
    }
    let (scale, dimension) = parse_quantity(&format!("1 {unit}")).ok()?;
    let is_it = |ending: &&UnitSuffix| {
        let [m, kg, s] = ending.dimension;
        (ending.scale / scale - 1.0).abs() < 1e-9 && dimension.0 == [m, kg, s, 0]
    };
    SUFFIXES.iter().find(is_it).map(|ending| ending.text)
}

/// Returns a name without the ending of its unit.
pub(crate) fn bare(header: &str) -> &str {
    ending_of(header).and_then(|ending| ending.before(header)).unwrap_or(header)
}

/// Whether the name of a column is one of these and a number, `stop_2`; the first instant of a row is `start`.
pub(crate) fn is_numbered(header: &str, names: &str) -> bool {
    let bare = bare(header);
    let name = bare.trim_end_matches(|c: char| c.is_ascii_digit() || c == '#');
    (name.len() < bare.len() || name == "start") && is_one_of(name.trim_end_matches('_'), names)
}

/// Returns a name without a unit in brackets, which it keeps if no column has that unit: `voltage [V]`.
pub(super) fn before_brackets(header: &str) -> &str {
    header.split(['[', '(']).next().unwrap_or_default().trim_end_matches('_')
}

/// Returns a name and all names that it may be without a unit at its end: `speed_m_s` is `speed` in m/s, or
/// `speed_m` in s.
pub(super) fn readings(header: &str) -> impl Iterator<Item = &str> {
    let bare = SUFFIXES.iter().filter_map(|ending| ending.before(header));
    std::iter::once(header).chain(bare)
}

pub(super) const SPEEDS: &str = "speed approach_speed impact_speed relative_speed incident_speed velocity impact_velocity \
    relative_velocity incident_velocity v v_n vn normal_velocity normal_speed speed_before velocity_before v_before v_in";
/// Names of columns of heights from which a body falls on the other one, most certain first.
pub(crate) const DROP_HEIGHTS: [&str; 2] = [
    "drop_height release_height initial_height start_height fall_height height_of_fall height_of_drop h0 h_0 h_drop",
    "height h h1 h_1",
];
/// Names of columns of heights to which it rebounds.
pub(super) const REBOUND_HEIGHTS: [&str; 2] = [
    "rebound_height bounce_height height_of_bounce height_of_rebound rebound bounce return_height final_height h_rebound \
     h2 h_2",
    "h1 h_1",
];
/// Names of columns of speeds after impacts.
pub(super) const REBOUND_SPEEDS: &str = "rebound_speed rebound_velocity speed_after velocity_after v_after v_out v_rebound exit_velocity";
pub(crate) const RESTITUTIONS: &str = "restitution coefficient_of_restitution restitution_coefficient cor e e_n en normal_restitution";
/// Uncertainties whose names do not say of what.
const UNCERTAINTIES: &str = "uncertainty sigma σ standard_error standard_deviation std stdev std.dev. std._dev. sd s.d. err error";
/// The first parts of a sweep's dotted keys: the tables of a case.
const KEY_TABLES: &str =
    "material body start gravity stop mesh contact time output model accuracy effects limits";
/// Signs that part a value from its uncertainty.
pub(super) const SIGNS: [&str; 3] = ["±", "+/-", "+-"];

/// Returns whether a column has the values of a key that a sweep varies: `body.0.approach_speed`.
pub(super) fn is_key(header: &str) -> bool {
    header.split_once('.').is_some_and(|(table, _)| is_one_of(table, KEY_TABLES))
}

/// Returns the name of the column of a column's uncertainty: `speed_uncertainty_cm_s` for `speed_cm_s`.
pub(super) fn uncertainty_of(header: &str) -> String {
    let unit = ending_of(header).map_or("", |unit| unit.text);
    format!("{}_uncertainty{unit}", header.strip_suffix(unit).unwrap_or(header))
}
/// Words before the name of a quantity that make it the uncertainty of the quantity: `delta e`, `u(e)`, `± e`.
const BEFORE: &str = "± +- +/- delta δ d u sigma σ std error";
/// Words after it: `e_err`.
const AFTER: &str = "uncertainty unc err error sigma std standard_error ±";

/// Returns all names of the uncertainty of a restitution, the preferred one first.
pub(super) fn uncertainties() -> &'static str {
    static NAMES: LazyLock<String> = LazyLock::new(|| {
        let of = |name: &str| {
            let after = AFTER.split(' ').map(|word| format!("{name}_{word}"));
            let before = BEFORE.split(' ').flat_map(|word| {
                [format!("{word}_{name}"), format!("{word}{name}"), format!("{word}({name})")]
            });
            after.chain(before).collect::<Vec<_>>().join(" ")
        };
        RESTITUTIONS
            .split(' ')
            .map(of)
            .chain([UNCERTAINTIES.to_string()])
            .collect::<Vec<_>>()
            .join(" ")
    });
    &NAMES
}

pub(super) const CONTACT_TIMES: &str = "contact_time t_contact";
/// Columns that identify the lower and the upper body; a sweep's own names come last.
pub(super) const DIAMETERS: [&str; 2] =
    ["diameter_1 body.0.sphere.diameter", "diameter_2 body.1.sphere.diameter"];

/// Names of a column of frequencies.
pub(super) const FREQUENCIES: &str = "frequency f freq freq. ν";
/// Names of a column of angular frequencies, which are in rad/s without a unit.
pub(super) const ANGULAR_FREQUENCIES: &str =
    "angular_frequency omega ω w angular_freq ang._freq. ang._frequency";
/// Names of a column of temperatures, in °C without a unit.
pub(super) const TEMPERATURES: &str = "temperature temp temp. t θ t_mean";

/// Returns all names that a column may have, without units; among synonyms the preferred name comes first.
pub(super) fn column_names() -> Vec<&'static str> {
    let names = [
        SPEEDS,
        "drop_height rebound_height rebound_speed",
        RESTITUTIONS,
        "restitution_uncertainty",
        UNCERTAINTIES,
        CONTACT_TIMES,
        "diameter_1 diameter_2",
        // Trials of a cradle, records, and moduli.
        "alpha beta alpha_uncertainty beta_uncertainty",
        "time time_uncertainty height height_uncertainty force signal",
        "frequency angular_frequency temperature storage_modulus loss_modulus complex_modulus relaxation_modulus tan_delta \
         phase e g",
        REBOUNDS,
    ];
    names.iter().flat_map(|names| names.split(' ')).collect()
}
