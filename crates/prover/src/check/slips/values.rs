//! Finds wrong numbers in a formula and wrong parameters.
//!
//! The right number is calculated instant by instant.
//! The right number must be the same at all instants, and must have few digits, like numbers that people write.
//! If the formula is wrong by a factor or is constant, each of its numbers could be the wrong number. A number is then
//! reported only if its digits are confused: exchanged, lost, added or doubled.

use std::collections::BTreeSet;

use super::edits;
use super::places::{at_every_place, numbered, replaced};
use super::slip::{FormulaSlip, SlipKind, Tried};
use crate::check::trial::Trial;
use formula::{FormulaTree, NodeShape, Operator, information};
use linkage::math::KeepNan;

/// A number with more digits than this is not considered as written by a person.
const DIGITS: usize = 6;
/// Relative accuracy to which a number must be known before its digits are compared.
const KNOWN: f64 = 1e-8;
/// A factor is simple if its information is below this limit (bits). A simple factor is no evidence of confused digits.
const SIMPLE: f64 = 2.0;

/// Tries every number of the formulas `used`, and every parameter in them.
pub(super) fn tried(trial: &mut Trial, used: &[usize], tried: &mut Tried) {
    let formulas = trial.formulas.clone();
    let known: BTreeSet<&str> =
        used.iter().flat_map(|&index| formulas.list[index].tree.names()).map(|(name, _)| name).collect();
    for own in &formulas.parameters {
        let names: Vec<(String, f64)> = own.names().map(|(name, number)| (name.to_string(), number.value)).collect();
        // A parameter with two names in the formula is skipped, because the two numbers would have to change together.
        let names: Vec<&(String, f64)> = names.iter().filter(|(name, _)| known.contains(name.as_str())).collect();
        let &[(name, number)] = names.as_slice() else { continue };
        let Some(place) = trial.sheet.named(name) else { continue };
        tried.count += 1;
        let Some((right, is_confused)) = meant(trial, place, own.given) else { continue };
        let number = FormulaTree::number(if own.given == 0.0 { right } else { number * (right / own.given) });
        let change = |index: &usize| (*index, formulas.list[*index].tree.with_name(name, &number));
        let changed: Vec<(usize, FormulaTree)> = used.iter().map(change).collect();
        let text = |value: f64| format!("{} = {value}", own.key);
        put(trial, tried, &changed, "[parameters]", [text(own.given), text(right)], is_confused);
    }
    for &index in used {
        let own = &formulas.list[index];
        let mut numbers = Vec::new();
        let mut next = 0;
        at_every_place(&own.tree, &mut |_, part| {
            if let NodeShape::Number(value) = part.shape {
                numbers.push((next, value));
            }
            next += 1;
        });
        for (number, value) in numbers {
            let place = trial.sheet.places(index)[number];
            tried.count += 1;
            let Some((right, is_confused)) = meant(trial, place, value) else { continue };
            let changed = vec![(index, replaced(&own.tree, number, &FormulaTree::number(right)))];
            let written = numbered(&own.tree, number).to_string();
            put(trial, tried, &changed, &own.name, [written, right.to_string()], is_confused);
        }
    }
}

fn put(
    trial: &mut Trial,
    tried: &mut Tried,
    changed: &[(usize, FormulaTree)],
    formula: &str,
    texts: [String; 2],
    is_confused: bool,
) {
    let [written, right] = texts;
    let slip = FormulaSlip {
        formula: formula.into(),
        kind: SlipKind::Value,
        written,
        right,
        everywhere: false,
        marks: Vec::new(),
    };
    // A corrected number leaves the units unchanged. If the wrong number has no confused digits, its correction ranks
    // after missing terms.
    let rank = (false, !is_confused, changed[0].0 != trial.index, SlipKind::Value);
    tried.put(trial, changed, slip, rank);
}

/// The number that must replace `wrong` to make the formula right at all instants; it has the sign of `wrong`.
/// Also returns whether `wrong` looks like this number with confused digits.
fn meant(trial: &mut Trial, place: usize, wrong: f64) -> Option<(f64, bool)> {
    if trial.is_spent() || wrong == 0.0 {
        return None;
    }
    let depending = trial.sheet.depending(&[place]);
    let mut found: Option<[f64; 2]> = None;
    for instant in trial.order.clone() {
        let target = trial.targets[instant];
        let Some([factor, known]) = trial.sheet.amount(Operator::Times, &depending, instant, 1.0, &target) else {
            continue;
        };
        match found {
            Some([other, well]) if (factor - other).abs() > known + well => return None,
            Some([_, well]) if well <= known => {}
            _ => found = Some([factor, known]),
        }
    }
    let [factor, known] = found?;
    if !(known <= KNOWN * factor.abs()) {
        return None;
    }
    let right = short(factor * wrong, known * wrong.abs())?;
    let is_open = trial.is_constant() || trial.is_number;
    let is_confused = is_confused(wrong, right);
    (right * wrong > 0.0 && (!is_open || is_confused)).then_some((right, is_confused))
}

/// The number with the fewest digits that agrees with `value` within `error`. `None` if the number needs more than
/// `DIGITS` digits.
fn short(value: f64, error: f64) -> Option<f64> {
    (0..DIGITS).find_map(|digits| {
        let own: f64 = format!("{value:.digits$e}").parse().ok()?;
        ((own - value).abs() <= error.larger(4.0 * f64::EPSILON * value.abs())).then_some(own)
    })
}

/// Whether the digits of the right number were confused: two digits exchanged, or one digit lost, added or doubled.
/// A usual value of gravity in place of another usual value also counts as confused digits.
/// A shifted decimal point and a simple factor are not confused digits.
fn is_confused(wrong: f64, right: f64) -> bool {
    if edits::GRAVITY.contains(&wrong) && edits::GRAVITY.contains(&right) {
        return true;
    }
    let digits = |value: f64| -> Vec<u8> {
        let text = format!("{:e}", value.abs());
        text.split('e').next().unwrap_or_default().bytes().filter(u8::is_ascii_digit).collect()
    };
    let [one, other] = [digits(wrong), digits(right)];
    let is_simple = information(right / wrong, KNOWN) < SIMPLE;
    let is_lost = |long: &[u8], short: &[u8]| {
        long.len() == short.len() + 1
            && short.len() >= 3
            && (0..long.len()).any(|at| [&long[..at], &long[at + 1..]].concat() == short)
    };
    // Trailing zeros count as digits, so 106 and 160 have the same digits.
    let length = one.len().max(other.len());
    let padded =
        |digits: &[u8]| -> Vec<u8> { digits.iter().copied().chain(std::iter::repeat(b'0')).take(length).collect() };
    let [written, meant] = [padded(&one), padded(&other)];
    let is_exchanged = (1..length).any(|at| {
        let mut turned = written.clone();
        turned.swap(at - 1, at);
        turned == meant && written != meant
    });
    !is_simple && (is_exchanged || is_lost(&one, &other) || is_lost(&other, &one))
}

#[cfg(test)]
mod tests {
    use super::{is_confused, short};

    #[test]
    fn confused_digits_are_distinguished_from_simple_factors() {
        for (wrong, right) in
            [(0.0352, 0.0325), (164.0, 146.0), (106.0, 160.0), (105.0, 150.0), (10.0, 9.81), (0.105, 0.1055)]
        {
            assert!(is_confused(wrong, right), "{wrong} for {right}");
        }
        for (wrong, right) in [(40.0, 80.0), (4.0, 40.0), (0.5, 0.25), (3.0, 7.0), (160.0, 176.0)] {
            assert!(!is_confused(wrong, right), "{wrong} for {right}");
        }
    }

    #[test]
    fn only_numbers_with_few_digits_are_short() {
        assert_eq!(short(0.032_500_000_000_001, 1e-14), Some(0.0325));
        assert_eq!(short(0.032_512_345_678, 1e-14), None);
    }
}
