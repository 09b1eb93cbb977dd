//! Time–temperature superposition: isothermal blocks of moduli become one master curve.
//!
//! The shifts are those with which a single series meets all blocks best (`joint`). They start from the shift of each block against its
//! neighbour: the best of a scan about the area between their curves over the moduli that both have (the closed form of Gergesova,
//! Zupančič, Saprunov & Emri, *J. Rheol.* 55 (2011) 1). The laws of [`fem_material::ShiftLaw`] are fitted to them by generalised least
//! squares with their covariance.
//!
//! A vertical factor b_T of both moduli may be found with each shift.
//!
//! Blocks whose shifts the moduli do not determine (`determination`) are left out.
//!
//! Limits: where moduli hardly depend on the frequency a shift is uncertain, and so are those of all blocks behind it.

use nalgebra::{Cholesky, DMatrix, DVector};

use fem_material::ShiftLaw;

use crate::estimate::spectrum::bounded::non_negative;
use crate::estimate::{covariance, jacobian, minimise};
use crate::table::{ModulusPoint, TestKind};

use super::joint::Joint;
use super::series::{Observations, compressed_by_products, grid};

/// Terms per decade of the series of a few blocks: the waves of its moduli are below all scatter.
pub(super) const DENSITY: f64 = 3.0;
/// Reach of the scan on either side of the first estimate, ln: a decade and a half, the standard uncertainty of a shift that the data do
/// not determine.
pub(super) const REACH: f64 = 1.5 * std::f64::consts::LN_10;
/// Values of the scan.
const N_SCANNED: usize = 16;
/// Difference of ln of the moduli of two blocks that is no gap but scatter.
const MAX_GAP: f64 = 0.1;

/// The moduli at one temperature.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Mean temperature, K.
    pub temperature: f64,
    /// Indices of its points.
    pub points: Vec<usize>,
    /// Natural logarithm of the shift factor a_T.
    pub ln_shift: f64,
    /// Standard uncertainty of ln a_T; 0 for the reference.
    pub shift_uncertainty: f64,
    /// ln b_T, the factor of both moduli; 0 unless it is asked for.
    pub ln_vertical: f64,
}

/// A shift law that was fitted.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedShift {
    /// The law with its constants.
    pub law: ShiftLaw,
    /// Standard uncertainties of its constants, in their order.
    pub uncertainties: Vec<f64>,
    /// Root mean square of the deviations over their uncertainties, per degree of freedom.
    pub misfit: f64,
    /// Largest deviation of log₁₀ a_T.
    pub largest_deviation: f64,
}

/// Isothermal blocks with their shifts.
#[derive(Clone, Debug, PartialEq)]
pub struct Superposition {
    /// Blocks with a shift, by rising temperature.
    pub blocks: Vec<Block>,
    /// Temperatures (K) of the blocks whose shifts the moduli do not determine, and which are left out.
    pub left_out: Vec<f64>,
    /// Index of the reference.
    pub reference: usize,
    /// The law of Williams, Landel and Ferry, if there are at least three blocks and it fits.
    pub wlf: Option<FittedShift>,
    /// Arrhenius' law through the shifts.
    pub arrhenius: Option<FittedShift>,
}

/// Returns a point at the reference temperature.
pub(super) fn reduced(
    kind: TestKind,
    point: &ModulusPoint,
    ln_shift: f64,
    ln_vertical: f64,
) -> ModulusPoint {
    let factor = match kind {
        TestKind::Oscillation => ln_shift.exp(),
        TestKind::Relaxation => (-ln_shift).exp(),
    };
    let vertical = (-ln_vertical).exp();
    let [storage, loss] = [point.storage, point.loss].map(|modulus| modulus * vertical);
    ModulusPoint { at: factor * point.at, storage, loss, ..*point }
}

impl Superposition {
    /// Finds the shifts of blocks of points (by rising temperature) to one of them.
    ///
    /// # Errors
    /// The index of two neighbouring blocks whose moduli do not overlap.
    pub(super) fn of(
        kind: TestKind,
        points: &[ModulusPoint],
        blocks: Vec<Block>,
        reference: usize,
        has_vertical: bool,
    ) -> Result<Self, usize> {
        let mut found =
            Self { blocks, left_out: Vec::new(), reference, wlf: None, arrhenius: None };
        let steps = found.steps(kind, points)?;
        for k in reference + 1..found.blocks.len() {
            found.blocks[k].ln_shift = found.blocks[k - 1].ln_shift + steps[k - 1];
        }
        for k in (0..reference).rev() {
            found.blocks[k].ln_shift = found.blocks[k + 1].ln_shift - steps[k];
        }
        let covariance = loop {
            let reference = found.reference;
            let (covariance, determined) =
                Joint::new(kind, points, &mut found.blocks, reference, has_vertical).refine();
            if !determined.contains(&false) {
                break covariance;
            }
            found.leave_out(&determined);
        };
        let moving = (0..found.blocks.len()).filter(|block| *block != found.reference);
        for (k, block) in moving.enumerate() {
            found.blocks[block].shift_uncertainty = covariance[(k, k)].sqrt();
        }
        found.fit_laws(covariance);
        Ok(found)
    }

    /// Removes the blocks whose shifts are not determined, of all but the reference.
    fn leave_out(&mut self, determined: &[bool]) {
        let mut is_kept = determined.to_vec();
        is_kept.insert(self.reference, true);
        self.reference = is_kept[..self.reference].iter().filter(|kept| **kept).count();
        let blocks = std::mem::take(&mut self.blocks).into_iter().zip(is_kept);
        let (kept, out): (Vec<_>, Vec<_>) = blocks.partition(|(_, kept)| *kept);
        self.blocks = kept.into_iter().map(|(block, _)| block).collect();
        self.left_out.extend(out.into_iter().map(|(block, _)| block.temperature));
        self.left_out.sort_by(f64::total_cmp);
    }

    /// Returns the points of the blocks at the reference temperature, in their order, with the uncertainty of ln a_T of each.
    pub fn reduced(&self, kind: TestKind, points: &[ModulusPoint]) -> Vec<(ModulusPoint, f64)> {
        let of_block = |block: &Block| {
            let Block { ln_shift, ln_vertical, shift_uncertainty, .. } = *block;
            let of_point = move |k: &usize| {
                (*k, (reduced(kind, &points[*k], ln_shift, ln_vertical), shift_uncertainty))
            };
            block.points.iter().map(of_point).collect::<Vec<_>>()
        };
        let mut all: Vec<_> = self.blocks.iter().flat_map(of_block).collect();
        all.sort_by_key(|(k, _)| *k);
        all.into_iter().map(|(_, point)| point).collect()
    }

    /// Returns the temperature of the reference, K.
    pub fn reference_temperature(&self) -> f64 {
        self.blocks[self.reference].temperature
    }

    /// Returns a first estimate of the shift from each block to the next warmer one.
    fn steps(&self, kind: TestKind, points: &[ModulusPoint]) -> Result<Vec<f64>, usize> {
        let of = |block: &Block| -> Vec<ModulusPoint> {
            block.points.iter().map(|k| points[*k]).collect()
        };
        let pairs = self.blocks.windows(2).enumerate();
        pairs
            .map(|(k, pair)| {
                let (first, second) = (of(&pair[0]), of(&pair[1]));
                let start = area_shift(&rising_curve(kind, &first), &rising_curve(kind, &second));
                Ok(scanned_shift(kind, &first, &second, start.ok_or(k)?.min(0.0)))
            })
            .collect()
    }

    fn fit_laws(&mut self, covariance: DMatrix<f64>) {
        if self.blocks.len() < 2 {
            return;
        }
        let reference = self.reference_temperature();
        let moving: Vec<usize> =
            (0..self.blocks.len()).filter(|block| *block != self.reference).collect();
        let blocks: Vec<(f64, f64)> = moving
            .iter()
            .map(|k| (self.blocks[*k].temperature, self.blocks[*k].ln_shift))
            .collect();
        // A floor, since exact data have no scatter.
        let floor = 1e-9 * covariance.diagonal().max().max(1e-12);
        let covariance =
            covariance + DMatrix::identity(moving.len(), moving.len()) * floor.max(1e-16);
        let Some(factor) = Cholesky::new(covariance) else { return };
        let shifts = Shifts { blocks, reference, factor: factor.l() };
        let (coldest, hottest) =
            (self.blocks[0].temperature, self.blocks.last().map_or(0.0, |b| b.temperature));
        // log₁₀ a = −s ΔT/(1 + κ ΔT) has no pole in the range of the data: s = C₁/C₂, κ = 1/C₂.
        let ends = [reference - coldest, hottest - reference];
        let bounds =
            [(0.0, f64::INFINITY), (-0.999 / ends[1].max(1e-3), 0.999 / ends[0].max(1e-3))];
        let wlf_of = |c: &[f64]| {
            // An infinite C₂ is a straight line; a large one is as good.
            let kappa = if c[1].abs() < 1e-9 { 1e-9 } else { c[1] };
            ShiftLaw::Wlf { c1: c[0] / kappa, c2: kappa.recip() }
        };
        if moving.len() >= 2 {
            self.wlf = shifts.fit(&[0.1, 0.25 * bounds[1].1.min(0.02)], &bounds, &wlf_of).map(
                |(fitted, found, variance)| {
                    let [s, kappa] = [found[0], found[1]];
                    let of = |a: f64, b: f64| {
                        let squares = a * a * variance[(0, 0)]
                            + b * b * variance[(1, 1)]
                            + 2.0 * a * b * variance[(0, 1)];
                        squares.max(0.0).sqrt()
                    };
                    let c1 = of(kappa.recip(), -s / kappa / kappa);
                    let c2 = of(0.0, kappa.powi(-2));
                    FittedShift { uncertainties: vec![c1, c2], ..fitted }
                },
            );
        }
        let arrhenius_of = |c: &[f64]| ShiftLaw::Arrhenius { activation_temperature: 1e4 * c[0] };
        self.arrhenius = shifts.fit(&[1.0], &[(0.0, f64::INFINITY)], &arrhenius_of).map(
            |(fitted, _, variance)| FittedShift {
                uncertainties: vec![1e4 * variance[(0, 0)].max(0.0).sqrt()],
                ..fitted
            },
        );
    }
}

/// Shifts of the blocks that are shifted, to which laws are fitted.
struct Shifts {
    /// Temperature, K, and ln a_T of each block.
    blocks: Vec<(f64, f64)>,
    /// Temperature of the reference, K.
    reference: f64,
    /// Cholesky's factor of the covariance of ln a_T.
    factor: DMatrix<f64>,
}

impl Shifts {
    /// Fits a law; returns it with its constants and their covariance.
    fn fit(
        &self,
        start: &[f64],
        bounds: &[(f64, f64)],
        of: &dyn Fn(&[f64]) -> ShiftLaw,
    ) -> Option<(FittedShift, Vec<f64>, DMatrix<f64>)> {
        let residuals = |constants: &[f64]| -> Option<Vec<f64>> {
            let law = of(constants);
            let off = self.blocks.iter().map(|(temperature, ln_shift)| {
                let predicted = law.log10_shift(*temperature, self.reference)?;
                Some(ln_shift - predicted * std::f64::consts::LN_10)
            });
            let off = DVector::from_vec(off.collect::<Option<Vec<f64>>>()?);
            Some(self.factor.solve_lower_triangular(&off)?.as_slice().to_vec())
        };
        let (found, sum) = minimise(&residuals, start, bounds).ok()?;
        let slopes = jacobian(&residuals, &found, bounds)?;
        // Shifts that scatter more about the law than they should make its constants more uncertain (Birge's ratio).
        let freedom = self.blocks.len().saturating_sub(found.len()).max(1) as f64;
        let variance = covariance(&slopes, (sum / freedom).max(1.0))?;
        let law = of(&found);
        let deviation = self.blocks.iter().map(|(temperature, ln_shift)| {
            let predicted = law.log10_shift(*temperature, self.reference).unwrap_or(f64::NAN);
            (ln_shift / std::f64::consts::LN_10 - predicted).abs()
        });
        let fitted = FittedShift {
            largest_deviation: deviation.fold(0.0, f64::max),
            law,
            uncertainties: Vec::new(),
            misfit: (sum / freedom).sqrt(),
        };
        Some((fitted, found, variance))
    }
}

/// Returns the shift of the second block against the first with which a single series meets both best, of those about a first estimate.
fn scanned_shift(
    kind: TestKind,
    first: &[ModulusPoint],
    second: &[ModulusPoint],
    start: f64,
) -> f64 {
    let misfit = |ln_shift: f64| {
        let second = second.iter().map(|point| reduced(kind, point, ln_shift, 0.0));
        let both: Vec<ModulusPoint> = first.iter().copied().chain(second).collect();
        let times = grid(kind, &both, DENSITY, 0.0);
        let linear = Observations::over_magnitude(kind, &both).linear_of_all(&times);
        let linear = compressed_by_products(&linear);
        linear.misfit(non_negative(&linear.a, &linear.b).as_slice())
    };
    let width = 2.0 * REACH / N_SCANNED as f64;
    let from = start - 0.5 * width * N_SCANNED as f64;
    // A warmer block is faster.
    let scanned = (0..=N_SCANNED).map(|k| (from + width * k as f64).min(0.0));
    let best = scanned.map(|at| (misfit(at), at)).min_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or(start, |best| best.1)
}

/// Returns ln of frequency (or of the inverse of time) and ln of the storage modulus, which scatter does not make fall.
fn rising_curve(kind: TestKind, points: &[ModulusPoint]) -> Vec<(f64, f64)> {
    let sign = if kind == TestKind::Oscillation { 1.0 } else { -1.0 };
    let mut curve: Vec<(f64, f64)> =
        points.iter().map(|point| (sign * point.at.ln(), point.storage.ln())).collect();
    curve.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut highest = f64::NEG_INFINITY;
    for point in &mut curve {
        highest = highest.max(point.1);
        point.1 = highest;
    }
    curve
}

/// Returns ln a of the second curve less that of the first: the mean distance of the curves over the moduli that both have.
fn area_shift(first: &[(f64, f64)], second: &[(f64, f64)]) -> Option<f64> {
    let ends = |curve: &[(f64, f64)]| Some((curve.first()?.1, curve.last()?.1));
    let (first_ends, second_ends) = (ends(first)?, ends(second)?);
    let (low, high) = (first_ends.0.max(second_ends.0), first_ends.1.min(second_ends.1));
    if high <= low {
        // Scatter may part two blocks of a plateau.
        return (low - high < MAX_GAP).then_some(0.0);
    }
    let [first, second] = [first, second].map(|curve| area(curve, low, high));
    Some((first - second) / (high - low))
}

/// Returns ∫ x dy of a rising polygon between two heights.
fn area(curve: &[(f64, f64)], low: f64, high: f64) -> f64 {
    let of_piece = |pair: &[(f64, f64)]| {
        let [(x0, y0), (x1, y1)] = [pair[0], pair[1]];
        let (from, to) = (y0.max(low), y1.min(high));
        if to <= from {
            return 0.0;
        }
        let at = |y: f64| x0 + (x1 - x0) * (y - y0) / (y1 - y0);
        0.5 * (at(from) + at(to)) * (to - from)
    };
    curve.windows(2).map(of_piece).sum()
}
