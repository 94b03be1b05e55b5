//! The text of a scenario file.
#![no_main]

#[allow(dead_code)]
#[path = "../../tests/suite/common/entries.rs"]
mod entries;

libfuzzer_sys::fuzz_target!(|text: &str| {
    entries::scenario(text);
});
