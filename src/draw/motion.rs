//! The motion that a drawing shows: paths, travels, frames.

use std::f64::consts::TAU;

use drawing::Travels;
use linkage::case::{Case, Grid, Wanted};
use linkage::math::statistics::ends;
use linkage::mechanism::LinkId;
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;

/// Number of instants of a revolution at which travels and paths are computed.
const INSTANTS: usize = 180;

/// The states of a free motion at the instants of the grid, if a picture of one revolution would not show this motion.
/// This is so if there are several drives, or if the crank does not make a full revolution during the motion.
/// A pendulum is an example: it swings, although its geometry allows full revolutions.
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

/// Whether a link turns fully in these states.
fn turns(states: &[State], link: LinkId) -> bool {
    let [least, most] = ends(states.iter().map(|state| state.angles[link]));
    most - least >= TAU
}

/// The states of a case on its grid; `None` if an instant of the grid cannot be reached.
fn visited(case: &Case, solver: &dyn Solver) -> Option<Vec<State>> {
    let mut states: Vec<Option<State>> = vec![None; case.grid.len()];
    let mut visit = |row: usize, state: &State| {
        states[row] = Some(state.clone());
        Ok(())
    };
    solver.each(case, &mut visit).ok()?;
    states.into_iter().collect()
}
