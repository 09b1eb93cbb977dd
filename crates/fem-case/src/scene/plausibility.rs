//! Plausibility checks: numbers of a scene that are possible but unlikely, such as after a forgotten unit, and losses that
//! the materials do not include. They cause warnings, never errors.

use fem_material::Material;

use crate::engineering::{number, show};
use crate::library::{self, MeasuredRestitution};
use crate::scene::Scene;
use crate::scene::body::{Body, Shape};
use crate::scene::model::ModelChoice;

/// Diameters above this, m, are unlikely.
const MAX_DIAMETER: f64 = 100.0;
/// Diameters from this, m, are unlikely if the other sphere is smaller by the ratio below.
const LARGE: f64 = 1.0;
const MAX_RATIO: f64 = 100.0;
/// Plausible densities, kg/m³: aerogel has 1 to 100, osmium 22,590.
const DENSITIES: std::ops::RangeInclusive<f64> = 10.0..=25_000.0;
/// Plausible Young's moduli, Pa: the softest gels have about 100 Pa, diamond has 1.2 TPa.
const YOUNGS_MODULI: std::ops::RangeInclusive<f64> = 100.0..=2e12;

/// Share of the contact compliance above which the losses of a body matter.
const MIN_SHARE: f64 = 1e-3;

fn is_elastic(material: &Material) -> bool {
    material.relaxation().is_none()
}

impl Scene {
    /// Returns the library's materials, without `lib:`, that have a relaxation neither there nor in the case, so that the
    /// restitution lacks their loss. The list is empty for contact laws, whose loss the user gives, and leaves out bodies
    /// that hardly deform.
    pub fn materials_without_loss(&self) -> Vec<&'static str> {
        if matches!(self.model, ModelChoice::Law { .. }) {
            return Vec::new();
        }
        let deforms = self.bodies.iter().zip(self.compliance_shares());
        let deforms = deforms.filter(|(_, share)| *share > MIN_SHARE).map(|(body, _)| body);
        let elastic = |body: &Body| {
            let name =
                body.library_material().filter(|_| body.material().is_some_and(is_elastic))?;
            library::materials()[name].material.relaxation.is_none().then_some(name)
        };
        let mut names: Vec<&str> = deforms.filter_map(elastic).collect();
        names.dedup();
        names
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

    /// Returns a warning that the restitution lacks the loss of the
    /// [materials without a loss](Self::materials_without_loss), with a measured restitution if there is one.
    pub fn unknown_loss(&self) -> Option<String> {
        let names = self.materials_without_loss();
        let speed = self.approach_speed();
        let measured = self.measured_restitutions();
        let within = measured.iter().find_map(|it| Some((it, it.at(speed)?)));
        let remedy = match (within, measured.first()) {
            (Some((it, restitution)), _) => {
                format!("measured: {} ({})", number(restitution, 2), it.name)
            }
            (None, Some(it)) => {
                let (slowest, fastest) = it.speeds();
                let [from, to] = [slowest, fastest].map(|speed| show(speed, "m/s"));
                format!("restitutions are measured at {from} to {to} ({})", it.name)
            }
            (None, None) => "`fem-run calibrate` finds one from measured restitutions".to_string(),
        };
        (!names.is_empty()).then(|| {
            format!(
                "the library has no relaxation for {}: {} loss is not computed, and the restitution is too high by an \
                 unknown amount; {remedy}",
                names.join(" and "),
                if names.len() > 1 { "their" } else { "its" }
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

    /// Returns one warning per number that is so unusual that a unit was probably forgotten.
    pub fn implausible_numbers(&self) -> Vec<String> {
        let mut found = Vec::new();
        let diameters = self.bodies.each_ref().map(|body| body.diameter());
        for (k, body) in self.bodies.iter().enumerate() {
            let name = body.name();
            let key = format!("body.{k}.sphere.diameter");
            let other = diameters[1 - k];
            if let Some(diameter) = diameters[k] {
                if diameter > MAX_DIAMETER {
                    found.push(format!(
                        "the diameter of {name} is {} ({key}); a bare number is in metres",
                        show(diameter, "m")
                    ));
                } else if let Some(other) = other
                    && diameter >= LARGE
                    && diameter > MAX_RATIO * other
                {
                    found.push(format!(
                        "the diameter of {name} is {} ({key}), that of the other body {}; a \
                         bare number is in metres",
                        show(diameter, "m"),
                        show(other, "m")
                    ));
                }
            }
            let (Shape::Sphere { material, .. } | Shape::HalfSpace { material }) = &body.shape
            else {
                continue;
            };
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
        }
        found
    }
}
