//! The contacts of one pair of bodies from its slowest to its fastest collision, by Hertz.

use fem_case::Scene;
use fem_laws::{HertzImpact, LawError};
use fem_material::Material;

use fem_simulation::effects::QUASI_STATIC_LIMIT;

/// Fewest elements across the largest and the smallest contact radius.
const ELEMENTS_ACROSS: (f64, f64) = (8.0, 4.0);
/// Fewest elements across the radius of the smaller sphere.
const ACROSS_SPHERE: f64 = 12.0;

/// Hertz' impacts with instantaneous moduli at the slowest and the fastest speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SpeedSpan {
    pub slowest: HertzImpact,
    pub fastest: HertzImpact,
}

/// A speed at which the inertia of the bodies matters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedDoubt {
    /// Approach speed, m/s.
    pub speed: f64,
    /// The speed over the slowest shear wave speed.
    pub mach: f64,
}

impl SpeedSpan {
    /// Creates the span for the bodies of a scene at these speeds, m/s.
    ///
    /// # Errors
    /// The numbers have no Hertz impact.
    pub fn of(scene: &Scene, speeds: &[f64]) -> Result<Self, LawError> {
        let pair = scene.pair()?;
        let (slowest, fastest) = ends(speeds);
        let at = |speed: f64| HertzImpact::new(&pair, speed);
        Ok(Self { slowest: at(slowest)?, fastest: at(fastest)? })
    }

    /// Returns the slowest and the fastest speed, m/s.
    pub fn speeds(&self) -> (f64, f64) {
        (self.slowest.approach_speed(), self.fastest.approach_speed())
    }

    /// Returns the contact time at a speed, s: T ∝ v^(−1/5).
    pub fn contact_time(&self, speed: f64) -> f64 {
        self.fastest.contact_time() * (speed / self.fastest.approach_speed()).powf(-0.2)
    }

    /// Returns the size of elements that resolve the smallest contact on a mesh for the largest, m.
    pub fn element_size(&self, scene: &Scene) -> f64 {
        let radii = scene.bodies().iter().filter_map(|body| Some(0.5 * body.diameter()?));
        let smallest_radius = radii.fold(f64::INFINITY, f64::min);
        (self.fastest.max_contact_radius() / ELEMENTS_ACROSS.0)
            .min(self.slowest.max_contact_radius() / ELEMENTS_ACROSS.1)
            .min(smallest_radius / ACROSS_SPHERE)
    }

    /// Returns the numbers of elements of a size (m) across the smallest and the largest contact radius.
    pub fn elements_across(&self, size: f64) -> (f64, f64) {
        (self.slowest.max_contact_radius() / size, self.fastest.max_contact_radius() / size)
    }

    /// Returns the fastest speed, if it is too fast for the quasi-static model.
    pub fn doubt(&self, scene: &Scene) -> Option<SpeedDoubt> {
        let materials = scene.bodies().iter().filter_map(|body| body.material());
        let slow = materials.map(Material::shear_wave_speed).fold(f64::INFINITY, f64::min);
        let speed = self.fastest.approach_speed();
        let mach = speed / slow;
        (mach > QUASI_STATIC_LIMIT).then_some(SpeedDoubt { speed, mach })
    }
}

/// Returns the smallest and the largest value.
pub(super) fn ends<'v>(values: impl IntoIterator<Item = &'v f64>) -> (f64, f64) {
    let start = (f64::INFINITY, 0.0f64);
    values.into_iter().fold(start, |(low, high), value| (low.min(*value), high.max(*value)))
}
