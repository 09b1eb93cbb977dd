//! Cache of condensed pairs that several cases share, so that a sweep over speeds or relaxations factors once.
//!
//! The key of a pair is its source, so no mesh is built to find it. The result of a case does not depend on the cases
//! before it: a pair that had to be enlarged is not put back.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use fem_condensed::{CondensedPair, PairSettings};

use crate::plan::body_source::BodySource;

/// Most bytes of all pairs of a cache.
const MAX_BYTES: usize = 1_000_000_000;
/// Numbers per equation that are neither factor nor field: mesh, indices and values of the stiffness.
const NUMBERS_PER_EQUATION: usize = 32;

/// The source of a pair. Equal sources give equal pairs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PairKey {
    /// Lower and upper body, without relaxation.
    pub bodies: [BodySource; 2],
    /// Settings of the condensation.
    pub settings: PairSettings,
}

/// The pairs that were used last, as many as fit into the memory, and always the last one.
#[derive(Debug)]
pub struct PairCache {
    max_bytes: usize,
    /// The entry that was used last is at the end.
    entries: Mutex<Vec<Arc<Entry>>>,
    n_made: AtomicUsize,
}

/// A pair, or the place of a pair that one thread makes while others wait for it.
#[derive(Debug)]
struct Entry {
    key: PairKey,
    pair: Mutex<Option<Arc<CondensedPair>>>,
    /// 0 until it is made.
    bytes: AtomicUsize,
}

impl Default for PairCache {
    fn default() -> Self {
        Self::with_max_bytes(MAX_BYTES)
    }
}

impl PairCache {
    /// Returns an empty cache with this limit of memory in bytes.
    pub fn with_max_bytes(max_bytes: usize) -> Self {
        Self { max_bytes, entries: Mutex::default(), n_made: AtomicUsize::new(0) }
    }

    /// Returns the number of factored pairs.
    pub fn n_made(&self) -> usize {
        self.n_made.load(Ordering::Relaxed)
    }

    /// Returns the number of kept pairs.
    pub fn n_kept(&self) -> usize {
        lock(&self.entries).len()
    }

    /// Returns the kept pair of this key, or makes it by `make`.
    pub(crate) fn pair<E>(
        &self,
        key: PairKey,
        make: impl FnOnce(&PairKey) -> Result<CondensedPair, E>,
    ) -> Result<Arc<CondensedPair>, E> {
        let entry = self.entry(key);
        let mut place = lock(&entry.pair);
        if let Some(pair) = &*place {
            return Ok(pair.clone());
        }
        let pair = match make(&entry.key) {
            Ok(pair) => Arc::new(pair),
            Err(error) => {
                lock(&self.entries).retain(|other| !Arc::ptr_eq(other, &entry));
                return Err(error);
            }
        };
        self.n_made.fetch_add(1, Ordering::Relaxed);
        entry.bytes.store(bytes(&pair), Ordering::Relaxed);
        *place = Some(pair.clone());
        drop(place);
        self.trim();
        Ok(pair)
    }

    /// Returns the entry of this key, and moves it to the end.
    fn entry(&self, key: PairKey) -> Arc<Entry> {
        let mut entries = lock(&self.entries);
        let entry = match entries.iter().position(|entry| entry.key == key) {
            Some(index) => entries.remove(index),
            None => {
                let (pair, bytes) = (Mutex::new(None), AtomicUsize::new(0));
                Arc::new(Entry { key, pair, bytes })
            }
        };
        entries.push(entry.clone());
        entry
    }

    /// Drops the pairs that were not used for longest. Their users keep them.
    fn trim(&self) {
        let mut entries = lock(&self.entries);
        let bytes = |entry: &Arc<Entry>| entry.bytes.load(Ordering::Relaxed);
        let mut total: usize = entries.iter().map(bytes).sum();
        while total > self.max_bytes {
            let older = &entries[..entries.len().saturating_sub(1)];
            let Some(oldest) = older.iter().position(|entry| bytes(entry) > 0) else { break };
            total -= bytes(&entries.remove(oldest));
        }
    }
}

/// Locks a mutex; a thread that panicked left the data valid.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Estimates the bytes of a pair, with the blocks of a relaxing shear modulus that are made later.
fn bytes(pair: &CondensedPair) -> usize {
    let settings = pair.settings();
    let n_fields = settings.shear_blocks * pair.n_points() + settings.vibration_modes;
    pair.factor_bytes() + 8 * pair.n_equations() * (n_fields + NUMBERS_PER_EQUATION)
}
