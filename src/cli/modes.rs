//! The configurations that `linkproof inspect --modes` lists.

use std::fmt::Write;

use serde_json::Value;

use crate::mechanism::AssemblyMode;
use crate::reference::modes::Mode;
use crate::scenario::Scenario;

/// Why a configuration has no angular velocities.
const SINGULAR: &str = "the configuration is singular: angular velocities are not determined";

/// As text.
pub(super) fn text(scenario: &Scenario, crank: f64, all: &[Vec<Mode>]) -> String {
    let mechanism = &scenario.case.mechanism;
    let mut text = String::new();
    let _ = writeln!(text, "{} at crank angle {:.4} deg", scenario.name, crank.to_degrees());
    for (group, modes) in scenario.case.structure.groups.iter().zip(all) {
        let _ = writeln!(text, "\n{}: {} real configurations", group.names(mechanism), modes.len());
        for (number, mode) in modes.iter().enumerate() {
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

/// As JSON.
pub(super) fn json(scenario: &Scenario, crank: f64, all: &[Vec<Mode>]) -> Value {
    let mechanism = &scenario.case.mechanism;
    let groups = scenario.case.structure.groups.iter().zip(all).map(|(group, modes)| {
        let modes = modes.iter().map(|mode| {
            let links = group.links.iter().zip(&mode.poses).enumerate().map(|(k, (&link, pose))| {
                let omega = mode.omegas.as_ref().map(|all| all[k]);
                let link = &mechanism.links()[link];
                let points = link.points.iter().map(|point| {
                    let at = pose.point(point.local);
                    serde_json::json!({"name": point.name, "x_m": at.x, "y_m": at.y})
                });
                serde_json::json!({"name": link.name, "angle_rad": pose.angle, "omega_rad_s": omega, "points": points.collect::<Vec<_>>()})
            });
            let mut value = serde_json::json!({"mode": mode.mode.name(), "followed": mode.is_followed, "links": links.collect::<Vec<_>>()});
            if mode.omegas.is_none() {
                value["omega_absent"] = SINGULAR.into();
            }
            value
        });
        serde_json::json!({"links": group.links.iter().map(|&l| mechanism.links()[l].name.as_str()).collect::<Vec<_>>(), "modes": modes.collect::<Vec<_>>()})
    });
    serde_json::json!({"crank_rad": crank, "groups": groups.collect::<Vec<_>>()})
}
