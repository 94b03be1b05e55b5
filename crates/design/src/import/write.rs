//! The text of the scenario.

use super::parts::{DrivePart, FRAME, LinkPart, PartPair, Parts};
use crate::sentences;
use linkage::math::{KeepNan, Vec2};
use std::fmt::Write;

/// The text of the scenario called `name`. `groups` is the text of the tables `[[start.groups]]`, and `grid` is the
/// text of the grid.
pub(super) fn text(parts: &Parts, name: &str, groups: &str, grid: &str) -> String {
    let mut text = format!("# {}\n", sentences::imported_from(&parts.source));
    for told in &parts.told {
        let _ = writeln!(text, "# - {}", files::visible(told));
    }
    let _ = writeln!(text, "format = 1\nname = {name:?}\ntitle = {}\n", quoted(&parts.title));
    let writer = Writer::of(parts);
    text += "[ground.points]\n";
    writer.points(&mut text, &parts.links[FRAME]);
    if !parts.is_exact {
        let _ = writeln!(text, "\n# {}", sentences::THE_FRAME_OF_A_LINK_BEGINS_AT);
    }
    for link in &parts.links[1..] {
        let key = key(&link.name);
        if let Some(mass) = link.mass {
            let _ = writeln!(text, "\n[links.{key}]\nmass_{} = {}", parts.units.mass, number(mass.mass));
            let _ = writeln!(text, "mass_centre = {}", writer.place(mass.centre));
            let _ = writeln!(text, "inertia_kg_m2 = {}", number(mass.inertia));
        } else {
            text.push('\n');
        }
        let _ = writeln!(text, "[links.{key}.points]");
        writer.points(&mut text, link);
    }
    joints(&mut text, parts);
    tables(&mut text, parts, |heading| heading == "[[transmissions]]");
    drives(&mut text, &writer);
    tables(&mut text, parts, |heading| heading != "[[transmissions]]");
    if let Some(gravity) = parts.gravity {
        let [x, y] = [gravity.x, gravity.y].map(number);
        let _ = writeln!(text, "\n[gravity]\nx_m_s2 = {x}\ny_m_s2 = {y}");
    }
    text + &start(&writer) + groups + grid
}

/// The section `[start]`, without its groups.
fn start(writer: &Writer) -> String {
    let first = writer.parts.drives.first().filter(|drive| writer.is_crank(drive.joint));
    let crank = first.map(|drive| writer.start(drive));
    let keys: String = crank.map(|own| format!("crank_{own}\n")).unwrap_or_default();
    format!("\n# {}\n[start]\n{keys}", sentences::THE_POSE_IS_THAT_OF_THE_SOURCE)
}

fn joints(text: &mut String, parts: &Parts) {
    for joint in &parts.joints {
        let links = joint.links.map(|link| quoted(&parts.links[link].name)).join(", ");
        let (kind, keys) = match &joint.pair {
            PartPair::Pin(point) if *point == joint.name => ("revolute", String::new()),
            PartPair::Pin(point) => ("revolute", format!("point = {}\n", quoted(point))),
            PartPair::Slide { points, axes } => {
                let points = points.each_ref().map(|point| quoted(point)).join(", ");
                let [own, second] = axes.map(degrees);
                let second = if axes[1] == 0.0 { String::new() } else { format!("second_axis_deg = {second}\n") };
                ("prismatic", format!("points = [{points}]\naxis_deg = {own}\n{second}"))
            }
        };
        let name = quoted(&joint.name);
        let _ = writeln!(text, "\n[[joints]]\nname = {name}\ntype = \"{kind}\"\nlinks = [{links}]\n{keys}");
        text.truncate(text.trim_end().len());
        text.push('\n');
    }
}

fn drives(text: &mut String, writer: &Writer) {
    let parts = writer.parts;
    let heading = if parts.drives.len() == 1 { "[drive]" } else { "[[drive]]" };
    for (index, drive) in parts.drives.iter().enumerate() {
        let unit = match parts.joints[drive.joint].pair {
            PartPair::Pin(_) => drive.turning.to_string(),
            PartPair::Slide { .. } => format!("{}_s", parts.units.length),
        };
        let name = quoted(&parts.joints[drive.joint].name);
        let _ = writeln!(text, "\n{heading}\njoint = {name}\nspeed_{unit} = {}", number(drive.speed));
        if let Some((rate, _)) = drive.free {
            let _ = writeln!(text, "motion = \"free\"\ninitial_speed_{unit} = {}", number(rate));
        }
        if index > 0 || !writer.is_crank(drive.joint) {
            let _ = writeln!(text, "start_{}", writer.start(drive));
        }
    }
}

fn tables(text: &mut String, parts: &Parts, is_wanted: impl Fn(&str) -> bool) {
    for (heading, keys) in parts.tables.iter().filter(|(heading, _)| is_wanted(heading)) {
        let _ = writeln!(text, "\n{heading}");
        for (key, value) in keys {
            let _ = writeln!(text, "{key} = {value}");
        }
    }
}

/// A mechanism, and the step to which its coordinates are rounded in the text.
pub(super) struct Writer<'a> {
    parts: &'a Parts,
    step: f64,
}

impl<'a> Writer<'a> {
    pub(super) fn of(parts: &'a Parts) -> Writer<'a> {
        let size = parts.size();
        let is_rounded = !parts.is_exact && size > 0.0;
        let step = if is_rounded { 10f64.powf(size.log10().floor() - 11.0).larger(parts.rounding) } else { 0.0 };
        Writer { parts, step }
    }

    fn length(&self, value: f64) -> String {
        if self.step > 0.0 {
            // A whole number divided by a power of ten gives the double nearest to the decimal number. The text then
            // has no further digits.
            let per = (1.0 / self.step).round();
            let rounded = if per > 1.0 { (value * per).round() / per } else { (value / self.step).round() * self.step };
            return number(rounded);
        }
        number(value)
    }

    /// A position as an inline table.
    pub(super) fn place(&self, place: Vec2) -> String {
        format!("{{ {} }}", self.coordinates(place))
    }

    /// The two coordinates of a position, each with its key.
    pub(super) fn coordinates(&self, place: Vec2) -> String {
        let [x, y] = [place.x, place.y].map(|value| self.length(value));
        let unit = self.parts.units.length;
        format!("x_{unit} = {x}, y_{unit} = {y}")
    }

    fn points(&self, text: &mut String, link: &LinkPart) {
        for (name, place) in &link.points {
            let _ = writeln!(text, "{} = {}", key(name), self.place(*place));
        }
    }

    /// Whether a driven joint has a crank angle as its input.
    fn is_crank(&self, joint: usize) -> bool {
        let joint = &self.parts.joints[joint];
        matches!(joint.pair, PartPair::Pin(_)) && joint.links.contains(&FRAME)
    }

    /// Start value of a drive: the text that follows `start_` or `crank_` in the scenario, from the unit on.
    fn start(&self, drive: &DrivePart) -> String {
        let value = self.parts.start(drive);
        match self.parts.joints[drive.joint].pair {
            PartPair::Pin(_) => format!("deg = {}", degrees(value)),
            PartPair::Slide { .. } => format!("{} = {}", self.parts.units.length, self.length(value)),
        }
    }
}

/// An angle in degrees.
pub(super) fn degrees(angle: f64) -> String {
    // An angle that differs from whole degrees only by rounding is written as whole degrees.
    let (own, whole) = (angle.to_degrees(), angle.to_degrees().round());
    number(if (own - whole).abs() < 1e-12 * own.abs() { whole } else { own })
}

/// The shortest text from which a parser reads the same number.
pub(super) fn number(value: f64) -> String {
    let text = format!("{:?}", value + 0.0);
    text.strip_suffix(".0").map_or(text.clone(), Into::into)
}

/// A text in quotes. Control characters, which TOML does not allow, are escaped.
pub(super) fn quoted(text: &str) -> String {
    format!("\"{}\"", files::visible(text).replace('\\', "\\\\").replace('"', "\\\""))
}

/// A name as a key.
fn key(name: &str) -> String {
    let is_bare = name.bytes().all(|byte| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-'));
    if is_bare { name.into() } else { quoted(name) }
}
