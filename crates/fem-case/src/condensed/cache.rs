//! Condensed pairs that several cases share: a sweep over speeds or relaxations factors once.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex};

use fem_condensed::{BodyInput, CondensedError, CondensedPair, PairSettings};

/// Pairs that are kept at most.
const CAPACITY: usize = 4;

/// The pairs used last. A pair that had to be enlarged is not put back: what a case gives does not
/// depend on the cases before it.
#[derive(Debug, Default)]
pub struct PairCache {
    pairs: Mutex<VecDeque<Arc<CondensedPair>>>,
}

impl PairCache {
    /// The pair of these bodies, condensed with these settings: a kept one, or a new one.
    ///
    /// # Errors
    /// As [`CondensedPair::new`].
    pub fn pair(
        &self,
        inputs: [BodyInput; 2],
        settings: PairSettings,
    ) -> Result<Arc<CondensedPair>, CondensedError> {
        let is_same =
            |pair: &Arc<CondensedPair>| *pair.settings() == settings && *pair.inputs() == inputs;
        // A thread that panicked left the list whole.
        let list = || self.pairs.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        if let Some(pair) = list().iter().find(|pair| is_same(pair)) {
            return Ok(pair.clone());
        }
        let pair = Arc::new(CondensedPair::new(inputs, settings)?);
        let mut pairs = list();
        if pairs.len() == CAPACITY {
            pairs.pop_front();
        }
        pairs.push_back(pair.clone());
        Ok(pair)
    }
}
