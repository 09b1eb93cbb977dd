//! The six quantities by which impacts are compared.

use crate::hertz::HertzImpact;

/// The quantities of interest of one impact. A closed form gives all of them without a history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpactQuantities {
    /// Relative velocity after over before; 0 if the bodies stay together.
    pub restitution: f64,
    /// Contact time, s; infinite if the bodies stay together.
    pub contact_time: f64,
    /// Largest force, N.
    pub peak_force: f64,
    /// Largest approach, m.
    pub max_approach: f64,
    /// Largest contact radius, m.
    pub max_contact_radius: f64,
    /// Largest pressure on the axis, Pa.
    pub peak_pressure: f64,
}

impl ImpactQuantities {
    /// Returns the quantities in the order of their declaration, which is that of a summary.
    pub fn in_order(&self) -> [f64; 6] {
        let Self { restitution, contact_time, peak_force, max_approach, .. } = *self;
        let (radius, pressure) = (self.max_contact_radius, self.peak_pressure);
        [restitution, contact_time, peak_force, max_approach, radius, pressure]
    }

    /// Returns the changes against another impact in the same order, relative to it; that of the restitution is absolute.
    pub fn change_from(&self, other: &Self) -> [f64; 6] {
        let (own, other) = (self.in_order(), other.in_order());
        std::array::from_fn(|k| match k {
            0 => own[0] - other[0],
            _ => own[k] / other[k] - 1.0,
        })
    }
}

impl From<&HertzImpact> for ImpactQuantities {
    fn from(hertz: &HertzImpact) -> Self {
        Self {
            restitution: hertz.restitution(),
            contact_time: hertz.contact_time(),
            peak_force: hertz.peak_force(),
            max_approach: hertz.max_approach(),
            max_contact_radius: hertz.max_contact_radius(),
            peak_pressure: hertz.peak_pressure(),
        }
    }
}
