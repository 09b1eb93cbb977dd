//! Errors of building a model or resuming a run.

use fem_collision::ApproachError;
use fem_contact::ContactError;
use fem_material::engineering::number;
use thiserror::Error;

/// Reasons for which a model cannot be built or a run cannot be resumed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ModelError {
    /// The surfaces make no contact.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// The bodies do not meet in their own frame.
    #[error(transparent)]
    Approach(#[from] ApproachError),
    /// A setting lies outside of its range.
    #[error("{name} is {value}; allowed is {allowed}", value = number(*value, 5))]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Its value, in SI units.
        value: f64,
        /// The allowed range.
        allowed: &'static str,
    },
    /// The time step is not a positive finite number, because a body is extremely stiff, light, small, soft, heavy or
    /// large.
    #[error(
        "explicit elements would need a time step of {time_step} s: the time in which a wave crosses the \
         smallest element is beyond the range of numbers", time_step = number(*time_step, 5))]
    NoStep {
        /// The time step that would follow, s.
        time_step: f64,
    },
    /// All corners of an element are massless surface nodes.
    #[error(
        "all corners of element {element} lie in the surface that can be in contact, which has no \
         mass with contact.method = \"massless\": use a mesh of more layers, or \
         contact.method = \"penalty\""
    )]
    NoInterior {
        /// Number of the element in the mesh.
        element: usize,
    },
    /// The stiffness matrix of a massless boundary is not positive.
    #[error(
        "the boundary without mass of contact.method = \"massless\" cannot be in balance, since an \
         element at the contact has no stiffness: use contact.method = \"penalty\""
    )]
    NoBalance,
    /// A rigid body is to be at finite strain.
    #[error("a rigid body does not deform and cannot be at finite strain")]
    StrainOfRigid,
    /// A material that flows is to be at small strain, or to follow another hyperelastic law than Hencky's.
    #[error("plastic flow is computed at finite strain with the law \"hencky\", found {law:?}")]
    FlowWithoutHencky {
        /// Name of the law, or "none" at small strain.
        law: &'static str,
    },
    /// A material has more relaxation terms than elements at finite strain can keep.
    #[error(
        "the material has {n_terms} relaxation terms, and at finite strain at most {most} are allowed: merge \
         terms whose relaxation times are far from the contact time"
    )]
    TooManyTerms {
        /// Number of terms of the material.
        n_terms: usize,
        /// Largest number of terms.
        most: usize,
    },
    /// Forces act on a wall, which keeps its velocity.
    #[error("a force acts on the nodes of a wall, which keeps its velocity")]
    ForceOnWall,
    /// The restart state belongs to another model or version, or its parts contradict each other.
    #[error(
        "the restart state belongs to a run of another model or version (meshes, masses, materials, forces, \
         contact, approach or time step differ), or its parts contradict each other"
    )]
    ForeignRestartState,
}
