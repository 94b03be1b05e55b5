//! Slips that are made on purpose.

use super::edits;
use super::places::{at_every_place, quantities, replaced};
use super::slip::Kind;
use formula::Tree;
use scenario::Formulas;

/// A formula with one slip of a kind. What may have been meant by a part is as well what may be written for it: of all
/// places and ways in which the slip can be made, the one with a `number`, counted round. `None` if it cannot be made.
#[must_use]
pub fn planted(formulas: &Formulas, formula: usize, kind: Kind, number: usize) -> Option<Tree> {
    let tree = &formulas.list[formula].tree;
    let names = quantities(formulas, formula);
    let known: Vec<&str> = names.iter().map(String::as_str).collect();
    let (mut place, mut edits) = (0, Vec::new());
    at_every_place(tree, &mut |_, part| {
        edits.extend(edits::of(part, kind, &known, &formulas.parameters).into_iter().map(|edit| (place, edit)));
        place += 1;
    });
    let (place, edit) = edits.get(number % edits.len().max(1))?;
    Some(replaced(tree, *place, edit))
}
