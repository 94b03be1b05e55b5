//! Converts the failure of a run to the case's time, crank angle and joint.

use linkproof_simbody::Failure;

use super::model::Linkage;
use linkage::case::Case;
use linkage::error::{Error, ErrorKind};

/// The failure of a run as an error with the case's time, crank angle and joint.
pub(super) fn stopped(case: &Case, linkage: &Linkage, sense: f64, failure: &Failure) -> Error {
    let t = failure.time.unwrap_or(0.0) * sense;
    let at = case.told(case.crank().at(t).value);
    // Written so that NaN counts as the largest.
    let widest = failure.gaps.iter().zip(&linkage.tree.cut).reduce(|a, b| if a.0 >= b.0 { a } else { b });
    let gap = widest.map_or(String::new(), |(gap, &joint)| {
        format!(", joint \"{}\" open by {gap:.3e} m", case.mechanism.joints()[joint].name)
    });
    let message = format!("Simbody stopped at t = {t:.6} s, {at}{gap}: {}", failure.message);
    let mut error = Error::new(ErrorKind::Numeric, message).at_time(t).at_input(at);
    if let Some((_, &joint)) = widest {
        error = error.of_joint(&case.mechanism.joints()[joint].name);
    }
    error
        .help("check that the pose can be assembled there")
        .or_help("shorten the grid to the crank angles before the dead point")
}
