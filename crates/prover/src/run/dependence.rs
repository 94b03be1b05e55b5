//! The groups that a channel depends on. Errors in all other groups do not affect the channel.
//! See docs/numerics/bounds.md.

use std::collections::BTreeMap;

use linkage::case::{Case, Seat};
use linkage::mechanism::{GroupId, LinkId, Mechanism, PerLink, Structure};
use linkage::trajectory::{Channel, Stage};

/// Sets of groups that channels depend on.
pub(super) struct Dependence {
    /// The distinct sets. Each set is a list of group indices in ascending order.
    pub(super) sets: Vec<Vec<GroupId>>,
    /// For every channel, the index of its set.
    pub(super) of: Vec<usize>,
    /// For every set, the last groups. The last groups determine the set, because they depend on all other groups of
    /// the set.
    tops: Vec<Vec<GroupId>>,
}

impl Dependence {
    /// Determines the groups that each channel depends on.
    /// In a prescribed motion, a link depends on its own group and on the groups before it.
    /// Forces depend on all groups. A motion that forces determine depends on all groups too.
    pub(super) fn of(case: &Case, channels: &[Channel]) -> Self {
        let all: Vec<GroupId> = case.structure.groups.ids().collect();
        let upstream = case.structure.upstream(&case.mechanism);
        let mut found = Dependence { sets: Vec::new(), of: Vec::with_capacity(channels.len()), tops: Vec::new() };
        let seats = case.seats();
        // Maps the last groups of a set to the index of the set, so that each set is determined only once.
        let mut known: BTreeMap<Vec<GroupId>, usize> = BTreeMap::new();
        for channel in channels {
            // The link's group is the last of the groups that the link depends on, so this group determines the set.
            let tops = match case.is_free() || channel.kind.stage >= Stage::Reactions {
                true => all.clone(),
                false => {
                    let links = links_of(&case.mechanism, seats.of(channel));
                    links.iter().filter_map(|&link| upstream[link].last().copied()).collect()
                }
            };
            let index = *known.entry(tops).or_insert_with_key(|tops| {
                let set = if *tops == all { all.clone() } else { joined(&case.structure, &upstream, tops) };
                let same = found.sets.iter().position(|own| *own == set);
                same.unwrap_or_else(|| {
                    found.sets.push(set);
                    found.tops.push(tops.clone());
                    found.sets.len() - 1
                })
            });
            found.of.push(index);
        }
        found
    }

    /// Whether set `to` contains all groups of set `from`.
    pub(super) fn feeds(&self, from: usize, to: usize) -> bool {
        let (from, to) = (&self.tops[from], &self.sets[to]);
        from.iter().all(|group| to.binary_search(group).is_ok())
    }
}

/// The groups `tops` and all groups that they depend on, in ascending order.
fn joined(structure: &Structure, upstream: &PerLink<Vec<GroupId>>, tops: &[GroupId]) -> Vec<GroupId> {
    let of = |&top: &GroupId| upstream[structure.groups[top].links[0]].iter().copied();
    let mut set: Vec<GroupId> = tops.iter().flat_map(of).collect();
    set.sort_unstable();
    set.dedup();
    set
}

/// The links whose motion a motion channel describes.
fn links_of(mechanism: &Mechanism, seat: Option<Seat>) -> Vec<LinkId> {
    match seat {
        Some(Seat::Link(link)) => vec![link],
        Some(Seat::Point(side)) => vec![side.link],
        Some(Seat::Joint(joint)) => {
            let joint = &mechanism.joints()[joint];
            vec![joint.first.link, joint.second.link]
        }
        // Channels of these kinds do not describe a motion.
        Some(Seat::Frame | Seat::Drive(_) | Seat::Transmission(_)) | None => Vec::new(),
    }
}

#[cfg(test)]
mod tests {

    use super::*;
    use crate::run::solve;
    use fixtures::of_repository;

    #[test]
    fn motions_depend_on_earlier_groups_and_forces_on_all() {
        let case = of_repository("scenarios/ov7_base.toml").case;
        let solved = solve(&case).unwrap();
        let found = Dependence::of(&case, solved.channels());
        let groups = case.structure.groups.len();
        assert!(groups > 1);
        let set = |name: &str| {
            let index = solved.channels().iter().position(|own| own.to_string() == name);
            found.sets[found.of[index.unwrap_or_else(|| panic!("{name}"))]].clone()
        };
        let driving = case.structure.drivers[0].link;
        let name = |link: LinkId| &case.mechanism.links()[link].name;
        assert!(set(&format!("link.{}.alpha_rad_s2", name(driving))).is_empty());
        for (index, group) in case.structure.groups.entries() {
            let own = set(&format!("link.{}.alpha_rad_s2", name(group.links[0])));
            assert_eq!(own.last(), Some(&index), "{}", name(group.links[0]));
        }
        assert_eq!(set("drive.torque_N_m"), (0..groups).map(GroupId).collect::<Vec<_>>());
        // The last groups of a set must give the same answer as all groups of the set.
        let (sets, count) = (&found.sets, found.sets.len());
        assert!(count > 2);
        for (from, to) in (0..count).flat_map(|from| (0..count).map(move |to| (from, to))) {
            let all = sets[from].iter().all(|group| sets[to].contains(group));
            assert_eq!(found.feeds(from, to), all, "{:?} {:?}", sets[from], sets[to]);
        }
    }
}
