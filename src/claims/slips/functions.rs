//! Slips in functions: another one, one that is missing, another branch.

use super::slip::Kind;
use formula::{Function, Operator, Shape, Tree};

/// Functions that may be missing around a name, as where a small angle is taken for its sine.
pub(super) fn of_name(name: &Tree) -> impl Iterator<Item = (Kind, Tree)> {
    let functions = [Function::Sin, Function::Cos, Function::Tan];
    functions.into_iter().map(|function| (Kind::Function, Tree::call(function, vec![name.clone()])))
}

/// What may have been meant by a function of its arguments.
pub(super) fn of_call(function: Function, parts: &[Tree]) -> Vec<(Kind, Tree)> {
    let call = |function: Function| Tree::call(function, parts.to_vec());
    let own = || call(function);
    let minus = |left: Tree, right: Tree| Tree::pair(Operator::Minus, left, right);
    let mut edits = Vec::new();
    let others: &[Function] = match function {
        Function::Sin => &[Function::Cos, Function::Tan],
        Function::Cos => &[Function::Sin, Function::Tan],
        Function::Tan => &[Function::Sin, Function::Cos],
        Function::Asin => &[Function::Acos, Function::Atan],
        Function::Acos => &[Function::Asin, Function::Atan],
        Function::Atan => &[Function::Asin, Function::Acos],
        Function::Atan2 | Function::Sqrt | Function::Abs | Function::Exp | Function::Ln | Function::Sign => &[],
    };
    edits.extend(others.iter().map(|other| (Kind::Function, call(*other))));
    if matches!(function, Function::Sin | Function::Cos | Function::Tan) {
        edits.push((Kind::Function, parts[0].clone()));
    }
    match function {
        Function::Sqrt => {
            edits.push((Kind::Branch, own().negative()));
            edits.push((Kind::Power, parts[0].clone()));
        }
        Function::Abs => edits.push((Kind::Branch, parts[0].clone())),
        Function::Acos => edits.push((Kind::Branch, own().negative())),
        Function::Asin => edits.push((Kind::Branch, minus(Tree::name("pi"), own()))),
        Function::Atan => {
            edits.push((Kind::Branch, Tree::pair(Operator::Plus, own(), Tree::name("pi"))));
            if let Shape::Pair(Operator::Over, sides) = &parts[0].shape {
                edits.push((Kind::Branch, Tree::call(Function::Atan2, sides.to_vec())));
            }
        }
        Function::Atan2 => {
            let swapped = vec![parts[1].clone(), parts[0].clone()];
            edits.push((Kind::Function, Tree::call(Function::Atan2, swapped)));
            edits.push((Kind::Branch, Tree::pair(Operator::Plus, own(), Tree::name("pi"))));
        }
        Function::Sin | Function::Cos | Function::Tan | Function::Exp | Function::Ln | Function::Sign => {}
    }
    edits
}
