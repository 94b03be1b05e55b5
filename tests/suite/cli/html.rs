//! `run --html`; `tests/html` tests the pages in a browser.

use std::fs;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use linkage::math::KeepNan;
use serde_json::Value;

use super::tools::{Place, Table};

/// Largest allowed page.
const MOST_BYTES: usize = 3_000_000;

/// The text between two texts, both of which must occur.
fn between<'a>(text: &'a str, start: &str, end: &str) -> &'a str {
    let from = text.find(start).unwrap_or_else(|| panic!("no {start}")) + start.len();
    &text[from..from + text[from..].find(end).unwrap_or_else(|| panic!("no {end}"))]
}

fn data(page: &str) -> Value {
    serde_json::from_str(between(page, "<script type=\"application/json\" id=\"data\">", "</script>")).unwrap()
}

fn doubles(column: &Value) -> Vec<f64> {
    let bytes = STANDARD.decode(column.as_str().unwrap()).unwrap();
    bytes.as_chunks::<8>().0.iter().map(|eight| f64::from_le_bytes(*eight)).collect()
}

fn singles(column: &Value) -> Vec<f64> {
    let bytes = STANDARD.decode(column.as_str().unwrap()).unwrap();
    bytes.as_chunks::<4>().0.iter().map(|four| f64::from(f32::from_le_bytes(*four))).collect()
}

/// Asserts that the page loads nothing except the empty icon.
/// The namespace of SVG is only a name, so it does not count as loaded.
fn assert_alone(page: &str) {
    for word in ["src=", "@import", "url(", "fetch(", "XMLHttpRequest", "import("] {
        assert!(!page.contains(word), "{word}");
    }
    assert_eq!(page.matches("href=").count(), page.matches("<link rel=\"icon\" href=\"data:,\">").count());
    assert_eq!(
        page.matches("http").count(),
        page.matches("http://www.w3.org/2000/svg").count() + 1,
        "http-equiv alone"
    );
    assert!(page.contains("content=\"default-src 'none';"));
}

#[test]
fn a_page_has_verdict_channels_errors_and_positions() {
    let place = Place::new();
    let run = "run scenarios/pendulum.toml --record out --budget 1e5";
    let told = place.ok(&format!("{run} --html page.html --json out.json"));
    assert!(told.contains("page       page.html"), "{told}");
    let page = fs::read_to_string(place.path("page.html")).unwrap();
    assert!(page.len() < MOST_BYTES, "{} bytes", page.len());
    assert!(page.starts_with("<!doctype html>") && page.trim_end().ends_with("</html>"));
    assert_alone(&page);
    assert!(between(&page, "id=\"verdict\">", "</p>").contains("AGREE"));
    assert!(!page.contains("{{"), "a placeholder is not filled");
    let data = data(&page);
    // The page has the same values as the JSON, channel by channel.
    let json: Value = serde_json::from_str(&fs::read_to_string(place.path("out.json")).unwrap()).unwrap();
    let judged = json["runs"][0]["engines"][0]["channels"].as_array().unwrap();
    let channels = data["channels"].as_array().unwrap();
    assert_eq!(channels.len(), judged.len());
    for ((channel, own), judged) in channels.iter().zip(data["engines"][0]["channels"].as_array().unwrap()).zip(judged)
    {
        assert_eq!(channel["name"], judged["channel"]);
        for (key, same) in
            [("max", "max"), ("bound", "bound"), ("verdict", "verdict"), ("scale", "scale"), ("at", "worst_t_s")]
        {
            assert_eq!(own[key], judged[same], "{key} of {}", channel["name"]);
        }
        // Errors are computed in double precision and written in single precision.
        // The largest written error therefore equals the largest error of the report to single precision.
        let largest = singles(&own["errors"]).iter().map(|error| error.abs()).fold(0.0, f64::larger);
        let max = judged["max"].as_f64().unwrap();
        assert!(judged["left_out"] != 0 || (largest - max).abs() <= 1e-6 * max, "{largest} {max}");
    }
    // The page stores positions as doubles, with exactly the bits of the solution.
    let solved = Table::of(&place.ok("solve scenarios/pendulum.toml --with assur"));
    let times = solved.column("t_s");
    let rows: Vec<usize> =
        doubles(&data["time"]).iter().map(|time| times.iter().position(|own| own == time).unwrap()).collect();
    assert_eq!(rows.len(), times.len());
    for name in ["link.rod.angle_rad", "link.rod.x_m", "point.E.y_m"] {
        let own = channels.iter().find(|own| own["name"] == name).unwrap();
        let right = solved.column(name);
        assert_eq!(doubles(&own["values"]), rows.iter().map(|&row| right[row]).collect::<Vec<_>>(), "{name}");
    }
    // Errors are engine minus reference, as in the recording.
    let sides = recording::load(&place.path("out/pendulum.mcap")).unwrap();
    let value = |side: usize, name: &str, row: usize| sides[side].1.named(name).unwrap()[row];
    for name in ["link.rod.omega_rad_s", "joint.O.fx_N", "point.E.y_m"] {
        let place = channels.iter().position(|own| own["name"] == name).unwrap();
        let errors = singles(&data["engines"][0]["channels"][place]["errors"]);
        let wanted = rows.iter().map(|&row| f64::from((value(1, name, row) - value(0, name, row)) as f32));
        assert_eq!(errors, wanted.collect::<Vec<f64>>(), "{name}");
    }
    // The page marks instants that are not judged; in this run, all instants are judged.
    assert!(judged.iter().all(|own| own["left_out"] == 0));
    assert_eq!(data["engines"][0]["unjudged"], serde_json::json!([]));
    // Equal runs give equal bytes.
    place.ok(&format!("{run} --html again.html"));
    assert!(fs::read_to_string(place.path("again.html")).unwrap() == page);
}

#[test]
fn scenario_texts_are_escaped_on_the_page() {
    let place = Place::new();
    // Names of links are single words, but titles, names of published numbers and comments may be any text.
    let bad = "</title></script><b>&'<!-- <script>alert(1)</script>";
    let [title, oracle] =
        ["title = \"", "name = \"Newton"].map(|own| (own, own.replace("= \"", &format!("= \"{bad}"))));
    place.edited("pendulum.toml", "bad.toml", &[(title.0, &title.1), (oracle.0, &oracle.1)]);
    let text = fs::read_to_string(place.path("scenarios/bad.toml")).unwrap();
    fs::write(place.path("scenarios/bad.toml"), format!("# {bad}\n{text}")).unwrap();
    place.ok("run scenarios/bad.toml --no-record --budget 1e5 --html page.html");
    let page = fs::read_to_string(place.path("page.html")).unwrap();
    assert!(page.matches("&lt;b&gt;").count() > 3, "title, check, comment and scenario");
    for markup in ["<b>", "alert(1)</script>", "<!-- "] {
        assert!(!page.contains(markup), "{markup}");
    }
    // The page has two scripts, and each script has exactly one closing tag.
    assert_eq!([page.matches("<script").count(), page.matches("</script>").count()], [2, 2]);
    assert_eq!(data(&page)["motion"]["links"][0]["name"], "rod");
    assert_alone(&page);
}

#[test]
fn a_long_run_is_thinned_with_a_note() {
    let place = Place::new();
    place
        .ok("run scenarios/pendulum.toml --no-record --budget 1e5 --times 0:3:0.0001 --html page.html --json out.json");
    let page = fs::read_to_string(place.path("page.html")).unwrap();
    assert!(page.len() < MOST_BYTES, "{} bytes", page.len());
    let data = data(&page);
    let shown = doubles(&data["time"]).len();
    assert!(shown > 1000 && data["instants"] == 30_001, "{shown} of {}", data["instants"]);
    assert_eq!(doubles(&data["time"]).last(), Some(&3.0));
    assert!(page.contains(&format!("{shown} of 30001 instants")), "{shown}");
    // The page contains the worst instant of every channel that is judged at all instants.
    let json: Value = serde_json::from_str(&fs::read_to_string(place.path("out.json")).unwrap()).unwrap();
    let judged = json["runs"][0]["engines"][0]["channels"].as_array().unwrap();
    for own in judged.iter().filter(|own| own["left_out"] == 0) {
        let worst = own["worst_t_s"].as_f64().unwrap();
        assert!(doubles(&data["time"]).contains(&worst), "{}: {worst} s", own["channel"]);
    }
}

#[test]
fn several_pages_go_to_a_directory_that_is_checked_first() {
    let place = Place::new();
    fs::copy(place.path("scenarios/pendulum.toml"), place.path("scenarios/same.toml")).unwrap();
    let files = "scenarios/pendulum.toml scenarios/same.toml";
    place.ok(&format!("run {files} --no-record --budget 1e5 --quiet --html new/pages"));
    let mut names: Vec<_> =
        fs::read_dir(place.path("new/pages")).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["pendulum-2.html", "pendulum.html"]);
    fs::write(place.path("file"), "old").unwrap();
    for (target, words) in [
        ("no/page.html", ["-o", "the directory no does not exist"]),
        ("file/page.html", ["-o", "directory"]),
        ("-", ["--html", "a page cannot go to standard output"]),
        ("scenarios/pendulum.toml", ["--html", "scenario file"]),
    ] {
        let outcome = place.refused(&format!("run scenarios/pendulum.toml --no-record --html {target}"), &words);
        assert_eq!(outcome.stdout, "", "the refusal comes before the proof");
    }
    place.refused(&format!("run {files} --no-record --html file"), &["-o", "not a directory"]);
    assert_eq!(fs::read_to_string(place.path("file")).unwrap(), "old");
}

#[test]
fn every_drive_with_a_moment_is_on_the_page_with_its_channel() {
    let place = Place::new();
    for (file, moments) in [("crank_rocker", &["O"][..]), ("five_bar", &["O1", "O2"]), ("double_pendulum", &[])] {
        place.ok(&format!("run scenarios/{file}.toml --no-record --budget 1e5 --html {file}.html"));
        let page = fs::read_to_string(place.path(&format!("{file}.html"))).unwrap();
        let data = data(&page);
        if file == "crank_rocker" {
            // The rocker's frame is at C, (150, 15) mm; in pictures y points down.
            let own = between(&page, "data-name=\"rocker\" transform=\"matrix(", ")");
            let numbers: Vec<f64> = own.split(' ').map(|part| part.parse().unwrap()).collect();
            let unit = data["motion"]["unit"].as_f64().unwrap();
            assert!((numbers[4] * unit - 0.15).abs() < 1e-9 && (numbers[5] * unit + 0.015).abs() < 1e-9, "{own}");
        }
        let drives = data["loads"]["drives"].as_array().unwrap();
        let named: Vec<&Value> =
            drives.iter().map(|own| &data["channels"][own["torque"].as_u64().unwrap() as usize]["name"]).collect();
        let expected: Vec<String> = moments
            .iter()
            .enumerate()
            .map(
                |(number, joint)| {
                    if number == 0 { "drive.torque_N_m".into() } else { format!("drive.{joint}.torque_N_m") }
                },
            )
            .collect();
        assert_eq!(named, expected.iter().collect::<Vec<_>>(), "{file}");
    }
}

/// A number, or the first number of a column.
fn first(column: &Value) -> f64 {
    column.as_f64().unwrap_or_else(|| singles(column)[0])
}

#[test]
fn a_page_has_loads_and_the_vectors_of_the_plans() {
    let place = Place::new();
    place.ok("run scenarios/rotary_engine.toml --no-record --budget 1e5 --html page.html");
    let data = data(&fs::read_to_string(place.path("page.html")).unwrap());
    let loads = &data["loads"];
    // The loads are a gas force of 300 N, springs, dampers, a moment and weights.
    // The gas force turns with the cylinder and points towards the cylinder's pivot.
    // Springs and dampers have only a magnitude.
    let force = &loads["arrows"][0];
    assert_eq!(force["name"], "force at B on piston");
    let size = first(&force["force"][0]).hypot(first(&force["force"][1]));
    assert!((size - 300.0).abs() < 1e-4 && force["moment"].is_null(), "{force}");
    let place_of = |name: &str| {
        let channels = data["channels"].as_array().unwrap();
        doubles(&channels.iter().find(|own| own["name"] == name).unwrap()["values"])[0]
    };
    let [x, y] = ["point.B.x_m", "point.B.y_m"].map(place_of);
    let along = (x * first(&force["force"][0]) + y * first(&force["force"][1])) / x.hypot(y);
    assert!((along + 300.0).abs() < 1e-3, "towards the pivot, which is the origin: {along}");
    assert!(loads["weights"].as_array().unwrap().iter().all(|own| own["force"][0] == 0.0));
    let between: Vec<&str> =
        loads["between"].as_array().unwrap().iter().map(|own| own["name"].as_str().unwrap()).collect();
    assert_eq!(between[..2], ["spring from H on cylinder to B on piston", "damper from S to B on piston"]);
    assert_eq!(loads["drives"][0]["name"], "balancing moment on cylinder");
    // The Coriolis component and the relative acceleration of the piston in its cylinder equal those of `plan`.
    let start = doubles(&data["crank"])[0].to_degrees();
    let plan: Value =
        serde_json::from_str(&place.ok(&format!("plan scenarios/rotary_engine.toml --crank-deg {start} --json -")))
            .unwrap();
    let own = &data["plans"]["plans"][1];
    let layout = match own["which"].as_array() {
        Some(which) => which[0].as_u64().unwrap() as usize,
        None => 0,
    };
    let vectors = own["layouts"][layout]["vectors"].as_array().unwrap();
    let right = plan["acceleration"]["vectors"].as_array().unwrap();
    assert_eq!(vectors.len(), right.len());
    for (vector, right) in vectors.iter().zip(right) {
        assert_eq!([&vector[0], &vector[5]], [&right["name"], &right["meaning"]]);
        let tip = |end: usize, axis: usize| first(&own["tips"][vector[end].as_u64().unwrap() as usize][axis]);
        for (axis, key) in [(0, "x"), (1, "y")] {
            let apart = tip(3, axis) - tip(2, axis) - right[key].as_f64().unwrap();
            assert!(apart.abs() < 1e-4, "{}: {apart}", right["name"]);
        }
    }
    assert!(vectors.iter().any(|own| own[1] == "coriolis") && vectors.iter().any(|own| own[1] == "sliding"));
}

#[test]
fn disagreeing_inconclusive_and_partial_runs_have_pages() {
    let place = Place::new();
    let page = |options: &str, code: i32| {
        let outcome = place.run(&format!("run scenarios/crank_rocker.toml --no-record --html page.html {options}"));
        assert_eq!(outcome.code, code, "{}", outcome.stderr);
        fs::read_to_string(place.path("page.html")).unwrap()
    };
    let wrong = page("--budget 1e5 --tolerance-scale 1e-4", 1);
    assert!(between(&wrong, "id=\"verdict\">", "</p>").contains("DISAGREE"));
    let why = between(&wrong, "<div id=\"why\">", "</div>");
    assert!(why.contains("is beyond the scaled bound") && why.contains("more for the same reason"), "{why}");
    let open = page("--dt 0.02", 3);
    assert!(between(&open, "id=\"verdict\">", "</p>").contains("INCONCLUSIVE"));
    let placeless = page("--budget 1e5 --only joint.B", 0);
    assert!(placeless.contains("nothing can be drawn") && data(&placeless)["motion"].is_null());
    let several = page("--budget 1e5 --engine rapier --engine impulse --only positions", 0);
    assert_eq!(data(&several)["engines"].as_array().unwrap().len(), 2);
    assert!(data(&several)["motion"]["joints"][0]["force"].is_null(), "no reactions were requested");
}
