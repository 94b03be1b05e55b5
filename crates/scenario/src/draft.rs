//! The part of a scenario file that is needed to draw its mechanism.
//! The mechanism may have mistakes, or may be impossible to assemble.

use std::path::Path;

use super::asked::StartRequest;
use super::links::is_somewhere;
use super::reader::TomlTable;
use super::source::Source;
use super::start::Lists;
use super::stated::FileSections;
use super::{keys, numbers, parameter_table, start};
use linkage::drive::{Drive, Load, MotionLaw};
use linkage::error::{Error, Result};
use linkage::input::Input;
use linkage::math::Vec2;
use linkage::mechanism::{DrivenJoint, GROUND, JointId, Mechanism, StartGroup, Structure};

/// The mechanism of a scenario file, without the parts that have mistakes. The mechanism may be impossible to assemble.
#[derive(Clone, Debug)]
pub struct Draft {
    /// Short name. If the file does not state a name, the short name is the file name without its ending.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Links and joints. If the file has mistakes, links and joints may be inconsistent.
    pub mechanism: Mechanism,
    /// The groups of the mechanism, or the reason why they cannot be determined.
    pub structure: Result<Structure>,
    /// The drives of the mechanism.
    pub drives: Vec<Drive>,
    /// Whether the file states no drive that could be read.
    /// The crank is then the first link hinged to the ground that gives a valid structure, if there is such a link.
    pub is_driven_by_guess: bool,
    /// The loads on the mechanism.
    pub loads: Vec<Load>,
    /// Acceleration of gravity (m/s^2).
    pub gravity: Vec2,
    /// Input at t = 0 (SI).
    pub crank: f64,
    /// Start of each group, in the order of the groups of [`Structure::at_start`]; empty if there is no structure.
    /// Without a valid start in the file, every start that the caller does not request is the default.
    pub starts: Vec<StartGroup>,
    /// The mistakes of the file, if there are any.
    pub mistakes: Option<Error>,
}

impl Draft {
    /// Reads a draft from the text of the file at `path`.
    ///
    /// # Errors
    /// An error if the text is not TOML, if the request `asked` is wrong, or if the file has another format version
    /// than this program.
    pub fn parse(text: &str, path: &Path, asked: &StartRequest) -> Result<Draft> {
        let plain = Source::new(path, text);
        let mut tree = plain.tree()?;
        numbers::replace(tree.as_mut(), &asked.set)?;
        let table = TomlTable::root(&plain, &tree).optional_table("parameters").unwrap_or_default();
        let (parameters, fault) = parameter_table::read(table, &asked.set, asked.adds_parameters)?;
        let source = plain.with(parameters, keys::rows);
        let read = |asked: &StartRequest| {
            let found = TomlTable::root(&source, &tree).read_on(|root| read(root, asked));
            found.map_err(|error| source.located(tree.get_ref(), error))
        };
        let (mut draft, mut mistakes) = read(asked)?;
        if draft.drives.is_empty() && draft.structure.is_ok() {
            (draft, mistakes) = read(&StartRequest { without_drive: true, ..asked.clone() })?;
        }
        // If a parameter has a mistake, only this mistake is reported, because the wrong parameter may be the cause of
        // all other mistakes.
        Ok(Draft { mistakes: fault.or(mistakes), ..draft })
    }

    /// Whether the file has no drive and its links cannot move.
    #[must_use]
    pub fn is_fixed(&self) -> bool {
        self.drives.is_empty() && self.structure.is_ok() && self.mistakes.is_none()
    }

    /// What the input measures.
    #[must_use]
    pub fn input(&self) -> Input {
        input(&self.drives)
    }
}

fn input(drives: &[Drive]) -> Input {
    drives.first().map_or(Input::Angle, |drive| drive.input)
}

fn read(root: &mut TomlTable, asked: &StartRequest) -> Result<Draft> {
    let stated = FileSections::read(root, asked)?;
    let FileSections { title, crank, gravity, start, groups, .. } = stated;
    let mechanism = with_places(&stated.mechanism);
    let is_driven_by_guess = stated.drives.is_none();
    let drives: Vec<Drive> = match &stated.drives {
        Some(drives) => drives.to_vec(),
        None => guessed(&mechanism, crank).into_iter().collect(),
    };
    let driven: Vec<DrivenJoint> =
        drives.iter().map(|drive| DrivenJoint { joint: drive.joint, input: drive.input }).collect();
    let structure = Structure::of(&mechanism, &driven);
    let starts = structure.as_ref().map_or_else(
        |_| Vec::new(),
        |structure| {
            let structure = structure.at_start();
            let wanted = asked.groups(&mechanism, structure).unwrap_or_default();
            let none = vec![StartGroup::default(); structure.groups.len()];
            let given =
                start.and_then(|start| start::groups(&start, groups, &mechanism, structure, &wanted, Lists::No).ok());
            let mut starts = given.unwrap_or(none);
            for (index, group) in wanted {
                starts[index] = group;
            }
            starts
        },
    );
    let name = match stated.name.is_empty() {
        true => root.source().path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        false => stated.name,
    };
    let crank = asked.start(input(&drives)).unwrap_or(crank);
    let loads =
        stated.loads.into_iter().filter(|load| load.points().iter().all(|end| is_somewhere(end.local))).collect();
    Ok(Draft {
        name,
        title,
        mechanism,
        structure,
        drives,
        is_driven_by_guess,
        loads,
        gravity,
        crank,
        starts,
        mistakes: None,
    })
}

/// A drive of the first link hinged to the ground whose rotation determines the motion of all links.
fn guessed(mechanism: &Mechanism, crank: f64) -> Option<Drive> {
    let joints = mechanism.joints();
    let is_hinge = |&index: &JointId| joints[index].is_pin() && joints[index].on(GROUND).is_some();
    let index = joints.ids().filter(is_hinge).find(|&index| Structure::of(mechanism, &[index]).is_ok())?;
    Some(Drive::prescribed(index, joints[index].other(GROUND).link, 0.0, crank, MotionLaw::ConstantSpeed(1.0)))
}

/// The mechanism without the points whose position could not be read. The reader of joints has left out the joints at
/// these points.
fn with_places(mechanism: &Mechanism) -> Mechanism {
    let mut links = mechanism.links().to_vec();
    for link in &mut links {
        link.points.retain(|point| is_somewhere(point.local));
    }
    let placed = Mechanism::unchecked(links, mechanism.joints().to_vec());
    placed.clone().with_transmissions(mechanism.transmission_designs()).unwrap_or(placed)
}
