//! Diagnoses in words.

use super::cells::{counted, some};
use linkage::trajectory::{Channel, Stage};
use prover::diagnosis::{Arm, Axis, Cause, Change, Diagnosis, How, Nature, Over, Part, Plain, Since, Slip, Standing};
use prover::numbers::{fixed, significant, with_unit};

/// Column at which the text of a line begins.
pub const INDENT: usize = 12;

/// Note on a diagnosis that ended early.
pub const CUT: &str =
    "The search for a cause ended at its limit of work, before all causes were tried: allow more work.";

/// Channels that are named; the others are counted.
const NAMED: usize = 3;

/// A diagnosis as lines of text, without a newline at the end.
#[must_use]
pub fn text(diagnosis: &Diagnosis) -> String {
    let mut text = format!("Diagnosis of {}:", diagnosis.suspect);
    let mut line = |what: &str, told: String| {
        put!(text, "\n  {what:<10}{told}");
    };
    line("alone", standing(&diagnosis.alone));
    if let Some(first) = diagnosis.since.first() {
        line("since", since(diagnosis, first));
    }
    let (wrong, solved) = (counted(diagnosis.since.len(), "channel"), diagnosis.solved);
    match &diagnosis.cause {
        None => {
            line("cause", format!("nothing simple: {solved} changed cases and all simple slips explain none of it"));
        }
        Some(found) if diagnosis.is_explained() => {
            line("cause", format!("{}; that explains all {wrong} to within their bounds", cause(found)));
        }
        Some(found) => {
            line("cause", format!("no single one; a part is explained by this: {}", cause(found)));
            let left = &diagnosis.left_over;
            line("left over", format!("{} of {wrong}: {}", left.len(), names(left)));
        }
    }
    if let Some(own) = diagnosis.nature {
        line("error", nature(own));
    }
    for one in &diagnosis.also {
        line("or", format!("{}, which explains as much", cause(one)));
    }
    text
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
        put!(told, "; from {} s, {} deg, in {}", fixed(time, 6), fixed(crank, 3), next.channel);
        let more = diagnosis.since.len() - together.len() - 1;
        if more > 0 {
            put!(told, " and later in {more} more");
        }
    }
    told
}

fn names(channels: &[Channel]) -> String {
    some(channels, NAMED)
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
        Slip::Plain(own) => plain(*own, &of),
        Slip::Unit { factor: _, told } => format!("another unit, {told}, in {of}"),
        Slip::Offset(by) => format!("{} added at every instant to {of}", amount(*by, unit)),
        Slip::Mirrored(by) => {
            format!("{of} counted the other way round, from another axis: {} less the right value", amount(*by, unit))
        }
        Slip::Instead(other) => format!("the values of {other} in place of {of}"),
        Slip::Opposite(other) => format!("the values of {other} with the opposite sign in place of {of}"),
        Slip::Magnitude([one, other]) => format!("the magnitude of {one} and {other} in place of {of}"),
        Slip::Differences { of: other, order, over } => {
            let (order, over) = (if *order == 1 { "" } else { "second " }, rows_of(*over));
            format!(
                "{order}differences of {other} over {over}, or such of its like, in place of {of}: take closer rows"
            )
        }
        Slip::NoCoriolis(joint) => format!("the Coriolis acceleration of the block at {joint} is missing in {of}"),
        Slip::About(Arm::Constant([x, y])) => {
            format!("{of} about another point, by ({}, {}) m away", number(*x), number(*y))
        }
        Slip::About(Arm::Between(None, to)) => format!("{of} about {to} instead of the origin"),
        Slip::About(Arm::Between(Some(from), to)) => format!("{of} about {to} instead of {from}"),
        Slip::Outlier(time) => format!("one row alone, at t = {} s, in {of}: an outlier", number(*time)),
        Slip::Clock { factor, told: Some(told) } => {
            format!("another unit of time: {told}, {} times the time of a row", number(*factor))
        }
        Slip::Clock { factor, told: None } => {
            let how = if *factor < 1.0 { "fast" } else { "slow" };
            let by = told_apart(factor.recip(), 1.0);
            format!("the clock of all rows is too {how}: the time of a row is {by} times that of its values")
        }
        Slip::Exchanged([one, other]) => format!("{one} and {other} exchanged"),
        Slip::Between { of: [first, second], offset: 0.0 } => {
            format!("{first} less {second} in place of {of}: counted from another link")
        }
        Slip::Between { of: [first, second], offset } => format!(
            "{first} less {second} and {} more in place of {of}: counted from another link",
            amount(*offset, unit)
        ),
        Slip::Factor(factor) => format!("{} times the values of {of}", number(*factor)),
        Slip::Late { by, steps, stage } => {
            let what = stage.map_or("all channels".to_string(), |stage| stage.name().replace('_', " "));
            let how = if *by >= 0.0 { "late" } else { "early" };
            let size = duration(by.abs());
            let steps = steps.map_or(String::new(), |(steps, told)| {
                let several = if steps.abs() > 1.0 { "s" } else { "" };
                format!(", {} {told}{several}", number(steps.abs()))
            });
            let are = if *stage == Some(Stage::BalancingMoment) { "is" } else { "are" };
            format!("{what} {are} {size}{steps} too {how}")
        }
    }
}

fn plain(slip: Plain, of: &str) -> String {
    match slip {
        Plain::Sign => format!("the opposite sign of {of}"),
        Plain::Turns => format!("whole turns too much or too little in {of}"),
        Plain::HalfTurns => format!("half turns too much or too little in {of}, as an arc tangent of a quotient gives"),
        Plain::Twice => format!("twice the values of {of}"),
        Plain::Half => format!("half the values of {of}"),
        Plain::Zero => format!("zero instead of {of}"),
        Plain::Size => format!("the sign of {of} is lost"),
        Plain::ArcSine => format!("{of} from its sine: beyond a quarter turn it is folded back"),
        Plain::PerRadian => format!("rates per radian of the crank instead of per second in {of}"),
    }
}

fn rows_of(over: Over) -> String {
    match over {
        Over::Either(1) => "the row before and the one behind".into(),
        Over::Either(rows) => format!("{rows} rows before and behind"),
        Over::Before => "the row and the one before".into(),
        Over::Behind => "the row and the one behind".into(),
    }
}

/// A short time in ms, a longer one in s.
fn duration(seconds: f64) -> String {
    if seconds < 0.1 { format!("{} ms", number(1e3 * seconds)) } else { format!("{} s", number(seconds)) }
}

/// What an error without a simple cause looks like.
#[must_use]
pub fn nature(nature: Nature) -> String {
    let percent = prover::numbers::percent;
    match nature {
        Nature::Growing(power) => {
            let how = power.map_or(String::new(), |power| match power {
                1 => ", about in proportion to it".into(),
                power => format!(", about with its power of {power}"),
            });
            format!("the error grows with time{how}: integration, or the step of it")
        }
        Nature::Smooth(share) => {
            format!("the error is smooth, at most {} of the scale: integration or step", percent(share))
        }
        Nature::Noise(share) => {
            format!("the error has no order, at most {} of the scale: noise, or few digits on the way", percent(share))
        }
    }
}

/// A fitted amount with its unit; angles in degrees.
fn amount(by: f64, unit: &str) -> String {
    if unit == "rad" { format!("{} deg", number(by.to_degrees())) } else { format!("{} {unit}", number(by)) }
}

/// A difference between two cases in words.
#[must_use]
pub fn change(change: &Change) -> String {
    let how = match &change.how {
        How::Missing => "missing".into(),
        How::Reversed => "of the opposite sign".into(),
        How::Twice => "counted twice".into(),
        How::Half => "counted half".into(),
        How::Times(factor, told) => format!("{} times as large, {told}", number(*factor)),
        How::AtJoint(joint) => format!("at joint {joint}"),
        How::AtPoint(point) => format!("at point {point}"),
        How::FromJoint([one, other]) => format!("measured from the wrong end, {one} and {other} exchanged"),
        How::Across([one, other]) => format!("mirrored at the line of {one} and {other}"),
        How::Middle([one, other]) => format!("in the middle of {one} and {other}"),
        How::Turned(by) => format!("turned by {} deg", number(by.to_degrees())),
        How::AboutJoint(joint) => format!("taken about joint {joint} instead of the mass centre"),
        How::Swapped => "x and y exchanged".into(),
        How::Other(mode) => (*mode).to_string(),
        How::Instead { found, given, unit } => {
            let (factor, unit) = if *unit == "rad" { (1f64.to_degrees(), "deg") } else { (1.0, *unit) };
            let [found, given] = [found, given].map(|value| factor * value);
            let [found, given] = [told_apart(found, given), number(given)].map(|own| with_unit(&own, unit));
            format!("{found} instead of {given}")
        }
    };
    format!("{}: {how}", part(&change.part))
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
        Part::Body(link) => format!("mass and inertia of {link}"),
        Part::Weight(link) => format!("weight of {link}"),
        Part::Inert(link) => format!("inertia forces of {link}"),
        Part::Length(one, other, link) => format!("distance of {one} and {other} on {link}"),
        Part::MassCentre(link) => format!("mass centre of {link}"),
        Part::MassCentreAlong(link, along) => format!("mass centre of {link}, {}", axis(along)),
        Part::Load(number, sort) => format!("load {number}, {}", sort.replace('_', " ")),
        Part::Free(number) => format!("free length of load {number}, spring"),
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
pub fn told_apart(value: f64, other: f64) -> String {
    let differ = |digits: &usize| significant(value, *digits) != significant(other, *digits);
    significant(value, (6..15).find(differ).unwrap_or(15))
}

/// A number with at most six significant digits.
pub fn number(value: f64) -> String {
    significant(value, 6)
}
