//! Proofs in test suites.
//! One line tests a scenario ([`assert_proven!`](crate::assert_proven)).
//! One line tests a folder of scenarios (`testing::main`, with the feature `testing`).
//!
//! A test passes only if its proof ends in *agree*; an inconclusive proof also fails the test.
//! The failure message is the report.

#[cfg(feature = "testing")]
mod folder;

#[cfg(feature = "testing")]
pub use folder::{Folder, main};

use std::path::{Path, PathBuf};

use crate::plain::{brief, errors, style};
use crate::sentences;
use linkage::case::Grid;
use linkage::drive::Drive;
use linkage::error::{Advice, Error, ErrorKind, Result};
use prover::bounds::Verdict;
use prover::run::{Options, Proof, prove};
use scenario::grid::listed;
use scenario::{Scenario, StartRequest};

/// Proves a scenario file, and panics with the report unless the proof agrees; returns the [`Proof`].
///
/// The path is relative to the directory of the caller's `Cargo.toml`.
/// Each further argument, such as `only = [...]`, calls the method of that name of
/// [`Proving`](crate::testing::Proving).
///
/// ```
/// use linkproof::{Options, assert_proven};
///
/// let proof = assert_proven!("scenarios/crank_rocker.toml", only = ["positions"]);
/// assert!(proof.engine().channels.iter().all(|channel| channel.residual.share() < 1e-4));
/// assert_proven!("scenarios/pendulum.toml", with = Options::default().step(1e-3), only = ["link.rod"]);
/// assert_proven!("scenarios/formulas/slider_crank_centric.toml", set = ("r_mm", 40.0), only = ["point.B.positions"]);
/// ```
#[macro_export]
macro_rules! assert_proven {
    (@with $proving:expr,) => { $proving };
    (@with $proving:expr, set = ($key:expr, $value:expr $(,)?) $(, $($rest:tt)*)?) => {
        $crate::assert_proven!(@with $proving.set($key, $value), $($($rest)*)?)
    };
    (@with $proving:expr, $option:ident = $value:expr $(, $($rest:tt)*)?) => {
        $crate::assert_proven!(@with $proving.$option($value), $($($rest)*)?)
    };
    ($file:expr $(, $($options:tt)*)?) => {{
        let file = ::std::path::Path::new(::core::env!("CARGO_MANIFEST_DIR")).join($file);
        $crate::assert_proven!(@with $crate::testing::Proving::of(file), $($($options)*)?).assert()
    }};
}

/// Methods for testing a [`Proof`]: the report, and a panic unless the proof agrees.
pub trait AssertProven: Sized {
    /// The report, as the terminal shows it.
    #[must_use]
    fn report(&self) -> String;

    /// Returns the proof if it agrees.
    ///
    /// ```
    /// use linkproof::testing::AssertProven;
    /// use linkproof::{Options, Scenario, prove};
    ///
    /// # std::env::set_current_dir(env!("CARGO_MANIFEST_DIR"))?;
    /// let scenario = Scenario::load("scenarios/pendulum.toml")?;
    /// prove(&scenario, &Options::default())?.assert();
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Panics
    /// Panics with the verdict and the report if the proof disagrees or is inconclusive.
    #[track_caller]
    fn assert(self) -> Self;
}

impl AssertProven for Proof {
    fn report(&self) -> String {
        style::plain(&brief::proof(self, Advice::to_string, style::COLUMNS))
    }

    #[track_caller]
    fn assert(self) -> Self {
        match failure(&self) {
            None => self,
            Some(failure) => panic!("{failure}"),
        }
    }
}

/// The failure message of a test with this proof; `None` if the proof agrees, so that the test passes.
fn failure(proof: &Proof) -> Option<String> {
    let word = match proof.verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => return None,
        Verdict::Disagree { .. } | Verdict::Inconclusive { .. } => proof.verdict.word(),
    };
    let mut told = sentences::is_not_proven(&proof.scenario, &word, &proof.report());
    for error in proof.engines.iter().filter_map(|engine| engine.failure.as_ref()) {
        told += &format!("\n{}\n", errors::text(error, Advice::to_string));
    }
    Some(told)
}

/// A proof of a scenario file, prepared by [`Proving::of`].
/// Settings that no method of `Proving` sets come from the scenario file.
#[derive(Clone, Debug)]
#[must_use = "nothing is proven before `prove` or `assert`"]
pub struct Proving {
    file: PathBuf,
    asked: StartRequest,
    instants: Option<Instants>,
    only: Vec<String>,
    options: Options,
    tolerance: Option<f64>,
}

/// The crank angles (rad) or times (s) of a grid, and the function that builds a grid from such values.
#[derive(Clone, Debug)]
struct Instants {
    values: Vec<f64>,
    grid: fn(&Drive, Vec<f64>) -> Grid,
}

impl Proving {
    /// Begins a proof of the scenario file at `path`, for a test.
    ///
    /// ```no_run
    /// use linkproof::Options;
    /// use linkproof::testing::Proving;
    ///
    /// Proving::of("scenarios/crank_rocker.toml").with(Options::default().step(1e-3)).only(["positions"]).assert();
    /// ```
    pub fn of(path: impl AsRef<Path>) -> Self {
        Proving {
            file: path.as_ref().into(),
            asked: StartRequest::default(),
            instants: None,
            only: Vec::new(),
            options: Options::default(),
            tolerance: None,
        }
    }

    /// Sets the engines, the settings of the engines, and the reference solution.
    pub fn with(mut self, options: Options) -> Self {
        self.options = options;
        self
    }

    /// Requests only the channels that these words name; the words are those of `want` in `[channels]`.
    /// A word is a stage (`positions`), a subject (`point.P`), a subject's stage (`point.P.positions`) or a channel
    /// (`joint.B.fx_N`).
    /// The method may be called several times.
    pub fn only<W: Into<String>>(mut self, words: impl IntoIterator<Item = W>) -> Self {
        self.only.extend(words.into_iter().map(Into::into));
        self
    }

    /// Sets a parameter by its key in `[parameters]`, in the unit of the key.
    /// Published numbers are valid only for the file's parameters, so the proof omits these numbers if a parameter is
    /// set.
    /// The method may be called several times.
    pub fn set(mut self, key: impl Into<String>, number: f64) -> Self {
        self.asked.set.push((key.into(), number));
        self
    }

    /// Sets the grid by values of the input: crank angles (rad) or slide positions (m), as measured in the scenario.
    pub fn cranks(mut self, angles: impl IntoIterator<Item = f64>) -> Self {
        self.instants = Some(Instants { values: angles.into_iter().collect(), grid: Grid::of_inputs });
        self
    }

    /// Sets the grid by times (s).
    pub fn times(mut self, times: impl IntoIterator<Item = f64>) -> Self {
        self.instants = Some(Instants { values: times.into_iter().collect(), grid: Grid::of_times });
        self
    }

    /// Sets the input at t = 0: a crank angle (rad) or a slide position (m), measured as in the scenario file.
    pub fn start(mut self, crank: f64) -> Self {
        self.asked.crank = Some(crank);
        self
    }

    /// Starts a group in the given assembly mode, written `LINK,LINK=MODE`, instead of the mode of the file.
    /// The method may be called for several groups.
    pub fn mode(mut self, group: impl Into<String>) -> Self {
        self.asked.modes.push(group.into());
        self
    }

    /// Sets an upper limit for the engine's error bound, as a fraction of a channel's scale.
    /// If the error bound exceeds this limit, agreement no longer counts as a proof.
    /// The limit replaces `engine_rel` of `[tolerances]`.
    /// The error bounds themselves are computed and cannot be chosen.
    pub fn tolerance(mut self, share: f64) -> Self {
        self.tolerance = Some(share);
        self
    }

    /// Proves the scenario.
    ///
    /// # Errors
    /// The errors of [`Scenario::load`] and of [`prove`], and [`ErrorKind::Input`] for invalid settings.
    pub fn prove(&self) -> Result<Proof> {
        prove(&self.scenario()?, &self.options)
    }

    /// Proves the scenario, and returns the proof if it agrees.
    ///
    /// # Panics
    /// Panics with the verdict and the report if the proof disagrees or is inconclusive.
    /// Panics with the error if the proof cannot be made.
    #[track_caller]
    pub fn assert(&self) -> Proof {
        match self.prove() {
            Ok(proof) => proof.assert(),
            Err(error) => panic!("{}", errors::text(&error, Advice::to_string)),
        }
    }

    /// The scenario with all settings applied.
    fn scenario(&self) -> Result<Scenario> {
        let asked = StartRequest { without_grid: self.instants.is_some(), ..self.asked.clone() };
        let mut scenario = Scenario::load_as(&self.file, &asked)?;
        if let Some(instants) = &self.instants {
            let grid = instants.grid(&scenario)?;
            scenario.case = scenario.case.on(grid)?;
        }
        if !self.only.is_empty() {
            scenario = scenario.only(&self.only)?;
        }
        if let Some(share) = self.tolerance {
            if !(share > 0.0 && share < 1.0) {
                let message = sentences::found_as_tolerance_but_this_is_a_share(&share);
                return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_A_NUMBER_BETWEEN_AND_SUCH_AS));
            }
            scenario.engine_rel = share;
        }
        Ok(scenario)
    }
}

impl Instants {
    fn grid(&self, scenario: &Scenario) -> Result<Grid> {
        let crank = scenario.case.crank();
        let wrong = |message: String| {
            Error::new(ErrorKind::Input, sentences::the_grid_cannot_be(&message))
                .help(sentences::GIVE_EVERY_INSTANT_ONCE_CRANK)
        };
        let grid = (self.grid)(crank, listed(self.values.clone()).map_err(wrong)?);
        grid.check(&scenario.case.drives).map_err(wrong)?;
        Ok(grid)
    }
}
