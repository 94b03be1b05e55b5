//! Positions in formulas, and the names and steps that formulas use.

use std::collections::{BTreeMap, BTreeSet};

use formula::FormulaTree;
use scenario::Formulas;

/// Names of quantities: the parameters (in SI units) and the steps before a formula.
pub(in crate::check) fn quantities(formulas: &Formulas, formula: usize) -> Vec<String> {
    // A plain number is not a quantity.
    let steps = formulas.list[..formula].iter().filter(|step| !step.tree.names().is_empty());
    let steps = steps.map(|step| step.name.clone());
    formulas.parameters.iter().map(|own| own.quantity().to_string()).chain(steps).collect()
}

/// Index of a formula, followed by the indices of the formulas that the formula uses.
pub(in crate::check) fn used_by(formulas: &Formulas, formula: usize) -> Vec<usize> {
    let names: BTreeMap<&str, usize> =
        formulas.list[..formula].iter().enumerate().map(|(index, own)| (own.name.as_str(), index)).collect();
    let (mut found, mut known) = (vec![formula], BTreeSet::from([formula]));
    let mut next = 0;
    while next < found.len() {
        for (name, _) in formulas.list[found[next]].tree.names() {
            if let Some(&index) = names.get(name).filter(|index| known.insert(**index)) {
                found.push(index);
            }
        }
        next += 1;
    }
    found
}

/// Visits every subexpression of a tree with its position. The whole tree comes first.
pub(in crate::check) fn at_every_place<'a>(tree: &'a FormulaTree, visit: &mut dyn FnMut(&[usize], &'a FormulaTree)) {
    fn go<'a>(tree: &'a FormulaTree, place: &mut Vec<usize>, visit: &mut dyn FnMut(&[usize], &'a FormulaTree)) {
        visit(place, tree);
        for (index, part) in tree.parts().iter().enumerate() {
            place.push(index);
            go(part, place, visit);
            place.pop();
        }
    }
    go(tree, &mut Vec::new(), visit);
}

/// The subexpression with the index `number` in the order of [`at_every_place`].
pub(in crate::check) fn numbered(tree: &FormulaTree, number: usize) -> &FormulaTree {
    let (mut found, mut next) = (tree, 0);
    at_every_place(tree, &mut |_, part| {
        if next == number {
            found = part;
        }
        next += 1;
    });
    found
}

/// The tree in which `other` replaces the subexpression with the index `number`.
pub(in crate::check) fn replaced(tree: &FormulaTree, number: usize, other: &FormulaTree) -> FormulaTree {
    let (mut at, mut next) = (Vec::new(), 0);
    at_every_place(tree, &mut |place, _| {
        if next == number {
            at = place.to_vec();
        }
        next += 1;
    });
    let mut changed = tree.clone();
    *at.iter().fold(&mut changed, |tree, &index| &mut tree.parts_mut()[index]) = other.clone();
    changed
}
