//! The traits by which a step calls the stress of a body: [`Stress`], [`SmallStrainStress`] and [`FiniteStrainStress`].
//!
//! No method has a default, so every stress implements all of them, also the one that is made of others
//! ([`PartlyFinite`](super::partly_finite)).

use fem_element::{ElementMatrix, QuadGeometry};

use crate::part::{Accounts, Field, Motion, NodalField, Part};

/// An element whose deformation its stress cannot follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collapse {
    /// Number of the element.
    pub element: usize,
    /// Its volume over that of the undeformed element.
    pub volume_ratio: f64,
}

/// An element whose law has lost ellipticity: its material no longer bears every wave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct UnstableElement {
    /// Number of the element.
    pub element: usize,
    /// Its principal stretches: two in the meridian plane, the larger first, then that of the hoop.
    pub stretches: [f64; 3],
    /// Name of the law.
    pub law: &'static str,
}

/// An undeformed element with its lumped masses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LumpedElement {
    pub geometry: QuadGeometry,
    /// Lumped masses of its corners, kg.
    pub masses: [f64; 4],
    /// Corners on the axis, which move along y alone.
    pub on_axis: [bool; 4],
}

/// A stress by the strain that it is computed from. Whether a body is at finite strain is asked here and nowhere else.
pub(crate) enum StrainMeasure<'a> {
    /// All elements are at small strain; the stiffness is constant.
    Small(&'a dyn SmallStrainStress),
    /// Elements are at finite strain, all or some; the stiffness changes with the deformation.
    Finite(&'a dyn FiniteStrainStress),
}

impl<'a> StrainMeasure<'a> {
    /// Returns the stress if it is at finite strain.
    pub fn finite(self) -> Option<&'a dyn FiniteStrainStress> {
        match self {
            Self::Small(_) => None,
            Self::Finite(stress) => Some(stress),
        }
    }
}

/// The stress of a body: internal forces, stored and dissipated energy, and a bound of its stiffness.
///
/// Its history consists of fields of its elements, one pair per element, followed by fields of the nodes.
pub(crate) trait Stress: Part {
    /// Returns this stress by its strain measure.
    fn strain_measure(&self) -> StrainMeasure<'_>;

    /// Returns the number of fields of history of the elements.
    fn n_element_history(&self) -> usize;

    /// Returns, for each element, the largest eigenvalue of its undeformed stiffness against its lumped masses, s⁻², or
    /// a bound of it.
    fn largest_eigenvalues(&self, elements: &[LumpedElement]) -> Vec<f64>;

    /// Sets the history of a body that is displaced (m) as a whole.
    fn start_rigid(&self, displacement: &Field, history: &mut [NodalField]);

    /// Sets the history of a body that has been deformed instantaneously: nothing has relaxed.
    fn start_deformed(&self, displacement: &Field, history: &mut [NodalField]);

    /// Subtracts the internal forces (N) from `forces`. The history has been advanced to the motion.
    ///
    /// # Errors
    /// An element has collapsed; then the forces have no meaning.
    fn subtract_forces(
        &self,
        motion: &Motion<'_>,
        history: &[NodalField],
        forces: &mut Field,
    ) -> Result<(), Collapse>;

    /// Advances the history over a step with this motion.
    fn advance(&self, motion: &Motion<'_>, history: &mut [NodalField]);

    /// Adds the energy that the body stores and the power that it dissipates.
    fn add_energies(&self, motion: &Motion<'_>, history: &[NodalField], accounts: &mut Accounts);
}

/// A stress at small strain: it is linear in the motion, which a boundary without mass relies on.
pub(crate) trait SmallStrainStress: Stress {
    /// Returns the stiffness (N/m) of an element against a further displacement at the end of a step, once the time
    /// step is known.
    fn stiffness_of_step(&self, geometry: &QuadGeometry) -> ElementMatrix;

    /// Adds the further displacement (m) of a node to the history, which has been advanced to the end of the step.
    fn shift(&self, node: usize, change: [f64; 2], history: &mut [NodalField]);

    /// Returns which field of its history is the effective displacement, if the stress follows from another
    /// displacement than that of the body.
    fn effective(&self) -> Option<usize>;
}

/// A stress at finite strain: time step control and diagnostics follow its changing stiffness.
pub(crate) trait FiniteStrainStress: Stress {
    /// Returns the number of elements at finite strain.
    fn n_elements(&self) -> usize;

    /// Adds a bound of the stiffness at each node (N/m) of the undeformed body.
    fn add_undeformed_stiffness_bound(&self, bound: &mut [f64]);

    /// Adds a bound of the stiffness at each node (N/m) of the deformed body.
    fn add_stiffness_bound(&self, motion: &Motion<'_>, history: &[NodalField], bound: &mut [f64]);

    /// Returns the largest strain rate of any element, relative to its present deformation, 1/s.
    fn strain_rate(&self, motion: &Motion<'_>) -> f64;

    /// Returns the largest ratio of an element's strain rate to its strain allowance, which is the least of those at
    /// its corners, 1/s.
    fn allowance_rate(&self, motion: &Motion<'_>, allowances: &[f64]) -> f64;

    /// Returns the element that is compressed most.
    fn most_compressed(&self, displacement: &Field) -> Collapse;

    /// Returns whether the law can lose ellipticity, so that unstable elements have to be searched for.
    fn can_lose_stability(&self) -> bool;

    /// Returns the least stable element, if it is unstable.
    fn unstable_element(
        &self,
        displacement: &Field,
        history: &[NodalField],
    ) -> Option<UnstableElement>;

    /// Overwrites `stress` with the Cauchy stress (σ_rr, σ_yy, σ_θθ, σ_ry) of each element, tension positive, Pa.
    fn update_cauchy_stress(
        &self,
        displacement: &Field,
        history: &[NodalField],
        stress: &mut Vec<[f64; 4]>,
    );

    /// Overwrites `plastic` with the equivalent plastic strain and the plastic work per undeformed volume (J/m³) of each
    /// element; it is empty for a stress without flow.
    fn update_plastic(&self, history: &[NodalField], plastic: &mut Vec<[f64; 2]>);
}
