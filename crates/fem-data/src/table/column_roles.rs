//! The roles and the units of columns by their names: `speed_cm_s`, `alpha_deg`.

use std::f64::consts::PI;
use std::sync::LazyLock;

use super::rebounds::rebound_columns;

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
const ENDINGS: [UnitSuffix; 44] = [
    ending("_cm_s", 1e-2, [1, 0, -1]),
    ending("_mm_s", 1e-3, [1, 0, -1]),
    ending("_um_s", 1e-6, [1, 0, -1]),
    ending("_km_h", 1.0 / 3.6, [1, 0, -1]),
    ending("_ft_s", 0.3048, [1, 0, -1]),
    ending("_in_s", 0.0254, [1, 0, -1]),
    ending("_mph", 0.44704, [1, 0, -1]),
    ending("_m_s", 1.0, [1, 0, -1]),
    ending("_hz", 1.0, [0, 0, -1]),
    // A rate of phase counts in cycles per second, like a frequency.
    ending("_rad_s", 0.5 / PI, [0, 0, -1]),
    ending("_per_s", 1.0, [0, 0, -1]),
    ending("_rpm", 1.0 / 60.0, [0, 0, -1]),
    ending("_us", 1e-6, [0, 0, 1]),
    ending("_ms", 1e-3, [0, 0, 1]),
    ending("_ns", 1e-9, [0, 0, 1]),
    ending("_s", 1.0, [0, 0, 1]),
    ending("_deg", PI / 180.0, [0; 3]),
    ending("_mrad", 1e-3, [0; 3]),
    ending("_khz", 1e3, [0, 0, -1]),
    ending("_rad", 1.0, [0; 3]),
    ending("_percent", 1e-2, [0; 3]),
    ending("_mm", 1e-3, [1, 0, 0]),
    ending("_cm", 1e-2, [1, 0, 0]),
    ending("_um", 1e-6, [1, 0, 0]),
    ending("_m", 1.0, [1, 0, 0]),
    ending("_kn", 1e3, [1, 1, -2]),
    ending("_mn", 1e-3, [1, 1, -2]),
    ending(NEWTON, 1.0, [1, 1, -2]),
    ending("_newton", 1.0, [1, 1, -2]),
    ending("_pa", 1.0, PRESSURE),
    ending("_kpa", 1e3, PRESSURE),
    ending("_mpa", 1e6, PRESSURE),
    ending("_gpa", 1e9, PRESSURE),
    ending("_psi", PSI, PRESSURE),
    ending("_ksi", 1e3 * PSI, PRESSURE),
    ending("_dyn_cm2", 0.1, PRESSURE),
    // A name that ends in `_min` may be a least value.
    ending("_minutes", 60.0, [0, 0, 1]),
    ending("_hours", 3600.0, [0, 0, 1]),
    // The scale of a picture is not in its names.
    ending("_px", 1.0, PIXELS),
    ending("_pixel", 1.0, PIXELS),
    ending("_pixels", 1.0, PIXELS),
    // Scales of temperature have an offset, which their reader adds.
    ending("_degc", 1.0, [0; 3]),
    ending("_degf", 1.0, [0; 3]),
    ending("_kelvin", 1.0, [0; 3]),
];

/// Exponents of a length in pixels, which is of no dimension of a table.
const PIXELS: [i32; 3] = [1, 0, 1];
/// The ending of newton, which is a part of the name where no force can stand: `e_n`.
const NEWTON: &str = "_n";
/// Names of forces, and how others begin.
const FORCES: [&str; 8] = ["f", "fn", "fmax", "fz", "fy", "f_max", "f_peak", "n"];
const FORCE_WORDS: [&str; 3] = ["force", "load", "kraft"];

/// A pound-force per square inch, Pa: lb g_n / in².
const PSI: f64 = 0.453_592_37 * 9.806_65 / (0.0254 * 0.0254);
/// Exponents of a pressure.
pub(super) const PRESSURE: [i32; 3] = [-1, 1, -2];

/// Endings of names with the units that the units of a case do not have.
const OTHER_UNITS: [(&str, &[&str]); 14] = [
    ("_rad_s", &["rad/s", "rad s^-1", "rad·s⁻¹"]),
    ("_per_s", &["1/s", "s^-1", "s⁻¹"]),
    ("_rpm", &["rpm"]),
    ("_deg", &["deg", "°"]),
    ("_rad", &["rad"]),
    ("_degc", &["C", "°C", "º C", "ºC", "degC"]),
    ("_kelvin", &["K"]),
    ("_degf", &["°F", "degF", "F"]),
    ("_psi", &["psi"]),
    ("_ksi", &["ksi"]),
    ("_dyn_cm2", &["dyn/cm^2", "dyn/cm²", "dyn/cm2", "dyne/cm^2", "dyne/cm²", "dyne/cm2"]),
    ("_hours", &["hr"]),
    ("_px", &["px", "pixel", "pixels"]),
    ("_s", &["second", "seconds", "sec"]),
];

/// Returns the ending of a unit of an angle, a rate of phase or a temperature.
pub(super) fn other_ending(unit: &str) -> Option<&'static str> {
    OTHER_UNITS.iter().find(|(_, names)| names.contains(&unit)).map(|(ending, _)| *ending)
}

/// Returns the unit in which a column's name ends.
pub(super) fn ending_of(header: &str) -> Option<UnitSuffix> {
    ENDINGS.into_iter().find(|ending| ending.before(header).is_some())
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
    FORCES.contains(&name) || FORCE_WORDS.iter().any(|word| name.contains(word))
}

/// Returns a name with the ending of a unit.
pub(super) fn with_ending(name: &str, ending: &str) -> String {
    let is_unclear = ending == NEWTON && !is_force(name);
    format!("{name}{}", if is_unclear { "_newton" } else { ending })
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
pub(crate) fn bare(header: &str) -> &str {
    ending_of(header).and_then(|ending| ending.before(header)).unwrap_or(header)
}

/// Whether the name of a column is one of these and a number, `stop_2`; the first instant of a row is `start`.
pub(crate) fn is_numbered(header: &str, names: &[&str]) -> bool {
    let bare = bare(header);
    let name = bare.trim_end_matches(|c: char| c.is_ascii_digit() || c == '#');
    (name.len() < bare.len() || name == "start") && names.contains(&name.trim_end_matches('_'))
}

/// Returns a name without a unit in brackets, which it keeps if no column has that unit: `voltage [V]`.
pub(super) fn before_brackets(header: &str) -> &str {
    header.split(['[', '(']).next().unwrap_or_default().trim_end_matches('_')
}

/// Returns a name and all names that it may be without a unit at its end: `speed_m_s` is `speed` in m/s, or
/// `speed_m` in s.
pub(super) fn readings(header: &str) -> impl Iterator<Item = &str> {
    let bare = ENDINGS.into_iter().filter_map(|ending| ending.before(header));
    std::iter::once(header).chain(bare)
}

pub(super) const SPEEDS: [&str; 18] = [
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
    "v_n",
    "vn",
    "normal_velocity",
    "normal_speed",
    "speed_before",
    "velocity_before",
    "v_before",
    "v_in",
];
/// Names of columns of heights from which a body falls on the other one, most certain first.
pub(crate) const DROP_HEIGHTS: [&[&str]; 2] = [
    &[
        "drop_height",
        "release_height",
        "initial_height",
        "start_height",
        "fall_height",
        "height_of_fall",
        "height_of_drop",
        "h0",
        "h_0",
        "h_drop",
    ],
    &["height", "h", "h1", "h_1"],
];
/// Names of columns of heights to which it rebounds.
pub(super) const REBOUND_HEIGHTS: [&[&str]; 2] = [
    &[
        "rebound_height",
        "bounce_height",
        "height_of_bounce",
        "height_of_rebound",
        "rebound",
        "bounce",
        "return_height",
        "final_height",
        "h_rebound",
        "h2",
        "h_2",
    ],
    &["h1", "h_1"],
];
/// Names of columns of speeds after impacts.
pub(super) const REBOUND_SPEEDS: [&str; 8] = [
    "rebound_speed",
    "rebound_velocity",
    "speed_after",
    "velocity_after",
    "v_after",
    "v_out",
    "v_rebound",
    "exit_velocity",
];
pub(crate) const RESTITUTIONS: [&str; 8] = [
    "restitution",
    "coefficient_of_restitution",
    "restitution_coefficient",
    "cor",
    "e",
    "e_n",
    "en",
    "normal_restitution",
];
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

/// Names of a column of frequencies.
pub(super) const FREQUENCIES: [&str; 5] = ["frequency", "f", "freq", "freq.", "ν"];
/// Names of a column of angular frequencies, which are in rad/s without a unit.
pub(super) const ANGULAR_FREQUENCIES: [&str; 7] =
    ["angular_frequency", "omega", "ω", "w", "angular_freq", "ang._freq.", "ang._frequency"];
/// Names of a column of times after the step of a relaxation test.
pub(super) const TIMES: [&str; 3] = ["time", "t", "step_time"];
/// Names of a column of temperatures, in °C without a unit.
pub(super) const TEMPERATURES: [&str; 6] = ["temperature", "temp", "temp.", "t", "θ", "t_mean"];
/// Names of temperatures that end in a unit of one letter, with the ending that it stands for.
pub(super) const SHORT_TEMPERATURES: [(&str, &str); 9] = [
    ("temperature_c", "_degc"),
    ("temp_c", "_degc"),
    ("t_c", "_degc"),
    ("temperature_k", "_kelvin"),
    ("temp_k", "_kelvin"),
    ("t_k", "_kelvin"),
    ("temperature_f", "_degf"),
    ("temp_f", "_degf"),
    ("t_f", "_degf"),
];
/// Names of moduli that may be of Young or of shear.
pub(super) const STORAGE_MODULI: [&str; 4] =
    ["storage_modulus", "storage", "stor._modulus", "storage_mod."];
pub(super) const LOSS_MODULI: [&str; 3] = ["loss_modulus", "loss", "loss_mod."];
pub(super) const COMPLEX_MODULI: [&str; 4] =
    ["complex_modulus", "dynamic_modulus", "absolute_modulus", "modulus"];
pub(super) const RELAXATION_MODULI: [&str; 4] =
    ["relaxation_modulus", "modulus", "relaxation", "relax._modulus"];
/// Ends of the names of moduli after `e` or `g`: `e'`, `g_stor`.
pub(super) const STORAGE_ENDS: [&str; 8] = ["'", "′", "’", "_stor", "_storage", "_prime", "1", "`"];
pub(super) const LOSS_ENDS: [&str; 10] =
    ["''", "″", "\"", "′′", "’’", "”", "_loss", "_double_prime", "2", "``"];
pub(super) const COMPLEX_ENDS: [&str; 5] = ["*", "_star", "_complex", "_comp", "_abs"];
pub(super) const RELAXATION_ENDS: [&str; 3] = ["", "(t)", "_relax"];
/// Names of columns of the stress and the strain of a relaxation test.
pub(super) const STRESSES: [&str; 6] =
    ["stress", "tensile_stress", "shear_stress", "σ", "τ", "oscillation_stress"];
pub(super) const STRAINS: [&str; 6] =
    ["strain", "tensile_strain", "shear_strain", "ε", "γ", "oscillation_strain"];
/// Names of a column of loss factors.
pub(super) const LOSS_FACTORS: [&str; 10] = [
    "tan_delta",
    "tan_δ",
    "tanδ",
    "tandelta",
    "tan(delta)",
    "tan(δ)",
    "tand",
    "tan_del",
    "loss_factor",
    "damping_factor",
];
/// Names of a column of phase angles.
pub(super) const PHASES: [&str; 6] =
    ["phase", "phase_angle", "delta", "δ", "loss_angle", "phase_lag"];
/// Names of columns of moduli as `--columns` writes them.
const MODULI: [&str; 11] = [
    "frequency",
    "angular_frequency",
    "temperature",
    "storage_modulus",
    "loss_modulus",
    "complex_modulus",
    "relaxation_modulus",
    "tan_delta",
    "phase",
    "e",
    "g",
];

/// Returns all names that a column may have, without units; among synonyms the preferred name comes first.
pub(super) fn column_names() -> Vec<&'static str> {
    let diameters = DIAMETERS.map(|[name, _]| name);
    let all: [&[&str]; 10] = [
        &SPEEDS,
        &["drop_height", "rebound_height", "rebound_speed"],
        &RESTITUTIONS,
        &["restitution_uncertainty"],
        &UNCERTAINTIES,
        &CONTACT_TIMES,
        &diameters,
        &ANGLES,
        &RECORDS,
        &MODULI,
    ];
    [all.concat(), rebound_columns()].concat()
}
