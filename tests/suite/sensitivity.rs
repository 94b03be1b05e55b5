//! `linkproof sensitivity`: derivatives, compared with differences between solutions of the crate `precise`; the
//! command.

use std::fs;

use serde_json::Value;

use crate::cli::tools::Place;
use crate::common::{assert_within, shipped};
use design::sensitivity::{SensitivityQuestion, sensitivity};
use scenario::{Scenario, StartRequest};

/// The file computes many numbers of the case from one parameter.
/// The derivative with respect to the parameter equals a difference quotient: two solutions of the crate `precise`, for
/// two values of the parameter.
#[test]
fn a_parameter_has_the_derivative_of_differences() {
    let scenario = shipped("boom_lift.toml");
    let figure = "at=400:drive.force_N";
    let rows = scenario.case.grid.inputs.len();
    let row = rows / 2;
    let input = 1e3 * scenario.case.grid.inputs[row];
    let figure = figure.replace("400", &format!("{input}"));
    let question = SensitivityQuestion { figures: vec![figure.parse().unwrap()], ..SensitivityQuestion::default() };
    let found = sensitivity(&scenario, &question).unwrap();
    assert!(!found.by_input && !found.keys.is_empty());
    let mut seen = 0;
    for (index, key) in found.keys.iter().enumerate().take(4) {
        let value = |by: f64| -> Option<f64> {
            let asked = StartRequest { set: vec![(key.name.clone(), key.value + by)], ..StartRequest::default() };
            let moved = Scenario::parse_as(&scenario.text, &scenario.path, &asked).ok()?;
            let run = ::precise::solve(&moved.case).unwrap();
            Some(run.named("drive.force_N").unwrap()[row])
        };
        let step = 1e-4 * key.value.abs();
        let central = |h: f64| Some((value(h)? - value(-h)?) / (2.0 * h));
        let (Some(whole), Some(half)) = (central(step), central(step / 2.0)) else { continue };
        let expected = (4.0 * half - whole) / 3.0;
        let size = found.figures[0].sampled.value.abs() / key.value.abs();
        let off = (found.figures[0].by[index] - expected).abs();
        assert!(off <= 1e-9 * size, "{}: {} and {expected}", key.name, found.figures[0].by[index]);
        seen += 1;
    }
    assert!(seen > 1, "{seen}");
}

/// The command gives the same numbers as text, table, JSON and drawing.
/// The derivatives equal the difference quotients of a sweep, and the tolerance stack follows from the derivatives.
#[test]
fn all_results_have_the_same_numbers() {
    let place = Place::empty();
    place.ok("new four-bar");
    let figure = "max:joint.A.f_N";
    let tolerances = [("crank_mm", 0.02), ("coupler_mm", 0.05)];
    let told = place.ok(&format!(
        "sensitivity four_bar.toml --figure {figure} --tolerance crank_mm=0.02 --tolerance coupler_mm=0.05 --most 3 \
         -o all.csv -o all.json -o all.svg"
    ));
    let found: Value = serde_json::from_str(&fs::read_to_string(place.path("all.json")).unwrap()).unwrap();
    let found = &found["figures"][0];
    let slopes = found["slopes"].as_array().unwrap();
    let slope = |key: &str| {
        let of_key = slopes.iter().find(|own| own["key"] == key).unwrap_or_else(|| panic!("{key}"));
        (of_key["derivative"].as_f64().unwrap(), of_key["relative"].as_f64().unwrap())
    };

    let table = fs::read_to_string(place.path("all.csv")).unwrap();
    let mut rows = csv::Reader::from_reader(table.as_bytes());
    let header = rows.headers().unwrap().clone();
    let rows: Vec<csv::StringRecord> = rows.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), slopes.len());
    for row in &rows {
        let cell = |name: &str| &row[header.iter().position(|own| own == name).unwrap()];
        let (derivative, relative) = slope(cell("key"));
        assert_eq!(cell("derivative").parse::<f64>().unwrap(), derivative);
        assert_eq!(cell("relative").parse::<f64>().unwrap(), relative);
        let limit = tolerances.iter().find(|(key, _)| *key == cell("key")).map(|(_, limit)| *limit);
        assert_eq!(cell("tolerance").parse::<f64>().ok(), limit);
    }

    // For these small changes, the extreme stays at its instant.
    // The error of the central difference is therefore of order step^2.
    for (key, at) in [("crank_mm", 40.0), ("coupler_mm", 120.0), ("rocker_mm", 80.0), ("speed_rpm", 60.0)] {
        let step = 1e-4 * at;
        place.ok(&format!("sweep four_bar.toml --vary {key}={}:{}:2 --figure {figure} -o {key}", at - step, at + step));
        let ends = crate::sweep::figures(&place.path(&format!("{key}/cases.parquet")), figure);
        let (derivative, _) = slope(key);
        assert_within!((ends[1] - ends[0]) / (2.0 * step) - derivative, 1e-5 * derivative.abs(), "{key}");
    }
    // All masses are proportional to the density, and the mechanism has no other loads than weight and inertia.
    assert_within!(slope("density").1 - 1.0, 1e-12, "density");
    assert_eq!(slope("point_mm").0, 0.0);

    let effects = tolerances.map(|(key, limit)| (slope(key).0 * limit).abs());
    let stack = |name: &str| found["stack"][name].as_f64().unwrap();
    assert_within!(stack("worst") - effects.iter().sum::<f64>(), 1e-15, "worst case");
    assert_within!(stack("root_sum_square") - effects[0].hypot(effects[1]), 1e-15, "root of the sum of squares");
    // The variance of a uniform deviation is a third of its squared limit.
    // A sample of 300 mechanisms gives this variance to a few per cent.
    let uniform = stack("root_sum_square") / 3f64.sqrt();
    assert_within!(stack("linear_deviation") - uniform, 0.15 * uniform, "sample of linear theory");
    assert_within!(stack("sampled_deviation") - stack("linear_deviation"), 1e-3 * uniform, "sampled mechanisms");

    // The keys with tolerances are listed first, in the order of their effects.
    // The text only counts the remaining keys.
    let places: Vec<usize> = ["coupler_mm", "crank_mm"].map(|key| told.find(key).unwrap()).into();
    assert!(places[0] < places[1] && told.contains("5 further keys"), "{told}");
    let drawing = fs::read_to_string(place.path("all.svg")).unwrap();
    for (key, effect) in [("crank_mm", effects[0]), ("coupler_mm", effects[1])] {
        assert!(drawing.contains(key) && drawing.contains(&format!("{effect:.6}")), "{drawing}");
    }
}

#[test]
fn questions_that_mean_nothing_are_refused() {
    let place = Place::empty();
    place.ok("new four-bar");
    let refused = |arguments: &str, words: &[&str]| {
        place.refused(&format!("sensitivity four_bar.toml {arguments} -o a.csv"), words);
        assert!(!place.path("a.csv").exists(), "{arguments}");
    };
    refused("--figure max:joint.Q.f_N", &["joint.Q.f_N"]);
    refused("--figure most:joint.A.f_N", &["most"]);
    refused("--figure max:joint.A.f_N --by crank", &["crank"]);
    refused("--figure max:joint.A.f_N --by links.crank.weight_kg", &["links.crank.weight_kg"]);
    refused("--figure max:joint.A.f_N --tolerance crank_mm=0", &["--tolerance", "crank_mm"]);
    refused("--figure max:joint.A.f_N --tolerance crank_mm=wide", &["wide"]);
    let twice = "--tolerance crank_mm=0.1 --tolerance crank_mm=0.2";
    refused(&format!("--figure max:joint.A.f_N {twice}"), &["--tolerance", "`crank_mm` is given twice"]);
    refused("--figure max:joint.A.f_N --set crank_mm=30 --set crank_mm=31", &["--set", "`crank_mm` is given twice"]);
    refused("--figure max:joint.A.f_N --by parameters.crank_mm", &["did you mean `crank_mm`?"]);
}
