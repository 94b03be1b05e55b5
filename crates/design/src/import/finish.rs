//! The last steps of an import: the assembly modes of the start pose, and a grid that the mechanism can follow.

use super::parts::{PartPair, Parts};
use super::write::{self, Writer, number, quoted};
use crate::sentences;
use analytic::range::{ASIDE, Extent, reachable};
use linkage::case::Case;
use linkage::error::{Error, Result};
use linkage::math::KeepNan;
use linkage::mechanism::assembly::{Configuration, configurations};
use linkage::mechanism::{Group, LinkId, LinkPose, Mechanism, Pose};
use linkage::work::limited;
use scenario::{Draft, Scenario, StartRequest};
use std::fmt::Write;
use std::path::Path;

/// The scenario of a mechanism of another program.
#[derive(Debug)]
pub struct ImportedScenario {
    /// Text of the scenario file.
    pub text: String,
    /// Lines that name the parts of the source that were not understood, and lines that state assumptions.
    /// The scenario's text has these lines as comments.
    pub told: Vec<String>,
    /// The reason why the scenario does not run, if there is one.
    pub problem: Option<Error>,
}

/// Number of steps of a grid that is not a whole turn.
const STEPS: f64 = 60.0;
/// The grid covers this fraction of the way from the start to a dead point.
/// Towards a dead point, accelerations grow without bound.
const SHARE: f64 = 0.9;

/// The scenario of a mechanism, with the reason why it cannot run, if there is one.
pub(super) fn finished(mut parts: Parts, name: &str) -> ImportedScenario {
    let path = Path::new(name);
    let groups = groups(&parts, name, path);
    let first = first_grid(&parts);
    let case = Scenario::parse(&write::text(&parts, name, &groups, &first), path).map(|scenario| scenario.case);
    let grid = case.as_ref().map_or(first, |case| grid(&mut parts, case));
    let text = write::text(&parts, name, &groups, &grid);
    let problem = Scenario::parse(&text, path).err();
    ImportedScenario { text, told: parts.told, problem }
}

/// The tables `[[start.groups]]`; empty if the mechanism has no groups.
fn groups(parts: &Parts, name: &str, path: &Path) -> String {
    let Ok(draft) = Draft::parse(&write::text(parts, name, "", ""), path, &StartRequest::default()) else {
        return String::new();
    };
    let Ok(structure) = &draft.structure else { return String::new() };
    let metres = parts.units.metres;
    let in_metres = |pose: LinkPose| LinkPose { origin: pose.origin * metres, ..pose };
    let pose = Pose(parts.links.iter().map(|link| in_metres(link.pose)).collect());
    let groups = structure.at_start().groups.iter().filter(|group| !group.kind.has_one_configuration());
    groups.map(|group| table(parts, &draft.mechanism, group, &pose)).collect()
}

/// The start of one group: the assembly mode of a dyad, or approximate positions of two points of every link.
fn table(parts: &Parts, mechanism: &Mechanism, group: &Group, pose: &Pose) -> String {
    let names: Vec<String> = group.links.iter().map(|&link| quoted(&mechanism.links()[link].name)).collect();
    let mut text = format!("\n[[start.groups]]\nlinks = [{}]\n", names.join(", "));
    let off = |own: &Configuration| -> f64 {
        let off = |(&link, found): (&LinkId, &LinkPose)| {
            let points = &mechanism.links()[link].points;
            points.iter().map(|point| (found.point(point.local) - pose.0[link].point(point.local)).norm()).sum::<f64>()
        };
        group.links.iter().zip(&own.links).map(off).sum()
    };
    let all = if group.kind.modes().is_some() { configurations(mechanism, group, pose) } else { Ok(Vec::new()) };
    if let Some(nearest) = all.unwrap_or_default().iter().min_by(|a, b| off(a).total_cmp(&off(b))) {
        let _ = writeln!(text, "mode = \"{}\"", nearest.mode.name());
        return text;
    }
    let mut near = Vec::new();
    for link in group.links.iter().map(|link| link.index()) {
        let points = &parts.links[link].points;
        let far = points.iter().rev().take(if points.len() > 1 { 1 } else { 0 });
        near.extend(points.iter().take(1).chain(far).map(|(point, _)| {
            let place = Writer::of(parts).coordinates(parts.world(link, point));
            format!("  {{ point = {}, {place} }},\n", quoted(point))
        }));
    }
    near.dedup();
    let _ = writeln!(text, "near = [\n{}]", near.concat());
    text
}

/// A grid with only the start instant. For a free motion, the grid covers the first second.
fn first_grid(parts: &Parts) -> String {
    let Some(drive) = parts.drives.first() else { return String::new() };
    if parts.drives.iter().any(|drive| drive.free.is_some()) {
        return "\n[grid]\nfrom_s = 0\nto_s = 1\nstep_s = 0.01\n".into();
    }
    let at = parts.start(drive);
    match parts.joints[drive.joint].pair {
        PartPair::Pin(_) => format!("\n[grid]\nangles_deg = [{}]\n", write::degrees(at)),
        PartPair::Slide { .. } => format!("\n[grid]\nslides_m = [{}]\n", number(at * parts.units.metres)),
    }
}

/// The grid from the start in the direction of motion: a whole turn, or 0.9 of the way to the limit of the motion. A
/// grid of a slide is not longer than the drive's travel.
fn grid(parts: &mut Parts, case: &Case) -> String {
    let crank = case.crank();
    if case.drives.iter().any(|drive| drive.is_free()) {
        return first_grid(parts);
    }
    let input = crank.input;
    let (start, sense) = (input.shown(crank.start), crank.sense());
    let unit = input.shown_in().0;
    let travel = parts.drives.first().and_then(|drive| drive.travel).map(|own| input.shown(own * parts.units.metres));
    let extent: Result<Extent> = limited(ASIDE, || reachable(case)).0;
    let (step, count) = match extent {
        Ok(Extent::FullTurn(_)) => (5.0, 72.0),
        Ok(Extent::Limited(limits)) => {
            let [from, to] = limits.map(|limit| input.shown(limit.crank));
            parts.told.push(sentences::the_input_reaches_only(&input.noun(), &from, &to, &unit));
            let way = SHARE * if sense > 0.0 { to - start } else { start - from };
            (rounded(travel.map_or(way, |travel| way.smaller(travel)) / STEPS), STEPS)
        }
        // If the limits of the motion are unknown, the grid covers the drive's travel. If the travel is unknown too,
        // the grid covers a small fraction of the mechanism's size, or a small angle.
        Err(_) => {
            let small = input.shown(0.1 * if unit == "mm" { case.mechanism.size() } else { 1.0 });
            (rounded(travel.unwrap_or(small) / STEPS), STEPS)
        }
    };
    let [from, to, step] = [start, start + sense * count * step, sense * step].map(number);
    format!("\n[grid]\nfrom_{unit} = {from}\nto_{unit} = {to}\nstep_{unit} = {step}\n")
}

/// Rounds a number down to two significant digits.
fn rounded(value: f64) -> f64 {
    let digit = 10f64.powf(value.log10().floor() - 1.0);
    (value / digit).floor() * digit
}
