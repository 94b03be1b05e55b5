//! Causes that are tried by solving a changed case: a part that is missing or reversed, another value, another instant.

use std::cell::Cell;
use std::rc::Rc;

use super::bench::{Bench, early, thinned};
use super::cause::{CasePart, Change, DataSlip, DisagreementCause, LateChannels};
use super::knobs;
use super::late::late;
use super::numbers::{confirmed, is_sure, numbers};
use super::question::{DiagnosisInput, Found, Rank};
use super::tries::{Candidate, Tries};
use super::whole::whole_changes;

/// Largest number of changed cases that are solved on thinned grids to find changes other than the change of a number,
/// such as another configuration. The search for changed numbers and shifted instants has a separate limit of the same
/// size. A prescribed motion of at most `LINKS` links costs little, so both limits are then `CHEAP` times as high.
const MOST: usize = 120;
const CHEAP: usize = 3;
/// Up to this number of links, solving a case costs hardly more than for the smallest mechanisms.
const LINKS: usize = 16;
/// Largest number of causes that are confirmed on the whole grid.
const CONFIRMED: usize = 6;
/// Claims (sums of changes divided by bounds) are rounded to multiples of 1 / this number before they are compared.
/// A smaller difference between two claims counts as a rounding error.
const CLAIMED: f64 = 1e3;
/// Limit of cases solved on the whole grid to confirm causes. The limit allows several cases per cause, because a value
/// may need correction.
const WHOLE: usize = 4 * CONFIRMED;

/// All found changes that explain disagreeing channels, and the number of cases that were solved.
pub(super) fn found(question: &DiagnosisInput) -> (Vec<Found>, usize) {
    let links = question.case.mechanism.links().len();
    let most = if question.case.is_free() || links > LINKS { MOST } else { CHEAP * MOST };
    let left = Rc::new(Cell::new(most));
    let whole: Vec<usize> = (0..question.case.grid.len()).collect();
    let is_free = question.case.is_free();
    let thin = Bench::new(question, &thinned(question), left.clone());
    let soon = Bench::new(question, &if is_free { early(question) } else { thinned(question) }, left.clone());
    let first = Bench::new(question, &[0], Rc::new(Cell::new(2 * most)));
    let (Some(thin), Some(soon), Some(first)) = (thin, soon, first) else { return (Vec::new(), 0) };
    let tries = Tries { first, starts: [soon.start(), thin.start()], soon, thin, is_free };
    // No cause is sought if all differences are within their bounds, or if a difference is not finite.
    if tries.starts[1].fits() || !tries.starts[1].worst().is_finite() {
        return (Vec::new(), 0);
    }
    let without_number = whole_changes(&tries);
    let spent = most - left.replace(most);
    // Changes of a single number are put first, because the first of several equivalent changes is preferred.
    let mut candidates = numbers(&tries);
    candidates.extend(without_number);
    let late = late(question, &tries.thin, &tries.starts[1]);
    candidates.extend(turned(&tries, &candidates, &late));
    candidates.extend(late);
    let solved = spent + most - left.get();
    candidates.sort_by(|a, b| {
        let most = b.found.explained.len().cmp(&a.found.explained.len());
        most.then(a.found.rank.cmp(&b.found.rank))
            .then((a.claim * CLAIMED).round().total_cmp(&(b.claim * CLAIMED).round()))
    });
    let mut all = Vec::new();
    let confirming = Rc::new(Cell::new(WHOLE));
    let Some(full) = Bench::new(question, &whole, confirming) else { return (Vec::new(), solved) };
    let begin = full.start();
    for candidate in candidates.into_iter().take(CONFIRMED) {
        let misfit = (candidate.make)(&full.case).and_then(|case| full.tried_in(&case, candidate.changed_channels()));
        let Some(misfit) = misfit else { continue };
        let mut found = Found { explained: full.explained(&begin, &misfit), ..candidate.found };
        if let Some((knob, values)) = candidate.number.filter(|_| !misfit.fits())
            && let Some((value, better)) = confirmed(&knob, values, &full, &misfit)
        {
            let cause = DisagreementCause::Case(Change { part: knob.part.clone(), how: knob.told(value) });
            found = Found { cause, explained: full.explained(&begin, &better), ..found };
        }
        let is_sure = match &found.cause {
            DisagreementCause::Case(change) => is_sure(change, begin.worst()),
            DisagreementCause::Values { .. } => true,
        };
        if !found.explained.is_empty() && is_sure {
            all.push(found);
        }
    }
    (all, solved)
}

/// A drive with a changed start angle, as an alternative to late values. At constant speed, the changed angle and the
/// delay have the same effect.
fn turned(tries: &Tries, known: &[Candidate], late: &[Candidate]) -> Option<Candidate> {
    let case = &tries.thin.case;
    let by = late.iter().find_map(|one| match one.found.cause {
        DisagreementCause::Values { slip: DataSlip::Late { by, of: LateChannels::All, .. }, .. } => Some(by),
        DisagreementCause::Values { .. } | DisagreementCause::Case(_) => None,
    })?;
    let speed = case.crank().constant_speed().filter(|_| case.is_steady() && case.drives.further().is_empty())?;
    let is_turn = |part: &CasePart| matches!(part, CasePart::StartAngle(_));
    let is_known =
        known.iter().any(|one| matches!(&one.found.cause, DisagreementCause::Case(change) if is_turn(&change.part)));
    let knob = knobs::all(case).into_iter().find(|knob| is_turn(&knob.part)).filter(|_| !is_known)?;
    let value = knob.given - speed * by;
    let misfit = tries.of(&|case| knob.at(case, value))?;
    let change = Change { part: knob.part.clone(), how: knob.told(value) };
    tries.candidate(&misfit, Rank::Number, change, Box::new(move |case| knob.at(case, value)))
}
