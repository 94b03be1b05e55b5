//! The XML document.
//! Simple shapes show the links. The shapes have no mass and no contacts.

use crate::sentences;
use std::fmt::Write;

use quick_xml::escape::escape;

use super::effects;
use super::forces::Forces;
use super::model::{Freedom, MjcfModel};
use super::names::{of_transmission, side};
use super::xml::{Xml, about_z, flat, number, numbers};
use linkage::math::{KeepNan, Vec2, corners, rotated, unit};
use linkage::mechanism::{GROUND, JointSide, LinkId};

/// Stiffness of every constraint, as explained in the documentation of the module `mjcf`.
const STIFF: &str = "1e-9 0.5";
/// Impedance of every constraint: the largest impedance that MuJoCo accepts, the same for every gap.
const HARD: &str = "0.9999 0.9999 1";
/// Colours of links, used in turn.
const COLOURS: [&str; 6] = [
    "0.20 0.42 0.70 1",
    "0.85 0.45 0.13 1",
    "0.25 0.60 0.30 1",
    "0.62 0.30 0.62 1",
    "0.75 0.62 0.15 1",
    "0.30 0.62 0.65 1",
];

/// The whole document.
pub(super) fn document(model: &MjcfModel, forces: &Forces) -> String {
    let mut xml = Xml::new();
    xml.nest(format_args!(r#"mujoco model="{}""#, escape(model.name)), |xml| {
        xml.comment(concat!(
            "Written by linkproof ",
            env!("CARGO_PKG_VERSION"),
            "; SI units, plane XOY. Load the keyframe \"start\": without it nothing moves."
        ));
        options(xml, model);
        xml.nest("worldbody", |xml| world(xml, model, forces));
        loops(xml, model);
        effects::tendons(xml, model, forces);
        effects::actuators(xml, model, forces);
        sensors(xml, model);
        keyframe(xml, model);
    });
    xml.text
}

fn options(xml: &mut Xml, model: &MjcfModel) {
    xml.leaf(r#"compiler angle="radian" autolimits="false" inertiafromgeom="false""#);
    // MuJoCo scales its tolerance with the trace of the inertia matrix. The rotor makes this trace so large that only a
    // tolerance of zero is small enough.
    // Newton's method needs two iterations. The limit of 20 ends the iteration if rounding errors would prolong it.
    let solver = r#"integrator="implicitfast" solver="Newton" iterations="20" tolerance="0" ls_tolerance="1e-6""#;
    let (step, gravity) = (number(model.step), flat(model.case.gravity));
    xml.nest(format_args!(r#"option timestep="{step}" gravity="{gravity}" {solver}"#), |xml| {
        xml.leaf(r#"flag contact="disable" refsafe="enable""#);
    });
    let poses = &model.case.start.0;
    let joints = model.case.mechanism.joints().iter();
    let [low, high] = corners(joints.map(|joint| poses[joint.second.link].point(joint.second.local)));
    let (centre, extent) = (flat((low + high) / 2.0), number((high - low).norm().larger(model.size())));
    xml.leaf(format_args!(r#"statistic center="{centre}" extent="{extent}""#));
    xml.nest("visual", |xml| {
        // View from above: x right, y up.
        xml.leaf(r#"global azimuth="90" elevation="-90""#);
    });
    xml.comment(sentences::AS_STIFF_AS_A_STEP_ALLOWS);
    xml.nest("default", |xml| {
        xml.leaf(format_args!(r#"equality solref="{STIFF}" solimp="{HARD}""#));
        let friction = format!(r#"solreffriction="{STIFF}" solimpfriction="{HARD}""#);
        xml.leaf(format_args!(r#"joint {friction} damping="0""#));
        xml.leaf(format_args!("tendon {friction}"));
        xml.leaf(r#"geom contype="0" conaffinity="0""#);
        xml.leaf(format_args!(r#"site size="{}" rgba="0.1 0.1 0.1 1""#, number(0.005 * model.size())));
    });
}

fn world(xml: &mut Xml, model: &MjcfModel, forces: &Forces) {
    let above = numbers([0.0, 0.0, 10.0 * model.size()]);
    xml.leaf(format_args!(r#"light pos="{above}" dir="0 0 -1" type="directional""#));
    draw(xml, model, GROUND, "0.45 0.45 0.45 1");
    sites(xml, model, forces, GROUND);
    for link in model.children(GROUND) {
        body(xml, model, forces, link);
    }
}

fn body(xml: &mut Xml, model: &MjcfModel, forces: &Forces, link: LinkId) {
    let index = model.branch_of(link).expect("every moving link is in the tree");
    let own = &model.bodies[index];
    let data = &model.case.mechanism.links()[link];
    let (name, at, turn) = (escape(data.name.as_str()), flat(own.offset), about_z(own.turn));
    xml.nest(format_args!(r#"body name="{name}" pos="{at}" axisangle="{turn}""#), |xml| {
        let (mass, inertia) = model.inertial(link);
        // The import of models reads these comments.
        if !(data.mass > 0.0) {
            xml.comment(sentences::IT_HAS_NO_MASS);
        } else if !(data.inertia > 0.0) {
            xml.comment(sentences::IT_HAS_NO_INERTIA);
        }
        // Three equal moments of inertia satisfy the triangle inequality. The moments of inertia about x and y have no
        // effect in planar motion.
        let (centre, mass, inertia) = (flat(data.mass_centre), number(mass), numbers([inertia; 3]));
        xml.leaf(format_args!(r#"inertial pos="{centre}" mass="{mass}" diaginertia="{inertia}""#));
        joint(xml, model, index);
        draw(xml, model, link, COLOURS[(link.index() - 1) % COLOURS.len()]);
        sites(xml, model, forces, link);
        for child in model.children(link) {
            body(xml, model, forces, child);
        }
    });
}

fn joint(xml: &mut Xml, model: &MjcfModel, index: usize) {
    let (own, branch) = (&model.bodies[index], &model.tree.branches[index]);
    let name = escape(model.case.mechanism.joints()[branch.joint].name.as_str());
    let freedom = match own.freedom {
        Freedom::Hinge(at) => format!(r#"type="hinge" axis="0 0 1" pos="{}""#, flat(at)),
        Freedom::Slide(axis) => format!(r#"type="slide" axis="{}""#, flat(axis)),
    };
    let mut tag = format!(r#"joint name="{name}" {freedom} ref="{}""#, number(own.coordinate));
    if let Some(inertia) = model.armature(branch.joint) {
        let _ = write!(tag, r#" armature="{}""#, number(inertia));
        xml.comment(match model.case.drives.iter().any(|drive| drive.joint == branch.joint && drive.is_free()) {
            true => sentences::ROTOR_AND_REDUCER_OF_THE_MOTOR,
            false => sentences::DRIVE_A_ROTOR_SO_HEAVY_THAT_ITS_SPEED,
        });
    }
    if let Some(found) = model.frictions.iter().find(|friction| friction.link == branch.link && friction.own_hinge) {
        let _ = write!(tag, r#" frictionloss="{}""#, number(found.moment));
    }
    xml.leaf(tag);
}

/// Sites of a link: at its joints, its points, and where loads act.
fn sites(xml: &mut Xml, model: &MjcfModel, forces: &Forces, link: LinkId) {
    let mechanism = &model.case.mechanism;
    for joint in mechanism.joints() {
        if let Some(place) = joint.on(link) {
            effects::site(xml, &side(joint, link), place);
        }
    }
    for (name, side) in mechanism.moving_points().filter(|(_, side)| side.link == link) {
        effects::site(xml, name, side.local);
    }
    effects::sites(xml, forces, link);
}

fn loops(xml: &mut Xml, model: &MjcfModel) {
    let transmissions = model.case.mechanism.transmissions();
    if model.tree.cut.is_empty() && transmissions.is_empty() {
        return;
    }
    xml.nest("equality", |xml| {
        for transmission in transmissions {
            let name = of_transmission(transmission);
            let name = escape(&name);
            xml.leaf(format_args!(r#"tendon name="{name}" tendon1="{name}""#));
        }
        for &joint in &model.tree.cut {
            let joint = &model.case.mechanism.joints()[joint];
            let [first, second] = [joint.first.link, joint.second.link].map(|link| side(joint, link));
            let [name, first, second] = [&joint.name, &first, &second].map(|name| escape(name.as_str()));
            xml.leaf(format_args!(r#"connect name="{name}" site1="{first}" site2="{second}""#));
        }
    });
}

/// Writes sensors of the reaction in every joint of the tree.
/// Prismatic and driven joints also get a sensor of the moment.
fn sensors(xml: &mut Xml, model: &MjcfModel) {
    xml.comment(sentences::WHAT_ACTS_ON_THE_BODY_IN_THE_JOINT);
    xml.nest("sensor", |xml| {
        for branch in &model.tree.branches {
            let joint = &model.case.mechanism.joints()[branch.joint];
            let (name, site) = (escape(joint.name.as_str()), side(joint, branch.link));
            let site = escape(site.as_str());
            xml.leaf(format_args!(r#"force name="{name}.force" site="{site}""#));
            if joint.keeps_angle() || model.is_driven(branch.joint) {
                xml.leaf(format_args!(r#"torque name="{name}.moment" site="{site}""#));
            }
        }
    });
}

fn keyframe(xml: &mut Xml, model: &MjcfModel) {
    let coordinates = numbers(model.in_order().iter().map(|body| body.coordinate));
    let rates = numbers(model.in_order().iter().map(|body| body.rate));
    xml.nest("keyframe", |xml| {
        xml.leaf(format_args!(r#"key name="start" time="0" qpos="{coordinates}" qvel="{rates}""#));
    });
}

/// Thickness of the shapes, divided by the mechanism's size.
const THICKNESS: f64 = 0.012;

/// Shapes of a link: rods between the link's joints, and a block or a guide at each prismatic joint.
pub(super) fn draw(xml: &mut Xml, model: &MjcfModel, link: LinkId, colour: &str) {
    let mechanism = &model.case.mechanism;
    let thick = THICKNESS * model.size();
    let rod = |xml: &mut Xml, [from, to]: [Vec2; 2], radius: f64| {
        let (ends, size) = (numbers([from.x, from.y, 0.0, to.x, to.y, 0.0]), number(radius));
        xml.leaf(format_args!(r#"geom type="capsule" fromto="{ends}" size="{size}" rgba="{colour}""#));
    };
    let mut places: Vec<Vec2> = Vec::new();
    for joint in mechanism.joints() {
        let Some(place) = joint.on(link) else { continue };
        // MuJoCo refuses rods without length, so joints at the same position are listed once.
        if places.iter().all(|other| (other - place).norm() > 1e-6 * model.size()) {
            places.push(place);
        }
        let Some(axis) = joint.axis_on(link) else { continue };
        let sides = mechanism.guide_and_block(joint).expect("a prismatic joint has a guide");
        if sides[1].link == link {
            let (at, turn, half) = (flat(place), about_z(axis.y.atan2(axis.x)), [3.0, 2.0, 2.0].map(|k| k * thick));
            let size = numbers(half);
            xml.leaf(format_args!(r#"geom type="box" pos="{at}" axisangle="{turn}" size="{size}" rgba="{colour}""#));
        } else {
            let middle = place + axis * along(model, sides, axis);
            let reach = axis * model.size();
            rod(xml, [middle - reach, middle + reach], 0.4 * thick);
        }
    }
    if link == GROUND || places.len() < 2 {
        for place in places {
            let (at, size) = (flat(place), number(1.8 * thick));
            xml.leaf(format_args!(r#"geom type="sphere" pos="{at}" size="{size}" rgba="{colour}""#));
        }
    } else {
        let closing = (places.len() > 2).then_some([places[places.len() - 1], places[0]]);
        let pairs = places.windows(2).map(|pair| [pair[0], pair[1]]).chain(closing);
        pairs.for_each(|pair| rod(xml, pair, thick));
    }
}

/// Start position of a guide's block along the guide's axis (m).
fn along(model: &MjcfModel, sides: [JointSide; 2], axis: Vec2) -> f64 {
    let [guide, block] = sides.map(|side| model.case.start.0[side.link]);
    rotated(unit(guide.angle), axis).dot(&(block.point(sides[1].local) - guide.point(sides[0].local)))
}
