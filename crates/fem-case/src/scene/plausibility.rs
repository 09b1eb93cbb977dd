//! Plausibility checks: numbers of a scene that are possible but unlikely, such as after a forgotten unit, and losses that
//! the materials do not include. They cause warnings, never errors.

use crate::engineering::{number, show};
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

impl Scene {
    /// Returns the library's materials, without `lib:`, that have no published loss and no relaxation in the case, so
    /// that the restitution lacks their loss. The list is empty for contact laws, whose loss the user gives, and leaves
    /// out bodies that hardly deform.
    pub fn materials_of_unpublished_loss(&self) -> Vec<&str> {
        if matches!(self.model, ModelChoice::Law { .. }) {
            return Vec::new();
        }
        let deforms = self.bodies.iter().zip(self.compliance_shares());
        let deforms = deforms.filter(|(_, share)| *share > MIN_SHARE).map(|(body, _)| body);
        let mut names: Vec<&str> = deforms.filter_map(Body::unpublished_loss).collect();
        names.dedup();
        names
    }

    /// Returns a warning that the restitution lacks the loss of the
    /// [materials of unpublished loss](Self::materials_of_unpublished_loss).
    pub fn unpublished_loss(&self) -> Option<String> {
        let names = self.materials_of_unpublished_loss();
        (!names.is_empty()).then(|| {
            let names = names.join(" and ");
            format!(
                "the loss of {names} in an impact is not published: the restitution is that of a material without it, \
                 and its error is unknown; give the material a relaxation, which `fem-run calibrate` finds from measured \
                 restitutions"
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
