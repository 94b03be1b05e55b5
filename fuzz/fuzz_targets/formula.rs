//! The text of a formula.
#![no_main]

#[allow(dead_code)]
#[path = "../../tests/suite/common/entries.rs"]
mod entries;

libfuzzer_sys::fuzz_target!(|text: &str| {
    entries::formula(text);
});
