//! The structural formula: the driving links and the groups in the order in which they can be solved.

use super::{DrivingLink, Group, GroupKind, Structure, roman};
use crate::mechanism::{JointId, LinkId, Mechanism};

impl Structure {
    /// Structural formula, for example `I(ground, crank) -> II.2 RRR(coupler, rocker)`.
    #[must_use]
    pub fn formula(&self, mechanism: &Mechanism) -> String {
        let name = |link: LinkId| mechanism.links()[link].name.clone();
        let sort = |group: &Group| {
            let pairs = group.kind.letters().map_or_else(String::new, |letters| format!(" {letters}"));
            format!("{}.{}{pairs}", roman(group.class), group.order())
        };
        self.parts(mechanism, &name, ", ", sort).join(" -> ")
    }

    /// Structural formula with the numbers of the links in the order of the mechanism, 0 for the ground:
    /// `I(0,1) -> II(2,3)`.
    /// Pictures show the same numbers.
    #[must_use]
    pub fn numbered_formula(&self, mechanism: &Mechanism) -> String {
        self.numbered_parts(mechanism).join(" -> ")
    }

    /// The parts of [`Structure::numbered_formula`]: the driving links outside groups, then the groups.
    #[must_use]
    pub fn numbered_parts(&self, mechanism: &Mechanism) -> Vec<String> {
        self.parts(mechanism, &|link: LinkId| link.to_string(), ",", |group| roman(group.class))
    }

    /// Class of the mechanism: the highest class of its groups, 1 without groups (Artobolevsky).
    #[must_use]
    pub fn class(&self) -> usize {
        self.groups.iter().map(|group| group.class).fold(1, usize::max)
    }

    /// Whether every group is a dyad or a driven link, so that no group needs an iteration.
    #[must_use]
    pub fn is_chain_of_dyads(&self) -> bool {
        self.groups.iter().all(|group| group.kind != GroupKind::Higher)
    }

    /// One text for each driving link outside groups and for each group. `name` names a link, `between` separates
    /// names, `sort` states class and kind of a group.
    fn parts(
        &self,
        mechanism: &Mechanism,
        name: &dyn Fn(LinkId) -> String,
        between: &str,
        sort: impl Fn(&Group) -> String,
    ) -> Vec<String> {
        let driving = |link: LinkId, joint: JointId, moved: &str| {
            let base = mechanism.joints()[joint].other(link).link;
            format!("I({}{between}{moved})", name(base))
        };
        let leading = |driver: &DrivingLink| driving(driver.link, driver.joint, &name(driver.link));
        let of_group = |group: &Group| {
            let bodies = group.bodies_by(mechanism, name, between);
            if group.kind == GroupKind::Driven {
                let on = |&&link: &&LinkId| mechanism.joints()[group.outer[0]].on(link).is_some();
                let link = group.links.iter().find(on).expect("the outer joint is on the group");
                return driving(*link, group.outer[0], &bodies);
            }
            if !group.trains.is_empty() {
                return format!("train({bodies})");
            }
            format!("{}({bodies})", sort(group))
        };
        self.leading().map(|(_, driver)| leading(driver)).chain(self.groups.iter().map(of_group)).collect()
    }
}
