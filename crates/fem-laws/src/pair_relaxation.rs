//! The relaxation function E*(t) of the contact of two viscoelastic bodies, exactly.
//!
//! With the Carson transforms G(s) and K(s) of a body's moduli (s times Laplace's), its contact
//! modulus is E/(1−ν²) of the elastic solution with G, K replaced (correspondence principle; Lee
//! 1955), and the compliances of the two bodies add:
//!
//! ```math
//! \frac1{E^*(s)} = \sum_{i=1,2} \frac{3K_i+4G_i}{4G_i(3K_i+G_i)}
//! = \sum_{i=1,2}\left[\frac1{4G_i(s)} + \frac1{\tfrac43\,(3K_i(s)+G_i(s))}\right].
//! ```
//!
//! So the contact is a chain of generalised Maxwell elements in series. Each element,
//! M(s) = M∞ + Σ M_k s/(s+b_k), has its zeros −λ between its poles; they are the poles of the
//! compliance 1/E*, whose zeros −p lie between them in turn (all real and not positive), and
//!
//! ```math
//! E^*(t) = E^*_0\Bigl(g_\infty + \sum_k g_k e^{-p_k t}\Bigr), \qquad g_k > 0.
//! ```
//!
//! A body whose bulk modulus relaxes with its shear modulus (`ActsOn::All`) is one element, an
//! elastic body a constant, a rigid wall nothing. Limits: linear viscoelasticity.

use fem_material::{ActsOn, ElasticModuli, Material, PronyTerm, relaxation_at};

use crate::error::{LawError, positive};
use crate::numerics::secular_equation::{Pole, merged, zeros};

/// E*(t)/E*(0) of a pair as a Prony series of its own.
#[derive(Debug, Clone, PartialEq)]
pub struct PairRelaxation {
    equilibrium_weight: f64,
    terms: Vec<PronyTerm>,
}

impl PairRelaxation {
    /// Creates the relaxation function for the materials of two bodies in either order; `None` is a rigid
    /// body.
    ///
    /// # Errors
    /// Two walls; relaxation times so short or long that a rate leaves the range of f64.
    pub fn new(first: Option<&Material>, second: Option<&Material>) -> Result<Self, LawError> {
        Self::of_chain(&chain_of(Direction::Normal, [first, second])?)
    }

    /// Returns the tangential modulus G* before relaxation, Pa, and its relaxation function, as [`PairRelaxation::new`] does those of E*:
    ///
    /// ```math
    /// \frac1{G^*(s)} = \sum_{i=1,2}\frac{2-\nu_i}{4G_i}(s)
    /// = \sum_{i=1,2}\left[\frac1{\tfrac83G_i(s)} + \frac1{\tfrac83\,(3K_i(s)+G_i(s))}\right].
    /// ```
    ///
    /// # Errors
    /// Those of [`PairRelaxation::new`].
    pub fn tangential(
        first: Option<&Material>,
        second: Option<&Material>,
    ) -> Result<(f64, Self), LawError> {
        let chain = chain_of(Direction::Tangential, [first, second])?;
        let compliance: f64 = chain.iter().map(|element| element.instantaneous().recip()).sum();
        Ok((positive("tangential modulus", compliance.recip())?, Self::of_chain(&chain)?))
    }

    fn of_chain(chain: &[Element]) -> Result<Self, LawError> {
        // Like elements in series relax as each of them does.
        if chain.iter().all(|element| *element == chain[0]) {
            return chain[0].relaxation();
        }
        let compliance: f64 = chain.iter().map(|element| element.instantaneous().recip()).sum();
        let creep = chain.iter().flat_map(|element| element.creep_poles(compliance.recip()));
        let terms = zeros(-1.0, &merged(creep.collect()))
            .into_iter()
            .map(|zero| {
                let weight = positive("pair relaxation weight", 1.0 / (zero.at * zero.slope))?;
                Ok(PronyTerm { weight, relaxation_time: zero.at.recip() })
            })
            .collect::<Result<_, LawError>>()?;
        let equilibrium: f64 = chain.iter().map(|element| element.equilibrium.recip()).sum();
        Ok(Self { equilibrium_weight: compliance / equilibrium, terms })
    }

    /// Returns E*(t)/E*(0) at `time` (s) after a step; 1 at and before 0, up to rounding.
    pub fn relaxation(&self, time: f64) -> f64 {
        relaxation_at(self.equilibrium_weight, &self.terms, time)
    }

    /// Returns the dissipation time of the slow limit, s, the A of [`crate::laws::kuwabara_kono`]; `None` if
    /// either body flows.
    ///
    /// A contact that changes slowly next to every p_k meets E*(s) = E*∞(1 + A s) with
    ///
    /// ```math
    /// A = \frac{\mathrm d\ln E^*}{\mathrm ds}\Big|_{s=0} = \frac1{g_\infty}\sum_k\frac{g_k}{p_k},
    /// ```
    ///
    /// which is Kelvin's solid: E* g∞ for the spring, and for one material the viscosities
    /// Σ G_k τ_k and Σ K_k τ_k in [`crate::laws::corrected_dissipation_time`].
    pub fn dissipation_time(&self) -> Option<f64> {
        let viscosity: f64 = self.terms.iter().map(|term| term.weight * term.relaxation_time).sum();
        (self.equilibrium_weight > 0.0).then(|| viscosity / self.equilibrium_weight)
    }

    /// Returns g∞ = E*(∞)/E*(0), in 0 ..= 1; exactly 0 if either body flows, 1 if both are elastic.
    pub fn equilibrium_weight(&self) -> f64 {
        self.equilibrium_weight
    }

    /// Returns the Maxwell elements, slowest first; none for two elastic bodies.
    pub fn terms(&self) -> &[PronyTerm] {
        &self.terms
    }
}

/// M(s) = M∞ + Σ M_k s/(s+b_k).
#[derive(PartialEq)]
struct Element {
    /// Equilibrium modulus M∞, Pa.
    equilibrium: f64,
    /// The decaying part: at b_k, 1/s, the weight M_k, Pa.
    terms: Vec<Pole>,
}

impl Element {
    fn instantaneous(&self) -> f64 {
        self.equilibrium + self.terms.iter().map(|term| term.weight).sum::<f64>()
    }

    /// Returns the relaxation function of a chain of such elements, M(t)/M(0).
    fn relaxation(&self) -> Result<PairRelaxation, LawError> {
        let instantaneous = self.instantaneous();
        let terms = merged(self.terms.clone()).into_iter().map(|pole| {
            let weight = positive("pair relaxation weight", pole.weight / instantaneous)?;
            Ok(PronyTerm { weight, relaxation_time: pole.at.recip() })
        });
        let equilibrium_weight = self.equilibrium / instantaneous;
        Ok(PairRelaxation { equilibrium_weight, terms: terms.collect::<Result<_, LawError>>()? })
    }

    /// Poles at λ of `unit`/M(−x) = `unit`/M₀ − Σ r/(x−λ).
    ///
    /// M(−x)/x = M∞/x + Σ M_k/(x−b_k) has the wanted zeros, and r = 1/(λ·slope). If M∞ = 0 the
    /// zero at 0 is M's own; there M(s) = s Σ M_k/b_k.
    fn creep_poles(&self, unit: f64) -> Vec<Pole> {
        let mut poles = self.terms.clone();
        poles.push(Pole { at: 0.0, weight: self.equilibrium });
        let mut creep: Vec<Pole> = zeros(0.0, &merged(poles))
            .into_iter()
            .map(|zero| Pole { at: zero.at, weight: unit / (zero.at * zero.slope) })
            .collect();
        if self.equilibrium == 0.0 {
            let viscosity: f64 = self.terms.iter().map(|term| term.weight / term.at).sum();
            creep.push(Pole { at: 0.0, weight: unit / viscosity });
        }
        creep
    }
}

/// Direction of the displacement relative to the surface.
#[derive(Clone, Copy)]
enum Direction {
    Normal,
    Tangential,
}

impl Direction {
    /// Returns the modulus of a body of one Poisson's ratio, and those of a chain of two elements in units of its shear modulus and of
    /// three times its bulk modulus.
    fn moduli(self, moduli: &ElasticModuli) -> (f64, [[f64; 2]; 2]) {
        match self {
            Self::Normal => (moduli.plane_strain_modulus(), [[4.0, 0.0], [4.0 / 3.0, 4.0 / 3.0]]),
            Self::Tangential => {
                let modulus = 4.0 * moduli.shear_modulus() / (2.0 - moduli.poissons_ratio());
                (modulus, [[8.0 / 3.0, 0.0], [8.0 / 3.0, 8.0 / 3.0]])
            }
        }
    }
}

fn chain_of(
    direction: Direction,
    materials: [Option<&Material>; 2],
) -> Result<Vec<Element>, LawError> {
    let mut chain = Vec::new();
    for material in materials.into_iter().flatten() {
        add_elements(&mut chain, direction, material)?;
    }
    if chain.is_empty() { Err(LawError::TwoWalls) } else { Ok(chain) }
}

fn add_elements(
    chain: &mut Vec<Element>,
    direction: Direction,
    material: &Material,
) -> Result<(), LawError> {
    let moduli = material.instantaneous();
    let (whole, parts) = direction.moduli(moduli);
    let Some(series) = material.relaxation() else {
        chain.push(Element { equilibrium: whole, terms: Vec::new() });
        return Ok(());
    };
    let element = |relaxing: f64, constant: f64| -> Result<Element, LawError> {
        let terms = series.terms().iter().filter(|term| term.weight > 0.0).map(|term| {
            let rate = positive("relaxation rate", term.relaxation_time.recip())?;
            Ok(Pole { at: rate, weight: relaxing * term.weight })
        });
        Ok(Element {
            equilibrium: constant + relaxing * series.equilibrium_weight(),
            terms: terms.collect::<Result<_, LawError>>()?,
        })
    };
    match series.acts_on() {
        ActsOn::All => chain.push(element(whole, 0.0)?),
        ActsOn::Shear => {
            let (bulk, shear) = (moduli.bulk_modulus(), moduli.shear_modulus());
            for [of_shear, of_bulk] in parts {
                chain.push(element(of_shear * shear, of_bulk * 3.0 * bulk)?);
            }
        }
    }
    Ok(())
}
