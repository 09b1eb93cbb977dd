//! The rejection of a scene that a model cannot compute: the key that causes it, what was found, and what is allowed.

use fem_case::{Case, CaseError, Scene};

/// A fault of a scene that a model finds. It names a key, whose place the case knows.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{key}: {message}")]
pub struct Rejection {
    /// Dotted key (`mesh.contact_element_size`); the nearest table around it if the case lacks it.
    pub key: String,
    /// The fault that was found.
    pub message: String,
    /// The allowed values, or the change to make.
    pub help: Option<String>,
}

impl Rejection {
    /// Returns a rejection that names a key.
    pub fn new(key: impl Into<String>, message: impl Into<String>) -> Self {
        Self { key: key.into(), message: message.into(), help: None }
    }

    /// Returns the rejection of a scene with another model than that of a method.
    pub(crate) fn chose_another(scene: &Scene, method: &str) -> Self {
        let message = format!("model `{}` is not `{method}`", scene.model().name());
        Self::new(scene.model().path(), message)
    }

    /// Adds the allowed values, or the change to make.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Returns the rejection as an error of the scene's case, with its place.
    pub fn in_case(self, case: &Case) -> CaseError {
        let error = case.error_at(&self.key, self.message);
        match self.help {
            Some(help) => error.with_help(help),
            None => error,
        }
    }
}
