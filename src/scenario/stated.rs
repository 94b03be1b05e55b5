//! What a scenario file states, before it is asked what that means as a whole.

use super::asked::Asked;
use super::header::{check_format, name};
use super::reader::{Faults, Sign, Table};
use super::settings::{self, ENGINE_REL, EngineKeys};
use super::{clearance, grid, joints, links, loads, motion, start, unit};
use linkage::case::Grid;
use linkage::drive::{Drive, Drives, Load, MotionLaw};
use linkage::error::Result;
use linkage::math::Vec2;
use linkage::mechanism::{Joint, Link, Mechanism};
use workshop::clearance::Question;

/// The sections of a file. Those that need the whole case are still tables.
pub struct Stated<'a> {
    pub name: String,
    pub title: String,
    pub source: Option<String>,
    pub mechanism: Mechanism,
    pub drives: Drives,
    /// Crank angle at t = 0 (rad).
    pub crank: f64,
    pub loads: Vec<Load>,
    pub gravity: Vec2,
    pub start: Table<'a>,
    pub groups: Vec<start::Stated<'a>>,
    pub grid: Grid,
    /// The section `[channels]` with its words.
    pub channels: Option<(Table<'a>, Vec<String>)>,
    pub engine: (Option<f64>, EngineKeys),
    pub engine_rel: f64,
    pub oracles: Vec<Table<'a>>,
    pub formulas: Vec<Table<'a>>,
    pub clearance: Option<Question>,
}

impl<'a> Stated<'a> {
    /// Reads every section, and tells the mistakes of all of them.
    pub fn read(root: &mut Table<'a>, asked: &Asked) -> Result<Stated<'a>> {
        check_format(root)?;
        let (name, title, source) = (name(root), root.string("title"), root.optional_string("source"));
        // All sections are fetched before any is read: a misspelt section is the cause of other errors.
        let (ground, links, joints) = (root.table("ground"), root.table("links"), root.tables("joints")?);
        let (drives, motor) = (root.needed_tables("drive"), root.optional_table("motor")?);
        let (gravity, loads) = (root.optional_table("gravity")?, root.tables("loads")?);
        let (start, grid, channels) = (root.table("start"), root.table("grid"), root.optional_table("channels")?);
        let (engine, tolerances) = (root.optional_table("engine")?, root.optional_table("tolerances")?);
        let (oracles, clearance) = (root.tables("oracle")?, root.optional_table("clearance")?);
        let formulas = root.tables("formula")?;
        // It was read before all others, which may use it.
        root.optional_table("parameters")?;
        let misspells_section = root.has_unknown_table();
        let finished = root.finish();
        if misspells_section {
            finished?;
        }
        let (ground, links, drives, mut start, mut grid) = (ground?, links?, drives?, start?, grid?);

        let mut faults = Faults::none();
        let engine_rel = tolerances.map(|mut table| faults.read(&mut table, settings::engine_rel));
        let gravity = gravity.map(|mut table| faults.read(&mut table, motion::gravity));
        let channels = channels.map(|mut table| Some((faults.read(&mut table, settings::wanted)?, table)));
        let links = links::read(ground, links, &mut faults);
        let joints = joints::read(joints, &links, &mut faults);
        let mechanism = mechanism(links, joints, &mut faults);
        let mut groups = Vec::new();
        let crank = faults.read(&mut start, |start| {
            groups = start.tables("groups")?;
            let crank = start.quantity("crank", &unit::ANGLE, Sign::Any)?;
            start.finish()?;
            Ok(crank)
        });
        let crank = crank.unwrap_or_default();
        let groups = start::stated(groups, &mechanism, &mut faults);
        let loads = loads::read(loads, &mechanism, &mut faults);
        let drives = motion::drives(drives, motor, &mechanism, asked.crank.unwrap_or(crank), &mut faults);
        // What follows depends on numbers of the mechanism and of the drive.
        faults.whole &= faults.is_empty();
        let clearance = clearance.map(|mut table| faults.read(&mut table, |table| clearance::read(table, &mechanism)));
        let crank_drive = match &drives {
            Some(drives) => drives.crank().clone(),
            None => Drive::prescribed(0, 1, 0.0, 0.0, MotionLaw::ConstantSpeed(1.0)),
        };
        let grid = faults.read(&mut grid, |grid| grid::read(grid, &crank_drive, asked.without_grid));
        let engine = engine.map(|mut table| faults.read(&mut table, |table| settings::engine(table, &crank_drive)));

        root.part(faults.end());
        root.sound_so_far()?;
        const READ: &str = "what could not be read has ended the reading";
        Ok(Stated {
            name: name?,
            title: title?,
            source: source?,
            mechanism,
            drives: drives.expect(READ),
            crank,
            loads,
            gravity: gravity.map_or_else(Vec2::zeros, |gravity| gravity.expect(READ)),
            start,
            groups,
            grid: grid.expect(READ),
            channels: channels.map(|channels| channels.expect(READ)).map(|(words, table)| (table, words)),
            engine: engine.map_or_else(Default::default, |engine| engine.expect(READ)),
            engine_rel: engine_rel.map_or(ENGINE_REL, |share| share.expect(READ)),
            oracles,
            formulas,
            clearance: clearance.map(|clearance| clearance.expect(READ)),
        })
    }
}

/// The mechanism; after a mistake one that is good for its names only.
fn mechanism(links: Vec<Link>, joints: Vec<Joint>, faults: &mut Faults) -> Mechanism {
    if !faults.is_empty() {
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
