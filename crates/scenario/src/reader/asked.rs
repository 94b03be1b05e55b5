//! Which keys readers have asked for, by section: for the test of the table of keys.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

thread_local! {
    static ASKED: RefCell<BTreeMap<String, BTreeSet<String>>> = const { RefCell::new(BTreeMap::new()) };
}

/// The section of a child. A key that was not asked for by its name is a name itself.
pub fn section(parent: &str, key: &str, asked: &[String]) -> String {
    let own = if asked.iter().any(|own| own == key) { key } else { "*" };
    if parent.is_empty() { own.into() } else { format!("{parent}.{own}") }
}

/// Adds what was asked for in a section.
pub fn put(section: &str, asked: &[String]) {
    ASKED.with_borrow_mut(|all| all.entry(section.into()).or_default().extend(asked.iter().cloned()));
}

/// Forgets all.
pub fn forget() {
    ASKED.with_borrow_mut(BTreeMap::clear);
}

/// All that was asked for since.
pub fn all() -> BTreeMap<String, BTreeSet<String>> {
    ASKED.with_borrow(Clone::clone)
}
