//! The class `Proof`.

use std::sync::Arc;

use linkage::math::KeepNan;
use linkproof::parts::{Advice, EngineName, EngineProof, Error, Reference, Route};
use linkproof::testing::AssertProven;
use linkproof::{Options, Verdict};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use scenario::words::choice;

use crate::errors::{OrRaised, argument, positive, within};
use crate::scenario_class::Scenario;
use crate::solution::Solution;
use crate::table::{Table, TableColumn};
use crate::task::released;
use crate::{html, sentences};

/// Options of a proof.
pub(crate) struct ProofWish {
    options: Options,
    tolerance: Option<f64>,
}

/// The element of `all` that is called `word`; an unknown word is an error that lists all words.
fn chosen<T>(key: &str, word: &str, all: &[T], name: impl Fn(&T) -> &'static str) -> Result<T, Error>
where
    T: Copy,
{
    let found = all.iter().find(|own| name(own) == word).copied();
    let names = || choice(all.iter().map(&name), "\"");
    found.ok_or_else(|| argument(key, sentences::there_is_no_such_choice(&word), sentences::it_has(&names())))
}

impl ProofWish {
    /// Reads the keywords of `Scenario.prove`.
    pub(crate) fn of_python(py: Python<'_>, given: Option<Bound<'_, PyDict>>) -> PyResult<ProofWish> {
        let mut wish = ProofWish { options: Options::default(), tolerance: None };
        for (key, value) in given.into_iter().flatten() {
            let key: String = key.extract()?;
            let options = wish.options.clone();
            wish.options = match key.as_str() {
                "engine" => {
                    let names: Vec<String> =
                        value.extract::<String>().map(|one| vec![one]).or_else(|_| value.extract())?;
                    let all = names.iter().map(|name| chosen("engine", name, &EngineName::ALL, |own| own.name()));
                    let all: Vec<EngineName> = all.collect::<Result<_, Error>>().or_raised(py)?;
                    if all.is_empty() {
                        let error = argument(&key, sentences::NO_ENGINE_IS_NAMED, sentences::OMIT_THE_OPTION);
                        return Err(error).or_raised(py);
                    }
                    all.into_iter().fold(options, Options::engine)
                }
                "reference" => {
                    let name: String = value.extract()?;
                    options.reference(chosen("reference", &name, &Reference::ALL, |own| own.name()).or_raised(py)?)
                }
                "route" => {
                    let name: String = value.extract()?;
                    options.route(chosen("route", &name, &Route::ALL, |own| own.name()).or_raised(py)?)
                }
                "step" => options.step(positive(&key, &value)?),
                "accuracy" => options.accuracy(positive(&key, &value)?),
                "sweeps" => options.sweeps(value.extract()?),
                "substeps" => options.substeps(value.extract()?),
                "extrapolated" => options.extrapolated(within(&key, &value, [0, 8])?),
                "budget" => options.budget(positive(&key, &value)?),
                "memory" => options.memory(positive(&key, &value)?),
                "tolerance" => {
                    wish.tolerance = Some(value.extract()?);
                    options
                }
                _ => {
                    let message = sentences::there_is_no_option(&key);
                    return Err(argument(&key, message, sentences::OPTIONS_OF_PROOFS)).or_raised(py);
                }
            };
        }
        Ok(wish)
    }

    /// Proves a scenario.
    pub(crate) fn prove(self, mut scenario: Arc<linkproof::Scenario>) -> Result<Proof, Error> {
        if let Some(share) = self.tolerance {
            if !(share > 0.0 && share < 1.0) {
                let message = sentences::the_tolerance_is_a_share(&share);
                return Err(argument("tolerance", message, sentences::GIVE_A_NUMBER_BETWEEN_0_AND_1));
            }
            Arc::make_mut(&mut scenario).engine_rel = share;
        }
        Ok(Proof { inner: Arc::new(linkproof::prove(&scenario, &self.options)?) })
    }
}

/// Smallest ratio of a bound to its residual; `None` unless the verdict is `agree`.
pub(crate) fn margin(verdict: &Verdict) -> Option<f64> {
    match verdict {
        Verdict::Agree { margin } => Some(*margin),
        Verdict::Disagree { .. } | Verdict::Expected { .. } | Verdict::Inconclusive { .. } => None,
    }
}

/// The reason of a verdict other than agreement.
pub(crate) fn reason(verdict: &Verdict) -> Option<String> {
    verdict.reason(Advice::to_string)
}

/// The results of a proof: the verdict, the compared motions, and the judged channels and checks.
#[pyclass(module = "linkproof", frozen)]
pub(crate) struct Proof {
    inner: Arc<linkproof::Proof>,
}

impl Proof {
    fn engine(&self, py: Python<'_>, name: Option<&str>) -> PyResult<&EngineProof> {
        let all = &self.inner.engines;
        let found = name.map_or(all.first(), |name| all.iter().find(|own| own.info.name == name));
        let names = || choice(all.iter().map(|own| own.info.name), "\"");
        let missing = || {
            let message = sentences::there_is_no_such_choice(&name.unwrap_or_default());
            argument("engine", message, sentences::it_has(&names()))
        };
        found.ok_or_else(missing).or_raised(py)
    }
}

#[pymethods]
impl Proof {
    /// Name of the scenario.
    #[getter]
    fn scenario(&self) -> &str {
        &self.inner.scenario
    }

    /// The verdict: `agree`, `disagree` or `inconclusive`.
    #[getter]
    fn verdict(&self) -> &'static str {
        self.inner.verdict.word()
    }

    /// Whether the verdict is `agree`, or all disagreements are known findings.
    #[getter]
    fn is_proven(&self) -> bool {
        match self.inner.verdict {
            Verdict::Agree { .. } | Verdict::Expected { .. } => true,
            Verdict::Disagree { .. } | Verdict::Inconclusive { .. } => false,
        }
    }

    /// Smallest ratio of a bound to its residual, without a unit; `None` unless the verdict is `agree`.
    #[getter]
    fn margin(&self) -> Option<f64> {
        margin(&self.inner.verdict)
    }

    /// Reason of any verdict other than `agree`; `None` for `agree`.
    #[getter]
    fn reason(&self) -> Option<String> {
        reason(&self.inner.verdict)
    }

    /// One row per engine and channel: the largest residual, its bound and the verdict.
    ///
    /// `residual`, `bound`, `rms` and `scale` are in the unit of the row, `worst_t_s` is in s.
    #[getter]
    fn channels(&self) -> Table {
        let all: Vec<_> =
            self.inner.engines.iter().flat_map(|own| own.channels.iter().map(move |channel| (own, channel))).collect();
        let texts = |name: &str, of: fn(&(&EngineProof, &linkproof::parts::ChannelProof)) -> String| {
            TableColumn::texts(name, all.iter().map(of).collect())
        };
        let numbers = |name: &str, unit: &str, of: fn(&linkproof::parts::ChannelProof) -> f64| {
            TableColumn::numbers(name, unit, all.iter().map(|(_, own)| of(own)).collect())
        };
        Table::of(vec![
            texts("engine", |(engine, _)| engine.info.name.into()),
            texts("channel", |(_, own)| own.residual.channel.to_string()),
            texts("unit", |(_, own)| own.residual.channel.kind.unit.symbol().into()),
            texts("verdict", |(_, own)| own.verdict.word().into()),
            numbers("residual", "", |own| own.residual.max),
            numbers("bound", "", |own| own.bound),
            numbers("rms", "", |own| own.residual.rms),
            numbers("scale", "", |own| own.residual.scale),
            numbers("worst_t_s", "s", |own| own.residual.worst_time),
            numbers("left_out", "", |own| own.left_out as f64),
            texts("reason", |(_, own)| reason(&own.verdict).unwrap_or_default()),
        ])
    }

    /// One row per check of the analytic sides and the engines; `value` and `bound` are in the unit of the row.
    #[getter]
    fn checks(&self) -> Table {
        let all: Vec<_> = self.inner.all_checks().collect();
        Table::of(vec![
            TableColumn::texts("check", all.iter().map(|own| own.name()).collect()),
            TableColumn::texts("unit", all.iter().map(|own| own.unit.into()).collect()),
            TableColumn::texts("verdict", all.iter().map(|own| own.verdict.word().into()).collect()),
            TableColumn::numbers("value", "", all.iter().map(|own| own.value).collect()),
            TableColumn::numbers("bound", "", all.iter().map(|own| own.bound).collect()),
            TableColumn::texts("reason", all.iter().map(|own| reason(&own.verdict).unwrap_or_default()).collect()),
        ])
    }

    /// Names of the engines, in the requested order.
    #[getter]
    fn engines(&self) -> Vec<&'static str> {
        self.inner.engines.iter().map(|own| own.info.name).collect()
    }

    /// The motion computed by the analytic side that is the reference.
    #[getter]
    fn reference(&self, py: Python<'_>) -> PyResult<Py<Solution>> {
        Solution::of(py, self.inner.reference_trajectory.clone())
    }

    /// The motion computed by an engine, by default the first; `None` if the engine gave no motion.
    #[pyo3(signature = (engine=None, /))]
    fn solution(&self, py: Python<'_>, engine: Option<&str>) -> PyResult<Option<Py<Solution>>> {
        self.engine(py, engine)?.trajectory.clone().map(|own| Solution::of(py, own)).transpose()
    }

    /// The time step of the engine (s), or its relative accuracy if it controls its error. The largest of these numbers
    /// if there are several engines.
    #[getter]
    fn resolution(&self) -> f64 {
        self.inner.engines.iter().map(|own| own.info.settings.resolution).fold(0.0, KeepNan::larger)
    }

    /// The report, as the terminal shows it.
    fn report(&self) -> String {
        self.inner.report()
    }

    fn __repr__(&self) -> String {
        sentences::a_proof_of(&self.inner.scenario, &self.verdict())
    }

    fn _repr_html_(&self) -> String {
        html::verdict(&self.inner.verdict, &self.inner.title) + &html::report(&self.inner.report())
    }
}

#[pymethods]
impl Scenario {
    /// Prove the scenario: solve it with both analytic sides and with engines, and judge whether the results agree.
    ///
    /// `engine`: name of an engine, or a list of names: "rapier" (the default) or "impulse".
    /// `reference`: analytic side whose motion is the reference: "assur" (the default) or "newton".
    /// `step`: time step of the engine in s.
    /// `accuracy`: relative accuracy of an engine that controls its error.
    /// `sweeps`, `substeps`, `extrapolated`: number of sweeps in a step, of substeps in a step, of extrapolations.
    /// `route`: method for the engine's reactions and balancing moment: "differences", "native" or "probe".
    /// `budget`: work allowed for the search of settings, in steps.
    /// `memory`: bytes allowed.
    /// `tolerance`: largest bound that allows a conclusive verdict: a fraction of a channel's scale, between 0 and 1.
    ///
    /// Settings that are not given are taken from the scenario, or chosen by the proof.
    #[pyo3(signature = (**options))]
    fn prove(&self, py: Python<'_>, options: Option<Bound<'_, PyDict>>) -> PyResult<Proof> {
        let wish = ProofWish::of_python(py, options)?;
        let inner = self.inner.clone();
        released(py, move || wish.prove(inner))
    }
}
