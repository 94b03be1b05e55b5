//! Any set of links, joints and drives, decomposed into Assur groups.
#![no_main]

#[allow(dead_code)]
#[path = "../../tests/suite/common/entries.rs"]
mod entries;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let _ = entries::structure(bytes);
});
