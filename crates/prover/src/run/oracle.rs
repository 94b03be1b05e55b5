//! Compares numbers of other sources with both analytic sides.
//! See docs/numerics/bounds.md.

use super::each_side::{EachSide, Reference};
use super::figures::Measured;
use super::problem::Problem;
use super::shifted::{Along, RoundedInstants, TELLING};
use crate::bounds::{Check, Verdict, magnitudes, scales};
use crate::tolerance::{BoundBasis, BoundOrigin, Tolerance};
use crate::{numbers, sentences};
use linkage::case::{Case, Wanted};
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::KeepNan;
use linkage::math::angle::wrapped;
use linkage::math::statistics::share;
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Stage, Trajectory};
use scenario::{ExpectedCell, FigureValue, Oracle, OracleBasis, OraclePoint, OracleSeries, When};

/// The checks of all series and figures of all oracles (sources of numbers), for each analytic side.
/// Series refer to channels of the problem's case; figures refer to the `whole` mechanism.
/// `integration` is the integration error of a side in a channel, in the channel's unit. The bounds of numbers at a
/// time contain this error, which is zero in a prescribed motion.
pub(super) fn checks(
    problem: Problem,
    whole: &Case,
    sides: EachSide<&dyn Solver>,
    integration: &dyn Fn(Reference, &Channel) -> f64,
) -> Result<Vec<Check>> {
    let mut checks = of_series(problem, sides, integration)?;
    // If forces determine the true motion, a published mean over a revolution refers to the nominal motion.
    checks.extend(of_figures(problem.oracles, &whole.nominal(), sides)?);
    Ok(checks)
}

/// Rounding error of a number from an analytic side. The unit is one ulp of the largest number that the quantity has in
/// the side's trajectory. The error matters for printed numbers with more digits than the side's result has correct
/// digits.
const ULPS: f64 = 16.0;

/// Largest number of instants at which all channels of a stage are solved.
const MOST: usize = 20_000;

/// A side's trajectory. For every channel: the largest number of the channel's quantity, and the channel's scale.
type Side = (Trajectory, Vec<(Channel, [f64; 2])>);

/// Results of both sides.
struct Solved {
    sides: EachSide<Side>,
    rounded: RoundedInstants,
}

/// Results of both sides at the instants of an oracle's numbers.
struct Answers<'a> {
    /// The nominal motion, sorted by crank angle; `None` if no number is given at a crank angle.
    nominal: Option<Solved>,
    /// The true motion, sorted by time; `None` if no number is given at a time.
    timed: Option<Solved>,
    /// Input of the case.
    input: Input,
    /// Integration error of a side in a channel of the true motion.
    integration: &'a dyn Fn(Reference, &Channel) -> f64,
}

impl<'a> Answers<'a> {
    fn of(
        case: &Case,
        series: &[&OracleSeries],
        solvers: EachSide<&'a dyn Solver>,
        integration: &'a dyn Fn(Reference, &Channel) -> f64,
    ) -> Result<Self> {
        let channels: Vec<Channel> = series.iter().flat_map(|series| channels_of(series)).collect();
        let stages: Vec<Stage> = series.iter().map(|series| series.channel.kind.stage).collect();
        let solved = |case: &Case, along: Along| -> Result<Option<Solved>> {
            let all = series.iter().flat_map(|series| series.instants());
            let mut instants: Vec<f64> = all.filter_map(|when| along.of(when)).collect();
            if instants.is_empty() {
                return Ok(None);
            }
            instants.sort_unstable_by(f64::total_cmp);
            instants.dedup();
            // If there are many instants, only the requested channels are solved at all instants. The scales are then
            // determined from a selection of the instants.
            let step = instants.len().div_ceil(MOST);
            let few = instants.iter().copied().step_by(step).collect();
            let whole = case.on(along.grid(case.crank(), few))?.wanting(Wanted::of(&stages));
            let many = (step > 1).then(|| case.on(along.grid(case.crank(), instants))).transpose()?;
            let many = many.map(|many| many.wanting_only(&channels));
            let of = |solver: &dyn Solver| -> Result<Side> {
                let found = solver.solve(&whole)?;
                let sizes = magnitudes(&found).into_iter().zip(scales(&found)).map(|(size, scale)| [size, scale]);
                let sizes = found.channels().iter().cloned().zip(sizes).collect();
                Ok((many.as_ref().map_or(Ok(found), |many| solver.solve(many))?, sizes))
            };
            let points = series.iter().flat_map(|series| series.all());
            let rounded = RoundedInstants::of(case, points, along, &channels, solvers[Reference::Assur])?;
            Ok(Some(Solved { sides: EachSide::tried(|side| of(solvers[side]))?, rounded }))
        };
        // If forces determine the true motion, numbers at crank angles belong to the nominal motion.
        let nominal = solved(&case.nominal(), Along::Crank)?;
        Ok(Answers { nominal, timed: solved(case, Along::Time)?, input: case.crank().input, integration })
    }

    /// A side's results for a series, in the nominal motion and in the true motion.
    fn of_series<'b>(
        &'b self,
        oracle: &Oracle,
        series: &OracleSeries,
        side: Reference,
    ) -> Result<[Option<Told<'b>>; 2]> {
        let told = |solved: &'b Option<Solved>, integration: f64| -> Result<Option<Told<'b>>> {
            let Some(Solved { sides, rounded }) = solved else { return Ok(None) };
            let values = EachSide::tried(|side| values(oracle, series, &sides[side].0))?;
            let (trajectory, sizes) = &sides[side];
            let sizes = sizes.iter().find(|(own, _)| *own == series.channel);
            let [size, scale] = sizes.map_or([0.0; 2], |(_, sizes)| *sizes);
            let known = ULPS * f64::EPSILON * size + integration;
            Ok(Some(Told { side, trajectory, values, known, scale, rounded, channels: channels_of(series).collect() }))
        };
        // The errors of all channels are added: a magnitude has the errors of both components.
        let integration: f64 = channels_of(series).map(|channel| (self.integration)(side, &channel)).sum();
        Ok([told(&self.nominal, 0.0)?, told(&self.timed, integration)?])
    }
}

/// Results of both sides for a series. `known` is the error of the side `side`; the difference between the sides is not
/// included.
struct Told<'a> {
    side: Reference,
    trajectory: &'a Trajectory,
    values: EachSide<Vec<f64>>,
    known: f64,
    /// Scale of the channel at the instants of the numbers.
    scale: f64,
    rounded: &'a RoundedInstants,
    /// The channel of the series; for a magnitude, the channels of both components.
    channels: Vec<Channel>,
}

/// A side's result for one printed number.
struct Found {
    /// Difference between the result and the printed number.
    deviation: f64,
    bound: f64,
    /// The part of the bound that is due to the rounding of the instant.
    instant: f64,
    scale: f64,
}

impl Found {
    /// Ratio of the deviation to its bound. NaN counts as infinite.
    fn used(&self) -> f64 {
        let used = share(self.deviation, self.bound);
        if used.is_nan() { f64::INFINITY } else { used }
    }

    /// Whether the deviation is within the bound, but the deviation and the part of the bound due to the rounded
    /// instant both exceed the fraction [`TELLING`] of the scale. Such a number proves nothing.
    fn is_open(&self) -> bool {
        self.used() <= 1.0 && self.deviation.smaller(self.instant) > TELLING * self.scale
    }
}

impl Told<'_> {
    /// The result for a printed number of a series.
    fn of(&self, series: &OracleSeries, point: &OraclePoint) -> Found {
        let (instants, at) = match point.at {
            When::Crank(crank) => (self.trajectory.inputs(), crank),
            When::Time(time) => (self.trajectory.times(), time),
        };
        let row = instants.binary_search_by(|other| other.total_cmp(&at)).expect("solved at this instant");
        let [value, other] = [self.side, self.side.other()].map(|side| self.values[side][row]);
        // No number is known more accurately than the difference between the two sides. Twice this difference is
        // therefore added to the known error.
        let known = self.known + 2.0 * (value - other).abs();
        let difference = value - point.value;
        let deviation = if series.channel.kind.periodic { wrapped(difference) } else { difference }.abs();
        // The change of a magnitude is at most the magnitude of the change of the vector. The changes of the components
        // are therefore combined like the components of a vector.
        let drift = self.channels.iter().map(|own| self.rounded.of_point(own, at, point.at_error));
        let instant = drift.fold(0.0, f64::hypot);
        // The error of a side adds to the rounding of the printed number.
        let bound = point.bound + known + instant;
        Found { deviation, bound, instant, scale: self.scale }
    }
}

fn of_series(
    problem: Problem,
    solvers: EachSide<&dyn Solver>,
    integration: &dyn Fn(Reference, &Channel) -> f64,
) -> Result<Vec<Check>> {
    let all = || problem.oracles.iter().flat_map(|oracle| oracle.series.iter().map(move |series| (oracle, series)));
    let series: Vec<&OracleSeries> = all().map(|(_, series)| series).collect();
    let answers = Answers::of(problem.case, &series, solvers, integration)?;
    let mut checks = Vec::new();
    for side in Reference::ALL {
        for (oracle, series) in all() {
            checks.extend(of_one(oracle, series, &answers, side)?);
        }
    }
    Ok(checks)
}

/// The checks of one series.
/// One check covers all values that are not known to be wrong. Each value that is known to be wrong has its own check.
/// If all values are known to be wrong, a single check covers all values.
fn of_one(oracle: &Oracle, series: &OracleSeries, answers: &Answers, side: Reference) -> Result<Vec<Check>> {
    let [nominal, timed] = answers.of_series(oracle, series, side)?;
    let found = |point: &OraclePoint| {
        let told = if matches!(point.at, When::Crank(_)) { &nominal } else { &timed };
        told.as_ref().expect("solved at every instant").of(series, point)
    };
    let against = |family: &str, point: &OraclePoint, origin: BoundOrigin| -> Check {
        let Found { deviation, bound, instant, .. } = found(point);
        let tolerance = tolerance(oracle, origin, bound, instant, point.digits);
        let check = Check::new(family, deviation, tolerance, series.channel.kind.unit.symbol());
        check.located(|| format!("at {}", point.at.told(answers.input)))
    };
    let [family, wrong] = [false, true].map(|wrong| family(oracle, wrong, side.name()));
    let corrected = |cell: &ExpectedCell| -> Check {
        let printed = against(&wrong, &cell.point, origin(oracle));
        against(&wrong, &cell.right, BoundOrigin::Recomputed).expected(&cell.finding, &printed)
    };
    // Each number has its own bound. The worst number has the largest ratio of deviation to bound; NaN is the worst.
    let (mut worst, mut open): (Option<(f64, &OraclePoint)>, Option<&OraclePoint>) = (None, None);
    for point in &series.points {
        let found = found(point);
        if worst.is_none_or(|(most, _)| found.used() >= most) {
            worst = Some((found.used(), point));
        }
        open = open.or(found.is_open().then_some(point));
    }
    let checked = |point: &OraclePoint| against(&family, point, origin(oracle)).of(&series.name);
    let mut checks: Vec<Check> = worst.iter().map(|(_, point)| checked(point)).collect();
    if let (Some(point), Some((..=1.0, _))) = (open, worst) {
        checks = vec![Check { verdict: unproven(point, answers.input), ..checked(point) }];
    }
    for cell in &series.expected {
        checks.push(corrected(cell).of(format!("{} at {}", series.name, shortly(cell.point.at, answers.input))));
    }
    if let Some((_, cells)) = &series.wrong {
        checks.extend(worst_of(cells.iter().map(corrected)).map(|check| check.of(&series.name)));
    }
    Ok(checks)
}

/// The verdict on a number whose deviation may come from the rounding of its instant.
fn unproven(point: &OraclePoint, input: Input) -> Verdict {
    let reason = sentences::at_the_rounding_of_the_instant(&point.at.told(input));
    let advice = vec![Advice::Text(sentences::PRINT_THE_INSTANTS_WITH_MORE.into())];
    Verdict::Inconclusive { reason, advice }
}

fn shortly(at: When, input: Input) -> String {
    match at {
        When::Crank(value) => format!("{:.1} {}", input.shown(value), input.shown_in().0),
        When::Time(_) => at.told(input),
    }
}

/// The worst check of a series whose printed numbers are all known to be wrong. A check whose verdict is not `expected`
/// is worse than any check with the verdict `expected`. Of two checks of the same kind, the check with the
/// larger ratio of deviation to bound is worse.
fn worst_of(checks: impl Iterator<Item = Check>) -> Option<Check> {
    let rank = |check: &Check| (!matches!(check.verdict, Verdict::Expected { .. }), check.used());
    checks.reduce(|worst, check| {
        let ((wrong, used), (other_wrong, other_used)) = (rank(&worst), rank(&check));
        if (other_wrong && !wrong) || (other_wrong == wrong && other_used > used) { check } else { worst }
    })
}

/// Bound of a number and its basis. `instant` is the part of the bound that is due to the rounding of the instant.
fn tolerance(oracle: &Oracle, origin: BoundOrigin, bound: f64, instant: f64, digits: i32) -> Tolerance {
    Tolerance { bound, basis: BoundBasis::Digits { origin, digits, source: oracle.source.clone(), instant } }
}

/// How the numbers of an `[[oracle]]` were obtained.
fn origin(oracle: &Oracle) -> BoundOrigin {
    match oracle.basis {
        OracleBasis::Published => BoundOrigin::Published,
        OracleBasis::Recomputed => BoundOrigin::Recomputed,
        OracleBasis::Derived => BoundOrigin::Derived,
    }
}

/// The channels of a series: one channel, or both components of a vector if the series contains the vector's magnitude.
fn channels_of(series: &OracleSeries) -> impl Iterator<Item = Channel> {
    [Some(series.channel.clone()), series.y()].into_iter().flatten()
}

/// Solved values of a series, by row.
fn values(oracle: &Oracle, series: &OracleSeries, solved: &Trajectory) -> Result<Vec<f64>> {
    let named = |channel: Channel| {
        solved.column(&channel).ok_or_else(|| {
            Error::new(ErrorKind::Input, sentences::oracle_there_is_no_channel(&oracle.name, &channel))
                .help(sentences::NAME_A_LINK_POINT_OR_JOINT)
        })
    };
    let components = channels_of(series).map(named).collect::<Result<Vec<&[f64]>>>()?;
    Ok(match components.as_slice() {
        [x, y] => x.iter().zip(*y).map(|(x, y)| x.hypot(*y)).collect(),
        own => own.concat(),
    })
}

fn of_figures(oracles: &[Oracle], case: &Case, solvers: EachSide<&dyn Solver>) -> Result<Vec<Check>> {
    let all = || oracles.iter().flat_map(|oracle| oracle.figures.iter().map(move |figure| (oracle, figure)));
    let values: EachSide<Vec<f64>> = EachSide::tried(|side| -> Result<_> {
        let mut measured = Measured::of(case, solvers[side]);
        all().map(|(_, figure)| measured.value(figure.figure)).collect()
    })?;
    let mut checks = Vec::new();
    for side in Reference::ALL {
        for (index, (oracle, figure)) in all().enumerate() {
            let [value, other] = [values[side][index], values[side.other()][index]];
            let known = ULPS * f64::EPSILON * value.abs() + 2.0 * (value - other).abs();
            let (family, unit) = (family(oracle, figure.wrong.is_some(), side.name()), figure.figure.unit());
            let against = |number: &FigureValue, origin: BoundOrigin| {
                let tolerance = tolerance(oracle, origin, number.bound.larger(known), 0.0, number.digits);
                Check::new(family.as_str(), (value - number.value).abs(), tolerance, unit)
                    .of(&figure.name)
                    .located(|| sentences::given_found(&number.value, &numbers::shown(unit), &value))
            };
            let printed = against(&figure.printed, origin(oracle));
            checks.push(match &figure.wrong {
                Some((finding, right)) => against(right, BoundOrigin::Recomputed).expected(finding, &printed),
                None => printed,
            });
        }
    }
    Ok(checks)
}

/// Heading of the checks of an oracle.
fn family(oracle: &Oracle, wrong: bool, side: &str) -> String {
    let known = if wrong { sentences::KNOWN_TO_BE_WRONG } else { "" };
    format!("{} {}{known} ({side})", origin(oracle).word(), oracle.name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn failed_checks_rank_above_those_closest_to_their_bound() {
        let check = |value: f64, verdict: Verdict| {
            let tolerance = Tolerance { bound: 1.0, basis: BoundBasis::Wanted("test") };
            Check { verdict, ..Check::new("f", value, tolerance, "") }
        };
        let expected = |value: f64| check(value, Verdict::Expected { finding: "why".into(), off: 1.0 });
        let wrong = check(0.1, Verdict::Disagree { place: String::new() });
        let worst = |all: Vec<Check>| worst_of(all.into_iter()).map(|check| check.value);
        assert_eq!(worst(vec![expected(0.9), wrong, expected(0.95)]), Some(0.1));
        assert_eq!(worst(vec![expected(0.5), expected(0.9), expected(0.7)]), Some(0.9));
        assert_eq!(worst(Vec::new()), None);
    }
}
