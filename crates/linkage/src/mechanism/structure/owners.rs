//! Ownership of equations. An equation of a joint or drive concerns two links; an equation of a transmission concerns
//! three links. Each equation is owned by one of its links. Each moving link owns three equations.

use crate::sentences;
use petgraph::algo::tarjan_scc;
use petgraph::graph::{DiGraph, NodeIndex};

use crate::error::{Error, ErrorKind, Result};
use crate::mechanism::{DrivenJoint, GROUND, JointId, LinkId, Mechanism, TransmissionId};

/// Checks Laman's condition for plane bodies: the joints and drives among k links, the ground included, have at most
/// 3 k - 3 equations.
/// The function tests an equivalent condition for each joint in turn. The test adds three copies of one of the joint's
/// equations.
/// All equations, the copies included, must still find owners. No link, the ground included, may own more than three
/// equations.
/// Source: Lee and Streinu, "Pebble game algorithms and sparse graphs", 2008.
pub(super) fn check_sparse(mechanism: &Mechanism, drives: &[DrivenJoint]) -> Result<()> {
    let mut owners = Owners::unassigned(mechanism, drives, OWNED);
    // A transmission concerns three links, so the condition does not apply to it.
    owners.equations.retain(|equation| !matches!(equation.of, Source::Transmission(_)));
    owners.assign_all(mechanism)?;
    let count = owners.equations.len();
    for (index, joint) in mechanism.joints().entries() {
        let ends = [joint.first.link, joint.second.link];
        owners.add((0..3).map(|_| Equation { of: Source::Joint(index), ends: joined(ends) }));
        owners.assign_from(count, mechanism)?;
        // The search may have moved equations of the mechanism to new owners. These equations keep their new owners
        // when the copies are removed, so every equation of the mechanism still has an owner.
        owners.keep(count);
    }
    Ok(())
}

/// What an equation describes.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Source {
    Joint(JointId),
    Drive(JointId),
    Transmission(TransmissionId),
}

/// One scalar equation and the links that it concerns. One of these links owns the equation.
#[derive(Clone, Copy)]
struct Equation {
    of: Source,
    ends: [LinkId; 3],
}

/// The links of a joint's equation; the second link is repeated to fill the array.
fn joined([first, second]: [LinkId; 2]) -> [LinkId; 3] {
    [first, second, second]
}

/// Number of equations that one link can own: its degrees of freedom.
const OWNED: usize = 3;

/// The owner of each equation.
pub(super) struct Owners {
    equations: Vec<Equation>,
    owner: Vec<Option<LinkId>>,
    /// The equations that each link owns.
    owned: Vec<Vec<usize>>,
    /// Number of equations that the ground can own.
    of_ground: usize,
}

impl Owners {
    /// Finds owners. The ground owns nothing, because its pose is given.
    pub(super) fn find(mechanism: &Mechanism, drives: &[DrivenJoint]) -> Result<Self> {
        let mut owners = Owners::unassigned(mechanism, drives, 0);
        owners.assign_all(mechanism)?;
        Ok(owners)
    }

    fn unassigned(mechanism: &Mechanism, drives: &[DrivenJoint], of_ground: usize) -> Self {
        let owned = vec![Vec::new(); mechanism.links().len()];
        let mut owners = Owners { equations: Vec::new(), owner: Vec::new(), owned, of_ground };
        for (index, joint) in mechanism.joints().entries() {
            let ends = [joint.first.link, joint.second.link];
            let ends = joined(ends);
            owners.add((0..joint.kind.equations()).map(|_| Equation { of: Source::Joint(index), ends }));
            let driven = drives.iter().filter(|drive| drive.joint == index);
            owners.add(driven.map(|_| Equation { of: Source::Drive(index), ends }));
        }
        let coupled = mechanism.transmissions().entries();
        owners.add(coupled.map(|(id, own)| Equation { of: Source::Transmission(id), ends: own.links() }));
        owners
    }

    fn add(&mut self, equations: impl Iterator<Item = Equation>) {
        self.equations.extend(equations);
        self.owner.resize(self.equations.len(), None);
    }

    fn assign_all(&mut self, mechanism: &Mechanism) -> Result<()> {
        self.assign_from(0, mechanism)
    }

    /// Finds owners for the equations with index `first` and above. These equations have no owners yet.
    fn assign_from(&mut self, first: usize, mechanism: &Mechanism) -> Result<()> {
        let mut visited = vec![false; mechanism.links().len()];
        for equation in first..self.equations.len() {
            visited.fill(false);
            if !self.assign(equation, &mut visited) {
                return Err(over_constrained(mechanism, &visited));
            }
        }
        Ok(())
    }

    /// Keeps the first `count` equations and removes all later equations.
    fn keep(&mut self, count: usize) {
        for equation in count..self.equations.len() {
            if let Some(link) = self.owner[equation] {
                self.owned[link].retain(|&own| own != equation);
            }
        }
        self.equations.truncate(count);
        self.owner.truncate(count);
    }

    /// Finds an owner for one equation. Moves already owned equations to new owners if necessary (Kuhn's augmenting
    /// paths).
    fn assign(&mut self, equation: usize, visited: &mut [bool]) -> bool {
        for link in self.equations[equation].ends {
            let most = if link == GROUND { self.of_ground } else { OWNED };
            if most == 0 || visited[link] {
                continue;
            }
            visited[link] = true;
            let owned = self.owned[link].clone();
            if owned.len() < most || owned.into_iter().any(|other| self.assign(other, visited)) {
                if let Some(former) = self.owner[equation].replace(link) {
                    self.owned[former].retain(|&own| own != equation);
                }
                self.owned[link].push(equation);
                return true;
            }
        }
        false
    }

    pub(super) fn owner_of(&self, of: Source) -> Option<LinkId> {
        let index = self.equations.iter().position(|equation| equation.of == of)?;
        self.owner[index]
    }

    /// The strongly connected components of the graph of dependences between links, in the order in which they can be
    /// solved.
    /// The links of each component are sorted.
    pub(super) fn parts(&self, mechanism: &Mechanism) -> Vec<Vec<LinkId>> {
        let mut graph = DiGraph::<(), ()>::new();
        for _ in mechanism.links() {
            graph.add_node(());
        }
        for (equation, owner) in self.equations.iter().zip(&self.owner) {
            let owner = owner.expect("every equation has an owner");
            for other in equation.ends.into_iter().filter(|&other| other != owner) {
                graph.update_edge(NodeIndex::new(owner.index()), NodeIndex::new(other.index()), ());
            }
        }
        let mut parts: Vec<Vec<LinkId>> = tarjan_scc(&graph)
            .into_iter()
            .map(|part| part.into_iter().map(|node| LinkId(node.index())).collect())
            .filter(|part: &Vec<LinkId>| part[..] != [GROUND])
            .collect();
        parts.iter_mut().for_each(|part| part.sort_unstable());
        parts
    }
}

fn over_constrained(mechanism: &Mechanism, links: &[bool]) -> Error {
    let names: Vec<&str> =
        mechanism.links().iter().zip(links).filter(|&(_, &is)| is).map(|(link, _)| link.name.as_str()).collect();
    Error::new(ErrorKind::Input, sentences::the_links_are_over_constrained(&names.join(", ")))
        .key("joints")
        .help(sentences::THE_COUNT_OF_JOINTS_IS_RIGHT)
}
