//! The diagnosis of a proof that disagrees: its parties, and which of them is examined.

use super::engines::EngineProof;
use super::observe::Observed;
use crate::compare::{Check, Verdict, magnitudes};
use crate::diagnosis::{Diagnosis, Judged, Party, Question, Standing, diagnose, standing};
use linkage::case::Case;
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Trajectory};

/// Examines the party that stands alone; else the first engine that disagrees; else the side that is not the
/// reference. `None` if no channel disagrees.
pub(super) fn of(
    case: &Case,
    main: &dyn Solver,
    sides: &[(&'static str, Observed); 2],
    checks: &[Check],
    engines: &[EngineProof],
) -> Option<Diagnosis> {
    let between = side_bounds(sides, checks);
    let engine = engines.iter().find(|engine| engine.channels.iter().any(|channel| disagrees(&channel.verdict)));
    if engine.is_none() && !between.iter().any(|judged| judged.disagrees) {
        return None;
    }
    let mut parties: Vec<Party> = sides
        .iter()
        .map(|(name, side)| {
            // The bound is on the difference of the two.
            let bounds = between.iter().map(|judged| (judged.channel.clone(), judged.bound / 2.0)).collect();
            Party { name, trajectory: &side.trajectory, bounds }
        })
        .collect();
    parties.extend(engines.iter().filter_map(|engine| {
        let bounds = judged(engine).into_iter().map(|judged| (judged.channel, judged.bound)).collect();
        Some(Party { name: engine.info.name, trajectory: engine.trajectory.as_ref()?, bounds })
    }));
    let [one, other] = match sides[0].0 == main.name() {
        true => [&sides[0], &sides[1]],
        false => [&sides[1], &sides[0]],
    };
    let alone = match standing(&parties) {
        Standing::Alone(name) => Some(name),
        Standing::Together | Standing::Camps(_) | Standing::Open(_) => None,
    };
    let of_sides = |suspect: &(&'static str, Observed), reference: &Trajectory| {
        let (suspicious, solver) = (&suspect.1.trajectory, main);
        let judged = &between;
        diagnose(&Question { suspect: suspect.0, reference, suspicious, judged, case, solver, step: None }, &parties)
    };
    match (alone, engine) {
        (Some(name), _) if name == one.0 => of_sides(one, &other.1.trajectory),
        (Some(name), _) if name == other.0 => of_sides(other, &one.1.trajectory),
        (_, None) => of_sides(other, &one.1.trajectory),
        (_, Some(engine)) => {
            let question = Question {
                suspect: engine.info.name,
                reference: &one.1.trajectory,
                suspicious: engine.trajectory.as_ref()?,
                judged: &judged(engine),
                case,
                solver: main,
                step: (!engine.info.controls_error).then_some(engine.info.settings.resolution),
            };
            diagnose(&question, &parties)
        }
    }
}

fn disagrees(verdict: &Verdict) -> bool {
    matches!(verdict, Verdict::Disagree { .. })
}

/// The channels of an engine whose bounds can be relied on. One that is beyond its bound for a known reason is none.
fn judged(engine: &EngineProof) -> Vec<Judged> {
    let channels = engine.channels.iter().filter(|own| own.convergence.is_trusted());
    let judged = channels.map(|own| (own.residual.max, own.bound, &own.residual.channel, disagrees(&own.verdict)));
    let sure = judged.filter(|&(value, bound, _, disagrees)| disagrees || value <= bound);
    sure.map(|(_, bound, channel, disagrees)| Judged { channel: channel.clone(), bound, disagrees }).collect()
}

/// Bounds on the difference of the two sides, from the check of each stage.
fn side_bounds(sides: &[(&'static str, Observed); 2], checks: &[Check]) -> Vec<Judged> {
    let [one, other] = [0, 1].map(|side: usize| &sides[side].1.trajectory);
    let family = format!("{} against {}", sides[0].0, sides[1].0);
    let of = |(channel, size): (&Channel, f64)| {
        let stage = channel.kind.stage.name();
        let check = checks.iter().find(|check| check.family == family && check.detail == stage)?;
        let gap = crate::compare::largest_difference(one.column(channel)?, other.column(channel)?, channel.kind.periodic);
        let bound = check.bound * size;
        let disagrees = disagrees(&check.verdict) && !(gap <= bound);
        Some(Judged { channel: channel.clone(), bound, disagrees })
    };
    one.channels().iter().zip(magnitudes(one)).filter_map(of).collect()
}
