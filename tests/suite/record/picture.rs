//! The picture that viewers receive, against the closed form of the motion.
//! The test covers positions, arrows, names, log and curves.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use linkage::math::{KeepNan, Motion, Vec2, rotated, unit};
use linkage::trajectory::{Stage, Trajectory};
use mcap::records::Record;
use prost::Message;
use prost_types::Timestamp;
use recording::viewers::{ArrowPrimitive, FrameTransforms, LineType, Log, Pose, SceneEntity, SceneUpdate};
use recording::{Level, LogEntry, RecordedSide, Show, film, load, place, view};

use super::{OMEGA, Run, floats, motions, reactions, turn};
use crate::common::assert_within;

const SLOW: f64 = 30.0;
/// The first instant (s).
const START: f64 = 0.5;
/// Tolerance of the picture: the engine's error at the end is 1e-6, and pictures are in single precision.
const NEAR: f64 = 5e-6;

/// Two revolutions that start at a later time than zero, played slowly.
fn run() -> Run {
    let times: Vec<f64> = (0..=80).map(|k| START + TAU / OMEGA * f64::from(k) / 40.0).collect();
    let entry = |time: f64, level: Level, text: &str| LogEntry { time, level, text: text.into() };
    let log = vec![
        entry(times[7], Level::Info, "agree"),
        entry(times[20], Level::Warning, "a small angle"),
        entry(times[80], Level::Error, "disagree"),
    ];
    let show = Show { slow: SLOW, forces: true, hz: None };
    Run { log, show, ..Run::over(times) }
}

fn written(run: &Run) -> (tempfile::TempDir, std::path::PathBuf, Vec<u8>) {
    let (directory, path) = super::place("picture.mcap");
    run.write(&path).unwrap();
    let bytes = fs::read(&path).unwrap();
    (directory, path, bytes)
}

/// Log times (ns) and messages of a topic.
fn said<M: Message + Default>(bytes: &[u8], topic: &str) -> Vec<(u64, M)> {
    let all = mcap::MessageStream::new(bytes).unwrap().map(Result::unwrap);
    let own = all.filter(|message| message.channel.topic == topic);
    own.map(|message| (message.log_time, M::decode(&message.data[..]).unwrap())).collect()
}

fn metadata(bytes: &[u8]) -> BTreeMap<String, String> {
    let summary = mcap::Summary::read(bytes).unwrap().unwrap();
    mcap::read::metadata(bytes, &summary.metadata_indexes[0]).unwrap().metadata
}

fn is_stamped(stamp: Option<Timestamp>, nanoseconds: u64) -> bool {
    stamp.is_some_and(|stamp| stamp.seconds as u64 * 1_000_000_000 + stamp.nanos as u64 == nanoseconds)
}

fn placed(pose: Option<&Pose>) -> (Vec2, f64) {
    let pose = pose.unwrap();
    let (at, turn) = (pose.position.unwrap(), pose.orientation.unwrap());
    (Vec2::new(at.x, at.y), 2.0 * turn.z.atan2(turn.w))
}

/// Motions at a log time.
fn at(nanoseconds: u64) -> [Motion; 3] {
    motions(START + nanoseconds as f64 * 1e-9 / SLOW)
}

/// Log times of all instants.
fn log_times(run: &Run) -> Vec<u64> {
    run.reference.times().iter().map(|time| ((time - START) * SLOW * 1e9).round() as u64).collect()
}

#[test]
fn every_frame_is_the_motion_at_its_log_time() {
    let run = run();
    let (_directory, _, bytes) = written(&run);
    let frames: Vec<(u64, FrameTransforms)> = said(&bytes, "/tf");
    assert_eq!(frames.iter().map(|(time, _)| *time).collect::<Vec<_>>(), log_times(&run));
    for (time, frames) in &frames {
        let names: Vec<&str> = frames.transforms.iter().map(|own| own.child_frame_id.as_str()).collect();
        let links = ["crank", "coupler", "rocker"];
        let wanted: Vec<String> =
            ["reference", "engine"].iter().flat_map(|side| links.map(|link| format!("{side}/{link}"))).collect();
        assert_eq!(names, wanted);
        let motions = at(*time);
        for (own, motion) in frames.transforms.iter().zip(motions.iter().cycle()) {
            let (place, turn) = (own.translation.unwrap(), own.rotation.unwrap());
            let off = (Vec2::new(place.x, place.y) - motion.origin).norm();
            let turned = (unit(2.0 * turn.z.atan2(turn.w)) - motion.direction).norm();
            assert_within!(off.larger(turned), NEAR, "{} at {time}", own.child_frame_id);
            assert!(own.parent_frame_id == "world" && is_stamped(own.timestamp, *time) && place.z == 0.0);
        }
    }
}

#[test]
fn every_arrow_is_the_reaction_at_its_joint() {
    let run = run();
    let (_directory, _, bytes) = written(&run);
    let all: Vec<(u64, SceneUpdate)> = said(&bytes, "/mechanism/forces");
    assert_eq!(all.iter().map(|(time, _)| *time).collect::<Vec<_>>(), log_times(&run));
    let size = run.mechanism.size();
    let forces = |time: u64| reactions(&run.mechanism, &at(time)).0;
    let largest = log_times(&run).into_iter().flat_map(forces).map(|force| force.norm()).fold(0.0, f64::larger);
    // The longest arrow has a length of 0.4 of the mechanism's size.
    let scale = 0.4 * size / largest;
    let told: f64 = metadata(&bytes)["force_scale_m_per_N"].parse().unwrap();
    assert_within!((told / scale - 1.0).abs(), NEAR, "{told} {scale}");
    let mut short = 0;
    for (time, update) in &all {
        let (motions, forces) = (at(*time), forces(*time));
        let places = [(0, 0.0), (0, 0.1), (1, 0.4)].map(|(link, x)| motions[link].point(Vec2::new(x, 0.0)));
        let places = [places[0], places[1], places[2], Vec2::new(0.4, 0.0)];
        assert_eq!(update.entities.len(), 8);
        for (number, entity) in update.entities.iter().enumerate() {
            let joint = number % 4;
            let side = ["reference", "engine"][number / 4];
            assert_eq!(entity.id, format!("{side}/{}", ["O", "A", "B", "C"][joint]));
            assert!(is_stamped(entity.timestamp, *time) && entity.frame_id == "world");
            let [arrow] = &entity.arrows[..] else { panic!("{}", entity.arrows.len()) };
            let ArrowPrimitive { shaft_length, head_length, shaft_diameter, head_diameter, .. } = *arrow;
            let (foot, angle) = placed(arrow.pose.as_ref());
            assert_within!((foot - places[joint]).norm(), NEAR, "{}", entity.id);
            let length = (scale * forces[joint].norm()).larger(0.01 * size);
            short += usize::from(length == 0.01 * size);
            let wanted = forces[joint].normalize() * length;
            assert_within!((unit(angle) * (shaft_length + head_length) - wanted).norm(), NEAR, "{}", entity.id);
            assert_within!((head_length - (0.3 * length).smaller(0.06 * size)).abs(), NEAR, "{}", entity.id);
            assert!(0.0 < shaft_diameter && shaft_diameter < head_diameter);
        }
    }
    assert!(short < all.len(), "the length of most arrows is proportional to the force");
}

#[test]
fn log_messages_have_their_time_and_level() {
    let run = run();
    let (_directory, path, bytes) = written(&run);
    let told: Vec<(u64, Log)> = said(&bytes, "/log");
    // Log levels of the viewers: 2 for information, 3 for warnings, 4 for errors.
    let wanted = [(7, 2, "agree"), (20, 3, "a small angle"), (80, 4, "disagree")];
    assert_eq!(told.len(), wanted.len());
    for ((time, own), (row, level, text)) in told.iter().zip(wanted) {
        assert_eq!((*time, own.level, own.message.as_str()), (log_times(&run)[row], level, text));
        assert!(own.name == "four_bar" && is_stamped(own.timestamp, *time));
    }
    let told = metadata(&bytes);
    assert_eq!((told["log_time_zero_s"].as_str(), told["slow"].as_str()), ("0.5", "30"));
    assert_eq!(told["scenario"], "four_bar");
    assert_eq!(load(&path).unwrap()[0].1.times(), run.reference.times());
}

/// Foreign programs identify the samples of a recording by sequence numbers, and the values by field numbers.
#[test]
fn samples_are_numbered_from_zero_and_fields_from_one() {
    let (_directory, _, bytes) = written(&run());
    let mut sequences: BTreeMap<String, Vec<u32>> = BTreeMap::new();
    for message in mcap::MessageStream::new(&bytes).unwrap().map(Result::unwrap) {
        let topic = message.channel.topic.clone();
        if topic.starts_with("/reference/") || topic.starts_with("/engine/") {
            // Key of a Protobuf field: its number times eight plus its wire type, which is 1 for doubles.
            assert_eq!(message.data[0], 8 + 1, "{topic}");
            sequences.entry(topic).or_default().push(message.sequence);
        }
    }
    assert!(sequences.len() > 10);
    assert!(sequences.values().all(|own| own.iter().copied().eq(0..81)), "{:?}", sequences.keys());
}

/// A grid may list its instants in any order.
/// Samples are written and numbered in the order of time, and are loaded again in the grid's order.
#[test]
fn unordered_rows_are_numbered_by_their_times() {
    let times: Vec<f64> = (0..40).map(|k| START + TAU / OMEGA * f64::from((7 * k + 3) % 40) / 40.0).collect();
    let run = Run { show: Show { slow: SLOW, ..Show::default() }, ..Run::over(times.clone()) };
    let (_directory, path, bytes) = written(&run);
    let mut stamps: BTreeMap<String, Vec<(u32, u64)>> = BTreeMap::new();
    for message in mcap::MessageStream::new(&bytes).unwrap().map(Result::unwrap) {
        let topic = message.channel.topic.clone();
        if topic.starts_with("/reference/") || topic.starts_with("/error/") {
            stamps.entry(topic).or_default().push((message.sequence, message.log_time));
        }
    }
    let log_time = |k: u32| (TAU / OMEGA * f64::from(k) / 40.0 * SLOW * 1e9).round() as u64;
    for (topic, own) in &stamps {
        assert_eq!(own.len(), 40, "{topic}");
        let is_in_order = |(k, (sequence, time)): (u32, &(u32, u64))| *sequence == k && time.abs_diff(log_time(k)) <= 1;
        assert!((0..).zip(own).all(is_in_order), "{topic}: {own:?}");
    }
    assert!(stamps.len() > 10);
    assert_eq!(load(&path).unwrap()[0].1.times(), times);
}

#[test]
fn a_film_has_motion_forces_and_curves_of_its_recording() {
    let run = run();
    let (_directory, path, bytes) = written(&run);
    let film = film(&path).unwrap();
    let near = |a: f64, b: f64| (a - b).abs() <= NEAR * (1.0 + b.abs());
    assert!(film.times.len() == 81 && film.times.iter().zip(run.reference.times()).all(|(a, b)| near(*a, *b)));
    assert_eq!(film.poses.len(), 6);
    for (name, rows) in &film.poses {
        let link = ["crank", "coupler", "rocker"].iter().position(|link| name.ends_with(link)).unwrap();
        assert_eq!(rows.len(), 81);
        for (&[x, y, angle], &time) in rows.iter().zip(run.reference.times()) {
            let motion = &motions(time)[link];
            let off = (Vec2::new(x, y) - motion.origin).norm().larger((unit(angle) - motion.direction).norm());
            assert_within!(off, NEAR, "{name} {time}");
        }
    }
    // Tips of the arrows.
    let arrows: Vec<(u64, SceneUpdate)> = said(&bytes, "/mechanism/forces");
    for (row, (_, update)) in arrows.iter().enumerate() {
        for entity in &update.entities {
            let arrow = &entity.arrows[0];
            let (foot, angle) = placed(arrow.pose.as_ref());
            let tip = unit(angle) * (arrow.shaft_length + arrow.head_length);
            let own = film.arrows[&entity.id][row];
            let wanted = [run.reference.times()[row], foot.x, foot.y, tip.x, tip.y];
            assert!(own.iter().zip(wanted).all(|(a, b)| near(*a, b)), "{}: {own:?} {wanted:?}", entity.id);
        }
    }
    // The curves of the sides have exact values. The curves of the errors have values in single precision and in small
    // units.
    assert!(film.view.plots.len() >= 2);
    for (plot, values) in film.view.plots.iter().zip(&film.values) {
        assert_eq!(plot.lines.len(), values.len());
        for (line, values) in plot.lines.iter().zip(values) {
            assert_eq!(values.len(), 81, "{}", line.label);
            let (side, wanted): (_, Box<dyn Fn(f64) -> f64>) = match line.side {
                Some(side) => ([&run.reference, &run.engine][side], Box::new(|value| value)),
                None => (&run.errors, Box::new(|value: f64| f64::from((value * 1e3) as f32))),
            };
            let of = |topic: &str| topic.split('/').skip(2).collect::<Vec<_>>().join(".");
            let field = line.field.replace("mN", "N");
            let column = side.named(&format!("{}.{field}", of(&line.topic))).unwrap();
            for ((&[time, value], &at), &own) in values.iter().zip(run.reference.times()).zip(column) {
                assert!(near(time, at) && value.to_bits() == wanted(own).to_bits(), "{}: {value} {own}", line.label);
            }
        }
    }
}

/// The drive's torque is plotted first.
/// The next plot shows the component of a reaction that has the largest range of all such components.
/// One revolution lasts half of the recording.
#[test]
fn a_view_starts_with_the_main_plots_and_shows_everything() {
    let run = run();
    let sides = [
        RecordedSide { name: "reference", trajectory: &run.reference },
        RecordedSide { name: "engine", trajectory: &run.engine },
    ];
    let (_directory, path, bytes) = written(&run);
    let links = said::<SceneUpdate>(&bytes, "/mechanism/links").remove(0).1;
    // Bounds of everything drawn, link by link over all instants.
    let mut ends = [Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY)];
    let mut take = |place: Vec2| ends = [ends[0].inf(&place), ends[1].sup(&place)];
    let places = |entity: &SceneEntity| -> Vec<Vec2> {
        let lines = entity.lines.iter().flat_map(|line| &line.points).map(|at| Vec2::new(at.x, at.y));
        lines.chain(entity.cylinders.iter().map(|pin| placed(pin.pose.as_ref()).0)).collect()
    };
    places(&links.entities[0]).into_iter().for_each(&mut take);
    for &time in run.reference.times() {
        let motions = motions(time);
        for (entity, motion) in links.entities[1..].iter().zip(motions.iter().cycle()) {
            places(entity).into_iter().for_each(|local| take(motion.point(local)));
        }
    }
    let force = |name: &str| run.reference.named(name).unwrap();
    let range = |own: &[f64]| {
        own.iter().fold(f64::NEG_INFINITY, |a, &b| a.larger(b)) - own.iter().fold(f64::INFINITY, |a, &b| a.smaller(b))
    };
    let names: Vec<String> = ["O", "A", "B", "C"]
        .iter()
        .flat_map(|joint| ["fx_N", "fy_N"].map(|own| format!("joint.{joint}.{own}")))
        .collect();
    let largest = names.iter().max_by(|a, b| range(force(a)).total_cmp(&range(force(b)))).unwrap();
    for view in [view(&run.recording(&sides)).unwrap(), film(&path).unwrap().view] {
        assert_within!((view.turn - SLOW * TAU / OMEGA).abs(), 1e-6, "{}", view.turn);
        assert!(view.slow == SLOW && view.forces && view.frames.len() == 6 && view.name == "four_bar");
        for (own, wanted) in view.corners.iter().zip(ends) {
            assert_within!((own - wanted).amax(), NEAR, "{:?} {ends:?}", view.corners);
        }
        let titles: Vec<&str> = view.plots.iter().map(|plot| plot.title.as_str()).collect();
        assert_eq!([titles[0], titles[2]], ["drive.torque_N_m", largest.as_str()], "{titles:?}");
        assert!(titles[1].starts_with("error of drive.torque_mN_m") && titles[3].starts_with("error of joint."));
    }
}

/// The side drawn later is thinner than the side drawn first, so that both sides are visible. Pins are rings.
/// The robot description has the same parts as the picture.
#[test]
fn both_sides_are_visible_and_the_robot_has_the_same_parts() {
    let (_directory, path, bytes) = written(&run());
    let links = said::<SceneUpdate>(&bytes, "/mechanism/links").remove(0).1;
    let ids: Vec<&str> = links.entities.iter().map(|entity| entity.id.as_str()).collect();
    assert_eq!((ids.len(), ids[0], ids[1], ids[6]), (7, "ground", "reference/crank", "engine/rocker"));
    for (first, second) in links.entities[1..4].iter().zip(&links.entities[4..]) {
        let [one, other] = [first, second].map(|own| own.lines.iter().map(|line| line.thickness).collect::<Vec<_>>());
        assert!(
            !one.is_empty() && one.iter().zip(&other).all(|(a, b)| (b / a - 0.4).abs() < 1e-6),
            "{one:?} {other:?}"
        );
        assert_ne!(first.lines[0].color, second.lines[0].color);
        for entity in [first, second] {
            assert!(entity.cylinders.len().is_multiple_of(2));
            for pair in entity.cylinders.chunks(2) {
                let [disc, hole] = [&pair[0], &pair[1]].map(|own| own.size.unwrap().x);
                assert_within!((hole / disc - 0.5).abs(), 1e-6);
                assert_eq!(placed(pair[0].pose.as_ref()).0, placed(pair[1].pose.as_ref()).0);
            }
        }
    }
    // Discs of a film have the radius of the cylinders, and closed lines end at their first point.
    let film = film(&path).unwrap();
    for (part, entity) in film.parts.iter().zip(&links.entities) {
        assert_eq!(part.frame, entity.frame_id);
        for ((_, radius, rgba), own) in part.discs.iter().zip(&entity.cylinders) {
            assert_within!((2.0 * radius - own.size.unwrap().x).abs(), 1e-12);
            assert_eq!(f64::from(rgba[0]), (own.color.unwrap().r * 255.0).round());
        }
        for ((points, thickness, _), own) in part.lines.iter().zip(&entity.lines) {
            let closed = own.r#type == LineType::LineLoop as i32;
            assert_eq!(points.len(), own.points.len() + usize::from(closed));
            assert!(*thickness == own.thickness && (!closed || points.first() == points.last()));
        }
    }

    let mut all = mcap::MessageStream::new(&bytes).unwrap().map(Result::unwrap);
    let message = all.find(|message| message.channel.topic == "/robot_description").unwrap();
    let (head, text) = message.data.split_at(8);
    // CDR encoding: the length in bytes includes the closing zero.
    assert_eq!(u32::from_le_bytes([head[4], head[5], head[6], head[7]]) as usize, text.len());
    let (zero, text) = text.split_last().unwrap();
    let robot = roxmltree::Document::parse(std::str::from_utf8(text).unwrap()).unwrap();
    assert_eq!(*zero, 0);
    let numbers = |text: &str| text.split(' ').map(|own| own.parse().unwrap()).collect::<Vec<f64>>();
    for entity in &links.entities {
        let own =
            robot.descendants().find(|own| own.has_tag_name("link") && own.attribute("name") == Some(&entity.frame_id));
        let visuals = own.unwrap().children().filter(|own| own.has_tag_name("visual"));
        let mut parts = visuals.map(|visual| {
            let origin = visual.children().find(|own| own.has_tag_name("origin")).unwrap();
            let shape =
                visual.descendants().find(|own| own.has_tag_name("box") || own.has_tag_name("cylinder")).unwrap();
            (numbers(origin.attribute("xyz").unwrap()), numbers(origin.attribute("rpy").unwrap()), shape)
        });
        for line in &entity.lines {
            let count = line.points.len();
            let last = if line.r#type == LineType::LineLoop as i32 { count } else { count - 1 };
            for k in 0..last {
                let [a, b] = [k, (k + 1) % count].map(|k| Vec2::new(line.points[k].x, line.points[k].y));
                let (at, turn, shape) = parts.next().unwrap();
                let size = numbers(shape.attribute("size").unwrap());
                // The segment is drawn as a box along it; at each end the box is longer than the segment by half of its
                // thickness.
                let ends = [-0.5, 0.5].map(|share| {
                    Vec2::new(at[0], at[1]) + rotated(unit(turn[2]), Vec2::new((size[0] - line.thickness) * share, 0.0))
                });
                assert_within!((ends[0] - a).norm().larger((ends[1] - b).norm()), 1e-9, "{}", entity.id);
                assert_within!((size[1] - line.thickness).abs(), 1e-12);
            }
        }
        for pin in &entity.cylinders {
            let (at, _, shape) = parts.next().unwrap();
            let radius: f64 = shape.attribute("radius").unwrap().parse().unwrap();
            assert_within!((2.0 * radius - pin.size.unwrap().x).abs(), 1e-12);
            assert_within!((Vec2::new(at[0], at[1]) - placed(pin.pose.as_ref()).0).norm(), 1e-12);
        }
        assert!(parts.next().is_none());
    }
}

/// If there are enough instants, a recording has about 400 frames.
/// A recording of more than eight seconds of log time has more frames, about 50 per second.
/// The recording always has a frame of the last instant.
#[test]
fn slow_motion_has_more_frames_and_ends_with_the_last_instant() {
    let times = turn(1_600);
    let positions = super::channels(&super::four_bar(), |channel| channel.kind.stage == Stage::Positions);
    let own = super::trajectory(times.clone(), positions, |value, _| value);
    for (log_time, stride) in [(1.0, 4), (20.0, 2)] {
        let slow = log_time / times[times.len() - 1];
        let base = Run { show: Show { slow, ..Show::default() }, log: Vec::new(), ..Run::over(turn(3)) };
        let run = Run { reference: own.clone(), engine: own.clone(), errors: own.clone(), ..base };
        let (_directory, _, bytes) = written(&run);
        let frames: Vec<(u64, FrameTransforms)> = said(&bytes, "/tf");
        let kept = (0..1_600).step_by(stride).chain([1_599]);
        let wanted: Vec<u64> = kept.map(|row| (times[row] * slow * 1e9).round() as u64).collect();
        assert_eq!(frames.iter().map(|(time, _)| *time).collect::<Vec<_>>(), wanted, "{log_time}");
    }
}

/// A killed run loses at most a second of log time, because every second has a separate chunk.
#[test]
fn every_second_has_its_own_chunk() {
    let mut run = Run::over(turn(600));
    run.show.slow = 6.0 / run.reference.times()[599];
    let (_directory, _, bytes) = written(&run);
    let records = mcap::read::LinearReader::new(&bytes).unwrap().map(Result::unwrap);
    let ends = records.filter_map(|record| match record {
        Record::Chunk { header, .. } => Some((header.message_start_time, header.message_end_time)),
        _ => None,
    });
    for (start, end) in ends {
        assert!(end - start <= 1_100_000_000, "{start} to {end}");
    }
}

/// If the recording has fewer samples than the grid has instants, the errors have as many samples as the sides.
#[test]
fn errors_are_thinned_like_their_sides() {
    let mut run = Run::over(turn(101));
    run.show.hz = Some(10.0 / run.reference.times()[100]);
    let (_directory, path, bytes) = written(&run);
    let all = mcap::MessageStream::new(&bytes).unwrap().map(Result::unwrap);
    let errors: Vec<Vec<f32>> =
        all.filter(|message| message.channel.topic == "/error/point/B").map(|message| floats(&message.data)).collect();
    let sides = load(&path).unwrap();
    assert_eq!((errors.len(), sides[0].1.times().len(), sides[1].1.times().len()), (11, 11, 11));
    let x = |own: &Trajectory| own.named("point.B.x_m").unwrap().to_vec();
    for ((row, engine), reference) in errors.iter().zip(x(&sides[1].1)).zip(x(&sides[0].1)) {
        assert_eq!(row[0], ((engine - reference) * 1e6) as f32);
    }
}

/// Every column has a number at every sample of its grid, or the recording is refused.
#[test]
fn a_recording_with_an_incomplete_column_is_refused() {
    let run = Run::over(turn(9));
    let (directory, path, bytes) = written(&run);
    for (topic, words) in
        [("/engine/point/B", "lacks samples of point.B.x_m"), ("/engine/grid", "lacks samples of its grid")]
    {
        // The second file is the first file with one message removed.
        let other = directory.path().join("other.mcap");
        let mut writer = mcap::Writer::new(fs::File::create(&other).unwrap()).unwrap();
        let mut left = 5;
        for message in mcap::MessageStream::new(&bytes).unwrap().map(Result::unwrap) {
            left -= i32::from(message.channel.topic == topic);
            if left != 0 || message.channel.topic != topic {
                writer.write(&message).unwrap();
            }
        }
        writer.finish().unwrap();
        let error = load(&other).unwrap_err().to_string();
        let words = if topic.ends_with("grid") { "the side \"engine\" lacks samples of" } else { words };
        assert!(error.contains(words) && error.contains("engine"), "{topic}: {error}");
    }
    assert_eq!(load(&path).unwrap().len(), 2);
}

/// The verdict in the older file may differ, but all other metadata must be equal.
#[test]
fn a_recording_replaces_one_that_differs_only_in_its_verdict() {
    let mut run = Run::over(turn(3));
    run.metadata = [("engine", "rapier"), ("engine_verdict", "agree")].map(|(k, v)| (k.into(), v.into())).into();
    let (_directory, path, _) = written(&run);
    let directory = path.parent().unwrap();
    let asked = |key: &str, value: &str, text: &str| {
        let mut metadata = run.metadata.clone();
        metadata.insert(key.into(), value.into());
        place(directory, "picture", text, &metadata).unwrap()
    };
    let (text, second) = ("name = \"four_bar\"\n", directory.join("picture-2.mcap"));
    assert_eq!(asked("engine_verdict", "disagree", text).path, path);
    for (key, value, text, why) in [
        ("engine", "impulse", text, "its engine is \"rapier\", not \"impulse\""),
        ("record_hz", "10", text, "its record_hz is none, not \"10\""),
        ("engine", "rapier", "name = \"other\"\n", "its scenario text differs"),
    ] {
        let found = asked(key, value, text);
        assert_eq!((found.path.as_path(), found.other.as_deref()), (Path::new(&second), Some(why)));
    }
}
