//! `[[transmissions.motion]]` and the other keys of cams.

use super::super::curve::{self, CurveVariable};
use super::super::keys::key::{Section, ValueKind, needed, optional};
use super::super::reader::{Sign, TomlTable};
use super::super::unit::UnitFamily;
use super::super::words::{Words, names, suggestion};
use crate::sentences;
use linkage::error::{ErrorKind, Result};
use linkage::math::{Curve, Piecewise, Vec2};
use linkage::mechanism::{CamContact, CamCurve, CamLaw, CamSegment, Link, TransmissionKind};
use std::f64::consts::TAU;

/// The part of the follower that touches the cam.
#[derive(Clone, Copy, Debug)]
pub enum Follower {
    Roller,
    Knife,
    Flat,
}

/// Words for the part that touches the cam.
pub const FOLLOWERS: Words<Follower> =
    &[("roller", Follower::Roller), ("knife", Follower::Knife), ("flat", Follower::Flat)];

/// Words for the curves of rises and returns.
const CURVES: Words<CamCurve> = &[
    ("cycloidal", CamCurve::Cycloidal),
    ("3-4-5", CamCurve::Polynomial345),
    ("4-5-6-7", CamCurve::Polynomial4567),
    ("modified-sine", CamCurve::ModifiedSine),
];

/// Angles of the cam count as equal if they differ by less than this limit (rad).
/// The values of a formula at the beginning and at the end of a turn count as equal if they differ by at most this
/// fraction of the formula's range.
const EQUAL: f64 = 1e-9;

/// Description of the pieces of a law.
pub const SECTION: Section = Section::at("transmissions.motion").with(&[
    needed("to", ValueKind::ANGLES.of(Sign::Positive))
        .means("angle of the cam at the end of the piece: ascending, the last one 360 deg"),
    optional("lift", ValueKind::INPUTS, "a dwell: that of the piece before")
        .means("lift of the follower at the end of the piece; that of the last piece is 0"),
    optional("law", ValueKind::Choice(|| names(CURVES)), "`\"cycloidal\"`").means("curve of a rise or return"),
]);

/// Description of a table of lifts.
pub const LIFTS: Section = Section::at("transmissions.lifts").with(&[
    needed("angle", ValueKind::ANGLES.of(Sign::NotNegative)).means("angle of the cam: ascending, below 360 deg"),
    needed("lift", ValueKind::INPUTS).means("lift of the follower at that angle"),
]);

/// Reads the keys of a cam; `link` is the follower. Also returns the units of the lifts, if the law states units.
pub fn read(table: &mut TomlTable, link: &Link) -> Result<(TransmissionKind, Option<&'static UnitFamily>)> {
    let follower = table.choice("follower", sentences::IS_NO_FOLLOWER, FOLLOWERS)?;
    let (point, radius) = (table.string("point")?, table.optional_si("roller")?);
    let (law, unit) = law(table)?;
    let Some(point) = link.points.iter().find(|own| own.name == point).map(|own| own.local) else {
        let known = suggestion(&point, link.points.iter().map(|own| own.name.as_str()), "\"");
        return table.refuse("point", sentences::the_follower_has_no_point(&link.name, &point), known);
    };
    Ok((TransmissionKind::Cam { law, contact: contact(table, follower, point, radius)? }, unit))
}

fn contact(table: &mut TomlTable, follower: Follower, point: Vec2, radius: Option<f64>) -> Result<CamContact> {
    match (follower, radius) {
        (Follower::Roller, Some(radius)) => Ok(CamContact::Roller { centre: point, radius }),
        (Follower::Roller, None) => Err(table.lacks(&["roller_mm", "roller_m"], sentences::GIVE_THE_ROLLER)),
        (Follower::Knife | Follower::Flat, Some(_)) => {
            table.refuse("roller", sentences::ONLY_A_ROLLER_HAS_A_RADIUS, sentences::TAKE_A_ROLLER)
        }
        (Follower::Knife, None) => Ok(CamContact::Roller { centre: point, radius: 0.0 }),
        (Follower::Flat, None) => Ok(CamContact::Flat(point)),
    }
}

/// A law of a cam, and the units of its lifts, if it states units.
type Law = (CamLaw, Option<&'static UnitFamily>);

/// Reads a law of a cam.
type ReadLaw = fn(&mut TomlTable) -> Result<Law>;

/// The ways to state the law of a cam, each with its reader.
const LAWS: [(&str, ReadLaw); 3] = [("motion", pieces), ("lifts", lifts), ("formula", formula)];

fn law(table: &mut TomlTable) -> Result<Law> {
    let mut stated = LAWS.into_iter().filter(|(key, _)| table.has(key));
    let (Some((_, read)), second) = (stated.next(), stated.next()) else {
        return Err(table.lacks(&["motion", "lifts", "formula"], sentences::GIVE_THE_MOTION_OF_THE_FOLLOWER));
    };
    match second {
        Some((key, _)) => table.refuse(key, sentences::THE_CAM_HAS_TWO_LAWS, sentences::TAKE_THE_KEY_OUT),
        None => read(table),
    }
}

/// A law by a periodic spline through a table of lifts.
fn lifts(table: &mut TomlTable) -> Result<Law> {
    let (mut points, mut unit): (Vec<(f64, f64)>, Option<&'static UnitFamily>) = (Vec::new(), None);
    for mut point in table.tables("lifts")? {
        let read = point.read(|point| {
            let (angle, lift) = (point.si("angle")?, point.optional_si_of("lift")?);
            point.finish()?;
            Ok((angle, lift))
        });
        let (angle, lift) = read?;
        let Some(lift) = lift_in(&mut point, lift, &mut unit)? else {
            return Err(
                point.lacks(&["lift_m", "lift_mm", "lift_rad", "lift_deg"], sentences::GIVE_LIFTS_LIKE_THE_JOINT)
            );
        };
        let last = points.last().map_or(-1.0, |(last, _)| *last);
        if !(angle > last + EQUAL && angle < TAU - EQUAL) {
            let message = sentences::the_angle_of_the_lift(&angle.to_degrees());
            return Err(point.fault(message).help(sentences::ASCEND_BELOW_360));
        }
        points.push((angle, lift));
    }
    let curve = Curve::Table(Piecewise::periodic_spline(&points, TAU));
    match curve.range() > 0.0 {
        true => Ok((CamLaw::Curve(curve), unit)),
        false => table.refuse("lifts", sentences::THE_FOLLOWER_DOES_NOT_MOVE, sentences::GIVE_LIFTS),
    }
}

/// The lift (rad or m), if its units agree with those of the lifts that were read before it.
fn lift_in(
    table: &mut TomlTable,
    lift: Option<(&'static UnitFamily, f64)>,
    unit: &mut Option<&'static UnitFamily>,
) -> Result<Option<f64>> {
    let Some((family, lift)) = lift else { return Ok(None) };
    if unit.replace(family).is_some_and(|other| !std::ptr::eq(other, family)) {
        return Err(table.wrong(ErrorKind::Input, "lift", sentences::LIFTS_IN_TWO_UNITS));
    }
    Ok(Some(lift))
}

/// A law by a formula of the cam's angle. The formula must repeat after a full turn.
fn formula(table: &mut TomlTable) -> Result<Law> {
    let (curve, _) = curve::formula(table, CurveVariable::Angle, TAU)?;
    let (begin, end, range) = (curve.at(0.0), curve.at(TAU), curve.range());
    if !begin.iter().zip(&end).all(|(begin, end)| (begin - end).abs() <= EQUAL * range) {
        let help = sentences::GIVE_A_FORMULA_WITH_TWO_DERIVATIVES;
        return table.refuse("formula", sentences::THE_FORMULA_DOES_NOT_REPEAT, help);
    }
    Ok((CamLaw::Curve(curve), None))
}

/// A law in pieces.
fn pieces(table: &mut TomlTable) -> Result<Law> {
    let (mut segments, mut unit): (Vec<CamSegment>, Option<&'static UnitFamily>) = (Vec::new(), None);
    for mut piece in table.tables("motion")? {
        let read = piece.read(|piece| {
            let (to, lift) = (piece.si("to")?, piece.optional_si_of("lift")?);
            let curve = piece.optional_choice("law", sentences::IS_NO_CURVE_OF_A_CAM, CURVES)?;
            piece.finish()?;
            Ok((to, lift, curve.unwrap_or(CamCurve::Cycloidal)))
        });
        let (to, lift, curve) = read?;
        let (last, before) = segments.last().map_or((0.0, 0.0), |own: &CamSegment| (own.to, own.lift));
        if !(to > last + EQUAL && to <= TAU + EQUAL) {
            let message = sentences::the_cam_angles_do_not_ascend(&to.to_degrees(), &last.to_degrees());
            return Err(piece.fault(message).help(sentences::ASCEND_TO_360));
        }
        let lift = lift_in(&mut piece, lift, &mut unit)?;
        // Removes the rounding error of the last angle, which is a full turn.
        let to = if (to - TAU).abs() <= EQUAL { TAU } else { to };
        segments.push(CamSegment { to, lift: lift.unwrap_or(before), curve });
    }
    let ends_at = segments.last().map_or(0.0, |own| own.to.to_degrees());
    match (segments.iter().all(|own| own.lift == 0.0), CamLaw::of(segments)) {
        (false, Some(law)) => Ok((law, unit)),
        (true, Some(_)) => table.refuse("motion", sentences::THE_FOLLOWER_DOES_NOT_MOVE, sentences::GIVE_A_LIFT),
        (_, None) => table.refuse("motion", sentences::the_law_of_the_cam_ends_at(&ends_at), sentences::ASCEND_TO_360),
    }
}
