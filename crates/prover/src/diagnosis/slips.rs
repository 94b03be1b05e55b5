//! Causes that can be found from the values alone: sign, unit, factor, offset, whole revolutions.

use crate::sentences;
use std::f64::consts::{PI, TAU};

use super::cause::{DataSlip, Plain};
use super::knobs::significant_in;
use super::question::{DiagnosisInput, Found, Rank, SuspectChannel};
use crate::bounds::{differences, magnitudes};
use linkage::case::Case;
use linkage::math::angle::wrapped;
use linkage::math::{KeepNan, largest_size};
use linkage::trajectory::{Channel, Stage, Unit};

/// Smallest bound, as a fraction of the magnitude of the reference's numbers. The reference may have relative errors
/// up to this fraction.
const KNOWN: f64 = 1e-10;
/// As `KNOWN`, for a free motion. Errors of its integration grow with time.
const KNOWN_OF_FREE: f64 = 1e-8;

/// The fraction of the magnitude of the reference's numbers up to which these numbers may have errors.
pub(super) fn known(case: &Case) -> f64 {
    if case.is_free() { KNOWN_OF_FREE } else { KNOWN }
}

/// A factor on the values of a channel, and the confusion of units that causes it.
type Mistaken = (f64, &'static str);

const DEGREES: Mistaken = (180.0 / PI, sentences::DEGREES_INSTEAD_OF_RADIANS);
const TWICE_CONVERTED: Mistaken = (PI / 180.0, sentences::RADIANS_TAKEN_FOR_DEGREES_AND_CONVERTED);
const TURNS: Mistaken = (1.0 / TAU, sentences::TURNS_INSTEAD_OF_RADIANS);
const MILLIMETRES: Mistaken = (1e3, sentences::MILLIMETRES_INSTEAD_OF_METRES);
const FROM_MILLIMETRES: Mistaken = (1e-3, sentences::METRES_TAKEN_FOR_MILLIMETRES);
const CENTIMETRES: Mistaken = (1e2, sentences::CENTIMETRES_INSTEAD_OF_METRES);
const FROM_CENTIMETRES: Mistaken = (1e-2, sentences::METRES_TAKEN_FOR_CENTIMETRES);
const INCHES: Mistaken = (1.0 / 0.0254, sentences::INCHES_INSTEAD_OF_METRES);
const FEET: Mistaken = (1.0 / 0.3048, sentences::FEET_INSTEAD_OF_METRES);
const PER_MINUTE: Mistaken = (60.0, sentences::PER_MINUTE_INSTEAD_OF_PER);
const FROM_MINUTE: Mistaken = (1.0 / 60.0, sentences::PER_SECOND_TAKEN_FOR_PER);
const THOUSANDFOLD: Mistaken = (1e3, sentences::A_THOUSANDFOLD_AS_FOR_KG);
const THOUSANDTH: Mistaken = (1e-3, sentences::A_THOUSANDTH_AS_KG_FOR_OR_KN);
const KILOPONDS: Mistaken = (1.0 / G, sentences::KILOPONDS_INSTEAD_OF_NEWTONS);
const FROM_KILOPONDS: Mistaken = (G, sentences::NEWTONS_TAKEN_FOR_KILOPONDS);
/// Standard gravity (m/s^2).
const G: f64 = 9.806_65;
/// A pound-force (N).
const POUND: f64 = 4.448_221_615_260_5;

/// Lengths in other units.
const LENGTHS: [Mistaken; 6] = [MILLIMETRES, FROM_MILLIMETRES, CENTIMETRES, FROM_CENTIMETRES, INCHES, FEET];
/// Forces in other units.
const FORCES: [Mistaken; 4] = [THOUSANDFOLD, THOUSANDTH, KILOPONDS, FROM_KILOPONDS];

/// Units that may be confused with the unit of a channel, the likeliest first.
fn mistaken(unit: Unit) -> Vec<Mistaken> {
    let (first, rest): (&[Mistaken], &[Mistaken]) = match unit {
        Unit::Radian | Unit::RadianPerSecondSquared => (&[DEGREES, TWICE_CONVERTED, TURNS], &[]),
        Unit::RadianPerSecond => (
            &[DEGREES, TWICE_CONVERTED],
            &[
                (30.0 / PI, sentences::REVOLUTIONS_PER_MINUTE_INSTEAD_OF_RAD),
                (PI / 30.0, sentences::RAD_TAKEN_FOR_REVOLUTIONS_PER),
                TURNS,
                PER_MINUTE,
                FROM_MINUTE,
            ],
        ),
        Unit::Metre => (&LENGTHS, &[]),
        Unit::MetrePerSecond => (&LENGTHS, &[PER_MINUTE, FROM_MINUTE, (3.6, sentences::KM_INSTEAD_OF)]),
        Unit::MetrePerSecondSquared => (&LENGTHS, &[(1.0 / G, sentences::MULTIPLES_OF_STANDARD_GRAVITY_INSTEAD)]),
        Unit::Newton => (&FORCES, &[(1.0 / POUND, sentences::POUNDS_FORCE_INSTEAD_OF_NEWTONS)]),
        Unit::NewtonMetre => (
            &FORCES,
            &[
                (1e2, sentences::CM_INSTEAD_OF),
                (1e-2, sentences::TAKEN_FOR_CM),
                (1.0 / (POUND * 0.3048), sentences::POUND_FEET_INSTEAD_OF),
                (1.0 / (POUND * 0.0254), sentences::POUND_INCHES_INSTEAD_OF),
            ],
        ),
    };
    [first, rest].concat()
}

/// A disagreeing channel with its values.
pub(super) struct Wrong<'a> {
    pub(super) channel: &'a Channel,
    pub(super) right: &'a [f64],
    pub(super) found: &'a [f64],
    pub(super) bound: f64,
    pub(super) times: &'a [f64],
    /// Speed of the crank (rad/s) if it is constant.
    speed: Option<f64>,
    /// Ratio of the reducer between motor and crank.
    ratio: Option<f64>,
}

/// Returns every slip with the channels that it explains.
/// A slip with a fitted number counts only if it explains all disagreeing channels, because a number can always be
/// fitted to one channel.
pub(super) fn found(wrong: &[Wrong]) -> Vec<Found> {
    let mut causes = Vec::new();
    let slips = plain(wrong);
    // If each channel has a slip without a number, a number that fits all channels adds nothing. An example is the
    // factor 1/1000 of lengths and of forces, which comes from two mistakes of units.
    let is_plain = wrong.iter().all(|wrong| slips.iter().any(|slip| wrong.is_explained_by(slip)));
    for slip in slips {
        let explained: Vec<Channel> =
            wrong.iter().filter(|wrong| wrong.is_explained_by(&slip)).map(|wrong| wrong.channel.clone()).collect();
        if !explained.is_empty() {
            causes.push(Found::of_values(slip, Rank::Slip, explained));
        }
    }
    if is_plain {
        return causes;
    }
    for Fitted { slip, number, is_angle } in fitted(wrong) {
        let explains_all = |number: f64| wrong.iter().all(|wrong| wrong.is_explained_by(&slip(number)));
        if explains_all(number) {
            let slip = slip(settled(number, is_angle, &explains_all));
            let explained = wrong.iter().map(|wrong| wrong.channel.clone()).collect();
            causes.push(Found::of_values(slip, Rank::Fitted, explained));
        }
    }
    causes
}

/// The disagreeing channels.
pub(super) fn wrong<'a>(question: &'a DiagnosisInput) -> Vec<Wrong<'a>> {
    let sizes = magnitudes(question.reference);
    let speed = question.case.crank().constant_speed().filter(|_| question.case.is_steady());
    let ratio = question.case.crank().motor().map(|motor| motor.ratio).filter(|ratio| *ratio != 1.0);
    let of = |judged: &'a SuspectChannel| {
        let channel = &judged.channel;
        let place = question.reference.channels().iter().position(|own| own == channel)?;
        let (right, found) = (question.reference.column(channel)?, question.suspicious.column(channel)?);
        let (bound, times) = (judged.bound.larger(known(question.case) * sizes[place]), question.reference.times());
        Some(Wrong { channel, right, found, bound, times, speed, ratio })
    };
    question.judged.iter().filter(|judged| judged.disagrees).filter_map(of).collect()
}

/// Slips without a free number, the simplest first.
fn plain(wrong: &[Wrong]) -> Vec<DataSlip> {
    let mut slips: Vec<DataSlip> = Plain::ALL.iter().map(|&plain| DataSlip::Plain(plain)).collect();
    for (factor, told) in wrong.iter().flat_map(|wrong| mistaken(wrong.channel.kind.unit)) {
        let slip = DataSlip::Unit { factor, told };
        if !slips.contains(&slip) {
            slips.push(slip);
        }
    }
    slips.extend(lonely(wrong).map(DataSlip::Outlier));
    slips
}

/// The time of the only wrong row, if all channels are right at all other rows.
fn lonely(wrong: &[Wrong]) -> Option<f64> {
    let times = wrong.first()?.times;
    let is_off = |row: usize| wrong.iter().any(|own| !(own.gap(row).abs() <= own.bound));
    let mut off = (0..times.len()).filter(|&row| is_off(row));
    let row = off.next().filter(|_| times.len() >= MANY)?;
    off.next().is_none().then_some(times[row])
}

/// Smallest number of instants among which a single wrong instant is sought.
const MANY: usize = 8;

/// A slip with a number. If the number is an angle, its digits are counted in degrees.
struct Fitted {
    slip: fn(f64) -> DataSlip,
    number: f64,
    is_angle: bool,
}

/// Slips with a number fitted to the channel with the largest ratio of difference to bound.
fn fitted(wrong: &[Wrong]) -> Vec<Fitted> {
    let far = |one: &Wrong| largest_size(&differences(one.right, one.found, one.channel.kind.periodic)) / one.bound;
    let Some(worst) = wrong.iter().max_by(|a, b| far(a).total_cmp(&far(b))) else { return Vec::new() };
    let gaps = differences(worst.right, worst.found, worst.channel.kind.periodic);
    let squares: f64 = worst.right.iter().map(|value| value * value).sum();
    let products: f64 = worst.right.iter().zip(worst.found).map(|(right, found)| right * found).sum();
    let same_unit = wrong.iter().all(|one| one.channel.kind.unit == worst.channel.kind.unit);
    let is_angle = same_unit && worst.channel.kind.unit == Unit::Radian;
    let mut slips = Vec::new();
    // At one or two instants, an offset or a factor often fits by chance. Numbers are therefore fitted only if there
    // are at least `FEWEST` instants.
    if gaps.len() >= FEWEST {
        if same_unit {
            let mean = |gaps: &[f64]| gaps.iter().sum::<f64>() / gaps.len() as f64;
            slips.push(Fitted { slip: DataSlip::Offset, number: mean(&gaps), is_angle });
            let negative: Vec<f64> = worst.right.iter().map(|value| -value).collect();
            let number = mean(&differences(&negative, worst.found, worst.channel.kind.periodic));
            slips.extend((number.abs() > worst.bound).then_some(Fitted { slip: DataSlip::Mirrored, number, is_angle }));
        }
        if squares > 0.0 {
            slips.push(Fitted { slip: DataSlip::Factor, number: products / squares, is_angle: false });
        }
    }
    slips
}

/// Rounds a fitted number to the smallest number of digits that `is_it` accepts.
pub(super) fn settled(by: f64, angle: bool, is_it: &dyn Fn(f64) -> bool) -> f64 {
    (2..=9).map(|digits| significant_in(angle, by, digits)).find(|by| is_it(*by)).unwrap_or(by)
}

/// A number is fitted only if there are at least this many instants.
const FEWEST: usize = 4;

impl Wrong<'_> {
    /// Whether the slip changes the right values into the found values.
    fn is_explained_by(&self, slip: &DataSlip) -> bool {
        let unit = self.channel.kind.unit;
        match *slip {
            DataSlip::Plain(plain) => self.is_plainly(plain),
            DataSlip::Factor(factor) => self.meets(|value| factor * value),
            DataSlip::Offset(by) => self.meets(|value| value + by),
            DataSlip::Mirrored(by) => self.meets(|value| by - value),
            DataSlip::Unit { factor, told } => {
                mistaken(unit).iter().any(|(_, own)| *own == told) && self.meets(|value| factor * value)
            }
            DataSlip::Outlier(time) => {
                (0..self.times.len()).all(|row| self.times[row] == time || self.gap(row).abs() <= self.bound)
            }
            // The modules `late`, `others` and `derived` examine the following slips, which need the solution at
            // further instants or in further channels.
            DataSlip::Late { .. } | DataSlip::Clock { .. } | DataSlip::Instead(_) | DataSlip::Opposite(_) => false,
            DataSlip::Exchanged(_) | DataSlip::Between { .. } | DataSlip::Magnitude(_) => false,
            DataSlip::Differences { .. } | DataSlip::NoCoriolis(_) | DataSlip::About(_) => false,
        }
    }

    fn is_plainly(&self, plain: Plain) -> bool {
        let is_angle = self.channel.kind.periodic;
        let parts_of = |turn: f64| {
            let gaps = differences(self.right, self.found, is_angle).into_iter().map(|gap| gap / turn);
            gaps.map(|gap| (gap.round(), turn * (gap - gap.round()).abs())).collect::<Vec<_>>()
        };
        match plain {
            Plain::Sign => self.meets(|value| -value),
            Plain::Twice => self.meets(|value| 2.0 * value),
            Plain::Half => self.meets(|value| value / 2.0),
            Plain::Zero => self.meets(|_| 0.0) && !self.is_proportional(),
            Plain::Size => self.meets(|value| if is_angle { wrapped(value).abs() } else { value.abs() }),
            Plain::ArcSine => is_angle && self.meets(|value| value.sin().asin()),
            Plain::PerRadian => match (self.speed, self.channel.kind.stage) {
                (Some(speed), Stage::Velocities) => self.meets(|value| value / speed),
                (Some(speed), Stage::Accelerations) => self.meets(|value| value / (speed * speed)),
                (_, Stage::Positions | Stage::Velocities | Stage::Accelerations) => false,
                (_, Stage::Reactions | Stage::BalancingMoment) => false,
            },
            Plain::BeforeReducer => match (self.ratio, self.channel.kind.stage) {
                (Some(ratio), Stage::BalancingMoment) => self.meets(|value| value / ratio),
                (_, Stage::Positions | Stage::Velocities | Stage::Accelerations) => false,
                (_, Stage::Reactions | Stage::BalancingMoment) => false,
            },
            Plain::Turns => is_angle && parts_of(TAU).iter().all(|(_, over)| *over <= self.bound),
            // A half revolution that is added at all instants is an offset and not this slip.
            Plain::HalfTurns => {
                let parts = parts_of(PI);
                let is_odd = |(halves, _): &(f64, f64)| halves.rem_euclid(2.0) == 1.0;
                let odd = parts.iter().filter(|own| is_odd(own)).count();
                // A single row may lie half a revolution away by chance.
                let changes = odd > 1 && odd < parts.len();
                is_angle && changes && parts.iter().all(|(_, over)| *over <= self.bound)
            }
        }
    }

    /// Whether the values are right up to a factor of at least 1e-4, as after a mistake of units. A tenth of their root
    /// mean square may differ.
    fn is_proportional(&self) -> bool {
        let sum =
            |of: &dyn Fn(f64, f64) -> f64| self.right.iter().zip(self.found).map(|(a, b)| of(*a, *b)).sum::<f64>();
        let [right, both, found] = [sum(&|a, _| a * a), sum(&|a, b| a * b), sum(&|_, b| b * b)];
        found >= 1e-8 * right && both * both >= 0.99 * right * found
    }

    /// The suspect's value minus the right value at a row.
    fn gap(&self, row: usize) -> f64 {
        differences(&self.right[row..=row], &self.found[row..=row], self.channel.kind.periodic)[0]
    }

    fn meets(&self, done: impl Fn(f64) -> f64) -> bool {
        let expected: Vec<f64> = self.right.iter().map(|&value| done(value)).collect();
        largest_size(&differences(&expected, self.found, self.channel.kind.periodic)) <= self.bound
    }
}
