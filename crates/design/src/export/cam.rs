//! Profiles of cams as tables and as DXF.

use std::fmt::Write;

use crate::sentences;
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Vec2;

/// Number of points of a profile.
const POINTS: usize = 720;

/// The name and profile of every cam in the frame of its link (m).
///
/// # Errors
/// [`ErrorKind::Input`] if the mechanism has no cam.
fn profiles(case: &Case) -> Result<Vec<(&str, Vec<Vec2>)>> {
    let motions = case.start.motions();
    let found = case.mechanism.transmissions().iter().filter_map(|own| {
        let at = own.coordinates_in(case.mechanism.joints(), &motions);
        Some((own.name(), own.cam.as_ref()?.profile(at, POINTS)))
    });
    let found: Vec<_> = found.collect();
    if found.is_empty() {
        return Err(Error::new(ErrorKind::Input, sentences::THE_MECHANISM_HAS_NO_CAM).help(sentences::ADD_A_CAM));
    }
    Ok(found)
}

/// The profiles of all cams as a table with its header: the cam, the cam's coordinate at the contact (deg), the point
/// of contact in the frame of the cam (m).
///
/// # Errors
/// [`ErrorKind::Input`] if the mechanism has no cam.
pub fn table(case: &Case) -> Result<Vec<[String; 4]>> {
    let mut rows = vec![["cam", "angle_deg", "x_m", "y_m"].map(String::from)];
    for (name, points) in profiles(case)? {
        rows.extend(points.iter().enumerate().map(|(index, point)| {
            let angle = 360.0 * index as f64 / POINTS as f64;
            [name.into(), angle.to_string(), point.x.to_string(), point.y.to_string()]
        }));
    }
    Ok(rows)
}

/// The profiles of all cams as DXF in mm: one closed polyline on one layer for each cam, in the frame of the cam.
/// Format: AutoCAD release 12, which all programs read.
/// The `dxf` crate is not used, because it writes the date: the bytes would differ from run to run.
///
/// # Errors
/// [`ErrorKind::Input`] if the mechanism has no cam.
pub fn drawing(case: &Case) -> Result<String> {
    let mut text = String::new();
    let mut put = |code: u8, value: &str| writeln!(text, "{code}\n{value}").expect("a text takes all");
    for (code, value) in [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1009"), (0, "ENDSEC")] {
        put(code, value);
    }
    put(0, "SECTION");
    put(2, "ENTITIES");
    for (name, points) in profiles(case)? {
        // The flag 66 says that vertices follow. The flag 70 says that the polyline is closed.
        for (code, value) in [(0, "POLYLINE"), (8, name), (66, "1"), (70, "1")] {
            put(code, value);
        }
        for point in points {
            put(0, "VERTEX");
            put(8, name);
            put(10, &(point.x * 1e3).to_string());
            put(20, &(point.y * 1e3).to_string());
        }
        put(0, "SEQEND");
    }
    put(0, "ENDSEC");
    put(0, "EOF");
    Ok(text)
}
