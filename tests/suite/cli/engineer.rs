//! The report answers the questions of an engineer: what the mechanism is, its figures, and every cause of a
//! disagreement.

use std::fs;

use linkage::math::KeepNan;
use serde_json::Value;

use super::tools::Place;
use crate::common::expected::agrees_with;

/// A file with two wrong formulas: a sign, and a sine for a cosine.
fn two_wrong() -> Place {
    let place = Place::new();
    let edits = [
        ("\"r*cos(phi) + sqrt(l^2 - r^2*sin(phi)^2)\"", "\"r*cos(phi) + sqrt(l^2 + r^2*sin(phi)^2)\""),
        ("\"-lambda*w*cos(phi)/cos(beta)\"", "\"-lambda*w*sin(phi)/cos(beta)\""),
    ];
    place.edited("formulas/slider_crank_centric.toml", "two_wrong.toml", &edits);
    place
}

fn report(name: &str) -> String {
    Place::new().ok(&format!("run scenarios/{name}.toml --no-record"))
}

fn is_as_reviewed(name: &str) {
    agrees_with(&format!("tests/suite/cli/reports/{name}.txt"), &report(name), "cli::engineer");
}

#[test]
fn the_report_of_a_four_bar() {
    is_as_reviewed("crank_rocker");
}

#[test]
fn the_report_of_a_slider_with_a_cylinder() {
    is_as_reviewed("boom_lift");
}

#[test]
fn the_report_of_a_motion_under_forces() {
    is_as_reviewed("compressor_runup");
}

#[test]
fn the_report_of_a_cam() {
    is_as_reviewed("cam_follower");
}

#[test]
fn ten_questions_have_their_lines() {
    let text = report("crank_rocker");
    let lines = [
        ("what is it", "joints     4 revolute: O, A, B, C"),
        ("what drives it", "drive      crank at joint O: constant speed, 130 rpm"),
        ("how far does the output move", "swing of rocker  "),
        ("how fast", "largest speed of rocker  "),
        ("what torque", "largest driving torque at O  "),
        ("what power", "largest power of the drive at O  "),
        ("which joint carries most", "largest force in joint C  "),
        ("how good is the force transmission", "smallest transmission angle (coupler, rocker)  "),
        ("is it right, and how sure", "Both analytic solutions and the Rapier simulation agree in all 57 quantities;"),
        ("what is next", "next       `linkproof "),
    ];
    for (question, line) in lines {
        assert!(text.lines().any(|own| own.starts_with(line)), "{question}: {line}\n{text}");
    }
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    let joints = text.lines().filter(|line| line.starts_with("largest force in joint")).count();
    assert_eq!(joints, 3, "{text}");
}

/// The figures are those of the solution: `bearings`, `drive` and `inspect` compute the same figures by other code.
#[test]
fn the_figures_are_those_of_the_solution() {
    let place = Place::new();
    let json: Value = serde_json::from_str(&place.ok("run scenarios/crank_rocker.toml --no-record --json -")).unwrap();
    let figures = json["runs"][0]["figures"].as_array().unwrap();
    let solved = super::tools::Table::of(&place.ok("solve scenarios/crank_rocker.toml"));
    let figure = |text: &str| figures.iter().find(|own| own["figure"] == text).unwrap_or_else(|| panic!("{text}"));
    let torque = solved.column("drive.torque_N_m").iter().fold(0.0f64, |most, own| most.larger(own.abs()));
    let found = figure("maxabs:drive.torque_N_m");
    assert_eq!(found["value"].as_f64(), Some(torque));
    assert_eq!((&found["unit"], found["at"].as_array().unwrap().len()), (&Value::from("N m"), 1));
    let [x, y] = ["fx_N", "fy_N"].map(|name| solved.column(&format!("joint.C.{name}")));
    let force = x.iter().zip(&y).fold(0.0f64, |most, (x, y)| most.larger(x.hypot(*y)));
    let found = figure("max:joint.C.f_N")["value"].as_f64().unwrap();
    assert!((found - force).abs() <= 1e-12 * force, "{found} {force}");
    assert_eq!(figure("range:link.rocker.angle_deg")["at"].as_array().unwrap().len(), 2);
    assert!(json["runs"][0]["machine"]["joints"].as_str().unwrap().contains("4 revolute"));
}

#[test]
fn a_file_chooses_its_figures() {
    let place = Place::new();
    let figures =
        "[report]\nfigures = [\"max:joint.A.f_N\", \"at_max:point.D.y_mm\", \"transmission_angle_deg\"]\n[grid]";
    place.edited("crank_rocker.toml", "chosen.toml", &[("[grid]", figures), ("\"crank_rocker\"", "\"chosen\"")]);
    let text = place.ok("run scenarios/chosen.toml --no-record --markdown out.md");
    let rows: Vec<&str> =
        text.lines().skip_while(|line| !line.starts_with("figure ")).take_while(|line| !line.is_empty()).collect();
    let names: Vec<&str> = rows.iter().skip(1).map(|row| row.split("  ").next().unwrap()).collect();
    assert_eq!(names, ["max:joint.A.f_N", "at_max:point.D.y_mm", "transmission_angle_deg"], "{text}");
    let markdown = fs::read_to_string(place.path("out.md")).unwrap();
    assert!(markdown.contains("\n| max:joint.A.f_N | "), "{markdown}");
    // With `--only`, the report keeps the chosen figures whose channels are requested.
    let only = place.ok("run scenarios/chosen.toml --no-record --only joint.A");
    assert!(only.contains("max:joint.A.f_N  ") && !only.contains("at_max:point.D.y_mm"), "{only}");
}

#[test]
fn a_wrong_figure_is_refused_with_its_place_and_the_way_out() {
    let place = Place::new();
    for (figures, words) in [
        ("[\"maxabs:drive.torque_Nm\"]", ["drive.torque_Nm", "did you mean `drive.torque_N_m`"]),
        ("[\"most:drive.torque_N_m\"]", ["most", "allowed here: `max`"]),
        ("[\"reach_to\"]", ["does not follow from the solution", "name figures such as"]),
        ("[\"verdict:none\"]", ["no formula `none`", ""]),
        ("[]", ["the list of figures is empty", "leave the section out"]),
        ("[3]", ["text", ""]),
    ] {
        place.edited(
            "crank_rocker.toml",
            "wrong.toml",
            &[("[grid]", &format!("[report]\nfigures = {figures}\n[grid]"))],
        );
        let found = place.refused("run scenarios/wrong.toml --no-record", &[]);
        let told = found.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        for word in words.iter().chain(&["wrong.toml:93", "figures"]) {
            assert!(told.contains(word), "{figures}: {word}\n{}", found.stderr);
        }
    }
    let needs = ("[grid]", "[report]\nfigures = [\"max:joint.A.f_N\"]\n[channels]\nwant = [\"positions\"]\n[grid]");
    place.edited("crank_rocker.toml", "needs.toml", &[needs]);
    place.refused("run scenarios/needs.toml --no-record", &["`max:joint.A.f_N` needs the channel joint.A.fx_N"]);
}

#[test]
fn every_wrong_formula_has_one_block_with_its_place_marked() {
    let place = two_wrong();
    let outcome = place.run("run scenarios/two_wrong.toml --no-record");
    assert_eq!(outcome.code, 1, "{}", outcome.stderr);
    let text = outcome.stdout;
    let lines: Vec<&str> = text.lines().collect();
    for (formula, mark) in
        [("x = r*cos(phi) + sqrt(l^2 + r^2*sin(phi)^2)", "+ r^2"), ("rod_w = -lambda*w*sin(phi)/cos(beta)", "sin")]
    {
        let at: Vec<usize> = (0..lines.len()).filter(|row| lines[*row] == formula).collect();
        let [row] = at[..] else { panic!("{formula}: {at:?}\n{text}") };
        let carets = lines[row + 1];
        assert_eq!(carets.trim_start().chars().collect::<std::collections::BTreeSet<_>>(), ['^'].into(), "{text}");
        assert_eq!(carets.find('^'), formula.find(mark), "{text}");
    }
    assert!(!text.contains("derivative of") && !text.contains(" more ("), "{text}");
    assert!(!text.contains("worst channel"), "{text}");
    assert!(lines.iter().all(|line| line.chars().count() <= 80), "{text}");
}

#[test]
fn the_page_has_the_curve_of_every_formula() {
    let place = two_wrong();
    place.run("run scenarios/two_wrong.toml --no-record -o page.html");
    let page = fs::read_to_string(place.path("page.html")).unwrap();
    let data = page.split("id=\"data\">").nth(1).unwrap().split("</script>").next().unwrap();
    let data: Value = serde_json::from_str(data).unwrap();
    let formulas = data["formulas"].as_array().unwrap();
    let wrong: Vec<&str> =
        formulas.iter().filter(|own| own["verdict"] == "disagree").map(|own| own["name"].as_str().unwrap()).collect();
    assert_eq!((formulas.len(), wrong), (12, vec!["x", "rod_w"]));
    for own in formulas {
        let (size, bound) = (own["max"].as_f64().unwrap(), own["bound"].as_f64().unwrap());
        assert_eq!(size <= bound, own["verdict"] == "agree", "{own}");
    }
    for part in ["<dt>joints</dt>", "stroke of piston", "<pre>x = r*cos(phi)"] {
        assert!(page.contains(part), "{part}");
    }
}
