//! The class `FormulaCheck`: formulas judged against a mechanism.

use std::sync::Arc;

use linkproof::parts::{Claimed, Error, FormulaQuestion};
use linkproof::{check, check_formula};
use prover::check::{FormulaAtInstant, FormulaOutcome, JudgedFormula};
use prover::run::Reference;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::{OrRaised, argument};
use crate::proof::{margin, reason};
use crate::scenario_class::Scenario;
use crate::table::{Table, TableColumn};
use crate::task::released;
use crate::{html, sentences};

/// The formula to check; `None` for all formulas of the scenario file.
pub(crate) struct Question(Option<FormulaQuestion>);

/// Text of a formula that is given as a text or as an expression of SymPy.
fn text(expression: &Bound<'_, PyAny>) -> PyResult<String> {
    match expression.extract::<String>() {
        Ok(text) => Ok(text),
        Err(_) => expression.py().import("linkproof._sympy")?.call_method1("formula", (expression,))?.extract(),
    }
}

impl Question {
    /// Reads the arguments of `Scenario.check`.
    pub(crate) fn of_python(
        py: Python<'_>,
        expression: Option<Bound<'_, PyAny>>,
        channel: Option<String>,
        steps: Option<Bound<'_, PyDict>>,
        valid: (Option<f64>, Option<f64>),
        error: Option<f64>,
    ) -> PyResult<Question> {
        let (expression, channel) = match (expression, channel) {
            (None, None) => return Ok(Question(None)),
            (Some(expression), Some(channel)) => (expression, channel),
            (Some(_), None) | (None, Some(_)) => {
                let error = argument("channel", sentences::A_FORMULA_NEEDS_A_CHANNEL, sentences::GIVE_BOTH_OR_NEITHER);
                return Err(error).or_raised(py);
            }
        };
        let step = |(name, step): (Bound<'_, PyAny>, Bound<'_, PyAny>)| Ok((name.str()?.extract()?, text(&step)?));
        let steps = steps.into_iter().flatten().map(step).collect::<PyResult<_>>()?;
        let formula = text(&expression)?;
        Ok(Question(Some(FormulaQuestion { formula, channel, steps, valid: [valid.0, valid.1], error })))
    }

    /// Judges the formula.
    pub(crate) fn judge(self, scenario: &Arc<linkproof::Scenario>) -> Result<FormulaCheck, Error> {
        let inner = match &self.0 {
            None => check(scenario)?,
            Some(question) => check_formula(scenario, question)?,
        };
        Ok(FormulaCheck { inner: Arc::new(inner), scenario: scenario.name.clone() })
    }
}

/// Formulas judged against both analytic sides, by value and by derivative.
#[pyclass(module = "linkproof", frozen)]
pub(crate) struct FormulaCheck {
    inner: Arc<Claimed>,
    scenario: String,
}

impl FormulaCheck {
    fn judged(&self) -> Vec<(Reference, &JudgedFormula)> {
        let all = self.inner.judgement.sides.iter();
        all.flat_map(|(side, own)| own.iter().flatten().map(move |judged| (side, judged))).collect()
    }
}

fn word(judged: &JudgedFormula) -> &'static str {
    match judged.outcome() {
        FormulaOutcome::Right => "agree",
        FormulaOutcome::Wrong => "disagree",
        FormulaOutcome::Expected { .. } => "expected",
        FormulaOutcome::Open { .. } => "inconclusive",
    }
}

#[pymethods]
impl FormulaCheck {
    /// The verdict: `agree`, `disagree` or `inconclusive`.
    #[getter]
    fn verdict(&self) -> &'static str {
        self.inner.verdict.word()
    }

    /// Smallest ratio of a bound to the difference that it limits; `None` unless the verdict is `agree`.
    #[getter]
    fn margin(&self) -> Option<f64> {
        margin(&self.inner.verdict)
    }

    /// Reason of any verdict other than `agree`; `None` for `agree`.
    #[getter]
    fn reason(&self) -> Option<String> {
        reason(&self.inner.verdict)
    }

    /// A dictionary from the names of the wrong formulas to the causes of their errors. A cause is `None` if no simple
    /// cause was found.
    #[getter]
    fn causes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let causes = PyDict::new(py);
        for (name, cause) in &self.inner.judgement.causes {
            causes.set_item(name, cause.as_ref().map(ToString::to_string))?;
        }
        Ok(causes)
    }

    /// One row for each side, formula and order of the derivative. The values of a row are those at the worst instant.
    ///
    /// `t_s` is in s, `input` in rad or m. `value`, `mechanism`, `difference` and `bound` are in the unit of the row.
    /// In the rows of a first or second derivative, these four numbers are in this unit per s or per s^2.
    #[getter]
    fn formulas(&self) -> Table {
        let all = self.judged();
        let texts = |name: &str, of: fn(&(Reference, &JudgedFormula)) -> String| {
            TableColumn::texts(name, all.iter().map(of).collect())
        };
        let worst = |name: &str, of: fn(&FormulaAtInstant) -> f64| {
            TableColumn::perhaps(name, "", all.iter().map(|(_, own)| own.worst.as_ref().map(of)).collect())
        };
        Table::of(vec![
            texts("formula", |(_, own)| own.name.clone()),
            texts("channel", |(_, own)| own.claim.clone()),
            texts("unit", |(_, own)| own.unit.into()),
            texts("side", |(side, _)| side.name().into()),
            TableColumn::numbers("derivative", "", all.iter().map(|(_, own)| own.order as f64).collect()),
            texts("verdict", |(_, own)| word(own).into()),
            worst("t_s", |at| at.time),
            worst("input", |at| at.crank),
            worst("value", |at| at.formula),
            worst("mechanism", |at| at.mechanism),
            worst("difference", |at| at.difference),
            worst("bound", |at| at.bound),
        ])
    }

    fn __repr__(&self) -> String {
        sentences::a_check_against(&self.scenario, &self.verdict())
    }

    fn _repr_html_(&self) -> String {
        let mut text = html::verdict(&self.inner.verdict, &self.scenario);
        for (name, cause) in &self.inner.judgement.causes {
            let cause = cause.as_ref().map_or_else(|| sentences::NO_SIMPLE_CAUSE.to_string(), ToString::to_string);
            text += &html::paragraph(&format!("{name}: {cause}"));
        }
        text + &self.formulas().html()
    }
}

#[pymethods]
impl Scenario {
    /// Judge whether a formula equals a channel over the whole motion, by value and by derivative.
    ///
    /// `expression`: a text such as "r*cos(phi)", or an expression of SymPy.
    /// The expression may contain the crank angle `phi` in rad, the time `t` in s, and the parameters of the scenario.
    /// For the parameter `r_mm` of the file, `r_mm` is the number in the file and `r` the value in SI units.
    /// `channel`: the claimed quantity in its unit, such as "link.rocker.angle_deg", or an expression of channels.
    /// `steps`: a dictionary of named formulas that the expression may use.
    /// `valid`: the first and the last crank angle in rad for which the claim holds.
    /// `error`: claimed error in the unit of the channel.
    ///
    /// Without an expression, the formulas of the file are judged.
    #[pyo3(signature = (expression=None, channel=None, *, steps=None, valid=(None, None), error=None))]
    fn check(
        &self,
        py: Python<'_>,
        expression: Option<Bound<'_, PyAny>>,
        channel: Option<String>,
        steps: Option<Bound<'_, PyDict>>,
        valid: (Option<f64>, Option<f64>),
        error: Option<f64>,
    ) -> PyResult<FormulaCheck> {
        let question = Question::of_python(py, expression, channel, steps, valid, error)?;
        let inner = self.inner.clone();
        released(py, move || question.judge(&inner))
    }
}
