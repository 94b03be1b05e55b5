//! Structural analysis: mobility and the decomposition into driving links and Assur groups.
//!
//! Every link has three freedoms, every revolute pair takes two and every drive one. The equations are given owners
//! among the links they touch, three to a link (a matching); a link then depends on the other link of every equation it
//! owns, and the strongly connected parts of that dependence are the driving links and the Assur groups, in the order in which
//! they can be solved. The parts do not depend on which matching was found (Dulmage and Mendelsohn 1958).

use petgraph::algo::tarjan_scc;
use petgraph::graph::{DiGraph, NodeIndex};

use super::{GROUND, JointKind, Mechanism};
use crate::error::{Error, ErrorKind, Result};

/// Sort of an Assur group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GroupKind {
    /// Dyad of two links and three revolute pairs: class II, order 2.
    Rrr,
    /// Any group of more than two links.
    Higher,
}

/// Assur group: a set of links that has no mobility once its outer joints are held.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// Its links, in the mechanism's order.
    pub links: Vec<usize>,
    /// Joints between two of its links.
    pub inner: Vec<usize>,
    /// Joints with links that are known before it is solved.
    pub outer: Vec<usize>,
    /// Class: 2 for dyads, else the number of sides of its highest closed contour (Artobolevsky).
    pub class: usize,
    /// Sort of the group.
    pub kind: GroupKind,
}

impl Group {
    /// Order: the number of outer joints.
    #[must_use]
    pub fn order(&self) -> usize {
        self.outer.len()
    }

    /// The group's outer joint on `link`, for a link that has exactly one.
    #[must_use]
    pub fn outer_on(&self, mechanism: &Mechanism, link: usize) -> Option<usize> {
        let mut found = self.outer.iter().copied().filter(|&joint| mechanism.joints()[joint].on(link).is_some());
        let first = found.next()?;
        found.next().is_none().then_some(first)
    }

    /// Letters of a dyad's pairs from outer over inner to outer ("RRR"); for higher groups the count of pairs.
    #[must_use]
    pub fn pairs(&self, mechanism: &Mechanism) -> String {
        let letter = |&joint: &usize| mechanism.joints()[joint].kind.letter();
        match self.kind {
            GroupKind::Rrr => [self.outer[0], self.inner[0], self.outer[1]].iter().map(letter).collect(),
            GroupKind::Higher => format!("{} inner and {} outer pairs", self.inner.len(), self.outer.len()),
        }
    }

    /// The group's links by name, for messages: `coupler, rocker`.
    #[must_use]
    pub fn names(&self, mechanism: &Mechanism) -> String {
        let names: Vec<&str> = self.links.iter().map(|&link| mechanism.links()[link].name.as_str()).collect();
        names.join(", ")
    }
}

/// Result of the structural analysis of a mechanism.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Structure {
    /// Mobility by Chebyshev-Gruebler, W = 3 n - 2 p (n moving links, p revolute pairs).
    pub mobility: i64,
    /// Driving links in the order in which they can be solved: (link, driven joint).
    pub drivers: Vec<(usize, usize)>,
    /// Assur groups in the order in which they can be solved.
    pub groups: Vec<Group>,
}

impl Structure {
    /// Analyses a mechanism driven at the joints `drives`.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if links hang free of the ground, if the mobility is not the number of drives, or if a part is
    /// over-constrained while another is free; [`ErrorKind::Unsupported`] if a drive does not act on a link hinged to the ground.
    pub fn of(mechanism: &Mechanism, drives: &[usize]) -> Result<Self> {
        check_connected(mechanism)?;
        let mobility = mobility(mechanism);
        if mobility != drives.len() as i64 {
            return Err(wrong_mobility(mechanism, mobility, drives.len()));
        }
        check_sparse(mechanism, drives)?;
        let owners = Owners::find(mechanism, drives)?;
        let mut structure = Structure { mobility, drivers: Vec::new(), groups: Vec::new() };
        let mut known = vec![false; mechanism.links().len()];
        known[GROUND] = true;
        for part in owners.parts(mechanism) {
            let solved = part.clone();
            let drive = drives
                .iter()
                .copied()
                .find(|&joint| owners.owner_of_drive(joint).is_some_and(|link| part.contains(&link)));
            match drive {
                None => structure.groups.push(group(mechanism, part, &known)),
                Some(joint) if part.len() == 1 && mechanism.joints()[joint].other(part[0]).link == GROUND => {
                    structure.drivers.push((part[0], joint));
                }
                Some(joint) => return Err(unsupported_drive(mechanism, joint)),
            }
            for link in solved {
                known[link] = true;
            }
        }
        Ok(structure)
    }

    /// Formula of structure, for example `I(ground, crank) -> II.2 RRR(coupler, rocker)`.
    #[must_use]
    pub fn formula(&self, mechanism: &Mechanism) -> String {
        const ROMAN: [&str; 9] = ["", "I", "II", "III", "IV", "V", "VI", "VII", "VIII"];
        let name = |&(link, _): &(usize, usize)| format!("I(ground, {})", mechanism.links()[link].name);
        let mut parts: Vec<String> = self.drivers.iter().map(name).collect();
        for group in &self.groups {
            let class = ROMAN.get(group.class).map_or_else(|| group.class.to_string(), ToString::to_string);
            let pairs = if group.kind == GroupKind::Higher { String::new() } else { group.pairs(mechanism) };
            let space = if pairs.is_empty() { "" } else { " " };
            parts.push(format!("{class}.{}{space}{pairs}({})", group.order(), group.names(mechanism)));
        }
        parts.join(" -> ")
    }
}

/// W = 3 n - 2 p.
fn mobility(mechanism: &Mechanism) -> i64 {
    let equations: usize = mechanism.joints().iter().map(|joint| joint.kind.equations()).sum();
    3 * (mechanism.links().len() as i64 - 1) - equations as i64
}

fn check_connected(mechanism: &Mechanism) -> Result<()> {
    let mut reached = vec![false; mechanism.links().len()];
    reached[GROUND] = true;
    while let Some(joint) = mechanism.joints().iter().find(|j| reached[j.first.link] != reached[j.second.link]) {
        reached[joint.first.link] = true;
        reached[joint.second.link] = true;
    }
    match reached.iter().position(|&is| !is) {
        None => Ok(()),
        Some(link) => {
            let name = &mechanism.links()[link].name;
            Err(Error::new(ErrorKind::Input, "the link is not connected to the ground by any chain of joints")
                .key(format!("links.{name}"))
                .help(format!("join \"{name}\" to another link, or take it out")))
        }
    }
}

fn wrong_mobility(mechanism: &Mechanism, mobility: i64, drives: usize) -> Error {
    let (n, p) = (mechanism.links().len() - 1, mechanism.joints().len());
    let help = if mobility > drives as i64 {
        "add the missing joints or drives, or take the loose links out"
    } else {
        "the mechanism is over-constrained: take out the joints or drives that are too many"
    };
    Error::new(
        ErrorKind::Input,
        format!("the mobility is W = 3*{n} - 2*{p} = {mobility}, but the number of drives is {drives}"),
    )
    .key("joints")
    .help(help)
}

fn unsupported_drive(mechanism: &Mechanism, joint: usize) -> Error {
    Error::new(
        ErrorKind::Unsupported,
        format!("the driven joint \"{}\" does not turn a link against the ground", mechanism.joints()[joint].name),
    )
    .key("drive.joint")
    .help("drive a link that is hinged to the ground by a revolute joint")
}

/// Every part of k links, the ground counted among them, may carry at most 3 k - 3 equations (Laman's condition for
/// plane bodies). Equivalent: with three more copies of any one equation, all equations still find owners among all links,
/// three to a link (Lee and Streinu, "Pebble game algorithms and sparse graphs", 2008).
fn check_sparse(mechanism: &Mechanism, drives: &[usize]) -> Result<()> {
    for (index, joint) in mechanism.joints().iter().enumerate() {
        let mut owners = Owners::unassigned(mechanism, drives, OWNED);
        let ends = [joint.first.link, joint.second.link];
        owners.add((0..3).map(|_| Equation { joint: index, of_drive: false, ends }));
        owners.assign_all(mechanism)?;
    }
    Ok(())
}

/// One scalar equation of a joint or of a drive, to be owned by one of the two links it touches.
struct Equation {
    joint: usize,
    of_drive: bool,
    ends: [usize; 2],
}

/// Equations that one link can own: as many as it has freedoms.
const OWNED: usize = 3;

/// Which link owns which equation.
struct Owners {
    equations: Vec<Equation>,
    owner: Vec<Option<usize>>,
    /// Equations that the ground can own.
    of_ground: usize,
}

impl Owners {
    /// The ground owns nothing: its pose is given.
    fn find(mechanism: &Mechanism, drives: &[usize]) -> Result<Self> {
        let mut owners = Owners::unassigned(mechanism, drives, 0);
        owners.assign_all(mechanism)?;
        Ok(owners)
    }

    fn unassigned(mechanism: &Mechanism, drives: &[usize], of_ground: usize) -> Self {
        let mut owners = Owners { equations: Vec::new(), owner: Vec::new(), of_ground };
        for (index, joint) in mechanism.joints().iter().enumerate() {
            let ends = [joint.first.link, joint.second.link];
            owners.add((0..joint.kind.equations()).map(|_| Equation { joint: index, of_drive: false, ends }));
            let driven = drives.iter().filter(|&&drive| drive == index);
            owners.add(driven.map(|_| Equation { joint: index, of_drive: true, ends }));
        }
        owners
    }

    fn add(&mut self, equations: impl Iterator<Item = Equation>) {
        self.equations.extend(equations);
        self.owner.resize(self.equations.len(), None);
    }

    fn assign_all(&mut self, mechanism: &Mechanism) -> Result<()> {
        for equation in 0..self.equations.len() {
            let mut visited = vec![false; mechanism.links().len()];
            if !self.assign(equation, &mut visited) {
                return Err(over_constrained(mechanism, &visited));
            }
        }
        Ok(())
    }

    /// Finds an owner for one equation, moving others along if need be (Kuhn's augmenting paths).
    fn assign(&mut self, equation: usize, visited: &mut [bool]) -> bool {
        for link in self.equations[equation].ends {
            let most = if link == GROUND { self.of_ground } else { OWNED };
            if most == 0 || visited[link] {
                continue;
            }
            visited[link] = true;
            let owned: Vec<usize> = (0..self.owner.len()).filter(|&e| self.owner[e] == Some(link)).collect();
            if owned.len() < most || owned.into_iter().any(|other| self.assign(other, visited)) {
                self.owner[equation] = Some(link);
                return true;
            }
        }
        false
    }

    fn owner_of_drive(&self, joint: usize) -> Option<usize> {
        let index = self.equations.iter().position(|equation| equation.of_drive && equation.joint == joint)?;
        self.owner[index]
    }

    /// The strongly connected parts, each sorted, in the order in which they can be solved.
    fn parts(&self, mechanism: &Mechanism) -> Vec<Vec<usize>> {
        let mut graph = DiGraph::<(), ()>::new();
        for _ in mechanism.links() {
            graph.add_node(());
        }
        for (equation, owner) in self.equations.iter().zip(&self.owner) {
            let owner = owner.expect("every equation has an owner");
            let other = if equation.ends[0] == owner { equation.ends[1] } else { equation.ends[0] };
            graph.update_edge(NodeIndex::new(owner), NodeIndex::new(other), ());
        }
        let mut parts: Vec<Vec<usize>> = tarjan_scc(&graph)
            .into_iter()
            .map(|part| part.into_iter().map(NodeIndex::index).collect())
            .filter(|part: &Vec<usize>| part[..] != [GROUND])
            .collect();
        parts.iter_mut().for_each(|part| part.sort_unstable());
        parts
    }
}

fn over_constrained(mechanism: &Mechanism, links: &[bool]) -> Error {
    let names: Vec<&str> =
        mechanism.links().iter().zip(links).filter(|&(_, &is)| is).map(|(link, _)| link.name.as_str()).collect();
    Error::new(
        ErrorKind::Input,
        format!("the links {} are over-constrained, while other links are free to move", names.join(", ")),
    )
    .key("joints")
    .help("the count of joints is right as a whole, but they are not where they are needed: move a joint")
}

/// The group of `links`, once all links marked in `known` are solved.
fn group(mechanism: &Mechanism, links: Vec<usize>, known: &[bool]) -> Group {
    let inside = |link: usize| links.contains(&link);
    let (mut inner, mut outer) = (Vec::new(), Vec::new());
    for (index, joint) in mechanism.joints().iter().enumerate() {
        let (a, b) = (joint.first.link, joint.second.link);
        if inside(a) && inside(b) {
            inner.push(index);
        } else if inside(a) && known[b] || inside(b) && known[a] {
            outer.push(index);
        }
    }
    // A dyad's outer joints stand in the order of its links.
    outer.sort_by_key(|&j| links.iter().position(|&link| mechanism.joints()[j].on(link).is_some()));
    let kind = if links.len() == 2 { GroupKind::Rrr } else { GroupKind::Higher };
    let mut group = Group { links, inner, outer, class: 2, kind };
    group.class = highest_contour(mechanism, &group);
    group
}

/// Number of sides of the highest closed contour of a group: a link with three or more pairs is a contour of as many
/// sides, and so is every shortest loop of inner joints.
fn highest_contour(mechanism: &Mechanism, group: &Group) -> usize {
    let joint = |&index: &usize| &mechanism.joints()[index];
    let pairs_on = |link: usize| group.inner.iter().map(joint).filter(|j| j.on(link).is_some()).count();
    let rigid = group.links.iter().map(|&link| pairs_on(link)).max().unwrap_or(0);
    let loops = group.inner.iter().filter_map(|&index| shortest_loop(mechanism, group, index)).max().unwrap_or(0);
    rigid.max(loops).max(2)
}

/// Number of links in the shortest loop of inner joints through the joint `through`, if there is one.
fn shortest_loop(mechanism: &Mechanism, group: &Group, through: usize) -> Option<usize> {
    debug_assert_eq!(mechanism.joints()[through].kind, JointKind::Revolute);
    let (start, goal) = (mechanism.joints()[through].first.link, mechanism.joints()[through].second.link);
    let mut layers = vec![(start, 1)];
    let mut next = 0;
    while let Some(&(link, length)) = layers.get(next) {
        if link == goal {
            return Some(length);
        }
        next += 1;
        for &index in group.inner.iter().filter(|&&index| index != through) {
            let joint = &mechanism.joints()[index];
            if joint.on(link).is_some() && !layers.iter().any(|&(seen, _)| seen == joint.other(link).link) {
                layers.push((joint.other(link).link, length + 1));
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanism::fixtures::{four_bar, link, mechanism};

    #[test]
    fn four_bar_is_a_crank_and_a_dyad() {
        let mechanism = four_bar();
        let structure = Structure::of(&mechanism, &[0]).unwrap();
        assert_eq!(structure.formula(&mechanism), "I(ground, crank) -> II.2 RRR(coupler, rocker)");
        assert_eq!(structure.mobility, 1);
        assert_eq!(
            (structure.groups[0].inner.as_slice(), structure.groups[0].outer.as_slice()),
            ([2].as_slice(), [1, 3].as_slice())
        );
    }

    #[test]
    fn the_same_chain_driven_at_the_other_pivot_turns_round() {
        let mechanism = four_bar();
        let structure = Structure::of(&mechanism, &[3]).unwrap();
        assert_eq!(structure.formula(&mechanism), "I(ground, rocker) -> II.2 RRR(crank, coupler)");
    }

    /// Crank and a base link on three leads, one of them the crank's: class III, order 3.
    fn triad() -> Mechanism {
        let links = vec![
            link("ground", &[("O", 0.0, 0.0), ("A", 3.0, 0.0), ("B", 0.0, 3.0)]),
            link("crank", &[("O", 0.0, 0.0), ("C", 1.0, 0.0)]),
            link("lead", &[("C", 0.0, 0.0), ("F", 1.0, 0.0)]),
            link("base", &[("D", 0.0, 0.0), ("E", 1.0, 0.0), ("F", 0.0, 1.0)]),
            link("left", &[("A", 0.0, 0.0), ("D", 1.0, 0.0)]),
            link("right", &[("B", 0.0, 0.0), ("E", 1.0, 0.0)]),
        ];
        let pins = [
            ("O", "O", "ground", "crank"),
            ("C", "C", "crank", "lead"),
            ("F", "F", "lead", "base"),
            ("D", "D", "base", "left"),
            ("E", "E", "base", "right"),
            ("A", "A", "ground", "left"),
            ("B", "B", "ground", "right"),
        ];
        mechanism(links, &pins).unwrap()
    }

    #[test]
    fn a_base_link_on_three_leads_is_class_three_order_three() {
        let mechanism = triad();
        let structure = Structure::of(&mechanism, &[0]).unwrap();
        assert_eq!(structure.formula(&mechanism), "I(ground, crank) -> III.3(lead, base, left, right)");
    }

    #[test]
    fn driving_a_lead_of_the_triad_lowers_the_class() {
        let mechanism = triad();
        let structure = Structure::of(&mechanism, &[5]).unwrap();
        assert_eq!(structure.formula(&mechanism), "I(ground, left) -> II.2 RRR(base, right) -> II.2 RRR(crank, lead)");
    }

    #[test]
    fn a_changeable_quadrilateral_is_class_four_order_two() {
        let links = vec![
            link("ground", &[("O", 0.0, 0.0), ("K", 8.5, -1.5)]),
            link("1", &[("O", 0.0, 0.0), ("A", 1.0, 0.0)]),
            link("2", &[("A", 0.0, 0.0), ("B", 3.0, 0.0), ("C", 1.5, 2.6)]),
            link("3", &[("B", 0.0, 0.0), ("D", 5.1, 0.0)]),
            link("4", &[("C", 0.0, 0.0), ("E", 4.0, 0.0)]),
            link("5", &[("K", 0.0, 0.0), ("D", 3.0, 0.0), ("E", 1.5, 2.6)]),
        ];
        let pins = [
            ("O", "O", "ground", "1"),
            ("A", "A", "1", "2"),
            ("B", "B", "2", "3"),
            ("C", "C", "2", "4"),
            ("D", "D", "3", "5"),
            ("E", "E", "4", "5"),
            ("K", "K", "ground", "5"),
        ];
        let mechanism = mechanism(links, &pins).unwrap();
        let structure = Structure::of(&mechanism, &[0]).unwrap();
        assert_eq!(structure.formula(&mechanism), "I(ground, 1) -> IV.2(2, 3, 4, 5)");
    }

    #[test]
    fn a_rigid_part_beside_a_loose_one_is_found_although_the_count_is_right() {
        let links = vec![
            link("ground", &[("O", 0.0, 0.0), ("P", 4.0, 0.0)]),
            link("crank", &[("O", 0.0, 0.0), ("A", 1.0, 0.0)]),
            link("coupler", &[("A", 0.0, 0.0), ("P", 4.0, 0.0)]),
            link("loose", &[("A", 0.0, 0.0)]),
        ];
        let pins = [
            ("O", "O", "ground", "crank"),
            ("A", "A", "crank", "coupler"),
            ("P", "P", "ground", "coupler"),
            ("A2", "A", "crank", "loose"),
        ];
        let mechanism = mechanism(links, &pins).unwrap();
        assert_eq!(mobility(&mechanism), 1);
        let error = Structure::of(&mechanism, &[0]).unwrap_err();
        assert!(error.to_string().contains("crank, coupler are over-constrained"), "{error}");
    }

    #[test]
    fn two_links_pinned_together_twice_are_over_constrained_and_no_dyad() {
        let links = vec![
            link("ground", &[("O", 0.0, 0.0)]),
            link("crank", &[("O", 0.0, 0.0), ("A", 1.0, 0.0)]),
            link("a", &[("A", 0.0, 0.0), ("P", 1.0, 0.0), ("Q", 0.0, 1.0)]),
            link("b", &[("P", 0.0, 0.0), ("Q", -1.0, 1.0)]),
        ];
        let pins =
            [("O", "O", "ground", "crank"), ("A", "A", "crank", "a"), ("P", "P", "a", "b"), ("Q", "Q", "a", "b")];
        let mechanism = mechanism(links, &pins).unwrap();
        assert_eq!(mobility(&mechanism), 1);
        let error = Structure::of(&mechanism, &[0]).unwrap_err();
        assert!(error.to_string().contains("a, b are over-constrained"), "{error}");
    }

    #[test]
    fn a_floating_part_with_one_joint_too_many_is_found() {
        // Four links in a square with a fifth as diagonal pin: 5 joints on 4 links is one equation more than 3*4 - 3.
        let corner = |a: &str, b: &str| -> Vec<(String, f64, f64)> { vec![(a.into(), 0.0, 0.0), (b.into(), 1.0, 0.0)] };
        let names = |points: &[(String, f64, f64)]| points.to_vec();
        let body = |name: &str, points: &[(String, f64, f64)]| {
            link(name, &points.iter().map(|(n, x, y)| (n.as_str(), *x, *y)).collect::<Vec<_>>())
        };
        let mut first = names(&corner("S", "P"));
        first.extend([("A".to_string(), 0.5, 0.5), ("X".to_string(), 2.0, 0.0)]);
        let mut third = names(&corner("Q", "R"));
        third.push(("X".to_string(), 3.0, 0.0));
        let links = vec![
            link("ground", &[("O", 0.0, 0.0)]),
            link("crank", &[("O", 0.0, 0.0), ("A", 1.0, 0.0)]),
            body("1", &first),
            body("2", &corner("P", "Q")),
            body("3", &third),
            body("4", &corner("R", "S")),
            link("loose", &[("A", 0.0, 0.0)]),
        ];
        let pins = [
            ("O", "O", "ground", "crank"),
            ("A", "A", "crank", "1"),
            ("P", "P", "1", "2"),
            ("Q", "Q", "2", "3"),
            ("R", "R", "3", "4"),
            ("S", "S", "4", "1"),
            ("X", "X", "1", "3"),
            ("A2", "A", "1", "loose"),
        ];
        let mechanism = mechanism(links, &pins).unwrap();
        let error = Structure::of(&mechanism, &[0, 1]).unwrap_err();
        assert!(error.to_string().contains("over-constrained"), "{error}");
        assert!(!error.to_string().contains("loose"), "{error}");
    }

    #[test]
    fn loose_links_and_missing_drives_are_refused() {
        let links = vec![link("ground", &[("O", 0.0, 0.0)]), link("a", &[("O", 0.0, 0.0)]), link("b", &[])];
        let alone = mechanism(links.clone(), &[("O", "O", "ground", "a")]).unwrap();
        assert!(Structure::of(&alone, &[0]).unwrap_err().to_string().contains("not connected to the ground"));
        let message = Structure::of(&four_bar(), &[]).unwrap_err().to_string();
        assert!(message.contains("W = 3*3 - 2*4 = 1, but the number of drives is 0"), "{message}");
    }
}
