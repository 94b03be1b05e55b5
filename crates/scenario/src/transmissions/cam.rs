//! `[[transmissions.motion]]` and the other keys of cams.

use super::super::keys::key::{Section, ValueKind, needed, optional};
use super::super::reader::{Sign, TomlTable};
use super::super::unit::UnitFamily;
use super::super::words::{Words, names, suggestion};
use crate::sentences;
use linkage::error::{ErrorKind, Result};
use linkage::math::Vec2;
use linkage::mechanism::{CamContact, CamCurve, CamLaw, CamSegment, Link, TransmissionKind};
use std::f64::consts::TAU;

/// What touches the cam.
#[derive(Clone, Copy, Debug)]
pub enum Follower {
    Roller,
    Knife,
    Flat,
}

/// Words for what touches the cam.
pub const FOLLOWERS: Words<Follower> =
    &[("roller", Follower::Roller), ("knife", Follower::Knife), ("flat", Follower::Flat)];

/// Words for the curves of rises and returns.
const CURVES: Words<CamCurve> = &[
    ("cycloidal", CamCurve::Cycloidal),
    ("3-4-5", CamCurve::Polynomial345),
    ("4-5-6-7", CamCurve::Polynomial4567),
    ("modified-sine", CamCurve::ModifiedSine),
];

/// Angles of the cam that differ by less are equal (rad).
const EQUAL: f64 = 1e-9;

/// Description of the pieces of a law.
pub const SECTION: Section = Section::at("transmissions.motion").with(&[
    needed("to", ValueKind::ANGLES.of(Sign::Positive))
        .means("angle of the cam at the end of the piece: ascending, the last one 360 deg"),
    optional("lift", ValueKind::INPUTS, "a dwell: that of the piece before")
        .means("lift of the follower at the end of the piece; that of the last piece is 0"),
    optional("law", ValueKind::Choice(|| names(CURVES)), "`\"cycloidal\"`").means("curve of a rise or return"),
]);

/// Reads the keys of a cam with this follower. Also returns the units of the lifts.
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

fn law(table: &mut TomlTable) -> Result<(CamLaw, Option<&'static UnitFamily>)> {
    if !table.has("motion") {
        return Err(table.lacks(&["motion"], sentences::GIVE_THE_MOTION_OF_THE_FOLLOWER));
    }
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
        if let Some((family, _)) = lift
            && unit.replace(family).is_some_and(|other| !std::ptr::eq(other, family))
        {
            return Err(piece.wrong(ErrorKind::Input, "lift", sentences::LIFTS_IN_TWO_UNITS));
        }
        // The last angle is a whole turn, whatever its rounding.
        let to = if (to - TAU).abs() <= EQUAL { TAU } else { to };
        segments.push(CamSegment { to, lift: lift.map_or(before, |(_, lift)| lift), curve });
    }
    let ends_at = segments.last().map_or(0.0, |own| own.to.to_degrees());
    match (segments.iter().all(|own| own.lift == 0.0), CamLaw::of(segments)) {
        (false, Some(law)) => Ok((law, unit)),
        (true, Some(_)) => table.refuse("motion", sentences::THE_FOLLOWER_DOES_NOT_MOVE, sentences::GIVE_A_LIFT),
        (_, None) => table.refuse("motion", sentences::the_law_of_the_cam_ends_at(&ends_at), sentences::ASCEND_TO_360),
    }
}
