//! Settings of the condensation and the dissipation of a pair.

use crate::error::CondensedError;
use crate::operators::slip::Slip;
use fem_material::PronySeries;

/// The method that limits overlap of the surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactModel {
    /// Surfaces do not overlap at the nodes.
    Exact,
    /// Penalty springs at Gauss points, as in the explicit model. The value is stiffness per area times element size,
    /// Pa.
    Springs(f64),
}

/// Settings of the condensation of a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairSettings {
    /// Radius out to which the surfaces are condensed, m; see also [`crate::CondensedPair::enlarge`].
    pub candidate_radius: f64,
    /// Method that limits overlap.
    pub contact: ContactModel,
    /// Smallest number of blocks of the basis for a relaxing shear modulus with an elastic bulk modulus; the default
    /// is 2. A modulus that falls to nearly zero gets more.
    pub shear_blocks: usize,
    /// Number of modes of free vibration of each sphere; 0 is quasi-static.
    pub vibration_modes: usize,
    /// Bodies whose mass centres are held fixed, lower first.
    pub held: [bool; 2],
    /// Slip between the surfaces of unlike bodies, if included.
    pub slip: Option<Slip>,
    /// Whether factors are kept. Fields, a relaxing shear modulus with an elastic bulk modulus, and vibration modes
    /// need them; otherwise they are computed again on request.
    pub keeps_factors: bool,
}

impl PairSettings {
    /// Creates settings with exact contact, two blocks, no vibration, no held body, no slip, and kept factors.
    pub fn new(candidate_radius: f64) -> Self {
        Self {
            candidate_radius,
            contact: ContactModel::Exact,
            shear_blocks: 2,
            vibration_modes: 0,
            held: [false; 2],
            slip: None,
            keeps_factors: true,
        }
    }
}

/// Dissipation in both bodies, the lower one first. A pair of relaxations converts to it:
///
/// ```
/// use fem_condensed::Damping;
///
/// // The lower body is large and radiates with γ = C/(μ c_s), s m/N.
/// let waves = Damping { radiation: [Some(2.4e-15), None], ..Damping::default() };
/// assert_eq!(Damping::from([None, None]), Damping { radiation: [None, None], ..waves });
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Damping<'a> {
    /// Relaxation of each body; `None` is elastic.
    pub relaxations: [Option<&'a PronySeries>; 2],
    /// Radiation coefficient γ = C(ν)/(μ c_s) of each body whose waves do not return within the contact, s m/N;
    /// `None` for other bodies. The radiated power is γ Ḟ².
    pub radiation: [Option<f64>; 2],
    /// Mobility β of a plate that bends, m/(N s), if one of the bodies is such a plate; the body itself is a half-space.
    pub plate_mobility: Option<f64>,
}

impl<'a> From<[Option<&'a PronySeries>; 2]> for Damping<'a> {
    fn from(relaxations: [Option<&'a PronySeries>; 2]) -> Self {
        Self { relaxations, ..Self::default() }
    }
}

impl Damping<'_> {
    pub(crate) fn check(&self) -> Result<(), CondensedError> {
        let radiation = self.radiation.into_iter().flatten();
        let radiation =
            radiation.map(|value| ("radiation of a body", value, "at least 0 s m/N, and finite"));
        let plate = self
            .plate_mobility
            .map(|value| ("mobility of a plate", value, "at least 0 m/(N s), and finite"));
        let is_wrong = |(_, value, _): &(_, f64, _)| !(*value >= 0.0 && value.is_finite());
        match radiation.chain(plate).find(is_wrong) {
            Some((name, value, allowed)) => Err(CondensedError::Setting { name, value, allowed }),
            None => Ok(()),
        }
    }
}
