//! Sweeps: `Scenario.sweep`, and the functions that continue and join them.

use std::ops::ControlFlow;
use std::path::PathBuf;

use linkage::threads::cores;
use linkproof::parts::{Error, ErrorKind};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use scenario::StartRequest;
use sweep::{DesignKind, Goal, Shard, SweepAxis, SweepDesign, SweepPlan, SweepStore, SweepTally, run};

use crate::errors::{OrRaised, argument};
use crate::scenario_class::Scenario;
use crate::sentences;
use crate::swept::Sweep;
use crate::task::{released, told};

/// What is to be done for a sweep: the directory, the share of the cases, the number of threads, and whether only the
/// plan is written.
struct SweepWish {
    out: PathBuf,
    shard: Option<Shard>,
    jobs: usize,
    plan_only: bool,
}

impl SweepWish {
    /// Solves the cases that are not stored yet, and joins all parts to one table. `tell` receives the number of
    /// finished cases and the number of all cases.
    fn carried_out(self, plan: SweepPlan, tell: &mut dyn FnMut((u64, u64)) -> ControlFlow<()>) -> Result<Sweep, Error> {
        let store = SweepStore::open(&self.out, &plan).map_err(|error| error.key("out"))?;
        let shard = self.shard.unwrap_or(Shard::WHOLE);
        let cases = shard.cases(&plan);
        let mut tally = SweepTally::default();
        if !self.plan_only || store.is_complete() {
            let mut progress = |tally: &SweepTally| tell((tally.cases(), cases));
            (tally, _) = run(&plan, &store, self.shard, self.jobs, Goal::default(), &mut progress)?;
            if let Some(case) = tally.disagreement {
                let error = Error::new(ErrorKind::Numeric, sentences::the_proof_of_a_case_disagrees(&case));
                return Err(error
                    .key("prove_every")
                    .help(sentences::prove_the_case(&dictionary(&plan.setting_of(case)))));
            }
        }
        Ok(Sweep { plan, store, shard, tally })
    }

    /// Calls `carried_out` without Python's lock.
    fn released(
        self,
        py: Python<'_>,
        plan: impl FnOnce() -> Result<SweepPlan, Error> + Send + 'static,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Sweep> {
        let work = move |tell: &mut dyn FnMut((u64, u64)) -> ControlFlow<()>| self.carried_out(plan()?, tell);
        told(py, work, |done| progress.as_ref().map_or(Ok(()), |own| own.call1(done).map(drop)))
    }
}

/// A dictionary from keys to numbers, as Python writes it.
fn dictionary(numbers: &[(String, f64)]) -> String {
    let all: Vec<String> = numbers.iter().map(|(key, value)| format!("{key:?}: {value:?}")).collect();
    format!("{{{}}}", all.join(", "))
}

/// The share of the cases from a pair: the number of this share (from 1), and the count of all shares.
fn share(given: Option<(u64, u64)>) -> Result<Option<Shard>, Error> {
    match given {
        Some((number, count)) if !(1..=count).contains(&number) => {
            Err(argument("shard", sentences::this_is_no_shard(&number, &count), sentences::GIVE_A_SHARE_OF_ALL))
        }
        Some((number, count)) => Ok(Some(Shard { number, count })),
        None => Ok(None),
    }
}

/// A number that must be above 0.
fn positive(key: &str, given: Option<u64>) -> Result<Option<u64>, Error> {
    match given {
        Some(0) => Err(argument(key, sentences::THIS_NUMBER_IS_0, sentences::GIVE_A_WHOLE_NUMBER_ABOVE_0)),
        Some(_) | None => Ok(given),
    }
}

/// The axes of a sweep, from a dictionary that gives the values of each varied number.
fn axes(vary: &Bound<'_, PyAny>) -> PyResult<Vec<SweepAxis>> {
    let py = vary.py();
    let mut axes = Vec::new();
    for item in vary.call_method0("items")?.try_iter()? {
        let (key, values): (String, Bound<'_, PyAny>) = item?.extract()?;
        let text = match values.cast::<PyTuple>() {
            Ok(numbers) => match (numbers.extract::<(f64, f64, u64)>(), numbers.extract::<(f64, f64)>()) {
                (Ok((from, to, count)), _) => Some(format!("{from}:{to}:{count}")),
                (_, Ok((from, to))) => Some(format!("{from}:{to}")),
                (Err(_), Err(_)) => None,
            },
            Err(_) => values.extract::<String>().ok(),
        };
        let wrong = || argument("vary", sentences::these_are_no_values(&key), sentences::VARY_A_KEY_BY);
        let axis = text.ok_or_else(wrong).and_then(|text| {
            SweepAxis::parse(&format!("{key}={text}")).map_err(|error| error.key("vary").help(sentences::VARY_A_KEY_BY))
        });
        axes.push(axis.or_raised(py)?);
    }
    Ok(axes)
}

/// How the varied values are combined: as a grid, or as one kind of samples.
fn kind(samples: [Option<u64>; 3], seed: u64) -> Result<DesignKind, Error> {
    Ok(match samples {
        [None, None, None] => DesignKind::Grid,
        [Some(cases), None, None] => DesignKind::Random { cases, seed },
        [None, Some(cases), None] => DesignKind::LatinHypercube { cases, seed },
        [None, None, Some(cases)] => DesignKind::Sobol { cases, seed },
        [Some(_), Some(_), _] | [Some(_), _, Some(_)] | [_, Some(_), Some(_)] => {
            let help = sentences::GIVE_ONE_OF_RANDOM_LATIN_SOBOL;
            return Err(argument("sobol", sentences::SAMPLES_ARE_TAKEN_IN_ONE_WAY, help));
        }
    })
}

/// Reads one text or a list of texts.
pub(crate) fn texts(given: &Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    given.extract::<String>().map(|one| vec![one]).or_else(|_| given.extract())
}

#[pymethods]
impl Scenario {
    /// Solve many cases of this scenario: numbers are varied, and every case gives some figures.
    ///
    /// `vary`: a dictionary from keys to values in the unit of the key.
    /// A key is a parameter ("crank_mm") or the path of a number ("links.crank.mass_kg").
    /// For a grid, values are "20:60:41" or (20, 60, 41).
    /// For samples, values are "20:60" or (20, 60), "normal(40, 0.02)" or "normal(40, 0.02, 39.9, 40.1)".
    /// `figures`: names of figures, such as "max:joint.A.f_N" or "transmission_angle_deg".
    /// `random`, `latin`, `sobol`: number of samples of this kind. If all three are missing, the cases form a grid.
    /// `seed`: seed of the samples.
    /// `prove_every`: proves each case whose index is a multiple of this number. A proof that disagrees stops the sweep
    /// and is raised as `NumericError`.
    /// `out`: directory of the results. A sweep that was stopped continues in this directory.
    /// Without `out`, the results are in a temporary directory that is removed with the returned object.
    /// `shard`: (i, n) solves the share i of n equal shares; i counts from 1.
    /// `part`: number of cases that are stored together.
    /// `plan_only`: whether only the plan is written into `out`, for `linkproof.resume` in other processes.
    /// `jobs`: number of threads, all cores by default.
    /// `progress`: a function that receives the number of finished cases and the number of all cases.
    ///
    /// Other threads of Python run during the sweep. Ctrl-C stops the sweep; finished parts stay in `out`.
    #[pyo3(signature = (
        vary, figures, *, random=None, latin=None, sobol=None, seed=1, prove_every=None, out=None, shard=None, part=None,
        plan_only=false, jobs=None, progress=None
    ))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn sweep<'py>(
        &self,
        py: Python<'py>,
        vary: &Bound<'py, PyAny>,
        figures: &Bound<'py, PyAny>,
        random: Option<u64>,
        latin: Option<u64>,
        sobol: Option<u64>,
        seed: u64,
        prove_every: Option<u64>,
        out: Option<PathBuf>,
        shard: Option<(u64, u64)>,
        part: Option<u64>,
        plan_only: bool,
        jobs: Option<usize>,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, Sweep>> {
        let asked = self.request().or_raised(py)?;
        if asked != (StartRequest { set: asked.set.clone(), ..StartRequest::default() }) {
            let message = sentences::a_sweep_takes_its_start_from_the_file(&self.inner.name);
            return Err(argument("scenario", message, sentences::WRITE_THEM_IN_THE_FILE)).or_raised(py);
        }
        let (shard, part) = (share(shard).or_raised(py)?, positive("part", part).or_raised(py)?);
        let prove_every = positive("prove_every", prove_every).or_raised(py)?;
        let kind = kind([random, latin, sobol], seed).or_raised(py)?;
        let (axes, figures) = (axes(vary)?, texts(figures)?);
        if out.is_none() && (shard.is_some() || plan_only) {
            let error = argument("out", sentences::A_SHARE_NEEDS_A_DIRECTORY, sentences::NAME_A_DIRECTORY_WITH_OUT);
            return Err(error).or_raised(py);
        }
        let inner = self.inner.clone();
        let plan = move || {
            let design = SweepDesign::of(kind, axes).map_err(|error| error.key("vary"))?;
            SweepPlan::of((inner.text.clone(), &inner.path), asked.set, design, &figures, prove_every, part)
                .map_err(|error| error.key("figures"))
        };
        let wish = |out| SweepWish { out, shard, jobs: jobs.unwrap_or_else(cores), plan_only };
        match out {
            Some(out) => Bound::new(py, wish(out).released(py, plan, progress)?),
            None => {
                let directory = py.import("tempfile")?.call_method1("mkdtemp", ("", "linkproof-"))?;
                let remove = py.import("shutil")?.getattr("rmtree")?;
                let done = wish(directory.extract()?).released(py, plan, progress);
                let Ok(done) = done else {
                    remove.call1((&directory, true))?;
                    return done.and_then(|done| Bound::new(py, done));
                };
                let done = Bound::new(py, done)?;
                py.import("weakref")?.call_method1("finalize", (&done, remove, directory, true))?;
                Ok(done)
            }
        }
    }
}

/// Continue the sweep of a directory: solve the cases that are not stored yet, and join all parts to one table.
/// A complete sweep is only opened.
///
/// `shard`: (i, n) solves the share i of n equal shares, and joins nothing; i counts from 1.
/// `jobs`: number of threads, all cores by default.
/// `path`: path of the scenario file, needed if the scenario names other files relative to this path.
/// `progress`: a function that receives the number of finished cases and the number of all cases.
#[pyfunction]
#[pyo3(signature = (directory, /, *, shard=None, jobs=None, path=PathBuf::new(), progress=None))]
pub(crate) fn resume(
    py: Python<'_>,
    directory: PathBuf,
    shard: Option<(u64, u64)>,
    jobs: Option<usize>,
    path: PathBuf,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Sweep> {
    let shard = share(shard).or_raised(py)?;
    let wish = SweepWish { out: directory.clone(), shard, jobs: jobs.unwrap_or_else(cores), plan_only: false };
    let plan = move || Ok(SweepPlan { path, ..SweepStore::found(&directory)?.1 });
    wish.released(py, plan, progress)
}

/// Join the shares of a sweep from one or several directories to one table.
///
/// `out`: directory of the table, by default the first of the directories.
#[pyfunction]
#[pyo3(signature = (*directories, out=None))]
pub(crate) fn merge(py: Python<'_>, directories: Vec<PathBuf>, out: Option<PathBuf>) -> PyResult<Sweep> {
    let Some(to) = out.or_else(|| directories.first().cloned()) else {
        let help = sentences::NAME_THE_DIRECTORIES_OF_SHARDS;
        return Err(argument("directories", sentences::NO_DIRECTORY_IS_NAMED, help)).or_raised(py);
    };
    released(py, move || {
        let (store, plan) = SweepStore::merged(&directories, &to)?;
        let tally = SweepTally { stored: plan.design.cases(), ..SweepTally::default() };
        Ok(Sweep { plan, store, shard: Shard::WHOLE, tally })
    })
}
