//! Simple causes of differences between a table and a scenario.

use crate::sentences;
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};

use super::judge::{Both, Compared, Which};
use crate::bounds::largest_difference;
use crate::check::{KnownTrajectory, Term, Wrong, missing_in_numbers};
use crate::diagnosis::{
    CasePart, Change, DataSlip, DiagnosedParty, Diagnosis, DiagnosisInput, DisagreementCause, PartChange,
    SuspectChannel, diagnose, even,
};
use analytic::AssurSolver;
use formula::NodeShape;
use linkage::case::Grid;
use linkage::error::Result;
use linkage::math::KeepNan;
use linkage::math::statistics::half_range;
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Trajectory};
use linkage::work::limited;
use scenario::Scenario;

/// A cause, and the difference that remains after the cause is corrected.
#[derive(Clone, Debug)]
pub struct Explained {
    /// Names of the explained channels, or of all examined channels if no cause was found.
    pub of: Vec<String>,
    /// What was found.
    pub diagnosis: Diagnosis,
    /// Missing terms, if they are the cause.
    pub terms: Vec<Term>,
    /// Fraction of the largest difference that may remain; zero if the cause explains the channels within their bounds.
    pub left: f64,
    /// Time (s) of a single wrong row that the cause does not explain; `None` if there is no such row.
    pub but: Option<f64>,
}

/// Fractions of the largest difference that a cause may leave, tried in this order.
/// With the first fraction, the remaining differences must be within the bounds.
/// The further fractions allow for errors of a method, such as the step error of a simulation.
const LEFT: [f64; 3] = [0.0, 0.01, 0.05];

/// Largest number of channels with small differences for which missing terms are sought.
const TRIED: usize = 12;

/// Number of instants at which terms are tried first.
const FEW: usize = 24;

/// Largest number of instants at which causes are sought, besides the instants with the largest differences.
const MOST: usize = 2000;

/// Limit of the work of the search, in the unit of budgets.
const WORK: f64 = 2e6;

/// If a difference exceeds this fraction of a channel's scale, it is a mistake and not the error of a method.
pub const GROSS: f64 = 0.02;

/// Finds causes for the channels that disagree between a scenario (the party `which`) and the other party.
/// The search has three steps. First, causes are sought that explain channels to within their bounds: for all channels
/// together, then for the channels that are still unexplained. Such a cause may leave a single wrong row unexplained.
/// Second, a cause is sought that explains all remaining channels and leaves a small fraction of their differences.
/// Third, channels with gross errors are examined, together and one by one. A cause of a gross error may leave a small
/// remainder.
/// A small difference without a common cause counts as the error of a method.
/// Also returns whether the search ended at the limit of its work.
pub(super) fn explained(
    scenario: &Scenario,
    which: Which,
    both: &Both,
    channels: &[Compared],
) -> Result<(Vec<Explained>, bool)> {
    let is_wrong = |own: &&Compared| own.wrong > 0 && own.is_plain();
    let open: Vec<&Compared> = channels.iter().filter(is_wrong).collect();
    // Without wrong numbers, the scenario is not solved again.
    let stage = if open.is_empty() { None } else { Stage::of(scenario, which, both, channels)? };
    Ok(stage.map_or((Vec::new(), false), |stage| limited(WORK, || sought(&stage, open))))
}

fn sought(stage: &Stage, mut open: Vec<&Compared>) -> Vec<Explained> {
    let mut found: Vec<Explained> = Vec::new();
    let mut grant = |open: &mut Vec<&Compared>, explained: Explained| {
        open.retain(|own| !explained.of.contains(&own.claim.text));
        match found.iter_mut().find(|known| known.has_cause_of(&explained)) {
            Some(known) => known.include(explained),
            None => found.push(explained),
        }
    };
    while let Some(exact) = stage.examined(&open, LEFT[0]).or_else(|| stage.examined_but_one(&open, LEFT[0])) {
        grant(&mut open, exact);
    }
    // A simulation also has the error of its step, so a cause may leave a small remainder.
    let most = stage.examined(&open, LEFT[1]).filter(|most| most.of.len() == open.len());
    if let Some(most) = most.or_else(|| stage.examined_but_one(&open, LEFT[1])) {
        grant(&mut open, most);
    }
    let (mut open, mut little): (Vec<&Compared>, Vec<&Compared>) = open.into_iter().partition(|own| own.is_gross());
    while !open.is_empty() {
        // All channels are examined together first. If no cause explains all channels together, each channel is
        // examined alone.
        let together = || LEFT[1..].iter().find_map(|&left| stage.examined(&open, left));
        let alone = || open.iter().find_map(|one| LEFT.iter().find_map(|&left| stage.examined(&[*one], left)));
        let next = together().or_else(|| if open.len() > 1 { alone() } else { None });
        let Some(explained) = next.or_else(|| open.iter().find_map(|one| stage.lacking(one))) else { break };
        grant(&mut open, explained);
    }
    if !open.is_empty() {
        found.extend(stage.unexplained(&open));
    }
    // A small difference counts as a method's error, unless missing terms explain the whole difference.
    for one in little.clone().into_iter().take(TRIED) {
        if let Some(explained) = stage.lacking(one) {
            little.retain(|own| !explained.of.contains(&own.claim.text));
            found.push(explained);
        }
    }
    let seen = stage.unexplained(&little).filter(|own| own.diagnosis.nature.is_some());
    found.extend(seen);
    found
}

impl Explained {
    /// Whether another group of channels has the same cause and the same remainder.
    fn has_cause_of(&self, other: &Explained) -> bool {
        let is_same = match (&self.diagnosis.cause, &other.diagnosis.cause) {
            (
                Some(DisagreementCause::Values { slip: one, .. }),
                Some(DisagreementCause::Values { slip: other, .. }),
            ) => one == other,
            (one, other) => one.is_some() && one == other,
        };
        is_same && self.terms.is_empty() && other.terms.is_empty() && (self.left, self.but) == (other.left, other.but)
    }

    /// Adds the channels of another group with the same cause. Equally good causes remain if they hold for both groups.
    fn include(&mut self, other: Explained) {
        if let (
            Some(DisagreementCause::Values { channels, .. }),
            Some(DisagreementCause::Values { channels: more, .. }),
        ) = (&mut self.diagnosis.cause, &other.diagnosis.cause)
        {
            channels.extend_from_slice(more);
        }
        self.diagnosis.also.retain(|also| other.diagnosis.also.contains(also));
        self.of.extend(other.of);
    }
}

impl Compared {
    /// Whether a single channel is compared, with numbers from both parties.
    fn is_plain(&self) -> bool {
        matches!(self.claim.tree.shape, NodeShape::Name(_)) && self.largest.is_some()
    }

    /// Whether the difference is too large for the error of a method.
    #[must_use]
    pub fn is_gross(&self) -> bool {
        self.wrong > 0 && self.largest.is_some_and(|at| at.difference.abs() > GROSS * self.scale)
    }
}

/// Whether a cause may be named although a difference remains.
/// A fitted number of the case may not be named, because the meaning of the number is unclear if a difference remains.
/// The start angle of a drive is an exception: at constant speed, it has the same effect as late rows, which may be
/// named.
/// Numerical derivatives may not be named, because they resemble values that are late by half a row.
/// A single wrong row may not be named.
fn may_leave(cause: &DisagreementCause) -> bool {
    match cause {
        DisagreementCause::Case(Change { part, how: PartChange::Instead { .. } }) => {
            matches!(part, CasePart::StartAngle(_))
        }
        // A single wrong row may not leave a remainder: a diverging simulation ends in rows with huge errors, and all
        // other errors look small beside these.
        DisagreementCause::Values { slip: DataSlip::Differences { .. } | DataSlip::Outlier(_), .. } => false,
        DisagreementCause::Case(_) | DisagreementCause::Values { .. } => true,
    }
}

/// Adds whole revolutions to angles, because many programs print angles without whole revolutions. Afterwards the
/// angles of an agreeing channel lie near the reference, and those of a disagreeing channel continue without jumps.
fn unwrap(values: &mut [f64], right: &[f64], is_right: bool) {
    let is_wrapped = |own: &[f64]| half_range(own) <= PI * (1.0 + 1e-9);
    if !is_right && !is_wrapped(values) {
        return;
    }
    let mut turns = 0.0;
    let mut before: Option<f64> = None;
    for (value, right) in values.iter_mut().zip(right) {
        let gap = *value - right;
        let near = if is_right { 0.0 } else { before.unwrap_or(gap) };
        // The first row of a wrong angle stays unchanged, and whole revolutions are added to the further rows.
        if is_right || before.is_some() {
            turns = -((gap - near) / TAU).round();
        }
        *value += TAU * turns;
        before = Some(*value - right);
    }
}

/// Smallest number of rows among which a single wrong row is sought.
const FEWEST: usize = 8;

/// A single wrong row is not sought in this many rows or more, because the search would take several times as long as
/// the rest of the examination.
const MOST_ROWS: usize = 20_000;

/// Data for the search for causes. Only rows at which all channels have numbers are included.
struct Stage {
    case: linkage::case::Case,
    right: Trajectory,
    found: Trajectory,
    /// For each channel of `found`: the text of the claim, the bound in SI units, and whether the channel agrees.
    bounds: Vec<(String, f64, bool)>,
}

impl Stage {
    fn of(scenario: &Scenario, which: Which, both: &Both, channels: &[Compared]) -> Result<Option<Stage>> {
        let other = both.parties[which.other() as usize];
        let plain = channels.iter().filter(|own| own.is_plain());
        let plain: Vec<(&Compared, Cow<[formula::Rounded]>)> = plain
            .filter(|own| !own.claim.channels[0].1.magnitude)
            .filter_map(|own| Some((own, other.values_of(&own.claim)?)))
            .collect();
        let has_all = |row: &usize| plain.iter().all(|(_, values)| values[*row].value.is_finite());
        let mut rows: Vec<usize> = both.at.ascending().into_iter().filter(has_all).collect();
        rows.dedup_by(|a, b| both.instants[0][*a] == both.instants[0][*b]);
        let telling = |own: &Compared| [own.since, own.worst, own.largest].map(|at| at.map(|at| at.row));
        let kept: BTreeSet<usize> = channels.iter().flat_map(telling).flatten().collect();
        let (mut place, step) = (0, rows.len().div_ceil(MOST));
        rows.retain(|row| {
            place += 1;
            place % step == 0 || kept.contains(row)
        });
        if rows.len() < 4 || plain.is_empty() {
            return Ok(None);
        }
        let [times, cranks] = both.places().map(|instants| rows.iter().map(|&row| instants[row]).collect::<Vec<f64>>());
        let (mut names, mut columns, mut bounds) = (Vec::new(), Vec::new(), Vec::new());
        for (own, values) in &plain {
            let printed = &own.claim.channels[0].1;
            if names.contains(&printed.channel) {
                continue;
            }
            names.push(printed.channel.clone());
            columns.push(rows.iter().map(|&row| printed.to_si(values[row].value)).collect::<Vec<f64>>());
            // A cause is judged by a single bound for each channel, usually the loosest bound of its numbers. A tighter
            // bound, from numbers with more digits, would reject right causes.
            let agrees = own.wrong == 0;
            let largest = own.largest.map_or(0.0, |at| at.difference.abs());
            // The rounded instants belong to wrong values, which may change faster than the right ones. In a table of
            // several runs, differences between rows are no rates, so the uncertainty is limited.
            let drift = both.drift_of(values, own.claim.turn()).smaller(LEFT[1] * largest);
            let loosest = own.loosest + if agrees { 0.0 } else { drift };
            let bound = match agrees || largest > loosest {
                true => loosest,
                false => own.worst.map_or(0.0, |worst| worst.bound),
            };
            bounds.push((own.claim.text.clone(), printed.to_si(bound), agrees));
        }
        let all: Vec<Channel> = scenario.case.all_channels();
        let case = scenario.case.on(Grid { times: times.clone(), inputs: cranks.clone() })?.wanting_only(&all);
        // No cause is sought if the scenario cannot be solved for all channels at the instants of the rows.
        let Ok(right) = AssurSolver.solve(&case) else { return Ok(None) };
        for ((channel, column), (.., agrees)) in names.iter().zip(&mut columns).zip(&bounds) {
            if let Some(right) = right.column(channel).filter(|_| channel.kind.periodic) {
                unwrap(column, right, *agrees);
            }
        }
        let found = Trajectory::new(times, cranks, names, columns)?.of_input(case.crank().input);
        Ok(Some(Stage { case, right, found, bounds }))
    }

    /// A cause for some of the channels `of`. At most the fraction `left` of the difference in these channels remains.
    fn examined(&self, of: &[&Compared], left: f64) -> Option<Explained> {
        let mut diagnosis = self.diagnosis(of, left)?;
        let causes = diagnosis.cause.take().into_iter().chain(std::mem::take(&mut diagnosis.also));
        // A wrong row next to rows without numbers is no outlier: a diverging simulation ends in this way.
        let is_undefined = of.iter().any(|own| own.undefined > 0);
        let is_outlier =
            |cause: &DisagreementCause| matches!(cause, DisagreementCause::Values { slip: DataSlip::Outlier(_), .. });
        let may_be =
            |cause: &DisagreementCause| (left == 0.0 || may_leave(cause)) && !(is_undefined && is_outlier(cause));
        let mut causes = causes.filter(may_be);
        (diagnosis.cause, diagnosis.also) = (Some(causes.next()?), causes.collect());
        let is_left = |text: &str| diagnosis.left_over.iter().any(|channel| self.text(channel) == Some(text));
        let explained: Vec<String> =
            of.iter().map(|own| own.claim.text.clone()).filter(|text| !is_left(text)).collect();
        (!explained.is_empty()).then_some(Explained { of: explained, diagnosis, terms: Vec::new(), left, but: None })
    }

    /// A cause that explains all channels in `of`, except in a single row.
    /// This row is the first row, the last row, or the row whose difference is farthest from the differences of the
    /// neighbouring rows.
    fn examined_but_one(&self, of: &[&Compared], left: f64) -> Option<Explained> {
        let count = self.right.times().len();
        if !(FEWEST..MOST_ROWS).contains(&count) || of.is_empty() {
            return None;
        }
        let mut rows = vec![0, count - 1];
        rows.extend(self.stands_out());
        rows.into_iter().find_map(|row| {
            let (stage, time) = (self.without(row)?, self.right.times()[row]);
            let found = stage.examined(of, left).filter(|found| found.of.len() == of.len())?;
            Some(Explained { but: Some(time), ..found })
        })
    }

    /// The row whose difference is farthest from the differences of the neighbouring rows.
    fn stands_out(&self) -> Option<usize> {
        let bend = |row: usize| {
            let columns = self.found.iter().zip(&self.bounds).filter(|(_, (.., agrees))| !agrees);
            columns.fold(0.0, |most: f64, ((channel, values), (_, bound, _))| {
                let Some(right) = self.right.column(channel) else { return most };
                let gap = |row: usize| values[row] - right[row];
                most.larger((gap(row + 1) - 2.0 * gap(row) + gap(row - 1)).abs() / bound)
            })
        };
        (1..self.right.times().len() - 1).max_by(|&a, &b| bend(a).total_cmp(&bend(b)))
    }

    /// The rows of this examination except one row.
    fn without(&self, row: usize) -> Option<Stage> {
        let keep: Vec<bool> = (0..self.right.times().len()).map(|own| own != row).collect();
        let [right, found] = [&self.right, &self.found].map(|own| own.at_rows(&keep));
        let (times, cranks) = (right.times().to_vec(), right.inputs().to_vec());
        let case = self.case.on(Grid { times, inputs: cranks }).ok()?;
        let bounds = self.bounds.iter().zip(found.iter()).map(|((text, bound, agrees), (channel, values))| {
            let gap = right.column(channel).map(|right| largest_difference(right, values, channel.kind.periodic));
            (text.clone(), *bound, *agrees || gap.is_some_and(|gap| gap <= *bound))
        });
        let bounds = bounds.collect();
        Some(Stage { case, right, found, bounds })
    }

    /// First instant and kind of an error without a known simple cause.
    fn unexplained(&self, of: &[&Compared]) -> Option<Explained> {
        let mut diagnosis = self.diagnosis(of, 0.0)?;
        diagnosis.cause = None;
        diagnosis.also.clear();
        let of = of.iter().map(|own| own.claim.text.clone()).collect();
        Some(Explained { of, diagnosis, terms: Vec::new(), left: 0.0, but: None })
    }

    /// Terms of the mechanism that are missing in a channel, in the channel's printed unit.
    fn lacking(&self, own: &Compared) -> Option<Explained> {
        let place = self.bounds.iter().position(|(text, ..)| *text == own.claim.text)?;
        let channel = &self.found.channels()[place];
        let right = self.right.column(channel)?;
        let (printed, turn) = (&own.claim.channels[0].1, own.claim.turn());
        let gap = |(right, found): (&f64, &f64)| {
            let gap = (right - found) / printed.to_si(1.0);
            turn.map_or(gap, |turn| gap - turn * (gap / turn).round())
        };
        let differences: Vec<f64> = right.iter().zip(self.found.column(channel)?).map(gap).collect();
        let rows: Vec<usize> = (0..differences.len()).collect();
        let few: Vec<usize> = (0..FEW).map(|part| (2 * part + 1) * rows.len() / (2 * FEW)).collect();
        let wrong = Wrong {
            rows: &rows,
            bounds: vec![self.bounds[place].1 / printed.to_si(1.0); rows.len()],
            differences,
            right: right.to_vec(),
            few: &few,
        };
        let (terms, left) = missing_in_numbers(&KnownTrajectory::new(&self.case, &self.right, &|_, _| 0.0), &wrong)?;
        // A term in time or in the crank angle alone does not count: it resembles any smooth difference and is not a
        // term of a mechanism.
        let drifts = terms.iter().any(|term| term.of == "t" || term.of == "phi");
        (left == 0.0 && !drifts).then_some(())?;
        let diagnosis = self.diagnosis(&[own], 0.0)?;
        Some(Explained { of: vec![own.claim.text.clone()], diagnosis, terms, left, but: None })
    }

    fn text(&self, channel: &Channel) -> Option<&str> {
        let place = self.found.channels().iter().position(|own| own == channel)?;
        Some(&self.bounds[place].0)
    }

    /// The diagnosis of some channels. Each bound is at least the fraction `left` of the channel's largest difference.
    fn diagnosis(&self, of: &[&Compared], left: f64) -> Option<Diagnosis> {
        let judged: Vec<SuspectChannel> = self
            .found
            .channels()
            .iter()
            .zip(&self.bounds)
            .filter_map(|(channel, (text, bound, agrees))| {
                if *agrees {
                    // A cause must not make an agreeing channel disagree.
                    return Some(SuspectChannel { channel: channel.clone(), bound: *bound, disagrees: false });
                }
                let own = of.iter().find(|own| own.claim.text == *text)?;
                let largest = own.largest.map_or(0.0, |at| own.claim.channels[0].1.to_si(at.difference.abs()));
                Some(SuspectChannel { channel: channel.clone(), bound: bound.larger(left * largest), disagrees: true })
            })
            .collect();
        let parties = [(sentences::THE_ANALYTIC_SIDES, &self.right), (sentences::THE_OTHER_PARTY, &self.found)].map(
            |(name, trajectory)| {
                let bounds = judged.iter().map(|judged| (judged.channel.clone(), judged.bound)).collect();
                DiagnosedParty { name, trajectory, bounds }
            },
        );
        let question = DiagnosisInput {
            suspect: parties[1].name,
            reference: &self.right,
            suspicious: &self.found,
            judged: &judged,
            case: &self.case,
            solver: &AssurSolver,
            step: even(self.right.times()).map(|step| (step, "row")),
        };
        diagnose(&question, &parties)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The angles, each reduced to the range from -pi to pi, as many programs print angles.
    fn wrapped(values: &[f64]) -> Vec<f64> {
        values.iter().map(|value| value - TAU * (value / TAU).round()).collect()
    }

    #[test]
    fn wrapped_angles_are_unwrapped() {
        let right: Vec<f64> = (0..60).map(|row| 0.3 + 0.25 * f64::from(row)).collect();
        let twice: Vec<f64> = right.iter().map(|angle| 2.0 * angle - 0.3).collect();
        for (meant, is_right) in [(&right, true), (&twice, false)] {
            let mut values = wrapped(meant);
            unwrap(&mut values, &right, is_right);
            assert!(values.iter().zip(meant).all(|(a, b)| (a - b).abs() < 1e-12), "{is_right}: {values:?}");
        }
        // Unwrapping changes angles that are right except for whole revolutions. Wrong angles without jumps stay
        // unchanged.
        for (is_right, turns) in [(false, 2.0), (true, 0.0)] {
            let mut values: Vec<f64> = right.iter().map(|angle| angle + 2.0 * TAU).collect();
            unwrap(&mut values, &right, is_right);
            assert!(values.iter().zip(&right).all(|(a, b)| (a - b - turns * TAU).abs() < 1e-12), "{is_right}");
        }
    }
}
