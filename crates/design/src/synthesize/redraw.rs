//! Rewrites the text of a drawing's scenario with other dimensions.

use crate::sentences;
use toml_edit::{ArrayOfTables, DocumentMut, InlineTable, Item, TableLike, value};

use crate::synthesize::bars::BarMass;
use crate::synthesize::task::{Task, TaskNumber};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Vec2;
use linkage::mechanism::{GROUND, Link, LinkId, Mechanism, first_pose};
use precise::{Dual, Scalar};

/// Dimensions are rounded to the accuracy of a workshop.
/// The numbers are rounding steps per millimetre and rounding steps per degree.
const DECIMALS: [f64; 2] = [1e3, 1e4];

/// A number rounded to a multiple of 1 / `parts`.
fn rounded(value: f64, parts: f64) -> f64 {
    (value * parts).round() / parts
}

/// Values of a task's variables (SI), rounded as [`redrawn`] writes them: to a micrometre and a ten thousandth of a
/// degree.
pub fn round_values(task: &Task, values: &[f64]) -> Vec<f64> {
    let round = |(value, variable): (&f64, &crate::synthesize::task::Variable)| match variable.is_angle {
        true => rounded(value.to_degrees(), DECIMALS[1]).to_radians(),
        false => rounded(value * 1e3, DECIMALS[0]) / 1e3,
    };
    values.iter().zip(&task.variables).map(round).collect()
}

/// Sections that are valid only for the drawing's original dimensions: published numbers with their tables, formulas to
/// be checked, and the source of the dimensions.
const OWN: [&str; 3] = ["oracle", "formula", "source"];

/// The drawing `text` with new dimensions: the task's variables have the values `values` (SI).
/// The new text has the task's name, and `comment` at the top.
/// Sections that are valid only for the original dimensions are left out, and the comment names them.
/// Approximate positions at the start are replaced by the positions of the mechanism found.
/// If the task states the mass of bars, every moving link with several points gets the masses of slender bars.
/// These bars join the link's first point to each of its other points.
///
/// # Errors
/// [`ErrorKind::Input`] if the text is not the scenario from which the task was read.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the TOML parser")]
pub fn redrawn(task: &Task, text: &str, values: &[f64], comment: &str) -> Result<String> {
    let mut document: DocumentMut =
        text.parse().map_err(|error| Error::new(ErrorKind::Input, sentences::the_file_is_not_valid_toml(&error)))?;
    let left_out: Vec<&str> = OWN.into_iter().filter(|key| document.remove(key).is_some()).collect();
    let mut mechanism = task.case.mechanism.clone();
    document["name"] = value(task.name.as_str());
    document["title"] = value(task.title.as_str());
    for place in &task.places {
        place.apply(values, &mut mechanism);
        let body = &mechanism.links()[place.handle.link];
        let [a, b] = place.entries.map(|entry| entry.value(values));
        let written = match place.from {
            None => flat(Vec2::new(a, b)),
            Some(from) => InlineTable::from_iter([
                ("from", toml_edit::Value::from(body.points[from].name.as_str())),
                ("length_mm", rounded(a * 1e3, DECIMALS[0]).into()),
                ("angle_deg", rounded(b.to_degrees(), DECIMALS[1]).into()),
            ]),
        };
        let owner = link_table(&mut document, place.handle.link, &body.name)?;
        let points = owner.get_mut("points").and_then(Item::as_table_like_mut).ok_or_else(|| foreign(&body.name))?;
        points.insert(&body.points[place.handle.point].name, value(written));
    }
    if let TaskNumber::Free(index) = task.zero {
        let drive = match &mut document["drive"] {
            Item::ArrayOfTables(drives) => drives.get_mut(0).map(|table| table as &mut dyn TableLike),
            item => item.as_table_like_mut(),
        };
        let drive = drive.ok_or_else(|| foreign("drive"))?;
        drive.remove("zero_rad");
        drive.insert("zero_deg", value(rounded(values[index].to_degrees(), DECIMALS[1])));
    }
    if let Some(bar) = task.bar {
        for (index, body) in mechanism.links().entries().filter(|(index, _)| *index != GROUND) {
            weigh(link_table(&mut document, index, &body.name)?, body, bar);
        }
    }
    approach(&mut document, task, &mechanism, task.zero.value(values));
    let left_out = match &left_out[..] {
        [] => String::new(),
        keys => sentences::left_out_of_the_drawing_because(&keys.join(", ")),
    };
    let comment = comment.to_string() + &left_out;
    let comment: String = comment.lines().map(|line| format!("# {line}").trim_end().to_string() + "\n").collect();
    Ok(format!("{comment}\n{document}"))
}

/// Replaces the approximate positions at the start by the positions of the mechanism found.
/// `zero` is the angle of the crank (rad) from which crank angles are counted.
/// The drawing's approximate positions could select a wrong configuration of the mechanism found.
fn approach(document: &mut DocumentMut, task: &Task, mechanism: &Mechanism, zero: f64) {
    let case = &task.case;
    let start = [zero + case.crank().start];
    let Ok((pose, _)) = first_pose(mechanism, &case.structure, &start, &task.starts) else { return };
    let world = |name: &str| {
        mechanism.links().entries().skip(1).find_map(|(link, body)| {
            let point = body.points.iter().find(|point| point.name == name)?;
            Some(pose.0[link].point(point.local))
        })
    };
    let update = |near: &mut dyn TableLike| {
        let Some(at) = near.get("point").and_then(Item::as_str).and_then(world) else { return };
        ["x_m", "y_m"].iter().for_each(|key| drop(near.remove(key)));
        flat(at).into_iter().for_each(|(key, number)| drop(near.insert(&key, value(number))));
    };
    let groups = document.get_mut("start").and_then(|start| start.get_mut("groups"));
    for group in groups.and_then(Item::as_array_of_tables_mut).into_iter().flat_map(ArrayOfTables::iter_mut) {
        let Some(near) = group.get_mut("near") else { continue };
        if let Some(only) = near.as_table_like_mut() {
            update(only);
        } else if let Some(all) = near.as_array_mut() {
            all.iter_mut().filter_map(toml_edit::Value::as_inline_table_mut).for_each(|own| update(own));
        }
    }
}

fn foreign(name: &str) -> Error {
    Error::new(ErrorKind::Input, sentences::the_drawing_has_no_where(&name))
        .help(sentences::GIVE_THE_TEXT_OF_THE_SCENARIO)
}

/// The table of a link in the document: its entry in `links`, or the table `ground` for the ground.
fn link_table<'a>(document: &'a mut DocumentMut, link: LinkId, name: &str) -> Result<&'a mut dyn TableLike> {
    let item = match link {
        GROUND => document.get_mut("ground"),
        _ => document.get_mut("links").and_then(|links| links.get_mut(name)),
    };
    item.and_then(Item::as_table_like_mut).ok_or_else(|| foreign(name))
}

/// A position in the frame of its link (m), as a table of the scenario.
fn flat(place: Vec2) -> InlineTable {
    InlineTable::from_iter(
        [("x_mm", place.x), ("y_mm", place.y)].map(|(key, at)| (key, rounded(at * 1e3, DECIMALS[0]))),
    )
}

/// Writes the mass data of a link of slender bars that join its first point to each of its other points.
/// `bar` is the mass per length of a bar (kg/m).
fn weigh(table: &mut dyn TableLike, body: &Link, bar: f64) {
    let points: Vec<_> =
        body.points.iter().map(|point| [point.local.x, point.local.y].map(Dual::<f64, 0>::of)).collect();
    let Some(bars) = BarMass::of(&points, bar) else { return };
    let (mass, inertia) = (bars.mass.value, bars.inertia.value);
    let centre = Vec2::new(bars.centre[0].value, bars.centre[1].value);
    for key in ["mass_g", "mass_kg", "inertia_kg_m2", "mass_centre"] {
        table.remove(key);
    }
    table.insert("mass_kg", value(rounded(mass, 1e6)));
    // Six significant digits.
    let digits = 10f64.powi(5 - inertia.log10().floor() as i32);
    table.insert("inertia_kg_m2", value(rounded(inertia, digits)));
    table.insert("mass_centre", value(flat(centre)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkage::mechanism::Point;

    #[test]
    fn a_bar_has_its_mass_at_its_middle() {
        let point = |name: &str, x: f64, y: f64| Point { name: name.into(), local: Vec2::new(x, y) };
        let body = Link {
            name: "bar".into(),
            points: vec![point("A", 0.1, 0.0), point("B", 0.1, 0.2)],
            mass: 0.0,
            mass_centre: Vec2::zeros(),
            inertia: 0.0,
        };
        let mut table = toml_edit::Table::new();
        weigh(&mut table, &body, 2.0);
        let text = table.to_string();
        // The moment of inertia is m l^2 / 12 with m = 0.4 kg and l = 0.2 m.
        for line in ["mass_kg = 0.4", "inertia_kg_m2 = 0.00133333", "x_mm = 100.0, y_mm = 100.0"] {
            assert!(text.contains(line), "{line}: {text}");
        }
    }
}
