//! A half-space under the pressure of a contact: the displacement and the strain of its surface.

use crate::fields::ContactProfile;

/// Contact radii within which the strain of the half-space is taken from the pressure.
const REACH: f64 = 2.5;

/// The nodes of a surface near a contact, and the half-space under the same pressure.
pub(super) struct HalfSpace {
    /// (1 − 2ν)/2G, 1/Pa.
    compliance: f64,
    /// Radius (m) and load of the nodes from the pole outward, and of one more.
    nodes: Vec<(f64, RadialLoad)>,
    /// Number of nodes near the contact.
    pub n_near: usize,
}

impl HalfSpace {
    /// Takes the nodes at these radii (m), as long as the surface runs outward.
    pub fn new(compliance: f64, contact: &ContactProfile, radii: &[f64]) -> Self {
        let loads = RadialLoads::of(contact);
        let runs_outward = |k: usize| k == 0 || radii[k] > radii[k - 1];
        let reach = REACH * contact.radius;
        let near = (0..radii.len()).take_while(|&k| radii[k] < reach && runs_outward(k)).count();
        let nodes = radii.iter().take(near + 1).map(|&radius| (radius, loads.at(radius)));
        let nodes: Vec<_> = nodes.collect();
        Self { compliance, n_near: near.min(nodes.len().saturating_sub(1)), nodes }
    }

    /// Returns whether a node is near the contact.
    pub fn is_near(&self, k: usize) -> bool {
        k < self.n_near
    }

    /// Returns u_r of the half-space at a node near the contact or next to one, m.
    pub fn displacement(&self, k: usize) -> f64 {
        let (radius, load) = self.nodes[k];
        if radius > 0.0 { -self.compliance * load.inner / radius } else { 0.0 }
    }

    /// Returns u_r/r of the half-space at a node near the contact; on the axis it is half of ε_ss + ε_θθ.
    pub fn hoop_strain(&self, k: usize) -> f64 {
        let (radius, load) = self.nodes[k];
        if radius > 0.0 {
            -self.compliance * load.inner / (radius * radius)
        } else {
            -0.5 * self.compliance * load.pressure
        }
    }

    /// Returns ε_ss + ε_θθ of the half-space at a node; 0 far from the contact.
    pub fn dilatation(&self, k: usize) -> f64 {
        -self.compliance * self.pressure(k)
    }

    /// Returns the contact pressure at a node, Pa; 0 far from the contact.
    pub fn pressure(&self, k: usize) -> f64 {
        if self.is_near(k) { self.nodes[k].1.pressure } else { 0.0 }
    }
}

/// The contact pressure p (Pa) at a radius, and ∫₀ʳ p ρ dρ, N.
#[derive(Debug, Clone, Copy, Default)]
struct RadialLoad {
    pressure: f64,
    inner: f64,
}

/// The contact pressure and its integral at the points of a profile.
struct RadialLoads<'a> {
    contact: &'a ContactProfile,
    inner: Vec<f64>,
}

impl<'a> RadialLoads<'a> {
    fn of(contact: &'a ContactProfile) -> Self {
        let mut inner = Vec::with_capacity(contact.places.len());
        let (mut sum, mut before) = (0.0, [0.0; 2]);
        for (k, place) in contact.places.iter().enumerate() {
            let here = [place.radius, place.pressure];
            sum += if k == 0 { 0.5 * here[1] * here[0] * here[0] } else { between(before, here) };
            before = here;
            inner.push(sum);
        }
        Self { contact, inner }
    }

    /// Returns pressure and integral at a radius (m), for a pressure that is linear between the points of the profile.
    fn at(&self, radius: f64) -> RadialLoad {
        let (places, pressure) = (&self.contact.places, self.contact.pressure_at(radius));
        let outer = places.partition_point(|place| place.radius <= radius);
        let inner = match outer.checked_sub(1).map(|k| (&places[k], self.inner[k])) {
            Some((place, sum)) => sum + between([place.radius, place.pressure], [radius, pressure]),
            None => 0.5 * pressure * radius * radius,
        };
        RadialLoad { pressure, inner }
    }
}

/// Returns ∫ p ρ dρ between two points (ρ, p), by Simpson's rule, which is exact for a linear p.
fn between([a, p]: [f64; 2], [b, q]: [f64; 2]) -> f64 {
    (b - a) / 6.0 * (a * p + (a + b) * (p + q) + b * q)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fields::surface::tests::profile;

    /// ∫ p ρ dρ of p = 2 − ρ is ρ² − ρ³/3, at points and between them, and constant beyond the last one.
    #[test]
    fn pressure_and_its_integral_are_those_of_a_linear_pressure() {
        let contact = profile(2.0, |r| 2.0 - r);
        let loads = RadialLoads::of(&contact);
        for r in [0.0, 0.01, 0.5, 1.7, 2.0] {
            let load = loads.at(r);
            // Rounding of 64 parts.
            assert!((load.inner - (r * r - r * r * r / 3.0)).abs() < 1e-14, "{r} {load:?}");
            assert!((load.pressure - (2.0 - r)).abs() < 1e-14, "{r} {load:?}");
        }
        assert_eq!((loads.at(3.0).pressure, loads.at(3.0).inner), (0.0, loads.at(2.0).inner));
    }
}
