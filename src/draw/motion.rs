//! The motion that a drawing shows: paths, travels, frames.

use crate::sentences;
use std::f64::consts::TAU;

use drawing::Travels;
use linkage::case::{Case, Grid, Wanted};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::math::statistics::ends;
use linkage::mechanism::LinkId;
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;

/// Number of instants of a revolution at which travels and paths are computed.
const INSTANTS: usize = 180;

/// The states of a free motion at the instants of the grid, if there are several drives, or if the crank does not make
/// a full revolution during the motion: a picture of one revolution would not show such a motion. A pendulum is an
/// example: it swings, although its geometry allows full revolutions.
pub(super) fn swung(case: &Case, solver: &dyn Solver) -> Option<Vec<State>> {
    let states = case.is_free().then(|| visited(&case.wanting(seen()), solver))??;
    (case.drives.len() > 1 || !turns(&states, case.crank().link)).then_some(states)
}

/// The channels needed to draw a motion.
fn seen() -> Wanted {
    Wanted::of(&[Stage::Positions, Stage::Velocities])
}

/// The states of one revolution from the start on, and the travel of every link in these states.
/// If the crank cannot make a revolution, the states are those of the grid.
pub(super) fn turned(case: &Case, solver: &dyn Solver) -> (Vec<State>, Travels) {
    let crank = case.crank();
    let whole = crank.input.period().and_then(|(period, _)| {
        let at = |k: usize| crank.start + crank.sense() * period * k as f64 / INSTANTS as f64;
        let case = case.on(Grid::of_inputs(crank, (0..INSTANTS).map(at).collect())).ok()?;
        visited(&case.wanting(seen()), solver)
    });
    let states = whole.or_else(|| visited(&case.wanting(seen()), solver)).unwrap_or_default();
    with_travels(case, states)
}

/// States with the travels of every link.
pub(super) fn with_travels(case: &Case, states: Vec<State>) -> (Vec<State>, Travels) {
    let mut travels = Travels::none(&case.mechanism);
    for state in &states {
        travels.take_in(&case.mechanism, |link, local| Some(state.motions[link].point(local)));
    }
    (states, travels)
}

/// A motion with equally spaced positions.
pub(super) struct Course {
    /// States of the whole motion, in the order in which the mechanism passes them.
    pub(super) states: Vec<State>,
    /// Positions, as indices of `states`.
    pub(super) rows: Vec<usize>,
    /// The input or the time of the first position, and the distance between neighbouring positions.
    pub(super) from: f64,
    pub(super) apart: f64,
    /// Whether the positions are equally spaced in time (s) instead of the input.
    pub(super) is_timed: bool,
}

impl Course {
    /// The motion of a case, with `count` positions.
    /// If the driving link turns fully, the positions are equally spaced over one revolution from the start. The end of
    /// the revolution is left out.
    /// If the driving link does not turn fully, the positions are equally spaced in the input over the grid of the
    /// case, including both ends of the grid.
    /// The positions are equally spaced in time if there are several drives, if the input reverses within the grid or
    /// cannot be followed over the grid, or if the driving link swings freely.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if the positions are spaced in time and the grid has one instant.
    /// The error of the solver if an instant cannot be reached.
    pub(super) fn of(case: &Case, solver: &dyn Solver, count: usize) -> Result<Course> {
        let nominal = case.nominal();
        let crank = nominal.crank();
        if swung(case, solver).is_some() {
            return Course::timed(case, solver, count);
        }
        if !nominal.drives.further().is_empty() {
            return Course::timed(&nominal, solver, count);
        }
        let whole = crank.input.period().and_then(|(period, _)| {
            Course::over(&nominal, solver, [crank.start, crank.start + crank.sense() * period], [count, count]).ok()
        });
        if let Some(whole) = whole {
            return Ok(whole);
        }
        let inputs: Vec<f64> = nominal.grid.ascending().into_iter().map(|row| nominal.grid.inputs[row]).collect();
        let (&[first, ..], &[.., last]) = (&inputs[..], &inputs[..]) else {
            return Course::timed(&nominal, solver, count);
        };
        let [low, high] = ends(inputs.iter().copied());
        let is_one_way = low == first.smaller(last) && high == first.larger(last) && low < high;
        match is_one_way.then(|| Course::over(&nominal, solver, [first, last], [count, count - 1])) {
            Some(Ok(course)) => Ok(course),
            Some(Err(_)) | None => Course::timed(&nominal, solver, count),
        }
    }

    /// The first `count` of the positions that divide the input from `from` to `to` into `intervals` equal intervals.
    fn over(case: &Case, solver: &dyn Solver, [from, to]: [f64; 2], [count, intervals]: [usize; 2]) -> Result<Course> {
        let (parts, inputs) = spaced([from, to], intervals);
        let grid = Grid::of_inputs(case.crank(), inputs);
        let rows = (0..count).map(|k| k * parts).collect();
        let states = reached(&case.on(grid)?.wanting(seen()), solver)?;
        Ok(Course { states, rows, from, apart: (to - from) / intervals as f64, is_timed: false })
    }

    /// Positions equally spaced in time over the grid of a case.
    fn timed(case: &Case, solver: &dyn Solver, count: usize) -> Result<Course> {
        let [from, to] = ends(case.grid.times.iter().copied());
        if !(to > from) {
            let error = Error::new(ErrorKind::Input, sentences::THE_GRID_HAS_ONE_INSTANT);
            return Err(error.help(sentences::GIVE_A_GRID_OVER_THE_MOTION));
        }
        let (parts, times) = spaced([from, to], count - 1);
        let states = reached(&case.on(Grid::of_times(case.crank(), times))?.wanting(seen()), solver)?;
        let rows = (0..count).map(|k| k * parts).collect();
        Ok(Course { states, rows, from, apart: (to - from) / (count - 1) as f64, is_timed: true })
    }
}

/// Equally spaced values between two ends, with both ends. Each of the `intervals` has the same number of parts, so
/// that there are about [`INSTANTS`] parts. Returns the number of parts of an interval, and the values.
fn spaced([from, to]: [f64; 2], intervals: usize) -> (usize, Vec<f64>) {
    let parts = INSTANTS.div_ceil(intervals);
    let all = parts * intervals;
    (parts, (0..=all).map(|k| if k == all { to } else { from + (to - from) * k as f64 / all as f64 }).collect())
}

/// Whether a link turns fully in these states.
fn turns(states: &[State], link: LinkId) -> bool {
    let [least, most] = ends(states.iter().map(|state| state.angles[link]));
    most - least >= TAU
}

/// The states of a case on its grid; `None` if an instant of the grid cannot be reached.
fn visited(case: &Case, solver: &dyn Solver) -> Option<Vec<State>> {
    reached(case, solver).ok()
}

/// The states of a case on its grid.
fn reached(case: &Case, solver: &dyn Solver) -> Result<Vec<State>> {
    let mut states: Vec<Option<State>> = vec![None; case.grid.len()];
    let mut visit = |row: usize, state: &State| {
        states[row] = Some(state.clone());
        Ok(())
    };
    solver.each(case, &mut visit)?;
    Ok(states.into_iter().flatten().collect())
}
