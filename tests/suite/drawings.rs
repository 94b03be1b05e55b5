//! `linkproof draw`: positions, partial assemblies, configurations, bitmaps, wrong input.

mod groups;
mod marks;
mod positions;
mod shipped;
mod unfinished;

use std::fs;
use std::path::{Path, PathBuf};

use analytic::AssurSolver;
use assert_cmd::Command;
use design::plan::state_at;
use linkage::case::When;
use linkage::math::{KeepNan, Vec2};
use linkproof::Scenario;

use crate::common::assert_within;

fn draw(arguments: &[&str]) -> (i32, Vec<u8>, String) {
    let output = Command::cargo_bin("linkproof").unwrap().arg("draw").args(arguments).output().unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    (output.status.code().unwrap(), output.stdout, told)
}

fn svg(arguments: &[&str]) -> String {
    let (code, out, told) = draw(&[arguments, &["-o", "-"]].concat());
    assert_eq!(code, 0, "{told}");
    String::from_utf8(out).unwrap()
}

fn file(name: &str) -> String {
    format!("scenarios/{name}.toml")
}

/// A changed scenario in a temporary directory.
fn changed(directory: &Path, name: &str, change: impl Fn(String) -> String) -> PathBuf {
    let path = directory.join(format!("{name}.toml"));
    fs::write(&path, change(fs::read_to_string(file(name)).unwrap())).unwrap();
    path
}

/// Centres of the pins, drawn as circles with a white interior.
fn pins(document: &roxmltree::Document) -> Vec<Vec2> {
    let number = |node: &roxmltree::Node, key: &str| node.attribute(key).unwrap().parse::<f64>().unwrap();
    let circles = document.descendants().filter(|node| node.has_tag_name("circle"));
    let pins = circles.filter(|node| node.attribute("fill") == Some("white") && number(node, "r") == 1.2);
    pins.map(|node| Vec2::new(number(&node, "cx"), -number(&node, "cy"))).collect()
}

fn texts(document: &roxmltree::Document) -> Vec<String> {
    let words = document.descendants().filter(|node| node.has_tag_name("text"));
    words.map(|node| node.descendants().filter_map(|n| n.is_text().then(|| n.text())?).collect::<String>()).collect()
}

/// The pins on paper have the positions of the solution, except for one scale and one shift.
#[test]
fn pins_are_drawn_at_the_solved_positions() {
    for (name, degrees) in [("crank_rocker", 30.0), ("ov7_base", -120.0), ("class3_group", 200.0)] {
        let case = Scenario::load(file(name)).unwrap().case;
        let state = state_at(&case, &AssurSolver, When::Crank(f64::to_radians(degrees))).unwrap();
        let text = svg(&[&file(name), "--crank-deg", &degrees.to_string()]);
        let document = roxmltree::Document::parse(&text).unwrap();
        let drawn = pins(&document);
        let mut places: Vec<Vec2> = Vec::new();
        for joint in case.mechanism.joints() {
            let at = state.motions[joint.first.link].point(joint.first.local);
            if !places.iter().any(|other| (other - at).norm() < 1e-9) {
                places.push(at);
            }
        }
        assert_eq!(drawn.len(), places.len(), "{name}");
        let size = |all: &[Vec2]| all.iter().map(|a| all.iter().map(|b| (a - b).norm()).sum::<f64>()).sum::<f64>();
        let scale = size(&places) / size(&drawn);
        let middle = |all: &[Vec2]| all.iter().sum::<Vec2>() / all.len() as f64;
        for at in &places {
            let own = (at - middle(&places)) / scale;
            let nearest = drawn.iter().map(|pin| (pin - middle(&drawn) - own).norm()).fold(f64::MAX, f64::smaller);
            assert_within!(nearest, 0.02, "{name}: {at:?}");
        }
    }
}

#[test]
fn every_scenario_can_be_drawn_reproducibly() {
    let mut count = 0;
    for entry in fs::read_dir("scenarios").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "toml") {
            let name = path.to_str().unwrap();
            let text = svg(&[name, "--loads", "--dimensions", "--traces"]);
            assert!(roxmltree::Document::parse(&text).is_ok() && !text.contains("NaN"), "{name}");
            if count % 5 == 0 {
                assert_eq!(text, svg(&[name, "--loads", "--dimensions", "--traces"]), "{name}");
            }
            count += 1;
        }
    }
    assert!(count > 25);
}

#[test]
fn a_loop_that_cannot_close_is_drawn_with_its_gap() {
    let directory = tempfile::tempdir().unwrap();
    // The two rods together are shorter than the distance of their outer ends, so the loop cannot close.
    let short = changed(directory.path(), "five_bar_on_a_spring", |text| {
        text.replace("x_mm = 260", "x_mm = 100").replace("x_mm = 240", "x_mm = 90")
    });
    let picture = directory.path().join("open.svg");
    let (code, _, told) = draw(&[short.to_str().unwrap(), "-o", picture.to_str().unwrap()]);
    assert_eq!(code, 0, "{told}");
    assert!(told.starts_with("warning: `start.groups (rod_1, rod_2)`: "), "{told}");
    assert!(told.contains("apart, but its links span") && told.contains("stays open by"), "{told}");
    let text = fs::read_to_string(&picture).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    // A is at (60, 0), B is 45 mm from (300, 0) in the direction 40 deg. The gap is the distance AB minus both rod
    // lengths.
    let gap = (300.0 + 45.0 * f64::to_radians(40.0).cos() - 60.0).hypot(45.0 * f64::to_radians(40.0).sin()) - 190.0;
    let written = texts(&document)
        .into_iter()
        .find_map(|text| text.trim().strip_prefix("gap ")?.strip_suffix(" mm")?.parse::<f64>().ok());
    assert_within!(written.unwrap() - gap, 0.01);
    assert!(text.contains("stroke-dasharray=\"2 1.4\""), "links without a definite position are dashed");
}

/// A crank and a rocker without the coupler between them.
const WITHOUT_COUPLER: &str = r#"
format = 1
name = "open"
title = "A crank-rocker without its coupler"
[ground.points]
O = { x_mm = 0, y_mm = 0 }
C = { x_mm = 200, y_mm = 0 }
[links.crank.points]
O = { x_mm = 0, y_mm = 0 }
A = { x_mm = 50, y_mm = 0 }
[links.rocker.points]
C = { x_mm = 0, y_mm = 0 }
B = { x_mm = 120, y_mm = 0 }
[[joints]]
name = "O"
type = "revolute"
links = ["ground", "crank"]
[[joints]]
name = "C"
type = "revolute"
links = ["ground", "rocker"]
[drive]
joint = "O"
speed_rad_s = 10
[start]
crank_deg = 60
[grid]
from_deg = 60
to_deg = 420
step_deg = 10
"#;

#[test]
fn an_incomplete_mechanism_is_drawn() {
    let directory = tempfile::tempdir().unwrap();
    let open = directory.path().join("open.toml");
    fs::write(&open, WITHOUT_COUPLER).unwrap();
    let (code, out, told) = draw(&[open.to_str().unwrap(), "-o", "-"]);
    assert!(code == 0 && told.starts_with("warning: `joints`: the mobility is"), "{code} {told}");
    let text = String::from_utf8(out).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    assert_eq!(pins(&document).len(), 2, "both pivots");
    assert!(text.contains("stroke-dasharray=\"2 1.4\""), "the rocker has no definite position");
    assert!(texts(&document).iter().any(|text| text.contains("mobility")), "the picture states the reason");
}

/// The picture has a cell for every configuration, with the names that `mode` accepts.
/// The configuration that the file selects is one of the cells.
#[test]
fn configurations_are_drawn_side_by_side_with_their_names() {
    let text = svg(&[&file("ov7_base"), "--each-mode"]);
    let document = roxmltree::Document::parse(&text).unwrap();
    let all = texts(&document).join("|");
    for wanted in ["rod_23,rocker_43 = left", "rod_57,rocker_87 = right", "(as in the file)", "(does not"] {
        assert!(all.contains(wanted), "{wanted}: {all}");
    }
    // `--mode` accepts names from the picture.
    let one = svg(&[&file("ov7_base"), "--mode", "rod_57,rocker_87=left"]);
    assert_ne!(one, svg(&[&file("ov7_base")]));
}

/// If the file leaves the mode open, the command points to `--each-mode`, which draws all configurations.
#[test]
fn a_missing_mode_can_be_chosen_from_the_picture() {
    let directory = tempfile::tempdir().unwrap();
    let open = changed(directory.path(), "six_bar_slider", |text| {
        text.lines().filter(|line| !line.starts_with("mode = ")).map(|line| format!("{line}\n")).collect()
    });
    let (code, _, told) = draw(&[open.to_str().unwrap(), "-o", "-"]);
    assert!(code == 0 && told.starts_with("warning: "), "{told}");
    let words = ["neither an assembly mode", "note: six_bar_slider: --each-mode draws all configurations"];
    assert!(words.iter().all(|word| told.contains(word)), "{told}");
    let (code, out, told) = draw(&[open.to_str().unwrap(), "--each-mode", "-o", "-"]);
    assert!(code == 0 && told.starts_with("note: "), "{told}");
    let text = String::from_utf8(out).unwrap();
    assert!(["= left", "= right", "= ahead", "= behind"].iter().all(|mode| text.contains(mode)), "{text}");
}

#[test]
fn bitmaps_are_animated_and_reproducible() {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name).to_str().unwrap().to_string();
    for name in ["a.png", "a.gif", "a.webp"] {
        let (own, to) = (file("crank_rocker"), path(name));
        let mut arguments = vec![own.as_str(), "-o", &to, "--width", "200"];
        if !name.ends_with("png") {
            arguments.extend(["--frames", "6", "--seconds", "3"]);
        }
        assert_eq!(draw(&arguments).0, 0, "{name}");
        let first = fs::read(path(name)).unwrap();
        assert_eq!(draw(&arguments).0, 0);
        assert_eq!(first, fs::read(path(name)).unwrap(), "{name}");
    }
    assert!(fs::read(path("a.png")).unwrap().starts_with(b"\x89PNG"));
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(fs::File::open(path("a.gif")).unwrap()).unwrap();
    let mut frames = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        assert_eq!((frame.width, frame.delay), (200, 50));
        frames.push(frame.buffer.to_vec());
    }
    assert_eq!(frames.len(), 6);
    assert!(frames.windows(2).all(|pair| pair[0] != pair[1]), "every frame shows another pose");
    // The upper left corner has the colour of the paper, and the frame contains a drawing.
    assert_eq!(frames[0][..4], [255; 4]);
    assert!(frames[0].chunks(4).filter(|pixel| pixel[0] < 128).count() > 100);
    let bytes = fs::read(path("a.webp")).unwrap();
    let mut decoder = image_webp::WebPDecoder::new(std::io::Cursor::new(bytes)).unwrap();
    assert_eq!((decoder.num_frames(), decoder.dimensions().0), (6, 200));
    let mut pixels = vec![0; decoder.output_buffer_size().unwrap()];
    assert_eq!(decoder.read_frame(&mut pixels).unwrap(), 500);
    assert!(pixels.iter().any(|&part| part < 128) && pixels[..3] == [255; 3]);
}

/// A released pendulum swings: its path is the arc to the other side, not a circle.
/// The path of a double pendulum is not a circle either.
#[test]
fn paths_of_swinging_links_are_no_full_circles() {
    let path = |name: &str| {
        let text = svg(&[&file(name), "--traces"]);
        let document = roxmltree::Document::parse(&text).unwrap();
        let mut lines = document.descendants().filter_map(|node| node.attribute("d")).collect::<Vec<_>>();
        lines.sort_by_key(|own| own.len());
        let numbers = lines.last().unwrap().split(|sign: char| !matches!(sign, '0'..='9' | '.' | '-'));
        let numbers: Vec<f64> = numbers.filter(|own| !own.is_empty()).map(|own| own.parse().unwrap()).collect();
        assert!(numbers.len() > 200 && numbers.len().is_multiple_of(2), "{name}: {} numbers", numbers.len());
        numbers
    };
    let extent = |own: &[f64], axis: usize| {
        let all = || own.iter().skip(axis).step_by(2).copied();
        all().fold(f64::NEG_INFINITY, f64::larger) - all().fold(f64::INFINITY, f64::smaller)
    };
    // After a release at 20 deg, the arc is 2 sin 20 deg wide and 1 - cos 20 deg high, as multiples of the pendulum's
    // length.
    let arc = path("formulas/simple_pendulum");
    let ratio = (1.0 - 20f64.to_radians().cos()) / (2.0 * 20f64.to_radians().sin());
    approx::assert_relative_eq!(extent(&arc, 1) / extent(&arc, 0), ratio, max_relative = 2e-2);
    let free = path("double_pendulum");
    assert!(extent(&free, 1) < 0.7 * extent(&free, 0), "{} by {}", extent(&free, 0), extent(&free, 1));
}

#[test]
fn wrong_input_is_refused_with_a_remedy() {
    let own = file("crank_rocker");
    for (arguments, told) in [
        (vec![own.as_str(), "-o", "x.bmp"], ".svg, .pdf, .png, .dxf, .gif or .webp"),
        (vec![own.as_str(), "-o", "picture"], ".svg, .pdf, .png, .dxf, .gif or .webp"),
        (vec![own.as_str(), "-o", "/nowhere/at/all/x.svg"], "nowhere"),
        (vec![own.as_str(), "-o", "-", "--crank-deg", "nan"], "finite"),
        (vec![own.as_str(), "-o", "-", "--crank-deg", "1e300"], "--crank-deg"),
        (vec![own.as_str(), "-o", "x.png", "--width", "0"], "100..=4000"),
        (vec![own.as_str(), "-o", "x.gif", "--each-mode"], "--each-mode"),
        (vec![own.as_str(), "-o", "x.svg", "--width", "300"], "`--width`: an SVG, a PDF or a DXF has no pixels"),
        (vec![own.as_str(), "-o", "x.png", "--frames", "3"], "`--frames`: the picture is not animated"),
        (vec![own.as_str(), "-o", "-", "--seconds", "3"], "`--seconds`: the picture is not animated"),
        (vec![own.as_str(), "-o", "scenarios/x.toml"], "scenario file"),
        (vec!["scenarios/none.toml", "-o", "-"], "none.toml"),
    ] {
        let (code, out, error) = draw(&arguments);
        assert!(code == 2 && out.is_empty() && error.contains(told), "{arguments:?}: {code} {error}");
    }
}

/// A small picture has no letters.
/// If a viewer in dark mode opens the file of a picture directly, the picture is dark.
/// Inside a page or printed, the picture stays light.
#[test]
fn small_pictures_have_no_letters_and_pictures_follow_a_dark_viewer() {
    let small = svg(&[&file("crank_rocker"), "--traces", "--small"]);
    let document = roxmltree::Document::parse(&small).unwrap();
    assert!(texts(&document).is_empty() && pins(&document).len() >= 4, "{small}");
    for rule in ["@media screen and (prefers-color-scheme:dark)", "svg:root [fill=\"#1a1a1a\"]{fill:#eceff4}"] {
        assert!(small.contains(rule), "{small}");
    }
    let (code, _, told) = draw(&[&file("crank_rocker"), "--small", "--loads"]);
    assert!(code == 2 && told.contains("--loads"), "{told}");
}

/// A pin that joins three links has a ring, and loads have a separate colour.
#[test]
fn marks_distinguish_pins_and_loads() {
    let rings = |name: &str| {
        let text = svg(&[&file(name)]);
        let document = roxmltree::Document::parse(&text).unwrap();
        let circles = document.descendants().filter(|node| node.has_tag_name("circle"));
        circles.filter(|node| node.attribute("r") == Some("2.1") && node.attribute("fill") == Some("none")).count()
    };
    assert_eq!((rings("ov7_base"), rings("class3_group")), (2, 0));
    let (with, without) = (svg(&[&file("rotary_engine")]), svg(&[&file("crankcase")]));
    let loads = |text: &str| text.matches("stroke=\"#c1121f\"").count();
    assert!(loads(&with) >= 5 && loads(&without) == 0);
}

/// The key `drawn` of a prismatic pair takes precedence over the symbol that the program chooses by names and
/// positions.
#[test]
fn a_prismatic_pair_is_drawn_as_the_file_says() {
    let directory = tempfile::tempdir().unwrap();
    let as_said = |name: &str, said: &str| {
        let path = changed(directory.path(), name, |text| {
            text.replace("type = \"prismatic\"", &format!("type = \"prismatic\"\n{said}"))
        });
        draw(&[path.to_str().unwrap(), "-o", "-"])
    };
    let picture = |name: &str, said: &str| {
        let (code, out, told) = as_said(name, said);
        assert_eq!(code, 0, "{told}");
        String::from_utf8(out).unwrap()
    };
    // For each scenario: the symbol that the program chooses, and a symbol that it does not choose.
    // The scenarios have a ram on rails, pistons in cylinders, and a block in a swinging slot.
    for (name, own, other) in [
        ("loaded_slider", "block", "cylinder"),
        ("compressor", "cylinder", "block"),
        ("quick_return", "block", "cylinder"),
        ("rotary_engine", "cylinder", "block"),
    ] {
        let plain = picture(name, "");
        assert_eq!(plain, picture(name, &format!("drawn = \"{own}\"")), "{name}");
        assert_ne!(plain, picture(name, &format!("drawn = \"{other}\"")), "{name}");
    }
    let (code, out, told) = as_said("compressor", "drawn = \"cylindre\"");
    assert!(code == 0 && told.starts_with("warning: ") && told.contains(".drawn`"), "{told}");
    assert!(told.contains("did you mean \"cylinder\"?") && !out.is_empty(), "{told}");
}

/// In an animation the labels are the numbers of links, drawn on the links.
/// Names of points are not drawn, because they would jump from frame to frame.
#[test]
fn numbers_move_with_links_in_an_animation() {
    let case = Scenario::load(file("crank_rocker")).unwrap().case;
    let places = |degrees: f64| {
        let state = state_at(&case, &AssurSolver, When::Crank(f64::to_radians(degrees))).unwrap();
        let pose = |motion: &linkage::math::Motion| {
            let angle = motion.direction.y.atan2(motion.direction.x);
            linkage::mechanism::LinkPose { origin: motion.origin, angle }
        };
        drawing::lay::Laid::whole(state.motions.iter().map(pose))
    };
    let shots = [20.0, 60.0].map(|degrees| drawing::view::Shot { laid: places(degrees), acting: Vec::new() });
    let subject = drawing::view::DrawnSubject {
        mechanism: &case.mechanism,
        drives: &case.drives,
        loads: &case.loads,
        gravity: case.gravity,
    };
    let extras = drawing::view::Extras { is_moving: true, ..Default::default() };
    let travels = drawing::Travels::none(&case.mechanism);
    let motion = drawing::view::ShownMotion { travels: &travels, traces: &[], series: None };
    let cells = drawing::view::cells(&subject, &shots, motion, extras, Vec2::new(150.0, 120.0));
    for cell in cells {
        let text = drawing::paper::document::document(&cell.figure, [200.0, 200.0], "frame");
        let words = texts(&roxmltree::Document::parse(&text).unwrap());
        assert!(words.contains(&"2".into()) && words.contains(&"3".into()), "{words:?}");
        assert!(!words.contains(&"B".into()), "{words:?}");
    }
}
