//! SDF, URDF and USD: structure of the files, refusals, and error bounds of the relations between joint coordinates.
//! `tests/viewers/formats_check.py` opens the files with public parsers.

use roxmltree::{Document, Node};

use super::{all, start};
use crate::common::{assert_within, shipped};
use analytic::AssurSolver;
use design::export::{sdf, urdf, usd};
use design::relations::Mimics;
use design::rigid::RigidModel;
use linkage::ErrorKind;
use linkage::case::{Case, Grid};
use linkage::error::Result;
use linkage::math::{KeepNan, angle};
use linkage::mechanism::{GROUND, LinkId, Mechanism, SpanningTree};

/// Scenarios whose only loads act on hinges of the ground.
const HINGED: [&str; 6] = ["crank_rocker", "compressor", "quick_return", "scotch_yoke", "fourth_class", "ov7_new"];

fn sdf(case: &Case) -> Result<String> {
    sdf::sdf(case, &AssurSolver, "own", 1e-3)
}

fn urdf(case: &Case) -> Result<String> {
    urdf::urdf(case, &AssurSolver, "own", None)
}

fn usd(case: &Case) -> Result<String> {
    usd::usd(case, &AssurSolver, "own")
}

fn unloaded(case: &Case) -> Case {
    case.with(|parts| parts.loads.clear()).unwrap()
}

fn text<'a>(node: Node<'a, '_>, path: &str) -> &'a str {
    let found = path.split('/').fold(node, |node, name| {
        node.children().find(|own| own.has_tag_name(name)).unwrap_or_else(|| panic!("no {path}"))
    });
    found.text().unwrap()
}

#[test]
fn sdf_has_all_links_and_all_joints() {
    for scenario in all() {
        let case = unloaded(&scenario.case);
        let Ok(file) = sdf(&case) else { panic!("{}: {}", scenario.name, sdf(&case).unwrap_err()) };
        let document = Document::parse(&file).unwrap();
        let model = document.descendants().filter(|node| node.has_tag_name("model")).nth(1).unwrap();
        let (links, joints) = (case.mechanism.links(), case.mechanism.joints());
        let of = |tag: &'static str| model.children().filter(move |node| node.has_tag_name(tag));
        assert_eq!((of("link").count(), of("joint").count()), (links.len() - 1, joints.len()), "{}", scenario.name);
        for node in of("joint") {
            let joint = &joints[case.mechanism.joint_named(node.attribute("name").unwrap()).unwrap()];
            let name = |link: LinkId| if link == GROUND { "world" } else { links[link].name.as_str() };
            let mut sides = [name(joint.first.link), name(joint.second.link)];
            let mut found = [text(node, "parent"), text(node, "child")];
            assert_ne!(found[1], "world", "SDF permits no child called world");
            sides.sort_unstable();
            found.sort_unstable();
            assert_eq!(found, sides, "{}", scenario.name);
            assert_eq!(node.attribute("type") == Some("prismatic"), joint.slides());
        }
        let driven = case.drives.iter().count();
        assert_eq!(of("plugin").count(), driven, "{}", scenario.name);
    }
}

#[test]
fn usd_excludes_the_joints_that_close_loops() {
    for scenario in all() {
        let case = unloaded(&scenario.case);
        let file = usd(&case).unwrap_or_else(|error| panic!("{}: {error}", scenario.name));
        let (joints, cut) = (case.mechanism.joints(), SpanningTree::of(&case.mechanism).cut);
        let count = |word: &str| file.matches(word).count();
        assert_eq!(count("excludeFromArticulation = 1"), cut.len(), "{}", scenario.name);
        assert_eq!(count("def PhysicsRevoluteJoint"), joints.iter().filter(|joint| !joint.slides()).count());
        assert_eq!(count("def PhysicsPrismaticJoint"), joints.iter().filter(|joint| joint.slides()).count());
        assert_eq!(count("\"PhysicsRigidBodyAPI\""), case.mechanism.links().len());
        assert_eq!(count("physics:targetVelocity"), case.drives.iter().count());
    }
}

#[test]
fn usd_gives_names_that_are_no_identifiers_a_display_name() {
    let file = usd(&shipped("ov7_base.toml").case).unwrap();
    assert!(file.contains("def PhysicsRevoluteJoint \"_5a\"") && file.contains("displayName = \"5a\""), "{file}");
    let speed = shipped("ov7_base.toml").case.crank().at(0.0).rate.to_degrees();
    let found: f64 = file.split("targetVelocity = ").nth(1).unwrap().lines().next().unwrap().parse().unwrap();
    assert_within!((found - speed).abs(), 1e-12 * speed.abs());
}

#[test]
fn urdf_has_the_tree_and_the_loops_as_an_extension() {
    for name in HINGED {
        let case = shipped(&format!("{name}.toml")).case;
        let file = urdf(&case).unwrap();
        let document = Document::parse(&file).unwrap();
        let tree = SpanningTree::of(&case.mechanism);
        let robot = document.root_element();
        let of = |tag: &'static str| robot.children().filter(move |node| node.has_tag_name(tag));
        assert_eq!((of("link").count(), of("joint").count()), (tree.branches.len() + 1, tree.branches.len()), "{name}");
        let loops = of("gazebo").flat_map(|node| node.children()).filter(|node| node.has_tag_name("joint"));
        assert_eq!(loops.count(), tree.cut.len(), "{name}");
    }
}

#[test]
fn a_resistance_is_the_friction_of_a_hinge_on_the_ground() {
    let case = shipped("crank_rocker.toml").case;
    let (_, moment) = case.loads[0].resistance().unwrap();
    let joint = |file: &str, tag: &str| {
        let document = Document::parse(file).unwrap();
        let found = document.descendants().filter(|node| node.has_tag_name(tag)).count();
        assert_eq!(found, 1, "{file}");
    };
    joint(&sdf(&case).unwrap(), "friction");
    assert!(sdf(&case).unwrap().contains(&format!("<friction>{moment}</friction>")));
    assert!(urdf(&case).unwrap().contains(&format!("friction=\"{moment}\"")));
}

/// Asserts that a format refuses a case, and that the error contains `words` and a remedy.
fn refused(found: Result<String>, words: &[&str]) {
    let error = found.unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported, "{error}");
    assert!(error.way_out().is_some() && words.iter().all(|word| error.to_string().contains(word)), "{error}");
}

#[test]
fn what_a_format_cannot_hold_is_refused_by_name() {
    let case = |name: &str| shipped(&format!("{name}.toml")).case;
    refused(usd(&case("crank_rocker")), &["\"resistance\"", "USD"]);
    for write in [sdf, urdf] {
        refused(write(&case("four_bar_relative")), &["\"moment\""]);
        refused(write(&unloaded(&case("cam_follower"))), &["cam \"cam\""]);
        refused(write(&unloaded(&case("planetary_train"))), &["the coupling of joints by \"inner\""]);
    }
    refused(usd(&unloaded(&case("geared_five_bar"))), &["the coupling of joints by \"pair\"", "USD"]);
    for write in [sdf, usd] {
        refused(write(&case("belt_arm")), &["law \"cycloidal\""]);
        refused(write(&unloaded(&case("crank_rocker_runup"))), &["motor"]);
    }
}

#[test]
fn names_that_a_format_does_not_take_are_refused() {
    let case = shipped("quick_return.toml").case;
    let renamed = |link: &str| {
        let mut links = case.mechanism.links().to_vec();
        links[1].name = link.into();
        let mechanism = Mechanism::new(links, case.mechanism.joints().to_vec()).unwrap();
        case.with(|parts| parts.mechanism = mechanism).unwrap()
    };
    let joint = case.mechanism.joints().iter().next().unwrap().name.clone();
    for name in [joint.as_str(), "world", "__own__"] {
        refused(sdf(&renamed(name)), &["SDF", name]);
        assert!(usd(&renamed(name)).is_ok());
    }
    refused(urdf(&renamed("world")), &["world"]);
}

#[test]
fn a_gear_pair_is_a_mimic() {
    let case = unloaded(&shipped("geared_five_bar.toml").case);
    for file in [sdf(&case).unwrap(), urdf(&case).unwrap()] {
        assert_eq!(file.matches("<mimic ").count(), 1, "{file}");
    }
}

/// The coordinates of ten thousand poses lie within the proven bounds, and the largest error is near each bound.
#[test]
fn errors_of_relations_are_within_their_proven_bounds() {
    for (name, degree) in [("crank_rocker", 1), ("crank_rocker", 6), ("quick_return", 5), ("scotch_yoke", 3)] {
        let case = shipped(&format!("{name}.toml")).case;
        let model = RigidModel::new(&case, &start(&case), name);
        let mimics = Mimics::new(&model, degree).unwrap();
        let crank = case.crank();
        let [low, high] = mimics.domain;
        let sense = if crank.at(0.0).rate > 0.0 { 1.0 } else { -1.0 };
        // The driven joint's coordinate is zero at the start.
        assert!(if sense > 0.0 { low.abs() } else { high.abs() } < 1e-12, "{:?}", mimics.domain);
        let inputs: Vec<f64> =
            (0..10_000).map(|k| crank.start + sense * (high - low) * f64::from(k) / 9_999.0).collect();
        let at: Vec<f64> = inputs.iter().map(|input| crank.time_of(*input)).collect();
        let case = case.on(Grid::of_times(crank, at.clone())).unwrap();
        let states = crate::common::states(&AssurSolver, &case, &at).unwrap();
        for relation in &mimics.relations {
            let joint = &case.mechanism.joints()[relation.joint];
            let branch = SpanningTree::of(&case.mechanism);
            let branch = *branch.branches.iter().find(|branch| branch.joint == relation.joint).unwrap();
            let sign = if branch.link == joint.second.link { 1.0 } else { -1.0 };
            let of = |k: usize| match states[k].slide(joint) {
                Some(slide) => slide[0],
                None => sign * (states[k].angles[joint.second.link] - states[k].angles[joint.first.link]),
            };
            let error = |k: usize| {
                let off = relation.at(inputs[k] - crank.start) - (of(k) - of(0));
                if joint.slides() { off.abs() } else { angle::wrapped(off).abs() }
            };
            let most = (0..states.len()).map(error).fold(0.0, f64::larger);
            assert_within!(most, relation.error.bound + 1e-14, "{name}: {}", joint.name);
            let scale = if joint.slides() { case.mechanism.size() } else { 1.0 };
            assert!(relation.error.bound <= (1.5 * most).larger(1e-9 * scale), "{name}: {} {most}", joint.name);
        }
        assert!(!mimics.pins.is_empty() && mimics.pins.iter().all(|pin| pin.error.sampled <= pin.error.bound));
    }
}
