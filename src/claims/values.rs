//! A claim's own numbers over a course.

use super::course::Course;
use super::judge::graph_of;
use crate::scenario::Claim;
use formula::{Program, Rounded};
use linkage::error::Result;

impl Course<'_> {
    /// What the side finds for a claim, instant by instant, in the claim's unit, with how well it is known.
    ///
    /// # Errors
    /// If the course lacks a channel of the claim.
    pub fn values(&self, claim: &Claim) -> Result<Vec<Rounded>> {
        let channels = self.channels(claim, 0)?;
        let (graph, node) = graph_of(claim);
        let mut program = Program::of(&graph, &[node]);
        let mut inputs = self.figures(claim)?;
        let numbers = inputs.len();
        inputs.resize(numbers + channels.len(), Rounded::exact(0.0));
        let mut at = |row: usize| {
            for (input, channel) in inputs[numbers..].iter_mut().zip(&channels) {
                *input = channel.at(row);
            }
            program.run(&inputs)[0]
        };
        Ok((0..self.len()).map(&mut at).collect())
    }
}
