//! Effects on the solution when the problem is moved, rotated, mirrored, reversed or made heavier.

use std::f64::consts::PI;

use linkage::case::Case;
use linkage::math::{KeepNan, Vec2, cross, rotated, unit};
use linkage::mechanism::{GroupKind, JointId};
use linkage::solver::{Solver, State};
use proptest::test_runner::TestCaseError;

use super::COUNT;
use crate::common::random::{DyadSpecimen, for_each, within};
use crate::common::spec::{Spec, Start};
use crate::common::states;

/// Bound on the rounding difference between the solutions of one problem in two forms.
/// The bound is this constant times the quantity's magnitude and the square of the condition number.
/// The largest measured difference is a tenth of the bound.
const ROUNDING: f64 = 1e-12;

/// States of both problems over the grid of the first problem.
/// The crank angles of the second problem are the crank angles of the first problem times `sense`.
fn pairs(solver: &dyn Solver, sample: &DyadSpecimen, two: &Case, sense: f64) -> Vec<(State, State)> {
    let one = &sample.scenario.case;
    let times = one.grid.inputs.iter().map(|crank| two.crank().time_of(crank * sense));
    let ours = states(solver, one, &one.grid.times).expect("solvable");
    let theirs = states(solver, two, &times.collect::<Vec<_>>()).expect("solvable");
    ours.into_iter().zip(theirs).collect()
}

/// Expected state of the second problem, computed from the state of the first problem.
struct Expected {
    place: Box<dyn Fn(Vec2) -> Vec2>,
    angle: Box<dyn Fn(f64) -> f64>,
    /// Factors of angular velocity, angular acceleration and drive torque.
    omega: f64,
    alpha: f64,
    torque: f64,
    velocity: Box<dyn Fn(Vec2) -> Vec2>,
    /// Transforms accelerations and forces in the same way.
    vector: Box<dyn Fn(Vec2) -> Vec2>,
}

fn case_of(spec: &Spec) -> Case {
    spec.scenario().unwrap_or_else(|error| panic!("{error}")).case
}

fn check(sample: &DyadSpecimen, other: &Spec, sense: f64, expected: &Expected) -> Result<(), TestCaseError> {
    let other = case_of(other);
    for solver in analytic::all() {
        for (ours, theirs) in pairs(solver, sample, &other, sense) {
            compare(sample, &other, [&ours, &theirs], expected)?;
        }
    }
    Ok(())
}

fn compare(
    sample: &DyadSpecimen,
    other: &Case,
    [ours, theirs]: [&State; 2],
    expected: &Expected,
) -> Result<(), TestCaseError> {
    let case = &sample.scenario.case;
    let bound = ROUNDING * sample.condition.powi(2);
    let spin = ours.motions.iter().map(|m| m.omega.abs()).fold(0.0, f64::larger);
    let force = ours.forces.iter().map(|f| f.norm()).fold(0.0, f64::larger);
    for (link, body) in case.mechanism.links().entries().skip(1) {
        let (a, b, c) = (&ours.motions[link], &theirs.motions[link], body.mass_centre);
        let d = other.mechanism.links()[link].mass_centre;
        let turn = theirs.angles[link] - (expected.angle)(ours.angles[link]);
        within("angle", linkage::math::angle::wrapped(turn).abs(), bound)?;
        within("omega", (b.omega - expected.omega * a.omega).abs(), bound * spin)?;
        within("alpha", (b.alpha - expected.alpha * a.alpha).abs(), bound * spin * spin)?;
        within("place", (b.point(d) - (expected.place)(a.point(c))).norm(), bound * 10.0)?;
        let velocity = b.point_velocity(d) - (expected.velocity)(a.point_velocity(c));
        within("velocity", velocity.norm(), bound * spin)?;
        let acceleration = b.point_acceleration(d) - (expected.vector)(a.point_acceleration(c));
        within("acceleration", acceleration.norm(), bound * spin * spin)?;
    }
    for (a, b) in ours.forces.iter().zip(&theirs.forces) {
        within("force", (b - (expected.vector)(*a)).norm(), bound * force)?;
    }
    // Moments change their sign together with the driving moment.
    for (a, b) in ours.moments.iter().zip(&theirs.moments) {
        within("moment", (b - expected.torque * a).abs(), bound * force.larger(ours.torques[0].abs()))?;
    }
    within(
        "torque",
        (theirs.torques[0] - expected.torque * ours.torques[0]).abs(),
        bound * force.larger(ours.torques[0].abs()),
    )
}

#[test]
fn a_moved_and_rotated_mechanism_behaves_alike() {
    for_each(COUNT, |sample| {
        let (by, turn) = (Vec2::new(3.0, -2.0), 2.2);
        let expected = Expected {
            place: Box::new(move |v| by + rotated(unit(turn), v)),
            angle: Box::new(move |a| a + turn),
            omega: 1.0,
            alpha: 1.0,
            torque: 1.0,
            velocity: Box::new(move |v| rotated(unit(turn), v)),
            vector: Box::new(move |v| rotated(unit(turn), v)),
        };
        check(sample, &sample.spec.moved(by, turn), 1.0, &expected)
    });
}

#[test]
fn a_reversed_drive_flips_the_velocities_and_nothing_else() {
    for_each(COUNT, |sample| {
        let mut free = sample.spec.clone();
        free.loads.clear();
        let sample = crate::common::random::sample(free).expect("loads do not matter to the motion");
        let mut back = sample.spec.clone();
        back.speed = -back.speed;
        let expected = Expected {
            place: Box::new(|v| v),
            angle: Box::new(|a| a),
            omega: -1.0,
            alpha: 1.0,
            torque: 1.0,
            velocity: Box::new(|v| -v),
            vector: Box::new(|v| v),
        };
        check(&sample, &back, 1.0, &expected)
    });
}

#[test]
fn a_mirror_image_has_mirrored_motion_and_forces() {
    for_each(COUNT, |sample| {
        let flip = |v: Vec2| Vec2::new(v.x, -v.y);
        let expected = Expected {
            place: Box::new(flip),
            angle: Box::new(|a| -a),
            omega: -1.0,
            alpha: -1.0,
            torque: -1.0,
            velocity: Box::new(flip),
            vector: Box::new(flip),
        };
        check(sample, &sample.spec.mirrored(), -1.0, &expected)
    });
}

fn same() -> Expected {
    Expected {
        place: Box::new(|v| v),
        angle: Box::new(|a| a),
        omega: 1.0,
        alpha: 1.0,
        torque: 1.0,
        velocity: Box::new(|v| v),
        vector: Box::new(|v| v),
    }
}

#[test]
fn swapping_the_links_of_a_joint_flips_only_its_force() {
    for_each(COUNT, |sample| {
        let case = &sample.scenario.case;
        for (index, joint) in case.mechanism.joints().entries() {
            let mut other = sample.spec.clone();
            other.pins.iter_mut().filter(|pin| pin.name == joint.name).for_each(|pin| pin.links.reverse());
            other.guides.iter_mut().filter(|guide| guide.name == joint.name).for_each(|guide| guide.reverse());
            turn_modes(case, &mut other, index, |kind| kind == GroupKind::Rpr);
            let other = case_of(&other);
            for solver in analytic::all() {
                for (ours, mut theirs) in pairs(solver, sample, &other, 1.0) {
                    theirs.forces[index] = -theirs.forces[index];
                    // In `theirs`, the two links of the joint are exchanged, so the moment is about the joint point on
                    // the original first link.
                    // The test transfers the moment to the joint point on the original second link.
                    let [first, second] =
                        [joint.first, joint.second].map(|side| ours.motions[side.link].point(side.local));
                    if joint.slides() {
                        theirs.moments[index] = cross(first - second, theirs.forces[index]) - theirs.moments[index];
                    }
                    compare(sample, &other, [&ours, &theirs], &same())?;
                }
            }
        }
        Ok(())
    });
}

/// Changes the mode of each group with `joint` as an inner joint.
/// The mode of an RRP dyad also changes if `joint` is an outer joint of the dyad.
/// The mode stays unchanged if `matters` does not accept the kind of the group.
fn turn_modes(case: &Case, spec: &mut Spec, joint: JointId, matters: impl Fn(GroupKind) -> bool) {
    for group in case.structure.groups.iter().filter(|group| matters(group.kind)) {
        let has = |start: &Start| {
            start.links.iter().all(|name| group.links.contains(&case.mechanism.link_named(name).expect("a link")))
        };
        if group.inner.contains(&joint) || group.outer.contains(&joint) && group.kind == GroupKind::Rrp {
            spec.starts.iter_mut().filter(|start| has(start)).for_each(|start| start.ask.reverse());
        }
    }
}

/// A guide is a line.
/// The sense of a guide's axis and the choice of the point on its line do not matter.
#[test]
fn sense_and_reference_point_of_a_guide_do_not_matter() {
    for_each(COUNT, |sample| {
        let case = &sample.scenario.case;
        for (index, joint) in case.mechanism.joints().entries().filter(|(_, joint)| joint.slides()) {
            let mut turned = sample.spec.clone();
            let guide = turned.guides.iter_mut().find(|guide| guide.name == joint.name).expect("a guide");
            guide.axes.iter_mut().for_each(|axis| *axis += PI);
            turn_modes(case, &mut turned, index, |kind| matches!(kind, GroupKind::Rpr | GroupKind::Rrp));
            check(sample, &turned, 1.0, &same())?;
            let mut moved = sample.spec.clone();
            let guide = moved.guides.iter().find(|guide| guide.name == joint.name).expect("a guide").clone();
            for (k, by) in [(0, 0.3), (1, -0.2)] {
                let points = match guide.links[k].as_str() {
                    "ground" => &mut moved.ground,
                    link => &mut moved.links.iter_mut().find(|body| body.name == link).expect("a link").points,
                };
                let (_, at) = points.iter_mut().find(|(name, _)| *name == guide.points[k]).expect("a point");
                *at += unit(guide.axes[k]) * by;
            }
            let moved = case_of(&moved);
            for solver in analytic::all() {
                for (ours, mut theirs) in pairs(solver, sample, &moved, 1.0) {
                    let place = |state: &State| state.motions[joint.second.link].point(joint.second.local);
                    let second = moved.mechanism.joints()[index].second;
                    let shift = place(&ours) - ours.motions[second.link].point(second.local);
                    theirs.moments[index] -= cross(shift, theirs.forces[index]);
                    compare(sample, &moved, [&ours, &theirs], &same())?;
                }
            }
        }
        Ok(())
    });
}

#[test]
fn twice_the_masses_make_exactly_twice_the_forces() {
    for_each(COUNT, |sample| {
        let mut free = sample.spec.clone();
        free.loads.clear();
        let sample = crate::common::random::sample(free).expect("loads do not matter to the motion");
        let heavier = case_of(&sample.spec.heavier(2.0));
        for solver in analytic::all() {
            for (ours, theirs) in pairs(solver, &sample, &heavier, 1.0) {
                // A factor of 2 is exact in floating-point numbers.
                // Twice the masses therefore give exactly twice the forces.
                let doubled: Vec<Vec2> = ours.forces.iter().map(|force| force * 2.0).collect();
                proptest::prop_assert_eq!(&*theirs.forces, &doubled);
                let doubled: Vec<f64> = ours.moments.iter().map(|moment| moment * 2.0).collect();
                proptest::prop_assert_eq!(&*theirs.moments, &doubled);
                proptest::prop_assert_eq!(theirs.torques[0], 2.0 * ours.torques[0]);
                proptest::prop_assert_eq!(&theirs.motions, &ours.motions);
            }
        }
        Ok(())
    });
}
