//! The statements of a scenario file, before the case is built from them.

use super::asked::StartRequest;
use super::clearance::ClearanceQuestion;
use super::engine::{self, EngineSettings};
use super::header::{check_format, name};
use super::keys::key::{Section, ValueKind, needed, optional};
use super::reader::{Faults, TomlTable};
use super::settings::{self, ENGINE_REL};
use super::unit::ANGLE;
use super::{clearance, grid, joints, links, loads, motion, start, transmissions};
use crate::sentences;
use linkage::case::Grid;
use linkage::drive::{Drive, Drives, Load, MotionLaw};
use linkage::error::{Error, Result};
use linkage::input::Input;
use linkage::math::Vec2;
use linkage::mechanism::{Joint, JointId, Link, LinkId, Mechanism, Structure};

/// Descriptions of the keys that this module reads.
pub const SECTIONS: &[Section] = &[Section::at("").with(&[
    needed("format", ValueKind::Integer).means("version of this format: 1"),
    needed("name", ValueKind::Text).means("short name for file names: `a`-`z`, `0`-`9`, `_`"),
    needed("title", ValueKind::Text).means("title, one line"),
    optional("source", ValueKind::Text, "none").means("where the dimensions come from"),
    optional("parameters", ValueKind::Table, "none").means("named numbers, for use in other numbers and in formulas"),
    needed("ground", ValueKind::Table).means("the frame"),
    needed("links", ValueKind::Table).means("moving links by name"),
    needed("joints", ValueKind::Tables).means("joints"),
    optional("transmissions", ValueKind::Tables, "none").means("gear pairs, racks, screws, belts and cams"),
    needed("drive", ValueKind::TableOrTables).means("drives; the input of the first one identifies an instant"),
    optional("motor", ValueKind::Table, "none").means("motor of the crank"),
    optional("gravity", ValueKind::Table, "none").means("acceleration of gravity"),
    optional("loads", ValueKind::Tables, "none").means("forces, moments, springs and dampers"),
    needed("start", ValueKind::Table).means("pose at t = 0"),
    needed("grid", ValueKind::Table).means("instants of the results"),
    optional("channels", ValueKind::Table, "all").means("requested results"),
    optional("engine", ValueKind::Table, "found by `run`").means("settings of the engine"),
    optional("tolerances", ValueKind::Table, "its defaults").means("largest bound at which agreement is conclusive"),
    optional("oracle", ValueKind::Tables, "none").means("numbers that the mechanism must reproduce"),
    optional("clearance", ValueKind::Table, "none")
        .means("outlines of links and a housing, for contacts and smallest distances"),
    optional("formula", ValueKind::Tables, "none").means("derived formulas, and the quantities that they claim to be"),
    optional("report", ValueKind::Table, "its usual figures").means("figures in the report of a proof"),
])];

/// The sections of a file. Sections whose content depends on the whole case are not read yet; they are stored as
/// tables.
/// A part with a mistake is left out or replaced by an empty default.
pub struct FileSections<'a> {
    pub name: String,
    pub title: String,
    pub source: Option<String>,
    /// Links and joints. After a mistake, links and joints are only suitable for display.
    pub mechanism: Mechanism,
    /// Drives of the mechanism; `None` after a mistake, and if the file has no drive.
    pub drives: Option<Drives>,
    /// Input of the first drive at t = 0 (rad or m), as the file states it.
    pub crank: f64,
    pub loads: Vec<Load>,
    pub gravity: Vec2,
    /// The section `[start]`; `None` if it is missing.
    pub start: Option<TomlTable<'a>>,
    pub groups: Vec<start::StatedGroup<'a>>,
    /// Whether all tables of `[[start.groups]]` could be read.
    pub has_all_groups: bool,
    pub grid: Grid,
    /// The section `[channels]` with its words.
    pub channels: Option<(TomlTable<'a>, Vec<String>)>,
    pub engine: EngineSettings,
    pub engine_rel: f64,
    pub oracles: Vec<TomlTable<'a>>,
    pub formulas: Vec<TomlTable<'a>>,
    /// The section `[report]`.
    pub report: Option<TomlTable<'a>>,
    pub clearance: Option<ClearanceQuestion>,
}

impl<'a> FileSections<'a> {
    /// Reads every section. Mistakes of all sections are noted in `root`.
    ///
    /// # Errors
    /// An error if no section can be read: if the file is empty or has an unknown format version.
    pub fn read(root: &mut TomlTable<'a>, asked: &StartRequest) -> Result<FileSections<'a>> {
        check_format(root)?;
        let (name, title, source) = (name(root), root.string("title"), root.optional_string("source"));
        // All sections are fetched before any section is read. If the sections were fetched one by one, a misspelt
        // section name would cause further errors.
        let (ground, links, joints) = (root.table("ground"), root.table("links"), root.tables("joints")?);
        let drives = match asked.without_drive {
            true => root.table_or_tables("drive"),
            false if !root.has("drive") => Err(root.lacks(&["drive"], sentences::ADD_A_DRIVE)),
            false => root.needed_tables("drive"),
        };
        let motor = root.optional_table("motor")?;
        let (gravity, loads) = (root.optional_table("gravity")?, root.tables("loads")?);
        let transmissions = root.tables("transmissions")?;
        let section = |root: &mut TomlTable<'a>, key: &str| match asked.without_drive {
            true => root.optional_table(key),
            false => root.table(key).map(Some),
        };
        let (start, grid) = (section(root, "start"), section(root, "grid"));
        let channels = root.optional_table("channels")?;
        let (engine, tolerances) = (root.optional_table("engine")?, root.optional_table("tolerances")?);
        let (oracles, clearance) = (root.tables("oracle")?, root.optional_table("clearance")?);
        let (formulas, report) = (root.tables("formula")?, root.optional_table("report")?);
        // All other sections may use parameters, so the parameters were read before these sections. This line only
        // marks the section `[parameters]` as known.
        root.optional_table("parameters")?;
        let mut faults = Faults::none();
        let has_all = ground.is_ok() && links.is_ok() && drives.is_ok() && start.is_ok();
        faults.whole = has_all && !root.has_unknown_table();
        faults.names = ground.is_ok() && links.is_ok();
        // The result is not needed, because `finish` notes its errors in `root`.
        let _ = root.finish();

        let engine_rel = tolerances.and_then(|mut table| faults.read(&mut table, settings::engine_rel));
        let gravity = gravity.and_then(|mut table| faults.read(&mut table, motion::gravity));
        let channels = channels.and_then(|mut table| Some((faults.read(&mut table, settings::wanted)?, table)));
        let links = links::read(ground.ok(), links.ok(), &mut faults);
        let joints = joints::read(joints, &links, &mut faults);
        let mechanism = mechanism(links, joints, &mut faults);
        let mechanism = transmissions::read(transmissions, mechanism, &mut faults);
        let first_input = drives.as_ref().ok().and_then(|drives| motion::first_input(drives, &mechanism));
        let (mut start, mut groups, mut crank) = (start.ok().flatten(), Vec::new(), None);
        if let Some(start) = &mut start {
            let own = |start: &mut TomlTable<'a>| {
                groups = start.tables("groups")?;
                let crank = if asked.without_drive { None } else { crank_of(start, first_input)? };
                start.finish()?;
                Ok(crank)
            };
            crank = faults.read(start, own).unwrap_or_default();
        }
        let group_count = groups.len();
        let groups = start::stated(groups, &mechanism, &mut faults);
        let loads = loads::read(loads, &mechanism, &mut faults);
        let drives =
            drives.ok().and_then(|drives| motion::drives(drives, motor, &mechanism, (crank, asked), &mut faults));
        let (drives, first) = drives.map_or((None, None), |(drives, first)| (Some(drives), Some(first)));
        let crank = first.or(crank).unwrap_or_default();
        // The sections after this line depend on numbers of the mechanism and of the drive.
        // After a mistake in these numbers, `faults.whole` is therefore false.
        faults.whole &= faults.is_empty();
        let clearance =
            clearance.and_then(|mut table| faults.read(&mut table, |table| clearance::read(table, &mechanism)));
        let stand_in = || Drive::prescribed(JointId(0), LinkId(1), 0.0, 0.0, MotionLaw::ConstantSpeed(1.0));
        let all = drives.clone().unwrap_or_else(|| Drives::new(stand_in(), Vec::new()));
        let grid = grid
            .ok()
            .flatten()
            .and_then(|mut grid| faults.read(&mut grid, |grid| grid::read(grid, &all, asked.without_grid)));
        let engine = engine.and_then(|mut table| faults.read(&mut table, |table| engine::read(table, all.crank())));
        root.part(faults.end());
        Ok(FileSections {
            name: name.unwrap_or_default(),
            title: title.unwrap_or_default(),
            source: source.unwrap_or_default(),
            mechanism,
            drives,
            crank,
            loads,
            gravity: gravity.unwrap_or_else(Vec2::zeros),
            start,
            has_all_groups: groups.len() == group_count,
            groups,
            grid: grid.unwrap_or_default(),
            channels: channels.map(|(words, table)| (table, words)),
            engine: engine.unwrap_or_default(),
            engine_rel: engine_rel.unwrap_or(ENGINE_REL),
            oracles,
            formulas,
            report,
            clearance,
        })
    }
}

impl FileSections<'_> {
    /// The error for missing assembly modes in a file that also has mistakes of another kind.
    /// `None` if the mistakes of the other kind may be the reason for the missing modes.
    pub fn missing_modes(&self, asked: &StartRequest) -> Option<Error> {
        let (start, drives) = (self.start.as_ref()?, self.drives.as_ref()?);
        let asked = |structure: &Structure| asked.groups(&self.mechanism, structure).unwrap_or_default();
        let found = || start::also_missing(start, &self.groups, &self.mechanism, &drives.joints(), asked);
        self.has_all_groups.then(found).flatten()
    }
}

/// The crank angle in `[start]`.
/// The crank angle is required if the first drive moves a crank, and refused if the first drive moves no crank.
/// `input` is the input of the first drive, if it is known.
fn crank_of(start: &mut TomlTable, input: Option<Input>) -> Result<Option<f64>> {
    match input {
        None | Some(Input::Angle) => start.si("crank").map(Some),
        Some(input) => match ANGLE.keys("crank").into_iter().find(|key| start.has(key)) {
            None => Ok(None),
            Some(key) => {
                let message = sentences::the_first_drive_has_the_input(&input.noun());
                start.refuse(&key, message, sentences::GIVE_ITS_START_IN_DRIVE)
            }
        },
    }
}

/// Builds the mechanism. After a mistake, only the names of the mechanism are usable.
fn mechanism(links: Vec<Link>, joints: Vec<Joint>, faults: &mut Faults) -> Mechanism {
    if !(faults.is_empty() && faults.whole) {
        return Mechanism::unchecked(links, joints);
    }
    match faults.kept(Mechanism::new(links.clone(), joints.clone())) {
        Some(mechanism) => mechanism,
        None => {
            faults.whole = false;
            Mechanism::unchecked(links, joints)
        }
    }
}
