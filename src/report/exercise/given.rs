//! The given numbers of a task sheet: dimensions, speed, masses and loads.

use super::super::class_words::{self as words, SheetLanguage};
use super::super::html::escaped;
use linkage::drive::Drive;
use linkage::input::Input;
use linkage::math::Vec2;
use linkage::mechanism::{GROUND, Link};
use linkage::trajectory::Stage;
use prover::mark::AnswerSheet;
use prover::numbers::significant;
use scenario::Scenario;
use scenario::excerpt::stated_tables;
use std::fmt::Write;

/// A length in mm, with at most three decimals.
fn mm(metres: f64) -> String {
    format!("{}", (metres * 1e6).round() / 1e3 + 0.0)
}

/// The given numbers as HTML.
pub(super) fn given(scenario: &Scenario, sheet: &AnswerSheet, language: SheetLanguage) -> String {
    let (case, mechanism) = (&scenario.case, &scenario.case.mechanism);
    let has_forces = sheet.columns.iter().any(|column| column.stage() >= Stage::Reactions);
    let mut text = String::from("<ul>\n");
    let mut item = |told: String| {
        let _ = writeln!(text, "<li>{}</li>", escaped(&told));
    };
    item(speed(case.crank(), &mechanism.links()[case.crank().link].name, language));
    for (index, link) in mechanism.links().entries() {
        let name = match index {
            GROUND => words::points_of_the_ground(language),
            _ => words::points_of(language, &link.name, &index.index()),
        };
        let at = |at: Vec2| format!("({}; {})", mm(at.x), mm(at.y));
        let points: Vec<String> = link.points.iter().map(|own| format!("{} {}", own.name, at(own.local))).collect();
        let mut told = format!("{name}: {}", points.join(", "));
        if index != GROUND {
            told += &lengths(link, language);
        }
        if has_forces && link.mass > 0.0 {
            let [mass, inertia] = [link.mass, link.inertia].map(|number| significant(number, 4));
            let centre = link.mass_centre;
            told += &format!("; {}", words::mass_of(language, &mass, &inertia, &mm(centre.x), &mm(centre.y)));
        }
        item(told);
    }
    for joint in mechanism.joints().iter().filter(|joint| joint.slides() && joint.first.link == GROUND) {
        let axis = joint.axis_on(joint.first.link).unwrap_or_default();
        let degrees = format!("{}", (axis.y.atan2(axis.x).to_degrees() * 1e4).round() / 1e4 + 0.0);
        item(words::guide(language, &joint.name, &degrees));
    }
    if has_forces {
        item(words::gravity(language, &case.gravity.x, &case.gravity.y));
    }
    text += "</ul>\n";
    let mut put = |title: &str, section: &str| {
        let tables = stated_tables(scenario, section);
        if !tables.is_empty() {
            let _ = writeln!(text, "<p>{title}:</p>\n<pre>{}</pre>", escaped(&tables));
        }
    };
    put(&words::transmissions_as_in_the_file(language), "transmissions");
    if has_forces {
        put(&words::loads_as_in_the_file(language), "loads");
    }
    let _ = writeln!(text, "<p class=\"small\">{}</p>", words::frame_of_angles(language));
    text
}

fn speed(drive: &Drive, link: &str, language: SheetLanguage) -> String {
    let speed = drive.constant_speed().unwrap_or_default();
    let number = |value: f64| significant(value, 6);
    match drive.input {
        Input::Angle | Input::Turn => {
            let [rad, rpm] = ["rad/s", "rpm"].map(|symbol| words::unit(language, symbol));
            let told = format!("{} {rad} ({} {rpm})", number(speed), number(speed * 30.0 / std::f64::consts::PI));
            words::crank_speed(language, &link, &told)
        }
        Input::Slide => {
            words::drive_speed(language, &link, &format!("{} {}", number(speed), words::unit(language, "m/s")))
        }
    }
}

/// Distances of the points of a link from each other.
fn lengths(link: &Link, language: SheetLanguage) -> String {
    let mut told = Vec::new();
    for (number, one) in link.points.iter().enumerate() {
        for other in &link.points[number + 1..] {
            told.push(format!("{}{} = {}", one.name, other.name, mm((other.local - one.local).norm())));
        }
    }
    if told.is_empty() { String::new() } else { format!("; {}: {}", words::distances(language), told.join(", ")) }
}
