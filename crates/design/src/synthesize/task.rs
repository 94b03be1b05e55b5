//! Input of a synthesis, in SI units and world axes.
//! The input consists of a structure with a starting drawing, the variable dimensions, the required motion, and
//! constraints.
//! The required motion is the motion of a link or of a point.

mod points;
mod timing;

use crate::sentences;
pub use points::{PrecisionPoint, PrecisionPoints};
pub use timing::{Phase, Sense, Timing};

use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{Vec2, unit};
use linkage::mechanism::{GroupKind, Handle, LinkId, Mechanism, StartGroup};
use scenario::Claim;
use scenario::clearance::ClearanceQuestion;

/// The output quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OutputQuantity {
    /// The angle of a link (rad, counter-clockwise positive).
    Angle {
        /// The link.
        link: LinkId,
        /// Working point of the link: its acceleration is limited, and compared between mechanisms.
        /// Index among the link's points; `None` if the task names no working point.
        point: Option<usize>,
    },
    /// The coordinate of a point along a direction of the world (m).
    Coordinate {
        /// A link that contains the point.
        link: LinkId,
        /// Index of the point among the link's points.
        point: usize,
        /// Unit vector of the direction.
        along: Vec2,
    },
}

/// A variable quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Name of the variable in texts, such as `crank.A length`.
    pub name: String,
    /// Smallest and largest value (m or rad).
    pub bounds: [f64; 2],
    /// Whether the variable is an angle. A variable that is not an angle is a length or a coordinate.
    pub is_angle: bool,
}

/// A fixed number or a variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TaskNumber {
    /// Fixed (SI).
    Fixed(f64),
    /// The variable with this index.
    Free(usize),
}

impl OutputQuantity {
    /// The output link, and the index of its working point if there is one.
    pub fn working_point(&self) -> (LinkId, Option<usize>) {
        match *self {
            OutputQuantity::Angle { link, point } => (link, point),
            OutputQuantity::Coordinate { link, point, .. } => (link, Some(point)),
        }
    }
}

impl TaskNumber {
    /// Value of the number (SI). `values` are the values of the variables.
    #[inline]
    pub fn value(self, values: &[f64]) -> f64 {
        match self {
            TaskNumber::Fixed(value) => value,
            TaskNumber::Free(index) => values[index],
        }
    }
}

/// The position of a point in its link.
#[derive(Clone, Debug, PartialEq)]
pub struct PointPosition {
    /// The point, and the joints that move with it.
    pub handle: Handle,
    /// Point of the same link from which length and angle are measured. `None` if the entries are x and y.
    pub from: Option<usize>,
    /// x and y (m), or length (m) and angle (rad) in the link's frame.
    pub entries: [TaskNumber; 2],
}

impl PointPosition {
    /// Moves the point to the position that `values` define.
    #[inline]
    pub fn apply(&self, values: &[f64], mechanism: &mut Mechanism) {
        let [a, b] = self.entries.map(|entry| entry.value(values));
        let local = match self.from {
            None => Vec2::new(a, b),
            Some(from) => mechanism.links()[self.handle.link].points[from].local + unit(b) * a,
        };
        mechanism.place(&self.handle, local);
    }
}

/// A limited quantity: a channel, or an expression of channels, that must stay within bounds at every crank angle.
#[derive(Clone, Debug)]
pub struct LimitedQuantity {
    /// The quantity.
    pub claim: Claim,
    /// Smallest and largest permitted value, in the unit of the quantity. Infinite without a limit.
    pub bounds: [f64; 2],
}

impl LimitedQuantity {
    /// The value by which violations of the limits are divided: the permitted range. If only one limit is given, the
    /// value is the magnitude of this limit.
    pub(super) fn scale(&self) -> f64 {
        let [low, high] = self.bounds;
        let only = if low.is_finite() { low.abs() } else { high.abs() };
        let scale = if (high - low).is_finite() { high - low } else { only };
        if scale > 0.0 { scale } else { 1.0 }
    }
}

/// Smallest permitted distances between links, and between links and the housing.
#[derive(Clone, Debug)]
pub struct WantedClearance {
    /// The bodies with their outlines, and the pairs whose distances are limited.
    /// If a corner of an outline lies at a point of its link, the corner moves with this point.
    pub question: ClearanceQuestion,
    /// Smallest permitted distance of every pair (m).
    pub wanted: f64,
}

linkage::words! {
    /// Method by which the best random candidates are refined.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Refinement: name {
        /// An evolution strategy, then COBYLA: no derivatives, any mechanism.
        Evolution = "evolution",
        /// Sequential quadratic programming with exact derivatives.
        Gradients = "gradients",
    }
}

/// Effort of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SearchEffort {
    /// Seed of all random numbers.
    pub seed: u64,
    /// Number of random candidates.
    pub candidates: usize,
    /// Number of the best candidates that are refined.
    pub refined: usize,
    /// Largest number of evaluations of each refinement. With exact derivatives: the largest number of steps.
    pub evaluations: usize,
    /// Method of the refinement.
    pub refinement: Refinement,
}

/// A synthesis task.
#[derive(Clone, Debug)]
pub struct Task {
    /// Short name of the resulting scenario.
    pub name: String,
    /// Title for the reader, in one line.
    pub title: String,
    /// Structure and starting drawing.
    pub case: Case,
    /// Assembly modes or approximate positions of the groups at the start, in the order of the structure.
    pub starts: Vec<StartGroup>,
    /// The variable quantities.
    pub variables: Vec<Variable>,
    /// The points whose positions depend on the variables, in the order in which the positions must be set.
    pub places: Vec<PointPosition>,
    /// World direction of the crank at crank angle zero (rad).
    pub zero: TaskNumber,
    /// The output quantity.
    pub output: OutputQuantity,
    /// Sense of the output that counts as forward: +1 or -1. `None` if the search chooses the sense.
    pub forward: Option<f64>,
    /// The required motion of the output; without phases if only precision points are required.
    pub timing: Timing,
    /// Positions that the output link must reach.
    pub points: PrecisionPoints,
    /// Smallest and largest permitted stroke of the output (rad or m).
    pub stroke: [f64; 2],
    /// Smallest permitted transmission angle of any dyad (rad).
    pub transmission: f64,
    /// Largest permitted acceleration of the working point (m/s^2), at the drawing's crank speed. Infinite if the
    /// acceleration has no limit.
    pub acceleration: f64,
    /// Further limited quantities. Only a refinement with exact derivatives keeps the limits in `keep`, `clearance` and
    /// `mass`.
    pub keep: Vec<LimitedQuantity>,
    /// Smallest permitted distances of links. `None` if distances are not limited.
    pub clearance: Option<WantedClearance>,
    /// Largest permitted mass of all moving links (kg). Infinite without a limit.
    pub mass: f64,
    /// Effort of the search.
    pub effort: SearchEffort,
    /// Mass of the links of the resulting mechanism, per metre of their length (kg/m). `None` if the links keep the
    /// masses of the drawing.
    pub bar: Option<f64>,
}

/// Largest permitted number of random candidates, of refinements, and of evaluations per refinement.
/// A larger number is most likely a typing error.
pub const MOST: usize = 1_000_000_000;

impl Task {
    /// Checks the consistency of the parts of a task.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for mechanisms with several degrees of freedom.
    /// [`ErrorKind::Unsupported`] if a transmission angle is limited and the mechanism has higher groups.
    /// [`ErrorKind::Unsupported`] if the task asks for an evolution strategy, but has precision points, or limits in
    /// `keep`, `clearance` or `mass`.
    /// [`ErrorKind::Input`] if no dimension may vary, or if a count of the search is outside its limits.
    /// [`ErrorKind::Input`] if an acceleration is limited or a position is required, but the output has no point.
    pub fn check(&self) -> Result<()> {
        let wrong = |kind: ErrorKind, key: &str, message: &'static str, help: &'static str| {
            Err(Error::new(kind, message).key(key).help(help))
        };
        if !self.case.drives.further().is_empty() {
            let message = sentences::THE_MECHANISM_HAS_SEVERAL_DRIVES;
            return wrong(ErrorKind::Unsupported, "scenario", message, sentences::TAKE_A_SCENARIO_WITH_ONE_DRIVE);
        }
        let needs_gradients =
            !self.keep.is_empty() || !self.points.is_empty() || self.clearance.is_some() || self.mass.is_finite();
        if self.effort.refinement == Refinement::Evolution && needs_gradients {
            let message = sentences::ONLY_GRADIENTS_KEEP_LIMITS;
            return wrong(ErrorKind::Unsupported, "search", message, sentences::REFINE_BY_GRADIENTS);
        }
        if self.variables.is_empty() {
            return wrong(ErrorKind::Input, "vary", sentences::NOTHING_MAY_VARY, sentences::ADD_A_TABLE_VARY_FOR_EACH);
        }
        let higher = self.case.structure.groups.iter().any(|group| group.kind == GroupKind::Higher);
        if higher && self.transmission > 0.0 {
            let message = sentences::A_SMALLEST_TRANSMISSION_ANGLE_IS_ASKED;
            return wrong(ErrorKind::Unsupported, "limits", message, sentences::LEAVE_TRANSMISSION_OUT);
        }
        if self.acceleration.is_finite() && self.output.working_point().1.is_none() {
            let message = sentences::AN_ACCELERATION_IS_LIMITED_BUT_NO_POINT;
            return wrong(ErrorKind::Input, "limits", message, sentences::NAME_THE_WORKING_POINT_OF_THE_OUTPUT);
        }
        if self.points.all().iter().any(|point| point.place.is_some()) && self.output.working_point().1.is_none() {
            let message = sentences::A_POINT_NEEDS_A_WORKING_POINT;
            return wrong(ErrorKind::Input, "output", message, sentences::NAME_THE_WORKING_POINT_OF_THE_OUTPUT);
        }
        let effort = &self.effort;
        let counts = [effort.candidates, effort.refined, effort.evaluations];
        if counts.iter().any(|count| !(1..=MOST).contains(count)) || effort.refined > effort.candidates {
            let message = sentences::THE_SEARCH_HAS_NO_CANDIDATES;
            return wrong(ErrorKind::Input, "search", message, sentences::GIVE_COUNTS_OF_OR_MORE_AND_NO_MORE);
        }
        Ok(())
    }

    /// Sense of rotation of the crank: +1 or -1.
    pub fn turning(&self) -> f64 {
        self.case.crank().sense()
    }
}
