//! Coordinates of joints as polynomials of the driven joint's coordinate, with proven bounds on the errors.
//!
//! A polynomial is the least-squares fit on Chebyshev nodes of the range that the case's grid spans.
//! The bounds hold for every pose of the range, also between the nodes: see the file `bound.rs`.

mod bound;
mod chebyshev;
mod mimics;
mod range;

pub use mimics::{JointRelation, MOST_DEGREE, MimicError, Mimics, PinError};

use crate::clearance;
use crate::rigid::{Body, RigidModel};
use crate::sentences;
use analytic::PoseSolver;
use chebyshev::Chebyshev;
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::mechanism::GROUND;
use linkage::trajectory::Stage;
use range::InputRange;

/// Number of nodes for each coefficient of a polynomial. `LEAST` is the smallest number of nodes.
const NODES: usize = 4;
const LEAST: usize = 256;
/// If all coefficients of degree 2 or more are below this value (rad or m), they count as rounding errors.
const NOISE: f64 = 1e-11;

impl Mimics {
    /// Polynomials of degree `degree` over the range that the case's grid spans. If poses repeat after a turn, the
    /// range is at most one turn.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`](linkage::ErrorKind::Unsupported) for several drives.
    /// [`ErrorKind::Numeric`](linkage::ErrorKind::Numeric) if no bound can be proven near a singular pose.
    /// The errors of the pose solver.
    pub fn new(model: &RigidModel, degree: usize) -> Result<Self> {
        if !model.case.drives.further().is_empty() {
            let message = sentences::cannot_be_written_to(&sentences::RELATIONS_WITH_SEVERAL_DRIVES, &"URDF");
            return Err(Error::new(ErrorKind::Unsupported, message).help(sentences::WRITE_NO_RELATIONS));
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

    /// Returns those points of joints that the relations move, each with an error of zero.
    /// These points lie on links whose path to the ground in the tree contains a joint other than the driven joint.
    fn placed(&self, model: &RigidModel) -> Vec<PinError> {
        let mut moved = vec![false; model.case.mechanism.links().len()];
        for body in &model.bodies {
            moved[body.branch.link.index()] = moved[body.branch.parent.index()] || body.branch.joint != self.driver;
        }
        let joints = model.bodies.iter().chain(&model.closing).flat_map(|body| {
            // In the tree, the points of a hinge on its two links coincide, so that one of them is enough.
            let twice = body.slides() || model.tree.cut.contains(&body.branch.joint);
            let ends = [(body.branch.parent, true), (body.branch.link, twice)];
            ends.into_iter().filter(|(_, counts)| *counts).map(|(link, _)| (body.branch.joint, link))
        });
        let pins = joints.filter(|(_, link)| *link != GROUND && moved[link.index()]);
        pins.map(|(joint, link)| PinError { joint, link, error: MimicError::default() }).collect()
    }
}

/// Fits polynomials to the coordinates of all joints of the tree, except the driven joint.
fn fits(model: &RigidModel, case: &Case, range: InputRange, own: &Mimics) -> Result<Vec<JointRelation>> {
    let mut nodes = chebyshev::nodes(own.domain, LEAST.max(NODES * (own.degree + 1)));
    // The solver follows the motion, so the nodes must be in the order in which the motion reaches them.
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
