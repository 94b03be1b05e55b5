//! Places in formulas, and the names and steps that they use.

use crate::scenario::Formulas;
use formula::Tree;

/// Names of parameters (in SI), and of the steps before a formula: they stand for quantities.
pub(in crate::claims) fn quantities(formulas: &Formulas, formula: usize) -> Vec<String> {
    // A plain number is no quantity.
    let steps = formulas.list[..formula].iter().filter(|step| !step.tree.names().is_empty());
    let steps = steps.map(|step| step.name.clone());
    formulas.parameters.iter().map(|own| own.quantity().to_string()).chain(steps).collect()
}

/// Indices of a formula and of those that it uses, itself first.
pub(in crate::claims) fn used_by(formulas: &Formulas, formula: usize) -> Vec<usize> {
    let index_of = |name: &str| formulas.list.iter().position(|own| own.name == name);
    let mut found = vec![formula];
    let mut next = 0;
    while next < found.len() {
        for (name, _) in formulas.list[found[next]].tree.names() {
            if let Some(index) = index_of(name).filter(|index| !found.contains(index)) {
                found.push(index);
            }
        }
        next += 1;
    }
    found
}

/// Visits every part of a tree with its place, the whole first.
pub(in crate::claims) fn at_every_place<'a>(tree: &'a Tree, visit: &mut dyn FnMut(&[usize], &'a Tree)) {
    fn go<'a>(tree: &'a Tree, place: &mut Vec<usize>, visit: &mut dyn FnMut(&[usize], &'a Tree)) {
        visit(place, tree);
        for (index, part) in tree.parts().iter().enumerate() {
            place.push(index);
            go(part, place, visit);
            place.pop();
        }
    }
    go(tree, &mut Vec::new(), visit);
}

/// The part at a place.
pub(in crate::claims) fn part_at<'a>(tree: &'a mut Tree, place: &[usize]) -> &'a mut Tree {
    place.iter().fold(tree, |tree, &index| &mut tree.parts_mut()[index])
}
