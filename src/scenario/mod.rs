//! Scenario files: TOML in, a [`Case`] out. Only this module converts units; docs/scenario.md describes the format.
//! Every error names file, line and key, what was found, and the way out.

pub mod catalogue;
mod correction;
pub mod edit;
mod figure;
pub mod grid;
mod joints;
mod links;
mod loads;
mod motion;
mod motor;
pub mod oracle;
mod printed;
mod reader;
pub mod redraw;
mod series;
mod settings;
mod source;
mod start;
mod table_file;
pub mod task_file;
#[cfg(test)]
mod tests;
pub mod unit;
mod words;

pub use figure::{Figure, FigureValue, OracleFigure};
pub use oracle::{Oracle, OracleBasis};
pub use series::{ExpectedCell, OraclePoint, OracleSeries};
pub use settings::EngineKeys;

use std::path::{Path, PathBuf};

use self::reader::{Sign, Table};
use self::source::Source;
use linkage::case::{Case, CaseParts, Grid};
use linkage::error::{Error, ErrorKind, Result};
use linkage::mechanism::assembly::{Choice, first_choices};
use linkage::mechanism::{Mechanism, StartGroup, Structure};

/// Version of the file format that this crate reads.
pub const FORMAT: i64 = 1;

/// A scenario: the problem, the engine's settings, and the published numbers that it is compared with.
///
/// ```
/// use linkproof::Scenario;
///
/// # std::env::set_current_dir(env!("CARGO_MANIFEST_DIR"))?;
/// let scenario = Scenario::load("scenarios/crank_rocker.toml".as_ref())?;
/// assert_eq!(scenario.name, "crank_rocker");
/// assert_eq!(scenario.case.mechanism.joints().len(), 4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Scenario {
    /// Short name, usable in file names: lower-case letters, digits and `_`.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Where the dimensions come from.
    pub source: Option<String>,
    /// Path of the file as the user gave it.
    pub path: PathBuf,
    /// Whole text of the file.
    pub text: String,
    /// The problem, in SI.
    pub case: Case,
    /// Step of the engine (s), if the scenario gives one.
    pub dt: Option<f64>,
    /// The other keys of the engine.
    pub engine: EngineKeys,
    /// Largest discretisation error of the engine, as a share of a channel's scale, at which agreement is still a
    /// proof.
    pub engine_rel: f64,
    /// Published numbers.
    pub oracles: Vec<Oracle>,
    /// The start asked for in the file for each group, in the order of the structure.
    pub starts: Vec<StartGroup>,
    /// How each group was placed at the start, in the order of the structure.
    pub choices: Vec<Choice>,
}

/// The scenario files (`*.toml`) of a directory, by name.
///
/// # Errors
/// [`ErrorKind::Io`] if the directory cannot be read.
pub fn files_in(directory: &Path) -> Result<Vec<PathBuf>> {
    let entries = std::fs::read_dir(directory).map_err(|error| {
        Error::new(ErrorKind::Io, format!("the directory {} cannot be read: {error}", directory.display()))
    })?;
    let mut files: Vec<PathBuf> = entries
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    files.sort();
    Ok(files)
}

impl Scenario {
    /// Reads the scenario file at `path` and the tables it names.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] if a file cannot be read, else as [`Scenario::parse`].
    pub fn load(path: &Path) -> Result<Scenario> {
        let text = std::fs::read_to_string(path).map_err(|error| {
            Error::new(ErrorKind::Io, format!("the scenario {} cannot be read: {error}", path.display()))
                .help("give the path of a scenario file, such as scenarios/crank_rocker.toml")
        })?;
        Scenario::parse(&text, path)
    }

    /// Reads a scenario from its text. Tables of published numbers are searched in the directory of `path`.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for anything wrong in the text, [`ErrorKind::Geometry`] if the first pose cannot be
    /// taken, [`ErrorKind::Unsupported`] for what this version does not solve, [`ErrorKind::Io`] for a table that
    /// cannot be read; all with the place in the file and the key.
    pub fn parse(text: &str, path: &Path) -> Result<Scenario> {
        let source = Source { path, text };
        let tree = source.tree()?;
        read(&mut Table::root(&source, &tree)).map_err(|error| source.located(tree.get_ref(), error))
    }

    /// The scenario of a case that was built in code: without a file, without published numbers, with the engine's own
    /// settings, which the proof finds. `name` must be usable in file names.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a name with other characters than lower-case letters, digits and `_`.
    pub fn of_case(name: &str, case: Case) -> Result<Scenario> {
        if !is_name(name) {
            let message = format!("\"{name}\" cannot be the name of a scenario");
            return Err(Error::new(ErrorKind::Input, message).key("name").help(NAME_HELP));
        }
        Ok(Scenario {
            name: name.into(),
            title: name.into(),
            source: None,
            path: PathBuf::new(),
            text: String::new(),
            choices: case.modes.iter().map(|&mode| Choice { mode, nearest_m: None, next_m: None }).collect(),
            starts: vec![StartGroup::default(); case.structure.groups.len()],
            case,
            dt: None,
            engine: EngineKeys::default(),
            engine_rel: settings::ENGINE_REL,
            oracles: Vec::new(),
        })
    }

    /// The same scenario with every drive in its nominal motion, for questions about crank angles.
    #[must_use]
    pub fn nominal(self) -> Scenario {
        Scenario { case: self.case.nominal(), ..self }
    }

    /// The same scenario with other starts for some groups. Each of `asked` is `LINK,LINK=MODE` or `LINK,LINK=NUMBER`.
    /// The links of a group and its mode are named as in the file; in another order of the links, left and right are
    /// exchanged. NUMBER is the place in the list of [`configurations`](linkage::mechanism::assembly::configurations),
    /// counted from 1. If the start pose changes, the published numbers are left out, because they belong to the
    /// scenario's own pose.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if a group, its mode or its number is not known; those of [`first_choices`] for the groups
    /// after it.
    pub fn with_modes(&self, asked: &[String]) -> Result<Scenario> {
        let mut changed = self.clone();
        let case = &self.case;
        for text in asked {
            let (index, start) = start::asked(text, &case.mechanism, &case.structure)?;
            changed.starts[index] = start;
        }
        let angles = case.drives.world_angles(case.crank().start);
        let (pose, choices) = first_choices(&case.mechanism, &case.structure, &angles, &changed.starts)?;
        if pose != case.start {
            changed.oracles.clear();
        }
        changed.case = case.with(|parts| {
            parts.modes = choices.iter().map(|choice| choice.mode).collect();
            parts.start = pose;
        })?;
        changed.choices = choices;
        Ok(changed)
    }
}

fn read(root: &mut Table) -> Result<Scenario> {
    check_format(root)?;
    let name = name(root)?;
    let title = root.string("title")?;
    let cited = root.optional_string("source")?;
    // All sections are fetched before any is read: a misspelt section is the cause of other errors.
    let (ground, links, joints) = (root.table("ground")?, root.table("links")?, root.tables("joints")?);
    let (drives, motor) = (root.needed_tables("drive")?, root.optional_table("motor")?);
    let (gravity, loads) = (root.optional_table("gravity")?, root.tables("loads")?);
    let (mut start, grid, channels) = (root.table("start")?, root.table("grid")?, root.optional_table("channels")?);
    let (engine, tolerances) = (root.optional_table("engine")?, root.optional_table("tolerances")?);
    let oracles = root.tables("oracle")?;
    root.finish()?;

    let links = links::read(ground, links)?;
    let joints = joints::read(joints, &links)?;
    let mechanism = Mechanism::new(links, joints)?;
    let crank = start.quantity("crank", &unit::ANGLE, Sign::Any)?;
    let groups = start.tables("groups")?;
    start.finish()?;
    let drives = motion::drives(drives, motor, &mechanism, crank)?;
    let loads = loads::read(loads, &mechanism)?;
    let gravity = motion::gravity(gravity)?;
    let structure = Structure::of(&mechanism, &drives.joints())?;
    let starts = start::groups(&start, groups, &mechanism, &structure)?;
    let grid = grid::read(grid, drives.crank())?;
    let wanted = settings::wanted(channels)?;
    let (dt, engine) = settings::engine(engine, drives.crank())?;
    let engine_rel = settings::engine_rel(tolerances)?;
    let (start, choices) = first_choices(&mechanism, &structure, &drives.world_angles(crank), &starts)?;
    let modes = choices.iter().map(|choice| choice.mode).collect();
    let case = Case::new(CaseParts { mechanism, structure, drives, loads, gravity, start, modes, grid, wanted })?;
    let oracles = oracle::read(oracles, &case)?;
    let series = oracles.iter().flat_map(|oracle| &oracle.series);
    let published =
        series.flat_map(|series| series.points.iter().chain(series.expected.iter().map(|cell| &cell.point)));
    let cranks: Vec<f64> = published.map(|point| point.crank).collect();
    let free = grid::only_times(case.crank()).filter(|_| !cranks.is_empty()).map(String::from);
    if let Err(message) = free.map_or_else(|| Grid::of_cranks(case.crank(), cranks).check(case.crank()), Err) {
        let error = Error::new(ErrorKind::Input, format!("published numbers: {message}")).key("oracle");
        return Err(error.help("take the numbers out, or give them at crank angles to which the drive comes"));
    }
    let source = root.source();
    let (path, text) = (source.path.to_path_buf(), source.text.to_string());
    Ok(Scenario { name, title, source: cited, path, text, case, dt, engine, engine_rel, oracles, starts, choices })
}

fn check_format(root: &mut Table) -> Result<()> {
    if root.is_empty() {
        let error = root.fault("the file holds no scenario");
        return Err(error.help("a scenario starts with `format = 1`; docs/scenario.md builds one up step by step"));
    }
    match root.integer("format")? {
        FORMAT => Ok(()),
        other => Err(root
            .wrong(ErrorKind::Unsupported, "format", format!("format {other} is not handled by this version"))
            .help(format!("this version reads `format = {FORMAT}`"))),
    }
}

/// Whether a name can be used in file names.
fn is_name(name: &str) -> bool {
    !name.is_empty() && name.bytes().all(|byte| matches!(byte, b'a'..=b'z' | b'0'..=b'9' | b'_'))
}

const NAME_HELP: &str = "it names files: use lower-case letters, digits and `_`";

fn name(root: &mut Table) -> Result<String> {
    let name = root.string("name")?;
    if is_name(&name) {
        return Ok(name);
    }
    Err(root.wrong(ErrorKind::Input, "name", format!("\"{name}\" cannot be the name of a scenario")).help(NAME_HELP))
}
