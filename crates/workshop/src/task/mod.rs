//! What a synthesis is given: a structure with a starting drawing, which of its dimensions may vary, what a link or point shall do, and what else must
//! hold. SI units, world axes.

mod dimension;
mod timing;

pub use dimension::{Entry, Place};
pub use timing::{Phase, Sense, Timing};

use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Vec2;
use linkage::mechanism::{GroupKind, StartGroup};

/// What is watched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Output {
    /// The angle of a link (rad, counter-clockwise positive).
    Angle {
        /// The link.
        link: usize,
    },
    /// The coordinate of a point along a direction of the world (m).
    Coordinate {
        /// A link that carries the point.
        link: usize,
        /// The point among the link's.
        point: usize,
        /// Unit vector of the direction.
        along: Vec2,
    },
}

/// A quantity that varies.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Name for people: `crank.A length`.
    pub name: String,
    /// Least and greatest value (m or rad).
    pub bounds: [f64; 2],
    /// Whether it is an angle; else it is a length or a coordinate.
    pub is_angle: bool,
}

/// How long is searched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Seed of all random numbers.
    pub seed: u64,
    /// Random candidates.
    pub candidates: usize,
    /// Best of them that are refined.
    pub refined: usize,
    /// Evaluations that each refinement may take.
    pub evaluations: usize,
}

/// A problem of synthesis.
#[derive(Clone, Debug)]
pub struct Task {
    /// Short name of the scenario to be found.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Structure and starting drawing.
    pub case: Case,
    /// How its groups start, in the order of the structure.
    pub starts: Vec<StartGroup>,
    /// The quantities that vary.
    pub variables: Vec<Variable>,
    /// Places that follow from them, in the order in which they are to be set.
    pub places: Vec<Place>,
    /// World direction of the crank at the crank angle zero (rad).
    pub zero: Entry,
    /// What is watched.
    pub output: Output,
    /// Sense of the output that counts as forward: +1 or -1; `None` leaves it to the search.
    pub forward: Option<f64>,
    /// What the output shall do.
    pub timing: Timing,
    /// Smallest and largest stroke of the output that will do (rad or m).
    pub stroke: [f64; 2],
    /// Smallest transmission angle of any dyad (rad) that will do.
    pub transmission: f64,
    /// How long is searched.
    pub effort: Effort,
    /// Mass of the links found a metre of their length (kg/m); without it links keep the masses of the drawing.
    pub bar: Option<f64>,
}

/// Most random candidates, refinements and evaluations of one: more is a slip of the pen.
pub const MOST: usize = 1_000_000_000;

impl Task {
    /// Checks what holds between the parts of a task.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for mechanisms of several freedoms or transmission angles of groups that have none, [`ErrorKind::Input`] if nothing may vary
    /// or the effort is none.
    pub fn check(&self) -> Result<()> {
        let wrong = |key: &str, message: &str, help: &str| {
            Err(Error::new(ErrorKind::Input, message.to_string()).key(key).help(help.to_string()))
        };
        if !self.case.drives.further().is_empty() {
            let message = "the mechanism has several drives, but a timing belongs to one crank";
            return Err(Error::new(ErrorKind::Unsupported, message)
                .key("scenario")
                .help("take a scenario with one `[drive]`"));
        }
        if self.variables.is_empty() {
            return wrong("vary", "nothing may vary", "add a table `[[vary]]` for each length or pivot to be found");
        }
        let higher = self.case.structure.groups.iter().any(|group| group.kind == GroupKind::Higher);
        if higher && self.transmission > 0.0 {
            let message = "a smallest transmission angle is asked for, but higher groups have none";
            return Err(Error::new(ErrorKind::Unsupported, message).key("limits").help("leave `transmission` out"));
        }
        let effort = &self.effort;
        let counts = [effort.candidates, effort.refined, effort.evaluations];
        if counts.iter().any(|count| !(1..=MOST).contains(count)) || effort.refined > effort.candidates {
            let help = "give counts of 1 or more, and no more refinements than candidates";
            return wrong("search", "the search has no candidates, no refinements or no evaluations", help);
        }
        Ok(())
    }

    /// Number of quantities that vary.
    #[must_use]
    pub fn freedoms(&self) -> usize {
        self.variables.len()
    }

    /// Sense in which the crank turns: +1 or -1.
    #[must_use]
    pub fn turning(&self) -> f64 {
        self.case.crank().sense()
    }
}
