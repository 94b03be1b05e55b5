//! `[[start.groups]]`: the assembly mode in which each Assur group starts. The command line can state the mode too.

use super::joints::link;
use super::keys::key::{Section, ValueKind, needed, optional};
use super::reader::{Faults, TomlTable};
use super::words::{Words, names, suggestion};
use crate::sentences;
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::math::Vec2;
use linkage::math::statistics::distinct;
use linkage::mechanism::{
    AssemblyMode, DrivenJoint, Group, GroupId, GroupKind, JointSide, LinkId, Mechanism, StartGroup, Structure,
    pose::SidePoint,
};

const MODES: Words<AssemblyMode> = &[
    ("left", AssemblyMode::Left),
    ("right", AssemblyMode::Right),
    ("ahead", AssemblyMode::Ahead),
    ("behind", AssemblyMode::Behind),
];

/// Descriptions of the keys that this module reads.
pub const SECTIONS: &[Section] = &[
    Section::at("start").with(&[
        optional("crank", ValueKind::ANGLES, "required if the first drive moves a crank")
            .means("crank angle at t = 0, of the first drive"),
        optional("groups", ValueKind::Tables, "none: a mechanism without groups")
            .means("one table for each Assur group"),
    ]),
    Section::at("start.groups").with(&[
        needed("links", ValueKind::Texts).means("all links of the group"),
        optional("mode", ValueKind::Choice(|| names(MODES)), "chosen by `near`")
            .means("one of a dyad's two configurations, see below. RPP and PRP dyads have only one, and need no table"),
        optional("near", ValueKind::TableOrTables, "chosen by `mode`").means(
            "approximate position in the world of one point of the group; or an array of several such \
             tables",
        ),
    ]),
    Section::at("start.groups.near").with(&[
        needed("point", ValueKind::Text).means("a point of the group"),
        needed("x", ValueKind::LENGTHS).means("coordinate along x in the world"),
        needed("y", ValueKind::LENGTHS).means("coordinate along y in the world"),
    ]),
];

/// What happens to a group whose assembly mode the file does not state: it is an error (`No`), or the group is placed
/// anyway and listed (`Undecided`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lists {
    No,
    Undecided,
}

/// A table of `[[start.groups]]` as the file states it.
pub struct StatedGroup<'a> {
    table: TomlTable<'a>,
    links: Vec<LinkId>,
    mode: Option<AssemblyMode>,
    near: Vec<(TomlTable<'a>, String, Vec2)>,
}

/// Reads the tables of `[[start.groups]]`. Tables with mistakes are left out.
pub fn stated<'a>(tables: Vec<TomlTable<'a>>, mechanism: &Mechanism, faults: &mut Faults) -> Vec<StatedGroup<'a>> {
    let one = |mut table: TomlTable<'a>| {
        let (links, mode, near) = faults.read(&mut table, |table| {
            let names = table.strings("links")?;
            let mode = table.optional_choice("mode", sentences::IS_NO_ASSEMBLY_MODE, MODES)?;
            let near = table.table_or_tables("near")?.into_iter().map(rough_place).collect::<Result<_>>();
            let near = table.part(near);
            table.finish()?;
            let links = names.iter().map(|name| link(table, name, mechanism.links())).collect::<Result<_>>()?;
            Ok((links, mode, near))
        })?;
        Some(StatedGroup { table, links, mode, near })
    };
    tables.into_iter().filter_map(one).collect()
}

/// The start that the file requests for each group, in the order of the structure.
/// `start` is the table that contains the groups.
/// The file may omit groups in `asked`, because the caller requests their start.
pub fn groups(
    start: &TomlTable,
    stated: Vec<StatedGroup>,
    mechanism: &Mechanism,
    structure: &Structure,
    asked: &[(GroupId, StartGroup)],
    lists: Lists,
) -> Result<Vec<StartGroup>> {
    let mut wanted: Vec<Option<StartGroup>> = vec![None; structure.groups.len()];
    let mut faults = Faults::none();
    for own in stated {
        if let Some((index, group)) = faults.kept(group(own, mechanism, structure, &wanted)) {
            wanted[index] = Some(group);
        }
    }
    faults.end()?;
    // A list of configurations needs no choice, so assembly modes may be missing.
    if lists == Lists::No {
        missing(start, |index| wanted[index].is_some(), mechanism, structure, asked)?;
    }
    Ok(wanted.into_iter().map(Option::unwrap_or_default).collect())
}

/// Refuses a start that lacks assembly modes.
/// `is_given` says whether the file states the start of a group. For the groups in `asked`, the caller requests the
/// start.
fn missing(
    start: &TomlTable,
    is_given: impl Fn(GroupId) -> bool,
    mechanism: &Mechanism,
    structure: &Structure,
    asked: &[(GroupId, StartGroup)],
) -> Result<()> {
    let is_asked = |index: GroupId| asked.iter().any(|(other, _)| *other == index);
    let open = structure.groups.entries().filter(|(index, _)| !is_given(*index) && !is_asked(*index));
    let missing: Vec<&Group> = open.map(|(_, group)| group).collect();
    // A group without named modes is not reported here, because the search for the first pose reports it.
    let named = |group: &&&Group| !modes_of(group.kind).is_empty();
    let names: Vec<String> =
        missing.iter().filter(named).map(|group| format!("({})", group.names(mechanism))).collect();
    let message = match names.as_slice() {
        [] => return Ok(()),
        [one] => sentences::the_assembly_mode_of_the_group(one),
        several => sentences::the_assembly_modes_of_groups(&several.join(", ")),
    };
    let help = sentences::add_with_the_right_mode(&ready_to_paste(&missing, mechanism));
    Err(start.fault(message).help(help).key("start.groups"))
}

/// The error for missing assembly modes in a file that also has mistakes of another kind.
/// `None` if these mistakes make it impossible to know whether modes are missing.
pub fn also_missing(
    start: &TomlTable,
    stated: &[StatedGroup],
    mechanism: &Mechanism,
    drives: &[DrivenJoint],
    asked: impl FnOnce(&Structure) -> Vec<(GroupId, StartGroup)>,
) -> Option<Error> {
    let structure = Structure::of(mechanism, drives).ok()?;
    let structure = structure.at_start();
    let is_given = |index: GroupId| stated.iter().any(|own| group_of(&own.links, structure) == Some(index));
    missing(start, is_given, mechanism, structure, &asked(structure)).err()
}

fn group(
    StatedGroup { table, links, mode, near }: StatedGroup,
    mechanism: &Mechanism,
    structure: &Structure,
    before: &[Option<StartGroup>],
) -> Result<(GroupId, StartGroup)> {
    let Some(index) = group_of(&links, structure) else {
        return Err(unknown_group(&table, &links, mechanism, structure));
    };
    if before[index].is_some() {
        return table.refuse("links", sentences::THIS_GROUP_IS_GIVEN_TWICE, sentences::KEEP_ONE_OF_THE_TWO);
    }
    let group = &structure.groups[index];
    if let Some(asked) = mode
        && !modes_of(group.kind).contains(&asked)
    {
        return Err(foreign_mode(&table, asked, group));
    }
    let mode = if is_in_order(&links, group, mechanism) { mode } else { mode.map(AssemblyMode::swapped) };
    let near = near.into_iter().map(|near| side_point(near, mechanism, group)).collect::<Result<_>>()?;
    Ok((index, StartGroup { mode, rank: None, near }))
}

/// Index of the group with exactly these links, in any order.
fn group_of(links: &[LinkId], structure: &Structure) -> Option<GroupId> {
    let mut sorted = links.to_vec();
    sorted.sort_unstable();
    structure.groups.find(|group| group.links == sorted)
}

/// Whether the first link of `links` belongs to the group's first body. `links` are the group's links in the order in
/// which the request names them. An assembly mode refers to the order of the two bodies.
fn is_in_order(links: &[LinkId], group: &Group, mechanism: &Mechanism) -> bool {
    let leads = group.leads(mechanism);
    let body = |link: LinkId| group.links.iter().position(|&own| own == link).map(|at| leads[at]);
    links.first().and_then(|&link| body(link)) == leads.first().copied()
}

/// The group and the start that `LINK,LINK=MODE` or `LINK,LINK=NUMBER` requests.
///
/// # Errors
/// [`ErrorKind::Input`] if the group does not exist or does not have the mode.
pub fn asked(text: &str, mechanism: &Mechanism, structure: &Structure) -> Result<(GroupId, StartGroup)> {
    let examples = || {
        let example = |group: &Group| {
            let names = group.names(mechanism).replace(", ", ",");
            format!("\"{names}={}\"", modes_of(group.kind).first().map_or("1", |mode| mode.name()))
        };
        structure.groups.iter().map(example).collect::<Vec<_>>().join(" or ")
    };
    let Some((names, mode)) = text.rsplit_once('=') else {
        return Err(Error::new(ErrorKind::Input, sentences::names_no_group_and_mode(&text))
            .help(sentences::write_the_links_of_a_group(&examples())));
    };
    let names: Vec<&str> = names.split(',').map(str::trim).collect();
    let links: Option<Vec<LinkId>> = names.iter().map(|name| mechanism.link_named(name)).collect();
    let Some(index) = links.as_ref().and_then(|links| group_of(links, structure)) else {
        return Err(Error::new(ErrorKind::Input, sentences::the_mechanism_has_no_assur(&names.join(", ")))
            .help(sentences::ask_for_one_of_its_groups(&examples())));
    };
    let (group, mode) = (&structure.groups[index], mode.trim());
    if let Ok(rank) = mode.parse::<usize>() {
        return Ok((index, StartGroup { rank: Some(rank), ..StartGroup::default() }));
    }
    let Some(&found) = modes_of(group.kind).iter().find(|own| own.name() == mode) else {
        let message = sentences::is_no_assembly_mode_of_the_group(&mode, &group.names(mechanism));
        let names = modes_of(group.kind).iter().map(|mode| format!("\"{}\", ", mode.name())).collect::<String>();
        let or = if names.is_empty() { "" } else { "or " };
        return Err(Error::new(ErrorKind::Input, message)
            .help(Advice::Configuration { give: sentences::a_number_from_the_list_of_configurations(&names, &or) }));
    };
    let in_order = links.is_some_and(|links| is_in_order(&links, group, mechanism));
    let mode = if in_order { found } else { found.swapped() };
    Ok((index, StartGroup { mode: Some(mode), ..StartGroup::default() }))
}

/// The assembly modes of a group of this kind that can be requested by name.
fn modes_of(kind: GroupKind) -> &'static [AssemblyMode] {
    kind.modes().map_or(&[], |modes| modes)
}

fn foreign_mode(table: &TomlTable, asked: AssemblyMode, group: &Group) -> Error {
    let message = sentences::mode_does_not_belong_to_a_group(&asked.name(), &group.pairs());
    let help = match modes_of(group.kind) {
        [one, other] => sentences::write_or_2(&one.name(), &other.name()),
        _ if group.kind == GroupKind::Higher => sentences::GIVE_NEAR_INSTEAD.to_string(),
        _ => sentences::IT_HAS_ONE_CONFIGURATION_LEAVE.to_string(),
    };
    table.wrong(ErrorKind::Input, "mode", message).help(help)
}

/// Reads an approximate position. Returns the table of the position, the name of the point, and the coordinates (m).
fn rough_place(mut table: TomlTable) -> Result<(TomlTable, String, Vec2)> {
    let (name, place) = table.read(|table| {
        let name = table.string("point")?;
        let place = Vec2::new(table.si("x")?, table.si("y")?);
        table.finish()?;
        Ok((name, place))
    })?;
    Ok((table, name, place))
}

fn side_point(
    (table, name, place): (TomlTable, String, Vec2),
    mechanism: &Mechanism,
    group: &Group,
) -> Result<(SidePoint, Vec2)> {
    let points = group.links.iter().flat_map(|&link| {
        mechanism.links()[link]
            .points
            .iter()
            .map(move |point| (point.name.as_str(), JointSide { link, local: point.local }))
    });
    match points.clone().find(|&(point, _)| point == name) {
        Some((_, side)) => Ok((SidePoint { name, side }, place)),
        None => {
            let names = distinct(points.map(|(point, _)| point));
            let message = sentences::no_link_of_the_group_has_a_point(&name);
            table.refuse("point", message, suggestion(&name, names, "\""))
        }
    }
}

fn unknown_group(table: &TomlTable, links: &[LinkId], mechanism: &Mechanism, structure: &Structure) -> Error {
    let names: Vec<&str> = links.iter().map(|&link| mechanism.links()[link].name.as_str()).collect();
    let message = sentences::the_mechanism_has_no_assur(&names.join(", "));
    let groups: Vec<&Group> = structure.groups.iter().collect();
    let help = if groups.is_empty() {
        sentences::IT_HAS_NO_GROUP_AT_ALL_TAKE.to_string()
    } else {
        sentences::its_groups_are(&ready_to_paste(&groups, mechanism))
    };
    table.wrong(ErrorKind::Input, "links", message).help(help)
}

fn ready_to_paste(groups: &[&Group], mechanism: &Mechanism) -> String {
    let entry = |group: &&Group| {
        let names: Vec<String> =
            group.links.iter().map(|&link| format!("\"{}\"", mechanism.links()[link].name)).collect();
        let mode = match modes_of(group.kind) {
            [one, other] => sentences::mode_or(&one.name(), &other.name()),
            _ => "near = { point = \"...\", x_mm = ..., y_mm = ... }".to_string(),
        };
        sentences::start_groups_links(&names.join(", "), &mode)
    };
    let takes_mode = |group: &&&Group| !group.kind.has_one_configuration();
    groups.iter().filter(takes_mode).map(entry).collect::<Vec<_>>().join("\n")
}
