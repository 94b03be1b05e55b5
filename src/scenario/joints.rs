//! `[[joints]]`: which links are joined, and where.

use super::links::{NAME_HELP, sound_name};
use super::reader::Table;
use super::words::suggestion;
use crate::error::{ErrorKind, Result};
use crate::mechanism::{Joint, JointKind, Link, Side};

/// All joints, in the order of the file.
pub fn read(tables: Vec<Table>, links: &[Link]) -> Result<Vec<Joint>> {
    let mut joints: Vec<Joint> = Vec::new();
    for table in tables {
        let joint = joint(table, links, &joints)?;
        joints.push(joint);
    }
    Ok(joints)
}

fn joint(mut table: Table, links: &[Link], before: &[Joint]) -> Result<Joint> {
    let name = table.string("name")?;
    if !sound_name(&name) {
        let message = format!("\"{name}\" cannot be the name of a joint");
        return Err(table.wrong(ErrorKind::Input, "name", message).help(NAME_HELP));
    }
    if before.iter().any(|joint| joint.name == name) {
        let message = format!("two joints are called \"{name}\"");
        return Err(table
            .wrong(ErrorKind::Input, "name", message)
            .help("give every joint its own name; two joints on one pin share the point instead: `point = \"...\"`"));
    }
    let kind = kind(&mut table)?;
    let pair = table.strings("links")?;
    let point = table.optional_string("point")?;
    table.finish()?;
    let [first, second] = &pair[..] else {
        let message = format!("found {} links, but a joint has two", pair.len());
        return Err(table.wrong(ErrorKind::Input, "links", message).help("write `links = [\"ground\", \"crank\"]`"));
    };
    let (first, second) = (link(&table, first, links)?, link(&table, second, links)?);
    if first == second {
        let message = format!("it joins \"{}\" with itself", links[first].name);
        return Err(table.wrong(ErrorKind::Input, "links", message).help("name two different links"));
    }
    if let Some(other) = before.iter().find(|joint| joint.on(first).is_some() && joint.on(second).is_some()) {
        let message = format!(
            "joint \"{}\" joins \"{}\" and \"{}\" already; two revolute joints lock two links together",
            other.name, links[first].name, links[second].name
        );
        return Err(table
            .wrong(ErrorKind::Input, "links", message)
            .help("make the two one link with all their points, or join other links"));
    }
    let (key, point) = match &point {
        Some(point) => ("point", point),
        None => ("name", &name),
    };
    let side = |link: usize| -> Result<Side> {
        let points = &links[link].points;
        let found = points.iter().find(|found| found.name == *point);
        let local = found.map(|found| found.local).ok_or_else(|| {
            let message = format!("link \"{}\" has no point \"{point}\"", links[link].name);
            let points = points.iter().map(|point| point.name.as_str());
            let near = suggestion(point, points, "\"");
            table
                .wrong(ErrorKind::Input, key, message)
                .help(format!("a joint lies at the point of its name, or of its key `point`, on both links; {near}"))
        })?;
        Ok(Side { link, local })
    };
    let (first, second) = (side(first)?, side(second)?);
    Ok(Joint { name, kind, first, second })
}

fn kind(table: &mut Table) -> Result<JointKind> {
    match table.string("type")?.as_str() {
        "revolute" => Ok(JointKind::Revolute),
        "prismatic" => Err(table
            .wrong(ErrorKind::Unsupported, "type", "prismatic joints are not handled by this version")
            .help("only `type = \"revolute\"` is handled so far")),
        other => Err(table
            .wrong(ErrorKind::Input, "type", format!("\"{other}\" is no type of joint"))
            .help(suggestion(other, ["revolute"], "\""))),
    }
}

/// Index of the link called `name`; unknown names are errors of the key `links` or `link` of `table`.
pub fn link(table: &Table, name: &str, links: &[Link]) -> Result<usize> {
    let key = if table.has("links") { "links" } else { "link" };
    links.iter().position(|link| link.name == name).ok_or_else(|| {
        let names = links.iter().map(|link| link.name.as_str());
        let error = table.wrong(ErrorKind::Input, key, format!("there is no link \"{name}\""));
        error.help(suggestion(name, names, "\""))
    })
}
