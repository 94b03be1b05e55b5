//! Names in model files. A model file uses the names of the scenario if the file format accepts them.

use std::collections::BTreeSet;

use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};
use linkage::mechanism::Mechanism;

/// Checks that SDF accepts all names. In SDF, a link and a joint of one model must not have the same name.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a name that is given twice, and for a name that SDF reserves.
pub(super) fn check_sdf(mechanism: &Mechanism) -> Result<()> {
    let links = mechanism.links()[1..].iter().map(|link| ("links", &link.name));
    let mut known = BTreeSet::new();
    for (table, name) in links.chain(mechanism.joints().iter().map(|joint| ("joints", &joint.name))) {
        let message = match known.insert(name) {
            false => sentences::sdf_takes_no_joint_called(&name),
            true if name == "world" || name.contains("::") || name.starts_with("__") && name.ends_with("__") => {
                sentences::sdf_reserves_the_name(&name)
            }
            true => continue,
        };
        let error = Error::new(ErrorKind::Unsupported, message).key(format!("{table}.{name}"));
        return Err(error.help(sentences::GIVE_IT_ANOTHER_NAME_IN_THE_SCENARIO));
    }
    Ok(())
}

/// Checks that no link has the name of the root of a URDF file.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a link called `world`.
pub(super) fn check_urdf(mechanism: &Mechanism) -> Result<()> {
    match mechanism.links()[1..].iter().any(|link| link.name == "world") {
        false => Ok(()),
        true => Err(Error::new(ErrorKind::Unsupported, sentences::THE_ROOT_OF_THE_FILE_IS_WORLD)
            .key("links.world")
            .help(sentences::GIVE_IT_ANOTHER_NAME_IN_THE_SCENARIO)),
    }
}

/// The names as identifiers of USD: letters, digits and underscores, without a digit at the beginning.
/// If an identifier would occur twice, the second one gets a number.
pub(super) fn identifiers<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for name in names {
        let mut own: String = name.chars().map(|one| if one.is_alphanumeric() { one } else { '_' }).collect();
        if !own.starts_with(|first: char| first.is_alphabetic() || first == '_') {
            own.insert(0, '_');
        }
        let plain = own.clone();
        let mut number = 2;
        while found.contains(&own) {
            own = format!("{plain}_{number}");
            number += 1;
        }
        found.push(own);
    }
    found
}
