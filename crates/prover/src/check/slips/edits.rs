//! Slips at one position of a formula: the possible corrections of a subexpression.

use super::rules::with_slips;
use super::slip::SlipKind;
use formula::Operator::{Minus, Over, Plus, Power, Times};
use formula::{FormulaTree, NodeShape};
use scenario::Parameter;

/// Values that authors write for the gravitational acceleration (m/s^2).
pub(super) const GRAVITY: [f64; 5] = [9.81, 9.806_65, 9.8, 9.807, 10.0];

/// Returns the possible corrections of a subexpression for one kind of slip. `names` are the names of quantities.
/// Corrections that the table of rules (`rules.rs`) cannot express come first.
pub(super) fn of(part: &FormulaTree, kind: SlipKind, names: &[&str], parameters: &[Parameter]) -> Vec<FormulaTree> {
    let other_than = |numbers: &[f64], own: f64| -> Vec<FormulaTree> {
        numbers.iter().filter(|other| **other != own).map(|other| FormulaTree::number(*other)).collect()
    };
    let mut edits = match (kind, &part.shape) {
        (SlipKind::Name, _) => others(part, names, parameters),
        (SlipKind::Exchanged, _) => exchanged(part, names),
        (SlipKind::Unit, NodeShape::Number(own)) if GRAVITY.contains(own) => other_than(&GRAVITY, *own),
        (SlipKind::Unit, _) => quantity(part, parameters).map(FormulaTree::name).into_iter().collect(),
        (SlipKind::Factor, NodeShape::Number(own)) if !is_unit(*own) => {
            other_than(&[1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0], *own)
        }
        (SlipKind::Parentheses, _) => regrouped(part).into_iter().collect(),
        _ => Vec::new(),
    };
    let has_gravity = parameters.iter().any(|own| own.unit() == Some("m_s2"));
    with_slips(part, kind, has_gravity, &mut edits);
    edits
}

/// Whether a number typically comes from a unit conversion.
fn is_unit(value: f64) -> bool {
    GRAVITY.contains(&value) || [1e3, 1e6, 1e-3, 1e-6, 30.0, 60.0, 90.0, 180.0, 270.0, 360.0, 3600.0].contains(&value)
}

/// If the subexpression is the key of a parameter, such as `r_mm` (the number in the file), returns the name of the
/// quantity in SI units, such as `r`.
fn quantity<'a>(part: &FormulaTree, parameters: &'a [Parameter]) -> Option<&'a str> {
    let NodeShape::Name(own) = &part.shape else { return None };
    parameters.iter().find(|parameter| parameter.key == *own).and_then(Parameter::short)
}

/// If the subexpression is a name: other names that the author of the formula may have meant.
fn others(part: &FormulaTree, names: &[&str], parameters: &[Parameter]) -> Vec<FormulaTree> {
    let NodeShape::Name(own) = &part.shape else { return Vec::new() };
    let quantity = quantity(part, parameters);
    let is_other = |other: &&&str| own != "pi" && **other != own.as_str() && Some(**other) != quantity;
    names.iter().filter(is_other).map(|other| FormulaTree::name(*other)).collect()
}

/// Variants of a sum, difference, product or quotient. In each variant, two quantities are exchanged at all their
/// occurrences.
fn exchanged(part: &FormulaTree, names: &[&str]) -> Vec<FormulaTree> {
    let NodeShape::Pair(Plus | Minus | Over | Times, _) = part.shape else { return Vec::new() };
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

fn rename(tree: &mut FormulaTree, [one, other]: [&str; 2]) {
    if let NodeShape::Name(own) = &mut tree.shape {
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

/// The subexpression with other parentheses and the same order of symbols. Only groupings that the table of rules
/// (`rules.rs`) cannot express are returned, here as written => returned:
/// a*b + c + d => a*(b + c + d), a/b + c => a/(b + c), sin(a) + b => sin(a + b), sin(a^2) => sin(a)^2.
fn regrouped(part: &FormulaTree) -> Option<FormulaTree> {
    let first = first_of(part);
    match (&part.shape, &first.shape) {
        (NodeShape::Pair(Plus | Minus, _), NodeShape::Pair(operator @ (Times | Over), pair)) => {
            Some(FormulaTree::pair(*operator, pair[0].clone(), with_first(part, &pair[1])))
        }
        (NodeShape::Pair(Plus | Minus, _), NodeShape::Call(function, arguments)) if function.arity() == 1 => {
            Some(FormulaTree::call(*function, vec![with_first(part, &arguments[0])]))
        }
        (NodeShape::Call(function, arguments), _) => {
            let [FormulaTree { shape: NodeShape::Pair(Power, pair), .. }] = arguments.as_slice() else { return None };
            Some(FormulaTree::pair(Power, FormulaTree::call(*function, vec![pair[0].clone()]), pair[1].clone()))
        }
        _ => None,
    }
}

/// The first term of a sum.
fn first_of(tree: &FormulaTree) -> &FormulaTree {
    let NodeShape::Pair(Plus | Minus, parts) = &tree.shape else { return tree };
    first_of(&parts[0])
}

/// A sum in which another term replaces the first.
fn with_first(tree: &FormulaTree, first: &FormulaTree) -> FormulaTree {
    let NodeShape::Pair(operator @ (Plus | Minus), parts) = &tree.shape else { return first.clone() };
    FormulaTree::pair(*operator, with_first(&parts[0], first), parts[1].clone())
}
