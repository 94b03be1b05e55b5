//! Prismatic joints on the analytic sides: against closed forms, differences, and the laws of momentum and power.

use crate::common::sliders::{self, SPEED, Sample};
use crate::common::{assert_within, centre, centre_acceleration, states};
use analytic::{self, witness::power};
use linkage::case::Case;
use linkage::math::{KeepNan, Vec2, cross};
use linkage::mechanism::JointId;
use linkage::solver::{Solver, State};

/// The states of a solver on the sample's grid, with their times and crank angles.
fn solved(solver: &dyn Solver, case: &Case) -> Vec<(f64, f64, State)> {
    let found = states(solver, case, &case.grid.times).unwrap();
    let rows = case.grid.times.iter().zip(&case.grid.inputs).zip(found);
    rows.map(|((&time, &crank), state)| (time, crank, state)).collect()
}

/// Every mechanism with every solver.
fn each(check: impl Fn(&Sample, &dyn Solver)) {
    for sample in sliders::all() {
        for solver in analytic::all() {
            check(&sample, solver);
        }
    }
}

fn joint_of(sample: &Sample) -> JointId {
    sample.case.mechanism.joint_named(sample.joint).unwrap()
}

#[test]
fn motion_matches_the_closed_forms() {
    each(|sample, solver| {
        let joint = &sample.case.mechanism.joints()[joint_of(sample)];
        let link = sample.case.mechanism.link_named(sample.link).unwrap();
        for (_, crank, state) in solved(solver, &sample.case) {
            let exact = (sample.exact)(crank);
            let slide = state.slide(joint).unwrap();
            let angle = [state.angles[link], state.motions[link].omega, state.motions[link].alpha];
            for order in 0..3 {
                // The bound allows for the rounding error of the closed form and of Newton's last step, at a
                // transmission angle of at least 30 degrees.
                let bound = 1e-14 * SPEED.powi(order as i32) * 10.0;
                let errors = [slide[order] - exact.slide[order], angle[order] - exact.angle[order]];
                let what = format!("{} at {crank}: {errors:?}, order {order}", sample.name);
                errors.iter().for_each(|error| assert_within!(error.abs(), bound, "{what}"));
            }
        }
    });
}

/// Fourth-order differences with steps h and 2h.
/// The truncation error of these differences is (h w)^4 / 30 for a motion with harmonics up to a few times w.
/// The rounding error is 1e-16 / h for a length of 1.
#[test]
fn velocities_and_accelerations_are_derivatives() {
    let h = 1e-4;
    each(|sample, solver| {
        let case = &sample.case;
        for &time in case.grid.times.iter().step_by(9) {
            let times: Vec<f64> = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| time + k * h).into();
            let around = states(solver, case, &times).unwrap();
            let slope = |of: &dyn Fn(&State) -> f64| {
                let [a, b, _, d, e] = [0, 1, 2, 3, 4].map(|k| of(&around[k]));
                (8.0 * (d - b) - (e - a)) / (12.0 * h)
            };
            let here = &around[2];
            for link in case.mechanism.links().ids().skip(1) {
                let motion = &here.motions[link];
                let pairs = [
                    (slope(&|s| s.angles[link]), motion.omega),
                    (slope(&|s| s.motions[link].origin.x), motion.velocity.x),
                    (slope(&|s| s.motions[link].origin.y), motion.velocity.y),
                    (slope(&|s| s.motions[link].omega) / SPEED, motion.alpha / SPEED),
                    (slope(&|s| s.motions[link].velocity.x) / SPEED, motion.acceleration.x / SPEED),
                    (slope(&|s| s.motions[link].velocity.y) / SPEED, motion.acceleration.y / SPEED),
                ];
                for (by_differences, value) in pairs {
                    let error = (by_differences - value).abs();
                    assert_within!(error, 1e-9 * SPEED, "{} link {link} at {time}: {error:e}", sample.name);
                }
            }
        }
    });
}

/// Equilibrium of every link.
/// The force of a joint acts at the joint point of the joint's second link; moments are about this point.
#[test]
fn every_link_is_in_equilibrium() {
    each(|sample, solver| {
        let case = &sample.case;
        for (time, _, state) in solved(solver, case) {
            let largest = state.forces.iter().fold(0.0, |max: f64, force| max.larger(force.norm()));
            for (index, link) in case.mechanism.links().entries().skip(1) {
                let middle = centre(case, &state, index);
                let mut force = (case.gravity - centre_acceleration(case, &state, index)) * link.mass;
                let mut moment = -link.inertia * state.motions[index].alpha;
                if index == case.crank().link {
                    moment += state.torques[0];
                }
                for (joint, (reaction, own)) in
                    case.mechanism.joints().iter().zip(state.forces.iter().zip(&state.moments))
                {
                    if joint.on(index).is_none() {
                        continue;
                    }
                    let sign = if joint.second.link == index { 1.0 } else { -1.0 };
                    let place = state.motions[joint.second.link].point(joint.second.local);
                    force += reaction * sign;
                    moment += (cross(place - middle, *reaction) + own) * sign;
                }
                // The bound allows for the rounding error of a linear system of nine equations, relative to the largest
                // force.
                // Lengths are below a metre, so the same bound is valid for moments.
                let bound = 1e-13 * largest;
                assert_within!(force.norm(), bound, "{} {index} {time}: {force} {moment}", sample.name);
                assert_within!(moment.abs(), bound, "{} {index} {time}: {force} {moment}", sample.name);
            }
        }
    });
}

/// The force of a prismatic joint is perpendicular to the joint's axis, up to the rounding of the largest joint force.
#[test]
fn sliders_are_not_pushed_along_their_guides() {
    each(|sample, solver| {
        for (_, _, state) in solved(solver, &sample.case) {
            let largest = state.forces.iter().fold(0.0, |max: f64, force| max.larger(force.norm()));
            for (joint, force) in sample.case.mechanism.joints().iter().zip(&state.forces) {
                let Some(axis) = joint.axis_on(joint.first.link) else { continue };
                let along = state.motions[joint.first.link].arm(axis).dot(force);
                assert_within!(
                    along.abs(),
                    1e-14 * largest,
                    "{} {}: {along:e} of {largest}",
                    solver.name(),
                    sample.name
                );
            }
        }
    });
}

/// The balance of powers gives the driving torque, and the momentum of all links gives the shaking force and moment on
/// the frame.
/// Neither check uses the reaction of a joint.
#[test]
fn drive_and_frame_agree_with_power_and_momentum() {
    each(|sample, solver| {
        let case = &sample.case;
        let states = solved(solver, case);
        let size = states.iter().fold(0.0, |max: f64, (_, _, state)| max.larger(state.torques[0].abs()));
        for (time, _, state) in &states {
            let error = (state.torques[0] - power::balancing_moment(case, state)).abs();
            assert_within!(error, 1e-11 * size, "{} at {time}: {error:e} of {size}", sample.name);
            let (mut force, mut moment, mut weight) = (Vec2::zeros(), 0.0, 0.0);
            for (index, link) in case.mechanism.links().entries().skip(1) {
                let inertial = (case.gravity - centre_acceleration(case, state, index)) * link.mass;
                force += inertial;
                moment += cross(centre(case, state, index), inertial) - link.inertia * state.motions[index].alpha;
                weight += inertial.norm();
            }
            let shaking = state.shaking(case);
            let errors = [(shaking.0 - force).norm(), (shaking.1 - moment).abs()];
            errors
                .iter()
                .for_each(|error| assert_within!(*error, 1e-12 * weight, "{} {time}: {errors:?}", sample.name));
        }
    });
}

/// The order in which a joint names its links does not change the joint.
/// With the reverse order, the force changes its sign.
/// The moment also changes its sign, and is then taken about the joint point on the original first link.
#[test]
fn order_of_a_joints_links_does_not_matter() {
    each(|sample, solver| {
        let other = sliders::swapped(&sample.case);
        for ((time, _, one), (_, _, two)) in solved(solver, &sample.case).into_iter().zip(solved(solver, &other)) {
            let size = one.forces.iter().fold(0.0, |max: f64, force| max.larger(force.norm()));
            for (index, joint) in sample.case.mechanism.joints().entries() {
                let [first, second] = [joint.first, joint.second].map(|side| one.motions[side.link].point(side.local));
                let moment =
                    if joint.slides() { one.moments[index] + cross(second - first, one.forces[index]) } else { 0.0 };
                let errors = [(two.forces[index] + one.forces[index]).norm(), (two.moments[index] + moment).abs()];
                errors
                    .iter()
                    .for_each(|error| assert_within!(*error, 1e-12 * size, "{} {time}: {errors:?}", sample.name));
            }
        }
    });
}
