//! Limits of memory and time per input: the allocator counts the memory and a watchdog checks the time. An input that
//! exceeds a limit ends the process, which prints its number.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::io::Write;
use std::sync::atomic::{AtomicI64, AtomicU64, Ordering::Relaxed};
use std::time::{Duration, Instant};

/// Allocated bytes of the whole process.
static LIVE: AtomicI64 = AtomicI64::new(0);
static MOST: AtomicI64 = AtomicI64::new(i64::MAX);

thread_local! {
    /// Number of the input of this thread.
    static CURRENT: Cell<u64> = const { Cell::new(u64::MAX) };
}

/// The system's allocator with a limit.
pub struct Counting;

fn count(size: usize) {
    let live = LIVE.fetch_add(size as i64, Relaxed) + size as i64;
    if live > MOST.load(Relaxed) {
        // Printing needs memory beyond the limit.
        MOST.store(i64::MAX, Relaxed);
        let input = CURRENT.try_with(Cell::get).unwrap_or(u64::MAX);
        let _ = writeln!(std::io::stderr(), "input {input}: {live} bytes, the last {size}");
        std::process::abort();
    }
}

// SAFETY: all calls are passed on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size());
        // SAFETY: same arguments.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count(layout.size());
        // SAFETY: same arguments.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(size);
        LIVE.fetch_sub(layout.size() as i64, Relaxed);
        // SAFETY: same arguments.
        unsafe { System.realloc(pointer, layout, size) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        LIVE.fetch_sub(layout.size() as i64, Relaxed);
        // SAFETY: same arguments.
        unsafe { System.dealloc(pointer, layout) }
    }
}

/// Allows the process this many bytes in addition to those that it has now.
pub fn limit_memory(bytes: i64) {
    MOST.store(LIVE.load(Relaxed) + bytes, Relaxed);
}

/// The current input of a thread and its start, ms after `began`.
#[derive(Default)]
pub struct CurrentInput {
    since: AtomicU64,
    input: AtomicU64,
}

impl CurrentInput {
    /// Starts an input.
    pub fn begin(&self, began: Instant, input: u64) {
        CURRENT.with(|current| current.set(input));
        self.input.store(input, Relaxed);
        self.since.store(began.elapsed().as_millis() as u64 + 1, Relaxed);
    }

    /// Ends the input and returns its duration.
    pub fn end(&self, began: Instant) -> Duration {
        let since = self.since.swap(0, Relaxed);
        Duration::from_millis((began.elapsed().as_millis() as u64 + 1).saturating_sub(since))
    }

    /// Returns the input if it has taken longer than this.
    pub fn overdue(&self, began: Instant, longest: Duration) -> Option<u64> {
        let since = self.since.load(Relaxed);
        let now = began.elapsed().as_millis() as u64 + 1;
        let is_overdue = since > 0 && now.saturating_sub(since) > longest.as_millis() as u64;
        is_overdue.then(|| self.input.load(Relaxed))
    }
}
