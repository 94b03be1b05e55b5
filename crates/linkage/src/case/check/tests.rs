//! Each test makes the smallest fault in one part of a case and checks the resulting error.

use crate::case::{Case, CaseParts, Grid};
use crate::drive::{Acts, Course, Drive, DriveMotion, Drives, Load, MotionLaw, Motor, MotorLaw};
use crate::fixtures::{class_four, four_bar, turning};
use crate::math::Vec2;
use crate::mechanism::{AssemblyMode, JointId, JointSide, LinkId, LinkPose, Structure};
use crate::{Error, ErrorKind};

/// The error that the four-bar's case returns after `change`.
fn refused(change: impl FnOnce(&mut CaseParts)) -> Error {
    turning(four_bar()).with(change).unwrap_err()
}

/// Asserts the kind, key and words of the error that `change` causes.
fn says(kind: ErrorKind, key: &str, words: &[&str], change: impl FnOnce(&mut CaseParts)) {
    let error = refused(change);
    assert_eq!((error.kind(), error.scenario_key()), (kind, Some(key)), "{error}");
    for word in words {
        assert!(error.message().contains(word), "{error} does not say {word}");
    }
}

use ErrorKind::{Geometry, Input, Unsupported};

#[test]
fn valid_parts_form_a_case_and_are_returned_unchanged() {
    let case = turning(four_bar());
    assert_eq!(Case::new(case.clone().into_parts()).unwrap(), case);
    assert_eq!(case.with(|_| {}).unwrap(), case);
}

#[test]
fn a_drive_belongs_to_a_moving_link_and_its_joint() {
    says(Input, "drive", &["joint 9", "4 joints"], |parts| parts.drives.crank_mut().joint = JointId(9));
    says(Input, "drive", &["link 4", "4 links"], |parts| parts.drives.crank_mut().link = LinkId(4));
    says(Input, "drive", &["\"ground\"", "\"O\""], |parts| parts.drives.crank_mut().link = LinkId(0));
    says(Input, "drive", &["\"rocker\"", "\"O\""], |parts| parts.drives.crank_mut().link = LinkId(3));
    says(Input, "drive", &["driven already"], |parts| {
        let crank = parts.drives.crank().clone();
        parts.drives = Drives::new(crank.clone(), vec![crank]);
    });
}

#[test]
fn invalid_numbers_of_a_drive_are_refused() {
    for value in [f64::NAN, f64::INFINITY] {
        says(Input, "drive", &["\"crank\"", "not finite"], |parts| parts.drives.crank_mut().zero = value);
        says(Input, "drive", &["\"crank\"", "not finite"], |parts| parts.drives.crank_mut().start = value);
    }
    let moved = |motion: DriveMotion| {
        says(Input, "drive", &["\"crank\"", "not finite"], |parts| parts.drives.crank_mut().motion = motion);
    };
    for speed in [0.0, f64::NAN, f64::NEG_INFINITY] {
        moved(DriveMotion::Prescribed { law: MotionLaw::ConstantSpeed(speed), motor: None });
        moved(DriveMotion::Prescribed { law: MotionLaw::Ramp { speed, time: 1.0 }, motor: None });
        moved(DriveMotion::Prescribed { law: MotionLaw::Cycloidal { rise: speed, time: 1.0 }, motor: None });
        moved(DriveMotion::Free { initial_speed: 0.0, nominal_speed: speed, motor: None });
    }
    for time in [0.0, -1.0, f64::NAN] {
        moved(DriveMotion::Prescribed { law: MotionLaw::Ramp { speed: 1.0, time }, motor: None });
        moved(DriveMotion::Prescribed { law: MotionLaw::Cycloidal { rise: 1.0, time }, motor: None });
    }
    moved(DriveMotion::Free { initial_speed: f64::NAN, nominal_speed: 1.0, motor: None });
}

#[test]
fn a_start_beyond_the_allowed_turns_is_refused() {
    for start in [-7e5, 7e5, 1e18] {
        says(Input, "start.crank", &["turns from zero", "1e5"], |parts| parts.drives.crank_mut().start = start);
    }
}

#[test]
fn invalid_numbers_of_a_motor_are_refused() {
    let good = || Motor::ideal(MotorLaw::Linear { at_rest: 2.0, slope: -0.1 }, 10.0);
    let case = turning(four_bar());
    assert!(case.with_motor(Some(good())).is_ok());
    let table = |speeds: &[f64]| MotorLaw::Table { speeds: speeds.into(), torques: vec![1.0; 2] };
    let laws = [
        MotorLaw::Constant { torque: f64::NAN },
        MotorLaw::Linear { at_rest: 1.0, slope: f64::INFINITY },
        MotorLaw::Kloss { breakdown_torque: 1.0, breakdown_slip: 0.0, synchronous_speed: 1.0 },
        MotorLaw::Kloss { breakdown_torque: 1.0, breakdown_slip: 0.1, synchronous_speed: f64::NAN },
        table(&[1.0, 1.0]),
        table(&[1.0, 2.0, 3.0]),
        table(&[1.0]),
    ];
    let mut wrong: Vec<Motor> = laws.map(|law| Motor { law, ..good() }).into();
    wrong.extend([0.0, -1.0, f64::NAN].map(|ratio| Motor { ratio, ..good() }));
    wrong.extend([0.0, 1.1, f64::NAN].map(|efficiency| Motor { efficiency, ..good() }));
    let mut heavy = good();
    heavy.inertia.rotor = -1e-3;
    wrong.push(heavy);
    for motor in wrong {
        let error = case.with_motor(Some(motor.clone())).unwrap_err();
        assert_eq!((error.kind(), error.scenario_key()), (Input, Some("drive")), "{motor:?}");
    }
}

/// Regression test with a double pendulum.
/// The double pendulum has two driving links and two degrees of freedom.
#[test]
fn unsupported_combinations_of_drives_are_refused() {
    let links = vec![
        crate::fixtures::link("ground", &[("O", 0.0, 0.0)]),
        crate::fixtures::link("upper", &[("O", 0.0, 0.0), ("A", 1.0, 0.0)]),
        crate::fixtures::link("lower", &[("A", 0.0, 0.0), ("B", 1.0, 0.0)]),
    ];
    let pins = [("O", "O", "ground", "upper"), ("A", "A", "upper", "lower")];
    let mechanism = crate::fixtures::mechanism(links, &pins).unwrap();
    let structure = Structure::of(&mechanism, &[JointId(0), JointId(1)]).unwrap();
    let free = |joint: JointId, motor: Option<Motor>| {
        let motion = DriveMotion::Free { initial_speed: 0.0, nominal_speed: 1.0, motor };
        Drive {
            input: crate::input::Input::Angle,
            joint,
            link: LinkId(joint.index() + 1),
            zero: 0.0,
            start: 0.0,
            motion,
            through: false,
        }
    };
    let of = |crank: Drive, second: Drive| {
        let mut pose = vec![LinkPose::GROUND; 3];
        pose[2].origin.x = 1.0;
        Case::new(CaseParts {
            mechanism: mechanism.clone(),
            structure: structure.clone(),
            drives: Drives::new(crank, vec![second]),
            start: crate::mechanism::Pose(pose.into()),
            modes: Vec::new(),
            ..turning(four_bar()).into_parts()
        })
    };
    let motor = || Some(Motor::ideal(MotorLaw::Constant { torque: 1.0 }, 1.0));
    let pair = of(free(JointId(0), motor()), free(JointId(1), None)).unwrap();
    assert_eq!(pair.drives.free().count(), 2);
    // Only the crank's motor exerts a moment.
    assert_eq!(pair.drives.with_moment().map(|(index, _)| index).collect::<Vec<_>>(), [0]);
    let nominal = pair.nominal();
    assert!(!nominal.is_free() && nominal.crank().motor().is_some() && nominal.crank().moving_motor().is_none());

    let error = of(free(JointId(0), None), free(JointId(1), motor())).unwrap_err();
    assert!(error.kind() == Unsupported && error.message().contains("\"lower\"") && error.message().contains("motor"));
    let prescribed = Drive::prescribed(JointId(1), LinkId(2), 0.0, 0.0, MotionLaw::ConstantSpeed(1.0));
    let error = of(free(JointId(0), None), prescribed).unwrap_err();
    assert!(error.kind() == Unsupported && error.message().contains("is attached to a moving link"), "{error}");
    let ramp = Drive::prescribed(JointId(0), LinkId(1), 0.0, 0.0, MotionLaw::Ramp { speed: 1.0, time: 1.0 });
    let pair = of(ramp, free(JointId(1), None)).unwrap();
    assert!(pair.is_free() && pair.crank().constant_speed().is_none());
}

#[test]
fn the_structure_of_another_mechanism_is_refused() {
    says(Input, "structure", &["has 1 parts", "structure of 2"], |parts| parts.structure.groups = Vec::new().into());
    says(Input, "structure", &[], |parts| {
        parts.structure = Structure::of(&class_four(1.0, 1.0), &[JointId(0)]).unwrap()
    });
    says(Input, "structure", &[], |parts| parts.structure = Structure::of(&parts.mechanism, &[JointId(3)]).unwrap());
}

#[test]
fn loads_need_existing_links_and_valid_numbers() {
    let at = |link: LinkId| JointSide { link, local: Vec2::zeros() };
    let friction = |joint: usize, links: [usize; 2], length: f64| Load::Friction {
        joint: JointId(joint),
        links: links.map(LinkId),
        coefficient: 0.1,
        length,
    };
    let wrong = [
        (Load::Resistance { link: LinkId(4), moment: 1.0 }, "link 4"),
        (Load::ResistingForce { at: at(LinkId(7)), force: 1.0 }, "link 7"),
        (Load::Spring { ends: [at(LinkId(0)), at(LinkId(5))], stiffness: 1.0, free_length: 0.0 }, "link 5"),
        (Load::TorsionDamper { links: [LinkId(9), LinkId(0)], damping: 1.0 }, "link 9"),
        (Load::Resistance { link: LinkId(1), moment: -1.0 }, "not finite"),
        (
            Load::TorsionSpring {
                links: [LinkId(0), LinkId(1)],
                stiffness: f64::NAN,
                free_angle: 0.0,
                acts: Acts::Always,
            },
            "not finite",
        ),
        (
            Load::Moment {
                link: LinkId(1),
                moment: Course::table(&[(0.0, 1.0), (2.0, f64::NAN)], 1, false),
                acts: Acts::Always,
            },
            "not finite",
        ),
        (friction(7, [0, 1], 0.01), "4 joints"),
        (friction(1, [0, 1], 0.01), "not the links of joint"),
        (friction(0, [0, 1], -0.01), "negative"),
    ];
    for (load, word) in wrong {
        let sort = load.sort();
        says(Input, "loads", &["load 1", sort, word], |parts| {
            parts.loads = vec![Load::Resistance { link: LinkId(1), moment: 0.0 }, load];
        });
    }
    says(Input, "loads", &["load 1", "has friction already"], |parts| {
        parts.loads = vec![friction(0, [0, 1], 0.01), friction(0, [0, 1], 0.02)];
    });
    says(Input, "loads", &["load 0", "leave out `through"], |parts| {
        parts.loads = vec![friction(0, [0, 1], 0.01)];
        parts.drives.crank_mut().through = true;
    });
    says(Input, "gravity", &["NaN"], |parts| parts.gravity.y = f64::NAN);
}

#[test]
fn a_start_pose_must_close_the_joints_at_the_start_angle() {
    says(Input, "start", &["3 link poses", "4 links"], |parts| parts.start.0 = parts.start.0[1..].to_vec().into());
    says(Input, "start", &["ground"], |parts| parts.start.0[LinkId(0)].angle = 1e-15);
    says(Input, "start", &["\"rocker\""], |parts| parts.start.0[LinkId(3)].angle = f64::NAN);
    says(Geometry, "start", &["\"B\"", "e-8 m"], |parts| parts.start.0[LinkId(3)].angle += 1e-8);
    says(Geometry, "start", &["\"crank\"", "1.000e-8 rad"], |parts| parts.drives.crank_mut().start = 1e-8);
    // Angles of the start pose may differ from the required angles by whole turns and by rounding errors.
    let turned = turning(four_bar()).with(|parts| {
        parts.start.0[LinkId(2)].angle += 3.0 * std::f64::consts::TAU;
        parts.start.0[LinkId(3)].angle += 1e-14;
    });
    assert!(turned.is_ok(), "{turned:?}");
}

#[test]
fn every_group_needs_a_mode_of_its_kind() {
    says(Input, "start", &["0 assembly modes", "1 groups"], |parts| parts.modes.clear());
    for mode in [AssemblyMode::Ahead, AssemblyMode::Behind, AssemblyMode::Only, AssemblyMode::Followed] {
        says(Input, "start", &[mode.name(), "coupler, rocker"], |parts| parts.modes[0] = mode);
    }
}

#[test]
fn an_invalid_grid_is_refused() {
    let far = Grid { times: vec![0.0, 1e9], inputs: vec![0.0, 1e9] };
    says(Input, "grid", &["1.6e8 turns"], |parts| parts.grid = far.clone());
    let case = turning(four_bar());
    assert!(case.on(far).is_err() && case.on(Grid::of_times(case.crank(), vec![1.0])).is_ok());
    let uneven = Grid { times: vec![0.0], inputs: Vec::new() };
    assert!(case.on(uneven).unwrap_err().message().contains("1 times, but 0 inputs"));
    assert!(case.on(Grid { times: vec![f64::NAN], inputs: vec![0.0] }).is_err());
}
