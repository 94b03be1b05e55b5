//! Assembly modes: names for the real configurations of a group, and requests for one configuration.

use crate::math::Vec2;
use crate::mechanism::LinkPose;
use crate::mechanism::pose::SidePoint;

crate::words! {
    /// The assembly mode of a group: the name of one of its real configurations.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum AssemblyMode: name {
        /// RRR dyad: the inner joint lies to the left of a directed line.
        /// The line leads from the first link's outer joint to the second link's outer joint.
        Left = "left",
        /// RRR dyad: the inner joint lies to the right of a directed line.
        /// The line leads from the first link's outer joint to the second link's outer joint.
        Right = "right",
        /// RRP dyad: along the axis of its prismatic pair, the inner joint lies ahead of the outer pin.
        /// RPR dyad: along the axis of its prismatic pair, the outer pin of the pair's second link lies ahead of the
        /// outer pin of the pair's first link.
        Ahead = "ahead",
        /// RRP dyad: along the axis of its prismatic pair, the inner joint lies behind the outer pin.
        /// RPR dyad: along the axis of its prismatic pair, the outer pin of the pair's second link lies behind the
        /// outer pin of the pair's first link.
        Behind = "behind",
        /// RPP or PRP dyad, or driven link: there is only one configuration.
        Only = "only",
        /// Higher group: the configuration that the group has in the start pose and keeps during the motion.
        Followed = "followed",
    }
}

impl AssemblyMode {
    /// The mode of the same configuration if the dyad's two links are listed in reverse order.
    #[must_use]
    pub fn swapped(self) -> Self {
        match self {
            AssemblyMode::Left => AssemblyMode::Right,
            AssemblyMode::Right => AssemblyMode::Left,
            AssemblyMode::Ahead | AssemblyMode::Behind | AssemblyMode::Only | AssemblyMode::Followed => self,
        }
    }
}

/// One real configuration of a group, for a given pose of the links that are solved before the group.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// Assembly mode of the configuration.
    pub mode: AssemblyMode,
    /// Pose of each of the group's links, in the order of [`Group::links`](crate::mechanism::Group::links).
    pub links: Vec<LinkPose>,
}

/// The required first pose of one group. The mode refers to the links in the order of
/// [`Group::links`](crate::mechanism::Group::links).
#[derive(Clone, Debug, PartialEq, Default)]
pub struct StartGroup {
    /// Required assembly mode.
    pub mode: Option<AssemblyMode>,
    /// Number of the required configuration in the list of [`configurations`](super::configurations), counted from 1.
    pub rank: Option<usize>,
    /// Points of the group's links with their approximate positions (m).
    pub near: Vec<(SidePoint, Vec2)>,
}

/// The configuration chosen for a group at the start.
/// Two distances from the approximate positions show how clear the choice is: the distance of the chosen configuration
/// and the distance of the second nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConfigurationChoice {
    /// Assembly mode of the configuration.
    pub mode: AssemblyMode,
    /// Largest distance of the configuration's points from their approximate positions (m).
    /// `None` if no approximate positions were used.
    pub nearest_m: Option<f64>,
    /// Largest distance of the second nearest configuration's points from their approximate positions (m).
    /// `None` if there is only one configuration, if not all configurations are known, or if no approximate positions
    /// were used.
    pub next_m: Option<f64>,
}
