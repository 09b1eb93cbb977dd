//! The runs that claims share.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use fem::SharedModels;

use crate::error::StudyError;
use crate::run::{ExplicitRun, Run};

/// A run that is there, is being made, or failed.
pub(crate) type Slot<T> = Arc<OnceLock<Result<Arc<T>, StudyError>>>;

/// Runs keyed by their resolved case.
#[derive(Debug)]
pub(crate) struct Slots<T>(Mutex<HashMap<String, Slot<T>>>);

impl<T> Slots<T> {
    /// Returns the slot of a resolved case.
    pub fn slot(&self, key: String) -> Slot<T> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).entry(key).or_default().clone()
    }
}

impl<T> Default for Slots<T> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

/// The runs that claims share: a case is run once.
#[derive(Debug, Default)]
pub struct Shelf {
    /// Runs of the explicit model.
    pub(crate) explicit: Slots<ExplicitRun>,
    /// Runs of all other models.
    pub(crate) others: Slots<Run>,
    /// Data shared by runs at several speeds or relaxations.
    pub(crate) shared: SharedModels,
}
