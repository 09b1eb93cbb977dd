//! Why a model cannot compute a scene: which key is to blame, what was found, what is allowed.

use fem_case::{Case, CaseError, Scene};

/// A fault of a scene that a model finds. It names a key; the case knows where that stands.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{key}: {message}")]
pub struct Rejection {
    /// Dotted key (`mesh.contact_element_size`); the nearest table around it if the case lacks it.
    pub key: String,
    /// What was found.
    pub message: String,
    /// What is allowed, or what to do.
    pub help: Option<String>,
}

impl Rejection {
    /// A refusal that blames a key.
    pub fn new(key: impl Into<String>, message: impl Into<String>) -> Self {
        Self { key: key.into(), message: message.into(), help: None }
    }

    /// A scene that chose another model than that of a method.
    pub(crate) fn chose_another(scene: &Scene, method: &str) -> Self {
        let message = format!("model `{}` is not `{method}`", scene.model().name());
        Self::new(scene.model().path(), message)
    }

    /// Adds what is allowed, or what to do.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// This refusal as an error of the case that the scene is from, with its place.
    pub fn in_case(self, case: &Case) -> CaseError {
        let error = case.error_at(&self.key, self.message);
        match self.help {
            Some(help) => error.with_help(help),
            None => error,
        }
    }
}
