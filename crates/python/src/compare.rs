//! The class `Comparison`: a scenario, compared with a table, a file or another scenario.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use columns::TextTable;
use linkproof::parts::{Advice, Allowed, By, ComparedParty, ComparisonRule, Error, Mapped, Mapping, PartyComparison};
use linkproof::parts::{Compared, RowPair, Size};
use linkproof::plain::style::{COLUMNS, Detail, plain};
use linkproof::report::compare::{text, why};
use prover::tables::Held;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::{OrRaised, argument};
use crate::proof::{margin, reason};
use crate::scenario_class::Scenario;
use crate::table::{Table, TableColumn};
use crate::task::released;
use crate::{foreign, html, sentences};

/// Name of the second party in messages if it has no file.
const TABLE: &str = "the table";
/// Name of the argument `map` in messages.
const MAP: &str = "map";

enum Other {
    Scenario(Arc<linkproof::Scenario>),
    Path(PathBuf),
    Table(TextTable),
}

/// The second party, and the rules of the comparison.
pub(crate) struct ComparisonWish {
    other: Other,
    mapping: Mapping,
    rule: ComparisonRule,
}

impl ComparisonWish {
    /// Reads the arguments of `Scenario.compare`. `allowed` contains `absolute`, `relative` and `of_value`.
    pub(crate) fn of_python(
        py: Python<'_>,
        other: Bound<'_, PyAny>,
        map: Option<Bound<'_, PyAny>>,
        allowed: [Option<Bound<'_, PyAny>>; 3],
        by: Option<&str>,
        interpolates: bool,
        only: Vec<String>,
    ) -> PyResult<ComparisonWish> {
        let other = match other.cast::<Scenario>() {
            Ok(scenario) => Other::Scenario(scenario.get().inner.clone()),
            Err(_) => match other.extract::<PathBuf>() {
                Ok(path) => Other::Path(path),
                Err(_) => Other::Table(foreign::taken_over(&other)?),
            },
        };
        let mapping = map.map_or_else(|| Ok(Mapping::default()), |map| mapping(&map, &other))?;
        let by = match by {
            None => None,
            Some("time") => Some(By::Time),
            Some("input") => Some(By::Crank),
            Some(word) => {
                let message = sentences::there_is_no_such_choice(&word);
                return Err(argument("by", message, sentences::ROWS_ARE_MATCHED_BY)).or_raised(py);
            }
        };
        let mut rule = ComparisonRule { by, interpolates, only, ..ComparisonRule::default() };
        rule.allowed.extend(mapping.allowed.iter().cloned());
        let sizes: [fn(f64) -> Size; 3] = [Size::Absolute, Size::Relative, Size::OfValue];
        for (given, kind) in allowed.into_iter().zip(["absolute", "relative", "of_value"].into_iter().zip(sizes)) {
            put(given, kind, &mut rule.allowed)?;
        }
        Ok(ComparisonWish { other, mapping, rule })
    }

    /// Compares the scenario with the other party.
    pub(crate) fn compare(self, scenario: &Arc<linkproof::Scenario>) -> Result<Comparison, Error> {
        let (name, other) = match self.other {
            Other::Scenario(other) => (other.name.clone(), ComparedParty::from((*other).clone())),
            Other::Path(path) => (path.display().to_string(), ComparedParty::table(path, &self.mapping)?),
            Other::Table(table) => (TABLE.into(), Held::of_table(&table, &self.mapping)?.into()),
        };
        let first = ComparedParty::from((**scenario).clone());
        let inner = linkproof::compare([first, other], &self.rule)?;
        Ok(Comparison::of(&inner, [scenario.name.clone(), name]))
    }
}

/// Reads a mapping from a dictionary of channels and columns, or from a mapping file.
fn mapping(map: &Bound<'_, PyAny>, other: &Other) -> PyResult<Mapping> {
    let py = map.py();
    let Ok(lines) = map.cast::<PyDict>() else {
        return Mapping::load(&map.extract::<PathBuf>()?).or_raised(py);
    };
    let mut mapping = Mapping::default();
    for (channel, column) in lines {
        let (channel, column): (String, String) = (channel.extract()?, column.extract()?);
        // In backquotes, a column name with operators, such as `a-b`, is not read as an expression.
        let is_column = match other {
            Other::Table(table) => table.names.contains(&column),
            Other::Scenario(_) | Other::Path(_) => false,
        };
        let quoted = if is_column && !column.contains('`') { format!("`{column}`") } else { column };
        mapping.push(Mapped::parse(&format!("{quoted}={channel}"), MAP).or_raised(py)?);
    }
    Ok(mapping)
}

/// Adds the allowed differences of the argument `name`: one number for all channels, or a number for each channel.
fn put(
    given: Option<Bound<'_, PyAny>>,
    (name, size): (&'static str, fn(f64) -> Size),
    to: &mut Vec<Allowed>,
) -> PyResult<()> {
    let Some(given) = given else { return Ok(()) };
    let py = given.py();
    let mut push = |of: Option<String>, number: f64| {
        if !(number >= 0.0) {
            let message = sentences::this_difference_is_negative(&number);
            return Err(argument(name, message, sentences::GIVE_A_DIFFERENCE_OF_0_OR_MORE)).or_raised(py);
        }
        to.push(Allowed { of, size: size(number) });
        Ok(())
    };
    match given.cast::<PyDict>() {
        Ok(by_channel) => by_channel.iter().try_for_each(|(of, number)| push(Some(of.extract()?), number.extract()?)),
        Err(_) => push(None, given.extract()?),
    }
}

/// Two parties compared channel by channel.
#[pyclass(module = "linkproof", frozen)]
pub(crate) struct Comparison {
    verdict: linkproof::Verdict,
    names: [String; 2],
    channels: Vec<Compared>,
    causes: Vec<(Vec<String>, Option<String>)>,
    report: String,
}

impl Comparison {
    fn of(inner: &PartyComparison, names: [String; 2]) -> Comparison {
        let paths = names.each_ref().map(Path::new);
        let causes = inner.pairs.iter().flat_map(|pair| &pair.causes);
        Comparison {
            report: plain(&text(paths, inner, Detail::Short, Advice::to_string, COLUMNS)),
            verdict: inner.verdict.clone(),
            channels: inner.pairs.iter().flat_map(|pair| &pair.channels).cloned().collect(),
            causes: causes.map(|own| (own.of.clone(), why(own))).collect(),
            names,
        }
    }
}

#[pymethods]
impl Comparison {
    /// The verdict: `agree`, `disagree` or `inconclusive`.
    #[getter]
    fn verdict(&self) -> &'static str {
        self.verdict.word()
    }

    /// Smallest ratio of a bound to the difference that it limits; `None` unless the verdict is `agree`.
    #[getter]
    fn margin(&self) -> Option<f64> {
        margin(&self.verdict)
    }

    /// Reason of any verdict other than `agree`; `None` for `agree`.
    #[getter]
    fn reason(&self) -> Option<String> {
        reason(&self.verdict)
    }

    /// Causes of the differences. Each entry has the affected channels, and a text with the cause. If no cause was
    /// found, the text describes the difference.
    #[getter]
    fn causes(&self) -> Vec<(Vec<String>, Option<String>)> {
        self.causes.clone()
    }

    /// One row per channel: the worst instant, the difference there and its bound.
    ///
    /// `first` is the value of the scenario, `second` is the value of the other party, and `difference` is `second`
    /// minus `first`. These values, `bound`, `rms` and `scale` are in the unit of the row. `t_s` is in s, `input` in
    /// rad or m.
    #[getter]
    fn channels(&self) -> Table {
        let all = &self.channels;
        let worst = |name: &str, unit: &str, of: fn(&RowPair) -> f64| {
            TableColumn::perhaps(name, unit, all.iter().map(|own| own.found.worst.as_ref().map(of)).collect())
        };
        let texts = |name: &str, of: fn(&Compared) -> String| TableColumn::texts(name, all.iter().map(of).collect());
        let numbers =
            |name: &str, of: fn(&Compared) -> f64| TableColumn::numbers(name, "", all.iter().map(of).collect());
        Table::of(vec![
            texts("channel", |own| own.claim.text.clone()),
            texts("unit", |own| own.claim.unit().into()),
            texts("verdict", |own| own.verdict.word().into()),
            worst("t_s", "s", |at| at.time),
            worst("input", "", |at| at.crank),
            worst("first", "", |at| at.values[0]),
            worst("second", "", |at| at.values[1]),
            worst("difference", "", |at| at.difference),
            worst("bound", "", |at| at.bound),
            numbers("rms", |own| own.found.rms),
            numbers("scale", |own| own.scale),
            numbers("judged", |own| own.found.judged as f64),
            numbers("missing", |own| own.found.missing as f64),
            texts("reason", |own| reason(&own.verdict).unwrap_or_default()),
        ])
    }

    /// The report, as the terminal shows it.
    fn report(&self) -> &str {
        &self.report
    }

    fn __repr__(&self) -> String {
        sentences::a_comparison_of(&self.names[0], &self.names[1], &self.verdict.word())
    }

    fn _repr_html_(&self) -> String {
        html::verdict(&self.verdict, &self.names.join(" | ")) + &html::report(&self.report)
    }
}

#[pymethods]
impl Scenario {
    /// Compare another party with this scenario, channel by channel.
    ///
    /// `other`: a data frame, an Arrow table or any object with `__arrow_c_stream__`, a dictionary of columns, a
    /// solution, another scenario, or the path of a CSV or Parquet file. Every column has one number per instant.
    /// `map`: a dictionary, or the path of a mapping file.
    /// The keys of the dictionary are channels or instants ("time_s", "time_ms", "crank_rad", "crank_deg", ...).
    /// The values of the dictionary are columns or arithmetic expressions of columns.
    /// A column named like a channel needs no entry.
    /// `absolute`: allowed difference in the unit of the channel.
    /// `relative`: allowed difference as a fraction of the channel's scale.
    /// `of_value`: allowed difference as a fraction of the reference value in the same row.
    /// Each of these three is one number for all channels, or a dictionary from channels to numbers.
    /// `by`: whether rows are matched by "time" or by "input".
    /// `interpolate`: whether the table is interpolated between its rows.
    /// `only`: words that select the compared channels.
    #[pyo3(signature = (other, map=None, *, absolute=None, relative=None, of_value=None, by=None, interpolate=false, only=Vec::new()))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn compare(
        &self,
        py: Python<'_>,
        other: Bound<'_, PyAny>,
        map: Option<Bound<'_, PyAny>>,
        absolute: Option<Bound<'_, PyAny>>,
        relative: Option<Bound<'_, PyAny>>,
        of_value: Option<Bound<'_, PyAny>>,
        by: Option<&str>,
        interpolate: bool,
        only: Vec<String>,
    ) -> PyResult<Comparison> {
        let wish = ComparisonWish::of_python(py, other, map, [absolute, relative, of_value], by, interpolate, only)?;
        let inner = self.inner.clone();
        released(py, move || wish.compare(&inner))
    }
}
