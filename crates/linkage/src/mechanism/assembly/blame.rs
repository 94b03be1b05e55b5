//! If a group cannot be placed, finds the earlier group whose wrong configuration is the cause, if there is one.

use super::{StartGroup, configurations, first_choices};
use crate::error::{Advice, Error, ErrorKind, ErrorSubject};
use crate::mechanism::{AssemblyMode, Group, GroupId, Mechanism, Structure};
use crate::sentences;

/// A group whose configuration makes it impossible to place a later group.
#[derive(Clone, Debug, PartialEq)]
pub struct Blame {
    /// Index, in [`Structure::at_start`], of the group to blame.
    pub group: GroupId,
    /// Number of the group's configuration, counted from 1, with which the later group can be placed.
    pub rank: usize,
    /// Assembly mode of this configuration.
    pub mode: AssemblyMode,
}

/// Index, in [`Structure::at_start`], of the group to which an error of [`first_choices`] refers.
#[must_use]
pub fn group_of(mechanism: &Mechanism, structure: &Structure, error: &Error) -> Option<GroupId> {
    match error.part() {
        Some(ErrorSubject::Group(names)) => structure.at_start().groups.find(|group| group.names(mechanism) == *names),
        Some(ErrorSubject::Link(_) | ErrorSubject::Joint(_)) | None => None,
    }
}

/// The earlier group that must change its configuration so that the group of `error` can be placed.
/// All other arguments must be the arguments of the call to [`first_choices`] that returned `error`.
///
/// An earlier group with approximate positions in the input is not blamed.
#[must_use]
pub fn blame(
    mechanism: &Mechanism,
    structure: &Structure,
    drive_angles: &[f64],
    wanted: &[StartGroup],
    error: &Error,
) -> Option<Blame> {
    let structure = structure.at_start();
    let failed = group_of(mechanism, structure, error).filter(|_| error.kind() == ErrorKind::Geometry)?;
    let before = |count: usize| structure.of_groups(structure.groups.ids().take(count));
    let part = before(failed.index() + 1);
    let mut own = wanted.to_vec();
    own[failed].near.clear();
    // `stands`: the failed group can be placed if its approximate positions are ignored.
    // An earlier group is then blamed only if another configuration of this earlier group brings the failed group
    // clearly nearer to its approximate positions.
    let stands = first_choices(mechanism, &part, drive_angles, &own).is_ok();
    let earlier = part.groups.entries().rev().filter(|(index, _)| *index < failed && wanted[*index].near.is_empty());
    for (index, group) in earlier {
        let Ok((pose, _)) = first_choices(mechanism, &before(index.index()), drive_angles, wanted) else { continue };
        let Ok(all) = configurations(mechanism, group, &pose) else { continue };
        for (number, one) in all.iter().enumerate() {
            let mut other = wanted.to_vec();
            other[index] = StartGroup { rank: Some(number + 1), ..StartGroup::default() };
            let Ok((_, choices)) = first_choices(mechanism, &part, drive_angles, &other) else { continue };
            let is_nearer = || clearly_nearer(mechanism, &part, drive_angles, wanted, choices[failed].nearest_m);
            if !stands || is_nearer() {
                return Some(Blame { group: index, rank: number + 1, mode: one.mode });
            }
        }
    }
    None
}

/// Whether a changed configuration of an earlier group clearly improves the fit of the last group.
/// After the change, the distance of the last group from its approximate positions is `found` (m).
/// The improvement is clear if `found` is less than half of the smallest distance without the change.
fn clearly_nearer(
    mechanism: &Mechanism,
    part: &Structure,
    drive_angles: &[f64],
    wanted: &[StartGroup],
    found: Option<f64>,
) -> bool {
    let last = part.groups.len() - 1;
    let before = part.of_groups(part.groups.ids().take(last));
    let group = part.groups.last().expect("the last is the one that failed");
    let least = first_choices(mechanism, &before, drive_angles, wanted)
        .and_then(|(pose, _)| configurations(mechanism, group, &pose))
        .map(|all| {
            let off = all.iter().map(|one| super::choice::distance(group, &wanted[last], one));
            off.fold(f64::INFINITY, crate::math::KeepNan::smaller)
        });
    matches!((found, least), (Some(found), Ok(least)) if 2.0 * found < least)
}

/// Rewrites `error` so that it names the group to blame.
/// The old message stays. The new message adds the configuration with which the later group can be placed.
pub fn blamed(mechanism: &Mechanism, structure: &Structure, blame: &Blame, error: &Error) -> Error {
    let (structure, names) = (structure.at_start(), |group: &Group| group.names(mechanism));
    let own = names(&structure.groups[blame.group]);
    let later = match error.part() {
        Some(ErrorSubject::Group(names) | ErrorSubject::Link(names) | ErrorSubject::Joint(names)) => names.clone(),
        None => String::new(),
    };
    let fits = match blame.mode {
        AssemblyMode::Followed | AssemblyMode::Only => format!("configuration {}", blame.rank),
        AssemblyMode::Left | AssemblyMode::Right | AssemblyMode::Ahead | AssemblyMode::Behind => {
            format!("mode \"{}\"", blame.mode.name())
        }
    };
    let message = sentences::this_configuration_of_the_group(&own, &later, &fits, &error.message());
    let give = sentences::of_the_group_or_check_the_lengths(&fits, &own, &later);
    Error::new(error.kind(), message)
        .help(Advice::Configuration { give })
        .key(structure.groups[blame.group].key(mechanism))
        .of_group(own)
}
