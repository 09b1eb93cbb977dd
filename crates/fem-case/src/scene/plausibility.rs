//! Plausibility checks: numbers of a scene that are possible but unlikely, such as after a forgotten unit, and losses that
//! the materials do not include. They cause warnings; [`Case::check_units`] rejects such a number without a unit.

use fem_material::Material;

use crate::case::Case;
use crate::engineering::{number, show};
use crate::error::CaseError;
use crate::library::{self, MeasuredRestitution};
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
const DENSITIES: std::ops::RangeInclusive<f64> = 10.0..=25_000.0;
/// Plausible Young's moduli, Pa: the softest gels have about 100 Pa, diamond has 1.2 TPa.
const YOUNGS_MODULI: std::ops::RangeInclusive<f64> = 100.0..=2e12;

/// Moduli below this, Pa, are those of gels: a bare number was probably meant in GPa or MPa.
const SMALL_MODULUS: f64 = 1e5;
/// Plausible yield strengths, Pa: soft waxes and greases have 10 kPa, diamond about 100 GPa.
pub(crate) const YIELD_STRENGTHS: std::ops::RangeInclusive<f64> = 1e4..=2e11;

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
        let numbers = (0..2).flat_map(|side| self.implausible(side)).map(|found| found.message);
        let is_large =
            |input: &&UncertainInput| input.value != 0.0 && input.uncertainty > input.value.abs();
        let spreads = self.inputs.iter().filter(is_large).map(|input| {
            let share = number(100.0 * input.uncertainty / input.value.abs(), 3);
            format!("the uncertainty of {} is {share} % of its value: check its unit", input.key)
        });
        numbers.chain(spreads).collect()
    }

    /// Returns the implausible numbers of a body.
    fn implausible(&self, side: usize) -> Vec<Implausible> {
        let mut found = Vec::new();
        let body = &self.bodies[side];
        let name = body.name();
        let key = format!("body.{side}.sphere.diameter");
        let other = self.bodies[1 - side].diameter();
        if let Some(diameter) = body.diameter() {
            let others = other.filter(|other| diameter >= LARGE && diameter > MAX_RATIO * other);
            let others =
                others.map(|other| format!(", that of the other body {}", show(other, "m")));
            if diameter > MAX_DIAMETER || others.is_some() {
                found.push(Implausible {
                    number: Number::Diameter,
                    message: format!(
                        "the diameter of {name} is {} ({key}){}; a bare number is in metres",
                        show(diameter, "m"),
                        others.unwrap_or_default()
                    ),
                });
            }
        }
        let Some(material) = body.material() else { return found };
        let density = material.density();
        if !DENSITIES.contains(&density) {
            found.push(Implausible {
                number: Number::Density,
                message: format!(
                    "the density of {name} is {} kg/m^3, but solids have 10 to 25000 kg/m^3; a number \
                     without a unit is in kg/m^3",
                    number(density, 5)
                ),
            });
        }
        let modulus = material.instantaneous().youngs_modulus();
        if !YOUNGS_MODULI.contains(&modulus) {
            found.push(Implausible {
                number: Number::Modulus,
                message: format!(
                    "Young's modulus of {name} is {}; solids have 100 Pa to 2 TPa, and a \
                     bare number is in Pa",
                    show(modulus, "Pa")
                ),
            });
        }
        if let Some(strength) = body.yield_strength().filter(|it| !YIELD_STRENGTHS.contains(it)) {
            found.push(Implausible {
                number: Number::YieldStrength,
                message: format!(
                    "the yield strength of {name} is {}; solids have 10 kPa to 200 GPa, and a bare number is in Pa",
                    show(strength, "Pa")
                ),
            });
        }
        found
    }
}

/// A number that is so unusual that a unit was probably forgotten.
struct Implausible {
    number: Number,
    message: String,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Number {
    Diameter,
    PlateThickness,
    PlateDiameter,
    Density,
    Modulus,
    YieldStrength,
    HardeningModulus,
}

impl Number {
    /// Returns the unit, and the keys of the body or material that may have given the number.
    fn keys(self) -> (&'static str, &'static [&'static str]) {
        match self {
            Self::Diameter => ("m", &["sphere.diameter"]),
            Self::PlateThickness => ("m", &["plate.thickness"]),
            Self::PlateDiameter => ("m", &["plate.diameter"]),
            Self::Density => ("kg/m^3", &["density"]),
            Self::Modulus => ("Pa", &["youngs_modulus", "shear_modulus", "bulk_modulus"]),
            Self::YieldStrength => {
                ("Pa", &["yield_strength", "flow.yield_strength", "flow.hardening.table.0.1"])
            }
            Self::HardeningModulus => ("Pa", &["flow.hardening.modulus"]),
        }
    }
}

impl Case {
    /// Rejects implausible numbers that the file or an override gives without a unit, bare sizes of 1 m and more, and bare
    /// moduli below 0.1 MPa.
    ///
    /// # Errors
    /// All such numbers, each with its place. With a unit the same number is only warned of.
    pub fn check_units(&self) -> Result<(), CaseError> {
        let mut faults = Vec::new();
        for Unusual { side, message, path, unit } in self.unusual_numbers() {
            let key = path.iter().fold(String::new(), |key, part| join(&key, &quote_key(part)));
            let text = self.document.value_text(&key);
            let Ok(bare) = text.trim_matches(['"', '\'']).trim().parse::<f64>() else { continue };
            let is_known = faults.iter().any(|(_, known)| *known == key);
            if !is_known {
                let last = path.iter().rfind(|part| part.parse::<usize>().is_err());
                let last = last.map_or("", |last| last);
                let intended = match (unit, last) {
                    ("m", _) => "mm",
                    ("Pa", "yield_strength" | "table") => "MPa",
                    ("Pa", _) => "GPa",
                    _ => "g/cm^3",
                };
                // The point of a table has no key.
                let equals = if last == "table" { String::new() } else { format!("{last} = ") };
                let fault = self.error_at(&key, message).with_help(format!(
                    "write the unit: {equals}\"{bare} {intended}\", or {equals}\"{bare} {unit}\" if {} is so",
                    self.scene.bodies[side].name()
                ));
                faults.push((fault, key));
            }
        }
        let faults = faults.into_iter().map(|(fault, _)| fault).collect();
        CaseError::joined(faults).map_or(Ok(()), Err)
    }

    /// Returns this case in another form, such as the resolved one, as TOML ([`CaseFile::to_toml`]). Its unusual numbers have
    /// their units, so that it can be run ([`check_units`](Self::check_units)).
    ///
    /// # Errors
    /// Those of [`CaseFile::to_toml`].
    pub fn toml_of(&self, file: &CaseFile) -> Result<String, toml::ser::Error> {
        let mut tree = toml::Value::try_from(file)?;
        for Unusual { path, unit, .. } in self.unusual_numbers() {
            let number = path.iter().try_fold(&mut tree, |value, part| match value {
                toml::Value::Table(table) => table.get_mut(part),
                toml::Value::Array(array) => array.get_mut(part.parse::<usize>().ok()?),
                _ => None,
            });
            if let Some(number) = number.filter(|number| number.is_float()) {
                *number = toml::Value::String(format!("{number} {unit}"));
            }
        }
        toml::to_string(&tree)
    }

    /// Returns the numbers that need a unit to be accepted, each with the keys that may have given it.
    fn unusual_numbers(&self) -> Vec<Unusual> {
        let mut all = Vec::new();
        for side in 0..2 {
            let material = self.file.body[side].material.as_deref().unwrap_or_default();
            let mut found = self.scene.implausible(side);
            for bare in self.doubtful_if_bare(side, material) {
                if found.iter().all(|told| told.number != bare.number) {
                    found.push(bare);
                }
            }
            for Implausible { number, message } in found {
                let (unit, keys) = number.keys();
                let place = match unit {
                    "m" => ["body".to_string(), side.to_string()],
                    _ => ["material".to_string(), material.to_string()],
                };
                all.extend(keys.iter().map(|keys| {
                    let path = keys.split('.').map(str::to_string);
                    let path = place.iter().cloned().chain(path).collect();
                    Unusual { side, message: message.clone(), path, unit }
                }));
            }
        }
        all
    }

    /// Returns the numbers of a body that are doubtful without a unit.
    fn doubtful_if_bare(&self, side: usize, material: &str) -> impl Iterator<Item = Implausible> {
        let body = &self.scene.bodies[side];
        let plate = body.plate();
        let modulus = body.material().map(|it| it.instantaneous().youngs_modulus());
        let hardening =
            self.file.material.get(material).and_then(|table| {
                table.flow.as_ref()?.hardening.as_ref()?.modulus.as_ref()?.si().ok()
            });
        let large = |size: &f64| *size >= LARGE;
        let small = |modulus: &f64| *modulus > 0.0 && *modulus < SMALL_MODULUS;
        let numbers = [
            (Number::Diameter, "the diameter", "m", body.diameter().filter(large)),
            (
                Number::PlateThickness,
                "the thickness",
                "m",
                plate.map(|it| it.thickness).filter(large),
            ),
            (
                Number::PlateDiameter,
                "the diameter",
                "m",
                plate.and_then(|it| it.diameter).filter(large),
            ),
            (Number::Modulus, "Young's modulus", "Pa", modulus.filter(small)),
            (Number::HardeningModulus, "the hardening modulus", "Pa", hardening.filter(small)),
        ];
        numbers.into_iter().filter_map(|(number, what, unit, value)| {
            let message = format!("{what} of {} is {}", body.name(), show(value?, unit));
            Some(Implausible { number, message })
        })
    }
}

/// A number that needs a unit to be accepted.
struct Unusual {
    /// Side of the body that has it.
    side: usize,
    message: String,
    /// The keys and indices that lead to it in the case.
    path: Vec<String>,
    unit: &'static str,
}
