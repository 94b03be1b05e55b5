//! The reduced model under loads.

use linkage::math::KeepNan;
use std::f64::consts::TAU;

use analytic::PoseSolver;
use analytic::reduced::{CrankState, ReducedModel, RunUp, RunUpEnd, motion};
use linkage::case::Case;
use linkage::drive::Load;
use linkage::error::ErrorKind;
use linkage::trajectory::Stage;

use crate::common::{assert_within, centre, centre_velocity, shipped};
use linkage::mechanism::LinkId;

/// The press, with only the loads that `keep` accepts.
fn press(keep: impl Fn(&Load) -> bool) -> Case {
    shipped("loaded_slider.toml").case.with(|parts| parts.loads.retain(keep)).unwrap()
}

/// Sum of kinetic energy, potential energy of the weights and energy of the linear springs (J).
fn energy(case: &Case, poses: &mut PoseSolver, at: &CrankState) -> f64 {
    let state = poses.solve(at.crank, at.omega, at.alpha, Stage::Velocities).unwrap();
    let mut sum = 0.0;
    for (index, link) in case.mechanism.links().entries().skip(1) {
        let velocity = centre_velocity(case, state, index);
        sum += (link.mass * velocity.norm_squared() + link.inertia * state.motions[index].omega.powi(2)) / 2.0;
        sum -= link.mass * case.gravity.dot(&centre(case, state, index));
    }
    for load in &case.loads {
        if let &Load::Spring { ends, stiffness, free_length } = load {
            let [first, second] = ends.map(|end| state.motions[end.link].point(end.local));
            sum += stiffness * ((second - first).norm() - free_length).powi(2) / 2.0;
        }
    }
    sum
}

#[test]
fn a_spring_returns_its_energy() {
    let case = press(|load| matches!(load, Load::Spring { .. }));
    assert_eq!(case.loads.len(), 1);
    let model = ReducedModel::of(&case).unwrap();
    let times: Vec<f64> = (0..=2000).map(|k| f64::from(k) * 5e-3).collect();
    let (found, end) = motion(&model, 60.0, &times, 3e-15).unwrap();
    assert_eq!(end, RunUpEnd::Reached);
    let mut poses = PoseSolver::new(&case).unwrap();
    let first = energy(&case, &mut poses, &found[0]);
    let worst = found.iter().map(|at| (energy(&case, &mut poses, at) - first).abs()).fold(0.0, f64::larger);
    assert_within!(worst, 1e-11 * first.abs(), "{worst:e} of {first}");
    assert!(found[2000].crank > 10.0 * TAU);
}

#[test]
fn reduced_moments_of_varying_loads_match_the_reactions() {
    let case = press(|load| matches!(load, Load::Force { .. } | Load::Spring { .. }));
    let rod = case.mechanism.link_named("rod").unwrap();
    let table = linkage::drive::Course::table(&[(0.3, 2.0), (4.0, -5.0), (9.0, 8.0)], 2, false);
    let acts = linkage::drive::Acts::Clockwise;
    let more = [Load::Moment { link: rod, moment: table, acts }, Load::Resistance { link: rod, moment: 3.0 }];
    let case = case.with(|parts| parts.loads.extend(more)).unwrap();
    let model = ReducedModel::of(&case).unwrap();
    // The period is two revolutions, because one load table extends over two revolutions.
    // The table over two revolutions has three points per period; the press's table has nine points per revolution.
    // The resistance of the rod adds no kinks, because the rod reverses at points of the press's table.
    assert_eq!((model.kinks().period, model.kinks().cranks.len()), (Some(2.0 * TAU), 3 + 18));
    let times: Vec<f64> = (0..=400).map(|k| f64::from(k) * 1e-3).collect();
    let found = RunUp::of(&model, 120.0, &times, 1e-12).unwrap();
    assert!(found.motion.last().unwrap().crank > 4.0 * TAU);
    let worst = found.power_residual().unwrap();
    assert_within!(worst, 1e-12, "{worst:e}");
}

#[test]
fn loads_unknown_to_the_reduction_are_refused_by_name() {
    for (keep, word) in [("damper", "magnitude of speeds"), ("torsion_damper", "magnitude of speeds")] {
        let case = press(|load| load.sort() == keep);
        let error = ReducedModel::of(&case).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Unsupported);
        assert!(
            error.message().contains(keep) && error.message().contains(word) && error.way_out().is_some(),
            "{error}"
        );
    }
    let case = press(|_| false);
    let loaded = |loads: Vec<Load>| case.with(|parts| parts.loads = loads).unwrap();
    let at = case.mechanism.joint_named("guide").map(|joint| case.mechanism.joints()[joint].second).unwrap();
    let resisted = loaded(vec![Load::ResistingForce { at, force: 1.0 }]);
    let error = ReducedModel::of(&resisted).unwrap_err();
    assert!(error.message().contains("\"resisting_force\" follows the motion of a point"), "{error}");
    let (link, acts) = (at.link, linkage::drive::Acts::Always);
    let tables = [7, 11, 17].map(|turns| Load::Moment {
        link,
        moment: linkage::drive::Course::table(&[(0.0, 1.0)], turns, true),
        acts,
    });
    assert!(ReducedModel::of(&loaded(tables.into())).unwrap_err().message().contains("after 1309 turns"));
    let crank = case.crank().link;
    let spring = vec![Load::TorsionSpring {
        links: [LinkId(0), crank],
        stiffness: 1.0,
        free_angle: 0.0,
        acts: linkage::drive::Acts::Always,
    }];
    assert!(ReducedModel::of(&loaded(spring)).unwrap_err().message().contains("wound up by every turn"));
}
