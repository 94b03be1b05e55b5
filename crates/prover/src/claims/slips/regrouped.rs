//! Parentheses that are missing or stand in another place.

use formula::Operator::{self, Minus, Over, Plus, Power, Times};
use formula::{Shape, Tree};

/// The same signs in the same order, grouped otherwise.
pub(super) fn of(part: &Tree) -> Vec<Tree> {
    let mut found = Vec::new();
    match &part.shape {
        Shape::Pair(operator @ (Plus | Minus), parts) => {
            let [left, right] = parts.as_ref();
            found.extend(beyond_first(part));
            // a + b*c for (a + b)*c, and the same with a stroke.
            if let Shape::Pair(inner @ (Times | Over), pair) = &right.shape {
                let sum = Tree::pair(*operator, left.clone(), pair[0].clone());
                found.push(Tree::pair(*inner, sum, pair[1].clone()));
            }
        }
        Shape::Pair(Times, parts) => {
            let [left, right] = parts.as_ref();
            // a/b*c for a/(b*c).
            if let Shape::Pair(Over, pair) = &left.shape {
                let below = Tree::pair(Times, pair[1].clone(), right.clone());
                found.push(Tree::pair(Over, pair[0].clone(), below));
            }
            found.extend(power_of_both(Times, left, right));
        }
        Shape::Pair(Over, parts) => found.extend(power_of_both(Over, &parts[0], &parts[1])),
        // sin(x^2) for sin(x)^2.
        Shape::Call(function, arguments) => {
            if let [Tree { shape: Shape::Pair(Power, pair), .. }] = arguments.as_slice() {
                found.push(Tree::pair(Power, Tree::call(*function, vec![pair[0].clone()]), pair[1].clone()));
            }
        }
        Shape::Number(_) | Shape::Name(_) | Shape::Negative(_) | Shape::Pair(Power, _) => {}
    }
    found
}

/// a*b + c + d for a*(b + c + d), a/b + c for a/(b + c), sin(a) + b for sin(a + b).
fn beyond_first(sum: &Tree) -> Option<Tree> {
    let first = first_of(sum);
    match &first.shape {
        Shape::Pair(operator @ (Times | Over), pair) => {
            Some(Tree::pair(*operator, pair[0].clone(), with_first(sum, &pair[1])))
        }
        Shape::Call(function, arguments) if function.arity() == 1 => {
            Some(Tree::call(*function, vec![with_first(sum, &arguments[0])]))
        }
        Shape::Number(_) | Shape::Name(_) | Shape::Negative(_) | Shape::Pair(..) | Shape::Call(..) => None,
    }
}

/// a*b^2 for (a*b)^2.
fn power_of_both(operator: Operator, left: &Tree, right: &Tree) -> Option<Tree> {
    let Shape::Pair(Power, pair) = &right.shape else { return None };
    Some(Tree::pair(Power, Tree::pair(operator, left.clone(), pair[0].clone()), pair[1].clone()))
}

/// The first term of a sum.
fn first_of(tree: &Tree) -> &Tree {
    match &tree.shape {
        Shape::Pair(Plus | Minus, parts) => first_of(&parts[0]),
        Shape::Number(_) | Shape::Name(_) | Shape::Negative(_) | Shape::Pair(..) | Shape::Call(..) => tree,
    }
}

/// A sum with another first term.
fn with_first(tree: &Tree, first: &Tree) -> Tree {
    match &tree.shape {
        Shape::Pair(operator @ (Plus | Minus), parts) => {
            Tree::pair(*operator, with_first(&parts[0], first), parts[1].clone())
        }
        Shape::Number(_) | Shape::Name(_) | Shape::Negative(_) | Shape::Pair(..) | Shape::Call(..) => first.clone(),
    }
}
