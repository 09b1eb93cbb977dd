//! Recovery of the pressure on the axis.
//!
//! Node k has the mean of p over its hat function, p(x̄) + ½ p″ var x in x = r². So p² is fitted by
//!
//! ```math
//! p^2 = c_0 + c_1 x + c_2 x^2
//! ```
//!
//! at x̄, to the means less the term ½ p″ var x of the previous fit. Hertz' profile has c₂ = 0. Relaxing bodies
//! need c₂: without it, fits over 0.8 a are 2 to 3 % too high where the moduli fall by e⁻² within the contact.

use super::{ContactEnforcement, HatMoments, NodalMean, nodal_means};

/// Largest number of fitted nodes, from the axis outward.
const MAX_FITTED_NODES: usize = 64;
/// Fits in the order of preference: number of terms, reach over the contact radius, least number of nodes. The
/// weights fall to zero at the reach, so that a node that enters or leaves causes no jump.
const FITS: [(usize, f64, usize); 2] = [(3, 0.6, 4), (2, 0.8, 2)];
/// Number of passes; the second changes the result by 0.1 %, the third by less than 1e-5.
const FIT_PASSES: usize = 3;
/// Valid range of the fitted pressure over that of the axis node. For two elements per contact radius Hertz'
/// profile gives 1.2.
const VALID_PRESSURE_RATIO: std::ops::Range<f64> = 0.8..1.4;
/// Relative deficit of the pressure at the first nodes, times a/h, caused by the elements at the axis. This and
/// the next two constants were measured on elastic spheres with 8 to 32 elements per radius.
const DEFICIT_OF_FIRST_NODES: [f64; 5] = [0.27, 0.085, 0.030, 0.012, 0.005];
/// Relative decrease of the pressure by springs of the penalty factor 1, times a/h: they spread the load.
const DECREASE_BY_SPRINGS: f64 = 0.022;
/// Remaining relative excess of the fit, times a²/h², for 4 to 8 elements per radius.
const EXCESS_OF_FIT: f64 = 0.15;
/// Largest h/a for which these constants are valid.
const MAX_SIZE_OVER_RADIUS: f64 = 0.5;

/// Coefficients of a fit of p² over x/a².
#[derive(Debug, Clone, Copy)]
struct PressureFit([f64; 3]);

impl PressureFit {
    /// Returns ½ p″ at x; p² is limited from below by a tenth of its fitted value.
    fn half_bend(self, x: f64, pressure: f64) -> f64 {
        let Self([c0, c1, c2]) = self;
        let p = (c0 + x * (c1 + x * c2)).max(0.1 * pressure * pressure).sqrt();
        let slope = c1 + 2.0 * c2 * x;
        0.5 * (c2 / p - slope * slope / (4.0 * p.powi(3)))
    }
}

/// Returns the contact pressure on the axis (Pa) for mean pressures at nodes from the axis outward (r in m, p in
/// Pa) and a contact radius, m; 0 without contact there.
pub fn centre_pressure(
    nodes: impl Iterator<Item = (f64, f64)> + Clone,
    contact_radius: f64,
    enforcement: ContactEnforcement,
) -> f64 {
    let means = nodal_means(nodes);
    let Some(axis) = means.clone().next().filter(|axis| axis.pressure != 0.0) else { return 0.0 };
    let size = axis.neighbours[1].unwrap_or(0.0);
    let coarseness = (size / contact_radius).min(MAX_SIZE_OVER_RADIUS);
    if !(axis.pressure.is_finite() && coarseness > 0.0) {
        return axis.pressure;
    }
    let scale = 1.0 - EXCESS_OF_FIT * coarseness * coarseness
        + match enforcement {
            ContactEnforcement::Springs => DECREASE_BY_SPRINGS * coarseness,
            ContactEnforcement::Rigid => 0.0,
        };
    // The moments are evaluated once for all fits and passes.
    let mut room = [FittedNode::default(); MAX_FITTED_NODES];
    let widest = (FITS[1].1 * contact_radius).powi(2);
    let mut n_inside = 0;
    for (k, cell) in means.take_while(|cell| cell.pressure > 0.0).take(MAX_FITTED_NODES).enumerate()
    {
        let weight = cell.hat_moments();
        if weight.square >= widest {
            break;
        }
        room[k] = FittedNode { pressure: without_layer(k, cell, coarseness).pressure, weight };
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
            && VALID_PRESSURE_RATIO.contains(&(pressure / axis.pressure))
        {
            return scale * pressure;
        }
    }
    scale * without_layer(0, axis, coarseness).pressure
}

/// Returns the contact pressures (Pa) at nodes from the axis outward (r in m, p in Pa): on the axis
/// [`centre_pressure`], at the next nodes corrected for the deficit near the axis, farther out unchanged.
pub fn pressure_profile(
    nodes: impl Iterator<Item = (f64, f64)> + Clone,
    contact_radius: f64,
    enforcement: ContactEnforcement,
) -> impl Iterator<Item = f64> + Clone {
    let on_axis = centre_pressure(nodes.clone(), contact_radius, enforcement);
    let size = nodes.clone().nth(1).map_or(0.0, |(radius, _)| radius);
    let coarseness = (size / contact_radius).min(MAX_SIZE_OVER_RADIUS);
    nodal_means(nodes).enumerate().map(move |(k, cell)| match k {
        0 => on_axis,
        _ if coarseness > 0.0 => without_layer(k, cell, coarseness).pressure,
        _ => cell.pressure,
    })
}

/// Corrects the pressure of a node for the deficit near the axis.
fn without_layer(k: usize, cell: NodalMean, coarseness: f64) -> NodalMean {
    let taken = DEFICIT_OF_FIRST_NODES.get(k).map_or(0.0, |layer| layer * coarseness);
    NodalMean { pressure: cell.pressure / (1.0 - taken), ..cell }
}

/// A fitted node.
#[derive(Debug, Clone, Copy, Default)]
struct FittedNode {
    /// Pressure corrected for the deficit near the axis, Pa.
    pressure: f64,
    weight: HatMoments,
}

/// Returns √c₀ of a fit with this number of terms; `None` if c₀ is not positive.
fn fitted(nodes: &[FittedNode], reach: f64, radius: f64, terms: usize) -> Option<f64> {
    let mut fit: Option<PressureFit> = None;
    for _ in 0..FIT_PASSES {
        let (mut moments, mut sums) = ([0.0; 5], [0.0; 3]);
        for FittedNode { pressure, weight } in nodes {
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
        fit = Some(PressureFit(solve(&moments, &sums, terms)));
    }
    let PressureFit([squared, ..]) = fit?;
    (squared > 0.0 && squared.is_finite()).then(|| squared.sqrt())
}

/// Returns the coefficients of the least-squares polynomial with this number of terms, by Cramer's rule.
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
