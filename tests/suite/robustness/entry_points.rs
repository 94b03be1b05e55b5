//! Runs the bodies of the fuzz targets on random inputs, so that tests and fuzz targets stay in step.

use proptest::prelude::*;

use crate::common::{damage::damaged, draws, entries};

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases: draws(cases as usize) as u32, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(config(300))]

    #[test]
    fn any_text_is_a_scenario_or_an_error_with_a_position(text in "\\PC{0,60}|([a-z_.\\[\\]\"= 0-9\n]){0,200}") {
        entries::scenario(&text);
    }

    #[test]
    fn any_text_is_a_formula_or_an_error_with_a_position(
        text in "\\PC{0,60}|(sin|cos|sqrt|atan2|phi|t|pi|[-+*/^(), .0-9]){0,80}",
    ) {
        entries::formula(&text);
    }

    #[test]
    fn any_structure_is_refused_or_decomposes(bytes in prop::collection::vec(any::<u8>(), 0..1500)) {
        let _ = entries::structure(&bytes);
    }

    #[test]
    fn any_bytes_are_a_recording_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..600)) {
        let _ = entries::recording(&bytes);
    }
}

#[test]
fn damaged_texts_are_scenarios_or_errors_with_a_position() {
    for index in 0..draws(60) as u64 {
        let damaged = damaged(7, index);
        entries::scenario(&damaged.text);
    }
}

/// Inputs found by fuzzing, by target: `fuzz/finds/TARGET/NAME`.
/// docs/stories.md describes these inputs.
#[test]
fn inputs_found_by_fuzzing_stay_fixed() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/finds");
    let mut count = 0;
    for target in ["scenario", "formula", "structure", "recording"] {
        let Ok(finds) = std::fs::read_dir(root.join(target)) else { continue };
        for find in finds {
            let bytes = std::fs::read(find.unwrap().path()).unwrap();
            match target {
                "scenario" => drop(entries::scenario(&String::from_utf8_lossy(&bytes))),
                "formula" => entries::formula(&String::from_utf8_lossy(&bytes)),
                "structure" => drop(entries::structure(&bytes)),
                _ => drop(entries::recording(&bytes)),
            }
            count += 1;
        }
    }
    println!("{count} finds");
}
