//! Effects of loads and gravity at one state of a case.

use linkage::case::Case;
use linkage::drive::{Load, On};
use linkage::math::{Motion, Vec2};
use linkage::mechanism::JointSide;

/// A load that is drawn as an arrow, at one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Acting {
    /// Index of the load in the loads of its case.
    pub load: usize,
    /// World position at which the load is drawn (m).
    pub at: Vec2,
    /// The force (N, world axes).
    pub force: Vec2,
    /// The moment (N m), counter-clockwise positive.
    pub moment: f64,
}

/// Forces and moments of all loads that are drawn as arrows.
/// Friction, and springs and dampers between points or links, are not drawn as arrows.
/// `motions` and `angles` (rad, including full turns) contain one entry for each link.
pub fn acting(case: &Case, sketch: &super::Sketch, motions: &[Motion], angles: &[f64]) -> Vec<Acting> {
    let one = |sign: &super::LoadSign| {
        let at = motions[sign.at.link].point(sign.at.local);
        let mut found = Acting { load: sign.load, at, force: Vec2::zeros(), moment: 0.0 };
        case.each_action(sign.load, motions, angles, |action| {
            // A load along a slide acts on both links of the joint. Only its action on the link with the arrow counts.
            if action.link == sign.at.link {
                found.force += action.force;
                found.moment += action.moment;
            }
        });
        found
    };
    sketch.loads.iter().map(one).collect()
}

/// Force or moment of a spring or damper between its two points or links, at one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tension {
    /// Index of the load in the loads of its case.
    pub load: usize,
    /// Between points: the force (N) that pulls the two points together; a negative force pushes them apart.
    /// Between links: the moment (N m) on the first link, counter-clockwise positive.
    pub size: f64,
}

/// Forces and moments of all springs and dampers. The arguments have the same meaning as in [`acting`].
pub fn tensions(case: &Case, motions: &[Motion], angles: &[f64]) -> Vec<Tension> {
    let of = |(load, own): (usize, &Load)| {
        let first = match own.nature().on {
            On::Points(ends) => {
                let [start, end] = ends.map(|end| motions[end.link].point(end.local));
                let span = end - start;
                Some(if span.norm() > 0.0 { span.normalize() } else { Vec2::zeros() })
            }
            On::Links(_) => None,
            On::Link(_) | On::Point(_) | On::Joint(..) => return None,
        };
        let mut size = None;
        case.each_action(load, motions, angles, |action| {
            size = size.or(Some(first.map_or(action.moment, |toward| action.force.dot(&toward))));
        });
        Some(Tension { load, size: size.unwrap_or_default() })
    };
    case.loads.iter().enumerate().filter_map(of).collect()
}

/// The weight of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weight {
    /// The mass centre.
    pub at: JointSide,
    /// The force (N, world axes).
    pub force: Vec2,
}

/// The weights of all links that have a weight.
pub fn weights(case: &Case) -> Vec<Weight> {
    let links = case.mechanism.links().entries().skip(1);
    let all = links
        .map(|(link, own)| Weight { at: JointSide { link, local: own.mass_centre }, force: case.gravity * own.mass });
    all.filter(|own| own.force.norm() > 0.0).collect()
}
