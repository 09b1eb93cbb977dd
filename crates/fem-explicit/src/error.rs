//! What can be wrong with a model.

use fem_collision::ApproachError;
use fem_contact::ContactError;
use thiserror::Error;

/// Why no model can be built.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ModelError {
    /// The surfaces make no contact.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// The bodies do not meet in their own frame.
    #[error(transparent)]
    Approach(#[from] ApproachError),
    /// A setting lies outside of its range.
    #[error("{name} is {value}; allowed is {allowed}")]
    Setting {
        /// Which setting.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// The bodies are so stiff, light or small, or so soft, heavy or large, that none is a number.
    #[error(
        "explicit elements would need a time step of {time_step} s, which is none: a wave passes the \
         smallest of them in a time beyond the range of numbers"
    )]
    NoStep {
        /// What it would be, s.
        time_step: f64,
    },
    /// Surface nodes without mass need an inside that has it.
    #[error(
        "all corners of element {element} lie in the surface that can be in contact, which has no \
         mass with contact.method = \"massless\"; a mesh of more layers, or \
         contact.method = \"penalty\""
    )]
    NoInterior {
        /// Its number in the mesh.
        element: usize,
    },
    /// The matrix of a boundary without mass is not positive.
    #[error(
        "the boundary without mass of contact.method = \"massless\" cannot be in balance: an \
         element at the contact has no stiffness; contact.method = \"penalty\" needs none"
    )]
    NoBalance,
    /// A rigid body is to be computed at finite strain.
    #[error("a rigid body does not deform: it has no finite strain")]
    StrainOfRigid,
    /// A material relaxes by more terms than elements at finite strain keep.
    #[error(
        "the material relaxes by {n_terms} terms; at finite strain it may have {most}: fold those of \
         times far from the impact's"
    )]
    TooManyTerms {
        /// How many it has.
        n_terms: usize,
        /// How many it may have.
        most: usize,
    },
    /// A wall keeps its velocity, whatever acts on it.
    #[error("a force acts on the nodes of a wall, which keeps its velocity")]
    ForceOnWall,
    /// A run is to go on from the memory of another, or from one whose parts contradict each other.
    #[error(
        "the memory is of a run of another model or version: its meshes, masses, materials, forces, \
         contact, approach or time step differ; or its parts contradict each other"
    )]
    ForeignRestartState,
}
