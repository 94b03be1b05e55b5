//! What a case is built for, whatever moves in it: sizes for what vanishes in the whole mechanism.

use crate::compare::Built;
use linkage::case::Case;
use linkage::math::KeepNan;

/// Size, speed and force that a case is built for. Its force is the weight of all links, or what accelerates them at
/// that speed and size, if that is larger; none where nothing has a mass.
pub(super) fn built(case: &Case) -> Built {
    let (length, speed) = (case.mechanism.size(), case.drives.top_speed());
    let mass: f64 = case.mechanism.links().iter().map(|link| link.mass).sum();
    Built { length, speed, force: mass * case.gravity.norm().larger(speed * speed * length) }
}
