//! Solves many poses in one call.
//! Up to rounding, the numbers of a batch equal those of a pose-by-pose solution, and both report the same errors.
//! The bits of a pose do not depend on its position in the series.

use linkage::math::KeepNan;
use linkage::math::tally::Tally;
use linkage::mechanism::{GroupKind, Pose};
use std::cell::Cell;
use std::f64::consts::TAU;

use crate::common::higher::{Among, FAMILIES, mechanism};
use crate::common::random::{for_each, within};
use crate::common::sketch::RandomSource;
use crate::common::{assert_within, shipped};
use analytic::assur::batch::{Batch, CaseBatch, PoseQuantity, PoseTally, Poses};
use analytic::range::conditions;
use analytic::{AssurSolver, PoseSolver};
use linkage::Result;
use linkage::case::{Case, Grid};
use linkage::solver::{Solver, State};
use linkage::trajectory::{OfPoint, Stage};

/// Bound on the differences, as a fraction of the largest value of the same kind.
/// Rounding errors accumulate from the crank to the last dyad, and for forces back from the last dyad to the crank.
/// The bound allows about 900 rounding errors of 1.1e-16.
const ROUNDING: f64 = 1e-13;
/// Acceleration of the crank (rad/s^2); it is not zero, so that terms with the acceleration are tested.
const ALPHA: f64 = 3.7;

/// All numbers of a state by kind: positions, directions, velocities, angular velocities, accelerations, angular
/// accelerations, forces, moments, balancing moments.
fn sorts(state: &State) -> [Vec<f64>; 9] {
    let motions = || state.motions.iter();
    [
        motions().flat_map(|motion| [motion.origin.x, motion.origin.y]).collect(),
        motions().flat_map(|motion| [motion.direction.x, motion.direction.y]).collect(),
        motions().flat_map(|motion| [motion.velocity.x, motion.velocity.y]).collect(),
        motions().map(|motion| motion.omega).collect(),
        motions().flat_map(|motion| [motion.acceleration.x, motion.acceleration.y]).collect(),
        motions().map(|motion| motion.alpha).collect(),
        state.forces.iter().flat_map(|force| [force.x, force.y]).collect(),
        state.moments.to_vec(),
        state.torques.clone(),
    ]
}

/// Solves one pose after the other, up to the first pose that fails.
fn one_by_one(case: &Case, cranks: &[f64], deepest: Stage) -> (Vec<State>, Result<()>) {
    let (mut solver, omega) = (PoseSolver::new(case).unwrap(), case.crank().at(0.0).rate);
    let mut states = Vec::new();
    for &crank in cranks {
        match solver.solve(crank, omega, ALPHA, deepest) {
            Ok(state) => states.push(state.clone()),
            Err(error) => return (states, Err(error)),
        }
    }
    (states, Ok(()))
}

fn at_once(case: &Case, cranks: &[f64], deepest: Stage) -> (Poses, Result<()>) {
    let mut poses = Poses::new();
    let omega = case.crank().at(0.0).rate;
    let outcome = Batch::of(case).unwrap().solve(cranks, omega, ALPHA, deepest, &mut poses);
    (poses, outcome)
}

fn rows(case: &Case, poses: &Poses) -> Vec<State> {
    let copied = |row| {
        let mut state = State::at_rest(case);
        poses.copy_to(row, &mut state);
        state
    };
    (0..poses.len()).map(copied).collect()
}

/// Largest difference of each kind, as a fraction of the largest value of the kind.
fn differences(ours: &[State], theirs: &[State]) -> [f64; 9] {
    let (mut difference, mut scale) = ([0.0f64; 9], [f64::MIN_POSITIVE; 9]);
    for (ours, theirs) in ours.iter().zip(theirs) {
        for (sort, (ours, theirs)) in sorts(ours).iter().zip(sorts(theirs)).enumerate() {
            for (a, b) in ours.iter().zip(theirs) {
                let apart = (a - b).abs();
                // NaN counts as infinite.
                difference[sort] = difference[sort].larger(if apart.is_nan() { f64::INFINITY } else { apart });
                scale[sort] = scale[sort].larger(b.abs());
            }
        }
    }
    std::array::from_fn(|sort| difference[sort] / scale[sort])
}

fn turn(case: &Case, count: usize) -> Vec<f64> {
    (0..count).map(|k| case.crank().start + TAU * k as f64 / count as f64).collect()
}

/// The largest condition number of a group at the poses of `states`.
fn condition(case: &Case, states: &[State]) -> f64 {
    let pose = |state: &State| Pose::of(&state.motions);
    let conditions = |state| conditions(&case.mechanism, &case.structure.groups, &pose(state));
    states.iter().flat_map(conditions).fold(1.0, f64::larger)
}

#[test]
fn batch_poses_match_the_pose_solver() {
    let kinds = [
        ("crank_rocker", true),
        ("ov7_base", true),
        ("five_bar", true),
        ("ov7_new", true),
        ("fourth_class", true),
        ("compressor", false),
    ];
    for (name, is_vectorised) in kinds {
        let case = &shipped(&format!("{name}.toml")).case;
        assert_eq!(Batch::of(case).unwrap().is_vectorised(), is_vectorised, "{name}");
        let cranks = turn(case, 500);
        let (states, outcome) = one_by_one(case, &cranks, Stage::BalancingMoment);
        outcome.unwrap();
        let (poses, outcome) = at_once(case, &cranks, Stage::BalancingMoment);
        outcome.unwrap();
        assert_eq!(poses.len(), 500);
        let found = differences(&rows(case, &poses), &states);
        // A dyad has a condition number near 1, but a higher group may have a much larger condition number.
        // In the groups after a higher group, differences grow with the higher group's condition number, so the bound
        // is multiplied by this number.
        let is_higher = case.structure.groups.iter().any(|group| group.kind == GroupKind::Higher);
        let bound = ROUNDING * if is_higher { condition(case, &states) } else { 1.0 };
        found.iter().for_each(|&found| assert_within!(found, bound, "{name}: {found:?}"));
    }
}

#[test]
fn a_stage_is_solved_without_later_stages() {
    let case = &shipped("ov7_base.toml").case;
    let cranks = turn(case, 11);
    let whole = rows(case, &at_once(case, &cranks, Stage::BalancingMoment).0);
    for (stage, sorts_of) in [(Stage::Positions, 2), (Stage::Velocities, 4), (Stage::Accelerations, 6)] {
        let part = rows(case, &at_once(case, &cranks, stage).0);
        for (part, whole) in part.iter().zip(&whole) {
            assert_eq!(sorts(part)[..sorts_of], sorts(whole)[..sorts_of], "{stage:?}");
        }
    }
}

#[test]
fn random_chains_agree_and_fail_alike() {
    let failed = Cell::new(0);
    for_each(60, |sample| {
        let case = &sample.scenario.case;
        // The grid avoids dead points, because near a dead point a dyad magnifies the errors of the dyads before it.
        let (states, _) = one_by_one(case, &case.grid.inputs, Stage::BalancingMoment);
        let (poses, outcome) = at_once(case, &case.grid.inputs, Stage::BalancingMoment);
        within("poses lost", f64::from(outcome.is_err()), 0.0)?;
        for found in differences(&rows(case, &poses), &states) {
            within("difference", found, ROUNDING * sample.condition)?;
        }
        // Tries a whole revolution in 200 and in 5 steps.
        // Most chains cannot make a whole revolution.
        // For such a chain, the batch and the pose-by-pose solution must report the same error.
        for count in [200, 5] {
            let cranks = turn(case, count);
            let (states, expected) = one_by_one(case, &cranks, Stage::Positions);
            let (poses, outcome) = at_once(case, &cranks, Stage::Positions);
            let text = |outcome: Result<()>| outcome.err().map(|error| error.to_string());
            let (ours, theirs) = (text(outcome), text(expected));
            failed.set(failed.get() + usize::from(ours.is_some()));
            assert_eq!(ours, theirs);
            assert_eq!(poses.len(), states.len());
        }
        Ok(())
    });
    assert!(failed.get() >= 20, "only {} grids led out of reach", failed.get());
}

#[test]
fn a_batch_is_usable_after_an_error() {
    let case = &shipped("crank_rocker.toml").case;
    let (start, omega) = (case.crank().start, case.crank().at(0.0).rate);
    let (mut batch, mut poses) = (Batch::of(case).unwrap(), Poses::new());
    let error = batch.solve(&[start, f64::NAN, start], omega, ALPHA, Stage::Positions, &mut poses).unwrap_err();
    assert_eq!(error.kind(), linkage::ErrorKind::Geometry);
    assert_eq!(poses.len(), 1);
    batch.solve(&[start], omega, ALPHA, Stage::BalancingMoment, &mut poses).unwrap();
    let (again, _) = at_once(case, &[start], Stage::BalancingMoment);
    assert_eq!(sorts(&rows(case, &poses)[0]), sorts(&rows(case, &again)[0]));
}

#[test]
fn a_row_has_the_same_bits_at_any_position() {
    for name in ["crank_rocker", "ov7_base", "five_bar", "ov7_new", "fourth_class"] {
        let case = &shipped(&format!("{name}.toml")).case;
        let omega = case.crank().at(0.0).rate;
        let cranks = turn(case, 1000);
        let bits = |state: &State| sorts(state).concat().iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        let whole: Vec<_> = rows(case, &at_once(case, &cranks, Stage::BalancingMoment).0).iter().map(bits).collect();
        assert_eq!(whole.len(), 1000);
        let (mut batch, mut poses) = (Batch::of(case).unwrap(), Poses::new());
        for length in [1, 7, 8, 9] {
            for (cranks, whole) in cranks.chunks(length).zip(whole.chunks(length)) {
                batch.solve(cranks, omega, ALPHA, Stage::BalancingMoment, &mut poses).unwrap();
                assert_eq!(rows(case, &poses).iter().map(bits).collect::<Vec<_>>(), whole, "{name}, {length}");
            }
        }
    }
}

#[test]
fn a_turn_split_over_threads_keeps_every_bit() {
    for name in ["ov7_base", "ov7_new", "fourth_class"] {
        let case = &shipped(&format!("{name}.toml")).case;
        let cranks = turn(case, 720);
        let bits = |cranks: &[f64]| {
            let states = rows(case, &at_once(case, cranks, Stage::BalancingMoment).0);
            states.iter().flat_map(|state| sorts(state).concat()).map(f64::to_bits).collect::<Vec<_>>()
        };
        let whole = bits(&cranks);
        for threads in [2, 5] {
            let pieces: Vec<u64> = std::thread::scope(|scope| {
                let start = |piece| scope.spawn(move || bits(piece));
                let running: Vec<_> = cranks.chunks(cranks.len().div_ceil(threads)).map(start).collect();
                running.into_iter().flat_map(|piece| piece.join().unwrap()).collect()
            });
            assert!(pieces == whole, "{name} on {threads} threads");
        }
    }
}

/// Random groups of four and six links, alone and with dyads.
/// Most of these mechanisms reach a dead point before a full revolution.
#[test]
fn random_higher_groups_agree_and_fail_alike() {
    let (mut random, mut solved, mut ended) = (RandomSource::from_seed(23), 0, 0);
    for among in [Among::Alone, Among::BehindADyad, Among::CarryingADyad] {
        for family in FAMILIES.iter().filter(|family| matches!(family.topology.links, 4 | 6)) {
            for _ in 0..12 {
                let Ok(scenario) = mechanism(&mut random, family, among).0.scenario() else { continue };
                let case = &scenario.case;
                if !Batch::of(case).unwrap().is_vectorised() {
                    continue;
                }
                for way in [1.0, -1.0] {
                    let cranks: Vec<f64> = (0..400).map(|k| case.crank().start + way * 0.016 * f64::from(k)).collect();
                    let (states, expected) = one_by_one(case, &cranks, Stage::Positions);
                    let (poses, outcome) = at_once(case, &cranks, Stage::Positions);
                    assert_eq!(outcome.is_err(), expected.is_err(), "{}", family.topology.name);
                    assert_eq!(poses.len(), states.len(), "{}", family.topology.name);
                    ended += usize::from(outcome.is_err());
                    solved += 1;
                    let found = differences(&rows(case, &poses), &states);
                    let bound = ROUNDING * condition(case, &states);
                    found[..2].iter().for_each(|&found| assert_within!(found, bound, "{}", family.topology.name));
                }
            }
        }
    }
    assert!(solved >= 60 && ended >= 20, "{solved} turns, {ended} of them ended");
}

#[test]
fn an_empty_batch_gives_no_poses() {
    let case = &shipped("crank_rocker.toml").case;
    let (poses, outcome) = at_once(case, &[], Stage::BalancingMoment);
    outcome.unwrap();
    assert!(poses.is_empty());
}

/// A case batch gives, bit by bit, the numbers of the pose solver.
/// The numbers also agree after a change of the masses of the case.
#[test]
fn a_case_batch_has_the_bits_of_the_pose_solver() {
    for (name, links) in [("crank_rocker", 3), ("ov7_base", 7)] {
        let case = &shipped(&format!("{name}.toml")).case;
        let times = (0..361).map(|row| f64::from(row) * TAU / 360.0 / case.crank().at(0.0).rate.abs()).collect();
        let case = case.with(|parts| parts.loads.clear()).unwrap();
        let case = case.on(Grid::of_times(case.crank(), times)).unwrap();
        let mut all = Vec::new();
        for (point, side) in case.mechanism.moving_points() {
            let words = ["x_m", "y_m", "vx_m_s", "vy_m_s", "ax_m_s2", "ay_m_s2"];
            let readings = [OfPoint::X, OfPoint::Y, OfPoint::VelocityX, OfPoint::VelocityY];
            let readings = readings.into_iter().chain([OfPoint::AccelerationX, OfPoint::AccelerationY]);
            let points = &case.mechanism.links()[side.link].points;
            let index = points.iter().position(|own| own.name == point).unwrap();
            let of =
                |(reading, word)| (PoseQuantity::Point(side.link, index, reading), format!("point.{point}.{word}"));
            all.extend(readings.zip(words).map(of));
        }
        for (id, link) in case.mechanism.links().entries().skip(1) {
            let own = |word: &str| format!("link.{}.{word}", link.name);
            all.push((PoseQuantity::Angle(id), own("angle_rad")));
            all.push((PoseQuantity::Omega(id), own("omega_rad_s")));
            all.push((PoseQuantity::Alpha(id), own("alpha_rad_s2")));
            all.push((PoseQuantity::Centre(id, OfPoint::VelocityY), own("vy_m_s")));
        }
        for (id, joint) in case.mechanism.joints().entries() {
            all.push((PoseQuantity::ForceX(id), format!("joint.{}.fx_N", joint.name)));
            all.push((PoseQuantity::ForceY(id), format!("joint.{}.fy_N", joint.name)));
        }
        all.push((PoseQuantity::Torque(0), "drive.torque_N_m".into()));
        let column = |(quantity, _): &(PoseQuantity, String)| PoseTally::of(*quantity, 1.0, Tally::Column(Vec::new()));
        let mut tallies: Vec<PoseTally> = all.iter().map(column).collect();
        let mut batch = CaseBatch::of(&case).unwrap();
        let mut same = |batch: &mut CaseBatch| {
            assert!(batch.solve(Stage::BalancingMoment, &mut tallies), "{name}");
            let expected = AssurSolver.solve(batch.case()).unwrap();
            for (tally, (_, channel)) in tallies.iter().zip(&all) {
                let expected = expected.named(channel).unwrap_or_else(|| panic!("{channel}"));
                assert_eq!(tally.tally, Tally::Column(expected.to_vec()), "{name}, {channel}");
            }
        };
        same(&mut batch);
        batch.renumber(|all, _| all[1..=links].iter_mut().for_each(|link| link.mass *= 1.7));
        same(&mut batch);
    }
}

/// A case batch does not solve a case that cannot be assembled; the pose solver gives the error.
#[test]
fn a_case_batch_leaves_dead_points_to_the_pose_solver() {
    let case = shipped("crank_rocker.toml").case;
    let case = case.with(|parts| parts.loads.clear()).unwrap();
    let times = (0..120).map(|row| f64::from(row) * TAU / 120.0 / case.crank().at(0.0).rate.abs()).collect();
    let case = case.on(Grid::of_times(case.crank(), times)).unwrap();
    let mut batch = CaseBatch::of(&case).unwrap();
    assert!(batch.solve(Stage::Positions, &mut []));
    // The coupler becomes so long that the dyad cannot be assembled.
    batch.renumber(|links, joints| {
        let stretch = |place: &mut linkage::math::Vec2| *place *= 3.0;
        links[2].points.iter_mut().for_each(|point| stretch(&mut point.local));
        for joint in joints {
            for side in [&mut joint.first, &mut joint.second] {
                if side.link.index() == 2 {
                    stretch(&mut side.local);
                }
            }
        }
    });
    assert!(!batch.solve(Stage::Positions, &mut []));
}
