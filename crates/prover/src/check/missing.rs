//! Finds a term or factor that is missing in a formula.
//!
//! At every position of the formula, the summand or factor that makes the formula right is calculated for each instant.
//! If these amounts are proportional to an expression of the derivation, the expression is missing at this position.

mod dictionary;
mod monomials;

use std::collections::BTreeMap;
use std::ops::Range;

use super::dimension::Dimensions;
use super::slips::{at_every_place, numbered, replaced, used_by};
use super::trial::Trial;
use dictionary::{Dictionary, Entry};
use formula::{FormulaTree, NodeShape, Operator};
pub(in crate::check) use monomials::Monomials;

/// A term or a factor that is missing.
#[derive(Clone, Debug, PartialEq)]
pub struct Missing {
    /// Name of the formula that lacks the term or factor.
    pub formula: String,
    /// The subexpression to which the term must be added, or which must be multiplied by the factor; `None` for the
    /// whole formula.
    pub beside: Option<String>,
    /// The missing expression with its sign: `+ m*g*s*cos(phi)`, `/ cos(beta)^3`.
    pub what: String,
    /// Byte range of the subexpression `beside` in the formula's text; the range of the whole text if `beside` is
    /// `None`.
    pub at: Range<usize>,
    /// Whether the missing expression is a factor rather than a term.
    pub is_factor: bool,
}

/// Fewest instants from which a function of the crank angle is recognised.
const FEWEST: usize = 4;
/// Relative accuracy to which a constant amount is recognised as a product of known quantities.
const ACCURACY: f64 = 1e-9;

/// For each instant, the missing amount at one position of the formula, and the error of this amount; `None` if the
/// amount cannot be determined.
type Needed = Vec<Option<[f64; 2]>>;

/// Limit for accepting a product of parameters only because its value equals a constant amount. The limit applies to
/// the expected number of products that equal the amount by chance.
const CHANCE: f64 = 0.5;
/// Number of positions that is assumed for a missing product of several quantities. The assumption is made if the
/// formula is wrong by a constant factor or offset, or if the mechanism's value is constant.
const LONG: f64 = 100.0;

/// The missing term or factor that makes the formula right, at one position and with consistent units.
/// If several products of parameters equal the missing number, each of them is an explanation.
pub(super) fn missing(trial: &mut Trial, dimensions: &Dimensions) -> Vec<Missing> {
    let dictionary = Dictionary::of(trial);
    let monomials = Monomials::of(&trial.formulas, trial.index, &dictionary.constants, dimensions);
    trial.sheet.operations += (30 * dictionary.entries.len() * trial.few.len() + monomials.len()) as u64;
    // If the units are inconsistent without the missing expression, this inconsistency is further evidence.
    let own = trial.formulas.list[trial.index].tree.clone();
    let units = if dimensions.are_sound(&[(trial.index, own)]) { 1.0 } else { 0.05 };
    let is_weak = trial.is_number || trial.is_constant();
    let mut ratios = Ratios::default();
    let mut found = Vec::new();
    for index in used_by(&trial.formulas, trial.index) {
        let all = places(&trial.formulas.list[index].tree);
        for &(depth, number) in &all {
            for operator in [Operator::Plus, Operator::Times] {
                if trial.is_spent() {
                    break;
                }
                for needed in needed(trial, trial.sheet.places(index)[number], operator) {
                    let alike = ratios.alike(&dictionary.entries, &needed);
                    for entry in alike.into_iter().map(|own| &dictionary.entries[own]) {
                        if trial.is_spent() {
                            break;
                        }
                        // If a formula is wrong by a constant factor or offset, no varying expression is missing.
                        if entry.after > index || trial.is_number && !entry.is_one() {
                            continue;
                        }
                        let Some(coefficient) = coefficient(entry, &needed) else { continue };
                        for (what, weight) in written(&monomials, coefficient, entry, operator) {
                            let Some(own) = Candidate::of(trial, [index, number], operator, &what) else { continue };
                            let is_sound = dimensions.are_sound(&own.changed);
                            trial.sheet.operations += dimensions.work();
                            if !is_sound {
                                continue;
                            }
                            if entry.is_one()
                                && !is_believed(
                                    &monomials,
                                    dimensions,
                                    coefficient,
                                    &what,
                                    weight,
                                    units,
                                    is_weak.then(|| before(&all, depth)),
                                )
                            {
                                continue;
                            }
                            // Three things make an explanation less simple: a change of an earlier formula, the depth
                            // of the position, and every name that is new in the formula.
                            let outside = usize::from(index != trial.index) + depth + own.strangers;
                            found.push((weight + 2 * outside, own));
                        }
                    }
                }
            }
        }
    }
    found.sort_by_key(|(weight, _)| *weight);
    found.dedup_by(|one, other| one.1.changed == other.1.changed);
    let mut right: Vec<(usize, Candidate)> = Vec::new();
    for (weight, own) in found {
        // Keeps only explanations that are nearly as simple as the simplest one and complete the same position.
        let is_equal = right.first().is_none_or(|(least, first)| weight <= least + 1 && own.is_beside(first));
        if is_equal && right.len() < MOST && trial.fits(&own.changed, 0.0) {
            right.push((weight, own));
        }
    }
    right.into_iter().map(|(_, own)| own.missing).collect()
}

/// Largest number of equally good products that are reported.
const MOST: usize = 3;

/// Entries of a dictionary, sorted by the ratio of their values at two instants.
/// A binary search then finds the entries that are proportional to an amount.
#[derive(Default)]
struct Ratios {
    sorted: BTreeMap<[usize; 2], Vec<(f64, usize)>>,
}

impl Ratios {
    /// Indices of the entries that may be proportional to the missing amount. The indices are in ascending order.
    /// If fewer than two instants are known, the result contains only the index of the constant 1.
    fn alike(&mut self, entries: &[Entry], needed: &Needed) -> Vec<usize> {
        let mut known: Vec<(usize, [f64; 2])> =
            needed.iter().enumerate().filter_map(|(instant, own)| Some((instant, (*own)?))).collect();
        // Selects the two instants with the smallest relative error.
        let sharpness = |(_, [amount, known]): &(usize, [f64; 2])| (amount / known).abs();
        known.sort_by(|one, other| sharpness(other).total_cmp(&sharpness(one)));
        let [(one, [first, first_known]), (other, [second, second_known])] = match known.as_slice() {
            [one, other, ..] => [*one, *other],
            _ => return entries.iter().position(Entry::is_one).into_iter().collect(),
        };
        let sorted = self.sorted.entry([one, other]).or_insert_with(|| {
            let ratio = |(index, own): (usize, &Entry)| (own.values[one] / own.values[other], index);
            let mut all: Vec<(f64, usize)> =
                entries.iter().enumerate().map(ratio).filter(|(ratio, _)| ratio.is_finite()).collect();
            all.sort_by(|one, other| one.0.total_cmp(&other.0));
            all
        });
        let ratio = first / second;
        let slack = 2.0 * ratio.abs() * ((first_known / first).abs() + (second_known / second).abs() + 1e-12);
        let begin = sorted.partition_point(|(own, _)| *own < ratio - slack);
        let near = sorted[begin..].iter().take_while(|(own, _)| *own <= ratio + slack);
        let mut found: Vec<usize> = near.map(|(_, index)| *index).collect();
        found.sort_unstable();
        found
    }
}

/// An expression that may be missing, and the formula that includes it.
struct Candidate {
    changed: Vec<(usize, FormulaTree)>,
    /// Number of names in the expression that the formula does not contain.
    strangers: usize,
    missing: Missing,
}

impl Candidate {
    fn is_beside(&self, other: &Candidate) -> bool {
        let of = |own: &Candidate| (own.missing.formula.clone(), own.missing.beside.clone(), own.missing.is_factor);
        of(self) == of(other)
    }

    /// Returns `None` if the formula with the missing expression would use itself or a later formula.
    fn of(trial: &Trial, [index, number]: [usize; 2], operator: Operator, what: &FormulaTree) -> Option<Self> {
        let later = &trial.formulas.list[index..];
        if what.names().iter().any(|(name, _)| later.iter().any(|own| own.name == *name)) {
            return None;
        }

        let own = &trial.formulas.list[index];
        let part = numbered(&own.tree, number);
        let beside = (number > 0).then(|| part.to_string());
        let tree = replaced(&own.tree, number, &with(operator, part.clone(), what.clone()));
        let names = own.tree.names();
        let is_stranger = |name: &str| name != "pi" && names.iter().all(|(own, _)| *own != name);
        let strangers = what.names().iter().filter(|(name, _)| is_stranger(name)).count();
        let (what, is_factor) = (signed(operator, what), operator == Operator::Times);
        let at = part.at.clone();
        let missing = Missing { formula: own.name.clone(), beside, what, at, is_factor };
        Some(Candidate { changed: vec![(index, tree)], strangers, missing })
    }
}

/// Whether a number alone proves that a product is missing.
/// It does so only if hardly any other product with the same unit is expected to match the number by chance.
/// The product fits at several positions if the formula is wrong by a constant factor or offset, or if the mechanism's
/// value is constant. In these cases, `places` is the number of the positions; in all other cases, it is `None`.
fn is_believed(
    monomials: &Monomials,
    dimensions: &Dimensions,
    coefficient: f64,
    what: &FormulaTree,
    weight: usize,
    units: f64,
    places: Option<usize>,
) -> bool {
    let dimension = dimensions.of_constant(what);
    let (products, one) = monomials.by_chance(coefficient, ACCURACY, weight, dimension);
    // A simple product is accepted if no other product of its complexity has the same unit.
    if weight <= 2 && products <= 1 && dimension.is_some() {
        return true;
    }
    match places {
        None => one * units <= CHANCE,
        Some(_) if weight > 3 && units == 1.0 => one * LONG <= CHANCE,
        Some(places) => one * 2.0 * places as f64 * units <= CHANCE,
    }
}

/// Number of positions no deeper than `depth`.
fn before(places: &[(usize, usize)], depth: usize) -> usize {
    places.partition_point(|(own, _)| *own <= depth)
}

/// Depth and index of every position of a tree at which an expression may be missing. The first entry is the whole
/// tree.
fn places(tree: &FormulaTree) -> Vec<(usize, usize)> {
    let (mut places, mut number) = (Vec::new(), 0);
    at_every_place(tree, &mut |place, part| {
        if !matches!(part.shape, NodeShape::Number(_)) {
            places.push((place.len(), number));
        }
        number += 1;
    });
    places.sort_by_key(|(depth, _)| *depth);
    places
}

/// A subexpression with an added term or factor.
fn with(operator: Operator, part: FormulaTree, what: FormulaTree) -> FormulaTree {
    match (operator, what.shape) {
        (Operator::Plus, NodeShape::Negative(inner)) => FormulaTree::pair(Operator::Minus, part, *inner),
        (operator, shape) => FormulaTree::pair(operator, part, FormulaTree { shape, at: 0..0 }),
    }
}

/// A term with its sign, or a factor with its operator.
fn signed(operator: Operator, what: &FormulaTree) -> String {
    let one = FormulaTree::number(1.0);
    let whole = match (operator, &what.shape) {
        (Operator::Times, NodeShape::Pair(Operator::Over, parts)) if parts[0].shape == one.shape => what.clone(),
        _ => with(operator, one, what.clone()),
    };
    // Removes the placeholder 1, so that the text can follow another expression. Necessary parentheses remain.
    let text = whole.to_string();
    let after = text.trim_start_matches('1').trim_start();
    let (sign, rest) = after.split_at(1);
    format!("{sign} {}", rest.trim_start())
}

/// The known ways to write the product `coefficient * entry` as a formula, each with its complexity.
/// `coefficient` is written as a product of known quantities. If a constant factor is missing, it may also be 1 plus or
/// minus such a product.
fn written(monomials: &Monomials, coefficient: f64, entry: &Entry, operator: Operator) -> Vec<(FormulaTree, usize)> {
    let one = || FormulaTree::number(1.0);
    let mut factors = match (coefficient.abs() - 1.0).abs() <= ACCURACY {
        true => vec![(if coefficient < 0.0 { one().negative() } else { one() }, 0)],
        false => monomials.with_value(coefficient, ACCURACY),
    };
    if entry.is_one() && operator == Operator::Times {
        let more = monomials.with_value(coefficient - 1.0, ACCURACY).into_iter();
        factors.extend(more.map(|(more, weight)| (with(Operator::Plus, one(), more), weight + 2)));
    }
    factors.into_iter().map(|(factor, weight)| (product(&factor, &entry.tree), weight + 2 * entry.weight)).collect()
}

/// The product of a factor and an entry. A factor of one is not written.
fn product(factor: &FormulaTree, entry: &FormulaTree) -> FormulaTree {
    let is_one = |tree: &FormulaTree| tree.shape == NodeShape::Number(1.0);
    match (&factor.shape, &entry.shape) {
        (NodeShape::Negative(size), _) => product(size, entry).negative(),
        (_, NodeShape::Number(_)) => factor.clone(),
        _ if is_one(factor) => entry.clone(),
        (_, NodeShape::Pair(Operator::Over, parts)) if is_one(&parts[0]) => {
            FormulaTree::pair(Operator::Over, factor.clone(), parts[1].clone())
        }
        (_, NodeShape::Pair(operator @ (Operator::Times | Operator::Over), parts)) => {
            FormulaTree::pair(*operator, product(factor, &parts[0]), parts[1].clone())
        }
        _ => FormulaTree::pair(Operator::Times, factor.clone(), entry.clone()),
    }
}

/// The missing amount at one position of the formula, for each instant of the trial.
/// There may be several solutions, for example two if the amount is squared in the formula.
/// The iteration is therefore done three times: from the neutral value, from the amount at the previous instant, and
/// from the amount at the next instant. All different results are returned.
fn needed(trial: &mut Trial, place: usize, operator: Operator) -> Vec<Needed> {
    let depending = trial.sheet.depending(&[place]);
    let neutral = if operator == Operator::Plus { 0.0 } else { 1.0 };
    let Trial { sheet, targets, .. } = trial;
    let mut at = |instant: usize, from: f64| sheet.amount(operator, &depending, instant, from, &targets[instant]);
    let count = targets.len();
    let afresh: Needed = (0..count).map(|instant| at(instant, neutral)).collect();
    let mut followed = |instants: &mut dyn Iterator<Item = usize>| -> Needed {
        let mut last = neutral;
        let mut next = |instant: usize| {
            let found = at(instant, last);
            last = found.map_or(last, |[amount, _]| amount);
            found
        };
        instants.map(&mut next).collect()
    };
    let forwards = followed(&mut (0..count));
    let mut backwards = followed(&mut (0..count).rev());
    backwards.reverse();
    // If another starting value leads to the same amounts, they are not returned a second time.
    let is_same = |other: &Needed| {
        afresh.iter().zip(other).all(|pair| match pair {
            (Some([one, known]), Some([other, well])) => (one - other).abs() <= known + well,
            (one, other) => one.is_none() && other.is_none(),
        })
    };
    let others: Vec<Needed> = [forwards, backwards].into_iter().filter(|own| !is_same(own)).collect();
    [vec![afresh], others].concat()
}

/// Constant ratio of the missing amount to the values of an entry; `None` if the ratio varies from instant to instant.
fn coefficient(entry: &Entry, needed: &Needed) -> Option<f64> {
    let known = || entry.values.iter().zip(needed).filter_map(|(value, own)| Some((*value, (*own)?)));
    // Selects the instant with the smallest relative error.
    let sharpness = |(value, [_, known]): &(f64, [f64; 2])| (value / known).abs();
    let (sharpest, [amount, sharp]) = known().max_by(|one, other| sharpness(one).total_cmp(&sharpness(other)))?;
    // A constant needs `FEWEST` instants, or all instants of the trial if the trial has fewer than `FEWEST`.
    let fewest = if entry.is_one() { FEWEST.min(needed.len()) } else { FEWEST };
    if known().count() < fewest {
        return None;
    }
    let coefficient = amount / sharpest;
    let goes_with = |(value, [amount, known]): (f64, [f64; 2])| {
        (amount - coefficient * value).abs() <= known + sharp * (value / sharpest).abs()
    };
    (coefficient != 0.0 && coefficient.is_finite() && known().all(goes_with)).then_some(coefficient)
}
