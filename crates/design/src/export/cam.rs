//! Profiles of cams as tables and as DXF.

use crate::sentences;
use drawing::dxf::Dxf;
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
///
/// # Errors
/// [`ErrorKind::Input`] if the mechanism has no cam.
pub fn drawing(case: &Case) -> Result<String> {
    let mut file = Dxf::default();
    for (name, points) in profiles(case)? {
        file.polyline(name, points.into_iter().map(|point| point * 1e3), true);
    }
    Ok(file.finish())
}
