//! Runs a sweep on several threads.

use std::io;
use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};

use linkage::error::Result;
use linkage::quiet::{guarded, panic_text};
use linkage::threads::side_by_side;

use crate::plan::{CaseResult, CaseSolver, SweepPlan, one_line};
use crate::sentences;
use crate::store::SweepStore;
use crate::table::Rows;

/// One of several shares of a sweep's parts. The sizes of the shares differ by at most one part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Number of the share, from 1.
    pub number: u64,
    /// Number of shares.
    pub count: u64,
}

impl Shard {
    /// All parts.
    pub const WHOLE: Shard = Shard { number: 1, count: 1 };

    /// The indices of the parts in this share.
    pub fn parts(self, plan: &SweepPlan) -> impl Iterator<Item = u64> {
        (self.number - 1..plan.parts()).step_by(self.count as usize)
    }

    /// Number of cases of this share.
    #[must_use]
    pub fn cases(self, plan: &SweepPlan) -> u64 {
        cases_of(plan, self.parts(plan))
    }
}

/// Number of cases of some parts.
fn cases_of(plan: &SweepPlan, parts: impl Iterator<Item = u64>) -> u64 {
    parts.map(|part| plan.cases_of(part).count() as u64).sum()
}

/// How many cases are finished: in this run so far, and in earlier runs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SweepTally {
    /// Cases solved in this run.
    pub solved: u64,
    /// Cases refused in this run.
    pub refused: u64,
    /// Cases stored by an earlier run.
    pub stored: u64,
    /// Index of the first case whose proof disagrees.
    pub disagreement: Option<u64>,
}

impl SweepTally {
    /// Number of finished cases, from this run and from earlier runs.
    #[must_use]
    pub fn cases(&self) -> u64 {
        self.solved + self.refused + self.stored
    }

    fn add(&mut self, first: u64, results: &[CaseResult]) {
        for (case, result) in (first..).zip(results) {
            match &result.refusal {
                None => self.solved += 1,
                Some(_) => self.refused += 1,
            }
            if result.verdict.as_deref() == Some("disagree") {
                self.disagreement = Some(self.disagreement.map_or(case, |own| own.min(case)));
            }
        }
    }
}

/// Solves the parts of a shard, or of the whole sweep, that are not stored yet.
/// After every part, `progress` is called with the numbers of finished cases.
/// If `progress` returns `Break`, the sweep stops.
/// If the proof of a case disagrees, the sweep stops after the part of this case; finished parts remain stored.
/// Without `shard`, the parts are joined to one table while further parts are solved.
///
/// # Errors
/// [`linkage::error::ErrorKind::Io`] if a part or the joined table cannot be written.
pub fn run(
    plan: &SweepPlan,
    store: &SweepStore,
    shard: Option<Shard>,
    threads: usize,
    progress: &mut dyn FnMut(&SweepTally) -> ControlFlow<()>,
) -> Result<SweepTally> {
    if let Some(shard) = shard {
        return solve_parts(plan, store, shard, threads, progress);
    }
    let mut outcome = Ok(SweepTally::default());
    store.fill(plan, |table| {
        let mut next = 0;
        // Parts are appended in their order. A part that is stored before an earlier part waits.
        let mut append = || {
            while next < plan.parts() && store.has(next) {
                table.append(&store.part(next)).map_err(io::Error::other)?;
                next += 1;
            }
            Ok::<bool, io::Error>(next == plan.parts())
        };
        let mut broken = None;
        outcome = solve_parts(plan, store, Shard::WHOLE, threads, &mut |tally| {
            broken = append().err();
            if broken.is_some() { ControlFlow::Break(()) } else { progress(tally) }
        });
        broken.map_or(Ok(()), Err)?;
        let is_whole = outcome.as_ref().is_ok_and(|tally| tally.disagreement.is_none()) && append()?;
        if is_whole { Ok(()) } else { Err(None) }
    })?;
    outcome
}

/// Solves and stores the parts of a shard. `progress` is as in [`run`].
fn solve_parts(
    plan: &SweepPlan,
    store: &SweepStore,
    shard: Shard,
    threads: usize,
    progress: &mut dyn FnMut(&SweepTally) -> ControlFlow<()>,
) -> Result<SweepTally> {
    let mut tally = SweepTally::default();
    let (stored, open): (Vec<u64>, Vec<u64>) = shard.parts(plan).partition(|part| store.has(*part));
    tally.stored = cases_of(plan, stored.into_iter());
    let mut failed = None;
    // Idle solvers. A thread takes an idle solver for its next part, so each thread reads the scenario file only once.
    let solvers: Mutex<Vec<CaseSolver>> = Mutex::default();
    let waiting = || solvers.lock().unwrap_or_else(PoisonError::into_inner);
    let part = |part: u64| {
        let idle = waiting().pop();
        let mut solver = idle.map_or_else(|| plan.solver(), Ok)?;
        let rows = solved(plan, &mut solver, part);
        waiting().push(solver);
        store.write(plan, part, &rows)?;
        Ok((rows.first, rows.results))
    };
    let work = |index: usize, tell: &mut dyn FnMut(Result<(u64, Vec<CaseResult>)>)| tell(part(open[index]));
    side_by_side(open.len(), threads, work, |_, part| {
        match part {
            Ok((first, results)) => tally.add(first, &results),
            Err(error) => failed = failed.take().or(Some(error)),
        }
        let go_on = progress(&tally);
        if failed.is_some() || tally.disagreement.is_some() { ControlFlow::Break(()) } else { go_on }
    });
    failed.map_or(Ok(tally), Err)
}

fn solved(plan: &SweepPlan, solver: &mut CaseSolver, part: u64) -> Rows {
    let cases = plan.cases_of(part);
    let count = (cases.end - cases.start) as usize;
    let columns = |number: usize| -> Vec<Vec<f64>> { (0..number).map(|_| Vec::with_capacity(count)).collect() };
    let (axes, figures) = (plan.design.axes().len(), plan.figures.len());
    let mut rows = Rows {
        first: cases.start,
        values: columns(axes),
        figures: columns(figures),
        results: Vec::with_capacity(count),
    };
    let (mut values, mut found) = (vec![0.0; axes], vec![0.0; figures]);
    for case in cases {
        // A panic is a bug in the program. The case is refused with the panic's message, and the sweep continues.
        let result = guarded(|| solver.solve(case, &mut values, &mut found)).unwrap_or_else(|panic| {
            found.fill(f64::NAN);
            let text = one_line(panic_text(panic.as_ref()).unwrap_or_default());
            CaseResult { refusal: Some(sentences::a_case_panicked(&text)), verdict: None }
        });
        rows.results.push(result);
        rows.values.iter_mut().zip(&values).for_each(|(column, value)| column.push(*value));
        rows.figures.iter_mut().zip(&found).for_each(|(column, value)| column.push(*value));
    }
    rows
}
