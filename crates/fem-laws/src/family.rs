//! Laws by name, with their parameters and how they are made of them: the one list that case files,
//! fits and inverse problems read.

use crate::error::LawError;
use crate::laws;
use crate::laws::{ContactLaw, EndRule};
use crate::pair::Pair;

/// A law with parameters of its own. Values of parameters always come in the order of
/// [`LawFamily::parameters`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LawFamily {
    /// [`laws::linear`].
    Linear,
    /// [`laws::power`].
    Power,
    /// [`laws::hertz`].
    Hertz,
    /// [`laws::kuwabara_kono`].
    KuwabaraKono,
    /// [`laws::hunt_crossley`].
    HuntCrossley,
    /// [`laws::tsuji`].
    Tsuji,
    /// [`laws::tsuji`], ended at zero force.
    ZhangWhiten,
    /// [`laws::falcon`].
    Falcon,
    /// [`laws::mishra_murty`].
    MishraMurty,
    /// [`laws::schwager_poeschel`].
    SchwagerPoeschel,
    /// [`laws::morgado_oppenheim`].
    MorgadoOppenheim,
    /// [`laws::bordbar_hyppanen`].
    BordbarHyppanen,
    /// [`crate::Ting`] with the relaxation of the two materials.
    Ting,
}

/// One parameter of a law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawParameter {
    /// Its name: the key of a case file.
    pub key: &'static str,
    /// Its SI unit; empty for a plain number.
    pub unit: &'static str,
    /// Exponents of metre, kilogram, second.
    pub dimension: [i32; 3],
    /// What it does to the motion.
    pub role: ParameterRole,
    /// Value that it has unless it is given; `None` if it must be given or be free.
    pub default: Option<f64>,
    /// Values that have a meaning.
    pub limits: (f64, f64),
}

impl LawParameter {
    /// A value to begin with that has a meaning, near a collision at `speed`, m/s.
    pub fn guess(&self, speed: f64) -> f64 {
        self.default.unwrap_or(match (self.role, self.key) {
            (ParameterRole::Speed, _) => speed,
            (ParameterRole::Number, "e") => 0.8,
            // Like Poisson's ratio; at 0, the middle, nothing depends on it in first order.
            (ParameterRole::Number, "eta_2") => 0.25,
            (ParameterRole::Number, _) => 0.5 * (self.limits.0 + self.limits.1),
            _ => 1.0,
        })
    }
}

/// What a parameter does, and so how it is varied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParameterRole {
    /// A factor of the damping: varied by its logarithm.
    Damping,
    /// A factor of the elastic force: varied by its logarithm.
    Stiffness,
    /// A rate: varied by its logarithm.
    Rate,
    /// A speed: varied by its logarithm.
    Speed,
    /// A plain number, varied as it is.
    Number,
}

const ANY: (f64, f64) = (0.0, f64::INFINITY);

const fn parameter(
    key: &'static str,
    unit: &'static str,
    dimension: [i32; 3],
    role: ParameterRole,
) -> LawParameter {
    LawParameter { key, unit, dimension, role, default: None, limits: ANY }
}

const fn number(key: &'static str, default: Option<f64>, limits: (f64, f64)) -> LawParameter {
    LawParameter { key, unit: "", dimension: [0; 3], role: ParameterRole::Number, default, limits }
}

/// A, s: C = 2 A E* R*^(1−n).
const A: LawParameter = parameter("a", "s", [0, 0, 1], ParameterRole::Damping);
/// Of the damping, ξⁿ.
const N: LawParameter = number("n", Some(0.5), (0.0, 3.0));

impl LawFamily {
    /// All families, the laws of the overlap first.
    pub const ALL: [Self; 13] = [
        Self::Linear,
        Self::Power,
        Self::Hertz,
        Self::KuwabaraKono,
        Self::HuntCrossley,
        Self::Tsuji,
        Self::ZhangWhiten,
        Self::Falcon,
        Self::MishraMurty,
        Self::SchwagerPoeschel,
        Self::MorgadoOppenheim,
        Self::BordbarHyppanen,
        Self::Ting,
    ];

    /// As case files and the command line write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Power => "power",
            Self::Hertz => "hertz",
            Self::KuwabaraKono => "kuwabara_kono",
            Self::HuntCrossley => "hunt_crossley",
            Self::Tsuji => "tsuji",
            Self::ZhangWhiten => "zhang_whiten",
            Self::Falcon => "falcon",
            Self::MishraMurty => "mishra_murty",
            Self::SchwagerPoeschel => "schwager_poeschel",
            Self::MorgadoOppenheim => "morgado_oppenheim",
            Self::BordbarHyppanen => "bordbar_hyppanen",
            Self::Ting => "ting",
        }
    }

    /// The law of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|family| family.name() == name)
    }

    /// Its parameters. The first one that damps is what is free unless something else is asked.
    pub fn parameters(self) -> &'static [LawParameter] {
        const LINEAR: &[LawParameter] = &[
            parameter("k", "N/m", [0, 1, -2], ParameterRole::Stiffness),
            parameter("c", "N s/m", [0, 1, -1], ParameterRole::Damping),
        ];
        const POWER: &[LawParameter] = &[
            parameter("k", "N/m^gamma", [0; 3], ParameterRole::Stiffness),
            number("gamma", Some(1.5), (0.1, 5.0)),
            parameter("c", "N s/m^(n+1)", [0; 3], ParameterRole::Damping),
            N,
        ];
        const KUWABARA_KONO: &[LawParameter] = &[A];
        const HUNT_CROSSLEY: &[LawParameter] = &[
            number("e", None, (1e-6, 1.0)),
            parameter("v", "m/s", [1, 0, -1], ParameterRole::Speed),
        ];
        const TSUJI: &[LawParameter] = &[parameter("alpha", "", [0; 3], ParameterRole::Damping)];
        const FALCON: &[LawParameter] =
            &[parameter("c", "N s/m^(5/4)", [0; 3], ParameterRole::Damping)];
        const MISHRA_MURTY: &[LawParameter] = &[
            parameter("k", "N/m^(8/5)", [0; 3], ParameterRole::Stiffness),
            parameter("c", "N s/m^(9/5)", [0; 3], ParameterRole::Damping),
        ];
        const SCHWAGER_POESCHEL: &[LawParameter] = &[A];
        const MORGADO_OPPENHEIM: &[LawParameter] = &[
            parameter("eta_1", "Pa s", [-1, 1, -1], ParameterRole::Damping),
            number("eta_2", None, (-0.99, 0.99)),
        ];
        const BORDBAR_HYPPANEN: &[LawParameter] = &[A, N];
        const TING: &[LawParameter] =
            &[parameter("decay_rate", "1/s", [0, 0, -1], ParameterRole::Rate)];
        match self {
            Self::Linear => LINEAR,
            Self::Power => POWER,
            Self::Hertz => &[],
            Self::KuwabaraKono => KUWABARA_KONO,
            Self::HuntCrossley => HUNT_CROSSLEY,
            Self::Tsuji | Self::ZhangWhiten => TSUJI,
            Self::Falcon => FALCON,
            Self::MishraMurty => MISHRA_MURTY,
            Self::SchwagerPoeschel => SCHWAGER_POESCHEL,
            Self::MorgadoOppenheim => MORGADO_OPPENHEIM,
            Self::BordbarHyppanen => BORDBAR_HYPPANEN,
            Self::Ting => TING,
        }
    }

    /// Index of the parameter that stands for the loss: the first one that damps, or else the first;
    /// `None` of a law without any.
    pub fn loss_parameter(self) -> Option<usize> {
        let damps = |parameter: &LawParameter| {
            matches!(parameter.role, ParameterRole::Damping | ParameterRole::Rate)
        };
        let first = (!self.parameters().is_empty()).then_some(0);
        self.parameters().iter().position(damps).or(first)
    }

    /// How a contact ends if that is part of the law itself.
    pub fn end_rule(self) -> Option<EndRule> {
        matches!(self, Self::ZhangWhiten | Self::Ting).then_some(EndRule::ZeroForce)
    }

    /// The law of a pair; `None` for [`LawFamily::Ting`], which is no law of the overlap.
    ///
    /// # Errors
    /// Values without a meaning.
    pub fn law(self, pair: &Pair, values: &[f64]) -> Option<Result<ContactLaw, LawError>> {
        Some(match (self, values) {
            (Self::Linear, &[k, c]) => laws::linear(k, c),
            (Self::Power, &[k, gamma, c, n]) => laws::power(k, gamma, c, n),
            (Self::Hertz, &[]) => laws::hertz(pair),
            (Self::KuwabaraKono, &[a]) => laws::kuwabara_kono(pair, a),
            (Self::HuntCrossley, &[e, speed]) => laws::hunt_crossley(pair, e, speed),
            (Self::Tsuji | Self::ZhangWhiten, &[alpha]) => laws::tsuji(pair, alpha),
            (Self::Falcon, &[c]) => laws::falcon(pair, c),
            (Self::MishraMurty, &[k, c]) => laws::mishra_murty(k, c),
            (Self::SchwagerPoeschel, &[a]) => laws::schwager_poeschel(pair, a),
            (Self::MorgadoOppenheim, &[eta_1, eta_2]) => {
                laws::morgado_oppenheim(pair, eta_1, eta_2)
            }
            (Self::BordbarHyppanen, &[a, n]) => laws::bordbar_hyppanen(pair, a, n),
            _ => return None,
        })
    }
}
