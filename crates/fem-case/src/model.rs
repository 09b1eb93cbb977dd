//! The model that a case chooses, its numbers checked. One variant a model.

use fem_laws::{EndRule, Family};

/// How the collision is computed.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum ModelChoice {
    /// Explicit finite elements.
    #[default]
    Fem,
    /// Linear finite elements condensed to their contact nodes.
    Condensed(CondensedOptions),
    /// Elastic half-spaces.
    Hertz {
        /// Whether the spheres' finite size adds to the approach.
        finite_size: bool,
    },
    /// Viscoelastic half-spaces, quasi-static.
    Ting {
        /// Whether the spheres' finite size adds to the approach.
        finite_size: bool,
        /// Accuracy of restitution, time and force.
        tolerance: f64,
    },
    /// A contact law.
    Law {
        /// Which, with its numbers.
        law: Law,
        /// When the contact is over.
        end_rule: EndRule,
        /// Accuracy of restitution, time and force.
        tolerance: f64,
    },
}

impl ModelChoice {
    /// Its key under `[model]`.
    pub fn name(&self) -> &'static str {
        match self {
            ModelChoice::Fem => "fem",
            ModelChoice::Condensed(_) => "condensed",
            ModelChoice::Hertz { .. } => "hertz",
            ModelChoice::Ting { .. } => "ting",
            ModelChoice::Law { .. } => "law",
        }
    }

    /// The dotted key of its table.
    pub fn path(&self) -> String {
        match self {
            ModelChoice::Law { law, .. } => format!("model.law.{}", law.name()),
            _ => format!("model.{}", self.name()),
        }
    }
}

/// The keys of `model.condensed`, resolved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CondensedOptions {
    /// Modes of free vibration of each body.
    pub vibration_modes: usize,
    /// Steps over the elastic contact time.
    pub steps: usize,
    /// Whether overlap is resisted by the explicit model's springs.
    pub penalty_springs: bool,
}

impl Default for CondensedOptions {
    fn default() -> Self {
        Self { vibration_modes: 0, steps: 1000, penalty_springs: false }
    }
}

/// A contact law with its numbers, SI.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// Spring and dashpot.
    Linear {
        /// K, N/m.
        stiffness: f64,
        /// C, N s/m.
        damping: f64,
    },
    /// The same by what comes out.
    LinearFromRestitution {
        /// e.
        restitution: f64,
        /// T, s.
        contact_time: f64,
    },
    /// F = K ξ^γ + C ξⁿ ξ̇.
    Power {
        /// K, N/m^γ.
        stiffness: f64,
        /// γ.
        elastic_exponent: f64,
        /// C, N s/m^(n+1).
        damping: f64,
        /// n.
        damping_exponent: f64,
    },
    /// Hertz.
    Hertz,
    /// By A.
    KuwabaraKono(Dissipation),
    /// By the restitution at a speed.
    HuntCrossley {
        /// e.
        restitution: f64,
        /// m/s; the case's approach speed if none.
        speed: Option<f64>,
    },
    /// By e or α.
    Tsuji(Dashpot),
    /// By e or α.
    ZhangWhiten(Dashpot),
    /// By its dashpot.
    Falcon {
        /// C, N s/m^(5/4).
        damping: f64,
    },
    /// Spring and dashpot.
    MishraMurty {
        /// K, N/m^(8/5).
        stiffness: f64,
        /// C, N s/m^(9/5).
        damping: f64,
    },
    /// By C_n.
    SchwagerPoeschel(Dissipation),
    /// By viscoelastic coefficients.
    MorgadoOppenheim {
        /// η₁, Pa s.
        eta_1: f64,
        /// η₂.
        eta_2: f64,
    },
    /// By A and n.
    BordbarHyppanen {
        /// A, s.
        dissipation_time: f64,
        /// n.
        damping_exponent: f64,
    },
}

/// Where a dissipation time comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dissipation {
    /// Given, s.
    Time(f64),
    /// From viscosities.
    Viscosities {
        /// η₁, Pa s.
        shear: f64,
        /// η₂, Pa s.
        bulk: f64,
    },
    /// From the relaxation of the materials.
    Relaxation,
}

/// How strong a dashpot is that makes the restitution independent of speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dashpot {
    /// By the restitution e.
    Restitution(f64),
    /// By its coefficient α.
    Coefficient(f64),
}

impl Law {
    /// Which law it is.
    pub fn family(&self) -> Family {
        match self {
            Law::Linear { .. } | Law::LinearFromRestitution { .. } => Family::Linear,
            Law::Power { .. } => Family::Power,
            Law::Hertz => Family::Hertz,
            Law::KuwabaraKono(_) => Family::KuwabaraKono,
            Law::HuntCrossley { .. } => Family::HuntCrossley,
            Law::Tsuji(_) => Family::Tsuji,
            Law::ZhangWhiten(_) => Family::ZhangWhiten,
            Law::Falcon { .. } => Family::Falcon,
            Law::MishraMurty { .. } => Family::MishraMurty,
            Law::SchwagerPoeschel(_) => Family::SchwagerPoeschel,
            Law::MorgadoOppenheim { .. } => Family::MorgadoOppenheim,
            Law::BordbarHyppanen { .. } => Family::BordbarHyppanen,
        }
    }

    /// Its key under `law`.
    pub fn name(&self) -> &'static str {
        self.family().name()
    }
}
