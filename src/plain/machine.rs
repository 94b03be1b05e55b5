//! The mechanism as the file describes it: links, joints, drives, transmissions and loads. A proof shows that several
//! methods get equal results from the file. Only a reader can see whether the file describes the intended mechanism.

use super::cells::some;
use crate::sentences;
use linkage::case::Case;
use linkage::drive::load::{LoadPart, LoadRole};
use linkage::drive::{Course, Drive, DriveMotion, Load, MotionLaw};
use linkage::input::Input;
use linkage::math::statistics::distinct;
use linkage::mechanism::{GROUND, JointKind, LinkId};
use prover::numbers::{significant, with_unit};
use prover::run::Proof;

/// Number of names and loads that are listed; further ones are only counted.
const SHOWN: usize = 12;
/// Number of significant digits with which numbers of the scenario are shown.
const DIGITS: usize = 4;

/// The mechanism in rows: each row has a subject, such as the links, and its description.
#[must_use]
pub fn rows(proof: &Proof) -> Vec<(&'static str, String)> {
    let case = &proof.scene.case;
    let mechanism = &case.mechanism;
    let names: Vec<&str> = mechanism.links().iter().skip(1).map(|link| link.name.as_str()).collect();
    let links = if names.len() == 1 { "link" } else { "links" };
    let mut rows = vec![
        ("mechanism", proof.title.clone()),
        ("links", sentences::links_and_frame(&names.len(), &links, &some(&names, SHOWN))),
        ("joints", joints(case)),
    ];
    let transmissions: Vec<String> = mechanism
        .transmissions()
        .iter()
        .map(|own| {
            let [first, second, _] = own.links().map(|link| name(case, link));
            format!("{} {} ({first}, {second})", own.design.kind.name(), own.name())
        })
        .collect();
    if !transmissions.is_empty() {
        rows.push(("couplings", some(&transmissions, SHOWN)));
    }
    let drives: Vec<String> = case.drives.iter().map(|own| drive(case, own)).collect();
    rows.push((if drives.len() == 1 { "drive" } else { "drives" }, drives.join("; ")));
    rows.push(("loads", loads(case)));
    rows
}

fn name(case: &Case, link: LinkId) -> &str {
    &case.mechanism.links()[link].name
}

fn joints(case: &Case) -> String {
    let joints = case.mechanism.joints();
    let told = |joint: &linkage::mechanism::Joint| match joint.kind {
        JointKind::Revolute => joint.name.clone(),
        JointKind::Prismatic { axes } => {
            let [first, second] = [joint.first, joint.second].map(|side| name(case, side.link));
            let deg = significant(axes[0].y.atan2(axes[0].x).to_degrees(), DIGITS);
            sentences::an_axis_at(&joint.name, &first, &second, &deg, &first)
        }
    };
    let kinds = distinct(joints.iter().map(|joint| joint.kind.name()));
    let each = kinds.into_iter().map(|kind| {
        let names: Vec<String> = joints.iter().filter(|joint| joint.kind.name() == kind).map(told).collect();
        format!("{} {kind}: {}", names.len(), some(&names, SHOWN))
    });
    each.collect::<Vec<_>>().join("; ")
}

fn drive(case: &Case, own: &Drive) -> String {
    let joint = &case.mechanism.joints()[own.joint];
    let (link, law) = (name(case, own.link), motion(own));
    match own.input {
        Input::Angle => sentences::joint_turns(&joint.name, &link, &law),
        Input::Turn => sentences::joint_turns_from(&joint.name, &link, &name(case, joint.first.link), &law),
        Input::Slide => sentences::joint_slides(&joint.name, &link, &law),
    }
}

fn motion(own: &Drive) -> String {
    let is_slide = own.input == Input::Slide;
    let speed = |value: f64| match is_slide {
        true => (significant(value, DIGITS), "m/s"),
        false => (significant(value * 30.0 / std::f64::consts::PI, DIGITS), "rpm"),
    };
    let motor = |is_there: bool, words: &'static str| if is_there { words } else { "" };
    match &own.motion {
        DriveMotion::Free { initial_speed, motor: own, .. } => {
            let (size, unit) = speed(*initial_speed);
            let under = if own.is_some() { sentences::UNDER_ITS_MOTOR } else { sentences::UNDER_LOADS_ALONE };
            sentences::free_from(&size, &unit) + under
        }
        DriveMotion::Prescribed { law, .. } if law.holds() => sentences::HELD.into(),
        DriveMotion::Prescribed { law, motor: own } => {
            let told = match law {
                MotionLaw::ConstantSpeed(value) if is_slide => sentences::constant_slide_speed(&speed(*value).0),
                MotionLaw::ConstantSpeed(value) => sentences::constant_speed(&speed(*value).0),
                MotionLaw::Ramp { .. } | MotionLaw::Cycloidal { .. } | MotionLaw::Curve(_) => {
                    let (size, unit) = speed(law.top_speed());
                    sentences::law_up_to(&law.name(), &size, &unit)
                }
            };
            told + motor(own.is_some(), sentences::WITH_A_MOTOR)
        }
    }
}

/// Gravity and all loads. Equal descriptions are given once.
fn loads(case: &Case) -> String {
    let gravity = case.gravity;
    let size = significant(gravity.norm(), DIGITS);
    let first = match gravity.norm() > 0.0 {
        true if gravity.x == 0.0 && gravity.y < 0.0 => sentences::gravity_down(&size),
        true => sentences::gravity_at(&size, &significant(gravity.y.atan2(gravity.x).to_degrees(), DIGITS)),
        false => sentences::NO_GRAVITY.into(),
    };
    let all = distinct(std::iter::once(first).chain(case.loads.iter().map(|own| load(case, own))));
    some(&all, SHOWN)
}

/// A load with its constant numbers, such as the force, and the links on which the load acts.
fn load(case: &Case, own: &Load) -> String {
    let (mut links, mut sizes) = (Vec::new(), Vec::new());
    for part in own.clone().parts() {
        match part {
            LoadPart::Link(link) => links.push(*link),
            LoadPart::Point(side) => links.push(side.link),
            LoadPart::Number { role: LoadRole::Amount | LoadRole::Size, name, value } => sizes.push((name, *value)),
            LoadPart::Courses { name, values } => {
                let constant: Option<Vec<f64>> = values
                    .iter()
                    .map(|own| match own {
                        Course::Constant(value) => Some(*value),
                        Course::Table { .. } => None,
                    })
                    .collect();
                sizes.extend(constant.map(|own| (name, own.iter().fold(0.0, |sum: f64, own| sum.hypot(*own)))));
            }
            LoadPart::Number { .. } | LoadPart::Acts(_) | LoadPart::Follows(_) => {}
        }
    }
    let sizes: Vec<String> =
        sizes.iter().map(|(name, value)| with_unit(&significant(*value, DIGITS), unit(name))).collect();
    let told = format!("{} {}", own.sort().replace('_', " "), sizes.join(", "));
    let names: Vec<&str> = links.iter().map(|link| name(case, *link)).collect();
    match names.as_slice() {
        [first, second] => sentences::load_between(&told.trim_end(), first, second),
        _ => {
            let moving: Vec<&str> =
                links.iter().filter(|link| **link != GROUND).map(|link| name(case, *link)).collect();
            sentences::load_on(&told.trim_end(), &moving.join(", "))
        }
    }
}

/// Unit of a number of a load, by its key.
fn unit(key: &str) -> &'static str {
    match key {
        "moment_N_m" => "N m",
        "force_N" => "N",
        "stiffness_N_m" => "N/m",
        "damping_N_s_m" => "N s/m",
        "stiffness_N_m_rad" => "N m/rad",
        "damping_N_m_s_rad" => "N m s/rad",
        _ => "",
    }
}
