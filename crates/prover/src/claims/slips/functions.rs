//! Slips in functions: another one, one that is missing, another branch.

use formula::{Function, Operator, Shape, Tree};

/// Functions that may be missing around a part, as where a small angle is taken for its sine.
pub(super) fn missing(part: &Tree) -> Vec<Tree> {
    use Function::{Asin, Atan, Cos, Sin, Tan};
    [Sin, Cos, Tan, Asin, Atan].map(|function| Tree::call(function, vec![part.clone()])).to_vec()
}

/// Another function that may have been meant by one of its arguments, or none.
pub fn others(function: Function, parts: &[Tree]) -> Vec<Tree> {
    let others: &[Function] = match function {
        Function::Sin => &[Function::Cos, Function::Tan],
        Function::Cos => &[Function::Sin, Function::Tan],
        Function::Tan => &[Function::Sin, Function::Cos, Function::Atan],
        Function::Asin => &[Function::Acos, Function::Atan, Function::Sin],
        Function::Acos => &[Function::Asin, Function::Atan, Function::Cos],
        Function::Atan => &[Function::Asin, Function::Acos, Function::Tan],
        Function::Atan2 | Function::Sqrt | Function::Abs | Function::Exp | Function::Ln | Function::Sign => &[],
    };
    let mut edits: Vec<Tree> = others.iter().map(|other| Tree::call(*other, parts.to_vec())).collect();
    if matches!(function, Function::Sin | Function::Cos | Function::Tan) {
        edits.push(parts[0].clone());
    }
    if function == Function::Atan2 {
        edits.push(Tree::call(Function::Atan2, vec![parts[1].clone(), parts[0].clone()]));
    }
    edits
}

/// Another branch of a function that has several.
pub(super) fn branches(function: Function, parts: &[Tree]) -> Vec<Tree> {
    let own = || Tree::call(function, parts.to_vec());
    let half_a_turn = || Tree::name("pi");
    match function {
        Function::Sqrt | Function::Acos => vec![own().negative()],
        Function::Abs => vec![parts[0].clone()],
        Function::Asin => vec![Tree::pair(Operator::Minus, half_a_turn(), own())],
        Function::Atan => {
            let mut edits = vec![Tree::pair(Operator::Plus, own(), half_a_turn())];
            if let Shape::Pair(Operator::Over, sides) = &parts[0].shape {
                edits.push(Tree::call(Function::Atan2, sides.to_vec()));
            }
            edits
        }
        Function::Atan2 => vec![Tree::pair(Operator::Plus, own(), half_a_turn())],
        Function::Sin | Function::Cos | Function::Tan | Function::Exp | Function::Ln | Function::Sign => Vec::new(),
    }
}
