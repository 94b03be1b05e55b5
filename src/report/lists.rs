//! Lists of scenarios, channels and solvers.

use crate::sentences;
use std::fmt::Display;
use std::path::{Path, PathBuf};

use crate::plain::Tell;
use linkage::case::{Case, Seat};
use linkage::error::Result;
use linkage::mechanism::LinkId;
use linkage::trajectory::{CHANNELS, Channel};
use scenario::Scenario;

/// The scenario files of a directory with title and structure, or the reason why a file cannot be read.
pub(crate) fn scenarios(directory: &Path, all: &[(Result<Scenario>, PathBuf)], tell: Tell) -> String {
    let mut text = String::new();
    for (scenario, file) in all {
        let told = scenario.as_ref().map_or_else(
            |error| sentences::cannot_be_read_3(&(error.lines_by(tell).replace('\n', "\n    "))),
            |own| format!("{}\n    {}", own.title, own.case.structure.formula(&own.case.mechanism)),
        );
        say!(text, "{}\n    {told}", file.display());
    }
    if all.is_empty() {
        say!(text, sentences::no_scenario_files_toml_in(&directory.display()));
    }
    text
}

/// Every channel with its unit, its quantity and its stage of computation.
pub(crate) fn channels() -> String {
    let mut text = String::new();
    for kind in &CHANNELS {
        let of = if kind.subject.is_whole() { "" } else { "NAME" };
        let name = Channel { of: of.into(), kind }.to_string();
        say!(text, "{name:40} {:8} {:26} stage \"{}\"", kind.unit, kind.quantity, kind.stage.name());
    }
    text + sentences::COMPUTED_FROM_CHANNELS
}

/// Every channel of a case with its unit, its meaning and its stage of computation.
pub(crate) fn channels_of(case: &Case) -> String {
    let (all, seats) = (case.all_channels(), case.seats());
    let row = |own: &Channel| {
        let meaning = meaning(own, seats.of(own).expect("a channel of the case"), case);
        [own.to_string(), own.kind.unit.to_string(), meaning, own.kind.stage.name().into()]
    };
    let rows: Vec<[String; 4]> = all.iter().map(row).collect();
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or_default();
    let (name, meaning) = (width(0), width(2));
    let mut text = String::new();
    for [own, unit, what, stage] in &rows {
        say!(text, "{own:name$}  {unit:8} {what:meaning$}  stage \"{stage}\"");
    }
    text + sentences::COMPUTED_FROM_CHANNELS
}

/// Meaning of a channel of a case, in words.
fn meaning(channel: &Channel, seat: Seat, case: &Case) -> String {
    let (mechanism, of, quantity) = (&case.mechanism, channel.of.as_str(), channel.kind.quantity);
    let name = |link: LinkId| mechanism.links()[link].name.as_str();
    let what = match seat {
        Seat::Link(_) => sentences::of_link(&quantity, &of),
        Seat::Point(_) => format!("{quantity}, {of}"),
        Seat::Joint(joint) => {
            let joint = &mechanism.joints()[joint];
            sentences::in_on(&quantity, &of, &name(joint.first.link), &name(joint.second.link))
        }
        Seat::Transmission(index) => {
            let [first, second] = mechanism.transmissions()[index].design.links;
            sentences::in_on(&quantity, &of, &name(first), &name(second))
        }
        Seat::Frame => sentences::on_the_frame(&quantity),
        Seat::Drive(drive) => sentences::on_link(&quantity, &name(case.drives[drive].link)),
    };
    let letters = channel.kind.suffix.split('_').next().unwrap_or_default();
    match letters.chars().next_back().filter(|_| letters.len() <= 2) {
        Some(axis @ ('x' | 'y')) => sentences::along_world(&what, &axis),
        _ => what,
    }
}

/// Names of the analytic solvers, then names and versions of the engines.
pub(crate) fn solvers<'a, V: Display>(
    analytic: impl IntoIterator<Item = &'a str>,
    engines: impl IntoIterator<Item = (&'a str, V)>,
) -> String {
    let mut text = String::new();
    for name in analytic {
        say!(text, "{name:10} analytic");
    }
    for (name, version) in engines {
        say!(text, "{name:10} engine, {version}");
    }
    text
}
