//! The two links of a dyad, in the order of its equations.

use linkage::mechanism::{Group, Joint, LinkId, Mechanism};

/// One link of a dyad and its outer joint.
pub(super) struct Half<'a> {
    pub(super) link: LinkId,
    pub(super) outer: &'a Joint,
}

/// Returns the two halves of a dyad. The half for which `is_first` is true comes first.
pub(super) fn of_dyad<'a>(
    mechanism: &'a Mechanism,
    group: &Group,
    is_first: impl Fn(&Joint, LinkId) -> bool,
) -> [Half<'a>; 2] {
    let half = |k: usize| Half { link: group.links[k], outer: &mechanism.joints()[group.outer[k]] };
    let [a, b] = [half(0), half(1)];
    if is_first(a.outer, a.link) { [a, b] } else { [b, a] }
}
