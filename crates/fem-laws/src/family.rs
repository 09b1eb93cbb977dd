//! Laws by name, made from the table of [`crate::contact_laws`]: what case files, fits and inverse
//! problems read.

use fem_material::{FlowStress, Material};

use crate::error::LawError;
use crate::laws;
use crate::laws::{ContactLaw, EndRule};
use crate::pair::Pair;
use crate::pair_relaxation::PairRelaxation;

/// One parameter of a law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawParameter {
    /// Its name: the key of a case file.
    pub key: &'static str,
    /// Its SI unit; empty for a plain number.
    pub unit: &'static str,
    /// Exponents of metre, kilogram, second.
    pub dimension: [i32; 3],
    /// Its effect on the motion.
    pub role: ParameterRole,
    /// Value that it has unless it is given; `None` if it must be given or be free.
    pub default: Option<f64>,
    /// Values that a fit may try.
    pub limits: (f64, f64),
    /// Value that a fit of a plain number without a default begins with.
    pub start: f64,
}

impl LawParameter {
    /// Returns a valid value to begin with, near a collision at `speed`, m/s.
    pub fn guess(&self, speed: f64) -> f64 {
        self.default.unwrap_or(match self.role {
            ParameterRole::Speed => speed,
            ParameterRole::Number => self.start,
            _ => 1.0,
        })
    }
}

/// The effect of a parameter, which decides how a fit varies it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParameterRole {
    /// A factor of the damping: varied by its logarithm.
    Damping,
    /// A factor of the elastic force: varied by its logarithm.
    Stiffness,
    /// A yield strength, pressure or hardness: varied by its logarithm.
    Strength,
    /// A rate: varied by its logarithm.
    Rate,
    /// A speed: varied by its logarithm.
    Speed,
    /// A plain number, varied as it is.
    Number,
}

/// The kind of quantity that a key of a law holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum KeyKind {
    /// A plain number.
    Number,
    /// A speed, m/s.
    Speed,
    /// A time, s.
    Time,
    /// A stiffness, N/m.
    Stiffness,
    /// A damping coefficient, N s/m.
    Damping,
    /// A viscosity, Pa s.
    Viscosity,
    /// A rate, 1/s.
    Rate,
    /// A stress or pressure, Pa.
    Stress,
}

impl KeyKind {
    /// Returns the SI unit, and exponents of metre, kilogram, second.
    const fn unit(self) -> (&'static str, [i32; 3]) {
        match self {
            Self::Number => ("", [0; 3]),
            Self::Speed => ("m/s", [1, 0, -1]),
            Self::Time => ("s", [0, 0, 1]),
            Self::Stiffness => ("N/m", [0, 1, -2]),
            Self::Damping => ("N s/m", [0, 1, -1]),
            Self::Viscosity => ("Pa s", [-1, 1, -1]),
            Self::Rate => ("1/s", [0, 0, -1]),
            Self::Stress => ("Pa", [-1, 1, -2]),
        }
    }
}

/// The values that a key of a law allows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum KeyRange {
    /// Greater than 0.
    Positive,
    /// 0 or greater.
    NotNegative,
    /// Greater than 0 and at most 1.
    Restitution,
    /// Between −1 and 1.
    LikePoissonsRatio,
}

/// Whether a key is needed by a set of keys that determines a law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum KeyNeed {
    /// It must be given.
    Required,
    /// It may be left out; the law then takes it from the case.
    Optional,
    /// It has this value if it is left out.
    Default(f64),
    /// It must be given if this other key is greater than 0, and is 0 otherwise.
    With(&'static str),
}

/// A set of keys that determines a law.
pub type KeySet = &'static [(&'static str, KeyNeed)];

/// How a key is varied: the part of a [`LawParameter`] that a row of the table states.
#[derive(Clone, Copy)]
struct Role {
    role: ParameterRole,
    unit: Option<&'static str>,
    default: Option<f64>,
    limits: (f64, f64),
    start: f64,
}

impl Role {
    const DAMPING: Self = Self::factor(ParameterRole::Damping);
    const STIFFNESS: Self = Self::factor(ParameterRole::Stiffness);
    const STRENGTH: Self = Self::factor(ParameterRole::Strength);
    const HARDENING: Self = Self::number(Some(0.0), (0.0, 1e12));
    const SPEED: Self = Self::factor(ParameterRole::Speed);
    const RATE: Self = Self::factor(ParameterRole::Rate);
    /// n of a dashpot C ξⁿ ξ̇.
    const DAMPING_EXPONENT: Self = Self::number(Some(0.5), (0.0, 3.0));

    const fn factor(role: ParameterRole) -> Self {
        Self { role, unit: None, default: None, limits: (0.0, f64::INFINITY), start: 1.0 }
    }

    /// A number with a default, or one that a fit begins in the middle of its limits.
    const fn number(default: Option<f64>, limits: (f64, f64)) -> Self {
        let start = 0.5 * (limits.0 + limits.1);
        Self { role: ParameterRole::Number, unit: None, default, limits, start }
    }

    const fn starting_at(self, start: f64) -> Self {
        Self { start, ..self }
    }

    /// Sets the unit of a key that is a plain number in a case file, because its unit depends on an exponent.
    const fn in_unit(self, unit: &'static str) -> Self {
        Self { unit: Some(unit), ..self }
    }

    const fn parameter(self, key: &'static str, kind: KeyKind) -> LawParameter {
        let (own_unit, dimension) = kind.unit();
        let unit = match self.unit {
            Some(unit) => unit,
            None => own_unit,
        };
        let Self { role, default, limits, start, .. } = self;
        LawParameter { key, unit, dimension, role, default, limits, start }
    }
}

/// The value of a key in a set: required if the row does not say.
macro_rules! need {
    () => {
        KeyNeed::Required
    };
    ($need:expr) => {
        $need
    };
}

/// The function that makes parameters from keys: they are the keys' values if the row does not say.
macro_rules! values_by {
    () => {
        parameters_as_given
    };
    ($values:path) => {
        $values
    };
}

macro_rules! families {
    ($(
        $(#[$doc:meta])*
        $variant:ident, $name:ident, $table:ident, $example:literal;
        formula($pair:ident, [$($value:ident),*]) = $formula:expr;
        given by $([$($set_key:ident $(: $need:expr)?),*])+ $(, values $values:path)?;
        $(ends at $end:ident;)?
        keys { $($(#[$key_doc:meta])* $key:ident: $kind:ident, $range:ident $(, $role:expr)?;)* }
    )+) => {
        /// A law with parameters of its own. Values of parameters always come in the order of
        /// [`LawFamily::parameters`].
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum LawFamily {
            $($(#[$doc])* $variant,)+
            /// [`crate::Ting`] with the relaxation of the two materials.
            Ting,
        }

        impl LawFamily {
            /// All families, the laws of the overlap first.
            pub const ALL: [Self; [$(stringify!($name)),+].len() + 1] =
                [$(Self::$variant,)+ Self::Ting];

            /// Returns the name that case files and the command line use.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => stringify!($name),)+
                    Self::Ting => "ting",
                }
            }

            /// Returns the law's parameters.
            pub fn parameters(self) -> &'static [LawParameter] {
                match self {
                    $(Self::$variant => {
                        const {
                            &[$($($role.parameter(stringify!($key), KeyKind::$kind),)?)*]
                        }
                    })+
                    Self::Ting => const { &[Role::RATE.parameter("decay_rate", KeyKind::Rate)] },
                }
            }

            /// Returns how a contact ends, if that is part of the law itself.
            pub fn end_rule(self) -> Option<EndRule> {
                match self {
                    $($(Self::$variant => Some(EndRule::$end),)?)+
                    Self::Ting => Some(EndRule::ZeroForce),
                    _ => None,
                }
            }

            /// Returns the sets of keys of a case file that determine the law, any one of them.
            pub fn key_sets(self) -> &'static [KeySet] {
                match self {
                    $(Self::$variant => {
                        &[$(&[$((stringify!($set_key), need!($($need)?)),)*],)+]
                    })+
                    Self::Ting => &[],
                }
            }

            /// Returns the law of a pair; `None` for [`LawFamily::Ting`], which is no law of the
            /// overlap.
            ///
            /// # Errors
            /// A value is out of its range.
            pub fn law(self, pair: &Pair, values: &[f64]) -> Option<Result<ContactLaw, LawError>> {
                match (self, values) {
                    $((Self::$variant, &[$($value),*]) => {
                        let $pair = pair;
                        Some($formula)
                    })+
                    _ => None,
                }
            }

            fn values_by(self) -> fn(&LawInput, &LawContext<'_>) -> LawValues {
                match self {
                    $(Self::$variant => values_by!($($values)?),)+
                    Self::Ting => parameters_as_given,
                }
            }
        }
    };
}

crate::contact_laws!(families);

impl LawFamily {
    /// Returns the law of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|family| family.name() == name)
    }

    /// Returns whether a contact under this law leaves a dent.
    pub fn is_elastic_plastic(self) -> bool {
        use LawFamily::{
            Brake, JacksonGreen, Johnson, Luding, Mdr, MeanPressure, Thornton, WaltonBraun,
        };
        matches!(
            self,
            Thornton | Johnson | JacksonGreen | Brake | MeanPressure | Mdr | WaltonBraun | Luding
        )
    }

    /// Returns the index of the parameter that is a yield strength, a pressure or a hardness, of a law that has one.
    pub fn strength_parameter(self) -> Option<usize> {
        let is_it = |parameter: &LawParameter| parameter.role == ParameterRole::Strength;
        self.parameters().iter().position(is_it)
    }

    /// Returns the index of the parameter that a fit varies to match the loss: the first one that damps, or else the
    /// first; `None` for a law without parameters.
    pub fn loss_parameter(self) -> Option<usize> {
        let damps = |parameter: &LawParameter| {
            matches!(parameter.role, ParameterRole::Damping | ParameterRole::Rate)
        };
        let first = (!self.parameters().is_empty()).then_some(0);
        self.parameters().iter().position(damps).or(first)
    }
}

/// A law as a case gives it: the values of its keys, which one of its [`LawFamily::key_sets`] holds.
#[derive(Debug, Clone, PartialEq)]
pub struct LawInput {
    /// The family of the law.
    pub family: LawFamily,
    /// Keys and their values, SI.
    pub values: Vec<(&'static str, f64)>,
}

impl LawInput {
    /// Returns the value of a key, SI, if it is given.
    pub fn get(&self, key: &str) -> Option<f64> {
        self.values.iter().find(|(own, _)| *own == key).map(|(_, value)| *value)
    }

    /// Returns whether the law takes its damping from the relaxation of the materials.
    pub fn is_slow_limit(&self) -> bool {
        self.family == LawFamily::KuwabaraKono && self.values.is_empty()
    }

    /// Returns the parameters of the family and the pair that they belong to.
    ///
    /// # Errors
    /// A value is out of its range; the materials do not give what the law needs of them.
    pub fn parameters(&self, context: &LawContext<'_>) -> LawValues {
        self.family.values_by()(self, context)
    }
}

/// The pair and the collision that a law is made for.
#[derive(Debug, Clone, Copy)]
pub struct LawContext<'a> {
    /// The pair, with instantaneous moduli.
    pub pair: Pair,
    /// Approach speed, m/s.
    pub approach_speed: f64,
    /// Material of each body; `None` is rigid.
    pub materials: [Option<&'a Material>; 2],
    /// Yield strength of each body, Pa, where it is known.
    pub yield_strengths: [Option<f64>; 2],
    /// Radius of each body, m; infinite for a flat one.
    pub radii: [f64; 2],
    /// Relaxation of the contact modulus.
    pub relaxation: &'a PairRelaxation,
    /// When the contact is over.
    pub end_rule: EndRule,
}

/// Parameters of a family, and the pair that they belong to.
pub type LawValues = Result<(Vec<f64>, Pair), LawInputError>;

/// A law that cannot be made of its keys.
#[derive(Debug, Clone, PartialEq)]
pub enum LawInputError {
    /// The law rejects a value.
    Law(LawError),
    /// The materials do not give what the law needs of them.
    Materials {
        /// Why the law cannot be made.
        message: &'static str,
        /// The suggested fix.
        help: &'static str,
    },
}

impl From<LawError> for LawInputError {
    fn from(error: LawError) -> Self {
        Self::Law(error)
    }
}

/// Returns the parameters, which are the keys.
fn parameters_as_given(law: &LawInput, context: &LawContext<'_>) -> LawValues {
    let parameters = law.family.parameters().iter();
    let values = parameters.map(|parameter| law.get(parameter.key).unwrap_or_default());
    Ok((values.collect(), context.pair))
}
