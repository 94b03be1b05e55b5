use std::f64::consts::PI;

use super::*;
use crate::mechanism::{LinkId, LinkPose, PerJoint};

/// Motions of the ground and of one link.
/// The link's origin is at (3, 0) m and moves with (0, 2) m/s.
/// The link is turned by 90 degrees, and its angular velocity is `omega`.
fn motions(omega: f64) -> [Motion; 2] {
    let moving = Motion {
        origin: Vec2::new(3.0, 0.0),
        direction: Vec2::new(0.0, 1.0),
        velocity: Vec2::new(0.0, 2.0),
        omega,
        ..Motion::REST
    };
    [Motion::REST, moving]
}

fn act(load: &Load, motions: &[Motion], angles: &[f64], crank: f64) -> Vec<Action> {
    let start: Vec<LinkPose> = motions.iter().map(LinkPose::of).collect();
    let mut found = Vec::new();
    load.act(&LoadState { motions, angles, joints: &PerJoint::default(), start: &start, crank }, &mut |action| {
        found.push(action)
    });
    found
}

fn side(link: LinkId, x: f64, y: f64) -> JointSide {
    JointSide { link, local: Vec2::new(x, y) }
}

#[test]
fn resistance_opposes_the_rotation() {
    let load = Load::Resistance { link: LinkId(1), moment: 100.0 };
    let moment = |omega| act(&load, &motions(omega), &[], 0.0)[0].moment;
    assert_eq!([moment(2.0), moment(-0.1), moment(0.0)], [-100.0, 100.0, 0.0]);
}

#[test]
fn a_moment_may_act_in_one_sense_of_rotation_only() {
    for (acts, expected) in
        [(Acts::Always, [7.0, 7.0, 7.0]), (Acts::CounterClockwise, [7.0, 0.0, 0.0]), (Acts::Clockwise, [0.0, 7.0, 0.0])]
    {
        let load = Load::Moment { link: LinkId(1), moment: Course::Constant(7.0), acts };
        assert_eq!([2.0, -2.0, 0.0].map(|omega| act(&load, &motions(omega), &[], 0.0)[0].moment), expected);
        assert_eq!(load.sensed_link(), (acts != Acts::Always).then_some(LinkId(1)));
    }
}

#[test]
fn a_force_keeps_its_direction_or_follows_its_link() {
    let [x, y] = [Course::Constant(5.0), Course::table(&[(0.0, 1.0), (1.0, 3.0)], 1, false)];
    for (follows, expected) in [(false, Vec2::new(5.0, 2.0)), (true, Vec2::new(-2.0, 5.0))] {
        let load = Load::Force { at: side(LinkId(1), 1.0, 0.0), force: [x.clone(), y.clone()], follows };
        let found = act(&load, &motions(0.0), &[], 0.5);
        assert_eq!((found[0].force, found[0].place, found[0].moment), (expected, Vec2::new(3.0, 1.0), 0.0));
        // The moment of the force about the origin is 3 F_y - 1 F_x.
        assert!((found[0].about(Vec2::zeros()) - (3.0 * expected.y - expected.x)).abs() < 1e-15);
        assert!(load.needs_angles());
    }
}

#[test]
fn a_resisting_force_opposes_the_velocity_of_its_point() {
    // The loaded point lies on the link's x axis, 1 m from the link's origin.
    // The link's x axis points along world +y.
    // The point moves with (-1, 2) m/s when the link turns with 1 rad/s.
    let load = Load::ResistingForce { at: side(LinkId(1), 1.0, 0.0), force: 10.0 };
    let found = act(&load, &motions(1.0), &[], 0.0)[0];
    assert!((found.force - Vec2::new(1.0, -2.0) * (10.0 / 5f64.sqrt())).norm() < 1e-14);
    assert!((found.power(&motions(1.0)[1]) + 10.0 * 5f64.sqrt()).abs() < 1e-13);
    let still = [Motion::REST; 2];
    assert_eq!(act(&load, &still, &[], 0.0)[0].force, Vec2::zeros());
}

#[test]
fn a_spring_pulls_when_it_is_long_and_pushes_when_it_is_short() {
    // The spring connects (0, 1) on the ground with (3, 5), so the spring's length is 5 m.
    for (free_length, pull) in [(3.0, 200.0), (6.0, -100.0), (5.0, 0.0)] {
        let load = Load::Spring {
            ends: [side(LinkId(0), 0.0, 1.0), side(LinkId(1), 5.0, 0.0)],
            stiffness: 100.0,
            free_length,
        };
        let [ground, link] = act(&load, &motions(0.0), &[], 0.0)[..] else { panic!("two ends") };
        assert_eq!((ground.link, link.link), (LinkId(0), LinkId(1)));
        assert!((ground.force - Vec2::new(0.6, 0.8) * pull).norm() < 1e-13, "{ground:?}");
        assert_eq!((link.force, link.place), (-ground.force, Vec2::new(3.0, 5.0)));
    }
    let shut = Load::Spring {
        ends: [side(LinkId(0), 3.0, 0.0), side(LinkId(1), 0.0, 0.0)],
        stiffness: 100.0,
        free_length: 1.0,
    };
    assert_eq!(act(&shut, &motions(0.0), &[], 0.0)[1].force, Vec2::zeros());
}

#[test]
fn a_damper_resists_the_rate_of_its_length() {
    // The point at (3, 5) moves with (0, 2) - 5 (1, 0) = (-5, 2) m/s when the link turns with 1 rad/s.
    // The distance of this point from (0, 1) changes with (-5 * 0.6 + 2 * 0.8) = -1.4 m/s.
    let load = Load::Damper { ends: [side(LinkId(0), 0.0, 1.0), side(LinkId(1), 5.0, 0.0)], damping: 10.0 };
    let [ground, link] = act(&load, &motions(1.0), &[], 0.0)[..] else { panic!("two ends") };
    assert!((ground.force - Vec2::new(0.6, 0.8) * -14.0).norm() < 1e-13, "{ground:?}");
    assert!((link.power(&motions(1.0)[1]) + 10.0 * 1.4 * 1.4).abs() < 1e-12);
    assert!(load.is_viscous());
}

#[test]
fn a_torsion_spring_counts_turns_from_the_start() {
    // At the start the link's angle is 90 degrees.
    // Two revolutions later the twist is larger by two revolutions.
    // The pose has the start angle again, but the twist must keep the two revolutions.
    let load =
        Load::TorsionSpring { links: [LinkId(0), LinkId(1)], stiffness: 2.0, free_angle: 0.5, acts: Acts::Always };
    let still = motions(0.0);
    for turns in [0.0, 2.0, -1.0] {
        let angle = PI / 2.0 + 2.0 * PI * turns;
        let [ground, link] = act(&load, &still, &[0.0, angle], 0.0)[..] else { panic!("two links") };
        assert!((ground.moment - 2.0 * (angle - 0.5)).abs() < 1e-13 && link.moment == -ground.moment, "{turns}");
    }
    let start = [LinkPose::GROUND, LinkPose { origin: Vec2::zeros(), angle: 2.0 + 2.0 * PI }];
    let setting = LoadState {
        motions: &still,
        angles: &[0.0, 2.5 + 2.0 * PI],
        joints: &PerJoint::default(),
        start: &start,
        crank: 0.0,
    };
    assert!(
        (setting.twist([LinkId(0), LinkId(1)]) - 2.5).abs() < 1e-15 * 8.0
            && (setting.twist([LinkId(1), LinkId(0)]) + 2.5).abs() < 1e-15 * 8.0
    );
}

#[test]
fn a_torsion_damper_resists_the_relative_rotation() {
    let load = Load::TorsionDamper { links: [LinkId(1), LinkId(0)], damping: 3.0 };
    let [link, ground] = act(&load, &motions(2.0), &[], 0.0)[..] else { panic!("two links") };
    assert_eq!((link.link, link.moment, ground.moment), (LinkId(1), -6.0, 6.0));
}

#[test]
fn moment_in_equals_the_moment_of_the_action() {
    let table = Course::table(&[(0.0, 1.0), (2.0, 3.0)], 2, true);
    for acts in [Acts::CounterClockwise, Acts::Clockwise] {
        let load = Load::Moment { link: LinkId(1), moment: table.clone(), acts };
        for omega in [-1.5, 0.0, 0.1] {
            assert_eq!(act(&load, &motions(omega), &[], 7.0)[0].moment, load.moment_in(omega, 7.0));
        }
    }
}

#[test]
fn scaled_loads_act_in_proportion() {
    let moments = |loads: &[Load], omega: f64| -> f64 {
        loads
            .iter()
            .flat_map(|load| act(load, &motions(omega), &[0.0, 0.4], 0.7))
            .map(|action| action.about(Vec2::zeros()))
            .sum()
    };
    let table = Course::table(&[(0.0, 1.0), (2.0, 5.0)], 1, false);
    let ends = [side(LinkId(0), 1.0, 2.0), side(LinkId(1), 0.5, 0.1)];
    let loads = [
        Load::Resistance { link: LinkId(1), moment: 100.0 },
        Load::Moment { link: LinkId(1), moment: table.clone(), acts: Acts::Clockwise },
        Load::Force { at: side(LinkId(1), 0.2, 0.3), force: [table, Course::Constant(3.0)], follows: true },
        Load::ResistingForce { at: side(LinkId(1), 0.2, 0.3), force: 7.0 },
        Load::Spring { ends, stiffness: 20.0, free_length: 0.3 },
        Load::Damper { ends, damping: 4.0 },
    ];
    for load in &loads {
        for omega in [2.0, -1.5] {
            // Only the moment on the link is compared, because the moments on link and ground cancel in a sum.
            let one = moments(std::slice::from_ref(load), omega);
            for factor in [0.0, 0.5, 3.0, -2.0] {
                match load.times(factor) {
                    Some(scaled) => approx::assert_relative_eq!(moments(&scaled, omega), factor * one, epsilon = 1e-12),
                    None => assert!(factor < 0.0 && matches!(load, Load::ResistingForce { .. })),
                }
            }
        }
    }
    let twist = [
        Load::TorsionSpring { links: [LinkId(0), LinkId(1)], stiffness: 2.0, free_angle: 0.1, acts: Acts::Always },
        Load::TorsionDamper { links: [LinkId(0), LinkId(1)], damping: 2.0 },
    ];
    for load in twist {
        let on_second = |load: &Load| act(load, &motions(2.0), &[0.0, 0.4], 0.7)[1].moment;
        let doubled = load.times(2.0).unwrap();
        approx::assert_relative_eq!(on_second(&doubled[0]), 2.0 * on_second(&load), epsilon = 1e-12);
    }
}

/// A load that is zero where its link reverses has at most a kink, and no jump. A load of magnitude zero has no jump.
#[test]
fn the_jump_of_a_load_is_its_difference_between_both_senses() {
    let one_way = |moment, acts| Load::Moment { link: LinkId(1), moment, acts };
    let table = || Course::table(&[(0.0, 0.0), (1.0, 4.0)], 1, false);
    let loads = [
        (Load::Resistance { link: LinkId(1), moment: 100.0 }, 200.0),
        (Load::Resistance { link: LinkId(1), moment: 0.0 }, 0.0),
        (Load::ResistingForce { at: side(LinkId(1), 0.2, 0.0), force: 3.0 }, 6.0),
        (one_way(Course::Constant(-7.0), Acts::CounterClockwise), 7.0),
        (one_way(table(), Acts::Clockwise), 2.0),
        (one_way(table(), Acts::Always), 0.0),
        (Load::TorsionDamper { links: [LinkId(0), LinkId(1)], damping: 2.0 }, 0.0),
    ];
    for (load, jump) in loads {
        assert_eq!(load.jump(0.5), jump, "{load:?}");
    }
    assert_eq!(one_way(table(), Acts::Clockwise).jump(0.0), 0.0);
}
