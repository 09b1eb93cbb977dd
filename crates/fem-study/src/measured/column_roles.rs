//! The roles and the units of columns by their names: `speed_cm_s`, `alpha_deg`.

use std::f64::consts::PI;
use std::sync::LazyLock;

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

const fn ending(text: &'static str, scale: f64, dimension: [i32; 3]) -> UnitSuffix {
    UnitSuffix { text, scale, dimension }
}

/// If two endings fit the same name, the longer one comes first.
const ENDINGS: [UnitSuffix; 23] = [
    ending("_cm_s", 1e-2, [1, 0, -1]),
    ending("_mm_s", 1e-3, [1, 0, -1]),
    ending("_um_s", 1e-6, [1, 0, -1]),
    ending("_km_h", 1.0 / 3.6, [1, 0, -1]),
    ending("_ft_s", 0.3048, [1, 0, -1]),
    ending("_in_s", 0.0254, [1, 0, -1]),
    ending("_mph", 0.44704, [1, 0, -1]),
    ending("_m_s", 1.0, [1, 0, -1]),
    ending("_us", 1e-6, [0, 0, 1]),
    ending("_ms", 1e-3, [0, 0, 1]),
    ending("_ns", 1e-9, [0, 0, 1]),
    ending("_s", 1.0, [0, 0, 1]),
    ending("_deg", PI / 180.0, [0; 3]),
    ending("_mrad", 1e-3, [0; 3]),
    ending("_rad", 1.0, [0; 3]),
    ending("_percent", 1e-2, [0; 3]),
    ending("_mm", 1e-3, [1, 0, 0]),
    ending("_cm", 1e-2, [1, 0, 0]),
    ending("_um", 1e-6, [1, 0, 0]),
    ending("_m", 1.0, [1, 0, 0]),
    ending("_kn", 1e3, [1, 1, -2]),
    ending("_mn", 1e-3, [1, 1, -2]),
    ending("_n", 1.0, [1, 1, -2]),
];

/// Returns the unit in which a column's name ends.
pub(super) fn ending_of(header: &str) -> Option<UnitSuffix> {
    ENDINGS.into_iter().find(|ending| header.ends_with(ending.text))
}

/// Returns the ending of a unit, given by its factor to SI and its dimension (metre, kilogram, second, byte).
pub(super) fn ending_like(scale: f64, dimension: [i32; 4]) -> Option<UnitSuffix> {
    let [m, kg, s, bytes] = dimension;
    ENDINGS.into_iter().find(|ending| {
        let is_scale = (ending.scale / scale - 1.0).abs() < 1e-9;
        is_scale && ending.dimension == [m, kg, s] && bytes == 0
    })
}

/// Returns a name without the ending of its unit.
pub(super) fn bare(header: &str) -> &str {
    ENDINGS.iter().find_map(|ending| header.strip_suffix(ending.text)).unwrap_or(header)
}

/// Returns a name and all names that it may be without a unit at its end: `speed_m_s` is `speed` in m/s, or
/// `speed_m` in s.
pub(super) fn readings(header: &str) -> impl Iterator<Item = &str> {
    let bare = ENDINGS.iter().filter_map(|ending| header.strip_suffix(ending.text));
    std::iter::once(header).chain(bare)
}

pub(super) const SPEEDS: [&str; 10] = [
    "speed",
    "approach_speed",
    "impact_speed",
    "relative_speed",
    "incident_speed",
    "velocity",
    "impact_velocity",
    "relative_velocity",
    "incident_velocity",
    "v",
];
pub(super) const RESTITUTIONS: [&str; 5] =
    ["restitution", "coefficient_of_restitution", "restitution_coefficient", "cor", "e"];
/// Uncertainties whose names do not say of what.
const UNCERTAINTIES: [&str; 13] = [
    "uncertainty",
    "sigma",
    "σ",
    "standard_error",
    "standard_deviation",
    "std",
    "stdev",
    "std.dev.",
    "std._dev.",
    "sd",
    "s.d.",
    "err",
    "error",
];
/// The first parts of a sweep's dotted keys: the tables of a case.
const KEY_TABLES: [&str; 13] = [
    "material", "body", "start", "gravity", "stop", "mesh", "contact", "time", "output", "model",
    "accuracy", "effects", "limits",
];
/// Signs that part a value from its uncertainty.
pub(super) const SIGNS: [&str; 3] = ["±", "+/-", "+-"];

/// Returns whether a column has the values of a key that a sweep varies: `body.0.approach_speed`.
pub(super) fn is_key(header: &str) -> bool {
    header.split_once('.').is_some_and(|(table, _)| KEY_TABLES.contains(&table))
}

/// Returns the name of the column of a column's uncertainty: `speed_uncertainty_cm_s` for `speed_cm_s`.
pub(super) fn uncertainty_of(header: &str) -> String {
    let unit = ending_of(header).map_or("", |unit| unit.text);
    format!("{}_uncertainty{unit}", header.strip_suffix(unit).unwrap_or(header))
}
/// Words before the name of a quantity that make it the uncertainty of the quantity: `delta e`, `u(e)`, `± e`.
const BEFORE: [&str; 11] = ["±", "+-", "+/-", "delta", "δ", "d", "u", "sigma", "σ", "std", "error"];
/// Words after it: `e_err`.
const AFTER: [&str; 8] =
    ["uncertainty", "unc", "err", "error", "sigma", "std", "standard_error", "±"];

/// Returns all names of the uncertainty of a restitution, the preferred one first.
pub(super) fn uncertainties() -> &'static [&'static str] {
    static NAMES: LazyLock<Vec<String>> = LazyLock::new(|| {
        let of = |name: &&str| {
            let after = AFTER.map(|word| format!("{name}_{word}"));
            let before = BEFORE.iter().flat_map(|word| {
                [format!("{word}_{name}"), format!("{word}{name}"), format!("{word}({name})")]
            });
            after.into_iter().chain(before).collect::<Vec<String>>()
        };
        RESTITUTIONS.iter().flat_map(of).chain(UNCERTAINTIES.map(String::from)).collect()
    });
    static WORDS: LazyLock<Vec<&'static str>> =
        LazyLock::new(|| NAMES.iter().map(String::as_str).collect());
    &WORDS
}

pub(super) const CONTACT_TIMES: [&str; 2] = ["contact_time", "t_contact"];
/// Columns that identify the lower and the upper body; a sweep's own names come last.
pub(super) const DIAMETERS: [[&str; 2]; 2] =
    [["diameter_1", "body.0.sphere.diameter"], ["diameter_2", "body.1.sphere.diameter"]];
/// Columns of the trials of a cradle.
const ANGLES: [&str; 4] = ["alpha", "beta", "alpha_uncertainty", "beta_uncertainty"];
/// Columns of measured records.
const RECORDS: [&str; 6] =
    ["time", "time_uncertainty", "height", "height_uncertainty", "force", "signal"];

/// Returns all names that a column may have, without units; among synonyms the preferred name comes first.
pub(super) fn column_names() -> Vec<&'static str> {
    let diameters = DIAMETERS.map(|[name, _]| name);
    let all: [&[&str]; 8] = [
        &SPEEDS,
        &RESTITUTIONS,
        &["restitution_uncertainty"],
        &UNCERTAINTIES,
        &CONTACT_TIMES,
        &diameters,
        &ANGLES,
        &RECORDS,
    ];
    all.concat()
}
