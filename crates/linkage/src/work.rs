//! Exact counts of the work of solvers and engines.
//! Solvers and engines count their work in a [`WorkTally`]. A caller obtains the counts from [`counted`].
//! Counts show the cost of a run independently of the machine. Counts never affect a result.

use crate::sentences;
use std::cell::Cell;

use crate::error::{Advice, Error, ErrorKind, Result};

crate::words! {
    /// Kinds of counted work.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum Count: name {
        /// Computed poses of the whole mechanism, including intermediate poses between requested poses.
        Poses = "poses",
        /// Assur groups placed while the counted poses were computed.
        Groups = "groups",
        /// Iterations of Newton's method.
        Iterations = "iterations",
        /// Factorisations of a Jacobian.
        Factorisations = "factorisations",
        /// Solutions for the velocities of the whole mechanism.
        Velocities = "velocities",
        /// Solutions for the accelerations of the whole mechanism.
        Accelerations = "accelerations",
        /// Solutions for the reactions and balancing moments of the whole mechanism, from a known motion.
        Forces = "forces",
        /// Evaluations of an equation of motion.
        Evaluations = "evaluations",
        /// Accepted integration steps of a free motion.
        Intervals = "intervals",
        /// Engine worlds built.
        Worlds = "worlds",
        /// Time steps in simulations by engines.
        Steps = "steps",
        /// Sweeps over the constraints of an engine's simulation, summed over all steps.
        Sweeps = "sweeps",
        /// Tiny time steps of an engine from a given pose. Such a step shows the forces that the engine exerts in the
        /// pose.
        Probes = "probes",
    }
}

/// One number for every variant of `Count`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work([u64; Count::ALL.len()]);

impl Work {
    /// No work.
    pub const NONE: Work = Work([0; Count::ALL.len()]);

    /// The number for the variant `what`.
    #[must_use]
    pub fn of(&self, what: Count) -> u64 {
        self.0[what as usize]
    }

    /// Every variant of `Count` whose number is above zero, with this number.
    pub fn iter(&self) -> impl Iterator<Item = (Count, u64)> + '_ {
        Count::ALL.into_iter().map(|what| (what, self.of(what))).filter(|(_, times)| *times > 0)
    }

    /// The sum of `self` and `other`, count by count.
    #[must_use]
    pub fn and(mut self, other: &Work) -> Work {
        self.0.iter_mut().zip(other.0).for_each(|(own, other)| *own += other);
        self
    }
}

thread_local! {
    static DONE: Cell<Work> = const { Cell::new(Work::NONE) };
}

/// Runs `run` and returns its result together with the work counted on this thread during the call.
/// The returned work includes work of other threads that was passed to [`add`] during the call.
/// A `WorkTally` adds its counts only when the tally is dropped. Every tally that `run` creates must therefore be
/// dropped in `run`.
pub fn counted<T>(run: impl FnOnce() -> T) -> (T, Work) {
    let before = DONE.replace(Work::NONE);
    let answer = run();
    let own = DONE.get();
    DONE.set(before.and(&own));
    (answer, own)
}

/// Adds work that was done elsewhere, for example on another thread, to the work of this thread.
pub fn add(work: &Work) {
    DONE.set(DONE.get().and(work));
}

/// Work of placing one Assur group.
/// The work of one step of Newton's method for all constraints is this value times the number of links.
/// The unit is the unit of budgets: one time step of an engine on a four-bar, without sweeps.
/// The value was measured on chains of 1 to 1000 four-bars.
pub const PLACED: f64 = 0.2;

thread_local! {
    /// The [limit](limited) that applies on this thread: the remaining work and the total allowed work.
    static ALLOWED: Cell<[f64; 2]> = const { Cell::new([f64::INFINITY; 2]) };
}

/// Runs `run` with a limit on its work (in the unit of budgets). Beyond the limit, [`spend`] fails on this thread.
/// Returns the result of `run` and whether the limit was exceeded. If limits are nested, the smallest limit applies.
pub fn limited<T>(limit: f64, run: impl FnOnce() -> T) -> (T, bool) {
    let [left, allowed] = ALLOWED.get();
    let own = if limit < left { [limit, limit] } else { [left, allowed] };
    ALLOWED.set(own);
    let answer = run();
    let [still, _] = ALLOWED.get();
    ALLOWED.set([left - (own[0] - still), allowed]);
    (answer, still < 0.0)
}

/// Subtracts work (in the unit of budgets) from the [allowed](limited) work of this thread.
/// Every loop over successive poses calls this function. The limit therefore ends the loop.
///
/// # Errors
/// [`ErrorKind::Unsupported`] if the allowed work is used up. The remedy is a larger budget.
#[inline]
pub fn spend(work: f64) -> Result<()> {
    let [left, allowed] = ALLOWED.get();
    ALLOWED.set([left - work, allowed]);
    if left - work < 0.0 { Err(spent(allowed)) } else { Ok(()) }
}

#[cold]
fn spent(allowed: f64) -> Error {
    let message = sentences::the_work_that_is_allowed(&format_args!("{allowed:.1e}"));
    Error::new(ErrorKind::Unsupported, message).or_help(Advice::MoreWork { to: 10.0 * allowed })
}

/// Counts the work of one solver. When a tally is dropped, its counts are added to the counts of the thread.
#[derive(Debug, Default)]
pub struct WorkTally(Work);

impl WorkTally {
    /// Increases the count `what` by one.
    #[inline]
    pub fn one(&mut self, what: Count) {
        self.many(what, 1);
    }

    /// Increases the count `what` by `times`.
    #[inline]
    pub fn many(&mut self, what: Count, times: usize) {
        self.0.0[what as usize] += times as u64;
    }
}

/// A cloned tally starts at zero. With the counts of the original, the same work would be added to the thread's counts
/// twice.
impl Clone for WorkTally {
    fn clone(&self) -> Self {
        WorkTally::default()
    }
}

impl Drop for WorkTally {
    fn drop(&mut self) {
        add(&self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nested_work_counts_once_in_the_outer_count() {
        let ((inner, outer_first), outer) = counted(|| {
            let mut own = WorkTally::default();
            own.many(Count::Steps, 3);
            let copy = own.clone();
            drop((own, copy));
            let inner = counted(|| {
                let mut own = WorkTally::default();
                own.one(Count::Steps);
                own.one(Count::Probes);
            });
            (inner.1, counted(|| ()).1)
        });
        assert_eq!((inner.of(Count::Steps), inner.of(Count::Probes)), (1, 1));
        assert_eq!(outer_first, Work::NONE);
        assert_eq!(outer.iter().collect::<Vec<_>>(), [(Count::Steps, 4), (Count::Probes, 1)]);
    }

    #[test]
    fn nested_work_counts_towards_the_outer_limit() {
        assert!(spend(1e300).is_ok());
        let ((inner, last), outer) = limited(10.0, || {
            let inner = limited(4.0, || (spend(3.0).is_ok(), spend(2.0).is_ok()));
            (inner, spend(6.0))
        });
        assert_eq!((inner, outer), (((true, false), true), true));
        let error = last.expect_err("5 and 6 are more than 10");
        assert!(error.message().contains("1.0e1 steps") && !error.advice().is_empty(), "{error}");
        assert!(spend(1e300).is_ok());
        // A larger nested limit does not raise the outer limit.
        assert!(limited(1.0, || limited(5.0, || spend(2.0))).0.0.is_err());
    }

    #[test]
    fn counts_are_listed_in_declaration_order() {
        for (index, what) in Count::ALL.into_iter().enumerate() {
            assert_eq!(what as usize, index, "{}", what.name());
        }
    }
}
