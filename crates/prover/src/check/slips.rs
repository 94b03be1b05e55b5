//! Finds the single slip in writing whose correction makes a formula right.
//!
//! Every slip is tried at every position of the formula and of the steps that the formula uses.
//! A correction that makes the formula right at every instant explains the error.

mod edits;
mod everywhere;
mod marks;
mod places;
mod rules;
mod slip;
mod values;

use super::dimension::Dimensions;
use super::trial::Trial;
use formula::{DerivationSheet, FormulaTree, NodeShape};
pub use marks::FormulaMark;
use places::quantities;
pub(super) use places::{at_every_place, numbered, replaced, used_by};
pub(super) use rules::with_parts;
use scenario::Formulas;
pub use slip::{FormulaSlip, SlipKind};
pub(super) use slip::{Mended, Tried};

/// Tries every slip, the simplest kinds first, until the trial's work is used up.
pub(super) fn tried(trial: &mut Trial, dimensions: &Dimensions) -> Tried {
    let formulas = trial.formulas.clone();
    let names = quantities(&formulas, trial.index);
    let known: Vec<&str> = names.iter().map(String::as_str).collect();
    let used = used_by(&formulas, trial.index);
    let mut tried = Tried::default();
    for kind in SlipKind::ALL {
        for &index in &used {
            let own = &formulas.list[index];
            let mut next = 0;
            at_every_place(&own.tree, &mut |_, part| {
                let (number, place) = (next, trial.sheet.places(index)[next]);
                next += 1;
                if trial.is_spent() {
                    return;
                }
                let is_whole = matches!(kind, SlipKind::Exchanged | SlipKind::Parentheses);
                let edited = if is_whole { part.clone() } else { hollow(part, place, &trial.sheet, 2) };
                let edits = edits::of(&edited, kind, &known, &formulas.parameters);
                if edits.is_empty() {
                    return;
                }
                let depending = trial.sheet.depending(&[place]);
                for right in edits {
                    if trial.is_spent() {
                        return;
                    }
                    tried.count += 1;
                    let change = [(place, right)];
                    if !trial.is_promising(&change, &depending) {
                        continue;
                    }
                    let [(_, right)] = change;
                    let right = filled(&right, &own.tree, trial.sheet.places(index));
                    let changed = vec![(index, replaced(&own.tree, number, &right))];
                    let (formula, written) = (own.name.clone(), part.to_string());
                    let slip = FormulaSlip {
                        formula,
                        kind,
                        written,
                        right: right.to_string(),
                        everywhere: false,
                        marks: Vec::new(),
                    };
                    tried.put_standing(trial, dimensions, &changed, [part, &right], slip);
                }
            });
        }
    }
    everywhere::tried(trial, &used, &known, dimensions, &mut tried);
    values::tried(trial, &used, &mut tried);
    tried.right.sort_by_key(|own| own.rank);
    tried
}

/// Copies the upper `levels` levels of an expression tree. Placeholders replace the deeper subexpressions.
fn hollow(part: &FormulaTree, place: usize, sheet: &DerivationSheet, levels: usize) -> FormulaTree {
    if part.parts().is_empty() {
        return part.clone();
    }
    if levels == 0 {
        return DerivationSheet::placeholder(place);
    }
    let shape = match &part.shape {
        NodeShape::Number(_) | NodeShape::Name(_) => part.shape.clone(),
        NodeShape::Negative(inner) => {
            NodeShape::Negative(Box::new(hollow(inner, sheet.arguments(place)[0], sheet, levels - 1)))
        }
        NodeShape::Pair(operator, parts) => {
            let arguments = sheet.arguments(place);
            let of = |index: usize| hollow(&parts[index], arguments[index], sheet, levels - 1);
            NodeShape::Pair(*operator, Box::new([of(0), of(1)]))
        }
        NodeShape::Call(function, parts) => {
            let arguments = sheet.arguments(place);
            let of = |(part, place): (&FormulaTree, usize)| hollow(part, place, sheet, levels - 1);
            NodeShape::Call(*function, parts.iter().zip(arguments).map(of).collect())
        }
    };
    FormulaTree { shape, at: part.at.clone() }
}

/// Replaces the placeholders of a tree by the subexpressions of a formula.
fn filled(tree: &FormulaTree, formula: &FormulaTree, places: &[usize]) -> FormulaTree {
    let number = match &tree.shape {
        NodeShape::Name(name) => {
            DerivationSheet::placed(name).and_then(|own| places.iter().position(|place| *place == own))
        }
        NodeShape::Number(_) | NodeShape::Negative(_) | NodeShape::Pair(..) | NodeShape::Call(..) => None,
    };
    if let Some(number) = number {
        return numbered(formula, number).clone();
    }
    let mut own = tree.clone();
    for part in own.parts_mut() {
        *part = filled(part, formula, places);
    }
    own
}

/// Returns a formula with one slip of a kind. The possible slips are the replacements that the search uses as
/// corrections.
/// `number`, modulo the number of possible slips, selects the position and the replacement.
/// `None` if the formula offers no slip of this kind.
#[must_use]
pub fn planted(formulas: &Formulas, formula: usize, kind: SlipKind, number: usize) -> Option<FormulaTree> {
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
