//! The moduli that a contact of relaxing bodies meets, by which it is judged how fast, how stiff and how wide it is.
//!
//! A body that relaxes is stopped by less than its first response. What inertia, waves and the spheres' own
//! compliance take of such a contact is what they take of one of elastic bodies that are as soft. They are those of
//! which Hertz' force at the largest approach is the largest force of the collision as Ting's model foretells it on
//! half-spaces,
//!
//! ```math
//! E_s^* = \frac{3\,\max F}{4\,\sqrt R\;(\max\delta)^{3/2}}, \qquad E^*(t_s) = E_s^*,
//! ```
//!
//! the modulus of each body that at the time t_s after a sudden load. Of elastic bodies it is theirs; of bodies that
//! relax to a lasting modulus it comes down to that; of a fluid, of which nothing lasts, it is that of the time in
//! which it flows. Bodies that keep more than half of their moduli over the contact are taken in its middle, t_s =
//! T/2, which is within some per cent.

use fem_case::{Body, Scene, Shape};
use fem_collision::Collision;
use fem_laws::{HertzImpact, Impact, LawError};
use fem_material::{ElasticModuli, Material};

use crate::estimate::quasi_static::foretold_on_half_spaces;
use crate::estimate::{Estimate, pair_at};

/// Halvings of the logarithm of t_s.
const HALVINGS: usize = 50;
/// Decades about the contact time in which t_s is looked for.
const DECADES: f64 = 12.0;

/// The size of a collision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// Contact time, in seconds.
    pub contact_time: f64,
    /// Peak force, in newtons.
    pub peak_force: f64,
    /// m.
    pub max_approach: f64,
    /// m.
    pub max_contact_radius: f64,
    /// Peak pressure, in pascals.
    pub peak_pressure: f64,
}

/// A contact as relaxation makes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectiveModuli {
    /// Time t_s after a sudden load when the moduli are those that the contact meets, s; 0 of elastic bodies.
    pub after: f64,
    /// Hertz with these moduli.
    pub hertz: HertzImpact,
    /// The collision as it is expected.
    pub sizes: Sizes,
    /// Radius of the contact when its pressure is largest, m.
    pub pressure_radius: f64,
}

impl EffectiveModuli {
    /// Returns the moduli of bodies that hardly relax, at a time (s).
    pub(crate) fn little(hertz: &HertzImpact, after: f64) -> Self {
        let pressure_radius = hertz.max_contact_radius();
        Self { after, hertz: *hertz, sizes: Sizes::from(hertz), pressure_radius }
    }

    /// Returns the moduli of bodies that relax strongly, for an impact that is elastic with the
    /// instantaneous moduli.
    ///
    /// # Errors
    /// A motion that Ting's model has no answer to.
    pub(crate) fn much(scene: &Scene, elastic: &HertzImpact) -> Result<Self, LawError> {
        let impact = foretold_on_half_spaces(scene, elastic.pair(), elastic.approach_speed())?;
        let met = impact.peak_force / elastic.force(impact.max_approach);
        let share = |after: f64| {
            let pair = pair_at(scene, after, 0.0);
            pair.map_or(0.0, |pair| pair.contact_modulus() / elastic.pair().contact_modulus())
        };
        let of = |power: f64| elastic.contact_time() * 10f64.powf(power);
        let (mut stiff, mut soft) = (-DECADES, DECADES);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (stiff + soft);
            if share(of(middle)) > met { stiff = middle } else { soft = middle }
        }
        let after = of(stiff);
        let hertz = HertzImpact::new(&pair_at(scene, after, 0.0)?, elastic.approach_speed())?;
        let pressures = impact.history.iter().filter_map(|now| Some((now.centre_pressure?, now)));
        let pressed = pressures.max_by(|(one, _), (other, _)| one.total_cmp(other));
        let pressure_radius =
            pressed.map_or(impact.max_contact_radius, |(_, now)| now.contact_radius);
        Ok(Self { after, hertz, sizes: Sizes::of(&impact, &hertz), pressure_radius })
    }

    /// A scene of the elastic bodies that are as soft; the scene itself where nothing relaxes.
    pub(crate) fn twin(&self, scene: &Scene) -> Scene {
        if self.after == 0.0 {
            return scene.clone();
        }
        let shape = |body: &Body| -> Shape {
            body.material().map_or_else(
                || body.shape().clone(),
                |material| body.shape_of(left_at(material, self.after)),
            )
        };
        let [lower, upper] = scene.bodies();
        scene.clone().with_shapes([shape(lower), shape(upper)])
    }
}

impl Sizes {
    /// Returns the sizes for an impact. Bodies that stay together have the contact time of equally soft
    /// elastic ones.
    fn of(impact: &Impact, effective: &HertzImpact) -> Self {
        Self {
            contact_time: impact.contact_time.unwrap_or_else(|| effective.contact_time()),
            peak_force: impact.peak_force,
            max_approach: impact.max_approach,
            max_contact_radius: impact.max_contact_radius,
            peak_pressure: impact.peak_pressure.unwrap_or_else(|| effective.peak_pressure()),
        }
    }
}

impl From<&HertzImpact> for Sizes {
    fn from(hertz: &HertzImpact) -> Self {
        Self {
            contact_time: hertz.contact_time(),
            peak_force: hertz.peak_force(),
            max_approach: hertz.max_approach(),
            max_contact_radius: hertz.max_contact_radius(),
            peak_pressure: hertz.peak_pressure(),
        }
    }
}

impl Estimate {
    /// With the size of a collision as it came in place of the one that was expected, of bodies that relax.
    pub(crate) fn as_came(&self, collision: &Collision) -> Self {
        let mut came = *self;
        if self.relaxed == 0.0 {
            return came;
        }
        let sizes = &mut came.effective.sizes;
        for (size, of_collision) in [
            (&mut sizes.contact_time, collision.contact_time),
            (&mut sizes.peak_force, collision.peak_force),
            (&mut sizes.max_approach, collision.max_approach),
            (&mut sizes.max_contact_radius, collision.max_contact_radius),
            (&mut sizes.peak_pressure, collision.peak_pressure),
        ] {
            *size = of_collision.filter(|size| *size > 0.0 && size.is_finite()).unwrap_or(*size);
        }
        came
    }
}

/// An elastic material of what is left of the moduli at a time, s.
pub(crate) fn left_at(material: &Material, time: f64) -> Material {
    if material.relaxation().is_none() {
        return material.clone();
    }
    let moduli = ElasticModuli::from_bulk_shear(
        material.bulk_modulus_at(time),
        material.shear_modulus_at(time),
    );
    let left = moduli.and_then(|moduli| Material::new(material.density(), moduli, None));
    left.unwrap_or_else(|_| material.without_relaxation())
}
