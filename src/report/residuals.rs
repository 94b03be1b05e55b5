//! Every residual of a proof beside its bound, for readers who examine the bounds.

use crate::plain::cells::{table, trimmed};
use crate::plain::judged::{self, Judged, Sort};
use linkage::math::statistics::share;
use prover::numbers;
use prover::proof::Proof;

/// One line for every channel of every engine, and for every check.
#[must_use]
pub fn all(proof: &Proof) -> String {
    let rows = judged::checks_last(proof).into_iter().map(|own| {
        let Judged { sort, engine, name, value, bound, unit, verdict, .. } = own;
        let side = engine.filter(|_| sort != Sort::Check).map_or("", |engine| engine.info.name);
        let used = numbers::significant(share(value, bound), 3);
        let [value, bound] = [value, bound].map(|number| numbers::significant(number, 4));
        [name, side.into(), value, bound, unit.into(), used, verdict.word().into()]
    });
    let header = "channel or check | side | residual> | bound> | unit | used> | verdict";
    format!("\n{}\n", trimmed(table(header).add_rows(rows)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use prover::proof::{Options, prove};
    use scenario::of_repository;

    /// Residual, bound and what is used of it, line by line, in the order of the proof.
    #[test]
    fn every_residual_stands_beside_its_bound() {
        let proof =
            prove(&of_repository("scenarios/crank_rocker.toml"), &Options::default().step(2e-3).sweeps(16)).unwrap();
        let channels = proof
            .engines
            .iter()
            .flat_map(|engine| engine.channels.iter().chain(engine.own_forces.iter().flat_map(|own| &own.channels)));
        let channels = channels.map(|own| ([own.residual.max, own.bound], own.verdict.word()));
        let checks = proof.all_checks().map(|own| ([own.value, own.bound], own.verdict.word()));
        let text = all(&proof);
        let verdicts = ["agree", "disagree", "inconclusive", "expected"];
        let mut lines = text.lines().filter(|line| verdicts.iter().any(|word| line.ends_with(word)));
        for ([value, bound], verdict) in channels.chain(checks) {
            let line = lines.next().unwrap();
            let numbers: Vec<f64> = line.split_whitespace().filter_map(|cell| cell.parse().ok()).collect();
            let found = &numbers[numbers.len() - 3..];
            for (found, wanted) in found.iter().zip([value, bound, value / bound]) {
                assert!((found - wanted).abs() <= 5e-3 * wanted.abs(), "{line}: {found} {wanted}");
            }
            assert!(line.ends_with(verdict), "{line}: {verdict}");
        }
        assert_eq!(lines.next(), None);
    }
}
