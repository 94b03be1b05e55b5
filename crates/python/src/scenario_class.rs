//! The class `Scenario`: reading, changing, solving, proving.

use std::path::PathBuf;
use std::sync::Arc;

use linkage::case::Grid;
use linkproof::parts::{Channel, Error};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use scenario::StartRequest;
use scenario::grid::listed;
use scenario::source::text_of;
use scenario::templates::{TEMPLATES, named};

use crate::errors::{OrRaised, argument};
use crate::sentences;
use crate::task::released;

/// Instants that replace the grid of the file: their values, and the function that makes a grid of them.
#[derive(Clone)]
struct Instants {
    key: &'static str,
    values: Vec<f64>,
    grid: fn(&linkage::drive::Drive, Vec<f64>) -> Grid,
}

/// Name of the argument that gives the instants as inputs.
const INPUT: &str = "input";

/// The changes that were requested of a scenario.
#[derive(Clone, Default)]
struct Changes {
    start: StartRequest,
    instants: Option<Instants>,
    only: Vec<String>,
}

/// A mechanism with its drive, loads and requested channels.
///
/// Scenarios are immutable: every method that changes something returns a new scenario.
#[pyclass(module = "linkproof", frozen)]
#[derive(Clone)]
pub(crate) struct Scenario {
    pub(crate) inner: Arc<linkproof::Scenario>,
    /// The scenario before the changes, if it was built in code and thus has no text to read again.
    built: Option<Arc<linkproof::Scenario>>,
    changes: Changes,
}

impl Scenario {
    /// A mechanism that was built in code.
    pub(crate) fn of_built(inner: linkproof::Scenario) -> Scenario {
        let inner = Arc::new(inner);
        Scenario { built: Some(inner.clone()), inner, changes: Changes::default() }
    }

    fn of_text(text: &str, path: PathBuf, changes: Changes) -> Result<Scenario, Error> {
        let request = StartRequest { without_grid: changes.instants.is_some(), ..changes.start.clone() };
        let scenario = linkproof::Scenario::parse_as(text, path, &request)?;
        Ok(Scenario { inner: Arc::new(changes.applied(scenario)?), built: None, changes })
    }

    /// The requested start, for work that reads the text of the file again.
    ///
    /// # Errors
    /// [`ErrorKind::Input`](linkproof::parts::ErrorKind::Input) for a mechanism that was built in code.
    pub(crate) fn request(&self) -> Result<StartRequest, Error> {
        if self.built.is_some() {
            let message = sentences::the_scenario_was_built_in_code(&self.inner.name);
            return Err(argument("scenario", message, sentences::BUILD_IT_AGAIN_OR_READ_IT_FROM_A_FILE));
        }
        Ok(StartRequest { without_grid: self.changes.instants.is_some(), ..self.changes.start.clone() })
    }

    /// Whether the instants of [`Scenario::at`] are inputs and not times; `None` for the grid of the file.
    pub(crate) fn is_by_input(&self) -> Option<bool> {
        self.changes.instants.as_ref().map(|own| own.key == INPUT)
    }

    /// This scenario with `changes` in place of its present changes.
    fn with(&self, changes: Changes) -> Result<Scenario, Error> {
        match &self.built {
            None => Scenario::of_text(&self.inner.text, self.inner.path.clone(), changes),
            Some(_) if changes.start != StartRequest::default() => {
                let message = sentences::the_scenario_was_built_in_code(&self.inner.name);
                Err(argument("set", message, sentences::BUILD_IT_AGAIN_OR_READ_IT_FROM_A_FILE))
            }
            Some(built) => {
                let inner = Arc::new(changes.applied((**built).clone())?);
                Ok(Scenario { inner, built: Some(built.clone()), changes })
            }
        }
    }
}

impl Changes {
    fn applied(&self, mut scenario: linkproof::Scenario) -> Result<linkproof::Scenario, Error> {
        if let Some(Instants { key, values, grid }) = &self.instants {
            let crank = scenario.case.crank();
            let refused = |message: String| argument(key, message, sentences::GIVE_EVERY_INSTANT_ONCE);
            let grid = grid(crank, listed(values.clone()).map_err(refused)?);
            grid.check(&scenario.case.drives).map_err(refused)?;
            scenario.case = scenario.case.on(grid)?;
        }
        if self.only.is_empty() { Ok(scenario) } else { scenario.only(&self.only).map_err(|error| error.key("only")) }
    }
}

#[pymethods]
impl Scenario {
    /// Read a scenario file.
    #[staticmethod]
    #[pyo3(signature = (path, /))]
    fn from_file(py: Python<'_>, path: PathBuf) -> PyResult<Scenario> {
        released(py, move || Scenario::of_text(&text_of(&path)?, path, Changes::default()))
    }

    /// Read a scenario from its text. Files named in the text are searched for in the directory of `path`.
    #[staticmethod]
    #[pyo3(signature = (text, /, path=PathBuf::from("<text>")))]
    fn from_text(py: Python<'_>, text: String, path: PathBuf) -> PyResult<Scenario> {
        released(py, move || Scenario::of_text(&text, path, Changes::default()))
    }

    /// A scenario from a template, as `linkproof new` writes it; `linkproof.templates()` lists them.
    ///
    /// Each dimension is in the unit of its key, such as `crank_mm=40`.
    #[staticmethod]
    #[pyo3(signature = (template="four-bar", /, **dimensions))]
    fn new(py: Python<'_>, template: &str, dimensions: Option<Bound<'_, PyDict>>) -> PyResult<Scenario> {
        let given = numbers(dimensions)?;
        let template = named(template).or_raised(py)?;
        let text = template.scenario(&template.scenario_name(), &given).or_raised(py)?;
        let path = PathBuf::from(template.scenario_name()).with_extension("toml");
        released(py, move || Scenario::of_text(&text, path, Changes::default()))
    }

    /// This scenario with other numbers, given by their keys in `[parameters]`, such as `crank_mm=40`, or by their
    /// paths in the file, such as `{"links.crank.mass_kg": 2.5}`.
    ///
    /// Each number is in the unit of its key. Published numbers of the file are left out, because they hold only for
    /// the parameters in the file.
    #[pyo3(signature = (parameters=None, /, **more))]
    fn set(
        &self,
        py: Python<'_>,
        parameters: Option<Bound<'_, PyDict>>,
        more: Option<Bound<'_, PyDict>>,
    ) -> PyResult<Scenario> {
        let mut changes = self.changes.clone();
        for (key, value) in numbers(parameters)?.into_iter().chain(numbers(more)?) {
            changes.start.set.retain(|(own, _)| *own != key);
            changes.start.set.push((key, value));
        }
        self.with(changes).or_raised(py)
    }

    /// This scenario with only the channels that the words select; other quantities are not computed.
    ///
    /// A word is a stage ("positions"), a subject ("point.P"), a subject's stage ("point.P.positions") or a channel
    /// ("joint.B.fx_N").
    #[pyo3(signature = (*words))]
    fn only(&self, py: Python<'_>, words: Vec<String>) -> PyResult<Scenario> {
        self.with(Changes { only: words, ..self.changes.clone() }).or_raised(py)
    }

    /// This scenario with other instants, which replace the grid of the file.
    ///
    /// `input`: sequence of crank angles or joint angles in rad, or of slides in m.
    /// `time`: sequence of times in s.
    /// Give either `input` or `time`.
    #[pyo3(signature = (*, input=None, time=None))]
    fn at(
        &self,
        py: Python<'_>,
        input: Option<Bound<'_, PyAny>>,
        time: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Scenario> {
        let floats = |values: Bound<'_, PyAny>| -> PyResult<Vec<f64>> {
            values.try_iter()?.map(|value| value?.extract()).collect()
        };
        let instants = match (input, time) {
            (Some(values), None) => Instants { key: INPUT, values: floats(values)?, grid: Grid::of_inputs },
            (None, Some(values)) => Instants { key: "time", values: floats(values)?, grid: Grid::of_times },
            (Some(_), Some(_)) | (None, None) => {
                let error = argument(INPUT, sentences::INSTANTS_ARE_INPUTS_OR_TIMES, sentences::GIVE_ONE_OF_THE_TWO);
                return Err(error).or_raised(py);
            }
        };
        self.with(Changes { instants: Some(instants), ..self.changes.clone() }).or_raised(py)
    }

    /// This scenario with another start.
    ///
    /// `modes`: assembly modes of groups as "LINK,LINK=MODE".
    /// `input`: crank angle or joint angle in rad, or slide in m, at t = 0.
    #[pyo3(signature = (*modes, input=None))]
    fn start(&self, py: Python<'_>, modes: Vec<String>, input: Option<f64>) -> PyResult<Scenario> {
        let mut changes = self.changes.clone();
        changes.start.modes.extend(modes);
        changes.start.crank = input.or(changes.start.crank);
        self.with(changes).or_raised(py)
    }

    /// Name of the scenario. The names of output files are made from it.
    #[getter]
    fn name(&self) -> &str {
        &self.inner.name
    }

    /// Title in one line.
    #[getter]
    fn title(&self) -> &str {
        &self.inner.title
    }

    /// Path of the file, as it was given.
    #[getter]
    fn path(&self) -> String {
        self.inner.path.display().to_string()
    }

    /// Text of the file, without later changes by `set`, `start` and `at`; empty for a mechanism that was built in code.
    #[getter]
    fn text(&self) -> &str {
        &self.inner.text
    }

    /// The parameters with their numbers, each in the unit of its key.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let parameters = PyDict::new(py);
        for parameter in &self.inner.formulas.parameters {
            parameters.set_item(&parameter.key, parameter.given)?;
        }
        Ok(parameters)
    }

    /// Names of the requested channels with their units.
    #[getter]
    fn channels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let channels = PyDict::new(py);
        for channel in self.inner.case.channels() {
            channels.set_item(Channel::to_string(&channel), channel.kind.unit.symbol())?;
        }
        Ok(channels)
    }

    /// Names of the links, the ground first.
    #[getter]
    fn links(&self) -> Vec<String> {
        self.inner.case.mechanism.links().iter().map(|link| link.name.clone()).collect()
    }

    /// Names of the joints.
    #[getter]
    fn joints(&self) -> Vec<String> {
        self.inner.case.mechanism.joints().iter().map(|joint| joint.name.clone()).collect()
    }

    /// Formula of structure: the driving links and the groups.
    #[getter]
    fn structure(&self) -> String {
        self.inner.case.structure.formula(&self.inner.case.mechanism)
    }

    fn __repr__(&self) -> String {
        sentences::a_scenario_called(&self.inner.name, &self.inner.title)
    }
}

/// The names and titles of the templates for `Scenario.new`.
#[pyfunction]
pub(crate) fn templates(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let all = PyDict::new(py);
    for template in TEMPLATES {
        all.set_item(template.name, template.title())?;
    }
    Ok(all)
}

/// Numbers by name.
pub(crate) fn numbers(given: Option<Bound<'_, PyDict>>) -> PyResult<Vec<(String, f64)>> {
    given.into_iter().flatten().map(|(key, value)| Ok((key.extract()?, value.extract()?))).collect()
}
