//! Values of another instant.

use super::bench::{Bench, Misfit};
use super::cause::{Cause, Slip};
use super::question::{Question, Rank};
use super::tries::{Candidate, Make};
use linkage::case::{Case, Grid};
use linkage::math::KeepNan;
use linkage::trajectory::Stage;

/// Steps of the search for the time.
const STEPS: usize = 6;

/// Values of another instant: of all channels, or of those of one stage.
pub(super) fn late(question: &Question, bench: &Bench, start: &Misfit) -> Vec<Candidate> {
    let mut stages: Vec<Option<Stage>> = vec![None];
    for column in bench.columns.iter().filter(|column| column.disagrees) {
        let stage = Some(column.channel.kind.stage);
        if !stages.contains(&stage) {
            stages.push(stage);
        }
    }
    stages.into_iter().filter_map(|stage| late_in(question, bench, start, stage)).collect()
}

fn late_in(question: &Question, bench: &Bench, start: &Misfit, stage: Option<Stage>) -> Option<Candidate> {
    let times = &bench.case.grid.times;
    let span = times.iter().fold(0.0, |most: f64, t| most.larger(t.abs()));
    let step = question.step;
    let of = |by: f64| bench.tried_in(&shifted(&bench.case, by)?, stage);
    let nudge = step.unwrap_or(1e-5 * span) * 0.25;
    let mut effect = of(nudge)?.plus(-1.0, start).times(1.0 / nudge);
    let (mut old, mut before) = (0.0, start.clone());
    for _ in 0..STEPS {
        let square = effect.dot(&effect);
        if !(square > 0.0 && square.is_finite()) {
            return None;
        }
        let by = old - effect.dot(&before) / square;
        // A whole or plain part of a step, where it is as good.
        let parts = [0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0].into_iter().flat_map(|part| [part, -part]);
        let near =
            step.and_then(|step| parts.map(|part| (part * step, part)).find(|(t, _)| (t - by).abs() < 0.05 * step));
        if let Some((at, part)) = near
            && let Some(misfit) = of(at)
            && let Some(found) = late_candidate(bench, start, &misfit, at, Some(part), stage)
        {
            return Some(found);
        }
        let misfit = of(by)?;
        if misfit.fits() || stage.is_some() {
            let found = late_candidate(bench, start, &misfit, by, None, stage);
            if found.is_some() {
                return found;
            }
        }
        if by == old || misfit.dot(&misfit) > before.dot(&before) {
            return None;
        }
        effect = misfit.plus(-1.0, &before).times(1.0 / (by - old));
        (old, before) = (by, misfit);
    }
    None
}

fn late_candidate(
    bench: &Bench,
    start: &Misfit,
    misfit: &Misfit,
    by: f64,
    steps: Option<f64>,
    stage: Option<Stage>,
) -> Option<Candidate> {
    let explained = bench.explained(start, misfit);
    let cause = Cause::Values { slip: Slip::Late { by, steps, stage }, channels: explained.clone() };
    let rank = match (steps, stage) {
        (Some(_), _) => Rank::Change,
        (None, None) => Rank::Number,
        (None, Some(_)) => Rank::Fitted,
    };
    let make: Make = Box::new(move |case| shifted(case, by));
    let claim = bench.claim(start, misfit);
    (!explained.is_empty()).then_some(Candidate { rank, cause, make, stage, explained, claim, number: None })
}

/// The same case asked at instants that are earlier by `by` (s). A free motion has none before it begins.
fn shifted(case: &Case, by: f64) -> Option<Case> {
    let earliest = if case.is_free() { 0.0 } else { f64::NEG_INFINITY };
    let times = case.grid.times.iter().map(|t| (t - by).larger(earliest)).collect();
    case.on(Grid::of_times(case.crank(), times)).ok()
}
