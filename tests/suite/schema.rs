//! The JSON Schema of scenario files is up to date. The tests of `crates/crosschecks` judge scenarios by it.

use linkproof::report::schema;

use crate::cli::tools::Place;

const COMMITTED: &str = include_str!("../../docs/scenario.schema.json");

#[test]
fn the_committed_schema_is_current() {
    assert_eq!(schema::scenario(), COMMITTED, "linkproof schema -o docs/scenario.schema.json");
    let place = Place::new();
    assert_eq!(place.ok("schema"), COMMITTED);
    place.ok("schema -o own.json");
    assert_eq!(std::fs::read_to_string(place.path("own.json")).unwrap(), COMMITTED);
}
