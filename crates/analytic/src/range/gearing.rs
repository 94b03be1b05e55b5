//! Treats further drives as if they were geared to the first drive.

use super::constraints::{Constraints, Gearing};
use crate::sentences;
use linkage::case::Case;
use linkage::drive::Drive;
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;

/// Index of the coordinate of the first drive, and a linear equation between this coordinate and the coordinate of each
/// further drive.
/// If all drives have constant speeds, the ratio of each further drive's speed to the first drive's speed is constant.
///
/// # Errors
/// [`ErrorKind::Unsupported`] if there are several drives and the speed of one of them changes.
pub(super) fn gearings(case: &Case, constraints: &Constraints) -> Result<(usize, Vec<Gearing>)> {
    let size = case.mechanism.size();
    let unit = |drive: &Drive| drive.input.span(size);
    let mut given = 0;
    let indices: Vec<usize> = case
        .drives
        .iter()
        .map(|drive| {
            if drive.input == Input::Angle {
                return Constraints::angle(drive.link);
            }
            given += 1;
            constraints.of_given(given - 1)
        })
        .collect();
    if case.goes_by_time() {
        let help = sentences::GIVE_THE_DRIVES_CONSTANT_SPEEDS;
        return Err(Error::new(ErrorKind::Unsupported, sentences::ONE_OF_SEVERAL_DRIVES_CHANGES).help(help));
    }
    let crank = case.crank();
    let further = case.drives.further().iter().zip(case.drives.ratios(0.0).skip(1)).zip(&indices[1..]);
    let gearing = |((drive, ratio), &own): ((&Drive, f64), &usize)| {
        let ratio = ratio * unit(crank) / unit(drive);
        let [start, of_crank] = [drive, crank].map(|drive| drive.coordinate(drive.start) / unit(drive));
        Gearing { terms: vec![(own, 1.0), (indices[0], -ratio)], sum: start - ratio * of_crank, law: None }
    };
    Ok((indices[0], further.map(gearing).collect()))
}
