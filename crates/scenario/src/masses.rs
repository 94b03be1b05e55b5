//! Refuses masses that are out of proportion to their mechanism. The usual cause is a wrong unit.
//!
//! A double has sixteen digits.
//! A mass that is too far from its link, or too heavy compared with the rest of the mechanism, leaves too few digits
//! for the other quantities of the mechanism.
//! The rounding error of such a mass would hide the rest of the mechanism from the solvers and the engines, so the mass
//! is refused.

use crate::sentences;
use linkage::drive::{Drive, Drives};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::mechanism::{Link, Mechanism};

/// Upper limit of the distance between a mass centre and the nearest point of its link, as a multiple of the size of
/// the largest link.
const FARTHEST: f64 = 1e3;
/// Upper limit of a link's moment of inertia, divided by the sum of the moments of inertia of all other links and of
/// the motors.
/// Each link's moment of inertia is its own one plus its mass times the square of the largest link's size.
const HEAVIEST: f64 = 1e12;

/// Speed of light (m/s).
const LIGHT: f64 = 299_792_458.0;

/// Checks that no point of a driving link is faster than light, neither under the law of motion nor at the start.
///
/// # Errors
/// [`ErrorKind::Input`] for a point faster than light.
pub fn check_speeds(mechanism: &Mechanism, drives: &Drives) -> Result<()> {
    for drive in drives.iter() {
        let speed = drive.top_speed().abs().larger(drive.initial_speed().abs());
        let link = &mechanism.links()[drive.link];
        if !(speed * drive.input.reach(link.size()) <= LIGHT) {
            let message = sentences::at_rad_link_of_has_points(
                &format_args!("{speed:.3e}"),
                &link.name,
                &format_args!("{:.3e}", link.size()),
            );
            let help = sentences::CHECK_THE_UNITS_OF_ITS_SPEED;
            return Err(Error::new(ErrorKind::Input, message).key("drive").of_link(&link.name).help(help));
        }
    }
    Ok(())
}

/// Checks the positions of mass centres, and the masses relative to each other.
///
/// # Errors
/// [`ErrorKind::Input`] for a mass centre or an inertia that is out of proportion to the rest of the mechanism.
pub fn check(mechanism: &Mechanism, drives: &Drives) -> Result<()> {
    let size = mechanism.links().iter().map(Link::size).fold(0.0, f64::larger);
    if size == 0.0 {
        return Ok(());
    }
    let moving = || mechanism.links()[1..].iter().filter(|link| link.mass > 0.0 || link.inertia > 0.0);
    for link in moving().filter(|link| link.mass > 0.0) {
        let far = link.points.iter().map(|point| (point.local - link.mass_centre).norm_squared());
        let far = far.fold(f64::INFINITY, f64::smaller).sqrt();
        if !(far <= FARTHEST * size) {
            let message = sentences::the_mass_centre_of_link_is_away(
                &link.name,
                &format_args!("{far:.3e}"),
                &format_args!("{:.1e}", far / size),
            );
            return Err(Error::new(ErrorKind::Input, message)
                .key(format!("links.{}.mass_centre", link.name))
                .of_link(&link.name)
                .help(sentences::CHECK_THE_UNIT_A_LINK_THAT_IS_SO));
        }
    }
    let inertia = |link: &Link| link.inertia + link.mass * size * size;
    let motors: f64 = drives.iter().map(Drive::moving_inertia).sum();
    // The sum is formed without the link, because the difference of two sums would lose all significant digits.
    let others = |link: &Link| moving().filter(|other| other.name != link.name).map(inertia).sum::<f64>() + motors;
    let Some(link) = moving().max_by(|a, b| inertia(a).total_cmp(&inertia(b))) else { return Ok(()) };
    let (own, others) = (inertia(link), others(link));
    if others > 0.0 && !(own <= HEAVIEST * others) {
        let key = if link.inertia > own / 2.0 { "inertia" } else { "mass" };
        let message = sentences::link_has_a_moment_of_inertia(
            &link.name,
            &format_args!("{own:.3e}"),
            &format_args!("{:.1e}", own / others),
        );
        return Err(Error::new(ErrorKind::Input, message)
            .key(format!("links.{}.{key}", link.name))
            .of_link(&link.name)
            .help(sentences::CHECK_THE_UNIT_LEAVE_OUT));
    }
    Ok(())
}
