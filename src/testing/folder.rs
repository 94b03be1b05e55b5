//! One test for every scenario of a folder.
//! The test harness supports filters, `list` and ignored tests.

use crate::sentences;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use libtest_mimic::{Arguments, Failed, Trial, run};

use super::{Proving, failure};
use crate::plain::errors;
use linkage::error::Advice;
use prover::run::Options;
use scenario::files_in;

/// Proves every scenario of a folder (`*.toml`, without subfolders), each as a test with the name of its file.
/// The path is relative to the directory of the package, because Cargo runs tests in this directory.
///
/// The whole file `tests/scenarios.rs`:
///
/// ```no_run
/// fn main() -> std::process::ExitCode {
///     linkproof::testing::main("scenarios")
/// }
/// ```
///
/// `Cargo.toml`:
///
/// ```toml
/// [dev-dependencies]
/// linkproof = { path = "../linkproof", features = ["testing"] }
///
/// [[test]]
/// name = "scenarios"
/// harness = false
/// ```
#[must_use = "the exit code says whether all agree"]
pub fn main(folder: impl AsRef<Path>) -> ExitCode {
    Folder::of(folder).main()
}

/// One test for every scenario of a folder, as in [`main`], but with options for the proofs.
///
/// ```no_run
/// use linkproof::Options;
/// use linkproof::testing::Folder;
///
/// # fn test() -> std::process::ExitCode {
/// Folder::of("scenarios").with(Options::default().every_engine()).ignored(["long_run_up"]).main()
/// # }
/// ```
#[derive(Clone, Debug)]
#[must_use = "nothing is proven before `main`"]
pub struct Folder {
    path: PathBuf,
    options: Options,
    ignored: Vec<String>,
}

impl Folder {
    /// The tests of the folder at `path`.
    pub fn of(path: impl AsRef<Path>) -> Self {
        Folder { path: path.as_ref().into(), options: Options::default(), ignored: Vec::new() }
    }

    /// Sets the engines, the settings of the engines, and the reference solution for every proof.
    pub fn with(mut self, options: Options) -> Self {
        self.options = options;
        self
    }

    /// Marks tests as ignored: they run only if ignored tests are requested.
    /// `names` are names of scenario files, without `.toml`.
    pub fn ignored<N: Into<String>>(mut self, names: impl IntoIterator<Item = N>) -> Self {
        self.ignored.extend(names.into_iter().map(Into::into));
        self
    }

    /// Runs the tests that the arguments of the program select, and returns the exit code for the program.
    #[must_use = "the exit code says whether all agree"]
    pub fn main(self) -> ExitCode {
        run(&Arguments::from_args(), self.trials()).exit_code()
    }

    /// A test for each scenario, and a failing test for each ignored name without a scenario.
    /// If the folder has no scenario or cannot be read, the result is one failing test that reports the error.
    fn trials(self) -> Vec<Trial> {
        let files = match files_in(&self.path) {
            Ok(files) if files.is_empty() => return vec![self.wrong(sentences::THERE_IS_NO_SCENARIO_TOML)],
            Ok(files) => files,
            Err(error) => return vec![self.wrong(&errors::text(&error, Advice::to_string))],
        };
        let names: Vec<String> = files.iter().map(|file| name(file)).collect();
        let unknown = self.ignored.iter().filter(|own| !names.contains(own));
        let unknown = unknown.map(|own| self.wrong(&sentences::is_to_be_ignored_but_no_scenario(&own)));
        let mut trials: Vec<Trial> = unknown.collect();
        for (file, name) in files.into_iter().zip(names) {
            let (options, is_ignored) = (self.options.clone(), self.ignored.contains(&name));
            trials.push(Trial::test(name, || proven(file, options)).with_ignored_flag(is_ignored));
        }
        trials
    }

    fn wrong(&self, message: &str) -> Trial {
        let message = format!("{}: {message}", self.path.display());
        Trial::test(format!("folder {}", self.path.display()), || Err(message.into()))
    }
}

fn name(file: &Path) -> String {
    file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

fn proven(file: PathBuf, options: Options) -> Result<(), Failed> {
    match Proving::of(file).with(options).prove() {
        Ok(proof) => failure(&proof).map_or(Ok(()), |failure| Err(failure.into())),
        Err(error) => Err(errors::text(&error, Advice::to_string).into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    const PENDULUM: &str = include_str!("../../scenarios/pendulum.toml");

    /// A folder with a valid scenario and an unreadable one.
    fn folder() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("right.toml"), PENDULUM).unwrap();
        fs::write(folder.path().join("broken.toml"), PENDULUM.replace("joint = \"O\"", "joint = \"Q\"")).unwrap();
        fs::write(folder.path().join("notes.txt"), "no scenario").unwrap();
        folder
    }

    /// Numbers of tests that passed, failed, were ignored and were filtered out.
    fn outcome(folder: Folder, arguments: &Arguments) -> [u64; 4] {
        let found = run(arguments, folder.trials());
        [found.num_passed, found.num_failed, found.num_ignored, found.num_filtered_out]
    }

    #[test]
    fn every_scenario_is_a_separate_test() {
        let folder = folder();
        let all = Folder::of(folder.path()).trials();
        assert_eq!(all.iter().map(Trial::name).collect::<Vec<_>>(), ["broken", "right"]);
        assert_eq!(outcome(Folder::of(folder.path()), &Arguments::default()), [1, 1, 0, 0]);
        let only = Arguments { filter: Some("right".into()), ..Arguments::default() };
        assert_eq!(outcome(Folder::of(folder.path()), &only), [1, 0, 0, 1]);
        let ignoring = || Folder::of(folder.path()).ignored(["broken"]);
        assert_eq!(outcome(ignoring(), &Arguments::default()), [1, 0, 1, 0]);
        let asked = Arguments { ignored: true, ..Arguments::default() };
        assert_eq!(outcome(ignoring(), &asked), [0, 1, 0, 1]);
    }

    #[test]
    fn options_apply_to_every_proof() {
        let folder = folder();
        let coarse = Folder::of(folder.path()).with(Options::default().step(0.2)).ignored(["broken"]);
        assert_eq!(outcome(coarse, &Arguments::default()), [0, 1, 1, 0]);
    }

    #[test]
    fn a_folder_without_tests_fails() {
        let empty = tempfile::tempdir().unwrap();
        for folder in [Folder::of(empty.path()), Folder::of(empty.path().join("missing"))] {
            assert_eq!(outcome(folder, &Arguments::default()), [0, 1, 0, 0]);
        }
        let folder = folder();
        assert_eq!(outcome(Folder::of(folder.path()).ignored(["borken"]), &Arguments::default()), [1, 2, 0, 0]);
    }
}
