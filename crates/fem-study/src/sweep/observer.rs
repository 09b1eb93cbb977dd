//! The observer of the members of a sweep while they run.

use fem_case::CaseError;
use fem_collision::Monitor;

use fem_simulation::ComputedCollision;

/// Observes the members of a sweep, from several threads at the same time.
///
/// To end a sweep, `admits` leaves out the members that have not begun, and [`Monitor::report`] interrupts those that
/// have.
///
/// ```
/// use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
///
/// use fem_simulation::ComputedCollision;
/// use fem_study::sweep::Observer;
/// use fem_case::CaseError;
/// use fem_collision::{Monitor, Progress};
///
/// /// Counts members, and ends all when a button is pressed.
/// #[derive(Default)]
/// struct Panel {
///     n_done: AtomicUsize,
///     is_pressed: AtomicBool,
/// }
///
/// impl<'a> Observer for &'a Panel {
///     type Watch = Member<'a>;
///
///     fn admits(&self, _: usize) -> bool {
///         !self.is_pressed.load(Relaxed)
///     }
///
///     fn begin(&self, _: usize) -> Member<'a> {
///         Member(self)
///     }
///
///     fn end(&self, _: usize, _: Member<'a>, _: Result<&ComputedCollision, &CaseError>) {
///         self.n_done.fetch_add(1, Relaxed);
///     }
/// }
///
/// struct Member<'a>(&'a Panel);
///
/// impl Monitor for Member<'_> {
///     fn report(&mut self, _: Progress) -> bool {
///         !self.0.is_pressed.load(Relaxed)
///     }
/// }
/// ```
pub trait Observer: Sync {
    /// Observes one member from its beginning to its end.
    type Watch: Monitor;

    /// Whether the next member shall run.
    fn admits(&self, _index: usize) -> bool {
        true
    }

    /// Is called when a member begins, before its case is read.
    fn begin(&self, index: usize) -> Self::Watch;

    /// Is called when a member has ended. Its collision may be interrupted, or the case may be invalid or rejected.
    fn end(
        &self,
        _index: usize,
        _watch: Self::Watch,
        _ran: Result<&ComputedCollision, &CaseError>,
    ) {
    }
}

/// No observer.
impl Observer for () {
    type Watch = ();

    fn begin(&self, _: usize) {}
}
