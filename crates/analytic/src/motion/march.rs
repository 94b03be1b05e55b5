//! Integration by DOP853, with steps that end exactly where a smooth piece of the equation of motion ends.
//! Requested instants lie inside the steps and need no additional step.
//!
//! A step of eighth order that contains a kink is only of first order.
//! Each piece therefore has separate equations, which continue smoothly beyond the ends of the piece.
//! A step that leaves its piece is repeated until its end lies on the boundary.
//! Hairer, Norsett, Wanner, "Solving ordinary differential equations I", II.5 (DOP853) and II.6 (discontinuities).

use crate::sentences;
use differential_equations::interpolate::Interpolation;
use differential_equations::methods::ExplicitRungeKutta;
use differential_equations::ode::OrdinaryNumericalMethod;
use differential_equations::status::Status;
use linkage::math::{KeepNan, root};

use super::inside::{Course, Remembering, Targets, parts};
use super::step::{Flow, Method, Step, a_step, checked, lost, rate};
use linkage::error::{Error, ErrorKind, Result};
use linkage::work::{self, Count, WorkTally};

/// Relative and absolute error allowed in each step, including the states inside it.
/// With this error, the run-up of `crank_rocker` is accurate to 5e-12 rad, and its last instant to 1e-14 rad.
pub const ACCURACY: f64 = 1e-11;
/// Tolerance for the error estimate of a step, divided by the allowed error. The estimate refers to the end of the
/// step.
/// Inside a step the order is lower by one, and errors are some hundred times larger than at the end of the step.
/// The errors inside the steps of `crank_rocker_runup` are 40 to 400 times the estimate.
const ESTIMATED: f64 = 0.01;
/// Smallest tolerance for an error estimate.
/// With a smaller tolerance, rounding shortens the steps.
/// The rounding error of the additional steps then exceeds the truncation error that they save.
const LEAST_ESTIMATED: f64 = 2e-15;
/// Fractions of a step at which the bounds are checked.
const LOOKED_AT: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
/// Error allowed in the tighter runs, divided by [`ACCURACY`]. The difference between a normal run and a tighter run
/// shows the error of the normal run.
/// With a smaller value, rounding error dominates.
pub(crate) const TIGHTER: f64 = 0.01;
/// Width of the windows around change points in the tighter runs, divided by the usual width.
/// The tighter runs pass a change point with poses other than those of the normal run.
/// The difference between a normal run and a tighter run therefore also shows the error of the windows.
pub(crate) const NARROWER: f64 = 0.8;
/// If more than this number of consecutive pieces have zero duration, the motion is stuck at a kink.
pub(crate) const MOST_EMPTY: usize = 8;
/// Largest number of steps of one piece. A hundred turns of a mechanism take about ten thousand steps.
const MOST_STEPS: usize = 3_000_000;
/// Each time this number of steps is completed, the total number of steps is predicted. If the predicted total exceeds
/// `MOST_STEPS`, the march ends.
/// Too many steps are needed if a motor is much too strong for the machine.
/// In this case, the motor's time constant limits the length of the steps.
const PREDICTED: usize = 50_000;
/// A step is short if its length, divided by a reference length, is at most this value.
/// The reference length is the integration interval or the independent variable at the step's beginning, whichever is
/// larger.
/// A long sequence of short steps ends the march.
/// Short steps would never pass a singular pose: near such a pose, accelerations cannot be computed, or their rounding
/// errors exceed their values.
const SHORTEST: f64 = 1e-9;
const MOST_SHORT: usize = 400;
/// A step may be longer than planned by this factor if the longer step reaches the last target. The factor avoids a
/// tiny last step.
const STRETCH: f64 = 1.001;
/// How often a step is bisected to estimate where the motion crosses a bound.
const BISECTIONS: usize = 40;
/// Largest number of repetitions of a shortened step. The secant method usually needs one or two repetitions.
const CORRECTIONS: usize = 6;

/// Why a march ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stop {
    /// The march ended at the last target.
    End,
    /// The march ended on a bound of the piece.
    Bound(usize),
}

/// Present position of a march.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place<const N: usize> {
    /// Independent variable.
    pub(crate) x: f64,
    /// State.
    pub(crate) y: [f64; N],
    /// Length of the next step; 0 if not known.
    pub(crate) h: f64,
}

/// Integrates from `place` over the ascending `targets`, to the last target or to the first bound.
/// `visit` receives every step, in parts that end at the targets inside the step.
pub(crate) fn march<const N: usize, F: Flow<N>>(
    flow: &F,
    place: &mut Place<N>,
    targets: &[f64],
    accuracy: f64,
    visit: &mut dyn FnMut(&F, &Step<N>) -> Result<()>,
) -> Result<Stop> {
    let Some(&last) = targets.last() else { return Ok(Stop::End) };
    let begun_at = place.x;
    let mut targets = Targets::beyond(targets, begun_at);
    if targets.is_empty() {
        return Ok(Stop::End);
    }
    flow.begin(place.x, &place.y);
    let h0 = if place.h > 0.0 { place.h.smaller(last - place.x) } else { 0.0 };
    let allowed = (ESTIMATED * accuracy).larger(LEAST_ESTIMATED);
    let method = ExplicitRungeKutta::dop853().rtol(allowed).atol(allowed).max_steps(MOST_STEPS).h0(h0);
    // Without this limit, the first trial step of a motion from equilibrium would exceed the interval many times.
    let mut method: Method<N> = method.h_max(last - place.x);
    let known = Remembering::new(flow);
    let begun = method.init(&known, place.x, last, &place.y);
    checked(flow, begun, place.x)?;
    let mut begins = known.rate(place.x, &place.y);
    let (mut refused, mut short, mut steps) = (None, 0, 0);
    let mut tally = WorkTally::default();
    loop {
        steps += 1;
        work::spend(1.0)?;
        let way = place.x - begun_at;
        // The comparison is negated so that NaN is refused.
        if steps % PREDICTED == 0 && !((last - begun_at) / way * steps as f64 <= MOST_STEPS as f64) {
            let why = sentences::of_steps_it_is_only_on_of(
                &steps,
                &format_args!("{way:.1e}"),
                &format_args!("{:.1e}", last - begun_at),
            );
            return Err(lost(place.x, &why));
        }
        let (from, wished) = (method.t(), method.h());
        let cut = wished * STRETCH >= last - from;
        if cut {
            method.set_h(last - from);
        }
        let taken = method.step(&known);
        // An error in a trial step only shortens the step. If steps stay short, the error is reported.
        let fault = flow.fault();
        if let Err(why) = taken {
            return Err(fault.or(refused).unwrap_or_else(|| lost(from, &format!("{why:?}"))));
        }
        let is_short = method.h() <= SHORTEST * from.abs().larger(last - begun_at);
        (short, refused) = if is_short { (short + 1, fault.or(refused)) } else { (0, fault) };
        if short > MOST_SHORT {
            let why = sentences::ITS_STEPS_BECOME_TOO_SMALL;
            return Err(refused.unwrap_or_else(|| lost(from, why)));
        }
        if matches!(method.status(), Status::RejectedStep) {
            continue;
        }
        let before = (place.x, place.y);
        let ends = known.rate(method.t(), method.y());
        let mut course = Course { ends: [before, (method.t(), *method.y())], rates: [begins, ends] };
        if let Some(beyond) = beyond(flow, &mut method)? {
            return end_on_bound(flow, place, &course, &mut method, beyond, &mut targets, visit);
        }
        // If this step was shortened to end at the last target, the next step may be longer than this step.
        place.h = if cut { wished.larger(method.h()) } else { method.h() };
        method.set_h(place.h);
        (place.x, place.y) = (if cut { last } else { method.t() }, *method.y());
        course.ends[1].0 = place.x;
        begins = ends;
        tally.one(Count::Intervals);
        parts(flow, &course, &mut method, &mut targets, visit)?;
        if cut {
            return Ok(Stop::End);
        }
        flow.begin(place.x, &place.y);
    }
}

/// The first checked position in the last step that lies beyond a bound, and the state at this position.
/// The checks inside the step also detect a bound that is passed twice within the step.
fn beyond<const N: usize, F: Flow<N>>(flow: &F, method: &mut Method<N>) -> Result<Option<(f64, [f64; N])>> {
    let (from, to) = (method.t_prev(), method.t());
    for share in LOOKED_AT {
        let x = from + share * (to - from);
        let y = if share == 1.0 { *method.y() } else { roughly(method, x)? };
        let x = if share == 1.0 { to } else { x };
        if (0..flow.bounds()).any(|bound| flow.margin(bound, x, &y) < 0.0) {
            return Ok(Some((x, y)));
        }
    }
    Ok(None)
}

/// The state at a position in the last step, by the library's interpolation, which is of order 4 only.
fn roughly<const N: usize>(method: &mut Method<N>, x: f64) -> Result<[f64; N]> {
    method.interpolate(x).map_err(|why| lost(x, &format!("{why:?}")))
}

/// Repeats the last step of the integration so that it ends on a bound.
/// At the position `beyond` the step has passed one or more bounds; the step is repeated for the bound passed first.
fn end_on_bound<const N: usize, F: Flow<N>>(
    flow: &F,
    place: &mut Place<N>,
    course: &Course<N>,
    method: &mut Method<N>,
    beyond: (f64, [f64; N]),
    targets: &mut Targets,
    visit: &mut dyn FnMut(&F, &Step<N>) -> Result<()>,
) -> Result<Stop> {
    let (mut at, mut passed) = (f64::INFINITY, (0, f64::NAN));
    for bound in 0..flow.bounds() {
        let margin = flow.margin(bound, beyond.0, &beyond.1);
        if margin < 0.0 {
            let found = crossing(flow, course, method, beyond.0, bound)?;
            if found < at {
                (at, passed) = (found, (bound, margin));
            }
        }
    }
    let before = (place.x, place.y);
    // If the bound was nearly reached at the beginning of the step, no separate step is needed.
    if at - place.x > 8.0 * f64::EPSILON * at.abs() {
        let known = (beyond.0 - place.x, passed.1);
        let mut found = shortened(flow, before, at - place.x, known, passed.0)?;
        (place.x, place.y) = (found.t(), *found.y());
        let end = rate(flow, place.x, &place.y);
        let course = Course { ends: [before, (place.x, place.y)], rates: [course.rates[0], end] };
        parts(flow, &course, &mut found, targets, visit)?;
    }
    Ok(Stop::Bound(passed.0))
}

/// Position in the last step, before `beyond`, at which the state passes a bound. The position is as accurate as
/// [`Course::at`].
fn crossing<const N: usize, F: Flow<N>>(
    flow: &F,
    course: &Course<N>,
    method: &mut Method<N>,
    beyond: f64,
    bound: usize,
) -> Result<f64> {
    let [low, _] = root::halved([method.t_prev(), beyond], BISECTIONS, |middle| -> Result<bool> {
        let state = course.at(method, middle)?;
        Ok(!(flow.margin(bound, middle, &state) < 0.0))
    })?;
    Ok(low)
}

/// Takes a step of about the length `h` that ends on the bound.
/// The step is repeated, and the secant method gives the length of each repetition.
/// `known` contains the length of a longer step, and the margin to the bound at the end of the longer step.
fn shortened<const N: usize, F: Flow<N>>(
    flow: &F,
    (x, y): (f64, [f64; N]),
    h: f64,
    known: (f64, f64),
    bound: usize,
) -> Result<Method<N>> {
    let mut best: Option<(Method<N>, f64)> = None;
    root::secants(known, h, CORRECTIONS, |h| -> Result<f64> {
        let taken = a_step(flow, x, &y, h)?;
        let margin = flow.margin(bound, taken.t(), taken.y());
        if best.as_ref().is_none_or(|(_, least)| margin.abs() <= *least) {
            best = Some((taken, margin.abs()));
        }
        Ok(margin)
    })?;
    best.map(|(taken, _)| taken).ok_or_else(|| lost(x, sentences::NO_STEP_REACHES_ITS_BOUND))
}

/// Largest number of pieces of one motion. A hundred turns of a mechanism under tables of loads take some thousand
/// pieces.
const MOST_PIECES: usize = 3_000_000;
/// Each time this number of pieces is completed, the total number of pieces is predicted and compared with
/// `MOST_PIECES`.
const JUDGED: usize = 5_000;

/// Counts the pieces of a motion. A motion whose speed grows without bound needs more and more pieces.
#[derive(Debug, Default)]
pub(crate) struct Pace(usize);

impl Pace {
    /// Counts a piece that ends at `x`, in a motion from 0 to `last`.
    ///
    /// # Errors
    /// [`ErrorKind::Numeric`] if the motion would take too many pieces.
    pub(crate) fn piece(&mut self, x: f64, last: f64) -> Result<()> {
        self.0 += 1;
        // The comparison is negated so that NaN is refused.
        if self.0.is_multiple_of(JUDGED) && !(last / x * self.0 as f64 <= MOST_PIECES as f64) {
            return Err(Error::new(
                ErrorKind::Numeric,
                sentences::of_the_motion_has_gone_in_pieces(&last, &x, &self.0),
            )
            .at_time(x)
            .help(sentences::IT_RUNS_AWAY_OR_A_LOAD_TURNS));
        }
        Ok(())
    }
}
