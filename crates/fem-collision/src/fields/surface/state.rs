//! The stress of a surface from its strain, its traction and the elements around its nodes.

use fem_material::ElasticModuli;

use crate::fields::stress::invariants;

/// Stress and strain of an element.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ElementState {
    /// (σ_rr, σ_yy, σ_θθ, σ_ry), Pa.
    pub stress: [f64; 4],
    /// (ε_rr, ε_yy, ε_θθ, γ_ry).
    pub strain: [f64; 4],
    pub flows: bool,
}

/// A node of the surface at an instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct SurfaceNode {
    /// Unit tangents (r, y) of the undeformed and of the deformed surface.
    pub tangents: [[f64; 2]; 2],
    /// Contact pressure, Pa.
    pub pressure: f64,
    /// Strains along the meridian and along the hoop.
    pub strains: [f64; 2],
}

/// The surface of a body at an instant.
#[derive(Debug)]
pub(crate) struct SurfaceState {
    pub(super) moduli: ElasticModuli,
    pub(super) nodes: Vec<SurfaceNode>,
}

impl SurfaceState {
    /// Returns (σ_rr, σ_yy, σ_θθ, σ_ry) at a node of the surface, Pa, from the elements around it and the stress that is
    /// extrapolated from them.
    pub fn stress(
        &self,
        position: usize,
        elements: impl Iterator<Item = ElementState> + Clone,
        extrapolated: [f64; 4],
    ) -> [f64; 4] {
        let node = &self.nodes[position];
        if elements.clone().any(|element| element.flows) {
            let largest = elements.map(|element| invariants(element.stress).1).fold(0.0, f64::max);
            return node.flowing(extrapolated, largest);
        }
        let (mut meridian, mut hoop, mut n) = (0.0, 0.0, 0.0);
        for element in elements {
            let [along, around] = self.of_element(node, &element);
            (meridian, hoop, n) = (meridian + along, hoop + around, n + 1.0);
        }
        node.components(meridian / n, hoop / n)
    }

    /// Returns σ_ss and σ_θθ at a node from one element.
    fn of_element(&self, node: &SurfaceNode, element: &ElementState) -> [f64; 2] {
        let [reference, deformed] = node.tangents;
        let [_, normal, _] = in_axes(deformed, element.stress);
        let [rr, yy, tt, ry] = element.strain;
        let [strain, ..] = in_axes(reference, [rr, yy, tt, 0.5 * ry]);
        let (along, around) = (node.strains[0] - strain, node.strains[1] - tt);
        let (lambda, shear) = (self.moduli.lame_lambda(), self.moduli.shear_modulus());
        let across = (-node.pressure - normal - lambda * (along + around)) / (lambda + 2.0 * shear);
        let volume = lambda * (along + around + across);
        let [meridian, ..] = in_axes(deformed, element.stress);
        [meridian + volume + 2.0 * shear * along, element.stress[2] + volume + 2.0 * shear * around]
    }
}

impl SurfaceNode {
    /// Returns the stress of a flowing body: the deviator of an extrapolated one, with at most this von Mises stress, and
    /// the pressure that the traction asks for.
    fn flowing(&self, extrapolated: [f64; 4], largest: f64) -> [f64; 4] {
        let [meridian, normal, _] = in_axes(self.tangents[1], extrapolated);
        let hoop = extrapolated[2];
        let (_, von_mises) = invariants([meridian, normal, hoop, 0.0]);
        let scale = if von_mises > largest { largest / von_mises } else { 1.0 };
        let from_normal = |stress: f64| scale * (stress - normal) - self.pressure;
        self.components(from_normal(meridian), from_normal(hoop))
    }

    /// Returns (σ_rr, σ_yy, σ_θθ, σ_ry) of the stresses along the meridian and the hoop, with the pressure on the surface.
    fn components(&self, meridian: f64, hoop: f64) -> [f64; 4] {
        let [r, y] = self.tangents[1];
        let normal = -self.pressure;
        [
            meridian * r * r + normal * y * y,
            meridian * y * y + normal * r * r,
            hoop,
            (meridian - normal) * r * y,
        ]
    }
}

/// Returns the components ss, nn and sn of a tensor (rr, yy, θθ, ry), for a unit tangent s and its normal n = (−s_y, s_r).
fn in_axes([r, y]: [f64; 2], [rr, yy, _, ry]: [f64; 4]) -> [f64; 3] {
    [
        rr * r * r + yy * y * y + 2.0 * ry * r * y,
        rr * y * y + yy * r * r - 2.0 * ry * r * y,
        (yy - rr) * r * y + ry * (r * r - y * y),
    ]
}
