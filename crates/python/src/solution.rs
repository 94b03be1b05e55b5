//! Trajectories as tables for Python.

use std::sync::Arc;

use linkproof::parts::{Error, Trajectory};
use prover::run::memory;
use pyo3::prelude::*;

use crate::scenario_class::Scenario;
use crate::sentences;
use crate::table::{Table, TableColumn};
use crate::task::released;

/// Name of the column of times.
const TIME: &str = "t_s";

/// The motion of a mechanism: a mapping from names to arrays, with one row per instant.
///
/// The names are those in the CSV file of `linkproof solve`, units included: `t_s`, `crank_rad` (or `joint_rad`,
/// `slide_m`), then the channels, such as `link.crank.angle_rad`. Every array has the shape (rows,) and the type
/// float64. An array shares the memory of the solution and is read-only; `array.copy()` gives a writable copy.
/// `units` contains the unit of every column.
#[pyclass(module = "linkproof", extends = Table, frozen)]
pub(crate) struct Solution {
    input: &'static str,
}

impl Solution {
    /// The columns of the trajectory become the columns of the table without a copy.
    pub(crate) fn of(py: Python<'_>, trajectory: Trajectory) -> PyResult<Py<Solution>> {
        let input = trajectory.input();
        let own = [(TIME.to_string(), "s"), (input.key().to_string(), input.unit())];
        let channels = trajectory.channels().iter().map(|channel| (channel.to_string(), channel.kind.unit.symbol()));
        let names: Vec<_> = own.into_iter().chain(channels).collect();
        let columns = names.into_iter().zip(trajectory.into_columns());
        let column = |((name, unit), values)| TableColumn::numbers(name, unit, values);
        let table = Table::of(columns.map(column).collect());
        Py::new(py, (Solution { input: input.key() }, table))
    }
}

#[pymethods]
impl Solution {
    /// Times of the rows: shape (rows,), in s.
    #[getter]
    fn time<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.get_item(TIME)
    }

    /// Values of the input, shape (rows,): crank angle in rad, angle of the driven joint in rad, or slide of the driven
    /// joint in m.
    #[getter]
    fn input<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.get_item(slf.get().input)
    }

    /// Name of the column of the input: `crank_rad`, `joint_rad` or `slide_m`.
    #[getter]
    fn input_name(&self) -> &'static str {
        self.input
    }

    fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
        let rows: usize = slf.getattr("rows")?.extract()?;
        Ok(sentences::a_solution_of(&rows, &(slf.len()? - 2)))
    }
}

#[pymethods]
impl Scenario {
    /// Solve the scenario analytically. The result is accurate to rounding error; in a free motion, to integration
    /// error.
    ///
    /// Returns a `Solution`: an array of the shape (rows,) for every name. The name ends with the unit of the array.
    /// The numbers equal those of `linkproof solve`, bit by bit. Other Python threads can run during the computation.
    fn solve(&self, py: Python<'_>) -> PyResult<Py<Solution>> {
        let own = self.inner.clone();
        let trajectory = released(py, move || solved(&own))?;
        Solution::of(py, trajectory)
    }
}

/// The motion computed by analytic side 1.
fn solved(scenario: &Arc<linkproof::Scenario>) -> Result<Trajectory, Error> {
    let case = scenario.case.scene()?.case;
    memory::check(&case, memory::of_solution(&case, 1), None)?;
    linkproof::solve(&scenario.case)
}
