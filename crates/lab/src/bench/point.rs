//! One method of solving a scenario, and its outcome.
//! The effort of a run is exact, because operations are counted and no clock is used.

use linkage::engine::Settings;
use linkage::math::KeepNan;
use linkage::trajectory::Stage;

linkage::words! {
    /// The kind of party that a method belongs to.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum MethodOwner: name {
        /// An analytic side.
        Side = "side",
        /// An engine of this build.
        Engine = "engine",
        /// Another program.
        Peer = "peer",
    }
}

/// Errors of all channels of one stage. The error of each channel is divided by the channel's scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Largest error over instants and channels.
    pub max: f64,
    /// Largest root mean square of a channel's errors.
    pub rms: f64,
    /// Whether the reference's error exceeds a hundredth of `max`.
    pub is_limited: bool,
}

/// A run that answered.
#[derive(Clone, Debug, PartialEq)]
pub struct AnsweredRun {
    /// Errors by stage, in the order of [`Stage::ALL`].
    /// `None` for a stage that was not requested, has failed, or has no channel in the answer of a peer.
    pub errors: [Option<Errors>; Stage::ALL.len()],
    /// Stages in which a peer's numbers are invalid, each with its fault.
    /// Stages with invalid numbers count as failures.
    pub failed: Vec<(Stage, String)>,
    /// Stages that are judged although channels are missing in the peer's answer, each with the missing channels.
    /// For example, a peer of an older version does not know the newest channels.
    pub without: Vec<(Stage, String)>,
    /// Times of all rounds (s).
    pub seconds: Vec<f64>,
    /// Counted operations of the run.
    pub effort: RunEffort,
}

/// Outcome of a method.
#[derive(Clone, Debug, PartialEq)]
pub enum BenchOutcome {
    /// The method answered.
    Answered(AnsweredRun),
    /// The run failed, for this reason.
    Failed(String),
}

/// One method of solving a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct BenchPoint {
    /// Name of solver, engine or peer.
    pub program: String,
    /// The kind of party that the method belongs to.
    pub party: MethodOwner,
    /// Settings except the resolution, in words.
    pub way: String,
    /// Step or accuracy, in words.
    pub resolution: String,
    /// Settings of an engine.
    pub settings: Option<Settings>,
    /// Whether an analytic side runs with its default settings. Always false for engines and peers.
    pub is_usual: bool,
    /// Outcome of the method.
    pub outcome: BenchOutcome,
}

impl BenchPoint {
    /// The run; `None` if the method gave no solution.
    pub fn run(&self) -> Option<&AnsweredRun> {
        match &self.outcome {
            BenchOutcome::Answered(run) => Some(run),
            BenchOutcome::Failed(_) => None,
        }
    }

    /// Shortest time (s).
    pub fn seconds(&self) -> Option<f64> {
        let least = self.run()?.seconds.iter().copied().fold(f64::INFINITY, f64::smaller);
        (least.is_finite() && least > 0.0).then_some(least)
    }

    /// Errors of a stage; `None` if the run has none for the stage.
    pub fn error(&self, stage: Stage) -> Option<Errors> {
        self.run()?.errors[stage as usize]
    }

    /// Reason of a stage's failure; `None` if the stage has not failed.
    pub fn failure(&self, stage: Stage) -> Option<&str> {
        match &self.outcome {
            BenchOutcome::Failed(reason) => Some(reason),
            BenchOutcome::Answered(run) => {
                run.failed.iter().find(|(own, _)| *own == stage).map(|(_, what)| what.as_str())
            }
        }
    }

    /// Text that lists the channels missing in the peer's answer, for a stage that is judged.
    pub fn without(&self, stage: Stage) -> Option<&str> {
        self.run()?.without.iter().find(|(own, _)| *own == stage).map(|(_, what)| what.as_str())
    }

    /// Settings and resolution in words.
    pub fn told(&self) -> String {
        let comma = if self.way.is_empty() || self.resolution.is_empty() { "" } else { ", " };
        format!("{}{comma}{}", self.way, self.resolution)
    }
}

/// Counts of a run's operations, by name: `steps`, `sweeps`, `poses`, `evaluations`, `factorisations`, ...
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RunEffort(pub Vec<(String, u64)>);

/// Names of counts that give the number of solutions. One solution solves the whole mechanism at one state.
/// The first entry whose counts have a sum above zero is used.
/// Evaluations come first, because a step of a multistage method has several evaluations.
const SOLUTIONS: [&[&str]; 3] = [&["evaluations"], &["steps", "probes"], &["poses"]];
/// Names of counts that give the inner work of the solutions. The first count above zero is used.
const INNER: [&[&str]; 4] = [&["sweeps"], &["factorisations"], &["iterations"], &["groups"]];

impl RunEffort {
    /// Number of operations of this name; `None` if they were not counted.
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
    pub fn solutions(&self) -> Option<u64> {
        self.first(&SOLUTIONS)
    }

    /// Inner work: the first count above zero among sweeps of an engine, factorisations, iterations and placed groups.
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
