//! A recording replaces an older recording of the same run, and no recording of a different run.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use prost::Message;
use prost_types::field_descriptor_proto::Type;

use super::tools::Place;

const RUN: &str = "run scenarios/pendulum.toml --route differences --record out";

fn recordings(place: &Place) -> Vec<String> {
    let entries = fs::read_dir(place.path("out")).unwrap();
    let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    // Layout files accompany recordings, and are not counted as recordings.
    let layouts: Vec<String> = names.extract_if(.., |name| name.ends_with(".foxglove.json")).collect();
    names.sort();
    for layout in layouts {
        assert!(names.contains(&layout.replace(".foxglove.json", ".mcap")), "{layout} is of no recording");
    }
    names
}

/// A viewer takes a log time as the time of the event.
/// Log times are therefore the times of the instants, counted from the first instant and multiplied by the requested
/// factor.
#[test]
fn log_times_follow_the_times_of_the_instants() {
    let place = Place::new();
    for (slow, options) in [(1, ""), (10, " --slow 10")] {
        place.ok(&format!("run scenarios/crank_rocker.toml --times 0.1,0.15,0.3 --record out{slow}{options}"));
        let bytes = fs::read(place.path(&format!("out{slow}/crank_rocker.mcap"))).unwrap();
        let mut topics: BTreeMap<String, Vec<u64>> = BTreeMap::new();
        for message in mcap::MessageStream::new(&bytes).unwrap() {
            let message = message.unwrap();
            assert_eq!(message.log_time, message.publish_time);
            topics.entry(message.channel.topic.clone()).or_default().push(message.log_time);
        }
        // The instants are 0, 50 and 200 ms after the first instant; the recording also has frames of the picture
        // between these instants.
        let instants = [0, 50_000_000, 200_000_000].map(|time| slow * time);
        let of_instants = topics.values().filter(|times| times.as_slice() == instants).count();
        assert!(of_instants >= 5, "{topics:?}");
        for (topic, times) in &topics {
            assert!(times.is_sorted() && times.iter().all(|time| *time <= instants[2]), "{topic}: {times:?}");
        }
    }
}

#[test]
fn other_settings_get_a_separate_file_name() {
    let place = Place::new();
    place.ok(RUN);
    let first = fs::read(place.path("out/pendulum.mcap")).unwrap();
    // A repetition of the same run replaces the recording, byte for byte.
    let told = place.ok(RUN);
    let size = (first.len() as f64 / 1e3).round();
    let line = format!("recording  out/pendulum.mcap ({size} kB)\nlayout     out/pendulum.foxglove.json\n");
    assert!(told.contains(&line), "{told}");
    assert_eq!(
        (recordings(&place), fs::read(place.path("out/pendulum.mcap")).unwrap()),
        (vec!["pendulum.mcap".into()], first.clone())
    );

    for (arguments, name, why) in [
        ("--reference newton", "pendulum-2.mcap", "its reference is \"assur\", not \"newton\""),
        ("--times 0,0.1,0.2", "pendulum-3.mcap", "its grid_times_s is none, not \"0,0.1,0.2\""),
        ("--only positions", "pendulum-4.mcap", "its only is none, not \"positions\""),
        ("--reference newton", "pendulum-2.mcap", "its reference"),
        // A recording with fewer samples never replaces a complete recording.
        // A recording that differs only in the playback speed (`--slow`) may replace a complete recording.
        ("--record-hz 10", "pendulum-5.mcap", "its record_hz is none, not \"10\""),
    ] {
        let told = place.ok(&format!("{RUN} {arguments}"));
        let line = format!("\n           pendulum.mcap belongs to another run and is kept: {why}");
        assert!(told.contains(&format!("recording  out/{name} (")) && told.contains(&line), "{arguments}: {told}");
    }
    // A changed scenario with an unchanged name also gets a new recording file.
    place.edited("pendulum.toml", "pendulum.toml", &[("title = \"", "title = \"Another, ")]);
    let told = place.ok(RUN);
    assert!(told.contains("out/pendulum-6.mcap") && told.contains("its scenario text differs"), "{told}");
    let expected = [2, 3, 4, 5, 6].map(|number| format!("pendulum-{number}.mcap")).into_iter();
    let expected: Vec<String> = expected.chain(["pendulum.mcap".into()]).collect();
    assert_eq!(recordings(&place), expected);
    assert_eq!(fs::read(place.path("out/pendulum.mcap")).unwrap(), first);
}

#[test]
fn files_that_are_no_recordings_are_left_alone() {
    let place = Place::new();
    fs::create_dir(place.path("out")).unwrap();
    fs::write(place.path("out/pendulum.mcap"), "notes of mine").unwrap();
    let told = place.ok(RUN);
    assert!(told.contains("out/pendulum-2.mcap") && told.contains("it is not a recording of a run"), "{told}");
    assert_eq!(fs::read_to_string(place.path("out/pendulum.mcap")).unwrap(), "notes of mine");
}

/// One command runs two scenarios that have the same name.
#[test]
fn scenarios_of_one_name_are_both_recorded() {
    let place = Place::new();
    place.edited("pendulum.toml", "other.toml", &[("title = \"", "title = \"Another, ")]);
    place.ok("run scenarios/pendulum.toml scenarios/other.toml --route differences --record out");
    assert_eq!(recordings(&place), ["pendulum-2.mcap", "pendulum.mcap"]);
}

/// A recording that is slowed down, thinned or has arrows keeps the values of the trajectory. Two equal runs give the
/// same bytes.
#[test]
fn a_time_scale_changes_no_number() {
    let place = Place::new();
    let run = |options: &str, to: &str| {
        place.ok(&format!("run scenarios/crank_rocker.toml {options} --record {to}"));
        let path = place.path(to).join("crank_rocker.mcap");
        (fs::read(&path).unwrap(), recording::load(&path).unwrap())
    };
    let (plain, whole) = run("", "plain");
    let (slow, same) = run("--slow 20", "slow");
    assert!(slow == run("--slow 20", "again").0 && slow != plain);
    let bits = |sides: &[(String, linkage::trajectory::Trajectory)]| -> Vec<Vec<u64>> {
        let columns = sides.iter().flat_map(|(_, own)| own.iter().map(|(_, column)| column).chain([own.times()]));
        columns.map(|column| column.iter().map(|value| value.to_bits()).collect()).collect()
    };
    assert!(bits(&same) == bits(&whole));
    let last = |bytes: &[u8]| {
        let times = mcap::MessageStream::new(bytes).unwrap().map(|message| message.unwrap().log_time);
        times.max().unwrap() as f64 * 1e-9
    };
    assert!((last(&slow) / last(&plain) - 20.0).abs() < 1e-6, "{} {}", last(&slow), last(&plain));

    let (thin, few) = run("--record-hz 100", "thin");
    assert!(thin.len() < plain.len() / 4, "{} {}", thin.len(), plain.len());
    for ((_, few), (_, whole)) in few.iter().zip(&whole) {
        // One revolution takes 0.46 s; at 100 Hz this gives 48 samples, including the first and the last instant.
        assert_eq!(few.times().len(), 48);
        let row = |time: &f64| whole.times().iter().position(|own| own == time).unwrap();
        for ((channel, few_values), (_, values)) in few.iter().zip(whole.iter()) {
            let same = |(value, time): (&f64, &f64)| *value == values[row(time)];
            assert!(few_values.iter().zip(few.times()).all(same), "{channel}");
        }
    }
    place.ok("compare scenarios/crank_rocker.toml slow/crank_rocker.mcap --side reference");
    place.ok("compare scenarios/crank_rocker.toml thin/crank_rocker.mcap --side reference");
    let topics = |bytes: &[u8]| {
        let all = mcap::MessageStream::new(bytes).unwrap();
        all.filter(|message| message.as_ref().unwrap().channel.topic == "/mechanism/forces").count()
    };
    assert!(topics(&plain) == 0 && topics(&run("--record-forces", "arrows").0) > 300);
    for wrong in ["--slow 0", "--slow nan", "--record-hz -1"] {
        let told = place.run(&format!("run scenarios/crank_rocker.toml {wrong} --record no"));
        assert!(told.code == 2 && told.stderr.contains("greater than 0"), "{wrong}: {}", told.stderr);
    }
    place.refused("run scenarios/crank_rocker.toml --slow 1e300 --record no", &["cannot last", "time scale"]);
}

/// The layout shows the whole mechanism from above, and plots the channels of the recording.
#[test]
fn layouts_show_the_recorded_data() {
    let place = Place::new();
    place.ok("run scenarios/crank_rocker.toml --record out --record-forces");
    let text = fs::read_to_string(place.path("out/crank_rocker.foxglove.json")).unwrap();
    let layout: serde_json::Value = serde_json::from_str(&text).unwrap();
    let bytes = fs::read(place.path("out/crank_rocker.mcap")).unwrap();
    let topics: BTreeSet<String> =
        mcap::MessageStream::new(&bytes).unwrap().map(|message| message.unwrap().channel.topic.clone()).collect();
    let panels = layout["configById"].as_object().unwrap();
    let scene = &panels["3D!mechanism"];
    // Foxglove and Lichtblick read the title under different keys, so the layout contains both keys.
    for (name, panel) in panels {
        let title = panel["foxglovePanelTitle"].as_str().unwrap();
        assert_eq!(panel["lichtblickPanelTitle"].as_str(), Some(title), "{name}");
    }
    assert!(scene["topics"].as_object().unwrap().keys().all(|topic| topics.contains(topic)), "{scene}");
    assert_eq!(
        (scene["cameraState"]["phi"].as_f64(), scene["cameraState"]["perspective"].as_bool()),
        (Some(0.0), Some(false))
    );
    let mut sides = BTreeSet::new();
    for line in panels.values().filter_map(|panel| panel["paths"].as_array()).flatten() {
        let topic = line["value"].as_str().unwrap().split('.').next().unwrap();
        assert!(topics.contains(topic), "{topic}");
        assert!(line["label"].as_str().unwrap().len() > 5);
        sides.insert(topic.split('/').nth(1).unwrap().to_string());
    }
    assert_eq!(sides.into_iter().collect::<Vec<_>>(), ["engine", "error", "reference"].map(String::from));
}

/// For every topic: the declared fields of its messages, and whether every message contains the field.
fn declared(bytes: &[u8]) -> BTreeMap<String, BTreeMap<String, bool>> {
    let mut found: BTreeMap<String, BTreeMap<String, bool>> = BTreeMap::new();
    for message in mcap::MessageStream::new(bytes).unwrap().map(Result::unwrap) {
        let schema = message.channel.schema.as_ref().unwrap();
        if !schema.name.starts_with("linkproof.") {
            continue;
        }
        let set = prost_types::FileDescriptorSet::decode(&*schema.data).unwrap();
        let own = found.entry(message.channel.topic.clone()).or_default();
        for field in &set.file[0].message_type[0].field {
            // All field numbers are below 16, so a key of one byte precedes each value.
            let (number, size) = (field.number() as u8, if field.r#type() == Type::Float { 4 } else { 8 });
            let there = message.data.chunks(size + 1).any(|chunk| chunk[0] >> 3 == number);
            *own.entry(field.name().into()).or_insert(true) &= there;
        }
    }
    found
}

/// The layout for PlotJuggler refers to its recording, and only to recorded curves, even if few channels are recorded.
#[test]
fn plotjuggler_layouts_name_recorded_curves() {
    let place = Place::new();
    for (options, name) in [("", "whole"), ("--only point.D.positions --only joint.B.fx_N", "some")] {
        place.ok(&format!("run scenarios/crank_rocker.toml {options} --record {name}"));
        let recording = format!("{name}/crank_rocker.mcap");
        let fields = declared(&fs::read(place.path(&recording)).unwrap());
        // PlotJuggler shows a declared but absent field as zero, so every message must contain all declared fields.
        assert!(fields.values().all(|own| !own.is_empty() && own.values().all(|&there| there)), "{name}: {fields:?}");

        let told = place.ok(&format!("view {recording} --with plotjuggler"));
        assert!(told.contains(&format!("{name}/crank_rocker.plotjuggler.xml")), "{told}");
        let text = fs::read_to_string(place.path(name).join("crank_rocker.plotjuggler.xml")).unwrap();
        let layout = roxmltree::Document::parse(&text).unwrap();
        let of = |tag: &'static str| layout.descendants().filter(move |node| node.has_tag_name(tag));
        assert_eq!(of("fileInfo").next().unwrap().attribute("filename"), Some("crank_rocker.mcap"));
        let topics = of("parameters").next().unwrap().attribute("selected_topics").unwrap();
        assert_eq!(topics.split(';').collect::<Vec<_>>(), fields.keys().collect::<Vec<_>>());
        let mut sides = BTreeSet::new();
        for curve in of("curve") {
            let (topic, field) = curve.attribute("name").unwrap().rsplit_once('/').unwrap();
            assert!(fields[topic].contains_key(field), "{topic} {field}");
            sides.insert(topic.split('/').nth(1).unwrap().to_string());
        }
        assert_eq!(sides.into_iter().collect::<Vec<_>>(), ["engine", "error", "reference"]);
        assert_eq!(of("DockSplitter").next().unwrap().attribute("count"), Some("4"));
    }
    // If the layout is in a directory other than that of the recording, the layout names the recording by its whole
    // path.
    place.ok("view whole/crank_rocker.mcap --with plotjuggler -o there.xml");
    let whole = place.path("whole/crank_rocker.mcap").canonicalize().unwrap();
    let text = fs::read_to_string(place.path("there.xml")).unwrap();
    let layout = roxmltree::Document::parse(&text).unwrap();
    let named = layout.descendants().find(|node| node.has_tag_name("fileInfo")).unwrap().attribute("filename").unwrap();
    assert!(named != "crank_rocker.mcap" && Path::new(named).canonicalize().unwrap() == whole, "{named}");
}
