//! The diagnosis of a disagreeing proof: its parties, and the party to be examined.

use super::each_side::{EachSide, Reference};
use super::engine_proof::EngineProof;
use super::known::Known;
use super::observe::Observed;
use crate::bounds::{Verdict, largest_difference};
use crate::diagnosis::{DiagnosedParty, Diagnosis, DiagnosisInput, PartyStanding, SuspectChannel, diagnose, standing};
use linkage::case::{Case, Grid};
use linkage::trajectory::{Channel, Trajectory};

/// Examines the analytic side that contradicts all other parties.
/// If no side contradicts all others, examines the first engine that disagrees. If no engine disagrees, examines the
/// side that is not the reference.
/// `None` if no channel disagrees.
pub(super) fn of(
    case: &Case,
    main: Reference,
    sides: &EachSide<Observed>,
    known: &Known,
    engines: &[EngineProof],
) -> Option<Diagnosis> {
    let between = side_bounds(sides, known);
    let engine = engines.iter().find(|engine| engine.channels.iter().any(|channel| disagrees(&channel.verdict)));
    if engine.is_none() && !between.iter().any(|judged| judged.disagrees) {
        return None;
    }
    // The diagnosis leaves out instants that are not judged.
    let keep = engine.map_or_else(|| vec![true; case.grid.len()], |engine| engine.kept.clone());
    let thin = |trajectory: &Trajectory| trajectory.at_rows(&keep);
    let own = EachSide::of(|side| thin(&sides[side].trajectory));
    let case = &case.on(Grid::of_times(case.crank(), own[main].times().to_vec())).ok()?;
    let ran = engines.iter().filter(|engine| engine.failure.is_none());
    let ran: Vec<(&EngineProof, Trajectory)> =
        ran.filter_map(|engine| Some((engine, thin(engine.trajectory.as_ref()?)))).collect();

    // The bound applies to the difference of the two analytic sides, so each side gets half of the bound.
    let halves: Vec<_> = between.iter().map(|judged| (judged.channel.clone(), judged.bound / 2.0)).collect();
    let mut parties: Vec<DiagnosedParty> = own
        .iter()
        .map(|(side, trajectory)| DiagnosedParty { name: side.name(), trajectory, bounds: halves.clone() })
        .collect();
    parties.extend(ran.iter().map(|(engine, trajectory)| {
        let bounds = judged(engine).into_iter().map(|judged| (judged.channel, judged.bound)).collect();
        DiagnosedParty { name: engine.info.name, trajectory, bounds }
    }));
    let alone = match standing(&parties) {
        PartyStanding::Alone(name) => Some(name),
        PartyStanding::Together | PartyStanding::Camps(_) | PartyStanding::Open(_) => None,
    };
    let of_side = |suspect: Reference| {
        let (reference, suspicious) = (&own[suspect.other()], &own[suspect]);
        let (solver, suspect, judged) = (suspect.other().solver(), suspect.name(), &between[..]);
        diagnose(&DiagnosisInput { suspect, reference, suspicious, judged, case, solver, step: None }, &parties)
    };
    match (alone.and_then(|name| Reference::named(&name)), engine) {
        (Some(side), _) => of_side(side),
        (None, None) => of_side(main.other()),
        (None, Some(engine)) => {
            let (_, suspicious) = ran.iter().find(|(own, _)| own.info.name == engine.info.name)?;
            let question = DiagnosisInput {
                suspect: engine.info.name,
                reference: &own[main],
                suspicious,
                judged: &judged(engine),
                case,
                solver: main.solver(),
                step: (!engine.info.controls_error).then_some((engine.info.settings.resolution, "step")),
            };
            diagnose(&question, &parties)
        }
    }
}

fn disagrees(verdict: &Verdict) -> bool {
    matches!(verdict, Verdict::Disagree { .. })
}

/// Those channels of an engine that have reliable bounds. A channel is left out if it exceeds its bound but the verdict
/// is inconclusive.
fn judged(engine: &EngineProof) -> Vec<SuspectChannel> {
    let channels = engine.channels.iter().filter(|own| own.convergence.is_trusted());
    let judged = channels.map(|own| (own.residual.max, own.bound, &own.residual.channel, disagrees(&own.verdict)));
    let sure = judged.filter(|&(value, bound, _, disagrees)| disagrees || value <= bound);
    sure.map(|(_, bound, channel, disagrees)| SuspectChannel { channel: channel.clone(), bound, disagrees }).collect()
}

/// Bounds on the difference of the two sides, from the known errors of both sides.
fn side_bounds(sides: &EachSide<Observed>, known: &Known) -> Vec<SuspectChannel> {
    let [one, other] = sides.pair().map(|own| &own.trajectory);
    let of = |(index, channel): (usize, &Channel)| {
        let gap = largest_difference(one.column(channel)?, other.column(channel)?, channel.kind.periodic);
        let bound = known.between(channel.kind.stage, index);
        // This form of the comparison makes NaN disagree.
        Some(SuspectChannel { channel: channel.clone(), bound, disagrees: !(gap <= bound) })
    };
    one.channels().iter().enumerate().filter_map(of).collect()
}

#[cfg(test)]
mod tests {

    use super::*;
    use crate::diagnosis::{DataSlip, DisagreementCause, Plain};
    use crate::run::observe::{Watch, observe};
    use crate::run::{Options, prove};
    use fixtures::of_repository;
    use linkage::solver::Solver;

    /// The observations of `side`, but with the sign of the balancing moment changed in the trajectory.
    fn spoiled(mut side: Observed) -> Observed {
        let right = &side.trajectory;
        let moment = Channel::named("drive.torque_N_m").unwrap();
        let column = |(channel, values): (&Channel, &[f64])| match *channel == moment {
            true => values.iter().map(|value| -value).collect(),
            false => values.to_vec(),
        };
        let columns = right.iter().map(column).collect();
        let (times, cranks) = (right.times().to_vec(), right.inputs().to_vec());
        side.trajectory = Trajectory::new(times, cranks, right.channels().to_vec(), columns).unwrap();
        side
    }

    /// The engine's results decide which of the two sides is wrong, and the diagnosis names the cause of this side's
    /// error.
    #[test]
    fn a_side_contradicted_by_side_and_engine_is_the_odd_one_out() {
        let scenario = of_repository("scenarios/crank_rocker.toml");
        let case = &scenario.case;
        let right = prove(&scenario, &Options::default()).unwrap();
        assert!(right.diagnosis.is_none());
        let seen = |solver: &dyn Solver| {
            observe(case, solver, Watch::Side, &mut |_| {}).unwrap_or_else(|stopped| panic!("{}", stopped.error))
        };
        for wrong in Reference::ALL {
            let sides = EachSide::of(|side| match side == wrong {
                true => spoiled(seen(side.solver())),
                false => seen(side.solver()),
            });
            let known = Known::of(case, sides.pair().map(|side| &side.trajectory)).unwrap();
            let found = of(case, Reference::Assur, &sides, &known, &right.engines).expect("the sides disagree");
            let wrong = wrong.name();
            assert_eq!((found.suspect.as_str(), &found.alone), (wrong, &PartyStanding::Alone(wrong.into())));
            assert!(
                matches!(found.cause, Some(DisagreementCause::Values { slip: DataSlip::Plain(Plain::Sign), .. })),
                "{:?}",
                found.cause
            );
            assert!(found.is_explained());
        }
    }
}
