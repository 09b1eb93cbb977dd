//! Plausibility checks: numbers of a scene that are possible but unlikely, such as after a forgotten unit, and losses that
//! the materials do not include. They cause warnings; [`Case::check_units`] rejects such a number without a unit.

use std::ops::RangeInclusive;

use fem_material::Material;

use crate::case::Case;
use crate::engineering::{number, show};
use crate::error::CaseError;
use crate::library::{self, MeasuredRestitution};
use crate::quantity::units::parse_quantity;
use crate::scene::body::Body;
use crate::scene::model::ModelChoice;
use crate::scene::{Scene, UncertainInput};
use crate::schema::CaseFile;
use crate::source::toml_syntax::{join, quote_key};

/// Diameters above this, m, are unlikely.
const MAX_DIAMETER: f64 = 100.0;
/// Diameters from this, m, are unlikely if the other sphere is smaller by the ratio below.
const LARGE: f64 = 1.0;
const MAX_RATIO: f64 = 100.0;
/// Plausible densities, kg/m³: aerogel has 1 to 100, osmium 22,590.
const DENSITIES: RangeInclusive<f64> = 10.0..=25_000.0;
/// Plausible Young's moduli, Pa: the softest gels have about 100 Pa, diamond has 1.2 TPa.
const YOUNGS_MODULI: RangeInclusive<f64> = 100.0..=2e12;

/// Plausible moduli of a bare number, Pa: those below are of gels, and were probably meant in GPa or MPa.
const BARE_MODULI: RangeInclusive<f64> = 1e5..=2e12;
/// Plausible speeds of a bare number, m/s: one faster than sound in air was probably meant in mm/s.
const BARE_SPEEDS: RangeInclusive<f64> = 0.0..=340.0;
/// Plausible yield strengths, Pa: soft waxes and greases have 10 kPa, diamond about 100 GPa.
pub(crate) const YIELD_STRENGTHS: RangeInclusive<f64> = 1e4..=2e11;

/// Share of the contact compliance, and so of the elastic energy, above which the loss of a body matters: of a twentieth of the
/// energy solids lose little.
const MIN_SHARE: f64 = 0.05;

/// Young's modulus (Pa) below which a solid is a polymer, whose own loss in an impact is not small beside that by plastic flow
/// (Ashby 2011, chart of loss coefficient and modulus: above it the loss coefficient is mostly below 0.01).
pub const MAX_MODULUS_OF_POLYMERS: f64 = 1e10;

impl Scene {
    /// Returns the bodies whose own loss is not known: they deform, the case gives their material no relaxation, and does not
    /// say that it is meant to be elastic. There are none for contact laws, whose loss the user gives. Where a body loses
    /// energy as it `flows`, the loss of metals is small beside that.
    pub fn bodies_of_unknown_loss(&self, flows: bool) -> impl Iterator<Item = &Body> {
        let is_law = matches!(self.model, ModelChoice::Law { .. });
        let deforms = self.bodies.iter().zip(self.compliance_shares());
        let deforms = deforms.filter(|(_, share)| *share > MIN_SHARE).map(|(body, _)| body);
        deforms.filter(move |body| {
            let is_open = |material: &Material| {
                let modulus = material.instantaneous().youngs_modulus();
                let is_small = flows && modulus > MAX_MODULUS_OF_POLYMERS;
                material.relaxation().is_none() && !is_small
            };
            !is_law && !body.is_meant_elastic() && body.material().is_some_and(is_open)
        })
    }

    /// Returns the measured restitutions of the library between bodies of one material, if both bodies are of it or one is
    /// a rigid wall.
    pub fn measured_restitutions(&self) -> &'static [MeasuredRestitution] {
        let mut names = self.bodies.iter().filter(|body| body.material().is_some());
        let first = names.next().and_then(Body::library_material);
        match first.filter(|first| names.all(|body| body.library_material() == Some(first))) {
            Some(name) => library::materials().get(name).map_or(&[], |entry| &entry.measured),
            None => &[],
        }
    }

    /// Returns a note that relaxations hold at their reference temperatures, since the case gives no temperature.
    pub fn reference_temperatures(&self) -> Option<String> {
        let known = self.bodies.iter().filter_map(|body| {
            let reference = body.measured()?.reference_temperature?;
            Some(format!("{:.1} degC", reference - fem_material::ZERO_CELSIUS))
        });
        let mut known: Vec<String> = known.filter(|_| self.temperature.is_none()).collect();
        known.dedup();
        (!known.is_empty()).then(|| {
            format!(
                "relaxation at its reference temperature, {} (no temperature is given)",
                known.join(" and ")
            )
        })
    }

    /// Returns a note on the sizes and the unit of spheres that are all one metre or larger, which may be intended;
    /// `None` if one of them is [implausible](Self::implausible_numbers).
    pub fn large_spheres(&self) -> Option<String> {
        let spheres: Vec<f64> = self.bodies.iter().filter_map(Body::diameter).collect();
        let are_large = spheres.iter().all(|diameter| (LARGE..=MAX_DIAMETER).contains(diameter));
        let sizes: Vec<String> = spheres.iter().map(|diameter| show(*diameter, "m")).collect();
        are_large
            .then(|| format!("spheres of {} (bare numbers are in metres)", sizes.join(" and ")))
    }

    /// Returns one warning per number or uncertainty that is so unusual that a unit was probably forgotten.
    pub fn implausible_numbers(&self) -> Vec<String> {
        let numbers = (0..2).flat_map(|side| self.implausible(side));
        let is_large =
            |input: &&UncertainInput| input.value != 0.0 && input.uncertainty > input.value.abs();
        let spreads = self.inputs.iter().filter(is_large).map(|input| {
            let share = number(100.0 * input.uncertainty / input.value.abs(), 3);
            format!("the uncertainty of {} is {share} % of its value: check its unit", input.key)
        });
        numbers.chain(spreads).collect()
    }

    /// Returns a message per implausible number of a body.
    fn implausible(&self, side: usize) -> Vec<String> {
        let mut found = Vec::new();
        let body = &self.bodies[side];
        let name = body.name();
        let other = self.bodies[1 - side].diameter();
        if let Some(diameter) = body.diameter() {
            let others = other.filter(|other| diameter >= LARGE && diameter > MAX_RATIO * other);
            let others =
                others.map(|other| format!(", that of the other body {}", show(other, "m")));
            if diameter > MAX_DIAMETER || others.is_some() {
                found.push(format!(
                    "the diameter of {name} is {} (body.{side}.sphere.diameter){}; a bare number is in metres",
                    show(diameter, "m"),
                    others.unwrap_or_default()
                ));
            }
        }
        let Some(material) = body.material() else { return found };
        let density = material.density();
        if !DENSITIES.contains(&density) {
            found.push(format!(
                "the density of {name} is {} kg/m^3, but solids have 10 to 25000 kg/m^3; a number \
                 without a unit is in kg/m^3",
                number(density, 5)
            ));
        }
        let modulus = material.instantaneous().youngs_modulus();
        if !YOUNGS_MODULI.contains(&modulus) {
            found.push(format!(
                "Young's modulus of {name} is {}; solids have 100 Pa to 2 TPa, and a \
                 bare number is in Pa",
                show(modulus, "Pa")
            ));
        }
        if let Some(strength) = body.yield_strength().filter(|it| !YIELD_STRENGTHS.contains(it)) {
            found.push(format!(
                "the yield strength of {name} is {}; solids have 10 kPa to 200 GPa, and a bare number is in Pa",
                show(strength, "Pa")
            ));
        }
        found
    }
}

/// Units that people use together, for each [`Unit`]: those of daily use, and then the consistent systems of finite-element decks
/// in mm, t, s; in mm, g, ms; in mm, kg, ms; and in inches and pounds of force.
const SYSTEMS: [[&str; 5]; 5] = [
    ["mm", "mm/s", "g/cm^3", "GPa", "MPa"],
    ["mm", "mm/s", "t/mm^3", "MPa", "MPa"],
    ["mm", "m/s", "g/mm^3", "MPa", "MPa"],
    ["mm", "m/s", "kg/mm^3", "GPa", "GPa"],
    ["in", "in/s", "lbf s^2/in^4", "psi", "psi"],
];

/// A kind of number, as an index of a system of units.
#[derive(Clone, Copy)]
enum Unit {
    Length,
    Speed,
    Density,
    Modulus,
    Strength,
}

impl Unit {
    /// Returns the SI unit, and the values that a bare number may have.
    fn bare(self) -> (&'static str, RangeInclusive<f64>) {
        match self {
            Self::Length => ("m", 0.0..=LARGE.next_down()),
            Self::Speed => ("m/s", BARE_SPEEDS),
            Self::Density => ("kg/m^3", DENSITIES),
            Self::Modulus => ("Pa", BARE_MODULI),
            Self::Strength => ("Pa", YIELD_STRENGTHS),
        }
    }
}

impl Case {
    /// Rejects implausible numbers that the file gives without a unit, bare sizes of 1 m and more, bare moduli below 0.1 MPa
    /// and bare speeds above that of sound. If the bare numbers of a file are plausible in one system of units, all of them
    /// need their units. Overrides are checked as well if they are not `in_code`, where bare numbers are SI.
    ///
    /// # Errors
    /// All such numbers, each with its place. With a unit the same number is only warned of.
    pub fn check_units(&self, in_code: bool) -> Result<(), CaseError> {
        let mut bare: Vec<BareNumber> = Vec::new();
        for number in self.numbers() {
            let key = number.path.iter().fold(String::new(), |key, it| join(&key, &quote_key(it)));
            let text = self.document.value_text(&key).trim_matches(['"', '\'']).trim();
            let is_bare = text.parse::<f64>().is_ok_and(|value| value != 0.0);
            let is_checked = !in_code || self.document.turn_of(&key) == 0;
            if is_bare && is_checked && bare.iter().all(|known| known.key != key) {
                let text = text.to_string();
                bare.push(BareNumber { number, key, text });
            }
        }
        let first = &SYSTEMS[0];
        let suits = |system: &&[&str; 5], all: bool| {
            let mut numbers = bare.iter().filter(|it| all || it.number.is_unusual());
            numbers.all(|it| it.is_plausible_in(system))
        };
        let deck = SYSTEMS[1..].iter().find(|system| suits(system, true));
        let deck = deck.filter(|_| !suits(&first, false));
        let system =
            deck.or_else(|| SYSTEMS.iter().find(|system| suits(system, false))).unwrap_or(first);
        let faults = bare.iter().filter(|it| deck.is_some() || it.number.is_unusual());
        let faults = faults.map(|BareNumber { number, key, text }| {
            let Number { side, what, unit, value, path } = number;
            let (name, intended) = (self.scene.bodies[*side].name(), system[*unit as usize]);
            let value = match unit {
                Unit::Density => format!("{} kg/m^3", crate::engineering::number(*value, 5)),
                _ => show(*value, unit.bare().0),
            };
            let unit = unit.bare().0;
            let message = format!("{what} of {name} is {value}: a bare number is in {unit}");
            let last = path.iter().rfind(|part| part.parse::<usize>().is_err());
            // The point of a table has no key.
            let last = last.filter(|last| *last != "table");
            let equals = last.map(|last| format!("{last} = ")).unwrap_or_default();
            self.error_at(key, message).with_help(format!(
                "write the unit: {equals}\"{text} {intended}\", or {equals}\"{text} {unit}\" if {name} is so"
            ))
        });
        CaseError::joined(faults.collect()).map_or(Ok(()), Err)
    }

    /// Returns this case in another form, such as the resolved one, as TOML ([`CaseFile::to_toml`]). Its unusual numbers have
    /// their units, so that it can be run ([`check_units`](Self::check_units)).
    ///
    /// # Errors
    /// Those of [`CaseFile::to_toml`].
    pub fn toml_of(&self, file: &CaseFile) -> Result<String, toml::ser::Error> {
        let mut tree = toml::Value::try_from(file)?;
        for Number { path, unit, .. } in self.numbers().filter(Number::is_unusual) {
            let number = path.iter().try_fold(&mut tree, |value, part| match value {
                toml::Value::Table(table) => table.get_mut(part),
                toml::Value::Array(array) => array.get_mut(part.parse::<usize>().ok()?),
                _ => None,
            });
            if let Some(number) = number.filter(|number| number.is_float()) {
                *number = toml::Value::String(format!("{number} {}", unit.bare().0));
            }
        }
        toml::to_string(&tree)
    }

    /// Returns the numbers of both bodies that need a unit if they are unusual, each with the keys that may have given it.
    fn numbers(&self) -> impl Iterator<Item = Number> {
        (0..2).flat_map(|side| {
            let body = &self.scene.bodies[side];
            let plate = body.plate();
            let material = self.file.body[side].material.as_deref().unwrap_or_default();
            let modulus = body.material().map(|it| it.instantaneous().youngs_modulus());
            let hardening = self.file.material.get(material).and_then(|table| {
                table.flow.as_ref()?.hardening.as_ref()?.modulus.as_ref()?.si().ok()
            });
            let density = body.material().map(Material::density);
            let of_plate = plate.and_then(|it| it.diameter);
            let speed = self.file.body[side].approach_speed.as_ref().and_then(|it| it.si().ok());
            let moduli = ["youngs_modulus", "shear_modulus", "bulk_modulus"];
            let strengths = ["yield_strength", "flow.yield_strength", "flow.hardening.table.0.1"];
            let numbers: [(_, _, _, &[&str]); 8] = [
                ("the diameter", Unit::Length, body.diameter(), &["sphere.diameter"]),
                ("the thickness", Unit::Length, plate.map(|it| it.thickness), &["plate.thickness"]),
                ("the diameter", Unit::Length, of_plate, &["plate.diameter"]),
                ("the approach speed", Unit::Speed, speed, &["approach_speed"]),
                ("the density", Unit::Density, density, &["density"]),
                ("Young's modulus", Unit::Modulus, modulus, &moduli),
                ("the yield strength", Unit::Strength, body.yield_strength(), &strengths),
                ("the hardening modulus", Unit::Modulus, hardening, &["flow.hardening.modulus"]),
            ];
            let place = |unit| match unit {
                Unit::Length | Unit::Speed => ["body".to_string(), side.to_string()],
                _ => ["material".to_string(), material.to_string()],
            };
            let number = |what, unit, value: Option<f64>, key: &str| {
                let key = key.split('.').map(str::to_string);
                let path = place(unit).into_iter().chain(key).collect();
                value.map(|value| Number { side, what, unit, value: value.abs(), path })
            };
            let numbers = numbers.into_iter().flat_map(|(what, unit, value, keys)| {
                keys.iter().filter_map(move |key| number(what, unit, value, key))
            });
            numbers.collect::<Vec<_>>()
        })
    }
}

/// A number of a body that needs its unit if it is unusual.
struct Number {
    /// Side of the body that has it.
    side: usize,
    what: &'static str,
    unit: Unit,
    /// Its absolute value, SI.
    value: f64,
    /// The keys and indices that lead to it in the case.
    path: Vec<String>,
}

impl Number {
    /// Returns whether the number would be implausible without its unit. A modulus or size of 0 is what a body lacks.
    fn is_unusual(&self) -> bool {
        self.value != 0.0 && !self.unit.bare().1.contains(&self.value)
    }
}

/// A number that the case gives without a unit.
struct BareNumber {
    number: Number,
    key: String,
    /// The number as it is written.
    text: String,
}

impl BareNumber {
    /// Returns whether the number as it is written is plausible in the unit of a system.
    fn is_plausible_in(&self, system: &[&str; 5]) -> bool {
        let unit = self.number.unit;
        let value = parse_quantity(&format!("{} {}", self.text, system[unit as usize]));
        value.is_ok_and(|(value, _)| unit.bare().1.contains(&value.abs()))
    }
}
