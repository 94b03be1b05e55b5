//! Sheets of other cases: another configuration, another sense of rotation, no gravity.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::cause::MarkCause;
use super::hypothesis::Hypothesis;
use super::sheet::{AnswerSheet, AnswerTable};
use crate::diagnosis::without_inertia_forces;
use crate::diagnosis::{CasePart, Change, PartChange, at_speed, changed, driven, others, reassembled, remade};
use linkage::case::Case;
use linkage::drive::DriveMotion;
use linkage::mechanism::{GROUND, LinkId};
use linkage::trajectory::Stage;

/// Largest number of combinations of two groups that both have another configuration.
const PAIRS: usize = 12;

/// The hypotheses of mistakes by which the student solved another case.
pub(super) fn all(sheet: &AnswerSheet) -> Vec<Hypothesis> {
    let case = &sheet.case;
    let mut found: Vec<(MarkCause, f64, Option<Case>)> = Vec::new();
    let mut put = |cause: MarkCause, prior: f64, other: Option<Case>| found.push((cause, prior, other));
    let first = others(case);
    for (change, other) in &first {
        put(configuration(&[change]), -1.5, Some(other.clone()));
    }
    let pairs = first.iter().flat_map(|(one, other)| others(other).into_iter().map(move |own| (one, own)));
    for (one, (two, other)) in pairs.filter(|(one, (two, _))| one.part != two.part).take(PAIRS) {
        put(configuration(&[one, &two]), -2.5, Some(other));
    }
    if let Some(speed) = case.crank().constant_speed() {
        put(MarkCause::Reversed, -1.5, with_speed(case, -speed));
        for (factor, written, asked) in [(TAU / 60.0, "rpm", "rad/s"), (60.0 / TAU, "rad/s", "rpm")] {
            put(MarkCause::SpeedUnit(written, asked), -2.2, with_speed(case, factor * speed));
        }
    }
    for (link, point, other) in from_other_ends(case) {
        put(MarkCause::FromOtherEnd(link, point), -2.5, Some(other));
    }
    if sheet.columns.iter().any(|column| column.stage() >= Stage::Reactions) {
        if case.gravity.norm() > 0.0 {
            put(MarkCause::NoGravity, -1.5, case.with(|parts| parts.gravity *= 0.0).ok());
            put(MarkCause::GravityUp, -2.5, case.with(|parts| parts.gravity *= -1.0).ok());
        }
        let links: Vec<LinkId> = case.mechanism.links().ids().skip(1).collect();
        put(MarkCause::NoInertiaForces, -1.5, without_inertia_forces(case, &links));
        for load in 0..case.loads.len() {
            put(MarkCause::NoLoad(load + 1), -1.5, case.with(|parts| drop(parts.loads.remove(load))).ok());
        }
    }
    let at = |other: &Case, position: &dyn Fn(f64) -> f64| -> Vec<Option<AnswerTable>> {
        sheet.positions().iter().map(|&own| sheet.answers_of(other, vec![position(own)])).collect()
    };
    let mut all: Vec<Hypothesis> = found
        .into_iter()
        .filter_map(|(cause, prior, other)| Some(Hypothesis::of_table(cause, prior, at(&other?, &|own| own))))
        .collect();
    if case.crank().input.period().is_some() {
        let turned = [(180, PI), (90, FRAC_PI_2), (-90, -FRAC_PI_2)];
        all.push(Hypothesis::of_table(MarkCause::Clockwise, -2.5, at(case, &|own| -own)));
        all.extend(turned.map(|(degrees, by)| {
            Hypothesis::of_table(MarkCause::CrankTurned(degrees), -2.8, at(case, &|own| own + by))
        }));
    }
    all
}

fn configuration(changes: &[&Change]) -> MarkCause {
    let told = |change: &&Change| match (&change.part, &change.how) {
        (CasePart::Configuration(group), PartChange::Other(mode)) => (group.clone(), mode.clone()),
        (part, how) => unreachable!("not a configuration: {part:?} {how:?}"),
    };
    let (groups, modes): (Vec<String>, Vec<String>) = changes.iter().map(told).unzip();
    MarkCause::Configuration { group: groups.join(" + "), mode: modes.join(" + ") }
}

fn with_speed(case: &Case, speed: f64) -> Option<Case> {
    remade(case, |parts| {
        driven(parts, 0, |drive| {
            if let DriveMotion::Prescribed { law, .. } = &mut drive.motion {
                *law = at_speed(law, speed);
            }
        });
        Some(())
    })
}

/// Cases in which the position of a point P is measured from Q2 instead of Q1. Q1 and Q2 are two other points of the
/// link: P becomes Q1 + Q2 - P.
/// Each case comes with the names of the link and of the point P.
fn from_other_ends(case: &Case) -> Vec<(String, String, Case)> {
    let mut found = Vec::new();
    for (index, link) in
        case.mechanism.links().entries().filter(|(index, link)| *index != GROUND && link.points.len() > 2)
    {
        for point in &link.points {
            let ends: Vec<_> = link.points.iter().filter(|own| own.name != point.name).collect();
            for pair in ends.windows(2) {
                let (old, new) = (point.local, pair[0].local + pair[1].local - point.local);
                let other = remade(case, |parts| {
                    changed(parts, |links, joints| {
                        let points = links[index].points.iter_mut().map(|point| &mut point.local);
                        let sides = joints.iter_mut().flat_map(|joint| [&mut joint.first, &mut joint.second]);
                        let on_link = sides.filter(|side| side.link == index).map(|side| &mut side.local);
                        points.chain(on_link).filter(|local| **local == old).for_each(|local| *local = new);
                    })?;
                    reassembled(parts)
                });
                found.extend(other.map(|other| (link.name.clone(), point.name.clone(), other)));
            }
        }
    }
    found
}
