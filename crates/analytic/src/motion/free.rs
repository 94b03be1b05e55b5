//! Motion determined by forces, with any number of degrees of freedom.
//! Each analytic side computes the accelerations of the driving links with separate equations.
//! The shared integrator integrates these accelerations in time.
//!
//! The independent coordinates are the angles of the driving links (coordinate partitioning: Wehage and Haug 1982).
//! Resistances and the losses of a reducer jump when the motion on which they depend changes its sense.
//! Each sense is constant within one piece of the motion. Pieces end exactly at the instant at which a sense changes.

use super::flow::{self, Pieces};
use super::march::{MOST_EMPTY, Pace, Place, Stop, march};
use super::side::Side;
use super::step::Step;
use crate::sentences;
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::InputValue;
use linkage::solver::{Progress, State, Visit, check_instants};

/// Largest number of free driving links.
pub const MOST_FREEDOMS: usize = 4;

/// Checks that a case can be solved as a free motion.
///
/// # Errors
/// [`ErrorKind::Input`] for instants before t = 0, and for mechanisms without mass; [`ErrorKind::Unsupported`] for
/// too many degrees of freedom.
pub(crate) fn check(case: &Case) -> Result<()> {
    check_instants(case)?;
    let free = case.drives.free().count();
    if free > MOST_FREEDOMS {
        let message = sentences::driving_links_are_free_at_most(&free, &MOST_FREEDOMS);
        return Err(Error::new(ErrorKind::Unsupported, message).help(sentences::PRESCRIBE_THE_MOTION_OF_SOME));
    }
    if case.crank().moving_inertia() == 0.0 && case.mechanism.links().iter().all(|link| link.mass == 0.0) {
        let message = sentences::THE_MOTION_UNDER_FORCES_IS_ASKED;
        return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_THE_LINKS_MASSES_OR_THE_MOTOR));
    }
    Ok(())
}

/// Follows the motion over the case's grid. `accuracy` is the error allowed in each step.
///
/// # Errors
/// The errors of [`check`] and of the side; [`ErrorKind::Numeric`] if a resistance holds the mechanism.
pub(crate) fn sweep(case: &Case, side: &mut dyn Side, accuracy: f64, visit: Visit, progress: Progress) -> Result<()> {
    check(case)?;
    match case.drives.free().count() {
        1 => run::<2>(case, side, accuracy, visit, progress),
        2 => run::<4>(case, side, accuracy, visit, progress),
        3 => run::<6>(case, side, accuracy, visit, progress),
        _ => run::<8>(case, side, accuracy, visit, progress),
    }
}

/// Adds the time (s) and the input to an error of the integration. Errors of a side already contain the input.
fn located(error: Error, t: f64, at: InputValue) -> Error {
    if error.message().starts_with(at.input.noun()) {
        return error.at_time(t);
    }
    let message = format!("t = {t:.6} s, {at}: {}", error.message());
    Error::new(error.kind(), message).at_time(t).at_input(at).help(sentences::LET_THE_GRID_END_BEFORE_WHERE)
}

fn run<const N: usize>(
    case: &Case,
    side: &mut dyn Side,
    accuracy: f64,
    visit: Visit,
    progress: Progress,
) -> Result<()> {
    let rows = case.grid.ascending();
    let mut targets: Vec<f64> = rows.iter().map(|&row| case.grid.times[row]).collect();
    targets.dedup();
    let Some(&last) = targets.last() else { return Ok(()) };
    let mut place = Place { x: 0.0, y: flow::start::<N>(case), h: 0.0 };
    let pieces: Pieces<N> = Pieces::new(case, side);
    pieces.enter(&mut place, None)?;
    let mut next = 0;
    let mut state = State::at_rest(case);
    let mut reach = |pieces: &Pieces<N>, t: f64, y: &[f64; N]| -> Result<()> {
        if rows.get(next).is_none_or(|&row| case.grid.times[row] != t) {
            return Ok(());
        }
        pieces.fill(t, y, &mut state)?;
        while let Some(&row) = rows.get(next).filter(|&&row| case.grid.times[row] == t) {
            visit(row, &state)?;
            next += 1;
        }
        progress(next as f64 / rows.len() as f64);
        Ok(())
    };
    if targets[0] == 0.0 {
        reach(&pieces, 0.0, &place.y)?;
    }
    let (mut empty, mut pace) = (0, Pace::default());
    while place.x < last {
        let from = place.x;
        let mut at_step = |pieces: &Pieces<N>, &[_, (t, y)]: &Step<N>| reach(pieces, t, &y);
        let stop = march(&pieces, &mut place, &targets, accuracy, &mut at_step);
        let drive = case.drives.free().next().expect("a drive is free").1;
        let at = drive.told(drive.from_coordinate(place.y[0]));
        let stop = stop.map_err(|error| located(error, place.x, at))?;
        let Stop::Bound(bound) = stop else { break };
        pace.piece(place.x, last)?;
        empty = if place.x > from { 0 } else { empty + 1 };
        if empty > MOST_EMPTY {
            return Err(Error::new(ErrorKind::Numeric, sentences::the_motion_does_not_get_away(&from))
                .at_time(from)
                .help(sentences::A_LOAD_THAT_TURNS_ABOUT_JUST));
        }
        pieces.enter(&mut place, Some(bound))?;
    }
    Ok(())
}
