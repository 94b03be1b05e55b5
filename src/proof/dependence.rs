//! Which groups the number of a channel depends on: an error of another group does not reach it.

use linkage::case::Case;
use linkage::mechanism::Mechanism;
use linkage::trajectory::{Channel, Stage, Subject};

/// Sets of groups that channels depend on.
pub(super) struct Dependence {
    /// The different sets: indices of groups in ascending order.
    pub(super) sets: Vec<Vec<usize>>,
    /// The set of every channel, as an index.
    pub(super) of: Vec<usize>,
}

impl Dependence {
    /// A prescribed motion comes to a link through its own group and those before it. Forces, and a motion that they
    /// decide, depend on all groups.
    pub(super) fn of(case: &Case, channels: &[Channel]) -> Self {
        let all: Vec<usize> = (0..case.structure.groups.len()).collect();
        let upstream = case.structure.upstream(&case.mechanism);
        let mut found = Dependence { sets: Vec::new(), of: Vec::with_capacity(channels.len()) };
        for channel in channels {
            let set = match case.is_free() || channel.kind.stage >= Stage::Reactions {
                true => all.clone(),
                false => {
                    let links = links_of(&case.mechanism, channel).into_iter();
                    let mut set: Vec<usize> = links.flat_map(|link| upstream[link].iter().copied()).collect();
                    set.sort_unstable();
                    set.dedup();
                    set
                }
            };
            let known = found.sets.iter().position(|own| *own == set);
            found.of.push(known.unwrap_or(found.sets.len()));
            if known.is_none() {
                found.sets.push(set);
            }
        }
        found
    }

    /// Whether all that set `from` depends on is also what set `to` depends on.
    pub(super) fn feeds(&self, from: usize, to: usize) -> bool {
        let (from, to) = (&self.sets[from], &self.sets[to]);
        from.iter().all(|group| to.binary_search(group).is_ok())
    }
}

/// The links whose motion a channel of motion tells.
fn links_of(mechanism: &Mechanism, channel: &Channel) -> Vec<usize> {
    let known = "a channel of motion belongs to a part of its mechanism";
    match channel.kind.subject {
        Subject::Link => vec![mechanism.link_named(&channel.of).expect(known)],
        Subject::Point => {
            let mut points = mechanism.moving_points();
            vec![points.find(|(name, _)| *name == channel.of).expect(known).1.link]
        }
        Subject::Joint | Subject::Slider => {
            let joint = &mechanism.joints()[mechanism.joint_named(&channel.of).expect(known)];
            vec![joint.first.link, joint.second.link]
        }
        // None of them tells a motion.
        Subject::Frame | Subject::Drive | Subject::Motor => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::scenario::Scenario;
    use crate::solve;

    #[test]
    fn motions_depend_on_the_groups_before_and_forces_on_all() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/ov7_base.toml");
        let case = Scenario::load(&path).unwrap().case;
        let solved = solve(&case).unwrap();
        let found = Dependence::of(&case, solved.channels());
        let groups = case.structure.groups.len();
        assert!(groups > 1);
        let set = |name: &str| {
            let index = solved.channels().iter().position(|own| own.to_string() == name);
            found.sets[found.of[index.unwrap_or_else(|| panic!("{name}"))]].clone()
        };
        let (driving, _) = case.structure.drivers[0];
        let name = |link: usize| &case.mechanism.links()[link].name;
        assert!(set(&format!("link.{}.alpha_rad_s2", name(driving))).is_empty());
        for (index, group) in case.structure.groups.iter().enumerate() {
            let own = set(&format!("link.{}.alpha_rad_s2", name(group.links[0])));
            assert_eq!(own.last(), Some(&index), "{}", name(group.links[0]));
        }
        assert_eq!(set("drive.torque_N_m"), (0..groups).collect::<Vec<_>>());
    }
}
