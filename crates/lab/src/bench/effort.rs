//! Exact effort of a run: numbers that do not depend on a clock.

/// Counts of a run's operations, by name: `steps`, `sweeps`, `poses`, `evaluations`, `factorisations`, ...
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RunEffort(pub Vec<(String, u64)>);

/// Names of counts that give the number of solutions of the whole mechanism, each at one state.
/// The first entry whose counts have a sum above zero is used.
/// A step of a multistage method has one evaluation for each stage.
const SOLUTIONS: [&[&str]; 3] = [&["evaluations"], &["steps", "probes"], &["poses"]];
/// Names of counts that give the inner work of the solutions. The first count above zero is used.
const INNER: [&[&str]; 4] = [&["sweeps"], &["factorisations"], &["iterations"], &["groups"]];

impl RunEffort {
    /// Number of operations of this name; `None` if they were not counted.
    #[must_use]
    pub fn of(&self, name: &str) -> Option<u64> {
        self.0.iter().find(|(own, _)| own == name).map(|&(_, times)| times)
    }

    fn first(&self, wanted: &[&[&str]]) -> Option<u64> {
        wanted.iter().map(|names| names.iter().filter_map(|name| self.of(name)).sum::<u64>()).find(|&sum| sum > 0)
    }

    /// Number of solutions of the whole mechanism.
    /// The result is the number of evaluations of the equation of motion.
    /// If evaluations were not counted, the result is the number of an engine's steps and probes, or the number of
    /// poses.
    #[must_use]
    pub fn solutions(&self) -> Option<u64> {
        self.first(&SOLUTIONS)
    }

    /// Inner work: the first number that was counted among sweeps of an engine, factorisations, iterations and placed
    /// groups.
    #[must_use]
    pub fn inner(&self) -> Option<u64> {
        self.first(&INNER)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_preferred_count_measures_the_effort() {
        let effort =
            |counts: &[(&str, u64)]| RunEffort(counts.iter().map(|&(name, n)| (name.to_string(), n)).collect());
        let engine = effort(&[("poses", 3), ("steps", 10), ("probes", 2), ("sweeps", 40)]);
        assert_eq!((engine.solutions(), engine.inner()), (Some(12), Some(40)));
        let stages = effort(&[("steps", 10), ("evaluations", 41)]);
        assert_eq!((stages.solutions(), stages.inner()), (Some(41), None));
        let side = effort(&[("poses", 3), ("factorisations", 0), ("iterations", 5)]);
        assert_eq!((side.solutions(), side.inner()), (Some(3), Some(5)));
        assert_eq!((effort(&[]).solutions(), effort(&[]).inner()), (None, None));
    }
}
