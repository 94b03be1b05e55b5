//! Assembly modes: which of its real configurations a group takes, and how one is asked for.

use crate::math::Vec2;
use crate::mechanism::LinkPose;
use crate::mechanism::pose::SidePoint;

/// Which of its real configurations a group takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AssemblyMode {
    /// Of a dyad: the inner joint lies to the left of the line from the first link's outer joint to the second link's.
    Left,
    /// Of a dyad: the inner joint lies to the right of that line.
    Right,
    /// Of an RRP or RPR dyad: measured along the axis of its prismatic pair, the inner joint lies ahead of the outer pin (RRP), or
    /// the outer pin of the pair's second link ahead of that of its first (RPR).
    Ahead,
    /// Of an RRP or RPR dyad: it lies behind.
    Behind,
    /// Of an RPP or PRP dyad, which has one configuration.
    Only,
    /// Of a higher group: the configuration of the start pose, followed from there.
    Followed,
}

impl AssemblyMode {
    /// The same configuration seen with a dyad's links in the other order.
    #[must_use]
    pub fn swapped(self) -> Self {
        match self {
            AssemblyMode::Left => AssemblyMode::Right,
            AssemblyMode::Right => AssemblyMode::Left,
            AssemblyMode::Ahead | AssemblyMode::Behind | AssemblyMode::Only | AssemblyMode::Followed => self,
        }
    }

    /// Name, as in scenario files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            AssemblyMode::Left => "left",
            AssemblyMode::Right => "right",
            AssemblyMode::Ahead => "ahead",
            AssemblyMode::Behind => "behind",
            AssemblyMode::Only => "only",
            AssemblyMode::Followed => "followed",
        }
    }
}

/// One real configuration of a group at a given pose of the links it hangs on.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// Its mode.
    pub mode: AssemblyMode,
    /// Pose of each of the group's links, in the order of [`Group::links`].
    pub links: Vec<LinkPose>,
}

/// What is asked of one group's first pose. The links stand in the order of [`Group::links`].
#[derive(Clone, Debug, PartialEq, Default)]
pub struct StartGroup {
    /// Assembly mode asked for.
    pub mode: Option<AssemblyMode>,
    /// Place of the configuration asked for in the list of [`configurations`](super::configurations), counted from 1.
    pub rank: Option<usize>,
    /// Points of the group's links and where each roughly is (m).
    pub near: Vec<(SidePoint, Vec2)>,
}

/// Which configuration a group has taken at the start, and how clear that was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// Its assembly mode.
    pub mode: AssemblyMode,
    /// Largest distance of its points from their rough places (m), if such were given.
    pub nearest_m: Option<f64>,
    /// The same of the next configuration (m), if there is one and all are known.
    pub next_m: Option<f64>,
}
