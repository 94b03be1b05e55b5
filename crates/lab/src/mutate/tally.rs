//! Counts of the outcomes of planted faults.

use super::mutant::{FaultyParty, Mutated};
use super::seen::FaultyProof;

/// Numbers of faults by outcome.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Share {
    /// Faults for which a channel or check disagrees.
    pub detected: usize,
    /// Faults because of which a party gives no answer.
    pub refused: usize,
    /// Faults with which the proof is inconclusive.
    pub inconclusive: usize,
    /// Faults with which all comparisons agree.
    pub escaped: usize,
    /// Faults that change no exact answer.
    pub equivalent: usize,
}

impl Share {
    /// Counts one more outcome.
    pub fn add(&mut self, outcome: &FaultyProof) {
        match outcome {
            FaultyProof::Detected { .. } => self.detected += 1,
            FaultyProof::Refused(_) => self.refused += 1,
            FaultyProof::Inconclusive(_) => self.inconclusive += 1,
            FaultyProof::Escaped => self.escaped += 1,
            FaultyProof::Equivalent(_) => self.equivalent += 1,
        }
    }

    /// Number of faults that change the answer.
    pub fn real(&self) -> usize {
        self.found() + self.inconclusive + self.escaped
    }

    /// Faults that were found.
    pub fn found(&self) -> usize {
        self.detected + self.refused
    }
}

/// Counts over scenarios.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FaultCounts {
    /// Faults in one party.
    pub planted: Share,
    /// Faults in the code that all parties share.
    pub trunk: Share,
    /// Mistakes in formulas.
    pub formulas: Share,
    /// Kinds that were planted in the code shared by all parties and have an effect.
    pub trunk_kinds: Vec<&'static str>,
    /// The kinds in `trunk_kinds` that are found in at least one scenario.
    pub trunk_found: Vec<&'static str>,
    /// Kinds planted anywhere.
    pub kinds: Vec<&'static str>,
}

/// Summary of all planted faults.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultTally {
    /// Every fault that has an effect is found.
    AllFound,
    /// No proof with a fault agrees, but some proofs are inconclusive.
    NoneEscapes,
    /// Some proofs with a fault agree, so the fault escapes.
    SomeEscape,
    /// Only faults in the shared code have an effect, and some of these faults are not found.
    TrunkOpen,
    /// No planted fault has an effect, so the test proves nothing.
    Nothing,
}

impl FaultCounts {
    /// Summary of all faults. Faults in the shared code count only if no other fault has an effect.
    pub fn end(&self) -> FaultTally {
        let FaultCounts { planted, formulas, trunk_kinds, trunk_found, .. } = self;
        let of = |count: fn(&Share) -> usize| count(planted) + count(formulas);
        match (of(Share::real), of(|own| own.escaped), of(|own| own.inconclusive)) {
            (0, _, _) if trunk_kinds.is_empty() => FaultTally::Nothing,
            (0, _, _) if trunk_found.len() < trunk_kinds.len() => FaultTally::TrunkOpen,
            (_, 0, 0) => FaultTally::AllFound,
            (_, 0, _) => FaultTally::NoneEscapes,
            (_, _, _) => FaultTally::SomeEscape,
        }
    }
}

/// Counts all outcomes.
pub fn tally(all: &[Mutated]) -> FaultCounts {
    let mut tally = FaultCounts::default();
    let put = |names: &mut Vec<&'static str>, name| {
        if !names.contains(&name) {
            names.push(name);
        }
    };
    for mutant in all.iter().flat_map(|one| &one.mutants) {
        put(&mut tally.kinds, mutant.kind.name);
        match mutant.party {
            FaultyParty::Assur | FaultyParty::Newton | FaultyParty::Engine => tally.planted.add(&mutant.outcome),
            FaultyParty::Formulas => tally.formulas.add(&mutant.outcome),
            FaultyParty::All => {
                tally.trunk.add(&mutant.outcome);
                if !matches!(mutant.outcome, FaultyProof::Equivalent(_)) {
                    put(&mut tally.trunk_kinds, mutant.kind.name);
                }
                if mutant.outcome.is_found() {
                    put(&mut tally.trunk_found, mutant.kind.name);
                }
            }
        }
    }
    tally
}
