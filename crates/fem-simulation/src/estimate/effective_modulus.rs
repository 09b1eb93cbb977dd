//! Effective moduli of relaxing bodies during the contact. Effects are judged by them.
//!
//! A relaxing body is stopped by less than its instantaneous stiffness. Inertia, waves and the spheres' own compliance
//! change its contact as they change that of equally soft elastic bodies. The effective moduli are those with which Hertz'
//! force at the largest approach equals the peak force of Ting's model between half-spaces,
//!
//! ```math
//! E_s^* = \frac{3\,\max F}{4\,\sqrt R\;(\max\delta)^{3/2}}, \qquad E^*(t_s) = E_s^*,
//! ```
//!
//! and the modulus of each body is its relaxation modulus at the time t_s after a sudden load. For elastic bodies this
//! is the elastic modulus; with fast relaxation it tends to the equilibrium modulus; for a fluid it is the modulus at
//! the time in which it flows. For bodies that keep more than half of their moduli during the contact t_s = T/2, which
//! is right within some per cent.

use fem_case::{Body, Scene, Shape};
use fem_collision::{Collision, QuantityOfInterest};
use fem_laws::{HertzImpact, Impact, ImpactQuantities, LawError};
use fem_material::{ElasticModuli, Material};

use crate::estimate::quasi_static::KnownImpacts;
use crate::estimate::{Estimate, pair_at};

/// Bisections of the logarithm of t_s.
const BISECTIONS: usize = 50;
/// Decades on both sides of the contact time in which t_s is searched.
const SEARCHED_DECADES: f64 = 12.0;

/// The contact with the effective moduli of its bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectiveModuli {
    /// Time t_s after a sudden load at which the moduli are the effective ones, s; 0 for elastic bodies.
    pub after: f64,
    /// Hertz' impact with these moduli.
    pub hertz: HertzImpact,
    /// The expected quantities of the collision, by which its effects are scaled.
    pub sizes: ImpactQuantities,
    /// Contact radius at the largest pressure, m.
    pub pressure_radius: f64,
}

impl EffectiveModuli {
    /// Returns the effective moduli of weakly relaxing bodies, those at a time (s).
    pub(crate) fn little(hertz: &HertzImpact, after: f64) -> Self {
        let pressure_radius = hertz.max_contact_radius();
        Self { after, hertz: *hertz, sizes: hertz.into(), pressure_radius }
    }

    /// Returns the effective moduli of strongly relaxing bodies; `elastic` is the impact with instantaneous moduli.
    pub(crate) fn much(
        scene: &Scene,
        elastic: &HertzImpact,
        impacts: &KnownImpacts,
    ) -> Result<Self, LawError> {
        let impact = impacts.on_half_spaces(scene, elastic.pair(), elastic.approach_speed())?;
        let met = impact.peak_force / elastic.force(impact.max_approach);
        let share = |after: f64| {
            let pair = pair_at(scene, after, 0.0);
            pair.map_or(0.0, |pair| pair.contact_modulus() / elastic.pair().contact_modulus())
        };
        let of = |power: f64| elastic.contact_time() * 10f64.powf(power);
        let (mut stiff, mut soft) = (-SEARCHED_DECADES, SEARCHED_DECADES);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (stiff + soft);
            if share(of(middle)) > met { stiff = middle } else { soft = middle }
        }
        let after = of(stiff);
        let hertz = HertzImpact::new(&pair_at(scene, after, 0.0)?, elastic.approach_speed())?;
        let pressures = impact.history.iter().filter_map(|now| Some((now.centre_pressure?, now)));
        let pressed = pressures.max_by(|(one, _), (other, _)| one.total_cmp(other));
        let pressure_radius =
            pressed.map_or(impact.max_contact_radius, |(_, now)| now.contact_radius);
        Ok(Self { after, hertz, sizes: sizes_of(&impact, &hertz), pressure_radius })
    }

    /// Returns the scene with equally soft elastic bodies; the scene itself if nothing relaxes.
    pub(crate) fn elastic_equivalent(&self, scene: &Scene) -> Scene {
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

/// Returns the quantities of an impact. Bodies that stay together get the contact time of equally soft elastic ones.
pub(super) fn sizes_of(impact: &Impact, effective: &HertzImpact) -> ImpactQuantities {
    ImpactQuantities {
        restitution: impact.restitution,
        contact_time: impact.contact_time.unwrap_or_else(|| effective.contact_time()),
        peak_force: impact.peak_force,
        max_approach: impact.max_approach,
        max_contact_radius: impact.max_contact_radius,
        peak_pressure: impact.peak_pressure.unwrap_or_else(|| effective.peak_pressure()),
    }
}

impl Estimate {
    /// Returns the value in SI units that a relative error of a quantity belongs to; 1 for the restitution, whose errors
    /// are absolute.
    pub(crate) fn scale(&self, quantity: QuantityOfInterest) -> f64 {
        match quantity {
            QuantityOfInterest::Restitution => 1.0,
            _ => self.effective.sizes.in_order()[quantity as usize],
        }
    }

    /// Replaces the expected quantities of relaxing bodies by those of the finished collision.
    pub(crate) fn with_computed(&self, collision: &Collision) -> Self {
        let mut computed = self.clone();
        if self.relaxed == 0.0 {
            return computed;
        }
        let sizes = &mut computed.effective.sizes;
        for (size, of_collision) in [
            (&mut sizes.contact_time, collision.contact_time),
            (&mut sizes.peak_force, collision.peak_force),
            (&mut sizes.max_approach, collision.max_approach),
            (&mut sizes.max_contact_radius, collision.max_contact_radius),
            (&mut sizes.peak_pressure, collision.peak_pressure),
        ] {
            *size = of_collision.filter(|size| *size > 0.0 && size.is_finite()).unwrap_or(*size);
        }
        computed
    }
}

/// Returns the elastic material with the moduli at a time (s) after a sudden load.
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
