//! The worked example of docs/scenario.md is a scenario, and the repository's scenarios can be read.

use crate::common::assert_within;
use std::path::Path;

use scenario::{Scenario, files_in};

#[test]
fn the_worked_example_is_a_scenario() {
    let page = include_str!("../../docs/scenario.md");
    let section = page.split("\n## ").find(|section| section.starts_with("Worked example")).unwrap();
    let blocks = section.split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    let scenario = Scenario::parse(&blocks.collect::<String>(), Path::new("four_bar.toml"));
    let scenario = scenario.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(
        (scenario.name.as_str(), scenario.case.grid.len(), scenario.engine.step.get()),
        ("four_bar", 73, Some(1e-3))
    );
    // The rocker angle that the example's oracle states is pi - acos(0.6) by the law of cosines.
    let value = scenario.oracles[0].series[0].points[0].value;
    assert_within!(
        (value - (std::f64::consts::PI - 0.6f64.acos())).abs(),
        scenario.oracles[0].series[0].points[0].bound
    );
}

#[test]
fn every_scenario_of_the_repository_can_be_read() {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios");
    let mut count = 0;
    for entry in std::fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let scenario = Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(Some(scenario.name.as_str()), path.file_stem().and_then(|stem| stem.to_str()));
            assert!(!scenario.case.grid.is_empty());
            count += 1;
        }
    }
    assert!(count >= 2);
}

/// docs/site/gallery writes docs/gallery.md, with the verdict of each scenario; `.ci/run` compares the complete page.
#[test]
fn the_gallery_has_every_mechanism() {
    let page = include_str!("../../docs/gallery.md");
    let top = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut count = 0;
    for folder in ["crates/scenario/src/templates", "scenarios", "scenarios/formulas"] {
        for path in files_in(top.join(folder)).unwrap() {
            let file = format!("(../{folder}/{})", path.file_name().unwrap().to_string_lossy());
            let title = Scenario::load(&path).unwrap_or_else(|error| panic!("{error}")).title;
            let row = page.lines().find(|line| line.contains(&file)).unwrap_or_else(|| panic!("no row of {file}"));
            assert!(row.contains(&format!("| {title} |")), "{row}");
            let picture = row.split("src=\"").nth(1).unwrap().split('"').next().unwrap();
            assert!(top.join("docs").join(picture).is_file(), "{picture}");
            count += 1;
        }
    }
    assert_eq!(page.matches("](../").count(), count);
    assert_eq!(std::fs::read_dir(top.join("docs/gallery")).unwrap().count(), count);
}
