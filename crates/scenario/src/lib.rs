//! Scenario files: reads TOML and returns a [`Case`]. docs/scenario.md describes the format.
//! Only this crate converts the units of files.
//! Every error names file, line and key, states what was found, and says how to correct the mistake.

pub mod accepted;
mod asked;
mod case_figure;
mod claim;
pub mod clearance;
mod curve;
mod draft;
pub mod edit;
pub mod engine;
pub mod excerpt;
mod family;
mod figure;
pub mod formula;
pub mod grid;
pub mod header;
pub mod joints;
pub mod keys;
mod links;
mod loads;
mod malformed;
pub mod mapping;
mod masses;
mod motion;
mod motor;
mod numbers;
pub mod oracle;
mod parameter_table;
mod parameters;
mod printed;
pub mod reader;
mod reduced;
mod renumbering;
mod sentences;
mod series;
mod setting;
mod settings;
mod slopes;
pub mod source;
mod start;
mod stated;
mod statistic;
mod table_file;
pub mod templates;
#[cfg(test)]
mod tests;
mod transfer;
mod transmissions;
pub mod unit;
pub mod varied;
pub mod words;

pub use self::claim::Claim;
pub use self::formula::{Formula, Formulas};
pub use asked::{StartRequest, Undecided};
pub use case_figure::{CaseFigure, FigureKind, TRANSMISSION_ANGLE};
pub use draft::Draft;
pub use engine::{EngineName, EngineSettings};
pub use family::ScenarioFamily;
pub use figure::{FigureValue, MechanismFigure, OracleFigure};
pub use linkage::case::When;
pub use oracle::{Oracle, OracleBasis};
pub use parameters::{INPUTS, Parameter};
pub use printed::{Printed, PrintedChannel};
pub use renumbering::Renumbering;
pub use series::{ExpectedCell, OraclePoint, OracleSeries, within};
pub use setting::{EngineSetting, SettingOrigin};
pub use slopes::{CaseKey, CaseSlopes, KeySort, Slope};
pub use statistic::{FigureGrid, SampledFigure, Statistic, TurnFigure, mean_weights, sampled_values};

use std::path::{Path, PathBuf};

use toml::Spanned;
use toml::de::DeTable;

use self::clearance::ClearanceQuestion;
use self::header::{NAME_HELP, is_name};
use self::reader::{Faults, TomlTable};
use self::source::{Source, text_of};
use self::start::Lists;
use self::stated::FileSections;
use linkage::case::{Case, CaseParts, Grid, Wanted};
use linkage::drive::{Course, Drives};
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::mechanism::assembly::{ConfigurationChoice, group_of};
use linkage::mechanism::{GroupId, Mechanism, StartGroup, Structure};

/// A scenario: the problem, the engine's settings, and the published numbers with which the result is compared.
///
/// ```
/// use linkproof::Scenario;
///
/// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
/// let scenario = Scenario::load("scenarios/crank_rocker.toml")?;
/// assert_eq!(scenario.name, "crank_rocker");
/// assert_eq!(scenario.case.mechanism.joints().len(), 4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Scenario {
    /// Short name, usable in file names: lower-case letters, digits and `_`.
    pub name: String,
    /// Title in one line, for readers.
    pub title: String,
    /// Source of the dimensions, if the file states one.
    pub source: Option<String>,
    /// Path of the file as the user gave it.
    pub path: PathBuf,
    /// Whole text of the file.
    pub text: String,
    /// The problem, in SI.
    pub case: Case,
    /// Engines and the settings that the scenario gives.
    pub engine: EngineSettings,
    /// If the bound on the engine's error, divided by a channel's scale, exceeds this limit, agreement proves nothing.
    pub engine_rel: f64,
    /// Published numbers.
    pub oracles: Vec<Oracle>,
    /// Parameters and formulas. A formula may claim the value of a channel or a figure.
    pub formulas: Formulas,
    /// Outlines of the bodies and the question about the distances between the bodies, if the scenario asks this
    /// question.
    pub clearance: Option<ClearanceQuestion>,
    /// Figures that the report of a proof shows; empty if the file requests none.
    pub figures: Vec<CaseFigure>,
    /// For each group, the start that the file requests. The groups have the order of the structure at the start
    /// ([`Structure::at_start`]).
    pub starts: Vec<StartGroup>,
    /// How each group in `starts` was placed at the start.
    pub choices: Vec<ConfigurationChoice>,
}

/// The scenario files (`*.toml`) of a directory, sorted by name.
///
/// # Errors
/// [`ErrorKind::Io`] if the directory cannot be read.
pub fn files_in(directory: impl AsRef<Path>) -> Result<Vec<PathBuf>> {
    let entries = std::fs::read_dir(directory.as_ref()).map_err(|error| {
        Error::new(ErrorKind::Io, sentences::the_directory_cannot_be_read(&directory.as_ref().display(), &error))
    })?;
    let mut files: Vec<PathBuf> = entries
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    files.sort();
    Ok(files)
}

impl Scenario {
    /// Reads the scenario file at `path` and the tables that the file names.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] if a file cannot be read; all other errors are those of [`Scenario::parse`].
    pub fn load(path: impl AsRef<Path>) -> Result<Scenario> {
        Scenario::load_as(path, &StartRequest::default())
    }

    /// Reads a scenario from its text. Tables of published numbers are searched in the directory of `path`.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a mistake in the text.
    /// [`ErrorKind::Geometry`] if the mechanism cannot be assembled in its first pose.
    /// [`ErrorKind::Unsupported`] for a problem that this version cannot solve.
    /// [`ErrorKind::Io`] for a table that cannot be read.
    /// All errors carry the position in the file and the key.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<Scenario> {
        Ok(parse(text, path.as_ref(), &StartRequest::default(), Lists::No)?.0)
    }

    /// Reads the scenario file at `path` with the start `asked` in place of the file's start.
    ///
    /// Published numbers belong to the file's branch. If the start is on a branch other than the file's branch,
    /// published numbers are left out.
    /// Numbers that depend on the input at t = 0 are left out too if this input differs from the input in the file.
    /// These numbers are the distances of points at t = 0, and all values that the file gives at a time.
    /// Values at crank angles or slides are left out too if they depend on the input at t = 0. There are three such
    /// cases: the crank's speed is not constant, there are further drives, or a torsional spring counts turns from the
    /// start.
    ///
    /// # Errors
    /// The errors of [`Scenario::load`].
    /// [`ErrorKind::Input`] without a position in the file if a group, its mode or its number is unknown.
    pub fn load_as(path: impl AsRef<Path>, asked: &StartRequest) -> Result<Scenario> {
        Scenario::parse_as(&text_of(path.as_ref())?, path, asked)
    }

    /// Reads a scenario from the text of the file at `path`, with the start `asked` in place of the file's start.
    ///
    /// # Errors
    /// The errors of [`Scenario::load_as`] that do not come from reading the file.
    pub fn parse_as(text: &str, path: impl AsRef<Path>, asked: &StartRequest) -> Result<Scenario> {
        Ok(parse(text, path.as_ref(), asked, Lists::No)?.0)
    }

    /// Reads a scenario from the text of the file as [`Scenario::parse_as`] does, for a list of configurations.
    /// A group that the file leaves undecided is placed in one of its configurations.
    /// Undecided groups are returned with the reason, in the order of the structure.
    ///
    /// # Errors
    /// The errors of [`Scenario::parse_as`]. An undecided group does not cause an error.
    pub fn parse_to_list(text: &str, path: &Path, asked: &StartRequest) -> Result<(Scenario, Vec<Undecided>)> {
        let (scenario, mut undecided) = parse(text, path, asked, Lists::Undecided)?;
        undecided.sort_by_key(|undecided| undecided.group);
        Ok((scenario, undecided))
    }

    /// The scenario of a case that was built in code. The scenario has no file and no published numbers.
    /// The engine settings are free: the proof finds them. `name` must be usable in file names.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a name that cannot be used in file names.
    pub fn of_case(name: &str, case: Case) -> Result<Scenario> {
        if !is_name(name) {
            let message = sentences::cannot_be_the_name_of_a_scenario(&name);
            return Err(Error::new(ErrorKind::Input, message).key("name").help(NAME_HELP));
        }
        Ok(Scenario {
            name: name.into(),
            title: name.into(),
            source: None,
            path: PathBuf::new(),
            text: String::new(),
            choices: case
                .structure
                .modes_at_start(&case.modes)
                .into_iter()
                .map(|mode| ConfigurationChoice { mode, nearest_m: None, next_m: None })
                .collect(),
            starts: vec![StartGroup::default(); case.structure.at_start().groups.len()],
            case,
            engine: EngineSettings::default(),
            engine_rel: settings::ENGINE_REL,
            oracles: Vec::new(),
            formulas: Formulas::over(Vec::new()),
            clearance: None,
            figures: Vec::new(),
        })
    }

    /// This scenario, restricted to the channels that `words` request. The words have the syntax of `want` in
    /// `[channels]`.
    /// Figures of the whole mechanism are left out. Numbers and claims about channels that are not requested are left
    /// out too.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a word that requests nothing.
    pub fn only(mut self, words: &[String]) -> Result<Scenario> {
        let channels = settings::called(&self.case, words)
            .map_err(|(message, help)| Error::new(ErrorKind::Input, message).help(help))?;
        self.case = self.case.wanting_only(&channels);
        let wanted = self.case.channels();
        for oracle in &mut self.oracles {
            oracle.series.retain(|series| wanted.contains(&series.channel));
            oracle.figures.clear();
        }
        self.oracles.retain(|oracle| !oracle.series.is_empty());
        let is_wanted = |claim: &Claim| {
            claim.figures.is_empty() && claim.channels.iter().all(|(_, own)| wanted.contains(&own.channel))
        };
        for formula in &mut self.formulas.list {
            formula.claim = formula.claim.take().filter(|claim| is_wanted(claim));
        }
        let has_all = |figure: &CaseFigure| {
            let claim = figure.claim(&self.case, &self.formulas).ok().flatten();
            claim.iter().flat_map(Claim::components).all(|channel| wanted.contains(&channel))
        };
        self.figures.retain(has_all);
        Ok(self)
    }

    /// How a group of the case was placed at the start; `None` for a group with transmissions.
    #[must_use]
    pub fn choice(&self, group: GroupId) -> Option<&ConfigurationChoice> {
        let structure = &self.case.structure;
        let at_start = structure.at_start().groups.find(|own| *own == structure.groups[group])?;
        self.choices.get(at_start.index())
    }

    /// This scenario with every drive in its nominal motion, for questions about crank angles.
    #[must_use]
    pub fn nominal(self) -> Scenario {
        Scenario { case: self.case.nominal(), ..self }
    }
}

fn parse(text: &str, path: &Path, asked: &StartRequest, lists: Lists) -> Result<(Scenario, Vec<Undecided>)> {
    let plain = Source::new(path, text);
    let tree = plain.tree()?;
    of_tree(plain, tree, asked, lists)
}

/// The scenario of a parsed file. Requested numbers and parameters replace numbers and parameters of the file.
fn of_tree<'a>(
    plain: Source<'a>,
    mut tree: Spanned<DeTable<'a>>,
    asked: &StartRequest,
    lists: Lists,
) -> Result<(Scenario, Vec<Undecided>)> {
    numbers::replace(tree.as_mut(), &asked.set)?;
    let (parameters, fault) = parameter_table::read(
        TomlTable::root(&plain, &tree).optional_table("parameters")?,
        &asked.set,
        asked.adds_parameters,
    )?;
    if let Some(fault) = fault {
        return Err(fault);
    }
    let source = plain.with(parameters, keys::rows);
    let in_file = |error| source.located(tree.get_ref(), error);
    let stated = TomlTable::root(&source, &tree).read(|root| {
        let stated = FileSections::read(root, asked)?;
        root.sound_so_far().map_err(|mistakes| {
            Error::all([Some(mistakes), stated.missing_modes(asked)].into_iter().flatten()).expect("there are mistakes")
        })?;
        Ok(stated)
    });
    let mut stated = stated.map_err(in_file)?;
    let (Some(drives), Some(start)) = (&stated.drives, &stated.start) else {
        unreachable!("what is missing has ended the reading");
    };
    let structure = structure(&stated.mechanism, drives).map_err(in_file)?;
    let (mechanism, at_start) = (&stated.mechanism, structure.at_start());
    // Errors of a requested start are returned without a position in the file, because the caller requests the start.
    let groups = asked.groups(mechanism, at_start)?;
    if drives.crank().start != stated.crank && !mechanism.transmissions().is_empty() {
        let message = sentences::THE_START_OF_TRANSMISSIONS_IS_THAT_OF_THE_FILE;
        return Err(Error::new(ErrorKind::Unsupported, message).help(sentences::CHANGE_THE_STARTS_IN_THE_FILE));
    }
    let starts = start::groups(start, stated.groups, mechanism, at_start, &groups, lists).map_err(in_file)?;
    let placing = asked::Start { mechanism, structure: at_start, drives, crank: stated.crank, starts: &starts, lists };
    let placed = placing.placed(drives.crank().start, &groups).map_err(|error| {
        let own = group_of(mechanism, at_start, &error);
        if groups.iter().any(|(index, _)| own == Some(*index)) { error } else { in_file(error) }
    })?;
    stated.groups = Vec::new();
    finished(stated, structure, placed, &source, asked).map_err(in_file)
}

/// The structure of a stated mechanism. Masses and speeds of the mechanism are checked first.
fn structure(mechanism: &Mechanism, drives: &Drives) -> Result<Structure> {
    masses::check(mechanism, drives)?;
    masses::check_speeds(mechanism, drives)?;
    Structure::of(mechanism, &drives.joints())
}

/// The scenario of a mechanism that is placed at its start. Also returns the undecided groups of the mechanism.
fn finished(
    stated: FileSections,
    structure: Structure,
    placed: asked::Placed,
    source: &Source,
    asked: &StartRequest,
) -> Result<(Scenario, Vec<Undecided>)> {
    let (mechanism, drives) = (stated.mechanism, stated.drives.expect("what is missing has ended the reading"));
    let (own_crank, crank) = (stated.crank, drives.crank().start);
    let (starts, choices, undecided) = (placed.starts, placed.choices, placed.undecided);
    let modes = structure.modes(&choices.iter().map(|choice| choice.mode).collect::<Vec<_>>());
    let start = placed.pose;
    let (loads, gravity, grid, wanted) = (stated.loads, stated.gravity, stated.grid, Wanted::ALL);
    let input = drives.crank().input;
    let differs = |table: &Course| table.knots().is_some() && table.turns().is_none() != (input == Input::Slide);
    if let Some(load) = loads.iter().find(|load| load.courses().any(differs)) {
        let over = if input == Input::Slide { "an angle" } else { "a slide" };
        let message = sentences::a_table_of_a_load_is_over(&load.sort(), &over, &input.noun());
        return Err(Error::new(ErrorKind::Unsupported, message).key("loads").help(sentences::GIVE_THE_LOAD_A_CONSTANT));
    }
    let case =
        Case::new(CaseParts { mechanism, structure, drives, loads, gravity, start, modes, grid, wanted, only: None })?;
    let case = match stated.channels {
        Some((table, words)) => settings::wanting(&table, &words, case)?,
        None => case,
    };
    let mut faults = Faults::none();
    let mut oracles = oracle::read(stated.oracles, &case, asked.memory, &mut faults);
    let mut formulas = self::formula::read(source.parameters.list().to_vec(), stated.formulas, &case, &mut faults);
    let figures = stated.report.map(|table| case_figure::reported(table, &case, &formulas));
    let figures = faults.kept(figures.unwrap_or_else(|| Ok(Vec::new()))).unwrap_or_default();
    faults.end()?;
    if !asked.set.is_empty() {
        // Published numbers are valid for the numbers of the file only, so they are removed if a number is replaced.
        oracles.clear();
    }
    if !placed.is_own_branch {
        oracles.clear();
        formulas.list.iter_mut().for_each(|formula| formula.claim = None);
    } else if crank != own_crank {
        oracles = oracles.into_iter().filter_map(|oracle| oracle.at_another_start(&case)).collect();
    }
    let series = oracles.iter().flat_map(|oracle| &oracle.series);
    let cranks: Vec<f64> = series.flat_map(OracleSeries::instants).filter_map(When::crank).collect();
    if let Err(message) = Grid::of_inputs(case.crank(), cranks).check(&case.drives) {
        let error = Error::new(ErrorKind::Input, sentences::published_numbers(&message)).key("oracle");
        return Err(error.help(match case.crank().is_free() {
            true => sentences::GIVE_THE_NUMBERS_AT_TIMES,
            false => sentences::TAKE_THE_NUMBERS_OUT_OR_GIVE,
        }));
    }
    let scenario = Scenario {
        name: stated.name,
        title: stated.title,
        source: stated.source,
        path: source.path.to_path_buf(),
        text: source.text.to_string(),
        case,
        engine: stated.engine,
        engine_rel: stated.engine_rel,
        oracles,
        formulas,
        clearance: stated.clearance,
        figures,
        starts,
        choices,
    };
    Ok((scenario, undecided))
}
