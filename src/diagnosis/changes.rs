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
/// Knobs whose values are searched, of those that explain most in a first approximation.
const SEARCHED: usize = 6;
/// Steps of the search for a value.
const STEPS: usize = 5;

/// A change that explains something at the instants of a bench.
struct Candidate {
    rank: Rank,
    cause: Cause,
    /// How it is solved on any grid.
    make: Box<dyn Fn(&Case) -> Option<Case>>,
    stage: Option<Stage>,
    explained: Vec<Channel>,
}

/// Every change that explains disagreeing channels, and the number of cases that were solved.
pub(super) fn found(question: &Question) -> (Vec<Found>, usize) {
    let left = Rc::new(Cell::new(MOST));
    let whole: Vec<usize> = (0..question.case.grid.len()).collect();
    let thin = Bench::new(question, &thinned(question), left.clone());
    let soon = match question.case.is_free() {
        true => Bench::new(question, &early(question), left.clone()),
        false => Bench::new(question, &thinned(question), left.clone()),
    };
    let (Some(thin), Some(soon)) = (thin, soon) else { return (Vec::new(), 0) };
    let start = thin.start();
    // Differences of rounding size are explained by no change.
    if start.fits() || !start.worst().is_finite() {
        return (Vec::new(), 0);
    }
    let mut candidates = whole_changes(&thin, &start);
    candidates.extend(numbers(&soon, &thin, &start));
    candidates.extend(late(question, &thin, &start));
    let solved = MOST - left.get();
    candidates.sort_by_key(|one| (usize::MAX - one.explained.len(), one.rank));
    let mut found = Vec::new();
    let confirming = Rc::new(Cell::new(CONFIRMED));
    let Some(full) = Bench::new(question, &whole, confirming) else { return (Vec::new(), solved) };
    let begin = full.start();
    for candidate in candidates.into_iter().take(CONFIRMED) {
        let misfit = (candidate.make)(&full.case).and_then(|case| full.tried_in(&case, candidate.stage));
        let explained = misfit.map_or(Vec::new(), |misfit| full.explained(&begin, &misfit));
        if !explained.is_empty() {
            found.push(Found { cause: candidate.cause, rank: candidate.rank, explained });
        }
    }
    (found, solved)
}

type Make = Box<dyn Fn(&Case) -> Option<Case>>;

/// Changes without a number: another configuration, gravity along another axis, mass centres at joints, no inertia
/// forces.
fn whole_changes(bench: &Bench, start: &Misfit) -> Vec<Candidate> {
    let mut tries: Vec<(Change, Make)> = Vec::new();
    for (change, other) in others(&bench.case) {
        let (pose, modes) = (other.start.clone(), other.modes.clone());
        let make: Make = Box::new(move |case| {
            let (pose, modes) = (pose.clone(), modes.clone());
            case.with(|parts| (parts.start, parts.modes) = (pose, modes)).ok()
        });
        tries.push((change, make));
    }
    let gravity = bench.case.gravity;
    if gravity.norm() > 0.0 {
        let swapped = Vec2::new(gravity.y, gravity.x);
        let make: Make = Box::new(move |case| case.with(|parts| parts.gravity = swapped).ok());
        tries.push((Change { part: Part::Gravity, how: How::Swapped }, make));
    }
    let kinematic = is_moved(bench);
    if !kinematic && !bench.case.is_free() {
        tries.push((Change { part: Part::InertiaForces, how: How::Missing }, Box::new(without_inertia_forces)));
    }
    if kinematic || bench.case.is_free() {
        tries.extend(mass_centres(&bench.case));
    }
    let tried = tries.into_iter().filter_map(|(change, make)| {
        let misfit = bench.tried(&make(&bench.case)?)?;
        let explained = bench.explained(start, &misfit);
        let cause = Cause::Case(change);
        (!explained.is_empty()).then_some(Candidate { rank: Rank::Change, cause, make, stage: None, explained })
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

/// A knob with its effect: the change of the misfit per unit of its value.
struct Turned {
    knob: Knob,
    effect: Misfit,
    /// Root of the sum of squares that a change of the value leaves, in a first approximation.
    rest: f64,
}

/// Parts of the case with another value. The effects are seen on `soon`, the values are found on `thin`.
fn numbers(soon: &Bench, thin: &Bench, thin_start: &Misfit) -> Vec<Candidate> {
    let start = soon.start();
    let (moved, free) = (is_moved(soon), soon.case.is_free());
    let mut turned: Vec<Turned> = Vec::new();
    let mut candidates = Vec::new();
    for knob in knobs::all(&soon.case) {
        // Where the motion is prescribed, what moves nothing explains no motion, and what moves something shows in it.
        if !free && knob.moves_nothing == moved {
            continue;
        }
        let Some(nudged) = knob.at(&soon.case, knob.given + knob.nudge).and_then(|case| soon.tried(&case)) else {
            continue;
        };
        let effect = Misfit(nudged.plus(-1.0, &start).0.iter().map(|change| change / knob.nudge).collect());
        let square = effect.dot(&effect);
        if !(square > 0.0) {
            continue;
        }
        let by = -effect.dot(&start) / square;
        let left = start.plus(by, &effect);
        turned.push(Turned { rest: left.dot(&left).sqrt(), knob, effect });
    }
    // The sort is stable: of equals the simpler knob is first.
    turned.sort_by(|a, b| a.rest.total_cmp(&b.rest));
    let linear = |one: &Turned, value: f64| start.plus(value - one.knob.given, &one.effect);
    let mut searched = 0;
    for one in turned {
        let by = -one.effect.dot(&start) / one.effect.dot(&one.effect);
        let near = one.knob.given + by;
        // Values with a meaning are tried where they are near in a first approximation; a free motion may depend on
        // its cause in no simple way, and there they are tried anyway.
        let is_near = |value: f64| {
            let close = (value - near).abs() <= 0.05 * value.abs().larger(0.2 * natural(&one.knob));
            close || linear(&one, value).fits()
        };
        let plain: Vec<(f64, How)> =
            one.knob.plain.iter().filter(|(value, how)| is_near(*value) || (free && is_plain(how))).cloned().collect();
        let mut known = false;
        let knob = Rc::new(one.knob);
        for (value, how) in plain {
            let Some(misfit) = knob.at(&thin.case, value).and_then(|case| thin.tried(&case)) else { continue };
            known |= misfit.fits();
            candidates.extend(candidate(thin, thin_start, &misfit, &knob, value, how, Rank::Change));
        }
        searched += 1;
        if known || searched > SEARCHED || thin.is_spent() {
            continue;
        }
        if let Some((value, misfit)) = search(&knob, near, thin, thin_start) {
            let how = knob.told(value);
            let rank = if matches!(knob.part, Part::StartAngle(_)) { Rank::Shift } else { Rank::Number };
            candidates.extend(candidate(thin, thin_start, &misfit, &knob, value, how, rank));
        }
    }
    candidates
}

/// Whether a way of being different is common enough to be tried at any price.
fn is_plain(how: &How) -> bool {
    match how {
        How::Missing | How::Reversed => true,
        How::Twice | How::Half | How::Times(..) | How::AtJoint(_) => false,
        How::Swapped | How::Other(_) | How::Instead { .. } => false,
    }
}

fn candidate(
    bench: &Bench,
    start: &Misfit,
    misfit: &Misfit,
    knob: &Rc<Knob>,
    value: f64,
    how: How,
    rank: Rank,
) -> Option<Candidate> {
    let explained = bench.explained(start, misfit);
    let cause = Cause::Case(Change { part: knob.part.clone(), how });
    let knob = knob.clone();
    let make: Make = Box::new(move |case| knob.at(case, value));
    (!explained.is_empty()).then_some(Candidate { rank, cause, make, stage: None, explained })
}

/// The value of a knob that leaves least, from a first guess, by secants; with no more digits than the bounds allow.
fn search(knob: &Knob, guess: f64, bench: &Bench, start: &Misfit) -> Option<(f64, Misfit)> {
    let (mut old, mut before) = (knob.given, start.clone());
    let mut value = guess;
    for _ in 0..STEPS {
        let misfit = bench.tried(&knob.at(&bench.case, value)?)?;
        let effect = Misfit(misfit.plus(-1.0, &before).0.iter().map(|change| change / (value - old)).collect());
        let square = effect.dot(&effect);
        if !(square > 0.0 && square.is_finite()) {
            return None;
        }
        let by = -effect.dot(&misfit) / square;
        if misfit.plus(by, &effect).fits() && by.abs() <= 0.1 * (value - knob.given).abs() {
            return Some(rounded(knob, value + by, (value, &misfit), &effect, bench));
        }
        if misfit.dot(&misfit) > before.dot(&before) {
            return None;
        }
        (old, before, value) = (value, misfit, value + by);
        if value == old {
            return None;
        }
    }
    None
}

/// The value with the fewest digits that still explains everything, in a first approximation.
fn rounded(knob: &Knob, best: f64, (at, misfit): (f64, &Misfit), effect: &Misfit, bench: &Bench) -> (f64, Misfit) {
    let fewest = (2..=9).map(|digits| significant(best, digits)).find(|value| {
        *value != knob.given && misfit.plus(value - at, effect).fits()
    });
    let value = fewest.unwrap_or(best);
    let tried = |value: f64| bench.tried(&knob.at(&bench.case, value)?);
    match tried(value).filter(Misfit::fits) {
        Some(found) => (value, found),
        None => match tried(best) {
            Some(found) => (best, found),
            None => (at, misfit.clone()),
        },
    }
}

fn significant(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits - 1).parse().unwrap_or(value)
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
    let mut effect = Misfit(of(nudge)?.plus(-1.0, start).0.iter().map(|change| change / nudge).collect());
    let (mut old, mut before) = (0.0, start.clone());
    for _ in 0..STEPS {
        let square = effect.dot(&effect);
        if !(square > 0.0 && square.is_finite()) {
            return None;
        }
        let by = old - effect.dot(&before) / square;
        // A whole or plain part of a step, where it is as good.
        let parts = [0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0].into_iter().flat_map(|part| [part, -part]);
        let near = step.and_then(|step| parts.map(|part| (part * step, part)).find(|(t, _)| (t - by).abs() < 0.05 * step));
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
        effect = Misfit(misfit.plus(-1.0, &before).0.iter().map(|change| change / (by - old)).collect());
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
    let rank = if steps.is_some() { Rank::Change } else { Rank::Shift };
    let make: Make = Box::new(move |case| shifted(case, by));
    (!explained.is_empty()).then_some(Candidate { rank, cause, make, stage, explained })
}

/// The same case asked at instants that are earlier by `by` (s). A free motion has none before it begins.
fn shifted(case: &Case, by: f64) -> Option<Case> {
    let earliest = if case.is_free() { 0.0 } else { f64::NEG_INFINITY };
    let times = case.grid.times.iter().map(|t| (t - by).larger(earliest)).collect();
    case.on(Grid::of_times(case.crank(), times)).ok()
}
