//! Three hundred planted mistakes: all are found, most are named rightly, and no right cell is called wrong.

use std::collections::BTreeMap;

use prover::mark::{CellVerdict, MarkCriterion, marked};

use super::mistake::{Mistake, SORTS, plant};
use super::{read, variant, written};
use crate::common::sketch::RandomSource;

/// Number of mistakes.
const COUNT: usize = 300;
/// The criterion allows an error of this share of each value, but at least half a unit of the last requested decimal.
const SHARE: f64 = 0.05;

#[test]
fn planted_mistakes_are_found_and_named() {
    let mut random = RandomSource::from_seed(20);
    let sheets: Vec<_> = (1..=60).map(variant).collect();
    let (mut planted, mut named, mut cells, mut tally) = (0, 0, 0, BTreeMap::<&str, [usize; 2]>::new());
    let mut next = 0;
    while planted < COUNT {
        let (scenario, sheet) = &sheets[planted % sheets.len()];
        let sort = SORTS[next % SORTS.len()];
        next += 1;
        assert!(next < 20 * COUNT, "only {planted} mistakes can be planted");
        let Some(Mistake { sort, answers, names }) = plant(sort, scenario, sheet, &mut random) else { continue };
        // Right answers are written with the requested decimals, wrong answers with at least three significant digits.
        let text = written(sheet, &answers);
        let given = read(sheet, &text);
        // The expected verdicts follow from the documented criterion.
        let is_wrong = |row: usize, column: usize| {
            let (right, answer) = (sheet.right[row][column], given[row][column].as_ref().unwrap().value);
            let half = 0.5 * 10f64.powi(-sheet.decimals[column]) * (1.0 + 1e-9);
            let (gap, size) = match sheet.columns[column].turn {
                Some(turn) => {
                    ((answer - right + turn / 2.0).rem_euclid(turn) - turn / 2.0, turn / std::f64::consts::TAU)
                }
                None => (answer - right, right.abs()),
            };
            let allowed = if SHARE * size > half { SHARE * size } else { half };
            !(gap.abs() <= allowed)
        };
        let all: Vec<(usize, usize)> =
            (0..answers.len()).flat_map(|row| (0..sheet.columns.len()).map(move |column| (row, column))).collect();
        let wrong: Vec<_> = all.iter().filter(|(row, column)| is_wrong(*row, *column)).collect();
        // A mistake counts only if it changes some number by more than the criterion allows.
        if wrong.is_empty() {
            continue;
        }
        planted += 1;
        let found = marked(sheet, &given, MarkCriterion::Within(SHARE), &[]);
        for &(row, column) in &all {
            let expected = if is_wrong(row, column) { CellVerdict::Wrong } else { CellVerdict::Right };
            let verdict = found.cells[row][column].verdict;
            assert_eq!(verdict, expected, "{sort} in {}: {row}, {}", scenario.name, sheet.columns[column].name);
            cells += 1;
        }
        let right = wrong.iter().filter(|(row, column)| names(found.cells[*row][*column].cause.as_ref())).count();
        let is_named = 2 * right > wrong.len();
        named += usize::from(is_named);
        let own = tally.entry(sort).or_default();
        own[usize::from(!is_named)] += 1;
        if !is_named {
            let causes: Vec<_> = wrong
                .iter()
                .map(|(row, column)| format!("{} {:?}", sheet.columns[*column].name, found.cells[*row][*column].cause))
                .collect();
            println!(
                "{sort} in {}: {right} of {}: {}",
                scenario.name,
                wrong.len(),
                causes[..causes.len().min(6)].join("; ")
            );
        }
    }
    for (sort, [right, other]) in &tally {
        println!("{sort:40} {right:3} named, {other:3} not");
    }
    println!("{planted} mistakes, {cells} cells judged as expected, {named} mistakes named rightly");
    assert!(tally.len() >= 20, "{tally:?}");
    assert!(100 * named >= 85 * planted, "{named} of {planted}");
}
