//! Causes in which a number in the case has another value.

use std::rc::Rc;

use super::bench::{Bench, Misfit};
use super::cause::{Change, PartChange};
use super::knobs::{self, Knob, Shows, natural};
use super::question::Rank;
use super::tries::{Candidate, Tries};
use linkage::math::KeepNan;

/// Number of knobs whose guessed value is tried once. The knobs that explain most in a linear approximation are chosen.
const GUESSED: usize = 12;
/// Number of knobs whose value is searched. The knobs that explain most with their guessed value are chosen.
const SEARCHED: usize = 5;
/// Largest number of steps of the search for a value.
const STEPS: usize = 8;

/// A knob with a guess at its value.
struct Guess {
    knob: Rc<Knob>,
    value: f64,
    /// Remaining sum of squares with the guessed value: first the value of a linear approximation, later the value from
    /// a solved case.
    rest: f64,
    /// Index in the list of all knobs. The list begins with the simplest knob.
    place: usize,
}

/// The knobs that have an effect, with first guesses. Knobs that explain most come first.
fn guesses(tries: &Tries) -> Vec<Guess> {
    let (bench, start) = (&tries.soon, &tries.starts[0]);
    let (moved, shows) = (bench.is_moved(), bench.shows_motion());
    let mut found = Vec::new();
    for (place, knob) in knobs::all(&bench.case).into_iter().enumerate() {
        // In a prescribed motion, a knob for forces cannot explain a wrong motion.
        // A knob for the motion cannot explain forces if the motion is right.
        let is_idle = match knob.shows {
            Shows::Forces => moved,
            Shows::Motion => !moved && shows,
            Shows::Centres => false,
        };
        if !tries.is_free && is_idle {
            continue;
        }
        let nudged = knob.at(&bench.case, knob.given + knob.nudge).and_then(|case| bench.tried(&case));
        let Some(effect) = nudged.map(|nudged| nudged.plus(-1.0, start).times(1.0 / knob.nudge)) else { continue };
        let square = effect.dot(&effect);
        if square > 0.0 && square.is_finite() {
            let by = -effect.dot(start) / square;
            let left = start.plus(by, &effect);
            found.push(Guess { value: knob.given + by, knob: Rc::new(knob), rest: left.dot(&left), place });
        }
    }
    // The sort is stable: of two knobs that explain equally much, the simpler knob is first.
    found.sort_by(|a, b| a.rest.total_cmp(&b.rest));
    found
}

/// Whether the guess for a coordinate is close enough to the given value. With a distant value, the mechanism hardly
/// moves, and much work is needed to detect this.
fn is_likely(guess: &Guess) -> bool {
    guess.knob.shows == Shows::Forces
        || guess.knob.is_far
        || (guess.value - guess.knob.given).abs() <= natural(&guess.knob)
}

/// Candidates in which a part of the case has another value.
pub(super) fn numbers(tries: &Tries) -> Vec<Candidate> {
    let (mut plain, mut open) = (Vec::new(), Vec::new());
    for guess in guesses(tries) {
        let named = meant(tries, &guess.knob, guess.value, false);
        let is_known = named.iter().any(|one| one.1);
        plain.push((guess.place, named));
        if open.len() < GUESSED && is_likely(&guess) && !is_known {
            open.push(guess);
        }
    }
    // Of several values that explain equally much, the value of the simplest knob comes first.
    plain.sort_by_key(|(place, _)| *place);
    let mut candidates: Vec<Candidate> = plain.into_iter().flat_map(|(_, named)| named).map(|one| one.0).collect();
    // The first approximation may be inaccurate. One solved case improves the guess.
    for guess in &mut open {
        let tried = guess.knob.at(&tries.soon.case, guess.value).and_then(|case| tries.soon.tried(&case));
        guess.rest = tried.map_or(f64::INFINITY, |misfit| misfit.dot(&misfit));
    }
    open.sort_by(|a, b| a.rest.total_cmp(&b.rest));
    open.truncate(SEARCHED);
    open.sort_by_key(|guess| guess.place);
    for guess in open {
        let knob = &guess.knob;
        let Some([mut value, mut middle]) = search(knob, guess.value, &tries.soon, Some(&tries.starts[0])) else {
            continue;
        };
        let named = meant(tries, knob, value, true);
        let is_known = named.iter().any(|one| one.1);
        candidates.extend(named.into_iter().map(|one| one.0));
        if is_known {
            continue;
        }
        let on = |value: f64| tries.thin.tried(&knob.at(&tries.thin.case, value)?);
        let mut misfit = on(value);
        if tries.is_free && !misfit.as_ref().is_some_and(Misfit::fits) {
            // The value was found from a short time only, so it is searched again over the whole run.
            let Some(better) = search(knob, value, &tries.thin, None) else { continue };
            ([value, middle], misfit) = (better, on(better[0]));
        }
        let how = knob.told(value);
        let found = misfit.and_then(|misfit| of_knob(tries, &misfit, knob, value, how, Rank::Number));
        let number = Some((knob.clone(), [value, middle]));
        candidates.extend(found.map(|found| Candidate { number, ..found }));
    }
    candidates
}

/// Tries the knob's values with a simple meaning near `value`. The result states for each candidate whether it
/// explains all differences. `found` is true if `value` comes from a search and is more accurate than a linear
/// approximation. If `found` is false, distant values are tried too: all values if the knob `is_far`, a reversed part,
/// and, in a free motion, a missing part.
fn meant(tries: &Tries, knob: &Rc<Knob>, value: f64, found: bool) -> Vec<(Candidate, bool)> {
    let near = |plain: f64| match found {
        true => (plain - value).abs() <= 1e-2 * plain.abs().larger(1e-2 * natural(knob)),
        false => (plain - value).abs() <= 0.05 * plain.abs().larger(0.2 * natural(knob)),
    };
    let is_cheap = |how: &PartChange| match tries.is_free {
        true => is_plain(how),
        false => *how == PartChange::Reversed,
    };
    let anyway = |how: &PartChange| !found && (knob.is_far || is_cheap(how));
    let plain = knob.plain.iter().filter(|(plain, how)| near(*plain) || anyway(how));
    let tried = plain.filter_map(|(value, how)| {
        let misfit = tries.of(&|case| knob.at(case, *value))?;
        let rank = if matches!(how, PartChange::Times(..)) { Rank::Scale } else { Rank::Change };
        Some((of_knob(tries, &misfit, knob, *value, how.clone(), rank)?, misfit.fits()))
    });
    tried.collect()
}

/// Whether a change is so common that it is tried in every free motion in spite of the cost.
fn is_plain(how: &PartChange) -> bool {
    match how {
        PartChange::Missing | PartChange::Reversed => true,
        PartChange::Twice
        | PartChange::Half
        | PartChange::Times(..)
        | PartChange::AtJoint(_)
        | PartChange::AboutJoint(_) => false,
        PartChange::AtPoint(_)
        | PartChange::FromJoint(_)
        | PartChange::Across(_)
        | PartChange::Middle(_)
        | PartChange::Turned(_) => false,
        PartChange::Swapped | PartChange::Other(_) | PartChange::Instead { .. } => false,
    }
}

fn of_knob(
    tries: &Tries,
    misfit: &Misfit,
    knob: &Rc<Knob>,
    value: f64,
    how: PartChange,
    rank: Rank,
) -> Option<Candidate> {
    let (change, knob) = (Change { part: knob.part.clone(), how }, knob.clone());
    tries.candidate(misfit, rank, change, Box::new(move |case| knob.at(case, value)))
}

/// A value of a knob that keeps all differences within their bounds, with as few digits as possible.
/// Also returns the middle of the range of values that keep the differences within their bounds.
/// The secant method needs two points. The second point is `guess`. The first point is the value given in the case, and
/// `start` is its misfit. If `start` is `None`, the first point is a value close to `guess`.
fn search(knob: &Knob, guess: f64, bench: &Bench, start: Option<&Misfit>) -> Option<[f64; 2]> {
    let on = |value: f64| bench.tried(&knob.at(&bench.case, value)?);
    let (mut old, mut before) = match start {
        Some(start) => (knob.given, start.clone()),
        None => (guess + knob.nudge, on(guess + knob.nudge)?),
    };
    let mut value = guess;
    let mut halved = false;
    for _ in 0..STEPS {
        let misfit = on(value)?;
        let effect = misfit.plus(-1.0, &before).times(1.0 / (value - old));
        if let Some([low, high]) = misfit.kept_by(&effect) {
            for tried in within(knob, [value + low, value + high]) {
                if on(tried)?.fits() {
                    return Some([tried, value + f64::midpoint(low, high)]);
                }
            }
        }
        let square = effect.dot(&effect);
        if !(square > 0.0 && square.is_finite()) {
            return None;
        }
        if misfit.dot(&misfit) > before.dot(&before) {
            // A step that is too long is halved once. If the half step is too long too, the search ends.
            if halved {
                return None;
            }
            (value, halved) = (f64::midpoint(old, value), true);
            continue;
        }
        let by = -effect.dot(&misfit) / square;
        // The search fails: it has converged, but differences remain.
        // A tiny step that removes most of the misfit is not the end: bounds may be far below the differences.
        let rest = misfit.plus(by, &effect);
        if by.abs() <= 1e-6 * (value - knob.given).abs() && !(rest.dot(&rest) < 0.1 * misfit.dot(&misfit)) {
            return None;
        }
        (old, before, value) = (value, misfit, value + by);
    }
    None
}

/// The value with the fewest digits within a range, and the middle of the range.
fn within(knob: &Knob, [low, high]: [f64; 2]) -> Vec<f64> {
    let middle = f64::midpoint(low, high);
    let is_inside = |value: &f64| *value >= low && *value <= high && *value != knob.given;
    let fewest = (1..=9).map(|digits| knob.significant(middle, digits)).find(is_inside);
    fewest.into_iter().chain([middle]).collect()
}

/// Whether the found number is a credible cause. Any smooth error resembles a tiny change of some number, so the found
/// number must satisfy one of three criteria: it differs noticeably from the given number, it has few digits, or its
/// change is known accurately. The change is known accurately if `excess`, the ratio of the differences to their
/// bounds, is large.
pub(super) fn is_sure(change: &Change, excess: f64) -> bool {
    let PartChange::Instead { found, given, unit } = change.how else { return true };
    let told = if unit == "rad" { found.to_degrees() } else { found };
    // The comparison allows for the rounding error of the conversion to degrees.
    let has_few_digits = (knobs::significant(told, FEW_DIGITS) - told).abs() <= 1e-9 * told.abs();
    (found - given).abs() >= TRIFLE * found.abs().larger(given.abs()) || has_few_digits || excess >= TELLING
}

/// A number has few digits if it has at most this many.
const FEW_DIGITS: usize = 4;
/// A relative change below this size counts as a mistake in the number only with further evidence: see [`is_sure`].
const TRIFLE: f64 = 1e-3;
/// A tiny change with many digits counts as a mistake in the number if the differences are at least this many times
/// their bounds. The change is then known to a hundredth.
const TELLING: f64 = 100.0;

/// A value near the value found on the thinned grid, if it also explains everything on the whole grid.
pub(super) fn confirmed(
    knob: &Knob,
    [value, middle]: [f64; 2],
    full: &Bench,
    misfit: &Misfit,
) -> Option<(f64, Misfit)> {
    let on = |value: f64| full.tried(&knob.at(&full.case, value)?);
    let other = if middle == value { value + knob.nudge * 1e-2 } else { middle };
    let second = on(other)?;
    if second.fits() {
        return Some((other, second));
    }
    let effect = second.plus(-1.0, misfit).times(1.0 / (other - value));
    let [low, high] = second.kept_by(&effect)?;
    let tried = within(knob, [other + low, other + high]).into_iter().filter_map(|value| Some((value, on(value)?)));
    tried.into_iter().find(|(_, misfit)| misfit.fits())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::cause::CasePart;

    /// A number that is wrong by less than a thousandth and has many digits is unlikely to have been typed.
    /// Such a number is accepted as the cause only if the difference between the parties is a hundred times its bound.
    #[test]
    fn a_tiny_change_of_many_digits_is_no_cause() {
        let degrees = f64::to_radians;
        for (found, given, unit, excess, sure) in [
            (1.000_456_7, 1.0, "kg", 10.0, false),
            (0.999_543_2, 1.0, "kg", 99.0, false),
            (1.000_456_7, 1.0, "kg", 100.0, true),
            (1.002_456_7, 1.0, "kg", 10.0, true),
            (-1.0, 1.0, "kg", 10.0, true),
            (0.350_2, 0.35, "kg", 10.0, true),
            (degrees(30.01), degrees(30.0), "rad", 10.0, true),
            (degrees(30.012_345), degrees(30.0), "rad", 10.0, false),
        ] {
            let change = Change { part: CasePart::Mass("rod".into()), how: PartChange::Instead { found, given, unit } };
            assert_eq!(is_sure(&change, excess), sure, "{found} instead of {given} {unit}, {excess} times the bound");
        }
        assert!(is_sure(&Change { part: CasePart::Mass("rod".into()), how: PartChange::Missing }, 1.0));
    }
}
