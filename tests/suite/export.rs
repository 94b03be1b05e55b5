//! Models for other programs, read back: the file contains the mechanism, its start pose and its speeds.

mod forces;
mod formats;
mod model;

use crate::common::assert_within;
use analytic::AssurSolver;
use design::export::mjcf::{MjcfModel, mjcf};
use linkage::ErrorKind;
use linkage::case::Case;
use linkage::drive::Load;
use linkage::math::{KeepNan, Vec2, cross, rotated, unit};
use linkage::mechanism::{GROUND, JointKind, JointSide, LinkId, Mechanism, SpanningTree};
use linkage::solver::State;
use model::{Document, Kind};
use scenario::Scenario;

/// Time step (s) of the exported files.
const STEP: f64 = 1e-3;

fn start(case: &Case) -> State {
    crate::common::states(&AssurSolver, case, &[0.0]).unwrap().remove(0)
}

fn exported(case: &Case, name: &str) -> String {
    mjcf(case, &AssurSolver, name, STEP).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The shipped scenarios at constant speed whose only loads are resistances; all of them can be exported.
fn all() -> Vec<Scenario> {
    let top = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios");
    let files = |directory: &std::path::Path| {
        let paths = std::fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path());
        let mut paths: Vec<_> = paths.filter(|path| path.extension().is_some_and(|end| end == "toml")).collect();
        paths.sort();
        paths
    };
    let paths = [files(&top), files(&top.join("variants60"))].concat();
    let mut scenarios: Vec<Scenario> =
        paths.iter().map(|path| Scenario::load(path).unwrap_or_else(|error| panic!("{error}"))).collect();
    // Only scenarios at constant speed and without loads other than resistances are kept.
    // The tests in tests/suite/loads/engines.rs and tests/suite/laws.rs check that unsupported loads and laws are
    // refused.
    let known = |load: &Load| matches!(load, Load::Resistance { .. });
    scenarios.retain(|scenario| scenario.case.is_steady() && scenario.case.loads.iter().all(known));
    assert!(scenarios.len() >= 72, "{}", scenarios.len());
    scenarios
}

#[test]
fn bodies_are_the_links_on_the_spanning_tree() {
    for scenario in all() {
        let case = &scenario.case;
        let (links, joints) = (case.mechanism.links(), case.mechanism.joints());
        let document = Document::read(&exported(case, &scenario.name));
        let tree = SpanningTree::of(&case.mechanism);
        assert_eq!(document.name, scenario.name);
        assert_eq!(document.bodies.len(), links.len() - 1, "{}", scenario.name);
        for branch in &tree.branches {
            let (link, joint) = (&links[branch.link], &joints[branch.joint]);
            let body = document.body(&link.name);
            let parent = (branch.parent != GROUND).then(|| links[branch.parent].name.clone());
            assert_eq!((body.parent.as_ref(), &body.joint), (parent.as_ref(), &joint.name), "{}", scenario.name);
            assert_eq!(body.kind == Kind::Slide, joint.slides());
            assert_eq!((body.mass, body.centre), (link.mass, link.mass_centre), "{}: {}", scenario.name, link.name);
            // MuJoCo requires that no moment of inertia exceeds the sum of the two others.
            // Only `z` matters in planar motion.
            let [x, y, z] = body.inertia;
            assert!(x + y >= z && y + z >= x && z + x >= y && x > 0.0);
            assert!(z == link.inertia || link.inertia == 0.0 && z > 0.0, "{}: {}", scenario.name, link.name);
            let driven = case.drives.iter().any(|drive| drive.joint == branch.joint);
            assert_eq!(body.armature > 0.0, driven, "{}: {}", scenario.name, joint.name);
        }
        let cut: Vec<&str> = tree.cut.iter().map(|&joint| joints[joint].name.as_str()).collect();
        assert_eq!(document.loops.iter().map(|found| found.0.as_str()).collect::<Vec<_>>(), cut, "{}", scenario.name);
        assert_eq!(document.gravity, case.gravity);
        assert_eq!(document.step, STEP);
        let freedoms = tree.branches.len();
        assert_eq!((document.coordinates.len(), document.rates.len()), (freedoms, freedoms));
        assert_eq!(document.coordinates, document.bodies.iter().map(|body| body.reference).collect::<Vec<_>>());
        document.names_are_unique();
    }
}

/// Computes positions and speeds from the file alone, body by body.
/// All joints must close, including the joints that close loops, and the pose must be the start pose of the case.
#[test]
fn the_file_holds_the_start_pose_and_its_speeds() {
    for scenario in all() {
        let case = &scenario.case;
        let mechanism = &case.mechanism;
        let document = Document::read(&exported(case, &scenario.name));
        let motions = document.motions();
        let size = mechanism.size();
        let speed = case.crank().at(0.0).rate.abs();
        let fastest = motions.iter().map(|motion| motion.omega.abs()).fold(speed, f64::larger);
        for joint in mechanism.joints() {
            let [first, second] = [("first", joint.first), ("second", joint.second)].map(|(word, side)| {
                let (owner, local) = document.site(&format!("{}.{word}", joint.name));
                let motion = document.motion_of(&motions, owner);
                let there = case.start.0[side.link].point(side.local);
                assert_eq!(local, side.local);
                assert_within!(
                    (motion.place(local) - there).norm(),
                    1e-14 * (size + there.norm()),
                    "{}",
                    scenario.name
                );
                (motion, local)
            });
            let gap = second.0.speed(second.1) - first.0.speed(first.1);
            let (off, turning) = match joint.axis_on(joint.first.link) {
                None => (gap.norm(), 0.0),
                // The guide that carries the block rotates; the velocity that the block has from this rotation is no
                // velocity of a gap, and is subtracted.
                Some(axis) => {
                    let axis = rotated(unit(first.0.angle), axis);
                    let way = second.0.place(second.1) - first.0.place(first.1);
                    let carried = first.0.omega * way.dot(&axis);
                    (cross(axis, gap) - carried, second.0.omega - first.0.omega)
                }
            };
            let bound = 1e-12 * fastest * size;
            assert_within!(off.abs(), bound, "{}: {} {off:e}", scenario.name, joint.name);
            assert_within!(turning.abs(), 1e-12 * fastest, "{}: {} {turning:e}", scenario.name, joint.name);
        }
        for drive in &case.drives {
            let link = &mechanism.links()[drive.link].name;
            let omega = document.motion_of(&motions, Some(link)).omega;
            assert_within!((omega - drive.at(0.0).rate).abs(), 1e-14 * speed, "{}: {omega}", scenario.name);
        }
    }
}

#[test]
fn a_slide_has_the_sign_of_its_channel_for_either_parent() {
    let case = crate::common::shipped("compressor.toml").case;
    let slider = case.mechanism.joint_named("cylinder_1").unwrap();
    let piston = case.mechanism.links()[case.mechanism.joints()[slider].second.link].name.clone();
    let forward = Document::read(&exported(&case, "forward"));
    let slide = start(&case).slide(&case.mechanism.joints()[slider]).unwrap();
    let mut joints = case.mechanism.joints().to_vec();
    let joint = &mut joints[slider];
    std::mem::swap(&mut joint.first, &mut joint.second);
    if let JointKind::Prismatic { axes } = &mut joint.kind {
        axes.swap(0, 1);
    }
    let mechanism = Mechanism::new(case.mechanism.links().to_vec(), joints).unwrap();
    let swapped = case.with(|parts| parts.mechanism = mechanism).unwrap();
    let backward = Document::read(&exported(&swapped, "backward"));
    let [a, b] = [&forward, &backward].map(|document| document.body(&piston).reference);
    assert_within!((a - slide[0]).abs(), 1e-15, "{a} {b}");
    assert_within!((a + b).abs(), 1e-15, "{a} {b}");
    let axes = [&forward, &backward].map(|document| document.body(&piston).axis);
    assert_eq!(axes[0], -axes[1]);
    let rates = [&forward, &backward].map(|document| document.rate_of(&piston));
    assert_within!((rates[0] + rates[1]).abs(), 1e-12, "{rates:?}");
}

#[test]
fn resistance_is_dry_friction_on_the_angle_of_the_link() {
    let case = crate::common::shipped("crank_rocker.toml").case;
    let [coupler, rocker] = ["coupler", "rocker"].map(|name| case.mechanism.link_named(name).unwrap());
    // Two loads on one link add up.
    let more = [(rocker, 20.0), (coupler, 7.0)].map(|(link, moment)| Load::Resistance { link, moment });
    let case = case.with(|parts| parts.loads.extend(more)).unwrap();
    let document = Document::read(&exported(&case, "loads"));
    assert_eq!(document.body("rocker").friction, 120.0);
    assert_eq!(document.body("coupler").friction, 0.0);
    // The coupler follows the crank: the coupler's angle is the sum of the angles of the hinges O and A.
    let path = vec![("O".to_string(), 1.0), ("A".to_string(), 1.0)];
    assert_eq!(document.tendons, [("coupler".to_string(), 7.0, path)]);

    let case = crate::common::shipped("compressor.toml").case;
    let piston = case.mechanism.link_named("piston_3").unwrap();
    let case = case.with(|parts| parts.loads = vec![Load::Resistance { link: piston, moment: 5.0 }]).unwrap();
    let document = Document::read(&exported(&case, "piston"));
    assert!(document.tendons.is_empty() && document.bodies.iter().all(|body| body.friction == 0.0));
}

#[test]
fn massless_links_get_a_small_mass() {
    let case = crate::common::shipped("crank_rocker.toml").case;
    let mut links = case.mechanism.links().to_vec();
    (links[2].mass, links[2].inertia) = (0.0, 0.0);
    let of = |links: &[linkage::mechanism::Link]| {
        let mechanism = Mechanism::new(links.to_vec(), case.mechanism.joints().to_vec()).unwrap();
        case.with(|parts| parts.mechanism = mechanism).unwrap()
    };
    let light = of(&links);
    let document = Document::read(&exported(&light, "light"));
    let total: f64 = links.iter().map(|link| link.mass).sum();
    let coupler = document.body("coupler");
    assert!(coupler.mass > 0.0 && coupler.mass <= 1e-5 * total && coupler.inertia[2] > 0.0, "{}", coupler.mass);
    assert_eq!(document.body("rocker").mass, links[3].mass);
    // A mechanism without any mass can still be exported, to show its motion.
    links.iter_mut().for_each(|link| (link.mass, link.inertia) = (0.0, 0.0));
    let none = of(&links);
    assert!(
        Document::read(&exported(&none, "none")).bodies.iter().all(|body| body.mass > 0.0 && body.inertia[2] > 0.0)
    );
}

#[test]
fn the_rotor_inertia_dominates_the_mechanism() {
    for scenario in all() {
        let case = &scenario.case;
        let state = start(case);
        let model = MjcfModel::new(case, &state, &scenario.name, STEP).unwrap();
        // Inertia reduced to the crank: twice the kinetic energy divided by the square of the crank's speed.
        let energy = |link: LinkId| {
            let (body, motion) = (&case.mechanism.links()[link], &state.motions[link]);
            body.mass * motion.point_velocity(body.mass_centre).norm_squared() + body.inertia * motion.omega.powi(2)
        };
        let total: f64 = case.mechanism.links().ids().skip(1).map(energy).sum();
        let reduced = total / case.crank().at(0.0).rate.powi(2);
        let rotor = model.rotor(case.crank().input);
        assert!(rotor >= 1e7 * reduced, "{}: {rotor:e} and {reduced:e}", scenario.name);
    }
}

/// The crank-rocker with other names of its links and of its second joint.
fn renamed(names: [&str; 4], joint: &str) -> Case {
    let case = crate::common::shipped("crank_rocker.toml").case;
    let mut links = case.mechanism.links().to_vec();
    for (link, name) in links.iter_mut().zip(names) {
        link.name = name.into();
    }
    let mut joints = case.mechanism.joints().to_vec();
    joints[1].name = joint.into();
    case.with(|parts| parts.mechanism = Mechanism::new(links, joints).unwrap()).unwrap()
}

#[test]
fn scenario_names_are_kept_with_any_characters() {
    let names = ["ground", "кривошип", "coupler'_2", "rocker's--end"];
    let document = Document::read(&exported(&renamed(names, "'B'"), "a & b"));
    assert_eq!(document.name, "a & b");
    for name in &names[1..] {
        assert_eq!(document.body(name).name, *name);
    }
    assert_eq!(document.body(names[2]).joint, "'B'");
    document.names_are_unique();
}

#[test]
fn names_that_mujoco_does_not_take_are_refused() {
    let refused = |case: &Case, words: &[&str]| {
        let error = mjcf(case, &AssurSolver, "refused", STEP).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Unsupported, "{error}");
        assert!(error.way_out().is_some() && words.iter().all(|word| error.to_string().contains(word)), "{error}");
    };
    refused(&renamed(["ground", "crank", "world", "rocker"], "A"), &["world", "links.world"]);
}

/// A mechanism refuses names with characters that could end an attribute or a file name, so no such name is exported.
#[test]
fn names_with_special_meaning_are_refused() {
    let links = crate::common::shipped("crank_rocker.toml").case.mechanism.links().to_vec();
    let joints = crate::common::shipped("crank_rocker.toml").case.mechanism.joints().to_vec();
    for name in ["", "a\nb", "<a href=\"x\">&amp;", "]]>", "../up", "a b"] {
        let mut links = links.clone();
        links[2].name = name.into();
        let error = Mechanism::new(links, joints.clone()).unwrap_err();
        assert!(error.kind() == ErrorKind::Input && error.way_out().is_some(), "{name}: {error}");
    }
}

#[test]
fn a_step_must_be_positive() {
    let case = crate::common::shipped("crank_rocker.toml").case;
    for step in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        let error = mjcf(&case, &AssurSolver, "step", step).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Input, "{error}");
    }
}

#[test]
fn rods_lie_between_joints_and_nothing_touches() {
    let case = crate::common::shipped("ov7_base.toml").case;
    let document = Document::read(&exported(&case, "shapes"));
    for (link, body) in case.mechanism.links().entries().skip(1) {
        let places: Vec<Vec2> = case.mechanism.joints().iter().filter_map(|joint| joint.on(link)).collect();
        let rods = document.rods(&body.name);
        assert!(!rods.is_empty(), "{} is not drawn", body.name);
        assert!(rods.iter().flatten().all(|end| places.contains(end)), "{}: {rods:?}", body.name);
        assert!(places.iter().all(|place| rods.iter().flatten().any(|end| end == place)), "{}", body.name);
    }
    assert!(document.nothing_touches);
    let sides: Vec<JointSide> = case.mechanism.moving_points().map(|(_, side)| side).collect();
    for ((name, _), side) in case.mechanism.moving_points().zip(sides) {
        let (owner, local) = document.site(name);
        assert_eq!((owner, local), (Some(case.mechanism.links()[side.link].name.as_str()), side.local));
    }
}
