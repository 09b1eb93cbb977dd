//! From a law's numbers in a case to the law of its pair: one arm a law.

use fem_laws::laws::{self, ContactLaw};
use fem_laws::{EndRule, LawError, Pair, PairRelaxation};
use fem_material::Material;

use crate::model::{Dashpot, Dissipation, Law};

/// What a law is made for.
pub(super) struct Setting<'a> {
    /// With instantaneous moduli.
    pub pair: Pair,
    /// m/s.
    pub speed: f64,
    pub materials: [Option<&'a Material>; 2],
    pub relaxation: &'a PairRelaxation,
    pub end_rule: EndRule,
}

/// What cannot be made.
pub(super) enum Refusal {
    /// By the law itself.
    Law(LawError),
    /// By what it would be made from; and what to do.
    Source(&'static str, &'static str),
}

impl From<LawError> for Refusal {
    fn from(error: LawError) -> Self {
        Refusal::Law(error)
    }
}

impl Setting<'_> {
    /// The law, and the pair that it belongs to.
    pub fn law(&self, law: &Law) -> Result<(ContactLaw, Pair), Refusal> {
        let pair = &self.pair;
        let made = match *law {
            Law::Linear { stiffness, damping } => laws::linear(stiffness, damping)?,
            Law::LinearFromRestitution { restitution, contact_time } => {
                laws::linear_from_restitution(pair, restitution, contact_time, self.end_rule)?
            }
            Law::Power { stiffness, elastic_exponent, damping, damping_exponent } => {
                laws::power(stiffness, elastic_exponent, damping, damping_exponent)?
            }
            Law::Hertz => laws::hertz(pair)?,
            Law::KuwabaraKono(Dissipation::Relaxation) => return self.slow_limit(),
            Law::KuwabaraKono(Dissipation::Time(time)) => laws::kuwabara_kono(pair, time)?,
            Law::KuwabaraKono(Dissipation::Viscosities { shear, bulk }) => {
                let moduli = self.materials.map(|material| Some(material?.instantaneous()));
                let time = laws::corrected_dissipation_time(moduli, shear, bulk)?;
                laws::kuwabara_kono(pair, time)?
            }
            Law::HuntCrossley { restitution, speed } => {
                laws::hunt_crossley(pair, restitution, speed.unwrap_or(self.speed))?
            }
            Law::Tsuji(Dashpot::Coefficient(alpha))
            | Law::ZhangWhiten(Dashpot::Coefficient(alpha)) => laws::tsuji(pair, alpha)?,
            Law::Tsuji(Dashpot::Restitution(e)) if self.end_rule == EndRule::ZeroOverlap => {
                laws::tsuji_from_restitution(pair, e)?
            }
            Law::Tsuji(Dashpot::Restitution(e)) | Law::ZhangWhiten(Dashpot::Restitution(e)) => {
                laws::zhang_whiten_from_restitution(pair, e)?
            }
            Law::Falcon { damping } => laws::falcon(pair, damping)?,
            Law::MishraMurty { stiffness, damping } => laws::mishra_murty(stiffness, damping)?,
            Law::SchwagerPoeschel(Dissipation::Time(time)) => laws::schwager_poeschel(pair, time)?,
            Law::SchwagerPoeschel(Dissipation::Viscosities { shear, bulk }) => {
                self.schwager_poeschel(shear, bulk)?
            }
            Law::SchwagerPoeschel(Dissipation::Relaxation) => {
                return Err(Refusal::Source("schwager_poeschel has no slow limit", "give a"));
            }
            Law::MorgadoOppenheim { eta_1, eta_2 } => laws::morgado_oppenheim(pair, eta_1, eta_2)?,
            Law::BordbarHyppanen { dissipation_time, damping_exponent } => {
                laws::bordbar_hyppanen(pair, dissipation_time, damping_exponent)?
            }
        };
        Ok((made, *pair))
    }

    /// Kelvin's solid as the slow limit of the materials: relaxed moduli and the first moment.
    fn slow_limit(&self) -> Result<(ContactLaw, Pair), Refusal> {
        const GIVE: &str = "give a, or eta_1 and eta_2";
        if self.relaxation.terms().is_empty() {
            return Err(Refusal::Source(
                "no material relaxes, so nothing gives kuwabara_kono its \
                                        dissipation",
                GIVE,
            ));
        }
        let Some(time) = self.relaxation.dissipation_time() else {
            return Err(Refusal::Source(
                "a material flows (its weights sum to 1), so it has no slow \
                                        limit with a lasting stiffness",
                GIVE,
            ));
        };
        let slow = self.pair.softened(self.relaxation.equilibrium_weight())?;
        Ok((laws::kuwabara_kono(&slow, time)?, slow))
    }

    fn schwager_poeschel(&self, shear: f64, bulk: f64) -> Result<ContactLaw, Refusal> {
        let mut moduli = self.materials.iter().flatten().map(|material| material.instantaneous());
        let Some(first) = moduli.next() else { return Err(LawError::TwoWalls.into()) };
        if moduli.any(|other| other != first) {
            return Err(Refusal::Source(
                "the viscosities of schwager_poeschel are those of one material, and the bodies' \
                 differ",
                "give a, or take kuwabara_kono",
            ));
        }
        let time = laws::dissipation_time(first, shear, bulk)?;
        Ok(laws::schwager_poeschel(&self.pair, time)?)
    }
}
