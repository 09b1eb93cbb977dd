//! The restitutions and contact times that DEM codes make of entered numbers, and the entries that make wanted ones.
//!
//! **LAMMPS**, `pair_style granular` with `hertz/material`. `damping viscoelastic` is η m* a with a = √(R* ξ), a Kelvin
//! dashpot C √ξ, so that
//!
//! ```math
//! \eta = \frac{C}{m^*\sqrt{R^*}} = \frac{2E^*A}{m^*},
//! ```
//!
//! which is no material constant: another pair of sizes needs another η. `damping coeff_restitution` is Tsuji's dashpot
//! with Antypov & Elliott's exact coefficient. `damping tsuji` is the same dashpot with a polynomial of the entered e
//! (Marshall 2009, eq. 53),
//!
//! ```math
//! \alpha = 1.2728-4.2783e+11.087e^2-22.348e^3+27.467e^4-18.022e^5+4.8218e^6,
//! ```
//!
//! made for a mass that counts double: up to the release of 22 July 2025 the code applies it to m* and damps too little
//! by √2; later sources multiply by √2 (`gran_sub_mod_damping.cpp`). `fix wall/gran` gives a wall the sphere's own
//! modulus, E* = E/(2(1−ν²)), so 2(1−ν²)E* of the contact is entered. Checked by collisions in LAMMPS,
//! `.ci/check_dem.py`.
//!
//! `mdr` is the law of [`fem_laws::laws::mdr()`]. Its plane strain modulus of the spheres is entered as 2E\* and, of one sphere on a
//! flat, as E\*. Run in LAMMPS by `.ci/check_dem.py`.
//!
//! `damping velocity` is a constant dashpot, C = the entered coefficient, cut off at zero force by `limit_damping`
//! (`gran_sub_mod_damping.cpp`, `gran_sub_mod_normal.cpp`).
//!
//! **Luding's springs** without adhesion, [`fem_laws::laws::luding()`]: LIGGGHTS' `hooke/hysteresis`, whose k₁ is that of `hooke` and
//! whose dashpot is off at a restitution of 1 (`normal_model_hooke_hysteresis.h`); YADE's LudingPM (`LudingPM.cpp`, run in YADE by
//! `.ci/check_dem.py` where it is installed); MercuryDPM's `LinearPlasticViscoelasticSpecies`
//! (`LinearPlasticViscoelasticInteraction.cc`). All have δ\* = 2R\*φ_f k_p/(k_p − k₁), and
//!
//! ```math
//! e = \Bigl(1 + \bigl(\tfrac{k_p}{k_1}-1\bigr)\frac v{v^*}\Bigr)^{-1/2}, \qquad
//! T = \frac\pi2\sqrt{\frac{m^*}{k_1}}\,(1+e), \qquad v^* = \delta^*\sqrt{k_1/m^*},
//! ```
//!
//! up to v\*, which is put at the fastest of the data, since only the slope of k₂ matters below it.
//!
//! **LIGGGHTS**. `gran model hertz` is Tsuji's dashpot with the exact coefficient of the entered restitution. `hooke` has
//!
//! ```math
//! k_n = \tfrac{16}{15}\sqrt{R^*}E^*\left(\frac{15m^*V^2}{16\sqrt{R^*}E^*}\right)^{1/5}, \qquad
//! \gamma_n = \sqrt{\frac{4m^*k_n}{1+(\pi/\ln e)^2}}
//! ```
//!
//! (`normal_model_hooke.h`): the spring that stores ½m*V² at Hertz' approach for the characteristic velocity V, so that at
//! V its contact is longer than Hertz' by π/2.943. Here V is chosen for the contact time instead. Both end at zero
//! overlap, unless `limitForce on`.
//!
//! **YADE**. Hertz–Mindlin turns en into β_n by the fit of Thornton, Cummins & Cleary (2013), eq. 20, for a contact that
//! ends at zero force, and damps with C = 2β_n √(m* S) ξ^(1/4), S = 2E*√R*: what comes out misses what is entered by 8e-4
//! at 0.936, so the entry is corrected. ViscEl takes
//!
//! ```math
//! k_n = \frac{m^*(\pi^2+\ln^2e_n)}{t_c^2}, \qquad c_n = -\frac{2m^*\ln e_n}{t_c}
//! ```
//!
//! (Pournin et al. 2001), right for a contact that ends at zero overlap, but cuts the force off at zero: 0.92 entered
//! makes 0.9213, and is corrected too. Seen in YADE 2023.02a. A wall is a sphere of the same radius there.
//!
//! **MercuryDPM**. `setEffectiveElasticModulusAndRestitutionCoefficient` takes E* of the contact and
//!
//! ```math
//! F = k\,\xi - \gamma\sqrt{m^*k}\,\dot\xi, \qquad k = \tfrac43E^*\sqrt{R^*\xi}, \qquad
//! \gamma = \sqrt{\frac{5\ln^2e}{\pi^2+\ln^2e}}
//! ```
//!
//! (`HertzianViscoelasticNormalSpecies.cc`, `HertzianViscoelasticInteraction.cc`): Tsuji's dashpot with Antypov & Elliott's
//! exact coefficient. `setCollisionTimeAndRestitutionCoefficient` takes T, e and the mass of two equal particles, 2m*, of
//! the linear law. Both end at zero overlap: what is entered is made. Mercury would take harmonic means of two species, so
//! the pair's own values are set. Read, not run.
//!
//! **Lethe**, `hertz_mindlin_limit_overlap` between particles, `nonlinear` with walls:
//!
//! ```math
//! F = \tfrac23S\,\xi - 2\sqrt{\tfrac56}\,\beta\sqrt{S\,m^*}\,\dot\xi, \qquad S = 2E^*\sqrt{R^*\xi}, \qquad
//! \beta = \frac{\ln e}{\sqrt{\pi^2+\ln^2e}}
//! ```
//!
//! (*Lethe documentation*, DEM theory; `particle_particle_contact_force.h`): Tsuji's dashpot with Antypov & Elliott's exact
//! coefficient, ended at zero overlap, constants in five digits. e of a pair is the harmonic mean of both bodies', so both
//! get the pair's. Read, not run.
//!
//! **MFIX-DEM**. `DES_COLL_MODEL = 'HERTZIAN'` and `'LSD'` damp with
//!
//! ```math
//! \eta = \frac{2\sqrt{k\,m^*}\,|\ln e_n|}{\sqrt{\pi^2+\ln^2e_n}}
//! ```
//!
//! (`check_solids_dem.f`), the linear model with k = `KN`, for which it is exact; the Hertzian one with k = K of F = K
//! ξ^(3/2), times ξ^(1/4) (`calc_force_dem.f`). That is Tsuji's dashpot with α = 2 sin θ for e_n = e^(−π tan θ), where
//! √5 sin θ would make e_n: it damps too little, 0.9 entered makes 0.910, so that what is entered is corrected. A
//! contact ends at zero overlap. Restitutions below 0.002 cannot be made. Read, not run.
//!
//! **Drake**, point contact with Hunt & Crossley's dissipation d:
//!
//! ```math
//! F = k\,\xi\,(1 + d\,\dot\xi)_+
//! ```
//!
//! (*Drake documentation*, Compliant point contact). The restitution depends on a = d v alone, for any spring: from
//! v dv/(1 + d v) = −(k/m*) ξ dξ, integrated over loading and unloading between the same overlaps,
//!
//! ```math
//! (1+e)\,a = \ln\frac{1+a}{1-e\,a} .
//! ```
//!
//! It falls with speed, as 1 − 2a/3 at first. Two bodies of stiffness k₁, k₂ make k₁k₂/(k₁ + k₂), and the mean of d weighed
//! by the other's stiffness: of equal ones k/2 and d. Run in Drake by `.ci/check_robotics.py`.
//!
//! **MuJoCo** prescribes accelerations: with the direct format of `solref`, (−κ, −β), and one impedance for all depths, the
//! bodies of a contact approach with
//!
//! ```math
//! \ddot\xi = -\kappa\,\xi - \beta\,\dot\xi,
//! ```
//!
//! while that pushes them apart (*MuJoCo documentation*, Computation, Solver parameters): a linear spring and dashpot
//! whose masses cancel, κ = k/m*, β = c/m*, and whose contact ends at zero force. So one `solref` makes one e and one
//! contact time for all sizes. Run in MuJoCo by `.ci/check_robotics.py`.
//!
//! **Newton**, the solvers that integrate penalty forces (`SolverSemiImplicit`, `SolverFeatherstone`): the mean of both bodies'
//! `contactStiffness` k and `contactDamping` c makes
//!
//! ```math
//! F = k\,\xi + c\,\max(\dot\xi, 0)
//! ```
//!
//! (`eval_body_contact`, `kernels_contact.py` of newton 1.8.0): the dashpot acts in the approach only, so that with ζ = c/(2√(m\*k)) and
//! cos φ = ζ
//!
//! ```math
//! e = \exp\frac{-\zeta\varphi}{\sqrt{1-\zeta^2}}, \qquad T = \sqrt{\frac{m^*}k}\left(\frac\varphi{\sqrt{1-\zeta^2}}+\frac\pi2\right):
//! ```
//!
//! the restitution is the root of that of the linear law that ends at zero force. Run in Newton by `.ci/check_robotics.py`.

use std::f64::consts::PI;

use fem_laws::bisection::{falling_zero, last_where};
use fem_laws::laws::{ContactLaw, kuwabara_kono, linear_from_restitution, power};
use fem_laws::{EndRule, LawError, LawImpact, Pair};

use crate::estimate::FitError;
use crate::estimate::minimise;
use crate::table::Point;

/// Decades around the data's own values within which Drake's d is searched.
const REACH: f64 = 1e6;
/// v\* over the fastest speed of the data.
const BEYOND: f64 = 1.001;
/// Least k_p/k₁ − 1 that counts as a loss.
const LEAST_EXCESS: f64 = 1e-6;

/// Which LAMMPS: the factor of its `tsuji`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TsujiVersion {
    /// Up to 22 July 2025: the polynomial as it is.
    Plain,
    /// Later: times √2.
    RootTwo,
}

/// Returns Marshall's polynomial at e.
fn polynomial(e: f64) -> f64 {
    let coefficients = [1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218];
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * e + coefficient)
}

/// α of F = K ξ^(3/2) + α √(m* K) ξ^(1/4) ξ̇ for an entered e.
fn tsuji_alpha(entered: f64, version: TsujiVersion) -> f64 {
    match version {
        TsujiVersion::Plain => polynomial(entered),
        TsujiVersion::RootTwo => 2f64.sqrt() * polynomial(entered),
    }
}

/// Returns the restitution that `damping tsuji` makes of an entered one, at zero overlap.
pub fn tsuji_outcome(entered: f64, version: TsujiVersion) -> f64 {
    let ratio = tsuji_alpha(entered, version).max(0.0) / 5f64.sqrt();
    (-PI * ratio / (1.0 - ratio * ratio).max(0.0).sqrt()).exp()
}

/// Returns the entry for which `damping tsuji` makes this restitution; `None` if no value from 0 to 1 does.
pub fn tsuji_entry(wanted: f64, version: TsujiVersion) -> Option<f64> {
    let reach = tsuji_outcome(0.0, version)..=tsuji_outcome(1.0, version);
    let entry = || last_where(0.0, 1.0, |entered| tsuji_outcome(entered, version) <= wanted);
    reach.contains(&wanted).then(entry)
}

/// Returns η, 1/(m s), of a pair with A, s.
///
/// # Errors
/// A negative or not finite.
pub fn viscoelastic_damping(pair: &Pair, dissipation_time: f64) -> Result<f64, LawError> {
    let law = kuwabara_kono(pair, dissipation_time)?;
    Ok(law.damping() / (pair.effective_mass() * pair.effective_radius().sqrt()))
}

/// Returns k_n, N/m, of `hooke` for a characteristic velocity, m/s.
pub fn hooke_stiffness(pair: &Pair, velocity: f64) -> f64 {
    let unit = 16.0 / 15.0 * pair.effective_radius().sqrt() * pair.contact_modulus();
    unit * (pair.effective_mass() * velocity * velocity / unit).powf(0.2)
}

/// Returns V, m/s, at which [`hooke_stiffness`] is this, N/m.
pub fn characteristic_velocity(pair: &Pair, stiffness: f64) -> f64 {
    let unit = 16.0 / 15.0 * pair.effective_radius().sqrt() * pair.contact_modulus();
    ((stiffness / unit).powi(5) * unit / pair.effective_mass()).sqrt()
}

/// Returns β_n of an en from 0 to 1 (not included).
pub fn yade_betan(en: f64) -> f64 {
    const H: [f64; 10] = [
        -6.918798, -16.41105, 146.8049, -796.4559, 2928.711, -7206.864, 11494.29, -11342.18,
        6276.757, -1489.915,
    ];
    let exponent = en * H.iter().rev().fold(0.0, |sum, h| sum * en + h);
    let share = 1.0 - (1.0 + en).powi(2) * exponent.exp();
    (share.recip() - 1.0).max(0.0).sqrt()
}

/// Returns the en for which Hertz–Mindlin makes this restitution.
///
/// # Errors
/// The pair has no collision.
pub fn hertz_mindlin_entry(pair: &Pair, restitution: f64) -> Result<f64, LawError> {
    let stiffness = 2.0 * pair.contact_modulus() * pair.effective_radius().sqrt();
    let unit = 2.0 * (pair.effective_mass() * stiffness).sqrt();
    // The restitution is the same at every speed.
    let made = |en: f64| {
        let law = power(2.0 / 3.0 * stiffness, 1.5, unit * yade_betan(en), 0.25)?;
        Ok::<f64, LawError>(LawImpact::new(pair, law).impact(1.0)?.restitution)
    };
    made(restitution)?;
    // The entry corrects the error of YADE's fit; beyond en = 0.999 the fit is not monotone.
    let (low, high) = ((restitution - 0.02).max(1e-3), (restitution + 0.02).min(0.999));
    if low >= high || made(low)? >= restitution || made(high)? <= restitution {
        return Ok(restitution);
    }
    Ok(falling_zero(low, high, |en| made(en).map_or(0.0, |made| restitution - made)))
}

/// Returns the tc, s, and en for which ViscEl's cut-off contact makes e and T of a linear law that ends at zero force;
/// `None` for restitutions below about 0.14, which tc and en cannot make.
pub fn viscel_entry(pair: &Pair, law: &ContactLaw) -> Option<(f64, f64)> {
    let mass = pair.effective_mass();
    let rate = 0.5 * law.damping() / mass;
    let frequency = law.stiffness() / mass - rate * rate;
    let time = PI / frequency.sqrt();
    (frequency > 0.0).then(|| (time, (-rate * time).exp()))
}

/// Returns the stiffness, N/m, and the damping, N s/m, for which Newton's penalty contact makes this restitution and contact time, s.
///
/// # Errors
/// A restitution outside (0, 1], a time that is not positive and finite.
pub fn newton_entry(pair: &Pair, restitution: f64, time: f64) -> Result<[f64; 2], LawError> {
    // Twice the approach of the linear law that ends at zero force, less the half period of an undamped return.
    let unit = linear_from_restitution(pair, restitution.powi(2), 1.0, EndRule::ZeroForce)?;
    let phase = (unit.stiffness() / pair.effective_mass()).sqrt();
    let faster = 0.5 * (phase + PI) / (phase * time);
    Ok([unit.stiffness() * faster * faster, unit.damping() * faster])
}

/// Returns the restitution that `HERTZIAN` makes of an e_n in (0, 1].
pub fn mfix_outcome(entered: f64) -> f64 {
    of_sine(2.0 / 5f64.sqrt() * sine(entered))
}

/// Returns the e_n for which `HERTZIAN` makes this restitution; `None` if there is none.
pub fn mfix_entry(wanted: f64) -> Option<f64> {
    let sine = 5f64.sqrt() / 2.0 * sine(wanted);
    (sine < 1.0).then(|| of_sine(sine)).filter(|entry| *entry > 0.0)
}

/// |ln e|/√(π² + ln² e).
fn sine(e: f64) -> f64 {
    let loss = e.recip().ln();
    loss / PI.hypot(loss)
}

fn of_sine(sine: f64) -> f64 {
    (-PI * sine / ((1.0 - sine) * (1.0 + sine)).sqrt()).exp()
}

/// Returns a = d v of a restitution between 0 and 1.
pub fn dissipation_of(restitution: f64) -> f64 {
    let e = restitution;
    // The root is above 3/2 (1 − e).
    last_where(0.5 * (1.0 - e), e.recip(), |a| surplus(e, a) >= 0.0)
}

/// Returns the restitution at a = d v > 0.
pub fn restitution_of(a: f64) -> f64 {
    last_where(0.0, a.recip().min(1.0), |e| surplus(e, a) >= 0.0)
}

/// (1 + e) a less the logarithm: positive below the root, a of an e or e of an a; far below it rounding.
fn surplus(e: f64, a: f64) -> f64 {
    (1.0 + e) * a - a.ln_1p() + (-e * a).ln_1p()
}

/// Returns d, s/m, by least squares of e(v), and √(Σ (e − e_i)²/N); `None` for data without a loss or with nothing but loss.
///
/// # Errors
/// A fit that does not converge.
pub fn fit_dissipation(points: &[Point]) -> Result<Option<[f64; 2]>, FitError> {
    let lossy = points.iter().filter(|point| (1e-6..1.0 - 1e-6).contains(&point.restitution));
    let mut own: Vec<f64> =
        lossy.map(|point| dissipation_of(point.restitution) / point.speed).collect();
    own.sort_by(f64::total_cmp);
    let [first, .., last] = own[..] else { return Ok(None) };
    let residuals = |theta: &[f64]| {
        let d = theta[0].exp();
        let error = |point: &Point| restitution_of(d * point.speed) - point.restitution;
        Some(points.iter().map(error).collect())
    };
    let bounds = [((first / REACH).ln(), (last * REACH).ln())];
    // For data that rise with speed the sum of squares may have more than one minimum.
    let starts = [first, own[own.len() / 2], last];
    let mut best: Option<[f64; 2]> = None;
    for start in starts {
        let (theta, sum) = minimise(&residuals, &[start.ln()], &bounds)?;
        let rms = (sum / points.len() as f64).sqrt();
        if best.is_none_or(|best| rms < best[1]) {
            best = Some([theta[0].exp(), rms]);
        }
    }
    Ok(best)
}

/// Returns Luding's springs of a pair, k_p/k₁, k₁ (N/m) and φ_f over the reduced diameter, by least squares of e(v) and then of T(v),
/// of T/T_i − 1; `None` if the restitution does not fall or there are no contact times.
///
/// # Errors
/// A fit that does not converge.
pub fn fit_springs(pair: &Pair, points: &[Point]) -> Result<Option<[f64; 3]>, FitError> {
    let fastest = BEYOND * points.iter().map(|point| point.speed).fold(0.0, f64::max);
    let restitution = |excess: f64, speed: f64| (1.0 + excess * speed / fastest).powf(-0.5);
    let residuals = |theta: &[f64]| {
        let error = |point: &Point| restitution(theta[0].exp(), point.speed) - point.restitution;
        Some(points.iter().map(error).collect())
    };
    let bounds = (LEAST_EXCESS.ln(), -LEAST_EXCESS.ln());
    let excess = minimise(&residuals, &[0.0], &[bounds])?.0[0].exp();
    let rate = |point: &Point| {
        let share = 0.5 * PI * (1.0 + restitution(excess, point.speed));
        point.contact_time.map(|time| share / time)
    };
    let rates = || points.iter().filter_map(rate);
    let (sum, squares) = (rates().sum::<f64>(), rates().map(|rate| rate * rate).sum::<f64>());
    if excess <= 2.0 * LEAST_EXCESS || sum == 0.0 {
        return Ok(None);
    }
    let mass = pair.effective_mass();
    let loading = mass * (squares / sum).powi(2);
    let approach = fastest * (mass / loading).sqrt();
    let ratio = 1.0 + excess;
    let depth = approach * excess / (2.0 * pair.effective_radius() * ratio);
    Ok(Some([ratio, loading, depth]))
}
