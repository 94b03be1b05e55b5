//! A joint between two links: its points of action, and the forces and moments that it transmits in the spanning tree.

use linkage::case::Case;
use linkage::math::{Vec2, cross, turned};
use linkage::mechanism::{JointId, JointKind, JointSide, LinkId};
use linkage::solver::State;

/// Number of components of a pin or a slide. Two equations determine the components of a cut joint.
pub(super) const PAIR: usize = 2;

/// A joint between two links.
#[derive(Clone, Debug)]
pub(super) struct Seam {
    pub(super) joint: JointId,
    /// The two links, and their indices in the tree (`None` for the ground).
    pub(super) links: [LinkId; 2],
    pub(super) numbers: [Option<usize>; 2],
    /// Sign with which the reaction acts on each link: +1 for the joint's second link, -1 for its first link.
    pub(super) signs: [f64; 2],
    pub(super) pair: Pair,
}

#[derive(Clone, Debug)]
pub(super) enum Pair {
    /// The joint's points relative to the mass centres, in the links' frames (m).
    Pin([Vec2; 2]),
    /// Axis in the frame of the joint's first link, point in the frame of its second link, and mass centres in the
    /// frames of the two links.
    Slide { axis: JointSide, place: JointSide, centres: [Vec2; 2] },
}

/// A joint at one instant: arms from the mass centres of its links to its point of action (m, world axes).
/// For a prismatic joint, the unit vector across its axis is also stored.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stand {
    pub(super) arms: [Vec2; 2],
    pub(super) normal: Option<Vec2>,
}

/// Weights of a joint of the tree. The outer link must receive a force (x, y) and a moment about its mass centre.
/// Weighted sums of these three numbers give two results. The first result is the component that the joint cannot
/// transmit. The second result is the additional load that the inner link must receive: a force, and a moment about
/// this link's mass centre.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pass {
    /// The part that the joint cannot transmit: the moment for a revolute joint, the axial force for a prismatic joint.
    left_over: Term,
    /// Entries xx, xy and yy of the symmetric matrix that gives the transmitted force.
    force: Term,
    /// Weights of the moment about the inner link's mass centre.
    moment: Term,
}

/// The force (x, y) on a link and the moment about its mass centre. This load is a linear function of the unknown joint
/// components; a `Term` is its constant part, or its part per unit of one component.
pub(super) type Term = [f64; 3];

impl Seam {
    /// A joint, with its links in the order of `links`.
    pub(super) fn new(case: &Case, joint: JointId, links: [LinkId; 2], numbers: &[Option<usize>]) -> Self {
        let found = &case.mechanism.joints()[joint];
        let centres = links.map(|link| case.mechanism.links()[link].mass_centre);
        let on = links.map(|link| found.on(link).expect("the joint is on the link"));
        let pair = match found.kind {
            JointKind::Revolute => Pair::Pin([on[0] - centres[0], on[1] - centres[1]]),
            JointKind::Prismatic { axes: [axis, _] } => {
                Pair::Slide { axis: JointSide { link: found.first.link, local: axis }, place: found.second, centres }
            }
        };
        let signs = links.map(|link| if link == found.second.link { 1.0 } else { -1.0 });
        Seam { joint, links, numbers: links.map(|link| numbers[link]), signs, pair }
    }

    #[inline]
    pub(super) fn stand(&self, state: &State) -> Stand {
        let motion = |k: usize| &state.motions[self.links[k]];
        match &self.pair {
            Pair::Pin(places) => Stand { arms: [0, 1].map(|k| motion(k).arm(places[k])), normal: None },
            Pair::Slide { axis, place, centres } => {
                let place = state.motions[place.link].point(place.local);
                let arms = [0, 1].map(|k| place - motion(k).point(centres[k]));
                Stand { arms, normal: Some(turned(state.motions[axis.link].arm(axis.local))) }
            }
        }
    }
}

impl Stand {
    /// Effect of the joint's two components on the link on side `k`, without the sign of the reaction.
    #[inline]
    pub(super) fn components(&self, k: usize) -> [Term; PAIR] {
        let arm = self.arms[k];
        match self.normal {
            None => [[1.0, 0.0, -arm.y], [0.0, 1.0, arm.x]],
            Some(normal) => [[normal.x, normal.y, cross(arm, normal)], [0.0, 0.0, 1.0]],
        }
    }

    /// Weights of a joint of the tree. The first arm belongs to the inner link, the second arm to the outer link.
    #[inline]
    pub(super) fn pass(&self) -> Pass {
        let [inner, outer] = self.arms;
        match self.normal {
            None => {
                Pass { left_over: [outer.y, -outer.x, 1.0], force: [1.0, 0.0, 1.0], moment: [-inner.y, inner.x, 0.0] }
            }
            Some(normal) => {
                let arm = cross(inner - outer, normal);
                Pass {
                    left_over: [normal.y, -normal.x, 0.0],
                    force: [normal.x * normal.x, normal.x * normal.y, normal.y * normal.y],
                    moment: [arm * normal.x, arm * normal.y, 1.0],
                }
            }
        }
    }

    /// Weights of a driven joint between moving links, or of a driven prismatic joint. The drive transmits the force or
    /// moment that the joint alone cannot transmit.
    #[inline]
    pub(super) fn rigid(&self) -> Pass {
        let arm = self.arms[0] - self.arms[1];
        Pass { force: [1.0, 0.0, 1.0], moment: [-arm.y, arm.x, 1.0], ..self.pass() }
    }

    /// Moment about the outer link's mass centre (N m) of a driving force (N) along the axis of a prismatic joint.
    #[inline]
    pub(super) fn moment_of_thrust(&self, thrust: f64) -> f64 {
        self.normal.map_or(0.0, |normal| -cross(self.arms[1], turned(normal)) * thrust)
    }

    /// Force (N) and moment about the joint's point (N m) that a joint of the tree exerts on its outer link.
    #[inline]
    pub(super) fn reaction(&self, [x, y, moment]: Term) -> (Vec2, f64) {
        match self.normal {
            None => (Vec2::new(x, y), 0.0),
            Some(normal) => {
                let across = x * normal.x + y * normal.y;
                (normal * across, moment - cross(self.arms[1], normal) * across)
            }
        }
    }
}

impl Pass {
    #[inline]
    pub(super) fn left_over(&self, term: &Term) -> f64 {
        weighed(&self.left_over, term)
    }

    /// Increases `sum`, the force and moment that the inner link must receive, by the part of `term` that the joint
    /// transmits. `term` is the force and moment that the outer link must receive.
    #[inline]
    pub(super) fn on(&self, term: &Term, sum: &mut Term) {
        let [xx, xy, yy] = self.force;
        sum[0] += xx * term[0] + xy * term[1];
        sum[1] += xy * term[0] + yy * term[1];
        sum[2] += weighed(&self.moment, term);
    }
}

#[inline]
fn weighed(weights: &Term, term: &Term) -> f64 {
    weights[0] * term[0] + weights[1] * term[1] + weights[2] * term[2]
}
