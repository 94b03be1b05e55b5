//! Chooses the configuration of a group at the start.
//! The input specifies the configuration by mode, number or approximate positions.

use super::configurations::configurations;
use super::fused::Fused;
use super::mode::{AssemblyMode, Configuration, ConfigurationChoice, StartGroup};
use super::{four_link, rough};
use crate::error::{Advice, Error, ErrorKind, Result};
use crate::math::KeepNan;
use crate::mechanism::{Group, GroupKind, LinkPose, Mechanism, Pose};
use crate::sentences;

/// Places the links of a group in the required configuration.
pub(super) fn place(
    mechanism: &Mechanism,
    group: &Group,
    wanted: &StartGroup,
    pose: &mut Pose,
) -> Result<ConfigurationChoice> {
    if !group.is_rigid() && group.kind != GroupKind::Driven {
        let fused = Fused::of(mechanism, group, pose);
        let choice = place(&fused.mechanism, &fused.group, &fused.wanted(wanted), pose)?;
        let leads: Vec<LinkPose> = fused.group.links.iter().map(|&link| pose.0[link]).collect();
        for (&link, place) in group.links.iter().zip(fused.expanded(&leads)) {
            pose.0[link] = place;
        }
        return Ok(choice);
    }
    let all_known = group.kind != GroupKind::Higher || four_link::Layout::of(mechanism, group, pose).is_some();
    if !all_known && wanted.rank.is_none() && !wanted.near.is_empty() {
        return rough::place(mechanism, group, &wanted.near, pose);
    }
    let all = configurations(mechanism, group, pose)?;
    let (chosen, nearest_m, next_m) = choose(mechanism, group, wanted, &all)?;
    for (&link, &place) in group.links.iter().zip(&chosen.links) {
        pose.0[link] = place;
    }
    Ok(ConfigurationChoice { mode: chosen.mode, nearest_m, next_m })
}

fn choose<'a>(
    mechanism: &Mechanism,
    group: &Group,
    wanted: &StartGroup,
    all: &'a [Configuration],
) -> Result<(&'a Configuration, Option<f64>, Option<f64>)> {
    if let Some(rank) = wanted.rank {
        return match rank.checked_sub(1).and_then(|index| all.get(index)) {
            Some(one) => Ok((one, None, None)),
            None => Err(out_of_range(rank, all.len())),
        };
    }
    if !wanted.near.is_empty() {
        let (nearest, first, next) = nearest(mechanism, group, wanted, all)?;
        return match wanted.mode {
            Some(mode) if mode != nearest.mode => Err(contradiction(wanted, mode)),
            _ => Ok((nearest, Some(first), next)),
        };
    }
    let only = all.iter().find(|one| one.mode == AssemblyMode::Only);
    let asked = only.or_else(|| all.iter().find(|one| Some(one.mode) == wanted.mode));
    asked.map(|one| (one, None, None)).ok_or_else(|| nothing_asked(group))
}

fn out_of_range(rank: usize, count: usize) -> Error {
    let message = match count {
        1 => sentences::configuration_is_asked_for_but_the_group_has_here(&rank),
        _ => sentences::configuration_is_asked_for_but_the_group(&rank, &count),
    };
    Error::new(ErrorKind::Input, message).help(Advice::Configuration { give: sentences::a_number_from_to(&count) })
}

fn nothing_asked(group: &Group) -> Error {
    let near = "`near = { point = \"...\", x_mm = ..., y_mm = ... }`";
    match group.kind.modes() {
        Some([one, other]) => Error::new(ErrorKind::Input, sentences::NEITHER_AN_ASSEMBLY_MODE_NOR)
            .help(sentences::add_mode_or_mode_or(&one.name(), &other.name(), &near)),
        None => {
            Error::new(ErrorKind::Input, sentences::NO_ROUGH_PLACE_IS_GIVEN_FOR_THIS_GROUP).help(format!("add {near}"))
        }
    }
}

/// Subject of a sentence about the approximate positions: `the approximate position of point "B" is`, or `the
/// approximate positions of points "B" and "C" are`.
fn rough_places(wanted: &StartGroup) -> String {
    let names: Vec<String> = wanted.near.iter().map(|(point, _)| format!("\"{}\"", point.name)).collect();
    match &names[..] {
        [one] => sentences::the_rough_place_of_point(&one),
        [first @ .., last] => sentences::the_rough_places_of_points(&first.join(", "), &last),
        [] => sentences::THE_ROUGH_PLACE_IS.into(),
    }
}

fn contradiction(wanted: &StartGroup, mode: AssemblyMode) -> Error {
    let message = sentences::nearer_to_another_configuration_than_to_mode(&rough_places(wanted), &mode.name());
    Error::new(ErrorKind::Geometry, message).help(sentences::CORRECT_THE_MODE_OR_THE_ROUGH)
}

/// Largest distance of a configuration's points from their approximate positions (m).
pub(super) fn distance(group: &Group, wanted: &StartGroup, one: &Configuration) -> f64 {
    let distances = wanted.near.iter().map(|(point, guess)| {
        let index = group.links.iter().position(|&link| link == point.side.link);
        let links = &one.links[index.expect("the point is on a link of the group")];
        (links.point(point.side.local) - guess).norm()
    });
    distances.fold(0.0, f64::larger)
}

/// The configuration nearest to the approximate positions, its distance from these positions (m), and the distance of
/// the second nearest configuration (m).
/// The distance of a configuration is the largest distance between a point and the point's approximate position.
fn nearest<'a>(
    mechanism: &Mechanism,
    group: &Group,
    wanted: &StartGroup,
    all: &'a [Configuration],
) -> Result<(&'a Configuration, f64, Option<f64>)> {
    let mut order: Vec<(f64, &Configuration)> = all.iter().map(|one| (distance(group, wanted, one), one)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    // The second nearest configuration must be at least twice as far away as the nearest configuration.
    // The distance of the nearest configuration must not exceed the size of the mechanism.
    if let [(first, a), (second, b), ..] = order[..]
        && 2.0 * first > second
    {
        let (places, a, b) = (rough_places(wanted), named(a.mode, "nearest"), named(b.mode, "next"));
        let message = sentences::from_the_and_from_the_configuration(&places, &first, &a, &second, &b);
        let help = Advice::Configuration { give: sentences::A_PLACE_NEARER_TO_THE_CONFIGURATION.into() };
        return Err(Error::new(ErrorKind::Geometry, message).help(help));
    }
    let next = order.get(1).map(|&(distance, _)| distance);
    match order[..] {
        [(first, one), ..] if first <= mechanism.size() => Ok((one, first, next)),
        [(first, _), ..] => {
            let message = sentences::from_the_nearest_configuration_farther(&rough_places(wanted), &first);
            Err(Error::new(ErrorKind::Geometry, message).help(sentences::CHECK_ITS_COORDINATES_AND_THEIR))
        }
        [] => unreachable!("a group without configurations is an error before"),
    }
}

/// The name of a dyad's mode. The configurations of higher groups have no names. For higher groups, `rank` is returned.
fn named(mode: AssemblyMode, rank: &'static str) -> &'static str {
    if mode == AssemblyMode::Followed { rank } else { mode.name() }
}
