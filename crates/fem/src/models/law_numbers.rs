//! From what a case says of a law to the numbers of its family: one arm a law.

use fem_case::{Dashpot, Dissipation, Law};
use fem_laws::{EndRule, LawError, Pair, PairRelaxation, laws};
use fem_material::Material;

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
pub(super) enum Unmade {
    /// By the law itself.
    Law(LawError),
    /// By what it would be made from; and what to do.
    Source(&'static str, &'static str),
}

impl From<LawError> for Unmade {
    fn from(error: LawError) -> Self {
        Unmade::Law(error)
    }
}

impl Setting<'_> {
    /// The numbers of the law's family, and the pair that it belongs to.
    pub fn numbers(&self, law: &Law) -> Result<(Vec<f64>, Pair), Unmade> {
        let pair = &self.pair;
        let numbers = match *law {
            Law::Linear { stiffness, damping } => vec![stiffness, damping],
            Law::LinearFromRestitution { restitution, contact_time } => {
                let made =
                    laws::linear_from_restitution(pair, restitution, contact_time, self.end_rule)?;
                vec![made.stiffness(), made.damping()]
            }
            Law::Power { stiffness, elastic_exponent, damping, damping_exponent } => {
                vec![stiffness, elastic_exponent, damping, damping_exponent]
            }
            Law::Hertz => Vec::new(),
            Law::KuwabaraKono(Dissipation::Relaxation) => return self.slow_limit(),
            Law::KuwabaraKono(Dissipation::Viscosities { shear, bulk }) => {
                let moduli = self.materials.map(|material| Some(material?.instantaneous()));
                vec![laws::corrected_dissipation_time(moduli, shear, bulk)?]
            }
            Law::KuwabaraKono(Dissipation::Time(time))
            | Law::SchwagerPoeschel(Dissipation::Time(time)) => vec![time],
            Law::HuntCrossley { restitution, speed } => {
                vec![restitution, speed.unwrap_or(self.speed)]
            }
            Law::Tsuji(Dashpot::Coefficient(alpha))
            | Law::ZhangWhiten(Dashpot::Coefficient(alpha)) => vec![alpha],
            Law::Tsuji(Dashpot::Restitution(e)) | Law::ZhangWhiten(Dashpot::Restitution(e)) => {
                vec![match self.end_rule {
                    EndRule::ZeroOverlap => laws::tsuji_coefficient(e)?,
                    EndRule::ZeroForce => laws::zhang_whiten_coefficient(e)?,
                }]
            }
            Law::Falcon { damping } => vec![damping],
            Law::MishraMurty { stiffness, damping } => vec![stiffness, damping],
            Law::SchwagerPoeschel(Dissipation::Viscosities { shear, bulk }) => {
                vec![self.schwager_poeschel(shear, bulk)?]
            }
            Law::SchwagerPoeschel(Dissipation::Relaxation) => {
                return Err(Unmade::Source("schwager_poeschel has no slow limit", "give a"));
            }
            Law::MorgadoOppenheim { eta_1, eta_2 } => vec![eta_1, eta_2],
            Law::BordbarHyppanen { dissipation_time, damping_exponent } => {
                vec![dissipation_time, damping_exponent]
            }
        };
        Ok((numbers, *pair))
    }

    /// Kelvin's solid as the slow limit of the materials: relaxed moduli and the first moment.
    fn slow_limit(&self) -> Result<(Vec<f64>, Pair), Unmade> {
        const GIVE: &str = "give a, or eta_1 and eta_2";
        if self.relaxation.terms().is_empty() {
            let message = "no material relaxes, so nothing gives kuwabara_kono its dissipation";
            return Err(Unmade::Source(message, GIVE));
        }
        let Some(time) = self.relaxation.dissipation_time() else {
            let message = "a material flows (its weights sum to 1), so it has no slow limit with a \
                           lasting stiffness";
            return Err(Unmade::Source(message, GIVE));
        };
        Ok((vec![time], self.pair.softened(self.relaxation.equilibrium_weight())?))
    }

    /// A of the viscosities of one material.
    fn schwager_poeschel(&self, shear: f64, bulk: f64) -> Result<f64, Unmade> {
        let mut moduli = self.materials.iter().flatten().map(|material| material.instantaneous());
        let Some(first) = moduli.next() else { return Err(LawError::TwoWalls.into()) };
        if moduli.any(|other| other != first) {
            return Err(Unmade::Source(
                "the viscosities of schwager_poeschel are those of one material, and the bodies' \
                 differ",
                "give a, or take kuwabara_kono",
            ));
        }
        Ok(laws::dissipation_time(first, shear, bulk)?)
    }
}
