//! Solves all points of some families in parallel.

use std::ops::ControlFlow;

use super::StressFamily;
use super::outcome::StressOutcome;
use super::point::{key_of, run};
use linkage::threads::side_by_side;

/// A point to be solved, or already solved.
#[derive(Clone, Debug)]
pub struct Job {
    /// The family.
    pub family: &'static StressFamily,
    /// Value of the family's varied parameter.
    pub dial: f64,
    /// Number of the sample.
    pub sample: u64,
    /// The result, if it exists.
    pub outcome: Option<StressOutcome>,
}

/// The points of a family. Stored results are used if they are still valid.
/// A quick run contains the points at the family's quick values, and all points with a stored result.
pub fn jobs(family: &'static StressFamily, quick: bool, seed: u64, kept: &[StressOutcome]) -> Vec<Job> {
    let all = family.points.iter().flat_map(|&dial| (0..family.samples).map(move |sample| (dial, sample)));
    let job = |(dial, sample): (f64, u64)| {
        let own = kept.iter().find(|own| own.dial == dial && own.sample == sample);
        let outcome = own.filter(|own| own.key == key_of(family, dial, sample, seed)).cloned();
        let wanted = !quick || family.quick.contains(&dial);
        (wanted || outcome.is_some()).then_some(Job { family, dial, sample, outcome })
    };
    all.filter_map(job).collect()
}

/// Solves the open points on `threads` threads.
/// After each point, `done` receives all jobs, the index of the job just finished, and the number of finished jobs.
/// If `done` returns an error, the work ends.
///
/// # Errors
/// The errors of `done`.
pub fn run_all<E>(
    mut jobs: Vec<Job>,
    seed: u64,
    threads: usize,
    mut done: impl FnMut(&[Job], usize, usize) -> Result<(), E>,
) -> Result<Vec<Job>, E> {
    let open: Vec<usize> = (0..jobs.len()).filter(|&index| jobs[index].outcome.is_none()).collect();
    let points: Vec<_> = open.iter().map(|&index| (jobs[index].family, jobs[index].dial, jobs[index].sample)).collect();
    let (mut finished, mut failed) = (jobs.len() - open.len(), None);
    let work = |index: usize, tell: &mut dyn FnMut(StressOutcome)| {
        let (family, dial, sample) = points[index];
        tell(run(family, dial, sample, seed));
    };
    side_by_side(open.len(), threads, work, |index, outcome| {
        jobs[open[index]].outcome = Some(outcome);
        finished += 1;
        failed = done(&jobs, open[index], finished).err();
        if failed.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    failed.map_or(Ok(jobs), Err)
}
