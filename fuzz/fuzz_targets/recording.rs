//! The bytes of a recording.
#![no_main]

#[allow(dead_code)]
#[path = "../../tests/suite/common/entries.rs"]
mod entries;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let _ = entries::recording(bytes);
});
