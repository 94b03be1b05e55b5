//! Clearance: smallest distances between links and from a housing, first collision, and swept areas.
//! Every result is proven for all crank angles in the range of the grid, also for crank angles between the instants.

mod gap;
mod search;
mod swept;
#[cfg(test)]
mod tests;
pub(crate) mod tube;

use crate::sentences;
pub use search::{Meeting, Smallest};
pub use swept::Area;

use std::f64::consts::TAU;

use analytic::{AssurSolver, PoseSolver};
use linkage::case::{Case, Wanted};
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::Motion;
use linkage::math::statistics::ends;
use linkage::mechanism::GroupKind;
use linkage::solver::{Progress, Solver};
use linkage::trajectory::Stage;
use scenario::clearance::{ClearanceBody, ClearanceQuestion};

use gap::Solid;
use search::DistanceSearch;
use swept::Sweep;
use tube::Tubes;

/// Default tolerance of a distance, divided by the mechanism's size.
const TOLERANCE: f64 = 1e-6;
/// Contact distance, divided by the mechanism's size.
/// If a part of the range cannot be halved further, bodies nearer to each other than the contact distance count as
/// touching.
const TOUCH: f64 = 1e-9;
/// Upper limit of the number of pairs of convex parts that one run examines, over all parts of the range.
/// `AREA_BUDGET` is the upper limit of the number of tests for one swept area.
const BUDGET: usize = 5_000_000;
const AREA_BUDGET: usize = 8_000_000;

/// Variable of the range: the input of the first drive, or the time if several drives have varying speeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RangeVariable {
    /// Input of the first drive (rad or m).
    Input(Input),
    /// Time (s).
    Time,
}

impl RangeVariable {
    /// Range variable of a case.
    pub fn of(case: &Case) -> Self {
        if case.goes_by_time() { RangeVariable::Time } else { RangeVariable::Input(case.crank().input) }
    }

    /// Name in texts.
    pub fn noun(self) -> &'static str {
        match self {
            RangeVariable::Input(input) => input.noun(),
            RangeVariable::Time => "time",
        }
    }

    /// Value in the unit of texts, and this unit.
    pub fn shown(self, value: f64) -> (f64, &'static str) {
        match self {
            RangeVariable::Input(input) => (input.shown(value), input.shown_in().0),
            RangeVariable::Time => (value, "s"),
        }
    }

    /// SI unit in the keys of JSON.
    pub fn unit(self) -> &'static str {
        match self {
            RangeVariable::Input(input) => input.unit(),
            RangeVariable::Time => "s",
        }
    }
}

/// Clearance of one pair of bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct PairClearance {
    /// Indices of the two bodies in the question's list of bodies.
    pub bodies: [usize; 2],
    /// Smallest distance over the range.
    pub smallest: Smallest,
    /// First contact; `None` if no contact was found. Contacts in unproven parts of the range may be missing.
    pub collision: Option<Meeting>,
    /// First pose that violates the required clearance.
    /// `None` if no pose violates the clearance, or if no clearance is required.
    pub too_near: Option<Meeting>,
}

/// Operation counts of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClearanceWork {
    /// Number of poses that the analytic solver (side 1) computes for distances.
    pub poses: usize,
    /// Number of additional poses that the analytic solver (side 1) computes for swept areas.
    pub positions: usize,
    /// Number of pairs of convex parts whose nearest points were computed.
    pub distances: usize,
    /// Number of tests whether the body covers a square of the plane during a part of the range.
    pub squares: usize,
}

/// Result of a clearance question.
#[derive(Clone, Debug, PartialEq)]
pub struct ClearanceResult {
    /// Range of the [range variable](RangeVariable) (rad, m or s), in the direction of motion.
    pub range: [f64; 2],
    /// Results of all pairs of the question.
    pub pairs: Vec<PairClearance>,
    /// Swept areas of the question's moving bodies: index of the body and area.
    pub swept: Vec<(usize, Area)>,
    /// Parts of the range (rad, m or s) for which no bound could be proven.
    /// These parts lie around singular poses, or remain when the work limit is reached.
    pub open: Vec<[f64; 2]>,
    /// Error bound of the smallest distances (m).
    pub tolerance: f64,
    /// Operation counts.
    pub work: ClearanceWork,
}

impl ClearanceResult {
    /// Returns the pair that collides first, with its first contact.
    /// If several pairs touch at the start, the pair that comes first in the question is returned.
    pub fn first_collision(&self) -> Option<(&PairClearance, Meeting)> {
        self.first(|pair| pair.collision)
    }

    /// Returns the pair that first violates the required clearance, and the pose of this violation.
    pub fn first_too_near(&self) -> Option<(&PairClearance, Meeting)> {
        self.first(|pair| pair.too_near)
    }

    fn first(&self, of: impl Fn(&PairClearance) -> Option<Meeting>) -> Option<(&PairClearance, Meeting)> {
        let gone = |meeting: &Meeting| (meeting.cranks[1] - self.range[0]).abs();
        let found = self.pairs.iter().filter_map(|pair| Some((pair, of(pair)?)));
        found.min_by(|a, b| gone(&a.1).total_cmp(&gone(&b.1)))
    }

    /// Returns the pair with the smallest distance.
    pub fn smallest(&self) -> Option<&PairClearance> {
        self.pairs.iter().min_by(|a, b| a.smallest.distance.total_cmp(&b.smallest.distance))
    }
}

/// Answers a clearance question about a case over the crank angles that its grid spans.
/// `progress` receives the finished fraction, from 0 to 1.
///
/// The poses repeat after a turn if all of these conditions hold:
/// - All groups are dyads.
/// - There is only one drive, and this drive turns a joint.
/// - There are no transmissions.
/// - The motion does not pass change points.
///
/// If the poses repeat and the range is longer than a turn, only one turn is examined.
/// For a free motion with one degree of freedom, the range spans the crank angles at the instants of the grid.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a cam, and for a free motion with several degrees of freedom.
/// The errors of [`analytic::PoseSolver::solve`] for crank angles that the mechanism cannot reach.
pub fn find(case: &Case, question: &ClearanceQuestion, progress: Progress) -> Result<ClearanceResult> {
    let range = range(case)?;
    let case = &case.nominal();
    let size = case.mechanism.size();
    let mut tubes = Tubes::new(case, range, question.extent())?;
    let solids: Vec<Solid> = question.bodies.iter().map(|body| Solid::new(body.link, &body.outline, size)).collect();
    let tolerance = question.tolerance.unwrap_or(TOLERANCE * size);
    let mut search = DistanceSearch {
        tubes: &mut tubes,
        solids: &solids,
        tolerance,
        touch: TOUCH * size,
        asked: 0,
        budget: BUDGET,
        open: Vec::new(),
    };
    let smallest = search.smallest(&question.pairs)?;
    progress(0.3);
    let mut pairs = Vec::with_capacity(smallest.len());
    for (&bodies, smallest) in question.pairs.iter().zip(smallest) {
        let mut first = |threshold: f64| {
            if smallest.least > threshold { Ok(None) } else { search.first(bodies, threshold) }
        };
        let collision = first(0.0)?;
        let too_near = question.wanted.map(&mut first).transpose()?.flatten();
        pairs.push(PairClearance { bodies, smallest, collision, too_near });
    }
    progress(0.5);
    let (distances, mut open) = (search.asked, search.open);
    let poses = tubes.poses;
    let moving: Vec<usize> = (0..question.bodies.len()).filter(|&body| question.bodies[body].moves()).collect();
    let (mut swept, mut squares) = (Vec::with_capacity(moving.len()), 0);
    for (done, &body) in moving.iter().enumerate() {
        let ClearanceBody { link, outline, .. } = &question.bodies[body];
        let mut sweep = Sweep::new(&mut tubes, *link, outline);
        swept.push((body, sweep.area(question.area, AREA_BUDGET)?));
        squares += sweep.tests;
        open.append(&mut sweep.open);
        progress(0.5 + 0.5 * (done + 1) as f64 / moving.len() as f64);
    }
    let open = merged(open, range);
    let work = ClearanceWork { poses, positions: tubes.poses - poses, distances, squares };
    Ok(ClearanceResult { range, pairs, swept, open, tolerance, work })
}

/// Distances of all pairs at the instants of a grid, sampled for graphs.
#[derive(Clone, Debug, PartialEq)]
pub struct DistanceCurve {
    /// Inputs of the first drive (rad or m), one per instant.
    pub cranks: Vec<f64>,
    /// Distances (m): one row per instant, one entry per pair of the question.
    pub rows: Vec<Vec<f64>>,
}

/// Computes the distances of all pairs at the instants of the case's grid.
///
/// # Errors
/// The errors of [`find`].
pub fn course(case: &Case, question: &ClearanceQuestion) -> Result<DistanceCurve> {
    let cranks = cranks(case)?;
    let case = &case.nominal();
    let size = case.mechanism.size();
    let mut tubes = Tubes::new(case, [case.crank().start; 2], question.extent())?;
    let solids: Vec<Solid> = question.bodies.iter().map(|body| Solid::new(body.link, &body.outline, size)).collect();
    let rounding = tubes.rounding();
    let mut rows = Vec::with_capacity(cranks.len());
    for &crank in &cranks {
        let slice = tubes.slice(crank, 0.0)?;
        let placed: Vec<gap::PlacedSolid> = solids.iter().map(|solid| solid.placed(&slice)).collect();
        let of = |&[a, b]: &[usize; 2]| {
            let bodies = [&solids[a], &solids[b]];
            gap::gap(bodies, [&placed[a], &placed[b]], &slice, rounding, f64::INFINITY, &mut 0).now
        };
        rows.push(question.pairs.iter().map(of).collect());
    }
    let cranks = if case.goes_by_time() { case.grid.inputs.clone() } else { cranks };
    Ok(DistanceCurve { cranks, rows })
}

/// Computes the poses of all links at the crank angles `cranks` (rad), for drawings.
///
/// # Errors
/// The errors of [`PoseSolver::solve`].
pub fn poses(case: &Case, cranks: &[f64]) -> Result<Vec<Vec<Motion>>> {
    let case = &case.nominal();
    let mut solver = PoseSolver::new(case)?;
    let mut at = |&crank: &f64| Ok(solver.solve(crank, 1.0, 0.0, Stage::Positions)?.motions.to_vec());
    cranks.iter().map(&mut at).collect()
}

/// Returns the [range variable](RangeVariable) at the instants of the grid (rad, m or s).
/// For a motion under forces, the crank angles come from the solution of the motion.
fn cranks(case: &Case) -> Result<Vec<f64>> {
    if let Some(cam) = case.mechanism.transmissions().iter().find(|own| own.cam.is_some()) {
        let error = Error::new(ErrorKind::Unsupported, sentences::clearance_knows_no_cams(&cam.name()));
        return Err(error.help(sentences::LEAVE_THE_CAM_OUT));
    }
    if !case.is_free() {
        return Ok(if case.goes_by_time() { &case.grid.times } else { &case.grid.inputs }.clone());
    }
    if !case.drives.further().is_empty() {
        let message = sentences::CLEARANCE_IS_LOOKED_FOR_OVER;
        let error = Error::new(ErrorKind::Unsupported, message);
        return Err(error.help(sentences::PRESCRIBE_THE_DRIVES_OR_LET));
    }
    Ok(AssurSolver.solve(&case.wanting(Wanted::of(&[Stage::Positions])))?.inputs().to_vec())
}

/// Returns the first and the last value of the [range variable](RangeVariable), in the direction of motion.
/// If the poses repeat after a turn, the range is limited to one turn.
pub(crate) fn range(case: &Case) -> Result<[f64; 2]> {
    let [low, mut high] = ends(cranks(case)?);
    let dyads = case.structure.groups.iter().all(|group| group.kind != GroupKind::Higher);
    let repeats = dyads && case.crank().input != Input::Slide && case.mechanism.transmissions().is_empty();
    let forwards = case.crank().sense() > 0.0 || case.goes_by_time();
    if repeats && case.drives.further().is_empty() && !case.crank().through && high - low > TAU {
        if !forwards {
            return Ok([high, high - TAU]);
        }
        high = low + TAU;
    }
    Ok(if forwards { [low, high] } else { [high, low] })
}

/// Sorts ranges in the direction of motion and merges ranges that touch or overlap.
fn merged(mut open: Vec<[f64; 2]>, range: [f64; 2]) -> Vec<[f64; 2]> {
    let gone = |angle: f64| (angle - range[0]).abs();
    open.sort_by(|a, b| gone(a[0]).total_cmp(&gone(b[0])).then(gone(a[1]).total_cmp(&gone(b[1]))));
    let mut all: Vec<[f64; 2]> = Vec::new();
    for own in open {
        match all.last_mut() {
            Some(last) if gone(own[0]) <= gone(last[1]) => {
                if gone(own[1]) > gone(last[1]) {
                    last[1] = own[1];
                }
            }
            _ => all.push(own),
        }
    }
    all
}
