//! The model that a case chooses, its numbers checked. One variant a model.

use fem_laws::{EndRule, LawFamily};

/// How the collision is computed.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum ModelChoice {
    /// Explicit finite elements.
    #[default]
    Fem,
    /// The cheapest of the others that serves what the case asks for.
    Auto,
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
            ModelChoice::Auto => "auto",
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
        Self { vibration_modes: 0, steps: 250, penalty_springs: false }
    }
}

/// A contact law with its numbers, SI.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// Spring and dashpot.
    Linear {
        /// Stiffness K, N/m.
        stiffness: f64,
        /// Damping C, N s/m.
        damping: f64,
    },
    /// Spring and dashpot by what is to come out.
    LinearFromRestitution {
        /// Restitution e.
        restitution: f64,
        /// Contact time T, s.
        contact_time: f64,
    },
    /// F = K ξ^γ + C ξⁿ ξ̇.
    Power {
        /// Stiffness K, N/m^γ.
        stiffness: f64,
        /// Exponent γ of the spring.
        elastic_exponent: f64,
        /// Damping C, N s/m^(n+1).
        damping: f64,
        /// Exponent n of the dashpot.
        damping_exponent: f64,
    },
    /// Hertz' spring without damping.
    Hertz,
    /// Kelvin's damping by the dissipation time A.
    KuwabaraKono(Dissipation),
    /// Damping in proportion to the spring, by the restitution at a speed.
    HuntCrossley {
        /// Restitution e.
        restitution: f64,
        /// m/s; the case's approach speed if none.
        speed: Option<f64>,
    },
    /// Damping that makes restitution independent of speed, by e or α.
    Tsuji(Dashpot),
    /// Tsuji's, ended at zero force, by e or α.
    ZhangWhiten(Dashpot),
    /// Hertz' spring with the damping C ξ^(1/4) ξ̇.
    Falcon {
        /// Damping C, N s/m^(5/4).
        damping: f64,
    },
    /// F = K ξ^(8/5) + C ξ^(4/5) ξ̇.
    MishraMurty {
        /// Stiffness K, N/m^(8/5).
        stiffness: f64,
        /// Damping C, N s/m^(9/5).
        damping: f64,
    },
    /// Kelvin's damping by the normal damping C_n.
    SchwagerPoeschel(Dissipation),
    /// Damping of the spring's own form, by viscoelastic coefficients.
    MorgadoOppenheim {
        /// Coefficient η₁ in place of E, Pa s.
        eta_1: f64,
        /// Coefficient η₂ in place of ν.
        eta_2: f64,
    },
    /// Hertz' spring with the damping 2 A E* R*^(1−n) ξⁿ ξ̇.
    BordbarHyppanen {
        /// Dissipation time A, s.
        dissipation_time: f64,
        /// Exponent n of the dashpot.
        damping_exponent: f64,
    },
}

/// Where a dissipation time comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dissipation {
    /// The dissipation time A itself, s.
    Time(f64),
    /// From viscosities.
    Viscosities {
        /// Viscosity η₁ in shear, Pa s.
        shear: f64,
        /// Viscosity η₂ in compression, Pa s.
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
    pub fn family(&self) -> LawFamily {
        match self {
            Law::Linear { .. } | Law::LinearFromRestitution { .. } => LawFamily::Linear,
            Law::Power { .. } => LawFamily::Power,
            Law::Hertz => LawFamily::Hertz,
            Law::KuwabaraKono(_) => LawFamily::KuwabaraKono,
            Law::HuntCrossley { .. } => LawFamily::HuntCrossley,
            Law::Tsuji(_) => LawFamily::Tsuji,
            Law::ZhangWhiten(_) => LawFamily::ZhangWhiten,
            Law::Falcon { .. } => LawFamily::Falcon,
            Law::MishraMurty { .. } => LawFamily::MishraMurty,
            Law::SchwagerPoeschel(_) => LawFamily::SchwagerPoeschel,
            Law::MorgadoOppenheim { .. } => LawFamily::MorgadoOppenheim,
            Law::BordbarHyppanen { .. } => LawFamily::BordbarHyppanen,
        }
    }

    /// Its key under `law`.
    pub fn name(&self) -> &'static str {
        self.family().name()
    }
}
