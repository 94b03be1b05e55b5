//! Coordinates of joints as polynomials of the driven joint's coordinate, with proven bounds on the errors.
//!
//! A polynomial is the least-squares fit on Chebyshev nodes of the range that the case's grid spans.
//! The bounds hold for every pose of the range, also between the nodes: see [`bound`].

mod bound;
mod chebyshev;

use super::FORMAT;
use crate::clearance;
use crate::export::limits::{self, Follower};
use crate::export::rigid::{Body, RigidModel};
use crate::export::xml::number;
use crate::sentences;
use analytic::PoseSolver;
use chebyshev::Chebyshev;
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::KeepNan;
use linkage::mechanism::{GROUND, JointId, LinkId};
use linkage::trajectory::Stage;

/// Largest degree of the polynomials.
pub const MOST_DEGREE: usize = 60;
/// Number of nodes for each coefficient, and least number of nodes.
const NODES: usize = 4;
const LEAST: usize = 256;
/// Coefficients of degree 2 or more count as rounding errors below this value (rad or m).
const NOISE: f64 = 1e-11;

/// Largest error over the range.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MimicError {
    /// Proven bound (rad or m).
    pub bound: f64,
    /// Largest error of the sampled poses (rad or m).
    pub sampled: f64,
}

/// Coordinate of a joint as a polynomial of the driven joint's coordinate. Both are zero in the start pose.
#[derive(Clone, Debug, PartialEq)]
pub struct JointRelation {
    /// The joint.
    pub joint: JointId,
    polynomial: Chebyshev,
    /// Error of the joint's coordinate (rad or m).
    pub error: MimicError,
}

impl JointRelation {
    /// Coordinate of the joint (rad or m) for a coordinate of the driven joint (rad or m).
    #[must_use]
    pub fn at(&self, driven: f64) -> f64 {
        self.polynomial.at(driven)[0]
    }
}

/// Error of the place of a joint's point on a link, if all joints of the tree follow their polynomials.
#[derive(Clone, Debug, PartialEq)]
pub struct PinError {
    /// The joint.
    pub joint: JointId,
    /// The link.
    pub link: LinkId,
    /// Error of the place (m).
    pub error: MimicError,
}

/// All joints of the spanning tree as followers of the driven joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Mimics {
    driver: JointId,
    /// Range of the driven joint's coordinate (rad or m).
    pub domain: [f64; 2],
    degree: usize,
    /// The relations of all joints of the tree but the driven one.
    pub relations: Vec<JointRelation>,
    /// The errors of all pins that a relation places.
    pub pins: Vec<PinError>,
}

/// The range of the first drive's input, from which the driven joint's coordinate follows.
#[derive(Clone, Copy, Debug)]
struct InputRange {
    /// Both ends (rad or m), in the direction of motion.
    ends: [f64; 2],
    /// Input in the start pose (rad or m).
    start: f64,
    /// Change of the driven joint's coordinate per unit of the input: 1 or -1.
    sense: f64,
}

impl InputRange {
    fn coordinate(&self, input: f64) -> f64 {
        self.sense * (input - self.start)
    }

    fn input(&self, coordinate: f64) -> f64 {
        self.start + self.sense * coordinate
    }
}

impl Mimics {
    /// Polynomials of degree `degree` over the range that the case's grid spans, at most one turn if poses repeat.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`](linkage::ErrorKind::Unsupported) for several drives.
    /// [`ErrorKind::Numeric`](linkage::ErrorKind::Numeric) if no bound can be proven near a singular pose.
    /// The errors of the pose solver.
    pub fn new(model: &RigidModel, degree: usize) -> Result<Self> {
        if !model.case.drives.further().is_empty() {
            return Err(limits::refused(sentences::RELATIONS_WITH_SEVERAL_DRIVES, FORMAT, sentences::WRITE_NO_RELATIONS));
        }
        let ends = clearance::range(model.case)?;
        let case = &model.case.nominal();
        let driver = case.crank().joint;
        let body = model.bodies.iter().find(|body| body.branch.joint == driver).expect("driven joints are in the tree");
        let start = case.crank().start;
        let state = PoseSolver::new(case)?.solve(start, 1.0, 0.0, Stage::Velocities)?.clone();
        let range = InputRange { ends, start, sense: body.rate_in(case, &state).signum() };
        let [first, last] = ends.map(|end| range.coordinate(end));
        let domain = [first.smaller(last), first.larger(last)];
        let mut own = Mimics { driver, domain, degree, relations: Vec::new(), pins: Vec::new() };
        own.relations = fits(model, case, range, &own)?;
        own.pins = own.placed(model);
        bound::prove(model, case, range, &mut own)?;
        Ok(own)
    }

    /// Pins that a relation places: all points of joints on links that more than the driven joint carries.
    fn placed(&self, model: &RigidModel) -> Vec<PinError> {
        let mut moved = vec![false; model.case.mechanism.links().len()];
        for body in &model.bodies {
            moved[body.branch.link.index()] = moved[body.branch.parent.index()] || body.branch.joint != self.driver;
        }
        let joints = model.bodies.iter().chain(&model.closing).flat_map(|body| {
            // A hinge of the tree has the same place on both links.
            let twice = body.slides() || model.tree.cut.contains(&body.branch.joint);
            let ends = [(body.branch.parent, true), (body.branch.link, twice)];
            ends.into_iter().filter(|(_, counts)| *counts).map(|(link, _)| (body.branch.joint, link))
        });
        let pins = joints.filter(|(_, link)| *link != GROUND && moved[link.index()]);
        pins.map(|(joint, link)| PinError { joint, link, error: MimicError::default() }).collect()
    }

    /// The polynomial of a joint; `None` for the driven joint.
    fn polynomial(&self, joint: JointId) -> Option<&Chebyshev> {
        self.relations.iter().find(|own| own.joint == joint).map(|own| &own.polynomial)
    }

    /// The relations of degree 1 as followers of the driven joint, and their offsets (rad or m).
    pub(super) fn linear(&self) -> (Vec<Follower>, Vec<f64>) {
        let lines = self.relations.iter().filter_map(|own| Some((own.joint, own.polynomial.line()?)));
        lines.map(|(joint, [offset, multiplier])| (Follower { joint, leader: self.driver, multiplier }, offset)).unzip()
    }

    /// The relations with their errors as JSON on one line.
    pub(super) fn json(&self, model: &RigidModel) -> String {
        let quoted = |name: &str| format!("{name:?}").replace("--", "-\\u002d");
        let joint = |joint: JointId| quoted(model.joint_name(joint));
        let list = |values: &[f64]| values.iter().copied().map(number).collect::<Vec<_>>().join(", ");
        let error = |unit: &str, error: MimicError| {
            let [bound, sampled] = [error.bound, error.sampled].map(number);
            format!(r#""error_{unit}": {bound}, "sampled_{unit}": {sampled}"#)
        };
        let unit = |joint: JointId| if model.case.mechanism.joints()[joint].slides() { "m" } else { "rad" };
        let relations = self.relations.iter().map(|own| {
            let (name, coefficients) = (joint(own.joint), list(&own.polynomial.coefficients));
            let error = error(unit(own.joint), own.error);
            format!(r#"{{"joint": {name}, {error}, "chebyshev": [{coefficients}]}}"#)
        });
        let pins = self.pins.iter().map(|own| {
            let (name, link) = (joint(own.joint), quoted(model.link_name(own.link)));
            format!(r#"{{"joint": {name}, "link": {link}, {}}}"#, error("m", own.error))
        });
        let (relations, pins) = (relations.collect::<Vec<_>>().join(", "), pins.collect::<Vec<_>>().join(", "));
        let (driver, unit, domain) = (joint(self.driver), unit(self.driver), list(&self.domain));
        let head = format!(r#""driven": {driver}, "domain_{unit}": [{domain}], "degree": {}"#, self.degree);
        format!(r#"{{{head}, "joints": [{relations}], "pins": [{pins}]}}"#)
    }
}

/// Fits all joints of the tree but the driven one.
fn fits(model: &RigidModel, case: &Case, range: InputRange, own: &Mimics) -> Result<Vec<JointRelation>> {
    let mut nodes = chebyshev::nodes(own.domain, LEAST.max(NODES * (own.degree + 1)));
    // The solver follows the motion from the start.
    if range.sense * (range.ends[1] - range.ends[0]) < 0.0 {
        nodes.reverse();
    }
    let bodies: Vec<&Body> = model.bodies.iter().filter(|body| body.branch.joint != own.driver).collect();
    let mut values = vec![Vec::with_capacity(nodes.len()); bodies.len()];
    let mut solver = PoseSolver::counting_turns(case)?;
    for &node in &nodes {
        solver.solve(range.input(node), 1.0, 0.0, Stage::Positions)?;
        let state = solver.with_angles();
        for (body, values) in bodies.iter().zip(&mut values) {
            values.push(body.coordinate_in(case, state) - body.coordinate);
        }
    }
    let relations = bodies.iter().zip(&values).map(|(body, values)| {
        let mut polynomial = Chebyshev::fit(own.domain, own.degree, &nodes, values);
        polynomial.drop_noise(NOISE);
        JointRelation { joint: body.branch.joint, polynomial, error: MimicError::default() }
    });
    Ok(relations.collect())
}
