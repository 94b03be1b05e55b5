//! Values of other instants: late values, early values, or values from a clock that is fast or slow.

use crate::sentences;
use std::cell::Cell;
use std::ops::RangeInclusive;
use std::rc::Rc;

use super::bench::{Bench, Column, Misfit};
use super::cause::{DataSlip, DisagreementCause, LateChannels};
use super::knobs::significant;
use super::question::{DiagnosisInput, Rank};
use super::tries::{Candidate, Make};
use linkage::case::{Case, Grid};
use linkage::math::KeepNan;
use linkage::math::statistics::ascending;

/// Largest number of steps of the search for a delay or a clock factor.
const STEPS: usize = 6;
/// If the misfit is below this fraction of the initial misfit, the present number is close to the number sought.
const NEAR: f64 = 1e-2;
/// Simple multiples of a step by which values may be late.
const PARTS: [f64; 7] = [0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0];
/// Factors on the time of a row, with the unit that was confused.
const CLOCKS: [(f64, Option<&str>); 8] = [
    (1e-3, Some(sentences::MILLISECONDS_TAKEN_FOR_SECONDS)),
    (1e3, Some(sentences::SECONDS_TAKEN_FOR_MILLISECONDS)),
    (1.0 / 60.0, Some(sentences::SECONDS_TAKEN_FOR_MINUTES)),
    (60.0, Some(sentences::MINUTES_TAKEN_FOR_SECONDS)),
    (0.5, None),
    (2.0, None),
    (0.1, None),
    (10.0, None),
];
/// Number of rows after which a fast clock is tried in a free motion.
const FIRST_ROWS: usize = 4;

/// Finds values of another instant, in all channels, in the channels of one stage or in the disagreeing channels, and
/// values from a fast or slow clock.
pub(super) fn late(question: &DiagnosisInput, bench: &Bench, start: &Misfit) -> Vec<Candidate> {
    let mut limits = vec![LateChannels::All];
    let of_stage = |column: &Column| LateChannels::OfStage(column.channel.kind.stage);
    for column in bench.columns.iter().filter(|column| column.disagrees) {
        let is_all = bench.columns.iter().all(|other| of_stage(other) == of_stage(column));
        if !is_all && !limits.contains(&of_stage(column)) {
            limits.push(of_stage(column));
        }
    }
    if bench.columns.iter().any(|column| !column.disagrees) {
        limits.push(LateChannels::Explained);
    }
    let search = Search { question, bench, start };
    let mut found: Vec<Candidate> = limits.into_iter().filter_map(|of| search.late_in(of)).collect();
    if found.iter().all(|one| one.changed_channels() != LateChannels::All) {
        // Jumps of forces can mislead the search, so the delay found for one stage is also tried for all channels.
        let all = found.iter().find_map(|one| search.late_by(&one.found.cause));
        found.extend(all);
    }
    found.extend(search.clock());
    found
}

struct Search<'a, 'b> {
    question: &'a DiagnosisInput<'b>,
    bench: &'a Bench<'b>,
    start: &'a Misfit,
}

impl Search<'_, '_> {
    fn late_in(&self, of_channels: LateChannels) -> Option<Candidate> {
        let bench = self.bench;
        let span = bench.case.grid.times.iter().fold(0.0, |most: f64, t| most.larger(t.abs()));
        let of = |by: f64| bench.tried_in(&shifted(&bench.case, by)?, of_channels);
        let step = self.question.step;
        let (nudge, parts) = match step {
            Some((size, _)) => (size, &PARTS[..]),
            None => (1e-5 * span, &[][..]),
        };
        // Prefers a simple multiple of a step that is near the delay found, if the multiple explains a channel.
        let plain = |by: f64| {
            let (size, told) = step?;
            let part =
                parts.iter().flat_map(|part| [*part, -part]).find(|part| (part * size - by).abs() < 0.05 * size)?;
            let misfit = of(part * size)?;
            self.late_candidate(&misfit, part * size, Some((part, told)), of_channels)
        };
        let rows = parts.iter().filter(|part| part.fract() == 0.0).flat_map(|part| [*part, -part]);
        let named = rows.filter_map(|part| plain(part * step?.0)).next();
        if named.is_some() {
            return named;
        }
        let is_enough = |misfit: &Misfit| misfit.fits() || of_channels != LateChannels::All && self.explains(misfit);
        let mut named = None;
        let found = self.secant(0.0, 0.25 * nudge, &of, &mut |by, misfit| {
            named = plain(by).or_else(|| {
                let (by, misfit) = self.short(by, misfit, 3..=5, &of, &is_enough)?;
                self.late_candidate(&misfit, by, None, of_channels)
            });
            named.is_some() || is_enough(misfit)
        });
        named.or_else(|| found.and_then(|(by, misfit)| self.late_candidate(&misfit, by, None, of_channels)))
    }

    /// The hypothesis that all channels are late by the delay found for one stage.
    fn late_by(&self, cause: &DisagreementCause) -> Option<Candidate> {
        let &DisagreementCause::Values { slip: DataSlip::Late { by, steps, .. }, .. } = cause else { return None };
        let misfit = self.bench.tried(&shifted(&self.bench.case, by)?)?;
        self.late_candidate(&misfit, by, steps, LateChannels::All)
    }

    /// A number with few digits near the found number, if its misfit satisfies `is_enough`. The found number is the
    /// result of an iteration, so it has many digits.
    fn short(
        &self,
        value: f64,
        misfit: &Misfit,
        mut digits: RangeInclusive<usize>,
        of: &dyn Fn(f64) -> Option<Misfit>,
        is_enough: &dyn Fn(&Misfit) -> bool,
    ) -> Option<(f64, Misfit)> {
        if misfit.worst() > NEAR * self.start.worst() {
            return None;
        }
        digits.find_map(|digits| {
            let value = significant(value, digits);
            of(value).filter(is_enough).map(|misfit| (value, misfit))
        })
    }

    /// The hypothesis that the suspect's clock is fast or slow, or counts in another unit.
    fn clock(&self) -> Option<Candidate> {
        let bench = self.bench;
        let of = |factor: f64| bench.tried(&on_clock(&bench.case, factor)?);
        let plain = CLOCKS.iter().filter(|(factor, _)| self.may_be_on_clock(*factor)).find_map(|&(factor, told)| {
            let misfit = of(factor)?;
            self.clock_candidate(&misfit, factor, told)
        });
        if plain.is_some() {
            return plain;
        }
        let mut named = None;
        let found = self.secant(1.0, 1e-6, &of, &mut |factor, misfit| {
            // Numbers with few digits are tried for a fast clock, and inverses of such numbers for a slow clock.
            let slow = |value: f64| of(1.0 / value);
            named = self.short(factor, misfit, 2..=6, &of, &Misfit::fits).or_else(|| {
                let (inverse, misfit) = self.short(1.0 / factor, misfit, 2..=6, &slow, &Misfit::fits)?;
                Some((1.0 / inverse, misfit))
            });
            named.is_some() || misfit.fits()
        });
        let (factor, misfit) = named.or(found)?;
        self.clock_candidate(&misfit, factor, None)
    }

    /// Whether the whole motion is followed on a clock with this factor. Following a free motion for longer costs more,
    /// so a factor above 1 must first explain differences of the first rows.
    fn may_be_on_clock(&self, factor: f64) -> bool {
        if factor < 1.0 || !self.bench.case.is_free() {
            return true;
        }
        let rows: Vec<usize> = ascending(self.question.reference.times()).into_iter().take(FIRST_ROWS).collect();
        let bench = Bench::new(self.question, &rows, Rc::new(Cell::new(1)));
        bench.is_some_and(|bench| {
            let explains = |case: Case| bench.tried(&case).is_some_and(|misfit| misfit.fits());
            !bench.start().fits() && on_clock(&bench.case, factor).is_some_and(explains)
        })
    }

    /// A number for which `is_found` is true, by the secant method. The search begins at `origin`, the number that
    /// changes nothing.
    fn secant(
        &self,
        origin: f64,
        nudge: f64,
        of: &dyn Fn(f64) -> Option<Misfit>,
        is_found: &mut dyn FnMut(f64, &Misfit) -> bool,
    ) -> Option<(f64, Misfit)> {
        let mut effect = of(origin + nudge)?.plus(-1.0, self.start).times(1.0 / nudge);
        let (mut old, mut before) = (origin, self.start.clone());
        for _ in 0..STEPS {
            let square = effect.dot(&effect);
            if !(square > 0.0 && square.is_finite()) {
                return None;
            }
            let next = old - effect.dot(&before) / square;
            let misfit = of(next)?;
            if is_found(next, &misfit) {
                return Some((next, misfit));
            }
            if next == old || misfit.dot(&misfit) > before.dot(&before) {
                return None;
            }
            effect = misfit.plus(-1.0, &before).times(1.0 / (next - old));
            (old, before) = (next, misfit);
        }
        None
    }

    fn explains(&self, misfit: &Misfit) -> bool {
        !self.bench.explained(self.start, misfit).is_empty()
    }

    fn late_candidate(
        &self,
        misfit: &Misfit,
        by: f64,
        steps: Option<(f64, &'static str)>,
        of: LateChannels,
    ) -> Option<Candidate> {
        let rank = match (steps, of) {
            (Some(_), _) => Rank::Change,
            (None, LateChannels::All) => Rank::Number,
            (None, LateChannels::OfStage(_) | LateChannels::Explained) => Rank::Fitted,
        };
        self.candidate(misfit, rank, DataSlip::Late { by, steps, of }, Box::new(move |case| shifted(case, by)))
    }

    fn clock_candidate(&self, misfit: &Misfit, factor: f64, told: Option<&'static str>) -> Option<Candidate> {
        let rank = if told.is_some() { Rank::Scale } else { Rank::Number };
        self.candidate(misfit, rank, DataSlip::Clock { factor, told }, Box::new(move |case| on_clock(case, factor)))
    }

    fn candidate(&self, misfit: &Misfit, rank: Rank, slip: DataSlip, make: Make) -> Option<Candidate> {
        Candidate::of(
            self.bench,
            [self.start, misfit],
            rank,
            |channels| DisagreementCause::Values { slip, channels },
            make,
        )
    }
}

/// The case at instants that are earlier by `by` (s). A free motion has no instants before its start.
fn shifted(case: &Case, by: f64) -> Option<Case> {
    let earliest = if case.is_free() { 0.0 } else { f64::NEG_INFINITY };
    at_times(case, |t| (t - by).larger(earliest))
}

/// The case at its instants multiplied by a factor.
fn on_clock(case: &Case, factor: f64) -> Option<Case> {
    at_times(case, |t| factor * t)
}

fn at_times(case: &Case, of: impl Fn(f64) -> f64) -> Option<Case> {
    let times = case.grid.times.iter().map(|t| of(*t)).collect();
    case.on(Grid::of_times(case.crank(), times)).ok()
}
