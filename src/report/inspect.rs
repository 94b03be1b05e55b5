//! The structure of a mechanism: links, joints, mobility, driving link and Assur groups.

use crate::sentences;
use serde_json::{Value, json};

use super::drivers::Drivers;
use super::pretty::{list, pretty};
use super::{modes, range};
use crate::plain::reasons::{cam_figures, undercut_remedy};
use analytic::modes::Modes;
use analytic::range::Range;
use linkage::case::CaseParts;
use linkage::mechanism::assembly::{ConfigurationChoice, transmission_sine};
use linkage::mechanism::{GROUND, Joint, JointId, LinkId, Mechanism, Transmission};
use prover::numbers::{fixed_in, input_in, significant};
use scenario::{Scenario, Undecided};

/// Number of digits shown for the figures of a cam. These figures are extremes over 720 angles.
const SAMPLED: usize = 5;
/// Number of digits shown for a mass or a moment of inertia.
/// This number of digits shows every digit of a scenario, but hides the rounding error of a unit conversion.
const SHOWN: usize = 12;

/// The structure as text.
pub(crate) fn text(scenario: &Scenario) -> String {
    let case = &scenario.case;
    let (mechanism, structure) = (&case.mechanism, &case.structure);
    let (links, joints) = (mechanism.links().len() - 1, mechanism.joints().len());
    let mut text = format!("{}: {}\n", scenario.name, scenario.title);
    if let Some(source) = &scenario.source {
        say!(text, "source     {source}");
    }
    let coupled = match mechanism.transmissions().len() {
        0 => String::new(),
        count => format!(" - {count}"),
    };
    say!(text, sentences::mobility_and_given(&links, &joints, &coupled, &structure.mobility, &case.drives.len()));
    say!(text, sentences::structure_links(&structure.formula(mechanism)));
    for ((id, link), pose) in mechanism.links().entries().zip(&case.start.0) {
        let points: Vec<&str> = link.points.iter().map(|point| point.name.as_str()).collect();
        let at = format!("at {}", fixed_in(pose.angle.to_degrees(), 3, "deg"));
        let [mass, inertia] = [link.mass, link.inertia].map(|value| significant(value, SHOWN));
        let body = match link.mass {
            _ if id == GROUND => "fixed".to_string(),
            0.0 => format!("massless, {at}"),
            _ => sentences::kg_kg(&mass, &inertia, &at),
        };
        say!(text, "  {:14} points {:14} {body}", link.name, points.join(" "));
    }
    say!(text, "\njoints");
    for joint in mechanism.joints() {
        let [first, second] = ends(mechanism, joint);
        let driven = case.drives.iter().any(|drive| mechanism.joints()[drive.joint].name == joint.name);
        let driven = if driven { ", driven" } else { "" };
        say!(text, "  {:14} {}, {first} - {second}{driven}", joint.name, joint.kind.name());
    }
    if !mechanism.transmissions().is_empty() {
        say!(text, "\ntransmissions");
    }
    for own in mechanism.transmissions() {
        say!(text, "{}", transmission(case, own));
    }
    let (input, start) = (case.crank().input, case.crank().start);
    if !structure.groups.is_empty() {
        say!(text, sentences::groups_at_the_start(&input.word(), &input_in(input.at(start), 3)));
    }
    for ((index, group), &mode) in structure.groups.entries().zip(&case.modes) {
        let transmission = transmission_sine(mechanism, group, &case.start)
            .map_or_else(String::new, |sine| sentences::transmission_angle_deg(&sine.abs().asin().to_degrees()));
        let from = scenario.choice(index).map_or_else(String::new, from_rough_place);
        let names = group.names(mechanism);
        let (class, order, pairs, mode) = (group.class, group.order(), group.pairs(), mode.name());
        say!(text, sentences::class_order_mode_2(&names, &class, &order, &pairs, &mode, &transmission, &from));
    }
    text
}

/// A transmission in one line: its kind, links, ratio and pitch radii, or the figures of a cam.
fn transmission(case: &CaseParts, own: &Transmission) -> String {
    let [first, second, carrier] = own.links().map(|link| case.mechanism.links()[link].name.as_str());
    let (name, kind) = (own.name(), own.design.kind.name());
    let slides = own.slide().is_some();
    let Some(ratio) = own.ratio() else {
        let Some(found) = cam_figures(case, own) else { return String::new() };
        let mm = |length: f64| format!("{} mm", significant(length * 1e3, SAMPLED));
        let in_deg = |angle: f64| significant(angle.to_degrees(), SAMPLED);
        let lift = if slides { mm(found.lift) } else { format!("{} deg", in_deg(found.lift)) };
        let curvature = match found.curvature {
            ..0.0 => sentences::the_profile_is_undercut(&mm(-found.curvature), &undercut_remedy(own)),
            radius => sentences::least_radius_of_curvature(&mm(radius)),
        };
        let angle = in_deg(found.pressure_angle);
        return sentences::a_cam(&name, &kind, &first, &second, &carrier, &lift, &mm(found.base), &angle, &curvature);
    };
    let [pitch, other] = own.members.map(|member| format!("{} mm", significant(member.radius * 1e3, SHOWN)));
    let (ratio, radii) = match slides {
        true => (format!("{} mm/rad", significant(ratio * 1e3, SHOWN)), sentences::pitch_radius(&pitch)),
        false => (significant(ratio, SHOWN), sentences::pitch_radii(&pitch, &other)),
    };
    sentences::a_transmission(&name, &kind, &first, &second, &carrier, &ratio, &radii)
}

/// Distance of the configuration from the approximate positions in the file, and the distance of the next-nearest
/// configuration from these positions.
fn from_rough_place(choice: &ConfigurationChoice) -> String {
    let mm = |distance: f64| format!("{:.*} mm", if distance < 0.01 { 1 } else { 0 }, distance * 1e3);
    match (choice.nearest_m, choice.next_m) {
        (None, _) => String::new(),
        (Some(nearest), None) => sentences::from_the_rough_place(&mm(nearest)),
        (Some(nearest), Some(next)) => sentences::from_the_rough_place_the_next(&mm(nearest), &mm(next)),
    }
}

/// The structure as JSON, schema 1.
/// `modes`: a value of the input (SI), and the configurations at this value.
/// `range`: the range of motion. `drivers`: structures for other driven joints.
/// Each of these three parts is written only if it is given.
/// A group in `undecided` has no mode.
pub(crate) fn json(
    scenario: &Scenario,
    modes: Option<(f64, &[Modes])>,
    undecided: &[Undecided],
    range: Option<&Range>,
    drivers: Option<&Drivers>,
) -> String {
    let mut value = structure(scenario);
    for open in undecided {
        value["groups"][open.group.index()]["mode"] = Value::Null;
        value["groups"][open.group.index()]["undecided"] = open.why.message().into();
    }
    if let Some((crank, all)) = modes {
        value["modes"] = modes::json(scenario, crank, all, undecided);
    }
    if let Some(range) = range {
        value["range"] = range::json(scenario, range);
    }
    if let Some(drivers) = drivers {
        value["driven_at"] = drivers.json(&scenario.case);
    }
    pretty(&value)
}

/// The structure alone.
fn structure(scenario: &Scenario) -> Value {
    let case = &scenario.case;
    let (mechanism, structure) = (&case.mechanism, &case.structure);
    let link = |index: LinkId| Value::from(mechanism.links()[index].name.as_str());
    let joint = |index: JointId| Value::from(mechanism.joints()[index].name.as_str());
    let links = list(mechanism.links().iter().zip(&case.start.0), |(link, pose)| {
        let points = list(&link.points, |own| json!({"name": own.name, "x_m": own.local.x, "y_m": own.local.y}));
        json!({
            "name": link.name, "points": points, "mass_kg": link.mass, "inertia_kg_m2": link.inertia,
            "mass_centre": {"x_m": link.mass_centre.x, "y_m": link.mass_centre.y}, "start_angle_rad": pose.angle,
        })
    });
    let joints = list(
        mechanism.joints(),
        |joint| json!({"name": joint.name, "type": joint.kind.name(), "links": ends(mechanism, joint)}),
    );
    let groups = list(structure.groups.entries().zip(&case.modes), |((index, group), mode)| {
        let choice = scenario.choice(index);
        json!({
            "links": list(&group.links, |&own| link(own)), "inner_joints": list(&group.inner, |&own| joint(own)),
            "outer_joints": list(&group.outer, |&own| joint(own)),
            "given_joints": list(&group.given, |&own| joint(own)), "class": group.class, "order": group.order(),
            "kind": group.pairs(), "mode": mode.name(),
            "transmission_angle_rad": transmission_sine(mechanism, group, &case.start).map(|sine| sine.abs().asin()),
            "from_rough_place_m": choice.and_then(|choice| choice.nearest_m),
            "next_from_rough_place_m": choice.and_then(|choice| choice.next_m),
        })
    });
    let transmissions = list(mechanism.transmissions(), |own| {
        let [first, second, carrier] = own.links().map(link);
        let mut told = json!({
            "name": own.name(), "type": own.design.kind.name(), "links": [first, second], "carrier": carrier,
            "start_joint": joint(own.design.joint),
        });
        let slides = own.slide().is_some();
        if let Some(found) = cam_figures(case, own) {
            told[if slides { "lift_m" } else { "lift_rad" }] = found.lift.into();
            told["base_radius_m"] = found.base.into();
            told["pressure_angle_rad"] = found.pressure_angle.into();
            told["least_convex_radius_m"] = found.curvature.into();
        } else {
            told[if slides { "ratio_m_per_rad" } else { "ratio" }] = own.ratio().into();
            told["pitch_radii_m"] = own.members.map(|member| member.radius).to_vec().into();
        }
        told
    });
    json!({
        "schema": 1, "scenario": scenario.name, "title": scenario.title, "mobility": structure.mobility,
        "formula": structure.formula(mechanism), "groups": groups, "links": links, "joints": joints,
        "transmissions": transmissions,
        "drivers": list(
            &structure.drivers,
            |own| json!({"link": link(own.link), "joint": joint(own.joint), "input": own.input.noun()}),
        ),
        format!("start_{}", case.crank().input.key()): case.crank().start,
    })
}

fn ends<'a>(mechanism: &'a Mechanism, joint: &Joint) -> [&'a str; 2] {
    [joint.first, joint.second].map(|side| mechanism.links()[side.link].name.as_str())
}
