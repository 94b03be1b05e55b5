//! Why a formula is wrong: the one slip that makes it right.
//!
//! Every slip is tried at every place of the formula, and of the steps that it uses; what then holds at every instant
//! explains it. Nothing is guessed from the shape of the error.

mod edits;
mod everywhere;
mod functions;
mod places;
mod regrouped;
mod slip;

use super::dimension::Dimensions;
use crate::scenario::Formulas;
use places::quantities;
pub(super) use places::{at_every_place, part_at, used_by};
pub(super) use slip::Mended;
pub use slip::{Kind, Slip};

/// Most slips that are tried, so that a formula of many pages has an answer too.
const MOST: usize = 30_000;

/// Every formula with one slip mended, in a formula or in a step that it uses. Those whose units fit together come
/// first; of them those in the formula itself, the simplest first.
pub(super) fn mended(formulas: &Formulas, formula: usize, dimensions: &Dimensions) -> Vec<Mended> {
    let names = quantities(formulas, formula);
    let known: Vec<&str> = names.iter().map(String::as_str).collect();
    let used = used_by(formulas, formula);
    let mut all = Vec::new();
    for &index in &used {
        let own = &formulas.list[index];
        at_every_place(&own.tree, &mut |place, part| {
            for (kind, right) in edits::of(part, &known, &formulas.parameters) {
                let (written, right_text) = (part.to_string(), right.to_string());
                let slip = Slip { formula: own.name.clone(), kind, written, right: right_text, everywhere: false };
                let mut tree = own.tree.clone();
                *part_at(&mut tree, place) = right;
                all.push(Mended { changed: vec![(index, tree)], slip, is_sound: false });
            }
        });
    }
    all.sort_by_key(|own| (own.changed[0].0 != formula, own.slip.kind));
    all.truncate(MOST);
    all.extend(everywhere::mended(formulas, &used, &known));
    for own in &mut all {
        own.is_sound = dimensions.are_sound(&own.changed);
    }
    all.sort_by_key(|own| !own.is_sound);
    all
}
