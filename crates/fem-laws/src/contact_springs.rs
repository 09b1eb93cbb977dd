//! A contact as independent springs: a law for codes that choose the motion and the time step themselves.
//!
//! The springs of the method of dimensionality reduction (Popov & Heß, *Method of Dimensionality Reduction in Contact Mechanics
//! and Friction*, 2015) stand on the line x with gaps g(x). A spring at x carries, per length and on both sides, E* times its
//! compression c, where E*(t) is the Prony series of the pair; it never pulls, and a spring without load recovers freely,
//!
//! ```math
//! F = \sum_i 2E^*_0\,\Delta x_i\,f_i, \qquad f = g_\infty c + \sum_k g_k q_k \ge 0, \qquad
//! f > 0 \;\Rightarrow\; c = \delta - g_i .
//! ```
//!
//! So re-loading, creep and contacts that begin with overlap need no rules of their own. The springs of Hertz' contact have
//! g = x²/R\*. An elastic contact with any force F(δ) has the same form with
//!
//! ```math
//! x = \frac1{2E^*}\frac{\mathrm dF}{\mathrm d\delta}, \qquad g(x) = \delta,
//! ```
//!
//! which gives the gaps of spheres of a finite size ([`crate::FiniteSize`]) and of surfaces that slip ([`crate::SurfaceSlip`]):
//! x = a/(1 + d(δ−u)/du) where a² = R\*u. The compliance of either is taken at the angular frequency of the contact.
//!
//! A step Δt advances a branch by q ← αq + βΔc with the trapezoidal rule,
//!
//! ```math
//! \alpha = \frac{1-h}{1+h}, \quad \beta = \frac{1+\alpha}2, \quad h = \frac{\Delta t}{2\tau},
//! ```
//!
//! and α = −1/2 where h > 3, so that what the rule leaves of a fast branch halves in each step. With β = (1+α)/2 the work ½(q + q′)Δc is never below the gain of ½q², for steps of any length: their
//! difference is ½(1−α)/(1+α) (q + q′)²: a code that integrates the motion by velocity Verlet is given no energy by a
//! spring in contact. A plate in series moves by β∫F dt, with the mean force of the step. A half-space that radiates waves moves by −γḞ
//! ([`crate::radiation_damping`]), which in first order is a dashpot beside the springs, of γ(dF/dδ)²; it does not pull.
//!
//! The file that `fem-run export --law` writes has the same steps in C.

use fem_material::PronyTerm;

use crate::error::{LawError, positive};
use crate::finite_size::FiniteSize;
use crate::finite_size::correction::{Correction, RelaxingCorrection};
use crate::pair::Pair;
use crate::pair_relaxation::PairRelaxation;
use crate::surface_slip::SurfaceSlip;

/// Springs in the smallest contact of the range, and per factor of e in the contact radius beyond it.
const IN_SMALLEST: usize = 12;
/// Radius of the outermost springs over that of the largest contact, and the ratio of neighbours between the two.
const BEYOND: [f64; 2] = [2.5, 1.25];
/// Iterations of Newton's method for a plate; a sum of springs is a convex polygon.
const MAX_ITERATIONS: usize = 30;

/// The springs of a pair.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactSprings {
    /// Approach at which each spring is reached, m, ascending.
    pub gaps: Vec<f64>,
    /// Radius of Hertz' contact at that approach, m.
    pub radii: Vec<f64>,
    /// Stiffness of each spring before relaxation, N/m.
    pub stiffnesses: Vec<f64>,
    /// Share of the stiffness that does not relax.
    pub equilibrium_weight: f64,
    /// The relaxing shares.
    pub terms: Vec<PronyTerm>,
    /// Mobility of a plate in series, m/(N s); 0 without one.
    pub plate_mobility: f64,
    /// γ of half-spaces that radiate waves, m s/N; 0 without one.
    pub radiation_damping: f64,
}

/// The state of the springs of one contact.
#[derive(Debug, Clone, PartialEq)]
pub struct SpringState {
    compressions: Vec<f64>,
    branches: Vec<Vec<f64>>,
    n_reached: usize,
    deflection: f64,
    force: f64,
}

/// Effects that make a contact larger or smaller than Hertz' at the same approach.
#[derive(Debug, Clone, Default)]
pub struct SpringProfile {
    /// The finite size of the bodies.
    pub finite_size: Option<FiniteSize>,
    /// The slip of their surfaces.
    pub surface_slip: Option<SurfaceSlip>,
}

impl SpringProfile {
    /// Returns K, c₁ and c₂ of F = K δ^(3/2)/(1 + c₁ √δ + c₂ δ), exact at half and at the whole of a contact radius (m) of elastic
    /// bodies. Between them it has 1e-4 of F for contacts of a tenth of the radius.
    pub fn elastic(&self, pair: &Pair, relaxation: &PairRelaxation, radius: f64) -> [f64; 3] {
        let stiffness = 4.0 / 3.0 * pair.contact_modulus() * pair.effective_radius().sqrt();
        let correction = self.correction(pair, relaxation, 0.0);
        // (K δ^(3/2)/F − 1)/√δ = c₁ + c₂ √δ.
        let [[near, first], [far, second]] = [0.5, 1.0].map(|share: f64| {
            let hertz = (share * radius).powi(2) / pair.effective_radius();
            let added = 1.0 + hertz.sqrt() * correction.at(hertz);
            let root = (hertz * added).sqrt();
            [root, (added * added.sqrt() - 1.0) / root]
        });
        let slope = (second - first) / (far - near);
        [stiffness, first - slope * near, slope]
    }

    /// Returns the correction α − β ln u of δ − u over u^(3/2), m^(-1/2), at an angular frequency, rad/s.
    fn correction(&self, pair: &Pair, relaxation: &PairRelaxation, frequency: f64) -> Correction {
        let stiffness = 4.0 / 3.0 * pair.contact_modulus() * pair.effective_radius().sqrt();
        let mut whole = RelaxingCorrection::none(relaxation.terms().len());
        if let Some(size) = &self.finite_size {
            let root = pair.effective_radius().sqrt();
            whole.add(&size.correction(1.0, stiffness, root, relaxation));
        }
        if let Some(slip) = &self.surface_slip {
            whole.add(&slip.correction(1.0, stiffness, relaxation));
        }
        let mut at_frequency = whole.equilibrium;
        for (term, fading) in relaxation.terms().iter().zip(&whole.fading) {
            let ratio = (frequency * term.relaxation_time).powi(2);
            at_frequency.add(fading, ratio / (1.0 + ratio));
        }
        at_frequency
    }
}

impl ContactSprings {
    /// Creates the springs of a pair for contact radii from one to another, m; the profile is taken at an angular frequency, rad/s.
    /// `relaxation` is the whole one of the pair: [`ContactSprings::with_series`] replaces it by a shorter one.
    ///
    /// # Errors
    /// Radii that are not positive and finite.
    pub fn new(
        pair: &Pair,
        relaxation: &PairRelaxation,
        profile: &SpringProfile,
        [smallest, largest]: [f64; 2],
        frequency: f64,
    ) -> Result<Self, LawError> {
        let smallest = positive("contact radius", smallest)?;
        let largest = positive("contact radius", largest)?.max(smallest);
        let correction = profile.correction(pair, relaxation, frequency);
        let mut edges: Vec<f64> =
            (0..=IN_SMALLEST).map(|k| smallest * k as f64 / IN_SMALLEST as f64).collect();
        let (mut edge, [beyond, coarse]) = (smallest, BEYOND);
        while edge < beyond * largest {
            let fine = 1.0 + 1.0 / IN_SMALLEST as f64;
            // Springs of stiffened contacts reach farther than the contact.
            edge *= if edge < fine * fine * largest { fine } else { coarse };
            edges.push(edge);
        }
        let middle = |ends: &[f64]| 0.5 * (ends[0] + ends[1]);
        let places: Vec<f64> = edges.windows(2).map(middle).collect();
        let unit = 2.0 * pair.contact_modulus();
        let hertz: Vec<f64> =
            places.iter().map(|place| hertz_at(*place, pair, correction)).collect();
        let added = |u: &f64| u + u * u.sqrt() * correction.at(*u);
        Ok(Self {
            gaps: hertz.iter().map(added).collect(),
            radii: hertz.iter().map(|u| (pair.effective_radius() * u).sqrt()).collect(),
            stiffnesses: edges.windows(2).map(|ends| unit * (ends[1] - ends[0])).collect(),
            equilibrium_weight: relaxation.equilibrium_weight(),
            terms: relaxation.terms().to_vec(),
            plate_mobility: 0.0,
            radiation_damping: 0.0,
        })
    }

    /// Returns the springs with another series, whose weights may have any sum.
    #[must_use]
    pub fn with_series(self, equilibrium_weight: f64, terms: Vec<PronyTerm>) -> Self {
        Self { equilibrium_weight, terms, ..self }
    }

    /// Returns the springs with a plate in series, of a mobility in m/(N s).
    #[must_use]
    pub fn on_plate(self, plate_mobility: f64) -> Self {
        Self { plate_mobility, ..self }
    }

    /// Returns the springs of bodies of which half-spaces radiate waves, with γ in m s/N.
    #[must_use]
    pub fn radiating(self, radiation_damping: f64) -> Self {
        Self { radiation_damping, ..self }
    }

    /// Returns the stiffness of a tangential spring beside each spring, N/m, for a tangential modulus before relaxation, Pa: that of a
    /// disc that sticks, 2G* a, with the displacement by the bodies' finite size in series.
    pub fn shear_stiffnesses(&self, modulus: f64, size: Option<&FiniteSize>) -> Vec<f64> {
        let whole = |radius: f64| {
            let added =
                size.filter(|_| radius > 0.0).map_or(0.0, |size| size.added_approach(1.0, radius));
            let half_space = 2.0 * modulus * radius;
            half_space / (1.0 + half_space * added)
        };
        let inner = self.radii.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let last = self.radii[self.radii.len() - 1];
        let edges: Vec<f64> = [0.0].into_iter().chain(inner).chain([last]).map(whole).collect();
        edges.windows(2).map(|ends| ends[1] - ends[0]).collect()
    }

    /// Returns the state before first touch.
    pub fn state(&self) -> SpringState {
        let zeros = vec![0.0; self.gaps.len()];
        SpringState {
            branches: vec![zeros.clone(); self.terms.len()],
            compressions: zeros,
            n_reached: 0,
            deflection: 0.0,
            force: 0.0,
        }
    }

    /// Advances the springs by a step, s, at the end of which the bodies have an approach, m, and its rate, m/s; returns the force, N.
    pub fn force(
        &self,
        state: &mut SpringState,
        [approach, rate]: [f64; 2],
        time_step: f64,
    ) -> f64 {
        let factors: Vec<(f64, f64)> =
            self.terms.iter().map(|term| factors(term, time_step)).collect();
        let gained = self.terms.iter().zip(&factors).map(|(term, (_, gain))| term.weight * gain);
        let stiffness = self.equilibrium_weight + gained.sum::<f64>();
        let mut indentation = approach - state.deflection;
        let reached = |gap: &&f64| **gap < indentation;
        state.n_reached += self.gaps[state.n_reached..].iter().take_while(reached).count();
        let held: Vec<f64> = (0..state.n_reached)
            .map(|spring| {
                let series = self.terms.iter().zip(&factors).zip(&state.branches);
                let relaxing =
                    series.map(|((term, (decay, _)), branch)| term.weight * decay * branch[spring]);
                self.equilibrium_weight * state.compressions[spring] + relaxing.sum::<f64>()
            })
            .collect();
        let load = |spring: usize, indentation: f64| {
            let change = indentation - self.gaps[spring] - state.compressions[spring];
            (held[spring] + stiffness * change).max(0.0)
        };
        let sum = |indentation: f64| {
            let loads = (0..held.len()).map(|spring| (spring, load(spring, indentation)));
            loads.fold((0.0, 0.0), |(force, slope), (spring, load)| {
                let own = self.stiffnesses[spring];
                (force + own * load, slope + if load > 0.0 { own * stiffness } else { 0.0 })
            })
        };
        let half = 0.5 * self.plate_mobility * time_step;
        let (mut force, mut slope) = sum(indentation);
        for _ in 0..MAX_ITERATIONS {
            let excess = indentation + half * (state.force + force) + state.deflection - approach;
            if half == 0.0 || excess.abs() <= 1e-12 * approach.abs() {
                break;
            }
            indentation -= excess / (1.0 + half * slope);
            (force, slope) = sum(indentation);
        }
        let loads: Vec<f64> = (0..held.len()).map(|spring| load(spring, indentation)).collect();
        for (spring, (load, held)) in loads.iter().zip(&held).enumerate() {
            let change = (load - held) / stiffness;
            state.compressions[spring] += change;
            for (branch, (decay, gain)) in state.branches.iter_mut().zip(&factors) {
                branch[spring] = decay * branch[spring] + gain * change;
            }
        }
        state.deflection += half * (state.force + force);
        state.force = force;
        (force + self.radiation_damping * slope * slope * rate).max(0.0)
    }

    /// Returns restitution, contact time (s; infinite if the bodies stay together) and largest force (N) of an impact at a speed (m/s)
    /// of bodies with an effective mass, kg, by velocity Verlet in steps of a time, s.
    pub fn impact(&self, mass: f64, speed: f64, time_step: f64) -> [f64; 3] {
        let mut state = self.state();
        verlet_impact(mass, speed, time_step, |motion| self.force(&mut state, motion, time_step))
    }
}

/// Steps after which an impact has no end.
const MAX_STEPS: usize = 100_000;

/// Returns restitution, contact time (s; infinite if the bodies stay together) and largest force (N) of an impact at a speed (m/s) of an
/// effective mass, kg, under a force (N) of the approach (m) and its rate half a step before (m/s), by velocity Verlet in steps of a time,
/// s.
pub fn verlet_impact(
    mass: f64,
    speed: f64,
    time_step: f64,
    mut force_at: impl FnMut([f64; 2]) -> f64,
) -> [f64; 3] {
    let (mut approach, mut rate, mut force, mut peak) = (0.0, speed, 0.0, 0.0f64);
    for step in 1..MAX_STEPS {
        rate -= 0.5 * time_step * force / mass;
        approach += time_step * rate;
        let next = force_at([approach, rate]);
        rate -= 0.5 * time_step * next / mass;
        peak = peak.max(next);
        if next == 0.0 && rate < 0.0 {
            return [-rate / speed, (step as f64 - 0.5) * time_step, peak];
        }
        force = next;
    }
    [0.0, f64::INFINITY, peak]
}

/// Returns the factors α and β of a term over a step, s.
fn factors(term: &PronyTerm, time_step: f64) -> (f64, f64) {
    let half = 0.5 * time_step / term.relaxation_time;
    let decay = ((1.0 - half) / (1.0 + half)).max(-0.5);
    (decay, 0.5 * (1.0 + decay))
}

/// Returns Hertz' approach u, m, of the contact whose springs reach to a place, m.
fn hertz_at(place: f64, pair: &Pair, correction: Correction) -> f64 {
    let mut hertz = place * place / pair.effective_radius();
    for _ in 0..MAX_ITERATIONS {
        let slope = hertz.sqrt() * (1.5 * correction.at(hertz) - correction.beta);
        hertz = (place * (1.0 + slope.max(-0.5))).powi(2) / pair.effective_radius();
    }
    hertz
}
