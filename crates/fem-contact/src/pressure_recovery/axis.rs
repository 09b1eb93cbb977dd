//! Recovery of the pressure on the axis.
//!
//! Node k has the mean of p over its hat, p(x̄) + ½ p″ var x in x = r², for areas are even in x. So p² is fitted by
//!
//! ```math
//! p^2 = c_0 + c_1 x + c_2 x^2
//! ```
//!
//! at x̄, to the means without what p″ of the fit before adds to them. Hertz' profile has c₂ = 0; that of
//! bodies that relax is followed by it: fits of two terms over 0.8 a are 2 to 3 % too high
//! where the moduli fall by e⁻² within the contact.

use super::{Cell, ContactEnforcement, Weight, cells};

/// Nodes that a fit takes at most, from the axis outward: plenty for three coefficients.
const MOST: usize = 64;
/// The fits that are tried: terms, share of the contact radius over which they go, fewest nodes. Their
/// weight falls to zero there, so that no node that comes or goes makes a step.
const FITS: [(usize, f64, usize); 2] = [(3, 0.6, 4), (2, 0.8, 2)];
/// Passes; the second moves the result by 0.1 %, the third by less than 1e-5.
const PASSES: usize = 3;
/// A fit that leaves these multiples of the pressure at the axis node goes astray; of a contact two elements
/// across the radius Hertz' profile is at 1.2.
const SOUND: std::ops::Range<f64> = 0.8..1.4;
/// By what the pressures at the first nodes are below the profile, times a/h: the axis is a place of its
/// own to elements. Measured on elastic spheres, 8 to 32 elements across the radius; so are the next two.
const LAYER: [f64; 5] = [0.27, 0.085, 0.030, 0.012, 0.005];
/// Springs spread the load: the pressure is lower by this times h/a, the penalty factor 1.
const SPRINGS: f64 = 0.022;
/// What the fit still is too high, times a²/h², 4 to 8 elements across the radius.
const BEND: f64 = 0.15;
/// Largest h/a that these are for.
const COARSEST: f64 = 0.5;

/// A fit of p² over x/a².
#[derive(Debug, Clone, Copy)]
struct Fit([f64; 3]);

impl Fit {
    /// ½ p″ at x, if p² is more than a share of what it was fitted to.
    fn half_bend(self, x: f64, pressure: f64) -> f64 {
        let Self([c0, c1, c2]) = self;
        let p = (c0 + x * (c1 + x * c2)).max(0.1 * pressure * pressure).sqrt();
        let slope = c1 + 2.0 * c2 * x;
        0.5 * (c2 / p - slope * slope / (4.0 * p.powi(3)))
    }
}

/// Contact pressure on the axis (Pa) of pressures at nodes from the axis outward (r in m, p in Pa), for
/// a contact radius, m; 0 without contact there.
pub fn centre_pressure(
    nodes: impl Iterator<Item = (f64, f64)> + Clone,
    contact_radius: f64,
    barrier: ContactEnforcement,
) -> f64 {
    let cells = cells(nodes);
    let Some(axis) = cells.clone().next().filter(|axis| axis.pressure != 0.0) else { return 0.0 };
    let size = axis.neighbours[1].unwrap_or(0.0);
    let coarseness = (size / contact_radius).min(COARSEST);
    if !(axis.pressure.is_finite() && coarseness > 0.0) {
        return axis.pressure;
    }
    let scale = 1.0 - BEND * coarseness * coarseness
        + match barrier {
            ContactEnforcement::Springs => SPRINGS * coarseness,
            ContactEnforcement::Rigid => 0.0,
        };
    // What weights cost is spent once for all fits and passes.
    let mut room = [Inside::default(); MOST];
    let widest = (FITS[1].1 * contact_radius).powi(2);
    let mut n_inside = 0;
    for (k, cell) in cells.take_while(|cell| cell.pressure > 0.0).take(MOST).enumerate() {
        let weight = cell.weight();
        if weight.square >= widest {
            break;
        }
        room[k] = Inside { pressure: without_layer(k, cell, coarseness).pressure, weight };
        n_inside = k + 1;
    }
    let inside = |reach: f64| {
        let end = (reach * contact_radius).powi(2);
        let inside = &room[..n_inside];
        let n_near = inside.iter().position(|node| node.weight.square >= end);
        &inside[..n_near.unwrap_or(n_inside)]
    };
    for (terms, reach, fewest) in FITS {
        if inside(reach).len() >= fewest
            && let Some(pressure) = fitted(inside(reach), reach, contact_radius, terms)
            && SOUND.contains(&(pressure / axis.pressure))
        {
            return scale * pressure;
        }
    }
    scale * without_layer(0, axis, coarseness).pressure
}

/// Contact pressures at nodes from the axis outward (r in m, p in Pa), Pa: on the axis [`centre_pressure`], at
/// the next without what elements take off them there, farther out as they are.
pub fn pressure_profile(
    nodes: impl Iterator<Item = (f64, f64)> + Clone,
    contact_radius: f64,
    barrier: ContactEnforcement,
) -> impl Iterator<Item = f64> + Clone {
    let on_axis = centre_pressure(nodes.clone(), contact_radius, barrier);
    let size = nodes.clone().nth(1).map_or(0.0, |(radius, _)| radius);
    let coarseness = (size / contact_radius).min(COARSEST);
    cells(nodes).enumerate().map(move |(k, cell)| match k {
        0 => on_axis,
        _ if coarseness > 0.0 => without_layer(k, cell, coarseness).pressure,
        _ => cell.pressure,
    })
}

/// A cell without what elements take off the pressure near the axis.
fn without_layer(k: usize, cell: Cell, coarseness: f64) -> Cell {
    let taken = LAYER.get(k).map_or(0.0, |layer| layer * coarseness);
    Cell { pressure: cell.pressure / (1.0 - taken), ..cell }
}

/// A node that a fit takes.
#[derive(Debug, Clone, Copy, Default)]
struct Inside {
    /// Without what elements take off it, Pa.
    pressure: f64,
    weight: Weight,
}

/// √c₀ of a fit of so many terms; `None` if it has none.
fn fitted(nodes: &[Inside], reach: f64, radius: f64, terms: usize) -> Option<f64> {
    let mut fit: Option<Fit> = None;
    for _ in 0..PASSES {
        let (mut moments, mut sums) = ([0.0; 5], [0.0; 3]);
        for Inside { pressure, weight } in nodes {
            let (x, spread) = (weight.square / radius.powi(2), weight.variance / radius.powi(4));
            let bend = fit.map_or(0.0, |fit| fit.half_bend(x, *pressure));
            let squared = (pressure - bend * spread).powi(2);
            let taper = 1.0 - x / (reach * reach);
            let mut term = weight.area * taper / pressure.powi(2);
            for k in 0..5 {
                moments[k] += term;
                if k < 3 {
                    sums[k] += term * squared;
                }
                term *= x;
            }
        }
        fit = Some(Fit(solve(&moments, &sums, terms)));
    }
    let Fit([squared, ..]) = fit?;
    (squared > 0.0 && squared.is_finite()).then(|| squared.sqrt())
}

/// Coefficients of the least-squares polynomial with so many terms, by Cramer's rule.
fn solve(m: &[f64; 5], y: &[f64; 3], terms: usize) -> [f64; 3] {
    if terms == 2 {
        let determinant = m[0] * m[2] - m[1] * m[1];
        return [
            (y[0] * m[2] - y[1] * m[1]) / determinant,
            (m[0] * y[1] - m[1] * y[0]) / determinant,
            0.0,
        ];
    }
    let determinant = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1])
            + c[0] * (a[1] * b[2] - a[2] * b[1])
    };
    let columns = [[m[0], m[1], m[2]], [m[1], m[2], m[3]], [m[2], m[3], m[4]]];
    let [a, b, c] = columns;
    let whole = determinant(a, b, c);
    [determinant(*y, b, c), determinant(a, *y, c), determinant(a, b, *y)].map(|part| part / whole)
}
