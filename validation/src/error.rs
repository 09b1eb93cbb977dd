//! What can go wrong with claims.

use std::path::PathBuf;

use fem_case::CaseError;
use fem_collision::{ApproachError, Stop};
use fem_explicit::ModelError;
use fem_laws::LawError;
use fem_material::MaterialError;
use fem_mesh::MeshError;

/// A folder of claims that cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum ClaimError {
    /// A file or folder cannot be read.
    #[error("{}: {error}", path.display())]
    Unreadable {
        /// Which folder or file.
        path: PathBuf,
        /// Why it cannot be read.
        error: std::io::Error,
    },
    /// A claim file says something that it cannot.
    #[error("{}:{line}:{column}: {message}", path.display())]
    Invalid {
        /// Which file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What is wrong.
        message: String,
    },
    /// A case of a claim that cannot be read.
    #[error("{0}")]
    Case(#[from] CaseError),
    /// No such claim.
    #[error("there is no claim `{name}`; the claims are {known}")]
    Unknown {
        /// The name that was asked for.
        name: String,
        /// All, with commas.
        known: String,
    },
}

/// A study that could not measure what it is for.
#[derive(Debug, Clone, thiserror::Error)]
pub enum StudyError {
    /// A case that cannot be read or prepared.
    #[error("{0}")]
    Case(#[from] CaseError),
    /// A run that did not end by itself.
    #[error("{title}: {stop}")]
    Stopped {
        /// Title of the case.
        title: String,
        /// Why it ended.
        stop: Stop,
    },
    /// The user wants to stop.
    #[error("interrupted")]
    Interrupted,
    /// A closed form or law that refuses the numbers.
    #[error("{0}")]
    Law(#[from] LawError),
    /// A mesh that cannot be made.
    #[error("{0}")]
    Mesh(#[from] MeshError),
    /// A material that cannot be.
    #[error("{0}")]
    Material(#[from] MaterialError),
    /// Bodies that do not meet.
    #[error("{0}")]
    Approach(#[from] ApproachError),
    /// A model that cannot be made.
    #[error("{0}")]
    Model(#[from] ModelError),
    /// Parameters of the study that do not fit it.
    #[error("{0}")]
    Parameters(String),
}

impl StudyError {
    /// Something about the parameters.
    pub fn parameters(message: impl Into<String>) -> Self {
        Self::Parameters(message.into())
    }
}
