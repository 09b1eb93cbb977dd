//! Plausibility checks: numbers of a scene that are possible but unlikely, such as after a
//! forgotten unit; and what its numbers do not say. They are told, never refused.

use crate::engineering::{number, show};
use crate::scene::Scene;
use crate::scene::body::{Body, Shape};
use crate::scene::model::ModelChoice;

/// Larger than what is thrown at each other; a bare number is in metres.
const LARGEST_DIAMETER: f64 = 100.0;
/// A sphere of a metre and more beside one that is so much smaller.
const LARGE: f64 = 1.0;
const LARGEST_RATIO: f64 = 100.0;
/// Aerogel is 1 to 100 kg/m³, osmium 22,590.
const DENSITIES: std::ops::RangeInclusive<f64> = 10.0..=25_000.0;
/// The softest gels have some 100 Pa, diamond has 1.2 TPa.
const YOUNGS_MODULI: std::ops::RangeInclusive<f64> = 100.0..=2e12;

/// Share of the contact's compliance from which what a body loses counts, a share of what its partner does.
const LEAST_SHARE: f64 = 1e-3;

impl Scene {
    /// Materials of the library, without `lib:`, of which no loss is published and the case gives no relaxation:
    /// the restitution lacks what they lose. None of a contact law, whose loss is the user's, and of a body that
    /// hardly deforms.
    pub fn materials_of_unpublished_loss(&self) -> Vec<&str> {
        if matches!(self.model, ModelChoice::Law { .. }) {
            return Vec::new();
        }
        let deforms = self.bodies.iter().zip(self.compliance_shares());
        let deforms = deforms.filter(|(_, share)| *share > LEAST_SHARE).map(|(body, _)| body);
        let mut names: Vec<&str> = deforms.filter_map(Body::unpublished_loss).collect();
        names.dedup();
        names
    }

    /// That the restitution lacks what the [materials of unpublished loss](Self::materials_of_unpublished_loss)
    /// lose, in words.
    pub fn unpublished_loss(&self) -> Option<String> {
        let names = self.materials_of_unpublished_loss();
        (!names.is_empty()).then(|| {
            let names = names.join(" and ");
            format!(
                "what {names} {} in an impact is not published: the restitution is computed as if that were \
                 nothing, and how far it is off is not known; give the material a relaxation, `fem-run \
                 calibrate` finds one from measured restitutions",
                if names.contains(" and ") { "lose" } else { "loses" },
            )
        })
    }

    /// The sizes of spheres all of which are of a metre and more, which may well be meant, with the unit that they are
    /// read in; none where one of them is [odd](Self::oddities).
    pub fn large_spheres(&self) -> Option<String> {
        let spheres: Vec<f64> = self.bodies.iter().filter_map(Body::diameter).collect();
        let are_large =
            spheres.iter().all(|diameter| (LARGE..=LARGEST_DIAMETER).contains(diameter));
        let sizes: Vec<String> = spheres.iter().map(|diameter| show(*diameter, "m")).collect();
        are_large
            .then(|| format!("spheres of {} (bare numbers are in metres)", sizes.join(" and ")))
    }

    /// What is so far from all bodies that a unit was probably forgotten, a sentence each.
    pub fn oddities(&self) -> Vec<String> {
        let mut found = Vec::new();
        let diameters = self.bodies.each_ref().map(|body| body.diameter());
        for (k, body) in self.bodies.iter().enumerate() {
            let name = body.name();
            let key = format!("body.{k}.sphere.diameter");
            let other = diameters[1 - k];
            if let Some(diameter) = diameters[k] {
                if diameter > LARGEST_DIAMETER {
                    found.push(format!(
                        "the diameter of {name} is {} ({key}); a bare number is in metres",
                        show(diameter, "m")
                    ));
                } else if let Some(other) = other
                    && diameter >= LARGE
                    && diameter > LARGEST_RATIO * other
                {
                    found.push(format!(
                        "the diameter of {name} is {} ({key}), beside one of {}; a \
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
                    "the density of {name} is {} kg/m^3; solids have 10 to 25000, and a bare \
                     number is in kg/m^3",
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
