//! First poses of changed cases, and cases in which a group has another configuration.

use super::cause::{CasePart, Change, PartChange};
use linkage::case::{Case, CaseParts};
use linkage::mechanism::assembly::{StartGroup, configurations, first_pose};
use linkage::mechanism::pose::SidePoint;
use linkage::mechanism::{AssemblyMode, JointSide, LinkId, LinkPose};

/// Reassembles the mechanism after a change of its lengths or of its drives' start angles.
/// Dyads keep their modes. Groups of a higher class stay as close as possible to their previous pose.
pub fn reassembled(parts: &mut CaseParts) -> Option<()> {
    let wanted = wanted(parts);
    assembled(parts, &wanted)
}

/// The conditions that keep every group in its configuration.
fn wanted(parts: &CaseParts) -> Vec<StartGroup> {
    let modes = parts.structure.modes_at_start(&parts.modes);
    let groups = parts.structure.at_start().groups.iter().zip(&modes);
    let of = |(group, mode): (&linkage::mechanism::Group, &AssemblyMode)| match mode {
        AssemblyMode::Left | AssemblyMode::Right | AssemblyMode::Ahead | AssemblyMode::Behind => {
            StartGroup { mode: Some(*mode), ..StartGroup::default() }
        }
        AssemblyMode::Only => StartGroup::default(),
        AssemblyMode::Followed => {
            let near = group.links.iter().flat_map(|&link| {
                let points = parts.mechanism.links()[link].points.iter();
                points.map(move |point| {
                    let side = JointSide { link, local: point.local };
                    (SidePoint { name: point.name.clone(), side }, parts.start.0[link].point(point.local))
                })
            });
            StartGroup { near: near.collect(), ..StartGroup::default() }
        }
    };
    groups.map(of).collect()
}

fn assembled(parts: &mut CaseParts, wanted: &[StartGroup]) -> Option<()> {
    let angles: Vec<f64> = parts.drives.iter().map(|drive| drive.coordinate(drive.start)).collect();
    (parts.start, parts.modes) = first_pose(&parts.mechanism, &parts.structure, &angles, wanted).ok()?;
    Some(())
}

/// All cases in which one group has another of its known configurations.
pub fn others(case: &Case) -> Vec<(Change, Case)> {
    let mut found = Vec::new();
    for (index, group) in case.structure.at_start().groups.entries() {
        // A group whose configurations are not all known is left out, such as a group of more than four links.
        let all = configurations(&case.mechanism, group, &case.start).unwrap_or_default();
        for (number, one) in all.iter().enumerate() {
            let same = |(&link, place): (&LinkId, &LinkPose)| {
                let own = &case.start.0[link];
                let turn = (place.angle - own.angle).sin().abs() + (1.0 - (place.angle - own.angle).cos());
                (place.origin - own.origin).norm() < 1e-6 * case.mechanism.size() && turn < 1e-6
            };
            if group.links.iter().zip(&one.links).all(same) {
                continue;
            }
            let mut parts = case.clone().into_parts();
            let mut wanted = wanted(&parts);
            wanted[index] = StartGroup { rank: Some(number + 1), ..StartGroup::default() };
            let other = assembled(&mut parts, &wanted).and_then(|()| Case::new(parts).ok());
            let how = match one.mode {
                AssemblyMode::Followed => PartChange::Other(format!("number {}", number + 1)),
                mode @ (AssemblyMode::Left
                | AssemblyMode::Right
                | AssemblyMode::Ahead
                | AssemblyMode::Behind
                | AssemblyMode::Only) => PartChange::Other(mode.name().into()),
            };
            let part = CasePart::Configuration(group.names(&case.mechanism));
            found.extend(other.map(|other| (Change { part, how }, other)));
        }
    }
    found
}
