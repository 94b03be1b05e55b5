//! The class `Sweep`: what a sweep has written, as tables.

use linkproof::parts::Error;
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict};
use scenario::words::choice;
use sweep::{FigureSpread, Goal, REFUSED, RowGroup, SOLVED, Shard, SweepGroups, SweepPlan, SweepRow, SweepStore};
use sweep::{SweepSummary, SweepTally};

use crate::errors::{OrRaised, argument};
use crate::table::{Table, TableColumn, streamed};
use crate::task::released;
use crate::{html, sentences};

/// The cases of a sweep, stored in a directory.
///
/// The table has the columns `case`, the varied numbers by their keys, the figures by their names, `state` ("solved" or
/// "refused"), `reason`, and `proof` if cases are proven. The name of a number ends with its unit.
/// Data frames read the table part by part by `__arrow_c_stream__`, so that memory stays small.
/// `table()` returns the whole table as NumPy arrays.
#[pyclass(module = "linkproof", frozen, weakref)]
pub(crate) struct Sweep {
    pub(crate) plan: SweepPlan,
    pub(crate) store: SweepStore,
    pub(crate) shard: Shard,
    pub(crate) tally: SweepTally,
}

/// The rows of a part of the table; `first` is the index of its first case.
fn rows(plan: &SweepPlan, first: u64, group: RowGroup) -> Table {
    let known = |value: f64| (!value.is_nan()).then_some(value);
    let axes = plan.design.axes().len();
    let states = group.reasons.iter().map(|reason| if reason.is_none() { SOLVED } else { REFUSED }.into()).collect();
    let mut columns = vec![TableColumn::whole("case", (first as i64..).take(group.reasons.len()).collect())];
    let numbers = plan.columns().zip(group.values.into_iter().chain(group.figures)).enumerate();
    columns.extend(numbers.map(|(index, ((name, unit), values))| match index < axes {
        true => TableColumn::numbers(name, unit, values),
        false => TableColumn::perhaps(name, unit, values.into_iter().map(known).collect()),
    }));
    columns.push(TableColumn::texts("state", states));
    columns.push(TableColumn::perhaps_texts("reason", group.reasons));
    if plan.prove_every.is_some() {
        columns.push(TableColumn::perhaps_texts("proof", group.verdicts));
    }
    Table::of(columns)
}

/// An empty part of the table: all columns, but no rows.
fn nothing(plan: &SweepPlan) -> RowGroup {
    let columns = |count: usize| vec![Vec::new(); count];
    let (values, figures) = (columns(plan.design.axes().len()), columns(plan.figures.len()));
    RowGroup { values, figures, reasons: Vec::new(), verdicts: Vec::new() }
}

/// The whole table in memory.
fn whole(plan: &SweepPlan, groups: SweepGroups) -> Result<Table, Error> {
    let mut all = nothing(plan);
    for group in groups {
        let group = group?;
        all.values.iter_mut().zip(group.values).for_each(|(to, from)| to.extend(from));
        all.figures.iter_mut().zip(group.figures).for_each(|(to, from)| to.extend(from));
        all.reasons.extend(group.reasons);
        all.verdicts.extend(group.verdicts);
    }
    Ok(rows(plan, 0, all))
}

impl Sweep {
    /// An error if some cases are not solved yet, or the parts are not joined.
    fn complete(&self) -> Result<(), Error> {
        if self.store.is_complete() {
            return Ok(());
        }
        let help = sentences::solve_the_other_cases(&self.store.directory().display());
        Err(argument("shard", sentences::THE_TABLE_IS_NOT_JOINED, help))
    }

    fn groups(&self) -> Result<SweepGroups, Error> {
        self.complete()?;
        SweepGroups::of(&self.plan, &self.store.table())
    }

    /// The summary of the figures, made in one pass over the table.
    fn summary(&self, py: Python<'_>, goal: Goal) -> PyResult<SweepSummary> {
        self.complete().or_raised(py)?;
        let (plan, table) = (self.plan.clone(), self.store.table());
        released(py, move || SweepSummary::of(&plan, &table, goal))
    }
}

/// A notebook shows the spread of the figures only if the sweep has at most this number of cases.
const SHOWN: u64 = 1_000_000;

#[pymethods]
impl Sweep {
    /// Path of the directory with the results.
    #[getter]
    fn directory(&self) -> String {
        self.store.directory().display().to_string()
    }

    /// Path of the table, a Parquet file with one row for each case.
    #[getter]
    fn path(&self, py: Python<'_>) -> PyResult<String> {
        self.complete().or_raised(py)?;
        Ok(self.store.table().display().to_string())
    }

    /// Whether all cases are solved and joined to one table.
    #[getter]
    fn is_complete(&self) -> bool {
        self.store.is_complete()
    }

    /// Number of cases of the whole sweep.
    #[getter]
    fn cases(&self) -> u64 {
        self.plan.design.cases()
    }

    /// Number of parts of the whole sweep: the cases of a part are stored together.
    #[getter]
    fn parts(&self) -> u64 {
        self.plan.parts()
    }

    /// Paths of the files with the parts of this share of the cases. The files exist until they are joined.
    #[getter]
    fn part_files(&self) -> Vec<String> {
        self.shard.parts(&self.plan).map(|part| self.store.part(part).display().to_string()).collect()
    }

    /// Numbers of cases: `solved` and `refused` in this call, and `stored` by an earlier call.
    #[getter]
    fn counts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let counts = PyDict::new(py);
        let tally = &self.tally;
        for (name, count) in [("solved", tally.solved), ("refused", tally.refused), ("stored", tally.stored)] {
            counts.set_item(name, count)?;
        }
        Ok(counts)
    }

    /// Unit of every varied number and figure; "" for a number without a unit.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let units = PyDict::new(py);
        for (name, unit) in self.plan.columns() {
            units.set_item(name, unit)?;
        }
        Ok(units)
    }

    /// The numbers of a case by their keys, each in the unit of its key: `scenario.set(sweep.setting(17))` is the
    /// case 17.
    #[pyo3(signature = (case, /))]
    fn setting<'py>(&self, py: Python<'py>, case: u64) -> PyResult<Bound<'py, PyDict>> {
        let cases = self.plan.design.cases();
        if case >= cases {
            let error =
                argument("case", sentences::there_is_no_case(&case), sentences::cases_are_counted_from_0(&cases));
            return Err(error).or_raised(py);
        }
        let setting = PyDict::new(py);
        for (key, value) in self.plan.setting_of(case) {
            setting.set_item(key, value)?;
        }
        Ok(setting)
    }

    /// The whole table in memory: a mapping from names to arrays of the shape (cases,).
    ///
    /// A missing figure is NaN. The property `units` has the units.
    fn table(&self, py: Python<'_>) -> PyResult<Table> {
        let (plan, groups) = (self.plan.clone(), self.groups().or_raised(py)?);
        released(py, move || whole(&plan, groups))
    }

    /// One row for each figure: number of cases with a value, smallest and largest value with their cases, mean and
    /// standard deviation.
    ///
    /// `least`, `most`, `mean` and `deviation` are in the unit of the row.
    fn spread(&self, py: Python<'_>) -> PyResult<Table> {
        let all = self.summary(py, Goal::default())?.figures;
        let numbers = |name: &str, of: fn(&FigureSpread) -> f64| {
            TableColumn::perhaps(name, "", all.iter().map(|own| own.as_ref().map(of)).collect())
        };
        let cases = |name: &str, of: fn(&FigureSpread) -> u64| {
            TableColumn::perhaps_whole(name, all.iter().map(|own| own.as_ref().map(|own| of(own) as i64)).collect())
        };
        Ok(Table::of(vec![
            TableColumn::texts("figure", self.plan.figures.iter().map(|own| own.text.clone()).collect()),
            TableColumn::texts("unit", self.plan.units.clone()),
            TableColumn::whole("count", all.iter().map(|own| own.map_or(0, |own| own.count as i64)).collect()),
            numbers("least", |own| own.least.0),
            cases("least_case", |own| own.least.1),
            numbers("most", |own| own.most.0),
            cases("most_case", |own| own.most.1),
            numbers("mean", |own| own.mean),
            numbers("deviation", |own| own.deviation),
        ]))
    }

    /// The ten best cases, the best one first: those with the smallest values of a figure, or with the largest ones.
    ///
    /// `figure`: name of the figure, by default the first figure.
    /// The columns of the table are `case`, the varied numbers and the figures, each in its unit.
    #[pyo3(signature = (figure=None, *, largest=false))]
    fn best(&self, py: Python<'_>, figure: Option<&str>, largest: bool) -> PyResult<Table> {
        let names = || self.plan.figures.iter().map(|own| own.text.as_str());
        let Some(index) = figure.map_or(Some(0), |figure| names().position(|own| own == figure)) else {
            let message = sentences::there_is_no_figure(&figure.unwrap_or_default());
            return Err(argument("figure", message, sentences::it_has(&choice(names(), "\"")))).or_raised(py);
        };
        let best = self.summary(py, Goal { figure: index, is_largest: largest })?.best;
        let mut columns = vec![TableColumn::whole("case", best.iter().map(|row| row.case as i64).collect())];
        for (index, (name, unit)) in self.plan.columns().enumerate() {
            let number = |row: &SweepRow| *row.values.iter().chain(&row.figures).nth(index).unwrap_or(&f64::NAN);
            columns.push(TableColumn::numbers(name, unit, best.iter().map(number).collect()));
        }
        Ok(Table::of(columns))
    }

    /// The reasons for which cases were refused, each with its number of cases. Reasons that differ only in numbers
    /// count as one reason.
    fn reasons(&self, py: Python<'_>) -> PyResult<std::collections::BTreeMap<String, u64>> {
        Ok(self.summary(py, Goal::default())?.reasons.into_values().collect())
    }

    /// Verdicts of the proven cases, each with its number of cases.
    fn verdicts(&self, py: Python<'_>) -> PyResult<std::collections::BTreeMap<String, u64>> {
        Ok(self.summary(py, Goal::default())?.verdicts)
    }

    /// The table as a stream of Arrow, one batch for each part.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyCapsule>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        let (plan, groups) = (self.plan.clone(), self.groups().or_raised(py)?);
        let first = rows(&plan, 0, nothing(&plan));
        let mut done = 0;
        let tables = groups.map(move |group| {
            group.map(|group| {
                let begins = done;
                done += group.reasons.len() as u64;
                rows(&plan, begins, group)
            })
        });
        streamed(py, &first, tables, requested_schema)
    }

    fn __repr__(&self) -> String {
        let state = if self.is_complete() { sentences::COMPLETE } else { sentences::INCOMPLETE };
        let (keys, figures) = (self.plan.design.axes().len(), self.plan.figures.len());
        sentences::a_sweep_of(&self.cases(), &keys, &figures, &state)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        let told = html::paragraph(&self.__repr__());
        // A pass over a long table would delay the display in a notebook.
        let is_short = self.is_complete() && self.cases() <= SHOWN;
        Ok(if is_short { told + &self.spread(py)?.html() } else { told })
    }
}
