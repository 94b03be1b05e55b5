//! The JSON Schema of scenario files accepts every scenario of the repository, and is strict about keys.

use std::fs;
use std::path::Path;

use jsonschema::Validator;
use serde_json::Value;

const TOP: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
const COMMITTED: &str = include_str!("../../../docs/scenario.schema.json");

fn validator() -> Validator {
    jsonschema::validator_for(&serde_json::from_str(COMMITTED).unwrap()).unwrap()
}

fn read(text: &str) -> Value {
    toml::from_str(text).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn every_scenario_of_the_repository_fits() {
    let (validator, mut count) = (validator(), 0);
    for directory in ["scenarios", "scenarios/formulas", "scenarios/variants60", "tests/suite/bad_scenarios"] {
        for entry in fs::read_dir(Path::new(TOP).join(directory)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|extension| extension != "toml") {
                continue;
            }
            let text = fs::read_to_string(&path).unwrap();
            let faults: Vec<String> = validator.iter_errors(&read(&text)).map(|fault| fault.to_string()).collect();
            assert!(faults.is_empty(), "{}: {faults:?}", path.display());
            count += 1;
        }
    }
    assert!(count >= 50, "{count}");
}

const GOOD: &str = include_str!("../../../tests/suite/bad_scenarios/good.toml");
const RUN_UP: &str = include_str!("../../../scenarios/crank_rocker_runup.toml");
const FORMULAS: &str = include_str!("../../../scenarios/formulas/yoke_drive.toml");

#[test]
fn misspelt_keys_and_words_do_not_fit() {
    let validator = validator();
    for (text, old, new) in [
        (GOOD, "title = ", "titel = "),
        (GOOD, "format = 1", "format = \"1\""),
        (GOOD, "mass_kg = ", "mass = "),
        (GOOD, "inertia_kg_m2 = ", "inertia_kg_mm2 = "),
        (GOOD, "[ground.points]", "[ground.point]"),
        (GOOD, "type = \"revolute\"", "type = \"revolut\""),
        (GOOD, "joint = \"O\"", "joints = \"O\""),
        (GOOD, "crank_deg = ", "crank_degrees = "),
        (GOOD, "[grid]", "[grids]"),
        (GOOD, "figures = ", "figure = "),
        (RUN_UP, "motion = \"free\"", "motion = \"freely\""),
        (RUN_UP, "ratio = ", "ration = "),
        (RUN_UP, "moment_N_m = ", "moment_Nm = "),
        (FORMULAS, "expression = ", "expresion = "),
        (FORMULAS, "second_axis_deg = ", "axis2_deg = "),
        (FORMULAS, "r_mm = 80", "r_mm = true"),
    ] {
        assert!(text.contains(old), "{old}");
        assert!(validator.is_valid(&read(text)), "{old}");
        assert!(!validator.is_valid(&read(&text.replacen(old, new, 1))), "{new}");
    }
    // Any number may be an arithmetic expression.
    assert!(validator.is_valid(&read(&FORMULAS.replacen("x_mm = 80", "x_mm = \"2*r\"", 1))));
}
