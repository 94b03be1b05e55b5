//! Share links of the older PMKS (`mech=`), with one record for each joint.
//! A record contains the names of the joint's links, its kind, its position, the direction of a slide in degrees, and
//! four flags. The last flag marks the input.

use crate::import::parts::{DrivePart, FRAME, JointPart, LinkPart, PartPair, Parts, SourceUnits};
use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Vec2;

/// Speed of the input if the share link contains no speed (turns per minute).
const USUAL_SPEED: f64 = 10.0;
/// Units that are assumed, because these share links contain no units.
const UNITS: SourceUnits = SourceUnits { length: "mm", metres: 1e-3, mass: "kg", force: "N" };

/// One joint.
struct ClassicJoint<'a> {
    links: Vec<&'a str>,
    is_slide: bool,
    place: Vec2,
    /// Direction of a slide (rad).
    angle: f64,
    is_input: bool,
}

/// Builds the mechanism from a query with the parameter `mech`.
pub(super) fn parts(query: &str) -> Result<Parts> {
    let parameter = |name: &str| query.split('&').find_map(|part| part.strip_prefix(name)?.strip_prefix('='));
    let records = parameter("mech").unwrap_or_default().split('|').filter(|record| !record.trim().is_empty());
    let joints = records.enumerate().map(|(at, text)| joint(at + 1, text)).collect::<Result<Vec<_>>>()?;
    Parts::check_count(joints.len())?;
    let mut parts = Parts::new("a link of PMKS", UNITS);
    parts.told.push(sentences::THE_LINK_HAS_NO_UNIT.into());
    let mut names: Vec<&str> = vec!["ground"];
    for name in joints.iter().flat_map(|joint| &joint.links) {
        if !names.contains(name) {
            names.push(name);
        }
    }
    Parts::check_count(names.len())?;
    let points: Vec<String> = (1..=joints.len()).map(|at| parts.point_names.legal(&format!("P{at}"))).collect();
    let pins = || joints.iter().zip(&points).filter(|(joint, _)| !joint.is_slide);
    for name in &names[1..] {
        let own = pins().filter(|(joint, _)| joint.links.contains(name));
        let places = own.map(|(joint, point)| (point.clone(), joint.place)).collect();
        let angle =
            joints.iter().find(|joint| joint.is_slide && joint.links.contains(name)).map_or(0.0, |own| own.angle);
        let legal = parts.link_names.legal(name);
        if legal != *name {
            parts.told.push(sentences::the_link_is_called(name, &legal));
        }
        parts.links.push(LinkPart::through(legal, places, angle));
    }
    let speed = parameter("set").and_then(|set| set.split('|').find_map(|own| own.strip_prefix('s')?.parse().ok()));
    let speed = speed.filter(|speed: &f64| *speed != 0.0 && speed.abs() < 1e9).unwrap_or(USUAL_SPEED);
    let input = joints.iter().position(|joint| joint.is_input);
    let input =
        input.or_else(|| joints.iter().position(|joint| joint.links.len() > 1 && joint.links.contains(&"ground")));
    for (at, (joint, point)) in joints.iter().zip(&points).enumerate() {
        let mut links: Vec<usize> =
            joint.links.iter().filter_map(|own| names.iter().position(|name| name == own)).collect();
        // The ground comes first.
        links.sort_by_key(|link| *link != FRAME);
        let first = parts.joints.len();
        if !joint.is_slide {
            if links.len() > 1 && links[0] == FRAME {
                parts.links[FRAME].put(point, joint.place);
            }
            parts.pin(point, &links);
        } else if let [guide, block] = links[..] {
            let other = parts.point_names.legal(&format!("{point}_block"));
            let names = [point.clone(), other];
            let axes = [guide, block].map(|link| joint.angle - parts.links[link].pose.angle);
            for (link, name) in [guide, block].into_iter().zip(&names) {
                let place = parts.links[link].local(joint.place);
                parts.links[link].put(name, place);
            }
            let name = parts.joint_names.legal(point);
            parts.joints.push(JointPart { name, links: [guide, block], pair: PartPair::Slide { points: names, axes } });
        } else {
            return Err(broken(at + 1, sentences::the_slide_needs_one_block(&links.len())));
        }
        if input == Some(at) && parts.joints.len() > first {
            parts.drives.push(DrivePart { joint: first, speed, turning: "rpm", travel: None, free: None });
        }
    }
    Ok(parts)
}

fn joint(number: usize, text: &str) -> Result<ClassicJoint<'_>> {
    let words: Vec<&str> = text.split([',', ' ']).filter(|word| !word.is_empty()).collect();
    let kind = words.iter().rposition(|word| ["R", "P", "RP", "G"].contains(&word.to_uppercase().as_str()));
    let Some(kind) = kind.filter(|kind| *kind > 0) else {
        return Err(broken(number, sentences::THE_RECORD_HAS_NO_KIND.into()));
    };
    if words[kind].len() > 1 || words[kind].eq_ignore_ascii_case("g") {
        let message = sentences::the_kind_is_not_read(&words[kind]);
        return Err(Error::new(ErrorKind::Unsupported, message)
            .key(record(number))
            .help(sentences::DRAW_A_SLIDE_AND_A_PIN));
    }
    let value = |at: usize| words.get(at).and_then(|word| word.parse().ok()).filter(|own: &f64| own.abs() < 1e9);
    let (Some(x), Some(y)) = (value(kind + 1), value(kind + 2)) else {
        return Err(broken(number, sentences::the_record_ends_before(&"its two coordinates")));
    };
    Ok(ClassicJoint {
        links: words[..kind].to_vec(),
        is_slide: words[kind].eq_ignore_ascii_case("p"),
        place: Vec2::new(x, y),
        angle: value(kind + 3).unwrap_or_default().to_radians(),
        is_input: words.last().is_some_and(|word| word.len() == 4 && word.ends_with('t') && word.contains(['t', 'f'])),
    })
}

fn record(number: usize) -> String {
    format!("joint {number}")
}

fn broken(number: usize, message: String) -> Error {
    Error::new(ErrorKind::Input, message).key(record(number)).help(sentences::COPY_THE_WHOLE_LINK)
}
