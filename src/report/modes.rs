//! All real configurations of the groups at one crank angle.

use crate::sentences;
use serde_json::{Value, json};

use super::pretty::list;
use analytic::modes::Modes;
use linkage::mechanism::{AssemblyMode, GroupId, Link, LinkPose};
use prover::numbers::{fixed, input_told};
use scenario::{Scenario, Undecided};

/// Why a configuration has no angular velocities.
const SINGULAR: &str = sentences::THE_CONFIGURATION_IS_SINGULAR_ANGULAR;

/// Note beside the list of a group, if the scenario leaves this group or an earlier group undecided.
enum Open<'a> {
    /// The reason why the group is undecided.
    Undecided(&'a str),
    /// The list depends on an earlier, undecided group: that group, and the number of its assumed configuration.
    After(String, usize),
}

/// The note beside the list of the group `index`; `None` if neither this group nor an earlier group is undecided.
fn open<'a>(scenario: &Scenario, all: &[Modes], undecided: &'a [Undecided], index: GroupId) -> Option<Open<'a>> {
    if let Some(own) = undecided.iter().find(|other| other.group == index) {
        return Some(Open::Undecided(own.why.message()));
    }
    let before = undecided.iter().find(|other| other.group < index)?;
    let names = scenario.case.structure.groups[before.group].names(&scenario.case.mechanism);
    let number = all[before.group].modes.iter().position(|mode| mode.is_followed).map_or(1, |place| place + 1);
    Some(Open::After(names, number))
}

/// The configurations as text.
/// `undecided` has the groups whose configuration the scenario does not determine.
pub(crate) fn text(scenario: &Scenario, crank: f64, all: &[Modes], undecided: &[Undecided]) -> String {
    let mechanism = &scenario.case.mechanism;
    let mut text = sentences::scenario_at(&scenario.name, &input_told(scenario.case.told(crank), 4));
    for ((index, group), found) in scenario.case.structure.groups.entries().zip(all) {
        let names = group.names(mechanism);
        let open = open(scenario, all, undecided, index);
        match &found.unknown {
            None => say!(text, sentences::real_configurations(&names, &found.modes.len())),
            Some(why) => say!(text, sentences::only_the_followed_one_is_shown(&names, &why)),
        };
        match &open {
            None => {}
            Some(Open::Undecided(why)) => say!(text, sentences::not_decided_by_the_scenario(&why)),
            Some(Open::After(names, number)) => say!(text, sentences::for_configuration_of(&number, &names)),
        };
        for (number, mode) in found.modes.iter().enumerate() {
            let name = (mode.mode != AssemblyMode::Followed).then(|| format!(", {}", mode.mode.name()));
            let followed = if mode.is_followed && open.is_none() { sentences::FOLLOWED_BY_THE_SCENARIO } else { "" };
            say!(text, "  {}{}{followed}", number + 1, name.unwrap_or_default());
            for (k, (&link, pose)) in group.links.iter().zip(&mode.poses).enumerate() {
                let omega = mode.omegas.as_ref().map(|all| format!("{:>12} rad/s", fixed(all[k], 5)));
                let omega = omega.unwrap_or_else(|| "singular".into());
                let link = &mechanism.links()[link];
                let angle = fixed(pose.angle.to_degrees(), 5);
                say!(text, "    {:14} {angle:>11} deg {omega:<18}   {} m", link.name, points_text(link, pose));
            }
        }
    }
    text
}

/// Names and world positions of the points of a link.
pub(super) fn points_text(link: &Link, pose: &LinkPose) -> String {
    let points = link.points.iter().map(|point| {
        let at = pose.point(point.local);
        format!("{} ({}, {})", point.name, fixed(at.x, 6), fixed(at.y, 6))
    });
    points.collect::<Vec<_>>().join(", ")
}

/// Names and world positions of the points of a link as JSON.
pub(super) fn points_json(link: &Link, pose: &LinkPose) -> Value {
    list(&link.points, |point| {
        let at = pose.point(point.local);
        json!({"name": point.name, "x_m": at.x, "y_m": at.y})
    })
}

/// The configurations as JSON.
pub(super) fn json(scenario: &Scenario, crank: f64, all: &[Modes], undecided: &[Undecided]) -> Value {
    let mechanism = &scenario.case.mechanism;
    let groups = scenario.case.structure.groups.entries().zip(all);
    let groups = list(groups, |((index, group), found)| {
        let open = open(scenario, all, undecided, index);
        let modes = list(&found.modes, |mode| {
            let links = list(group.links.iter().zip(&mode.poses).enumerate(), |(k, (&link, pose))| {
                let link = &mechanism.links()[link];
                let points = points_json(link, pose);
                let omega = mode.omegas.as_ref().map(|all| all[k]);
                json!({"name": link.name, "angle_rad": pose.angle, "omega_rad_s": omega, "points": points})
            });
            let followed = mode.is_followed && open.is_none();
            let mut value = json!({"mode": mode.mode.name(), "followed": followed, "links": links});
            if mode.omegas.is_none() {
                value["omega_absent"] = SINGULAR.into();
            }
            value
        });
        let links = list(&group.links, |&link| mechanism.links()[link].name.as_str().into());
        let mut value = json!({"links": links, "all_known": found.unknown.is_none(), "modes": modes});
        if let Some(why) = &found.unknown {
            value["others_absent"] = why.as_str().into();
        }
        match open {
            None => {}
            Some(Open::Undecided(why)) => value["undecided"] = why.into(),
            Some(Open::After(names, number)) => {
                value["for_configuration"] = json!({"group": names, "number": number});
            }
        }
        value
    });
    json!({scenario.case.crank().input.key(): crank, "groups": groups})
}
