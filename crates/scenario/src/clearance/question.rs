//! The clearance question: bodies with outlines, the pairs that must not meet, and the requested accuracy.

use linkage::math::KeepNan;
use linkage::mechanism::{GROUND, LinkId, Mechanism};

use super::outline::Outline;

/// A body: a link, or a part of the housing.
#[derive(Clone, Debug, PartialEq)]
pub struct ClearanceBody {
    /// Name for reports.
    pub name: String,
    /// Link of the body; [`GROUND`] for the housing.
    pub link: LinkId,
    /// Outline of the body in the frame of its link.
    pub outline: Outline,
}

impl ClearanceBody {
    /// Whether the body moves.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.link != GROUND
    }
}

/// A question of clearance.
#[derive(Clone, Debug, PartialEq)]
pub struct ClearanceQuestion {
    /// All bodies, in the order of reports.
    pub bodies: Vec<ClearanceBody>,
    /// Pairs of bodies whose distance is requested, by their indices.
    pub pairs: Vec<[usize; 2]>,
    /// The required clearance (m): the distance of every pair must exceed this value. `None` if no clearance is
    /// required.
    pub wanted: Option<f64>,
    /// Tolerance of a smallest distance (m). The default is a millionth of the mechanism's size.
    pub tolerance: Option<f64>,
    /// Tolerance of a swept area, divided by the area.
    pub area: f64,
}

impl ClearanceQuestion {
    /// Largest distance of a corner from the origin of its frame, plus the radius of the rounding (m).
    #[must_use]
    pub fn extent(&self) -> f64 {
        self.bodies.iter().map(|body| body.outline.extent()).fold(0.0, f64::larger)
    }
}

/// All pairs of bodies that can meet, except the pairs in `ignored`.
/// Two links can meet if they are not joined. A link and the housing can always meet.
#[must_use]
pub fn pairs(mechanism: &Mechanism, bodies: &[ClearanceBody], ignored: &[[usize; 2]]) -> Vec<[usize; 2]> {
    let mut pairs = Vec::new();
    for second in 1..bodies.len() {
        for first in 0..second {
            let links = [first, second].map(|body| bodies[body].link);
            let fixed = links == [GROUND; 2];
            let joined = !links.contains(&GROUND) && are_joined(mechanism, links);
            if !fixed && !joined && !ignored.contains(&[first, second]) && !ignored.contains(&[second, first]) {
                pairs.push([first, second]);
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

/// Whether two links share a joint, or are hinged to each other through further links whose pins all lie at one point.
#[must_use]
pub fn are_joined(mechanism: &Mechanism, [a, b]: [LinkId; 2]) -> bool {
    if mechanism.joints().iter().any(|joint| joint.on(a).is_some() && joint.on(b).is_some()) {
        return true;
    }
    // The search goes from one pin to another if both pins lie at one point of one link.
    let pins = mechanism.joints().iter().filter(|joint| joint.is_pin());
    for start in pins.filter_map(|joint| joint.on(a)) {
        let mut pin = vec![(a, start)];
        let mut next = 0;
        while let Some(&(link, place)) = pin.get(next) {
            next += 1;
            for joint in mechanism.joints().iter().filter(|joint| joint.is_pin() && joint.on(link) == Some(place)) {
                let other = joint.other(link);
                if other.link == b {
                    return true;
                }
                if !pin.contains(&(other.link, other.local)) {
                    pin.push((other.link, other.local));
                }
            }
        }
    }
    false
}
