//! Exact counts of what solvers and engines do.
//!
//! Whoever does the work counts it in a [`Tally`] of its own; whoever wants to know asks with [`counted`].
//! Counts say what a run costs on any machine. They never enter a result.

use std::cell::Cell;

/// What is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Count {
    /// Poses of a whole mechanism that a side has placed, also on the way to a wanted one.
    Poses,
    /// Assur groups placed for them.
    Groups,
    /// Iterations of Newton's method.
    Iterations,
    /// Factorisations of a Jacobian.
    Factorisations,
    /// Solutions for the velocities of a whole mechanism.
    Velocities,
    /// Solutions for its accelerations.
    Accelerations,
    /// Solutions for its reactions and balancing moments, from a known motion.
    Forces,
    /// Evaluations of an equation of motion.
    Evaluations,
    /// Accepted steps of the integrator of a motion under forces.
    Intervals,
    /// Worlds of an engine that were built.
    Worlds,
    /// Time steps of an engine's worlds.
    Steps,
    /// Sweeps over the constraints of a world, in all steps.
    Sweeps,
    /// Tiny steps from a given pose, for what the engine exerts there.
    Probes,
}

impl Count {
    /// All that is counted, in the order of reports.
    pub const ALL: [Count; 13] = [
        Count::Poses,
        Count::Groups,
        Count::Iterations,
        Count::Factorisations,
        Count::Velocities,
        Count::Accelerations,
        Count::Forces,
        Count::Evaluations,
        Count::Intervals,
        Count::Worlds,
        Count::Steps,
        Count::Sweeps,
        Count::Probes,
    ];

    /// Its name, in the plural and in small letters: `poses`, `sweeps`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Count::Poses => "poses",
            Count::Groups => "groups",
            Count::Iterations => "iterations",
            Count::Factorisations => "factorisations",
            Count::Velocities => "velocities",
            Count::Accelerations => "accelerations",
            Count::Forces => "forces",
            Count::Evaluations => "evaluations",
            Count::Intervals => "intervals",
            Count::Worlds => "worlds",
            Count::Steps => "steps",
            Count::Sweeps => "sweeps",
            Count::Probes => "probes",
        }
    }
}

/// Numbers of all that is counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work([u64; Count::ALL.len()]);

impl Work {
    /// No work.
    pub const NONE: Work = Work([0; Count::ALL.len()]);

    /// How often something was done.
    #[must_use]
    pub fn of(&self, what: Count) -> u64 {
        self.0[what as usize]
    }

    /// What was done at all, with its numbers.
    pub fn iter(&self) -> impl Iterator<Item = (Count, u64)> + '_ {
        Count::ALL.into_iter().map(|what| (what, self.of(what))).filter(|(_, times)| *times > 0)
    }

    /// Both together.
    #[must_use]
    pub fn and(mut self, other: &Work) -> Work {
        self.0.iter_mut().zip(other.0).for_each(|(own, other)| *own += other);
        self
    }
}

thread_local! {
    static DONE: Cell<Work> = const { Cell::new(Work::NONE) };
}

/// Runs `run`, and returns what this thread has done in it, and what other threads were told to [`add`].
/// Tallies count when they are dropped: those of `run` should not outlive it.
pub fn counted<T>(run: impl FnOnce() -> T) -> (T, Work) {
    let before = DONE.replace(Work::NONE);
    let answer = run();
    let own = DONE.get();
    DONE.set(before.and(&own));
    (answer, own)
}

/// Adds work that was done elsewhere, as on another thread, to that of this thread.
pub fn add(work: &Work) {
    DONE.set(DONE.get().and(work));
}

/// Counts on behalf of one solver. What it has counted is the thread's when it is dropped.
#[derive(Debug, Default)]
pub struct Tally(Work);

impl Tally {
    /// Counts one more.
    #[inline]
    pub fn one(&mut self, what: Count) {
        self.many(what, 1);
    }

    /// Counts several more.
    #[inline]
    pub fn many(&mut self, what: Count, times: usize) {
        self.0.0[what as usize] += times as u64;
    }
}

/// A copy begins anew: nothing is counted twice.
impl Clone for Tally {
    fn clone(&self) -> Self {
        Tally::default()
    }
}

impl Drop for Tally {
    fn drop(&mut self) {
        add(&self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_counted_once_and_also_by_those_around() {
        let ((inner, outer_first), outer) = counted(|| {
            let mut own = Tally::default();
            own.many(Count::Steps, 3);
            let copy = own.clone();
            drop((own, copy));
            let inner = counted(|| {
                let mut own = Tally::default();
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
    fn counts_are_listed_in_their_own_order() {
        for (index, what) in Count::ALL.into_iter().enumerate() {
            assert_eq!(what as usize, index, "{}", what.name());
        }
    }
}
