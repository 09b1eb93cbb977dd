//! Who looks on while the members of a sweep run.

use fem_case::CaseError;
use fem_collision::Monitor;

use fem_simulation::ComputedCollision;

/// Looks on from the threads that run the members, several of them at a time.
///
/// Who wants all of them to end says so to each: `admits` leaves out those that have not begun,
/// [`Monitor::report`] interrupts those that have.
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
    /// Looks on one member from its beginning to its end.
    type Watch: Monitor;

    /// Whether the member whose turn it is shall run.
    fn admits(&self, _index: usize) -> bool {
        true
    }

    /// A member begins: its case is read next and its model made.
    fn begin(&self, index: usize) -> Self::Watch;

    /// A member has ended, its collision perhaps interrupted; or it is no valid case, or was refused.
    fn end(
        &self,
        _index: usize,
        _watch: Self::Watch,
        _ran: Result<&ComputedCollision, &CaseError>,
    ) {
    }
}

/// Nobody looks on.
impl Observer for () {
    type Watch = ();

    fn begin(&self, _: usize) {}
}
