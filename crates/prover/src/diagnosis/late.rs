//! Values of other instants: late values, early values, or values from a clock that is fast or slow.

use crate::sentences;
use std::ops::RangeInclusive;

use super::bench::{Bench, Column, Misfit};
use super::cause::{DataSlip, DisagreementCause};
use super::knobs::significant;
use super::question::{DiagnosisInput, Rank};
use super::tries::{Candidate, Make};
use linkage::case::{Case, Grid};
use linkage::math::KeepNan;
use linkage::trajectory::Stage;

/// Largest number of steps of the search for a delay or a clock factor.
const STEPS: usize = 6;
/// If the misfit is below this fraction of the initial misfit, the present number is close to the number sought.
const NEAR: f64 = 1e-2;
/// Simple multiples of a step by which values may be late.
const PARTS: [f64; 7] = [0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0];
/// Factors on the time of a row, with their meaning.
const CLOCKS: [(f64, &str); 4] = [
    (1e-3, sentences::MILLISECONDS_TAKEN_FOR_SECONDS),
    (1e3, sentences::SECONDS_TAKEN_FOR_MILLISECONDS),
    (1.0 / 60.0, sentences::SECONDS_TAKEN_FOR_MINUTES),
    (60.0, sentences::MINUTES_TAKEN_FOR_SECONDS),
];

/// Finds values of another instant, in all channels or in the channels of one stage, and values from a fast or slow
/// clock.
pub(super) fn late(question: &DiagnosisInput, bench: &Bench, start: &Misfit) -> Vec<Candidate> {
    let mut stages: Vec<Option<Stage>> = vec![None];
    let stage = |column: &Column| Some(column.channel.kind.stage);
    for column in bench.columns.iter().filter(|column| column.disagrees) {
        let is_all = bench.columns.iter().all(|other| stage(other) == stage(column));
        let stage = stage(column);
        if !is_all && !stages.contains(&stage) {
            stages.push(stage);
        }
    }
    let search = Search { question, bench, start };
    let mut found: Vec<Candidate> = stages.into_iter().filter_map(|stage| search.late_in(stage)).collect();
    if found.iter().all(|one| one.stage().is_some()) {
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
    fn late_in(&self, stage: Option<Stage>) -> Option<Candidate> {
        let bench = self.bench;
        let span = bench.case.grid.times.iter().fold(0.0, |most: f64, t| most.larger(t.abs()));
        let of = |by: f64| bench.tried_in(&shifted(&bench.case, by)?, stage);
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
            self.late_candidate(&misfit, part * size, Some((part, told)), stage)
        };
        let rows = parts.iter().filter(|part| part.fract() == 0.0).flat_map(|part| [*part, -part]);
        let named = rows.filter_map(|part| plain(part * step?.0)).next();
        if named.is_some() {
            return named;
        }
        let is_enough = |misfit: &Misfit| misfit.fits() || stage.is_some() && self.explains(misfit);
        let mut named = None;
        let found = self.secant(0.0, 0.25 * nudge, &of, &mut |by, misfit| {
            named = plain(by).or_else(|| {
                let (by, misfit) = self.short(by, misfit, 3..=5, &of, &is_enough)?;
                self.late_candidate(&misfit, by, None, stage)
            });
            named.is_some() || is_enough(misfit)
        });
        named.or_else(|| found.and_then(|(by, misfit)| self.late_candidate(&misfit, by, None, stage)))
    }

    /// The hypothesis that all channels are late by the delay found for one stage.
    fn late_by(&self, cause: &DisagreementCause) -> Option<Candidate> {
        let &DisagreementCause::Values { slip: DataSlip::Late { by, steps, .. }, .. } = cause else { return None };
        let misfit = self.bench.tried(&shifted(&self.bench.case, by)?)?;
        self.late_candidate(&misfit, by, steps, None)
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
        // In a free motion, factors above 1 are not tried, because following the motion for longer would cost too much.
        let mut clocks = CLOCKS.iter().filter(|(factor, _)| *factor < 1.0 || !bench.case.is_free());
        let plain = clocks.find_map(|&(factor, told)| {
            let misfit = of(factor)?;
            self.clock_candidate(&misfit, factor, Some(told))
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
        stage: Option<Stage>,
    ) -> Option<Candidate> {
        let rank = match (steps, stage) {
            (Some(_), _) => Rank::Change,
            (None, None) => Rank::Number,
            (None, Some(_)) => Rank::Fitted,
        };
        self.candidate(misfit, rank, DataSlip::Late { by, steps, stage }, Box::new(move |case| shifted(case, by)))
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
