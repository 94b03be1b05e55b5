//! What loads do at one state of a case.

use linkage::case::Case;
use linkage::drive::Setting;
use linkage::math::{Motion, Vec2};

/// A load that is drawn as an arrow, at one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Acting {
    /// Number of the load in its case.
    pub load: usize,
    /// World place at which it is drawn (m).
    pub at: Vec2,
    /// The force (N, world axes).
    pub force: Vec2,
    /// The moment (N m), counter-clockwise positive.
    pub moment: f64,
}

/// Forces and moments of all loads but springs and dampers. `motions` and `angles` (rad, turns kept) are those of all links.
#[must_use]
pub fn acting(case: &Case, sketch: &super::Sketch, motions: &[Motion], angles: &[f64]) -> Vec<Acting> {
    let crank = angles[case.crank().link] - case.crank().zero;
    let setting = Setting { motions, angles, start: &case.start.0, crank };
    let one = |sign: &super::LoadSign| {
        let at = motions[sign.at.link].point(sign.at.local);
        let mut found = Acting { load: sign.load, at, force: Vec2::zeros(), moment: 0.0 };
        case.loads[sign.load].act(&setting, &mut |action| {
            found.force += action.force;
            found.moment += action.moment;
        });
        found
    };
    sketch.loads.iter().map(one).collect()
}
