//! What a formula lacks: the term or factor that makes it right at one of its places, found from its numbers.
//!
//! At every place the amount that would have to be added, or multiplied by, is calculated instant by instant. If it
//! goes with something that the derivation knows, that is what is missing.

mod dictionary;
mod monomials;

use super::dimension::Dimensions;
use super::slips::{at_every_place, part_at, used_by};
use super::trial::Trial;
use crate::scenario::formula::UNKNOWN;
use dictionary::{Dictionary, Entry};
use formula::{Operator, Program, Shape, Tree};
pub(in crate::claims) use monomials::Monomials;

/// A term or a factor that is missing.
#[derive(Clone, Debug, PartialEq)]
pub struct Missing {
    /// The formula that it is missing in.
    pub formula: String,
    /// The part that it is missing beside; `None` for the whole formula.
    pub beside: Option<String>,
    /// What is missing with its sign: `+ m*g*s*cos(phi)`, `/ cos(beta)^3`.
    pub what: String,
    /// Whether it is a factor.
    pub is_factor: bool,
}

/// Newton steps to the amount that is missing at an instant.
const STEPS: usize = 30;
/// Fewest instants that a function of the crank angle is recognised by.
const FEWEST: usize = 4;
/// Relative accuracy to which a constant amount is recognised as a product of known quantities.
const ACCURACY: f64 = 1e-9;

/// What is missing at a place by instants, and how well it is known; `None` where that cannot be told.
type Needed = Vec<Option<[f64; 2]>>;

/// What is missing, if one term or factor at one place makes the formula right.
/// `is_number` says that a factor or an offset makes it right.
pub(super) fn missing(trial: &mut Trial, dimensions: &Dimensions, is_number: bool) -> Option<Missing> {
    let dictionary = Dictionary::of(trial);
    let monomials = Monomials::of(&trial.formulas, trial.index, &dictionary.constants);
    let mut found = Vec::new();
    for index in used_by(&trial.formulas, trial.index) {
        for place in places(&trial.formulas.list[index].tree) {
            for operator in [Operator::Plus, Operator::Times] {
                let Some(needed) = needed(trial, index, &place, operator) else { continue };
                let known = dictionary.entries.iter().filter(|entry| entry.after <= index);
                for (entry, needed) in known.flat_map(|entry| needed.iter().map(move |needed| (entry, needed))) {
                    // What is right everywhere but for a number lacks nothing that changes.
                    let Some(coefficient) = coefficient(entry, needed).filter(|_| !is_number || entry.is_one()) else {
                        continue;
                    };
                    for (what, weight) in written(&monomials, coefficient, entry, operator) {
                        let Some(own) = Candidate::of(trial, (index, &place), operator, &what) else { continue };
                        // What is missing in the formula itself, and made of what stands there, is simpler.
                        let outside = usize::from(index != trial.index) + place.len() + own.strangers;
                        let weight = weight + 2 * outside;
                        found.push((!dimensions.are_sound(&own.changed), weight, own));
                    }
                }
            }
        }
    }
    found.sort_by_key(|(is_unsound, weight, _)| (*is_unsound, *weight));
    found.into_iter().find(|(_, _, own)| trial.fits(&own.changed, 0.0)).map(|(_, _, own)| own.missing)
}

/// Something that may be missing, and the formula with it.
struct Candidate {
    changed: Vec<(usize, Tree)>,
    /// Number of names in it that the formula does not have.
    strangers: usize,
    missing: Missing,
}

impl Candidate {
    /// `None` if it would have to know a formula that comes later.
    fn of(trial: &Trial, (index, place): (usize, &[usize]), operator: Operator, what: &Tree) -> Option<Self> {
        let later = &trial.formulas.list[index..];
        if what.names().iter().any(|(name, _)| later.iter().any(|own| own.name == *name)) {
            return None;
        }

        let own = &trial.formulas.list[index];
        let mut tree = own.tree.clone();
        let part = part_at(&mut tree, place);
        let beside = (!place.is_empty()).then(|| part.to_string());
        *part = with(operator, part.clone(), what.clone());
        let names = own.tree.names();
        let is_stranger = |name: &str| name != "pi" && names.iter().all(|(own, _)| *own != name);
        let strangers = what.names().iter().filter(|(name, _)| is_stranger(name)).count();
        let (what, is_factor) = (signed(operator, what), operator == Operator::Times);
        let missing = Missing { formula: own.name.clone(), beside, what, is_factor };
        Some(Candidate { changed: vec![(index, tree)], strangers, missing })
    }
}

/// Every place of a tree at which something may be missing.
fn places(tree: &Tree) -> Vec<Vec<usize>> {
    let mut places = Vec::new();
    at_every_place(tree, &mut |place, part| {
        if !matches!(part.shape, Shape::Number(_)) {
            places.push(place.to_vec());
        }
    });
    // The whole before its parts.
    places.sort_by_key(Vec::len);
    places
}

/// A part with a term or factor.
fn with(operator: Operator, part: Tree, what: Tree) -> Tree {
    match (operator, what.shape) {
        (Operator::Plus, Shape::Negative(inner)) => Tree::pair(Operator::Minus, part, *inner),
        (operator, shape) => Tree::pair(operator, part, Tree { shape, at: 0..0 }),
    }
}

/// A term with its sign, or a factor with its operator.
fn signed(operator: Operator, what: &Tree) -> String {
    let one = Tree::number(1.0);
    let whole = match (operator, &what.shape) {
        (Operator::Times, Shape::Pair(Operator::Over, parts)) if parts[0].shape == one.shape => what.clone(),
        _ => with(operator, one, what.clone()),
    };
    // As it is written after another part, with the parentheses that it needs there.
    let text = whole.to_string();
    let after = text.trim_start_matches('1').trim_start();
    let (sign, rest) = after.split_at(1);
    format!("{sign} {}", rest.trim_start())
}

/// A number of times an entry as it may be written, each with its complexity: by a product of known quantities, and for
/// a constant factor by one less, or more, such a product.
fn written(monomials: &Monomials, coefficient: f64, entry: &Entry, operator: Operator) -> Vec<(Tree, usize)> {
    let one = || Tree::number(1.0);
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

/// A factor times an entry, without ones.
fn product(factor: &Tree, entry: &Tree) -> Tree {
    let is_one = |tree: &Tree| tree.shape == Shape::Number(1.0);
    match (&factor.shape, &entry.shape) {
        (Shape::Negative(size), _) => product(size, entry).negative(),
        (_, Shape::Number(_)) => factor.clone(),
        _ if is_one(factor) => entry.clone(),
        (_, Shape::Pair(Operator::Over, parts)) if is_one(&parts[0]) => {
            Tree::pair(Operator::Over, factor.clone(), parts[1].clone())
        }
        (_, Shape::Pair(operator @ (Operator::Times | Operator::Over), parts)) => {
            Tree::pair(*operator, product(factor, &parts[0]), parts[1].clone())
        }
        _ => Tree::pair(Operator::Times, factor.clone(), entry.clone()),
    }
}

/// What is missing at a place at each of the few instants, by Newton's method: begun with nothing at each of them, or
/// with what is missing at its neighbour on either side, because squares have two answers.
fn needed(trial: &mut Trial, index: usize, place: &[usize], operator: Operator) -> Option<[Needed; 3]> {
    let mut tree = trial.formulas.list[index].tree.clone();
    let part = part_at(&mut tree, place);
    *part = Tree::pair(operator, part.clone(), Tree::name(UNKNOWN));
    let of = trial.index;
    let mut program = trial.formulas.with_trees(&[(index, tree)], of, |graph, id| {
        let slope = graph.derivative(id, 4);
        Program::of(graph, &[id, slope])
    })?;
    let neutral = if operator == Operator::Plus { 0.0 } else { 1.0 };
    let mut at = |place: usize, from: f64| -> Option<[f64; 2]> {
        let mut amount = from;
        for _ in 0..STEPS {
            let values = program.run(&trial.inputs(place, amount));
            let (value, slope) = (values[0].value, values[1].value);
            let change = trial.difference(value, place) / slope;
            if slope == 0.0 || !change.is_finite() {
                return None;
            }
            amount -= change;
            let bound = (trial.bound(place) / slope).abs();
            if change.abs() <= 1e-13 * amount.abs() + bound {
                return Some([amount, 4.0 * bound + 1e-11 * amount.abs()]);
            }
        }
        None
    };
    let few = &trial.few;
    let afresh: Needed = few.iter().map(|&place| at(place, neutral)).collect();
    let mut followed = |places: &mut dyn Iterator<Item = &usize>| -> Needed {
        let mut last = neutral;
        let mut next = |place: &usize| {
            let found = at(*place, last);
            last = found.map_or(last, |[amount, _]| amount);
            found
        };
        places.map(&mut next).collect()
    };
    let forwards = followed(&mut few.iter());
    let mut backwards = followed(&mut few.iter().rev());
    backwards.reverse();
    Some([afresh, forwards, backwards])
}

/// The number of times that an entry is missing, if the amount goes with it.
fn coefficient(entry: &Entry, needed: &Needed) -> Option<f64> {
    let known = || entry.values.iter().zip(needed).filter_map(|(value, own)| Some((*value, (*own)?)));
    // The instant that says most.
    let sharpness = |(value, [_, known]): &(f64, [f64; 2])| (value / known).abs();
    let (sharpest, [amount, sharp]) = known().max_by(|one, other| sharpness(one).total_cmp(&sharpness(other)))?;
    // A number for a single instant is known by that one.
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
