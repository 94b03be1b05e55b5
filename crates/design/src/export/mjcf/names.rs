//! Names in the file. The file uses the names of the scenario; names that MuJoCo does not accept are errors.

use crate::sentences;
use std::collections::BTreeSet;

use linkage::error::{Error, ErrorKind, Result};
use linkage::mechanism::{Joint, LinkId, Mechanism, Transmission};

/// Name that MuJoCo gives to the ground.
const WORLD: &str = "world";

/// Name of the site at the joint's point on `link`.
pub(super) fn side(joint: &Joint, link: LinkId) -> String {
    format!("{}.{}", joint.name, if joint.first.link == link { "first" } else { "second" })
}

/// Name of a transmission's tendon, and of the equality constraint on this tendon.
pub(super) fn of_transmission(transmission: &Transmission) -> String {
    format!("transmission.{}", transmission.name())
}

/// Checks that all names are unique in MuJoCo.
///
/// # Errors
/// [`ErrorKind::Unsupported`] in these cases:
/// a link has MuJoCo's name for the ground, two sites have the same name, or a name is empty or has control characters.
pub(super) fn check(mechanism: &Mechanism) -> Result<()> {
    let unsupported = |message: String, key: String| {
        let error = Error::new(ErrorKind::Unsupported, message).key(key);
        Err(error.help(sentences::GIVE_IT_ANOTHER_NAME_IN_THE_SCENARIO))
    };
    if mechanism.links()[1..].iter().any(|link| link.name == WORLD) {
        return unsupported(sentences::MUJOCO_CALLS_THE_GROUND_WORLD.to_string(), format!("links.{WORLD}"));
    }
    let links = mechanism.links()[1..].iter().map(|link| ("links", &link.name));
    for (table, name) in links.chain(mechanism.joints().iter().map(|joint| ("joints", &joint.name))) {
        if name.is_empty() || name.chars().any(char::is_control) {
            return unsupported(sentences::MUJOCO_TAKES_NO_EMPTY_NAMES.to_string(), format!("{table}.{name}"));
        }
    }
    let mut sites = BTreeSet::new();
    let sides =
        mechanism.joints().iter().flat_map(|joint| [joint.first.link, joint.second.link].map(|link| side(joint, link)));
    let points = mechanism.moving_points().map(|(name, _)| name.to_string());
    for name in sides.chain(points) {
        if !sites.insert(name.clone()) {
            return unsupported(sentences::the_file_would_have_two_sites(&name), format!("points.{name}"));
        }
    }
    Ok(())
}
