//! What happens to a solution when the whole problem is moved, turned, mirrored, reversed or made heavier.

use linkproof::case::Case;
use linkproof::math::{Vec2, rotated, unit};
use linkproof::reference;
use linkproof::solver::{Solver, State};
use proptest::test_runner::TestCaseError;

use crate::COUNT;
use crate::common::random::{Sample, for_each, within};
use crate::common::spec::Spec;
use crate::common::states;

/// Rounding of two solutions of one problem in different clothes, relative to the size of what is compared, times the
/// square of the condition: measured, the largest uses a tenth of it.
const ROUNDING: f64 = 1e-12;

/// States of both problems over the grid of the first at equal crank angles times `sense`.
fn pairs(solver: &dyn Solver, sample: &Sample, two: &Case, sense: f64) -> Vec<(State, State)> {
    let one = &sample.scenario.case;
    let times = one.grid.cranks.iter().map(|crank| two.drive.time_of(crank * sense));
    let ours = states(solver, one, &one.grid.times).expect("solvable");
    let theirs = states(solver, two, &times.collect::<Vec<_>>()).expect("solvable");
    ours.into_iter().zip(theirs).collect()
}

/// What is expected of the second problem's state, given the first's.
struct Expected {
    place: Box<dyn Fn(Vec2) -> Vec2>,
    angle: Box<dyn Fn(f64) -> f64>,
    /// Factors of angular velocity, acceleration and drive torque.
    omega: f64,
    alpha: f64,
    torque: f64,
    velocity: Box<dyn Fn(Vec2) -> Vec2>,
    /// Accelerations and forces turn alike.
    vector: Box<dyn Fn(Vec2) -> Vec2>,
}

fn case_of(spec: &Spec) -> Case {
    spec.scenario().unwrap_or_else(|error| panic!("{error}")).case
}

fn check(sample: &Sample, other: &Spec, sense: f64, expected: &Expected) -> Result<(), TestCaseError> {
    let other = case_of(other);
    for solver in reference::all() {
        for (ours, theirs) in pairs(solver, sample, &other, sense) {
            compare(sample, &other, [&ours, &theirs], expected)?;
        }
    }
    Ok(())
}

fn compare(
    sample: &Sample,
    other: &Case,
    [ours, theirs]: [&State; 2],
    expected: &Expected,
) -> Result<(), TestCaseError> {
    let case = &sample.scenario.case;
    let bound = ROUNDING * sample.condition.powi(2);
    let spin = ours.motions.iter().map(|m| m.omega.abs()).fold(0.0, f64::max);
    let force = ours.forces.iter().map(|f| f.norm()).fold(0.0, f64::max);
    for (link, body) in case.mechanism.links().iter().enumerate().skip(1) {
        let (a, b, c) = (&ours.motions[link], &theirs.motions[link], body.points[0].local);
        let d = other.mechanism.links()[link].points[0].local;
        let turn = theirs.angles[link] - (expected.angle)(ours.angles[link]);
        within("angle", linkproof::math::angle::wrapped(turn).abs(), bound)?;
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
    within(
        "torque",
        (theirs.torques[0] - expected.torque * ours.torques[0]).abs(),
        bound * force.max(ours.torques[0].abs()),
    )
}

#[test]
fn a_mechanism_moved_and_turned_as_a_whole_works_alike() {
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

#[test]
fn joints_read_the_other_way_round_flip_their_own_force_only() {
    for_each(COUNT, |sample| {
        for index in 0..sample.spec.pins.len() {
            let mut other = sample.spec.clone();
            other.pins[index].links.reverse();
            let other = case_of(&other);
            for solver in reference::all() {
                for (ours, mut theirs) in pairs(solver, sample, &other, 1.0) {
                    theirs.forces[index] = -theirs.forces[index];
                    let same = |v: Vec2| v;
                    let expected = Expected {
                        place: Box::new(same),
                        angle: Box::new(|a| a),
                        omega: 1.0,
                        alpha: 1.0,
                        torque: 1.0,
                        velocity: Box::new(same),
                        vector: Box::new(same),
                    };
                    compare(sample, &other, [&ours, &theirs], &expected)?;
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
        for solver in reference::all() {
            for (ours, theirs) in pairs(solver, &sample, &heavier, 1.0) {
                // A factor of two changes no rounding, so that the equality is exact.
                let doubled: Vec<Vec2> = ours.forces.iter().map(|force| force * 2.0).collect();
                proptest::prop_assert_eq!(&theirs.forces, &doubled);
                proptest::prop_assert_eq!(theirs.torques[0], 2.0 * ours.torques[0]);
                proptest::prop_assert_eq!(&theirs.motions, &ours.motions);
            }
        }
        Ok(())
    });
}
