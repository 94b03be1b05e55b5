//! `linkproof synthesize`, and `linkproof drive --catalogue`.

use std::fs;

use serde_json::Value;

use super::tools::Place;
use crate::common::assert_within;
use linkage::math::KeepNan;

const ROCKER: &str = "synthesize crank-rocker --pivot-mm 150,15 --rocker-mm 250 --extreme-deg 50 --swing-deg 32";
const SINKER: &str = "scenarios/ov7_drives/sinker_task.toml";

#[test]
fn a_crank_rocker_is_found_written_and_proven() {
    let place = Place::new();
    let text = place.ok(&format!("{ROCKER} -o rocker.toml --rpm 130"));
    for words in ["crank OA      0.025996 m\n", "coupler AB    0.347072 m\n", "mode          left\n"] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let proof = place.ok("run rocker.toml --no-record");
    assert!(proof.contains("AGREE"), "{proof}");
    assert!(fs::read_to_string(place.path("rocker.toml")).unwrap().starts_with("# linkproof synthesize crank-rocker"));
    let json: Value = serde_json::from_str(&place.ok(&format!("{ROCKER} --json -"))).unwrap();
    assert_within!((json["crank_m"].as_f64().unwrap() - 0.025_995_627_740_337).abs(), 1e-12);
    assert_within!((json["coupler_m"].as_f64().unwrap() - 0.347_071_931_891_81).abs(), 1e-12);
}

#[test]
fn a_slider_crank_is_found_written_and_proven() {
    let place = Place::new();
    let text = place.ok("synthesize slider-crank --stroke-mm 100 --offset-mm 30 --time-ratio 1.2 -o slider.toml");
    assert!(text.contains("time ratio    1.200000"), "{text}");
    assert!(place.ok("run slider.toml --no-record").contains("AGREE"));
    let scenario = place.ok("synthesize slider-crank --stroke-mm 100 --rod-mm 200 -o -");
    assert!(scenario.contains("[links.slider]") && scenario.contains("format = 1"), "{scenario}");
}

const MOTION: &str = "synthesize motion --pose 0,0,0 --pose 40,25,15 --pose 80,30,35 --pose 115,20,60";

/// Four-bars found in closed form for three, four and five positions are written, proven, and proven again by `run`.
#[test]
fn four_bars_through_precision_points_are_written_and_proven() {
    let place = Place::new();
    for (command, file) in [
        ("synthesize function --pivot-mm 100,0 --pair-deg 40,60 --pair-deg 80,80 --pair-deg 120,105", "f3"),
        (MOTION, "m4"),
        (
            "synthesize path --point-mm 0,0 --crank-deg 0 --point-mm 30,25 --crank-deg 40 --point-mm 70,30 --crank-deg 90",
            "p3",
        ),
    ] {
        let text = place.ok(&format!("{command} -o {file}.toml"));
        assert!(text.contains(&format!("proof         {file}: AGREE")), "{text}");
        let is_best = |line: &str| line.starts_with("   1 ") && line.trim_end().ends_with(" -");
        assert!(text.contains("four-bar 1 of the table") && text.lines().any(is_best), "{text}");
        let proof = place.ok(&format!("run {file}.toml --no-record"));
        assert!(proof.contains("AGREE"), "{proof}");
        let written = fs::read_to_string(place.path(&format!("{file}.toml"))).unwrap();
        let command = command.replace("function", "function --crank-pivot-mm 0,0");
        assert!(written.starts_with(&format!("# linkproof {command}\n")), "{written}");
        assert_eq!(written.contains("P = { x_m"), file != "f3", "{written}");
    }
    let json: Value = serde_json::from_str(&place.ok(&format!("{MOTION} --take 2 --json -"))).unwrap();
    assert_eq!((json["four_bars"].as_array().unwrap().len(), &json["taken"]), (10, &Value::from(2)));
    assert!(json["proof"].as_str().unwrap().contains("AGREE"), "{json}");
}

#[test]
fn a_search_is_written_drawn_and_checked() {
    let place = Place::new();
    let effort = "--candidates 20000 --refined 2 --evaluations 400 --seed 5";
    let text = place.ok(&format!("synthesize search {SINKER} {effort} -o found.toml --svg found.svg"));
    assert!(text.contains("ground.O3 y") && text.contains("Largest motion in a dwell"), "{text}");
    let written = fs::read_to_string(place.path("found.toml")).unwrap();
    assert!(
        written.starts_with("# Found by: linkproof synthesize search scenarios/ov7_drives/sinker_task.toml --seed 5")
    );
    let svg = fs::read_to_string(place.path("found.svg")).unwrap();
    let drawing = roxmltree::Document::parse(&svg).unwrap();
    let words: Vec<&str> = drawing.descendants().filter_map(|node| node.text()).collect();
    assert!(["dwell", "forward", "back", "360°", "100 %"].iter().all(|word| words.contains(word)), "{words:?}");
    // A repeated command writes an identical file, and `check` prints the same figures as the search.
    place.ok(&format!("synthesize search {SINKER} {effort} -o again.toml --threads 1"));
    assert_eq!(written, fs::read_to_string(place.path("again.toml")).unwrap());
    let checked = place.ok(&format!("synthesize check {SINKER} found.toml"));
    let tail = |text: &str| text[text.find(" from deg").unwrap()..].to_string();
    assert!(tail(&text).starts_with(&tail(&checked)), "{text}");
    assert!(text.ends_with('\n') && text.contains(": AGREE: "), "{text}");
    let json: Value =
        serde_json::from_str(&place.ok(&format!("synthesize check {SINKER} found.toml --json -"))).unwrap();
    assert_eq!(json["phases"].as_array().unwrap().len(), 6);
    assert!(place.ok("inspect found.toml").contains("RRR"));
}

/// A path through precision points is found with exact derivatives, written, drawn and proven.
#[test]
fn a_path_is_found_written_and_proven() {
    let place = Place::new();
    let task = "scenarios/synthesis/path_task.toml";
    let text = place.ok(&format!("synthesize search {task} -o path.toml -o path.svg -o path.json"));
    for words in ["refined with exact derivatives", "poses solved", "Largest distance from a precision point"] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let json: Value = serde_json::from_str(&fs::read_to_string(place.path("path.json")).unwrap()).unwrap();
    let distances: Vec<f64> =
        json["points"].as_array().unwrap().iter().map(|point| point["distance_m"].as_f64().unwrap()).collect();
    assert_eq!(distances.len(), 6);
    assert_within!(distances.iter().copied().fold(0.0, f64::larger), 1e-5);
    assert!(place.ok("run path.toml --no-record").contains("AGREE"));
    let svg = fs::read_to_string(place.path("path.svg")).unwrap();
    assert!(roxmltree::Document::parse(&svg).unwrap().descendants().any(|node| node.text() == Some("x, mm")));
}

/// A looser limit never gives a larger deviation.
#[test]
fn a_front_falls_with_its_limit() {
    let place = Place::new();
    let front = "synthesize front scenarios/ov7_drives/eyelet_needle_gradients_task.toml --candidates 300";
    place.ok(&format!("{front} --limit acceleration_m_s2=150:190:3 -o front.csv -o front.svg -o front.json"));
    let json: Value = serde_json::from_str(&fs::read_to_string(place.path("front.json")).unwrap()).unwrap();
    let deviations: Vec<f64> =
        json["points"].as_array().unwrap().iter().map(|point| point["deviation"].as_f64().unwrap()).collect();
    assert!(deviations.len() == 3 && deviations.windows(2).all(|pair| pair[1] <= pair[0]), "{deviations:?}");
    assert!(deviations[0] < 0.055, "{deviations:?}");
    assert_eq!(fs::read_to_string(place.path("front.csv")).unwrap().lines().count(), 4);
    place.refused(&format!("{front} --limit speed=1:2:3"), &["has no limit \"speed\"", "acceleration_m_s2"]);
    place.refused(&format!("{front} --limit acceleration_m_s2=1:2:1"), &["NAME=FROM:TO:COUNT"]);
    place.refused(
        "synthesize search scenarios/synthesis/path_task.toml --refinement evolution",
        &["precision points", "refinement = \"gradients\""],
    );
}

#[test]
fn mistakes_are_reported() {
    let place = Place::new();
    for (arguments, words) in [
        (
            "synthesize crank-rocker --pivot-mm 150 --rocker-mm 250 --extreme-deg 50 --swing-deg 32",
            ["two numbers", "150,15"],
        ),
        (
            "synthesize crank-rocker --pivot-mm 150,15 --rocker-mm 250 --extreme-deg 50 --swing-deg 0",
            ["the swing is 0 deg", "not zero"],
        ),
        (
            "synthesize crank-rocker --pivot-mm 150,0 --rocker-mm 250 --extreme-deg -16 --swing-deg 32",
            ["a crank of zero length", "move a pivot"],
        ),
        ("synthesize slider-crank --stroke-mm 100 --offset-mm 30 --rod-mm 60", ["too short", "longer than 0.067202 m"]),
        (
            "synthesize slider-crank --stroke-mm 100 --offset-mm 30 --time-ratio 9",
            ["cannot be reached", "give a time ratio below"],
        ),
        ("synthesize slider-crank --stroke-mm 100", ["--rod-mm", "--time-ratio"]),
        ("synthesize slider-crank --stroke-mm 100 --rod-mm 200 -o no.csv", ["FILE.toml, FILE.json", "found .csv"]),
        ("synthesize slider-crank --stroke-mm 100 --rod-mm 200 -o No.toml", ["cannot be the name", "lower-case"]),
        ("synthesize slider-crank --stroke-mm 100 --rod-mm 200 --rpm 0", ["--rpm", "not 0"]),
        ("synthesize motion --pose 0,0,0 --pose 40,25,15", ["found 2 positions", "three, four or five"]),
        ("synthesize motion --pose 0,0 --pose 40,25,15", ["three numbers", "100,20,45"]),
        ("synthesize motion --pose 0,0,0 --pose 4,2,0 --pose 9,3,0", ["translations", "parallelogram"]),
        ("synthesize path --point-mm 0,0 --point-mm 1,0 --crank-deg 3", ["2 points and 1 crank angles", "--point-mm"]),
        (
            "synthesize function --pivot-mm 0,0 --pair-deg 0,1 --pair-deg 2,3 --pair-deg 9,8",
            ["two pivots coincide", "separate pivot"],
        ),
        (
            "synthesize function --pivot-mm 9,0 --pair-deg 0,9 --pair-deg 20,30 --pair-deg 90,80 --take 2",
            ["the table has 1", "leave out --take"],
        ),
        ("synthesize search nothing.toml", ["cannot be read", "sinker_task.toml"]),
        ("synthesize search scenarios/crank_rocker.toml", ["`scenario` is missing", "add `scenario`"]),
        ("drive scenarios/crank_rocker.toml --catalogue nothing.toml", ["cannot be read", "catalogues/motors.toml"]),
        ("drive scenarios/crank_rocker.toml --catalogue motors.toml --efficiency 2", ["--efficiency", "0.92"]),
        (
            "drive scenarios/crank_rocker.toml --catalogue motors.toml --efficiency 0.1",
            ["the strongest motor has 2.2000 kW", "flywheel"],
        ),
        (
            "drive scenarios/crank_rocker.toml --catalogue motors.toml --synchronous-rpm 750",
            ["no motor with a synchronous speed of 750 rpm", "3000"],
        ),
    ] {
        motors(&place);
        place.refused(arguments, &words);
    }
    let outcome =
        place.run(&format!("synthesize search {SINKER} --candidates 100 --refined 1 --evaluations 1 -o {SINKER}"));
    assert!(outcome.code == 2, "{}", outcome.stderr);
    place.refused(
        &format!("synthesize check {SINKER} scenarios/ov7_new.toml"),
        &["--link", "no link \"lever\"", "lead_64"],
    );
    place.refused("synthesize cyclogram nothing.toml", &["cannot be read", "machine.toml"]);
    place.refused(&format!("synthesize cyclogram {SINKER}"), &["not known here"]);
}

const NEEDLES: &str = "synthesize check scenarios/ov7_drives/eyelet_needle_task.toml scenarios/ov7_base.toml \
     scenarios/ov7_new.toml scenarios/ov7_drives/eyelet_needle_found.toml";

/// The rows of a CSV file without quotes, as lists of cells.
fn rows(text: &str) -> Vec<Vec<&str>> {
    text.lines().map(|line| line.split(',').collect()).collect()
}

/// Largest length of a vector over the rows of a solution. The two channels are the components of the vector.
fn largest(place: &Place, file: &str, channels: [&str; 2]) -> f64 {
    let text = place.ok(&format!("solve scenarios/{file} -o -"));
    let rows = rows(&text);
    let columns = channels.map(|name| rows[0].iter().position(|own| *own == name).unwrap());
    let length = |row: &Vec<&str>| {
        let [x, y] = columns.map(|column| row[column].parse::<f64>().unwrap());
        x.hypot(y)
    };
    rows[1..].iter().map(length).fold(0.0, f64::larger)
}

/// Mechanisms of different structures are compared at one speed. The figures equal those of `solve` at this speed.
#[test]
fn mechanisms_are_compared_at_one_speed() {
    let place = Place::new();
    let text = place.ok(&format!("{NEEDLES} -o sheet.csv -o sheet.svg -o sheet.md -o sheet.json"));
    assert!(text.contains("928.192 rpm (97.2 rad/s)") && text.contains("ov7_base rocker_87, point 9"), "{text}");
    let csv = fs::read_to_string(place.path("sheet.csv")).unwrap();
    let rows = rows(&csv);
    assert_eq!(rows[0], ["quantity", "unit", "ov7_base", "ov7_new", "eyelet_needle_found"]);
    let row = |name: &str| {
        let own = rows.iter().find(|row| row[0].starts_with(name)).unwrap_or_else(|| panic!("{name}: {csv}"));
        [2, 3, 4].map(|column| own[column].parse::<f64>().unwrap_or(f64::NAN))
    };
    let accelerations = row("largest acceleration of the output point");
    let speeds = [97.2, 94.4, 94.4];
    let drives = [("ov7_base.toml", "9"), ("ov7_new.toml", "8"), ("ov7_drives/eyelet_needle_found.toml", "8")];
    for (((file, point), found), speed) in drives.into_iter().zip(accelerations).zip(speeds) {
        let channels = ["ax", "ay"].map(|axis| format!("point.{point}.{axis}_m_s2"));
        let sampled = largest(&place, file, [&channels[0], &channels[1]]) * (97.2f64 / speed).powi(2);
        assert!(sampled <= found + 1e-6 && sampled > 0.998 * found, "{file}: {sampled} {found}");
    }
    for (name, expected, within) in [
        ("largest motion in a dwell", [3.45, 15.0, 4.13], 0.01),
        ("acceleration divided", [30.26, 16.73, 19.35], 0.006),
        ("stroke", [5.45, 5.50, 5.50], 0.006),
    ] {
        for (found, expected) in row(name).into_iter().zip(expected) {
            assert_within!((found - expected).abs(), within, "{name}: {csv}");
        }
    }
    // Class III groups have no transmission angle.
    // Only the drive as built has a transmission angle, so this angle is not marked as the best value.
    let transmission = row("smallest transmission angle");
    assert!(transmission[0] > 0.0 && transmission[1].is_nan() && transmission[2].is_nan(), "{csv}");
    let markdown = fs::read_to_string(place.path("sheet.md")).unwrap();
    let marked = |name: &str| {
        let line = markdown.lines().find(|line| line.contains(name)).unwrap();
        line.split('|').skip(3).map(|cell| cell.contains("**")).take(3).collect::<Vec<_>>()
    };
    assert_eq!(marked("largest motion in a dwell"), [true, false, false]);
    assert_eq!(marked("largest acceleration of the output point"), [false, true, false]);
    assert_eq!([marked("| stroke |"), marked("smallest transmission")], [[false; 3], [false; 3]].map(Vec::from));
    let svg = fs::read_to_string(place.path("sheet.svg")).unwrap();
    let drawing = roxmltree::Document::parse(&svg).unwrap();
    let words = drawing.descendants().filter(|node| node.is_text());
    let words: Vec<&str> = words.filter_map(|node| node.text()).collect();
    assert_eq!(words.iter().filter(|word| **word == "forward").count(), 3, "{words:?}");
    let bold = drawing.descendants().filter(|node| node.attribute("font-weight") == Some("bold"));
    let bold: Vec<&str> = bold.filter_map(|node| node.text()).collect();
    assert!(bold.contains(&"3.45") && !bold.contains(&"4.13") && words.contains(&"4.13"), "{bold:?}");
    let json: Value = serde_json::from_str(&fs::read_to_string(place.path("sheet.json")).unwrap()).unwrap();
    assert_within!((json["mechanisms"][1]["unrest"].as_f64().unwrap() - 0.150).abs(), 1e-3);
    // At twice the speed, accelerations are four times as large. Scenarios with equal names get numbers.
    let task = "scenarios/ov7_drives/eyelet_needle_task.toml";
    let fast =
        place.ok(&format!("synthesize check {task} {0} {0} --speed-rpm 1856.4 -o -.csv", "scenarios/ov7_base.toml"));
    assert!(fast.starts_with("quantity,unit,ov7_base,ov7_base-2\n"), "{fast}");
    let line = fast.lines().find(|line| line.starts_with("largest acceleration of the output point")).unwrap();
    let double = line.split(',').nth(2).unwrap().parse::<f64>().unwrap();
    assert_within!((double / accelerations[0] - 4.0).abs(), 1e-3);
}

/// The drawing of the cyclogram has a ring of sectors for every organ, the names of the moments, and the displacements.
#[test]
fn a_cyclogram_is_drawn_for_all_organs() {
    let place = Place::new();
    let machine = "synthesize cyclogram scenarios/ov7_drives/machine.toml";
    let text = place.ok(&format!("{machine} -o machine.svg -o machine.csv -o machine.json"));
    assert!(text.contains("additional rise") && text.contains("printed end 250"), "{text}");
    let svg = fs::read_to_string(place.path("machine.svg")).unwrap();
    let drawing = roxmltree::Document::parse(&svg).unwrap();
    let sectors = drawing.descendants().filter(|node| {
        let is_tinted = ["#f3c9a5", "#fbe9da", "#e3edf4"].contains(&node.attribute("fill").unwrap_or(""));
        // Sectors have more than four corners; rectangles of the legend and of phases have four.
        is_tinted && node.attribute("d").is_some_and(|path| path.matches('L').count() > 4)
    });
    assert_eq!(sectors.count(), 5 + 6 + 4 + 4);
    let words: Vec<&str> = drawing.descendants().filter_map(|node| node.text()).collect();
    for name in [
        "drawing off",
        "clearing",
        "laying",
        "additional rise",
        "bringing in",
        "pressing",
        "landing",
        "joining, forming",
    ] {
        assert!(words.contains(&name), "{name}: {words:?}");
    }
    let csv = fs::read_to_string(place.path("machine.csv")).unwrap();
    let rows = rows(&csv);
    assert_eq!(rows.len(), 362);
    let column = rows[0].iter().position(|name| *name == "eyelet needles").unwrap();
    let at = |deg: usize| rows[deg + 1][column].parse::<f64>().unwrap();
    assert!(at(132) > 0.99 && at(15) < 0.1 && (at(0) - at(360)).abs() < 1e-9, "{csv}");
    let json: Value = serde_json::from_str(&fs::read_to_string(place.path("machine.json")).unwrap()).unwrap();
    assert_eq!(json["organs"].as_array().unwrap().len(), 4);
    assert_within!((json["moments"][5]["spans_rad"][0][1].as_f64().unwrap().to_degrees() - 260.0).abs(), 1e-9);
}

fn motors(place: &Place) {
    let own = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogues/motors.toml");
    fs::copy(own, place.path("motors.toml")).unwrap();
}

#[test]
fn the_published_motor_is_chosen() {
    let place = Place::new();
    motors(&place);
    let text = place.ok("drive scenarios/crank_rocker.toml --catalogue motors.toml --efficiency 0.92");
    for words in ["4A63B2: 0.55 kW, 2745 rpm", "ratio     21.115385", "required  547.3", "law = \"linear\""] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let json: Value = serde_json::from_str(
        &place.ok("drive scenarios/crank_rocker.toml --catalogue motors.toml --synchronous-rpm 1500 --json -"),
    )
    .unwrap();
    assert_eq!(json["motor"]["name"], "4A71A4");
}

/// An error in a catalogue is reported with the location of this error.
#[test]
fn catalogues_are_checked() {
    let place = Place::new();
    motors(&place);
    let good = fs::read_to_string(place.path("motors.toml")).unwrap();
    for (from, to, words) in [
        (
            "rated_speed_rpm = 2745",
            "rated_speed_rpm = 3745",
            ["`motors.4A63B2.rated_speed_rpm`", "not below the synchronous"],
        ),
        ("power_kW = 0.55", "power = 0.55", ["has no unit", "power_kW"]),
        ("breakdown_ratio = 2.2", "breakdown_ratio = 0.2", ["breakdown_ratio", "not above the rated"]),
        ("[[motors]]\nname = \"4A63B2\"", "[[motors]]\nnam = \"4A63B2\"", ["`name` is missing", "did you mean `name`"]),
    ] {
        assert!(good.contains(from), "{from}");
        fs::write(place.path("motors.toml"), good.replacen(from, to, 1)).unwrap();
        place.refused("drive scenarios/crank_rocker.toml --catalogue motors.toml", &words);
    }
}
