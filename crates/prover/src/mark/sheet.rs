//! The right answers for one student.

use crate::sentences;

use super::question::AskedColumn;
use analytic::{AssurSolver, NewtonSolver};
use linkage::case::{Case, Grid};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{KeepNan, largest_size};
use linkage::solver::{Solver, State};
use linkage::trajectory::{Channel, Trajectory};

/// Largest allowed difference between the two analytic sides, as a fraction of the column's largest value.
const AGREE: f64 = 1e-8;
/// Smallest number of decimals of an angle in degrees, and in radians.
const ANGLES: [i32; 2] = [1, 3];

/// The right answers for one student, by position of the crank and by quantity.
pub struct AnswerSheet {
    /// The case, on the grid of the positions.
    pub case: Case,
    /// The requested quantities.
    pub columns: Vec<AskedColumn>,
    /// The right answers in the printed units: position by position, quantity by quantity.
    pub right: Vec<Vec<f64>>,
    /// Requested number of decimals of each quantity. With these decimals, the largest value has at least the requested
    /// number of significant digits.
    pub decimals: Vec<i32>,
    /// The state of the mechanism at each position.
    pub(super) states: Vec<State>,
}

/// A table by position and quantity.
pub(super) type AnswerTable = Vec<Vec<f64>>;

impl AnswerSheet {
    /// Solves the case with both analytic sides at the `positions` of the input (SI).
    /// `digits` is the requested number of significant digits in the largest value of each quantity.
    ///
    /// # Errors
    /// The errors of the sides; [`ErrorKind::Numeric`] if the sides disagree, or if an answer is missing.
    pub fn of(case: &Case, columns: Vec<AskedColumn>, positions: &[f64], digits: usize) -> Result<AnswerSheet> {
        let channels: Vec<Channel> = columns.iter().flat_map(|own| own.channels.clone()).collect();
        let case = case.on(Grid::of_inputs(case.crank(), positions.to_vec()))?.wanting_only(&case.all_channels());
        let [right, other] = [&AssurSolver as &dyn Solver, &NewtonSolver].map(|side| -> Result<AnswerTable> {
            let solved = side.solve(&case.wanting_only(&channels))?;
            table_of(&columns, &solved).ok_or_else(|| Error::new(ErrorKind::Numeric, sentences::AN_ANSWER_IS_MISSING))
        });
        let (right, other) = (right?, other?);
        for (place, column) in columns.iter().enumerate() {
            let values: Vec<f64> = right.iter().map(|row| row[place]).collect();
            let gap = |(one, other): (&Vec<f64>, &Vec<f64>)| column.gap(one[place], other[place]);
            let largest = right.iter().zip(&other).map(gap).fold(0.0, |most: f64, gap| most.larger(gap.abs()));
            if !(largest <= AGREE * largest_size(&values).larger(1e-6)) {
                let message = sentences::the_sides_disagree_in(&column.name, &format_args!("{largest:.1e}"));
                return Err(Error::new(ErrorKind::Numeric, message).help(sentences::PROVE_THE_SCENARIO_FIRST));
            }
        }
        let mut states: Vec<Option<State>> = vec![None; positions.len()];
        AssurSolver.each(&case, &mut |row, state| {
            states[row] = Some(state.clone());
            Ok(())
        })?;
        let states = states.into_iter().flatten().collect();
        let decimals = (0..columns.len()).map(|place| decimals(&columns[place], place, &right, digits)).collect();
        Ok(AnswerSheet { case, columns, right, decimals, states })
    }

    /// The positions of the input (SI).
    #[must_use]
    pub fn positions(&self) -> &[f64] {
        &self.case.grid.inputs
    }

    /// Half a unit of the last requested decimal of a quantity.
    #[must_use]
    pub fn half_unit(&self, column: usize) -> f64 {
        // The margin covers the rounding of decimal numbers to binary numbers.
        0.5 * 10f64.powi(-self.decimals[column]) * (1.0 + 1e-9)
    }

    /// The answers to the questions of this sheet for another case, at `positions` of the other case's input (SI).
    /// `None` if the case cannot be solved at these positions.
    pub(super) fn answers_of(&self, case: &Case, positions: Vec<f64>) -> Option<AnswerTable> {
        let channels: Vec<Channel> = self.columns.iter().flat_map(|own| own.channels.clone()).collect();
        let case = case.on(Grid::of_inputs(case.crank(), positions)).ok()?.wanting_only(&channels);
        table_of(&self.columns, &AssurSolver.solve(&case).ok()?)
    }
}

impl AskedColumn {
    /// The difference `one - other`; whole turns of an angle are removed.
    pub(super) fn gap(&self, one: f64, other: f64) -> f64 {
        let gap = one - other;
        self.turn.map_or(gap, |turn| gap - turn * (gap / turn).round())
    }
}

fn table_of(columns: &[AskedColumn], solved: &Trajectory) -> Option<AnswerTable> {
    let values: Option<Vec<Vec<f64>>> = columns.iter().map(|column| column.values(solved)).collect();
    let values = values?;
    Some((0..solved.times().len()).map(|row| values.iter().map(|own| own[row]).collect()).collect())
}

fn decimals(column: &AskedColumn, place: usize, right: &AnswerTable, digits: usize) -> i32 {
    let largest = right.iter().fold(0.0, |most: f64, row| most.larger(row[place].abs()));
    // If all values are zero up to rounding, the number of decimals is chosen as for the value 1.
    let order = if largest > 1e-9 { largest.log10().floor() as i32 } else { 0 };
    let own = digits as i32 - 1 - order;
    match column.turn {
        Some(360.0) => own.max(ANGLES[0]),
        Some(_) => own.max(ANGLES[1]),
        None => own.max(0),
    }
}
