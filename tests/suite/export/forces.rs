//! Motors and loads in the exported file: at the start, each exerts the same force as in the case.

use std::path::Path;

use roxmltree::{Document, Node};

use super::{exported, start};
use crate::common::{assert_within, shipped};
use analytic::AssurSolver;
use design::export::mjcf::mjcf;
use linkage::ErrorKind;
use linkage::case::Case;
use linkage::drive::{Acts, Course, Load, MotorLaw};
use linkage::mechanism::{JointSide, LinkId};
use scenario::Scenario;

fn all_loads() -> Case {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/viewers/scenarios/all_loads.toml");
    Scenario::load(&path).unwrap().case
}

fn find<'a>(document: &'a Document, tag: &str, name: &str) -> Node<'a, 'a> {
    let is_it = |node: &Node| node.has_tag_name(tag) && node.attribute("name") == Some(name);
    document.descendants().find(is_it).unwrap_or_else(|| panic!("no {tag} {name}"))
}

fn numbers(node: Node, attribute: &str) -> Vec<f64> {
    node.attribute(attribute).unwrap().split(' ').map(|word| word.parse().unwrap()).collect()
}

/// Force of an actuator at a given length and rate of change of length.
fn force(node: Node, length: f64, rate: f64) -> f64 {
    let bias = numbers(node, "biasprm");
    bias[0] + bias[1] * length + bias[2] * rate
}

/// Angles and angular speeds of all links at the start.
fn turning(case: &Case) -> (Vec<f64>, Vec<f64>) {
    let state = start(case);
    (state.angles.to_vec(), state.motions.iter().map(|motion| motion.omega).collect())
}

#[test]
fn a_motor_with_losses_is_two_actuators() {
    let case = all_loads();
    let text = exported(&case, "all_loads");
    let document = Document::parse(&text).unwrap();
    let motor = case.crank().moving_motor().unwrap();
    let [drives, brakes] = ["drives", "brakes"].map(|end| find(&document, "general", &format!("O.motor.{end}")));
    assert_eq!([drives.attribute("joint"), brakes.attribute("joint")], [Some("O"); 2]);
    for omega in [0.0, 3.0, 12.0, 12.5, 13.0, 20.0] {
        let of = |node: Node| {
            let range = numbers(node, "forcerange");
            force(node, 0.0, omega).clamp(range[0], range[1])
        };
        let expected = motor.moment_on_crank(omega);
        // The bound is relative to the motor's torque at rest, 40 N m.
        assert_within!((of(drives) + of(brakes) - expected).abs(), 40.0 * 1e-12, "{omega}");
    }
    let armature: f64 = find(&document, "joint", "O").attribute("armature").unwrap().parse().unwrap();
    assert_within!((armature / motor.inertia_on_crank() - 1.0).abs(), 1e-14);
}

#[test]
fn torsional_springs_and_dampers_have_their_moments() {
    let case = all_loads();
    let (angles, speeds) = turning(&case);
    let state = start(&case);
    let text = exported(&case, "all_loads");
    let document = Document::parse(&text).unwrap();
    let mut seen = 0;
    for (index, load) in case.loads.iter().enumerate() {
        let (Load::TorsionSpring { links, .. } | Load::TorsionDamper { links, .. }) = load else { continue };
        let mut moment = 0.0;
        let setting = linkage::drive::LoadState {
            motions: &state.motions,
            angles: &angles,
            joints: case.mechanism.joints(),
            start: &case.start.0,
            crank: 0.0,
        };
        load.act(&setting, &mut |action| moment = if action.link == links[1] { action.moment } else { moment });
        let name = format!("load.{}", index + 1);
        // A load on one hinge acts on the joint; a load on several hinges needs a tendon.
        let actuator = find(&document, "general", &name);
        let [length, rate] = match actuator.attribute("joint") {
            Some(joint) => {
                let (joint, on) = (case.mechanism.joint_named(joint).unwrap(), &case.mechanism.joints());
                let [first, second] = [on[joint].first.link, on[joint].second.link];
                // The joint coordinate is the child's angle minus its parent's angle.
                let sign = if links[1] == second || links[0] == first { 1.0 } else { -1.0 };
                [sign * (angles[second] - angles[first]), sign * (speeds[second] - speeds[first])]
            }
            None => {
                assert!(!find(&document, "fixed", &name).children().any(|node| node.attribute("coef") == Some("0")));
                [angles[links[1]] - angles[links[0]], speeds[links[1]] - speeds[links[0]]]
            }
        };
        assert_within!((force(actuator, length, rate) - moment).abs(), 1e-12 * moment.abs(), "{name}");
        seen += 1;
    }
    assert_eq!(seen, 2);
}

#[test]
fn springs_and_dampers_lie_between_their_points() {
    let case = all_loads();
    let text = exported(&case, "all_loads");
    let document = Document::parse(&text).unwrap();
    let at = |name: &str, end: &str| numbers(find(&document, "site", &format!("{name}.{end}")), "pos");
    let check = |name: &str, ends: &[JointSide; 2], expected: [f64; 3]| {
        let tendon = find(&document, "spatial", name);
        let found = ["stiffness", "springlength", "damping"].map(|key| numbers(tendon, key)[0]);
        assert_eq!(found, expected, "{name}");
        for (side, end) in ends.iter().zip(["first", "second"]) {
            assert_eq!(at(name, end), [side.local.x, side.local.y, 0.0], "{name}");
            let site = find(&document, "site", &format!("{name}.{end}"));
            let link = &case.mechanism.links()[side.link].name;
            let body = site.ancestors().find_map(|node| node.attribute("name").filter(|_| node.has_tag_name("body")));
            assert_eq!(body.unwrap_or("ground"), link);
        }
    };
    let mut seen = 0;
    for (index, load) in case.loads.iter().enumerate() {
        let name = format!("load.{}", index + 1);
        if let Load::Spring { ends, stiffness, free_length } = load {
            check(&name, ends, [*stiffness, *free_length, 0.0]);
            seen += 1;
        } else if let Load::Damper { ends, damping } = load {
            check(&name, ends, [0.0, 0.0, *damping]);
            seen += 1;
        }
    }
    assert_eq!(seen, 2);
}

#[test]
fn forces_rotate_with_their_link_or_stay_fixed_in_the_world() {
    let text = exported(&all_loads(), "all_loads");
    let document = Document::parse(&text).unwrap();
    let [world, link] = ["load.2", "load.3"].map(|name| find(&document, "general", name));
    assert_eq!([world.attribute("refsite"), link.attribute("refsite")], [Some("world.axes"), None]);
    assert_eq!(numbers(world, "gear")[..2], [8.0, -5.0]);
    assert_eq!(numbers(link, "gear")[..2], [-3.0, 6.0]);
}

#[test]
fn features_unsupported_by_mjcf_are_refused_by_name() {
    let refused = |case: &Case, words: &[&str]| {
        let error = mjcf(case, &AssurSolver, "refused", 1e-3).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Unsupported);
        assert!(words.iter().all(|word| error.message().contains(word)) && error.way_out().is_some(), "{error}");
    };
    refused(&shipped("compressor_runup.toml").case, &["law \"kloss\""]);
    refused(&shipped("loaded_slider.toml").case, &["\"force\"", "table"]);
    let case = all_loads();
    let with = |load: Load| case.with(|parts| parts.loads = vec![load]).unwrap();
    let at = JointSide { link: LinkId(2), local: linkage::math::Vec2::new(0.1, 0.0) };
    refused(&with(Load::ResistingForce { at, force: 3.0 }), &["resisting_force"]);
    let moment = Course::Constant(2.0);
    refused(&with(Load::Moment { link: LinkId(2), moment, acts: Acts::Clockwise }), &["\"moment\"", "one sense"]);
    let table = MotorLaw::Table { speeds: vec![0.0, 10.0], torques: vec![2.0, 1.0] };
    let mut motor = case.crank().motor().unwrap().clone();
    motor.law = table;
    refused(&case.with_motor(Some(motor)).unwrap(), &["law \"table\""]);
}
