//! All points of some families, side by side on all cores.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::Family;
use super::outcome::Outcome;
use super::point::{key_of, run};

/// A point that is to be done, or is done already.
#[derive(Clone, Debug)]
pub struct Job {
    /// The family.
    pub family: &'static Family,
    /// Value of its dial.
    pub dial: f64,
    /// Number of the sample.
    pub sample: u64,
    /// The result, if there is one.
    pub outcome: Option<Outcome>,
}

/// The points of a family, with the results that are kept and still hold. A quick run has its few points and those that
/// are kept.
#[must_use]
pub fn jobs(family: &'static Family, quick: bool, seed: u64, kept: &[Outcome]) -> Vec<Job> {
    let all = family.points.iter().flat_map(|&dial| (0..family.samples).map(move |sample| (dial, sample)));
    let job = |(dial, sample): (f64, u64)| {
        let own = kept.iter().find(|own| own.dial == dial && own.sample == sample);
        let outcome = own.filter(|own| own.key == key_of(family, dial, sample, seed)).cloned();
        let wanted = !quick || family.quick.contains(&dial);
        (wanted || outcome.is_some()).then_some(Job { family, dial, sample, outcome })
    };
    all.filter_map(job).collect()
}

/// Does what is open, on `threads` cores. `done` is called after each point with all jobs as they stand and the number
/// of those that are finished; an error that it returns ends the work.
///
/// # Errors
/// Those of `done`.
pub fn run_all<E: Send>(
    jobs: Vec<Job>,
    seed: u64,
    threads: usize,
    done: impl Fn(&[Job], usize, usize) -> Result<(), E> + Sync,
) -> Result<Vec<Job>, E> {
    let open: Vec<usize> = (0..jobs.len()).filter(|&index| jobs[index].outcome.is_none()).collect();
    let (next, all, failed) = (AtomicUsize::new(0), Mutex::new(jobs), Mutex::new(None));
    std::thread::scope(|scope| {
        for _ in 0..threads.max(1).min(open.len()) {
            scope.spawn(|| {
                loop {
                    let taken = next.fetch_add(1, Ordering::Relaxed);
                    let Some(&index) = open.get(taken) else { return };
                    let (family, dial, sample) = {
                        let jobs = all.lock().expect("no point panics while it holds the list");
                        (jobs[index].family, jobs[index].dial, jobs[index].sample)
                    };
                    let outcome = run(family, dial, sample, seed);
                    let mut jobs = all.lock().expect("no point panics while it holds the list");
                    jobs[index].outcome = Some(outcome);
                    let finished = jobs.iter().filter(|job| job.outcome.is_some()).count();
                    if let Err(error) = done(&jobs, index, finished) {
                        *failed.lock().expect("nothing panics in between") = Some(error);
                        next.store(open.len(), Ordering::Relaxed);
                    }
                }
            });
        }
    });
    match failed.into_inner().expect("nothing panics in between") {
        Some(error) => Err(error),
        None => Ok(all.into_inner().expect("no point panics while it holds the list")),
    }
}
