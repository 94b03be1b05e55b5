//! Compares every number and every derivative with the case that is read from the file.

use std::collections::BTreeMap;
use std::path::Path;

use super::*;
use crate::{ScenarioFamily, files_in};
use linkage::case::CaseNumber;
use linkage::math::KeepNan;

/// The scenario with the number of a key increased by `by`; `None` if it is refused.
fn moved(family: &ScenarioFamily, key: &CaseKey, by: f64) -> Option<Scenario> {
    family.member(&[(key.name.clone(), key.value + by)]).ok()
}

fn numbers(scenario: &Scenario) -> BTreeMap<CaseNumber, f64> {
    scenario.case.numbers().into_iter().collect()
}

fn all_scenarios() -> Vec<Scenario> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let paths = files_in(folder).unwrap();
    paths.iter().map(|path| Scenario::load(path).unwrap_or_else(|error| panic!("{error}"))).collect()
}

#[test]
fn every_number_of_every_scenario_is_read_again() {
    let mut count = 0;
    for scenario in all_scenarios() {
        let slopes = CaseSlopes::of(&scenario, &StartRequest::default()).unwrap();
        for (number, slope) in &slopes.numbers {
            let own = numbers(&scenario)[number];
            let off = (slope.value - own).abs();
            assert!(off <= 1e-15 * own.abs(), "{} {number:?}: {} instead of {own}", scenario.name, slope.value);
            count += 1;
        }
    }
    assert!(count > 2000, "{count}");
}

/// Changes every key, reads the file again, and compares the change of every number of the case with its derivative.
/// The test also finds a number that changes although the module gives no derivative of it.
#[test]
fn every_derivative_is_that_of_the_file() {
    let (mut changed, mut silent) = (0, 0);
    for scenario in all_scenarios() {
        let slopes = CaseSlopes::of(&scenario, &StartRequest::default()).unwrap();
        let before = numbers(&scenario);
        let asked = StartRequest::default();
        let family = ScenarioFamily::of(&scenario.text, &scenario.path, asked, false).unwrap();
        for (index, key) in slopes.keys.iter().enumerate() {
            let step = 1e-7 * if key.value == 0.0 { 1.0 } else { key.value.abs() };
            let Some([up, down]) = [step, -step]
                .map(|by| moved(&family, key, by))
                .into_iter()
                .collect::<Option<Vec<_>>>()
                .and_then(|both| <[Scenario; 2]>::try_from(both).ok())
            else {
                silent += 1;
                continue;
            };
            let [up, down] = [numbers(&up), numbers(&down)];
            for (number, old) in &before {
                let (Some(high), Some(low)) = (up.get(number), down.get(number)) else { continue };
                let expected = (high - low) / (2.0 * step);
                let found = slopes.numbers.get(number).and_then(|own| own.by.get(&index)).copied().unwrap_or(0.0);
                let size = expected.abs() + old.abs() / key.value.abs().larger(1.0) + 1e-9;
                let off = (found - expected).abs();
                assert!(off <= 1e-5 * size, "{} {} {number:?}: {found}, {expected}", scenario.name, key.name);
                changed += usize::from(expected != 0.0);
            }
        }
    }
    assert!(changed > 2500 && silent < changed / 10, "{changed} changed, {silent} silent");
}
