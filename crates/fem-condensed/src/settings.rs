//! Settings of the condensation and the dissipation of a pair.

use crate::error::CondensedError;
use crate::operators::slip::Slip;
use fem_material::PronySeries;

/// How the surfaces resist overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactModel {
    /// They do not overlap at the nodes.
    Exact,
    /// Penalty springs at Gauss points, those of the explicit model: stiffness per area times
    /// element size, Pa.
    Springs(f64),
}

/// Settings of the condensation of a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairSettings {
    /// Radius out to which the surfaces are condensed, m; [`crate::CondensedPair::enlarge`] makes more.
    pub candidate_radius: f64,
    /// How overlap is prevented.
    pub contact: ContactModel,
    /// Least blocks of the basis for a relaxing shear beside an elastic bulk modulus; 2 is the
    /// default. A modulus that falls to nearly nothing gets more.
    pub shear_blocks: usize,
    /// Modes of free vibration of each sphere; 0 is quasi-static.
    pub vibration_modes: usize,
    /// Bodies whose mass centres do not move, whatever strikes them; lower first.
    pub held: [bool; 2],
    /// How the surfaces of unlike bodies slip on each other; facing points move alike without.
    pub slip: Option<Slip>,
    /// Whether factors are kept for fields, for a modulus that relaxes beside an elastic one, and for modes;
    /// without, they are made where these are asked for.
    pub keeps_factors: bool,
}

impl PairSettings {
    /// Exact contact, two blocks, no vibration, no body held, no slip, factors kept.
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

/// Dissipation in both bodies, the lower one first. Relaxations alone stand for it:
///
/// ```
/// use fem_condensed::Damping;
///
/// // The lower body is large: it radiates γ = C/(μ c_s), s m/N.
/// let waves = Damping { radiation: [Some(2.4e-15), None], ..Damping::default() };
/// assert_eq!(Damping::from([None, None]), Damping { radiation: [None, None], ..waves });
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Damping<'a> {
    /// Relaxation of each body; `None` is elastic.
    pub relaxations: [Option<&'a PronySeries>; 2],
    /// γ = C(ν)/(μ c_s) of each body that sends waves out which do not come back within the contact, s
    /// m/N; `None` of one that does not. It radiates γ Ḟ².
    pub radiation: [Option<f64>; 2],
}

impl<'a> From<[Option<&'a PronySeries>; 2]> for Damping<'a> {
    fn from(relaxations: [Option<&'a PronySeries>; 2]) -> Self {
        Self { relaxations, ..Self::default() }
    }
}

impl Damping<'_> {
    /// # Errors
    /// A radiation that is negative or not finite.
    pub(crate) fn check(&self) -> Result<(), CondensedError> {
        let is_wrong = |value: &f64| !(*value >= 0.0 && value.is_finite());
        match self.radiation.into_iter().flatten().find(is_wrong) {
            Some(value) => {
                let (name, allowed) = ("radiation of a body", "at least 0 s m/N, and finite");
                Err(CondensedError::Setting { name, value, allowed })
            }
            None => Ok(()),
        }
    }
}
