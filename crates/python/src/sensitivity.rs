//! The class `Sensitivity`: exact derivatives of figures, and tolerance stacks.

use std::collections::BTreeMap;

use analytic::range::explained;
use design::draw::tornado;
use design::sensitivity::{FigureSlopes, KeyTolerance, SensitivityQuestion, ToleranceStack, stacks};
use linkproof::parts::Error;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use scenario::{CaseKey, TurnFigure};

use crate::draw::Picture;
use crate::errors::{OrRaised, argument};
use crate::scenario_class::{Scenario, numbers};
use crate::sentences;
use crate::sweep::texts;
use crate::table::{Table, TableColumn};
use crate::task::released;

/// Exact first derivatives of figures with respect to numbers of the file, and tolerance stacks.
#[pyclass(module = "linkproof", frozen)]
pub(crate) struct Sensitivity {
    name: String,
    title: String,
    found: design::sensitivity::Sensitivity,
    tolerances: Vec<KeyTolerance>,
    stacks: Vec<ToleranceStack>,
}

impl Sensitivity {
    /// Figures and keys, in the order of the rows of `derivatives`.
    fn pairs(&self) -> impl Iterator<Item = (&FigureSlopes, usize, &CaseKey)> {
        let keys = &self.found.keys;
        self.found.figures.iter().flat_map(move |own| keys.iter().enumerate().map(move |(key, one)| (own, key, one)))
    }
}

fn known(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

#[pymethods]
impl Sensitivity {
    /// One row for each figure and key, with the columns of the CSV file of `linkproof sensitivity`.
    ///
    /// `derivative` is in `figure_unit` per `unit`; it is missing where the figure has a kink. `relative` is the change
    /// of the figure in per cent for one per cent of the key. `figure_value` is in `figure_unit`; `value` and
    /// `tolerance` are in `unit`.
    #[getter]
    fn derivatives(&self) -> Table {
        let texts = |name: &str, of: fn(&FigureSlopes, &CaseKey) -> String| {
            TableColumn::texts(name, self.pairs().map(|(own, _, key)| of(own, key)).collect())
        };
        let numbers = |name: &str, of: &dyn Fn(&FigureSlopes, usize, &CaseKey) -> Option<f64>| {
            TableColumn::perhaps(name, "", self.pairs().map(|(own, key, one)| of(own, key, one)).collect())
        };
        let limit = |key: &CaseKey| self.tolerances.iter().find(|own| own.key == key.name).map(|own| own.limit);
        Table::of(vec![
            texts("figure", |own, _| own.figure.to_string()),
            numbers("figure_value", &|own, _, _| known(own.sampled.value)),
            texts("figure_unit", |own, _| own.unit.clone()),
            texts("key", |_, key| key.name.clone()),
            numbers("value", &|_, _, key| known(key.value)),
            texts("unit", |_, key| key.unit.into()),
            numbers("derivative", &|own, key, _| known(own.by[key])),
            numbers("relative", &|own, key, _| own.relative(&self.found.keys, key).and_then(known)),
            numbers("tolerance", &|_, _, key| limit(key)),
        ])
    }

    /// One row for each figure. The columns are its value in the unit of the row, the instants that determine the
    /// value, another instant with an equal extreme, and whether the figure has a kink ("yes" or "no").
    #[getter]
    fn figures(&self) -> Table {
        let all = &self.found.figures;
        let texts =
            |name: &str, of: fn(&FigureSlopes) -> String| TableColumn::texts(name, all.iter().map(of).collect());
        Table::of(vec![
            texts("figure", |own| own.figure.to_string()),
            TableColumn::perhaps("value", "", all.iter().map(|own| known(own.sampled.value)).collect()),
            texts("unit", |own| own.unit.clone()),
            texts("instants", |own| own.instants.join(", ")),
            TableColumn::perhaps_texts("equal_extreme", all.iter().map(|own| own.rival.clone()).collect()),
            texts("kink", |own| if own.has_kink { "yes" } else { "no" }.into()),
        ])
    }

    /// One row for each figure: its tolerance stack, in the unit of the row. The table has no rows if no tolerances are
    /// given.
    ///
    /// `worst`: sum of the absolute values of derivative times tolerance.
    /// `root_sum_square`: root of the sum of the squares of derivative times tolerance.
    /// `linear_deviation`: standard deviation by linear theory.
    /// `sampled_deviation`: standard deviation of the sample.
    /// `sampled_shift`, `sampled_least`, `sampled_most`: mean, smallest and largest value of the sample, each minus the
    /// nominal value.
    /// `unsolved`: number of samples without a solution.
    /// `multiple`: end of the range in which linear theory holds, as a factor on all tolerances.
    /// `linear`: the reason for this end.
    /// With "from", linear theory fails from this factor on.
    /// With "until_unsolved", a random mechanism cannot be solved at this factor.
    /// With "beyond", linear theory holds up to this factor, which is the largest that is tried.
    #[getter]
    fn stacks(&self) -> Table {
        let all = || self.found.figures.iter().zip(&self.stacks);
        let numbers = |name: &str, of: fn(&ToleranceStack) -> f64| {
            TableColumn::numbers(name, "", self.stacks.iter().map(of).collect())
        };
        Table::of(vec![
            TableColumn::texts("figure", all().map(|(own, _)| own.figure.to_string()).collect()),
            TableColumn::texts("unit", all().map(|(own, _)| own.unit.clone()).collect()),
            numbers("worst", |own| own.worst),
            numbers("root_sum_square", |own| own.root_sum_square),
            numbers("linear_deviation", |own| own.linear_deviation),
            numbers("sampled_deviation", |own| own.sampled_deviation),
            numbers("sampled_shift", |own| own.sampled_shift),
            numbers("sampled_least", |own| own.sampled_ends[0]),
            numbers("sampled_most", |own| own.sampled_ends[1]),
            TableColumn::whole("unsolved", self.stacks.iter().map(|own| own.unsolved as i64).collect()),
            TableColumn::texts("linear", self.stacks.iter().map(|own| own.limit.named().0.into()).collect()),
            TableColumn::numbers("multiple", "", self.stacks.iter().map(|own| own.limit.named().1).collect()),
        ])
    }

    /// Default keys that were left out, each with the part of the file whose derivative with respect to this key is not
    /// known.
    #[getter]
    fn left_out(&self) -> BTreeMap<String, String> {
        self.found.left_out.iter().cloned().collect()
    }

    /// The tornado diagrams: the keys or tolerances with the largest effects on every figure, as an SVG picture.
    fn draw(&self) -> Picture {
        Picture::of_svg(tornado(&self.found, &self.tolerances, &self.title).svg(), &self.name)
    }

    fn __repr__(&self) -> String {
        sentences::a_sensitivity_of(&self.name, &self.found.figures.len(), &self.found.keys.len())
    }

    fn _repr_html_(&self) -> String {
        self.figures().html() + &self.draw().html()
    }
}

#[pymethods]
impl Scenario {
    /// Differentiate figures with respect to numbers of the file, and stack tolerances. The derivatives are exact, not
    /// difference quotients.
    ///
    /// `figures`: statistics of quantities, such as "max:joint.A.f_N" or "rms:drive.torque_N_m".
    /// `by`: keys, such as "crank_mm" or "links.crank.mass_kg".
    /// By default, the keys are the parameters that the mechanism uses.
    /// For a mechanism without parameters, the keys are its dimensions, masses, laws and loads.
    /// `tolerances`: a dictionary from keys to the largest deviation in either sense, in the unit of the key.
    /// `samples`: number of random mechanisms within the tolerances, from 10 to 100000.
    /// `seed`: seed of the samples.
    #[pyo3(signature = (figures, by=None, *, tolerances=None, samples=300, seed=1))]
    fn sensitivity(
        &self,
        py: Python<'_>,
        figures: &Bound<'_, PyAny>,
        by: Option<Bound<'_, PyAny>>,
        tolerances: Option<Bound<'_, PyDict>>,
        samples: usize,
        seed: u64,
    ) -> PyResult<Sensitivity> {
        let figure = |text: String| text.parse::<TurnFigure>().map_err(|error| error.key("figures"));
        let figures = texts(figures)?.into_iter().map(figure).collect::<Result<Vec<_>, _>>().or_raised(py)?;
        let keys = by.map_or_else(|| Ok(Vec::new()), |by| texts(&by))?;
        // The tolerances keep the order of the dictionary, because the sample is drawn in this order.
        let tolerances: Vec<KeyTolerance> =
            numbers(tolerances)?.into_iter().map(|(key, limit)| KeyTolerance { key, limit }).collect();
        if let Some(own) = tolerances.iter().find(|own| !(own.limit > 0.0)) {
            let message = sentences::the_tolerance_is_not_above_zero(&own.key, &own.limit);
            return Err(argument("tolerances", message, sentences::GIVE_A_NUMBER_ABOVE_ZERO)).or_raised(py);
        }
        if !(10..=100_000).contains(&samples) {
            let message = sentences::A_SAMPLE_IS_TOO_SMALL_OR_LARGE;
            return Err(argument("samples", message, sentences::GIVE_MORE_OR_FEWER_SAMPLES)).or_raised(py);
        }
        let question = SensitivityQuestion {
            figures,
            keys,
            also: tolerances.iter().map(|own| own.key.clone()).collect(),
            asked: self.request().or_raised(py)?,
            by_input: self.is_by_input(),
        };
        let scenario = self.inner.clone();
        released(py, move || solved(&scenario, &question, tolerances, (samples, seed)))
    }
}

fn solved(
    scenario: &linkproof::Scenario,
    question: &SensitivityQuestion,
    tolerances: Vec<KeyTolerance>,
    sample: (usize, u64),
) -> Result<Sensitivity, Error> {
    let found = design::sensitivity::sensitivity(scenario, question).map_err(|own| explained(&scenario.case, own))?;
    let stacks = match tolerances.is_empty() {
        true => Vec::new(),
        false => stacks(scenario, question, &found, &tolerances, sample)?,
    };
    Ok(Sensitivity { name: scenario.name.clone(), title: scenario.title.clone(), found, tolerances, stacks })
}
