//! The quantity of a figure with its derivatives, computed from the derivatives of its channels.

use analytic::AssurSolver;
use formula::{FormulaGraph, Program, Rounded};
use linkage::case::Case;
use linkage::error::Result;
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Trajectory};
use precise::{Dual, Readings, Scalar, Snapshot};
use scenario::Claim;

/// A quantity as an expression of channels, with its partial derivatives.
#[derive(Debug)]
pub(crate) struct Quantity {
    /// For every name of the expression: its channel; for the magnitude of a vector, also the channel of the other
    /// component; and the factor from SI to the unit of the name.
    names: Vec<(Channel, Option<Channel>, f64)>,
    /// Computes the value, followed by the partial derivatives with respect to the names.
    program: Program,
    /// A full turn in the unit of the quantity, if it is an angle.
    pub(super) turn: Option<f64>,
}

impl Quantity {
    /// The quantity of a claim; `None` if the claim contains names that are not channels.
    pub(crate) fn of(claim: &Claim) -> Option<Quantity> {
        let words: Vec<&str> = claim.channels.iter().map(|(name, _)| name.as_str()).collect();
        let mut graph = FormulaGraph::new(&words, 0);
        let node = graph.add(&claim.tree).ok()?;
        let slopes = (0..words.len()).map(|input| graph.derivative(node, input));
        let nodes: Vec<_> = std::iter::once(node).chain(slopes.collect::<Vec<_>>()).collect();
        let name = |(_, own): &(String, scenario::PrintedChannel)| {
            (own.channel.clone(), own.other_component(), own.from_si(1.0, None))
        };
        let names = claim.channels.iter().map(name).collect();
        Some(Quantity { names, program: Program::of(&graph, &nodes), turn: claim.turn() })
    }

    /// The quantity in a state. At a kink, and where the quantity has no value, its derivatives are NaN.
    pub(crate) fn at<const N: usize>(
        &mut self,
        readings: &Readings<Dual<f64, N>>,
        state: &Snapshot<Dual<f64, N>>,
    ) -> Dual<f64, N> {
        let read = |channel: &Channel| readings.read(state, channel).unwrap_or(Dual::constant(f64::NAN));
        let named = |(channel, other, factor): &(Channel, Option<Channel>, f64)| {
            let own = read(channel);
            let own = match other {
                Some(other) => {
                    let other = read(other);
                    (own * own + other * other).sqrt()
                }
                None => own,
            };
            own * Dual::of(*factor)
        };
        let all: Vec<Dual<f64, N>> = self.names.iter().map(named).collect();
        let inputs: Vec<Rounded> = all.iter().map(|own| Rounded::exact(own.value)).collect();
        let found = self.program.run(&inputs);
        let mut sum = Dual::constant(found[0].known());
        for (own, partial) in all.iter().zip(&found[1..]) {
            for (slope, by) in sum.slopes.iter_mut().zip(&own.slopes) {
                *slope += partial.value * by;
            }
        }
        sum
    }
}

/// Solves the part of a case that the claims need.
pub(super) fn solved(case: &Case, claims: &[Claim]) -> Result<Trajectory> {
    let channels: Vec<Channel> = claims.iter().flat_map(Claim::components).collect();
    AssurSolver.solve(&case.wanting_only(&channels).scene()?.case)
}
