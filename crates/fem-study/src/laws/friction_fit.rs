//! The coefficient of friction from measured rebounds of oblique impacts.
//!
//! The rebound of each row follows from the impact of the case's bodies along the axis, computed once per speed, and the coefficient
//! ([`ObliqueResponse`]). The coefficient with the least squares of all rows is searched on a logarithmic scale from sliding of all rows
//! to sticking of all, and refined. Patches that slide determine it; those that stick hardly depend on it.
//!
//! Dundurs' β is not found beside it: both change the rebound of patches that stick, by less than their errors.

use fem_case::{Case, CaseError, Scene};
use fem_data::estimate::{InputPart, SPEED};
use fem_data::table::{Incidence, Rebound, ReboundQuantity, Rebounds};
use fem_simulation::{ObliqueRebound, ObliqueResponse, Rejection};
use serde_json::{Value, json};

use super::law_fault::LawFault;

/// Values per decade of the search.
const STEPS_PER_DECADE: f64 = 12.0;
/// Difference of misfits by rounding.
const EXACT: f64 = 1e-9;
/// Halvings, nearly, of a bracket by the golden section: eight digits.
const GOLDEN_STEPS: usize = 40;
/// Least coefficient of the search over that of the first row that does not slide throughout.
const LOWEST: f64 = 0.02;
/// ψ₁ below which a row sticks for every coefficient above.
const STUCK: f64 = 0.03;
/// Share of the sliding limit from which a patch slides throughout.
const SLIDES: f64 = 1.0 - 1e-4;
/// Misfit over the error of the model beyond which no coefficient gives a single rebound.
const IMPOSSIBLE: f64 = 2.0;

/// How the contact patch of a row moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PatchMotion {
    /// It slides throughout.
    Slides,
    /// It slides and sticks.
    SlidesAndSticks,
    /// It sticks at first: ψ₁ < 1.
    Sticks,
}

impl PatchMotion {
    /// Returns its name in texts and stored results.
    pub fn words(self) -> &'static str {
        match self {
            Self::Slides => "slides throughout",
            Self::SlidesAndSticks => "slides and sticks",
            Self::Sticks => "sticks at first",
        }
    }
}

/// One row of a fit, in the SI unit of its quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionRow {
    /// Approach speed, m/s.
    pub speed: f64,
    /// Tangential velocity of the ball before, m/s.
    pub velocity: f64,
    /// Measured value and its uncertainty, 0 if there is none.
    pub measured: f64,
    /// Standard uncertainty of the measured value; 0 if there is none.
    pub uncertainty: f64,
    /// The value with the best coefficient.
    pub computed: f64,
    /// Error of the computed value by the model, without that of the restitution; `None` if it is not known.
    pub model_error: Option<f64>,
    /// Motion of the patch.
    pub motion: PatchMotion,
    /// Share of the row in what determines the coefficient.
    pub share: f64,
}

/// A coefficient of friction that is found from rebounds.
#[derive(Clone, Debug)]
pub struct FrictionFit<'a> {
    /// The measured rebounds.
    pub data: &'a Rebounds,
    /// The best coefficient.
    pub friction: f64,
    /// The least coefficient, if all larger ones fit too.
    pub at_least: Option<f64>,
    /// Other coefficients that fit as well.
    pub others: Vec<f64>,
    /// Standard error by the scatter of the data, or by their uncertainties; `None` of a single row without one.
    pub by_data: Option<f64>,
    /// Standard error by the model; `None` if it is not known.
    pub by_model: Option<f64>,
    /// Changes by the uncertain inputs of the case.
    pub inputs: Vec<InputPart>,
    /// Root mean square of the misfits, in the SI unit of the quantity.
    pub rms: f64,
    /// Sum of squares over uncertainties per degree of freedom, if the rows have uncertainties.
    pub chi_square: Option<f64>,
    /// One row per measured rebound.
    pub rows: Vec<FrictionRow>,
}

impl<'a> FrictionFit<'a> {
    /// Names of the columns of [`FrictionFit::residuals`].
    pub const RESIDUAL_COLUMNS: [&'static str; 6] = [
        "speed_m_s",
        "tangential_velocity_before_m_s",
        "measured_si",
        "computed_si",
        "residual_si",
        "share",
    ];

    /// Finds the coefficient of friction of a case's bodies.
    ///
    /// # Errors
    /// The model of the case has no friction; no row has a tangential velocity; no coefficient gives a single rebound.
    pub fn of(case: &Case, data: &'a Rebounds) -> Result<Self, LawFault> {
        let curve = Curve::of(case.scene(), data).map_err(|fault| of_case(fault, case))?;
        let coarse = curve.coarser();
        let scan = coarse.scan();
        let mut best: Vec<(f64, f64)> =
            minima(&scan).map(|bracket| golden(bracket, |mu| curve.misfit(mu))).collect();
        best.sort_by(|a, b| a.1.total_cmp(&b.1));
        // One row may have several exact solutions, of which that with the least friction is the usual one.
        let n_exact = best.iter().filter(|(_, misfit)| misfit - best[0].1 <= EXACT).count();
        best[..n_exact].sort_by(|a, b| a.0.total_cmp(&b.0));
        let (last, stuck) = scan[scan.len() - 1];
        // No coefficient is better than that of patches that all stick.
        let Some(&(friction, least)) = best.first().filter(|(_, misfit)| *misfit <= stuck) else {
            return Ok(Self::bounded(data, &curve, last, &scan));
        };
        let slopes = curve.slopes(friction);
        let rows = curve.rows(friction, &slopes);
        let freedom = data.points.len().saturating_sub(1);
        let information: f64 = slopes.iter().zip(&curve.weights).map(|(s, w)| w * s * s).sum();
        let is_weighed = curve.is_weighed;
        let scale = match (is_weighed, freedom) {
            (true, _) => Some(1.0),
            (false, 0) => None,
            (false, n) => Some(least / n as f64),
        };
        // The change of the coefficient by changes of all rows.
        let moved = |changes: &[f64]| {
            let sum = slopes.iter().zip(&curve.weights).zip(changes).map(|((s, w), c)| w * s * c);
            sum.sum::<f64>() / information
        };
        let by_rows = curve.model_errors(friction).map(|errors| moved(&errors).abs());
        let by_restitution = curve.changes_by_restitution(friction).map(|it| moved(&it).abs());
        let by_model = by_rows.zip(by_restitution).map(|(one, other)| one + other);
        let noise = scale.map_or(0.0, f64::sqrt);
        let tolerance = |mu: f64| curve.tolerated(mu, friction, noise);
        if freedom == 0 && !is_weighed && tolerance(friction) > IMPOSSIBLE {
            return Err(no_solution(data, &curve, friction));
        }
        let same = tolerance(friction) + 1.0;
        let at_least =
            (tolerance(last) <= same).then(|| lower_end(&tolerance, same, &scan, friction));
        let others = best[1..].iter().filter(|(mu, _)| tolerance(*mu) <= same).map(|it| it.0);
        let others: Vec<f64> = others.collect();
        let inputs = InputPart::of(case, 1, &[SPEED, "contact.friction"], |changed| {
            let changed = Curve::of(changed.scene(), data).ok()?;
            let values = curve.values(friction).into_iter().zip(changed.values(friction));
            let changes: Vec<f64> = values.map(|(own, other)| own - other).collect();
            Some(vec![moved(&changes)])
        });
        Ok(Self {
            data,
            friction,
            at_least,
            others,
            by_data: scale.map(|scale| (scale / information).sqrt()),
            by_model,
            inputs,
            rms: rms_of(&rows),
            chi_square: is_weighed.then(|| least / freedom.max(1) as f64),
            rows,
        })
    }

    /// Returns the fit of rebounds that fit best if all patches stick: the least coefficient with which they do.
    fn bounded(data: &'a Rebounds, curve: &Curve<'_>, last: f64, scan: &[(f64, f64)]) -> Self {
        let rows = curve.rows(last, &vec![0.0; data.points.len()]);
        let rms = rms_of(&rows);
        let noise = if curve.is_weighed { 1.0 } else { rms };
        let tolerance = |mu: f64| curve.tolerated(mu, last, noise);
        let at_least = lower_end(&tolerance, tolerance(last) + 1.0, scan, last);
        Self {
            data,
            friction: at_least,
            at_least: Some(at_least),
            others: Vec::new(),
            by_data: None,
            by_model: None,
            inputs: Vec::new(),
            rms,
            chi_square: None,
            rows,
        }
    }

    /// Returns the standard error by data, model and inputs; `None` if a part is not known, or the value is a bound.
    pub fn standard_error(&self) -> Option<f64> {
        let by_data = match self.rows.len() {
            1 => self.by_data.unwrap_or(0.0),
            _ => self.by_data?,
        };
        let error = by_data.hypot(self.by_model?).hypot(InputPart::sum(&self.inputs, 0));
        (self.at_least.is_none() && error.is_finite()).then_some(error)
    }

    /// Returns the number of rows of a motion, and their share in what determines the coefficient.
    pub fn of_motion(&self, motion: PatchMotion) -> (usize, f64) {
        let rows = || self.rows.iter().filter(|row| row.motion == motion);
        (rows().count(), rows().map(|row| row.share).sum())
    }

    /// Returns warnings about the fit.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = self.data.warnings.clone();
        if self.at_least.is_some() {
            let what = "every larger coefficient of friction fits too, since the patch sticks: measure at larger angles";
            warnings.push(what.to_string());
        }
        if let Some(other) = self.others.first() {
            warnings.push(format!(
                "friction = {other:.4} fits as well: a row at another angle distinguishes them"
            ));
        }
        if self.at_least.is_none() && self.by_model.is_none() {
            let what = "the error of the model is not known: give a column restitution, and rows with larger angles";
            warnings.push(what.to_string());
        }
        if let Some(chi_square) = self.chi_square.filter(|it| *it > 2.0 && self.rows.len() > 1) {
            warnings.push(format!(
                "the misfit is {:.1} times the uncertainties: the model is wrong or they are too small",
                chi_square.sqrt()
            ));
        }
        warnings
    }

    /// Returns data, computed values and their differences, one row per rebound; SI.
    pub fn residuals(&self) -> impl Iterator<Item = [Option<f64>; 6]> {
        self.rows.iter().map(|row| {
            let residual = row.computed - row.measured;
            [row.speed, row.velocity, row.measured, row.computed, residual, row.share].map(Some)
        })
    }

    /// Returns the stored form in SI units; `case` is the case's name.
    pub fn numbers(&self, case: &str) -> Value {
        let motions = [PatchMotion::Slides, PatchMotion::SlidesAndSticks, PatchMotion::Sticks];
        let regime = motions.map(|motion| {
            let (rows, share) = self.of_motion(motion);
            json!({ "patch": motion.words(), "rows": rows, "share": share })
        });
        let column = |of: fn(&FrictionRow) -> f64| self.rows.iter().map(of).collect::<Vec<_>>();
        json!({
            "case": case,
            "data": self.data.name,
            "law": "friction",
            "quantity": self.data.quantity.name(),
            "points": self.rows.len(),
            "parameters": [{
                "key": "friction",
                "unit": "",
                "value": self.friction,
                "standard_error": self.standard_error(),
                "standard_error_of_data": self.by_data,
                "standard_error_of_model": self.by_model,
                "at_least": self.at_least,
                "others": self.others,
            }],
            "inputs": self.inputs.iter().map(|it| it.numbers(&[("friction", 1.0)])).collect::<Value>(),
            "rms": self.rms,
            "chi_square": self.chi_square,
            "regime": regime,
            "measured": {
                "speed_m_s": column(|row| row.speed),
                "tangential_velocity_before_m_s": column(|row| row.velocity),
                "measured_si": column(|row| row.measured),
                "computed_si": column(|row| row.computed),
                "patch": self.rows.iter().map(|row| row.motion.words()).collect::<Vec<_>>(),
            },
            "warnings": self.warnings(),
        })
    }
}

/// The rebounds of all rows over the coefficient of friction.
struct Curve<'a> {
    data: &'a Rebounds,
    responses: Vec<ObliqueResponse>,
    /// Response, tangential velocity before (m/s) and approach speed (m/s) of each row.
    rows: Vec<(usize, f64, f64)>,
    /// One over the squares of uncertainties; 1 without them.
    weights: Vec<f64>,
    is_weighed: bool,
    spins: bool,
}

impl<'a> Curve<'a> {
    fn of(scene: &Scene, data: &'a Rebounds) -> Result<Self, Rejection> {
        let mut speeds: Vec<f64> = Vec::new();
        let mut responses = Vec::new();
        let mut rows = Vec::new();
        for point in &data.points {
            let speed = point.speed.unwrap_or_else(|| scene.approach_speed());
            let known = speeds.iter().position(|other| *other == speed);
            let response = match known {
                Some(known) => known,
                None => {
                    responses.push(ObliqueResponse::of(scene, speed)?);
                    speeds.push(speed);
                    speeds.len() - 1
                }
            };
            let velocity = match point.before {
                Incidence::Angle(angle) => speed * angle.tan(),
                Incidence::Velocity(velocity) => velocity,
            };
            rows.push((response, velocity, speed));
        }
        let uncertainty = |point: &Rebound| point.after.uncertainty;
        let is_weighed = data.points.iter().all(|point| uncertainty(point) > 0.0);
        let weight = |point: &Rebound| if is_weighed { uncertainty(point).powi(-2) } else { 1.0 };
        let curve = Self {
            data,
            responses,
            rows,
            weights: data.points.iter().map(weight).collect(),
            is_weighed,
            spins: scene.bodies().iter().any(|body| body.spin() != 0.0),
        };
        match (0..curve.rows.len()).any(|row| curve.rebound(row, 1.0, None).psi > 0.0) {
            true => Ok(curve),
            false => {
                Err(Rejection::new("contact.friction", "no patch of the data moves".to_string())
                    .with_help("friction needs an impact angle or a spin"))
            }
        }
    }

    fn coarser(&self) -> Self {
        let responses = self.responses.iter().map(ObliqueResponse::coarser).collect();
        let (rows, weights) = (self.rows.clone(), self.weights.clone());
        Self { responses, rows, weights, ..*self }
    }

    fn rebound(&self, row: usize, friction: f64, restitution: Option<f64>) -> ObliqueRebound {
        let (response, velocity, _) = self.rows[row];
        let restitution = restitution.or(self.data.points[row].restitution);
        self.responses[response].rebound(friction, velocity, restitution)
    }

    /// Returns the measured quantity of a rebound. Spins of balls that did not spin before are taken without their sign.
    fn quantity(&self, rebound: &ObliqueRebound) -> f64 {
        match self.data.quantity {
            ReboundQuantity::ReboundAngle => rebound.rebound_angle,
            ReboundQuantity::ContactPatchRebound => rebound.contact_patch_rebound,
            ReboundQuantity::SpinAfter if self.spins => rebound.spin,
            ReboundQuantity::SpinAfter => rebound.spin.abs(),
            ReboundQuantity::TangentialVelocityAfter => rebound.tangential_velocity,
            ReboundQuantity::TangentialRestitution => rebound.tangential_restitution,
            ReboundQuantity::ImpulseRatio => rebound.impulse_ratio,
        }
    }

    fn measured(&self, row: usize) -> f64 {
        let value = self.data.points[row].after.value;
        let is_unsigned = self.data.quantity == ReboundQuantity::SpinAfter && !self.spins;
        if is_unsigned { value.abs() } else { value }
    }

    fn value(&self, row: usize, friction: f64) -> f64 {
        self.quantity(&self.rebound(row, friction, None))
    }

    fn values(&self, friction: f64) -> Vec<f64> {
        (0..self.rows.len()).map(|row| self.value(row, friction)).collect()
    }

    fn misfit(&self, friction: f64) -> f64 {
        let of = |row: usize| {
            self.weights[row] * (self.value(row, friction) - self.measured(row)).powi(2)
        };
        (0..self.rows.len()).map(of).sum()
    }

    /// Returns the misfits over a logarithmic range of coefficients, from sliding of all rows to sticking of all.
    fn scan(&self) -> Vec<(f64, f64)> {
        let psi = (0..self.rows.len()).map(|row| self.rebound(row, 1.0, None).psi);
        let moving = || psi.clone().filter(|psi| *psi > 0.0);
        // All rows slide from ψ₁ = 6 on, which 4χ − 1 is at most.
        let low = LOWEST * moving().fold(f64::INFINITY, f64::min) / 6.0;
        let high = moving().fold(0.0, f64::max) / STUCK;
        let n = ((high / low).log10() * STEPS_PER_DECADE).ceil() as usize;
        let at = |k: usize| low * (high / low).powf(k as f64 / n as f64);
        (0..=n).map(|k| (at(k), self.misfit(at(k)))).collect()
    }

    /// Returns the slope of each row's value in the coefficient.
    fn slopes(&self, friction: f64) -> Vec<f64> {
        let step = 1e-3 * friction;
        let ends = self.values(friction + step).into_iter().zip(self.values(friction - step));
        ends.map(|(high, low)| 0.5 * (high - low) / step).collect()
    }

    /// Returns the error of each row's value by the model without that of the restitution; 0 where unknown errors have no weight.
    fn error(&self, row: usize, friction: f64) -> Option<f64> {
        let (response, velocity, _) = self.rows[row];
        let restitution = self.data.points[row].restitution;
        let erring = self.responses[response].erring(friction, velocity, restitution)?;
        Some(self.quantity(&erring) - self.value(row, friction))
    }

    /// Returns these errors of all rows. One that is not known counts as zero if patches that slide determine the coefficient.
    fn model_errors(&self, friction: f64) -> Option<Vec<f64>> {
        let errors: Vec<_> = (0..self.rows.len()).map(|row| self.error(row, friction)).collect();
        let is_any_known = errors.iter().any(Option::is_some);
        is_any_known.then(|| errors.into_iter().map(Option::unwrap_or_default).collect())
    }

    /// Returns the changes of all rows by the error of the computed restitution.
    fn changes_by_restitution(&self, friction: f64) -> Option<Vec<f64>> {
        let change = |row: usize| {
            let (response, ..) = self.rows[row];
            if self.data.points[row].restitution.is_some() {
                return Some(0.0);
            }
            let response = &self.responses[response];
            let away = (response.restitution - response.restitution_error?).max(0.0);
            let changed = self.quantity(&self.rebound(row, friction, Some(away)));
            Some(changed - self.value(row, friction))
        };
        (0..self.rows.len()).map(change).collect()
    }

    /// Returns the sum of the squares of misfits over errors: the noise times each row's uncertainty, and the model's at the best
    /// coefficient. Rows whose model error is not known do not count.
    fn tolerated(&self, friction: f64, best: f64, noise: f64) -> f64 {
        let of = |row: usize| {
            let error = self.error(row, best)?;
            let variance = noise * noise / self.weights[row] + error * error;
            Some((self.value(row, friction) - self.measured(row)).powi(2) / variance)
        };
        (0..self.rows.len()).filter_map(of).sum()
    }

    fn rows(&self, friction: f64, slopes: &[f64]) -> Vec<FrictionRow> {
        let parts: Vec<f64> = slopes.iter().zip(&self.weights).map(|(s, w)| w * s * s).collect();
        let all = parts.iter().sum::<f64>().max(f64::MIN_POSITIVE);
        let row = |row: usize| {
            let rebound = self.rebound(row, friction, None);
            let (_, velocity, speed) = self.rows[row];
            FrictionRow {
                speed,
                velocity,
                measured: self.measured(row),
                uncertainty: self.data.points[row].after.uncertainty,
                computed: self.quantity(&rebound),
                model_error: self.error(row, friction),
                motion: match rebound {
                    it if it.impulse_ratio >= SLIDES * friction => PatchMotion::Slides,
                    it if it.psi >= 1.0 => PatchMotion::SlidesAndSticks,
                    _ => PatchMotion::Sticks,
                },
                share: parts[row] / all,
            }
        };
        (0..self.rows.len()).map(row).collect()
    }
}

/// Returns the root mean square of the misfits, in the SI unit of the quantity.
fn rms_of(rows: &[FrictionRow]) -> f64 {
    let sum = rows.iter().map(|row| (row.computed - row.measured).powi(2)).sum::<f64>();
    (sum / rows.len() as f64).sqrt()
}

/// Returns the brackets of the minima of a scan.
fn minima(scan: &[(f64, f64)]) -> impl Iterator<Item = [f64; 2]> {
    let is_least = |three: &&[(f64, f64)]| three[1].1 < three[0].1 && three[1].1 <= three[2].1;
    scan.windows(3).filter(is_least).map(|three| [three[0].0, three[2].0])
}

/// Returns the place and value of the minimum in a bracket, by the golden section.
fn golden([mut low, mut high]: [f64; 2], of: impl Fn(f64) -> f64) -> (f64, f64) {
    let share = 0.5 * (5f64.sqrt() - 1.0);
    let (mut a, mut b) = (high - share * (high - low), low + share * (high - low));
    let (mut at_a, mut at_b) = (of(a), of(b));
    for _ in 0..GOLDEN_STEPS {
        if at_a <= at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - share * (high - low);
            at_a = of(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + share * (high - low);
            at_b = of(b);
        }
    }
    if at_a <= at_b { (a, at_a) } else { (b, at_b) }
}

/// Returns the coefficient below the best one from which on the misfit is within a tolerance.
fn lower_end(of: &dyn Fn(f64) -> f64, most: f64, scan: &[(f64, f64)], best: f64) -> f64 {
    let below = scan.iter().map(|it| it.0).filter(|mu| *mu < best);
    let Some(mut low) = below.filter(|mu| of(*mu) > most).last() else { return scan[0].0 };
    let mut high = best;
    for _ in 0..GOLDEN_STEPS / 2 {
        let middle = (low * high).sqrt();
        if of(middle) > most { low = middle } else { high = middle }
    }
    high
}

/// Returns the error of a single rebound that no coefficient gives.
fn no_solution(data: &Rebounds, curve: &Curve<'_>, nearest: f64) -> LawFault {
    let (unit, scale) = data.quantity.unit();
    let [wanted, found] = [curve.measured(0), curve.value(0, nearest)].map(|it| scale * it);
    LawFault::Sticks(
        format!(
            "no coefficient of friction gives {} {wanted:.4} {unit}: the nearest is {found:.4} {unit} at {nearest:.4}",
            data.quantity.name().replace('_', " ")
        ),
        "check the angle before, its sign, and the restitution along the axis".to_string(),
    )
}

fn of_case(rejection: Rejection, case: &Case) -> LawFault {
    let error: CaseError = rejection.in_case(case);
    error.into()
}
