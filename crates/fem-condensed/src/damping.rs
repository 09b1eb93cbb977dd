//! What takes energy from the bodies of a collision.

use fem_material::PronySeries;

use crate::error::CondensedError;

/// What takes energy from both bodies, lower first. Relaxations alone stand for it:
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
