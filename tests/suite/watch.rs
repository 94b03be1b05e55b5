//! `watch`: the messages to the page; a faulty draft never ends the server.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};

use serde_json::{Value, json};

use crate::cli::tools::Place;
use crate::common::damage::damaged;

/// A server for a file in a temporary directory.
struct Watched {
    place: Place,
    child: Child,
    /// Host and port, and the path of the page.
    host: String,
    path: String,
}

impl Watched {
    fn of(place: Place, file: &str) -> Watched {
        let mut command = Command::new(assert_cmd::cargo::cargo_bin("linkproof"));
        let mut child =
            command.current_dir(place.path("")).args(["watch", file]).stdout(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
        let (host, path) = line.trim().split_once("http://").unwrap().1.split_once('/').unwrap();
        Watched { host: host.into(), path: format!("/{path}"), place, child }
    }

    /// Status and body of a request.
    fn ask(&self, method: &str, path: &str, body: &str) -> (u16, String) {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        let (host, length) = (&self.host, body.len());
        let head =
            format!("{method} {path} HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nConnection: close\r\n");
        write!(stream, "{head}Content-Length: {length}\r\n\r\n{body}").unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        let (head, body) = answer.split_once("\r\n\r\n").unwrap();
        (head.split(' ').nth(1).unwrap().parse().unwrap(), body.into())
    }

    fn post(&self, what: &str, body: &Value) -> Value {
        let (status, answer) = self.ask("POST", &format!("{}{what}", self.path), &body.to_string());
        assert_eq!(status, 200, "{what}: {answer}");
        serde_json::from_str(&answer).unwrap()
    }

    /// The first state for which `holds` is true.
    fn state(&self, holds: impl Fn(&Value) -> bool) -> Value {
        let mut version = 0;
        loop {
            let (_, told) = self.ask("GET", &format!("{}state?after={version}", self.path), "");
            let state: Value = serde_json::from_str(&told).unwrap();
            if holds(&state) {
                return state;
            }
            version = state["version"].as_u64().unwrap();
        }
    }
}

impl Drop for Watched {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn is_judged(state: &Value) -> bool {
    state["shown"] == state["draft"] && state["stage"] == "judged"
}

#[test]
fn a_draft_is_solved_judged_changed_and_kept() {
    let place = Place::empty();
    place.ok("new four-bar");
    let watched = Watched::of(place, "four_bar.toml");
    let given = watched.state(|_| true)["text"].as_str().unwrap().to_string();
    let state = watched.state(is_judged);
    assert_eq!((&state["verdict"], &state["isKept"]), (&json!("agree"), &json!(true)));
    assert_eq!(state["parameters"][0], json!({ "key": "crank_mm", "value": 40.0 }));
    assert_eq!(state["ground"], json!([["O", 0.0, 0.0], ["C", 0.1, 0.0]]));
    assert!(state["page"].as_str().unwrap().contains("AGREE"));
    // A mistake in the file is reported at its position.
    watched.post(
        "draft",
        &json!({ "text": given.replace("links = [\"ground\", \"crank\"]", "links = [\"ground\", \"crnk\"]") }),
    );
    let wrong = watched.state(|state| state["stage"] == "wrong");
    let place = &wrong["errors"][0]["place"];
    let line = given.lines().position(|line| line.contains("\"ground\", \"crank\"")).unwrap() + 1;
    assert_eq!(place["line"], line);
    assert!(wrong["errors"][0]["help"].as_str().unwrap().contains("crank"));
    assert!(wrong["page"].is_string(), "what can be drawn is drawn");
    // The page changes a parameter and moves a point that two links share.
    // The file stays unchanged until the draft is kept.
    let slid = watched.post("parameter", &json!({ "text": given, "key": "crank_mm", "value": 38.5 }));
    let slid = slid["text"].as_str().unwrap();
    assert_eq!(slid, given.replace("crank_mm = 40 ", "crank_mm = 38.5 "));
    let places = json!([
        { "link": "coupler", "from": [0.12, 0.0], "to": [0.125, 0.0] }, { "link": "rocker", "from": [0.08, 0.0], "to": [0.09, 0.0] },
    ]);
    let moved = watched.post("point", &json!({ "text": slid, "point": "B", "places": places }));
    let moved = moved["text"].as_str().unwrap();
    assert_eq!(
        moved,
        slid.replace("coupler_mm = 120 ", "coupler_mm = 125 ").replace("rocker_mm = 80 ", "rocker_mm = 90 ")
    );
    let file = watched.place.path("four_bar.toml");
    assert_eq!(std::fs::read_to_string(&file).unwrap(), given);
    assert_eq!(watched.state(is_judged)["isKept"], false);
    watched.post("keep", &json!({ "text": moved }));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), moved);
    assert_eq!(watched.state(|state| state["isKept"] == true)["isMissing"], false);
    // If a parameter or a point cannot be changed, the answer contains an error.
    for (what, body) in [
        ("parameter", json!({ "text": given, "key": "none_mm", "value": 1.0 })),
        (
            "point",
            json!({ "text": given, "point": "E", "places": [{ "link": "coupler", "from": [0.0, 0.0], "to": [1.0, 1.0] }] }),
        ),
    ] {
        assert!(watched.post(what, &body)["error"].is_string(), "{what}");
    }
    // If the file was deleted, keeping the draft writes the file again.
    std::fs::remove_file(&file).unwrap();
    watched.state(|state| state["isMissing"] == true);
    watched.post("keep", &json!({ "text": given }));
    assert_eq!(watched.state(|state| state["isMissing"] == false && is_judged(state))["verdict"], "agree");
}

#[test]
fn no_draft_ends_the_server() {
    let watched = Watched::of(Place::new(), "scenarios/pendulum.toml");
    watched.state(is_judged);
    for index in 0..60 {
        let text = damaged(7, index).text;
        let draft = watched.post("draft", &json!({ "text": text }))["draft"].as_u64().unwrap();
        let state = watched.state(|state| state["shown"] == draft);
        assert!(["wrong", "moving", "solved", "judged"].contains(&state["stage"].as_str().unwrap()), "{index}");
        assert!(state["stage"] != "wrong" || state["errors"].as_array().is_some_and(|all| !all.is_empty()), "{index}");
    }
    for (method, path, body) in [
        ("POST", "draft", "{"),
        ("POST", "draft", "[]"),
        ("POST", "point", "{\"text\": \"\", \"point\": \"A\", \"places\": 3}"),
        ("POST", "nothing", "{\"text\": \"\"}"),
    ] {
        assert_eq!(watched.ask(method, &format!("{}{path}", watched.path), body).0, 400, "{path} {body}");
    }
    assert_eq!(watched.ask("GET", "/", "").0, 404);
    assert_eq!(watched.ask("DELETE", &watched.path, "").0, 404);
    let pendulum = include_str!("../../scenarios/pendulum.toml");
    watched.post("draft", &json!({ "text": pendulum }));
    assert_eq!(watched.state(is_judged)["verdict"], "agree");
}

#[test]
fn a_missing_file_and_a_taken_port_are_told() {
    let place = Place::new();
    let missing = place.run("watch none.toml");
    assert!(missing.code == 2 && missing.stderr.contains("none.toml"), "{}", missing.stderr);
    let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    let taken = place.run(&format!("watch scenarios/pendulum.toml --port {port}"));
    assert!(taken.code == 2 && taken.stderr.contains("port"), "{}", taken.stderr);
}
