//! Quantities with their derivatives at single instants.

use crate::sentences;
use std::collections::BTreeMap;

use analytic::AssurSolver;
use linkage::case::{Case, CaseNumber, Grid, Wanted};
use linkage::drive::Course;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Motion;
use linkage::solver::Solver;
use linkage::trajectory::Stage;
use precise::{CaseNumbers, Dual, Readings, Whole};
use scenario::{CaseSlopes, Claim};

use super::quantity::Quantity;

/// Number of keys by which one solution in dual numbers differentiates.
const WIDTH: usize = 16;

/// A value with its derivatives by all chosen keys.
#[derive(Clone, Debug, Default)]
pub(super) struct Sloped {
    pub(super) value: f64,
    pub(super) slopes: Vec<f64>,
}

/// Quantities with their derivatives, at some rows of the grid.
#[derive(Debug)]
pub(super) struct Derived {
    places: BTreeMap<usize, usize>,
    /// For every row, all quantities with their derivatives.
    rows: Vec<Vec<Sloped>>,
    turns: Vec<Option<f64>>,
    /// Times of the rows (s), with their derivatives.
    pub(super) times: Vec<f64>,
    pub(super) time_slopes: Vec<Vec<f64>>,
}

impl Derived {
    /// The quantity with this number, at a row.
    pub(super) fn at(&self, quantity: usize, row: usize) -> &Sloped {
        &self.rows[self.places[&row]][quantity]
    }

    /// A full turn in the unit of a quantity, if it is an angle.
    pub(super) fn turn(&self, quantity: usize) -> Option<f64> {
        self.turns[quantity]
    }
}

/// Motion and angles of all links at the rows, by side 1.
fn poses(case: &Case, rows: &[usize]) -> Result<Vec<(Vec<Motion>, Vec<f64>)>> {
    let pick = |all: &[f64]| rows.iter().map(|row| all[*row]).collect();
    let grid = Grid { times: pick(&case.grid.times), inputs: pick(&case.grid.inputs) };
    let case = case.on(grid)?.wanting(Wanted::of(&[Stage::Positions]));
    let mut found = vec![(Vec::new(), Vec::new()); rows.len()];
    AssurSolver.each(&case, &mut |row, state| {
        found[row] = (state.motions.to_vec(), state.angles.to_vec());
        Ok(())
    })?;
    Ok(found)
}

/// The quantities of the claims with their derivatives by the keys, at the rows.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a case that [`CaseNumbers::lifted`] refuses, and for a law by table if the instants
/// keep their inputs. [`ErrorKind::Geometry`] for a singular pose, and if the input stands still.
pub(super) fn derived(
    case: &Case,
    slopes: &CaseSlopes,
    keys: &[usize],
    claims: &[Claim],
    rows: &[usize],
    by_input: bool,
) -> Result<Derived> {
    let unsupported = |message: &str| Error::new(ErrorKind::Unsupported, message).help(sentences::COMPARE_WITH_A_SWEEP);
    let mut quantities: Vec<Quantity> = claims.iter().filter_map(Quantity::of).collect();
    let mut found = Derived {
        places: rows.iter().enumerate().map(|(place, row)| (*row, place)).collect(),
        rows: vec![vec![Sloped::default(); claims.len()]; rows.len()],
        turns: quantities.iter().map(|own| own.turn).collect(),
        times: rows.iter().map(|row| case.grid.times[*row]).collect(),
        time_slopes: vec![Vec::new(); rows.len()],
    };
    // A case that the dual numbers do not support is refused here, before side 1 solves it.
    CaseNumbers::<f64>::of(case).map_err(|error| unsupported(&sentences::no_sensitivities(&error.message())))?;
    let poses = poses(case, rows)?;
    for part in keys.chunks(WIDTH) {
        let lift = |number: CaseNumber, value: f64| {
            let by = slopes.numbers.get(&number).map(|own| &own.by);
            let slope = |k: usize| Some(*by?.get(part.get(k)?)?);
            Dual::<f64, WIDTH> { value, slopes: std::array::from_fn(|k| slope(k).unwrap_or(0.0)) }
        };
        let table = |load: usize, index: usize| -> Vec<(Dual<f64, WIDTH>, Course)> {
            let own = slopes.tables.get(&(load, index)).into_iter().flatten();
            let seed = |(key, course): &(usize, Course)| {
                let place = part.iter().position(|own| own == key)?;
                let slopes = std::array::from_fn(|k| f64::from(k == place));
                Some((Dual { value: 0.0, slopes }, course.clone()))
            };
            own.filter_map(seed).collect()
        };
        let numbers = CaseNumbers::lifted(case, &lift, &table)?;
        let whole = Whole::new(case, &numbers);
        if by_input && !whole.can_keep_input() {
            return Err(unsupported(sentences::A_LAW_BY_TABLE_KEEPS_NO_INPUT));
        }
        let readings = Readings::of(whole);
        for (place, row) in rows.iter().enumerate() {
            let (motions, angles) = &poses[place];
            let state = whole.near(motions, angles, case.grid.times[*row], by_input).ok_or_else(|| {
                Error::new(ErrorKind::Geometry, sentences::NO_DERIVATIVE_IN_THIS_POSE)
                    .at_input(case.told(case.grid.inputs[*row]))
                    .help(sentences::TAKE_ANOTHER_INSTANT)
            })?;
            found.time_slopes[place].extend(&state.time.slopes[..part.len()]);
            for (own, quantity) in found.rows[place].iter_mut().zip(&mut quantities) {
                let value = quantity.at(&readings, &state);
                own.value = value.value;
                own.slopes.extend(&value.slopes[..part.len()]);
            }
        }
    }
    Ok(found)
}
