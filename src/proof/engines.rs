//! One engine against the reference: its runs, the estimate of their error, and the verdict channel by channel.

use std::fmt::Write;

use super::checks;
use super::known::Known;
use super::observe::Stopped;
use super::options::Chosen;
use super::runs::{self, Bank, Runs};
use super::settle::{MORE_SWEEPS, Search, Settling};
use crate::compare::{Check, Convergence, Residual, Verdict, difference, largest_difference, overall, residuals};
use crate::scenario::Scenario;
use crate::tolerance::{Basis, Parts};
use linkage::case::Case;
use linkage::drive::Load;
use linkage::engine::{Engine, Settings};
use linkage::error::{Error, Result};
use linkage::solver::Provision;
use linkage::trajectory::{CHANNELS, Channel, Stage, Trajectory};

/// What is known about an engine that was run.
#[derive(Clone, Debug, PartialEq)]
pub struct EngineInfo {
    /// Name, as on the command line.
    pub name: &'static str,
    /// Software and version behind it.
    pub version: String,
    /// Its settings.
    pub settings: Settings,
    /// Whether its resolution is an accuracy, not a step.
    pub controls_error: bool,
    /// Settings that influence the result, by name, as text.
    pub told: Vec<(&'static str, String)>,
    /// How it provides each sort of channel: stage and provision.
    pub provides: Vec<(&'static str, Provision)>,
}

/// Comparison of one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelProof {
    /// Residual of the engine against the reference.
    pub residual: Residual,
    /// Bound, in the channel's unit.
    pub bound: f64,
    /// What the bound is made of, in the channel's unit.
    pub parts: Parts,
    /// Convergence of the engine in this channel.
    pub convergence: Convergence,
    /// Largest difference between the limit of the engine's runs and the reference, in the channel's unit; `None` where
    /// the runs have no limit that can be estimated.
    pub limit: Option<f64>,
    /// For a free motion: largest change over the run, as a share of the scale, per share of change in gravity and
    /// motor torque.
    pub sensitivity: Option<f64>,
    /// What the bound rests on.
    pub basis: Basis,
    /// The outcome.
    pub verdict: Verdict,
}

/// One engine's part of a proof.
#[derive(Clone, Debug)]
pub struct EngineProof {
    /// The engine.
    pub info: EngineInfo,
    /// How its settings were found; `None` if all were given, or if the engine failed.
    pub search: Option<Search>,
    /// Channels, in the order of columns; none if the engine failed.
    pub channels: Vec<ChannelProof>,
    /// Checks on the engine alone.
    pub checks: Vec<Check>,
    /// Verdict on channels and checks together.
    pub verdict: Verdict,
    /// Its trajectory: all instants, or those before it failed.
    pub trajectory: Option<Trajectory>,
    /// Engine minus reference; `None` if the engine failed.
    pub errors: Option<Trajectory>,
    /// Why there is no comparison.
    pub failure: Option<Error>,
}

/// What an engine's runs are judged by.
pub(super) struct Judge<'a> {
    pub(super) scenario: &'a Scenario,
    /// The reference's trajectory.
    pub(super) reference: &'a Trajectory,
    /// How well it is known.
    pub(super) known: &'a Known,
    /// Settings asked for; the search begins with them.
    pub(super) asked: Settings,
}

/// An engine at some settings, judged.
pub(super) struct Judged {
    pub(super) info: EngineInfo,
    pub(super) channels: Vec<ChannelProof>,
    pub(super) checks: Vec<Check>,
    pub(super) verdict: Verdict,
    trajectory: Trajectory,
    errors: Trajectory,
}

/// Runs an engine on `case`, at the settings asked for or at those that it finds, and compares it with `reference`.
pub(super) fn prove(
    scenario: &Scenario,
    case: &Case,
    chosen: &Chosen,
    reference: &Trajectory,
    known: &Known,
    progress: &mut dyn FnMut(f64),
) -> Result<EngineProof> {
    let engine = chosen.engine.as_ref();
    let judge = Judge { scenario, reference, known, asked: engine.settings() };
    let mut bank = Bank::new(case, engine);
    let found = if chosen.free.any() && !engine.controls_error() {
        let search = Settling::new(&judge, &mut bank, engine, chosen.free, chosen.budget);
        search.run(progress).map(|(judged, search)| (judged, Some(search)))
    } else {
        let other = Judge::other_sweeps(case, engine, engine.settings(), false);
        let runs = bank.runs(engine.settings(), other, progress);
        runs.and_then(|runs| Ok((judge.judge(engine, &runs)?, None)))
    };
    let (judged, search) = match found {
        Ok(found) => found,
        Err(Stopped { error, kept }) => {
            return Ok(EngineProof {
                info: describe(engine),
                search: None,
                channels: Vec::new(),
                checks: Vec::new(),
                verdict: Verdict::open(error.message()),
                trajectory: kept.map(|kept| *kept),
                errors: None,
                failure: Some(error),
            });
        }
    };
    let Judged { info, channels, checks, verdict, trajectory, errors } = judged;
    let mut proof = EngineProof {
        info,
        search,
        channels,
        checks,
        verdict,
        trajectory: Some(trajectory),
        errors: Some(errors),
        failure: None,
    };
    if let Some(search) = &proof.search {
        let (end, budget) = (search.end, search.budget);
        let channels = proof.channels.iter_mut().map(|channel| &mut channel.verdict);
        let all = channels.chain(proof.checks.iter_mut().map(|check| &mut check.verdict));
        all.chain([&mut proof.verdict]).for_each(|verdict| end.tell(verdict, budget));
    }
    Ok(proof)
}

impl Judge<'_> {
    /// Sweeps of the run that tells what the iteration leaves at `settings`.
    pub(super) fn other_sweeps(case: &Case, engine: &dyn Engine, settings: Settings, free: bool) -> Option<usize> {
        let other = runs::other_sweeps(case, engine, settings.sweeps);
        // A search has made runs with fewer sweeps anyway.
        other.map(|other| if free && settings.sweeps >= MORE_SWEEPS { settings.sweeps / MORE_SWEEPS } else { other })
    }

    /// Judges an engine by its runs.
    pub(super) fn judge(&self, engine: &dyn Engine, runs: &Runs) -> Result<Judged> {
        let channels = self.channels(engine, runs)?;
        let checks = checks::of_engine(self.scenario, engine, runs);
        let verdict = overall(channels.iter().map(|c| &c.verdict).chain(checks.iter().map(|c| &c.verdict)));
        let trajectory = runs.single().trajectory.clone();
        let errors = difference(self.reference, &trajectory)?;
        Ok(Judged { info: describe(engine), channels, checks, verdict, trajectory, errors })
    }
}

impl Judge<'_> {
    fn channels(&self, engine: &dyn Engine, runs: &Runs) -> Result<Vec<ChannelProof>> {
        let Judge { scenario, reference, known, .. } = *self;
        let ladder = runs.ladder();
        let [_, single, half] = ladder.resolutions;
        let (case, Settings { resolution, sweeps, .. }) = (&scenario.case, engine.settings());
        let finest = engine.at(resolution / 2.0);
        let judged = residuals(reference, single)?.into_iter().map(|residual| {
            let (channel, kind) = (residual.channel.clone(), residual.channel.kind);
            let convergence =
                Convergence::of_channel(ladder, &channel, engine.formal_order(case, kind), finest.noise(case, kind))
                    .expect("all runs of an engine have the same channels");
            let index =
                reference.channels().iter().position(|own| *own == channel).expect("residuals are of the reference");
            let parts =
                Parts { reference: known.error(kind.stage, index), ..convergence.parts(engine.noise(case, kind)) };
            let basis = convergence.tolerance(resolution, parts, checks::noise_origin(engine)).basis;
            let verdict = Verdict::of_engine(&residual, &convergence, parts, scenario.engine_rel);
            let verdict = verdict.from_settings(resolution, engine.controls_error(), sweeps);
            let verdict = unless_turning_about(case, [reference, single], &residual, resolution, verdict);
            let [single, half, reference] =
                [single, half, reference].map(|side| side.column(&channel).expect("all sides have the channel"));
            let limit = convergence.limit(single, half, kind.periodic);
            let limit = limit.map(|limit| largest_difference(reference, &limit, kind.periodic));
            ChannelProof { residual, bound: parts.sum(), parts, convergence, limit, sensitivity: None, basis, verdict }
        });
        Ok(judged.collect())
    }
}

/// Adds to an inconclusive verdict how strongly the motion depends on the forces that cause it: `sensitivity`, channel
/// by channel of the reference.
pub(super) fn tell_sensitivity(proof: &mut EngineProof, reference: &Trajectory, sensitivity: &[f64]) {
    for (channel, &change) in reference.channels().iter().zip(sensitivity) {
        let own = proof.channels.iter_mut().find(|own| own.residual.channel == *channel);
        if let Some(own) = own
            && own.residual.scale > 0.0
        {
            let share = change / own.residual.scale;
            own.sensitivity = Some(share);
            if let Verdict::Inconclusive { reason, .. } = &mut own.verdict {
                let _ = write!(
                    reason,
                    "; a millionth more of gravity and motor torque changes the channel by {share:.2} millionths of its scale"
                );
            }
        }
    }
}

/// Number of steps around a jump of the drive's acceleration in which the engine's values are doubtful.
const JUMP_STEPS: f64 = 8.0;

/// A disagreement in a force is inconclusive where a load jumps. So is one in a velocity, an acceleration or a force
/// where the drive's acceleration jumps.
fn unless_turning_about(
    case: &Case,
    sides: [&Trajectory; 2],
    residual: &Residual,
    resolution: f64,
    verdict: Verdict,
) -> Verdict {
    if residual.channel.kind.stage < Stage::Velocities {
        return verdict;
    }
    // Differences and impulses extend over a few steps to either side.
    let jump = case.crank().jump().filter(|jump| (residual.worst_time - jump).abs() <= JUMP_STEPS * resolution);
    if let (Verdict::Disagree { place }, Some(jump)) = (&verdict, jump) {
        let reason = format!(
            "{place}, but at {jump} s the drive's acceleration jumps: leave the instants about it out of the grid"
        );
        return Verdict::open(reason);
    }
    if residual.channel.kind.stage < Stage::Reactions {
        return verdict;
    }
    match (&verdict, turning_about(case, sides, residual.worst_time)) {
        (Verdict::Disagree { place }, Some(link)) => Verdict::open(format!(
            "{place}, but there link \"{link}\" turns about and its load jumps: leave that instant out of the grid"
        )),
        _ => verdict,
    }
}

/// The link whose load changes sign at an instant: the link, or its loaded point, moves one way on one side and the
/// opposite way on the other. The load jumps there, so the smallest error of the engine causes a difference of twice
/// the load.
fn turning_about<'a>(case: &'a Case, sides: [&Trajectory; 2], time: f64) -> Option<&'a str> {
    let row = sides[0].times().iter().position(|&t| t == time)?;
    let value = |side: &Trajectory, name: &str| Some(side.column(&Channel::named(name)?)?[row]);
    let both = |name: &str| Some([value(sides[0], name)?, value(sides[1], name)?]);
    let links = case.mechanism.links();
    let turns = |load: &Load| {
        let link = load.sensed_link()?;
        let [ours, theirs] = both(&format!("link.{}.omega_rad_s", links[link].name))?;
        (ours * theirs <= 0.0).then_some(link)
    };
    let turns_back = |load: &Load| {
        let at = load.sensed_point()?;
        let named = links[at.link].points.iter().find(|point| point.local == at.local)?;
        let [x, y] = ["vx", "vy"].map(|way| both(&format!("point.{}.{way}_m_s", named.name)));
        let ([x, other_x], [y, other_y]) = (x?, y?);
        (x * other_x + y * other_y <= 0.0).then_some(at.link)
    };
    let turning = case.loads.iter().find_map(|load| turns(load).or_else(|| turns_back(load)))?;
    Some(links[turning].name.as_str())
}

fn describe(engine: &dyn Engine) -> EngineInfo {
    let provides = Stage::ALL.map(|stage| {
        let kind = CHANNELS.iter().find(|kind| kind.stage == stage).expect("every stage has a channel");
        (stage.name(), engine.provides(&Channel { of: String::new(), kind }))
    });
    EngineInfo {
        name: engine.name(),
        version: engine.version(),
        settings: engine.settings(),
        controls_error: engine.controls_error(),
        told: engine.told(),
        provides: provides.into(),
    }
}
