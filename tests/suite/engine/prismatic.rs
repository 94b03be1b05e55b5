//! Prismatic joints: mechanisms with every kind of dyad that has such joints, built by hand.
//! The engines are compared with the whole-mechanism solver.

use analytic::NewtonSolver;
use linkage::case::{Case, Grid};
use linkage::math::KeepNan;
use linkage::mechanism::{JointSide, Link, LinkId, Mechanism};
use linkage::solver::Solver;
use rapier_twin::tree::SpanningTree;
use rapier_twin::{Build, Precision, Rapier};

use super::native::moving;
use super::{has_formal_order, solve};
use crate::common::sliders::{self, SPEED, swapped};
use crate::common::{assert_within, states};

/// The case with the link behind the crank (a rod, a block or a disc) made massless.
fn lighter(case: &Case) -> Case {
    let mut links = case.mechanism.links().to_vec();
    links[2] = Link { mass: 0.0, inertia: 0.0, ..links[2].clone() };
    let mechanism = Mechanism::new(links, case.mechanism.joints().to_vec()).unwrap();
    case.with(|parts| parts.mechanism = mechanism).unwrap()
}

/// Story 50.
/// Symptom: a slider moves in the wrong direction, or a slide, its speed or its moment does not converge.
/// Cause: the slide is measured along the axis of the parent in the tree, which may be the joint's second link.
/// The slide's speed belongs to the previous step, so the axis of the previous step must be used.
/// The order must be 2 in every channel, whichever link is named first and whichever link has no mass.
#[test]
fn regress_50_all_sorts_of_sliders_converge_with_the_formal_order() {
    for sample in sliders::all() {
        for case in [sample.case.clone(), lighter(&swapped(&sample.case))] {
            has_formal_order(&case, prover::engines::named("rapier", 1e-3).into_iter(), &NewtonSolver);
        }
        has_formal_order(&sample.case, prover::engines::named("impulse", 2e-3).into_iter(), &NewtonSolver);
    }
}

/// Story 51.
/// Symptom: slide speeds are wrong in the second digit.
/// Cause: as in story 12, the speed that the engine gives after step n belongs to step n - 1.
#[test]
fn regress_51_slide_speeds_are_one_step_late() {
    let dt = 1e-3;
    for sample in sliders::all() {
        for case in [sample.case.clone(), swapped(&sample.case)] {
            let steps = (case.grid.times.last().unwrap() / dt) as usize;
            let times: Vec<f64> = (0..=steps).map(|n| n as f64 * dt).collect();
            let truth = states(&NewtonSolver, &case, &times).unwrap();
            let tree = SpanningTree::of(&case.mechanism);
            let mut twin = moving(&case, Build::Multibody, tree.clone(), dt);
            let (mut now, mut late, mut size) = (0.0f64, 0.0f64, 0.0f64);
            for n in 1..=steps {
                twin.step();
                for (index, branch) in tree.branches.iter().enumerate() {
                    let joint = &case.mechanism.joints()[branch.joint];
                    let sign = if joint.first.link == branch.parent { 1.0 } else { -1.0 };
                    let Some([_, is, _]) = truth[n].slide(joint) else { continue };
                    let was = truth[n - 1].slide(joint).unwrap()[1];
                    let speed = sign * twin.relative_speed(index);
                    // The first steps have a transient, so they are not compared.
                    if n > 20 {
                        (now, late, size) =
                            (now.larger((speed - is).abs()), late.larger((speed - was).abs()), size.larger(is.abs()));
                    }
                }
            }
            // The crank rotates by 0.01 rad in a step.
            // A lag of one step therefore changes a speed by about 1 %; the engine's error is about 1e-4.
            assert!(now >= 5e-3 * size, "{}: {now:e}, {late:e} of {size}", sample.name);
            assert_within!(late, 1e-3 * size, "{}: {now:e}, {late:e} of {size}", sample.name);
        }
    }
}

/// Story 52.
/// Symptom: angles of links in sliders drift, or lose a revolution.
/// A prismatic joint keeps the angle between its links to the bit, including whole revolutions of the start pose.
/// In the coupling, all moving links rotate with the crank.
#[test]
fn regress_52_links_in_sliders_turn_together() {
    let case = sliders::double::oldham().case;
    let case = case.with(|parts| parts.start.0[LinkId(2)].angle += std::f64::consts::TAU).unwrap();
    let cranks = (0..=40).map(|k| case.crank().start + f64::from(k) * std::f64::consts::PI).collect();
    let case = case.on(Grid::of_inputs(case.crank(), cranks)).unwrap();
    let mut solvers: Vec<Box<dyn Solver>> = vec![Box::new(NewtonSolver)];
    solvers.push(Box::new(Rapier::new(Build::Multibody, Precision::Double, 1e-3)));
    for solver in solvers {
        for (state, &crank) in states(solver.as_ref(), &case, &case.grid.times).unwrap().iter().zip(&case.grid.inputs) {
            for link in case.mechanism.links().ids().skip(1) {
                let turned = state.angles[link] - case.start.0[link].angle;
                // For each step, the bound grows by half a unit in the last place of the largest angle, as in story 1.
                let bound = 0.5 * f64::EPSILON * 128.0 * (crank / SPEED / 1e-3);
                let error = (turned - (crank - case.crank().start)).abs();
                assert_within!(error, bound, "{} link {link} at {crank}: {error:e}", solver.name());
            }
        }
    }
}

/// Story 53.
/// Symptom: at the same step, mechanisms with sliders have larger errors than mechanisms with pins only.
/// At a step of 1e-4 s, the largest errors of the five mechanisms were 1.4e-6, 8.3e-6, 7.8e-7, 2.0e-5 and 1.7e-6.
/// Each of these errors is the largest over all channels, divided by half the range of its channel.
/// (The fourth mechanism makes only a fifth of a revolution, so its ranges are small.)
/// The bounds are a tenth larger than these errors.
#[test]
fn regress_53_errors_of_sliders_are_as_measured() {
    let measured = [1.4e-6, 8.3e-6, 7.8e-7, 2.0e-5, 1.7e-6];
    for (sample, measured) in sliders::all().into_iter().zip(measured) {
        let truth = solve(&NewtonSolver, &sample.case);
        for engine in [prover::engines::named("rapier", 1e-4).unwrap()] {
            let found = prover::bounds::residuals(&truth, &solve(engine.as_ref(), &sample.case)).unwrap();
            for residual in found {
                let error = residual.share();
                assert_within!(error, 1.1 * measured, "{} {}: {error:e}", sample.name, residual.channel);
            }
        }
    }
}

/// Story 54.
/// Symptom: no value looks wrong, until a run follows the wrong branch.
/// Cause: at the start, a slide has the wrong sign if the parent in the spanning tree is the joint's second
/// link.
/// The first step closes the loop again, which hides the fault.
#[test]
fn regress_54_the_twin_starts_in_the_start_pose() {
    for sample in sliders::all() {
        for case in [sample.case.clone(), swapped(&sample.case)] {
            for build in [Build::Multibody, Build::Impulse] {
                let tree = if build == Build::Impulse {
                    SpanningTree::none(&case.mechanism)
                } else {
                    SpanningTree::of(&case.mechanism)
                };
                let twin = moving(&case, build, tree, 1e-3);
                for (link, body) in case.mechanism.links().entries() {
                    for point in &body.points {
                        let gap =
                            twin.point(JointSide { link, local: point.local }) - case.start.0[link].point(point.local);
                        // The bound is the rounding error of a chain of three links, each shorter than 0.5 m.
                        assert_within!(gap.norm(), 1e-15, "{} {} {}: {gap}", sample.name, body.name, point.name);
                    }
                }
            }
        }
    }
}
