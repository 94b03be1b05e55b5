//! `linkproof synthesize`, and `linkproof drive --catalogue`.

use std::fs;

use serde_json::Value;

use super::tools::Place;
use crate::common::assert_within;

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
    assert_eq!(tail(&checked), tail(&text));
    let json: Value =
        serde_json::from_str(&place.ok(&format!("synthesize check {SINKER} found.toml --json -"))).unwrap();
    assert_eq!(json["phases"].as_array().unwrap().len(), 6);
    assert!(place.ok("inspect found.toml").contains("RRR"));
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
            ["cannot be reached", "ask for less than"],
        ),
        ("synthesize slider-crank --stroke-mm 100", ["--rod-mm", "--time-ratio"]),
        ("synthesize slider-crank --stroke-mm 100 --rod-mm 200 -o no.csv", ["FILE.toml, FILE.json", "found .csv"]),
        ("synthesize slider-crank --stroke-mm 100 --rod-mm 200 -o No.toml", ["cannot be the name", "lower-case"]),
        ("synthesize slider-crank --stroke-mm 100 --rod-mm 200 --rpm 0", ["--rpm", "not 0"]),
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
    let other = place.run(&format!("synthesize check {SINKER} scenarios/crank_rocker.toml"));
    assert!(other.code == 2 && other.stderr.contains("does not have the structure"), "{}", other.stderr);
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
