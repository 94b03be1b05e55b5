//! Why a table is off, where that is simple.

use std::borrow::Cow;
use std::collections::BTreeSet;

use super::judge::{Both, Compared, Row};
use crate::claims::{Course, Term, Wrong, missing_in_numbers};
use crate::diagnosis::{Diagnosis, Judged, Party, Question, diagnose};
use crate::scenario::Scenario;
use analytic::AssurSolver;
use formula::Shape;
use linkage::case::Grid;
use linkage::error::Result;
use linkage::math::KeepNan;
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Trajectory};

/// A cause, and what stays over when it is granted.
#[derive(Clone, Debug)]
pub struct Explained {
    /// The channels that were examined, by their texts.
    pub of: Vec<String>,
    /// What was found.
    pub diagnosis: Diagnosis,
    /// Terms that are missing, where that is the cause.
    pub terms: Vec<Term>,
    /// Share of the largest difference that may stay over when the cause is granted; zero for what the bounds allow.
    pub left: f64,
}

/// Shares of the largest difference that a cause may leave over: nothing but the bounds, then little, as the error of a
/// simulation that is wrong besides.
const LEFT: [f64; 3] = [0.0, 0.01, 0.05];

/// Number of channels that are off by little that terms are tried on.
const TRIED: usize = 12;

/// Number of instants that terms are tried on at first.
const FEW: usize = 24;

/// Number of instants that causes are sought on, besides those that tell most.
const MOST: usize = 2000;

/// Share of a channel's scale from which on a difference is a mistake, and not the error of a method.
pub const GROSS: f64 = 0.02;

/// Examines the channels of the party beside a scenario that disagree: all together, then those that are grossly off,
/// together and one by one. What is off by little and without a common cause is the error of a method.
pub(super) fn explained(
    scenario: &Scenario,
    both: &Both,
    channels: &[Compared],
    is_first: bool,
) -> Result<Vec<Explained>> {
    let is_wrong = |own: &&Compared| own.since.is_some() && own.is_plain();
    let wrong: Vec<&Compared> = channels.iter().filter(is_wrong).collect();
    let Some(stage) = Stage::of(scenario, both, channels, is_first)? else { return Ok(Vec::new()) };
    if let Some(all) = stage.examined(&wrong, &LEFT[..1]).filter(|all| all.of.len() == wrong.len()) {
        return Ok(vec![all]);
    }
    let mut found = Vec::new();
    let (mut open, little): (Vec<&Compared>, Vec<&Compared>) = wrong.into_iter().partition(|own| own.is_gross());
    while !open.is_empty() {
        // All of them at once, unless that explains none.
        let mut next = stage.examined(&open, &LEFT);
        if next.is_none() && open.len() > 1 {
            next = open.iter().find_map(|one| stage.examined(&[*one], &LEFT));
        }
        next = next.or_else(|| open.iter().find_map(|one| stage.lacking(one)));
        let Some(explained) = next else {
            found.extend(stage.unexplained(&open));
            break;
        };
        open.retain(|own| !explained.of.contains(&own.claim.text));
        found.push(explained);
    }
    // What is off by little may be a method's error, unless a term explains all of it.
    let lacking = little.into_iter().take(TRIED).filter_map(|one| stage.lacking(one));
    found.extend(lacking.filter(|explained| explained.left == 0.0));
    Ok(found)
}

impl Compared {
    /// Whether it is a channel with numbers on both sides.
    fn is_plain(&self) -> bool {
        matches!(self.claim.tree.shape, Shape::Name(_)) && self.largest.is_some()
    }

    /// Whether it is off by so much that no method's error explains it.
    #[must_use]
    pub fn is_gross(&self) -> bool {
        self.since.is_some() && self.largest.is_some_and(|at: Row| at.difference.abs() > GROSS * self.scale)
    }
}

/// What the channels are examined on: the rows at which all of them have numbers.
struct Stage {
    case: linkage::case::Case,
    right: Trajectory,
    found: Trajectory,
    /// By channel of `found`: text of its claim, the bound on it in SI, and whether it agrees.
    bounds: Vec<(String, f64, bool)>,
}

impl Stage {
    fn of(scenario: &Scenario, both: &Both, channels: &[Compared], is_first: bool) -> Result<Option<Stage>> {
        let other = both.parties[usize::from(is_first)];
        let plain = channels.iter().filter(|own| own.is_plain());
        let plain: Vec<(&Compared, Cow<[formula::Rounded]>)> = plain
            .filter(|own| !own.claim.channels[0].1.magnitude)
            .filter_map(|own| Some((own, other.values_of(&own.claim)?)))
            .collect();
        let has_all = |row: &usize| plain.iter().all(|(_, values)| values[*row].value.is_finite());
        let mut rows: Vec<usize> = both.at.ascending().into_iter().filter(has_all).collect();
        rows.dedup_by(|a, b| both.places[0][*a] == both.places[0][*b]);
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
        let times: Vec<f64> = rows.iter().map(|&row| both.places[0][row]).collect();
        let cranks: Vec<f64> = rows.iter().map(|&row| both.places[1][row]).collect();
        let (mut names, mut columns, mut bounds) = (Vec::new(), Vec::new(), Vec::new());
        for (own, values) in &plain {
            let printed = &own.claim.channels[0].1;
            if names.contains(&printed.channel) {
                continue;
            }
            names.push(printed.channel.clone());
            columns.push(rows.iter().map(|&row| printed.to_si(values[row].value)).collect());
            let bound = printed.to_si(own.worst.map_or(0.0, |worst| worst.bound));
            bounds.push((own.claim.text.clone(), bound, own.since.is_none()));
        }
        let all: Vec<Channel> = scenario.case.all_channels();
        let case = scenario.case.on(Grid { times: times.clone(), cranks: cranks.clone() })?.wanting_only(&all);
        // What is compared was solved at these instants; channels beside it may not be.
        let Ok(right) = AssurSolver.solve(&case) else { return Ok(None) };
        let found = Trajectory::new(times, cranks, names, columns)?;
        Ok(Some(Stage { case, right, found, bounds }))
    }

    /// A cause that explains some of the channels.
    fn examined(&self, of: &[&Compared], shares: &[f64]) -> Option<Explained> {
        shares.iter().find_map(|&left| {
            let diagnosis = self.diagnosis(of, left)?;
            diagnosis.cause.as_ref()?;
            let is_left = |text: &str| diagnosis.left_over.iter().any(|channel| self.text(channel) == Some(text));
            let explained: Vec<String> =
                of.iter().map(|own| own.claim.text.clone()).filter(|text| !is_left(text)).collect();
            (!explained.is_empty()).then_some(Explained { of: explained, diagnosis, terms: Vec::new(), left })
        })
    }

    /// What can be said where no cause is simple: since when.
    fn unexplained(&self, of: &[&Compared]) -> Option<Explained> {
        let diagnosis = self.diagnosis(of, 0.0)?;
        let of = of.iter().map(|own| own.claim.text.clone()).collect();
        Some(Explained { of, diagnosis, terms: Vec::new(), left: 0.0 })
    }

    /// What a channel lacks that the mechanism has, in the unit that it is printed in.
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
        let (terms, left) = missing_in_numbers(&Course::new(&self.case, &self.right, &|_, _| 0.0), &wrong)?;
        let is_little = left <= LEFT[1];
        is_little.then_some(())?;
        Some(Explained { of: vec![own.claim.text.clone()], diagnosis: self.diagnosis(&[own], 0.0)?, terms, left })
    }

    fn text(&self, channel: &Channel) -> Option<&str> {
        let place = self.found.channels().iter().position(|own| own == channel)?;
        Some(&self.bounds[place].0)
    }

    /// The diagnosis of some channels; what a cause may leave over widens their bounds.
    fn diagnosis(&self, of: &[&Compared], left: f64) -> Option<Diagnosis> {
        let judged: Vec<Judged> = self
            .found
            .channels()
            .iter()
            .zip(&self.bounds)
            .filter_map(|(channel, (text, bound, agrees))| {
                if *agrees {
                    // A cause must not spoil it.
                    return Some(Judged { channel: channel.clone(), bound: *bound, disagrees: false });
                }
                let own = of.iter().find(|own| own.claim.text == *text)?;
                let largest = own.largest.map_or(0.0, |at| own.claim.channels[0].1.to_si(at.difference.abs()));
                Some(Judged { channel: channel.clone(), bound: bound.larger(left * largest), disagrees: true })
            })
            .collect();
        let parties =
            [("the analytic sides", &self.right), ("the other party", &self.found)].map(|(name, trajectory)| {
                let bounds = judged.iter().map(|judged| (judged.channel.clone(), judged.bound)).collect();
                Party { name, trajectory, bounds }
            });
        let question = Question {
            suspect: parties[1].name,
            reference: &self.right,
            suspicious: &self.found,
            judged: &judged,
            case: &self.case,
            solver: &AssurSolver,
            step: None,
        };
        diagnose(&question, &parties)
    }
}
