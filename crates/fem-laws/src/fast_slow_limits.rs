//! Fast and slow limits of relaxation: terms much faster or slower than the contact are not integrated in
//! time.
//!
//! A term of relaxation time τ ≪ T has relaxed before the force has risen: its modulus is gone. One of τ ≫
//! T has not begun when the contact ends: it is elastic. The error of each follows from Ting's model to
//! first order about Hertz' pulse. With the contact's relaxation 1 + φ(t),
//!
//! ```math
//! F = K\bigl[u^{3/2} + P\bigr], \qquad
//! P = \tfrac32\int_0^{t_1}\!\varphi(t-s)\sqrt{u(s)}\,\mathrm du(s)
//! + \tfrac32\sqrt{u(t)}\int_{t_1}^t\varphi(t-s)\,\mathrm du(s),
//! ```
//!
//! where t₁ = t in loading and its mirror image in unloading. The changes follow from integrals over Hertz' pulse:
//!
//! - the loss of energy from the work K∮P du;
//! - the largest approach from the part of this work in loading;
//! - the largest force from both this part and P at T/2;
//! - the contact time from the change of u̇ at each u, less the time after the contact ends at u = −∫φ du, in which the
//!   surface still recovers.
//!
//! The loss of fast terms is C₁ of Ramírez et al. (1999).
//!
//! | | ε | φ | 1 − e | −ΔT/T | −ΔF/F |
//! |---|---|---|---|---|---|
//! | slow | g T/τ | −ε t/T | 4/9 ε | 0.0368 ε | 0.1974 ε |
//! | fast, with g′ left | g τ/(g′ T) | ε T δ(t) | c ε, c = 5.568 | (1 − c/10) ε | 3/5 c ε |
//!
//! Here g is the weight of the term in the contact's modulus. A term of the shear modulus G of one body is weighted
//! with this body's share of the contact's compliance and with ∂ ln(E/(1−ν²))/∂ ln G at constant K; that derivative is
//! 1 if K relaxes with G.
//!
//! Limits: ε ≪ 1. For a weak term with τ ≈ T, e and F are overestimated and T is underestimated by up to a
//! factor of three. With other terms that relax strongly the estimate has an error of up to a half.

use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};

use crate::difference::RelativeError;
use crate::error::{LawError, positive};

/// −∂(e, ln T, ln F)/∂ε of a slow term.
const SLOW: [f64; 3] = [4.0 / 9.0, 0.036_774, 0.197_430];

/// c of a fast term.
const FAST_LOSS: f64 = 5.567_81;

/// −∂(e, ln T, ln F)/∂ε of a fast term.
const FAST: [f64; 3] = [FAST_LOSS, 1.0 - 0.1 * FAST_LOSS, 0.6 * FAST_LOSS];

/// The materials of a contact without the terms that need not be integrated in time.
#[derive(Debug, Clone, PartialEq)]
pub struct FastSlowLimits {
    /// Material of each body; `None` is rigid. The instantaneous moduli lack the fast terms', the weights
    /// refer to them, and slow terms are part of what does not relax. Without a term left the material is
    /// elastic; with nothing folded it is as it was.
    pub materials: [Option<Material>; 2],
    /// Terms whose modulus is gone, of each body.
    pub n_fast: [usize; 2],
    /// Terms that are taken as elastic, of each body.
    pub n_slow: [usize; 2],
    /// Error of all folded terms together: restitution, contact time and force are too large by this.
    pub error: RelativeError,
}

/// Where a term goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fate {
    Kept,
    Fast,
    Slow,
}

impl FastSlowLimits {
    /// Folds as many terms as a tolerance on their total error allows. The bodies' materials are `None` for
    /// rigid bodies; the contact time (s) is that of Hertz' impact with instantaneous moduli.
    ///
    /// # Errors
    /// Two rigid bodies; a contact time or a tolerance that is not positive and finite.
    pub fn new(
        bodies: [Option<&Material>; 2],
        contact_time: f64,
        tolerance: &RelativeError,
    ) -> Result<Self, LawError> {
        if bodies == [None; 2] {
            return Err(LawError::TwoWalls);
        }
        positive("contact_time", contact_time)?;
        positive("tolerance of the restitution", tolerance.restitution)?;
        positive("tolerance of the contact time", tolerance.contact_time)?;
        positive("tolerance of the peak force", tolerance.peak_force)?;
        let contact = Folding { bodies, contact_time };
        let mut fates = bodies.map(|body| vec![Fate::Kept; terms(body).len()]);
        let mut folded = contact.fold(&fates).unwrap_or_else(|| contact.as_it_was());
        for (body, index, fate) in contact.candidates() {
            fates[body][index] = fate;
            match contact.fold(&fates).filter(|with| with.error.is_within(tolerance)) {
                Some(with) => folded = with,
                None => fates[body][index] = Fate::Kept,
            }
        }
        Ok(folded)
    }
}

/// A contact whose terms are to be folded.
struct Folding<'a> {
    bodies: [Option<&'a Material>; 2],
    contact_time: f64,
}

impl Folding<'_> {
    /// Returns body, term and the better limit of each term by itself, the least error first.
    fn candidates(&self) -> Vec<(usize, usize, Fate)> {
        let mut candidates = Vec::new();
        for (side, body) in self.bodies.iter().enumerate() {
            for (index, term) in terms(*body).iter().enumerate() {
                let ratio = self.contact_time / term.relaxation_time;
                let [slow, fast] = [SLOW[0] * ratio, FAST[0] / ratio];
                let fate = if slow < fast { Fate::Slow } else { Fate::Fast };
                candidates.push((term.weight * slow.min(fast), side, index, fate));
            }
        }
        candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
        candidates.into_iter().map(|(_, side, index, fate)| (side, index, fate)).collect()
    }

    fn as_it_was(&self) -> FastSlowLimits {
        FastSlowLimits {
            materials: self.bodies.map(Option::<&Material>::cloned),
            n_fast: [0; 2],
            n_slow: [0; 2],
            error: RelativeError::default(),
        }
    }

    /// `None` if nothing is left of a modulus.
    fn fold(&self, fates: &[Vec<Fate>; 2]) -> Option<FastSlowLimits> {
        let mut folded = self.as_it_was();
        for side in 0..2 {
            if let Some(body) = self.bodies[side] {
                folded.materials[side] = Some(material(body, &fates[side])?);
            }
            let count = |fate| fates[side].iter().filter(|other| **other == fate).count();
            folded.n_fast[side] = count(Fate::Fast);
            folded.n_slow[side] = count(Fate::Slow);
        }
        let moduli = |material: &Material| *material.instantaneous();
        let before = compliance(self.bodies.map(|body| body.map(moduli)));
        let after: [Option<ElasticModuli>; 2] =
            std::array::from_fn(|side| folded.materials[side].as_ref().map(moduli));
        let compliant = compliance(after);
        // T ∝ E*^(−2/5).
        let contact_time = self.contact_time * (compliant / before).powf(0.4);
        let (mut slow, mut fast) = (0.0, 0.0);
        for side in 0..2 {
            let (Some(body), Some(after)) = (self.bodies[side], &after[side]) else { continue };
            let Some(series) = body.relaxation() else { continue };
            let share = after.plane_strain_modulus().recip() / compliant;
            let left = after.shear_modulus() / body.instantaneous().shear_modulus();
            let weight = share * sensitivity(after, series.acts_on()) / left;
            for (term, fate) in series.terms().iter().zip(&fates[side]) {
                match fate {
                    Fate::Kept => {}
                    Fate::Slow => {
                        slow += weight * term.weight * (contact_time / term.relaxation_time)
                    }
                    Fate::Fast => {
                        fast += weight * term.weight * (term.relaxation_time / contact_time)
                    }
                }
            }
        }
        let [restitution, contact_time, peak_force] =
            std::array::from_fn(|i| SLOW[i] * slow + FAST[i] * fast);
        folded.error = RelativeError { restitution, contact_time, peak_force };
        Some(folded)
    }
}

fn terms(body: Option<&Material>) -> &[PronyTerm] {
    body.and_then(Material::relaxation).map_or(&[], PronySeries::terms)
}

/// Returns the compliance 1/E*, 1/Pa.
fn compliance(bodies: [Option<ElasticModuli>; 2]) -> f64 {
    bodies.iter().flatten().map(|moduli| moduli.plane_strain_modulus().recip()).sum()
}

/// Returns ∂ ln(E/(1−ν²))/∂ ln G, with K or at constant K.
fn sensitivity(moduli: &ElasticModuli, acts_on: ActsOn) -> f64 {
    let (bulk, shear) = (3.0 * moduli.bulk_modulus(), moduli.shear_modulus());
    match acts_on {
        ActsOn::All => 1.0,
        ActsOn::Shear => bulk / (bulk + 4.0 * shear) + shear / (bulk + shear),
    }
}

/// Returns the body's material without the folded terms.
fn material(body: &Material, fates: &[Fate]) -> Option<Material> {
    let Some(series) = body.relaxation().filter(|_| fates.iter().any(|fate| *fate != Fate::Kept))
    else {
        return Some(body.clone());
    };
    let with_fates = || series.terms().iter().zip(fates);
    // By what stays, so that rescaled weights do not add up to more than 1.
    let staying = with_fates().filter(|(_, fate)| **fate != Fate::Fast);
    let is_fast = fates.contains(&Fate::Fast);
    let left = if is_fast {
        series.equilibrium_weight() + staying.map(|(term, _)| term.weight).sum::<f64>()
    } else {
        1.0
    };
    let kept: Vec<PronyTerm> = with_fates()
        .filter(|(_, fate)| **fate == Fate::Kept)
        .map(|(term, _)| PronyTerm { weight: term.weight / left, ..*term })
        .collect();
    let moduli = body.instantaneous();
    let bulk = match series.acts_on() {
        ActsOn::All => left * moduli.bulk_modulus(),
        ActsOn::Shear => moduli.bulk_modulus(),
    };
    let moduli = ElasticModuli::from_bulk_shear(bulk, left * moduli.shear_modulus()).ok()?;
    let relaxation = match kept.is_empty() {
        true => None,
        false => Some(PronySeries::new(kept, series.acts_on()).ok()?),
    };
    Some(Material::new(body.density(), moduli, relaxation).ok()?.with_law(body.law()))
}
