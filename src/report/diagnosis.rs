//! Diagnoses in words, and as JSON.

use std::fmt::Write;

use serde::Serialize;

use crate::diagnosis::{Axis, Cause, Change, Diagnosis, How, Part, Since, Slip, Standing};
use crate::numbers::{fixed, significant};
use linkage::trajectory::Channel;

/// Column at which the text of a line begins.
pub(super) const INDENT: usize = 12;

/// Channels that are named; the others are counted.
const NAMED: usize = 3;

/// A diagnosis as lines of text, without a newline at the end.
#[must_use]
pub fn text(diagnosis: &Diagnosis) -> String {
    let mut text = format!("Diagnosis of {}:", diagnosis.suspect);
    let mut line = |what: &str, told: String| {
        let _ = write!(text, "\n  {what:<10}{told}");
    };
    line("alone", standing(&diagnosis.alone));
    if let Some(first) = diagnosis.since.first() {
        line("since", since(diagnosis, first));
    }
    let wrong = diagnosis.since.len();
    match &diagnosis.cause {
        None => line(
            "cause",
            format!("nothing simple: {} changed cases and all simple slips explain none of it", diagnosis.solved),
        ),
        Some(found) if diagnosis.is_explained() => {
            line(
                "cause",
                format!("{}; that explains all {} to within their bounds", cause(found), counted(wrong, "channel")),
            );
        }
        Some(found) => {
            let left = diagnosis.left_over.len();
            line("cause", format!("no single one; a part is explained by this: {}", cause(found)));
            line("left over", format!("{} of {}: {}", left, counted(wrong, "channel"), names(&diagnosis.left_over)));
        }
    }
    for one in &diagnosis.also {
        line("or", format!("{}, which explains as much", cause(one)));
    }
    text
}

fn counted(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}

/// Who stands against whom.
#[must_use]
pub fn standing(standing: &Standing) -> String {
    match standing {
        Standing::Together => "nobody: each is within the bounds of all others".into(),
        Standing::Alone(name) => format!("{name}; all others agree with each other"),
        Standing::Camps([one, other]) => format!("nobody: {} stand against {}", one.join(" and "), other.join(" and ")),
        Standing::Open(pairs) => {
            let pairs: Vec<String> = pairs.iter().map(|[one, other]| format!("{one} and {other}")).collect();
            format!("cannot be told: {} differ", pairs.join(", "))
        }
    }
}

fn since(diagnosis: &Diagnosis, first: &Since) -> String {
    let together: Vec<Channel> = diagnosis.first().iter().map(|one| one.channel.clone()).collect();
    let (time, crank) = (first.time, first.crank.to_degrees());
    let mut told =
        format!("t = {} s, crank angle {} deg, first in {}", fixed(time, 6), fixed(crank, 3), names(&together));
    if let Some(next) = diagnosis.since.get(together.len()) {
        let (time, crank) = (next.time, next.crank.to_degrees());
        let _ = write!(told, "; from {} s, {} deg, in {}", fixed(time, 6), fixed(crank, 3), next.channel);
        let more = diagnosis.since.len() - together.len() - 1;
        if more > 0 {
            let _ = write!(told, " and later in {more} more");
        }
    }
    told
}

fn names(channels: &[Channel]) -> String {
    let named: Vec<String> = channels.iter().take(NAMED).map(ToString::to_string).collect();
    match channels.len().saturating_sub(NAMED) {
        0 => named.join(", "),
        more => format!("{} and {more} more", named.join(", ")),
    }
}

/// A cause in words.
#[must_use]
pub fn cause(cause: &Cause) -> String {
    match cause {
        Cause::Values { slip: own, channels } => slip(own, channels),
        Cause::Case(own) => change(own),
    }
}

fn slip(slip: &Slip, channels: &[Channel]) -> String {
    let of = names(channels);
    let unit = channels.first().map_or("", |channel| channel.kind.unit.symbol());
    match slip {
        Slip::Sign => format!("the opposite sign of {of}"),
        Slip::Turns => format!("whole turns too much or too little in {of}"),
        Slip::Twice => format!("twice the values of {of}"),
        Slip::Half => format!("half the values of {of}"),
        Slip::Zero => format!("zero instead of {of}"),
        Slip::Unit { factor: _, told } => format!("another unit, {told}, in {of}"),
        Slip::PerRadian => format!("rates per radian of the crank instead of per second in {of}"),
        Slip::Offset(by) => {
            let by = if unit == "rad" {
                format!("{} deg", number(by.to_degrees()))
            } else {
                format!("{} {unit}", number(*by))
            };
            format!("{by} added at every instant to {of}")
        }
        Slip::Factor(factor) => format!("{} times the values of {of}", number(*factor)),
        Slip::Late { by, steps, stage } => {
            let what = stage.map_or("all channels".to_string(), |stage| stage.name().replace('_', " "));
            let how = if *by >= 0.0 { "late" } else { "early" };
            let size = number(by.abs());
            let steps = steps.map_or(String::new(), |steps| format!(", {} steps", number(steps.abs())));
            format!("{what} are {size} s{steps} too {how}")
        }
    }
}

/// A difference between two cases in words.
#[must_use]
pub fn change(change: &Change) -> String {
    let part = part(&change.part);
    match &change.how {
        How::Missing => format!("{part}: missing"),
        How::Reversed => format!("{part}: of the opposite sign"),
        How::Twice => format!("{part}: counted twice"),
        How::Half => format!("{part}: counted half"),
        How::Times(factor, told) => format!("{part}: {} times as large, {told}", number(*factor)),
        How::AtJoint(joint) => format!("{part}: at joint {joint}"),
        How::AboutJoint(joint) => format!("{part}: taken about joint {joint} instead of the mass centre"),
        How::Swapped => format!("{part}: x and y exchanged"),
        How::Other(mode) => format!("{part}: {mode}"),
        How::Instead { found, given, unit } => {
            let [found, given, unit] = match *unit {
                "rad" => [told(found.to_degrees(), given.to_degrees()), number(given.to_degrees()), " deg".into()],
                "" => [told(*found, *given), number(*given), String::new()],
                unit => [told(*found, *given), number(*given), format!(" {unit}")],
            };
            format!("{part}: {found}{unit} instead of {given}{unit}")
        }
    }
}

fn part(part: &Part) -> String {
    let axis = |axis: &Axis| match axis {
        Axis::X => "x",
        Axis::Y => "y",
    };
    match part {
        Part::Gravity => "gravity".into(),
        Part::InertiaForces => "inertia forces of all links".into(),
        Part::Inertias => "moments of inertia of all links".into(),
        Part::Masses => "masses of all links".into(),
        Part::Inertia(link) => format!("moment of inertia of {link}"),
        Part::Mass(link) => format!("mass of {link}"),
        Part::MassCentre(link) => format!("mass centre of {link}"),
        Part::MassCentreAlong(link, along) => format!("mass centre of {link}, {}", axis(along)),
        Part::Load(number, sort) => format!("load {number}, {}", sort.name().replace('_', " ")),
        Part::Configuration(group) => format!("another configuration of {group}"),
        Part::Speed(joint) => format!("speed of the drive at {joint}"),
        Part::StartAngle(joint) => format!("angle of the drive at {joint} at t = 0"),
        Part::InitialSpeed(joint) => format!("speed at {joint} at t = 0"),
        Part::MotorMoment => "moment of the motor".into(),
        Part::RotorInertia => "inertia of rotor and reducer".into(),
        Part::Place(joint, link, along) => format!("place of {joint} on {link}, {}", axis(along)),
    }
}

/// A number with so many digits that it differs from another.
fn told(value: f64, other: f64) -> String {
    let differ = |digits: &usize| significant(value, *digits) != significant(other, *digits);
    significant(value, (6..15).find(differ).unwrap_or(15))
}

/// A number with at most six significant digits.
fn number(value: f64) -> String {
    significant(value, 6)
}

/// A diagnosis in the JSON report.
#[derive(Debug, Serialize)]
pub struct Row {
    suspect: String,
    /// The party that stands alone, if one does, and how all of them stand to each other.
    alone: Option<String>,
    standing: String,
    /// The channels beyond their bounds, the earliest first.
    since: Vec<SinceRow>,
    /// The cause in words; `null` where nothing simple explains any of it.
    cause: Option<String>,
    /// Whether it explains all channels.
    explained: bool,
    /// Causes that explain as much.
    also: Vec<String>,
    left_over: Vec<String>,
    cases_tried: usize,
}

#[derive(Debug, Serialize)]
struct SinceRow {
    channel: String,
    t_s: f64,
    crank_rad: f64,
    difference: f64,
    bound: f64,
    instants_beyond: usize,
}

/// A diagnosis for the JSON report.
#[must_use]
pub fn row(diagnosis: &Diagnosis) -> Row {
    let since = |one: &Since| SinceRow {
        channel: one.channel.to_string(),
        t_s: one.time,
        crank_rad: one.crank,
        difference: one.difference,
        bound: one.bound,
        instants_beyond: one.beyond,
    };
    Row {
        suspect: diagnosis.suspect.clone(),
        alone: match &diagnosis.alone {
            Standing::Alone(name) => Some(name.clone()),
            Standing::Together | Standing::Camps(_) | Standing::Open(_) => None,
        },
        standing: standing(&diagnosis.alone),
        since: diagnosis.since.iter().map(since).collect(),
        cause: diagnosis.cause.as_ref().map(cause),
        explained: diagnosis.is_explained(),
        also: diagnosis.also.iter().map(cause).collect(),
        left_over: diagnosis.left_over.iter().map(ToString::to_string).collect(),
        cases_tried: diagnosis.solved,
    }
}
