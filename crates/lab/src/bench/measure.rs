//! Runs all methods and measures their times in rounds. Each round runs the methods one after the other.
//! The load of other programs on the machine therefore affects all methods alike.

use super::ladder::{Planned, Runner};
use super::options::Clock;
use super::peer::{Answer, Peer};
use super::point::RunEffort;
use super::point::{AnsweredRun, BenchOutcome, BenchPoint};
use super::reference::{Floor, apart};
use crate::sentences;
use linkage::case::Case;
use linkage::error::Error;
use linkage::math::KeepNan;
use linkage::solver::{Progress, Solver};
use linkage::trajectory::{Channel, Stage, Trajectory};
use linkage::work::{Count, Work, counted};

/// A run shorter than `SHORT` (s) is repeated at most `MOST` times. The repetitions are timed together.
const SHORT: f64 = 5e-3;
const MOST: f64 = 1000.0;
/// A run longer than this time (s) counts as long.
/// A long run of an analytic side or an engine is timed at most twice, a long run of a peer once.
const LONG: f64 = 0.2;
/// Largest number of rounds for long runs of analytic sides and engines, and for short runs of peers.
const FEW: usize = 2;
/// Largest length of the text that states the reason of a failure, in characters.
const REASON: usize = 300;
/// Two instants count as equal up to this difference, relative to the largest instant.
const SAME: f64 = 1e-9;

/// Everything needed to measure runs.
pub(super) struct Desk<'a> {
    pub(super) case: &'a Case,
    pub(super) reference: &'a Trajectory,
    pub(super) floor: &'a Floor,
    pub(super) peers: &'a [&'a dyn Peer],
    pub(super) clock: Clock<'a>,
}

impl Desk<'_> {
    /// Measures all planned methods and returns their points. Versions that peers report are added to `versions`.
    pub(super) fn measure(
        &self,
        mut planned: Vec<Planned>,
        rounds: usize,
        progress: Progress,
        versions: &mut Vec<(String, String)>,
    ) -> Vec<BenchPoint> {
        let (count, all) = (planned.len(), (rounds * planned.len()).max(1) as f64);
        for round in 0..rounds {
            for (index, Planned { point, runner }) in planned.iter_mut().enumerate() {
                progress((round * count + index) as f64 / all);
                match &mut point.outcome {
                    BenchOutcome::Answered(run) if round > 0 => self.again(runner, round, run),
                    BenchOutcome::Answered(_) | BenchOutcome::Failed(_) if round > 0 => {}
                    outcome @ (BenchOutcome::Answered(_) | BenchOutcome::Failed(_)) => {
                        let found = self.first(runner, versions);
                        *outcome =
                            found.map_or_else(|reason| BenchOutcome::Failed(short(&reason)), BenchOutcome::Answered);
                    }
                }
            }
        }
        planned.into_iter().map(|own| own.point).collect()
    }

    fn first(&self, runner: &Runner, versions: &mut Vec<(String, String)>) -> Result<AnsweredRun, String> {
        let told = |error: Error| error.to_string();
        match runner {
            Runner::Side(solver) => self.own(solver.as_ref()).map_err(told),
            Runner::Engine(engine) => self.own(engine.as_ref()).map_err(told),
            Runner::Peer(index, way) => {
                let peer = self.peers[*index];
                let answer = peer.run(way)?;
                let version = (peer.name().to_string(), answer.version.clone());
                if !versions.contains(&version) && !answer.version.is_empty() {
                    versions.push(version);
                }
                self.judged(answer)
            }
        }
    }

    /// Runs another round of a method that has answered.
    fn again(&self, runner: &Runner, round: usize, run: &mut AnsweredRun) {
        let is_long = run.seconds.iter().any(|&seconds| seconds > LONG);
        match runner {
            Runner::Side(_) | Runner::Engine(_) | Runner::Peer(..) if is_long && round >= FEW => {}
            Runner::Side(solver) => run.seconds.extend(self.timed(solver.as_ref()).map(|(seconds, ..)| seconds)),
            Runner::Engine(engine) => run.seconds.extend(self.timed(engine.as_ref()).map(|(seconds, ..)| seconds)),
            // A peer restarts for every answer, and repeats short runs by itself.
            // A peer therefore gets at most `FEW` rounds.
            Runner::Peer(index, way) if round < FEW && !is_long => {
                if let Ok(answer) = self.peers[*index].run(way) {
                    run.seconds.extend(answer.seconds.into_iter().filter(|seconds| *seconds > 0.0));
                }
            }
            Runner::Peer(..) => {}
        }
    }

    /// Time of a solver in this round, its solution and its work.
    /// Short runs are repeated and timed together, because reading the clock takes time.
    fn timed<S: Solver + ?Sized>(&self, solver: &S) -> Result<(f64, Trajectory, Work), Error> {
        let since = (self.clock)();
        let (found, work) = counted(|| solver.solve(self.case));
        let first = (self.clock)() - since;
        let found = found?;
        if first >= SHORT {
            return Ok((first, found, work));
        }
        let times = (SHORT / first).ceil().smaller(MOST).larger(1.0) as usize;
        let since = (self.clock)();
        for _ in 0..times {
            drop(solver.solve(self.case)?);
        }
        Ok((((self.clock)() - since) / times as f64, found, work))
    }

    fn own<S: Solver + ?Sized>(&self, solver: &S) -> Result<AnsweredRun, Error> {
        let (seconds, found, work) = self.timed(solver)?;
        let counts = Count::ALL.into_iter().map(|what| (what.name().to_string(), work.of(what)));
        let effort = RunEffort(counts.filter(|(_, times)| *times > 0).collect());
        let apart = apart(self.reference, &found)?;
        let errors = Stage::ALL
            .map(|stage| self.case.wanted.has(stage).then(|| self.floor.judged(stage, apart[stage as usize])));
        Ok(AnsweredRun { errors, failed: Vec::new(), without: Vec::new(), seconds: vec![seconds], effort })
    }

    /// Converts a peer's answer to a run. A fault in the answer is returned as the error.
    fn judged(&self, answer: Answer) -> Result<AnsweredRun, String> {
        let column = |name: &str| answer.columns.iter().find(|(own, _)| own == name).map(|(_, values)| values);
        let times = column("t_s").ok_or(sentences::THE_ANSWER_HAS_NO_COLUMN)?;
        let wanted = &self.case.grid.times;
        if times.len() != wanted.len() {
            return Err(sentences::the_answer_has_instants_and_are_wanted(&times.len(), &wanted.len()));
        }
        let span = wanted.iter().fold(0.0f64, |most, t| most.larger(t.abs()));
        if let Some(row) = (0..times.len()).find(|&row| !((times[row] - wanted[row]).abs() <= SAME * span)) {
            return Err(sentences::row_of_the_answer_is_at_and_is_wanted(&(row + 1), &times[row], &wanted[row]));
        }
        let seconds: Vec<f64> = answer.seconds.iter().copied().filter(|&own| own > 0.0 && own.is_finite()).collect();
        if seconds.is_empty() {
            return Err(sentences::THE_ANSWER_HAS_NO_TIME_ABOVE.into());
        }
        let (mut errors, mut failed, mut without) = ([None; Stage::ALL.len()], Vec::new(), Vec::new());
        for stage in Stage::ALL.into_iter().filter(|&stage| self.case.wanted.has(stage)) {
            let all = self.reference.channels().iter().filter(|one| one.kind.stage == stage);
            let (own, missing): (Vec<&Channel>, Vec<&Channel>) =
                all.partition(|one| column(&one.to_string()).is_some());
            if own.is_empty() {
                continue;
            }
            if let Some(first) = missing.first() {
                without.push((stage, format!("{first}{}", and_more(missing.len() - 1))));
            }
            let columns = own.iter().map(|one| column(&one.to_string()).cloned().unwrap_or_default()).collect();
            let channels = own.into_iter().cloned().collect();
            match Trajectory::new(wanted.clone(), self.reference.inputs().to_vec(), channels, columns) {
                Ok(found) => {
                    let apart = apart(self.reference, &found).map_err(|error| error.to_string())?;
                    errors[stage as usize] = Some(self.floor.judged(stage, apart[stage as usize]));
                }
                Err(error) => failed.push((stage, error.to_string())),
            }
        }
        // An answer without any requested channel counts as a failure.
        match (errors.iter().any(Option::is_some), failed.first()) {
            (true, _) => Ok(AnsweredRun { errors, failed, without, seconds, effort: answer.effort }),
            (false, Some((_, reason))) => Err(reason.clone()),
            (false, None) => Err(sentences::THE_ANSWER_HAS_NONE_OF_THE_WANTED.into()),
        }
    }
}

fn and_more(more: usize) -> String {
    if more == 0 { String::new() } else { sentences::and_more(&more) }
}

/// The first line of a reason, short enough for a diagram.
fn short(reason: &str) -> String {
    let line = reason.lines().find(|line| !line.trim().is_empty()).unwrap_or(sentences::NO_REASON_WAS_GIVEN).trim();
    match line.char_indices().nth(REASON) {
        Some((end, _)) => format!("{}...", &line[..end]),
        None => line.to_string(),
    }
}
