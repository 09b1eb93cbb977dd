//! Runs one member, or many in parallel, with an observer.

use std::cmp::Reverse;

use fem_case::CaseError;
use fem_collision::Monitor;
use fem_simulation::{ComputedCollision, SharedModels, Simulation};
use rayon::iter::{ParallelBridge, ParallelIterator};

use super::members::Members;

/// Runs members with shared models.
#[derive(Clone, Copy, Debug)]
pub struct Runner<'a, M: ?Sized> {
    members: &'a M,
    shared: &'a SharedModels,
    has_fields: bool,
}

impl<'a, M: Members + ?Sized> Runner<'a, M> {
    /// Creates a runner whose members share models and factors through `shared`.
    pub fn new(members: &'a M, shared: &'a SharedModels) -> Self {
        Self { members, shared, has_fields: true }
    }

    /// Returns this runner without the fields that the members ask for; all other results keep their bits.
    #[must_use]
    pub fn without_fields(self) -> Self {
        Self { has_fields: false, ..self }
    }

    /// Runs a member on this thread.
    ///
    /// # Errors
    /// The member is no valid case, or its model rejects it.
    pub fn run_one(
        &self,
        index: usize,
        monitor: &mut dyn Monitor,
    ) -> Result<ComputedCollision, CaseError> {
        let make = |case| Simulation::sharing(case, self.shared);
        let mut simulation = self.members.build(index, make)?;
        if !self.has_fields {
            simulation = simulation.without_snapshots();
        }
        Ok(simulation.run_within_tolerance(monitor))
    }

    /// Runs these members, begun in this order, on the threads of the current rayon pool, each
    /// member on one.
    ///
    /// Returns the index of each member and what `keep` makes of its result, in the order of the sweep; `observer`
    /// may leave members out. Without threads, as in a browser, one runs after the other.
    pub fn run<T: Send>(
        &self,
        order: &[usize],
        observer: &impl Observer,
        keep: impl Fn(ComputedCollision) -> T + Sync,
    ) -> Vec<(usize, Result<T, CaseError>)> {
        let run = |&index: &usize| Some((index, self.observed(index, observer)?.map(&keep)));
        // The bridge passes members on one by one, in order.
        let mut kept: Vec<_> = order.iter().par_bridge().filter_map(run).collect();
        kept.sort_by_key(|(index, _)| *index);
        kept
    }

    /// Runs these members as [`Runner::run`] does, for results that only `observer` uses.
    pub fn run_all(&self, order: &[usize], observer: &impl Observer) {
        let run = |&index: &usize| drop(self.observed(index, observer));
        order.iter().par_bridge().for_each(run);
    }

    /// Runs a member that `observer` admits.
    fn observed(
        &self,
        index: usize,
        observer: &impl Observer,
    ) -> Option<Result<ComputedCollision, CaseError>> {
        observer.admits(index).then(|| {
            let mut watch = observer.begin(index);
            let ran = self.run_one(index, &mut watch);
            observer.end(index, watch, ran.as_ref());
            ran
        })
    }
}

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

/// Observes nothing and admits every member.
impl Observer for () {
    type Watch = ();

    fn begin(&self, _: usize) {}
}

/// Returns all members, the most expensive first; rejected ones cost nothing.
pub fn most_expensive_first(members: &(impl Members + ?Sized)) -> Vec<usize> {
    let price = |index| {
        members
            .build(index, |case| Simulation::expected_of(&case))
            .unwrap_or_default()
            .element_updates
    };
    let mut order: Vec<usize> = (0..members.n_members()).collect();
    order.sort_by_cached_key(|index| Reverse(price(*index)));
    order
}
