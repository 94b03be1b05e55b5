//! One point of a family: both analytic sides and all engines on one case.

use crate::sentences;
use std::panic::{AssertUnwindSafe, catch_unwind};

use linkage::case::Case;
use linkage::error::{Error, Result};
use linkage::math::KeepNan;
use linkage::math::statistics::share;
use linkage::trajectory::{Channel, Stage, Trajectory};
use linkage::work::{Count, counted};

use super::outcome::{PartyAtPoint, PointEnd, QuantityGroup, StressOutcome, WorstOfGroup, rounded};
use super::{EngineUse, Setup, StressFamily};
use prover::bounds::{Check, Verdict, difference, scales};
use prover::engines::{self, EngineName};
use prover::run::beside::{AnalyticSide, BothSides, Deviation, sides};
use prover::run::{EngineProof, Options, prove};
use scenario::Scenario;

/// Solves a family's point with all solvers and engines of this build. A panic counts as a failure of the point.
pub fn run(family: &StressFamily, dial: f64, sample: u64, seed: u64) -> StressOutcome {
    let setup = (family.setup)(dial, sample, seed);
    let key = key(family, setup.as_ref().ok(), seed);
    let mut outcome = StressOutcome { dial, sample, key, refused: String::new(), parties: Vec::new() };
    match setup {
        Err(error) => outcome.refused = told(&error),
        Ok(setup) => match catch_unwind(AssertUnwindSafe(|| parties(family, &setup))) {
            Ok(Ok(parties)) => outcome.parties = parties,
            Ok(Err(error)) => outcome.refused = told(&error),
            Err(_) => outcome.refused = "panic".into(),
        },
    }
    outcome
}

/// The key of a point, computed without running the point.
pub(super) fn key_of(family: &StressFamily, dial: f64, sample: u64, seed: u64) -> String {
    key(family, (family.setup)(dial, sample, seed).as_ref().ok(), seed)
}

/// FNV-1a hash of everything that the result depends on: the program's version and engines, the case, and the solvers
/// and engines that run on the case.
fn key(family: &StressFamily, setup: Option<&Setup>, seed: u64) -> String {
    let engines: Vec<String> =
        built().map(|name| engines::with_step(name, 1.0).map_or_else(|_| String::new(), |own| own.version())).collect();
    let text = format!("{} {} {seed} {engines:?} {setup:?}", env!("CARGO_PKG_VERSION"), family.name);
    fnv(&text)
}

/// FNV-1a hash of a text, in hexadecimal digits.
pub fn fnv(text: &str) -> String {
    let hash = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    format!("{:016x}", text.bytes().fold(0xcbf2_9ce4_8422_2325, hash))
}

fn built() -> impl Iterator<Item = EngineName> {
    EngineName::ALL.into_iter().filter(|name| engines::is_built(*name))
}

/// An error as one line, with the value of the input at which the error occurred.
fn told(error: &Error) -> String {
    // A message that already names the input gets no input value.
    let at = error.input().filter(|at| !error.message().contains(at.input.noun()));
    format!("{}{}", error.message(), at.map_or_else(String::new, |at| format!(" at {at}")))
}

fn parties(family: &StressFamily, setup: &Setup) -> Result<Vec<PartyAtPoint>> {
    let case = &setup.case;
    let truth = if setup.precise { Some(precise::solve(case)) } else { None };
    let (truth, without) = match truth {
        Some(Ok(truth)) => (Some(truth), String::new()),
        Some(Err(error)) => (None, told(&error)),
        None => (None, String::new()),
    };
    let found = sides(case, truth.as_ref())?;
    let against = match &truth {
        Some(_) => precise::method(case).to_string(),
        None if without.is_empty() => sentences::THE_OTHER_SIDE_2.into(),
        None => sentences::the_other_side(&without),
    };
    let mut all: Vec<PartyAtPoint> = found.sides.iter().map(|side| of_side(side, &found, &against)).collect();
    let reference = truth.as_ref().map(|truth| (truth, against.as_str()));
    let reference = reference.or(found.trajectory.as_ref().map(|own| (own, "side 1")));
    if setup.engines != EngineUse::None {
        for name in built() {
            all.push(of_engine(family, setup, name, reference));
        }
    }
    Ok(all)
}

fn of_side(side: &AnalyticSide, all: &BothSides, against: &str) -> PartyAtPoint {
    if let Some(error) = &side.failure {
        return PartyAtPoint::failed(side.name, &told(error));
    }
    let beyond = side.deviations.iter().filter(|own| !(own.used <= 1.0)).count();
    PartyAtPoint {
        against: if side.deviations.is_empty() { String::new() } else { against.into() },
        reached: reached(&side.deviations),
        closure: side.closure.map(rounded),
        balance: side.balance.map(rounded),
        verdict: end(&all.verdict),
        why: reason(&all.verdict),
        done: side.work.iter().map(|(what, times)| (what.name().into(), times)).collect(),
        silent: if all.silent > 0 { beyond } else { 0 },
        ..PartyAtPoint::failed(side.name, "")
    }
}

fn of_engine(
    family: &StressFamily,
    setup: &Setup,
    name: EngineName,
    truth: Option<(&Trajectory, &str)>,
) -> PartyAtPoint {
    let options = match setup.engines {
        EngineUse::None | EngineUse::Found(_) => Options::default(),
        // The settings are given, so there is no search, and the smallest budget is enough.
        EngineUse::Given { step, sweeps } => Options::default().step(step).sweeps(sweeps).budget(1.0),
    };
    let options = match setup.engines {
        EngineUse::Found(work) => options.budget(work),
        EngineUse::None | EngineUse::Given { .. } => options,
    };
    let scenario = Scenario::of_case(family.name, setup.case.clone());
    let (proof, work) = counted(|| scenario.and_then(|scenario| prove(&scenario, &options.engine(name))));
    let own = [Count::Worlds, Count::Steps, Count::Sweeps, Count::Probes];
    let done = own.map(|what| (what.name().to_string(), work.of(what))).into_iter().filter(|(_, times)| *times > 0);
    let party = match proof {
        Err(error) => PartyAtPoint::failed(name.name(), &told(&error)),
        // An engine may agree with the reference although the two analytic sides disagree.
        // The verdict of the whole proof is therefore counted.
        Ok(proof) => of_proof(&setup.case, proof.engine(), &proof.verdict, truth),
    };
    PartyAtPoint { done: done.collect(), ..party }
}

fn of_proof(case: &Case, proof: &EngineProof, whole: &Verdict, truth: Option<(&Trajectory, &str)>) -> PartyAtPoint {
    let name = proof.info.name;
    if let Some(error) = &proof.failure {
        return PartyAtPoint::failed(name, &told(error));
    }
    let (Some(trajectory), Some((truth, against))) = (&proof.trajectory, truth) else {
        return PartyAtPoint::failed(name, sentences::THERE_IS_NOTHING_TO_HOLD);
    };
    let deviations = match deviations(truth, trajectory, proof) {
        Ok(deviations) => deviations,
        Err(error) => return PartyAtPoint::failed(name, &told(&error)),
    };
    let settings = &proof.info.settings;
    let agrees = |verdict: &Verdict| matches!(verdict, Verdict::Agree { .. } | Verdict::Expected { .. });
    let told_of = |own: &Deviation| {
        let own = proof.channels.iter().find(|channel| channel.residual.channel == own.channel);
        own.is_some_and(|own| !agrees(&own.verdict))
    };
    let silent = deviations.iter().filter(|own| !(own.used <= 1.0) && agrees(whole) && !told_of(own)).count();
    let check = |family: &str| {
        let own = |check: &&Check| check.family.starts_with(family);
        proof.checks.iter().find(own).map(|check| rounded(check.value))
    };
    let span = case.grid.times.iter().fold(0.0f64, |last, t| last.larger(t.abs()));
    let fixed = |value: f64| (!proof.info.controls_error).then(|| rounded(value));
    PartyAtPoint {
        against: against.into(),
        reached: reached(&deviations),
        closure: check("closure"),
        balance: check("driving moment"),
        verdict: end(whole),
        why: reason(whole),
        step: fixed(settings.resolution),
        sweeps: Some(settings.sweeps),
        extrapolated: Some(settings.extrapolated),
        steps: fixed((span / settings.resolution).ceil()),
        runs: proof.search.as_ref().map(|search| search.runs),
        work: proof.search.as_ref().map(|search| rounded(search.effort)),
        silent,
        ..PartyAtPoint::failed(name, "")
    }
}

/// Error of every judged channel of an engine. Rows that the proof leaves out are left out here too.
fn deviations(truth: &Trajectory, own: &Trajectory, proof: &EngineProof) -> Result<Vec<Deviation>> {
    let (errors, scales) = (difference(truth, own)?, scales(truth));
    let of = |((channel, values), scale): ((&Channel, &[f64]), f64)| {
        let judged = proof.channels.iter().find(|judged| judged.residual.channel == *channel)?;
        let kept = |row: usize| judged.left_out == 0 || proof.kept.get(row).is_none_or(|kept| *kept);
        let sizes = values.iter().enumerate().filter(|(row, _)| kept(*row)).map(|(_, value)| value.abs());
        let error = sizes.fold(0.0, f64::larger);
        Some(Deviation {
            channel: channel.clone(),
            error: share(error, scale),
            bound: share(judged.bound, scale),
            used: share(error, judged.bound),
        })
    };
    Ok(errors.iter().zip(scales).filter_map(of).collect())
}

fn group(stage: Stage) -> QuantityGroup {
    match stage {
        Stage::Positions => QuantityGroup::Positions,
        Stage::Velocities | Stage::Accelerations => QuantityGroup::Rates,
        Stage::Reactions | Stage::BalancingMoment => QuantityGroup::Forces,
    }
}

/// The worst channel of every group.
fn reached(deviations: &[Deviation]) -> Vec<WorstOfGroup> {
    let of = |wanted: QuantityGroup| {
        let own = || deviations.iter().filter(|own| group(own.channel.kind.stage) == wanted);
        let worst = own().max_by(|a, b| a.error.total_cmp(&b.error))?;
        Some(WorstOfGroup {
            group: wanted,
            error: rounded(worst.error),
            bound: rounded(worst.bound),
            channel: worst.channel.to_string(),
            used: rounded(own().map(|own| own.used).fold(0.0, f64::larger)),
        })
    };
    QuantityGroup::ALL.into_iter().filter_map(of).collect()
}

/// Converts a verdict to the outcome of a point.
/// `Expected` cannot occur, because the families have no published numbers.
fn end(verdict: &Verdict) -> PointEnd {
    match verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => PointEnd::Agree,
        Verdict::Disagree { .. } => PointEnd::Disagree,
        Verdict::Inconclusive { .. } => PointEnd::Inconclusive,
    }
}

/// The reason of a verdict. The reason contains no advice, because advice depends on the command.
fn reason(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => String::new(),
        Verdict::Disagree { place } => place.clone(),
        Verdict::Inconclusive { reason, .. } => reason.clone(),
    }
}
