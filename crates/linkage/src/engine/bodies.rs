//! Substitute masses and moments of inertia for links without mass or inertia.
//! Engines integrate bodies, and every body needs both quantities.

use crate::case::Case;
use crate::error::{Advice, Error, ErrorKind, Result};
use crate::mechanism::LinkId;
use crate::sentences;

/// Mass (kg) and moment of inertia (kg m^2) that engines add to a link without mass or inertia.
/// The result is 0 for a quantity that the link already has.
/// The substitute mass is the mean mass of the moving links, or 1 kg if no link has a mass.
/// The substitute moment of inertia is that of a rod: its mass is the mass of the link, its length the mechanism's
/// size.
pub fn stand_in(case: &Case, link: LinkId) -> [f64; 2] {
    let moving = &case.mechanism.links()[1..];
    let total: f64 = moving.iter().map(|link| link.mass).sum();
    let mean = if total > 0.0 { total / moving.len() as f64 } else { 1.0 };
    let (own, size) = (&case.mechanism.links()[link], case.mechanism.size());
    let mass = if own.mass > 0.0 { 0.0 } else { mean };
    [mass, if own.inertia > 0.0 { 0.0 } else { (own.mass + mass) * size * size / 12.0 }]
}

/// Checks that every link has a mass and a moment of inertia.
/// A free motion requires both quantities, because a substitute mass or moment of inertia would change the motion.
/// `software` is the engine's name as users know it.
///
/// # Errors
/// [`ErrorKind::Unsupported`] with the first link that lacks a mass or a moment of inertia.
pub fn check_inertias(case: &Case, software: &str) -> Result<()> {
    let Some(bare) = case.mechanism.links()[1..].iter().find(|link| !(link.mass > 0.0 && link.inertia > 0.0)) else {
        return Ok(());
    };
    Err(Error::new(ErrorKind::Unsupported, sentences::link_has_no_mass_or_no_moment(&bare.name, &software))
        .key(format!("links.{}", bare.name))
        .of_link(&bare.name)
        .help(sentences::GIVE_EVERY_LINK_BOTH)
        .or_help(Advice::OtherSolver { solver: "newton" }))
}
