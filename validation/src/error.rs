//! Errors of claims and studies.

use std::path::PathBuf;

use fem_case::CaseError;
use fem_collision::{ApproachError, Stop};
use fem_explicit::ModelError;
use fem_laws::LawError;
use fem_material::MaterialError;
use fem_mesh::MeshError;

/// Errors of reading claims.
#[derive(Debug, thiserror::Error)]
pub enum ClaimError {
    /// A file or folder cannot be read.
    #[error("{}: {error}", path.display())]
    Unreadable {
        /// Path of the folder or file.
        path: PathBuf,
        /// Error of the file system.
        error: std::io::Error,
    },
    /// A claim file is invalid.
    #[error("{}:{line}:{column}: {message}", path.display())]
    Invalid {
        /// Path of the file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// Description of the error.
        message: String,
    },
    /// A case of a claim cannot be read.
    #[error("{0}")]
    Case(#[from] CaseError),
    /// There is no claim with this name.
    #[error("there is no claim `{name}`; the claims are {known}")]
    Unknown {
        /// The requested name.
        name: String,
        /// Names of all claims, separated by commas.
        known: String,
    },
}

/// Errors of a study.
#[derive(Debug, Clone, thiserror::Error)]
pub enum StudyError {
    /// A case cannot be read or prepared.
    #[error("{0}")]
    Case(#[from] CaseError),
    /// A run was stopped.
    #[error("{title}: {stop}")]
    Stopped {
        /// Title of the case.
        title: String,
        /// Reason of the stop.
        stop: Stop,
    },
    /// The user interrupted the study.
    #[error("interrupted")]
    Interrupted,
    /// A closed form or contact law rejects its parameters.
    #[error("{0}")]
    Law(#[from] LawError),
    /// A mesh cannot be built.
    #[error("{0}")]
    Mesh(#[from] MeshError),
    /// A material is invalid.
    #[error("{0}")]
    Material(#[from] MaterialError),
    /// The bodies do not meet.
    #[error("{0}")]
    Approach(#[from] ApproachError),
    /// A model cannot be built.
    #[error("{0}")]
    Model(#[from] ModelError),
    /// The parameters of the study are invalid.
    #[error("{0}")]
    Parameters(String),
}

impl StudyError {
    /// Returns an error about the parameters of the study.
    pub fn parameters(message: impl Into<String>) -> Self {
        Self::Parameters(message.into())
    }
}
