//! Mechanisms of other programs: each becomes a scenario that runs, or the message says what is missing.

mod drawings;
mod hostile;
mod links;
mod models;

use crate::cli::tools::{Outcome, Place};

/// The file of `tests/data/import`.
fn data(name: &str) -> String {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/import").join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Imports a file of `tests/data/import` to `own.toml` in a new directory.
fn imported(name: &str) -> (Place, Outcome) {
    let place = Place::empty();
    std::fs::write(place.path(name), data(name)).unwrap();
    let outcome = place.run(&format!("import {name} -o own.toml"));
    (place, outcome)
}

/// Asserts that the imported scenario is proven.
fn proven(place: &Place, name: &str) {
    let told = place.run("run own.toml --no-record --quiet");
    assert!(told.code == 0 && told.stdout.contains(": AGREE"), "{name}: {}{}", told.stdout, told.stderr);
}
