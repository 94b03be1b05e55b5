//! `run --live`: what viewers receive, what they may request, and how the server ends.

use std::collections::BTreeSet;
use std::io::{BufRead, BufReader, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use mcap::MessageStream;
use serde_json::{Value, json};
use tungstenite::client::{IntoClientRequest, client};
use tungstenite::{Message, WebSocket};

use crate::cli::tools::Place;

const OLD: &str = "foxglove.websocket.v1";
const NEW: &str = "foxglove.sdk.v1";
/// One pass through the motion of 3 s takes 0.3 s.
/// The budget is small, because the proof does not matter in these tests.
const RUN: &str = "run scenarios/pendulum.toml --budget 1e5 --live=0 --slow 0.1";

/// A server in a temporary directory.
struct Served {
    place: Place,
    child: Child,
    address: String,
}

impl Served {
    fn by(place: Place, arguments: &str) -> Served {
        let mut command = Command::new(assert_cmd::cargo::cargo_bin("linkproof"));
        command.current_dir(place.path("")).args(arguments.split_whitespace());
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut note = String::new();
        BufReader::new(child.stderr.as_mut().unwrap()).read_line(&mut note).unwrap();
        let address = note.split("ws://").nth(1).unwrap_or_else(|| panic!("no address: {note}"));
        let address = address.split_whitespace().next().unwrap().to_string();
        Served { place, child, address }
    }

    /// Waits until the server has printed its hint about Ctrl-C, then interrupts it as Ctrl-C does.
    /// Returns the exit code.
    fn end(&mut self) -> i32 {
        let mut lines = BufReader::new(self.child.stdout.as_mut().unwrap()).lines();
        assert!(lines.any(|line| line.unwrap().contains("Ctrl-C")), "the server ends before Ctrl-C");
        let ended = Command::new("kill").args(["-INT", &self.child.id().to_string()]).status().unwrap();
        assert!(ended.success());
        self.child.wait().unwrap().code().expect("an exit code")
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        // A test that has called `end` has ended the server already, and `kill` then has no effect.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A message that the server sends to a viewer.
#[derive(Debug)]
enum Said {
    Text(Value),
    Message { number: u32, time: u64, data: Vec<u8> },
    Clock(u64),
    State { plays: bool, time: u64, jumped: bool, id: String },
}

struct Viewer(WebSocket<TcpStream>);

impl Viewer {
    fn at(address: &str, name: &str) -> Viewer {
        Viewer::let_in(address, name).unwrap()
    }

    /// The viewer, or the reason why it was refused.
    fn let_in(address: &str, name: &str) -> Result<Viewer, String> {
        let mut request = format!("ws://{address}").into_client_request().unwrap();
        request.headers_mut().insert("sec-websocket-protocol", name.parse().unwrap());
        let stream = TcpStream::connect(address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        client(request, stream).map(|(socket, _)| Viewer(socket)).map_err(|why| why.to_string())
    }

    fn say(&mut self, text: &Value) {
        self.0.send(Message::Text(text.to_string().into())).unwrap();
    }

    fn subscribe(&mut self, pairs: &[(u32, u64)]) {
        let pairs: Vec<Value> = pairs.iter().map(|(id, channel)| json!({ "id": id, "channelId": channel })).collect();
        self.say(&json!({ "op": "subscribe", "subscriptions": pairs }));
    }

    fn control(&mut self, plays: bool, speed: f32, seek: Option<u64>, id: &str) {
        let mut bytes = vec![3, u8::from(!plays)];
        bytes.extend(speed.to_le_bytes());
        bytes.push(u8::from(seek.is_some()));
        bytes.extend(seek.unwrap_or(0).to_le_bytes());
        bytes.extend((id.len() as u32).to_le_bytes());
        bytes.extend(id.as_bytes());
        self.0.send(Message::Binary(bytes.into())).unwrap();
    }

    fn hear(&mut self) -> Said {
        let long = |bytes: &[u8]| u64::from_le_bytes(bytes.try_into().unwrap());
        let short = |bytes: &[u8]| u32::from_le_bytes(bytes.try_into().unwrap());
        match self.0.read().unwrap() {
            Message::Text(text) => Said::Text(serde_json::from_str(&text).unwrap()),
            Message::Binary(bytes) => match bytes[0] {
                1 => {
                    Said::Message { number: short(&bytes[1..5]), time: long(&bytes[5..13]), data: bytes[13..].to_vec() }
                }
                2 => Said::Clock(long(&bytes[1..])),
                5 => Said::State {
                    plays: bytes[1] == 0,
                    time: long(&bytes[2..10]),
                    jumped: bytes[14] == 1,
                    id: String::from_utf8(bytes[19..].to_vec()).unwrap(),
                },
                other => panic!("a message of kind {other}"),
            },
            other => panic!("{other:?}"),
        }
    }

    /// Topics and numbers of the channels, once both the reference and the engine are advertised.
    fn channels(&mut self) -> Vec<(String, u64)> {
        loop {
            if let Said::Text(text) = self.hear()
                && text["op"] == "advertise"
            {
                let channels = text["channels"].as_array().unwrap().iter();
                let channels: Vec<(String, u64)> = channels
                    .map(|own| (own["topic"].as_str().unwrap().to_string(), own["id"].as_u64().unwrap()))
                    .collect();
                if channels.iter().any(|(topic, _)| topic.starts_with("/engine/")) {
                    return channels;
                }
            }
        }
    }
}

/// Identifier of the WebSocket channel of a topic.
fn channel(channels: &[(String, u64)], topic: &str) -> u64 {
    channels.iter().find(|(own, _)| own == topic).unwrap_or_else(|| panic!("no {topic}")).1
}

/// Topics, log times and messages of a recording, in their order.
fn recorded(place: &Place) -> Vec<(String, u64, Vec<u8>)> {
    let bytes = std::fs::read(place.path("recordings/pendulum.mcap")).unwrap();
    let messages = MessageStream::new(&bytes).unwrap().map(|own| own.unwrap());
    messages.map(|own| (own.channel.topic.clone(), own.log_time, own.data.to_vec())).collect()
}

#[test]
fn every_live_turn_repeats_the_recording() {
    let mut served = Served::by(Place::new(), &format!("{RUN} --record-hz 50 --record-forces"));
    for name in [OLD, NEW] {
        let mut viewer = Viewer::at(&served.address, name);
        let channels = viewer.channels();
        let pairs: Vec<(u32, u64)> = (0..).zip(channels.iter().map(|(_, id)| *id)).collect();
        viewer.subscribe(&pairs);
        let (mut turns, mut now) = (vec![Vec::new()], 0);
        while turns.len() < 4 {
            match viewer.hear() {
                Said::Clock(time) => {
                    if time < now {
                        turns.push(Vec::new());
                    }
                    now = time;
                }
                Said::Message { number, time, data } => {
                    if turns.len() > 1 {
                        assert_eq!(time, now, "the log time of a message equals the clock");
                    }
                    turns.last_mut().unwrap().push((channels[number as usize].0.clone(), time, data));
                }
                Said::State { .. } => assert_eq!(name, NEW, "viewers of the older protocol do not know this message"),
                Said::Text(text) => panic!("{text}"),
            }
        }
        let expected = recorded(&served.place);
        assert!(expected.iter().any(|(topic, ..)| topic == "/mechanism/forces") && expected.len() > 500);
        assert_eq!((&turns[1], &turns[2]), (&expected, &expected), "{name}");
    }
    assert_eq!(served.end(), 0);
}

#[test]
fn late_viewers_get_one_time_messages_and_may_unsubscribe() {
    let served = Served::by(Place::new(), RUN);
    let mut viewer = Viewer::at(&served.address, OLD);
    let channels = viewer.channels();
    while !matches!(viewer.hear(), Said::Clock(time) if time > 0) {}
    let links = channel(&channels, "/mechanism/links");
    viewer.subscribe(&[(7, links), (7, channel(&channels, "/tf")), (8, 0), (9, u64::MAX)]);
    let first = loop {
        match viewer.hear() {
            Said::Message { number, time, data } => break (number, time, data),
            Said::Clock(time) => {
                assert!(time > 0, "the message comes at once, not in the next pass through the motion")
            }
            other => panic!("{other:?}"),
        }
    };
    let expected = recorded(&served.place).into_iter().find(|(topic, ..)| topic == "/mechanism/links").unwrap();
    assert_eq!(first, (7, 0, expected.2));
    viewer.say(&json!({ "op": "unsubscribe", "subscriptionIds": [7] }));
    let (mut turns, mut now) = (0, 0);
    while turns < 2 {
        match viewer.hear() {
            Said::Clock(time) => {
                turns += usize::from(time < now);
                now = time;
            }
            Said::Message { .. } => assert_eq!(turns, 0, "only a message that was already sent may still come"),
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn the_reference_is_first_and_channel_numbers_are_unique() {
    let served = Served::by(Place::new(), RUN);
    let mut viewer = Viewer::at(&served.address, NEW);
    let (mut here, mut ever, mut sessions) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
    loop {
        let Said::Text(text) = viewer.hear() else { continue };
        match text["op"].as_str().unwrap() {
            "serverInfo" => assert!(sessions.insert(text["sessionId"].to_string()), "{text}"),
            "unadvertise" => {
                for id in text["channelIds"].as_array().unwrap() {
                    assert!(here.remove(&id.as_u64().unwrap()), "{id} was not advertised");
                }
            }
            "advertise" => {
                assert!(here.is_empty(), "{here:?} are still advertised");
                let channels = text["channels"].as_array().unwrap();
                for own in channels {
                    let id = own["id"].as_u64().unwrap();
                    assert!(here.insert(id) && ever.insert(id), "{id} comes twice");
                }
                let of = |side: &str| channels.iter().any(|own| own["topic"].as_str().unwrap().starts_with(side));
                assert!(channels.is_empty() || of("/reference/"));
                if of("/engine/") {
                    break;
                }
            }
            other => panic!("{other}"),
        }
    }
}

#[test]
fn pause_and_seek_affect_only_their_own_viewer() {
    let served = Served::by(Place::new(), RUN);
    let [mut viewer, mut other] = [Viewer::at(&served.address, NEW), Viewer::at(&served.address, NEW)];
    let channels = viewer.channels();
    other.channels();
    viewer.control(false, 1.0, None, "stop");
    let stopped = loop {
        if let Said::State { plays, time, jumped, id } = viewer.hear()
            && id == "stop"
        {
            assert!(!plays && !jumped);
            break time;
        }
    };
    let last = recorded(&served.place).last().unwrap().1;
    let wanted = if stopped > last / 2 { last / 4 } else { last / 4 * 3 };
    viewer.subscribe(&[(1, channel(&channels, "/tf"))]);
    viewer.control(false, 1.0, Some(wanted), "there");
    let (mut clock, mut shown) = (None, None);
    while clock != Some(wanted) || shown.is_none() {
        match viewer.hear() {
            Said::State { plays, time, jumped, id } => {
                assert_eq!((plays, time, jumped, id.as_str()), (false, wanted, true, "there"));
            }
            Said::Clock(time) => clock = Some(time),
            Said::Message { data, .. } => shown = (clock == Some(wanted)).then_some(data),
            Said::Text(text) => panic!("{text}"),
        }
    }
    let mut frames = recorded(&served.place).into_iter();
    let (.., frame) = frames.rfind(|(topic, time, _)| topic == "/tf" && *time <= wanted).unwrap();
    assert_eq!(shown.unwrap(), frame, "the viewer gets the frame of the requested time");
    // The viewer that did not pause continues to play, into the next pass through the motion.
    let mut now = 0;
    loop {
        if let Said::Clock(time) = other.hear() {
            if time < now {
                break;
            }
            now = time;
        }
    }
    // The first viewer receives no message until it resumes.
    viewer.control(true, 1.0, None, "on");
    assert!(matches!(viewer.hear(), Said::State { plays: true, time, .. } if time == wanted));
}

#[test]
fn a_single_instant_is_shown_without_motion() {
    let served = Served::by(Place::new(), "run scenarios/crank_rocker.toml --budget 1e5 --live=0 --times 0");
    let mut viewer = Viewer::at(&served.address, OLD);
    let channels = viewer.channels();
    let wanted = ["/tf", "/mechanism/links", "/engine/link/rocker"].map(|topic| channel(&channels, topic));
    viewer.subscribe(&[(0, wanted[0]), (1, wanted[1]), (2, wanted[2])]);
    let mut seen = [0; 3];
    for _ in 0..50 {
        match viewer.hear() {
            Said::Clock(time) => assert_eq!(time, 0),
            Said::Message { number, .. } => seen[number as usize] += 1,
            other => panic!("{other:?}"),
        }
    }
    assert_eq!(seen, [1; 3]);
}

#[test]
fn malformed_input_is_harmless_and_unknown_protocols_refused() {
    let mut served = Served::by(Place::new(), RUN);
    for text in ["GET / HTTP/1.0\r\n\r\n", "\0\0\0\0", ""] {
        TcpStream::connect(&served.address).unwrap().write_all(text.as_bytes()).unwrap();
    }
    let refused = Viewer::let_in(&served.address, "foxglove.sdk.v9").err().unwrap();
    assert!(refused.contains("400"), "{refused}");
    let mut viewer = Viewer::at(&served.address, NEW);
    viewer.channels();
    for text in
        ["", "{", "[1]", r#"{"op":"subscribe","subscriptions":[{"id":"a"},7,null]}"#, r#"{"op":"getParameters"}"#]
    {
        viewer.0.send(Message::Text(text.into())).unwrap();
    }
    for bytes in [vec![], vec![3], vec![3; 19], vec![255; 1000]] {
        viewer.0.send(Message::Binary(bytes.into())).unwrap();
    }
    for _ in 0..20 {
        assert!(matches!(viewer.hear(), Said::Clock(_) | Said::State { .. }));
    }
    drop(viewer);
    Viewer::at(&served.address, OLD).channels();
    assert_eq!(served.end(), 0);
}

/// Symptom: a viewer could subscribe to a topic without limit, and every lookup searched all its subscriptions.
#[test]
fn a_viewer_may_request_a_topic_four_times_at_most() {
    let mut served = Served::by(Place::new(), RUN);
    let mut viewer = Viewer::at(&served.address, OLD);
    let channels = viewer.channels();
    let grid = channel(&channels, "/reference/grid");
    let pairs: Vec<(u32, u64)> = (0..20_000).map(|number| (number, grid)).collect();
    viewer.subscribe(&pairs);
    let mut numbers = BTreeSet::new();
    let mut heard = 0;
    while heard < 400 {
        if let Said::Message { number, .. } = viewer.hear() {
            numbers.insert(number);
            heard += 1;
        }
    }
    assert_eq!(numbers.into_iter().collect::<Vec<_>>(), [0, 1, 2, 3]);
    // Giving up one subscription allows a new subscription.
    viewer.say(&json!({ "op": "unsubscribe", "subscriptionIds": [1] }));
    viewer.subscribe(&[(9, grid)]);
    let mut is_ninth = || matches!(viewer.hear(), Said::Message { number: 9, .. });
    assert!((0..20_000).any(|_| is_ninth()));
    drop(viewer);
    assert_eq!(served.end(), 0);
}

/// Reads the listening address from the system's list of sockets.
/// The test does not use the printed address, because a server prints the same address for every listening address.
#[cfg(target_os = "linux")]
#[test]
fn live_listens_locally_unless_an_address_is_given() {
    let listens = |arguments: &str| {
        let served = Served::by(Place::new(), arguments);
        let port: u16 = served.address.rsplit(':').next().unwrap().parse().unwrap();
        let sockets = std::fs::read_to_string("/proc/net/tcp").unwrap();
        let listening = sockets.lines().filter_map(|line| {
            let words: Vec<&str> = line.split_whitespace().collect();
            (words.get(3) == Some(&"0A")).then(|| words[1].to_string())
        });
        listening.filter(|own| own.ends_with(&format!(":{port:04X}"))).collect::<Vec<_>>()
    };
    let [own, any] = [RUN.to_string(), RUN.replace("--live=0", "--live=0.0.0.0:0")].map(|run| listens(&run));
    assert!(own.len() == 1 && own[0].starts_with("0100007F:"), "{own:?}");
    assert!(any.len() == 1 && any[0].starts_with("00000000:"), "{any:?}");
}

#[test]
fn surplus_viewers_wait_until_one_leaves() {
    let served = Served::by(Place::new(), RUN);
    let mut viewers: Vec<Viewer> = (0..32).map(|_| Viewer::at(&served.address, OLD)).collect();
    viewers.iter_mut().for_each(|viewer| drop(viewer.channels()));
    assert!(Viewer::let_in(&served.address, OLD).is_err());
    viewers.pop();
    let waits = || {
        sleep(Duration::from_millis(100));
        false
    };
    assert!((0..100).any(|_| Viewer::let_in(&served.address, OLD).is_ok() || waits()));
}

#[test]
fn live_ends_with_the_verdict_code_and_writes_its_outputs() {
    let also = "--no-record --tolerance-scale 1e-9 --json out.json --html out.html";
    let mut served = Served::by(Place::new(), &format!("{RUN} {also}"));
    let mut viewer = Viewer::at(&served.address, OLD);
    viewer.channels();
    while !matches!(viewer.hear(), Said::Clock(time) if time > 0) {}
    assert_eq!(served.end(), 1);
    let there = ["out.json", "out.html", "recordings"].map(|name| served.place.path(name).exists());
    assert_eq!(there, [true, true, false]);
}

#[test]
fn unusable_live_options_are_reported_before_any_work() {
    let place = Place::new();
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let address = taken.local_addr().unwrap();
    let file = "scenarios/pendulum.toml";
    place.refused(&format!("run {file} --live={address}"), &["--live", &address.to_string(), "in use"]);
    place.refused(&format!("run {file} --live={}", address.port()), &["--live", &address.to_string()]);
    place.refused(&format!("run {file} --live=nonsense"), &["--live", "nonsense"]);
    place.refused(&format!("run {file} scenarios/crank_rocker.toml --live"), &["one scenario", "2 are given"]);
    assert!(!place.path("recordings").exists());
}
