//! Causes that are tried by solving a changed case: something missing, reversed, of another value, of another instant.

use std::cell::Cell;
use std::rc::Rc;

use super::bench::{Bench, Misfit, early, thinned};
use super::cause::{Cause, Change, How, Part, Slip};
use super::configurations::others;
use super::knobs::{self, Knob, changed, natural};
use super::question::{Found, Question, Rank};
use linkage::case::{Case, Grid};
use linkage::drive::{Course, Load};
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::Side;
use linkage::trajectory::{Channel, Stage};

/// Most changed cases that are solved on thinned grids.
const MOST: usize = 120;
/// Most causes that are confirmed on the whole grid.
const CONFIRMED: usize = 6;
/// Cases that are solved for it on the whole grid: a value may have to be corrected.
const WHOLE: usize = 4 * CONFIRMED;
/// Knobs whose values are tried once, of those that explain most in a first approximation.
const GUESSED: usize = 12;
/// Knobs whose values are searched, of those that explain most then.
const SEARCHED: usize = 5;
/// Steps of the search for a value.
const STEPS: usize = 6;

/// A change that explains something at the instants of a bench.
struct Candidate {
    rank: Rank,
    cause: Cause,
    /// How it is solved on any grid.
    make: Make,
    stage: Option<Stage>,
    explained: Vec<Channel>,
    /// How much it changes in agreeing channels, in shares of their bounds.
    claim: f64,
    /// For a value that was found: its part, the value, and the middle of the values that would do.
    number: Option<(Rc<Knob>, [f64; 2])>,
}

/// The instants on which changes are tried. A free motion is followed for a short time first: later it may depend on
/// its cause in no simple way, and its solution costs more.
struct Tries<'a> {
    soon: Bench<'a>,
    thin: Bench<'a>,
    /// What the reference leaves on both.
    starts: [Misfit; 2],
    is_free: bool,
}

impl Tries<'_> {
    /// What a change leaves. A free motion that it does not explain for a short time is not followed further.
    fn of(&self, make: &dyn Fn(&Case) -> Option<Case>) -> Option<Misfit> {
        if self.is_free && !self.soon.tried(&make(&self.soon.case)?)?.fits() {
            return None;
        }
        self.thin.tried(&make(&self.thin.case)?)
    }

    fn candidate(&self, misfit: &Misfit, rank: Rank, cause: Cause, make: Make) -> Option<Candidate> {
        let (explained, claim) =
            (self.thin.explained(&self.starts[1], misfit), self.thin.claim(&self.starts[1], misfit));
        (!explained.is_empty()).then_some(Candidate { rank, cause, make, stage: None, explained, claim, number: None })
    }
}

/// Every change that explains disagreeing channels, and the number of cases that were solved.
pub(super) fn found(question: &Question) -> (Vec<Found>, usize) {
    let left = Rc::new(Cell::new(MOST));
    let whole: Vec<usize> = (0..question.case.grid.len()).collect();
    let is_free = question.case.is_free();
    let thin = Bench::new(question, &thinned(question), left.clone());
    let soon = Bench::new(question, &if is_free { early(question) } else { thinned(question) }, left.clone());
    let (Some(thin), Some(soon)) = (thin, soon) else { return (Vec::new(), 0) };
    let tries = Tries { starts: [soon.start(), thin.start()], soon, thin, is_free };
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

/// A value near the one found on the thinned grid that explains everything on the whole grid too.
fn confirmed(knob: &Knob, [value, middle]: [f64; 2], full: &Bench, misfit: &Misfit) -> Option<(f64, Misfit)> {
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

type Make = Box<dyn Fn(&Case) -> Option<Case>>;

/// Changes without a number: another configuration, gravity along another axis, mass centres at joints, no inertia
/// forces.
fn whole_changes(tries: &Tries) -> Vec<Candidate> {
    let case = &tries.thin.case;
    let mut all: Vec<(Change, Make)> = Vec::new();
    for (change, other) in others(case) {
        let (pose, modes) = (other.start.clone(), other.modes.clone());
        let make: Make = Box::new(move |case| {
            let (pose, modes) = (pose.clone(), modes.clone());
            case.with(|parts| (parts.start, parts.modes) = (pose, modes)).ok()
        });
        all.push((change, make));
    }
    let gravity = case.gravity;
    if gravity.norm() > 0.0 {
        let swapped = Vec2::new(gravity.y, gravity.x);
        let make: Make = Box::new(move |case| case.with(|parts| parts.gravity = swapped).ok());
        all.push((Change { part: Part::Gravity, how: How::Swapped }, make));
    }
    let kinematic = is_moved(&tries.thin);
    if !kinematic && !tries.is_free {
        all.push((Change { part: Part::InertiaForces, how: How::Missing }, Box::new(without_inertia_forces)));
    }
    if kinematic || tries.is_free {
        all.extend(mass_centres(case));
    }
    let tried = all.into_iter().filter_map(|(change, make)| {
        let misfit = tries.of(&make)?;
        tries.candidate(&misfit, Rank::Change, Cause::Case(change), make)
    });
    tried.collect()
}

/// Whether a position or a rate is among the disagreeing channels.
fn is_moved(bench: &Bench) -> bool {
    bench.columns.iter().any(|column| column.disagrees && column.channel.kind.stage < Stage::Reactions)
}

/// The mass centre of every link at each of its joints.
fn mass_centres(case: &Case) -> Vec<(Change, Make)> {
    let mut found: Vec<(Change, Make)> = Vec::new();
    for (index, link) in case.mechanism.links().iter().enumerate().skip(1).filter(|(_, link)| link.mass > 0.0) {
        for joint in case.mechanism.joints() {
            let Some(at) = joint.on(index).filter(|at| (at - link.mass_centre).norm() > 0.0) else { continue };
            let change = Change { part: Part::MassCentre(link.name.clone()), how: How::AtJoint(joint.name.clone()) };
            let make: Make = Box::new(move |case| {
                let mut parts = case.clone().into_parts();
                changed(&mut parts, |links, _| links[index].mass_centre = at)?;
                Case::new(parts).ok()
            });
            found.push((change, make));
        }
    }
    found
}

/// The case with weights, but without resistance to acceleration.
fn without_inertia_forces(case: &Case) -> Option<Case> {
    let mut parts = case.clone().into_parts();
    let gravity = parts.gravity;
    let weight = |(link, body): (usize, &linkage::mechanism::Link)| Load::Force {
        at: Side { link, local: body.mass_centre },
        force: [Course::Constant(body.mass * gravity.x), Course::Constant(body.mass * gravity.y)],
        follows: false,
    };
    let weights: Vec<Load> = case.mechanism.links().iter().enumerate().skip(1).map(weight).collect();
    parts.loads.extend(weights);
    changed(&mut parts, |links, _| links.iter_mut().for_each(|link| (link.mass, link.inertia) = (0.0, 0.0)))?;
    Case::new(parts).ok()
}

/// A knob with a guess at its value.
struct Guess {
    knob: Rc<Knob>,
    value: f64,
    /// Sum of squares that the guess leaves, in a first approximation.
    rest: f64,
}

/// The knobs that have an effect, with first guesses; those that explain most first.
fn guesses(tries: &Tries) -> Vec<Guess> {
    let (bench, start) = (&tries.soon, &tries.starts[0]);
    let moved = is_moved(bench);
    let mut found = Vec::new();
    for knob in knobs::all(&bench.case) {
        // Where the motion is prescribed, what moves nothing explains no motion, and what moves something shows in it.
        if !tries.is_free && knob.moves_nothing == moved {
            continue;
        }
        let nudged = knob.at(&bench.case, knob.given + knob.nudge).and_then(|case| bench.tried(&case));
        let Some(effect) = nudged.map(|nudged| nudged.plus(-1.0, start).times(1.0 / knob.nudge)) else { continue };
        let square = effect.dot(&effect);
        if square > 0.0 && square.is_finite() {
            let by = -effect.dot(start) / square;
            let left = start.plus(by, &effect);
            found.push(Guess { value: knob.given + by, knob: Rc::new(knob), rest: left.dot(&left) });
        }
    }
    // The sort is stable: of equals the simpler knob is first.
    found.sort_by(|a, b| a.rest.total_cmp(&b.rest));
    found
}

/// Parts of the case with another value.
fn numbers(tries: &Tries) -> Vec<Candidate> {
    let mut candidates = Vec::new();
    let mut open = Vec::new();
    for guess in guesses(tries) {
        let named = meant(tries, &guess.knob, guess.value, false);
        match named.iter().any(|one| one.1) {
            true => {}
            false if open.len() < GUESSED => open.push(guess),
            false => {}
        }
        candidates.extend(named.into_iter().map(|one| one.0));
    }
    // The first approximation may be far off: one real try tells more.
    for guess in &mut open {
        let tried = guess.knob.at(&tries.soon.case, guess.value).and_then(|case| tries.soon.tried(&case));
        guess.rest = tried.map_or(f64::INFINITY, |misfit| misfit.dot(&misfit));
    }
    open.sort_by(|a, b| a.rest.total_cmp(&b.rest));
    for guess in open.into_iter().take(SEARCHED) {
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
            // Known for a short time only: the whole time tells it better.
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

/// The values with a meaning that are near `value`, tried; and whether each explains everything. `found` says that the
/// value is more than a first approximation. Where that may be far off, missing and reversed are tried anyway.
fn meant(tries: &Tries, knob: &Rc<Knob>, value: f64, found: bool) -> Vec<(Candidate, bool)> {
    let near = |plain: f64| match found {
        true => (plain - value).abs() <= 1e-2 * plain.abs().larger(1e-2 * natural(knob)),
        false => (plain - value).abs() <= 0.05 * plain.abs().larger(0.2 * natural(knob)),
    };
    let anyway = |how: &How| !found && (knob.is_far || (tries.is_free && is_plain(how)));
    let plain = knob.plain.iter().filter(|(plain, how)| near(*plain) || anyway(how));
    let tried = plain.filter_map(|(value, how)| {
        let misfit = tries.of(&|case| knob.at(case, *value))?;
        let rank = if matches!(how, How::Times(..)) { Rank::Scale } else { Rank::Change };
        Some((of_knob(tries, &misfit, knob, *value, how.clone(), rank)?, misfit.fits()))
    });
    tried.collect()
}

/// Whether a way of being different is common enough to be tried at any price.
fn is_plain(how: &How) -> bool {
    match how {
        How::Missing | How::Reversed => true,
        How::Twice | How::Half | How::Times(..) | How::AtJoint(_) | How::AboutJoint(_) => false,
        How::Swapped | How::Other(_) | How::Instead { .. } => false,
    }
}

fn of_knob(tries: &Tries, misfit: &Misfit, knob: &Rc<Knob>, value: f64, how: How, rank: Rank) -> Option<Candidate> {
    let cause = Cause::Case(Change { part: knob.part.clone(), how });
    let knob = knob.clone();
    tries.candidate(misfit, rank, cause, Box::new(move |case| knob.at(case, value)))
}

/// The value of a knob that leaves nothing beyond its bound, with as few digits as can be, and the middle of all such
/// values; from a first guess, by secants. `start` is what the given value leaves, if it may serve as first point.
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
            // Too far, once: then there is no way.
            if halved {
                return None;
            }
            (value, halved) = (f64::midpoint(old, value), true);
            continue;
        }
        let by = -effect.dot(&misfit) / square;
        // It has converged, and something is left.
        if by.abs() <= 1e-6 * (value - knob.given).abs() {
            return None;
        }
        (old, before, value) = (value, misfit, value + by);
    }
    None
}

/// The value of fewest digits within a range, and the middle of the range.
fn within(knob: &Knob, [low, high]: [f64; 2]) -> Vec<f64> {
    let middle = f64::midpoint(low, high);
    let is_inside = |value: &f64| *value >= low && *value <= high && *value != knob.given;
    let fewest = (1..=9).map(|digits| knob.significant(middle, digits)).find(is_inside);
    fewest.into_iter().chain([middle]).collect()
}

/// Values of another instant: of all channels, or of those of one stage.
fn late(question: &Question, bench: &Bench, start: &Misfit) -> Vec<Candidate> {
    let mut stages: Vec<Option<Stage>> = vec![None];
    for column in bench.columns.iter().filter(|column| column.disagrees) {
        let stage = Some(column.channel.kind.stage);
        if !stages.contains(&stage) {
            stages.push(stage);
        }
    }
    stages.into_iter().filter_map(|stage| late_in(question, bench, start, stage)).collect()
}

fn late_in(question: &Question, bench: &Bench, start: &Misfit, stage: Option<Stage>) -> Option<Candidate> {
    let times = &bench.case.grid.times;
    let span = times.iter().fold(0.0, |most: f64, t| most.larger(t.abs()));
    let step = question.step;
    let of = |by: f64| bench.tried_in(&shifted(&bench.case, by)?, stage);
    let nudge = step.unwrap_or(1e-5 * span) * 0.25;
    let mut effect = of(nudge)?.plus(-1.0, start).times(1.0 / nudge);
    let (mut old, mut before) = (0.0, start.clone());
    for _ in 0..STEPS {
        let square = effect.dot(&effect);
        if !(square > 0.0 && square.is_finite()) {
            return None;
        }
        let by = old - effect.dot(&before) / square;
        // A whole or plain part of a step, where it is as good.
        let parts = [0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0].into_iter().flat_map(|part| [part, -part]);
        let near =
            step.and_then(|step| parts.map(|part| (part * step, part)).find(|(t, _)| (t - by).abs() < 0.05 * step));
        if let Some((at, part)) = near
            && let Some(misfit) = of(at)
            && let Some(found) = late_candidate(bench, start, &misfit, at, Some(part), stage)
        {
            return Some(found);
        }
        let misfit = of(by)?;
        if misfit.fits() || stage.is_some() {
            let found = late_candidate(bench, start, &misfit, by, None, stage);
            if found.is_some() {
                return found;
            }
        }
        if by == old || misfit.dot(&misfit) > before.dot(&before) {
            return None;
        }
        effect = misfit.plus(-1.0, &before).times(1.0 / (by - old));
        (old, before) = (by, misfit);
    }
    None
}

fn late_candidate(
    bench: &Bench,
    start: &Misfit,
    misfit: &Misfit,
    by: f64,
    steps: Option<f64>,
    stage: Option<Stage>,
) -> Option<Candidate> {
    let explained = bench.explained(start, misfit);
    let cause = Cause::Values { slip: Slip::Late { by, steps, stage }, channels: explained.clone() };
    let rank = match (steps, stage) {
        (Some(_), _) => Rank::Change,
        (None, None) => Rank::Number,
        (None, Some(_)) => Rank::Fitted,
    };
    let make: Make = Box::new(move |case| shifted(case, by));
    let claim = bench.claim(start, misfit);
    (!explained.is_empty()).then_some(Candidate { rank, cause, make, stage, explained, claim, number: None })
}

/// The same case asked at instants that are earlier by `by` (s). A free motion has none before it begins.
fn shifted(case: &Case, by: f64) -> Option<Case> {
    let earliest = if case.is_free() { 0.0 } else { f64::NEG_INFINITY };
    let times = case.grid.times.iter().map(|t| (t - by).larger(earliest)).collect();
    case.on(Grid::of_times(case.crank(), times)).ok()
}
