//! Names that scenario files allow. Each name is given only once.

use std::collections::BTreeSet;

use linkage::mechanism::{LONGEST_NAME, is_sound_name};

/// The names of one kind of part.
#[derive(Clone, Debug)]
pub(super) struct Names(BTreeSet<String>);

impl Names {
    /// A set of names in which only these names are already taken.
    pub(super) fn with(taken: &[&str]) -> Names {
        Names(taken.iter().map(ToString::to_string).collect())
    }

    /// A name that scenario files allow, similar to `wanted`. Forbidden characters become `_`, and a name that is taken
    /// gets a number.
    pub(super) fn legal(&mut self, wanted: &str) -> String {
        let sign = |letter: char| if is_sound_name(letter.encode_utf8(&mut [0; 4])) { letter } else { '_' };
        let mut base: String = wanted.trim().chars().take(LONGEST_NAME - 8).map(sign).collect();
        if base.is_empty() {
            base.push('_');
        }
        let numbered = (2..).map(|number| format!("{base}_{number}"));
        let free = std::iter::once(base.clone()).chain(numbered).find(|name| !self.0.contains(name));
        let name = free.expect("there are more numbers than names");
        self.0.insert(name.clone());
        name
    }
}
