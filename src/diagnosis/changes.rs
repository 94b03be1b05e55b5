//! Causes that are tried by solving a changed case: something missing, reversed, of another value, of another instant.

use std::cell::Cell;
use std::rc::Rc;

use super::bench::{Bench, early, thinned};
use super::cause::{Cause, Change};
use super::late::late;
use super::numbers::{confirmed, numbers};
use super::question::{Found, Question};
use super::tries::Tries;
use super::whole::whole_changes;

/// Most changed cases that are solved on thinned grids.
const MOST: usize = 120;
/// Most causes that are confirmed on the whole grid.
const CONFIRMED: usize = 6;
/// Cases that are solved for it on the whole grid: a value may have to be corrected.
const WHOLE: usize = 4 * CONFIRMED;

/// Every change that explains disagreeing channels, and the number of cases that were solved.
pub(super) fn found(question: &Question) -> (Vec<Found>, usize) {
    let left = Rc::new(Cell::new(MOST));
    let whole: Vec<usize> = (0..question.case.grid.len()).collect();
    let is_free = question.case.is_free();
    let thin = Bench::new(question, &thinned(question), left.clone());
    let soon = Bench::new(question, &if is_free { early(question) } else { thinned(question) }, left.clone());
    let first = Bench::new(question, &[0], Rc::new(Cell::new(MOST)));
    let (Some(thin), Some(soon), Some(first)) = (thin, soon, first) else { return (Vec::new(), 0) };
    let tries = Tries { first, starts: [soon.start(), thin.start()], soon, thin, is_free };
    // Differences of rounding size are explained by no change.
    if tries.starts[1].fits() || !tries.starts[1].worst().is_finite() {
        return (Vec::new(), 0);
    }
    let mut candidates = whole_changes(&tries);
    candidates.extend(numbers(&tries));
    candidates.extend(late(question, &tries.thin, &tries.starts[1]));
    let solved = MOST - left.get();
    candidates.sort_by(|a, b| {
        let most = b.explained.len().cmp(&a.explained.len());
        most.then(a.rank.cmp(&b.rank)).then(a.claim.total_cmp(&b.claim))
    });
    let mut found = Vec::new();
    let confirming = Rc::new(Cell::new(WHOLE));
    let Some(full) = Bench::new(question, &whole, confirming) else { return (Vec::new(), solved) };
    let begin = full.start();
    for candidate in candidates.into_iter().take(CONFIRMED) {
        let misfit = (candidate.make)(&full.case).and_then(|case| full.tried_in(&case, candidate.stage));
        let Some(misfit) = misfit else { continue };
        let (mut cause, mut explained) = (candidate.cause, full.explained(&begin, &misfit));
        if let Some((knob, values)) = candidate.number.filter(|_| !misfit.fits())
            && let Some((value, better)) = confirmed(&knob, values, &full, &misfit)
        {
            cause = Cause::Case(Change { part: knob.part.clone(), how: knob.told(value) });
            explained = full.explained(&begin, &better);
        }
        if !explained.is_empty() {
            found.push(Found { cause, rank: candidate.rank, explained });
        }
    }
    (found, solved)
}
