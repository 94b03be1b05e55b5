//! Checks besides the comparison of channels with an engine: closure, side against side, balance of powers.

use super::each_side::{EachSide, Reference};
use super::known::{Known, of_condition};
use super::observe::Observed;
use super::problem::{Problem, built};
use super::runs::Runs;
use crate::bounds::{Check, Convergence, difference};
use crate::sentences;
use crate::tolerance::{BoundBasis, BoundOrigin, Tolerance};
use linkage::case::Case;
use linkage::engine::{Engine, Route};
use linkage::math::statistics::{ascending, share};
use linkage::math::{KeepNan, largest_size};
use linkage::trajectory::{Channel, ChannelKind, Stage, Trajectory, Unit};

/// Largest allowed opening of a joint of an analytic side, as a fraction of a length.
/// The length is the mechanism's size or, if larger, the largest distance of a joint from the origin.
/// For the shipped mechanisms the fraction is at most 5e-16.
const CLOSURE: f64 = 1e-13;
/// Two methods compute the balancing moment of an analytic side. The difference of the two results, divided by the
/// largest moment on the driving link, must not exceed this limit.
const TWO_WAYS: f64 = 1e-11;

/// Rounding errors of the difference of two coordinates, in units of the last place of the coordinates.
const FAR: f64 = 16.0;

/// Returns `TWO_WAYS`, or a larger limit in two cases. Near change points, forces are known less accurately. Far from
/// the origin, the rounding of coordinates limits the arms of forces; `size` is the size of the mechanism (m).
fn two_ways(side: &Observed, size: f64) -> f64 {
    let of_arms = FAR * f64::EPSILON * side.reach / size;
    TWO_WAYS.larger(of_condition(Stage::Reactions, side.passing)).larger(of_arms)
}

pub(super) fn rounding(bound: f64, why: &'static str) -> Tolerance {
    Tolerance { bound, basis: BoundBasis::Wanted(why) }
}

/// Checks on the two analytic sides.
pub(super) fn of_sides(case: &Case, sides: EachSide<&Observed>, known: &Known) -> Vec<Check> {
    let size = case.mechanism.size();
    let check = |what: &str, side: Reference, value: f64, tolerance: Tolerance| {
        Check::new(format!("{what} ({})", side.name()), value, tolerance, "")
    };
    let closure = |(side, own): (Reference, &&Observed)| {
        let why = sentences::POSITIONS_ARE_GOOD_TO_A_FEW;
        check(sentences::CLOSURE_OF_ALL_JOINTS_2, side, own.closure() / size.larger(own.reach), rounding(CLOSURE, why))
    };
    let powers = |(side, own): (Reference, &&Observed)| {
        let tolerance = rounding(two_ways(own, size), sentences::SUMS_OF_A_FEW_FORCES_AND_POWERS);
        let what = sentences::BALANCING_MOMENT_FROM_EQUILIBRIUM_AND_FROM_POWERS;
        (!own.power.is_empty()).then(|| check(what, side, own.two_ways(), tolerance))
    };
    let shaking = |(side, own): (Reference, &&Observed)| {
        let tolerance = rounding(two_ways(own, size), sentences::SUMS_OF_AS_MANY_FORCES_AS_THERE);
        let what = sentences::SHAKING_FORCE_AND_MOMENT_FROM_REACTIONS;
        own.unbalance.map(|share| check(what, side, share, tolerance))
    };
    let mut checks: Vec<Check> = sides.iter().map(closure).collect();
    checks.extend(between_sides(sides, known));
    checks.extend(sides.iter().filter_map(powers));
    checks.extend(sides.iter().filter_map(shaking));
    checks
}

/// One channel at its worst instant: the instant with the largest ratio of difference to allowed difference.
struct Worst<'a> {
    channel: &'a Channel,
    row: usize,
    /// The difference and the allowed difference, both divided by the magnitude of the channel's numbers.
    relative: f64,
    allowed: f64,
}

impl Worst<'_> {
    fn used(&self) -> f64 {
        let used = share(self.relative, self.allowed);
        if used.is_nan() { f64::INFINITY } else { used }
    }
}

/// Every channel of side 1 at its worst instant.
fn worst_instants<'a>([reference, other]: [&'a Trajectory; 2], known: &Known) -> Vec<Worst<'a>> {
    let errors = difference(reference, other).expect("both sides stand on one grid");
    let of = |(index, channel): (usize, &'a Channel)| {
        let values = errors.column_near(channel, index).expect("both sides have all channels");
        let at = |(row, &value): (usize, &f64)| Worst {
            channel,
            row,
            relative: share(value.abs(), known.magnitudes[index]),
            allowed: known.apart(channel.kind.stage, index, row),
        };
        values.iter().enumerate().map(at).max_by(|a, b| a.used().total_cmp(&b.used())).expect("there is an instant")
    };
    reference.channels().iter().enumerate().map(of).collect()
}

/// A channel in which two trajectories differ by more than is allowed.
#[derive(Clone, Debug, PartialEq)]
pub struct Beyond {
    /// The channel.
    pub channel: Channel,
    /// First instant at which the difference is too large (s), and the value of the input there (rad or m).
    pub since: (f64, f64),
    /// Largest ratio of difference to allowed difference.
    pub margin: f64,
}

/// Every channel in which the two sides differ by more than is allowed, with the first instant of the disagreement and
/// the largest ratio of difference to allowed difference.
pub(super) fn beyond(sides: EachSide<&Observed>, known: &Known) -> Vec<Beyond> {
    let [reference, other] = sides.pair().map(|own| &own.trajectory);
    let rows = ascending(reference.times());
    let errors = difference(reference, other).expect("both sides stand on one grid");
    let of = |(index, worst): (usize, Worst)| {
        let values = errors.column_near(worst.channel, index)?;
        // This form of the comparison counts NaN as beyond the allowed difference.
        let is_beyond = |row: &&usize| {
            let relative = share(values[**row].abs(), known.magnitudes[index]);
            !(relative <= known.apart(worst.channel.kind.stage, index, **row))
        };
        let first = *rows.iter().find(is_beyond)?;
        let since = (reference.times()[first], reference.inputs()[first]);
        Some(Beyond { channel: worst.channel.clone(), since, margin: worst.used() })
    };
    worst_instants([reference, other], known).into_iter().enumerate().filter_map(of).collect()
}

/// Whether the two sides differ by more than is allowed in any channel.
pub(super) fn sides_differ(sides: [&Trajectory; 2], known: &Known) -> bool {
    worst_instants(sides, known).iter().any(|worst| !(worst.used() <= 1.0))
}

fn between_sides(sides: EachSide<&Observed>, known: &Known) -> Vec<Check> {
    let [reference, other] = sides.pair().map(|own| &own.trajectory);
    let all = worst_instants([reference, other], known);
    let [first, second] = Reference::ALL;
    let of_stage = |stage: Stage| {
        let own = all.iter().filter(|worst| worst.channel.kind.stage == stage);
        let worst = own.max_by(|a, b| a.used().total_cmp(&b.used()))?;
        let why = sentences::TWO_SOLVERS_WITHOUT_A_COMMON;
        let tolerance = rounding(worst.allowed, why);
        let check = Check::new(format!("{} against {}", first.name(), second.name()), worst.relative, tolerance, "");
        Some(check.of(stage.name()).located(|| sentences::in_at(&worst.channel, &reference.told(worst.row))))
    };
    Stage::ALL.into_iter().filter_map(of_stage).collect()
}

/// Checks on the engine, from its runs at double, single and half step.
pub(super) fn of_engine(problem: Problem, engine: &dyn Engine, runs: &Runs) -> Vec<Check> {
    let mut checks = vec![closure(problem, engine, runs)];
    if !runs.single().power.is_empty() {
        checks.push(power_balance(problem, engine, runs));
    }
    checks
}

/// Checks the opening of the engine's loops.
/// In an exact solution no loop is open, so any opening is an error of the engine. If the step is reduced, the opening
/// must decrease with the observed order of convergence.
fn closure(problem: Problem, engine: &dyn Engine, runs: &Runs) -> Check {
    let size = problem.case.mechanism.size();
    let kind = Channel::named("point.A.x_m").expect("the table has positions of points").kind;
    Vanishing {
        family: sentences::closure_of_all_joints(&engine.name()),
        of: &|run: &Observed| run.opening.iter().map(|opening| opening / size).collect(),
        value: runs.single().closure() / size,
        kind,
        noise: 1.0 / size,
        note: sentences::AN_OPENING_IS_ALL_ERROR_IT_MUST,
    }
    .check(problem, engine, runs)
}

/// Checks the engine's driving moment against the balance of powers of the same motion.
/// Both moments belong to the same motion, so their difference must tend to zero with the step.
fn power_balance(problem: Problem, engine: &dyn Engine, runs: &Runs) -> Check {
    let kind = Channel::named("drive.torque_N_m").expect("the table has the moment").kind;
    // Moments may cancel each other, so the largest summand counts too. If all moments are only rounding errors of the
    // engine, the scale is the natural size of a moment from the mechanism's data.
    let largest = runs.single().moment.larger(runs.single().summand);
    let largest = if largest <= engine.noise(problem.case, kind) { 0.0 } else { largest };
    let scale = built(problem.case).unless(largest, Unit::NewtonMetre);
    let gaps = |run: &Observed| run.moment_gap().collect::<Vec<f64>>();
    let by_differences = engine.settings().route == Route::Differences;
    Vanishing {
        family: sentences::driving_moment_from_reactions_and_from_powers(&engine.name()),
        of: &|run: &Observed| gaps(run).into_iter().map(|gap| share(gap, scale)).collect(),
        value: share(largest_size(&gaps(runs.single())), scale),
        kind,
        // The factor is 2, because two moments are compared and each has a rounding error.
        noise: if scale == 0.0 { 0.0 } else { 2.0 / scale },
        note: match by_differences {
            true => sentences::BOTH_FROM_THE_SAME_ACCELERATIONS,
            false => sentences::REACTIONS_AND_SPEEDS_COME_FROM_THE_ENGINE,
        },
    }
    .check(problem, engine, runs)
}

/// A relative number that is zero for an engine without errors. The number is evaluated from an engine's runs.
struct Vanishing<'a> {
    family: String,
    /// The number at every instant of a run.
    of: &'a dyn Fn(&Observed) -> Vec<f64>,
    /// Largest absolute value of the number in the judged run.
    value: f64,
    /// A kind of channel with the same order of convergence and a proportional rounding error.
    kind: &'static ChannelKind,
    /// Ratio of the number's rounding error to the channel's rounding error.
    noise: f64,
    /// Note on what the check shows.
    note: &'static str,
}

impl Vanishing<'_> {
    /// Checks that the number does not exceed the bound that its convergence over the runs gives.
    /// The number is a sum of two terms: v, which tends to zero with the step, and a constant, which an error causes.
    /// With the safety factor s, the check finds the error if the constant exceeds about (s - 1) v.
    fn check(self, problem: Problem, engine: &dyn Engine, runs: &Runs) -> Check {
        let (case, resolution) = (problem.case, engine.settings().resolution);
        let noise = |engine: &dyn Engine| self.noise * engine.noise(case, self.kind);
        let [double, single, half] = [0, 1, 2].map(|k| (self.of)(&runs.resolutions[k]));
        let order = engine.formal_order(case, self.kind);
        let found = Convergence::of(&double, &single, &half, false, order, noise(engine.at(resolution / 2.0).as_ref()));
        let others = runs.other_sweeps.map(|run| (self.of)(run));
        let found = found.with_other_sweeps(&single, &others.map(Vec::as_slice), noise(engine), false);
        let found = found.extrapolated(engine.settings().extrapolated);
        let parts = found.parts(noise(engine));
        let basis = found.tolerance(resolution, parts, noise_origin(engine)).basis;
        let basis = BoundBasis::Noted(Box::new(basis), self.note);
        Check::estimated(self.family, self.value, &found, parts, basis, problem.engine_rel)
    }
}

/// Origin of an engine's rounding error: measured or chosen.
pub(super) fn noise_origin(engine: &dyn Engine) -> BoundOrigin {
    if engine.is_noise_measured() { BoundOrigin::Measured } else { BoundOrigin::Wanted }
}
