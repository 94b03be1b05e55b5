//! Mistakes in formulas. The wrong formulas are judged in the same way as the formulas in the command `run`.

use std::collections::BTreeSet;

use super::effect::{Effect, rounding};
use super::kinds::{FaultKind, Mistake};
use super::mutant::Spoiled;
use super::seen::{Eyes, FaultyProof};
use super::stage::Stage;
use formula::{FormulaTree, NodeId, Operator, Program, Rounded};
use linkage::error::Result;
use linkage::math::KeepNan;
use linkage::math::statistics::share;
use linkage::trajectory::{Channel, Stage as Of};
use prover::check::{KnownTrajectory, planted};
use prover::run::{Judgement, Reference, formula_checks};
use scenario::{Claim, Formula, Formulas};

/// Work of one operation of a formula at one instant. The unit is the work of an engine's step on a four-bar.
const OPERATION: f64 = 0.04;

/// A mistake, ready to be judged.
pub(super) struct Planting {
    pub(super) what: Spoiled,
    formulas: Formulas,
}

impl Stage<'_> {
    /// Names of the formulas that both analytic sides judge.
    fn judged_formulas(&self) -> BTreeSet<&str> {
        let judged = self.sides.judgement.iter().flat_map(|own| &own.sides[Reference::Assur]);
        judged.filter_map(|all| Some(all.first()?.name.as_str())).collect()
    }

    /// Indices of the formulas that claim an exact value, and of the derivation steps behind these formulas.
    /// A claim with a stated error is left out: a claim with a mistake may still be correct within its stated error.
    /// A formula that `docs/findings.md` calls wrong is left out too.
    pub(super) fn formulas(&self) -> Vec<usize> {
        let all = &self.scenario.formulas.list;
        let judged = self.judged_formulas();
        let mut used: BTreeSet<&str> = BTreeSet::new();
        let mut found = Vec::new();
        for (index, own) in all.iter().enumerate().rev() {
            let is_right = own.claim.is_some() && own.finding.is_none() && judged.contains(own.name.as_str());
            let is_exact = is_right && own.error.is_none();
            if is_exact || used.contains(own.name.as_str()) {
                used.extend(own.tree.names().into_iter().map(|(name, _)| name));
                found.push(index);
            }
        }
        found.reverse();
        found
    }

    /// Work of judging all formulas once, on both analytic sides. The unit is the work of an engine's step on a
    /// four-bar.
    pub(super) fn work_of_formulas(&self) -> f64 {
        let formulas = &self.scenario.formulas;
        let nodes: Vec<NodeId> = formulas.claims().map(|(formula, _)| formula.id).collect();
        let operations = Program::of(&formulas.graph, &nodes).len() * self.case.grid.len();
        // A formula's value and two derivatives are evaluated.
        // Value and derivatives together need about six times the operations of the value.
        OPERATION * 2.0 * 6.0 * operations as f64
    }

    /// Plants a mistake in a formula; `None` if no position in the formula suits the mistake.
    pub(super) fn planting(&self, kind: &FaultKind, mistake: Mistake, of: usize, size: f64) -> Option<Planting> {
        let formulas = &self.scenario.formulas;
        let own = &formulas.list[of];
        let with_tree = |tree: FormulaTree| {
            let wrong = tree.to_string();
            let what = Spoiled { formula: own.name.clone(), right: own.text.clone(), wrong };
            Some(Planting { what, formulas: formulas.with_tree(of, tree)? })
        };
        let with_claim = |claim: Claim| {
            let mut formulas = formulas.clone();
            let right = own.claim.as_ref()?.text.clone();
            let what = Spoiled { formula: own.name.clone(), right, wrong: claim.text.clone() };
            formulas.list[of].claim = Some(claim);
            Some(Planting { what, formulas })
        };
        match mistake {
            // The mistake may suit many positions in the formula. One of them is chosen.
            // The choice depends on the formula and on the kind of fault, but not on the run.
            Mistake::Slip(slip) => {
                let number = own.name.bytes().chain(kind.name.bytes()).map(usize::from).sum();
                with_tree(planted(formulas, of, slip, number)?)
            }
            Mistake::Larger => {
                let more = FormulaTree::pair(Operator::Times, own.tree.clone(), FormulaTree::number(1.0 + size));
                with_tree(more)
            }
            Mistake::Subject => {
                with_claim(self.other(own, &|one, other| one.kind == other.kind && one.of != other.of)?)
            }
            Mistake::Quantity => with_claim(self.other(own, &|one, other| {
                one.kind.unit == other.kind.unit && one.kind != other.kind && one.of == other.of
            })?),
        }
    }

    /// The claim, changed to another channel: the first one for which `is_meant` returns true.
    /// The search goes from the claimed channel to the end of the list, and then continues from the start of the list.
    fn other(&self, own: &Formula, is_meant: &dyn Fn(&Channel, &Channel) -> bool) -> Option<Claim> {
        let claim = own.claim.as_ref()?;
        let [(name, claimed)] = claim.channels.as_slice() else { return None };
        // If both channels are of the same kind, the new name keeps the unit of the claimed name, such as `deg`.
        let unit = name.strip_prefix(&format!("{}.", claimed.channel.subject()))?;
        let is_si = unit == claimed.channel.kind.suffix;
        let all = self.right.channels();
        let first = all.iter().position(|channel| *channel == claimed.channel)?;
        let other = all[first..].iter().chain(all).find(|other| is_meant(&claimed.channel, other))?;
        let suffix = if other.kind == claimed.channel.kind { unit } else { other.kind.suffix };
        let is_named = *name == claim.text && (is_si || other.kind == claimed.channel.kind);
        is_named.then(|| Claim::of_channels(&format!("{}.{suffix}", other.subject()), all).ok()).flatten()
    }

    /// Effect of a mistake: the change of the formula's value, or of the claimed channel.
    pub(super) fn formula_effect(&self, own: &Planting) -> Result<Effect> {
        let right = &self.scenario.formulas;
        self.sides.on_course(&self.case, Reference::Assur, |course: &KnownTrajectory| {
            let [ours, theirs] = [right, &own.formulas].map(|formulas| course.given(formulas));
            let (mut largest, mut beyond, mut unsolved) = (0.0f64, false, false);
            let judged = self.judged_formulas();
            let claims = right.claims().zip(own.formulas.claims());
            for (((formula, claim), (_, claimed)), (ours, theirs)) in claims.zip(ours.iter().zip(&theirs)) {
                if formula.error.is_some() || !judged.contains(formula.name.as_str()) {
                    continue;
                }
                let stage = claim.channels.iter().map(|(_, own)| own.channel.kind.stage).max();
                let allowed = rounding(stage.unwrap_or(Of::BalancingMoment));
                let turn = claim.turn();
                let mut compare = |ours: &[Rounded], theirs: &[Rounded]| {
                    let scale = ours.iter().fold(0.0f64, |most, own| most.larger(own.value.abs()));
                    for (one, other) in ours.iter().zip(theirs) {
                        let change = other.value - one.value;
                        let change = turn.map_or(change, |turn| change - turn * (change / turn).round()).abs();
                        unsolved |= change.is_nan();
                        largest = largest.larger(share(change, scale));
                        beyond |= !(change <= one.error + other.error + allowed * scale);
                    }
                };
                if claim.text == claimed.text {
                    compare(ours, theirs);
                } else {
                    let holds = |claim: &Claim| -> Result<Vec<Rounded>> {
                        let all = course.values(claim)?.into_iter().zip(self.right.inputs());
                        Ok(all.filter(|(_, crank)| formula.holds_at(**crank)).map(|(value, _)| value).collect())
                    };
                    compare(&holds(claim)?, &holds(claimed)?);
                }
            }
            Ok(match (unsolved, beyond) {
                (true, _) => Effect::Unsolved,
                (false, true) => Effect::Changes(largest),
                (false, false) => Effect::Equivalent(largest),
            })
        })
    }

    /// Judges the formulas with the mistake on both analytic sides.
    pub(super) fn formula_outcome(&self, own: &Planting) -> FaultyProof {
        let judged = self.sides.claimed(&self.case, &own.formulas).map(|sides| {
            let judgement = Judgement::of(sides);
            let checks = formula_checks(&judgement);
            Eyes::default().formulas(&judgement, &checks).outcome()
        });
        judged.unwrap_or_else(|error| FaultyProof::Refused(error.message().into()))
    }
}
