//! Causes that are seen in the values alone: sign, unit, factor, offset, whole turns.

use std::f64::consts::{PI, TAU};

use super::cause::{Cause, Slip};
use super::knobs::significant;
use super::question::{Found, Judged, Question, Rank};
use crate::compare::{differences, magnitudes};
use linkage::math::{KeepNan, largest_size};
use linkage::trajectory::{Channel, Stage, Unit};

/// The part of a bound below which the reference itself is not known, as a share of the size of its numbers.
pub(super) const KNOWN: f64 = 1e-10;

const ANGULAR: &[Unit] = &[Unit::Radian, Unit::RadianPerSecond, Unit::RadianPerSecondSquared];
const LENGTHS: &[Unit] = &[Unit::Metre, Unit::MetrePerSecond, Unit::MetrePerSecondSquared];
const FORCES: &[Unit] = &[Unit::Newton, Unit::NewtonMetre];

/// Units that are taken for each other: the units of the channels, the factor on their values, what is meant.
const UNITS: &[(&[Unit], f64, &str)] = &[
    (ANGULAR, 180.0 / PI, "degrees instead of radians"),
    (ANGULAR, PI / 180.0, "radians taken for degrees and converted once more"),
    (&[Unit::RadianPerSecond], 30.0 / PI, "revolutions per minute instead of rad/s"),
    (&[Unit::RadianPerSecond], PI / 30.0, "rad/s taken for revolutions per minute"),
    (ANGULAR, 1.0 / TAU, "turns instead of radians"),
    (LENGTHS, 1e3, "millimetres instead of metres"),
    (LENGTHS, 1e-3, "metres taken for millimetres"),
    (LENGTHS, 1e2, "centimetres instead of metres"),
    (LENGTHS, 1e-2, "metres taken for centimetres"),
    (LENGTHS, 1.0 / 0.0254, "inches instead of metres"),
    (FORCES, 1e3, "a thousandfold, as g for kg or mN for N"),
    (FORCES, 1e-3, "a thousandth, as kg for g or kN for N"),
    (FORCES, 1.0 / 9.806_65, "kiloponds instead of newtons"),
    (FORCES, 9.806_65, "newtons taken for kiloponds"),
];

/// A disagreeing channel with its values.
pub(super) struct Wrong<'a> {
    pub(super) channel: &'a Channel,
    pub(super) right: &'a [f64],
    pub(super) found: &'a [f64],
    pub(super) bound: f64,
    /// Constant speed of the crank (rad/s), if it has one.
    speed: Option<f64>,
}

/// Every slip with the channels that it explains. A slip with a number that was fitted counts only where it explains
/// all of them: for one channel a number can always be found.
pub(super) fn found(question: &Question) -> Vec<Found> {
    let wrong = wrong(question);
    let mut causes = Vec::new();
    for slip in plain() {
        let explained: Vec<Channel> =
            wrong.iter().filter(|wrong| wrong.is_explained_by(&slip)).map(|wrong| wrong.channel.clone()).collect();
        if !explained.is_empty() {
            let cause = Cause::Values { slip, channels: explained.clone() };
            causes.push(Found { cause, rank: Rank::Slip, explained });
        }
    }
    let angle = wrong.iter().all(|wrong| wrong.channel.kind.unit == Unit::Radian);
    let explains_all = |slip: &Slip| wrong.iter().all(|wrong| wrong.is_explained_by(slip));
    for slip in fitted(&wrong) {
        if explains_all(&slip) {
            let slip = (2..=9).map(|digits| with_digits(&slip, digits, angle)).find(explains_all).unwrap_or(slip);
            let explained: Vec<Channel> = wrong.iter().map(|wrong| wrong.channel.clone()).collect();
            let cause = Cause::Values { slip, channels: explained.clone() };
            causes.push(Found { cause, rank: Rank::Fitted, explained });
        }
    }
    causes
}

/// The disagreeing channels.
pub(super) fn wrong<'a>(question: &'a Question) -> Vec<Wrong<'a>> {
    let sizes = magnitudes(question.reference);
    let speed = question.case.crank().constant_speed().filter(|_| question.case.is_steady());
    let of = |judged: &'a Judged| {
        let channel = &judged.channel;
        let place = question.reference.channels().iter().position(|own| own == channel)?;
        let (right, found) = (question.reference.column(channel)?, question.suspicious.column(channel)?);
        Some(Wrong { channel, right, found, bound: judged.bound.larger(KNOWN * sizes[place]), speed })
    };
    question.judged.iter().filter(|judged| judged.disagrees).filter_map(of).collect()
}

/// Slips without a free number, the simplest first.
fn plain() -> impl Iterator<Item = Slip> {
    let units = UNITS.iter().map(|&(_, factor, told)| Slip::Unit { factor, told });
    [Slip::Sign, Slip::Turns, Slip::Twice, Slip::Half, Slip::Zero].into_iter().chain(units).chain([Slip::PerRadian])
}

/// Slips whose number comes from the channel that is farthest beyond its bound.
fn fitted(wrong: &[Wrong]) -> Vec<Slip> {
    let far = |one: &Wrong| largest_size(&differences(one.right, one.found, one.channel.kind.periodic)) / one.bound;
    let Some(worst) = wrong.iter().max_by(|a, b| far(a).total_cmp(&far(b))) else { return Vec::new() };
    let gaps = differences(worst.right, worst.found, worst.channel.kind.periodic);
    let squares: f64 = worst.right.iter().map(|value| value * value).sum();
    let products: f64 = worst.right.iter().zip(worst.found).map(|(right, found)| right * found).sum();
    let same_unit = wrong.iter().all(|one| one.channel.kind.unit == worst.channel.kind.unit);
    let mut slips = Vec::new();
    // Over one or two instants anything is an offset and a factor.
    if gaps.len() >= FEWEST {
        if same_unit {
            let mean = |gaps: &[f64]| gaps.iter().sum::<f64>() / gaps.len() as f64;
            slips.push(Slip::Offset(mean(&gaps)));
            let negative: Vec<f64> = worst.right.iter().map(|value| -value).collect();
            let mirrored = mean(&differences(&negative, worst.found, worst.channel.kind.periodic));
            slips.extend((mirrored.abs() > worst.bound).then_some(Slip::Mirrored(mirrored)));
        }
        if squares > 0.0 {
            slips.push(Slip::Factor(products / squares));
        }
    }
    slips
}

/// The same slip with so many digits of its number; angles in degrees.
fn with_digits(slip: &Slip, digits: usize, angle: bool) -> Slip {
    match slip {
        Slip::Factor(factor) => Slip::Factor(significant(*factor, digits)),
        Slip::Offset(by) => Slip::Offset(shortened(*by, digits, angle)),
        Slip::Mirrored(by) => Slip::Mirrored(shortened(*by, digits, angle)),
        Slip::Instead(_) | Slip::Exchanged(_) | Slip::Between { .. } => slip.clone(),
        Slip::Sign | Slip::Turns | Slip::Twice | Slip::Half | Slip::Zero => slip.clone(),
        Slip::Unit { .. } | Slip::PerRadian | Slip::Late { .. } => slip.clone(),
    }
}

/// A number with so many digits; angles in degrees.
fn shortened(by: f64, digits: usize, angle: bool) -> f64 {
    if angle { significant(by.to_degrees(), digits).to_radians() } else { significant(by, digits) }
}

/// A fitted number with as few digits as still do.
pub(super) fn settled(by: f64, angle: bool, is_it: &dyn Fn(f64) -> bool) -> f64 {
    (2..=9).map(|digits| shortened(by, digits, angle)).find(|by| is_it(*by)).unwrap_or(by)
}

/// Fewest instants from which a number is fitted.
const FEWEST: usize = 4;

impl Wrong<'_> {
    /// Whether the slip, done to the right values, gives those found.
    fn is_explained_by(&self, slip: &Slip) -> bool {
        let unit = self.channel.kind.unit;
        match *slip {
            Slip::Sign => self.meets(|value| -value),
            Slip::Twice => self.meets(|value| 2.0 * value),
            Slip::Half => self.meets(|value| value / 2.0),
            Slip::Zero => self.meets(|_| 0.0),
            Slip::Factor(factor) => self.meets(|value| factor * value),
            Slip::Offset(by) => self.meets(|value| value + by),
            Slip::Mirrored(by) => self.meets(|value| by - value),
            Slip::Unit { factor, told } => {
                UNITS.iter().any(|(units, _, own)| *own == told && units.contains(&unit))
                    && self.meets(|value| factor * value)
            }
            Slip::PerRadian => match (self.speed, self.channel.kind.stage) {
                (Some(speed), Stage::Velocities) => self.meets(|value| value / speed),
                (Some(speed), Stage::Accelerations) => self.meets(|value| value / (speed * speed)),
                (_, Stage::Positions | Stage::Velocities | Stage::Accelerations) => false,
                (_, Stage::Reactions | Stage::BalancingMoment) => false,
            },
            Slip::Turns => {
                let gaps = differences(self.right, self.found, true);
                self.channel.kind.periodic
                    && gaps.iter().all(|gap| (gap - TAU * (gap / TAU).round()).abs() <= self.bound)
            }
            // Need the solution at other instants, or of other channels: see `late` and `others`.
            Slip::Late { .. } | Slip::Instead(_) | Slip::Exchanged(_) | Slip::Between { .. } => false,
        }
    }

    fn meets(&self, done: impl Fn(f64) -> f64) -> bool {
        let expected: Vec<f64> = self.right.iter().map(|&value| done(value)).collect();
        largest_size(&differences(&expected, self.found, self.channel.kind.periodic)) <= self.bound
    }
}
