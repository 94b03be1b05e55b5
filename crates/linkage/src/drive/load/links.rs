//! The links that a load acts on.

use super::Load;
use crate::mechanism::{LinkId, Side};

impl Load {
    /// The links that the load acts on, and on whose motion it depends: one or two, by their numbers.
    #[must_use]
    pub fn links(&self) -> Vec<LinkId> {
        match *self {
            Load::Resistance { link, .. } | Load::Moment { link, .. } => vec![link],
            Load::Force { at, .. } | Load::ResistingForce { at, .. } => vec![at.link],
            Load::Spring { ends, .. } | Load::Damper { ends, .. } => ends.map(|end| end.link).to_vec(),
            Load::TorsionSpring { links, .. } | Load::TorsionDamper { links, .. } => links.to_vec(),
        }
    }

    /// The same load on other links: `number` gives the new number of each of [`Load::links`].
    #[must_use]
    pub fn on_links(&self, number: impl Fn(LinkId) -> LinkId) -> Load {
        let side = |side: Side| Side { link: number(side.link), ..side };
        let mut load = self.clone();
        match &mut load {
            Load::Resistance { link, .. } | Load::Moment { link, .. } => *link = number(*link),
            Load::Force { at, .. } | Load::ResistingForce { at, .. } => *at = side(*at),
            Load::Spring { ends, .. } | Load::Damper { ends, .. } => *ends = ends.map(side),
            Load::TorsionSpring { links, .. } | Load::TorsionDamper { links, .. } => *links = links.map(&number),
        }
        load
    }
}
