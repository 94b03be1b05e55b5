//! Slips at one place of a formula.

use super::slip::Kind;
use super::{functions, regrouped};
use crate::scenario::Parameter;
use crate::scenario::formula::OMEGA;
use formula::{Function, Operator, Shape, Tree};

/// What may have been meant by a part.
pub(super) fn of(part: &Tree, names: &[&str], parameters: &[Parameter]) -> Vec<(Kind, Tree)> {
    use Operator::{Minus, Over, Plus, Power, Times};
    let mut edits = regrouped::of(part);
    match &part.shape {
        Shape::Pair(operator, parts) => {
            let [left, right] = [&parts[0], &parts[1]].map(Tree::clone);
            if matches!(operator, Plus | Minus) {
                edits.push((Kind::Term, left.clone()));
                edits.push((Kind::Term, if *operator == Minus { right.negative() } else { right.clone() }));
            }
            match operator {
                Plus => edits.push((Kind::Sign, Tree::pair(Minus, left, right))),
                Minus => {
                    edits.push((Kind::Sign, Tree::pair(Plus, left.clone(), right.clone())));
                    edits.push((Kind::Sign, Tree::pair(Minus, right, left)));
                }
                Times => edits.push((Kind::Operator, Tree::pair(Over, left, right))),
                Over => {
                    edits.push((Kind::Operator, Tree::pair(Times, left.clone(), right.clone())));
                    edits.push((Kind::Operator, Tree::pair(Over, right, left)));
                }
                Power => {
                    edits.push((Kind::Power, left.clone()));
                    for exponent in [2.0, 3.0, 4.0, 0.5] {
                        edits.push((Kind::Power, Tree::pair(Power, left.clone(), Tree::number(exponent))));
                    }
                }
            }
        }
        Shape::Call(function, parts) => edits.extend(functions::of_call(*function, parts)),
        Shape::Name(own) if own != "pi" => {
            edits.extend(functions::of_name(part));
            edits.extend(of_name(own, names, parameters));
        }
        Shape::Number(value) if [1e3, 1e6, 1e-3, 1e-6].contains(value) => edits.push((Kind::Unit, Tree::number(1.0))),
        Shape::Number(value) if [90.0, 180.0, 270.0, 360.0].contains(value) => {
            edits.push((
                Kind::Unit,
                Tree::pair(Times, part.clone(), Tree::pair(Over, Tree::name("pi"), Tree::number(180.0))),
            ));
        }
        Shape::Number(value) => {
            for other in [1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0].into_iter().filter(|other| other != value) {
                edits.push((Kind::Factor, Tree::number(other)));
            }
        }
        Shape::Negative(_) | Shape::Name(_) => {}
    }
    edits.push((Kind::Sign, part.negative()));
    edits.extend(exchanged(part, names).into_iter().map(|right| (Kind::Exchanged, right)));
    let of = |operator: Operator, right: Tree| Tree::pair(operator, part.clone(), right);
    let is_constant = matches!(&part.shape, Shape::Number(_)) || part.shape == Shape::Name("pi".into());
    if !is_constant {
        edits.push((Kind::Power, of(Power, Tree::number(2.0))));
        edits.push((Kind::Power, of(Power, Tree::number(3.0))));
        edits.push((Kind::Power, Tree::call(Function::Sqrt, vec![part.clone()])));
        for factor in [2.0, 3.0, 4.0] {
            edits.push((Kind::Factor, of(Times, Tree::number(factor))));
            edits.push((Kind::Factor, of(Over, Tree::number(factor))));
        }
        let to_degrees = Tree::pair(Over, Tree::number(180.0), Tree::name("pi"));
        edits.push((Kind::Unit, of(Times, to_degrees.clone())));
        edits.push((Kind::Unit, of(Over, to_degrees)));
        let per_minute = Tree::pair(Over, Tree::number(30.0), Tree::name("pi"));
        edits.push((Kind::Unit, of(Times, per_minute.clone())));
        edits.push((Kind::Unit, of(Over, per_minute)));
        for factor in [1e3, 1e6] {
            edits.push((Kind::Unit, of(Times, Tree::number(factor))));
            edits.push((Kind::Unit, of(Over, Tree::number(factor))));
        }
        for shift in [
            Tree::pair(Over, Tree::name("pi"), Tree::number(2.0)),
            Tree::name("pi"),
            Tree::pair(Times, Tree::number(2.0), Tree::name("pi")),
        ] {
            edits.push((Kind::Reference, of(Plus, shift.clone())));
            edits.push((Kind::Reference, of(Minus, shift)));
        }
        edits.push((Kind::Reference, Tree::pair(Minus, Tree::name("pi"), part.clone())));
        edits.push((
            Kind::Reference,
            Tree::pair(Minus, Tree::pair(Over, Tree::name("pi"), Tree::number(2.0)), part.clone()),
        ));
        // Hidden names: the crank's angular velocity.
        for omega in [Tree::name(OMEGA), Tree::pair(Power, Tree::name(OMEGA), Tree::number(2.0))] {
            edits.push((Kind::PerRadian, of(Times, omega.clone())));
            edits.push((Kind::PerSecond, of(Over, omega)));
        }
    }
    edits
}

/// What may have been meant by a name: another of the `names`, or the quantity whose plain number it is.
pub(super) fn of_name(own: &str, names: &[&str], parameters: &[Parameter]) -> Vec<(Kind, Tree)> {
    let plain = parameters.iter().find(|parameter| parameter.key == own && parameter.short().is_some());
    let quantity = plain.and_then(Parameter::short);
    let others = names.iter().filter(|other| **other != own && Some(**other) != quantity);
    let others = others.map(|other| (Kind::Name, Tree::name(*other)));
    quantity.map(|quantity| (Kind::Unit, Tree::name(quantity))).into_iter().chain(others).collect()
}

/// A sum, difference or quotient of two quantities with these exchanged, wherever they stand in it.
fn exchanged(part: &Tree, names: &[&str]) -> Vec<Tree> {
    let Shape::Pair(Operator::Plus | Operator::Minus | Operator::Over | Operator::Times, _) = part.shape else {
        return Vec::new();
    };
    let mut own: Vec<&str> = part.names().into_iter().map(|(name, _)| name).filter(|own| names.contains(own)).collect();
    own.sort_unstable();
    own.dedup();
    let pairs = (0..own.len()).flat_map(|first| (first + 1..own.len()).map(move |second| (first, second)));
    pairs.map(|(first, second)| with_exchanged(part, [own[first], own[second]])).collect()
}

fn with_exchanged(part: &Tree, [one, other]: [&str; 2]) -> Tree {
    let mut changed = part.clone();
    if let Shape::Name(own) = &mut changed.shape {
        if own == one {
            *own = other.into();
        } else if own == other {
            *own = one.into();
        }
    }
    for inner in changed.parts_mut() {
        *inner = with_exchanged(inner, [one, other]);
    }
    changed
}
