//! All real configurations of the groups at one crank angle.

use std::fmt::Write;

use serde_json::{Value, json};

use crate::scenario::Scenario;
use analytic::modes::Modes;
use linkage::mechanism::AssemblyMode;

/// Why a configuration has no angular velocities.
const SINGULAR: &str = "the configuration is singular: angular velocities are not determined";

/// The configurations as text.
pub(crate) fn text(scenario: &Scenario, crank: f64, all: &[Modes]) -> String {
    let mechanism = &scenario.case.mechanism;
    let mut text = String::new();
    let _ = writeln!(text, "{} at crank angle {:.4} deg", scenario.name, crank.to_degrees());
    for (group, found) in scenario.case.structure.groups.iter().zip(all) {
        let names = group.names(mechanism);
        let _ = match &found.unknown {
            None => writeln!(text, "\n{names}: {} real configurations", found.modes.len()),
            Some(why) => writeln!(text, "\n{names}: only the followed one is shown; {why}"),
        };
        for (number, mode) in found.modes.iter().enumerate() {
            let name =
                if mode.mode == AssemblyMode::Followed { String::new() } else { format!(", {}", mode.mode.name()) };
            let followed = if mode.is_followed { ", followed by the scenario" } else { "" };
            let _ = writeln!(text, "  {}{name}{followed}", number + 1);
            for (k, (&link, pose)) in group.links.iter().zip(&mode.poses).enumerate() {
                let omega =
                    mode.omegas.as_ref().map_or_else(|| "singular".into(), |all| format!("{:>12.5} rad/s", all[k]));
                let link = &mechanism.links()[link];
                let points = link.points.iter().map(|point| {
                    let at = pose.point(point.local);
                    format!("{} ({:.6}, {:.6})", point.name, at.x, at.y)
                });
                let points: Vec<String> = points.collect();
                let angle = pose.angle.to_degrees();
                let _ = writeln!(text, "    {:14} {angle:>11.5} deg {omega:<18}   {} m", link.name, points.join(", "));
            }
        }
    }
    text
}

/// The configurations as JSON.
pub(super) fn json(scenario: &Scenario, crank: f64, all: &[Modes]) -> Value {
    let mechanism = &scenario.case.mechanism;
    let groups = scenario.case.structure.groups.iter().zip(all).map(|(group, found)| {
        let modes = found.modes.iter().map(|mode| {
            let links = group.links.iter().zip(&mode.poses).enumerate().map(|(k, (&link, pose))| {
                let omega = mode.omegas.as_ref().map(|all| all[k]);
                let link = &mechanism.links()[link];
                let points = link.points.iter().map(|point| {
                    let at = pose.point(point.local);
                    json!({"name": point.name, "x_m": at.x, "y_m": at.y})
                });
                json!({"name": link.name, "angle_rad": pose.angle, "omega_rad_s": omega, "points": points.collect::<Vec<_>>()})
            });
            let mut value = json!({"mode": mode.mode.name(), "followed": mode.is_followed, "links": links.collect::<Vec<_>>()});
            if mode.omegas.is_none() {
                value["omega_absent"] = SINGULAR.into();
            }
            value
        });
        let links: Vec<&str> = group.links.iter().map(|&l| mechanism.links()[l].name.as_str()).collect();
        let mut value = json!({"links": links, "all_known": found.unknown.is_none(), "modes": modes.collect::<Vec<_>>()});
        if let Some(why) = &found.unknown {
            value["others_absent"] = why.as_str().into();
        }
        value
    });
    json!({"crank_rad": crank, "groups": groups.collect::<Vec<_>>()})
}
