//! A scene with the closed-form estimate of its collision, found once and carried by plan and model.

use std::borrow::Cow;

use fem_case::Scene;
use fem_laws::LawError;
use fem_material::Material;
use fem_material::engineering::{number, show};

use crate::estimate::Estimate;
use crate::estimate::quasi_static::KnownImpacts;
use crate::rejection::Rejection;

/// A scene for which a model is built, and its estimate.
#[derive(Clone, Debug)]
pub struct Regime {
    /// The scene that a model is built for.
    pub scene: Scene,
    /// Closed-form estimate of its collision.
    pub estimate: Estimate,
}

impl Regime {
    /// Estimates a scene.
    ///
    /// # Errors
    /// Those of [`Estimate::of`], as a fault of the scene; masses out of the range of f64.
    pub fn of(scene: Scene) -> Result<Self, Rejection> {
        Self::checked(scene, KnownImpacts::default())
    }

    /// Estimates a variant of the scene, with the impacts that are known already.
    ///
    /// # Errors
    /// Those of [`Regime::of`].
    pub(crate) fn variant(&self, scene: Scene) -> Result<Self, Rejection> {
        Self::checked(scene, self.estimate.impacts.clone())
    }

    /// Returns the estimate of the scene at an approach speed, m/s.
    ///
    /// # Errors
    /// Those of [`Estimate::of`].
    pub(crate) fn at(&self, speed: f64) -> Result<Cow<'_, Estimate>, LawError> {
        match speed == self.estimate.hertz.approach_speed() {
            true => Ok(Cow::Borrowed(&self.estimate)),
            false => self.estimate.of_variant(&self.scene, speed).map(Cow::Owned),
        }
    }

    fn checked(scene: Scene, known: KnownImpacts) -> Result<Self, Rejection> {
        let rejected = |why: String| {
            Rejection::new("body", format!("the collision cannot be estimated: {why}"))
                .with_help("check sizes, densities, moduli and speeds, and their units")
        };
        // An infinite mass would count as a wall, and products of masses must be finite too.
        let bodies = scene.bodies().iter().enumerate();
        let mut masses = bodies.filter_map(|(k, body)| Some((k, body, body.mass()?)));
        if let Some((k, body, mass)) = masses.find(|(_, _, mass)| !(mass * mass).is_normal()) {
            let (density, diameter) = (body.material().map(Material::density), body.diameter());
            // The factor that is farther from 1 in SI, by its power in the mass, is the likely cause.
            let far = |value: Option<f64>| value.map_or(0.0, |value| value.log10().abs());
            let is_density = far(density) > 3.0 * far(diameter);
            let (part, of) = match is_density {
                true => {
                    ("material", format!("density is {} kg/m^3", number(density.unwrap_or(0.0), 4)))
                }
                false => (
                    "sphere.diameter",
                    format!("diameter is {}", show(diameter.unwrap_or(0.0), "m")),
                ),
            };
            let mut rejection = rejected(format!(
                "the mass of {} is {} kg, since its {of}; its square must be a number",
                body.name(),
                number(mass, 4)
            ));
            rejection.key = format!("body.{k}.{part}");
            return Err(rejection);
        }
        match Estimate::with_known(&scene, scene.approach_speed(), known) {
            Ok(estimate) => Ok(Self { scene, estimate }),
            Err(error) => Err(rejected(error.to_string())),
        }
    }
}
