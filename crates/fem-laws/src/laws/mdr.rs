//! The law of LAMMPS' `pair_style granular` with `mdr`, without its adhesion, damping and response in bulk.
//!
//! Either sphere of the radius R is pressed by a rigid flat at the place where the spheres would intersect, to the depth
//!
//! ```math
//! \delta_1 = \frac{\delta\,(2R_2-\delta)}{2(R_1+R_2-\delta)}, \qquad \delta_2 = \delta-\delta_1,
//! ```
//!
//! and the force is the mean of both. With the plane strain modulus E' of the spheres, 2E\* (E\* of a sphere on a flat),
//! a sphere is Hertz' up to the mean pressure p_Y, and flows beyond:
//!
//! ```math
//! p_Y = Y\bigl(1 + 1.75\,e^{-4.4\,\delta_m/R}\bigr), \qquad
//! F = \pi a^2p_Y, \quad a^2 = 2R\delta - \delta^2 - \delta_Y(R-\delta_Y) .
//! ```
//!
//! It springs back as an elliptical profile of the height A = 4p_Y a/E' does on a layer of springs, from the depth A/2, and
//! with the displacement δ_R that the stress in the sphere adds:
//!
//! ```math
//! \frac F{F_m} = \frac2\pi\Bigl(\arccos(1-s) - (1-s)\sqrt{2s-s^2}\Bigr), \quad 0\le s\le1, \qquad
//! \ell = \frac A2 + \delta_R,
//! ```
//!
//! ```math
//! \delta_R = \frac{F_m}{2\pi a^2Gr}\Bigl(-2(1-\nu)a^2 + (1-2\nu)\,z(r-z)\Bigr), \quad z = R-\delta+\tfrac A2,\;
//! r = \sqrt{a^2+z^2},
//! ```
//!
//! whose work is 4/(3π) F_m ℓ. Zunker & Kamrin (2024), *J. Mech. Phys. Solids* 183, 105492 and 105493, as read in
//! `gran_sub_mod_normal.cpp` of LAMMPS. LAMMPS also lets a sphere grow by the volume that it displaces, and multiplies the force
//! of a wall by 1 + exp(10.7 δ/R − 10); both are left out here and are worth 1e-3 of the restitution at most, which
//! `.ci/check_dem.py` sees.

use std::f64::consts::PI;

use crate::numerics::bisection::last_where;
use crate::pair::Pair;

/// Share of F ℓ that an elliptical profile returns from half of its height.
const RETURNED: f64 = 4.0 / (3.0 * PI);
/// Share of F δ that Hertz' contact returns.
const RETURNED_BY_HERTZ: f64 = 0.4;

/// The law, with its parameters in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mdr {
    /// E' = E/(1 − ν²), Pa.
    modulus: f64,
    poissons_ratio: f64,
    strength: f64,
    /// The spheres; one on a flat stands twice, since its force is the mean then too.
    sides: [Side; 2],
    is_on_flat: bool,
}

/// One of the two spheres.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Side {
    radius: f64,
    /// Depth of first yield, m.
    yields: f64,
}

/// A sphere at a depth.
struct Pressed {
    force: f64,
    /// Square of the contact radius, m².
    area: f64,
    /// Depth that springs back, m, and the share of its product with the force that is energy.
    length: f64,
    returned: f64,
}

impl Mdr {
    /// Creates the law of a pair with a yield strength, Pa, and the radius of the smaller sphere over that of the larger one.
    pub fn new(pair: &Pair, strength: f64, poissons_ratio: f64, radius_ratio: f64) -> Self {
        let is_on_flat = radius_ratio == 0.0;
        let small = pair.effective_radius() * (1.0 + radius_ratio);
        let radii = if is_on_flat { [small; 2] } else { [small, small / radius_ratio] };
        let modulus = pair.contact_modulus() * if is_on_flat { 1.0 } else { 2.0 };
        let sides = radii.map(|radius| {
            let is_elastic = |share: f64| {
                4.0 * modulus * share.sqrt() <= 3.0 * PI * strength * constraint(share)
            };
            Side { radius, yields: radius * last_where(0.0, 1.0, is_elastic) }
        });
        Self { modulus, poissons_ratio, strength, sides, is_on_flat }
    }

    /// Returns the approach at which the first of both spheres yields, m.
    pub fn yield_approach(&self) -> f64 {
        let [first, second] = self.sides;
        if self.is_on_flat {
            return first.yields;
        }
        // The smaller root of the approach at which a depth is that of first yield.
        let of = |side: Side, other: Side| {
            let (both, sum) = (side.radius + other.radius, other.radius + side.yields);
            let root = (sum * sum - 2.0 * side.yields * both).max(0.0).sqrt();
            2.0 * side.yields * both / (sum + root)
        };
        of(first, second).min(of(second, first))
    }

    /// Returns the depths of both spheres, m.
    fn depths(&self, approach: f64) -> [f64; 2] {
        if self.is_on_flat {
            return [approach; 2];
        }
        let [first, second] = self.sides.map(|side| side.radius);
        // The formulas end where the smaller sphere is flat; the law goes on with a constant force.
        let near = approach.min(first);
        let share = (2.0 * second - near) / (2.0 * (first + second - near));
        [share * approach, (1.0 - share) * approach]
    }

    fn pressed(&self, side: &Side, depth: f64) -> Pressed {
        let (radius, modulus, nu) = (side.radius, self.modulus, self.poissons_ratio);
        let depth = depth.min(radius);
        if depth <= side.yields {
            let area = radius * depth;
            let force = 4.0 / 3.0 * modulus * area.sqrt() * depth;
            return Pressed { force, area, length: depth, returned: RETURNED_BY_HERTZ };
        }
        let pressure = self.strength * constraint(depth / radius);
        let area = 2.0 * radius * depth - depth * depth - side.yields * (radius - side.yields);
        let force = PI * area * pressure;
        let half_height = 2.0 * pressure * area.sqrt() / modulus;
        let centre = radius - depth + half_height;
        let distance = area.sqrt().hypot(centre);
        let shear_modulus = 0.5 * modulus * (1.0 - nu);
        let inner = (1.0 - 2.0 * nu) * centre * (distance - centre) - 2.0 * (1.0 - nu) * area;
        let within = force / (2.0 * PI * area * shear_modulus * distance) * inner;
        Pressed { force, area, length: half_height + within, returned: RETURNED }
    }

    fn both(&self, approach: f64) -> [Pressed; 2] {
        let [first, second] = self.depths(approach);
        [self.pressed(&self.sides[0], first), self.pressed(&self.sides[1], second)]
    }

    /// Returns the force of the loading, N.
    pub fn force(&self, approach: f64) -> f64 {
        self.both(approach).iter().map(|side| 0.5 * side.force).sum()
    }

    /// Returns the root of the mean square of both contact radii, m.
    pub fn contact_radius(&self, approach: f64) -> f64 {
        self.both(approach).iter().map(|side| 0.5 * side.area).sum::<f64>().sqrt()
    }

    /// Returns the length, m, and the energy, J, of the rebound from an approach, m. Both depths reach their ends at once.
    pub fn rebound(&self, approach: f64) -> (f64, f64) {
        let both = self.both(approach);
        let mean =
            |value: fn(&Pressed) -> f64| both.iter().map(|side| 0.5 * value(side)).sum::<f64>();
        let length = mean(|side| side.length) * if self.is_on_flat { 1.0 } else { 2.0 };
        (length, length * mean(|side| side.returned * side.force))
    }
}

/// Returns p_Y/Y at a depth over the radius.
fn constraint(depth: f64) -> f64 {
    1.0 + 1.75 * (-4.4 * depth).exp()
}
