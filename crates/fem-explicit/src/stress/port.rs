//! What the step asks of a body's stress.

use fem_element::{ElementMatrix, QuadGeometry};

use crate::part::{Accounts, Field, Motion, NodalField, Part};

/// The stress of a body: internal forces, what it stores and dissipates, and how stiff it is.
///
/// The place of effects that depend on strain and its past: another material law, finite strain.
pub trait Stress: Part {
    /// Largest eigenvalue (s⁻²) of an element's stiffness against its lumped masses (kg), its
    /// corners `on_axis` free along y alone; or a bound of it.
    fn largest_eigenvalue(
        &self,
        geometry: &QuadGeometry,
        masses: &[f64; 4],
        on_axis: [bool; 4],
    ) -> f64;

    /// History of a body that is displaced (m) as a whole.
    fn start_rigid(&self, _displacement: &Field, _history: &mut [NodalField]) {}

    /// History of a body that has been deformed in no time: nothing of it has relaxed.
    fn start_deformed(&self, _displacement: &Field, _history: &mut [NodalField]) {}

    /// Subtracts the internal forces (N) from `forces`.
    fn subtract_forces(&self, motion: &Motion<'_>, history: &[NodalField], forces: &mut Field);

    /// Takes the history to the end of a step, whose motion is given.
    fn advance(&self, _motion: &Motion<'_>, _history: &mut [NodalField]) {}

    /// Stiffness (N/m) of an element against what a node moves more by the end of a step, the time step
    /// known; `None` of a stress that is no linear function of the motion.
    fn stiffness_of_step(&self, _geometry: &QuadGeometry) -> Option<ElementMatrix> {
        None
    }

    /// A node has moved by so much more (m) in the step that the history has been taken to the end of.
    fn shift(&self, _node: usize, _change: [f64; 2], _history: &mut [NodalField]) {}

    /// Adds what the body stores and dissipates.
    fn add_energies(&self, motion: &Motion<'_>, history: &[NodalField], accounts: &mut Accounts);

    /// Which field of its history is the effective displacement, where relaxing stress is that of
    /// another displacement than the body's.
    fn effective(&self) -> Option<usize> {
        None
    }
}
