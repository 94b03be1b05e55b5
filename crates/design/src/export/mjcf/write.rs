//! The XML document.

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};

use super::bodies::Freedom;
use super::effects;
use super::forces::Forces;
use super::model::Model;
use super::names::Names;
use super::shapes::{self, Shape};
use super::xml::{Xml, about_z, flat, number, numbers};
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::{GROUND, LinkId};

/// Stiffness of every constraint: see the module documentation.
const STIFF: &str = "1e-9 0.5";
/// Impedance of every constraint: the largest that MuJoCo accepts, at any gap.
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
pub(super) fn document(model: &Model, forces: &Forces) -> String {
    let mut xml = Xml(Writer::new_with_indent(Vec::new(), b' ', 2));
    xml.put(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)));
    xml.nest("mujoco", &[("model", model.name)], |xml| {
        xml.comment(concat!(
            "Written by linkproof ",
            env!("CARGO_PKG_VERSION"),
            "; SI units, plane XOY. Load the keyframe \"start\": without it nothing moves."
        ));
        options(xml, model);
        xml.nest("worldbody", &[], |xml| world(xml, model, forces));
        loops(xml, model);
        effects::tendons(xml, model, forces);
        effects::actuators(xml, model, forces);
        sensors(xml, model);
        keyframe(xml, model);
    });
    let mut text = String::from_utf8(xml.0.into_inner()).expect("what was written is text");
    text.push('\n');
    text
}

fn options(xml: &mut Xml, model: &Model) {
    xml.leaf("compiler", &[("angle", "radian"), ("autolimits", "false"), ("inertiafromgeom", "false")]);
    let gravity = flat(model.case.gravity);
    let step = number(model.step);
    let settings =
        [("timestep", step.as_str()), ("gravity", &gravity), ("integrator", "implicitfast"), ("solver", "Newton")];
    // MuJoCo scales its tolerance with the trace of the inertia matrix, which contains the rotor: only zero is small enough.
    // Newton's method needs two iterations; 20 are a limit in case rounding keeps it going.
    let solver = [("iterations", "20"), ("tolerance", "0"), ("ls_tolerance", "1e-6")];
    xml.nest("option", &[&settings[..], &solver].concat(), |xml| {
        xml.leaf("flag", &[("contact", "disable"), ("refsafe", "enable")]);
    });
    let (centre, extent) = view(model);
    xml.leaf("statistic", &[("center", &flat(centre)), ("extent", &number(extent))]);
    xml.nest("visual", &[], |xml| {
        // View from above: x right, y up.
        xml.leaf("global", &[("azimuth", "90"), ("elevation", "-90")]);
    });
    xml.comment("As stiff as a step allows: the time constant is raised to twice the time step, whatever that is.");
    xml.nest("default", &[], |xml| {
        xml.leaf("equality", &[("solref", STIFF), ("solimp", HARD)]);
        let friction = [("solreffriction", STIFF), ("solimpfriction", HARD)];
        xml.leaf("joint", &[&friction[..], &[("damping", "0")]].concat());
        xml.leaf("tendon", &friction);
        xml.leaf("geom", &[("contype", "0"), ("conaffinity", "0")]);
        xml.leaf("site", &[("size", &number(0.005 * model.size())), ("rgba", "0.1 0.1 0.1 1")]);
    });
}

/// Middle and extent of the start pose (m).
fn view(model: &Model) -> (Vec2, f64) {
    let poses = &model.case.start.0;
    let places = model.case.mechanism.joints().iter().map(|joint| poses[joint.second.link].point(joint.second.local));
    let places: Vec<Vec2> = places.collect();
    let low = places.iter().fold(Vec2::repeat(f64::INFINITY), |low, place| low.inf(place));
    let high = places.iter().fold(Vec2::repeat(f64::NEG_INFINITY), |high, place| high.sup(place));
    ((low + high) / 2.0, (high - low).norm().larger(model.size()))
}

fn world(xml: &mut Xml, model: &Model, forces: &Forces) {
    xml.leaf(
        "light",
        &[("pos", &numbers([0.0, 0.0, 10.0 * model.size()])), ("dir", "0 0 -1"), ("type", "directional")],
    );
    on_link(xml, (model, forces), GROUND, "0.45 0.45 0.45 1");
    for link in model.children(GROUND) {
        body(xml, model, forces, link);
    }
}

fn body(xml: &mut Xml, model: &Model, forces: &Forces, link: LinkId) {
    let index = model.branch_of(link).expect("every moving link is in the tree");
    let own = &model.bodies[index];
    let data = &model.case.mechanism.links()[link];
    let place = [("pos", flat(own.offset)), ("axisangle", about_z(own.turn))];
    xml.nest("body", &[("name", &data.name), (place[0].0, &place[0].1), (place[1].0, &place[1].1)], |xml| {
        let (mass, inertia) = model.inertial(link);
        if model.is_lent(link) {
            xml.comment("It has no mass or no inertia: MuJoCo gets a small one.");
        }
        // Three equal moments satisfy the triangle inequality; those about x and y have no effect in planar motion.
        let inertial = [flat(data.mass_centre), number(mass), numbers([inertia; 3])];
        xml.leaf("inertial", &[("pos", &inertial[0]), ("mass", &inertial[1]), ("diaginertia", &inertial[2])]);
        joint(xml, model, index);
        on_link(xml, (model, forces), link, COLOURS[(link.index() - 1) % COLOURS.len()]);
        for child in model.children(link) {
            body(xml, model, forces, child);
        }
    });
}

fn joint(xml: &mut Xml, model: &Model, index: usize) {
    let (own, branch) = (&model.bodies[index], &model.tree.branches[index]);
    let name = &model.case.mechanism.joints()[branch.joint].name;
    let reference = number(own.coordinate);
    let (place, rotor, friction);
    let mut attributes: Vec<(&str, &str)> = vec![("name", name)];
    match own.freedom {
        Freedom::Hinge(at) => {
            place = flat(at);
            attributes.extend([("type", "hinge"), ("axis", "0 0 1"), ("pos", &place)]);
        }
        Freedom::Slide(axis) => {
            place = flat(axis);
            attributes.extend([("type", "slide"), ("axis", place.as_str())]);
        }
    }
    attributes.push(("ref", &reference));
    if let Some(inertia) = model.armature(branch.joint) {
        rotor = number(inertia);
        attributes.push(("armature", &rotor));
        xml.comment(match model.case.drives.iter().any(|drive| drive.joint == branch.joint && drive.is_free()) {
            true => "Rotor and reducer of the motor.",
            false => "Drive: a rotor so heavy that its speed stays what it is at the start.",
        });
    }
    if let Some(found) = model.frictions.iter().find(|friction| friction.link == branch.link && friction.own_hinge) {
        friction = number(found.moment);
        attributes.push(("frictionloss", &friction));
    }
    xml.leaf("joint", &attributes);
}

/// Shapes and sites of a link.
fn on_link(xml: &mut Xml, (model, forces): (&Model, &Forces), link: LinkId, colour: &str) {
    for shape in shapes::of_link(model, link) {
        match shape {
            Shape::Ball(at, radius) => {
                xml.leaf(
                    "geom",
                    &[("type", "sphere"), ("pos", &flat(at)), ("size", &number(radius)), ("rgba", colour)],
                );
            }
            Shape::Rod([from, to], radius) => {
                let ends = numbers([from.x, from.y, 0.0, to.x, to.y, 0.0]);
                xml.leaf(
                    "geom",
                    &[("type", "capsule"), ("fromto", &ends), ("size", &number(radius)), ("rgba", colour)],
                );
            }
            Shape::Block(at, angle, [length, width]) => {
                let (place, turn, half) = (flat(at), about_z(angle), numbers([length, width, width]));
                let block =
                    [("type", "box"), ("pos", place.as_str()), ("axisangle", &turn), ("size", &half), ("rgba", colour)];
                xml.leaf("geom", &block);
            }
        }
    }
    for (index, joint) in model.case.mechanism.joints().entries().filter(|(_, joint)| joint.on(link).is_some()) {
        xml.leaf("site", &[("name", &Names::side(joint, link)), ("pos", &flat(model.place(index, link)))]);
    }
    for (name, side) in model.case.mechanism.moving_points().filter(|(_, side)| side.link == link) {
        xml.leaf("site", &[("name", name), ("pos", &flat(side.local))]);
    }
    effects::sites(xml, forces, link);
}

fn loops(xml: &mut Xml, model: &Model) {
    if model.tree.cut.is_empty() {
        return;
    }
    xml.nest("equality", &[], |xml| {
        for &joint in &model.tree.cut {
            let joint = &model.case.mechanism.joints()[joint];
            let [first, second] = [joint.first.link, joint.second.link].map(|link| Names::side(joint, link));
            xml.leaf("connect", &[("name", &joint.name), ("site1", &first), ("site2", &second)]);
        }
    });
}

/// Reactions in the joints of the tree, and moments where there are any.
fn sensors(xml: &mut Xml, model: &Model) {
    xml.comment(
        "What acts on the body in the joint that carries it, in the body's frame; moments about the joint's place, without frictionloss.",
    );
    xml.nest("sensor", &[], |xml| {
        for branch in &model.tree.branches {
            let joint = &model.case.mechanism.joints()[branch.joint];
            let site = Names::side(joint, branch.link);
            xml.leaf("force", &[("name", &format!("{}.force", joint.name)), ("site", &site)]);
            if joint.keeps_angle() || model.is_driven(branch.joint) {
                xml.leaf("torque", &[("name", &format!("{}.moment", joint.name)), ("site", &site)]);
            }
        }
    });
}

fn keyframe(xml: &mut Xml, model: &Model) {
    let coordinates = numbers(model.in_order().iter().map(|body| body.coordinate));
    let rates = numbers(model.in_order().iter().map(|body| body.rate));
    xml.nest("keyframe", &[], |xml| {
        xml.leaf("key", &[("name", "start"), ("time", "0"), ("qpos", &coordinates), ("qvel", &rates)]);
    });
}
