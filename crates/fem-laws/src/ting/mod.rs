//! Quasi-static impact of viscoelastic bodies with Hertz' contact.
//!
//! While the contact grows (Lee & Radok 1960) and after it has begun to shrink (Ting 1966),
//!
//! ```math
//! F(t) = \tfrac43\sqrt{R^*}\int_0^{t_1}\!\!E^*(t-s)\,\mathrm d\bigl[\delta(s)^{3/2}\bigr], \qquad
//! p(0,t) = \frac{2}{\pi\sqrt{R^*}}\int_0^{t_1}\!\!E^*(t-s)\,\mathrm d\sqrt{\delta(s)}, \qquad
//! a = \sqrt{R^*\delta(t_1)},
//! ```
//!
//! with t₁ = t in loading; in unloading t₁ is the earlier time at which the contact was as large:
//!
//! ```math
//! \int_{t_1}^{t}E^*(t-s)\,\dot\delta(s)\,\mathrm ds = 0, \qquad m^*\ddot\delta = -F.
//! ```
//!
//! Contact ends when t₁ = 0, and so F = 0, while δ > 0: the surfaces recover later. With the
//! Prony series of [`PairRelaxation`] every integral is a sum of elements' fading memories. In
//! units of the length ℓ = (m*/K)^(2/5) v^(4/5) and the time ℓ/v nothing is left but g∞, g_k and
//! b_k = ℓ/(v τ_k).
//!
//! With a [`FiniteSize`], Hertz' approach u(t) takes the place of δ(t) in the integrals, and
//!
//! ```math
//! \delta = u + \sum_i\frac{c_i}{E_iR_i}(s)\,F(s)
//! = u + \Bigl[m_\infty + \sum_k\frac{m_k\,s}{s+p_k}\Bigr] K u^{3/2},
//! ```
//!
//! products in Carson's transform, with c(a), E, ν of the relaxed moduli. That is the correspondence
//! principle in loading, to first order in a/R. In unloading the term E* K u^(3/2) since t₁ is left out of F:
//! with it the restitution of glass from 0.1 to 2 m/s is too small by up to 4e-4 at any loss, as direct
//! integration and finite elements show.
//!
//! With a [`SurfaceSlip`] its compliance adds to that of finite size in the same way.
//!
//! Bodies that radiate add −γ Ḟ each to δ: [`crate::radiation_damping`], in the passive form of
//! `radiation_compliance.rs`, by the force itself, in loading and unloading. The contact is then largest a little
//! before the approach is, and t₁ is found from that time.
//!
//! A thin plate adds w = β ∫F dt = β m* (v + g t − δ̇) to δ: [`crate::plate_mobility`].
//!
//! With gravity, δ̈ = g − F/m*. A ball that turns back while it still touches, or that creeps under its
//! weight, does not leave any more: it stays. Contacts that grow twice are not followed.
//!
//! Limits: those of [`crate::HertzImpact`], but with loss; a restitution below [`crate::MIN_RESTITUTION`] is returned as bodies that
//! stay together.

mod collision;
mod collocation;
mod loading_record;
mod radiation_compliance;
mod step;

use fem_material::Material;

use crate::error::{LawError, not_negative, positive, tolerance as checked_tolerance};
use crate::finite_size::FiniteSize;
use crate::finite_size::correction::RelaxingCorrection;
use crate::hertz::HertzImpact;
use crate::impact::Impact;
use crate::numerics::power;
use crate::pair::Pair;
use crate::pair_relaxation::PairRelaxation;
use crate::radiation::{radiation_damping, share_of_damping};
use crate::surface_slip::SurfaceSlip;
use crate::ting::collision::{Collision, Units};
use crate::ting::loading_record::{Contact, Element, IterationAccuracy, Plate};
use crate::ting::radiation_compliance::{COARSE_SHARE_OF_CONTACT, Radiation, SHARE_OF_CONTACT};

/// Rates above this are cut off: they leave a force of 1e-15.
const MAX_RATE: f64 = 1e15;

/// A viscoelastic pair.
#[derive(Debug, Clone, PartialEq)]
pub struct Ting {
    pair: Pair,
    relaxation: PairRelaxation,
    finite_size: Option<FiniteSize>,
    surface_slip: Option<SurfaceSlip>,
    /// γ of all bodies that radiate, m s/N.
    radiation_damping: Option<f64>,
    /// Set by [`Ting::with_coarse_waves`].
    has_coarse_waves: bool,
    /// Mobility β of a thin plate, m/(N s).
    plate_mobility: Option<f64>,
    tolerance: f64,
    /// Gravity along the approach, m/s².
    gravity: f64,
}

impl Ting {
    /// Accuracy of restitution, time and force that [`Ting::new`] asks for.
    pub const DEFAULT_TOLERANCE: f64 = 1e-8;

    /// Largest radiated share of the energy, as [`crate::radiated_share`] estimates it, for which the first
    /// order in frequency is accepted.
    pub const MAX_RADIATED_SHARE: f64 = 0.2;

    /// Creates the model of a pair, whose modulus is the instantaneous one, and its relaxation.
    pub fn new(pair: &Pair, relaxation: PairRelaxation) -> Self {
        Self {
            pair: *pair,
            relaxation,
            finite_size: None,
            surface_slip: None,
            radiation_damping: None,
            has_coarse_waves: false,
            plate_mobility: None,
            tolerance: Self::DEFAULT_TOLERANCE,
            gravity: 0.0,
        }
    }

    /// Sets the tolerance, 1e-10 to 1e-2.
    ///
    /// # Errors
    /// A tolerance outside.
    pub fn with_tolerance(self, tolerance: f64) -> Result<Self, LawError> {
        Ok(Self { tolerance: checked_tolerance(tolerance)?, ..self })
    }

    /// Adds gravity along the approach (m/s²), on a ball above a body that does not move.
    ///
    /// # Errors
    /// An acceleration that is negative or not finite.
    pub fn with_gravity(self, acceleration: f64) -> Result<Self, LawError> {
        Ok(Self { gravity: not_negative("gravity", acceleration)?, ..self })
    }

    /// Adds the finite size of the spheres, for the same materials as the relaxation.
    pub fn with_finite_size(self, finite_size: FiniteSize) -> Self {
        Self { finite_size: Some(finite_size), ..self }
    }

    /// Adds surface slip, for the same materials as the relaxation.
    pub fn with_surface_slip(self, surface_slip: SurfaceSlip) -> Self {
        Self { surface_slip: Some(surface_slip), ..self }
    }

    /// Adds the loss by waves into each body from which they do not return, given by its
    /// material; none without such a body. Its instantaneous moduli are taken: of one that relaxes within the
    /// contact give the elastic material that waves of the contact meet.
    ///
    /// # Errors
    /// Moduli so extreme that γ leaves the range of f64.
    pub fn with_radiation<'a>(
        self,
        bodies: impl IntoIterator<Item = &'a Material>,
    ) -> Result<Self, LawError> {
        let damping = bodies.into_iter().map(radiation_damping).reduce(|sum, own| sum + own);
        let radiation_damping =
            damping.map(|damping| positive("radiation damping", damping)).transpose()?;
        Ok(Self { radiation_damping, ..self })
    }

    /// Puts a thin plate in series with the contact, given by its mobility, m/(N s); see [`crate::plate_mobility`].
    ///
    /// # Errors
    /// A mobility that is not positive and finite.
    pub fn with_plate(self, mobility: f64) -> Result<Self, LawError> {
        Ok(Self { plate_mobility: Some(positive("plate mobility", mobility)?), ..self })
    }

    /// Returns the share of the contact modulus that never relaxes, 0 to 1.
    pub fn equilibrium_weight(&self) -> f64 {
        self.relaxation.equilibrium_weight()
    }

    /// Makes the model coarser and five times faster, for estimates: iterations end at 1e-8 of the speed, and waves are
    /// smoothed over four times the usual share of the contact time. At a loss of 0.6 %, the loss is 0.3 % too small,
    /// the change of the peak force 5 % and that of the contact time 30 %. Results are given beyond
    /// [`Ting::MAX_RADIATED_SHARE`] too.
    pub fn with_coarse_waves(self) -> Self {
        Self { has_coarse_waves: true, ..self }
    }

    /// Returns the collision at an approach speed, m/s.
    ///
    /// # Errors
    /// Those of [`HertzImpact::new`]; a contact too large for the finite-size correction; a
    /// radiated share too large; a motion that does not end.
    pub fn impact(&self, approach_speed: f64) -> Result<Impact, LawError> {
        let hertz = HertzImpact::new(&self.pair, self.scale(approach_speed)?)?;
        let units = Units::of(&hertz);
        let terms = self.relaxation.terms();
        let mut corrections = match &self.finite_size {
            Some(size) => {
                size.check(hertz.max_contact_radius())?;
                size.correction(units.length, units.force, units.radius, &self.relaxation)
            }
            None => RelaxingCorrection::none(terms.len()),
        };
        if let Some(slip) = &self.surface_slip {
            corrections.add(&slip.correction(units.length, units.force, &self.relaxation));
        }
        let elements = terms.iter().zip(corrections.fading).map(|(term, correction)| Element {
            weight: term.weight,
            rate: (units.time / term.relaxation_time).min(MAX_RATE),
            correction,
        });
        let contact = Contact {
            equilibrium: self.relaxation.equilibrium_weight(),
            elements: elements.collect(),
            correction: corrections.equilibrium,
            radiation: None,
            plate: self.plate_mobility.map(|mobility| Plate {
                mobility: mobility * units.force / units.speed,
                first_rate: approach_speed / units.speed,
            }),
            gravity: self.gravity * units.time / units.speed,
            accuracy: if self.has_coarse_waves {
                IterationAccuracy::FORECAST
            } else {
                IterationAccuracy::FULL
            },
        };
        let rate = approach_speed / units.speed;
        let run = |contact: &Contact| {
            Collision::new(contact, self.finite_size.as_ref(), self.tolerance, rate).run(&units)
        };
        let Some(damping) = self.radiation_damping else { return run(&contact) };
        let without = run(&contact)?;
        let sizes = [without.peak_force, without.max_approach];
        let (value, limit) = (share_of_damping(&hertz, sizes, damping), Self::MAX_RADIATED_SHARE);
        // A share that is no number is none that is small.
        if !(value <= limit || self.has_coarse_waves) {
            let quantity = "radiated energy / energy of approach";
            return Err(LawError::OutsideValidity { quantity, value, limit });
        }
        let radiation = Radiation::new(
            damping * units.force / (units.length * units.time),
            (without.max_contact_radius / units.radius).powi(2),
            without.contact_time.unwrap_or(hertz.contact_time()) / units.time,
            if self.has_coarse_waves { COARSE_SHARE_OF_CONTACT } else { SHARE_OF_CONTACT },
        );
        run(&Contact { radiation: Some(radiation), ..contact })
    }
}

impl Ting {
    /// Returns the unit of speed (m/s): that of approach, or √(g δ) of the static
    /// approach δ of instantaneous moduli where a ball is let down more slowly than that.
    fn scale(&self, approach_speed: f64) -> Result<f64, LawError> {
        if self.gravity == 0.0 {
            return Ok(approach_speed);
        }
        let stiffness = HertzImpact::new(&self.pair, approach_speed)?.stiffness();
        let at_rest = power(self.pair.effective_mass() * self.gravity / stiffness, 2.0 / 3.0);
        Ok(approach_speed.max((self.gravity * at_rest).sqrt()))
    }
}
