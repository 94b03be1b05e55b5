//! Slips at one place of a formula: what may have been meant by a part.

use super::rules::with_slips;
use super::slip::Kind;
use formula::Operator::{Minus, Over, Plus, Power, Times};
use formula::{Shape, Tree};
use scenario::Parameter;

/// Values of the acceleration of gravity (m/s^2), as they are written.
pub(super) const GRAVITY: [f64; 5] = [9.81, 9.806_65, 9.8, 9.807, 10.0];

/// What may have been meant by a part, where it is wrong by one kind of slip. `names` are those of quantities. What no
/// rule can say comes before what rules say.
pub(super) fn of(part: &Tree, kind: Kind, names: &[&str], parameters: &[Parameter]) -> Vec<Tree> {
    let other_than = |numbers: &[f64], own: f64| -> Vec<Tree> {
        numbers.iter().filter(|other| **other != own).map(|other| Tree::number(*other)).collect()
    };
    let mut edits = match (kind, &part.shape) {
        (Kind::Name, _) => others(part, names, parameters),
        (Kind::Exchanged, _) => exchanged(part, names),
        (Kind::Unit, Shape::Number(own)) if GRAVITY.contains(own) => other_than(&GRAVITY, *own),
        (Kind::Unit, _) => quantity(part, parameters).map(Tree::name).into_iter().collect(),
        (Kind::Factor, Shape::Number(own)) if !is_unit(*own) => other_than(&[1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0], *own),
        (Kind::Parentheses, _) => regrouped(part).into_iter().collect(),
        _ => Vec::new(),
    };
    let has_gravity = parameters.iter().any(|own| own.unit() == Some("m_s2"));
    with_slips(part, kind, has_gravity, &mut edits);
    edits
}

/// Whether a number stands in formulas because of units.
fn is_unit(value: f64) -> bool {
    GRAVITY.contains(&value) || [1e3, 1e6, 1e-3, 1e-6, 30.0, 60.0, 90.0, 180.0, 270.0, 360.0, 3600.0].contains(&value)
}

/// The quantity whose plain number a name stands for.
fn quantity<'a>(part: &Tree, parameters: &'a [Parameter]) -> Option<&'a str> {
    let Shape::Name(own) = &part.shape else { return None };
    parameters.iter().find(|parameter| parameter.key == *own).and_then(Parameter::short)
}

/// The other names that may have been meant by one.
fn others(part: &Tree, names: &[&str], parameters: &[Parameter]) -> Vec<Tree> {
    let Shape::Name(own) = &part.shape else { return Vec::new() };
    let quantity = quantity(part, parameters);
    let is_other = |other: &&&str| own != "pi" && **other != own.as_str() && Some(**other) != quantity;
    names.iter().filter(is_other).map(|other| Tree::name(*other)).collect()
}

/// A sum, difference, product or quotient of two quantities with these exchanged, wherever they stand in it.
fn exchanged(part: &Tree, names: &[&str]) -> Vec<Tree> {
    let Shape::Pair(Plus | Minus | Over | Times, _) = part.shape else { return Vec::new() };
    let mut own: Vec<&str> = part.names().into_iter().map(|(name, _)| name).filter(|own| names.contains(own)).collect();
    own.sort_unstable();
    own.dedup();
    let pairs = (0..own.len()).flat_map(|first| (first + 1..own.len()).map(move |second| (first, second)));
    let with_exchanged = |(first, second): (usize, usize)| {
        let mut changed = part.clone();
        rename(&mut changed, [own[first], own[second]]);
        changed
    };
    pairs.map(with_exchanged).collect()
}

fn rename(tree: &mut Tree, [one, other]: [&str; 2]) {
    if let Shape::Name(own) = &mut tree.shape {
        if own == one {
            *own = other.into();
        } else if own == other {
            *own = one.into();
        }
    }
    for inner in tree.parts_mut() {
        rename(inner, [one, other]);
    }
}

/// The same signs in the same order, grouped otherwise, where a rule cannot say it: a*b + c + d for a*(b + c + d),
/// a/b + c for a/(b + c), sin(a) + b for sin(a + b), sin(a^2) for sin(a)^2.
fn regrouped(part: &Tree) -> Option<Tree> {
    let first = first_of(part);
    match (&part.shape, &first.shape) {
        (Shape::Pair(Plus | Minus, _), Shape::Pair(operator @ (Times | Over), pair)) => {
            Some(Tree::pair(*operator, pair[0].clone(), with_first(part, &pair[1])))
        }
        (Shape::Pair(Plus | Minus, _), Shape::Call(function, arguments)) if function.arity() == 1 => {
            Some(Tree::call(*function, vec![with_first(part, &arguments[0])]))
        }
        (Shape::Call(function, arguments), _) => {
            let [Tree { shape: Shape::Pair(Power, pair), .. }] = arguments.as_slice() else { return None };
            Some(Tree::pair(Power, Tree::call(*function, vec![pair[0].clone()]), pair[1].clone()))
        }
        _ => None,
    }
}

/// The first term of a sum.
fn first_of(tree: &Tree) -> &Tree {
    let Shape::Pair(Plus | Minus, parts) = &tree.shape else { return tree };
    first_of(&parts[0])
}

/// A sum with another first term.
fn with_first(tree: &Tree, first: &Tree) -> Tree {
    let Shape::Pair(operator @ (Plus | Minus), parts) = &tree.shape else { return first.clone() };
    Tree::pair(*operator, with_first(&parts[0], first), parts[1].clone())
}
