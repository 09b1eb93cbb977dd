//! What the step asks of a body's stress.

use fem_element::{ElementMatrix, QuadGeometry};

use crate::part::{Accounts, Field, Motion, NodalField, Part};

/// An element that a stress cannot follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collapse {
    /// Number of the element.
    pub element: usize,
    /// Its volume over that of the undeformed element.
    pub volume_ratio: f64,
}

/// An element whose material does not bear every wave any more: its law has lost ellipticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unstable {
    /// Number of the element.
    pub element: usize,
    /// Its principal stretches: two of the meridian plane, the larger first, then that of the hoop.
    pub stretches: [f64; 3],
    /// Name of the law.
    pub law: &'static str,
}

/// An element with its masses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LumpedElement {
    /// Of the undeformed element.
    pub geometry: QuadGeometry,
    /// Lumped masses of its corners, kg.
    pub masses: [f64; 4],
    /// Corners that are free along y alone.
    pub on_axis: [bool; 4],
}

/// The stress of a body: internal forces, what it stores and dissipates, and how stiff it is.
///
/// The place of effects that depend on strain and its past: another material law, finite strain.
///
/// Its history are fields of its elements, one pair an element, and behind them those of the nodes.
pub trait Stress: Part {
    /// Number of fields of history of the elements.
    fn n_element_history(&self) -> usize {
        0
    }

    /// Number of elements at finite strain.
    fn n_finite_elements(&self) -> usize {
        0
    }

    /// Largest eigenvalue (s⁻²) of an element's stiffness against its lumped masses (kg), its
    /// corners `on_axis` free along y alone; or a bound of it.
    fn largest_eigenvalue(
        &self,
        geometry: &QuadGeometry,
        masses: &[f64; 4],
        on_axis: [bool; 4],
    ) -> f64;

    /// Those of several elements.
    fn largest_eigenvalues(&self, elements: &[LumpedElement]) -> Vec<f64> {
        let of = |element: &LumpedElement| {
            self.largest_eigenvalue(&element.geometry, &element.masses, element.on_axis)
        };
        elements.iter().map(of).collect()
    }

    /// History of a body that is displaced (m) as a whole.
    fn start_rigid(&self, _displacement: &Field, _history: &mut [NodalField]) {}

    /// History of a body that has been deformed in no time: nothing of it has relaxed.
    fn start_deformed(&self, _displacement: &Field, _history: &mut [NodalField]) {}

    /// Subtracts the internal forces (N) from `forces`: of a motion to which the history has been taken,
    /// which may hold them.
    ///
    /// # Errors
    /// An element has collapsed; then the forces mean nothing.
    fn subtract_forces(
        &self,
        motion: &Motion<'_>,
        history: &[NodalField],
        forces: &mut Field,
    ) -> Result<(), Collapse>;

    /// Whether its stiffness changes as the body deforms; then the time step may follow.
    fn changes_stiffness(&self) -> bool {
        false
    }

    /// Whether its law can lose ellipticity: then it is looked for.
    fn can_lose_stability(&self) -> bool {
        false
    }

    /// The element that is least stable, if it is not stable.
    fn unstable_element(&self, _displacement: &Field, _: &[NodalField]) -> Option<Unstable> {
        None
    }

    /// Adds a bound of its stiffness at each node (N/m) of the undeformed body, where it changes.
    fn add_undeformed_stiffness_bound(&self, _bound: &mut [f64]) {}

    /// The same of the deformed body.
    fn add_stiffness_bound(&self, _: &Motion<'_>, _: &[NodalField], _bound: &mut [f64]) {}

    /// Largest rate (1/s) at which an element is strained, seen from how it is deformed, where that changes
    /// its stiffness.
    fn strain_rate(&self, _: &Motion<'_>) -> f64 {
        0.0
    }

    /// The same over the strain that an element may take before its nodes ask for a shorter step, the least of
    /// its corners', where that changes its stiffness, 1/s.
    fn urgency(&self, _: &Motion<'_>, _room: &[f64]) -> f64 {
        0.0
    }

    /// The element that is compressed most, where an element can collapse.
    fn most_compressed(&self, _displacement: &Field) -> Option<Collapse> {
        None
    }

    /// Cauchy stress (σ_rr, σ_yy, σ_θθ, σ_ry) of each element, tension positive, Pa, in place of what
    /// is there; nothing where it follows from the displacement or the effective displacement at small
    /// strain.
    fn update_cauchy_stress(
        &self,
        _displacement: &Field,
        _history: &[NodalField],
        stress: &mut Vec<[f64; 4]>,
    ) {
        stress.clear();
    }

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
