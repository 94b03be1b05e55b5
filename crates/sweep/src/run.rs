//! Runs a sweep on several threads.

use std::collections::BTreeMap;
use std::io;
use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};

use linkage::error::Result;
use linkage::quiet::{guarded, panic_text};
use linkage::threads::side_by_side;

use crate::plan::{CaseResult, CaseSolver, SweepPlan, one_line};
use crate::sentences;
use crate::store::SweepStore;
use crate::summary::{Goal, SweepSummary};
use crate::table::RowGroup;

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

    fn add(&mut self, part: &SweepSummary) {
        self.solved += part.cases - part.refused;
        self.refused += part.refused;
        self.disagreement = self.disagreement.into_iter().chain(part.disagreement).min();
    }
}

/// Solves the parts of a shard, or of the whole sweep, that are not stored yet.
/// After every part, `progress` is called with the numbers of finished cases.
/// If `progress` returns `Break`, the sweep stops.
/// If the proof of a case disagrees, the sweep stops after the part of this case; finished parts remain stored.
/// If the proof of a stored case disagrees, no further case is solved.
/// If the table is joined already, no case is solved.
/// Without `shard`, the parts are joined to one table while further parts are solved.
/// The summary is that of [`SweepSummary::of`] with the goal `goal`. It is `None` unless this call has solved all cases
/// and joined them.
///
/// # Errors
/// [`linkage::error::ErrorKind::Io`] if a part or the joined table cannot be read or written.
pub fn run(
    plan: &SweepPlan,
    store: &SweepStore,
    shard: Option<Shard>,
    threads: usize,
    goal: Goal,
    progress: &mut dyn FnMut(&SweepTally) -> ControlFlow<()>,
) -> Result<(SweepTally, Option<SweepSummary>)> {
    if store.is_complete() {
        let is_proven = plan.prove_every.is_some();
        let summary = is_proven.then(|| SweepSummary::of(plan, &store.table(), goal)).transpose()?;
        let disagreement = summary.and_then(|own| own.disagreement);
        let stored = shard.unwrap_or(Shard::WHOLE).cases(plan);
        return Ok((SweepTally { stored, disagreement, ..SweepTally::default() }, None));
    }
    let (stored, open): (Vec<u64>, Vec<u64>) =
        shard.unwrap_or(Shard::WHOLE).parts(plan).partition(|part| store.has(*part));
    let mut tally = SweepTally { stored: cases_of(plan, stored.iter().copied()), ..SweepTally::default() };
    if plan.prove_every.is_some() {
        for part in &stored {
            let of_part = SweepSummary::read(plan, &store.part(*part), plan.cases_of(*part).start, goal)?;
            tally.disagreement = tally.disagreement.or(of_part.disagreement);
        }
    }
    if tally.disagreement.is_some() {
        return Ok((tally, None));
    }
    let parts = Parts { plan, store, open, goal };
    if shard.is_some() {
        return Ok((parts.solve(tally, threads, &mut |tally, _| progress(tally))?, None));
    }
    let (mut outcome, mut summary) = (Ok(SweepTally::default()), None);
    store.fill(plan, |table| {
        let (mut next, mut all) = (0, SweepSummary::none(plan));
        // Parts are appended in their order. A part that is solved before an earlier part waits.
        let mut waiting = BTreeMap::new();
        let mut append = |solved: Option<SolvedPart>| {
            waiting.extend(solved);
            while next < plan.parts() {
                match waiting.remove(&next) {
                    Some(summary) => all.add(summary, goal),
                    None if stored.binary_search(&next).is_ok() => {}
                    None => return Ok(false),
                }
                table.append(&store.part(next)).map_err(io::Error::other)?;
                next += 1;
            }
            Ok::<bool, io::Error>(true)
        };
        let mut broken = None;
        outcome = parts.solve(tally, threads, &mut |tally, solved| {
            broken = append(solved).err();
            if broken.is_some() { ControlFlow::Break(()) } else { progress(tally) }
        });
        broken.map_or(Ok(()), Err)?;
        let is_whole = outcome.as_ref().is_ok_and(|tally| tally.disagreement.is_none()) && append(None)?;
        summary = (is_whole && stored.is_empty()).then_some(all.finished());
        if is_whole { Ok(()) } else { Err(None) }
    })?;
    Ok((outcome?, summary))
}

/// A part that was solved, and the summary of its cases.
type SolvedPart = (u64, SweepSummary);

/// The parts of a run that must be solved.
struct Parts<'a> {
    plan: &'a SweepPlan,
    store: &'a SweepStore,
    open: Vec<u64>,
    goal: Goal,
}

impl Parts<'_> {
    /// Solves and stores the parts, and adds their cases to `tally`. `progress` is as in [`run`], and also gets each
    /// part that was solved.
    fn solve(
        &self,
        mut tally: SweepTally,
        threads: usize,
        progress: &mut dyn FnMut(&SweepTally, Option<SolvedPart>) -> ControlFlow<()>,
    ) -> Result<SweepTally> {
        let Parts { plan, store, ref open, goal, .. } = *self;
        let mut failed = None;
        // A thread takes an idle solver for its next part, so each thread reads the scenario file only once.
        let solvers: Mutex<Vec<CaseSolver>> = Mutex::default();
        let idle = || solvers.lock().unwrap_or_else(PoisonError::into_inner);
        let solve_part = |part: u64| {
            let taken = idle().pop();
            let mut solver = taken.map_or_else(|| plan.solver(), Ok)?;
            let rows = solved(plan, &mut solver, part);
            idle().push(solver);
            store.write(plan, part, &rows)?;
            Ok((part, SweepSummary::of_rows(plan, plan.cases_of(part).start, &rows, goal)))
        };
        let work = |index: usize, tell: &mut dyn FnMut(Result<SolvedPart>)| tell(solve_part(open[index]));
        side_by_side(open.len(), threads, work, |_, found| {
            let found = found.map_err(|error| failed = failed.take().or(Some(error))).ok();
            if let Some((_, summary)) = &found {
                tally.add(summary);
            }
            let go_on = progress(&tally, found);
            if failed.is_some() || tally.disagreement.is_some() { ControlFlow::Break(()) } else { go_on }
        });
        failed.map_or(Ok(tally), Err)
    }
}

/// Solves the cases of a part.
fn solved(plan: &SweepPlan, solver: &mut CaseSolver, part: u64) -> RowGroup {
    let cases = plan.cases_of(part);
    let count = (cases.end - cases.start) as usize;
    let columns = |number: usize| -> Vec<Vec<f64>> { (0..number).map(|_| Vec::with_capacity(count)).collect() };
    let (axes, figures) = (plan.design.axes().len(), plan.figures.len());
    let mut rows = RowGroup {
        values: columns(axes),
        figures: columns(figures),
        reasons: Vec::with_capacity(count),
        verdicts: Vec::new(),
    };
    let (mut values, mut found) = (vec![0.0; axes], vec![0.0; figures]);
    for case in cases {
        // A panic is a bug in the program. The case is refused with the panic's message, and the sweep continues.
        let result = guarded(|| solver.solve(case, &mut values, &mut found)).unwrap_or_else(|panic| {
            found.fill(f64::NAN);
            let text = one_line(panic_text(panic.as_ref()).unwrap_or_default());
            CaseResult { refusal: Some(sentences::a_case_panicked(&text)), verdict: None }
        });
        rows.reasons.push(result.refusal);
        if plan.prove_every.is_some() {
            rows.verdicts.push(result.verdict);
        }
        rows.values.iter_mut().zip(&values).for_each(|(column, value)| column.push(*value));
        rows.figures.iter_mut().zip(&found).for_each(|(column, value)| column.push(*value));
    }
    rows
}
