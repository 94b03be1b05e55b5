//! A front of two conflicting requirements: the smallest deviation from the required motion, as a function of a limit
//! that is varied.
//!
//! Every point is a search with another limit (epsilon-constraint method: Haimes, Lasdon, Wismer, IEEE Transactions on
//! Systems, Man, and Cybernetics 1 (1971) 296-297).
//! The searches proceed from the tightest to the loosest limit. Each search also starts from the previous result.
//! A looser limit therefore never gives a larger deviation.

use linkage::error::{Error, ErrorKind, Result};
use linkage::solver::Progress;

use super::search::{SearchResult, search_from};
use super::task::Task;
use crate::sentences;

/// Names of limits, as in the section `limits` of a synthesis file.
const ACCELERATION: &str = "acceleration_m_s2";
const TRANSMISSION: &str = "transmission_deg";

/// The limit that is varied along a front.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrontLimit {
    /// Largest acceleration of the working point (m/s^2).
    Acceleration,
    /// Smallest transmission angle (deg).
    Transmission,
    /// Largest value of the task's limited quantity with this index, in the unit of the quantity.
    Quantity(usize),
}

/// A point of a front.
#[derive(Clone, Debug)]
pub struct FrontPoint {
    /// The limit, in the unit of its name.
    pub limit: f64,
    /// The task with this limit.
    pub task: Task,
    /// The result; `None` if the search finds no candidate that both can be assembled and nearly keeps the limits.
    pub found: Option<SearchResult>,
}

impl FrontLimit {
    /// The limit that a name denotes: `acceleration_m_s2`, `transmission_deg`, or the text of a limited quantity.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for another name.
    pub fn named(name: &str, task: &Task) -> Result<Self> {
        let quantity = task.keep.iter().position(|keep| keep.claim.text == name);
        match name {
            ACCELERATION => Ok(FrontLimit::Acceleration),
            TRANSMISSION => Ok(FrontLimit::Transmission),
            _ => quantity.map(FrontLimit::Quantity).ok_or_else(|| {
                let known = task.keep.iter().map(|keep| keep.claim.text.as_str());
                let known: Vec<&str> = [ACCELERATION, TRANSMISSION].into_iter().chain(known).collect();
                let message = sentences::no_limit_is_called(&name);
                Error::new(ErrorKind::Input, message).help(sentences::name_one_of(&known.join(", ")))
            }),
        }
    }

    /// The task with another value of the limit, in the unit of its name.
    fn with(self, task: &Task, limit: f64) -> Task {
        let mut task = task.clone();
        match self {
            FrontLimit::Acceleration => task.acceleration = limit,
            FrontLimit::Transmission => task.transmission = limit.to_radians(),
            FrontLimit::Quantity(index) => task.keep[index].bounds[1] = limit,
        }
        task
    }

    /// The limit in words, and its unit. For a limited quantity, the unit is empty, because the quantity's text
    /// contains it.
    pub fn noun(self, task: &Task) -> [String; 2] {
        match self {
            FrontLimit::Acceleration => [sentences::LARGEST_ACCELERATION.into(), "m/s²".into()],
            FrontLimit::Transmission => [sentences::SMALLEST_TRANSMISSION_ANGLE.into(), "deg".into()],
            FrontLimit::Quantity(index) => [task.keep[index].claim.text.clone(), String::new()],
        }
    }

    /// Whether a larger value of the limit admits more mechanisms.
    fn loosens(self) -> bool {
        self != FrontLimit::Transmission
    }
}

/// The points of the front for the values `values` of a limit, in the same order. The values are in the unit of the
/// limit's name.
///
/// # Errors
/// The errors of [`super::search()`], except the error that no candidate was found.
pub fn front(
    task: &Task,
    limit: FrontLimit,
    values: &[f64],
    threads: usize,
    progress: Progress,
) -> Result<Vec<FrontPoint>> {
    let mut order = linkage::math::statistics::ascending(values);
    if !limit.loosens() {
        order.reverse();
    }
    let mut points: Vec<Option<FrontPoint>> = vec![None; values.len()];
    let mut before: Option<SearchResult> = None;
    for (done, &index) in order.iter().enumerate() {
        let own = limit.with(task, values[index]);
        let mut part = |share: f64| progress((done as f64 + share) / values.len() as f64);
        let found = match search_from(&own, before.as_slice(), threads, &mut part) {
            Ok(found) => Some(found),
            Err(error) if error.kind() == ErrorKind::Numeric => None,
            Err(error) => return Err(error),
        };
        before = found.clone().or(before);
        points[index] = Some(FrontPoint { limit: values[index], task: own, found });
    }
    Ok(points.into_iter().flatten().collect())
}
