//! A claim's own numbers over a course.

use super::course::Course;
use super::judge::Claimed;
use formula::{Id, Program, Rounded};
use linkage::error::Result;
use scenario::{Claim, Formulas};

impl Course<'_> {
    /// What the formulas that claim something give, each at the instants at which it holds.
    #[must_use]
    pub fn given(&self, formulas: &Formulas) -> Vec<Vec<Rounded>> {
        let nodes: Vec<Id> = formulas.claims().map(|(formula, _)| formula.id).collect();
        let mut program = Program::of(&formulas.graph, &nodes);
        let mut all = vec![Vec::new(); nodes.len()];
        for row in 0..self.len() {
            let values = program.run(&self.inputs(row));
            for ((own, value), (formula, _)) in all.iter_mut().zip(values).zip(formulas.claims()) {
                if formula.holds_at(self.cranks()[row]) {
                    own.push(*value);
                }
            }
        }
        all
    }

    /// What the side finds for a claim, instant by instant, in the claim's unit, with how well it is known.
    ///
    /// # Errors
    /// If the course lacks a channel of the claim.
    pub fn values(&self, claim: &Claim) -> Result<Vec<Rounded>> {
        let mut claimed = Claimed::of(claim, 0, self)?;
        Ok((0..self.len()).map(|row| claimed.at(row)[0]).collect())
    }
}
